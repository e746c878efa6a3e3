"""Fill the numbers of a table into a text.

{{key}} becomes the value that the table's row `key` holds, with three digits; {{key:FORMAT}} takes
a format of Python's, such as .2e or .1%. A value may also be words, written as they are; \\n in them is
the end of a line. An unknown key or format ends with one line and status 1.

Usage: paper/include.py TEXT.md TABLE.tsv > RENDERED.md
"""
import re
import sys
from pathlib import Path

REFERENCE = re.compile(r"\{\{([^{}:]*)(?::([^{}]*))?\}\}")
DEFAULT_FORMAT = ".3g"


def read_values(path):
    """The column `value` of a table by its column `key`."""
    lines = [line for line in Path(path).read_text(encoding="utf-8").splitlines()
             if line and not line.startswith("#")]
    names = lines[0].split("\t")
    key, value = names.index("key"), names.index("value")
    rows = [line.split("\t") for line in lines[1:]]
    return {row[key]: number_or_words(row[value]) for row in rows}


def number_or_words(cell):
    try:
        return float(cell)
    except ValueError:
        return cell.replace("\\n", "\n")


def written(value, style):
    """A number in a format, its power of ten without a plus sign and leading zeros: 1.5e10; 1 %; or words."""
    if isinstance(value, str):
        return value
    if value == 0:
        return "0 %" if style.endswith("%") else "0"
    return re.sub(r"e([+-])0*(\d)", lambda m: f"e{'-' if m[1] == '-' else ''}{m[2]}",
                  format(value, style)).replace("%", " %")


def render(text, values, name):
    """The text with every reference replaced. Raises ValueError about the first bad one."""
    def replacement(match):
        line = text.count("\n", 0, match.start()) + 1
        key, style = match[1].strip(), match[2] or DEFAULT_FORMAT
        if key not in values:
            raise ValueError(f"{name}:{line}: no value named {key!r}")
        try:
            return written(values[key], style)
        except ValueError:
            raise ValueError(f"{name}:{line}: {style!r} is no format of a number") from None
    rendered = REFERENCE.sub(replacement, text)
    rest = rendered.find("{{")
    if rest >= 0:
        line = rendered.count("\n", 0, rest) + 1
        raise ValueError(f"{name}:{line}: {{{{ without a key and }}}}")
    return rendered


def main():
    if len(sys.argv) != 3:
        sys.exit(f"usage: {sys.argv[0]} TEXT.md TABLE.tsv")
    text, table = sys.argv[1:]
    try:
        rendered = render(Path(text).read_text(encoding="utf-8"), read_values(table), text)
    except (OSError, ValueError) as error:
        sys.exit(str(error))
    sys.stdout.write(f"<!-- made from {text} and {table}: edit those -->\n\n" + rendered)


if __name__ == "__main__":
    main()
