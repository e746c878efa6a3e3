"""Speed against error for questions of users: this project, SciPy, SUNDIALS, RK4 alone.

Usage: OMP_NUM_THREADS=1 /usr/bin/python3 peers/tab03_answers.py SCENE.toml > TABLE.tsv
       with letters of questions after the scene only these

Of each question some rows are drawn once. The other methods compute these, from rest
through a transient, and their cost is scaled to all rows; this project computes all rows.
The errors are those of the drawn rows. A setting is chosen on as many other rows, drawn
apart from them: the shortest transient, then the loosest tolerance with which enough rows
have the right kind and stay below the target.
"""

import shlex
import subprocess
import sys
import time
import tomllib
from statistics import median

import numpy as np
import scipy
from answers import Reading, Row, changed_file, read, reference
from explore import ROOT, Table, child_seconds
from integrators import Broken
from peers_table import cell, sundials_version
from tables import cells_as_numbers

COLUMNS = (
    ("question", "-", "letter of the question, see the list of questions"),
    ("method", "-", "this: command of this project; this-balance: by harmonic balance"),
    ("target", "-", "error that is asked for"),
    ("cpu_s", "s", "CPU time, median, scaled from the computed rows to all"),
    ("wall_s", "s", "the same of the clock, one thread"),
    ("error", "-", "median relative error of the rotor's horizontal amplitude"),
    ("evaluations", "-", "of Eq. 7, all rows, Jacobians included"),
    ("error_largest", "-", "largest of these errors"),
    ("within", "-", "rows whose error is below the target"),
    ("compared", "-", "rows whose motion closes or contracts, and that have a value"),
    ("kinds", "-", "drawn rows whose kind is the reference's; - where none is told"),
    ("drawn", "-", "rows whose error and kind are looked at"),
    ("computed", "-", "rows that were computed"),
    ("rows", "-", "rows of the question"),
    ("integrator", "-", "what integrates"),
    ("accuracy", "-", "relative tolerance; of rk4 the step [s]; - where none is given"),
    ("transient", "s", "before the recorded periods; - where the program chooses it"),
    ("repetitions", "-", "of the timed run"),
)


def spaced(span):
    return np.linspace(span["from"], span["to"], span["count"])


class Asked:
    """A question with its rows, the drawn ones and their references."""

    def __init__(self, question, scene):
        self.question, self.scene, self.name = question, scene, question["name"]
        self.file, self.seen = changed_file(self.name, question), {}
        self.speeds = spaced(question["speeds_hz"])
        clearances = question.get("clearances_m", {"from": 0, "to": 0, "count": 1})
        self.clearances = spaced(clearances)
        self.starts = question.get("starts", 1)
        shape = (len(self.clearances), len(self.speeds), self.starts)
        self.count = int(np.prod(shape))
        random = np.random.default_rng(scene["seed"])
        drawn = random.choice(self.count, 2 * scene["computed_rows"], replace=False)
        rows = [self.row(*np.unravel_index(k, shape)) for k in drawn]
        self.truth = {row: reference(row, scene) for row in rows}
        self.drawn, self.tried = rows[:len(rows) // 2], rows[len(rows) // 2:]
        self.references = [self.truth[row] for row in self.drawn]

    def row(self, line, column, start):
        clearance, file = self.clearances[line], self.file
        if clearance:
            file = changed_file(f"{self.name}-{line}", self.question, clearance)
        return Row(file, float(self.speeds[column]), float(clearance), int(start))

    def fewer(self, rows, method):
        """Those of the rows that a method computes."""
        return rows[:self.scene["fewer_rows"].get(method, len(rows))]


def errors_of(readings, references):
    """Relative errors of the rows that are compared; a missing reading has none."""
    return np.array([abs(found.amplitude / true.amplitude - 1)
                     for found, true in zip(readings, references) if true.kind and found])


def spent_by(run):
    """The result of a run, its CPU and its wall time, its child processes included."""
    began, clock = time.process_time() + child_seconds(), time.perf_counter()
    result = run()
    wall = time.perf_counter() - clock
    return result, time.process_time() + child_seconds() - began, wall


def reading_of(row, setting, scene):
    """None where the method breaks down."""
    try:
        return read(row, *setting, scene["closed"], scene)
    except Broken:
        return None


def readings_of(asked, rows, setting):
    """Readings of rows with their CPU and wall times, computed once for each setting."""
    for row in rows:
        if (row, setting) not in asked.seen:
            one = spent_by(lambda: reading_of(row, setting, asked.scene))
            asked.seen[row, setting] = one
    return zip(*(asked.seen[row, setting] for row in rows))


def enough(asked, rows, setting, bound):
    """Whether a share of the rows that are compared has the kind of the reference, where
    one is told, and an error below the bound; and the CPU time of all."""
    found, cpu, _ = readings_of(asked, rows, setting)
    pairs = [(one, asked.truth[row]) for one, row in zip(found, rows)
             if asked.truth[row].kind]
    right = sum(one is not None and one.kind in (None, true.kind) and
                abs(one.amplitude / true.amplitude - 1) <= bound for one, true in pairs)
    return right >= asked.scene["share"] * len(pairs), sum(cpu)


def transient_for(asked, target):
    """The shortest transient that leaves half of the target; else the longest."""
    search = asked.scene["search"]
    for transient in search["transients_s"]:
        setting = search["method"], search["accuracy"], transient
        if enough(asked, asked.tried, setting, target / 2)[0]:
            break
    return transient


def setting_for(asked, rows, integrators, transient, target):
    """The cheapest integrator with its loosest accuracy that is enough; else the tightest
    one of the first integrator."""
    found = []
    for integrator, accuracies in integrators.items():
        for accuracy in accuracies:
            setting = integrator, accuracy, transient
            reached, seconds = enough(asked, rows, setting, target)
            if reached:
                found.append((seconds, integrator, accuracy))
                break
    if found:
        return min(found)[1:]
    integrator, accuracies = next(iter(integrators.items()))
    return integrator, accuracies[-1]


def timed(run, scene, first=None):
    """The result of a run, medians of its CPU and wall time, and the repetitions; `first`
    is a run that has been made."""
    runs = [first or spent_by(run)]
    while len(runs) < scene["repetitions"] and runs[0][2] < scene["slow_s"]:
        runs.append(spent_by(run))
    _, cpu, wall = zip(*runs)
    return runs[0][0], median(cpu), median(wall), len(runs)


def table_row(asked, method, target, readings, **more):
    """One row of the table."""
    errors = errors_of(readings, asked.references)
    told = [(found.kind, true.kind) for found, true in zip(readings, asked.references)
            if found and found.kind is not None]
    return {"question": asked.name, "method": method, "target": target,
            "error": np.median(errors) if errors.size else "-",
            "error_largest": errors.max() if errors.size else "-",
            "within": int((errors <= target).sum()), "compared": errors.size,
            "kinds": sum(found == true for found, true in told) if told else "-",
            "drawn": len(readings), "rows": asked.count, **more}


def other(asked, method, integrators, target, transient):
    """A method that computes the drawn rows alone."""
    scene, drawn = asked.scene, asked.fewer(asked.drawn, method)
    tried = asked.fewer(asked.tried, method)
    integrator, accuracy = setting_for(asked, tried, integrators, transient, target)
    setting = integrator, accuracy, transient
    readings, cpu, wall = readings_of(asked, drawn, setting)
    readings, cpu, wall, repetitions = timed(
        lambda: [reading_of(row, setting, scene) for row in drawn], scene,
        (readings, sum(cpu), sum(wall)))
    scale = asked.count / len(drawn)
    evaluations = sum(found.evaluations for found in readings if found)
    return table_row(asked, method, target, readings, cpu_s=scale * cpu,
                     wall_s=scale * wall, evaluations=round(scale * evaluations),
                     computed=len(drawn),
                     integrator=integrator, accuracy=accuracy, transient=transient,
                     repetitions=repetitions)


def explored(words):
    """The table that explore prints; rows without a value do not end the program."""
    done = subprocess.run([str(ROOT / "build/explore"), *words, "--quiet"], cwd=ROOT,
                          check=False, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          text=True)
    if not done.stdout:
        sys.exit(f"explore {shlex.join(words)}: status {done.returncode}: {done.stderr}")
    return Table.of(done.stdout)


def kind_of(period, driven_twice):
    """Our K as a kind; a motion that is -1 contracts where two frequencies drive."""
    return period if period > 0 else -1 if period == -1 and driven_twice else 0


def ours(asked, table):
    """The readings of the drawn rows in our table; of several motions at a speed the
    nearest one."""
    is_map = "amplitude" in table.columns
    names = ("frequency", "amplitude") if is_map else ("f", "amp_x_r")
    speeds, amplitudes = (cells_as_numbers(table[name]) for name in names)
    periods = cells_as_numbers(table["period"]) if "period" in table.columns else None
    readings = []
    for row, true in zip(asked.drawn, asked.references):
        here = np.isclose(speeds, row.frequency, rtol=1e-9)
        if row.clearance:
            clearances = table["bearing.radial_clearance_m"]
            here &= np.isclose(clearances, row.clearance, rtol=1e-9, atol=0)
        twice = row.case().base()[1]
        found = [Reading(amplitudes[k],
                         None if periods is None else kind_of(int(periods[k]), twice))
                 for k in np.flatnonzero(here & np.isfinite(amplitudes))]
        same = [one for one in found if one.kind == true.kind]
        readings.append(min(same or found, default=None,
                            key=lambda one: abs(one.amplitude - true.amplitude)))
    return readings


def this(asked, method, command, target, done):
    """The command of this project, run once for all targets where it takes none."""
    words = shlex.split(command.format(file=asked.file, target=target))
    key = tuple(words)
    if key not in done:
        done[key] = timed(lambda: explored(words), asked.scene)
    table, cpu, wall, repetitions = done[key]
    asked.stamp = table.header.split("\n")
    return table_row(asked, method, target, ours(asked, table), cpu_s=cpu, wall_s=wall,
                     evaluations=table.value("evaluations", "-"), computed=asked.count,
                     integrator=table.value("method", "-"),
                     accuracy=target if "--tolerance" in words else "-", transient="-",
                     repetitions=repetitions)


def rows_of(asked):
    """All rows of one question."""
    done = {}
    for target in asked.scene["targets"]:
        for method, key in (("this", "command"), ("this-balance", "command_balance")):
            if key in asked.question:
                yield this(asked, method, asked.question[key], target, done)
        transient = transient_for(asked, target)
        for method, integrators in asked.scene["methods"].items():
            yield other(asked, method, integrators, target, transient)


def header(scene, asked):
    """The lines that say what was done."""
    tight, share = scene["reference"], scene["share"]
    fewer = ", ".join(f"{method}: {count}"
                      for method, count in scene["fewer_rows"].items())
    yield "Speed against error for questions of users"
    yield from (line[2:] for line in asked[0].stamp
                if line.startswith(("# source", "# compiler")))
    yield "schema: 2"
    yield (f"note: SUNDIALS {sundials_version()}, SciPy {scipy.__version__}, "
           f"NumPy {np.__version__}; one thread; all call the same compiled Eq. 7, SciPy "
           "from Python")
    for one in asked:
        yield f"row question: {one.name} {one.count} {one.question['what']}"
        yield f"row command: {one.name} build/explore {one.question['command']}"
        for key, values in one.question.get("changes", {}).items():
            yield from (f"row change: {one.name} {key} {old} {new}"
                        for old, new in values.items())
        kinds = " ".join(str(true.kind) for true in one.references)
        yield f"row kinds: {one.name} {kinds}"
    yield (f"note: other methods compute {scene['computed_rows']} rows of each question "
           f"({fewer}), drawn with the seed {scene['seed']}; their times and evaluations "
           "are scaled to all rows, by the number of rows")
    yield ("note: errors and kinds of every method are those of the drawn rows; "
           f"reference: Runge-Kutta of order 8, local error {tight['local_error']:g}, "
           f"{tight['transients_s'][0]:g} s from the start; kinds: K where the motion "
           "closes, -1 where it contracts, 0 for everything else")
    yield ("note: of several motions of this project at a speed the nearest counts, "
           "of the kind of the reference if there is one; other methods begin at the "
           "reference's start")
    yield (f"note: settings: transient, then tolerance with which {share:.0%} of as many "
           "other rows have the right kind and an error below the target; where none "
           "does, the tightest; choosing them is not counted in the times")
    yield from (f"column: {name} [{unit}] {meaning}" for name, unit, meaning in COLUMNS)


def checked(scene):
    """Ends the program where the scene cannot be computed."""
    for key in ("targets", "questions", "methods"):
        if not scene.get(key):
            sys.exit(f"{key} is missing or empty")
    if not all(0 < target < 1 for target in scene["targets"]):
        sys.exit("targets must lie between 0 and 1")
    for question in scene["questions"]:
        rows = question["speeds_hz"]["count"] * question.get("starts", 1)
        rows *= question.get("clearances_m", {"count": 1})["count"]
        if rows < 2 * scene["computed_rows"]:
            sys.exit(f"question {question['name']}: {rows} rows are too few to draw from")
    return scene


def main(scene_file, names):
    scene = checked(tomllib.loads((ROOT / scene_file).read_text(encoding="utf-8")))
    known = [one["name"] for one in scene["questions"]]
    if not set(names) <= set(known):
        sys.exit(f"no such question: {', '.join(sorted(set(names) - set(known)))}; "
                 f"there are {', '.join(known)}")
    chosen = [one for one in scene["questions"] if not names or one["name"] in names]
    asked, rows = [], []
    for question in chosen:
        asked.append(Asked(question, scene))
        for row in rows_of(asked[-1]):
            rows.append(row)
            print(*row.values(), file=sys.stderr)
    print(*("# " + line for line in header(scene, asked)), sep="\n")
    names = [name for name, _, _ in COLUMNS]
    print("\t".join(names))
    for row in rows:
        print("\t".join(cell(row[name]) for name in names))


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(f"usage: {sys.argv[0]} SCENE.toml [QUESTION...]")
    main(sys.argv[1], sys.argv[2:])
