# Figure 3: frequency response of rotor and stator, both data sets
#
# Paper: §3.3, Fig. 3 (data set 1; set 2 is added here), claims C1 to C3.
# Usage: gnuplot -e "table='data/generated/fig03_response.tsv'; output='fig03_response.svg'" \
#        figures/fig03_response.gp
# Harmonic balance with the speed rising lies over the same with the speed falling, so that the pale
# curve shows where they differ; a gap is a speed without solution. Markers are time integration. The first row shows
# the resonance on a linear scale, the second the same over five decades; the last what the stator moves for a unit of
# the rotor's motion: near the peak both curves above are one.

height = 1480
load 'figures/style.gp'

up = 1; down = 2; integrated = 3
mm(name) = 1e3 * column(name)
of_set(s) = column("set") == s ? column("f") : NaN
point(s, c) = column("curve") == c ? of_set(s) : NaN
marker(s, p) = column("periodic") == p ? point(s, integrated) : NaN

# All panels share the range of the smallest and the largest amplitude, with room for the labels.
stats table using (min(mm("amp_x_s"), mm("amp_y_s"))):(min(mm("amp_x_r"), mm("amp_y_r"))) \
  name 'low' nooutput
stats table using (max(mm("amp_x_s"), mm("amp_y_s"))):(max(mm("amp_x_r"), mm("amp_y_r"))) \
  name 'high' nooutput
stats table using "set":"f" name 'F' nooutput
least = min(low_min_x, low_min_y)
set xrange [0 : F_max_y]
most = max(high_max_x, high_max_y)

title_of(s) = sprintf("data set %d, δ = %g µm: harmonic balance, m = %g", \
                      s, 1e6 * clearance(s), harmonics(s))

# The curves are named above the panels, by the first panel alone: a row for each body.
first = 0
name(text) = first ? text : ""
# Lines are harmonic balance, marks time integration.
set key at screen 0.53, 0.995 center top vertical maxrows 2 Left reverse width -4 font ',14'

letter(row, s) = sprintf("(%s)", "abcdefgh"[2 * row + s - 2 : 2 * row + s - 2])
set multiplot layout 4, int(F_max_x) margins 0.105, 0.985, 0.048, 0.928 spacing 0.045, 0.025
do for [row = 1 : 3] {
  direction = word("x x y", row)
  if (row == 1) { unset logscale y; set yrange [0 : 1.25 * most] } else { set logscale y; set yrange [least / 2 : 15 * most] }
  r = "amp_".direction."_r"
  b = "amp_".direction."_s"
  set format x ""
  do for [s = 1 : F_max_x] {
    first = s == 1 && row == 1
    # The peak of harmonic balance, if any: integrated amplitudes count as the least.
    stats table using (of_set(s)):(column("curve") == integrated ? least : mm(r)) \
      name 'peak' nooutput
    stats table using (1 - column("periodic")):(point(s, integrated)) name 'time' nooutput
    set title row == 1 ? title_of(s) : "" offset 0, -0.6
    set ylabel s == 1 ? "half peak-to-peak of ".direction." [mm]" : "" offset 0.8, 0
    set format y s == 1 ? "%g" : ""
    if (peak_max_y > 1.01 * least) {
      set label 1 sprintf("rotor: %.1f Hz, %.4g mm", peak_pos_max_y, peak_max_y) \
        at peak_pos_max_y, peak_max_y right offset row == 1 ? -1.5 : 3.5, row == 1 ? 0 : 1 front point pt 6 ps 1.2
    } else {
      unset label 1
    }
    set label 2 time_sum_x == 0 || row == 1 ? "" : \
      sprintf("not T-periodic at\n%d of %d speeds", \
              time_sum_x, time_records) at graph 0.97, 0.13 right
    set label 3 letter(row, s) at graph 0.03, 0.93
    plot \
      table using (point(s, down)):(mm(r)) with lines ls rotor_down \
        title name("rotor, speed down"), \
      table using (point(s, down)):(mm(b)) with lines ls stator_down \
        title name("stator, speed down"), \
      table using (point(s, up)):(mm(r)) with lines ls rotor \
        title name("rotor, speed up"), \
      table using (point(s, up)):(mm(b)) with lines ls stator \
        title name("stator, speed up"), \
      table using (marker(s, 1)):(mm(r)) with points ls rotor_time ps 0.3 \
        title name("rotor, integrated"), \
      table using (marker(s, 1)):(mm(b)) with points ls stator_time ps 0.3 \
        title name("stator, integrated"), \
      table using (marker(s, 0)):(mm(r)) with points ls rotor_time pt 6 ps 0.45 \
        title name("rotor, not T-periodic"), \
      table using (marker(s, 0)):(mm(b)) with points ls stator_time pt 4 ps 0.45 \
        title name("stator, not T-periodic")
  }
}
unset logscale y
unset label
set yrange [0 : 1.1]
set format x "%g"
set xlabel "speed of rotation f [Hz]" offset 0, 0.4
set key at graph 0.97, 0.32 right top maxrows 2 width 0
do for [s = 1 : F_max_x] {
  set ylabel s == 1 ? "x of stator over x of rotor [-]" : "" offset 0.8, 0
  set format y s == 1 ? "%g" : ""
  set label 3 letter(4, s) at graph 0.03, 0.93
  plot \
    table using (point(s, up)):(column("amp_x_s") / column("amp_x_r")) with lines ls relative \
      title s == 1 ? "harmonic balance" : "", \
    for [p = 0 : 1] table using (marker(s, p)):(column("amp_x_s") / column("amp_x_r")) with points pt 6 + p ps 0.45 - 0.15 * p \
      lc rgb '#404040' title s == 1 && p ? "time integration" : ""
}
unset multiplot
