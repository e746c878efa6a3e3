"""The text of peers_auto.tsv: header, columns, rows."""

import subprocess

import numpy as np
from explore import child_seconds, explore, provenance

FOLD, USER = 5, -4
AMPLITUDES = ("amp_x_s", "amp_y_s", "amp_x_r", "amp_y_r")
COLUMNS = (
    ("run", "-", "down: from the highest speed; up: from the lowest"),
    ("point", "-", "number along the run"),
    ("f", "Hz", "speed of rotation"),
    *((name, "m", f"half peak-to-peak of {name[4:]}") for name in AMPLITUDES),
    ("fold", "-", "1 at the folds that AUTO located"),
    ("distance", "-", "largest difference of the four amplitudes to harmonic balance at this "
                      "speed, over the largest amplitude; -1: none"),
)


def version():
    """AUTO's, from the package manager where there is one."""
    try:
        done = subprocess.run(["dpkg-query", "-W", "-f=${Version}", "auto-07p"], text=True,
                              capture_output=True, check=False)
        return done.stdout or "of unknown version"
    except FileNotFoundError:
        return "of unknown version"


def gfortran():
    done = subprocess.run(["gfortran", "-dumpfullversion"], text=True, capture_output=True,
                          check=True)
    return done.stdout.strip()


def stop(row, scene):
    """The compared speed that AUTO stopped at in this row, to its tolerance; None elsewhere."""
    if row[1] != USER:
        return None
    return min(scene["compared_hz"], key=lambda f: abs(f - row[2]))


def distance(row, scene, amplitudes):
    """Of one row to harmonic balance at its speed; -1 without that."""
    truth = amplitudes.get(stop(row, scene))
    if truth is None:
        return -1.0
    return np.abs(np.array(row[3:7]) - truth).max() / truth.max()


def nearest(curve, scene, amplitudes):
    """The distance at each compared speed, of the sheet of the branch that is nearest."""
    best = {}
    for row in curve["rows"]:
        d, f = distance(row, scene, amplitudes), stop(row, scene)
        if d >= 0:
            best[f] = min(d, best.get(f, np.inf))
    return best


def spread(seconds):
    """Median and range of CPU times, for the header."""
    return (f"CPU {np.median(seconds):.3g} s ({min(seconds):.3g} to {max(seconds):.3g} s, "
            f"{len(seconds)} runs)")


def describe(scene, curve, amplitudes):
    """What AUTO did in one run, and how far it is from harmonic balance."""
    run, rows = curve["run"], curve["rows"]
    speeds, folds = [row[2] for row in rows], sum(row[1] == FOLD for row in rows)
    yield f"row run: {run['name']} {len(rows)} {folds} {min(speeds):.6g} {max(speeds):.6g}"
    yield (f"note: run {run['name']}: from {run['from_hz']:g} Hz, NTST = {run['mesh']}, NCOL = 4; "
           f"ended at {speeds[-1]:.6g} Hz: {curve['end']}; {spread(curve['seconds'])}")
    met = nearest(curve, scene, amplitudes)
    if met:
        worst = max(met, key=met.get)
        yield (f"row distance: {run['name']} {len(met)} {np.median(list(met.values())):.2g} "
               f"{met[worst]:.2g} {worst:g}")


def own_branch(scene, curve):
    """Our branch over the same speeds from the same end, one line for each number of harmonics; as much
    work as it takes."""
    speeds = [row[2] for row in curve["rows"]]
    upwards = curve["run"]["from_hz"] < curve["run"]["to_hz"]
    bounds = {"from": min(speeds), "to": max(speeds), "direction": "up" if upwards else "down",
              "budget": 1e10}
    for harmonics in scene["own_harmonics"]:
        seconds = []
        for _ in range(scene["own_repetitions"]):
            before = child_seconds()
            table, failed = explore("response", scene["parameters"], may_stop=True,
                                    harmonics=harmonics, **bounds)
            seconds.append(child_seconds() - before)
        yield (f"row balance: {curve['run']['name']} {harmonics} {len(table['f'])} "
               f"{table.value('folds'):g}")
        yield (f"note: run {curve['run']['name']}: m = {harmonics} over the same speeds: "
               f"{'stopped early' if failed else 'all of them'}; {spread(seconds)}")


def table_text(scene, curves, amplitudes, start):
    """The whole table; `start` is any explored table of the machine, for its provenance."""
    lines = ["AUTO-07p along the response curve", *(line[2:] for line in provenance(start)),
             f"note: auto-07p {version()}, gfortran {gfortran()} -O2; one thread",
             f"compared_harmonics: {scene['compared_harmonics']}",
             "note: row run: name, points, folds, least and highest speed [Hz]; row distance to "
             "harmonic balance: run, speeds, median, largest and its speed [Hz]; row balance: "
             "run, m, points, folds"]
    for curve in curves:
        lines += [*describe(scene, curve, amplitudes), *own_branch(scene, curve)]
    lines += [f"column: {name} [{unit}] {meaning}" for name, unit, meaning in COLUMNS]
    lines = ["# " + line for line in lines] + ["\t".join(name for name, _, _ in COLUMNS)]
    for curve in curves:
        for row in curve["rows"]:
            numbers = [row[0], *row[2:7], int(row[1] == FOLD), distance(row, scene, amplitudes)]
            lines.append("\t".join([curve["run"]["name"], *(f"{x:.15g}" for x in numbers)]))
    return "\n".join(lines) + "\n"
