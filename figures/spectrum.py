"""The lines of a motion: amplitudes of rotor and stator against the order, the largest with their names.

Each stem is a line of the table of `explore spectrum`; its height is the larger of the amplitudes in x and y. The spectrum
of a chaotic motion is continuous: its lines are samples of it, drawn as dots. A stem and a name have only those that stand
above their neighbours and whose name is a sum of at most three X, BPFO, BPFI, FTF or BSF.
A measured spectrum, a table with the columns f [Hz] and amplitude [m], is drawn over both.
Usage: /usr/bin/python3 figures/spectrum.py TABLE.tsv OUTPUT.svg [MEASURED.tsv]
"""

import re

import matplotlib.pyplot as plt
import numpy as np
from tables import ROTOR, STATOR, heading, run

MOST_NAMES = 24
NEAR = 0.018  # of the width: names that would overlap
NEIGHBOURS, ABOVE, LARGEST_SUM = 8, 2.5, 3  # how many, times their median, multiples in a name
DECADES = 4  # shown of a chaotic motion


def chosen(names, orders, heights, width):
    """The highest named lines whose names have room."""
    places = []
    for place in np.argsort(-heights, kind="stable"):
        if names[place] != "-" and all(abs(orders[place] - orders[other]) > NEAR * width for other in places):
            places.append(place)
    return places[:MOST_NAMES]


def is_simple(name):
    """Whether a name is a sum of whole multiples, few in all: 2X, BPFO-1X."""
    return re.fullmatch(r"[\dA-Z_+-]+", name) is not None and name != "-" and \
        sum(int(count or 1) for count in re.findall(r"(\d*)(?:X|[A-Z]{3,})", name)) <= LARGEST_SUM


def is_above(orders, heights):
    """Which lines stand above the nearest ones."""
    nearest = [np.argsort(abs(orders - order), kind="stable")[1:NEIGHBOURS + 1] for order in orders]
    return heights > ABOVE * np.array([np.median(heights[near]) for near in nearest])


def draw(table, measured=None):
    bodies = table.bodies()
    figure, grid = plt.subplots(len(bodies), 1, figsize=(10, 1 + 3.25 * len(bodies)), sharex=True, sharey=True,
                                layout="constrained", squeeze=False)
    grid = grid[:, 0]
    orders = table["order"]
    width = 1.04 * orders.max()
    is_chaotic = table.value("regime", "") == "chaotic"
    heights = {body: 1e6 * np.maximum(table[f"x_{body}"], table[f"y_{body}"]) for body in bodies}
    top = max(height.max() for height in heights.values())
    bottom = min(0.5 * min(height[height > 1e-6 * top].min(initial=top) for height in heights.values()), 0.1 * top)
    if is_chaotic:
        bottom = max(bottom, 10 ** -DECADES * top)
    if measured is not None:
        top = max(top, 1e6 * measured["amplitude"].max())
    room = 1.35
    for axes, body, name, colour in zip(grid, bodies, ("rotor", "stator"), (ROTOR, STATOR)):
        height = heights[body]
        shown = height > bottom
        if is_chaotic:
            axes.plot(orders[shown], height[shown], "o", ms=2.5, mew=0, color=colour, alpha=0.5, label="other lines and continuous part")
            axes.legend(loc="upper right", frameon=False, markerscale=2)
            shown &= is_above(orders, height) & [is_simple(name) for name in table["name"]]
        axes.vlines(orders[shown], bottom, height[shown], color=colour, lw=1.3)
        axes.plot(orders[shown], height[shown], "o", ms=3.5, color=colour)
        names = table["name"][shown]
        for place in chosen(names, orders[shown], height[shown], width):
            axes.annotate(str(names[place]), (max(orders[shown][place], 0.012 * width), height[shown][place]),
                          xytext=(0, 6), textcoords="offset points", rotation=90, ha="center", va="bottom",
                          fontsize=10)
            length = (10 + 6.6 * len(names[place])) / 205  # of the name, over the panel's height
            room = max(room, np.log(height[shown][place] / bottom) / np.log(top / bottom) / max(0.25, 1 - length))
        axes.set_ylabel(f"amplitude of the {name} [µm]")
        if measured is not None:
            axes.plot(measured["f"] / table.value("frequency"), 1e6 * measured["amplitude"], "-" if len(measured["f"]) > 50 else ".-",
                      color="#808080", lw=0.9, zorder=0, label="measured")
            axes.legend(loc="upper right", frameon=False)
    grid[0].set(yscale="log", ylim=(bottom, bottom * (top / bottom) ** room), xlim=(0, width))
    hertz = table.value("frequency")
    grid[0].secondary_xaxis("top", functions=(lambda order: order * hertz, lambda f: f / hertz)).set_xlabel("frequency [Hz]")
    grid[-1].set_xlabel("frequency over speed [-]")
    rest = table.value("unexplained", 0)
    note = f"; {100 * rest:.2g} % of the rms in no line" if rest >= 1e-3 else ""
    heading(figure, f"Lines of the motion at {table.speed_in_words()}{table.regime_in_words()}, larger of x and y{note}", table)
    return figure


run(draw)
