"""Hard cases: what each method does where it may fail.

Beside the paper, which reports no failure. A method is trusted for what it does when it cannot succeed. The list collects cases
that are likely to break one: no clearance, hardly any damping, a single ball, no gravity, grazing contact, bodies of very unequal
mass, a cage whose balls never return to where they were, too few samples, speeds on a fold or at the resonance of the contact.

Each case ends in one of two ways: an answer that an independent check confirms, or a refusal with its reason. A wrong answer that
claims success is the only failure, and would be drawn in orange. Filled circles are periodic motions that were confirmed, open
ones aperiodic motions; a dash is a refusal. Harmonic balance and shooting must refuse where no periodic motion exists;
time integration can still answer there, so it has fewer dashes without being the better method for that. An answer that could
be neither confirmed nor refuted is marked as such and not counted as solved.

The methods are those of `explore orbit`. An answer is claimed where it states an error of at most the accuracy of the scene.
The check of a periodic motion shares no code with the library: the judge of the tests (tests/truth/judge.cpp) integrates Eq. 7
over the period from the state that the answer has at its beginning, and corrects it by Newton's method until it closes. What is
not periodic, or what the judge does not close, is compared with an integration by GSL, rk8pd.

Usage: studies/hard_cases.py data/scenes/hard_cases.toml [--every N] > hard_cases.tsv   (from the project's root, with build/tests/judge)
"""
import copy
import math
import multiprocessing
import os
import sys
import tempfile
import tomllib
from pathlib import Path

import numpy as np

sys.path[1:1] = [str(Path(__file__).parents[1] / folder) for folder in ("figures", "tests/truth")]
import rotor_stator  # noqa: E402
from independent import Model, displacements, state_at_zero  # noqa: E402
from tables import print_columns, print_header  # noqa: E402

os.environ.setdefault("EXPLORE", str(Path(os.environ.get("BUILD", "build"), "explore")))
POINTS = 256           # instants of a base period
METHODS = ["auto", "aft", "aft-tolerance", "shooting"]
COLUMNS = [
    ("case", "-", "group of the list, varied value, speed"),
    ("method", "-", "auto: what the machine does from rest; aft: harmonic balance with m and N of the case, or to a tolerance; shooting"),
    ("status", "-", "0 an answer is claimed, 3 refused"),
    ("check_error", "-", "of displacement, by the check; of its rms about the mean if aperiodic; -1 none"),
    ("verdict", "-", "solved, refused, silent error or unconfirmed"), ("f", "Hz", "speed"),
    ("harmonics", "-", "m of harmonic balance; -1 none"), ("samples", "-", "N of harmonic balance; -1 none"),
    ("stated_error", "-", "of displacement, as the answer says; -1 none"),
    ("multiplier", "-", "largest modulus of the Floquet multipliers; -1 none"),
    ("multiplier_uncertainty", "-", "of it, as the answer says; -1 none"),
    ("check_multiplier", "-", "largest modulus on the motion that the check found; -1 none"),
    ("stability", "-", "stable, unstable, undecided; - where nothing is claimed"),
    ("regime", "-", "T-periodic, also after several T, or aperiodic; - where nothing is claimed"),
    ("check", "-", "what checked it"), ("note", "-", "the reason of the refusal")]


# The cases

def change(machine, key, value):
    """Sets a key of the machine; stator_ and rotor_ name the body."""
    for body in ("stator", "rotor"):
        if key.startswith(body):
            machine[body][key.removeprefix(body + "_")] = value
            return
    table = {"unbalance_kg_m": "rotor", "acceleration_m_per_s2": "gravity"}.get(key, "bearing")
    machine[table][key] = int(value) if key == "balls" else value


def write(machine, folder):
    path = Path(folder, "machine.toml")
    path.write_text('title = "hard"\n' + "".join(
        f"[{name}]\n" + "".join(f"{key} = {value!r}\n" for key, value in table.items())
        for name, table in machine.items() if isinstance(table, dict)), encoding="utf-8")
    return path


def solution(harmonics, samples):
    """The options of a solution by harmonic balance."""
    return ["--harmonics", str(harmonics), *([] if samples is None else ["--samples", str(samples)])]


def first_fold(machine, speeds, harmonics, samples):
    """The first speed at which the branch turns back."""
    with tempfile.TemporaryDirectory() as folder:
        f = rotor_stator.attempt("response", write(machine, folder), *solution(harmonics, samples), from_=speeds[0], to=speeds[1],
                                 columns="f")["f"]
    turns = np.flatnonzero(np.diff(f) < 0)
    if not len(turns):
        sys.exit(f"no fold from {speeds[0]} to {speeds[1]} Hz")
    return f[turns[0]]


def cases_of(scene):
    """Name, machine, speed, m and N of each case; N is None where it is explore's own."""
    base = tomllib.loads(Path("data", scene["parameters"] + ".toml").read_text(encoding="utf-8"))
    cases = []
    for group in scene["group"]:
        for value in group.get("values", [None]):
            machine, name, m = copy.deepcopy(base), group["name"], group["harmonics"]
            changes = dict(group.get("machine", {}))
            if value is not None:
                name += f": {value:g}"
                changes[group["vary"]] = value
            m = int(changes.pop("harmonics", m))
            for key, to in changes.items():
                change(machine, key, to)
            samples = 2 * m + 1 if group.get("samples_per_harmonic") == 0 else None
            speeds = group.get("frequencies_hz", [])
            if group.get("at") == "fold":
                speeds = [first_fold(machine, speeds, m, samples)]
            if group.get("at") == "contact resonance":
                speeds = [contact_speed(Model(machine, 1)) / (2 * math.pi) / divisor for divisor in group["divisors"]]
            for f in speeds:
                if group.get("graze"):
                    machine["bearing"]["radial_clearance_m"] = free_displacement(Model(machine, f))
                cases.append((f"{name}, {f:.6g} Hz", copy.deepcopy(machine), float(f), m, samples))
    return cases


def contact_speed(model):
    """The vibration [rad/s] of both bodies against one ball that bears all loads."""
    load = -sum(y for _, y in model.loads) + model.unbalance * sum(model.k) / sum(model.m)
    slope = 1.5 * model.k_h ** (2 / 3) * max(load, model.k_h * 1e-9**1.5) ** (1 / 3)
    return math.sqrt(slope * sum(1 / m for m in model.m))


def free_displacement(model):
    """The largest relative displacement [m] without contact."""
    omega = 2 * math.pi * model.frequency
    whirl = model.unbalance * omega**2 / (model.k[1] - model.m[1] * omega**2 + 1j * model.d[1] * omega)
    below, sag = (load[1] / k for load, k in zip(model.loads, model.k))
    return abs(whirl * np.exp(2j * np.pi * np.arange(1 << 14) / (1 << 14)) + 1j * (sag - below)).max()


# The check

def difference(a, b):
    """Of two motions, over the largest displacement; 0 at rest."""
    largest = abs(b).max()
    return abs(a - b).max() / largest if largest > 1e-15 else float(abs(a).max() > 1e-15)


class Case:
    """One machine at one speed, and what explore says of it."""

    def __init__(self, case, rule, folder):
        self.name, self.machine, self.f, self.m, self.samples = case
        self.rule, self.file = rule, write(self.machine, folder)

    def orbit(self, *words, points=POINTS):
        """Status, table and the reason of a refusal."""
        try:
            return rotor_stator.run("orbit", self.file, *words, frequency=self.f, points=points), ""
        except (rotor_stator.NoAnswer, ValueError) as refused:
            return None, str(refused).replace(f"{self.file}: ", "")

    def words(self, method):
        return {"auto": [], "aft": solution(self.m, self.samples),
                "aft-tolerance": ["--method", "aft", "--tolerance", self.rule["accuracy"]],
                "shooting": ["--method", "shooting"]}[method]

    def row(self, method):
        table, reason = self.orbit(*self.words(method))
        if method == "auto" and table is not None and table.value("period", 0) > 1:  # the whole motion
            table, reason = self.orbit(*self.words(method), "--periods", round(table.value("period")))
        row = {name: -1 for name, *_ in COLUMNS} | {
            "case": self.name, "method": method, "status": 3, "f": self.f, "stability": "-", "regime": "-", "check": "none",
            "note": reason}
        if table is not None:
            self.answer(table, row)
        if row["status"] == 0:
            self.check(table, method, row)
        row["verdict"] = verdict(row, self.rule)
        return row

    def answer(self, table, row):
        """What is claimed, or why not."""
        closed = "multiplier" in table.keys()
        regime = "periodic" if closed else table.value("regime", "undecided")  # of the motion, not of what follows it
        stated = max(table.value(f"{name}_largest", -1) for name in ("error", "distance"))
        row |= {"harmonics": table.value("harmonics", -1), "samples": table.value("samples", -1)}
        needs_error = regime != "chaotic" or table.value("method") == "aft"
        if regime == "undecided" or stated > self.rule["accuracy"] or stated < 0 and needs_error:
            row["note"] = f"the motion is {regime}, and the error stated {stated:.2g}" if stated >= 0 else \
                f"the motion is {regime}, and no error is stated"
            return
        row |= {"status": 0, "stated_error": stated, "multiplier": table.value("multiplier", -1), "note": "-",
                "multiplier_uncertainty": table.value("multiplier_uncertainty", -1),
                "stability": table.value("stability", "undecided"),
                "regime": "T-periodic" if regime in ("periodic", "rest") else "aperiodic"}

    def check(self, table, method, row):
        """By the judge, or by another integration."""
        model, answer = Model(self.machine, self.f), displacements(table)
        passed = table.value("cage_angle", 0) * model.n / (2 * math.pi)  # balls by phase 0
        if row["regime"] == "T-periodic" and table.value("regime", "") != "rest" and abs(passed - round(passed)) < 1e-9:
            model.base = len(answer) / POINTS * table.value("base_period")
            model.turns = model.base * self.f
            for number, start in enumerate(self.starts(method, answer)):
                if found := model.closed(state_at_zero(start, model.base)):
                    multiplier, state = found
                    motion = model.judged(model.settle(state, 0, 0, 1, 1, len(answer))).rows
                    seen = {"check": "judge", "check_error": difference(answer, motion), "check_multiplier": multiplier}
                    is_solved = verdict(row | seen, self.rule) == "solved"
                    if is_solved or number == 0:  # other methods' motions may confirm, no more
                        row |= seen
                    if is_solved:
                        return
            if row["check"] != "none" or row["stability"] != "stable":  # integration leaves what is unstable
                return
        self.compare(table, method, row)

    def starts(self, method, answer):
        """Motions from which the judge looks for that of an answer: itself, and what other methods find."""
        yield answer
        for other in ("shooting", "auto"):
            table, _ = self.orbit(*self.words(other)) if other != method else (None, "")
            if table is not None and len(table) == len(answer):
                yield displacements(table)

    def compare(self, table, method, row):
        periodic = row["regime"] == "T-periodic"
        words = [] if periodic else ["--periods", 256]
        exact, _ = self.orbit("--method", "rk8pd", *words)
        if not periodic:
            table, _ = self.orbit(*self.words(method), *words)
        if exact is None or table is None:
            return
        a, b = displacements(table), displacements(exact)
        if not periodic:
            a, b = (q.std(axis=0) for q in (a, b))
        regime, found = exact.value("regime", "undecided"), row | {"check": "rk8pd"}
        if a.shape != b.shape or regime != "undecided" and periodic != (regime in ("periodic", "rest")):
            return
        found["check_error"] = difference(a, b)
        if regime != "undecided" or verdict(found, self.rule) == "solved":  # what has not settled may confirm, no more
            row |= found


def verdict(row, rule):
    """What the rule makes of the numbers of a row."""
    error, multiplier, margin = row["check_error"], row["check_multiplier"], 1e-3
    if row["status"] == 3:
        return "refused"
    if row["check"] == "none" or error < 0:
        return "unconfirmed"
    stated = max(row["stated_error"], rule["least_error"])
    is_right = error <= min(rule["most_error"], rule["most_error_ratio"] * stated)
    growth = multiplier if multiplier >= 0 else row["multiplier"]
    if row["regime"] == "T-periodic" and not is_right and stated * growth > rule["most_error"]:
        return "unconfirmed"  # the stated error grows to that in a period: the judge leaves for another motion
    if row["regime"] == "aperiodic":
        return "solved" if error <= rule["most_change"] else "silent error"
    if multiplier >= 0 and (row["stability"] == "stable" and multiplier > 1 + margin
                            or row["stability"] == "unstable" and multiplier < 1 - margin):
        return "silent error"
    return "solved" if is_right else "silent error"


def rows_of(work):
    """The rows of a case, by all methods."""
    case, rule = work
    with tempfile.TemporaryDirectory() as folder:
        one = Case(case, rule, folder)
        return [one.row(method) for method in METHODS]


def main(file, every=1):
    scene = tomllib.loads(Path(file).read_text(encoding="utf-8"))
    cases = cases_of(scene)[::every]
    with multiprocessing.Pool() as pool:
        rows = sum(pool.imap(rows_of, [(case, scene) for case in cases]), [])
    example = rotor_stator.run("orbit", f"data/{scene['parameters']}.toml", frequency=45, points=1)
    ends = [("method", [method, *(sum(row["method"] == method and row["verdict"] == end for row in rows)
                                  for end in ("solved", "refused", "silent error", "unconfirmed"))]) for method in METHODS]
    print_header("How each method ends on the hard cases", [example],
                 f"rule: claimed when the stated error is at most {scene['accuracy']:g}; false when the check finds more than "
                 f"{scene['most_error_ratio']:g} times it (and {scene['least_error']:g}), or more than {scene['most_error']:g}",
                 "row method: name, cases solved, refused, silent errors, unconfirmed", rows=ends, cases=len(cases))
    print_columns(COLUMNS)
    for row in rows:
        print("\t".join(f"{value:.6g}" if isinstance(value, float) else str(value) for value in (row[name] for name, *_ in COLUMNS)))


if __name__ == "__main__":
    main(sys.argv[1], *(int(sys.argv[k + 1]) for k, word in enumerate(sys.argv) if word == "--every"))
