"""Attacks that no commit has seen before: command lines and files drawn with the number of the commit as seed, and readers against
libFuzzer where make has built it. Writes the counts into the page tests/hard/attacks.md; ends with status 1 where a promise breaks.

Usage: make test-all, or tests/hard/attack.py [TIMES] [SECONDS]   (from the project's root; 2 times as many as in the tests, 60 s)
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
HEAD = "| what | inputs | answered | refused, status 2 | without an answer, status 3 | broken promises |\n|---|---|---|---|---|---|\n"
READERS = {"machine": "files of machines, by libFuzzer", "scene": "scenes, by libFuzzer", "matrix": "Matrix Market, by libFuzzer",
           "table": "tables, by libFuzzer", "json": "text that becomes JSON, by libFuzzer"}


# Those of explore_input.py whose runs are short.
TESTS = ["spoilt_parameter_files", "spoilt_options", "spoilt_branches_to_restart", "rotors_given_by_matrices",
         "legal_and_extreme_machines_and_options", "legal_and_extreme_machines_of_another_kind"]


def questions(times, seed):
    """(name, answered, refused, without an answer) of the random questions; what is broken ends the program."""
    with tempfile.TemporaryDirectory() as folder:
        counts = Path(folder, "counts")
        tests = [f"Explore.test_{name}" for name in TESTS]
        if subprocess.run([sys.executable, Path(__file__).with_name("explore_input.py"), *tests], check=False, env={
                **os.environ, "ATTACKS": str(counts), "EXAMPLES": str(times), "SEED": str(seed)}).returncode:
            sys.exit("a promise is broken: see above")
        return [json.loads(line) for line in counts.read_text(encoding="utf-8").splitlines()]


def main(times=2, seconds=60):
    seed = int(subprocess.run(["git", "rev-list", "--count", "HEAD"], capture_output=True, check=True).stdout)
    rows = [[name, sum(ends), *ends, 0] for name, *ends in questions(int(times), seed)]
    ends = fuzz.attack_all(fuzz.BEGIN, int(seconds), seed) if fuzz.PROGRAM.exists() else {}
    for reader, (inputs, broken) in ends.items():
        print(f"{reader}: {inputs} inputs", broken)
        rows.append([READERS[reader], inputs, "", "", "", int(bool(broken))])
    if any(row[-1] for row in rows):
        return 1
    lines = HEAD + "".join("| " + " | ".join(f"{cell:,}" if isinstance(cell, int) else cell for cell in row) + " |\n" for row in rows)
    said = f"Seed {seed}, {sum(row[1] for row in rows):,} inputs.\n\n"
    page = PAGE.read_text(encoding="utf-8")
    PAGE.write_text(re.sub(r"(?<=<!-- counts -->\n).*?(?=<!-- end -->)", lambda _: said + lines, page, flags=re.S), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
