"""Read a table, start and finish a figure: what every figure drawn by Python needs.

Gnuplot asks for the value of a key, or the first cells of a list's members: /usr/bin/python3 figures/tables.py TABLE.tsv KEY
"""

import csv
import re
import sys
import warnings
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


KEY = re.compile(r"# (?!(?:source|compiler|parameters|column|note|row)\b)([a-z]\w*): (\S+(?: [\d.]+)?)")
MEMBER = re.compile(r"# row (\S+): (.*)")


def number_or_word(text):
    try:
        return float(text)
    except ValueError:
        return text


class Table:
    """A table, separated by tabs, semicolons (with decimal points or commas) or commas: columns by name as numpy arrays,
    the keys of its `#` lines by `value`, the lists by `members`."""

    def __init__(self, path):
        self._read(Path(path).read_text(encoding="utf-8-sig").splitlines())

    @classmethod
    def of(cls, text):
        """The table that a program printed."""
        table = object.__new__(cls)
        table._read(text.splitlines())
        return table

    def _read(self, lines):
        self.header = "\n".join(line for line in lines if line.startswith("#"))
        rows = [line for line in lines if line.strip() and not line.startswith("#")]
        between = next((mark for mark in "\t;," if mark in rows[0]), "\t")
        names, *cells = csv.reader(rows, delimiter=between, quoting=csv.QUOTE_NONE if between == "\t" else csv.QUOTE_MINIMAL)
        if between == ";":
            cells = [[cell.replace(",", ".") for cell in row] for row in cells]
        self.columns = {name: numbers_or_words(column) for name, column in zip(names, np.array(cells).reshape(len(cells), len(names)).T)}

    def keys(self):
        """All keys with their values, numbers or words."""
        found = (KEY.fullmatch(line) for line in self.header.split("\n"))
        return {match[1]: number_or_word(match[2]) for match in found if match}

    def value(self, key, *default):
        """The value of a key, a number or a word; `default` where the header has none."""
        keys = self.keys()
        if key in keys:
            return keys[key]
        if default:
            return default[0]
        raise KeyError(f"the header of the table has no key {key}")

    def members(self, name):
        """The members of a list, each a list of numbers and words."""
        found = (MEMBER.fullmatch(line) for line in self.header.split("\n"))
        rows = [match[2].split() for match in found if match and match[1] == name]
        return [[number_or_word(word) for word in row] for row in rows]

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
        return "r" if self.value("stator") == "rigid" else "rs"

    def speeds(self):
        """The speeds as the figure's axis shows them, the factor from Hz, and its name: in rpm after --rpm."""
        factor, unit = (60, "rpm") if self.value("speed_axis", "Hz") == "rpm" else (1, "Hz")
        return factor * self["f"], factor, f"speed of rotation [{unit}]"

    def speed_in_words(self):
        """The key `frequency`, in Hz and in turns a minute."""
        hertz = self.value("frequency")
        return f"{hertz:g} Hz ({60 * hertz:.5g} rpm)"

    def turns_per_base(self):
        """Turns of the rotor in a base period; 1 where the table has no base period."""
        return self.value("frequency") * self.value("base_period", 1 / self.value("frequency"))

    def regime_in_words(self):
        """", chaotic", ", periodic after 2 base periods"; nothing where the table has no regime."""
        regime, period = self.value("regime", ""), self.value("period", 1)
        return f", {regime}" * bool(regime) + f" after {period:g} base periods" * (regime == "periodic" and period > 1)

    def machine_title(self):
        """The title in the machine's file, at most 80 characters of it, and its bearing where it has a designation."""
        title = re.search(r"^# parameters: .*? \((.*)\)$", self.header, re.MULTILINE)
        bearing = re.search(r"^#   (?:bearing 1: )?(\S+): D = ", self.header, re.MULTILINE)
        words = "".join(letter for letter in title[1] if letter.isprintable()) if title else ""
        words = words if len(words) <= 80 else words[:79] + "…"
        return words + (f", {bearing[1]}" if bearing and bearing[1] not in words else "")

    def unit(self, name):
        """That of a column, as the header has it."""
        return self._column(name)[1]

    def meaning(self, name):
        """Likewise, what it is."""
        return self._column(name)[2].strip()

    def _column(self, name):
        return re.search(rf"^# column: {re.escape(name)} \[(.*?)\](.*)", self.header, re.MULTILINE)

    def error(self, name):
        """The larger of the two numbers `NAME_largest` and `NAME_rms`; -1 without them."""
        return max(self.value(f"{name}_largest", -1), self.value(f"{name}_rms", -1))


def over_keys(table, values, keys):
    """A number for each row as an array, a row for each value of the second key; NaN where there is no row."""
    x, y = (np.unique(table[key]) for key in keys)
    cells = np.full((y.size, x.size), np.nan)
    cells[np.searchsorted(y, table[keys[1]]), np.searchsorted(x, table[keys[0]])] = values
    return cells


SYMBOL = re.compile(r"(?<![A-Za-z0-9])(?:[va]_)?[xy]_[rs](?:_[a-z0-9]+)*(?!\w)")


def with_subscripts(text):
    """`x_r`, `v_y_s` or `x_r_out` in a text of a table as symbols."""
    def symbol(match):
        letter, *below = match[0].split("_")
        return f"${letter}_{{{','.join(below)}}}$"
    return SYMBOL.sub(symbol, text)


def column_in_words(name):
    """A column's name as a label: of `amp_1X_x_r` the displacement as a symbol, the words before it apart."""
    start = next((match.start() for match in SYMBOL.finditer(name)), len(name))
    return name[:start].replace("_", " ") + with_subscripts(name[start:])


def heading(figure, what, table):
    """What a figure shows and, below, of which machine; the machine's title is no markup."""
    figure.suptitle(f"{what}\n{table.machine_title()}".rstrip(), parse_math=False, fontsize="medium")


def read(path):
    """The table in a file: `read(path)["f"]` is a column, `read(path).value("regime")` a key of its header."""
    return Table(path)


STABILITY = {"stable": 1, "unstable": 0, "undecided": -1}  # in tables of numbers


def displacement_errors(orbit, exact, names=("x_s", "y_s", "x_r", "y_r")):
    """Of two tables with the columns of `explore orbit` and the same points per period, the first repeated as often as the second
    is longer: the rms difference about the means over that of the exact one about its mean, and the largest difference over the
    largest displacement."""
    a, b = (np.array([table[name] for name in names]) for table in (orbit, exact))
    a = np.tile(a, b.shape[1] // a.shape[1])
    centred = [q - q.mean(axis=1, keepdims=True) for q in (a, b)]
    return np.linalg.norm(centred[0] - centred[1]) / np.linalg.norm(centred[1]), abs(a - b).max() / abs(b).max()


def print_header(title, tables, *notes, rows=(), **keys):
    """The `#` lines of a table made from others: what it is, their source and compiler, the parameters of each with the clearance,
    keys, members of lists (name, cells) and notes."""
    lines = [table.header.split("\n") for table in tables]
    print(f"# {title}", *lines[0][1:3], "# schema: 2", sep="\n")
    for part in lines:
        print(*(line for line in part if line.startswith(("# parameters: ", "#   "))), sep="\n")
    clearances = [("clearance", [table.value("clearance")]) for table in tables if table.value("clearance", None) is not None]
    for key, value in keys.items():
        print(f"# {key}: {written(value)}")
    for name, cells in [*clearances, *rows]:
        print(f"# row {name}:", *map(written, cells))
    for note in notes:
        print(f"# note: {note}")


def written(value):
    return f"{value:.12g}" if isinstance(value, (int, float)) else value


def two_digits(value):
    """For a sentence: without a power of ten where the number is large."""
    return f"{value:.2g}" if abs(value) < 99.5 else f"{value:.0f}"


def print_columns(columns):
    """The lines that say what the columns are, (name, unit, meaning) each, and the row of names."""
    for name, unit, meaning in columns:
        print(f"# column: {name} [{unit}] {meaning}")
    print("\t".join(name for name, _, _ in columns))


def run(draw):
    """Call draw(table), or draw(table, overlay), with the style of the project; save the figure that it returns as SVG,
    or as the PNG or PDF that the name of the output says. No dates: the same table gives the same bytes."""
    import matplotlib.pyplot as plt  # here, since tests read tables and draw nothing

    if len(sys.argv) < 3:
        sys.exit(f"usage: {sys.argv[0]} TABLE.tsv OUTPUT.svg [OVERLAY.tsv]")
    plt.rcdefaults()  # whatever the reader's matplotlibrc says
    plt.switch_backend("svg")
    plt.style.use(Path(__file__).with_name("rotor_stator.mplstyle"))
    warnings.filterwarnings("ignore", "Glyph .* missing")  # a title may be in any language
    try:
        tables = [read(path) for path in (sys.argv[1], *sys.argv[3:])]
    except (OSError, IndexError, ValueError) as error:
        sys.exit(f"{sys.argv[1]}: is no table: {error}")
    figure = draw(*tables)
    suffix = Path(sys.argv[2]).suffix[1:]
    form = suffix if suffix in ("png", "pdf") else "svg"
    figure.savefig(sys.argv[2], format=form, metadata={
        "svg": {"Date": None, "Creator": "rotor_stator"}, "png": {"Software": "rotor_stator"},
        "pdf": {"CreationDate": None, "Creator": "rotor_stator"}}[form])


if __name__ == "__main__":
    asked = Table(sys.argv[1])
    print(*(f"{first:.12f}" for first, *_ in asked.members(sys.argv[2]) or [[asked.value(sys.argv[2])]]))
