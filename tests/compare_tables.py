"""Compares a table of a long study with the kept one.

Numbers agree within 2 % of the column's largest size: speeds in a raster of 1 Hz and shares of 60 speeds
move by more than rounding where a motion is aperiodic, so 97 % of the rows must agree, not all. With
--columns only some are compared: a state on a chaotic attractor is another one after any rounding. With
--key rows are matched by these columns; a row without a partner does not agree.

Usage: tests/compare_tables.py [--columns A,B] [--key C,D] KEPT.tsv NEW.tsv
"""
import argparse
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "figures"))
from tables import Table  # noqa: E402

SHARE_OF_ROWS = 0.97
OF_LARGEST = 0.02


def names(text):
    return text.split(",")


def matched(kept, new, key):
    """The rows of both tables that have a partner, in one order, and the rows in all."""
    if not key:
        return kept, new, max(len(kept), len(new))
    rows = [{tuple(values): k for k, values in enumerate(zip(*(table[name] for name in key)))}
            for table in (kept, new)]
    common = sorted(rows[0].keys() & rows[1].keys())
    parts = [table.rows(np.array([row[one] for one in common], int))
             for table, row in zip((kept, new), rows)]
    return *parts, max(len(kept), len(new))


def main(arguments):
    kept, new = Table(arguments.kept), Table(arguments.new)
    if list(kept.columns) != list(new.columns):
        sys.exit(f"{arguments.new}: other columns than {arguments.kept}")
    kept, new, count = matched(kept, new, arguments.key)
    if len(kept) != len(new):
        sys.exit(f"{arguments.new}: {len(new)} rows, {arguments.kept} has {len(kept)}")
    agrees = np.full(len(kept), True)
    for name in arguments.columns or kept.columns:
        if kept[name].dtype.kind == "U":
            agrees &= kept[name] == new[name]
            continue
        off = abs(kept[name] - new[name])
        agrees &= off <= OF_LARGEST * abs(kept[name]).max()
        print(f"{name}: largest difference {off.max():.3g}")
    print(f"{agrees.sum()} of {count} rows agree")
    return 0 if agrees.sum() >= SHARE_OF_ROWS * count else 1


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--columns", type=names)
    parser.add_argument("--key", type=names, default=[])
    parser.add_argument("kept")
    parser.add_argument("new")
    sys.exit(main(parser.parse_args()))
