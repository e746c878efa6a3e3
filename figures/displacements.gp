# The body of Figures 4 and 5: displacements of rotor and stator at one speed
#
# Loaded by fig04_displacements.gp and fig05_displacements.gp with `table` and `output` set.
# Left, x and y over two periods; right, both orbits and the rotor's motion relative to the stator.
# Harmonic balance, one period in the table and drawn twice, is a thin line in colour over the integrated motion, a
# broad line in a pale shade.

height = 960
load 'figures/style.gp'
from_top(units) = 1 - units / (1.0 * height)

set style line rotor_time  lc rgb '#A8CDE6' lw 6 dt 1
set style line stator_time lc rgb '#F3C4A3' lw 6 dt 1
balance = 1; integrated = 2
of(source, value) = column("source") == source ? value : NaN
shown(value) = value

# Both orbits in the unit that suits the largest displacement; the relative motion, of the size of
# the clearance, always in µm.
load 'figures/orbit_axes.gp'
relative_um(d) = 1e6 * (column(d."_r") - column(d."_s"))
delta_um = 1e6 * clearance(1)
stats table using (0):(sqrt(relative_um("x") ** 2 + relative_um("y") ** 2)) name 'U' nooutput

# Three lines on top: the case, how far the methods differ, whether integration finds period T.
stats table using "found":"periodic" name 'flag' nooutput
stats table using "spread":"difference_rms" name 'error' nooutput
stats table using (0):"difference_force" name 'force' nooutput
found = int(flag_max_x)
comparison = found == 1 ? \
  sprintf("Difference of both methods: displacements %.2g %% (rms, about the means), ", \
          100 * error_max_y).sprintf("force %.2g %% (largest)", 100 * force_max_y) : \
  "No harmonic-balance solution found: time integration alone"
regime = "Time integration is ".(flag_max_y == 1 ? "" : "not ").\
  sprintf("T-periodic: Poincaré spread %.2g %% ", 100 * error_max_x).\
  (flag_max_y == 1 ? "of the largest displacement" : "(spread and rms: means over 30 s)")
case = sprintf("f = %g Hz, δ = %g µm, harmonic balance with %d harmonics", \
               speed, delta_um, harmonics(1))
set label 1 case."\n".comparison."\n".regime at screen 0.5, from_top(18) center

set multiplot layout 2, 2 columnsfirst \
  margins 0.09, 0.975, 78.0 / height, from_top(156) spacing 0.13, 140.0 / height
set key at screen 0.53, from_top(87) center top vertical maxrows 2 Left reverse width 2

# The rows of harmonic balance ($3) once more with t/T ($13) one larger, and the first at the end.
two_periods = sprintf("< awk -F'\\t' -v OFS='\\t' '/^#/ || !NF { next } !names { names = 1; print; next } \
  $3 == 1 { row[n++] = $0 } END { for (k = 0; k <= 2 * n; k++) { $0 = row[k %% n]; $13 += int(k / n); print } }' '%s'", table)

# Left: x(t) and y(t). The first panel names the curves.
set xrange [0 : 2]
set xlabel "time over period t/T [-]" offset 0, 0.5
do for [d in "x y"] {
  r = d."_r"
  b = d."_s"
  name(text) = d eq "x" ? text : ""
  set ylabel d." [".unit(largest)."]" offset 1.2, 0
  set label 2 d eq "x" ? "(a)" : "(b)" at graph 0, 1.04 front
  plot \
    table using (of(integrated, column("t_over_T"))):(scaled(r)) \
      with lines ls rotor_time title name("rotor, time integration"), \
    table using (of(integrated, column("t_over_T"))):(scaled(b)) \
      with lines ls stator_time title name("stator, time integration"), \
    for [k = 1 : found] two_periods using "t_over_T":(scaled(r)) \
      with lines ls rotor title name("rotor, harmonic balance"), \
    for [k = 1 : found] two_periods using "t_over_T":(scaled(b)) \
      with lines ls stator title name("stator, harmonic balance")
  unset label 1
}

# Right, above: the orbits.
orbit = found ? closed_orbit(panel) : table
eval orbit_axes
set label 2 "(c)" at graph 0.03, 0.94
plot \
  table using (of(integrated, scaled("x_r"))):(scaled("y_r")) with lines ls rotor_time lw 3 notitle, \
  table using (of(integrated, scaled("x_s"))):(scaled("y_s")) with lines ls stator_time lw 3 notitle, \
  orbit using (of(balance, scaled("x_r"))):(scaled("y_r")) with lines ls rotor notitle, \
  orbit using (of(balance, scaled("x_s"))):(scaled("y_s")) with lines ls stator notitle

# Right, below: a contact needs a relative motion outside the circle of the clearance. Integration
# is drawn as points, since the samples of the table are too far apart to join them there. The key
# stands above the panel, whose middle the points may cross.
span = 1.08 * max(delta_um, U_max_y)
set xrange [-span : span]
set yrange [-span : span]
set xtics tic_step(2 * span)
set ytics tic_step(2 * span)
set xlabel "x of rotor − x of stator [µm]" offset 0, 0.5
set ylabel "y of rotor − y of stator [µm]" offset 1, 0
set label 2 "(d)" at graph 0.03, 0.94
set object 1 circle at 0, 0 size delta_um fs empty border rgb '#000000'
set key at graph 0.46, 1.025 center bottom vertical maxrows 2 Left reverse width -5
plot \
  table using (of(integrated, relative_um("x"))):(relative_um("y")) \
    with points pt 7 ps 0.35 lc rgb '#777777' notitle, \
  orbit using (of(balance, relative_um("x"))):(relative_um("y")) \
    with lines ls relative title found ? "harmonic balance" : "", \
  keyentry with points pt 7 ps 0.5 lc rgb '#777777' title "time integration", \
  keyentry with points pt 6 lw 1 ps 1.6 lc rgb '#000000' title sprintf("clearance δ = %g µm", delta_um)
unset multiplot
