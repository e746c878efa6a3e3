# Axes of an x-y panel at equal scale, around the orbits of rotor and stator
#
# Loaded by displacements.gp and orbits.gp, which define shown(value): value in the rows drawn, NaN
# in the others. Defines `panel`, `speed` [Hz], `largest` [m], scaled(name), a column in the unit
# that suits the largest displacement, and `orbit_axes`, the commands that set the axes.

stats table using (shown(column("panel"))):"f" name 'F' nooutput
panel = F_max_x
speed = F_max_y

stats table using (shown(max(column("x_r"), column("x_s")))):(max(column("y_r"), column("y_s"))) \
  name 'high' nooutput
stats table using (shown(min(column("x_r"), column("x_s")))):(min(column("y_r"), column("y_s"))) \
  name 'low' nooutput
largest = max(max(high_max_x, high_max_y), -min(low_min_x, low_min_y))
scaled(name) = per_metre(largest) * column(name)

# A square a little larger than the longer side of the orbits' box.
half = 0.55 * per_metre(largest) * max(high_max_x - low_min_x, high_max_y - low_min_y)
centre_x = 0.5 * per_metre(largest) * (high_max_x + low_min_x)
centre_y = 0.5 * per_metre(largest) * (high_max_y + low_min_y)

orbit_axes = "\
  set size square; \
  set xrange [centre_x - half : centre_x + half]; \
  set yrange [centre_y - half : centre_y + half]; \
  set xtics tic_step(2 * half); \
  set ytics tic_step(2 * half); \
  set xlabel 'x ['.unit(largest).']' offset 0, 0.6; \
  set ylabel 'y ['.unit(largest).']' offset 1.2, 0"
