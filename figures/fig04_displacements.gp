# Figure 4: displacements of rotor and stator in the transition
#
# Paper: §3.3, Fig. 4 (data set 1), claim C5.
# Usage: gnuplot -e "table='data/generated/fig04_displacements.tsv'; output='fig04_displacements.svg'" \
#        figures/fig04_displacements.gp

load 'figures/displacements.gp'
