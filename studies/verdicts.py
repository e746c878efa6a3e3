"""How often the multipliers of m harmonics are right.

Paper: §3.3, where six or ten harmonics are said to suffice; stability is not mentioned. A solution of harmonic balance satisfies
equations that are truncated at m harmonics. Its Floquet multipliers, the factors by which small disturbances change over a
period, can be computed for the truncated series, by integrating disturbances along it. This study counts how often they
agree with the machine.

The machine's multipliers are those of a motion of Eq. 7 itself, with nothing truncated, which shooting finds from the solution.
Each bar of the figure covers the solutions for which that motion was found and its stability decided. "False stable": the method
says stable, the machine's motion is unstable. "False unstable": the reverse. The displacements of these solutions are often
right to a per cent. The multipliers depend on the stiffness of the contact, which grows as the square root of the penetration,
with infinite slope where contact begins; its series converges more slowly than that of the displacements.

Speeds avoid the half hertz on which other studies stand.

Usage: studies/verdicts.py data/scenes/verdicts.toml > verdicts.tsv   (from the project's root)
"""
import sys
import tomllib
from pathlib import Path

sys.path.insert(1, str(Path(__file__).parents[1] / "figures"))
from rotor_stator import run  # noqa: E402
from tables import print_columns, print_header  # noqa: E402

STABILITY = {"stable": "1", "unstable": "0", "undecided": "-1"}
COLUMNS = [
    ("set", "-", "data set"), ("f", "Hz", "speed of rotation"), ("m", "-", "harmonics of the solution"),
    ("found", "-", "1 if there is a solution"),
    ("machine", "-", "largest modulus of the multipliers of the motion of Eq. 7 found from it; -1 none found"),
    ("machine_uncertainty", "-", "of it; -1"), ("machine_stable", "-", "1 stable, 0 unstable, -1 undecided"),
    ("distance", "-", "of the solution from that motion, rms about the mean; -1"),
    ("evaluations", "-", "of the force, for the verdict"),
    ("series", "-", "largest modulus by disturbances along the m harmonics; -1"),
    ("series_change", "-", "of it at the last refinement; -1"), ("series_stable", "-", "1 stable, 0 unstable, -1 undecided")]
QUANTITIES = ["multiplier", "uncertainty", "stability", "distance", "evaluations", "series", "series_uncertainty",
              "series_stability"]


def row(cells):
    """What stands after m, of the quantities of one point as words; - is a quantity that was not found."""
    found = cells["stability"] != "-"
    words = {name: STABILITY.get(cell, "-1" if cell == "-" else cell) for name, cell in cells.items()}
    if not found:
        words["evaluations"] = "0"
    return [str(int(found)), *words.values()]


def main(file):
    scene = tomllib.loads(Path(file).read_text(encoding="utf-8"))
    speeds, rows, tables = scene["speeds_hz"], {}, []
    count = round((speeds["to"] - speeds["from"]) / speeds["step"]) + 1
    for number, name in enumerate(scene["parameters"], 1):
        for m in scene["harmonics"]:
            # each speed is a line of its own, so that no solution starts from its neighbour
            table = run("map", f"data/{name}.toml", y=f"frequency={speeds['from']}:{speeds['to']}:{count}", method="aft", harmonics=m,
                        budget=scene["most_evaluations"], quantity=list(QUANTITIES))
            for k, frequency in enumerate(table["frequency"]):
                rows[number, frequency, m] = row({name: str(table[name][k]) for name in QUANTITIES})
        tables.append(table)
    print_header("Verdicts on the machine and on its m harmonics", tables,
                 f"modelled: harmonic balance; shooting with at most {scene['most_evaluations']:g} evaluations; disturbances "
                 "along the series")
    print_columns(COLUMNS)
    for key in sorted(rows):
        print("\t".join([*(f"{value:.12g}" for value in key), *rows[key]]))


if __name__ == "__main__":
    main(*sys.argv[1:])
