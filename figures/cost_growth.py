"""Growth of the cost of harmonic balance with harmonics, balls and speeds, with the fitted power laws.

Usage: /usr/bin/python3 figures/cost_growth.py data/reference/cost_growth.tsv cost_growth.svg
"""

import matplotlib.pyplot as plt
import numpy as np
from tables import run

KINDS = (("harmonics", "harmonics m"), ("balls", "balls n"), ("speeds", "speeds"))


def draw_kind(axes, sizes, values, exponent, fitted):
    """The measured values, and the fitted line over the sizes it is fitted to."""
    axes.plot(sizes, values, "o-", color="C0", ms=5, lw=0.8)
    if exponent != 0 and (np.diff(values[fitted]) > 0).all():  # no power describes what rises and falls
        x = sizes[fitted]
        log_a = np.mean(np.log(values[fitted]) - exponent * np.log(x))
        axes.plot(x, np.exp(log_a) * x**exponent, color="C1", label=f"exponent {exponent:.2f}")
        axes.legend(frameon=False, loc="upper left")
    axes.set(xscale="log", yscale="log")
    low, high = axes.get_ylim()
    axes.set_ylim(min(low, high / 30), 3 * high)  # a decade at least, and room for the legend
    axes.grid(color="0.9", lw=0.6)


def draw_other_algebra(axes, table):
    """Newton's equations solved otherwise, beside the usual way."""
    for name, color, marker, label in (("harmonics, whole", "C4", "v", "without the start on 64"),
                                       ("harmonics, dense", "C3", "s", "dense")):
        rows = table.where("against", name)
        axes.plot(rows["size"], 1e3 * rows["cpu_s"], marker + ":", color=color, ms=4, lw=0.8, label=label)
    low, high = axes.get_ylim()
    axes.set_ylim(low, max(high, 20e3 * table.where("against", "harmonics, dense")["cpu_s"].max()))
    axes.legend(frameon=False, loc="upper left")


def draw(table):
    """Rows: CPU and memory; columns: what grows."""
    figure, grid = plt.subplots(2, len(KINDS), figsize=(10, 7), sharex="col", layout="constrained")
    least = table.value("fitted_from_bytes")
    for (cpu, memory), (kind, label) in zip(grid.T, KINDS):
        rows = table.where("against", kind)
        sizes = rows["size"]
        fitted = sizes >= table.value(f"fitted_from_{kind}")
        draw_kind(cpu, sizes, 1e3 * rows["cpu_s"], rows.first("exponent_cpu"), fitted)
        above = rows["memory"] > 0
        draw_kind(memory, sizes[above], rows["memory"][above] / 1e6, rows.first("exponent_memory"),
                  (fitted & (rows["memory"] >= least))[above])
        if kind == "harmonics":
            draw_other_algebra(cpu, table)
        memory.set_xlabel(label)
    grid[0, 0].set_ylabel("CPU time [ms]")
    grid[1, 0].set_ylabel("peak memory [MB]")
    return figure


run(draw)
