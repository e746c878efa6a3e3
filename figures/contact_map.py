"""The body of Figures 7 and 9: which balls are loaded, and how much, over two periods.

Above, one panel per speed as in the paper: black where a ball is in contact. Below, the same panels
with the force of each ball in colour, white without contact, on one logarithmic scale for all panels since the
forces grow by an order of magnitude up to the resonance. Both are drawn as areas, one path for each
colour, so that the maps stay drawings at any size.
"""

from string import ascii_lowercase

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from matplotlib.ticker import MultipleLocator
from tables import over_keys

BALANCE = 1
COLOURS = 24


def force_map(panel):
    """Q as an array, a row per ball and a column per time, and the ends of the times."""
    times = np.unique(panel["t_over_T"])
    return over_keys(panel, panel["Q"], ("t_over_T", "ball")), np.append(times, 2 * times[-1] - times[-2])


def area_of(cells, ends):
    """All true cells of a map as one path: a rectangle for each run of neighbouring times."""
    steps = np.diff(cells.astype(int), axis=1, prepend=0, append=0)
    corners = [(ends[a], ends[b], ball + 0.5) for ball in range(cells.shape[0])
               for a, b in zip(np.flatnonzero(steps[ball] == 1), np.flatnonzero(steps[ball] == -1))]
    return Path(np.array([point for a, b, low in corners for point in
                          ((a, low), (b, low), (b, low + 1), (a, low + 1), (a, low))]),
                [Path.MOVETO, *3 * [Path.LINETO], Path.CLOSEPOLY] * len(corners))


def fill(axes, cells, ends, colour):
    if cells.any():
        axes.add_patch(PathPatch(area_of(cells, ends), facecolor=colour, edgecolor=colour, lw=0.15))
    axes.set(xlim=(ends[0], ends[-1]), ylim=(0.5, cells.shape[0] + 0.5))


def heading_of(panel, title):
    """The title, where the motion of the panel comes from, and the error of harmonic balance."""
    rms = f"rms error {100 * panel.first('difference_rms'):.2g} %"
    if panel.first("shown") == BALANCE:
        return f"{title}\n{rms}, force {100 * panel.first('difference_force'):.2g} %"
    reason = ("not T-periodic" if panel.first("periodic") == 0
              else "no solution found" if panel.first("found") == 0
              else f"{panel.value('harmonics'):g} harmonics: {rms}")
    return f"{title}, time integration\n{reason}"


def draw_contact(axes, panel, title):
    """Black where Q > 0."""
    force, ends = force_map(panel)
    fill(axes, force > 0, ends, "black")
    axes.set_title(heading_of(panel, title))


def fill_force(axes, panel, norm):
    """Q in colour, white where it is zero."""
    force, ends = force_map(panel)
    colours = ScalarMappable(norm, plt.get_cmap(lut=COLOURS))
    level = np.clip(COLOURS * np.ma.filled(colours.norm(np.maximum(force, 1e-30)), 0), 0, COLOURS - 1).astype(int)
    for step in range(COLOURS):
        fill(axes, (force > 0) & (level == step), ends, colours.cmap(step))


def draw_block(figure, panels, columns, draw_panel, heading):
    """One block of panels under a heading."""
    rows = -(-len(panels) // columns)
    grid = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
    for axes in grid.flat[len(panels):]:
        axes.remove()
    for letter, axes, panel in zip(ascii_lowercase, grid.flat, panels):
        draw_panel(axes, panel, f"({letter}) {panel.first('f'):g} Hz")
        last = int(panel["ball"].max())
        axes.set_yticks([1, *range(4, last, 4), last])
        axes.xaxis.set_major_locator(MultipleLocator(0.5))
        axes.xaxis.set_major_formatter("{x:g}")
    figure.suptitle(heading)
    figure.supxlabel("time over period t/T [-]")
    figure.supylabel("ball j")
    return grid


def draw(table):
    """Both blocks of all panels."""
    panels = [table.where("panel", number) for number in np.unique(table["panel"])]
    columns = min(len(panels), 2 if len(panels) <= 4 else 3)
    rows = -(-len(panels) // columns)
    figure = plt.figure(figsize=(10, 1.5 + 4.7 * rows), layout="constrained")
    above, below = figure.subfigures(2, 1, hspace=0.03)
    draw_block(above, panels, columns, draw_contact,
               f"Contact (black), none (white), δ = {1e6 * table.value('clearance'):g} µm, by harmonic balance with "
               f"{table.value('harmonics'):g} harmonics unless said\n"
               "rms error: of the displacements about their means; force: largest error of the bearing's force")
    scale = LogNorm(table["Q"].max() / 100, table["Q"].max())

    def draw_force(axes, panel, title):
        fill_force(axes, panel, scale)
        axes.set_title(title)

    grid = draw_block(below, panels, columns, draw_force, "Force of each ball in the same panels (white: no contact)")
    below.colorbar(ScalarMappable(scale, plt.get_cmap(lut=COLOURS)), ax=grid, pad=0.02, extend="min", label="Q [N]")
    return figure
