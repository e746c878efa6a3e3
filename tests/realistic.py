"""Realistic machines, drawn with a seed: every question is answered, and what the motion
after a start from rest is agrees with an integrator that shares no code with src
(truth/judge.cpp).

A motion that closes, or that two frequencies drive, is compared instant by instant, best
of the shifts by whole base periods; where that fails it must be continued, from its state
at t = 0, by the judge. A chaotic one is compared by mean and rms. A machine on which the
judge contradicts itself does not count. COUNT machines (10) of the seed SEED (1).
"""
import os
import random
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from tests.truth.independent import NAMES, POINTS, Model, displacements, errors, state_at_zero
from tests.machines import entries, realistic_machine, written
from tests.support.explore import NO_NUMBER, Case, Table

COUNT, SEED = (int(os.environ.get(name, usual)) for name, usual in (("COUNT", 10), ("SEED", 1)))
TOLERANCE = 1e-3  # to which a motion must be right where it prints a smaller error
FOLLOWED = 256    # base periods through which a printed state must be continued
THIN = 64         # instants of each that are compared then


def allowed(keys):
    return np.array([1.5 * max(TOLERANCE, keys.get(name, 0)) for name in ("error_largest", "error_rms")])


def turn_with(cage_angle, model):
    """A turn at whose start a ball stands nearest to this angle."""
    turns = np.arange(100_000) * model.turns
    return int(np.argmax(np.cos(model.n * (cage_angle - 2 * np.pi * model.c * turns))))


def worse(ours, theirs, keys):
    """The larger share of what is allowed, and the error that has it."""
    found, most = np.array(errors(ours, theirs)), allowed(keys)
    at = int(np.argmax(found / most))
    return found[at], most[at]


def compared(rows, keys, judged):
    """Yes or no, the difference and what is allowed, of a motion that closes or that two
    frequencies drive."""
    period = int(keys.get("period", 0)) if keys["regime"] == "periodic" else 0
    best, whole = (np.inf, 1), len(rows) == max(period, 1) * POINTS
    if whole and judged.kind == keys["regime"] and judged.period == period:
        for shift in range(max(period, 1)):
            part = judged.rows[shift * POINTS:][:len(rows)]
            best = min(best, worse(rows, part, keys), key=lambda pair: pair[0] / pair[1])
    return ("yes" if best[0] <= best[1] else "no"), *best


def statistics_agree(keys, judged):
    """Chaos: the share of the eight numbers, mean and rms of each displacement, that
    differ by more than 4 standard errors and 5 % of the largest rms. None should, one in
    20 may."""
    largest, wrong = judged.statistics[4:, 0].max(), []
    names = [f"{of}_{q}" for of in ("mean", "rms") for q in NAMES]
    for (theirs, their_error), name in zip(judged.statistics, names):
        error = np.hypot(their_error, keys.get(f"{name}_error", np.nan))
        # Not a number, where a key is missing, is wrong.
        right = abs(keys.get(name, np.nan) - theirs) <= max(4 * error, 0.05 * largest)
        wrong.append(not right)
    return ("yes" if np.mean(wrong) <= 0.05 else "no"), np.mean(wrong), 0.05


class Realistic(Case):
    def asked(self, command, file, frequency, *options):
        """What explore says by default."""
        result = self.run_explore(command, file, *(["--frequency", frequency] if frequency else []), *options, timeout=300)
        self.assertEqual((result.returncode, NO_NUMBER.search(result.stdout)), (0, None), (file, result.stderr))
        return Table.of(result.stdout)

    def followed(self, case, rows, keys, model):
        """The same where the judge starts from the printed state."""
        closed, chaotic = keys["regime"] == "periodic", keys["regime"] == "chaotic"
        first = turn_with(keys.get("cage_angle", 0), model) if chaotic else 0
        state = state_at_zero(rows, model.base * len(rows) / POINTS)
        if not closed:
            state[4:] = np.polynomial.polynomial.polyfit(np.arange(9), rows[:9], 8)[1] * POINTS / model.base
        judged = model.from_state(state, first, FOLLOWED, THIN)
        if judged.kind != keys["regime"]:
            return "no", np.inf, 1
        if chaotic:
            return statistics_agree(keys, judged)
        if closed:
            thin = rows[:: POINTS // THIN]
            printed = np.tile(thin, (FOLLOWED * THIN // len(thin) + 1, 1))[: FOLLOWED * THIN]
        else:
            printed = displacements(self.asked("orbit", *case, "--periods", FOLLOWED, "--points", THIN))
        difference, most = worse(printed, judged.rows, keys)
        return ("yes" if difference <= most else "no"), difference, most

    def verdict(self, case, machine):
        """Yes, no, undecided or uncounted, and by how much the motion is off and may be."""
        table, model = self.asked("orbit", *case, "--points", POINTS), Model(machine, case[1])
        keys, judged, found = table.keys(), model.from_rest(), ("no", np.inf, 1)
        regime = keys["regime"]
        for command in ("contact", "spectrum"):
            self.assertEqual(self.asked(command, *case).value("regime"), regime, case)
        if not model.two:
            self.assertAlmostEqual(keys["base_period"] / model.base, 1, delta=1e-9, msg=case)
        if regime == "undecided":
            return regime, 0, 0
        rows = displacements(table)
        if regime != "chaotic":
            found = compared(rows, keys, judged)
        elif judged.kind == "chaotic":
            found = statistics_agree(keys, judged)
        if found[0] == "no":
            found = min(found, self.followed(case, rows, keys, model), key=lambda one: one[0] == "no")
        uncounted = found[0] == "no" and judged.kind in (None, "undecided", "overflow")
        return ("uncounted", *found[1:]) if uncounted else found

    def test_machines(self):
        dice = random.Random(SEED)
        drawn = [realistic_machine(dice) for _ in range(COUNT)]
        cases = [(self.file(f"m{k:02}.toml", written(entries(machine))), speed) for k, (machine, speed) in enumerate(drawn)]
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            ends = list(pool.map(lambda k: self.verdict(cases[k], drawn[k][0]), range(COUNT)))
        count = {word: sum(end[0] == word for end in ends) for word in ("undecided", "no", "uncounted")}
        print(COUNT, "machines:", count)
        self.assertLessEqual(count["undecided"], 0.05 * COUNT, ends)
        self.assertLessEqual(count["no"], max(1, COUNT // 40), ends)
        self.assertLessEqual(count["uncounted"], 0.2 * COUNT, ends)
        for file, _ in cases[::10]:
            speeds = self.asked("response", file, None, "--from", 10, "--to", 100, "--count", 101)["f"]
            np.testing.assert_allclose(speeds, np.linspace(10, 100, 101))
