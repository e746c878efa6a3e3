"""Attacks that no commit has seen before: command lines and files drawn with the number
of the commit as seed, and readers against libFuzzer where make has built it. Writes the
counts into the page tests/hard/attacks.md; ends with status 1 where a promise breaks.

Usage: make test-all, or tests/hard/attack.py [TIMES] [SECONDS]   (from the project's
root; 2 times as many questions as in the tests, 60 s for each reader)
"""
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "fuzz"))
import fuzz  # noqa: E402

PAGE = Path("tests/hard/attacks.md")
COLUMNS = ["what", "inputs", "answered", "refused, status 2",
           "without an answer, status 3", "broken promises"]
READERS = {"machine": "files of machines", "scene": "scenes", "matrix": "Matrix Market",
           "table": "tables", "json": "text that becomes JSON"}
# Those of explore_input.py whose runs are short.
TESTS = ["spoilt_parameter_files", "spoilt_options", "spoilt_branches_to_restart",
         "rotors_given_by_matrices", "legal_and_extreme_machines_and_options",
         "legal_and_extreme_machines_of_another_kind"]


def questions(times, seed):
    """(name, answered, refused, without an answer) of the random questions; what is
    broken ends the program."""
    with tempfile.TemporaryDirectory() as folder:
        counts = Path(folder, "counts")
        words = ["-m", "unittest", *(f"tests.hard.explore_input.Explore.test_{name}" for name in TESTS)]
        drawn = {"ATTACKS": str(counts), "EXAMPLES": str(times), "SEED": str(seed)}
        run = subprocess.run([sys.executable, *words], env={**os.environ, **drawn},
                             check=False)
        if run.returncode:
            sys.exit("a promise is broken: see above")
        return [json.loads(line) for line in counts.read_text("utf-8").splitlines()]


def line(cells):
    shown = (f"{cell:,}" if isinstance(cell, int) else cell for cell in cells)
    return "| " + " | ".join(shown) + " |\n"


def main(times=2, seconds=60):
    count = ["git", "rev-list", "--count", "HEAD"]
    seed = int(subprocess.run(count, capture_output=True, check=True).stdout)
    rows = [[name, sum(ends), *ends, 0] for name, *ends in questions(int(times), seed)]
    if fuzz.PROGRAM.exists():
        ends = fuzz.attack_all(READERS, int(seconds), seed)
        for reader, (inputs, broken) in ends.items():
            print(f"{reader}: {inputs} inputs", broken)
            if broken:
                return 1
            rows.append([READERS[reader] + ", by libFuzzer", inputs, "", "", "", 0])
    table = "".join(map(line, [COLUMNS, ["---"] * len(COLUMNS), *rows]))
    said = f"Seed {seed}, {sum(row[1] for row in rows):,} inputs.\n\n{table}"
    page = re.sub(r"(?<=<!-- counts -->\n).*?(?=<!-- end -->)", lambda _: said,
                  PAGE.read_text("utf-8"), flags=re.S)
    PAGE.write_text(page, "utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
