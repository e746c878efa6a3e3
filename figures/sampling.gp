# The sample rule: error of sampling over error of truncation, against samples per harmonic
#
# Paper: §3.1, where N = 2m+1 (D-05, D-14).
# Usage: gnuplot -e "table='data/generated/sampling.tsv'; output='sampling.svg'" figures/sampling.gp
# One column for each machine and speed; above the displacements, below the force. Under the line at
# one, more samples buy less than more harmonics would. Rings mark the default N.

height = 640
load 'figures/style.gp'

stats table using "panel" name 'P' nooutput
panels = int(P_max)
counts = system(sprintf("awk -F'\\t' '/^[0-9]/ && !seen[$3]++ { print $3 }' '%s'", table))

# Light to dark with m (viridis).
array colour[6] = ['#FDE725', '#7AD151', '#22A884', '#2A788E', '#414487', '#440154']
shade(i) = colour[words(counts) + 1 - i < 1 ? 1 : 7 - (words(counts) + 1 - i)]
limit = 1; usual = 2
set style line limit lc rgb '#404040' lw 1.2 dt (2,3)
set style line usual lc rgb '#CC79A7' lw 2 pt 6 ps 1.1

set datafile missing "0"
set logscale xy
set xrange [1.7 : 75]
set xtics ("2" 2, "4" 4, "8" 8, "16" 16, "32" 32, "64" 64)
set yrange [1e-4 : 100]
set format y "10^{%T}"
set key at screen 0.53, 0.995 center top vertical maxrows 2 Left reverse width -1
what(row) = row == 1 ? "displacement" : "force"
panel_title(k) = system(sprintf( \
  "sed -nE 's/^# row panel: %d [^0-9]*([0-9])[^ ]* ([^ ]*)$/data set \\1, \\2 Hz/p' '%s'", k, table))
width = 0.885 / panels

set label 1 "samples per period over harmonics, N/m [-]" at screen 0.53, 0.035 center
set label 2 "sampling error over truncation error [-]" at screen 0.012, 0.48 center rotate

set multiplot
do for [row = 1 : 2] {
  set tmargin at screen row == 1 ? 0.835 : 0.465
  set bmargin at screen row == 1 ? 0.50 : 0.13
  do for [k = 1 : panels] {
    set lmargin at screen 0.105 + (k - 1) * width
    set rmargin at screen 0.09 + k * width
    set title row == 1 ? panel_title(k) : "" offset 0, -0.6
    set ylabel k == 1 ? what(row) : "" offset 1.2, 0
    set format y k == 1 ? "10^{%T}" : ""
    set format x row == 2 ? "%g" : ""
    set xtics (row == 2 ? "2" : "" 2, row == 2 ? "4" : "" 4, row == 2 ? "8" : "" 8, \
      row == 2 ? "16" : "" 16, row == 2 ? "32" : "" 32, row == 2 ? "64" : "" 64)
    name(text) = row == 1 && k == 1 ? text : ""
    error(of_what) = column(of_what.(row == 1 ? "_rms" : "_force"))
    of(i, wanted) = column("panel") == k && column("m") == word(counts, i) + 0 && wanted ? \
      column("N") / column("m") : NaN
    plot \
      1 with lines ls limit title name("errors equal"), \
      keyentry with points ls usual title name("default N"), \
      for [i = 1 : words(counts)] table using (of(i, column("found") == 1)):(error("sampling") / error("truncation")) \
        with linespoints lc rgb shade(i) lw 1.8 pt 3 + 2 * i ps 0.35 \
        title name(sprintf("m = %s", word(counts, i))), \
      for [i = 1 : words(counts)] table using (of(i, column("default") == 1)):(error("sampling") / error("truncation")) \
        with points ls usual notitle
    unset label
  }
}
unset multiplot
