# The body of Figures 6 and 8: orbits of rotor and stator, one speed per panel
#
# Loaded by fig06_orbits.gp and fig08_orbits.gp with `table` and `output` set.
# A panel shows the harmonic-balance orbit, in colour, where time integration finds a motion of
# period T and the rms error of harmonic balance about the mean is at most 10 %, with that motion in grey
# below it; elsewhere it shows the integrated motion over several periods, and says why.

panels = int(system(sprintf("awk -F'\t' '$1 + 0 > most { most = $1 } END { print most }' '%s'", table)))
rows = int(ceil(panels / 3.0))
height = 150 + 362 * rows
load 'figures/style.gp'

balance = 1; integrated = 2
of(source, value) = column("panel") == p && column("source") == source ? value : NaN

# After the speed: the error of harmonic balance; else why it is not drawn, or the spread.
title_of(f, found, periodic, spread, error) = sprintf("(%s) %g Hz", "abcdefghijkl"[p : p], f).( \
  periodic == 0 ? sprintf(", spread %.2g %%\nnot T-periodic", 100 * spread) : \
  found == 0 ? sprintf("\nno %d-harmonic solution found", harmonics(1)) : \
  source == balance ? sprintf("\nrms error %.2g %%", 100 * error) : \
  sprintf(", time integration\n%d harmonics: rms error %.2g %%", harmonics(1), 100 * error))

# Above the panels: what is drawn, and the names of the curves, given by the first panel.
from_top(units) = 1 - units / (1.0 * height)
stats table using "panel":"t_over_T" name 'all' nooutput
modelled = sprintf("δ = %g µm, harmonic balance with %d harmonics; ", \
                   1e6 * clearance(1), harmonics(1)).\
           sprintf("pale grey below: %d periods of time integration\n", ceil(all_max_y)).\
           "rms error: of the displacements about their means; above 10 % time integration is drawn alone\n".\
           "spread: scatter of the states after each turn, over the largest displacement"
set label 1 modelled at screen 0.5, from_top(20) center
set key at screen 0.53, from_top(80) center top vertical maxrows 2 Left reverse width 2

set multiplot layout rows, 3 \
  margins 0.085, 0.99, 60.0 / height, from_top(200) spacing 0.105, 132.0 / height
do for [p = 1 : int(all_max_x)] {
  # A range left from the panel before would hide rows from `stats`.
  set xrange [* : *]
  set yrange [* : *]
  stats table using (of(integrated, column("found"))):"periodic" name 'flag' nooutput
  stats table using (of(integrated, column("f"))):"spread" name 'motion' nooutput
  stats table using (of(integrated, column("shown"))):"difference_rms" name 'error' nooutput
  source = error_max_x
  # One turn of a motion that repeats: dashes drawn over others would fill their gaps.
  turns = flag_max_y == 1 ? 1 : all_max_y
  shown(value) = column("t_over_T") <= turns ? of(source, value) : NaN
  load 'figures/orbit_axes.gp'
  eval orbit_axes
  set title title_of(speed, flag_max_x, flag_max_y, motion_max_y, error_max_y) offset 0, -0.6
  data = source == balance ? closed_orbit(p) : table
  line = source == balance ? 1.6 : 1
  plot \
    table using (source == balance ? of(integrated, scaled("x_r")) : NaN):(scaled("y_r")) notitle \
      with lines lc rgb '#c8c8c8' lw 2.5, \
    table using (source == balance ? of(integrated, scaled("x_s")) : NaN):(scaled("y_s")) notitle \
      with lines lc rgb '#c8c8c8' lw 2.5, \
    data using (shown(scaled("x_r"))):(scaled("y_r")) notitle \
      with lines ls source == balance ? rotor : rotor_time lw 1.8 * line, \
    data using (shown(scaled("x_s"))):(scaled("y_s")) notitle \
      with lines ls source == balance ? stator : stator_time lw line, \
    keyentry with lines ls rotor title "rotor, harmonic balance", \
    keyentry with lines ls stator title "stator, harmonic balance", \
    keyentry with lines ls rotor_time title "rotor, time integration alone", \
    keyentry with lines ls stator_time title "stator, time integration alone"
  unset key
  unset label 1
}
unset multiplot
