"""The verdicts of explore against a judge that shares no code with src: its own equations, integrator, shooting and
multipliers (judge.cpp). It first reproduces published multipliers.

Usage: tests/truth/verdicts.py   (from the project's root)
"""
import math
import os
import re
import subprocess
import sys
import tomllib
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))
from support.explore import Case  # noqa: E402

JUDGE = Path(os.environ.get("BUILD", "build"), "tests", "judge").resolve()
SETS = {number: Path(f"data/set{number}.toml").resolve() for number in (1, 2)}
SAME, NEAR_ONE = 0.05, 0.002  # of the largest displacement; of the modulus
# Where six harmonics are right about themselves and wrong about the machine, and some where they are right.
SPEEDS = {1: [1.03, 6.18, 10.3, 15.45, 19.57, 20, 24.72, 25.75, 30.9, 40.17, 50.47, 53.9, 54],
          2: [21.63, 22.66, 27.81, 31.93, 40.17, 45.32, 49.44, 53.56, 57.68]}


class Judge:
    """The program judge, one case after the other."""

    def __init__(self):
        self.process = subprocess.Popen([JUDGE], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def __call__(self, *words):
        self.process.stdin.write(" ".join(str(word) for word in words) + "\n")
        self.process.stdin.flush()
        converged, closure, modulus, change, real, imaginary, *state = map(float, self.process.stdout.readline().split())
        return {"converged": converged == 1, "multiplier": complex(real, imaginary), "change": change,
                "state": np.array(state)}

    def machine(self, file, frequency, state):
        p = tomllib.loads(file.read_text(encoding="utf-8"))
        stator, rotor, bearing = p["stator"], p["rotor"], p["bearing"]
        bodies = [body[key] for body in (stator, rotor)
                  for key in ("mass_kg", "natural_frequency_rad_per_s", "damping_ratio")]
        return self("machine", *bodies, rotor["unbalance_kg_m"], bearing["balls"],
                    bearing["contact_stiffness_N_per_m1p5"], bearing["radial_clearance_m"],
                    bearing["cage_speed_ratio"], p["gravity"]["acceleration_m_per_s2"], frequency, 1, *state)

    def close(self):
        self.process.stdin.close()
        self.process.stdout.close()
        self.process.wait()


def settled_springs(omega, periods=80, steps=400):
    """Two masses with a unilateral spring, by RK4 from rest: q_1, q_2 and their rates at phase 0."""
    def rate(t, y):
        return np.array([y[2], y[3],
                         -(y[0] - y[1]) - 0.03 * (y[2] - y[3]) - 100 * max(0, y[0] - 1),
                         y[0] - 2 * y[1] + 0.03 * (y[2] - 2 * y[3]) + 0.1 * math.cos(omega * t)])
    y, h = np.zeros(4), 2 * math.pi / omega / steps
    for k in range(periods * steps):
        t = k * h
        a = rate(t, y)
        b = rate(t + h / 2, y + h / 2 * a)
        c = rate(t + h / 2, y + h / 2 * b)
        y = y + h / 6 * (a + 2 * b + 2 * c + rate(t + h, y + h * c))
    return y


class Verdicts(Case):
    def setUp(self):
        super().setUp()
        self.judge = Judge()
        self.addCleanup(self.judge.close)

    def test_the_judge_finds_published_multipliers(self):
        state = settled_springs(0.635)
        found = {}
        for omega in (0.635, 0.65, 0.675, 0.7, 0.725, 0.75, 0.635, 0.62, 0.6):
            if omega in found:
                state = found[omega]["state"]
            found[omega] = self.judge("springs", omega, 1, *state)
            self.assertTrue(found[omega]["converged"], omega)
            state = found[omega]["state"]
        # Published along 81 harmonics, which move this one most.
        self.assertAlmostEqual(found[0.75]["multiplier"].real, -1.197, delta=0.02)
        self.assertAlmostEqual(abs(found[0.7]["multiplier"]), 0.858, delta=0.002)
        self.assertAlmostEqual(abs(found[0.635]["multiplier"]), 0.886, delta=0.002)
        self.assertAlmostEqual(found[0.6]["multiplier"].real, -0.266, delta=0.003)
        self.assertAlmostEqual(abs(found[0.6]["multiplier"].imag), 1.363, delta=0.003)

    def orbit(self, file, frequency, *options):
        """The verdict, the state at phase 0 of the solution and the largest displacement."""
        result = self.run_explore("orbit", file, "--frequency", frequency, "--points", 512, *options)
        if result.returncode == 3:
            self.skipTest(result.stderr)
        lines = result.stdout.splitlines()
        word = next(re.search(r"stability: (\w+)", line)[1] for line in lines if line.startswith("# stability"))
        rows = np.array([line.split("\t") for line in lines if line[0] in "-.0123456789"], float)[:, 1:5]
        spectrum = np.fft.rfft(rows, axis=0)
        orders = np.arange(len(spectrum))[:, None]
        rates = np.fft.irfft(2j * math.pi * frequency * orders * spectrum, axis=0)
        return word, np.concatenate([rows[0], rates[0]]), abs(rows).max()

    def test_no_verdict_is_false(self):
        for number, speeds in SPEEDS.items():
            decided = judged = 0
            for frequency in speeds:
                for options in ([], ["--tolerance", "1e-3"]):
                    with self.subTest(set=number, frequency=frequency, options=options):
                        word, state, size = self.orbit(SETS[number], frequency, *options)
                        truth = self.judge.machine(SETS[number], frequency, state)
                        modulus = abs(truth["multiplier"])
                        moved = abs(truth["state"] - state)[:4].max() / size
                        if not truth["converged"] or moved > SAME or abs(modulus - 1) < NEAR_ONE:
                            continue
                        judged += 1
                        decided += word != "undecided"
                        if word != "undecided":
                            self.assertEqual(word, "stable" if modulus < 1 else "unstable", modulus)
            self.assertGreaterEqual(judged, len(speeds))
            self.assertGreaterEqual(decided, 0.95 * judged)

    def test_what_six_harmonics_hid(self):
        for frequency, word, regime in [(20, "unstable", "periodic 2"), (54, "unstable", "periodic 2"),
                                        (13.4, "undecided", "aperiodic"), (45, "stable", "periodic")]:
            lines = self.lines("orbit", self.machine, "--frequency", frequency, "--points", 4)
            self.assertIn(f"# regime: {regime}", lines)
            self.assertTrue(any(line.startswith(f"# stability: {word};") for line in lines), lines)

    def test_an_inaccurate_picture_is_said_to_be_one(self):
        lines = self.lines("orbit", SETS[1], "--frequency", 1, "--points", 4)
        self.assertTrue(any(line.startswith("# stability: stable;") for line in lines))
        self.assertTrue(any(line.startswith("# warning: the solution is not accurate") for line in lines))

    def test_a_coarse_step_decides_nothing(self):
        for options in (["rk4", "--step", "1e-3"], ["rk4"], ["rk8pd"]):
            lines = self.lines("orbit", self.machine, "--frequency", 54, "--method", *options)
            regime = next(line for line in lines if line.startswith("# regime"))
            self.assertTrue(regime.startswith("# regime: undecided" if len(options) > 1 else "# regime: periodic 2"),
                            (options, regime))


if __name__ == "__main__":
    unittest.main()
