"""Work against precision: error of displacement and of force against CPU time, and where the time goes.

Each line joins the settings of a method that no other of its settings beats. The outside references of
data/reference/peers.tsv are drawn as small crosses where they are there.
Usage: /usr/bin/python3 figures/work_precision.py data/reference/work_precision.tsv work_precision.svg
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import LogLocator
from tables import Table, run

SHOWN = ((6, "set1"), (45, "set1"), (45, "set2"))
START = "below"
SPLIT_AT = 1e-3
LEGEND = 0.12  # of the height
PEERS = Path("data/reference/peers.tsv")
STYLES = {"aft": ("harmonic balance", "C0", "-", "o"),
          "shooting-rk4": ("shooting, RK4", "C1", "-", "s"),
          "shooting-rk8": ("shooting, RK8", "C1", "--", "s"),
          "rk4": ("RK4", "C2", "-", "^"),
          "rkf45": ("RKF45", "C3", "-", "v"),
          "rk8": ("RK8", "C3", "--", "v"),
          "msadams": ("Adams", "C4", "-", "D"),
          "msbdf": ("BDF", "C5", "-", "x"),
          "bsimp": ("Bulirsch-Stoer", "C5", "--", "+")}
PARTS = (("force", "bearing's force", "0.25"), ("transform", "Fourier transforms", "C5"),
         ("rest", "algebra, steps, rest", "0.8"))


def front(cpu, error):
    """Indices of the points that none beats in both, by rising CPU time."""
    best, kept = np.inf, []
    for k in np.lexsort((error, cpu)):
        if error[k] < best:
            best = error[k]
            kept.append(k)
    return kept


def number_of(table, frequency, data_set):
    """The case of the header with this speed and data set."""
    return next(case for case, f, file, *_ in table.members("case")
                if f == frequency and Path(file).stem in (data_set, f"{data_set}-as-printed"))


def rows_of(table, frequency, data_set):
    rows = table.where("case", number_of(table, frequency, data_set))
    rows = rows.where("start", START)
    return rows.rows(rows["found"] == 1)


def draw_fronts(axes, rows, column):
    for method, (label, colour, line, marker) in STYLES.items():
        part = rows.where("method", method)
        if part["cpu_s"].size == 0:
            continue
        keep = front(part["cpu_s"], part[column])
        axes.plot(1e3 * part["cpu_s"][keep], part[column][keep], line, color=colour, marker=marker,
                  ms=4, lw=2.6 if method == "aft" else 1.4, label=label, zorder=3 if method == "aft" else 2)
    axes.set(xscale="log", yscale="log")
    axes.xaxis.set_major_locator(LogLocator(numticks=5))
    axes.yaxis.set_major_locator(LogLocator(numticks=6))
    axes.grid(color="0.9", lw=0.6)


def draw_peers(axes, frequency, data_set, column):
    """CVODE's and SciPy's points, if their table is there."""
    if not PEERS.exists():
        return
    peers = Table(PEERS)
    rows = peers.rows((peers["frequency"] == frequency) & (peers["set"] == float(data_set[-1])))
    rows = rows.where("start", "neighbour")
    if rows["cpu_s"].size:
        axes.plot(1e3 * rows["cpu_s"], rows[column], "x", color="0.55", ms=4, mew=1, zorder=1,
                  label="CVODE, SciPy")


def draw_split(axes, rows):
    """Shares of the CPU time of each method at its cheapest setting below an error."""
    names = []
    for place, (method, (label, *_)) in enumerate(STYLES.items()):
        part = rows.where("method", method)
        part = part.rows(part["error"] <= SPLIT_AT)
        names.append(label)
        if part["cpu_s"].size == 0:
            axes.text(0.02, place, "not reached", va="center", color="0.5")
            continue
        k = part["cpu_s"].argmin()
        shares = {"force": part["force_share"][k], "transform": part["transform_share"][k]}
        shares["rest"] = 1 - sum(shares.values())
        left = 0
        for key, name, colour in PARTS:
            axes.barh(place, shares[key], left=left, color=colour, height=0.7, label=name if place == 0 else None)
            left += shares[key]
    axes.set(xlim=(0, 1), ylim=(len(names) - 0.4, -0.6), yticks=range(len(names)), xticks=(0, 0.5, 1))
    axes.set_yticklabels(names)


def draw(table):
    """Rows: displacement, force, split; columns: speeds."""
    figure, grid = plt.subplots(3, len(SHOWN), figsize=(10, 10), layout="constrained")
    for letter, column, (frequency, data_set) in zip("abc", grid.T, SHOWN):
        rows = rows_of(table, frequency, data_set)
        column[0].set_title(f"({letter}) {frequency:g} Hz, set {data_set[-1]}")
        for axes, name in zip(column, ("error", "error_force")):
            draw_fronts(axes, rows, name)
            draw_peers(axes, frequency, data_set, name)
        draw_split(column[2], rows)
        column[1].set_xlabel("CPU time [ms]")
        column[2].set_xlabel("share of CPU")
    for row in grid:
        for axes in row[1:]:
            axes.tick_params(labelleft=False)
    for row in grid[:2]:
        low = min(axes.get_ylim()[0] for axes in row)
        high = max(axes.get_ylim()[1] for axes in row)
        for axes in row:
            axes.set(xlim=(5e-3, 1e3), ylim=(low, min(high, 3)))
    grid[0, 0].set_ylabel("error of displacement [-]")
    grid[1, 0].set_ylabel("error of force [-]")
    grid[2, 0].set_ylabel(f"displacement to {SPLIT_AT:g}")
    handles, labels = grid[0, 1].get_legend_handles_labels()
    bars, parts = grid[2, 0].get_legend_handles_labels()
    figure.get_layout_engine().set(rect=(0.02, LEGEND, 0.97, 1 - LEGEND))
    figure.legend(handles + bars, labels + parts, loc="lower center", ncols=4, frameon=False)
    return figure


run(draw)
