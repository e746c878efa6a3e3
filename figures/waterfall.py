"""The lines of `explore response --waterfall`, or `runup`, against speed: one row of lines for each speed, orders as rays.

Usage: /usr/bin/python3 figures/waterfall.py LINES.tsv OUTPUT.svg
"""

import matplotlib.pyplot as plt
import numpy as np
from tables import heading, run

MOST_SPEEDS, DECADES, MOST_RAYS = 60, 4, 12


def chosen_speeds(speeds):
    """Evenly spread ones of all."""
    wanted = np.linspace(speeds.min(), speeds.max(), min(MOST_SPEEDS, np.unique(speeds).size))
    known = np.unique(speeds)
    return np.unique(known[np.abs(known[None, :] - wanted[:, None]).argmin(axis=1)])


def draw(table):
    table.columns["f"] = np.round(table["f"] / table["order"], 9)  # speed of rotation
    figure, axes = plt.subplots(figsize=(10, 8), layout="constrained")
    amplitude = np.maximum(table["x_r"], table["y_r"])
    frequency, top = table["order"] * table["f"], amplitude.max()
    speeds = chosen_speeds(table["f"])
    low, high = table["f"].min(), table["f"].max()
    step = (high - low) / max(1, min(len(speeds), 30)) * 1.6 or 0.05 * high
    decades = np.clip(np.log10(amplitude / top) / DECADES + 1, 0, 1)
    shown = np.isin(table["f"], speeds) & (decades > 0)
    axes.vlines(frequency[shown], table["f"][shown], table["f"][shown] + step * decades[shown], color="C0", lw=1)
    for speed in speeds:
        axes.axhline(speed, color="#d0d0d0", lw=0.4, zorder=0)
    names = [name for name in np.unique(table["name"]) if name != "-"]
    size = {name: decades[table["name"] == name].sum() for name in names}
    right = 1.02 * frequency[shown].max()
    last = -np.inf
    chosen = {"1X"} & {*names} | {*sorted(names, key=size.get)[-MOST_RAYS:]}
    for name in sorted(chosen, key=lambda one: table["order"][table["name"] == one][0]):
        order = table["order"][table["name"] == name][0]
        axes.plot([order * low, order * high], [low, high], color="C1", lw=0.7, alpha=0.6, zorder=0)
        place = order * high
        if place - last > 0.02 * right:
            axes.annotate(name, (place, high + step), rotation=90, ha="center", va="bottom", fontsize=10)
            last = place
    axes.set(xlim=(0, right), ylim=(low - 0.3 * step, high + 0.12 * (high - low) + step),
             xlabel="frequency of the line [Hz]", ylabel="speed of rotation [Hz]")
    heading(figure, f"Lines of the rotor, larger of x and y; height: {DECADES} decades below {1e6 * top:.3g} µm", table)
    return figure


run(draw)
