"""How far the printed error of harmonic balance is from the true one, on machines drawn at random.

A solution to a tolerance says its error: the largest difference over the largest displacement, and the rms about the mean. Here
the motion of Eq. 7 comes from the judge (judge.cpp), which shares no code with src. Of one frequency the judge closes it from the
solution's state and, where that is farther away than is printed, from the motion that shooting finds; the nearer one counts; of two, it integrates from the
solution's state for so many turns that its error has done its work, where the solution is stable, and the last of them are
compared. Machines: like those that are built, with one frequency; in bearings of the catalogue; the same with a spall of the
outer race, of the inner race.

Usage: python3 -m tests.truth.printed_error COUNT > data/reference/printed_error.tsv   (from the project's root; COUNT of each kind)
"""
import random
import sys
import tomllib

import numpy as np

from tests.truth.independent import KEPT, NAMES, Model, displacements, errors, state_at_zero
from tests.machines import entries, random_machine, realistic_machine, written
from tests.support.explore import FULL, Case, Table, some
from project import source_line
from tables import print_columns

KINDS = ["one frequency", "catalogue", "outer spall", "inner spall"]
TOLERANCES = {0: [1e-2, 1e-3, 1e-4], 1: [1e-2, 1e-3], 2: [1e-2, 1e-3], 3: [1e-2, 1e-3]}  # of each kind
POINTS, FINE, COARSE, TURNS = 512, 4096, 64, 1000  # instants of a period; with two frequencies, of a turn, and turns
ANOTHER = 0.05  # of the largest displacement: the judge closed another motion
COLUMNS = [("kind", "-", "0 one frequency, 1 bearing of the catalogue, 2 spall of the outer race, 3 of the inner race"),
           ("seed", "-", "of the machine"), ("f", "Hz", "speed of rotation"), ("tolerance", "-", "asked for"),
           ("frequencies", "-", "of the solution; 0 without one"), ("printed", "-", "largest error over the largest displacement"),
           ("true", "-", "the same by the judge; -1 where it closes nothing near, or the solution is not stable"),
           ("printed_rms", "-", "rms error about the mean"), ("true_rms", "-", "the same by the judge; -1")]


def drawn(kind, seed):
    """A machine and a speed [Hz]."""
    dice = random.Random(f"{kind} {seed}")
    if kind == 0:
        return random_machine(dice), round(dice.uniform(18, 140), 3)
    machine, speed = realistic_machine(dice)
    if kind > 1:
        machine["bearing.defect"] = {"surface": ["outer_race", "inner_race"][kind - 2], "depth_m": round(dice.uniform(1e-6, 5e-6), 9),
                                     "width_rad": round(dice.uniform(0.08, 0.3), 4)}
    return machine, speed


def closed_from(model, rows):
    """The judge's motion of one base period, at as many instants, from the state of a motion at phase 0; None where it closes none."""
    found = model.closed(state_at_zero(rows, model.base))
    return None if found is None else model.settle(found[1], 0, 0, KEPT, 1, POINTS)[21:].reshape(-1, 4)


class PrintedError(Case):
    def row(self, kind, seed):
        machine, speed = drawn(kind, seed)
        tolerance = TOLERANCES[kind][seed % len(TOLERANCES[kind])]
        text = written(entries(machine))
        asked = ["orbit", self.file("drawn.toml", text), "--frequency", repr(speed), "--method", "aft", "--tolerance", tolerance]
        result = self.run_explore(*asked, "--points", 2)
        cells = [kind, seed, speed, tolerance]
        if result.returncode:
            return [*cells, 0, -1, -1, -1, -1]
        table = Table.of(result.stdout)
        two = table.value("base") == "two"
        cells += [2 if two else 1, table.value("error_largest", -1)]
        rms = table.value("error_rms", -1)
        if two and table.value("stability") != "stable":
            return [*cells, -1, rms, -1]
        model = Model(tomllib.loads(text), speed)
        if two:
            rates = [f"v_{name}" for name in NAMES]
            first, orbit = (Table.of(self.run_explore(*asked, "--points", points, "--periods", turns, "--no-stability", "--columns",
                                                      ",".join(names)).stdout)
                            for points, turns, names in ((FINE, 1, [*NAMES, *rates]), (COARSE, TURNS, NAMES)))
            state = np.array([first[name][0] for name in (*NAMES, *rates)])
            answer = model.settle(state, 0, TURNS - KEPT, KEPT, KEPT, COARSE)
            pairs = [(displacements(orbit)[-KEPT * COARSE:], answer[21:].reshape(-1, 4))]
        else:
            orbit = displacements(Table.of(self.run_explore(*asked, "--points", POINTS, "--no-stability").stdout))
            truth = closed_from(model, orbit)
            pairs = [] if truth is None else [(orbit, truth)]
            if truth is None or errors(orbit, truth)[0] > 1.05 * cells[-1]:  # perhaps another motion
                beside = self.run_explore(*asked[:4], "--method", "shooting", "--points", POINTS, "--no-stability", "--budget", 2e7)
                truth = None if beside.returncode else closed_from(model, displacements(Table.of(beside.stdout)))
                pairs += [] if truth is None else [(orbit, truth)]
        largest, its_rms = min((errors(*pair) for pair in pairs), default=(ANOTHER, 0))
        return [*cells, largest, rms, its_rms] if largest < ANOTHER else [*cells, -1, rms, -1]

    def test_a_few(self):
        """Would catch an estimate from as many harmonics as the solution has, which was 20 times too small for spalls of the inner race."""
        rows = [self.row(kind, seed) for kind in range(len(KINDS)) for seed in some(range(3, 7), 2)]
        judged = [row for row in rows if row[6] > 0]
        self.assertGreater(len(judged), 6 if FULL else 3)
        for row in judged:
            self.assertLess(max(row[6] / row[5], row[8] / row[7]), 2, row)

    def test_kept(self):
        """Of all kinds some, and hardly any error is half as large again as is printed."""
        table = Table("data/reference/printed_error.tsv")
        judged = table.rows(table["true"] > 0)
        self.assertEqual(set(judged["kind"]), set(range(len(KINDS))))
        beyond = np.maximum(judged["true"] / judged["printed"], judged["true_rms"] / judged["printed_rms"]) > 1.5
        self.assertLessEqual(beyond.mean(), 0.02)


if __name__ == "__main__":
    print("# Printed and true errors of harmonic balance, on machines drawn at random", source_line(), sep="\n")
    print("# note: machines of each kind, seeds from 1; true: against the motion of an independent integrator")
    print_columns(COLUMNS)
    case = PrintedError()
    for seed in range(1, int(sys.argv[1]) + 1):
        for kind in range(len(KINDS)):
            case.setUp()
            print("\t".join(f"{cell:.6g}" for cell in case.row(kind, seed)), flush=True)
            case.doCleanups()
