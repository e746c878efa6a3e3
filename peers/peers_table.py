"""The text of peers.tsv: header, columns, rows."""

import time
from ctypes import create_string_buffer

import numpy as np
import scipy
from equation7 import LIBRARY, Case
from explore import displacements, provenance

COLUMNS = (
    ("set", "-", "data set"),
    ("frequency", "Hz", "speed of rotation"),
    ("method", "-", "integrator"),
    ("tolerance", "-", "relative, and absolute over the size of each component"),
    ("start", "-", "static: at rest under the static load; neighbour: solution at the speed below"),
    ("transient", "s", "integrated before the period that is compared, whole periods"),
    ("cpu_s", "s", "CPU time of one thread: set-up, transient and one period, median"),
    ("cpu_min_s", "s", "least of the repetitions"),
    ("cpu_max_s", "s", "most of the repetitions"),
    ("repetitions", "-", "number of timed runs"),
    ("evaluations", "-", "of Eq. 7"),
    ("jacobians", "-", "analytic ones"),
    ("steps", "-", "taken by the integrator"),
    ("error", "-", "largest difference of the displacements over the largest displacement"),
    ("error_force", "-", "the same for the bearing's force"),
)


def sundials_version():
    version = create_string_buffer(32)
    LIBRARY.SUNDIALSGetVersion(version, len(version))
    return version.value.decode()


def call_costs(speed):
    """Seconds of an evaluation along the reference orbit: from C++, and from Python."""
    case, rounds = Case(speed.file, speed.frequency), 200
    times, states = speed.times([0]), np.zeros((speed.points, 8))
    states[:, :4] = displacements(speed.reference)
    began = time.thread_time()
    case.derivatives(times, states, rounds)
    middle = time.thread_time()
    for _ in range(rounds):
        for t, y in zip(times, states):
            case.derivative(t, y)
    ended = time.thread_time()
    return np.array([middle - began, ended - middle]) / (rounds * len(times))


def agreement(speed, tried):
    """How near the integrators come to the reference, from any start."""
    best = {}
    for (other, method, _), trials in tried.items():
        if other is speed and trials:
            best[method] = min(best.get(method, np.inf), min(trial[3] for trial in trials))
    return best


def header(scene, speeds, missed, tried):
    """The lines that say what was done."""
    compiled, interpreted = call_costs(speeds[0])
    yield "Cost against error of outside integrators at single speeds"
    yield from (line[2:] for line in provenance(speeds[0].reference)[:3])
    yield (f"note: SUNDIALS {sundials_version()}, SciPy {scipy.__version__}, NumPy {np.__version__}; "
           "dense Jacobians, one thread")
    for file in dict.fromkeys(speed.file for speed in speeds):
        speed = next(speed for speed in speeds if speed.file == file)
        yield from (line[2:] for line in provenance(speed.reference)[3:])
    yield (f"note: reference: harmonic balance, m = {scene['reference_harmonics']}; errors at "
           f"{scene['points']} instants of the period")
    yield (f"note: one evaluation of Eq. 7: {1e9 * compiled:.0f} ns from C++ (CVODE), "
           f"{1e9 * interpreted:.0f} ns from Python (SciPy)")
    asked = [", ".join(f"{e:g}" for e in scene[key]) for key in ("errors", "errors_force")]
    yield (f"note: rows: for each error asked for (displacement {asked[0]}; force {asked[1]}) the pair "
           "of tolerance and transient that reaches it with the fewest evaluations; "
           f"tried transients up to {max(scene['transients_s']):g} s, tolerances down to " +
           ", ".join(f"{min(values):g} ({method})"
                     for method, values in scene["tolerances"].items()))
    for speed in speeds:
        for method, error in sorted(agreement(speed, tried).items()):
            yield f"row nearest: {speed.entry['set']} {speed.frequency:g} {method} {error:.1e}"
    for speed, method, start, errors in missed:
        yield (f"note: not reached: set {speed.entry['set']}, {speed.frequency:g} Hz, {method}, "
               f"{start} start: " + ", ".join(errors))
    yield from (f"column: {name} [{unit}] {meaning}" for name, unit, meaning in COLUMNS)


def cell(value):
    """A word, or a number with enough digits; nothing that is not finite."""
    if isinstance(value, str):
        return value
    if not np.isfinite(value):
        raise SystemExit("a result is not finite")
    return f"{value:.15g}"


def table_text(scene, speeds, rows, missed, tried):
    """The whole table."""
    lines = ["# " + line for line in header(scene, speeds, missed, tried)]
    names = [name for name, _, _ in COLUMNS]
    lines.append("\t".join(names))
    lines += ["\t".join(cell(row[name]) for name in names) for row in rows]
    return "\n".join(lines) + "\n"
