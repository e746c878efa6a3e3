"""Compares tables of long studies with the kept ones in data/reference.

Numbers agree within 2 % of the column's largest size: speeds in a raster of 1 Hz and shares of 60 speeds
move by more than rounding where a motion is aperiodic, so 97 % of the rows must agree, not all. Some
columns are left out: a state on a chaotic attractor is another one after any rounding. CPU times are those
of a machine; they are shown, not judged.

Usage: tests/compare_kept.py data/generated/NAME.tsv...
"""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "figures"))
from tables import Table, cells_as_numbers  # noqa: E402

SHARE_OF_ROWS = 0.97
OF_LARGEST = 0.02

# The columns that are compared, where not all are; the columns that name a row, where rows may be missing.
COLUMNS = {"attractors": ["set"], "validity": ["found", "distance", "periodic"],
           "identification": ["reading", "set", "m_s", "m_r", "f_loss", "f", "periodic", "turns", "amp_x_r"],
           "large": ["n", "r"],
           "clearance_speed": ["frequency", "bearing.radial_clearance_m", "period", "contact_share"],
           "map_scaling": ["kind", "count", "points"],
           "verdicts": ["set", "f", "m", "found", "machine_stable", "distance", "series_stable"],
           "hard_cases": ["case", "method", "status", "verdict", "regime"]}
KEY = {"attractors": ["set", "f", "period", "point"]}
# The column of the kinds whose CPU times are shown.
TIMED = {"tab02_timing": "method", "tab02_equal_error": "method", "work_precision": "method",
         "cost_growth": "harmonics"}


def matched(kept, new, key):
    """The rows of both tables that have a partner, in one order."""
    rows = [{tuple(values): k for k, values in enumerate(zip(*(table[name] for name in key)))}
            for table in (kept, new)]
    common = sorted(rows[0].keys() & rows[1].keys())
    return [table.rows(np.array([row[one] for one in common], int))
            for table, row in zip((kept, new), rows)]


def show_times(kept, new, column):
    """Median CPU time over the kept one, kind by kind; the kinds must be the same."""
    if set(kept[column]) != set(new[column]):
        sys.exit(f"other {column}: {sorted(set(new[column]))}, kept {sorted(set(kept[column]))}")
    for kind in sorted(set(kept[column])):
        before, after = (np.median(table.where(column, kind)["cpu_s"]) for table in (kept, new))
        print(f"  {kind}: CPU {after / before:.2f} of the kept one")
    return True


def agree(kept, new, name):
    """Whether enough rows agree, in every compared column."""
    count = max(len(kept), len(new))
    if name in KEY:
        kept, new = matched(kept, new, KEY[name])
    if len(kept) != len(new):
        sys.exit(f"{len(new)} rows, kept {len(kept)}")
    rows = np.full(len(kept), True)
    for column in COLUMNS.get(name, kept.columns):
        try:
            before, after = (cells_as_numbers(table[column]) for table in (kept, new))
        except ValueError:  # words
            rows &= kept[column] == new[column]
            continue
        off = np.where(np.isnan(before) & np.isnan(after), 0, abs(before - after))
        rows &= off <= OF_LARGEST * np.nanmax(abs(before))
        print(f"  {column}: largest difference {np.nanmax(off):.3g}")
    print(f"  {rows.sum()} of {count} rows agree")
    return rows.sum() >= SHARE_OF_ROWS * count


def compare(file):
    kept_file = Path("data/reference") / file.relative_to("data/generated")
    print(f"{file} with {kept_file}:")
    kept, new = Table(kept_file), Table(file)
    if list(kept.columns) != list(new.columns):
        sys.exit("other columns")
    if file.stem in TIMED:
        return show_times(kept, new, TIMED[file.stem])
    return agree(kept, new, file.stem)


if __name__ == "__main__":
    sys.exit(0 if all([compare(Path(file)) for file in sys.argv[1:]]) else 1)
