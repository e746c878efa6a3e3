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

# The columns that are compared, where not all are.
COLUMNS = {"validity": ["found", "distance", "periodic"],
           "identification": ["reading", "set", "m_s", "m_r", "f_loss", "f", "periodic", "turns", "amp_x_r"],
           "large": ["n", "r"],
           "clearance_speed": ["frequency", "bearing.radial_clearance_m", "period", "contact_share"],
           "map_scaling": ["kind", "count", "points"],
           "verdicts": ["set", "f", "m", "found", "machine_stable", "distance", "series_stable"],
           "hard_cases": ["case", "method", "status", "verdict", "regime"]}
# Where the number of rows at a place may be another one: what is compared there is the set of the words that this column
# holds, from the least that is decided on.
KINDS = {"attractors": (["set", "f"], "period", -1), "stability": (["curve", "f"], "stable", 0)}
# The column of the kinds whose CPU times are shown.
TIMED = {"tab02_equal_error": "method", "work_precision": "method", "cost_growth": "harmonics",
         "tab03_answers": "method"}


def words_at(table, keys, column, least):
    """Those of the column at each place, in no order. The places are values of the keys, speeds of a branch by 1 Hz."""
    places = {}
    for *place, value in zip(*(np.round(table[key]) if key == "f" and "arc" in table.columns else table[key] for key in keys),
                             table[column]):
        places.setdefault(tuple(place), set()).update({value} if value >= least else {})
    return places


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
    if name in KINDS:
        before, after = (words_at(table, *KINDS[name]) for table in (kept, new))
        same = sum(before[place] == after.get(place) for place in before)
        print(f"  {KINDS[name][1]}: the same at {same} of {len(before | after)} places")
        return same >= SHARE_OF_ROWS * len(before | after)
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
    print(f"  {rows.sum()} of {len(rows)} rows agree")
    return rows.sum() >= SHARE_OF_ROWS * len(rows)


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
