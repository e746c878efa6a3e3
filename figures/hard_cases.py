"""Hard cases: how each method ends on each of them.

One row per group of the list, one column per method, one mark per machine and speed of the group, in the
order of the list. Usage: /usr/bin/python3 figures/hard_cases.py data/reference/hard_cases.tsv hard_cases.svg
"""

import re

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D
from tables import run

MARKS = {  # name: marker, face, edge
    "T-periodic, confirmed": ("o", "C0", "C0"),
    "aperiodic, confirmed": ("o", "white", "C0"),
    "refused with a reason": ("_", "#909090", "#909090"),
    "unconfirmed": ("s", "C4", "C4"),
    "silent error": ("X", "C1", "C1"),
}
SPACING = 0.085  # between the marks of a group, in columns


def mark_of(verdict, regime):
    """The name of the mark of one row of the table."""
    if verdict == "solved":
        return f"{regime}, confirmed"
    return "refused with a reason" if verdict == "refused" else verdict


def groups_of(cases):
    """The group of each case: its name without varied value and speed."""
    return [re.sub(r"(: [-+.\de]+)?, [\d.e+]+ Hz$", "", case) for case in cases]


def draw_method(axes, rows, groups, column):
    """The marks of one method."""
    order = list(dict.fromkeys(groups))
    seen = dict.fromkeys(order, 0)
    for group, verdict, regime in zip(groups, rows["verdict"], rows["regime"]):
        marker, face, edge = MARKS[mark_of(verdict, regime)]
        axes.plot(column + SPACING * seen[group], order.index(group), marker, mfc=face, mec=edge,
                  ms=6.5, mew=1.4)
        seen[group] += 1


def draw(table):
    """Groups down, methods across."""
    methods = list(dict.fromkeys(table["method"]))
    groups = groups_of(table.where("method", methods[0])["case"])
    order = list(dict.fromkeys(groups))
    figure, axes = plt.subplots(figsize=(10, 10), layout="constrained")
    for column, method in enumerate(methods):
        draw_method(axes, table.where("method", method), groups, column)
    solved = [np.sum(table.where("method", method)["verdict"] == "solved") for method in methods]
    axes.set_xticks(np.arange(len(methods)) + 0.3,
                    [f"{name}\n{count} of {len(groups)} solved"
                     for name, count in zip(methods, solved)])
    axes.set_yticks(range(len(order)), order)
    axes.set(xlim=(-0.1, len(methods) - 0.2), ylim=(len(order) - 0.5, -0.5))
    axes.xaxis.tick_top()
    axes.tick_params(length=0)
    for line in range(1, len(methods)):
        axes.axvline(line - 0.12, color="#404040", lw=0.75)
    for line in range(len(order)):
        axes.axhline(line, color="#e4e4e4", lw=0.75, zorder=0)
    axes.legend([Line2D([], [], ls="", marker=marker, mfc=face, mec=edge, ms=7, mew=1.4)
                 for marker, face, edge in MARKS.values()], MARKS,
                loc="upper center", bbox_to_anchor=(0.4, 0), ncols=3, frameon=False)
    return figure


run(draw)
