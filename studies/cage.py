"""What a cage ratio of 1/2 hides.

With c = 1/2 a whole number of balls passes in a turn, and all motion has the period of rotation; with a real bearing it has
two frequencies. For each data set, cage ratio and speed: the motion that integration from rest settles on, and whether
harmonic balance finds a solution within the tolerance, periodic or with two frequencies, that the machine's own verdict calls
stable.

Usage: studies/cage.py data/scenes/cage.toml > cage.tsv   (from the project's root; a quarter of an hour of two cores)
"""
import os
import re
import subprocess
import sys
import tempfile
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "figures"))
from tables import Table  # noqa: E402

MEASURED = ["amplitude", "contact_share", "ball_load"]
STABILITY = {"stable": 1, "unstable": 0, "undecided": -1}
COLUMNS = [
    ("set", "-", "data set"), ("c", "-", "omega_cage/omega"), ("f", "Hz", "speed of rotation"),
    ("amplitude", "m", "half peak-to-peak of x_r over a turn, mean of eight turns; integrated from rest"),
    ("contact_share", "-", "share of the time with at least one loaded ball; integrated from rest"),
    ("ball_load", "N", "largest force on a ball; integrated from rest"),
    ("found", "-", "harmonic balance reaches the tolerance: 1, else 0"),
    ("stable", "-", "the machine there: 1 stable, 0 unstable, -1 undecided or nothing found"),
    ("frequencies", "-", "of that solution: 1 or 2; 0 if nothing was found")]


def explore(*arguments):
    return subprocess.run(["build/explore", *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          encoding="utf-8", check=False)


def integrated(scene, name, ratio):
    """Rows of the map over the speeds, from rest."""
    result = explore("map", f"data/{name}.toml", "--method", "rk4", "--longest", scene["settling_s"], "--threads", 1,
                     "--x", f"frequency={scene['first_hz']}:{scene['last_hz']}:{scene['speeds']}",
                     "--list", ratio, "--quantity", ",".join(MEASURED))
    if result.returncode:
        sys.exit(result.stderr)
    return Table.of(result.stdout)


def solution(machine, speed, tolerance):
    """found, stable, frequencies."""
    result = explore("orbit", machine, "--frequency", speed, "--tolerance", tolerance, "--points", 2)
    if result.returncode == 2:
        sys.exit(result.stderr)
    if result.returncode:
        return [0, -1, 0]
    word = re.search(r"^# stability: (\w+)", result.stdout, re.M).group(1)
    return [1, STABILITY[word], 2 if "two frequencies" in result.stdout else 1]


def main(file):
    scene = tomllib.loads(Path(file).read_text(encoding="utf-8"))
    print("# Both data sets with other cage ratios")
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(os.cpu_count()) as pool:
        def of_ratio(name, ratio):
            text = Path(f"data/{name}.toml").read_text(encoding="utf-8")
            machine = Path(folder, f"{name}-{ratio}.toml")
            machine.write_text(re.sub(r"(?m)^cage_speed_ratio = .*$", f"cage_speed_ratio = {ratio}", text), encoding="utf-8")
            points = Path(folder, f"{name}-{ratio}.tsv")
            points.write_text(f"bearing.cage_speed_ratio\n{ratio}\n", encoding="utf-8")
            settled = integrated(scene, name, points)
            return [[ratio, f"{settled['frequency'][k]:.12g}", *(f"{settled[q][k]:.9g}" for q in MEASURED),
                     *solution(machine, settled["frequency"][k], scene["tolerance"])] for k in range(len(settled))], settled

        cases = [(name, ratio) for name in scene["parameters"] for ratio in scene["cage_speed_ratios"]]
        parts = list(pool.map(lambda case: of_ratio(*case), cases))
    print("\n".join(parts[0][1].header.split("\n")[1:3]))
    print(f"# parameters: data/{'.toml, data/'.join(scene['parameters'])}.toml with bearing.cage_speed_ratio = c")
    print(f"# method: rk4 from rest, transient of at most {scene['settling_s']:g} s; harmonic balance with --tolerance "
          f"{scene['tolerance']:g}")
    for name, unit, meaning in COLUMNS:
        print(f"# column: {name} [{unit}] {meaning}")
    print("\t".join(name for name, _, _ in COLUMNS))
    for (name, _), (rows, _) in zip(cases, parts):
        for row in rows:
            print("\t".join(map(str, [scene["parameters"].index(name) + 1, *row])))


if __name__ == "__main__":
    main(*sys.argv[1:])
