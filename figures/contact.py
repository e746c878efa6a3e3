"""The balls' forces of `explore contact`: over two base periods, in colour, white where a ball carries nothing; a panel for each
bearing and, where the table knows it (`--columns all`), the largest stress below.

Usage: /usr/bin/python3 figures/contact.py TABLE.tsv OUTPUT.svg
"""

import matplotlib.pyplot as plt
import numpy as np
from contact_map import force_map
from matplotlib.ticker import MaxNLocator
from tables import heading, run


def draw_stress(axes, parts):
    """The largest stress of all balls at each instant."""
    for name, part in parts.items():
        if not part["stress"].any():
            continue  # the sizes of its balls are not known
        times, which = np.unique(part["t_over_T"], return_inverse=True)
        largest = np.zeros(times.size)
        np.maximum.at(largest, which, part["stress"])
        axes.plot(times, largest, label=name)
    axes.set(ylabel="largest\nstress [N/mm²]", ylim=(0, None))
    if len(parts) > 1:
        axes.legend()


def draw(table):
    table.columns["t_over_T"] = table["t_over_T"] * table.turns_per_base()
    parts = {"": table}
    if "bearing" in table.columns:
        parts = {f"bearing {b:g}": table.where("bearing", b) for b in np.unique(table["bearing"])}
    has_stress = "stress" in table.columns
    heights = [3] * len(parts) + [1.5] * has_stress
    figure, all_axes = plt.subplots(len(heights), figsize=(10, 2 + sum(heights)), sharex=True, squeeze=False, layout="constrained",
                                    height_ratios=heights)
    most = table["Q"].max() or 1  # one colour is one force
    for axes, (name, part) in zip(all_axes.flat, parts.items()):
        force, ends = force_map(part)
        mesh = axes.pcolormesh(ends, np.arange(len(force) + 1) + 0.5, np.ma.masked_equal(force, 0), vmin=0,
                               vmax=most, rasterized=True)  # cells of an SVG would show white seams
        figure.colorbar(mesh, ax=axes, pad=0.03, label="Q [N]", ticks=MaxNLocator(4))
        axes.set(ylabel="ball j" + (", " + name if name else ""))
        axes.yaxis.set_major_locator(MaxNLocator(9, integer=True))
    if has_stress:
        draw_stress(all_axes[-1, 0], parts)
    all_axes[-1, 0].set_xlabel("turns [-]")
    heading(figure, f"Force of each ball at {table.speed_in_words()}{table.regime_in_words()}, white: no contact", table)
    return figure


run(draw)
