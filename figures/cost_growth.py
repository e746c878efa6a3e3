"""Growth of the cost of harmonic balance with the number of harmonics, with the fitted power laws.

Usage: /usr/bin/python3 figures/cost_growth.py data/reference/cost_growth.tsv cost_growth.svg
"""

import matplotlib.pyplot as plt
import numpy as np
from tables import run


def draw_power(axes, sizes, values, exponent, fitted):
    """The measured values, and the fitted line over the sizes it is fitted to."""
    axes.plot(sizes, values, "o-", color="C0", ms=5, lw=0.8, label="measured")
    if exponent != 0 and (np.diff(values[fitted]) > 0).all():  # no power describes what rises and falls
        x = sizes[fitted]
        log_a = np.mean(np.log(values[fitted]) - exponent * np.log(x))
        axes.plot(x, np.exp(log_a) * x**exponent, color="C1", label=f"power {exponent:.2f} of m, fitted")
    axes.legend(frameon=False, loc="upper left")
    axes.set(xscale="log", yscale="log", xlabel="harmonics m")
    low, high = axes.get_ylim()
    axes.set_ylim(min(low, high / 30), 3 * high)  # a decade at least, and room for the legend
    axes.grid(color="0.9", lw=0.6)


def draw(table):
    """CPU time, and the peak of memory."""
    figure, (cpu, memory) = plt.subplots(1, 2, figsize=(10, 4.5), layout="constrained")
    sizes = table["harmonics"]
    fitted = sizes >= table.value("fitted_from_harmonics")
    draw_power(cpu, sizes, 1e3 * table["cpu_s"], table.value("exponent_cpu", 0), fitted)
    above = table["memory"] > 0
    draw_power(memory, sizes[above], table["memory"][above] / 1e6, table.value("exponent_memory", 0), fitted[above])
    cpu.set_title("(a)", loc="left")
    memory.set_title("(b)", loc="left")
    cpu.set_ylabel("CPU time [ms]")
    memory.set_ylabel("peak memory [MB]")
    return figure


run(draw)
