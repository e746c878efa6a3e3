"""Compares a table of cost with the kept one.

CPU times are those of a machine, so they are shown, not judged: the median ratio of new to kept per
method (or kind). What must agree is what was measured: the columns, and the methods and ranges.

Usage: tests/compare_costs.py KEPT.tsv NEW.tsv
"""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "figures"))
from tables import Table  # noqa: E402


def medians(table, name):
    """Median CPU time of the rows of each kind."""
    return {kind: np.median(table.where(name, kind)["cpu_s"]) for kind in sorted(set(table[name]))}


def main(kept_file, new_file):
    if not Path(kept_file).exists():
        print(f"{kept_file}: nothing kept yet; make adopt keeps it")
        return 0
    kept, new = Table(kept_file), Table(new_file)
    if list(kept.columns) != list(new.columns):
        sys.exit(f"{new_file}: other columns than {kept_file}")
    name = "method" if "method" in kept.columns else "against"
    before, after = medians(kept, name), medians(new, name)
    if list(before) != list(after):
        sys.exit(f"{new_file}: {name} {', '.join(after)}; {kept_file} has {', '.join(before)}")
    for kind in before:
        print(f"{Path(new_file).stem}, {kind}: CPU {after[kind] / before[kind]:.2f} of the kept one")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
