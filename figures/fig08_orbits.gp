# Figure 8: evolution of the orbits with speed, data set 2
#
# Paper: §3.3, Fig. 8 (rotor solid, stator dashed), claims C3 and C13.
# Usage: gnuplot -e "table='data/generated/fig08.tsv'; output='fig08.svg'" \
#        figures/fig08_orbits.gp

load 'figures/orbits.gp'
