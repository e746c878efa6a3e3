"""In which intervals of speed a stable T-periodic motion exists, with what m it is reached, what is elsewhere.

Usage: figures/truth_intervals.py ATTRACTORS.tsv VALIDITY.tsv > truth_intervals.tsv
"""
import sys
import tomllib
from pathlib import Path

import numpy as np
from project import source_line
from tables import Table, print_columns

WORDS = {-2: "undecided", -1: "quasi-periodic", 0: "chaotic", 1: "T"}
LIMIT = min(tomllib.loads(Path("data/claims.toml").read_text(encoding="utf-8"))
            ["regimes"]["distance_limits"])
COLUMNS = [
    ("set", "-", "data set"), ("from", "Hz", "first speed"), ("to", "Hz", "last speed"),
    ("speeds", "-", "in the raster of the attractors"),
    ("T_periodic", "-", "1 only T-periodic attractors, 0.5 beside others, 0 none"),
    ("found", "-", "what there is: number of speeds with each kind"),
    ("m", "-", f"smallest m within {100 * LIMIT:g} % of a T-periodic attractor at all speeds of the raster "
     "of the validity map, by a sweep up; 0 if none, -1 without such speeds or a T-periodic attractor"),
    ("m_all", "-", "smallest m from which on that holds; 0, -1 likewise"),
    ("adaptive", "-", "share of these speeds with an adaptive solution that close; -1 without speeds"),
    ("adaptive_m", "-", "its largest m; 0 if none")]


def kinds_at(rows):
    """The kinds of the attractors at a speed."""
    return sorted({WORDS.get(period, f"{period}T") for period in rows["period"].astype(int)})


def intervals_of(rows):
    """(T_periodic, speeds, kinds of each) of neighbouring speeds of one sort."""
    intervals = []
    for f in np.unique(rows["f"]):
        kinds = kinds_at(rows.where("f", f))
        sort = 0.0 if "T" not in kinds else 1.0 if kinds == ["T"] else 0.5
        if not intervals or intervals[-1][0] != sort:
            intervals.append((sort, [], []))
        intervals[-1][1].append(f)
        intervals[-1][2].append(kinds)
    return intervals


def close(rows):
    """Where a solution is within the limit of a T-periodic attractor."""
    return (rows["found"] == 1) & (rows["nearest_periodic"] == 1) & (rows["distance"] <= LIMIT)


def harmonics_for(rows):
    """Smallest m that is close at all speeds, and smallest from which on all are."""
    fixed = rows.where("adaptive", 0)
    if len(fixed) == 0 or (fixed["periodic"] == 0).any():  # where validity knows no such attractor it tries few m
        return -1, -1
    reached = {m: close(fixed.where("m", m)).all() for m in np.unique(fixed["m"]).astype(int)}
    first = next((m for m in reached if reached[m]), 0)
    missed = max((m for m in reached if not reached[m]), default=0)
    return first, missed + 1 if missed < max(reached) else 0


def adaptive_for(rows):
    """Share of the speeds where the adaptive solution is close, and its largest m there."""
    chosen = rows.where("adaptive", 1)
    if len(chosen) == 0 or (rows["periodic"] == 0).any():
        return -1, 0
    near = close(chosen)
    return near.mean(), int(chosen["m"][near].max(initial=0))


def row(number, interval, validity):
    """The cells of one interval."""
    sort, speeds, kinds = interval
    names = sorted({kind for here in kinds for kind in here}, key=lambda k: (k != "T", k))
    words = ", ".join(f"{name} {sum(name in here for here in kinds)}" for name in names)
    rows = validity.where("set", number)
    rows = rows.rows((rows["f"] >= speeds[0]) & (rows["f"] <= speeds[-1]))
    m = harmonics_for(rows) if sort > 0 else (-1, -1)
    adaptive = adaptive_for(rows) if sort > 0 else (-1, 0)
    return [number, speeds[0], speeds[-1], len(speeds), sort, words, *m, *adaptive]


def main(attractors_file, validity_file):
    attractors, validity = Table(attractors_file), Table(validity_file)
    print("# Intervals of speed with and without a stable T-periodic motion")
    print(source_line())
    print(f"# modelled: nothing; {attractors_file} and {validity_file}")
    print_columns(COLUMNS)
    for number in np.unique(attractors["set"]).astype(int):
        for interval in intervals_of(attractors.where("set", number)):
            print("\t".join(f"{cell:.12g}" if not isinstance(cell, str) else cell
                            for cell in row(number, interval, validity)))


if __name__ == "__main__":
    main(*sys.argv[1:])
