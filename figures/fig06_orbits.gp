# Figure 6: evolution of the orbits with speed, data set 1
#
# Paper: §3.3, Fig. 6 (rotor solid, stator dashed), claims C4 to C6.
# Usage: gnuplot -e "table='data/generated/fig06_orbits.tsv'; output='fig06_orbits.svg'" \
#        figures/fig06_orbits.gp

load 'figures/orbits.gp'
