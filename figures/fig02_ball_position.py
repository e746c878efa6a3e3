"""Figure 2: position of ball j and its penetration

Paper: §2.2, Fig. 2, Eqs 3 to 5. The inner ring displaced by u; the balls in contact are coloured.
Usage: /usr/bin/python3 figures/fig02_ball_position.py data/generated/fig02_ball_position.tsv fig02_ball_position.svg
"""

from math import degrees

from matplotlib.patches import Arc

from bearing_sketch import INNER, MARKED, OUTER, arrow, label, polar, sketch
from tables import run


def name_angle(axes, marked, radius):
    """θ_j from the x axis to the radius through the marked ball."""
    angle = marked.first("theta")
    axes.plot(*zip((0, 0), (marked.first("x"), marked.first("y"))), color="black", linewidth=0.75)
    axes.add_patch(Arc((0, 0), 2 * radius, 2 * radius, theta1=0, theta2=degrees(angle)))
    arrow(axes, polar(radius, angle - 0.05), polar(radius, angle))
    axes.text(*polar(1.2 * radius, angle / 2), "$θ_j$", ha="center", va="center")


def name_displacement(axes, table, inner):
    """u, between the centres of the two rings."""
    u = inner.first("x"), inner.first("y")
    size = 1e6 * (u[0] ** 2 + u[1] ** 2) ** 0.5 / table.value("displacement_factor")
    axes.plot(*zip((0, 0), u), color="C3", linewidth=3, marker="o", markersize=5)
    label(axes, f"displacement $u$\nof the inner ring,\n|$u$| = {size:.3g} µm", u,
          polar(0.45 * inner.first("radius"), 5.2))


def name_turning(axes, radius, begin, text):
    """A speed of rotation [rad/s] as an arc with an arrow, its symbol beside it."""
    axes.add_patch(Arc((0, 0), 2 * radius, 2 * radius, theta1=degrees(begin), theta2=degrees(begin + 0.5), linewidth=2))
    arrow(axes, polar(radius, begin + 0.5), polar(radius, begin + 0.54), linewidth=2)
    axes.text(*polar(1.13 * radius, begin + 0.25), text, ha="center", va="center")


def draw(table):
    """The sketch, with the angle and the penetration of the marked ball."""
    figure, axes = sketch(
        table, f"Clearance δ = {1e6 * table.value('clearance'):g} µm drawn "
               f"{table.value('clearance_factor'):g} times larger, displacement $u$ "
               f"{table.value('displacement_factor'):g} times")
    inner, marked = table.where("part", INNER), table.where("part", MARKED)
    outer = table.where("part", OUTER).first("radius")
    name_angle(axes, marked, 0.45 * inner.first("radius"))
    name_displacement(axes, table, inner)
    name_turning(axes, 1.25 * outer, 1.92, r"$ω_{\mathrm{cage}}$")
    name_turning(axes, 0.6 * inner.first("radius"), 2.5, "$ω$")
    one = table.where("ball", 1)
    label(axes, "ball 1", (one.first("x"), one.first("y")), polar(1.5 * outer, one.first("theta") - 0.05))
    label(axes, f"ball $j$ = {marked.first('ball'):g}\n"
                f"$Δ_j$ − δ = {1e6 * marked.first('penetration'):.2g} µm",
          (marked.first("x"), marked.first("y")), polar(1.55 * outer, marked.first("theta") - 0.15))
    axes.text(-1.8 * outer, -1.2 * outer, "coloured: balls in contact,\n$Δ_j$ − δ > 0")
    return figure


run(draw)
