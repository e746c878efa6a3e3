"""The body of Figures 1 and 2: the cross-section of the bearing.

Every length comes from the table, where the clearance and the displacement are enlarged; only the
thickness of the rings is chosen here, since the model has none.
"""

from math import cos, sin

import matplotlib.pyplot as plt
from matplotlib.patches import Annulus, Circle

from tables import ROTOR, STATOR

OUTER, INNER, BALL, MARKED = range(4)
LOADED = "C2"
ARROW = {"arrowstyle": "-|>", "color": "black", "shrinkA": 0, "shrinkB": 0}
BOTH_WAYS = {**ARROW, "arrowstyle": "<|-|>"}
LEADER = {"arrowstyle": "-", "color": "0.4", "shrinkA": 2, "shrinkB": 0}


def polar(radius, angle, centre=(0, 0)):
    """A point at a distance and an angle [rad] from a centre."""
    return centre[0] + radius * cos(angle), centre[1] + radius * sin(angle)


def arrow(axes, start, end, **style):
    """An arrow between two points."""
    axes.annotate("", end, start, arrowprops={**ARROW, **style})


def label(axes, text, point, place, **style):
    """Text at a place, with a line to the point that it names."""
    axes.annotate(text, point, place, arrowprops=LEADER, ha="center", va="center", **style)


def draw_rings(axes, table):
    """Stator outside its race, rotor inside its own."""
    thickness = 1.2 * table.value("drawn_ball_radius")
    for part, colour, outside in ((OUTER, STATOR, thickness), (INNER, ROTOR, 0)):
        race = table.where("part", part)
        axes.add_patch(Annulus((race.first("x"), race.first("y")), race.first("radius") + outside,
                               thickness, facecolor=colour, edgecolor="black", alpha=0.55))


def draw_balls(axes, table):
    """Grey, or green where the rings squeeze them. The marked ball has a thick edge."""
    for part, x, y, radius, squeezed in zip(*(table[name] for name in
                                              ("part", "x", "y", "radius", "penetration"))):
        if part in (BALL, MARKED):
            axes.add_patch(Circle((x, y), radius, facecolor=LOADED if squeezed > 0 else "0.85",
                                  edgecolor="black", linewidth=2.5 if part == MARKED else 0.75))


def draw_axes(axes, outer):
    """The directions x and y of the displacements, and gravity."""
    for name, x, y in (("x", outer, 0), ("y", 0, outer)):
        arrow(axes, (-0.1 * x, -0.1 * y), (1.35 * x, 1.35 * y), linewidth=0.75)
        axes.text(1.42 * x, 1.42 * y, f"${name}$", ha="center", va="center")
    arrow(axes, (1.35 * outer, -0.7 * outer), (1.35 * outer, -1.1 * outer), linewidth=2)
    axes.text(1.4 * outer, -0.9 * outer, "gravity", va="center")


def sketch(table, sentence):
    """A figure with the bearing, its axes and a sentence above; returns the figure and its axes."""
    figure, axes = plt.subplots(figsize=(10, 7.8), layout="constrained")
    figure.get_layout_engine().set(h_pad=0.15)
    draw_rings(axes, table)
    draw_balls(axes, table)
    outer = table.where("part", OUTER).first("radius")
    draw_axes(axes, outer)
    axes.set(title=sentence, aspect="equal", xlim=(-1.9 * outer, 1.9 * outer),
             ylim=(-1.3 * outer, 1.5 * outer))
    axes.set_axis_off()
    return figure, axes
