"""Truncation: distance of the m-harmonic solution to the nearest attractor's motion, both data sets.

Paper: §3.3, claims C2 and C3. Errors over the speeds with a T-periodic attractor at which harmonic balance finds a solution: the
largest, which one speed may decide, and the median. Where a number of harmonics finds none at some speeds, their count stands
beside the point.
Usage: /usr/bin/python3 figures/truncation.py data/reference/validity.tsv truncation.svg
"""

import tomllib
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from tables import run

RULES = tomllib.loads(Path("data/claims.toml").read_text(encoding="utf-8"))
PAPER = {1: "C2", 2: "C3"}
QUANTITIES = {"distance": ("displacements", "C0", "o"), "distance_force": ("force", "C1", "^")}
SUMMARIES = {"largest": (np.max, "-", None), "median": (np.median, "--", "white")}


def draw_errors(axes, rows):
    """Lines over m; the number of speeds without a solution beside the largest error."""
    orders = np.unique(rows["m"][rows["m"] > 0])
    found = [rows.where("m", m).where("found", 1) for m in orders]
    for column, (name, colour, marker) in QUANTITIES.items():
        for summary, (number_of, line, face) in SUMMARIES.items():
            axes.plot(orders, [number_of(part[column]) for part in found], line, color=colour, marker=marker, ms=6,
                      mfc=face or colour, label=f"{name}, {summary}")
    for m, part in zip(orders, found):
        missed = (rows["m"] == m).sum() - len(part)
        if missed:
            axes.annotate(f"{missed}", (m, part["distance"].max()), (0, 7), textcoords="offset points", ha="center", fontsize=10)


def draw(table):
    """One panel per data set."""
    clearances = [clearance for clearance, in table.members("clearance")]
    figure, panels = plt.subplots(1, len(clearances), figsize=(10, 5.6), layout="constrained", sharey=True)
    for number, (axes, clearance) in enumerate(zip(panels, clearances), 1):
        of_set = table.where("set", number)
        one = of_set.where("adaptive", 1)
        draw_errors(axes, of_set.where("adaptive", 0).where("periodic", 1))
        for limit in RULES["regimes"]["distance_limits"]:
            axes.axhline(limit, color="#404040", lw=0.8, ls=":")
            if axes is panels[-1]:
                axes.annotate(f"{100 * limit:g} %", (1.01, limit), xycoords=("axes fraction", "data"), va="center", fontsize=10)
        claim = next(claim for claim in RULES["claim"] if claim["id"] == PAPER[number])
        axes.axvline(float(claim["paper"]), color="C3", lw=2, zorder=0, label="harmonics of the paper")
        axes.set(yscale="log", xlabel="number of harmonics m")
        axes.set_xticks(range(2, 17, 2))
        axes.set_title(f"({'ab'[number - 1]}) set {number}, δ = {1e6 * clearance:g} µm:\nT-periodic attractor at "
                       f"{one['periodic'].sum():.0f} of {len(one)} speeds", loc="left")
    panels[0].set_ylabel("rms error about the mean [-]")
    figure.get_layout_engine().set(rect=(0, 0, 1, 0.88))
    figure.legend(*panels[0].get_legend_handles_labels(), loc="upper center", ncols=3, frameon=False)
    return figure


run(draw)
