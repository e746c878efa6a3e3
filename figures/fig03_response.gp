# Figure 3: frequency response of rotor and stator, both data sets
#
# Paper: §3.3, Fig. 3 (data set 1; set 2 is added here), claims C1 to C3.
# Usage: gnuplot -e "table='data/generated/fig03_response.tsv'; output='fig03_response.svg'" \
#        figures/fig03_response.gp
# Harmonic balance with the speed rising lies over the same with the speed falling, so that the pale
# curve shows where they differ; a gap is a speed without solution. Markers are time integration.

height = 900
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
set yrange [least / 2 : 5 * max(high_max_x, high_max_y)]
set logscale y
set format y '10^{%T}'

title_of(s) = sprintf("data set %d, δ = %g µm: harmonic balance, m = %g", \
                      s, 1e6 * clearance(s), harmonics(s))

# The curves are named above the panels, by the first panel alone: a row for each body.
first = 0
name(text) = first ? text : ""
set key at screen 0.53, 0.995 center top vertical maxrows 2 Left reverse width 1

set multiplot layout 2, int(F_max_x) margins 0.105, 0.985, 0.075, 0.885 spacing 0.045, 0.03
do for [row = 1 : 2] {
  direction = word("x y", row)
  r = "amp_".direction."_r"
  b = "amp_".direction."_s"
  set xlabel row == 2 ? "speed of rotation f [Hz]" : ""
  set format x row == 2 ? "%g" : ""
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
        at peak_pos_max_y, peak_max_y right offset 3.5, 1 front point pt 6 ps 1.2
    } else {
      unset label 1
    }
    set label 2 time_sum_x == 0 ? "" : \
      sprintf("time integration: not T-periodic\nat %d of %d speeds (open markers)", \
              time_sum_x, time_records) at graph 0.97, 0.13 right
    plot \
      table using (point(s, down)):(mm(r)) with lines ls rotor_down \
        title name("rotor, speed down"), \
      table using (point(s, down)):(mm(b)) with lines ls stator_down \
        title name("stator, speed down"), \
      table using (point(s, up)):(mm(r)) with lines ls rotor \
        title name("rotor, speed up"), \
      table using (point(s, up)):(mm(b)) with lines ls stator \
        title name("stator, speed up"), \
      table using (marker(s, 1)):(mm(r)) with points ls rotor_time ps 0.25 \
        title name("rotor, time integration"), \
      table using (marker(s, 1)):(mm(b)) with points ls stator_time ps 0.25 \
        title name("stator, time integration"), \
      table using (marker(s, 0)):(mm(r)) with points ls rotor_time pt 6 ps 0.35 notitle, \
      table using (marker(s, 0)):(mm(b)) with points ls stator_time pt 4 ps 0.35 notitle
  }
}
unset multiplot
