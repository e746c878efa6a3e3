"""Outside integrators: cost against error at single speeds; AUTO-07p's response curve over ours.

Filled markers start from the solution at the speed below, open ones from rest; of each only the rows
that no cheaper one beats.
Usage: /usr/bin/python3 figures/peers.py data/reference/peers.tsv peers.svg
"""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import LogLocator
from tables import Table, run

AUTO, RESPONSE = "data/reference/peers_auto.tsv", "data/generated/fig03_response.tsv"
STYLES = {"cvode-adams": ("C0", "o", "CVODE, Adams"), "cvode-bdf": ("C5", "s", "CVODE, BDF"),
          "cvode-bdf2": ("C4", "P", "CVODE, BDF of order 2"),
          "scipy-dop853": ("C1", "^", "SciPy, DOP853"), "scipy-lsoda": ("C2", "D", "SciPy, LSODA"),
          "scipy-radau": ("C3", "v", "SciPy, Radau")}
SHOWN = ((1, 6), (1, 16), (1, 45), (2, 45))  # data set and speed [Hz]
ERRORS = (("error", "error of displacement [-]"), ("error_force", "error of force [-]"))


def front(rows, error):
    """CPU times and errors of the rows that no cheaper row of the same kind beats."""
    order = np.argsort(rows["cpu_s"])
    errors = rows[error][order]
    best = errors <= np.minimum.accumulate(errors)
    return rows["cpu_s"][order][best], errors[best]


def draw_costs(axes, rows, error):
    """One speed: CPU time against one error, a line for each method and start."""
    for method, (colour, marker, _) in STYLES.items():
        for start, line, face in (("static", ":", "white"), ("neighbour", "-", colour)):
            part = rows.rows((rows["method"] == method) & (rows["start"] == start))
            axes.plot(*front(part, error), line, color=colour, marker=marker, ms=4.5, mfc=face,
                      mew=1, lw=1)
    axes.set(xscale="log", yscale="log")
    for axis, most in ((axes.xaxis, 3), (axes.yaxis, 5)):
        axis.set_major_locator(LogLocator(numticks=most))
        axis.set_minor_locator(LogLocator(subs=[1], numticks=20))
        axis.set_minor_formatter("")
    axes.grid(color="#d9d9d9", lw=0.7)


def legend_lines():
    """One line for each method, then one for each start."""
    for colour, marker, label in STYLES.values():
        yield plt.Line2D([], [], color=colour, marker=marker, ms=5, lw=1, label=label)
    for line, face, label in ((":", "white", "from rest"), ("-", "black", "from the speed below")):
        yield plt.Line2D([], [], color="black", ls=line, marker="o", mfc=face, ms=5, lw=1,
                         label=label)


def draw_branch(axes, auto, response):
    """Rotor's amplitude along the branch; the folds that AUTO located."""
    ours = response.rows((response["set"] == 1) & (response["curve"] == 1))
    axes.plot(ours["f"], 1e3 * ours["amp_x_r"], color="#9CCFF2", lw=7,
              label="harmonic balance of Fig. 3", solid_capstyle="butt")
    for name, colour, text in (("up", "C2", "rising"), ("down", "C1", "falling")):
        part = auto.where("run", name)
        axes.plot(part["f"], 1e3 * part["amp_x_r"], color=colour, lw=1.2,
                  label=f"AUTO-07p, speed {text}: {part['f'].size} points, "
                        f"{part['fold'].sum():g} folds")
    folds = auto.where("fold", 1)
    axes.plot(folds["f"], 1e3 * folds["amp_x_r"], ls="", marker="|", ms=9, color="black",
              label="fold of AUTO-07p")
    axes.set(yscale="log", xlabel="speed of rotation f [Hz]",
             ylabel="half peak-to-peak\nof $x_r$ [mm]", xlim=(0, 60))
    axes.yaxis.set_major_formatter("{x:g}")
    axes.grid(color="#d9d9d9", lw=0.7)
    axes.legend(loc="upper left", fontsize=10)


def draw(peers):
    """Two rows of costs, a column for each speed, over the branch."""
    figure = plt.figure(figsize=(10, 9.5), layout="constrained")
    names, above, below = figure.subfigures(3, 1, height_ratios=(0.2, 2, 1.1))
    grid = above.subplots(2, len(SHOWN), sharex=True, sharey="row")
    for row, (error, label) in zip(grid, ERRORS):
        row[0].set_ylabel(label)
        for axes, (number, frequency) in zip(row, SHOWN):
            rows = peers.rows((peers["set"] == number) & (peers["frequency"] == frequency))
            draw_costs(axes, rows, error)
            if error == "error":
                axes.set_title(f"set {number:g}, {frequency:g} Hz")
    above.supxlabel("CPU time of one thread [s]")
    names.legend(handles=list(legend_lines()), loc="center", ncols=4)
    draw_branch(below.subplots(), Table(AUTO), Table(RESPONSE))
    return figure


run(draw)
