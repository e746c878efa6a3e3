"""The branch of `explore response`: amplitudes of rotor and stator against speed, with folds, and with `--stability`
what is stable and the bifurcations; of `--columns all` the first six further measures below. Where `--columns` names
columns, these alone, up to 24, one below the other, an amplitude above its phase.

Usage: /usr/bin/python3 figures/response.py TABLE.tsv OUTPUT.svg
"""

import re
import textwrap

import matplotlib.pyplot as plt
import numpy as np
from tables import ROTOR, STATOR, column_in_words, heading, run, with_subscripts

MARKS = {"fold": ("s", "fold"), "plus-one": ("D", "multiplier +1"), "period-doubling": ("^", "period doubling"),
         "neimark-sacker": ("o", "Neimark-Sacker")}
AMPLITUDES = [f"amp_{one}" for one in ("x_s", "y_s", "x_r", "y_r")]
# What explore computes without --columns; of what else it has, measures have panels.
USUAL = {"f", "t", *AMPLITUDES, "period", "error", "arc", "newton", "multiplier", "multiplier_change", "verdict", "bifurcation", "branch"}
MOST_MEASURES, MOST_PANELS = 6, 24
# Of a sweep: marks of the motions that do not repeat themselves after one base period, by the column `period`.
KINDS = [("o", "repeats after several\nperiods", lambda period: period > 1), ("x", "chaotic", lambda period: period == 0),
         ("D", "quasi-periodic", lambda period: period == -1), ("+", "undecided", lambda period: period == -2)]
LINES = {"stable": ("-", 1.8), "unstable": (":", 1.8), "undecided": ("-", 0.7)}


def branches(table):
    """Each branch, in the order in which it was followed."""
    if "branch" not in table.columns:
        return [table]
    return [table.where("branch", number) for number in np.unique(table["branch"])]


def measures(table):
    """The columns of numbers that are not the usual ones."""
    return [name for name, column in table.columns.items()
            if name not in USUAL and column.dtype.kind == "f"][:MOST_MEASURES]


def asked(table):
    """The columns of numbers that `--columns` names, an amplitude followed by its phase; none without it, or where all
    four amplitudes are among them."""
    names, = table.members("asked") or [[]]
    if {*AMPLITUDES} <= {*names}:
        return []
    chosen = [name for name in names if name not in ("f", "t") and table[name].dtype.kind == "f"][:MOST_PANELS]
    whose = [name.replace("phase_", "amp_", 1) for name in chosen]
    return sorted(chosen, key=lambda name: (whose.index(name.replace("phase_", "amp_", 1)), name))


def draw_measure(axes, table, name, colour):
    """One column, in µm where it is a length; kinds of motion in words."""
    if name == "period":
        axes.plot(table["f"], table[name], ".", ms=4, color=colour)
        known = np.unique(table[name])
        axes.set_yticks(known, [next((label for _, label, are in KINDS[1:] if are(value)), f"K = {value:g}") for value in known])
        axes.set_ylim(known[0] - 0.5, known[-1] + 0.5)
        return
    unit = table.unit(name)
    for branch in branches(table):
        draw_branch(axes, branch, name, colour, 1e6 if unit == "m" else 1)
    axes.set_ylabel(column_in_words(name) + {"m": " [µm]", "-": ""}.get(unit, f" [{unit}]"))


def draw_branch(axes, branch, column, colour, factor=1e6):
    """Pieces of one verdict; each ends where the next begins. Of a sweep a mark at each speed."""
    f, amplitude = branch["f"], factor * branch[column]
    if "period" in branch.columns:
        once = branch["period"] == 1
        axes.plot(f[once], amplitude[once], ".", ms=4, color=colour)
        for marker, _, are in KINDS:
            there = are(branch["period"])
            axes.plot(f[there], amplitude[there], marker, ms=4, mfc="white", color=colour)
    verdict = branch["verdict"] if "verdict" in branch.columns else np.full(len(branch), "stable")
    start = 0
    for end in range(1, len(branch) + 1):
        if end == len(branch) or verdict[end] != verdict[start]:
            style, width = LINES[str(verdict[start])]
            axes.plot(f[start:end + 1], amplitude[start:end + 1], style, color=colour, lw=width)
            start = end
    if "bifurcation" in branch.columns:
        for kind, (marker, _) in MARKS.items():
            there = branch["bifurcation"] == kind
            axes.plot(f[there], amplitude[there], marker, ms=6, mfc="white", color="#404040")
    else:
        turned = np.flatnonzero(np.diff(np.sign(np.diff(f)))) + 1
        axes.plot(f[turned], amplitude[turned], "s", ms=6, mfc="white", color="#404040")


def legend(axes, table):
    """What occurs, below the panels."""
    has_verdicts = "verdict" in table.columns
    lines = [(style, width, word) for word, (style, width) in LINES.items()
             if has_verdicts and np.isin(word, table["verdict"])]
    handles = [axes.plot([], [], style, lw=width, color="#404040", label=word)[0] for style, width, word in lines]
    known = np.unique(table["bifurcation"]) if has_verdicts else ["fold"]
    f = table["f"]
    for kind, (marker, label) in MARKS.items():
        if kind in known and (has_verdicts or np.any(np.diff(np.sign(np.diff(f))))):
            handles += axes.plot([], [], marker, mfc="white", color="#404040", label=label)
    for marker, label, are in KINDS if "period" in table.columns else []:
        if are(table["period"]).any():
            handles += axes.plot([], [], marker, ms=4, mfc="white", color="#404040", label=label)
    if handles:
        axes.legend(handles=handles, loc="best", fontsize=10)


def draw_usual(table, speed):
    """The four displacements and, below them, further measures."""
    bodies = table.bodies()
    further = measures(table)
    figure = plt.figure(figsize=(10, 7.5 + 2.5 * len(further)), layout="constrained")
    places = figure.add_gridspec(2 + len(further), len(bodies), height_ratios=[3.75, 3.75, *[2.5] * len(further)])
    grid = np.empty((2, len(bodies)), object)
    for place in np.ndindex(grid.shape):
        grid[place] = figure.add_subplot(places[place], sharex=grid[0, 0], sharey=grid[0, 0])
        grid[place].tick_params(labelbottom=place[0] == 1, labelleft=place[1] == 0)
    below = [figure.add_subplot(places[2 + row, :], sharex=grid[0, 0]) for row in range(len(further))]
    shown = np.concatenate([table[f"amp_{axis}_{body}"] for axis in "xy" for body in bodies])
    for row, axis in zip(grid, "xy"):
        for axes, body, word, colour in zip(row, bodies, ("rotor", "stator"), (ROTOR, STATOR)):
            for branch in branches(table):
                draw_branch(axes, branch, f"amp_{axis}_{body}", colour)
            axes.set_ylabel(f"{word}, {axis} [µm]")
    if shown.max() > 30 * shown.min() > 0:
        axes.set_yscale("log")
    else:
        axes.set_ylim(0, 1.05e6 * shown.max() or 1)
    for axes, name in zip(below, further):
        draw_measure(axes, table, name, "C2")
    for axes in [*grid[1], *below[-1:]]:
        axes.set_xlabel(speed)
    return figure


def draw_asked(table, speed, names):
    """One panel for each column, with its meaning as the table has it."""
    figure, grid = plt.subplots(len(names), 1, figsize=(10, 1.2 + 2.6 * len(names)), sharex=True, squeeze=False,
                                layout="constrained")
    for axes, name in zip(grid.flat, names):
        body = re.search(r"_([rs])(_|$)", name)
        draw_measure(axes, table, name, {"r": ROTOR, "s": STATOR}[body[1]] if body else "C2")
        axes.set_title(with_subscripts(textwrap.shorten(table.meaning(name), 100, placeholder=" ...")), fontsize="medium")
    grid[-1, 0].set_xlabel(speed)
    figure.align_ylabels()
    return figure


def draw(table):
    table.columns["f"], factor, speed = table.speeds()
    names = asked(table)
    figure = draw_asked(table, speed, names) if names else draw_usual(table, speed)
    title = table.header.split("\n")[0].removeprefix("# ") if names else "Half peak-to-peak of the displacements"
    if "t" in table.columns:
        ends = " to ".join(f"{factor * table.value(end):.6g}" for end in ("from", "to"))
        title = title.removesuffix(", turn by turn")
        title += f", turn by turn: {ends} {'Hz' if factor == 1 else 'rpm'} in {table.value('seconds'):g} s"
    heading(figure, title, table)
    legend(figure.axes[0], table)
    return figure


run(draw)
