"""Read a table, start and finish a figure: what every figure drawn by Python needs."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np

ROTOR, STATOR = "C0", "C1"


def numbers_or_words(column):
    """A column as numbers if all of it can be read so."""
    try:
        return column.astype(float)
    except ValueError:
        return column


def cells_as_numbers(column):
    """A column with NaN where the result is missing, -."""
    return column if column.dtype.kind != "U" else np.array([np.nan if cell == "-" else float(cell) for cell in column])


class Table:
    """The columns of a tab-separated table by name, and its `#` lines."""

    def __init__(self, path):
        self._read(Path(path).read_text(encoding="utf-8").splitlines())

    @classmethod
    def of(cls, text):
        """The table that a program printed."""
        table = object.__new__(cls)
        table._read(text.splitlines())
        return table

    def _read(self, lines):
        self.header = "\n".join(line for line in lines if line.startswith("#"))
        rows = [line for line in lines if line.strip() and not line.startswith("#")]
        cells = np.array([row.split("\t") for row in rows[1:]])
        self.columns = {name: numbers_or_words(column)
                        for name, column in zip(rows[0].split("\t"), cells.T)}

    def __getitem__(self, name):
        return self.columns[name]

    def __len__(self):
        return next(iter(self.columns.values())).size

    def rows(self, chosen):
        """The rows where `chosen` is true, or of these numbers, as a table with the same header."""
        part = object.__new__(Table)
        part.header = self.header
        part.columns = {key: column[chosen] for key, column in self.columns.items()}
        return part

    def where(self, name, value):
        """The rows in which a column has a value."""
        return self.rows(self[name] == value)

    def first_rows(self, most):
        """The first rows as Markdown, a line for each column with its name, unit, values and meaning, and how many they are."""
        def written(value):
            return value if isinstance(value, str) else re.sub(r"e([+-])0*", lambda sign: "e" + sign[1].strip("+"), f"{value:.4g}")
        lines = [" | ".join([f"| `{name}`", re.sub(r"\^(-?[\d.]+)", r"<sup>\1</sup>", unit), *map(written, self[name][:most]), f"{meaning} |"])
                 for name, unit, meaning in re.findall(r"^# column: (\S+) \[(.*?)\] ?(.*)", self.header, re.MULTILINE)]
        return {"grid": "\n".join([lines[0], re.sub("[^|]+", "---", lines[0]), *lines[1:]]), "rows": len(self), "shown": min(most, len(self))}

    def first(self, name):
        """A column's value in the first row, for columns that are constant in the rows."""
        return self[name][0]

    def bodies(self):
        """r, s: rotor and stator, without a stator that is held."""
        return "r" if "stator: rigid" in self.header else "rs"

    def number(self, name):
        """The number that the header gives after `name = ` or `name: `."""
        found = re.search(rf"\b{re.escape(name)}\s*[=:]\s*([-+.\deE]+)", self.header)
        if found is None:
            raise ValueError(f"the header of the table says nothing of {name}")
        return float(found[1])


def explore(*words):
    """A run of explore; what it refuses ends the program."""
    result = subprocess.run(["build/explore", *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                            encoding="utf-8", check=False)
    if result.returncode == 2:
        sys.exit(result.stderr)
    return result


def said(table, pattern):
    """The words of a header's line that a pattern has groups for; none where there is no such line."""
    found = re.search(pattern, table.header)
    return found.groups() if found else ()


def larger_error(table, line):
    """Of the two errors in the line `error` or `distance` of a header; -1 where there is no such line."""
    return max(map(float, said(table, rf"# {line}: (\S+) of .*?, (\S+) rms")), default=-1)


STABILITY = {"stable": 1, "unstable": 0, "undecided": -1}  # in tables of numbers


def displacement_errors(orbit, exact, names=("x_s", "y_s", "x_r", "y_r")):
    """Of two tables with the columns of `explore orbit` and the same points per period, the first repeated as often as the second
    is longer: the rms difference about the means over that of the exact one about its mean, and the largest difference over the
    largest displacement."""
    a, b = (np.array([table[name] for name in names]) for table in (orbit, exact))
    a = np.tile(a, b.shape[1] // a.shape[1])
    centred = [q - q.mean(axis=1, keepdims=True) for q in (a, b)]
    return np.linalg.norm(centred[0] - centred[1]) / np.linalg.norm(centred[1]), abs(a - b).max() / abs(b).max()


def print_header(title, tables, *notes):
    """The `#` lines of a table made from others: what it is, their source and compiler, the parameters of each, notes."""
    lines = [table.header.split("\n") for table in tables]
    print(f"# {title}", *lines[0][1:3], sep="\n")
    for part in lines:
        print(*(line for line in part if line.startswith(("# parameters: ", "#   "))), sep="\n")
    for note in notes:
        print(f"# {note}")


def print_columns(columns):
    """The lines that say what the columns are, (name, unit, meaning) each, and the row of names."""
    for name, unit, meaning in columns:
        print(f"# column: {name} [{unit}] {meaning}")
    print("\t".join(name for name, _, _ in columns))


def run(draw):
    """Call draw(table) with the style of the project; save the figure that it returns as SVG,
    or as the PNG or PDF that the name of the output says. No dates: the same table gives the same bytes."""
    import matplotlib.pyplot as plt  # here, since tests read tables and draw nothing

    if len(sys.argv) != 3:
        sys.exit(f"usage: {sys.argv[0]} TABLE.tsv OUTPUT.svg")
    plt.switch_backend("svg")
    plt.style.use(Path(__file__).with_name("rotor_stator.mplstyle"))
    figure = draw(Table(sys.argv[1]))
    suffix = Path(sys.argv[2]).suffix[1:]
    form = suffix if suffix in ("png", "pdf") else "svg"
    figure.savefig(sys.argv[2], format=form, metadata={"svg": {"Date": None}, "png": {},
                                                       "pdf": {"CreationDate": None}}[form])
