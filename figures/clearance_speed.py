"""Clearance against speed, from rest: after how many turns the motion repeats itself, how fast neighbours part where it never
does, and for how much of the time no ball is loaded. The dashed line at the clearance of data set 1 crosses what Figure 3 shows.
Usage: /usr/bin/python3 figures/clearance_speed.py data/reference/clearance_speed.tsv clearance_speed.svg
"""

import tomllib
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from map import edges_of, over_keys
from matplotlib.colors import BoundaryNorm, ListedColormap
from tables import cells_as_numbers, run

X, Y = KEYS = ["frequency", "bearing.radial_clearance_m"]
NAMES = ["undecided", "quasi-periodic", "aperiodic", "K = 1", "K = 2", "K = 3", "K = 4", "K above 4"]
COLOURS = ["white", "#CC79A7", "#303030", "#CFE3F1", "#56B4E9", "#E69F00", "#009E73", "#D55E00"]


def classes(periods):
    """Place in NAMES; a point without result is undecided."""
    return np.where(np.isnan(periods), 0, np.clip(periods, -2, 5) + 2)


def draw_map(axes, table, values, title, **colours):
    """Values in colour over both keys, grey where there are none."""
    x, y = np.unique(table[X]), 1e6 * np.unique(table[Y])
    image = axes.pcolormesh(edges_of(x), edges_of(y), np.ma.masked_invalid(over_keys(table, values, KEYS)), rasterized=True,
                            **colours)
    axes.set(title=title, ylabel="radial clearance δ [µm]", facecolor="#bbbbbb")
    clearance = tomllib.loads(Path("data/set1.toml").read_text(encoding="utf-8"))["bearing"]["radial_clearance_m"]
    axes.axhline(1e6 * clearance, color="black", ls=(0, (6, 4)), lw=1)
    return axes.figure.colorbar(image, ax=axes, pad=0.02)


def draw(table):
    """Three maps, one above the other."""
    figure, (period, chaos, contact) = plt.subplots(3, 1, figsize=(10, 9), sharex=True, layout="constrained")
    periods, rates, loaded = (cells_as_numbers(table[name]) for name in ("period", "lyapunov", "loaded"))
    draw_map(period, table, classes(periods), "(a) turns K after which the motion repeats itself", cmap=ListedColormap(COLOURS),
             norm=BoundaryNorm(np.arange(len(NAMES) + 1) - 0.5, len(NAMES))).set_ticks(range(len(NAMES)), labels=NAMES)
    draw_map(chaos, table, np.where(periods == 0, rates, np.nan), "(b) largest Lyapunov exponent of aperiodic motion [1/turn]; grey: other motion",
             vmin=0)
    draw_map(contact, table, np.where(loaded < 1, 100 * (1 - loaded), np.nan), "(c) share of the time without contact [%]; grey: contact is never lost", vmin=0)
    contact.set_xlabel("speed of rotation [Hz]")
    return figure


run(draw)
