"""What `explore map` computed: each quantity over the two keys, in colour or, where it counts or names, in classes
with a legend; over one key as a curve. White: no result. A key with equal ratios has a logarithmic axis. A Lyapunov
exponent is blue below 0 and red above, on one scale, with a line between.
Usage: /usr/bin/python3 figures/map.py TABLE.tsv OUTPUT.svg
"""

import textwrap

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.ticker import MaxNLocator
from tables import cells_as_numbers, column_in_words, heading, over_keys, run, with_subscripts

VERDICTS, REGIMES = ["stable", "unstable", "undecided"], ["rest", "periodic", "quasi-periodic", "chaotic", "undecided"]
CLASSES = {"stability": VERDICTS, "series_stability": VERDICTS, "regime": REGIMES}
PERIODS = {-2: "undecided", -1: "quasi-periodic", 0: "chaotic"}
COLOURS = {"undecided": "#d0d0d0", "quasi-periodic": "C3", "chaotic": "#404040", "period 1": "C0", "periodic": "C0", "period 2": "C1",
           "period 3": "C2", "period 4": "C4", "rest": "#8c6bb1", "stable": "C0", "unstable": "C1"}
MORE = ["C5", "#a6761d", "#1b9e77", "#e7298a", "#66a61e", "#e6ab02", "#5e4fa2", "#d53e4f", "#3288bd", "#abdda4", "#fdae61", "#9e0142"]  # in their order
UNITS = {"rad_per_s": "rad/s", "N_per_m1p5": "N/m$^{1.5}$", "N_per_mn": "N/m$^n$", "N_per_m3": "N/m³", "N_per_mm": "N/mm", "kN_per_m": "kN/m", "N_per_m": "N/m",
         "N_s_per_m": "N s/m", "m_per_s2": "m/s²", "s_per_m": "s/m", "kg_m": "kg m", "g_mm": "g mm", "um": "µm", "mm": "mm", "m": "m", "kg": "kg",
         "g": "g", "Hz": "Hz", "rpm": "rpm", "rad": "rad", "deg": "°", "N": "N", "kN": "kN", "Pa": "Pa", "MPa": "MPa", "GPa": "GPa"}


def described(table, name):
    """A column's name with its unit, a key of the machine's file in words: (text, factor that its values are drawn with)."""
    unit = table.unit(name)
    if unit == "m":
        return f"{column_in_words(name)} [µm]", 1e6
    if unit != "see key":
        words = "speed of rotation" if name == "frequency" else column_in_words(name)
        return words + (f" [{unit}]" if unit != "word" else ""), 1
    *tables, key = name.split(".")
    suffix = next((one for one in UNITS if key.endswith("_" + one)), "")
    words = key[:-len(suffix) - 1] if suffix else key
    text = words.replace("_", " ") + (f" of the {tables[0]}" if tables else "") + (f" [{UNITS[suffix]}]" if suffix else "")
    return (text.replace("[m]", "[µm]"), 1e6) if suffix == "m" else (text, 1)


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
        names = [one for one in CLASSES[name] if one in column]
        return np.array([names.index(cell) if cell in names else np.nan for cell in column]), names
    if name != "period":
        return None
    values = cells_as_numbers(column)
    known = np.unique(values[np.isfinite(values)])
    place = np.where(np.isfinite(values), np.searchsorted(known, values), np.nan)
    return place, [PERIODS.get(k, f"period {k:g}") for k in known]


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
    count = max(1, len(names))  # none where no point has a result
    bar = draw_grid(axes, x, y, cells, cmap=ListedColormap(colours or ["white"]), norm=BoundaryNorm(np.arange(count + 1) - 0.5, count))
    bar.set_ticks(range(len(names)), labels=names)


def draw_about_zero(axes, x, y, cells):
    """Blue below 0, red above, and a line between."""
    known = cells[np.isfinite(cells)]
    largest = abs(known).max(initial=0) or 1
    draw_grid(axes, x, y, cells, cmap="coolwarm", vmin=-largest, vmax=largest)
    if min(cells.shape) > 1 and known.size and known.min() < 0 < known.max():
        axes.contour(x, y, np.ma.masked_invalid(cells), [0], colors="black", linewidths=1)


def draw_cells(axes, x, y, cells, names):
    """Colours over two keys; beside them the scale, or the names of the classes."""
    if names is not None:
        others = iter(MORE)
        draw_classes(axes, x, y, cells, names, [COLOURS.get(name) or next(others) for name in names])
        return
    known = cells[np.isfinite(cells)]
    is_constant = known.size > 0 and np.ptp(known) < 1e-9 * abs(known).max()
    draw_grid(axes, x, y, cells, **({"vmin": 0, "vmax": 1.2 * known[0] or 1} if is_constant else {}))
    if min(cells.shape) > 1 and known.size > 3 and np.ptp(known) > 0:
        levels = MaxNLocator(9).tick_values(known.min(), known.max())
        is_dark = levels > (known.min() + known.max()) / 2
        axes.contour(x, y, np.ma.masked_invalid(cells), levels, colors=np.where(is_dark, "white", "#404040"),
                     linewidths=0.6, linestyles="solid")


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
    (x_label, x_factor), (y_label, y_factor) = (described(table, key) for key in (*keys, keys[0])[:2])
    x, y = x_factor * x, y_factor * y if y is not None else None
    for key, factor in zip(keys, (x_factor, y_factor)):
        table.columns[key] = factor * table[key]
    for axes, name in zip(grid.flat, quantities):
        classes = classes_of(name, table[name])
        values, names = classes if classes else (cells_as_numbers(table[name]), None)
        label, factor = described(table, name)
        values = factor * values
        meaning = "" if names else textwrap.shorten(table.meaning(name), 80, placeholder=" ...")
        axes.set_title(f"{label}: {with_subscripts(meaning)}".removesuffix(": "), fontsize="medium")
        if y is None:
            order = np.argsort(table[keys[0]])
            axes.plot(table[keys[0]][order], values[order], "." if names else ".-")
            if names:
                axes.set_yticks(range(len(names)), names)
            elif np.nanmin(values) == np.nanmax(values):
                axes.set_ylim(sorted((0, 1.2 * np.nanmax(values) or 1)))
            if name == "lyapunov":
                axes.axhline(0, color="#404040", lw=0.75)
        else:
            cells = over_keys(table, values, keys)
            draw_about_zero(axes, x, y, cells) if name == "lyapunov" else draw_cells(axes, x, y, cells, names)
            axes.set(ylabel=y_label, yscale="log" if is_logarithmic(y) else "linear")
        axes.set_xscale("log" if is_logarithmic(x) else "linear")
    grid.flat[-1].set_xlabel(x_label)
    heading(figure, "Map over " + " and ".join(label.split(" [")[0] for label in (x_label, y_label)[:len(keys)]), table)
    return figure


if __name__ == "__main__":
    run(draw)
