# Sensitivity to what the paper leaves out: five outputs against five parameters
#
# Usage: gnuplot -e "table='data/reference/sensitivity.tsv'; output='sensitivity.svg'" \
#        figures/sensitivity.gp
# The panels of a row share their range, so that what matters is seen at a glance. A bar
# is half a step of the search for loss of contact, or the standard error of the mean over the periods.

height = 1200
load 'figures/style.gp'

parameters = "mass mass_ratio cage_ratio samples step"
of(value) = strcol("parameter") eq word(parameters, p) && value >= 0 ? value : NaN
at(value) = value * (p == 5 ? 1e6 : 1)
usual(value) = column("default") == 1 ? of(value) : NaN
by(method, value) = strcol("peak_by") eq method ? of(value) : NaN
mm(name) = 1e3 * column(name)
um(name) = 1e6 * column(name)
peak(row) = row == 1 ? column("f_peak") : mm("amp_peak")

# All but the cage ratio are varied by factors. The space after an index is lost in some viewers, unless two
# in a row make gnuplot declare that spaces count.
array label[5] = ["m_s + m_r [kg]", "m_r / m_s", "ω_{cage} / ω", "samples N", "step h [µs]"]
spaced(text) = "  ".text."  "
array span[5] = ["[26 : 139]", "[0.86 : 4.65]", "[0.395 : 0.51]", "[10 : 660]", "[3.8 : 265]"]
array tics[5] = ["30, 60, 120", "1, 2, 4", "0.4, 0.45, 0.5", "13, 50, 512", "5, 20, 200"]

array output_label[5] = ["peak [Hz]", "x_r, peak [mm]", "contact lost [Hz]", \
                         "x_r, 13.4 Hz [µm]", "y_r, 13.4 Hz [µm]"]
array output_span[5] = ["[39.5 : 60.5]", "[5 : 32]", "[7 : 20.5]", "[28 : 190]", "[28 : 190]"]
array output_tics[5] = ["40, 5", "(6, 10, 15, 25)", "8, 4", \
                        "(30, 50, 100, 150)", "(30, 50, 100, 150)"]

by_balance = 1; by_rk4 = 2; ring = 3
set style line by_balance lc rgb '#0072B2' lw 2.4 dt 1 pt 7
set style line by_rk4     lc rgb '#D55E00' lw 1.4 dt 1 pt 5
set style line ring       lc rgb '#000000' lw 1.6 pt 6
band = '#F9D28A'
set style fill solid noborder
set bars small

from_top(units) = 1 - units / (1.0 * height)
set label 1 "amplitudes: half peak-to-peak; shaded: from the first to the last speed " \
  ."with loss of contact" at screen 0.53, from_top(18) center
set key at screen 0.53, from_top(32) center top vertical maxrows 1 Left reverse width 1
set multiplot layout 5, 5 \
  margins 0.085, 0.985, 80.0 / height, from_top(82) spacing 0.018, 22.0 / height
do for [row = 1 : 5] {
  eval "set yrange ".output_span[row]
  eval "set ytics ".output_tics[row]
  if (row == 1 || row == 3) { unset logscale y } else { set logscale y }
  do for [p = 1 : 5] {
    if (p == 3) { unset logscale x } else { set logscale x }
    eval "set xrange ".span[p]
    eval "set xtics (".tics[p].")"
    set format x row == 5 ? "%g" : ""
    set format y p == 1 ? "%g" : ""
    set xlabel row == 5 ? spaced(label[p]) : "" offset 0, 0.3
    set ylabel p == 1 ? output_label[row] : "" offset 1, 0
    direction = row == 4 ? "x" : "y"
    time = "amp_".direction."_13p4"
    if (row <= 2) {
      plot \
        table using (at(column("value"))):(by("aft", peak(row))) notitle \
          with linespoints ls by_balance ps 0.5, \
        table using (at(column("value"))):(by("rk4", peak(row))) notitle \
          with linespoints ls by_rk4 ps 0.5, \
        table using (at(column("value"))):(usual(peak(row))) notitle \
          with points ls ring ps 1.1, \
        keyentry with linespoints ls by_balance ps 0.5 title \
          sprintf("harmonic balance, m = %d", harmonics(1)), \
        keyentry with linespoints ls by_rk4 ps 0.5 title "time integration", \
        keyentry with points ls ring ps 1.1 title "default"
    }
    if (row == 3) {
      plot \
        table using (at(column("value"))):(of(column("f_loss_first"))):"f_loss_last" \
          notitle with filledcurves fc rgb band, \
        for [end in "first last"] table using (at(column("value"))): \
          (of(column("f_loss_".end))):"error_f_loss_".end notitle \
          with yerrorlines ls by_rk4 ps 0.5, \
        for [end in "first last"] table using (at(column("value"))): \
          (usual(column("f_loss_".end))) notitle with points ls ring ps 1.1
    }
    if (row >= 4) {
      plot \
        table using (at(column("value"))):(of(um(time."_aft"))) notitle \
          with linespoints ls by_balance ps 0.5, \
        table using (at(column("value"))):(of(um(time))):(um("error_".direction."_13p4")) \
          notitle with yerrorlines ls by_rk4 ps 0.5, \
        table using (at(column("value"))):(usual(um(time))) notitle \
          with points ls ring ps 1.1
    }
    unset key
    unset label 1
  }
}
unset multiplot
