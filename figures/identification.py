"""Score of each candidate for what the paper leaves out, in both readings of Table 1.

Above, the score as a map: outlined are the candidates accepted by the rule of data/claims.toml, a star is
the best of all, a circle stands at the masses of the reading's parameter file. The factor is that on the
ratio of masses which puts the joint resonance at the paper's peak. Below, the five parts of the score in
the row of the reading's best candidate.
Usage: /usr/bin/python3 figures/identification.py data/reference/identification.tsv identification.svg
"""

import tomllib
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import LogLocator
from tables import run

READINGS = ("exchanged: stator 500, rotor 150 rad/s", "as printed: stator 150, rotor 500 rad/s")
PARAMETERS = ("data/set1.toml", "data/set1-as-printed.toml")
ACCEPTED = {"color": "C1", "lw": 2.2}
BEST = {"marker": "*", "ms": 15, "mfc": "white", "mec": "black", "mew": 0.8, "ls": ""}
USED = {"marker": "o", "ms": 9, "mfc": "white", "mec": "black", "mew": 1.2, "ls": ""}
PARTS = {
    "c1": "C1: peak",
    "c4": "C4: low speeds",
    "c5": "C5: middle speeds",
    "c6": "C6: high speeds",
    "c10": "C10: passed once",
}
MARKERS = "osD^v"


def edges_of(values):
    """Borders of the cells around values that are equally spaced on a logarithmic axis."""
    logs = np.log(values)
    middles = (logs[1:] + logs[:-1]) / 2
    return np.exp([2 * logs[0] - middles[0], *middles, 2 * logs[-1] - middles[-1]])


def score_map(part):
    """The masses, the rows' (cage ratio, factor), and the score as an array, a row for each of them."""
    masses = np.unique(part["m_s"])
    pairs = list(zip(part["cage_speed_ratio"], part["ratio_factor"]))
    rows = sorted(set(pairs))
    score = np.full((len(rows), masses.size), np.nan)
    score[[rows.index(pair) for pair in pairs], np.searchsorted(masses, part["m_s"])] = part["score"]
    return masses, rows, score


def outline(axes, x, chosen):
    """Lines between the chosen cells and the others; row i is between i - 0.5 and i + 0.5."""
    padded = np.pad(chosen, 1).astype(int)
    for i, j in np.argwhere(np.diff(padded, axis=0)[:, 1:-1]):
        axes.plot(x[j:j + 2], [i - 0.5] * 2, **ACCEPTED, solid_capstyle="projecting")
    for i, j in np.argwhere(np.diff(padded, axis=1)[1:-1]):
        axes.plot([x[j]] * 2, [i - 0.5, i + 0.5], **ACCEPTED, solid_capstyle="projecting")


def label_rows(axes, rows):
    """The factor of each row; the cage ratio once for the rows between two white lines."""
    cages = [cage for cage, _ in rows]
    labels = [f"{factor:g}" for _, factor in rows]
    for cage in set(cages):
        first, count = cages.index(cage), cages.count(cage)
        labels[first + count // 2] = f"{cage:g}    {labels[first + count // 2]}"
        axes.axhline(first - 0.5, color="white", lw=3)
    axes.set_yticks(range(len(rows)), labels)


def mark_used(axes, part, rows):
    """A circle at the masses of the reading's parameter file, between the rows next to their ratio."""
    used = tomllib.loads(Path(PARAMETERS[int(part.first("reading"))]).read_text(encoding="utf-8"))
    m_s, cage = used["stator"]["mass_kg"], used["bearing"]["cage_speed_ratio"]
    factor = used["rotor"]["mass_kg"] / m_s / (part["m_r"] / part["m_s"] / part["ratio_factor"])[0]
    numbers = [number for number, (ratio, _) in enumerate(rows) if ratio == cage]
    axes.plot(m_s, np.interp(factor, [rows[number][1] for number in numbers], numbers), **USED)


def draw_map(axes, part, best, least):
    """The score of one reading in colour; returns the image for the colour bar."""
    masses, rows, score = score_map(part)
    x = edges_of(masses)
    y = np.arange(len(rows) + 1) - 0.5
    image = axes.pcolormesh(x, y, score, vmin=0, vmax=1, rasterized=True)
    label_rows(axes, rows)
    outline(axes, x, score >= least)
    mark_used(axes, part, rows)
    for i, j in np.argwhere(score == best):
        axes.plot(masses[j], i, **BEST)
    axes.set(xscale="log", xlim=x[[0, -1]], ylim=y[[0, -1]])
    axes.set_title(f"{READINGS[int(part.first('reading'))]}\nbest score {part['score'].max():.2f}, "
                   f"{np.sum(score >= least)} of {score.size} accepted")
    return image


def draw_parts(axes, part):
    """The parts of the score against the mass, other parameters as in the reading's best candidate."""
    top = part["score"].argmax()
    cage, factor = part["cage_speed_ratio"][top], part["ratio_factor"][top]
    row = part.where("cage_speed_ratio", cage).where("ratio_factor", factor)
    for name, marker in zip(PARTS, MARKERS):
        axes.plot(row["m_s"], row[name], marker=marker, ms=4.5, lw=1.2, label=PARTS[name])
    axes.set_title(f"parts of the score at $ω_{{cage}}/ω$ = {cage:g}, factor {factor:g}")
    axes.set(xlabel="mass of the stator $m_s$ [kg]", ylim=(-0.05, 1.05))
    axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes.xaxis.set_major_formatter("{x:g}")
    axes.xaxis.set_minor_formatter("")
    axes.grid(color="#d9d9d9", lw=0.5)


def draw(table):
    """A column of two panels for each reading."""
    within = tomllib.loads(Path("data/claims.toml").read_text(encoding="utf-8"))["score"]["within"]
    best = table["score"].max()
    figure = plt.figure(figsize=(10, 8.4), layout="constrained")
    panels, key = figure.subfigures(2, 1, height_ratios=(17, 2))
    grid = panels.subplots(2, 2, sharex="col", sharey="row", height_ratios=(5, 4))
    for (above, below), reading in zip(grid.T, np.unique(table["reading"])):
        part = table.where("reading", reading)
        image = draw_map(above, part, best, (1 - within) * best)
        draw_parts(below, part)
    panels.colorbar(image, ax=grid[0], label="score [-]", pad=0.02)
    grid[0, 0].set_ylabel("$ω_{cage}/ω$, factor of $m_r/m_s$ [-]")
    grid[1, 0].set_ylabel("part of the score [-]")
    marks = [plt.Line2D([], [], **style, label=label) for style, label in (
        (BEST, "best candidate of both readings"), (USED, "masses used"), (ACCEPTED, "accepted"))]
    for handles, place in ((marks, "upper center"), (grid[1, 0].get_lines(), "lower center")):
        key.legend(handles=handles, loc=place, ncols=len(handles), frameon=False, handlelength=1.6,
                   columnspacing=1.4)
    return figure


run(draw)
