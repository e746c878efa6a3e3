"""How often the multipliers of m harmonics are right about the machine.

Of the solutions on which the machine's verdict is known, the share that they call stable though the machine is not, or
unstable though it is stable, or leave open; all others are judged rightly. Below each m stands how many solutions that are.
Usage: /usr/bin/python3 figures/verdicts.py data/reference/verdicts.tsv verdicts.svg
"""

import matplotlib.pyplot as plt
import numpy as np
from tables import run

OUTCOMES = [("false stable", "C1", "//"), ("false unstable", "C2", "xx"), ("undecided", "#bbbbbb", "")]


def outcomes(rows):
    """How many of the solutions with a verdict on the machine end in each way."""
    known = rows.rows(rows["machine_stable"] >= 0)
    truth, said = known["machine_stable"], known["series_stable"]
    return len(known), [int(((said == 1) & (truth == 0)).sum()),
                        int(((said == 0) & (truth == 1)).sum()), int((said < 0).sum())]


def draw_set(axes, rows):
    """A bar for each number of harmonics."""
    harmonics, names = np.unique(rows["m"]).astype(int), []
    for at, m in enumerate(harmonics):
        known, counts = outcomes(rows.where("m", m))
        below = 0
        for count, (label, colour, hatch) in zip(counts, OUTCOMES):
            share = 100 * count / max(1, known)
            axes.bar(at, share, 0.6, bottom=below, color=colour, hatch=hatch, edgecolor="white", lw=0.5,
                     label=label if at == 0 else None)
            below += share
        names.append(f"m = {m}\n{known} solutions")
    axes.set_xticks(range(len(harmonics)), names, fontsize=10)
    axes.set_xlim(-0.6, len(harmonics) - 0.4)
    axes.tick_params(axis="x", length=0)


def draw(table):
    """One panel per data set."""
    clearances = [clearance for clearance, in table.members("clearance")]
    figure, grid = plt.subplots(1, len(clearances), figsize=(10, 4.8), sharey=True)
    figure.subplots_adjust(left=0.08, right=0.99, bottom=0.12, top=0.83, wspace=0.06)
    for number, (axes, clearance) in enumerate(zip(grid, clearances), 1):
        draw_set(axes, table.where("set", number))
        axes.set_title(f"({'ab'[number - 1]}) data set {number}, δ = {1e6 * clearance:g} µm", pad=8)
    grid[0].set(ylabel="solutions not judged rightly [%]")
    figure.legend(*grid[0].get_legend_handles_labels(), ncols=3, loc="upper center")
    return figure


run(draw)
