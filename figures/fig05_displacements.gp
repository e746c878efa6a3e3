# Figure 5: displacements of rotor and stator beyond the transition
#
# Paper: §3.3, Fig. 5 (data set 1), claim C6.
# Usage: gnuplot -e "table='data/generated/fig05_displacements.tsv'; output='fig05_displacements.svg'" \
#        figures/fig05_displacements.gp

load 'figures/displacements.gp'
