"""Campbell diagram: whirl frequencies against the speed of rotation, with the lines of unbalance and passing balls.

A thin line joins the modes of one number, which stands at its right end; a circle is where an order meets a mode.
Usage: /usr/bin/python3 figures/campbell.py TABLE.tsv OUTPUT.svg
"""
import matplotlib.pyplot as plt
import numpy as np
from tables import heading, run

KINDS = ((1, "C1", "forward"), (-1, "C0", "backward"), (0, "0.5", "planar"), (2, "C2", "mixed"))
NEAR = 0.03  # of the height: numbers of modes that would overlap


def name_modes(axes, frequency, mode, top):
    """Numbers of the modes at the right end, several in one place where they are near."""
    groups = []
    for place, number in sorted(zip(frequency, mode)):
        if groups and place - groups[-1][0][-1] < NEAR * top:
            groups[-1][0].append(place)
            groups[-1][1].append(number)
        else:
            groups.append(([place], [number]))
    for places, numbers in groups:
        which = (" and " if len(numbers) == 2 else " to ").join(f"{number:g}" for number in sorted({numbers[0], numbers[-1]}))
        axes.annotate(f"mode{'s' * (len(numbers) > 1)} {which}", (1, np.mean(places)), xycoords=("axes fraction", "data"),
                      xytext=(5, 0), textcoords="offset points", va="center", fontsize=10)


def draw(table):
    figure, axes = plt.subplots(figsize=(10, 6.5), layout="constrained")
    f, factor, speed_axis = table.speeds()
    frequency, whirl, mode = table["frequency"], table["whirl"], table["mode"]
    for number in np.unique(mode):
        axes.plot(f[mode == number], frequency[mode == number], color="0.75", lw=0.8, zorder=1)
    for kind, colour, label in KINDS:
        shown = whirl == kind
        if shown.any():
            axes.plot(f[shown], frequency[shown], ".", ms=4, color=colour, label=label)
    top = 1.08 * frequency.max()
    name_modes(axes, frequency[f == f.max()], mode[f == f.max()], top)
    orders = {name: order / factor for name, order in table.members("order")}
    for name, order in orders.items():
        end = min(f.max(), top / order)
        if end <= f.min():
            continue
        axes.plot([0, end], [0, order * end], color="0.3", lw=0.9, ls="--")
        places = f.min() + np.linspace(0.92, 0.6, 9) * (end - f.min())
        free = max(places, key=lambda place: abs(frequency - order * place - NEAR * top).min())
        axes.annotate(name, (free, order * free), xytext=(-4, 2), textcoords="offset points", ha="right", va="bottom",
                      color="0.3")
    critical = table.members("critical_speed")
    axes.plot([factor * speed for speed, *_ in critical], [orders[name] * factor * speed for speed, name, *_ in critical],
              "o", ms=6, mfc="none", color="k", label="critical speed" if critical else None)
    axes.set(xlim=(f.min(), f.max()), ylim=(0, top), xlabel=speed_axis, ylabel="frequency [Hz]")
    axes.grid(color="0.9", lw=0.6)
    axes.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=5, frameon=False, borderaxespad=0.2)
    heading(figure, "Whirl frequencies against speed (Campbell diagram)", table)
    return figure


run(draw)
