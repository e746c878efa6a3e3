"""Poincaré sections of the attractors against speed, and the largest Lyapunov exponent below.

One point per period: the relative displacement at phase 0 over the clearance. A single point at a speed
is a T-periodic motion. Up and down in speed differ where attractors coexist.
Usage: /usr/bin/python3 figures/sections.py data/generated/sections.tsv sections.svg
"""

import re

import matplotlib.pyplot as plt
import numpy as np
from tables import run

UP, DOWN = 1, 2
CLOSED = (1, 2)  # T-periodic, kT-periodic
STYLE = {UP: ("C0", "up in speed"), DOWN: ("C1", "down in speed")}


def draw_sections(axes, rows, clearance):
    """All points of both directions; down shifted a little to the right, so that neither hides the other."""
    for origin, (colour, label) in STYLE.items():
        part = rows.where("origin", origin)
        shift = 0.06 if origin == DOWN else -0.06
        axes.plot(part["f"] + shift, part["u_x"] / clearance, ".", ms=2.4, mew=0, color=colour,
                  label=label)


def draw_exponents(axes, rows):
    """One point per speed and direction, with three standard errors where the section does not close."""
    for origin, (colour, _) in STYLE.items():
        part = rows.where("origin", origin)
        _, first = np.unique(part["f"], return_index=True)
        part = part.rows(first)
        error = np.where(np.isin(part["verdict"], CLOSED), 0, 3 * part["exponent_error"])
        axes.errorbar(part["f"], part["exponent"], yerr=error, fmt=".", ms=4, mew=0,
                      elinewidth=0.7, color=colour, alpha=0.8)
    axes.axhline(0, color="#404040", lw=0.75)
    axes.set_xlim(0, rows["f"].max() + 1)


def draw(table):
    """One column per data set: section above, exponent below."""
    clearances = [float(x) for x in re.findall(r"delta = (\S+) m", table.header)]
    figure, grid = plt.subplots(2, len(clearances), figsize=(10, 7.5), sharex=True, sharey="row",
                                layout="constrained", height_ratios=(3, 2), squeeze=False)
    for number, clearance in enumerate(clearances, 1):
        rows = table.where("set", number)
        above, below = grid[:, number - 1]
        draw_sections(above, rows, clearance)
        draw_exponents(below, rows)
        above.set_title(f"data set {number}, δ = {1e6 * clearance:g} µm")
        below.set_xlabel("speed of rotation [Hz]")
    grid[0, 0].set_ylabel("section: $(x_r - x_s)/δ$ at phase 0 [-]")
    grid[1, 0].set_ylabel("largest Lyapunov exponent [1/s]")
    grid[0, 0].legend(loc="upper left", markerscale=5, handletextpad=0.2)
    return figure


run(draw)
