"""What `explore map` computed: each quantity over the two keys, in colour or, where it counts or names, in classes
with a legend; over one key as a curve. White: no result. A key with equal ratios has a logarithmic axis.
Usage: /usr/bin/python3 figures/map.py TABLE.tsv OUTPUT.svg
"""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap
from tables import cells_as_numbers, run

CLASSES = {"stability": ["stable", "unstable", "undecided"]}
PERIODS = {-2: "undecided", -1: "quasi-periodic", 0: "aperiodic"}
MOST_COLOURS = 10


def described(table, name):
    """A column's name with its unit."""
    line = next(line for line in table.header.split("\n") if line.startswith(f"# column: {name} ["))
    unit = line.split("[", 1)[1].split("]")[0]
    return name if unit in ("word", "see key") else f"{name} [{unit}]"


def keys_and_quantities(table):
    """The names of both kinds of columns."""
    keys, = table.members("keys")
    return keys, [name for name in table.columns if name not in (*keys, "status")]


def is_logarithmic(values):
    """Whether neighbours have equal ratios, and not equal differences."""
    if len(values) < 3 or values[0] <= 0:
        return False
    ratios, steps = values[1:] / values[:-1], np.diff(values)
    return np.ptp(ratios) < 1e-6 * ratios.mean() and np.ptp(steps) > 1e-6 * abs(steps).mean()


def classes_of(name, column):
    """Number of the class of each row, NaN without a result, and the names; None for a quantity that is measured."""
    if name in CLASSES:
        names = CLASSES[name]
        return np.array([names.index(cell) if cell in names else np.nan for cell in column]), names
    if name != "period":
        return None
    values = cells_as_numbers(column)
    known = np.unique(values[np.isfinite(values)])
    place = np.where(np.isfinite(values), np.searchsorted(known, values), np.nan)
    return place, [PERIODS.get(k, f"period {k:g}") for k in known]


def over_keys(table, values, keys):
    """A number for each row as an array, a row for each value of the second key; NaN where there is no row."""
    x, y = (np.unique(table[key]) for key in keys)
    cells = np.full((y.size, x.size), np.nan)
    cells[np.searchsorted(y, table[keys[1]]), np.searchsorted(x, table[keys[0]])] = values
    return cells


def edges_of(values):
    """Borders of the cells around values, in the middle on the axis that is drawn."""
    if is_logarithmic(values):
        return np.exp(edges_of(np.log(values)))
    if values.size == 1:
        return np.array([values[0] - 0.5, values[0] + 0.5])
    middles = (values[1:] + values[:-1]) / 2
    return np.array([2 * values[0] - middles[0], *middles, 2 * values[-1] - middles[-1]])


def draw_grid(axes, x, y, cells, **colours):
    """Colours over two keys, nothing where a cell is NaN; the bar of the colours."""
    image = axes.pcolormesh(edges_of(x), edges_of(y), np.ma.masked_invalid(cells), rasterized=True, **colours)
    return axes.figure.colorbar(image, ax=axes, pad=0.02)


def draw_classes(axes, x, y, cells, names, colours):
    """Numbers of classes in colours; beside them the names."""
    bar = draw_grid(axes, x, y, cells, cmap=ListedColormap(colours), norm=BoundaryNorm(np.arange(len(names) + 1) - 0.5, len(names)))
    bar.set_ticks(range(len(names)), labels=names)


def draw_cells(axes, x, y, cells, names):
    """Colours over two keys; beside them the scale, or the names of the classes."""
    if names is not None:
        draw_classes(axes, x, y, cells, names, [plt.get_cmap("tab10")(k % MOST_COLOURS) for k in range(len(names))])
        return
    draw_grid(axes, x, y, cells)
    known = cells[np.isfinite(cells)]
    if min(cells.shape) > 1 and known.size > 3 and np.ptp(known) > 0:
        axes.contour(x, y, np.ma.masked_invalid(cells), 8, colors="white", linewidths=0.6)


def draw(table):
    """One panel for each quantity."""
    keys, quantities = keys_and_quantities(table)
    if len(keys) > 2:
        raise SystemExit("a map over more than two keys cannot be drawn")
    x = np.unique(table[keys[0]])
    y = np.unique(table[keys[1]]) if len(keys) == 2 else None
    if y is not None and x.size * y.size != len(table):
        raise SystemExit("a list of points that is no grid cannot be drawn")
    figure, grid = plt.subplots(len(quantities), 1, figsize=(9, 0.6 + 3.6 * len(quantities)), sharex=True,
                                squeeze=False, layout="constrained")
    for axes, name in zip(grid.flat, quantities):
        classes = classes_of(name, table[name])
        values, names = classes if classes else (cells_as_numbers(table[name]), None)
        axes.set_title(described(table, name))
        if y is None:
            order = np.argsort(table[keys[0]])
            axes.plot(table[keys[0]][order], values[order], "." if names else ".-")
            if names:
                axes.set_yticks(range(len(names)), names)
        else:
            draw_cells(axes, x, y, over_keys(table, values, keys), names)
            axes.set(ylabel=described(table, keys[1]), yscale="log" if is_logarithmic(y) else "linear")
        axes.set_xscale("log" if is_logarithmic(x) else "linear")
    grid.flat[-1].set_xlabel(described(table, keys[0]))
    return figure


if __name__ == "__main__":
    run(draw)
