"""Stability along the response curves of both data sets.

Paper: §3.3, Fig. 3. Rows: numbers of harmonics; columns: data sets. Each panel shows the rotor's x along the curve, coloured by
what the nearest motion of Eq. 7 is; behind it stands where time integration settles. The strip below counts, in each hertz,
the folds of the m harmonics and the bifurcations of the machine: the larger the dot, the more.
Usage: /usr/bin/python3 figures/stability.py data/reference/stability.tsv stability.svg
"""

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from tables import read, run

KINDS = {"fold": "folds of m harmonics", "period-doubling": "period doublings", "neimark-sacker": "Neimark-Sacker",
         "plus-one": "multiplier +1"}
STATES = {"not known": ((-2, -1), {"color": "#555555", "lw": 0.6, "zorder": 2}),
          "stable": ((1,), {"color": "C0", "lw": 3, "zorder": 3, "solid_capstyle": "butt"}),
          "unstable": ((0,), {"color": "C1", "lw": 3, "zorder": 4, "solid_capstyle": "butt"})}
REPEATS = {"color": "#9CCBE8", "marker": "o", "ms": 5, "ls": "", "zorder": 1}
OTHER = {"color": "#BBBBBB", "marker": "o", "ms": 4, "ls": "", "zorder": 0}


def stretches(curve, states):
    """The amplitude where the curve has one of these states, begun at the point before; NaN elsewhere."""
    within = np.isin(curve["stable"], states)
    within[:-1] |= within[1:] & (states != STATES["not known"][0])
    return np.where(within, 1e3 * curve["amp_x_r"], np.nan)


def draw_curves(axes, rows, settled):
    """The curve with its states, over what integration settles on."""
    repeats = settled["period"] == 1
    for chosen, style in ((repeats, REPEATS), (~repeats, OTHER)):
        axes.plot(settled["f"][chosen], 1e3 * settled["amp_x_r"][chosen], **style)
    for number in np.unique(rows["curve"]):
        curve = rows.where("curve", number)
        for states, style in STATES.values():
            axes.plot(curve["f"], stretches(curve, states), **style)
    axes.set(yscale="log", ylim=(1e-4, 30), xlim=(0, 60))


def draw_counts(axes, rows):
    """How many of each kind lie in each hertz."""
    for line, kind in enumerate(KINDS):
        count, ends = np.histogram(rows["f"][rows["bifurcation"] == kind], bins=np.arange(0, 61))
        some = count > 0
        axes.scatter(ends[:-1][some] + 0.5, np.full(some.sum(), line), s=9 * count[some]**0.6, color="black", lw=0)
    axes.set_yticks(range(len(KINDS)), KINDS.values(), fontsize=10)
    axes.set(ylim=(len(KINDS) - 0.4, -0.6), xlim=(0, 60))
    axes.grid(axis="y", color="#dddddd", lw=0.6)


def draw(table):
    """Two panels and their strips for each number of harmonics."""
    settled = read(Path(sys.argv[1]).with_name("attractors.tsv"))
    harmonics, sets = np.unique(table["harmonics"]), np.unique(table["set"])
    figure, grid = plt.subplots(2 * len(harmonics), len(sets), figsize=(10, 11), layout="constrained", sharex=True, sharey="row",
                                height_ratios=[3.4, 1] * len(harmonics))
    clearances = [clearance for clearance, in table.members("clearance")]
    for column, number in enumerate(sets):
        for row, m in enumerate(harmonics):
            rows = table.where("set", number).where("harmonics", m)
            above, below = grid[2 * row:2 * row + 2, column]
            draw_curves(above, rows, settled.where("set", number))
            draw_counts(below, rows)
            letter = "abcdefgh"[len(sets) * row + column]
            above.set_title(f"({letter}) set {number:g}, δ = {1e6 * clearances[column]:g} µm, m = {m:g}", loc="left")
        grid[-1, column].set_xlabel("speed of rotation f [Hz]")
    for axes in grid[::2, 0]:
        axes.set_ylabel("half peak-to-peak of the rotor's x [mm]")
    marks = [plt.Line2D([], [], label=label, **style) for label, (_, style) in STATES.items()]
    marks += [plt.Line2D([], [], label="integrated, T-periodic", **REPEATS), plt.Line2D([], [], label="integrated, other", **OTHER)]
    figure.get_layout_engine().set(rect=(0, 0, 1, 0.94))
    figure.legend(handles=marks, loc="upper center", ncols=3, frameon=False)
    return figure


run(draw)
