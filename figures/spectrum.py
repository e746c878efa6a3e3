"""The lines of a motion: amplitudes of rotor and stator against the order, the largest with their names.

Each stem is a line of the table of `explore spectrum`; its height is the larger of the amplitudes in x and y. The spectrum
of a chaotic motion is continuous: its stems are samples of it, thin and without marks.
A measured spectrum, a table with the columns f [Hz] and amplitude [m], is drawn over both.
Usage: /usr/bin/python3 figures/spectrum.py TABLE.tsv OUTPUT.svg [MEASURED.tsv]
"""

import matplotlib.pyplot as plt
import numpy as np
from tables import ROTOR, STATOR, heading, run

MOST_NAMES = 24
NEAR = 0.018  # of the width: names that would overlap


def chosen(names, orders, heights, width):
    """The highest named lines whose names have room."""
    places = []
    for place in np.argsort(-heights, kind="stable"):
        if names[place] != "-" and all(abs(orders[place] - orders[other]) > NEAR * width for other in places):
            places.append(place)
    return places[:MOST_NAMES]


def draw(table, measured=None):
    bodies = table.bodies()
    figure, grid = plt.subplots(len(bodies), 1, figsize=(10, 1 + 3.25 * len(bodies)), sharex=True, sharey=True,
                                layout="constrained", squeeze=False)
    grid = grid[:, 0]
    orders = table["order"]
    width = 1.04 * orders.max()
    is_chaotic = table.value("regime", "") == "chaotic"
    heights = {body: np.maximum(table[f"x_{body}"], table[f"y_{body}"]) for body in bodies}
    top = max(height.max() for height in heights.values())
    bottom = min(0.5 * min(height[height > 1e-6 * top].min(initial=top) for height in heights.values()), 0.1 * top)
    if measured is not None:
        top = max(top, measured["amplitude"].max())
    for axes, body, name, colour in zip(grid, bodies, ("rotor", "stator"), (ROTOR, STATOR)):
        height = heights[body]
        shown = height > bottom
        axes.vlines(orders[shown], bottom, height[shown], color=colour, lw=0.8 if is_chaotic else 1.3)
        if not is_chaotic:
            axes.plot(orders[shown], height[shown], "o", ms=3.5, color=colour)
        names = table["name"][shown]
        for place in chosen(names, orders[shown], height[shown], width):
            axes.annotate(str(names[place]), (orders[shown][place], height[shown][place]),
                          xytext=(0, 6), textcoords="offset points", rotation=90, ha="center", va="bottom",
                          fontsize=10)
        axes.set_ylabel(f"amplitude of the {name} [m]")
        if measured is not None:
            axes.plot(measured["f"] / table.value("frequency"), measured["amplitude"], color="#808080", lw=0.9,
                      zorder=0, label="measured")
            axes.legend(loc="upper right", frameon=False)
    grid[0].set(yscale="log", ylim=(bottom, top * (top / bottom) ** 0.35), xlim=(0, width))
    hertz = table.value("frequency")
    grid[0].secondary_xaxis("top", functions=(lambda order: order * hertz, lambda f: f / hertz)).set_xlabel("frequency [Hz]")
    grid[-1].set_xlabel("frequency over speed [-]")
    heading(figure, f"Lines of the motion at {table.speed_in_words()}{table.regime_in_words()}, larger of x and y", table)
    return figure


run(draw)
