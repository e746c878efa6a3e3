"""Adaptive harmonics: estimate over true error, highest order chosen, cost against the best fixed number.

(a) the grey band is what is asked of the estimate; (b) filled: data set 1, open: data set 2; (c), (d) a
cross near the upper edge: the tolerance was not reached.
Usage: /usr/bin/python3 figures/adaptive.py data/reference/adaptive.tsv adaptive.svg
"""

from itertools import zip_longest

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import LogLocator
from tables import run

MARKERS = ("o", "s", "^", "D", "v", "P")
LEAST, MOST = 0.3, 10
TWICE = 2


def styles_of(table):
    """Each tolerance with its colour and marker, loose first."""
    tolerances = np.unique(table["tolerance"])[::-1]
    return [(value, f"C{k}", MARKERS[k]) for k, value in enumerate(tolerances)]


def scatter(axes, rows, columns, colour, marker, ms=5):
    """One tolerance: the two columns where both are known, filled for set 1, open for set 2."""
    x, y = columns
    for number, face in ((1, colour), (2, "none")):
        part = rows.rows((rows["set"] == number) & (rows[y] > 0) & (rows[x] > 0))
        axes.plot(part[x], part[y], marker, color=colour, mfc=face, ms=ms, mew=1)


def draw_effectivity(axes, table, styles):
    """The estimate over the true error, against the true error."""
    axes.axhspan(LEAST, MOST, color="#eeeeee", zorder=0)
    axes.axhline(1, color="#404040", lw=0.8, zorder=0)
    for tolerance, colour, marker in styles:
        rows = table.where("tolerance", tolerance)
        scatter(axes, rows, ("error", "effectivity"), colour, marker)
    axes.set(xscale="log", yscale="log", ylim=(LEAST / 2, MOST * 2), xlabel="true error [-]",
             ylabel="estimate / true error [-]", title=f"(a) effectivity; grey: {LEAST:g} to {MOST:g}")


def draw_cost(axes, table, styles):
    """Evaluations of the force over those of the best fixed m."""
    axes.axhline(TWICE, color="#404040", lw=0.8, zorder=0)
    for tolerance, colour, marker in styles:
        scatter(axes, table.where("tolerance", tolerance), ("f", "ratio"), colour, marker)
    axes.set(yscale="log", xlabel="speed [Hz]", ylabel="cost / cost of the best fixed m [-]",
             title=f"(b) cost; line: {TWICE:g} times")
    axes.yaxis.set_major_formatter("{x:g}")


def draw_harmonics(axes, table, styles, number, title):
    """m against the speed; where the tolerance was not reached, a cross."""
    rows = table.where("set", number)
    top = 2 * table["m"].max()
    for tolerance, colour, marker in styles:
        part = rows.where("tolerance", tolerance)
        reached = part["reached"] == 1
        # a line only between neighbouring speeds
        breaks = np.flatnonzero(np.diff(part["f"]) > 1.5) + 1
        for piece in np.split(np.arange(part["f"].size), breaks):
            m = np.where(reached, part["m"], np.nan)
            axes.plot(part["f"][piece], m[piece], "-", marker=marker, color=colour, ms=4, lw=1)
        row = top / 1.25 ** styles.index((tolerance, colour, marker))
        axes.plot(part["f"][~reached], np.full((~reached).sum(), row), "x", color=colour, ms=6)
    axes.set(yscale="log", xlabel="speed [Hz]", ylabel="highest order m [-]", title=title,
             ylim=(table["m"][table["m"] > 0].min() / 1.4, 1.4 * top))
    axes.yaxis.set_major_formatter("{x:g}")


def legend_of(styles, is_missed):
    """Column by column: a tolerance above, and below it what filled, open and crossed marks mean."""
    tolerances = [plt.Line2D([], [], color=colour, marker=marker, ms=5, lw=1,
                             label=f"tolerance $10^{{{np.log10(tolerance):g}}}$")
                  for tolerance, colour, marker in styles]
    meanings = [("o", "black", 5, "data set 1 in (a), (b)"), ("o", "none", 5, "data set 2 in (a), (b)")]
    if is_missed:
        meanings.append(("x", "none", 6, "(c), (d): not reached"))
    marks = [plt.Line2D([], [], color="black", marker=marker, mfc=face, ms=ms, ls="", label=label)
             for marker, face, ms, label in meanings]
    return [handle for pair in zip_longest(tolerances, marks) for handle in pair if handle]


def draw(table):
    """Estimate and cost above, harmonics of both data sets below."""
    figure = plt.figure(figsize=(10, 8.6), layout="constrained")
    key, panels = figure.subfigures(2, 1, height_ratios=(1, 13))
    (estimate, cost), (first, second) = panels.subplots(2, 2)
    styles = styles_of(table)
    draw_effectivity(estimate, table, styles)
    draw_cost(cost, table, styles)
    draw_harmonics(first, table, styles, 1, "(c) highest order chosen, data set 1")
    draw_harmonics(second, table, styles, 2, "(d) highest order chosen, data set 2")
    for axes in (estimate, cost, first, second):
        axes.grid(color="#d9d9d9", lw=0.7)
        axes.set_axisbelow(True)
    estimate.xaxis.set_major_locator(LogLocator(numticks=4))
    key.legend(handles=legend_of(styles, (table["reached"] == 0).any()), ncols=len(styles), loc="center")
    return figure


run(draw)
