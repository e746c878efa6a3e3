"""Campbell diagram: whirl frequencies against the speed of rotation, with the lines of unbalance and passing balls.

Usage: /usr/bin/python3 figures/campbell.py TABLE.tsv OUTPUT.svg
"""
import re

import matplotlib.pyplot as plt
from tables import run

KINDS = ((1, "C1", "forward"), (-1, "C0", "backward"), (0, "0.5", "planar"))


def draw(table):
    figure, axes = plt.subplots(figsize=(8, 5.5), layout="constrained")
    header = table.header
    f, frequency, whirl = table["f"], table["frequency"], table["whirl"]
    for kind, colour, label in KINDS:
        shown = whirl == kind
        if shown.any():
            axes.plot(f[shown], frequency[shown], ".", ms=4, color=colour, label=label)
    top = 1.05 * frequency.max()
    for name, order in re.findall(r"^# line (\S+): (\S+) times", header, re.M):
        order = float(order)
        end = min(f.max(), top / order)
        axes.plot([0, end], [0, order * end], color="0.3", lw=0.9, ls="--")
        axes.annotate(name, (end, order * end), ha="right", va="bottom", color="0.3")
    for speed, order_name in re.findall(r"^# critical speed: (\S+) Hz, (\S+),", header, re.M):
        order = float(re.search(rf"^# line {order_name}: (\S+) times", header, re.M)[1])
        axes.plot(float(speed), order * float(speed), "o", ms=6, mfc="none", color="k")
    axes.set(xlim=(f.min(), f.max()), ylim=(0, top), xlabel="speed of rotation [Hz]", ylabel="frequency [Hz]")
    axes.grid(color="0.9", lw=0.6)
    axes.legend(loc="upper left", frameon=False)
    return figure


run(draw)
