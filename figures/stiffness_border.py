"""Clearance against contact stiffness: peak, its speed, permanent contact, and the error of six harmonics against what the
machine does. White line in (d): an error of 1 %; orange, where it differs: the same of the way back, from large clearances to small
ones. The circle is data set 1; grey: no result.
Usage: /usr/bin/python3 figures/stiffness_border.py data/reference/stiffness_border.tsv stiffness_border.svg
"""

import tomllib
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from map import draw_grid
from matplotlib.colors import LogNorm
from tables import cells_as_numbers, over_keys, run

X, Y = KEYS = ["bearing.radial_clearance_m", "bearing.contact_stiffness_N_per_m1p5"]
BORDER, LEAST = 1, 1e-3  # %; smaller errors are drawn as this


def draw_map(axes, table, values, title, **colours):
    """Values in colour over both keys, grey where there are none; their array."""
    x, y = 1e6 * np.unique(table[X]), np.unique(table[Y])
    cells = over_keys(table, values, KEYS)
    draw_grid(axes, x, y, cells, **colours)
    bearing = tomllib.loads(Path("data/set1.toml").read_text(encoding="utf-8"))["bearing"]
    axes.plot(1e6 * bearing["radial_clearance_m"], bearing["contact_stiffness_N_per_m1p5"], "o", ms=9, mfc="white", mec="black")
    axes.set(yscale="log", title=title, facecolor="#bbbbbb", xlim=x[[0, -1]], ylim=y[[0, -1]])
    return x, y, cells


def draw(table):
    """Four maps over the same axes."""
    figure, grid = plt.subplots(2, 2, figsize=(10, 8), sharex=True, sharey=True, layout="constrained")
    (peak, speed), (permanent, error) = grid
    columns = {name: cells_as_numbers(table[name]) for name in ("peak", "peak_frequency", "permanent", "error")}
    draw_map(peak, table, 1e3 * columns["peak"], "(a) largest amplitude of $x_r$ [mm]")
    draw_map(speed, table, columns["peak_frequency"], "(b) its speed [Hz]")
    draw_map(permanent, table, 100 * columns["permanent"], "(c) solved speeds with permanent contact [%]")
    drawn = draw_map(error, table, np.maximum(100 * columns["error"], LEAST), "(d) error of six harmonics at 30 Hz [%]",
                     norm=LogNorm())
    back = over_keys(table, 100 * cells_as_numbers(table["error_back"]), KEYS)
    error.contour(*drawn[:2], back, [BORDER], colors="C1", linewidths=1.5)
    error.contour(*drawn, [BORDER], colors="white", linewidths=1)
    figure.supxlabel("radial clearance δ [µm]")
    figure.supylabel("contact stiffness $K_H$ [N/m$^{1.5}$]")
    return figure


run(draw)
