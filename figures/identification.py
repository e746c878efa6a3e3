"""The machines that the paper's text admits, and the verdict on each claim for every one of them.

Above, against the stator's mass, the closed form of the loss of contact (line) and the speeds at which the integrated
motion of set 1 loses contact (dots); grey is the transition of the text, its dashed line the speed of Fig. 4. Below, a
row for each claim and in it a line for each joint resonance and cage. The two columns are the readings of Table 1.
Usage: /usr/bin/python3 figures/identification.py data/reference/identification.tsv identification.svg
"""

import tomllib
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from claim_quantities import RULES
from claim_ranges import PAPER_PEAK, Accepted
from matplotlib.ticker import LogLocator
from tables import run

READINGS = ("exchanged: stator 500, rotor 150 rad/s", "as printed: stator 150, rotor 500 rad/s")
PARAMETERS = ("data/set1.toml", "data/set1-as-printed.toml")
HATCHES = {"reproduced": "", "partly": "//", "not reproduced": "xx", "not tested": ".."}  # readable in grey too
COLOURS = {"reproduced": "C2", "partly": "C4", "not reproduced": "C1", "not tested": "#bbbbbb"}
USED = {"marker": "o", "ms": 9, "mfc": "white", "mec": "black", "mew": 1.2, "ls": ""}
TRANSITION, SHOWN = {"color": "#eeeeee", "zorder": 0}, {"color": "#777777", "ls": "--", "lw": 1}
LOSS = {"marker": "o", "ms": 3, "mfc": "C1", "mec": "none", "ls": ""}


def used_mass(reading):
    """The stator's mass of the reading's parameter file."""
    return tomllib.loads(Path(PARAMETERS[reading]).read_text(encoding="utf-8"))["stator"]["mass_kg"]


def draw_losses(axes, rows, reading):
    """`rows`: set 1 with the paper's peak and the first cage."""
    accepted = RULES["accepted"]
    axes.axhspan(*accepted["loss_hz"], **TRANSITION)
    axes.axhline(accepted["paper_loss_hz"], **SHOWN)
    masses, first = np.unique(rows["m_s"], return_index=True)
    axes.plot(masses, rows["f_loss"][first], color="C0")
    lost = rows.rows(rows["contact"] < 1)
    axes.plot(lost["m_s"], lost["f"], **LOSS)
    axes.plot(used_mass(reading), np.interp(used_mass(reading), masses, rows["f_loss"][first]), **USED)
    axes.set(ylim=(0, 32), title=f"({'ab'[reading]}) {READINGS[reading]}\naccepted: $m_s$ = {masses[0]:.3g} to {masses[-1]:.3g} kg")


def draw_verdicts(axes, accepted, claims, families):
    """A rectangle for each machine, as wide as the step of the masses."""
    for row, claim in enumerate(claims):
        verdicts = accepted.verdicts(claim)
        for line, family in enumerate(families):
            if family not in verdicts:
                continue
            masses = np.array(sorted(verdicts[family]))
            half = np.sqrt(masses[1] / masses[0])
            bottom = row - 0.42 + 0.84 * line / len(families)
            axes.barh(np.full(masses.size, bottom), masses * (half - 1 / half), 0.84 / len(families) - 0.03, masses / half,
                      align="edge", color=[COLOURS[verdicts[family][mass]] for mass in masses],
                      hatch=[HATCHES[verdicts[family][mass]] for mass in masses], edgecolor="white", lw=0)
    axes.set_yticks(range(len(claims)), [claim["id"] for claim in claims])
    masses = [mass for claim in claims for family in accepted.verdicts(claim).values() for mass in family]
    axes.set(ylim=(len(claims) - 0.5, -0.5), xlim=(min(masses) / 1.1, 1.1 * max(masses)), xscale="log", xlabel="mass of the stator $m_s$ [kg]")
    axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 3, 4, 5, 6)))
    axes.xaxis.set_major_formatter("{x:g}")
    axes.xaxis.set_minor_formatter("")


def draw(table):
    """A column of two panels for each reading."""
    figure = plt.figure(figsize=(10, 9.6), layout="constrained")
    panels, key = figure.subfigures(2, 1, height_ratios=(18, 3))
    grid = panels.subplots(2, 2, sharex="col", sharey="row", height_ratios=(4, 7))
    for (above, below), reading in zip(grid.T, (0, 1)):
        accepted = Accepted(table, reading)
        main = max(family for family in accepted.families if family[0] == PAPER_PEAK)
        families = [main, *(family for family in accepted.families if family != main)]
        claims = [claim for claim in RULES["claim"] if accepted.values(claim)]
        part = table.where("reading", reading).where("set", 1)
        draw_losses(above, part.where("f_joint", main[0]).where("cage_speed_ratio", main[1]), reading)
        draw_verdicts(below, accepted, claims, families)
    grid[0, 0].set_ylabel("loss of contact [Hz]")
    grid[1, 0].set_ylabel("claim")
    marks = [plt.Line2D([], [], color="C0", label="closed form"), plt.Line2D([], [], **LOSS, label="integrated"),
             plt.Line2D([], [], **USED, label="masses used"),
             plt.Rectangle((0, 0), 1, 1, **TRANSITION, label="transition of the text"), plt.Line2D([], [], **SHOWN, label="speed of Fig. 4"),
             *(plt.Rectangle((0, 0), 1, 1, fc=colour, ec="white", hatch=HATCHES[name], label=name) for name, colour in COLOURS.items())]
    bars = "; ".join(f"{joint:g} Hz" + ("" if cage == main[1] else f" with c = {cage:g}") for joint, cage in families)
    key.legend(handles=marks, loc="upper center", ncols=4, frameon=False, handlelength=1.4, columnspacing=1.2,
               title=f"bars of a claim, from above, by the joint resonance: {bars}")
    return figure


run(draw)
