"""Compares a table that `make all` has written with its golden copy, or renews the copy.

A golden table freezes behaviour and proves nothing: what is right is tested in unit/. It holds every n-th
row of the table, and in its header how to compare them:

    # every: 29                         row of the table
    # key: panel source t_over_T        the columns that name a row
    # agreeing: 0.98 where set = 2      share of such rows that must agree; of all others, each
    # tolerance: x_s 1e-6 1e-10         relative, absolute; columns without one are not compared
    # aperiodic: x_s 0.1 0.15           of the mean in deviations, of the deviation relative
    # statistics: 4 x_s MEAN DEVIATION  of panel (or data set) 4

Integrated aperiodic motions (periodic = 0) differ from machine to machine in every digit. All rows of
such a panel are compared together, by the mean and the standard deviation of each column.

Usage: tests/golden.py check|renew NAME   (from the project's root, after `make all`)
"""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "figures"))
from tables import Table  # noqa: E402

GENERATED, GOLDEN = Path("data/generated"), Path("tests/golden")


class Rules:
    """What the header of a golden table says."""

    def __init__(self, header):
        said = [line[1:].split() for line in header.splitlines()]
        self.lines = [line for line in header.splitlines() if not line.startswith("# statistics:")]
        self.every = next(int(words[1]) for words in said if words[0] == "every:")
        self.key = next(words[1:] for words in said if words[0] == "key:")
        self.tolerances, self.aperiodic = (
            {words[1]: (float(words[2]), float(words[3])) for words in said if words[0] == name}
            for name in ("tolerance:", "aperiodic:"))
        self.statistics = {(float(words[1]), words[2]): (float(words[3]), float(words[4]))
                           for words in said if words[0] == "statistics:"}
        share = next((words for words in said if words[0] == "agreeing:"), None)
        self.share, self.where = (float(share[1]), (share[3], float(share[5]))) if share else (1, None)


def is_aperiodic(table):
    """Which rows are of an integrated motion that is not periodic."""
    if "periodic" not in table.columns:
        return np.zeros(len(table), bool)
    integrated = table["source"] == 2 if "source" in table.columns else True
    return (table["periodic"] != 1) & integrated


def statistics(table, columns):
    """Mean and standard deviation of the aperiodic rows of each panel, which the first column names."""
    aperiodic = table.rows(is_aperiodic(table))
    panel = next(iter(table.columns))
    return {(group, name): (values.mean(), values.std())
            for group in sorted(set(aperiodic[panel])) for name in columns
            for values in [aperiodic.where(panel, group)[name]]}


def differing_statistics(rules, table):
    """Where the statistics of aperiodic panels are others than the golden ones."""
    found = statistics(table, rules.aperiodic)
    if found.keys() != rules.statistics.keys():
        yield f"aperiodic panels {sorted({group for group, _ in found})}"
    for key in found.keys() & rules.statistics.keys():
        (mean, deviation), (expected_mean, expected_deviation) = found[key], rules.statistics[key]
        of_mean, of_deviation = rules.aperiodic[key[1]]
        if (abs(mean - expected_mean) > of_mean * expected_deviation
                or abs(deviation - expected_deviation) > of_deviation * expected_deviation):
            yield (f"aperiodic panel {key[0]:g}, {key[1]}: mean {mean:g}, deviation {deviation:g}; "
                   f"golden {expected_mean:g}, {expected_deviation:g}")


def differing_rows(rules, golden, table):
    """The rows that do not agree, if they are more than may disagree."""
    names = list(zip(*(table[name] for name in rules.key)))
    place = {name: k for k, name in enumerate(names)}
    periodic = golden.rows(~is_aperiodic(golden))
    sensitive = (periodic[rules.where[0]] == rules.where[1] if rules.where
                 else np.zeros(len(periodic), bool))
    wrong = []
    for k, name in enumerate(zip(*(periodic[name] for name in rules.key))):
        row = place.get(name)
        if row is None or not all(
                abs(table[column][row] - periodic[column][k])
                <= absolute + relative * abs(periodic[column][k])
                for column, (relative, absolute) in rules.tolerances.items()):
            wrong.append((sensitive[k], f"{'missing' if row is None else 'differs'}: "
                          + ", ".join(f"{key} {value}" for key, value in zip(rules.key, name))))
    tolerated = sum(odd for odd, _ in wrong) <= (1 - rules.share) * sensitive.sum()
    yield from (what for odd, what in wrong if not (odd and tolerated))


def check(name):
    golden, table = Table(GOLDEN / f"{name}.tsv"), Table(GENERATED / f"{name}.tsv")
    rules = Rules(golden.header)
    if list(table.columns) != list(golden.columns):
        sys.exit(f"{name}: columns {', '.join(table.columns)}; golden {', '.join(golden.columns)}")
    if len(golden) != -(-len(table) // rules.every):
        sys.exit(f"{name}: {len(table)} rows; golden {len(golden)}, every {rules.every}")
    faults = [*differing_rows(rules, golden, table), *differing_statistics(rules, table)]
    for fault in faults[:20]:
        print(f"{name}: {fault}", file=sys.stderr)
    print(f"{name}: {len(golden)} rows, {len(rules.statistics)} statistics, {len(faults)} differ")
    return 1 if faults else 0


def renew(name):
    """Takes the rows anew; the rules stay."""
    table, golden = Table(GENERATED / f"{name}.tsv"), GOLDEN / f"{name}.tsv"
    rules = Rules("\n".join(line for line in golden.read_text(encoding="utf-8").splitlines()
                            if line.startswith("#")))
    lines = [line for line in (GENERATED / f"{name}.tsv").read_text(encoding="utf-8").splitlines()
             if line and not line.startswith("#")]
    found = [f"# statistics: {group:g} {column} {mean:.6g} {deviation:.6g}"
             for (group, column), (mean, deviation) in statistics(table, rules.aperiodic).items()]
    golden.write_text("\n".join(rules.lines + found + lines[:1] + lines[1::rules.every]) + "\n",
                      encoding="utf-8")
    return 0


def main(action, name):
    for file in (GOLDEN / f"{name}.tsv", GENERATED / f"{name}.tsv"):
        if not file.exists():
            sys.exit(f"{file}: no such table" + "; make all writes it" * (file.parent == GENERATED))
    return {"check": check, "renew": renew}[action](name)


if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] not in ("check", "renew"):
        sys.exit("usage: tests/golden.py check|renew NAME")
    sys.exit(main(*sys.argv[1:]))
