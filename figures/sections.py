"""Poincaré sections of the attractors against speed, and the largest Lyapunov exponent below.

One point per period of rotation: the relative displacement at phase 0 over the clearance. A single point at a
speed is a T-periodic motion, K points a KT-periodic one, a band of dots one that does not repeat. Motions of one
kind have one mark; several at a speed are attractors that coexist.
Usage: /usr/bin/python3 figures/sections.py TABLE.tsv OUTPUT.svg
"""

import re
from dataclasses import dataclass

import matplotlib.pyplot as plt
import numpy as np
from tables import run



@dataclass
class Group:
    """Points that are drawn alike."""
    label: str
    rows: object  # with the columns f, exponent, exponent_error
    u: np.ndarray  # of the section, one for each row
    style: dict
    closed: np.ndarray | bool = False  # rows whose exponent is drawn without error bars


def draw_groups(above, below, groups):
    """Sections above, exponents below, these once for each speed and motion with three standard errors."""
    for group in groups:
        rows, style = group.rows, {"mew": 0, "ls": "", **group.style}
        above.plot(rows["f"], group.u, label=group.label, **style)
        keys = np.stack([rows["f"], rows["exponent"]])
        _, first = np.unique(keys, axis=1, return_index=True)
        part = rows.rows(first)
        closed = np.broadcast_to(group.closed, rows["f"].shape)[first]
        below.errorbar(part["f"], part["exponent"], yerr=np.where(closed, 0, 3 * part["exponent_error"]),
                       elinewidth=0.7, **{**style, "ms": max(4, style["ms"]), "alpha": 0.8})
    below.axhline(0, color="#404040", lw=0.75)


# The verdicts of the table of `sections`: label, number, style.
VERDICTS = (("chaotic", 4, {"marker": ".", "ms": 2.6, "color": "#8a8a8a"}), ("quasi-periodic", 3, {"marker": ".", "ms": 4, "color": "C3"}),
            ("undecided", 0, {"marker": "x", "ms": 4, "color": "black", "mew": 1}), ("T-periodic", 1, {"marker": "o", "ms": 3, "color": "C0"}),
            ("several periods", 2, {"marker": "^", "ms": 7, "color": "C1", "mec": "black", "mew": 0.6}))


def by_verdict(rows, clearance):
    """The groups of the table of `sections`."""
    for label, number, style in VERDICTS:
        part = rows.where("verdict", number)
        if len(part) > 0:
            yield Group(label, part, part["u_x"] / clearance, style, number in (1, 2))


# The periods of explore's table: label, chosen rows, marker, its size, colour.
KINDS = (("aperiodic", lambda k: k == 0, ".", 2.4, "#404040"),
         ("quasi-periodic", lambda k: k == -1, ".", 3, "C3"),
         ("period 1", lambda k: k == 1, "o", 4, "C0"),
         ("period 2", lambda k: k == 2, "^", 5, "C1"),
         ("period 3", lambda k: k == 3, "s", 4.5, "C2"),
         ("period 4", lambda k: k == 4, "D", 4, "C4"),
         ("period 5 and more", lambda k: k > 4, "v", 4.5, "C5"),
         ("undecided", lambda k: k == -2, "x", 4, "#909090"))


def by_period(rows, clearance):
    """The groups of explore's table."""
    rows.columns["exponent"] = rows["lyapunov"]
    rows.columns["exponent_error"] = rows["lyapunov_uncertainty"]
    for label, is_kind, marker, size, colour in KINDS:
        part = rows.rows(is_kind(rows["period"]))
        if len(part) > 0:
            yield Group(label, part, (part["x_r"] - part["x_s"]) / clearance,
                        {"marker": marker, "ms": size, "color": colour,
                         "mew": 1 if marker == "x" else 0})


def legend_above(axes, groups):
    """With markers of one size, the small dots too."""
    shown = axes.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=len(groups) if len(groups) < 6 else 4,
                        frameon=False, borderaxespad=0.2, handletextpad=0.2, columnspacing=1.2)
    for handle, group in zip(shown.get_lines(), groups):
        handle.set_markersize(10 if group.style["marker"] == "." else 7)


def draw_machine(table):
    """What explore found: one machine."""
    clearance = table.number("delta")
    figure, (above, below) = plt.subplots(2, 1, figsize=(10, 7.5), sharex=True, layout="constrained",
                                          height_ratios=(3, 2))
    unit, size = ("δ", clearance) if clearance > 0 else ("1 µm", 1e-6)
    groups = list(by_period(table, size))
    draw_groups(above, below, groups)
    legend_above(above, groups)
    above.set_ylabel(f"section: $(x_r - x_s)$/{unit} at phase 0 [-]")
    below.set_ylabel("largest Lyapunov exponent\n[1/period]")
    below.set_xlabel("speed of rotation [Hz]")
    return figure


def draw_sets(table):
    """One column per data set: section above, exponent below."""
    clearances = [float(x) for x in re.findall(r"delta = (\S+) m", table.header)]
    figure, grid = plt.subplots(2, len(clearances), figsize=(10, 7.5), sharex=True, sharey="row",
                                layout="constrained", height_ratios=(3, 2), squeeze=False)
    for number, clearance in enumerate(clearances, 1):
        rows = table.where("set", number)
        above, below = grid[:, number - 1]
        draw_groups(above, below, by_verdict(rows, clearance))
        below.set_xlim(0, rows["f"].max() + 1)
        above.set_title(f"({'ab'[number - 1]}) data set {number}, δ = {1e6 * clearance:g} µm")
        below.set_title(f"({'cd'[number - 1]})", loc="left")
        below.set_xlabel("speed of rotation [Hz]")
    grid[0, 0].set_ylabel("section: $(x_r - x_s)/δ$ at phase 0 [-]")
    grid[1, 0].set_ylabel("largest Lyapunov exponent [1/s]")
    named = {label: handle for axes in grid[0] for handle, label in zip(*axes.get_legend_handles_labels())}
    legend = grid[0, 1].legend(named.values(), named.keys(), loc="lower left", handletextpad=0.2)
    for handle in legend.get_lines():
        handle.set_markersize(10 if handle.get_marker() == "." else 7)
    return figure


def draw(table):
    return draw_sets(table) if "set" in table.columns else draw_machine(table)


run(draw)
