"""Runs the benchmarks and prints their table: python3 tests/bench/table.py build/tests/bench > bench.tsv

The benchmarks' medians of CPU time, and the ratios of one run that do not depend on the machine's
speed alone. Dates and host names are left out."""
import json
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "figures"))
from project import source_line  # noqa: E402

NANOSECONDS = {"ns": 1, "us": 1e3, "ms": 1e6, "s": 1e9}

# Ratio: numerator, denominator, and the m of both.
RATIOS = [("force", "square_roots", (6, 64)),
          ("force_and_stiffness", "square_roots", (6, 64)),
          ("newton_iteration", "factorisation", (6, 10, 64)),
          ("kept_factors_iteration", "factorisation", (6, 10, 64))]


def medians(report):
    """CPU nanoseconds by name and arguments, "force/6"."""
    return {run["run_name"]: run["cpu_time"] * NANOSECONDS[run["time_unit"]]
            for run in report["benchmarks"] if run.get("aggregate_name") == "median"}


def main():
    report = subprocess.run(
        [sys.argv[1], "--benchmark_repetitions=5", "--benchmark_report_aggregates_only=true",
         "--benchmark_format=json"], check=True, stdout=subprocess.PIPE).stdout
    cpu = medians(json.loads(report))
    print("# Benchmarks: medians of CPU time, data set 1 at its solution at 30 Hz")
    print(source_line())
    print("# column: what [-] benchmark; of a ratio: numerator/denominator")
    print("# column: m [-] harmonics")
    print("# column: speeds [-] of a sweep; 0 elsewhere")
    print("# column: value [ns, ratios -] CPU time, or the ratio of two of them")
    print("what", "m", "speeds", "value", sep="\t")
    for name, value in cpu.items():
        what, m, *speeds = name.split("/")
        print(what, m, *(speeds or [0]), f"{value:.6g}", sep="\t")
    for upper, lower, harmonics in RATIOS:
        for m in harmonics:
            ratio = cpu[f"{upper}/{m}"] / cpu[f"{lower}/{m}"]
            print(f"{upper}/{lower}", m, 0, f"{ratio:.4g}", sep="\t")


if __name__ == "__main__":
    main()
