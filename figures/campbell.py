"""Campbell diagram: whirl frequencies against the speed of rotation, with the lines of unbalance and passing balls.

Usage: /usr/bin/python3 figures/campbell.py TABLE.tsv OUTPUT.svg
"""
import matplotlib.pyplot as plt
from tables import run

KINDS = ((1, "C1", "forward"), (-1, "C0", "backward"), (0, "0.5", "planar"))


def draw(table):
    figure, axes = plt.subplots(figsize=(8, 5.5), layout="constrained")
    f, factor, speed_axis = table.speeds()
    frequency, whirl = table["frequency"], table["whirl"]
    for kind, colour, label in KINDS:
        shown = whirl == kind
        if shown.any():
            axes.plot(f[shown], frequency[shown], ".", ms=4, color=colour, label=label)
    top = 1.05 * frequency.max()
    orders = {name: order / factor for name, order in table.members("order")}
    for name, order in orders.items():
        end = min(f.max(), top / order)
        axes.plot([0, end], [0, order * end], color="0.3", lw=0.9, ls="--")
        axes.annotate(name, (end, order * end), ha="right", va="bottom", color="0.3")
    for speed, name, *_ in table.members("critical_speed"):
        axes.plot(factor * speed, orders[name] * factor * speed, "o", ms=6, mfc="none", color="k")
    axes.set(xlim=(f.min(), f.max()), ylim=(0, top), xlabel=speed_axis, ylabel="frequency [Hz]")
    axes.grid(color="0.9", lw=0.6)
    axes.legend(loc="upper left", frameon=False)
    return figure


run(draw)
