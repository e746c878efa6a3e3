"""Harmonics for a tolerance: how many an error needs, and what the printed error is worth.

Beside the paper: §3.3 asks how many harmonics are enough. Instead of a number of harmonics one may ask for an error. The
number is then doubled until the solution is that near to a motion of Eq. 7 that shooting has closed beside it. Two things can
go wrong: the motion may not be the solution's own, and the search may cost more than it saves. This table looks at both, at
the speeds of both data sets where the motion is T-periodic.

Panel (a) of the figure divides the printed error, here called the estimate, by the true one, the distance to the periodic
motion that shooting finds from starts of its own: on the line both are equal; the grey band is what is asked. Panel (b) divides the
cost by that of the cheapest fixed number of harmonics that does as well, a number that nobody knows beforehand: above one is
what not knowing costs, and the line at two is what it may cost. Panels (c) and (d) show the highest order chosen, speed by speed; a
cross is a tolerance that was not reached.

Each error is the larger of the largest difference over the largest displacement and the rms about the mean. Where shooting
from its own starts closes none of the solutions' motions, the nearest of three solutions with three to five times as many
harmonics as the ladder has stands for the exact motion; where the exact motion is not a solution's own, the distance that its verdict prints is the error.

Usage: studies/adaptive.py data/scenes/adaptive.toml > adaptive.tsv   (from the project's root)
"""
import os
import sys
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(1, str(Path(__file__).parents[1] / "figures"))
from rotor_stator import attempt, run  # noqa: E402
from tables import displacement_errors, print_columns, print_header  # noqa: E402

POINTS = 2048
NEAREST_START = "quasi-static-contact"
FAR = 10  # times the estimate: another motion
FINER = (3, 4, 5)  # times the harmonics of the ladder: several, since several motions may lie near each other
COLUMNS = [
    ("set", "-", "data set"), ("f", "Hz", "speed of rotation"), ("tolerance", "-", "wanted error of displacement"),
    ("reached", "-", "1 when the estimate is below the tolerance"),
    ("m", "-", "highest order chosen; -1 when the tolerance was not reached"), ("N", "-", "samples chosen; -1 likewise"),
    ("estimate", "-", "estimated error of displacement; -1 likewise"),
    ("error", "-", "distance to the exact periodic motion; -1 when none was found"),
    ("effectivity", "-", "estimate over error; -1 without error"),
    ("own_branch", "-", "1: against another exact motion than the other tolerances"),
    ("searched", "-", "1: quasi-static contact was no start; of other starts only a short time integration is in the cost"),
    ("cost", "-", "evaluations of the force times samples; -1 when the tolerance was not reached"),
    ("m_fixed", "-", "cheapest fixed m with at most that error; -1 when none"), ("error_fixed", "-", "its error"),
    ("cost_fixed", "-", "its cost"), ("ratio", "-", "cost over that of the fixed m")]


def orbit(machine, speed, *options):
    """The orbit; None without a solution."""
    return attempt("orbit", machine, *options, frequency=speed, columns=["x_s", "y_s", "x_r", "y_r"])


def over(a, b):
    return a / b if a > 0 and b > 0 else -1


def chosen(machine, speed, tolerance, exact):
    """The cells for one tolerance, but for the first three and the fixed m."""
    row = dict.fromkeys((name for name, *_ in COLUMNS[3:]), -1) | {"reached": 0, "own_branch": 0, "searched": 0}
    asked = ["--method", "aft", "--tolerance", tolerance, "--budget", 1e12]
    solution = orbit(machine, speed, *asked, "--points", POINTS, "--no-stability")
    if solution is None:
        return row
    row |= {"reached": 1, "m": int(solution.value("harmonics")), "N": int(solution.value("samples")),
            "searched": int(solution.value("start") != NEAREST_START), "estimate": solution.error("error"),
            "cost": solution.value("force_samples")}
    if exact is not None:
        row["error"] = max(displacement_errors(solution, exact))
    if exact is None or row["error"] > FAR * row["estimate"]:
        judged = orbit(machine, speed, *asked, "--points", 2)
        own = judged.error("distance")
        if own > 0 and (exact is None or own < row["error"]):
            row |= {"error": own, "own_branch": 1}
    return row | {"effectivity": over(row["estimate"], row["error"])}


def add_best_fixed(machine, speed, exact, most, rows):
    """The cheapest m of a ladder whose error is that of the row at most; the ladder ends with the first m that is as
    accurate as all rows want."""
    compared = [row for row in rows if row["error"] > 0 and not row["own_branch"]]
    least, error, m = min((row["error"] for row in compared), default=1), 2, 4
    while m <= most and error > least:
        fixed = orbit(machine, speed, "--method", "aft", "--harmonics", m, "--points", POINTS, "--no-stability")
        if fixed is not None and fixed.value("start") == NEAREST_START:
            error, cost = max(displacement_errors(fixed, exact)), fixed.value("force_samples")
            for row in compared:
                if error <= row["error"] and (row["m_fixed"] < 0 or cost < row["cost_fixed"]):
                    row |= {"m_fixed": m, "error_fixed": error, "cost_fixed": cost, "ratio": over(row["cost"], cost)}
        m += max(1, m // 7)


def rows_of(machine, speed, tolerances, most):
    """The rows of one speed."""
    exact = orbit(machine, speed, "--method", "shooting", "--local-error", 1e-12, "--points", POINTS, "--no-stability")
    rows = [chosen(machine, speed, tolerance, exact) for tolerance in tolerances]
    finest = [row["own_branch"] for row in rows if row["reached"]][-1:]
    if finest == [1] or exact is None:  # shooting found another motion, or none
        finer = [orbit(machine, speed, "--method", "aft", "--harmonics", k * most, "--points", POINTS, "--no-stability") for k in FINER]
        judged = [(exact, [chosen(machine, speed, tolerance, exact) for tolerance in tolerances]) for exact in finer]
        exact, rows = min(judged, key=lambda pair: (pair[0] is None, pair[1][-1]["own_branch"], pair[1][-1]["error"]))
    if exact is not None:
        add_best_fixed(machine, speed, exact, most, rows)
    return rows


def main(file):
    scene = tomllib.loads(Path(file).read_text(encoding="utf-8"))
    machines = [f"data/{name}.toml" for name in scene["parameters"]]
    speeds = [(number, speed) for number in range(1, len(machines) + 1) for speed in scene[f"speeds_of_set_{number}_hz"]]
    tolerances, most = scene["tolerances"], scene["most_fixed_harmonics"]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        found = list(pool.map(lambda at: rows_of(machines[at[0] - 1], at[1], tolerances, most), speeds))
    print_header("Error estimate, true error and cost of the adaptive number of harmonics",
                 [run("check", machine) for machine in machines],
                 f"modelled: harmonic balance; exact motions by shooting; fixed m up to {most}")
    print_columns(COLUMNS)
    for (number, speed), rows in zip(speeds, found):
        for tolerance, row in zip(tolerances, rows):
            print("\t".join(f"{cell:.12g}" for cell in (number, speed, tolerance, *row.values())))


if __name__ == "__main__":
    main(*sys.argv[1:])
