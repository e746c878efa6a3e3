"""Clearance against speed, from rest: after how many turns the motion repeats itself, how fast neighbours part where it never
does, and for how much of the time no ball is loaded. The dashed line at the clearance of data set 1 crosses what Figure 3 shows.
Usage: /usr/bin/python3 figures/clearance_speed.py data/reference/clearance_speed.tsv clearance_speed.svg
"""

import tomllib
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from map import draw_classes, draw_grid
from tables import cells_as_numbers, over_keys, run

X, Y = KEYS = ["frequency", "bearing.radial_clearance_m"]
NAMES = ["undecided", "quasi-periodic", "aperiodic", "K = 1", "K = 2", "K = 3", "K = 4", "K above 4"]
COLOURS = ["white", "#CC79A7", "#303030", "#CFE3F1", "#56B4E9", "#E69F00", "#009E73", "#D55E00"]
TITLES = ["(a) turns K after which the motion repeats itself", "(b) largest Lyapunov exponent of aperiodic motion [1/turn]; grey: other motion",
          "(c) share of the time without contact [%]; grey: contact is never lost"]


def classes(periods):
    """Place in NAMES; a point without result is undecided."""
    return np.where(np.isnan(periods), 0, np.clip(periods, -2, 5) + 2)


def draw(table):
    """Three maps, one above the other."""
    figure, panels = plt.subplots(3, 1, figsize=(10, 9), sharex=True, layout="constrained")
    period, chaos, contact = panels
    periods, rates, loaded = (cells_as_numbers(table[name]) for name in ("period", "lyapunov", "contact_share"))
    x, y = np.unique(table[X]), 1e6 * np.unique(table[Y])
    draw_classes(period, x, y, over_keys(table, classes(periods), KEYS), NAMES, COLOURS)
    draw_grid(chaos, x, y, over_keys(table, np.where(periods == 0, rates, np.nan), KEYS), vmin=0)
    draw_grid(contact, x, y, over_keys(table, np.where(loaded < 1, 100 * (1 - loaded), np.nan), KEYS), vmin=0)
    clearance = tomllib.loads(Path("data/set1.toml").read_text(encoding="utf-8"))["bearing"]["radial_clearance_m"]
    for axes, title in zip(panels, TITLES):
        axes.set(title=title, ylabel="radial clearance δ [µm]", facecolor="#bbbbbb")
        axes.axhline(1e6 * clearance, color="black", ls=(0, (6, 4)), lw=1)
    contact.set_xlabel("speed of rotation [Hz]")
    return figure


run(draw)
