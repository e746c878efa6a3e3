"""Shape of a running rotor, of `explore shape`: the orbits of its nodes along the shaft, and the shaft at two instants.

Where the orbits would be lost beside the static displacement, it is drawn about the mean at each node, as the axes say.
Usage: /usr/bin/python3 figures/shape.py TABLE.tsv OUTPUT.svg
"""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import MaxNLocator
from tables import ROTOR, heading, run

QUARTER, GREY = "C4", "0.45"
MOST_ORBITS = 24


def closed(path):
    """With its first instant at the end, where the motion is nearly closed."""
    gap = np.hypot(*(path[-1] - path[0]))
    return np.vstack([path, path[:1]]) if gap < 4 * np.hypot(*np.diff(path, axis=0).T).max(initial=0) else path


def draw(table):
    figure = plt.figure(figsize=(10, 6.5))
    axes = figure.add_axes((-0.04, 0.0, 1.0, 0.93), projection="3d", computed_zorder=False)
    starts = np.flatnonzero(table["phase"] == 0)
    instants = len(table) // len(starts)
    z = table["z"][starts]
    along = np.argsort(z, kind="stable")
    z = z[along]
    paths = 1e6 * np.column_stack([table["x"], table["y"]]).reshape(len(starts), instants, 2)[along]
    mean = paths.mean(axis=1, keepdims=True)
    is_small = 4 * np.ptp(paths, axis=1).max() < abs(mean).max()
    if is_small:
        paths = paths - mean
    phase = table["phase"][:instants]
    quarter = np.argmin(abs(phase * table.turns_per_base() - np.pi / 2))

    shown = np.unique(np.linspace(0, len(z) - 1, min(len(z), MOST_ORBITS)).round().astype(int))
    half = 0.55 * max(np.ptp(np.append(paths[..., axis], 0)) for axis in (0, 1)) or 1
    centre = [(np.append(paths[..., axis], 0).max() + np.append(paths[..., axis], 0).min()) / 2 for axis in (0, 1)]
    floor = centre[1] - half
    axes.plot(z[[0, -1]], [0, 0], [0, 0], "--", color=GREY, lw=1,
              label="mean at each node" if is_small else "shaft at rest without loads")
    for place in (z_bearing for _, _, z_bearing in table.members("bearing")):
        x, y = (np.interp(place, z, paths[:, 0, axis]) for axis in (0, 1))
        axes.plot([place, place], [x, x], [floor, y], color="k", lw=1)
        axes.plot([place], [x], [floor], "^", ms=9, mfc="w", color="k", label="bearing")
    for node in shown:
        x, y = closed(paths[node]).T
        axes.plot(np.full(len(x), z[node]), x, y, color=GREY, lw=1, label="orbit of a node")
    axes.plot(z, *paths[:, quarter].T, color=QUARTER, lw=1.6, label="shaft a quarter turn later")
    axes.plot(z, *paths[:, 0].T, color=ROTOR, lw=2.6, label="shaft at phase 0")
    axes.plot(z[shown], *paths[shown, 0].T, "o", ms=5, color=ROTOR)

    about = " − mean" if is_small else ""
    axes.set(xlim=(z[0], z[-1]) if z[-1] > z[0] else (z[0] - 1, z[0] + 1), ylim=(centre[0] - half, centre[0] + half),
             zlim=(floor, centre[1] + half), xlabel="z [m]", ylabel=f"x{about} [µm]", zlabel=f"y{about} [µm]")
    axes.set_box_aspect((2.4, 1, 1), zoom=1.25)
    axes.view_init(elev=22, azim=-60)
    axes.xaxis.labelpad, axes.yaxis.labelpad, axes.zaxis.labelpad = 22, 10, 8
    axes.xaxis.set_major_locator(MaxNLocator(6))
    for axis in (axes.yaxis, axes.zaxis):
        axis.set_major_locator(MaxNLocator(4))
    for axis in (axes.xaxis, axes.yaxis, axes.zaxis):
        axis.set_pane_color((1, 1, 1, 1))
    for artist in axes.lines:  # beside the square of the axes too
        artist.set_clip_on(False)
    entries = dict(zip(*reversed(axes.get_legend_handles_labels())))
    figure.legend(entries.values(), entries.keys(), loc="upper center", bbox_to_anchor=(0.5, 0.92), ncols=3, frameon=False)
    heading(figure, f"Rotor at {table.speed_in_words()}{table.regime_in_words()}", table)
    return figure


run(draw)
