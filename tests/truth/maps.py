"""Random points of the kept maps against the judge (judge.cpp), which shares no code with src.

Clearance against speed: the judge integrates from rest, beside a neighbour, for 6 s and then 10 s, and says after how many turns
the motion closes or, where it does not, how fast the neighbours part. Clearance against stiffness: the judge closes the
motion of one turn from the orbit of six harmonics or, where it finds none, integrates from there; the distance of the orbit from
that motion, rms about the mean, stands against that of the map, the motion's amplitude at the speed of the peak against the peak.

Usage: tests/truth/maps.py [COUNT > data/reference/map_checks.tsv]   (from the project's root; without COUNT a test of a few)
"""
import os
import random
import subprocess
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path

import numpy as np
from scipy.optimize import root

sys.path.insert(0, str(Path(__file__).parents[1]))
from support.explore import EXPLORE, MACHINE, Table  # noqa: E402

sys.path.insert(1, str(Path(__file__).parents[2] / "figures"))
from project import source_line  # noqa: E402
from tables import cells_as_numbers, print_columns  # noqa: E402

JUDGE = Path(os.environ.get("BUILD", "build"), "tests", "judge").resolve()
KEPT = Path("data/reference").resolve()
INSTANTS, SAME = 64, 0.05  # of a turn; of the largest displacement
NAMES = ["x_s", "y_s", "x_r", "y_r"]
COLUMNS = [("map", "-", "1 clearance and speed, 2 clearance and stiffness"), ("x", "Hz or m", "speed, or clearance"),
           ("y", "m or N/m^1.5", "clearance, or contact stiffness"),
           ("value", "-", "1: period K, 0 aperiodic, below 0 not decided; 2: error of six harmonics"),
           ("judge", "-", "the same by the judge; 1: -2 where its exponent is within three errors of zero"),
           ("second", "-", "1: share of time with contact; 2: peak of x_r [m]"), ("judge_second", "-", "the same by the judge"),
           ("agrees", "-", "1 if both do; 2 if the judge's is another of several motions there; -1 where the map has no result")]


class Judged:
    """A machine, its parameters changed, before the judge."""

    def __init__(self, judge, folder, changes):
        text = MACHINE
        for old, new in changes.items():
            line = next(line for line in text.splitlines() if line.startswith(old))
            text = text.replace(line, f"{old} = {new!r}")
        self.file = Path(folder, "point.toml")
        self.file.write_text(text, encoding="utf-8")
        self.judge, self.p = judge, tomllib.loads(text)

    def words(self, frequency):
        bodies = [self.p[body][key] for body in ("stator", "rotor")
                  for key in ("mass_kg", "natural_frequency_rad_per_s", "damping_ratio")]
        bearing = [self.p["bearing"][key] for key in ("balls", "contact_stiffness_N_per_m1p5", "radial_clearance_m",
                                                      "cage_speed_ratio")]
        return [*bodies, self.p["rotor"]["unbalance_kg_m"], *bearing, self.p["gravity"]["acceleration_m_per_s2"], frequency, 1]

    def ask(self, *words):
        self.judge.stdin.write(" ".join(str(word) for word in words) + "\n")
        self.judge.stdin.flush()
        return np.array(self.judge.stdout.readline().split(), float)

    def settled(self, frequency, state, transient, observed):
        """Period, exponent, its error, the last turns as instants x 4."""
        kept = min(32, transient + observed)
        answer = self.ask("settle", 0, transient, observed, transient + observed - kept, kept, INSTANTS, 1e-8,
                          "machine", *self.words(frequency), *state)
        return int(answer[0]), answer[[1, 3]].mean(), np.hypot(answer[2], answer[4]) / 2, answer[21:].reshape(-1, 4)

    def deflections(self, q, frequency):
        """Of each ball at each instant [m], negative without contact."""
        bearing = self.p["bearing"]
        instants = np.arange(len(q))[:, None] / INSTANTS
        angle = 2 * np.pi * (np.arange(bearing["balls"]) / bearing["balls"] + bearing["cage_speed_ratio"] * instants)
        u = q[:, 2:] - q[:, :2]
        return np.cos(angle) * u[:, :1] + np.sin(angle) * u[:, 1:] - bearing["radial_clearance_m"]

    def at_rest(self):
        """The state in which ball 1 at angle 0 and the others hold the weights."""
        g, k_h = self.p["gravity"]["acceleration_m_per_s2"], self.p["bearing"]["contact_stiffness_N_per_m1p5"]
        mass, spring = ([self.p[body]["mass_kg"] * self.p[body]["natural_frequency_rad_per_s"] ** power
                         for body in ("stator", "rotor")] for power in (0, 2))
        angle = 2 * np.pi * np.arange(self.p["bearing"]["balls"]) / self.p["bearing"]["balls"]

        def forces(q):
            q = 1e-4 * q
            load = k_h * np.maximum(0, self.deflections(q[None], 1)[0]) ** 1.5
            f = np.array([load @ np.cos(angle), load @ np.sin(angle)])
            weight = np.array([0, g])
            return np.concatenate([f - spring[0] * q[:2] - mass[0] * weight, -f - spring[1] * q[2:] - mass[1] * weight])

        sag = -1e4 * sum(mass) * g / sum(spring)
        start = [0, sag, 0, sag - 1.2e4 * self.p["bearing"]["radial_clearance_m"] - 0.1]
        return np.concatenate([1e-4 * root(forces, start, tol=1e-12).x, np.zeros(4)])

    def periods_near(self, frequency):
        """K of all motions that explore finds from several starts, where there is more than one."""
        result = subprocess.run([EXPLORE, "attractors", self.file, "--from", repr(frequency), "--to", repr(frequency + 0.01),
                                 "--count", "2", "--starts", "8"], capture_output=True, encoding="utf-8", check=True)
        periods = Table.of(result.stdout)["period"]
        return list(periods) if len(set(periods)) > 1 else []

    def orbit(self, frequency):
        """The solution of six harmonics, instants x 4, and its state at phase 0; None where there is none."""
        result = subprocess.run([EXPLORE, "orbit", self.file, "--frequency", repr(frequency), "--harmonics", "6",
                                 "--no-stability", "--points", str(INSTANTS)], capture_output=True, encoding="utf-8")
        if result.returncode:
            return None
        table = Table.of(result.stdout)
        q = np.stack([table[name] for name in NAMES], axis=1)
        orders = np.arange(INSTANTS // 2 + 1)[:, None]
        rates = np.fft.irfft(2j * np.pi * frequency * orders * np.fft.rfft(q, axis=0), axis=0)
        return q, np.concatenate([q[0], rates[0]])

    def error_alone(self, frequency):
        """What explore says of this point without the neighbour that the map starts from; NaN if nothing."""
        result = subprocess.run([EXPLORE, "map", self.file, "--x", f"frequency={frequency!r}:{frequency!r}:1", "--quantity",
                                 "error", "--harmonics", "6", "--quiet"], capture_output=True, encoding="utf-8", check=True)
        return cells_as_numbers(Table.of(result.stdout)["error"])[0]

    def motion_near(self, frequency):
        """The orbit, and the judge's motion beside it: of one turn, or what comes of the orbit."""
        found = self.orbit(frequency)
        if found is None:
            return None
        q, state = found
        answer = self.ask("machine", *self.words(frequency), *state)
        if answer[0] == 1 and abs(answer[6:10] - state[:4]).max() < SAME * abs(q).max():
            return q, self.settled(frequency, answer[6:], 0, 1)[3]
        return q, self.settled(frequency, state, int(6 * frequency), 48)[3]


def rms(q):
    return np.linalg.norm(q - q.mean(axis=0))


def check_speed(judged, row):
    frequency = row["frequency"]
    period, exponent, error, q = judged.settled(frequency, judged.at_rest(), int(6 * frequency) + 20,
                                                max(int(10 * frequency), 60))
    if period == 0 and exponent < 3 * error:
        period = -2
    contact = float((judged.deflections(q, frequency) > 0).any(axis=1).mean())
    if row["status"] != "ok":
        return -2, period, -1, contact, -1
    row = {name: float(row[name]) for name in ("period", "contact_share")}
    same = row["period"] == period and abs(contact - row["contact_share"]) < (0.02 if period > 0 else 0.1)
    if row["period"] < 0:
        same = -1
    elif not same and period in judged.periods_near(frequency):
        same = 2
    return row["period"], period, row["contact_share"], contact, same


def check_stiffness(judged, row):
    here, there = judged.motion_near(30.0), judged.motion_near(row["peak_frequency"])
    if here is None or row["error"] == "-":
        return -1, -1 if here is None else 0, -1, -1, -1
    q, true = here
    error = rms(np.tile(q, (len(true) // INSTANTS, 1)) - true) / rms(true)
    peak = -1 if there is None else float(np.ptp(there[1][:, 2]) / 2)
    value = float(row["error"])

    def same(said):
        return abs(said - error) < 0.2 * error + 1e-4

    if peak > 0 and abs(peak / row["peak"] - 1) > 0.03:
        return value, error, row["peak"], peak, 0
    return value, error, row["peak"], peak, 1 if same(value) else 2 if same(judged.error_alone(30.0)) else 0


MAPS = {"clearance_speed": ({"radial_clearance_m": "bearing.radial_clearance_m"}, check_speed),
        "stiffness_border": ({"radial_clearance_m": "bearing.radial_clearance_m",
                              "contact_stiffness_N_per_m1p5": "bearing.contact_stiffness_N_per_m1p5"}, check_stiffness)}


def checked(count, seed=2004):
    """Rows of COLUMNS: `count` random points of each map."""
    judge = subprocess.Popen([JUDGE], stdin=subprocess.PIPE, stdout=subprocess.PIPE, encoding="utf-8")
    with tempfile.TemporaryDirectory() as folder:
        for number, (name, (keys, check)) in enumerate(MAPS.items(), 1):
            table = Table(KEPT / f"{name}.tsv")
            names = list(table.columns)
            for k in sorted(random.Random(seed).sample(range(len(table)), count)):
                row = {column: table[column][k] for column in names}
                judged = Judged(judge, folder, {key: float(row[column]) for key, column in keys.items()})
                yield [number, row[names[0]], row[names[1]], *check(judged, row)]
    judge.stdin.close()
    judge.wait()


class Maps(unittest.TestCase):
    def test_random_points(self):
        """Would catch a map of another machine, periods counted wrongly, and errors that are not errors."""
        rows = list(checked(4, seed=7))
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
    if len(sys.argv) > 1 and sys.argv[1].isdigit():
        print("# Random points of the kept maps against an independent judge", source_line(), sep="\n")
        print_columns(COLUMNS)
        for row in checked(int(sys.argv[1])):
            print("\t".join(f"{float(cell):.12g}" for cell in row), flush=True)
    else:
        unittest.main()
