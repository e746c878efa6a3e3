"""Where a harmonic-balance solution is true: distance to the nearest attractor's motion against speed.

Full points are stable solutions, open ones unstable or unknown; a speed without a point has no solution.
Grey: no attractor has the period of rotation, so no periodic solution can be the motion; no line crosses it.
Usage: /usr/bin/python3 figures/validity.py data/reference/validity.tsv validity.svg
"""

import tomllib
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from tables import run

LIMITS = tomllib.loads(Path("data/claims.toml").read_text(encoding="utf-8"))["regimes"]["distance_limits"]
FIXED = {6: ("C1", "o"), 8: ("C2", "s"), 10: ("C3", "^")}


def shade(axes, rows):
    """The speeds without T-periodic attractor."""
    one = rows.where("adaptive", 1)
    half = np.diff(one["f"]).min() / 2
    label = "no T-periodic attractor"
    for f in one["f"][one["periodic"] == 0]:
        axes.axvspan(f - half, f + half, color="#dddddd", lw=0, label=label)
        label = None


def draw_solution(axes, rows, colour, marker, label):
    """Full points where the solution is stable; a line through speeds with T-periodic attractor."""
    distance = np.where(rows["found"] == 1, rows["distance"], np.nan)
    axes.plot(rows["f"], np.where(rows["periodic"] == 1, distance, np.nan), "-", color=colour, lw=0.8)
    stable = rows["stable"] == 1
    for chosen, face, name in ((stable, colour, label), (~stable, "white", None)):
        axes.plot(rows["f"][chosen], distance[chosen], marker, ms=4.5, mfc=face, mec=colour, mew=0.9,
                  label=name)


def draw_set(axes, rows, tolerance):
    """Fixed numbers of harmonics, and the one chosen for a tolerance."""
    shade(axes, rows)
    for m, (colour, marker) in FIXED.items():
        draw_solution(axes, rows.where("adaptive", 0).where("m", m), colour, marker, f"m = {m}")
    draw_solution(axes, rows.where("adaptive", 1), "C0", "D",
                  f"m chosen for {100 * tolerance:g} %")
    for limit in LIMITS:
        axes.axhline(limit, color="#404040", lw=0.7, ls=":")
        axes.annotate(f"{100 * limit:g} %", (0.998, limit), xycoords=("axes fraction", "data"),
                      ha="right", va="bottom", fontsize=9)


def point(face, label):
    """The legend's entry of a point that is full or open, whatever its colour and shape."""
    return plt.Line2D([], [], marker="o", ls="", ms=5.5, mfc=face, mec="black", mew=0.9, label=label)


def draw(table):
    """One panel per data set."""
    clearances = [clearance for clearance, in table.members("clearance")]
    tolerance = table.value("tolerance")
    figure, grid = plt.subplots(len(clearances), 1, figsize=(10, 9), sharex=True, sharey=True,
                                layout="constrained")
    for number, (axes, clearance) in enumerate(zip(grid, clearances), 1):
        draw_set(axes, table.where("set", number), tolerance)
        axes.set(yscale="log", xlim=(0, 61), title=f"({'ab'[number - 1]}) data set {number}, δ = {1e6 * clearance:g} µm",
                 ylabel="rms error about the mean [-]")
    grid[-1].set_xlabel("speed of rotation [Hz]")
    shaded, *methods = grid[-1].get_legend_handles_labels()[0]
    points = point("black", "stable"), point("white", "unstable or unknown")
    # column by column: the methods above, what points and shade mean below
    order = methods[0], points[0], methods[1], points[1], methods[2], shaded, methods[3]
    grid[0].legend(handles=order, ncols=4, loc="lower center", bbox_to_anchor=(0.5, 1.1),
                   handletextpad=0.4, columnspacing=1.6)
    return figure


run(draw)
