"""Validity: where a harmonic-balance solution is true.

Paper: §3.3, claims C2, C3 and C14.

The paper says that 6 harmonics suffice for the small clearance and that the large one needs 10. Enough for what? Here a
solution is compared with what the machine does: the root mean square of its difference from the nearest attractor's motion, both
about their means, over that of the motion. The means are left out because the static sag of the suspension is much larger than
the vibration at low speeds, and would hide any error of it.

The attractors of each speed are those of `explore attractors`, and the T-periodic motions that shooting and the adaptive
solution come to where they are stable. The solution with m harmonics is the one that `explore orbit` finds, begun at each speed anew; where several
solutions exist, another one may be nearer to an attractor.

Only speeds with a T-periodic attractor count; the titles give their number. The first figure shows the largest and the
median error against the number of harmonics, of displacement and of force. It falls in steps, at 8 and at 16 harmonics: 8 balls
pass a fixed direction in a turn, so that the bearing excites harmonics 8, 16, and so on, which fewer harmonics cannot follow. A
number beside a point counts speeds without a solution.

The second figure shows the same against speed; grey marks speeds at which no attractor has the period of rotation, where a
periodic solution can be exact but unstable, and the machine does not follow it. There more harmonics do not help: only the
numbers of harmonics that the figure draws are solved, without a verdict.

Points are full where the machine is stable: where shooting finds a motion of Eq. 7 from the solution, with all multipliers
inside the unit circle.

Usage: studies/validity.py data/scenes/validity.toml [as-printed] > validity.tsv   (from the project's root)
"""
import os
import sys
import tempfile
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(1, str(Path(__file__).parents[1] / "figures"))
from rotor_stator import attempt  # noqa: E402
from tables import STABILITY, Table, displacement_errors, print_columns, print_header  # noqa: E402

FORCE = ("F_x", "F_y")
SAME = 1e-3  # rms distance of two motions on one attractor
COLUMNS = [
    ("set", "-", "data set"), ("f", "Hz", "speed of rotation"),
    ("adaptive", "-", "1 if m was chosen for the tolerance, 0 if m is fixed"),
    ("m", "-", "harmonics; 0 for an adaptive solution that was not found"),
    ("found", "-", "1 if a solution was found; an adaptive one is looked for at the speeds with a T-periodic attractor"),
    ("distance", "-", "rms about the mean of the displacements' difference to the nearest attractor's motion, over that motion's "
     "rms about its mean; -1 when not found"), ("distance_force", "-", "the same of the bearing's force; -1"),
    ("nearest_periodic", "-", "1 if the nearest attractor has the period of rotation"),
    ("stable", "-", "the machine there: 1 stable, 0 unstable, -1 undecided or not asked for"),
    ("estimate", "-", "of the adaptive solution's error, the larger of both norms; -1"),
    ("periodic", "-", "1 if an attractor at this speed has the period of rotation"),
    ("distance_largest", "-", "largest difference to the nearest motion over its largest displacement; -1")]


def attractors(machine, scene, speeds):
    """The table of the attractors, and at each speed (period, motion) of each."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "motions.tsv")
        table = attempt("attractors", machine, from_=speeds[0], to=speeds[-1], count=len(speeds), starts=scene["random_starts"],
                        seed=scene["seed"], budget=1e15, motions=file)
        motions = Table(file)
    known = {f: [] for f in speeds}
    for f, motion, period in zip(table["f"], table["motion"], table["period"]):
        known[f].append((period, motions.rows((motions["f"] == f) & (motions["motion"] == motion))))
    return table, known


def orbit(machine, speed, *options):
    """The orbit at the instants of the attractors' motions; None without a solution."""
    return attempt("orbit", machine, *options, frequency=speed, points=256)


def stability(solution):
    return STABILITY[solution.value("stability", "undecided")]


def with_closed(known, machine, speed):
    """The attractors, with the stable motion that shooting finds if it is another one."""
    closed = orbit(machine, speed, "--method", "shooting", "--budget", 2e7)
    if closed is None or stability(closed) < 1 or any(displacement_errors(closed, motion)[0] < SAME for _, motion in known):
        return known
    return [*known, (1, closed)]


def nearest_to(solution, known):
    """rms distance, largest difference, period and motion of the nearest attractor."""
    return min(((*displacement_errors(solution, motion), period, motion) for period, motion in known), key=lambda one: one[0])


def row_of(solution, known, is_adaptive):
    """The cells from m on; `known`: (period, motion) of each attractor."""
    periodic = int(any(period == 1 for period, _ in known))
    if solution is None:
        return [0, 0, -1, -1, 0, -1, -1, periodic, -1]
    distance, largest, period, nearest = nearest_to(solution, known)
    estimate = solution.error("error") if is_adaptive else -1
    return [int(solution.value("harmonics")), 1, distance, displacement_errors(solution, nearest, FORCE)[0], int(period == 1), stability(solution), estimate,
            periodic, largest]


def rows_at(machine, speed, known, scene):
    """(adaptive, cells from m on) of all solutions at one speed; where none can be true, of the examined ones without verdict."""
    known, examined, tolerance = with_closed(known, machine, speed), scene["examined_harmonics"], scene["tolerance"]
    is_periodic = any(period == 1 for period, _ in known)
    adaptive = orbit(machine, speed, "--method", "aft", "--tolerance", tolerance) if is_periodic else None
    if adaptive and stability(adaptive) == 1 and nearest_to(adaptive, known)[0] > 2 * tolerance:  # an attractor that is not known
        finer = orbit(machine, speed, "--method", "aft", "--tolerance", tolerance / 100, "--no-stability")
        known = [*known, (1, finer)] if finer else known
    for m in range(1, scene["most_harmonics"] + 1) if is_periodic else examined:
        verdict = [] if is_periodic and m in examined else ["--no-stability"]
        _, *row = row_of(orbit(machine, speed, "--method", "aft", "--harmonics", m, *verdict), known, False)
        yield [0, m, *row]
    yield [1, *row_of(adaptive, known, True)]


def main(file, reading=""):
    scene = tomllib.loads(Path(file).read_text(encoding="utf-8"))
    first, last, step = (scene["speeds_hz"][key] for key in ("from", "to", "step"))
    speeds = [first + k * step for k in range(round((last - first) / step) + 1)]
    machines = [f"data/{name}{reading and '-' + reading}.toml" for name in scene["parameters"]]
    settled = [attractors(machine, scene, speeds) for machine in machines]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        found = [pool.map(lambda f, machine=machine, known=known: list(rows_at(machine, f, known[f], scene)), speeds)
                 for machine, (_, known) in zip(machines, settled)]
    print_header("Distance of harmonic-balance solutions to the nearest attractor", [table for table, _ in settled],
                 f"modelled: solutions with m = 1 to {scene['most_harmonics']}, without T-periodic attractor those with m in "
                 f"{scene['examined_harmonics']} alone; adaptive: for the tolerance; verdicts by shooting",
                 f"attractors: from rest, from the speeds below and above, from {scene['random_starts']} random states; by shooting; "
                 "a stable adaptive solution that is near none of these, with a hundredth of the tolerance",
                 tolerance=scene["tolerance"])
    print_columns(COLUMNS)
    for number, part in enumerate(found, 1):
        for speed, rows in zip(speeds, part):
            for row in rows:
                print("\t".join(f"{cell:.12g}" for cell in (number, speed, *row)))


if __name__ == "__main__":
    main(*sys.argv[1:])
