# Figure 8: evolution of the orbits with speed, data set 2
#
# Paper: §3.3, Fig. 8 (rotor solid, stator dashed), claims C3 and C13.
# Usage: gnuplot -e "table='data/generated/fig08_orbits.tsv'; output='fig08_orbits.svg'" \
#        figures/fig08_orbits.gp

load 'figures/orbits.gp'
