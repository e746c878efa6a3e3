"""Attractors: where time integration settles, speed by speed.

Beside the paper, which takes the periodic solution for the motion.

A machine that is switched on and left alone settles somewhere. Where that is may depend on how it began, so
`explore attractors` begins every speed from rest, from the motion at the speed below, from that at the speed above, and from
random states. Two starts that end alike count as one motion.

A motion that does not close is judged by its largest Lyapunov exponent, the rate at which neighbouring motions separate, known
to a standard error. It is chaotic if the exponent is positive by three of these errors, quasi-periodic if the exponent is zero
within three small ones, and undecided otherwise. The exponent of a closed motion follows from its multipliers.

The figure shows at which speeds the motion of the machine repeats after one turn. With the small clearance it does, except in
a band around 13 Hz and at a few other speeds, among them 20 and 54 Hz; the [results](../paper/results.md) list those of a
start from rest. With the large clearance it does not over most of the range below 38 Hz, and harmonic balance with this period
cannot represent it there.

Above, the horizontal motion of the rotor relative to the stator is observed once per turn, at phase zero, and divided by the
clearance (a Poincaré section). A motion that repeats after one turn gives the same value every time: a single point at its
speed. A motion with a longer period gives a few points. One that never repeats gives a vertical band of points. Where two
motions exist at one speed, the history decides which of them occurs.

Below stands the largest Lyapunov exponent. If it is negative, disturbances decay and the motion is stable. If it is zero, the
motion is quasi-periodic. If it is positive, neighbouring motions separate exponentially and the motion is chaotic. Bars show
three standard errors, which an exponent must exceed to count as different from zero.

Usage: studies/attractors.py data/scenes/attractors.toml [as-printed] > attractors.tsv   (from the project's root)
"""
import sys
import tempfile
import tomllib
from pathlib import Path

sys.path.insert(1, str(Path(__file__).parents[1] / "figures"))
from rotor_stator import attempt  # noqa: E402
from tables import Table, print_columns, print_header  # noqa: E402

OF_MOTION = ["motion", "period", "starts", "from_rest", "from_below", "from_above", "from_random", "lyapunov",
             "lyapunov_uncertainty", "amp_x_s", "amp_y_s", "amp_x_r", "amp_y_r"]
OF_POINT = ["x_s", "y_s", "x_r", "y_r"]
COLUMNS = [
    ("set", "-", "data set"), ("f", "Hz", "speed of rotation"), ("motion", "-", "number of the motion at this set and speed"),
    ("period", "-", "K of a motion that repeats after K turns; 0 aperiodic, -1 quasi-periodic, -2 undecided"),
    ("starts", "-", "how many ended there"), ("from_rest", "-", "of them at rest"), ("from_below", "-", "at the speed below"),
    ("from_above", "-", "at the speed above"), ("from_random", "-", "at random states"),
    ("lyapunov", "1/turn", "largest Lyapunov exponent"), ("lyapunov_uncertainty", "1/turn", "its standard error"),
    *((f"amp_{name}", "m", f"half peak-to-peak of {name}") for name in OF_POINT),
    ("point", "-", "number of the point of the Poincare section"), *((name, "m", "at phase 0") for name in OF_POINT)]


def rows_of(motions, section, most):
    """The cells after the set: a row for each point of the section, at most so many of a motion that does not close."""
    for k, (f, motion) in enumerate(zip(motions["f"], motions["motion"])):
        points = section.rows((section["f"] == f) & (section["motion"] == motion))
        for point in range(min(most, len(points))):
            yield [f, *(motions[name][k] for name in OF_MOTION), point + 1, *(points[name][point] for name in OF_POINT)]


def main(file, reading=""):
    scene = tomllib.loads(Path(file).read_text(encoding="utf-8"))
    speeds, tables, rows = scene["speeds_hz"], [], []
    count = round((speeds["to"] - speeds["from"]) / speeds["step"]) + 1
    with tempfile.TemporaryDirectory() as folder:
        section = Path(folder, "section.tsv")
        for number, name in enumerate(scene["parameters"], 1):
            machine = f"data/{name}{reading and '-' + reading}.toml"
            tables.append(attempt("attractors", machine, from_=speeds["from"], to=speeds["to"], count=count, starts=scene["random_starts"],
                                  seed=scene["seed"], budget=1e15, section=section))
            rows += [[number, *row] for row in rows_of(tables[-1], Table(section), scene["points"])]
    print_header("Attractors: their motions and Poincare sections", tables,
                 "starts: at each speed from rest, from the motions at the speeds below and above, and from random states",
                 "points: K of a motion that closes, at most so many of another",
                 **{key: tables[0].value(key) for key in ("method", "step", "base", "speeds", "starts", "seed")}, points=scene["points"])
    print_columns(COLUMNS)
    for row in rows:
        print("\t".join(f"{cell:.9g}" for cell in row))


if __name__ == "__main__":
    main(*sys.argv[1:])
