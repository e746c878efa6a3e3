"""One motion of `explore orbit`: orbits of rotor and stator, the relative motion in each bearing, and the same in time
with the forces.

Marks stand at each quarter turn of the first two, the filled one at phase 0; the circles are the clearances. In time
each displacement is drawn about its mean, which stands in the legend.
Usage: /usr/bin/python3 figures/orbit.py TABLE.tsv OUTPUT.svg
"""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import MaxNLocator
from tables import ROTOR, STATOR, heading, run

RELATIVE = "C2"


def draw_orbit(axes, x, y, turns, colour, title):
    """Closed where the motion is nearly closed; many turns by a thin line."""
    gap = np.hypot(x[-1] - x[0], y[-1] - y[0])
    closed = gap < 4 * np.hypot(np.diff(x), np.diff(y)).max()
    axes.plot(np.append(x, x[0]) if closed else x, np.append(y, y[0]) if closed else y, color=colour,
              lw=1.8 if turns[-1] < 3 else 0.8)
    marked = np.unique(np.searchsorted(turns, np.arange(0, min(2, turns[-1]), 0.25) - turns[1] / 2)) if len(turns) > 1 else [0]
    axes.plot(x[marked], y[marked], "o", ms=5, mfc="white", color=colour)
    axes.plot(x[0], y[0], "o", ms=6, color=colour)
    axes.set_title(title)
    axes.set_aspect("equal", adjustable="datalim")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(MaxNLocator(4))
    axes.set_xlabel("x [µm]")


def draw_relative(axes, table, bearing, turns, where):
    """Rotor against stator, with the clearance where it is of that size."""
    u, v = (1e6 * (table[f"{axis}_r{bearing}"] - table[f"{axis}_s{bearing}"]) for axis in "xy")
    clearance = 1e6 * table.value(f"clearance{bearing}")
    has_circle = 0 < clearance < 20 * np.hypot(u, v).max()
    draw_orbit(axes, u, v, turns, RELATIVE, f"rotor {where}" + (f"\nclearance {clearance:.4g} µm dashed" if has_circle else ""))
    if has_circle:
        angle = np.linspace(0, 2 * np.pi, 200)
        axes.plot(clearance * np.cos(angle), clearance * np.sin(angle), "--", color="#404040", lw=1)


def draw(table):
    figure = plt.figure(figsize=(10, 8.5), layout="constrained")
    above, below = figure.subfigures(2, 1, height_ratios=(4, 5))
    turns = table["phase"] / (2 * np.pi) * table.turns_per_base()
    micro = {name: 1e6 * table[name] for name in ("x_s", "y_s", "x_r", "y_r")}
    bodies = table.bodies()
    bearings = [""] + [f"_{k}" for k in range(2, 10) if f"F_x_{k}" in table.columns]
    panels = above.subplots(1, len(bodies) + len(bearings), squeeze=False)[0]
    for axes, body, name, colour in zip(panels, bodies, ("rotor", "stator"), (ROTOR, STATOR)):
        draw_orbit(axes, micro[f"x_{body}"], micro[f"y_{body}"], turns, colour, name)
    for axes, bearing in zip(panels[len(bodies):], bearings):
        where = f"in bearing {bearing[1:] or 1}" if len(bearings) > 1 else "against stator"
        draw_relative(axes, table, bearing, turns, where)
    panels[0].set_ylabel("y [µm]")
    displacement, force = below.subplots(2, 1, sharex=True)
    for axis, line in (("x", "-"), ("y", "--")):
        for body, colour in zip(bodies, (ROTOR, STATOR)):
            values = micro[f"{axis}_{body}"]
            mean = f"{values.mean():.3g}".replace("-", "−")
            displacement.plot(turns, values - values.mean(), line, color=colour, label=f"${axis}_{body}$, mean {mean} µm")
        for bearing, colour in zip(bearings, ("#404040", RELATIVE, "C4", "C5")):
            force.plot(turns, table[f"F_{axis}{bearing}"], line, color=colour,
                       label=f"$F_{axis}$" + (f" of bearing {bearing[1:]}" if bearing else ""))
    for axes in (displacement, force):
        axes.legend(loc="center left", bbox_to_anchor=(1, 0.5), frameon=False)
        axes.yaxis.set_major_locator(MaxNLocator(5))
    displacement.set_ylabel("displacement\nabout the mean [µm]")
    force.set_ylabel("force on the stator [N]")
    end = len(turns) * turns[1] if len(turns) > 1 else 1
    force.set(xlabel="turns [-]; above: a mark at every quarter turn, the filled one at 0", xlim=(0, end))
    below.align_ylabels()
    heading(above, f"Motion at {table.speed_in_words()}{table.regime_in_words()}", table)
    return figure


run(draw)
