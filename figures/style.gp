# Style of every figure drawn by gnuplot.
#
# Usage: load 'figures/style.gp', with `height` set, from a script started in the project root with
# gnuplot -e "table='...'; output='...'" figures/figNN_....gp
# Every figure is 960 units wide; rotor_stator.mplstyle has the same width, fonts and colours.

if (!exists("table") || !exists("output")) {
  print "usage: gnuplot -e \"table='FILE.tsv'; output='FILE.svg'\" SCRIPT"
  exit status 2
}

set terminal svg size 960, height enhanced font 'DejaVu Sans,sans-serif,16' \
  name 'rotor_stator' background 'white'
set output output
set datafile separator "\t"
set datafile columnheaders
set border lw 1 lc rgb '#404040'
set tics nomirror scale 0.6 textcolor rgb '#000000'
set grid lc rgb '#d9d9d9' lw 0.7 lt 1
set key samplen 2.5 spacing 1.15

# Colours of Okabe and Ito. Rotor solid, stator dashed, as in the paper; time integration in darker shades of the same.
rotor = 1; stator = 2; relative = 3
rotor_time = 4; stator_time = 5
rotor_down = 6; stator_down = 7
set style line rotor       lc rgb '#0072B2' lw 2.2 dt 1 pt 7
set style line stator      lc rgb '#D55E00' lw 2.2 dt (6,3) pt 5
set style line relative    lc rgb '#009E73' lw 2.2 dt 1
set style line rotor_time  lc rgb '#003C63' lw 1.2 dt 1 pt 7
set style line stator_time lc rgb '#A04000' lw 1.2 dt (6,3) pt 5
set style line rotor_down  lc rgb '#9CCFF2' lw 8 dt 1 pt 7
set style line stator_down lc rgb '#F9D28A' lw 5 dt 1 pt 5

max(a, b) = a > b ? a : b
min(a, b) = a < b ? a : b

# The number of a key of the table, or the first one of the n-th member of a list.
value_of(key, n) = real(word(system(sprintf("/usr/bin/python3 figures/tables.py '%s' %s", table, key)), n))
clearance(n) = value_of("clearance", n)
harmonics(n) = value_of("harmonics", n)

# The rows of a panel ($1) from harmonic balance ($3), the first once more at the end to close it.
closed_orbit(panel) = sprintf("< awk -F'\\t' '/^#/ || !NF { next } !names { names = $0; print } \
  $1 == %d && $3 == 1 { if (!first) first = $0; print } END { print first }' '%s'", panel, table)

# A length [m] is drawn in mm from 1 mm on, in µm below.
unit(length) = length < 1e-3 ? "µm" : "mm"
per_metre(length) = length < 1e-3 ? 1e6 : 1e3

# Distance of the tics, 1, 2 or 5 times a power of ten, so that two to five intervals fit a length.
power(length) = 10 ** floor(log10(length))
tic_step(length) = power(length) * (length < 2 * power(length) ? 0.5 : \
                                    length < 5 * power(length) ? 1 : 2)
