"""What one motion comes to, by any integrator: amplitude and kind after a transient.

A kind is K where the section of the base period closes after K of them, -1 where the
motion does not close but contracts, 0 for everything else; None where that is not told:
where two frequencies drive, one motion alone does not say whether it contracts.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from equation7 import ROOT, SIZE, Case
from integrators import Broken, integrate
from scipy.integrate import solve_ivp


@dataclass(frozen=True)
class Row:
    """A motion that is asked for: machine, speed [Hz], clearance [m] or 0 for the
    machine's, and number of the start, 0 at rest."""

    file: str
    frequency: float
    clearance: float = 0
    start: int = 0

    def case(self):
        return Case(self.file, self.frequency)

    def state(self, case, seed):
        """At rest under the static load, or the rotor at random within the bearing."""
        state = case.static_start()
        if self.start:
            random = np.random.default_rng([seed, self.start])
            away = random.uniform(-1, 1, SIZE) * np.array([0, 0, 1, 1, 0, 0, 0, 0])
            state += away * case.sizes()
        return state


@dataclass
class Reading:
    """What is known of a motion."""

    amplitude: float
    kind: int
    evaluations: int = 0


def changed_file(name, question, clearance=0):
    """The parameter file of a question with its values changed, written below build."""
    text = (ROOT / question["parameters"]).read_text(encoding="utf-8")
    changes = dict(question.get("changes", {}))
    if clearance:
        key = "radial_clearance_m"
        old = next(line for line in text.split("\n") if line.startswith(f"{key} = "))
        changes[key] = {old.split(" = ")[1]: f"{clearance:.15g}"}
    for key, values in changes.items():
        for old, new in values.items():
            if f"{key} = {old}\n" not in text:
                raise SystemExit(f"{question['parameters']} has no line {key} = {old}")
            text = text.replace(f"{key} = {old}\n", f"{key} = {new}\n")
    path = Path("build/tab03_answers", f"{name}.toml")
    (ROOT / path).parent.mkdir(exist_ok=True)
    (ROOT / path).write_text(text, encoding="utf-8")
    return str(path)


def dop853(case, tolerance, start, times, begin):
    """SciPy's DOP853 as its users call it."""
    case.counts()
    found = solve_ivp(case.derivative, (begin, times[-1]), start, "DOP853", times,
                      rtol=tolerance, atol=tolerance * case.sizes())
    if not found.success:
        raise Broken(found.message)
    return found.y.T, int(case.counts()[0])


def states_of(case, method, accuracy, transient, start, periods, points):
    """States at the instants of some base periods, with both ends, and evaluations."""
    frequency, _ = case.base()
    before = int(np.ceil(transient * frequency))
    if method.startswith("rk"):
        count = before * points
        first, spent = case.flow(method, accuracy, points, -count, start, count)
        later, more = case.flow(method, accuracy, points, 0, first[-1], periods * points)
        return np.vstack([first[-1:], later]), spent + more
    times = np.arange(periods * points + 1) / (points * frequency)
    if method == "scipy-dop853":
        return dop853(case, accuracy, start, times, -before / frequency)
    states, counts = integrate(case, method, accuracy, start, times, -before / frequency)
    return states, int(counts[-1][:2].sum())


def half_range(x, v, step):
    """Half peak-to-peak of samples with slopes, with the extremes of cubics between."""
    a, d = x[:-1], step * v[:-1]
    c_2, c_3 = 3 * (x[1:] - a) - 2 * d - step * v[1:], 2 * (a - x[1:]) + d + step * v[1:]
    with np.errstate(invalid="ignore", divide="ignore"):
        root = np.sqrt(c_2**2 - 3 * c_3 * d)
        turns = [d / (-c_2 - root), d / (-c_2 + root)]
    values = [x]
    for t in turns:
        inside = (t > 0) & (t < 1)
        t = np.where(inside, t, 0)
        values.append(a + t * (d + t * (c_2 + t * c_3)))
    values = np.concatenate(values)
    return (values.max() - values.min()) / 2


def closing(section, size, most, closed):
    """The fewest base periods after which the section repeats itself; 0 for none."""
    for period in range(1, min(most, len(section) // 2) + 1):
        if np.abs(section[period:] - section[:-period]).max() <= closed * size:
            return period
    return 0


def read(row, method, accuracy, transient, closed, scene, is_reference=False):
    """The reading of a row. A motion that closes is read over its last K base periods,
    another one over all that is recorded."""
    case, points = row.case(), scene["points"]
    frequency, driven_twice = case.base()
    periods = scene["periods_driven_twice" if driven_twice else "periods"]
    start = row.state(case, scene["seed"])
    states, spent = states_of(case, method, accuracy, transient, start, periods, points)
    if not np.isfinite(states).all():
        raise Broken("a state is not finite")
    step, x, v = 1 / (points * frequency), states[:, 2], states[:, 6]
    size = np.ptp(states[:, :4], axis=0).max() / 2
    kind = closing(states[::points, :4], size, scene["most_period"], closed)
    if driven_twice and not kind and not is_reference:
        kind = None
    last = slice(-kind * points - 1, None) if kind else slice(None)
    return Reading(half_range(x[last], v[last], step), kind, spent)


def reference(row, scene):
    """The reading with controlled steps of order 8; it contracts where a shorter
    transient ends on the same motion."""
    rule = scene["reference"]
    first, *others = (
        read(row, "rk8", rule["local_error"], transient, rule["closed"], scene, True)
        for transient in rule["transients_s"])
    same = all(abs(other.amplitude - first.amplitude) <= rule["same"] * first.amplitude
               for other in others)
    if not first.kind and same:
        first.kind = -1
    return first
