# Truncation: distance of the m-harmonic solution to the nearest attractor's motion, both data sets
#
# Paper: §3.3, claims C2 and C3.
# Usage: gnuplot -e "table='data/reference/validity.tsv'; output='truncation.svg'" \
#        figures/truncation.gp
# Above, the largest error over the speeds with a T-periodic attractor at which harmonic balance finds a solution;
# below, the number of those speeds at which it finds none, so that few harmonics are not favoured by what they miss.

height = 800
load 'figures/style.gp'

periodic = 2; force = 3; missing = 4; limit = 5; paper = 6
set style line periodic lc rgb '#0072B2' lw 2.2 dt 1 pt 7
set style line force    lc rgb '#D55E00' lw 1.6 dt 1 pt 9
set style line missing  lc rgb '#777777'
set style line limit    lc rgb '#404040' lw 1 dt (2,3)
set style line paper    lc rgb '#CC79A7' lw 2 dt 1
set style fill solid noborder

# The rows of the solutions with fixed m.
fixed = sprintf("< awk -F'\\t' '/^#/ || $3 != 1' '%s'", table)

# The rows of a set ($1) with a T-periodic attractor ($11) by m ($4): m, the largest error of the displacements ($6) and
# of the force ($7) over those found ($5), and the number not found.
by_harmonics(s) = sprintf("< awk -F'\\t' -v OFS='\\t' 'function most(a, b) { return a > b ? a : b } \
  BEGIN { print \"m\", \"periodic\", \"force\", \"missing\" } \
  $1 == %d && $3 == 0 && $11 { seen[$4]; if (!$5) { missing[$4]++; next } same[$4] = most(same[$4], $6); force[$4] = most(force[$4], $7) } \
  END { for (m = 1; m in seen; m++) print m, same[m], force[m], missing[m] + 0 }' '%s'", s, table)

# The limits and the paper's number of harmonics, from the rules of the claims.
claims = 'data/claims.toml'
limits = system("sed -n 's/^distance_limits = .\\(.*\\)./\\1/p' ".claims." | tr -d ,")
of_paper(claim) = real(system(sprintf( \
  "sed -n '/^id = \"%s\"/,/^paper/ s/^paper = \"\\(.*\\)\"/\\1/p' %s", claim, claims)))

# Both columns share their ranges.
stats fixed using "m":"set" name 'M' nooutput
sets = int(M_max_y)
most_missed = 1
least = real(word(limits, words(limits)))
array title_of[sets]
do for [s = 1 : sets] {
  stats by_harmonics(s) using "periodic":"missing" name 'R' nooutput
  least = min(least, R_min_x)
  most_missed = max(most_missed, R_max_y)
  stats table using (column("set") == s && column("adaptive") == 1 ? column("periodic") : NaN) name 'T' nooutput
  title_of[s] = sprintf("data set %d, δ = %g µm: T-periodic\nattractor at %d of %d speeds", \
                        s, 1e6 * clearance(s), T_sum, T_records)
}
stats fixed using (column("distance")):(column("distance_force")) name 'D' nooutput
greatest = max(D_max_x, D_max_y)

set xrange [M_min_x - 0.7 : M_max_x + 0.7]
set xtics 2
set key at screen 0.53, 0.995 center top vertical maxrows 2 Left reverse width -3
name(text) = s == 1 ? text : ""
column_width = 0.91 / sets

set multiplot
do for [s = 1 : sets] {
  rows = by_harmonics(s)
  set lmargin at screen 0.085 + (s - 1) * column_width
  set rmargin at screen 0.04 + s * column_width

  set tmargin at screen 0.84
  set bmargin at screen 0.36
  set title title_of[s] offset 0, -0.6
  set logscale y
  set yrange [least / 2 : 8 * greatest]
  set ytics autofreq
  set xlabel ""
  set format x ""
  set format y s == 1 ? "%g" : ""
  set ylabel s == 1 ? "largest rms error about the mean [-]" : "" offset 0.5, 0
  do for [i = 1 : words(limits)] {
    set label i sprintf("%g %%", 100 * word(limits, i)) at graph 1, first real(word(limits, i)) \
      right offset -0.4, -0.5
  }
  set label 9 s == 1 ? "(a)" : "(b)" at graph 0.03, 0.94
  paper_m = of_paper(word("C2 C3", s))
  set arrow 1 from paper_m, graph 0 rto 0, graph 1 nohead back ls paper
  plot \
    for [value in limits] real(value) with lines ls limit notitle, \
    rows using "m":"periodic" with linespoints ls periodic ps 0.8 title name("displacements"), \
    rows using "m":"force" with linespoints ls force ps 0.8 title name("force"), \
    keyentry with lines ls limit title name("limits of the verdicts"), \
    keyentry with lines ls paper title name("harmonics that suffice in the paper")
  unset label
  unset arrow
  set label 9 s == 1 ? "(c)" : "(d)" at graph 0.03, 0.88

  set tmargin at screen 0.33
  set bmargin at screen 0.085
  set title ""
  unset logscale y
  set yrange [0 : 1.1 * most_missed]
  set ytics tic_step(most_missed)
  set xlabel "number of harmonics m" offset 0, 0.3
  set format x "%g"
  set ylabel s == 1 ? "of them unsolved [-]" : "" offset 0.5, 0
  plot rows using (column("m")):(column("missing")):(0.7) with boxes ls missing notitle
}
unset multiplot
