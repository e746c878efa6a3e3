"""What the damping decides that the paper leaves out.

Paper: §3.3 and §4, claims C2 and C14; Table 1.

The paper gives its contact no damping and its suspensions a few per cent; it prints neither masses nor the cage's speed, and a
contact stiffness whose exponent reads oddly (D-08). Here all of them are varied. Each machine, with each damping of contact and
suspension, is integrated from rest at every speed. Where its motion repeats with every turn, the solutions with few harmonics
are found, and the nearest motion of Eq. 7 says how far each is from the truth. Where it does not repeat, no solution with that
period is right.

The steel of a real contact damps little: 0.1 to 1 s/m.

Usage: studies/robustness.py data/scenes/robustness.toml > robustness.tsv   (from the project's root)
"""
import sys
import tomllib
from pathlib import Path

sys.path.insert(1, str(Path(__file__).parents[1] / "figures"))
from rotor_stator import map_at  # noqa: E402
from tables import cells_as_numbers, print_columns, print_header  # noqa: E402

DAMPINGS = ("bearing.contact_damping_s_per_m", "stator.damping_ratio", "rotor.damping_ratio")
T_PERIODIC = 1


def machines_of(scene, base):
    """name, factor of the suspensions' damping and the values of all keys that vary, of every machine of the scene."""
    keys = dict.fromkeys(key for machine in scene["machine"] for key in machine if key != "name")
    keys = [*keys, *DAMPINGS]
    for times in scene["damping"]["suspension_times"]:
        for contact in scene["damping"]["contact_s_per_m"]:
            for machine in scene["machine"]:
                values = {**base, **machine, DAMPINGS[0]: contact}
                for key in DAMPINGS[1:]:
                    values[key] = float(f"{times * base[key]:.12g}")
                yield machine["name"], times, [values[key] for key in keys], keys


def parameters(file):
    """The parameters of a file by the names that `explore map --list` reads."""
    table = tomllib.loads(Path(file).read_text(encoding="utf-8"))
    return {f"{part}.{key}": value for part, values in table.items() if isinstance(values, dict) for key, value in values.items()}


def columns(harmonics):
    return [("set", "-", "data set"), ("machine", "-", "counts the machines of the scene, the one used first"),
            ("contact_damping", "s/m", "of the Hertz contact"), ("suspension", "-", "factor of both suspensions' damping"),
            ("f", "Hz", "speed of rotation"),
            ("period", "turns", "of the motion from rest; 0 chaotic, -1 quasi-periodic, -2 undecided"),
            *((f"error_{m}", "-", "rms error about the mean with so many harmonics; -1 where the motion is not T-periodic, 2 where "
               "there is no solution") for m in harmonics)]


def rows_of_set(file, scene):
    """The cells from machine on, and the map that says which program computed them."""
    speeds = scene["speeds_hz"]
    step = (speeds["to"] - speeds["from"]) / (speeds["count"] - 1)
    machines = list(machines_of(scene, parameters(file)))
    keys = machines[0][-1]
    points = [[speeds["from"] + k * step, *values] for *_, values, _ in machines for k in range(speeds["count"])]
    settled = map_at(file, ["frequency", *keys], points, quantity="period")
    period = cells_as_numbers(settled["period"])
    repeats = [k for k, one in enumerate(period) if one == T_PERIODIC]
    errors = {k: [-1] * len(scene["harmonics"]) for k in range(len(points))} | {k: [] for k in repeats}
    for m in scene["harmonics"]:
        found = map_at(file, ["frequency", *keys], [points[k] for k in repeats], harmonics=m, quantity="error")
        for k, cell in zip(repeats, found["error"]):
            errors[k].append(2 if cell == "-" else float(cell))
    names = [machine["name"] for machine in scene["machine"]]
    return settled, [[names.index(machines[k // speeds["count"]][0]) + 1, point[1 + keys.index(DAMPINGS[0])],
                      machines[k // speeds["count"]][1], point[0], period[k], *errors[k]] for k, point in enumerate(points)]


def main(file):
    scene = tomllib.loads(Path(file).read_text(encoding="utf-8"))
    parts = [rows_of_set(f"data/{name}.toml", scene) for name in scene["parameters"]]
    print_header("What the damping decides that the paper leaves out", [settled for settled, _ in parts],
                 "row machine: number, name with _ for a space", tolerance=scene["accurate"],
                 rows=[("machine", [number, machine["name"].replace(" ", "_")]) for number, machine in enumerate(scene["machine"], 1)])
    print_columns(columns(scene["harmonics"]))
    for number, (_, rows) in enumerate(parts, 1):
        for row in rows:
            print("\t".join(f"{cell:.5g}" for cell in (number, *row)))


if __name__ == "__main__":
    main(*sys.argv[1:])
