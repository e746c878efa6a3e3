"""Realistic machines, drawn with a seed: every question is answered, and what the motion
after a start from rest is agrees with an integrator that shares no code with src
(truth/judge.cpp).

A motion that closes, or that two frequencies drive, is compared instant by instant, best
of the shifts by whole base periods; where that fails it must be continued, from its state
at t = 0, by the judge. A chaotic one is compared by mean and rms. A machine on which the
judge contradicts itself does not count. One row a machine; status 1 where less is
answered, decided or right than is asked.

Usage, from the root of the project: python3 -m tests.realistic [COUNT] [SEED]   (10 machines, seed 1)
"""
import os
import random
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

from tests.truth.independent import NAMES, POINTS, Model, displacements, errors, state_at_zero
from tests.machines import entries, realistic_machine, written
from tests.support.explore import EXPLORE, NO_NUMBER, Table

TOLERANCE = 1e-3  # to which a motion must be right where it prints a smaller error
FOLLOWED = 256    # base periods through which a printed state must be continued
THIN = 64         # instants of each that are compared then
LONGEST = 300     # of a command [s]
COLUMNS = ("name f status regime period judge judge_period judge_exponent agree "
           "difference allowed seconds note")


def ask(command, file, *options):
    """Status, output and seconds of a command; the status is 4 where it printed something
    that is no number, 5 where it did not end."""
    start = time.monotonic()
    try:
        result = subprocess.run([EXPLORE, command, file, *map(str, options)],
                                capture_output=True, text=True, timeout=LONGEST)
    except subprocess.TimeoutExpired:
        return 5, "", LONGEST
    status = 4 if NO_NUMBER.search(result.stdout) else result.returncode
    return status, result.stdout, time.monotonic() - start


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


def followed(file, frequency, rows, keys, model):
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
        turns = ["--periods", FOLLOWED, "--points", THIN]
        status, text, _ = ask("orbit", file, "--frequency", frequency, *turns)
        if status:
            return "no", np.inf, 1
        printed = displacements(Table.of(text))
    difference, most = worse(printed, judged.rows, keys)
    return ("yes" if difference <= most else "no"), difference, most


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


def answer(name, machine, frequency, folder):
    """What explore says by default, one question after the other."""
    file = Path(folder, f"{name}.toml")
    file.write_text(written(entries(machine, name)), encoding="utf-8")
    status, text, seconds = ask("orbit", file, "--frequency", frequency, "--points",
                                POINTS)
    keys, notes = Table.of(text).keys() if status == 0 else {}, []
    for command in ("contact", "spectrum"):
        other, printed, _ = ask(command, file, "--frequency", frequency)
        if other == 0 and Table.of(printed).keys().get("regime") != keys.get("regime"):
            notes.append(f"{command} has another regime")
        status = status or other
    return {"name": name, "file": file, "machine": machine, "f": frequency,
            "status": status, "keys": keys, "text": text,
            "seconds": seconds, "notes": notes}


def verdict(case):
    """The row of a machine."""
    model, keys, notes = Model(case["machine"], case["f"]), case["keys"], case["notes"]
    judged, regime = model.from_rest(), keys.get("regime", "-")
    agree, difference, most = "no", np.nan, np.nan
    if not model.two and abs(keys.get("base_period", 0) / model.base - 1) > 1e-9:
        notes.append("another base period")
    if regime == "undecided":
        agree = "undecided"
    elif regime in ("periodic", "quasi-periodic", "chaotic"):
        rows = displacements(Table.of(case["text"]))
        if regime != "chaotic":
            agree, difference, most = compared(rows, keys, judged)
        elif judged.kind == "chaotic":
            agree, difference, most = statistics_agree(keys, judged)
        if agree == "no":
            again = followed(case["file"], case["f"], rows, keys, model)
            if again[0] == "yes":
                agree, difference, most = again
                notes.append("another motion than the judge's from rest")
    if agree == "no" and judged.kind in (None, "undecided", "overflow"):
        agree = "uncounted"
    kind = judged.kind or "/".join(judged.kinds) + f" {judged.own:.0e}"
    values = [case["name"], case["f"], case["status"], regime, keys.get("period", "-"),
              kind, judged.period, f"{judged.exponents[0]:.3g}", agree,
              f"{difference:.3g}", f"{most:.3g}", f"{case['seconds']:.2f}",
              "; ".join(notes) or "-"]
    return dict(zip(COLUMNS.split(), values))


def response_complete(case):
    """Whether `response` has a finite row for every speed."""
    status, text, seconds = ask("response", case["file"], "--from", 10, "--to", 100,
                                "--count", 101)
    speeds = np.array(Table.of(text)["f"], float) if status == 0 else np.zeros(0)
    whole = len(speeds) == 101 and np.allclose(speeds, np.linspace(10, 100, 101))
    return whole, seconds


def main(number=10, seed=1):
    dice = random.Random(int(seed))
    drawn = [realistic_machine(dice) for _ in range(int(number))]
    print(*COLUMNS.split(), sep="\t")
    cores = os.cpu_count()
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(cores) as pool:
        cases = [answer(f"m{k:02}", *one, folder) for k, one in enumerate(drawn)]
        rows = []
        for row in pool.map(verdict, cases):
            rows.append(row)
            print(*(row[name] for name in COLUMNS.split()), sep="\t", flush=True)
        responses = [response_complete(case) for case in cases[::10]]
    count = len(rows)
    unanswered = sum(row["status"] != 0 for row in rows)
    undecided = sum(row["regime"] in ("undecided", "-") for row in rows)
    contradicted = sum(row["agree"] == "no" for row in rows)
    uncounted = sum(row["agree"] == "uncounted" for row in rows)
    incomplete = sum(not whole for whole, _ in responses)
    seconds = sorted(float(row["seconds"]) for row in rows)[count // 2]
    longest = max((seconds for _, seconds in responses), default=0)
    print(f"# {count} machines: {unanswered} not answered, {undecided} not decided, "
          f"{contradicted} contradicted, {uncounted} not counted, median {seconds} s; "
          f"{len(responses)} responses: {incomplete} not complete, "
          f"at most {longest:.1f} s")
    most = max(1, count // 40)
    return unanswered or undecided > 0.05 * count or contradicted > most or incomplete


if __name__ == "__main__":
    sys.exit(1 if main(*sys.argv[1:]) else 0)
