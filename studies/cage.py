"""What a cage ratio of 1/2 hides.

With c = 1/2 a whole number of balls passes in a turn, and all motion has the period of rotation; with a real bearing it has
two frequencies. For each data set, cage ratio and speed: the motion that integration from rest settles on, and whether
harmonic balance finds a solution within the tolerance, periodic or with two frequencies, that the machine's own verdict calls
stable.

Usage: studies/cage.py data/scenes/cage.toml > cage.tsv   (from the project's root; a quarter of an hour of two cores)
       studies/cage.py data/reference/cage.tsv > cage.md   (the page, its numbers from the table)
"""
import os
import re
import sys
import tempfile
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

sys.path.insert(1, str(Path(__file__).parents[1] / "figures"))
from rotor_stator import attempt, map_at  # noqa: E402
from tables import STABILITY, Table, print_columns  # noqa: E402

MEASURED = ["amplitude", "contact_share", "ball_load"]
COLUMNS = [
    ("set", "-", "data set"), ("c", "-", "omega_cage/omega"), ("f", "Hz", "speed of rotation"),
    ("amplitude", "m", "half peak-to-peak of x_r over K base periods, 256 where it does not repeat; integrated from rest"),
    ("contact_share", "-", "share of the time with at least one loaded ball; integrated from rest"),
    ("ball_load", "N", "largest force on a ball; integrated from rest"),
    ("found", "-", "harmonic balance reaches the tolerance: 1, else 0"),
    ("stable", "-", "the machine there: 1 stable, 0 unstable, -1 undecided or nothing found"),
    ("frequencies", "-", "of that solution: 1 or 2; 0 if nothing was found")]


def integrated(scene, name, ratio):
    """Rows of the map over the speeds, from rest."""
    return map_at(f"data/{name}.toml", ["bearing.cage_speed_ratio"], [[ratio]], method="rk4", longest=scene["settling_s"], threads=1,
                  budget=1e10, quantity=MEASURED, x=f"frequency={scene['first_hz']}:{scene['last_hz']}:{scene['speeds']}")


def solution(machine, speed, tolerance):
    """found, stable, frequencies."""
    table = attempt("orbit", machine, frequency=speed, method="aft", tolerance=tolerance, points=2)
    if table is None:
        return [0, -1, 0]
    return [1, STABILITY[table.value("stability")], 2 if table.value("base") == "two" else 1]


def span(values, scale=1, digits=3):
    """The smallest and the largest, one number where they print the same."""
    low, high = (f"{scale * value:.{digits}g}" for value in (min(values), max(values)))
    return low if low == high else f"{low}-{high}"


def peak_speed(rows):
    return rows["f"][np.argmax(rows["amplitude"])]


def share(holds):
    return holds.mean() if len(holds) else 0.0


def within(rows, above, high):
    return rows.rows((rows["f"] > above) & (rows["f"] <= high))


def load_ratio(rows):
    """Of the largest ball load at the peak to that at the speed next to 30 Hz."""
    return rows["ball_load"][np.argmax(rows["amplitude"])] / rows["ball_load"][np.argmin(np.abs(rows["f"] - 30))]


CLAIMS = [
    ("C1", "speed of the largest amplitude [Hz]", peak_speed),
    ("C4", "share of the speeds of 1-10 Hz with permanent contact [%]",
     lambda rows: 100 * share(within(rows, 0, 10)["contact_share"] == 1)),
    ("C5", "share of the speeds above 10 to 19 Hz where contact is lost [%]",
     lambda rows: 100 * share(within(rows, 10, 19)["contact_share"] < 1)),
    ("C7", "largest ball load at the peak over that at 30 Hz [-]", load_ratio)]


def page(table):
    """Markdown."""
    ratios = [c for c in np.unique(table["c"]) if c != 0.5]
    lines = [
        "# What a cage ratio of 1/2 hides", "",
        "The paper's cage turns at half the rotor's speed, so that a whole number of balls passes in a turn and every force "
        "repeats itself turn by turn. The inner race of a real bearing is smaller than the outer one, its cage is slower, and "
        "the motion has two frequencies: the speed and the passage of the balls. Both data sets were therefore computed again "
        f"with c = {span(ratios, 1, 2)}, at {len(np.unique(table['f']))} speeds of {span(table['f'])} Hz: by integration from "
        "rest, and by harmonic balance, within the evaluations that it has by default, with a verdict on each solution.", "",
        "![Response, ball load and stable solutions against the cage ratio](figures/cage.svg)", "",
        "## The response", ""]
    for number in np.unique(table["set"]):
        rows = table.where("set", number)
        half = rows.where("c", 0.5)
        off = np.concatenate([np.abs(rows.where("c", c)["amplitude"] / half["amplitude"] - 1) for c in ratios])
        lines.append(f"- Data set {number:g}: the amplitude of x_r differs from that with c = 1/2 by {100 * np.median(off):.2g} % "
                     f"(median over speeds and ratios), by more than 10 % at {100 * share(off > 0.1):.2g} % of them, and by "
                     f"{100 * off.max():.2g} % at most.")
    lines += ["", "## The claims that do not need a whole number", "",
              "| claim | quantity | data set | c = 1/2 | other ratios |", "|---|---|---|---|---|"]
    for claim, meaning, quantity in CLAIMS:
        for number in np.unique(table["set"]):
            rows = table.where("set", number)
            lines.append(f"| {claim} | {meaning} | {number:g} | {quantity(rows.where('c', 0.5)):.3g} | "
                         f"{span([quantity(rows.where('c', c)) for c in ratios])} |")
    lines += ["", "C2, C3 and C9 count harmonics of one frequency, C10 counts balls over two turns: without a whole number of "
              "passages they mean nothing. C6 and C8 were not computed.", "",
              "## Solutions of harmonic balance", "",
              "| data set | c | speeds with a solution [%] | stable [%] |", "|---|---|---|---|"]
    for number in np.unique(table["set"]):
        for c in np.unique(table["c"]):
            rows = table.where("set", number).where("c", c)
            lines.append(f"| {number:g} | {c:g} | {100 * share(rows['found'] == 1):.3g} | {100 * share(rows['stable'] == 1):.3g} |")
    repeating = [c for c in ratios if abs(5 * 16 * c - round(5 * 16 * c)) < 1e-9]
    found = {number: [100 * share(np.concatenate([table.where("set", number).where("c", c)["found"] for c in some]) == 1)
                      for some in (repeating, [c for c in ratios if c not in repeating])] for number in np.unique(table["set"])}
    named = " and ".join(f"{16 * 5 * c:.0f}/5 at c = {c:.2f}" for c in repeating)
    shares = ", ".join(f"{one:.0f} % of the speeds of data set {number:g} with one frequency and {two:.0f} % with two"
                       for number, (one, two) in found.items())
    lines += ["", "A solution is one within the tolerance of the study; `stable` is the machine's verdict, never that of the "
              f"harmonics. With 16 balls n·c is {named}: there harmonic balance takes one frequency with orders h/5, at the other "
              f"ratios two frequencies with more unknowns. The same budget gives solutions at {shares}. Where there is none, "
              "no such motion attracts, or it needs more harmonics than the budget pays for."]
    return "\n".join(lines)


def main(file):
    if file.endswith(".tsv"):
        print(page(Table(file)))
        return
    scene = tomllib.loads(Path(file).read_text(encoding="utf-8"))
    print("# Both data sets with other cage ratios")
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(os.cpu_count()) as pool:
        def of_ratio(name, ratio):
            text = Path(f"data/{name}.toml").read_text(encoding="utf-8")
            machine = Path(folder, f"{name}-{ratio}.toml")
            machine.write_text(re.sub(r"(?m)^cage_speed_ratio = .*$", f"cage_speed_ratio = {ratio}", text), encoding="utf-8")
            settled = integrated(scene, name, ratio)
            return [[ratio, f"{settled['frequency'][k]:.12g}", *(f"{settled[q][k]:.9g}" for q in MEASURED),
                     *solution(machine, settled["frequency"][k], scene["tolerance"])] for k in range(len(settled))], settled

        cases = [(name, ratio) for name in scene["parameters"] for ratio in scene["cage_speed_ratios"]]
        parts = list(pool.map(lambda case: of_ratio(*case), cases))
    print("\n".join(parts[0][1].header.split("\n")[1:4]))
    print(f"# parameters: data/{'.toml, data/'.join(scene['parameters'])}.toml with bearing.cage_speed_ratio = c")
    print(f"# tolerance: {scene['tolerance']:g}")
    print(f"# note: rk4 from rest, transient of at most {scene['settling_s']:g} s; harmonic balance to the tolerance")
    print_columns(COLUMNS)
    for (name, _), (rows, _) in zip(cases, parts):
        for row in rows:
            print("\t".join(map(str, [scene["parameters"].index(name) + 1, *row])))


if __name__ == "__main__":
    main(*sys.argv[1:])
