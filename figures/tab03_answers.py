"""Questions of users: error against CPU time of this project and of other programs.

Each line joins the targets; a bar reaches from the median to the largest error.
Usage: /usr/bin/python3 figures/tab03_answers.py TABLE.tsv tab03_answers.svg
"""

import matplotlib.pyplot as plt
from matplotlib.ticker import LogLocator
from tables import cells_as_numbers, run

STYLES = {"this": ("C0", "o", "this project"),
          "this-balance": ("C5", "s", "harmonic balance"),
          "rk4": ("black", "P", "RK4 alone"), "cvode": ("C2", "D", "CVODE"),
          "scipy-lsoda": ("C1", "v", "SciPy, LSODA"),
          "scipy-dop853": ("C3", "^", "SciPy, DOP853")}


def draw_question(axes, rows, targets):
    """One question: a line for each method, and the targets."""
    for target in targets:
        axes.axhline(target, color="#b0b0b0", ls=":", lw=1)
    for method, (colour, marker, _) in STYLES.items():
        part = rows.where("method", method)
        if not len(part):
            continue
        cpu, error, largest = (cells_as_numbers(part[name])
                               for name in ("cpu_s", "error", "error_largest"))
        axes.vlines(cpu, error, largest, color=colour, lw=0.8, alpha=0.4)
        axes.plot(cpu, error, color=colour, marker=marker, ms=6, lw=1)
    axes.set(xscale="log", yscale="log")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(LogLocator(numticks=6))
        axis.set_minor_locator(LogLocator(subs=[1], numticks=20))
        axis.set_minor_formatter("")
    axes.grid(color="#d9d9d9", lw=0.7)


def draw(table):
    """A panel for each question."""
    figure = plt.figure(figsize=(10, 8), layout="constrained")
    names, panels = figure.subfigures(2, 1, height_ratios=(0.15, 2))
    grid = panels.subplots(2, 2, sharex=True, sharey=True)
    targets = sorted(set(table["target"]))
    for axes, (name, count, *words) in zip(grid.flat, sorted(table.members("question"))):
        draw_question(axes, table.where("question", name), targets)
        what = " ".join(f"{word:g}" if isinstance(word, float) else word
                        for word in words)
        axes.set_title(f"({name}) {what.split(',')[0]}, {count:g} motions", fontsize=10)
    panels.supxlabel("CPU time of all motions, one thread [s]")
    panels.supylabel("relative error of the amplitude of $x_r$ [-]")
    lines = [plt.Line2D([], [], color=colour, marker=marker, ms=6, lw=1, label=label)
             for colour, marker, label in STYLES.values()]
    lines.append(plt.Line2D([], [], color="#b0b0b0", ls=":", lw=1, label="target"))
    names.legend(handles=lines, loc="center", ncols=4)
    return figure


run(draw)
