"""Run-up and coast-down through a resonance that the bearing makes stiffer, beside the steady motions.

Usage: /usr/bin/python3 figures/runup.py data/generated/runup.tsv runup.svg
"""

import matplotlib.pyplot as plt
import numpy as np
from tables import run

COLOURS = {1: "C0", -1: "C1"}
WORDS = {1: "upwards", -1: "downwards"}


def draw_panel(axes, table, seconds):
    """One duration in both directions, over the steady motions."""
    for direction, colour in COLOURS.items():
        rows = table.where("direction", direction)
        steady = rows.where("seconds", 0)
        axes.plot(steady["f"], 1e3 * steady["amp_x_r"], "o", ms=4, mfc="none", color=colour,
                  label=f"steady, {WORDS[direction]}")
        passed = rows.where("seconds", seconds)
        axes.plot(passed["f"], 1e3 * passed["amp_x_r"], color=colour, lw=1.3, label=f"{seconds:g} s, {WORDS[direction]}")
    axes.axhline(1e3 * float(table.members("clearance")[0][0]), color="#808080", ls=":", lw=1, label="clearance")
    axes.set(xlabel="speed of rotation [Hz]", xlim=(table["f"].min(), table["f"].max()), ylim=(0, None))
    axes.legend(fontsize=9, loc="upper left")


def draw(table):
    seconds = [float(s) for s in np.unique(table["seconds"]) if s > 0]
    figure, panels = plt.subplots(1, len(seconds), figsize=(10, 4.4), sharey=True, layout="constrained", squeeze=False)
    for letter, axes, one in zip("abc", panels[0], seconds):
        draw_panel(axes, table, one)
        axes.set_title(f"({letter}) speed changed within {one:g} s", loc="left")
    panels[0][0].set_ylabel("amplitude of the rotor's x [mm]")
    return figure


run(draw)
