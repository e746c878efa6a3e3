"""Random points of the kept maps against the judge (judge.cpp), which shares no code with src.

Clearance against speed: the judge integrates from rest, beside a neighbour, for 6 s and then 10 s, and says after how many turns
the motion closes or, where it does not, how fast the neighbours part. Clearance against stiffness: the judge closes the
motion of one turn from the orbit of six harmonics or, where it finds none, integrates from there; the distance of the orbit from
that motion, rms about the mean, stands against that of the map, the motion's amplitude at the speed of the peak against the peak.

Usage: python3 -m tests.truth.maps COUNT > data/reference/map_checks.tsv   (from the project's root)
"""
import random
import re
import sys
import tomllib
from pathlib import Path

import numpy as np

from tests.truth.independent import Model, displacements, errors, state_at_zero
from tests.support.explore import MACHINE, SIX, Case, Table
from project import source_line
from tables import cells_as_numbers, print_columns

KEPT = Path("data/reference").resolve()
INSTANTS, SAME = 64, 0.05  # of a turn; of the largest displacement
COLUMNS = [("map", "-", "1 clearance and speed, 2 clearance and stiffness"), ("x", "Hz or m", "speed, or clearance"),
           ("y", "m or N/m^1.5", "clearance, or contact stiffness"),
           ("value", "-", "1: period K, 0 aperiodic, below 0 not decided; 2: error of six harmonics"),
           ("judge", "-", "the same by the judge; 1: -2 where its exponent is within three errors of zero"),
           ("second", "-", "1: share of time with contact; 2: peak of x_r [m]"), ("judge_second", "-", "the same by the judge"),
           ("agrees", "-", "1 if both do; 2 if the judge's is another of several motions there; -1 where either has no result")]


class Point:
    """A machine at a point of a map, asked of explore and of the judge."""

    def __init__(self, case, changes):
        text = re.sub(r"(?m)^(\w+) = .*", lambda line: f"{line[1]} = {changes.get(line[1], line[0].split(' = ', 1)[1])}", MACHINE)
        self.file, self.case, self.machine = case.file("point.toml", text), case, tomllib.loads(text)

    def settled(self, frequency, state, transient, observed):
        """Period, exponent, its error, the turns after the transient as instants x 4."""
        answer = Model(self.machine, frequency).settle(state, 0, transient, observed, min(32, observed), INSTANTS, 1e-8)
        return int(answer[0]), answer[[1, 3]].mean(), np.hypot(answer[2], answer[4]) / 2, answer[21:].reshape(-1, 4)

    def touches(self, q, frequency):
        """Whether any ball is pressed, at each instant."""
        model = Model(self.machine, frequency)
        angle = 2 * np.pi * (np.arange(model.n) / model.n + model.c * np.arange(len(q))[:, None] / INSTANTS)
        u = q[:, 2:] - q[:, :2]
        return (np.cos(angle) * u[:, :1] + np.sin(angle) * u[:, 1:] > model.delta).any(axis=1)

    def periods_near(self, frequency):
        """K of all motions that explore finds from several starts, where there is more than one."""
        asked = ["attractors", self.file, "--from", frequency, "--to", frequency + 0.01, "--count", 2, "--starts", 8]
        periods = self.case.table(*asked)["period"]
        return list(periods) if len(set(periods)) > 1 else []

    def error_alone(self, frequency):
        """What explore says of this point without the neighbour that the map starts from; NaN if nothing."""
        asked = ["map", self.file, "--x", f"frequency={frequency}:{frequency}:1", "--quantity", "error", *SIX, "--quiet"]
        return cells_as_numbers(Table.of(self.case.run_explore(*asked).stdout)["error"])[0]

    def motion_near(self, frequency):
        """The solution of six harmonics, and the judge's motion beside it: of one turn, or what comes of it. None without one."""
        result = self.case.run_explore("orbit", self.file, "--frequency", frequency, *SIX, "--no-stability", "--points", INSTANTS)
        if result.returncode:
            return None
        q = displacements(Table.of(result.stdout))
        state = state_at_zero(q, 1 / frequency)
        closed = Model(self.machine, frequency).closed(state)
        if closed and abs(closed[1] - state)[:4].max() < SAME * abs(q).max():
            return q, self.settled(frequency, closed[1], 0, 1)[3]
        return q, self.settled(frequency, state, int(6 * frequency), 48)[3]


def check_speed(point, row):
    frequency = row["frequency"]
    rest = Model(point.machine, frequency).rest(0)
    has_result = row["status"] == "ok"
    found, share = (float(row[name]) for name in ("period", "contact_share")) if has_result else (-2, -1)
    for seconds in (6, 60):  # a difference that alternates slowly closes after two turns before it closes after one
        period, exponent, error, q = point.settled(frequency, rest, int(seconds * frequency) + 20, max(int(10 * frequency), 60))
        if period == 0 and exponent < 3 * error:
            period = -2
        contact = float(point.touches(q, frequency).mean())
        same = found == period and abs(contact - share) < (0.02 if period > 0 else 0.1)
        if same:
            break
    if found < 0 or period == -2:
        same = -1
    elif not same and period in point.periods_near(frequency):
        same = 2
    return found, period, share, contact, same


def check_stiffness(point, row):
    here, there = point.motion_near(30.0), point.motion_near(row["peak_frequency"])
    if here is None or row["error"] == "-":
        return -1, -1 if here is None else 0, -1, -1, -1
    q, true = here
    error = errors(np.tile(q, (len(true) // INSTANTS, 1)), true)[1]
    peak = -1 if there is None else float(np.ptp(there[1][:, 2]) / 2)
    value = float(row["error"])
    if peak > 0 and abs(peak / row["peak"] - 1) > 0.03:
        return value, error, row["peak"], peak, 0

    def same(said):
        return abs(said - error) < 0.2 * error + 1e-4
    return value, error, row["peak"], peak, 1 if same(value) else 2 if same(point.error_alone(30)) else 0


MAPS = {"clearance_speed": ({"radial_clearance_m": "bearing.radial_clearance_m"}, check_speed),
        "stiffness_border": ({"radial_clearance_m": "bearing.radial_clearance_m",
                              "contact_stiffness_N_per_m1p5": "bearing.contact_stiffness_N_per_m1p5"}, check_stiffness)}


class Maps(Case):
    def checked(self, count, seed=2004):
        """Rows of COLUMNS: `count` random points of each map."""
        for number, (name, (keys, check)) in enumerate(MAPS.items(), 1):
            table = Table(KEPT / f"{name}.tsv")
            names = list(table.columns)
            for k in sorted(random.Random(seed).sample(range(len(table)), count)):
                row = {column: table[column][k] for column in names}
                point = Point(self, {key: float(row[column]) for key, column in keys.items()})
                yield [number, row[names[0]], row[names[1]], *check(point, row)]

    def test_random_points(self):
        """Would catch a map of another machine, periods counted wrongly, and errors that are not errors."""
        rows = list(self.checked(4, seed=7))
        self.assertLessEqual(sum(row[-1] == 0 for row in rows), 1, rows)
        self.assertGreaterEqual(sum(row[-1] == 1 for row in rows), 5)

    def test_kept_checks(self):
        table = Table(KEPT / "map_checks.tsv")
        for number in (1, 2):
            agrees = table.where("map", number)["agrees"]
            self.assertEqual(len(agrees), 200)
            self.assertLessEqual((agrees == -1).sum(), 10)
            self.assertGreaterEqual((agrees > 0).sum(), 0.95 * (agrees >= 0).sum())


if __name__ == "__main__":
    print("# Random points of the kept maps against an independent judge", source_line(), sep="\n")
    print_columns(COLUMNS)
    case = Maps()
    case.setUp()
    for row in case.checked(int(sys.argv[1])):
        print("\t".join(f"{float(cell):.12g}" for cell in row), flush=True)
