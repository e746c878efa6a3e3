"""AUTO-07p follows the response curve.

Usage: OMP_NUM_THREADS=1 /usr/bin/python3 peers/peers_auto.py data/scenes/peers_auto.toml > table
Compiles peers/auto/motion.f90 with the machine's numbers, links it with AUTO's objects as AUTO's
own commands do, and runs it without its Python front end: the time is that of the computation.
"""

import resource
import subprocess
import sys
import tomllib
from pathlib import Path
from shutil import rmtree

import numpy as np
from auto_table import stop, table_text
from equation7 import ROOT
from explore import Failed, child_seconds, displacements, orbit, slopes

SOURCE, BUILD = ROOT / "peers/auto", ROOT / "build/peers/auto"
OBJECTS = sorted(Path("/usr/lib/auto-07p/lib").glob("*.o"))
FORTRAN = ["gfortran", "-O2", "-fopenmp"]
BODY, RELATIVE = 1e-3, 1e-6  # the sizes in motion.f90 [m]
NO_CONVERGENCE = -9


def machine(values):
    """The Fortran module with the numbers of a parameter file."""
    bearing, numbers = values["bearing"], {}
    for name, key in (("s", "stator"), ("r", "rotor")):
        mass, omega = values[key]["mass_kg"], values[key]["natural_frequency_rad_per_s"]
        numbers |= {f"m_{name}": mass, f"k_{name}": mass * omega**2,
                    f"c_{name}": 2 * values[key]["damping_ratio"] * mass * omega}
    numbers |= {"unbalance": values["rotor"]["unbalance_kg_m"],
                "gravity": values["gravity"]["acceleration_m_per_s2"],
                "contact_stiffness": bearing["contact_stiffness_N_per_m1p5"],
                "clearance": bearing["radial_clearance_m"],
                "cage_ratio": bearing["cage_speed_ratio"]}
    lines = ["  double precision, parameter :: " + name + " = " + f"{number:.17e}".replace("e", "d")
             for name, number in numbers.items()]
    return "\n".join(["module machine", f"  integer, parameter :: balls = {bearing['balls']}",
                      *lines, "end module", ""])


def build(parameter_file):
    """AUTO's program for one machine."""
    rmtree(BUILD, ignore_errors=True)
    BUILD.mkdir(parents=True)
    values = tomllib.loads((ROOT / parameter_file).read_text(encoding="utf-8"))
    (BUILD / "machine.f90").write_text(machine(values), encoding="utf-8")
    objects = []
    for source in (BUILD / "machine.f90", SOURCE / "motion.f90"):
        objects.append(BUILD / source.with_suffix(".o").name)
        subprocess.run([*FORTRAN, "-c", source, "-o", objects[-1]], cwd=BUILD, check=True)
    subprocess.run([*FORTRAN, *objects, *OBJECTS, "-o", BUILD / "motion"], check=True)


def write_start(folder, scene, run):
    """The harmonic-balance orbit at the first speed, as AUTO's start file."""
    table = orbit(scene["parameters"], run["from_hz"], scene["start_harmonics"],
                  scene["start_points"])
    q = displacements(table)
    q = np.hstack([q[:, :2] / BODY, (q[:, 2:] - q[:, :2]) / RELATIVE])
    period = np.hstack([q, slopes(q)])
    time = np.arange(len(q) + 1) / len(q)
    np.savetxt(folder / "start.dat", np.column_stack([time, np.vstack([period, period[:1]]), time]),
               fmt="%.16e")


def constants(scene, run):
    """AUTO's constants of one run."""
    low, high = sorted((run["from_hz"], run["to_hz"]))
    return (SOURCE / "c.motion").read_text(encoding="utf-8") + "\n".join((
        f"dat='start.dat', PAR={{1: {run['from_hz']}}}, DS={run['step']}, NTST={run['mesh']}",
        f"NMX={run['points']}, UZSTOP={{1: [{low}, {high}]}}",
        f"UZR={{1: {[float(f) for f in scene['compared_hz']]}}}", ""))


def follow(scene, run):
    """The rows of one run, its CPU seconds and why it ended."""
    folder = BUILD / run["name"]
    folder.mkdir()
    write_start(folder, scene, run)
    limits = (scene["longest_s"], scene["longest_s"] + 1)
    seconds = []
    for _ in range(run["repetitions"]):
        before = child_seconds()
        with open(folder / "log", "w", encoding="utf-8") as log:
            subprocess.run([BUILD / "motion"], input=constants(scene, run), text=True,
                           cwd=folder, stdout=log, stderr=log, check=False, preexec_fn=lambda:
                           resource.setrlimit(resource.RLIMIT_CPU, limits))
        seconds.append(child_seconds() - before)
    rows = read_branch(folder / "fort.7")
    return {"run": run, "rows": rows, "seconds": seconds,
            "end": reason(scene, run, rows, min(seconds))}


def read_branch(file):
    """Number, type, speed and the four amplitudes of each point."""
    rows = []
    for line in file.read_text(encoding="ascii").splitlines():
        words = line.split()
        if words[0] == "0" or len(words) < 9:
            continue
        rows.append((int(words[1]), int(words[2]), float(words[4]), *map(float, words[-4:])))
    if not rows:
        raise SystemExit(f"{file}: AUTO computed no point")
    return rows


def reason(scene, run, rows, seconds):
    """Why AUTO stopped."""
    if rows[-1][1] == NO_CONVERGENCE:
        return "no convergence at the least step"
    if seconds > scene["longest_s"] - 1:
        return f"stopped after {scene['longest_s']} s"
    return "all points asked for" if len(rows) >= run["points"] else "end of the range"


def balance_amplitudes(scene, speeds):
    """Half peak-to-peak by harmonic balance at some speeds, where it has a solution, and one of the
    tables."""
    amplitudes, table = {}, None
    for f in speeds:
        try:
            table = orbit(scene["parameters"], f, scene["compared_harmonics"], 2048)
        except Failed:
            continue
        q = displacements(table)
        amplitudes[f] = (q.max(axis=0) - q.min(axis=0)) / 2
    return amplitudes, table


def main(scene_file):
    scene = tomllib.loads((ROOT / scene_file).read_text(encoding="utf-8"))
    build(scene["parameters"])
    curves = [follow(scene, run) for run in scene["runs"]]
    met = {stop(row, scene) for curve in curves for row in curve["rows"]} - {None}
    print(table_text(scene, curves, *balance_amplitudes(scene, sorted(met))), end="")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(f"usage: {sys.argv[0]} SCENE.toml")
    main(sys.argv[1])
