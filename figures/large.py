"""Cost of harmonic balance against the degrees of freedom, and the error of its solutions.

Usage: /usr/bin/python3 figures/large.py data/reference/large.tsv large.svg
"""
import matplotlib.pyplot as plt
import numpy as np
from tables import run

COSTS = (("reduction_s", "reading, reduction, fits: once", "s"), ("branch_200", "then a branch of 200 points", "o"),
         ("verdict_s", "solution to 0.1 %, verdict", "^"))


def draw(table):
    figure, (cost, memory, error) = plt.subplots(1, 3, figsize=(11, 4), layout="constrained")
    table.columns["branch_200"] = 200 * table["branch_s"] / table["points"]
    beams, bricks, paper = (table.where("kind", kind) for kind in ("beam", "brick", "paper"))
    for k, (name, label, marker) in enumerate(COSTS):
        cost.plot(beams["n"], beams[name], marker + "-", ms=5, lw=1, color=f"C{k}", label=label)
        for rows, fill in ((bricks, "none"), (paper, "0.8")):
            cost.plot(rows["n"], rows[name], marker, ms=7, mfc=fill, color=f"C{k}")
    whole = beams.rows(beams["integrated"] == beams["n"])
    cost.plot(whole["n"], whole["integration_s"], "x:", color="C3", label="integration of all")
    cost.set(ylabel="CPU time [s]")
    memory.plot(beams["n"], beams["memory"] / 1e6, "o-", ms=5, lw=1, color="C0")
    memory.plot(bricks["n"], bricks["memory"] / 1e6, "o", ms=7, mfc="none", color="C0")
    for label, fill in (("beams", "C0"), ("bricks", "none"), ("paper's machine", "0.8")):
        memory.plot([], [], "o", ms=6, mfc=fill, color="C0", label=label)
    memory.plot(paper["n"], paper["memory"] / 1e6, "o", ms=7, mfc="0.8", color="C0")
    memory.legend(frameon=False, fontsize=8, loc="upper left")
    memory.set(ylabel="peak memory of the branch [MB]", ylim=(10, 1e4))
    for rows, fill in ((beams, None), (bricks, "none"), (paper, "0.8")):
        error.plot(rows["n"], rows["error"], "o", ms=6, mfc=fill, color="C0")
    reduced = beams.rows(beams["reduction_error"] > 0)
    error.plot(reduced["n"], reduced["reduction_error"], "+", ms=8, color="C1")
    error.plot(bricks["n"], bricks["reduction_error"], "+", ms=8, color="C1")
    error.annotate("solution against integration", (4, 3 * error.get_lines()[0].get_ydata().max()), color="C0")
    error.annotate("receptances by the reduction", (4, 0.2 * reduced["reduction_error"].min()), color="C1")
    error.set(ylabel="relative error", ylim=(1e-12, 1))
    for letter, axes in zip("abc", (cost, memory, error)):
        axes.set_title(f"({letter})", loc="left")
        axes.set(xscale="log", yscale="log", xlabel="degrees of freedom", xlim=(2, 3e5))
        axes.set_xticks(10.0 ** np.arange(1, 6))
        axes.grid(color="0.9", lw=0.6)
    cost.legend(frameon=False, fontsize=8, loc="upper left")
    cost.set_ylim(1e-3, 3e3)
    return figure


run(draw)
