"""SUNDIALS, SciPy and AUTO-07p on the same equations.

This program computes cost against error of the outside integrators; AUTO-07p has a program of its own.

Usage: OMP_NUM_THREADS=1 /usr/bin/python3 peers/peers.py data/scenes/peers.toml > peers.tsv
First every pair of tolerance and transient is tried once, on all processors, and its errors and
evaluations are kept; then the cheapest pairs are timed, one after the other, on one thread.
"""

import sys
import time
import tomllib
from multiprocessing import Pool
from statistics import median

import numpy as np
from equation7 import ROOT, Case
from explore import displacements, orbit, slopes
from integrators import METHODS, Broken, integrate
from peers_table import table_text

WHAT = {"errors": "displacement", "errors_force": "force"}
STARTS = ("static", "neighbour")


class Speed:
    """A case of the scene with its reference and its starts."""

    def __init__(self, entry, scene):
        self.entry, self.points = entry, scene["points"]
        self.file, self.frequency = entry["parameters"], entry["frequency_hz"]
        self.reference = orbit(self.file, self.frequency, scene["reference_harmonics"],
                               self.points)
        below = self.frequency - scene["neighbour_hz"]
        harmonics = scene["neighbour_harmonics"]
        neighbour = displacements(orbit(self.file, below, harmonics, 16 * harmonics))
        speeds = 2 * np.pi * below * slopes(neighbour)
        self.starts = {"static": Case(self.file, self.frequency).static_start(),
                       "neighbour": np.concatenate([neighbour[0], speeds[0]])}

    def periods(self, transients):
        """The fewest whole periods not shorter than each transient [s]; each number once."""
        return sorted({int(np.ceil(t * self.frequency - 1e-9)) for t in transients})

    def times(self, transients):
        """The instants of the period after each transient of whole periods."""
        phases = np.arange(self.points) / self.points
        return np.concatenate([(count + phases) / self.frequency for count in transients])

    def errors(self, case, times, states):
        """Largest difference to the reference, of displacement and of force."""
        truth = displacements(self.reference)
        forces = np.column_stack([self.reference["F_x"], self.reference["F_y"]])
        off = np.abs(states[:, :4] - truth).max() / np.abs(truth).max()
        off_force = np.hypot(*(case.forces(times, states) - forces).T).max()
        return off, off_force / np.hypot(*forces.T).max()


def trials_of(job):
    """Every transient of each tolerance of one method from one start, the tolerances from loose to
    tight until every error asked for is reached, and one more."""
    speed, method, start, scene = job
    case, trials = Case(speed.file, speed.frequency), []
    transients = speed.periods(scene["transients_s"])
    done = False
    for tolerance in scene["tolerances"][method]:
        times = speed.times(transients)
        try:
            states, counts = integrate(case, method, tolerance, speed.starts[start], times)
        except Broken as reason:
            print(f"{method} at {tolerance:g}: {reason}", file=sys.stderr)
            continue
        for k, transient in enumerate(transients):
            part = slice(k * speed.points, (k + 1) * speed.points)
            error = speed.errors(case, times[part], states[part])
            cost = int(counts[part][-1][:2].sum())
            trials.append((cost, tolerance, transient, *error))
        if done:
            break
        done = not cheapest(trials, scene)[1]
    return trials


def cheapest(trials, scene):
    """For each error asked for, the cheapest pair that reaches it; and the errors not reached."""
    chosen, missed = set(), []
    for column, key in ((3, "errors"), (4, "errors_force")):
        for target in scene[key]:
            enough = [trial for trial in trials if trial[column] <= target]
            if enough:
                chosen.add(min(enough)[1:3])
            else:
                missed.append(f"{WHAT[key]} {target:g}")
    return sorted(chosen, reverse=True), missed


def timed(speed, method, start, pair, scene):
    """One row of the table."""
    case, (tolerance, transient) = Case(speed.file, speed.frequency), pair
    times, seconds, wanted = speed.times([transient]), [], scene["repetitions"]
    while len(seconds) < wanted:
        began = time.thread_time()
        states, counts = integrate(case, method, tolerance, speed.starts[start], times)
        seconds.append(time.thread_time() - began)
        if seconds[0] > scene["slow_s"]:
            wanted = scene["repetitions_if_slow"]
    error, error_force = speed.errors(case, times, states)
    return {"set": speed.entry["set"], "frequency": speed.frequency, "method": method,
            "tolerance": tolerance, "start": start,
            "transient": transient / speed.frequency,
            "cpu_s": median(seconds), "cpu_min_s": min(seconds), "cpu_max_s": max(seconds),
            "repetitions": wanted, "evaluations": counts[-1][0], "jacobians": counts[-1][1],
            "steps": counts[-1][2], "error": error, "error_force": error_force}


def main(scene_file):
    scene = tomllib.loads((ROOT / scene_file).read_text(encoding="utf-8"))
    speeds = [Speed(entry, scene) for entry in scene["cases"]]
    jobs = [(speed, method, start, scene) for method in reversed(METHODS)
            for speed in speeds for start in STARTS]
    with Pool() as pool:
        tried = pool.map(trials_of, jobs, chunksize=1)
    rows, missed = [], []
    for (speed, method, start, _), trials in zip(jobs, tried):
        pairs, unreached = cheapest(trials, scene)
        rows += [timed(speed, method, start, pair, scene) for pair in pairs]
        if unreached:
            missed.append((speed, method, start, unreached))
    print(table_text(scene, speeds, rows, missed, dict(zip(map(key_of, jobs), tried))), end="")


def key_of(job):
    speed, method, start, _ = job
    return speed, method, start


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(f"usage: {sys.argv[0]} SCENE.toml")
    main(sys.argv[1])
