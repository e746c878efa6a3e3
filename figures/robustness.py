"""What the damping decides that the paper leaves out: the share of all speeds, against the damping of the contact.

Above: the motion from rest repeats with every turn. Below: it does, and the solution with the paper's number of harmonics is it,
within the error that counts as right. Left set 1, right set 2. Thick: the machine used everywhere else; thin: other masses,
contact stiffness and cage.
Usage: /usr/bin/python3 figures/robustness.py data/reference/robustness.tsv robustness.svg
"""

import matplotlib.pyplot as plt
import numpy as np
from tables import run

USED = 1
STYLES = {1: ("C0", "-", "o", "as in Table 1"), 3: ("C1", "--", "s", "three times that")}  # of the suspensions' damping
HARMONICS = {1: 6, 2: 10}


def holds(rows, accurate, harmonics):
    """At each speed: T-periodic; and, if harmonics are given, with a solution that is right."""
    periodic = rows["period"] == 1
    return periodic & (rows[f"error_{harmonics}"] <= accurate) if harmonics else periodic


def draw_shares(axes, rows, accurate, harmonics=None):
    """A line for every machine and damping of the suspensions."""
    dampings = np.unique(rows["contact_damping"])
    for times, (colour, line, mark, label) in STYLES.items():
        for machine in np.unique(rows["machine"])[::-1]:
            part = rows.where("machine", machine).where("suspension", times)
            shares = [holds(part.where("contact_damping", one), accurate, harmonics).mean() for one in dampings]
            is_used = machine == USED
            axes.plot(range(len(dampings)), shares, color=colour, ls=line, lw=2.4 if is_used else 0.8, marker=mark,
                      ms=7 if is_used else 3, zorder=2 + is_used, label=label if is_used else None)
    axes.set_xticks(range(len(dampings)), [f"{one:g}" for one in dampings])
    axes.set(ylim=(0, 1.03))
    axes.grid(axis="y", color="#dddddd", lw=0.75)


def draw(table):
    """A column of panels for each data set."""
    figure, grid = plt.subplots(2, 2, figsize=(10, 8), layout="constrained", sharex=True, sharey=True)
    for number, (above, below) in enumerate(grid.T, 1):
        rows, m = table.where("set", number), HARMONICS[number]
        draw_shares(above, rows, table.value("tolerance"))
        draw_shares(below, rows, table.value("tolerance"), m)
        above.set_title(f"({'ab'[number - 1]}) set {number}: the motion is T-periodic", loc="left")
        below.set_title(f"({'cd'[number - 1]}) set {number}: {m} harmonics are right", loc="left")
        below.set_xlabel("damping of the contact [s/m]")
    for axes in grid[:, 0]:
        axes.set_ylabel("share of the speeds [-]")
    thin = plt.Line2D([], [], color="#404040", lw=0.8, label="other masses, $K_H$, cage")
    grid[0, 0].legend(handles=[*grid[0, 0].get_legend_handles_labels()[0], thin], title="damping of the suspensions", loc="lower left")
    return figure


run(draw)
