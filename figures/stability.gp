# Stability along the response curves of both data sets
#
# Paper: §3.3, Fig. 3.
# Usage: gnuplot -e "table='data/reference/stability.tsv'; output='stability.svg'" figures/stability.gp
# Rows: numbers of harmonics; columns: data sets. Solid: stable, dashed: unstable, thin grey: no motion
# of Eq. 7 found near the solution. Multipliers and bifurcations are the machine's, folds those of the m harmonics. Behind: where
# time integration settles, T-periodic (dots) and otherwise (bars over all such attractors at a speed), from
# the table of attractors beside that of stability.

height = 1150
load 'figures/style.gp'
attractors = system("dirname '".table."'")."/attractors.tsv"

mm(name) = 1e3 * column(name)
stats table using "set":"f" name 'F' nooutput
sets = int(F_max_x)
stats table using "amp_x_r" name 'A' nooutput
ms = system(sprintf("awk -F'\\t' '/^#/ || !NF { next } !names { names = 1; next } \
  !seen[$3]++ { print $3 }' '%s' | sort -n", table))

set style line 11 lc rgb '#0072B2' lw 2.2
set style line 12 lc rgb '#D55E00' lw 2.2
set style line 21 lc rgb '#0072B2' lw 1.1 dt (4,3)
set style line 22 lc rgb '#D55E00' lw 1.1 dt (4,3)
set style line 23 lc rgb '#999999' lw 0.4
set style line 41 lc rgb '#9CCBE8' pt 7 ps 0.35
set style line 42 lc rgb '#F6C79F' pt 7 ps 0.35
set style line 43 lc rgb '#BBBBBB' lw 2.5 pt 7 ps 0.3

# The points of one panel: rows of a set and m, of which those of one kind (1 stable, 0 unstable, 2 not
# examined); others are gaps. A stretch of one kind begins with the last point of the stretch before it.
rows(s, m, kind) = sprintf("< awk -F'\\t' '/^#/ { next } !NF { print \"\"; before = \"\"; next } \
  !names { names = 1; print; next } $1 != %d || $3 != %s { next } \
  { now = $12 == 1 ? 1 : $12 == -2 ? 2 : 0; \
    if (now == %d) { if (before != \"\" && last != now) print before; print } \
    else if (last == %d && before != \"\") { print; print \"\" } before = $0; last = now }' '%s'", \
  s, m, kind, kind, table)
marks(s, m, kind) = sprintf("< awk -F'\\t' '/^#/ || !NF { next } !names { names = 1; print; next } \
  $1 == %d && $3 == %s && $13 == \"%s\"' '%s'; echo", s, m, kind, table)

# Attractors: speed and amplitude of those with the period of rotation; speed and least and largest amplitude
# of the others. The column is that of amp_x_s or amp_x_r.
periodic(s, column) = sprintf("< echo f; awk -F'\\t' -v OFS='\\t' '/^#/ || $1 != %d || $4 != 1 { next } \
  { print $2, $%d }' '%s' | sort -u", s, column, attractors)
others(s, column) = sprintf("< echo f; awk -F'\\t' -v OFS='\\t' '/^#/ || $1 != %d || $4 == 1 { next } \
  !($2 in low) || $%d < low[$2] { low[$2] = $%d } !($2 in high) || $%d > high[$2] { high[$2] = $%d } \
  END { for (f in low) print f, low[f], high[f] }' '%s' | sort -n", \
  s, column, column, column, column, attractors)
x_s = 12
x_r = 14

set xrange [0 : F_max_y]
set logscale y
set yrange [5e-8 : 2.5e3 * A_max]
set ytics (1e-4, 1e-3, 1e-2, 1e-1, 1, 10)
set format y '10^{%T}'
set key at screen 0.53, 0.998 center top vertical maxrows 2 Left reverse font ',14' samplen 2
kinds = "fold period-doubling neimark-sacker plus-one"
array names[4] = ["folds of m harmonics", "period doublings", "Neimark-Sacker points", "multiplier 1"]
height_of(k) = 5e-5 / 7 ** k

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
    set label 1 sprintf("(%s) m = %s", "abcdefgh"[2 * k + s - 2 : 2 * k + s - 2], m) at graph 0.03, 0.95 front
    do for [j = 1 : 4] { set label 1 + j names[j] at 59, 2.4 * height_of(j - 1) right font ',12' front }
    plot \
      keyentry with lines ls 11 title "rotor, stable", \
      keyentry with lines ls 21 title "rotor, unstable", \
      keyentry with lines ls 12 title "stator, stable", \
      keyentry with lines ls 22 title "stator, unstable", \
      keyentry with lines ls 23 title "no motion found", \
      keyentry with points ls 41 title "T-periodic motion", \
      keyentry with lines ls 43 title "other motions", \
      others(s, x_r) using 1:(1e3*$2):(0):(1e3*($3 - $2)) with vectors ls 43 nohead notitle, \
      others(s, x_r) using 1:(1e3*$2) with points ls 43 notitle, \
      others(s, x_s) using 1:(1e3*$2):(0):(1e3*($3 - $2)) with vectors ls 43 nohead notitle, \
      others(s, x_s) using 1:(1e3*$2) with points ls 43 notitle, \
      periodic(s, x_r) using 1:(1e3*$2) with points ls 41 notitle, \
      periodic(s, x_s) using 1:(1e3*$2) with points ls 42 notitle, \
      rows(s, m, 2) using "f":(mm("amp_x_r")) with lines ls 23 notitle, \
      rows(s, m, 2) using "f":(mm("amp_x_s")) with lines ls 23 notitle, \
      rows(s, m, 1) using "f":(mm("amp_x_r")) with lines ls 11 notitle, \
      rows(s, m, 0) using "f":(mm("amp_x_r")) with lines ls 21 notitle, \
      rows(s, m, 1) using "f":(mm("amp_x_s")) with lines ls 12 notitle, \
      rows(s, m, 0) using "f":(mm("amp_x_s")) with lines ls 22 notitle, \
      for [j = 1 : 4] marks(s, m, word(kinds, j)) using "f":(height_of(j - 1)) with points pt '|' lc rgb '#000000' notitle
  }
}
unset multiplot
