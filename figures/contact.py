"""The balls' forces of `explore contact`: over two turns, in colour, white where a ball carries nothing.

Usage: /usr/bin/python3 figures/contact.py TABLE.tsv OUTPUT.svg
"""

import matplotlib.pyplot as plt
from contact_map import fill_force
from matplotlib.ticker import MaxNLocator
from tables import heading, run


def draw(table):
    figure, axes = plt.subplots(figsize=(10, 5), layout="constrained")
    fill_force(axes, table)
    heading(axes.figure, f"Force of each ball at {table.speed_in_words()}{table.regime_in_words()}, white: no contact", table)
    axes.set(xlabel="turns [-]", ylabel="ball j")
    axes.yaxis.set_major_locator(MaxNLocator(9, integer=True))
    return figure


run(draw)
