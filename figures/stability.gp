# Stability along the response curves of both data sets
#
# Paper: §3.3, Fig. 3.  Usage: gnuplot -e "table='data/reference/stability.tsv'; output='stability.svg'" \
#        figures/stability.gp
# Rows: numbers of harmonics; columns: data sets. Solid: stable, thin and dotted: unstable. The multipliers
# are those of the linearisation along the truncated series.

height = 1150
load 'figures/style.gp'

mm(name) = 1e3 * column(name)
stats table using "set":"f" name 'F' nooutput
sets = int(F_max_x)
ms = system(sprintf("awk -F'\\t' '/^#/ || !NF { next } !names { names = 1; next } \
  !seen[$3]++ { print $3 }' '%s' | sort -n", table))

set style line 11 lc rgb '#0072B2' lw 2.2
set style line 12 lc rgb '#D55E00' lw 2.2
set style line 21 lc rgb '#0072B2' lw 1.1 dt (2,3)
set style line 22 lc rgb '#D55E00' lw 1.1 dt (2,3)

# The points of one panel: rows of a set and m, of which those of one verdict; others are gaps. A stretch of
# one verdict begins with the last point of the stretch before it.
rows(s, m, verdict) = sprintf("< awk -F'\\t' '/^#/ { next } !NF { print \"\"; before = \"\"; next } \
  !names { names = 1; print; next } $1 != %d || $3 != %s { next } \
  { good = ($13 == 1); if (good == %d) { if (before != \"\" && last != good) print before; print } \
    else if (last == %d && before != \"\") { print; print \"\" } before = $0; last = good }' '%s'", \
  s, m, verdict, verdict, table)
marks(s, m, kind) = sprintf("< awk -F'\\t' '/^#/ || !NF { next } !names { names = 1; print; next } \
  $1 == %d && $3 == %s && $14 == \"%s\"' '%s'; echo", s, m, kind, table)

set xrange [0 : F_max_y]
set logscale y
set yrange [1e-4 : 30]
set format y '10^{%T}'
set key at screen 0.53, 0.998 center top vertical maxrows 3 Left reverse width 1
set style line 31 pt 2 ps 0.5 lc rgb '#000000'
set style line 32 pt 6 ps 0.6 lc rgb '#009E73'
set style line 33 pt 8 ps 0.7 lc rgb '#CC79A7'
set style line 34 pt 4 ps 0.4 lc rgb '#777777'

set multiplot layout words(ms), sets margins 0.095, 0.985, 0.06, 0.895 spacing 0.045, 0.025
do for [k = 1 : words(ms)] {
  m = word(ms, k)
  do for [s = 1 : sets] {
    # Above the panels once, whether the first panel shows each of them or not.
    if (k == 1 && s == 1) { set key on } else { set key off }
    last = k == words(ms)
    set xlabel last ? "speed of rotation f [Hz]" : ""
    set format x last ? "%g" : ""
    set ylabel s == 1 ? "half peak-to-peak of x [mm]" : "" offset 0.8, 0
    set format y s == 1 ? '10^{%T}' : ""
    set title k == 1 ? sprintf("data set %d, δ = %g µm", s, 1e6 * clearance(s)) : "" offset 0, -0.6
    set label 1 "m = ".m at graph 0.03, 0.92 front
    plot \
      keyentry with lines ls 11 title "rotor, stable", \
      keyentry with lines ls 21 title "rotor, unstable", \
      keyentry with lines ls 12 title "stator, stable", \
      keyentry with lines ls 22 title "stator, unstable", \
      keyentry with points ls 31 title "fold", \
      keyentry with points ls 32 title "period doubling", \
      keyentry with points ls 33 title "Neimark-Sacker", \
      keyentry with points ls 34 title "multiplier +1", \
      rows(s, m, 1) using "f":(mm("amp_x_r")) with lines ls 11 notitle, \
      rows(s, m, 0) using "f":(mm("amp_x_r")) with lines ls 21 notitle, \
      rows(s, m, 1) using "f":(mm("amp_x_s")) with lines ls 12 notitle, \
      rows(s, m, 0) using "f":(mm("amp_x_s")) with lines ls 22 notitle, \
      marks(s, m, "fold") using "f":(mm("amp_x_r")) with points ls 31 notitle, \
      marks(s, m, "period-doubling") using "f":(mm("amp_x_r")) with points ls 32 notitle, \
      marks(s, m, "neimark-sacker") using "f":(mm("amp_x_r")) with points ls 33 notitle, \
      marks(s, m, "plus-one") using "f":(mm("amp_x_r")) with points ls 34 notitle
  }
}
unset multiplot
