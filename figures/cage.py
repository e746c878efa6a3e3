"""What a cage ratio of 1/2 hides: response and contact of other ratios, and where harmonic balance finds a stable motion.

Rows: data sets. Left: difference of the amplitude from that with c = 1/2, the median and the largest of all other ratios. Middle: the
same of the largest ball load. Right: share of the speeds, against c.
Usage: /usr/bin/python3 figures/cage.py data/reference/cage.tsv cage.svg
"""

import matplotlib.pyplot as plt
import numpy as np
from tables import run

HALF = 0.5


def draw_difference(axes, rows, quantity):
    """From c = 1/2, relative, speed by speed: the median and the largest of the other ratios."""
    half = rows.where("c", HALF)
    others = np.array([np.abs(rows.where("c", c)[quantity] / half[quantity] - 1) for c in np.unique(rows["c"]) if c != HALF])
    axes.plot(half["f"], others.max(axis=0), color="C1", label="largest")
    axes.plot(half["f"], np.median(others, axis=0), color="C0", label="median")
    axes.set(yscale="log", xlim=(0, 61), ylim=(1e-6, 10), xlabel="speed of rotation [Hz]")


def draw_shares(axes, rows):
    ratios = np.unique(rows["c"])
    shares = {"solution found": lambda r: r["found"] == 1, "found and stable": lambda r: r["stable"] == 1,
              "contact always": lambda r: r["contact_share"] == 1}
    for (label, holds), marker in zip(shares.items(), "o^s"):
        axes.plot(ratios, [holds(rows.where("c", c)).mean() for c in ratios], marker + "-", ms=5, label=label)
    axes.set(ylim=(0, 1.03), xlabel="cage ratio c [-]", ylabel="share of the speeds [-]")


def draw(table):
    """One row of panels per data set."""
    figure, grid = plt.subplots(2, 3, figsize=(10, 7), layout="constrained")
    for number, panels in enumerate(grid, 1):
        rows = table.where("set", number)
        draw_difference(panels[0], rows, "amplitude")
        draw_difference(panels[1], rows, "ball_load")
        draw_shares(panels[2], rows)
        for letter, axes in zip("abc" if number == 1 else "def", panels):
            axes.set_title(f"({letter})", loc="left")
        panels[0].set(ylabel=f"data set {number}\namplitude, relative difference [-]")
        panels[1].set(ylabel="ball load, relative difference [-]")
    grid[0][0].legend(fontsize=10, loc="upper right")
    grid[0][2].legend(fontsize=10, loc="lower left")
    return figure


run(draw)
