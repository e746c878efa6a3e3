"""Two maps of the machine, and what larger ones would cost.

The first table of this study measures: a map of 10,000 short points on one core, on two, and on more threads than cores; the same
with as much work for every thread; memory against the number of points; the time that Snakemake takes for each shard, and the
files that it leaves; the CPU time of a point of the two large maps, line by line. The page puts it beside what the two maps say,
and goes on, on paper, to maps of a million and a thousand million points.

Usage: studies/map_scaling.py data/scenes/map_scaling.toml > map_scaling.tsv   (from the project's root, alone on the machine)
       studies/map_scaling.py data/reference/map_scaling.tsv > map_scaling.md   (the page, its numbers from the tables beside it)
"""
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np

sys.path.insert(1, str(Path(__file__).parents[1] / "figures"))
from rotor_stator import run  # noqa: E402
from tables import Table, cells_as_numbers, print_columns, print_header, two_digits  # noqa: E402

COLUMNS = [
    ("kind", "word", "threads: one map; weak: as many points for every thread; memory; shards: of Snakemake; or a map's name"),
    ("count", "-", "threads, points, shards, or the line of the map"), ("points", "-", "of the map that was timed"),
    ("median_s", "s", "elapsed; of a map's line CPU time"), ("least_s", "s", "of the repetitions"), ("most_s", "s", "likewise"),
    ("memory", "byte", "peak; 0: not watched"), ("files", "-", "that Snakemake leaves")]


def timed(words, watched=False):
    """Elapsed and CPU seconds of a process and, of one that is watched, which costs time, its peak of memory; else 0."""
    begin, peak = time.perf_counter(), 0
    child = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    done = 0
    while not done:
        if watched:
            lines = Path(f"/proc/{child.pid}/status").read_text(encoding="utf-8").split("\n")
            peak = max([peak, *(1024 * int(line.split()[1]) for line in lines if line.startswith("VmHWM"))])
            time.sleep(1e-3)
        done, status, usage = os.wait4(child.pid, os.WNOHANG if watched else 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode:
        sys.exit(f"{' '.join(words)}: status {child.returncode}")
    return time.perf_counter() - begin, usage.ru_utime + usage.ru_stime, peak


def row(kind, count, points, runs, measure=0, files=0):
    seconds = [run[measure] for run in runs]
    return [kind, count, points, statistics.median(seconds), min(seconds), max(seconds), max(run[2] for run in runs), files]


def short_map(scene, points, threads):
    lines = points // int(scene["x"].rsplit(":", 1)[1])
    return ["build/explore", "map", f"data/{scene['parameters'][0]}.toml", "--x", scene["x"], "--y", f"{scene['y']}:{lines}",
            "--quantity", scene["quantity"], "--harmonics", "6", "--threads", str(threads), "--quiet"]


def sharded(scene, shards):
    """The row of Snakemake with so many short jobs, in a folder of its own."""
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree("studies", Path(folder, "studies"))
        shutil.copytree("data", Path(folder, "data"))
        Path(folder, "studies", "short.yaml").write_text(
            f"machine: data/{scene['parameters'][0]}.toml\nx: frequency=20:50:2\ny: {scene['y']}:{shards}\n"
            f"quantities: [{scene['quantity']}]\noptions: --harmonics 6\nshards: {shards}\nminutes: 1\n", encoding="utf-8")
        run = timed(["env", "-C", folder, f"EXPLORE={Path('build/explore').resolve()}", "snakemake", "--snakefile",
                     "studies/Snakefile", "--cores", "2", "build/studies/short/map.tsv"])
        left = [path for part in (".snakemake", "build") for path in Path(folder, part).rglob("*") if path.is_file()]
        return row("shards", shards, 2 * shards, [run], files=len(left))


def of_a_line(name, study, place):
    """The row of one line of a large map."""
    lines = int(study["y"].split(":")[2])
    line = round(place * (lines - 1))
    run = timed(["build/explore", "map", study["machine"], "--x", study["x"], "--y", study["y"], "--quantity",
                 ",".join(study["quantities"]), *study.get("options", "").split(), "--threads", "1", "--quiet",
                 "--lines", f"{line}:{line + 1}"])
    return row(name, line, int(study["x"].split(":")[2]), [run], measure=1)


def measure(scene):
    import yaml  # of Snakemake, which the page does without

    def repeated(points, threads):
        return [timed(short_map(scene, points, threads)) for _ in range(scene["repetitions"])]

    rows = [row("threads", threads, scene["points"], repeated(scene["points"], threads)) for threads in scene["threads"]]
    rows += [row("weak", threads, threads * scene["points"], repeated(threads * scene["points"], threads))
             for threads in scene["threads"]]
    rows += [row("memory", points, points, [timed(short_map(scene, points, os.cpu_count()), True)]) for points in scene["memory_points"]]
    rows += [sharded(scene, shards) for shards in scene["shards"]]
    for name in MAPS:
        study = yaml.safe_load(Path("studies", f"{name}.yaml").read_text(encoding="utf-8"))
        rows += [of_a_line(name, study, place) for place in scene["lines"]]
    print_header("Cost of maps", [run("check", f"data/{scene['parameters'][0]}.toml")],
                 "repetitions of the kinds threads and weak, 1 of the others",
                 cores=len(os.sched_getaffinity(0)), repetitions=scene["repetitions"])
    print_columns(COLUMNS)
    for cells in rows:
        print("\t".join(cell if isinstance(cell, str) else f"{cell:.6g}" for cell in cells))


X, DELTA, STIFFNESS = "frequency", "bearing.radial_clearance_m", "bearing.contact_stiffness_N_per_m1p5"
ON_PAPER = {"points": (10**6, 10**9), "cores": (1, 100, 10**4), "shard_s": 600}
BORDER = 0.01  # error of a solution that is right


def of_speeds(table):
    """What the map over clearance and speed says."""
    period, loaded = cells_as_numbers(table["period"]), cells_as_numbers(table["contact_share"])
    aperiodic, lost = period == 0, loaded < 1
    widest = table[X][(loaded <= 0.999) & (table[DELTA] == table[DELTA].max())]
    return {"points": len(table), "once": np.mean(period == 1), "more": np.mean(period > 1), "aperiodic": np.mean(aperiodic),
            "quasi": np.mean(period == -1), "open": np.mean(~(period >= -1)), "first_um": 1e6 * table[DELTA][aperiodic].min(),
            "unlost": np.mean(~lost[aperiodic]), "tip_hz": np.median(table[X][lost & (table[DELTA] <= 5e-6)]),
            "band_from": widest.min(), "band_to": widest.max(), "lost_closed": np.mean(period[lost] > 0)}


def of_stiffness(table):
    """What the map over clearance and stiffness says."""
    columns = {name: cells_as_numbers(table[name]) for name in ("permanent", "peak_frequency", "peak", "error")}
    columns["peak_mm"] = 1e3 * columns.pop("peak")
    error, back = columns.pop("error"), cells_as_numbers(table["error_back"])
    known = np.isfinite(error)
    both = known & np.isfinite(back)
    ends = {f"{name}_{end}": value for name, column in columns.items()
            for end, value in (("least", np.nanmin(column)), ("most", np.nanmax(column)))}
    return {"points": len(table), "f_hz": table.value("frequency"), "limit": BORDER, "right": np.mean(error[known] <= BORDER),
            "open": np.mean(~known), "first_um": 1e6 * table[DELTA][known & (error > BORDER)].min(), "worst": error[known].max(),
            "other": np.mean((error > BORDER)[both] != (back > BORDER)[both]), "moved": np.mean(abs(back / error - 1)[both] > 0.1), **ends}


class LargeMap(NamedTuple):
    title: str
    values_of: Callable  # of its table
    text: str            # with these values


MAPS = {
    "clearance_speed": LargeMap("Clearance against speed", of_speeds, """The motion from rest, by time integration, repeats itself turn by turn at {once:.0%} of the points, after more turns at {more:.1%};
it is aperiodic at {aperiodic:.0%}, quasi-periodic at {quasi:.1%}, and not decided at {open:.1%}.

Aperiodic motion begins at a clearance of {first_um:.3g} µm, the first step of the map, and does not need a loss of contact: at {unlost:.0%} of the aperiodic points
a ball is loaded at every instant. Contact is lost in one tongue alone. Its tip, without
clearance, is at {tip_hz:.1f} Hz, where gravity and unbalance are equal; at the largest clearance it reaches from {band_from:.1f} to {band_to:.1f} Hz (speeds
that lose it for a thousandth of the time or more). Of the motions that lose contact {lost_closed:.0%} are periodic all the same. The paper shows panels at a few speeds for two
clearances, from which neither can be seen."""),
    "stiffness_border": LargeMap("Clearance against contact stiffness", of_stiffness, """The peak lies between {peak_frequency_least:.1f} and {peak_frequency_most:.1f} Hz and is {peak_mm_least:.1f} to
{peak_mm_most:.1f} mm high: it is that of both bodies as one, whatever joins them. The share of the solved speeds with permanent contact goes from
{permanent_least:.0%} to {permanent_most:.0%}.

At {f_hz:.0f} Hz six harmonics are within {limit:.0%} of what the machine does at {right:.0%} of the points, at every point that has
a result and a clearance below {first_um:.0f} µm, and within {worst:.1%} at all that have one. Their border of validity is no line: besides the corner of stiff contacts and
large clearances it has islands, and between them the error falls to a tenth and less along curves on which clearance and stiffness
change together. Walked from large clearances to small ones the error differs by more than a tenth at {moved:.1%} of the points, and lies on
the other side of {limit:.0%} at {other:.1%}: where several solutions or motions exist, the way decides which is found.
Neither clearance nor stiffness alone says whether six harmonics are enough; the paper gives one number of harmonics for each of two clearances.""")}


def agreement(checks, number):
    """How the independent check ended."""
    agrees = checks.where("map", number)["agrees"]
    return (f"{(agrees == 1).sum()} of {len(agrees)} random points agree with a program that shares no code (tests/truth/judge.cpp), at "
            f"{(agrees == 2).sum()} it comes to another of several motions, {(agrees == 0).sum()} disagree, {(agrees == -1).sum()} had no result to be compared")


def cost_of(costs, name):
    """CPU seconds of a point, mean over the timed lines."""
    rows = costs.where("kind", name)
    return rows["median_s"].sum() / rows["points"].sum()


def power(count):
    return f"$10^{round(np.log10(count))}$"


def written(seconds):
    """With a unit that a person uses."""
    for unit, size in (("years", 3.156e7), ("days", 86400), ("hours", 3600), ("minutes", 60)):
        if seconds >= size:
            return f"{two_digits(seconds / size)} {unit}"
    return f"{two_digits(seconds)} s"


def on_paper(costs, tables, per_shard, files_of_a_shard):
    """Rows of the table of maps that nobody computed."""
    for name, table in tables.items():
        seconds = cost_of(costs, name)
        size = Path("data/reference", f"{name}.tsv").stat().st_size / len(table)
        for points in ON_PAPER["points"]:
            shards = max(1, round(points * seconds / ON_PAPER["shard_s"]))
            for cores in ON_PAPER["cores"]:
                work = -(-shards // cores) * ON_PAPER["shard_s"]
                yield (f"| {name} | {power(points)} | {cores} | {written(work)} | {written(shards * per_shard)} | {shards} | "
                       f"{shards * files_of_a_shard:.0f} | {points * size / 1e9:.3g} |")


def page(folder):
    """Markdown."""
    costs, checks = (Table(folder / f"{name}.tsv") for name in ("map_scaling", "map_checks"))
    tables = {name: Table(folder / f"{name}.tsv") for name in MAPS}
    threads, weak, memory, shards = (costs.where("kind", kind) for kind in ("threads", "weak", "memory", "shards"))
    cores = int(costs.value("cores"))
    per_shard, files_of_a_shard = (np.diff(shards[name])[0] / np.diff(shards["count"])[0] for name in ("median_s", "files"))
    lines = ["# Two maps of the machine, and what larger ones would cost", ""]
    for number, (name, table) in enumerate(tables.items(), 1):
        values = MAPS[name].values_of(table)
        lines += [f"## {MAPS[name].title}", "", MAPS[name].text.format(**values), "",
                  f"*Cost and check.* {len(table)} points of {cost_of(costs, name):.2g} s, {written(len(table) * cost_of(costs, name))} "
                  f"of one core; at {values['open']:.2%} there is no result. {agreement(checks, number)}.", ""]
    one = threads["median_s"][0]
    lines += [
        "## Threads, memory and shards", "",
        f"Measured on {cores} cores, elapsed, with points of {1e3 * one / threads['points'][0]:.2g} ms, short ones, so that "
        "overhead is seen. First the same points for any number of threads, with the efficiency t(1) / (min(threads, cores) t); then "
        "so many points for each thread, with the same times the number of threads.", "",
        "| threads | same points [s] | efficiency | points of each thread [s] | efficiency |", "|---|---|---|---|---|"]
    for k, count in enumerate(threads["count"]):
        used = min(count, cores)
        lines.append(f"| {count:.0f} | {threads['median_s'][k]:.3g} ({threads['least_s'][k]:.3g}-{threads['most_s'][k]:.3g}) | "
                     f"{one / threads['median_s'][k] / used:.2f} | {weak['median_s'][k]:.3g} ({weak['least_s'][k]:.3g}-"
                     f"{weak['most_s'][k]:.3g}) | {weak['median_s'][0] / weak['median_s'][k] * count / used:.2f} |")
    lines += [
        "", f"The peak of memory is {', '.join(f'{size / 1e6:.3g}' for size in memory['memory'])} MB with "
        f"{', '.join(power(count) for count in memory['points'])} points. Snakemake takes {1e3 * per_shard:.2g} ms for a shard, and "
        f"leaves {files_of_a_shard:.2g} files for it.", "",
        "## A million points, and a thousand million", "",
        f"On paper, from the costs above, in shards of {ON_PAPER['shard_s'] // 60} minutes: the time of the jobs, that of the one "
        "controller which hands them out, and what is left on disk.", "",
        "| map | points | cores | jobs | controller | shards | files | table [GB] |", "|---|---|---|---|---|---|---|---|",
        *on_paper(costs, tables, per_shard, files_of_a_shard), ""]
    most = max(ON_PAPER["points"])
    shards_of_most = most * max(cost_of(costs, name) for name in MAPS) / ON_PAPER["shard_s"]
    lines += [
        f"A million points need nothing new. With {power(most)} points the controller breaks first: "
        f"{shards_of_most:.0f} shards are {written(shards_of_most * per_shard)} of its own time at the measured rate, which it "
        "spends before and between the jobs, and it keeps all of them in memory. Shards of hours instead of minutes, submitted as "
        "arrays of jobs, divide that by the length of a shard. Next come the files, of which most file systems want fewer in one "
        "folder: a folder for each thousand lines. Then the merged table, as text too large to be read at once: shards stay apart "
        "and are read column by column. Chaos does not grow with the map, but its points are reproduced on another processor as "
        "statistics alone, so that a shard that is computed anew elsewhere differs in these rows."]
    return "\n".join(lines)


def main(given):
    if given.endswith(".tsv"):
        print(page(Path(given).parent))
    else:
        measure(tomllib.loads(Path(given).read_text(encoding="utf-8")))


if __name__ == "__main__":
    main(*sys.argv[1:])
