"""Clearance against contact stiffness: peak, loss of contact, largest force, speeds without solution.

What (a) to (c) show is taken over the speeds with a solution; (a) is the top of a parabola through the
largest amplitude and its neighbours on the grid of speeds; grey in (b): contact is never lost. The
circles are the two data sets of the paper. Dots: more than a quarter of the speeds has no solution, so that what is
shown there is that of the others.
Usage: /usr/bin/python3 figures/clearance_stiffness.py data/reference/clearance_stiffness.tsv
       clearance_stiffness.svg
"""

import re
import tomllib
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from map import draw_grid
from matplotlib.colors import LogNorm
from matplotlib.ticker import LogLocator
from tables import over_keys, run

NEVER = -1
SETS = ("data/set1.toml", "data/set2.toml")


def speeds_of(table):
    """Number of speeds of a sweep and the distance between them [Hz]."""
    count, first, last = (table.value(f"sweep_{key}") for key in ("count", "from", "to"))
    return int(count), (last - first) / (count - 1)


def draw_map(axes, table, values, title, **colours):
    """Values in colour, grey where masked; returns the colour bar."""
    x, y = 1e6 * np.unique(table["delta"]), np.unique(table["K_H"])
    bar = draw_grid(axes, x, y, over_keys(table, np.ma.filled(values.astype(float), np.nan), ["delta", "K_H"]), **colours)
    axes.set(yscale="log", title=title, facecolor="#bbbbbb",
             xlim=x[[0, -1]], ylim=y[[0, -1]])
    return bar


def mark_sets(axes):
    """A numbered circle at each data set of the paper."""
    for path in SETS:
        bearing = tomllib.loads(Path(path).read_text(encoding="utf-8"))["bearing"]
        where = 1e6 * bearing["radial_clearance_m"], bearing["contact_stiffness_N_per_m1p5"]
        axes.plot(*where, "o", ms=17, mfc="white", mec="black", mew=1)
        axes.annotate(re.search(r"\d", path)[0], where, ha="center", va="center_baseline")


def draw(table):
    """Four maps over the same axes."""
    figure, grid = plt.subplots(2, 2, figsize=(10, 8), sharex=True, sharey=True,
                                layout="constrained")
    (peak, loss), (force, missed) = grid
    count, step = speeds_of(table)
    draw_map(peak, table, np.ma.masked_equal(table["f_peak"], NEVER),
             f"(a) speed of the peak [Hz], from a grid of {step:g} Hz")
    width = table["f_loss_last"] - table["f_loss_first"]
    width = np.ma.masked_where(table["f_loss_first"] == NEVER, width)
    draw_map(loss, table, width, "(b) last − first loss of contact [Hz]", vmin=0)
    bar = draw_map(force, table, table["largest_force"] / 1e3, "(c) largest force on a ball [kN]",
                   norm=LogNorm())
    bar.ax.yaxis.set_major_locator(LogLocator(subs=(1, 2, 3, 5)))
    bar.ax.yaxis.set_major_formatter("{x:g}")
    bar.ax.yaxis.set_minor_formatter("")
    draw_map(missed, table, table["missed"], f"(d) speeds without a solution, of {count:g}", vmin=0)
    few = table.rows(table["missed"] > count / 4)
    for axes in grid.flat:
        mark_sets(axes)
        if axes is not missed:
            axes.plot(1e6 * few["delta"], few["K_H"], ".", ms=2, color="white", mec="black", mew=0.3, zorder=1)
    figure.supxlabel("radial clearance δ [µm]")
    figure.supylabel("contact stiffness $K_H$ [N/m$^{1.5}$]")
    return figure


run(draw)
