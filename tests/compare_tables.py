"""Compares a table of a long study with the kept one.

Numbers agree within 2 % of the column's largest size: speeds in a raster of 1 Hz and shares of 60 speeds
move by more than rounding where a motion is aperiodic, so 97 % of the rows must agree, not all.

Usage: tests/compare_tables.py KEPT.tsv NEW.tsv
"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "figures"))
from tables import Table  # noqa: E402

SHARE_OF_ROWS = 0.97
OF_LARGEST = 0.02


def main(kept_file, new_file):
    kept, new = Table(kept_file), Table(new_file)
    if list(kept.columns) != list(new.columns):
        sys.exit(f"{new_file}: other columns than {kept_file}")
    first = next(iter(kept.columns))
    if kept[first].size != new[first].size:
        sys.exit(f"{new_file}: {new[first].size} rows, {kept_file} has {kept[first].size}")
    agrees = abs(kept[first] - new[first]) >= 0
    for name in kept.columns:
        if kept[name].dtype.kind == "U":
            agrees &= kept[name] == new[name]
            continue
        off = abs(kept[name] - new[name])
        agrees &= off <= OF_LARGEST * abs(kept[name]).max()
        print(f"{name}: largest difference {off.max():.3g}")
    print(f"{agrees.sum()} of {agrees.size} rows agree")
    return 0 if agrees.mean() >= SHARE_OF_ROWS else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
