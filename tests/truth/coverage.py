"""The error that `--tolerance` promises, on random machines: what harmonic balance prints must be within the tolerance of a
motion of Eq. 7 itself, which shooting closes (one frequency) or which integration follows for at least 100 turns (two).
A distance from another motion, or a solution that has not converged, would show.

30 machines, with FULL in the environment 100, or COUNT.
"""
import math
import os
import random

from tests.machines import entries, random_machine, written
from tests.support.explore import FULL, Case, Table, some

TOLERANCES = [1e-2, 1e-3, 1e-4]
COUNT = int(os.environ.get("COUNT", 100 if FULL else 30))


def drawn(seed):
    """A machine, half of them with two frequencies, and a speed [Hz]."""
    dice = random.Random(seed)
    machine = random_machine(dice)
    if dice.random() < 0.5:
        machine["bearing"]["cage_speed_ratio"] = round(dice.uniform(0.36, 0.46), 4)
    return machine, round(dice.uniform(18, 140), 3)


def distance(table):
    """Of the solution from the machine's motion: the larger of the two errors, or None where none was found. A motion that
    the verdict refuses as another one, because it is far away for the estimated error, counts: the estimate may be wrong."""
    return table.error("distance") if table.error("distance") >= 0 else table.value("distance_refused", None)


# Their errors, estimated from every second sample, came out too small (seeds 10000 to 16999): all samples and half of them put an
# order that matters in the same place, or neither reaches a resonance of the contact.
BEYOND = [10078, 10234, 11048, 11123, 11177, 12502, 12650, 12883, 13196, 14449, 14628, 15038, 15508, 16464, 16501, 16892, 16913]
# Another motion, 1.7 to 3.5 % away, was judged in place of the solution's own:
OTHER = [11274, 11652, 13419]
# From rest they are chaotic, so that no lines are known; the unstable torus beside it is found with --harmonics.
CHAOTIC = [11720, 12623]


class Coverage(Case):
    def answer_of(self, seed):
        machine, speed = drawn(seed)
        tolerance = TOLERANCES[seed % 3]
        result = self.run_explore("orbit", self.file("random.toml", written(entries(machine))), "--frequency", speed,
                                  "--points", 2, "--method", "aft", "--tolerance", tolerance)
        return tolerance, result

    def test_machines_that_were_wrong_once(self):
        for seed in some([*BEYOND, *OTHER, *CHAOTIC], 3):
            with self.subTest(seed=seed):
                tolerance, result = self.answer_of(seed)
                if seed in CHAOTIC:
                    self.assertEqual(result.returncode, 3)
                    self.assertIn("the motion from rest is chaotic", result.stderr)
                    continue
                self.assertEqual(result.returncode, 0, result.stderr)
                table = Table.of(result.stdout)
                if seed in BEYOND:
                    self.assertLessEqual(distance(table), tolerance)
                elif table.value("distance_rms", None) is None:
                    self.assertEqual(table.value("stability"), "undecided")
                else:
                    for norm in ("largest", "rms"):
                        self.assertLessEqual(table.value(f"distance_{norm}"), max(1e-3, 3 * table.value(f"error_{norm}")))

    def test_at_least_99_per_cent(self):
        beyond, judged, unanswered = [], 0, 0
        for seed in range(COUNT):
            tolerance, result = self.answer_of(seed)
            self.assertIn(result.returncode, (0, 3), result.stderr)
            if result.returncode == 3:
                self.assertRegex(result.stderr, "not reached at .* Hz: ")
                unanswered += 1
                continue
            table = Table.of(result.stdout)
            off = distance(table)
            leaves = table.value("base") == "two" and table.value("stability") == "unstable"
            if off is None or leaves or table.value("regime") == "undecided" and off > 0.05:
                continue  # the header says that nothing is known, or that the machine leaves a torus, unstable or not
            judged += 1
            if not off <= tolerance * (1 + 0.1):  # two digits are printed
                beyond.append((seed, tolerance, off))
        print(f"{COUNT} machines: {unanswered} without an answer, {judged} judged, beyond the tolerance: {beyond}")
        self.assertGreater(judged, 0.6 * COUNT)
        self.assertLessEqual(len(beyond), math.floor(0.01 * COUNT))
