"""Poincaré sections of the attractors against speed, and the largest Lyapunov exponent below.

One point per period of rotation: the relative displacement at phase 0 over the clearance. A single point at a
speed is a T-periodic motion, K points a KT-periodic one, a band of dots one that does not repeat. Motions of one
kind have one mark; several at a speed are attractors that coexist.
Usage: /usr/bin/python3 figures/sections.py TABLE.tsv OUTPUT.svg
"""

import matplotlib.pyplot as plt
import numpy as np
from tables import heading, run

# Motions by the period of explore's table: label, chosen rows, marker, its size, colour.
KINDS = (("chaotic", lambda k: k == 0, ".", 2.4, "#404040"),
         ("quasi-periodic", lambda k: k == -1, ".", 3, "C3"),
         ("period 1", lambda k: k == 1, "o", 4, "C0"),
         ("period 2", lambda k: k == 2, "^", 5, "C1"),
         ("period 3", lambda k: k == 3, "s", 4.5, "C2"),
         ("period 4", lambda k: k == 4, "D", 4, "C4"),
         ("period 5 and more", lambda k: k > 4, "v", 4.5, "C5"),
         ("undecided", lambda k: k == -2, ".", 2.4, "#a0a0a0"))

# The same, fewer of them, for the study of both data sets.
KINDS_OF_SETS = (("chaotic", lambda k: k == 0, ".", 2.6, "#8a8a8a"),
                 ("quasi-periodic", lambda k: k == -1, ".", 4, "C3"),
                 ("undecided", lambda k: k == -2, "x", 4, "black"),
                 ("T-periodic", lambda k: k == 1, "o", 3, "C0"),
                 ("several periods", lambda k: k > 1, "^", 6, "C1"))


def draw_kinds(above, below, rows, clearance, kinds):
    """Sections above, exponents below, these once for each speed and motion with three standard errors."""
    for label, is_kind, marker, size, colour in kinds:
        part = rows.rows(is_kind(rows["period"]))
        if len(part) == 0:
            continue
        style = {"marker": marker, "color": colour, "mew": 1 if marker == "x" else 0, "ls": ""}
        above.plot(part["f"], (part["x_r"] - part["x_s"]) / clearance, label=label, ms=size, **style)
        _, first = np.unique(np.stack([part["f"], part["lyapunov"]]), axis=1, return_index=True)
        once = part.rows(first)
        below.errorbar(once["f"], once["lyapunov"], yerr=3 * once["lyapunov_uncertainty"], elinewidth=0.7, ms=max(4, size),
                       alpha=0.8, **style)
    below.axhline(0, color="#404040", lw=0.75)


def enlarge_marks(legend):
    """Markers of one size, the small dots too."""
    for handle in legend.get_lines():
        handle.set_markersize(10 if handle.get_marker() == "." else 7)


def draw_machine(table):
    """What explore found: one machine."""
    clearance = table.value("clearance")
    table.columns["f"], _, speed = table.speeds()
    figure, (above, below) = plt.subplots(2, 1, figsize=(10, 7.5), sharex=True, layout="constrained",
                                          height_ratios=(3, 2))
    unit, size = ("δ", clearance) if clearance > 0 else ("1 µm", 1e-6)
    draw_kinds(above, below, table, size, KINDS)
    shown = len(above.get_lines())
    enlarge_marks(above.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=shown if shown < 6 else 4, frameon=False,
                               borderaxespad=0.2, handletextpad=0.2, columnspacing=1.2))
    above.set_ylabel(f"section: $(x_r - x_s)$/{unit} at phase 0 [-]")
    low, high = above.get_ylim()
    if low < 0 < high:
        above.axhline(0, color="#404040", lw=0.5, zorder=0)
    below.set_ylabel("largest Lyapunov exponent\n[1/base period]")
    below.set_xlabel(speed)
    heading(figure, "What the machine settles on: one point in each base period", table)
    return figure


def draw_sets(table):
    """One column per data set: section above, exponent below."""
    clearances = [clearance for clearance, in table.members("clearance")]
    figure, grid = plt.subplots(2, len(clearances), figsize=(10, 7.5), sharex=True, sharey="row",
                                layout="constrained", height_ratios=(3, 2), squeeze=False)
    for number, clearance in enumerate(clearances, 1):
        rows = table.where("set", number)
        for name in ("lyapunov", "lyapunov_uncertainty"):
            rows.columns[name] = rows[name] * rows["f"]
        above, below = grid[:, number - 1]
        draw_kinds(above, below, rows, clearance, KINDS_OF_SETS)
        below.set_xlim(0, rows["f"].max() + 1)
        above.set_title(f"({'ab'[number - 1]}) data set {number}, δ = {1e6 * clearance:g} µm")
        below.set_title(f"({'cd'[number - 1]})", loc="left")
        below.set_xlabel("speed of rotation [Hz]")
    grid[0, 0].set_ylabel("section: $(x_r - x_s)/δ$ at phase 0 [-]")
    grid[1, 0].set_ylabel("largest Lyapunov exponent [1/s]")
    named = {label: handle for axes in grid[0] for handle, label in zip(*axes.get_legend_handles_labels())}
    enlarge_marks(grid[0, 1].legend(named.values(), named.keys(), loc="lower left", handletextpad=0.2))
    return figure


def draw(table):
    return draw_sets(table) if "set" in table.columns else draw_machine(table)


run(draw)
