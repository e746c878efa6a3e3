"""Figure 1: the ball bearing

Paper: §2.1, Fig. 1. The rings, the balls and the clearance, at rest and centred.
Usage: /usr/bin/python3 figures/fig01_bearing.py data/generated/fig01_bearing.tsv fig01_bearing.svg
"""

from bearing_sketch import BALL, BOTH_WAYS, INNER, OUTER, arrow, label, polar, sketch
from tables import run


def name_lengths(axes, inner, ball):
    """R of the inner race, R_b of a ball and δ between race and ball, along radii."""
    arrow(axes, (0, 0), polar(inner, 3.6), **BOTH_WAYS)
    axes.text(*polar(0.55 * inner, 3.85), "$R$", ha="center", va="center")

    radius = ball.first("radius")
    centre = ball["x"][2], ball["y"][2]
    arrow(axes, centre, polar(radius, ball["theta"][2], centre))
    label(axes, "$R_b$", polar(0.5 * radius, ball["theta"][2], centre),
          polar(2 * inner, ball["theta"][2]))

    angle = ball["theta"][-1]
    innermost = ball["x"][0] - radius
    axes.plot(*zip(polar(inner, angle), polar(innermost, angle)), color="black", linewidth=4,
              solid_capstyle="butt")
    label(axes, "clearance $δ$", polar(inner, angle), polar(0.5 * inner, angle))


def draw(table):
    """The sketch, with the names of its parts and lengths."""
    figure, axes = sketch(table, f"Radial clearance δ = {1e6 * table.value('clearance'):g} µm, "
                                 f"drawn {table.value('clearance_factor'):g} times larger;\n"
                                 "radii for illustration: the data set fixes only the cage's speed")
    inner = table.where("part", INNER).first("radius")
    outer = table.where("part", OUTER).first("radius")
    ball = table.where("part", BALL)
    label(axes, "outer ring:\nstator", polar(1.06 * outer, 2.5), polar(1.6 * outer, 2.5))
    label(axes, "inner ring:\nrotor", polar(0.9 * inner, 2.2), polar(0.45 * inner, 2.5))
    label(axes, "ball", (ball["x"][1], ball["y"][1]), polar(1.5 * outer, ball["theta"][1]))
    name_lengths(axes, inner, ball)
    return figure


run(draw)
