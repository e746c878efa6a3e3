"""How the cost of harmonic balance grows with the degrees of freedom (claim C12).

An overhung shaft in one bearing with clearance is divided into more and more beam elements; a shaft of brick elements
and the paper's machine stand beside it. Each cell is a run of `explore` in a process of its own: CPU time of one thread
and the peak of its memory. A branch is timed without reading, reduction and the fits of the receptances, which come once
and have their own column. The judge integrates all degrees of freedom, of the largest bodies the reduced ones, until the
motion repeats itself.

Usage: studies/large.py data/scenes/large.toml > large.tsv   (from the project's root, alone on the machine)
"""
import os
import statistics
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

import numpy as np

sys.path.insert(1, str(Path(__file__).parents[1] / "figures"))
from tables import Table, displacement_errors, print_columns, print_header  # noqa: E402

YOUNG, POISSON, DENSITY = 211e9, 0.3, 7810.0
COLUMNS = [
    ("kind", "-", "paper: data set 1; beam: Timoshenko elements; brick: eight-node elements"),
    ("n", "-", "degrees of freedom of rotor and stator"), ("r", "-", "after the reduction"),
    ("reduction_error", "-", "of the receptances at random points, relative; 0 without reduction"),
    ("reduction_s", "s", "CPU of what a branch needs once: reading, reduction, fits of the receptances"),
    ("branch_s", "s", "CPU of the branch with 6 harmonics, after that"), ("points", "-", "of the branch"),
    ("solution_s", "s", "CPU of one solution with 20 harmonics, no verdict; with reading and reduction"),
    ("verdict_s", "s", "CPU of a solution to the tolerance, with its verdict; with reading and reduction"),
    ("integration_s", "s", "CPU of integration from rest until the motion repeats itself, and again with half the step; -1: none"),
    ("integrated", "-", "degrees of freedom that are integrated"),
    ("memory", "byte", "peak of the branch's process; about 35 MB are those of the Python that starts it"),
    ("error", "-", "rms about the mean, of the solution to the tolerance, against the integration; -1: none")]


def run(*words):
    """The table, CPU seconds, the peak of memory and the log; ends the program where explore does not succeed."""
    with tempfile.TemporaryFile("w+", encoding="utf-8") as out, tempfile.TemporaryFile("w+", encoding="utf-8") as log:
        child = subprocess.Popen(["build/explore", *map(str, words)], stdout=out, stderr=log)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        log.seek(0)
        if child.returncode:
            sys.exit(f"explore {' '.join(map(str, words))}: status {child.returncode}: {log.read()}")
        return out.read(), usage.ru_utime + usage.ru_stime, 1024 * usage.ru_maxrss, log.read()


def median_run(repetitions, *words):
    """The table, the median of the CPU times, the memory and all logs; what takes long is run once."""
    runs = [run(*words)]
    while len(runs) < repetitions and runs[0][1] < 20:
        runs.append(run(*words))
    return runs[0][0], statistics.median(one[1] for one in runs), runs[0][2], [one[3] for one in runs]


def machine(title, folder, joint, output, vertical, whole):
    return f"""title = "{title}"
[stator]
mass_kg = 30.0
natural_frequency_rad_per_s = 600.0
damping_ratio = 0.05
[rotor]
matrices = "{folder}"
bearing_dofs = [{joint}, {joint + 1}]
output_dofs = [{output}, {output + 1}]
vertical_dofs = {vertical}
unbalance = [{{ dofs = [{output}, {output + 1}], moment_kg_m = 2e-3 }}]
{"all_dofs = true" if whole else ""}
[bearing]
balls = 8
contact_stiffness_N_per_m1p5 = 1e10
radial_clearance_m = 1e-5
cage_speed_ratio = 0.375
[gravity]
acceleration_m_per_s2 = 9.81
"""


def beam(folder, elements):
    """Two thirds of the shaft up to the bearing, and a disk at its end. Its degrees of freedom: bearing, disk, weights."""
    nodes, bearing = elements + 1, 2 * elements // 3 + 1
    text = f"""title = "shaft"
[material]
youngs_modulus_Pa = {YOUNG}
shear_modulus_Pa = {YOUNG / 2 / (1 + POISSON)}
density_kg_per_m3 = {DENSITY}
[[segment]]
length_m = 1.5
diameter_m = 0.05
elements = {elements}
[[disk]]
node = {nodes}
outer_diameter_m = 0.35
bore_m = 0.05
thickness_m = 0.07
[[support]]
node = 1
stiffness_N_per_m = [1e7, 1e7]
damping_N_s_per_m = [500, 500]
[damping]
over_mass_1_per_s = 20
over_stiffness_s = 1e-5
"""
    (folder / "shaft.toml").write_text(text, encoding="utf-8")
    run("shaft", folder / "shaft.toml", "--to", folder / "matrices")
    return 4 * bearing - 3, 4 * nodes - 3, list(range(2, 4 * nodes, 4)), 4 * nodes


def brick_element(sides):
    """M and K, 24 × 24, of a trilinear element by two points of Gauss in each direction."""
    lame, shear = YOUNG * POISSON / (1 + POISSON) / (1 - 2 * POISSON), YOUNG / 2 / (1 + POISSON)
    elastic = np.diag([2 * shear] * 3 + [shear] * 3)
    elastic[:3, :3] += lame
    corners = 2.0 * np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)]) - 1
    volume, m, k = np.prod(sides) / 8, np.zeros((24, 24)), np.zeros((24, 24))
    for point in corners / np.sqrt(3):
        factors = 1 + corners * point
        slopes = [corners[:, a] * np.delete(factors, a, 1).prod(1) / 4 / sides[a] for a in range(3)]
        strains, shapes = np.zeros((6, 24)), np.zeros((3, 24))
        for a in range(3):
            strains[a, a::3], shapes[a, a::3] = slopes[a], factors.prod(1) / 8
        for row, (a, b) in enumerate([(0, 1), (1, 2), (0, 2)], 3):
            strains[row, a::3], strains[row, b::3] = slopes[b], slopes[a]
        k += volume * strains.T @ elastic @ strains
        m += volume * DENSITY * shapes.T @ shapes
    return m, k


def bricks(folder, counts):
    """A square bar of 50 mm, 1 m long, of bricks: held at one end, in the bearing at the other, the unbalance between."""
    x, y, z = counts
    first = np.array([((k * (y + 1) + j) * (x + 1)) + i for k in range(z) for j in range(y) for i in range(x)])
    layer = (x + 1) * (y + 1)
    nodes = first[:, None] + [a + b * (x + 1) + c * layer for c in (0, 1) for b in (0, 1) for a in (0, 1)]
    dofs = (3 * nodes[:, :, None] + np.arange(3)).reshape(len(nodes), 24)
    size = 3 * layer * (z + 1)
    entries = dofs[:, :, None] * size + dofs[:, None, :]
    places, which = np.unique(entries, return_inverse=True)
    rows, columns = places // size, places % size
    mass, stiffness = (np.bincount(which.ravel(), np.tile(block.ravel(), len(nodes)), len(places))
                       for block in brick_element([0.05 / x, 0.05 / y, 1 / z]))
    stiffness[(rows == columns) & (rows < 3 * layer)] += 1e8
    lower = rows >= columns
    (folder / "matrices").mkdir()
    for name, values in [("M", mass), ("K", stiffness), ("C", 20 * mass + 1e-5 * stiffness)]:
        with open(folder / "matrices" / f"{name}.mtx", "w", encoding="utf-8") as out:
            out.write(f"%%MatrixMarket matrix coordinate real symmetric\n{size} {size} {lower.sum()}\n")
            np.savetxt(out, np.column_stack([rows[lower] + 1, columns[lower] + 1, values[lower]]), "%d %d %.17g")
    axis = layer // 2
    return 3 * (z * layer + axis) + 1, 3 * (z // 2 * layer + axis) + 1, list(range(2, size, 3)), size


def row(scene, kind, file, whole, degrees):
    """The cells of one machine; `whole`: the same with all degrees of freedom kept, or none."""
    speed = ["--frequency", scene["frequency_hz"]]
    solution = median_run(scene["repetitions"], "orbit", file, *speed, "--method", "aft", "--harmonics", 20, "--no-stability")
    branch = median_run(scene["repetitions"], "response", file, "--from", scene["from_hz"], "--to", scene["to_hz"], "--harmonics", 6, "--times")
    logs = [dict(line.split(": ") for line in log.splitlines()) for log in branch[3]]
    once, alone = (statistics.median(float(log[key]) for log in logs) for key in ("cpu_machine_s", "cpu_branch_s"))
    judged = median_run(scene["repetitions"], "orbit", file, *speed, "--method", "aft", "--tolerance", scene["tolerance"])
    found, along = Table.of(judged[0]), Table.of(branch[0])
    kept, error = int(found.value("degrees_of_freedom", degrees)), along.value("reduction_error", 0)
    method = ["--method", "rk8pd"] if kind == "paper" else ["--method", "gauss", "--local-error", scene["local_error"]]
    settled = run("orbit", whole or file, *speed, *method, "--longest", 5, "--budget", 1e13)
    off = displacement_errors(found, Table.of(settled[0]))[0]
    points = len(along)
    return [kind, degrees, kept, f"{error:.2g}", f"{once:.3g}", f"{alone:.3g}", points, f"{solution[1]:.3g}",
            f"{judged[1]:.3g}", f"{settled[1]:.3g}", degrees if whole or kept == degrees else kept, branch[2], f"{off:.3g}"], branch[0]


def main(file):
    scene = tomllib.loads(Path(file).read_text(encoding="utf-8"))
    cells, first = row(scene, "paper", f"data/{scene['parameters'][0]}.toml", None, 4)
    print_header("Cost of harmonic balance against the degrees of freedom", [Table.of(first)],
                 f"branch: from {scene['from_hz']:g} to {scene['to_hz']:g} Hz; solution, verdict and integration at "
                 f"{scene['frequency_hz']:g} Hz, tolerance {scene['tolerance']:g}",
                 f"CPU times: median of {scene['repetitions']} runs, one where a run takes more than 20 s")
    print_columns(COLUMNS)
    print(*cells, sep="\t", flush=True)
    for kind, size in [("beam", e) for e in scene["elements"]] + [("brick", scene["bricks"])]:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            joint, output, vertical, degrees = (beam if kind == "beam" else bricks)(folder, size)
            paths = {}
            for whole in (False, True):
                paths[whole] = folder / f"machine_{whole:d}.toml"
                paths[whole].write_text(machine(kind, "matrices", joint, output, vertical, whole), encoding="utf-8")
            cells, _ = row(scene, kind, paths[False], paths[True] if degrees <= scene["all_integrated"] else None, degrees + 2)
            print(*cells, sep="\t", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
