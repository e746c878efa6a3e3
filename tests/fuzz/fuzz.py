"""Readers of files against libFuzzer, each for FUZZ_SECONDS (60) with SEED (1): from
files of the project, and from what earlier runs kept in build/fuzz. Ends with status 1
where one breaks, and names the input.

Usage: make fuzz, or tests/fuzz/fuzz.py [READER…]   (from the project's root)
"""
import os
import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

PROGRAM, FOLDER = Path("build/fuzz/readers"), Path("build/fuzz")
BEGIN = {"machine": "tests/cases/*.toml", "scene": "data/scenes/*.toml",
         "matrix": "data/rotors/*/*.mtx", "table": "tests/golden/tab*.tsv",
         "json": "tests/cases/*.toml"}


def attack(reader, seconds, seed=1):
    """How many inputs a reader took, and what libFuzzer says of the one that broke it."""
    known = FOLDER / reader
    known.mkdir(parents=True, exist_ok=True)
    for file in Path().glob(BEGIN[reader]):
        shutil.copy(file, known)
    words = [PROGRAM, f"-max_total_time={seconds}", f"-seed={seed}", "-max_len=5000",
             "-timeout=20", "-rss_limit_mb=2500", "-print_final_stats=1",
             f"-artifact_prefix={FOLDER}/", known]
    run = subprocess.run(words, env={**os.environ, "FUZZ": reader}, capture_output=True,
                         encoding="utf-8", errors="replace", check=False)
    count = re.search(r"stat::number_of_executed_units: (\d+)", run.stderr)
    return int(count[1]) if count else 0, run.stderr[-3000:] if run.returncode else ""


def attack_all(readers, seconds, seed=1):
    """{reader: (inputs, what broke)}, two at a time."""
    with ThreadPoolExecutor(2) as pool:
        ends = pool.map(lambda reader: attack(reader, seconds, seed), readers)
        return dict(zip(readers, ends))


def main(readers):
    seconds, seed = (int(os.environ.get(name, usual))
                     for name, usual in (("FUZZ_SECONDS", 60), ("SEED", 1)))
    ends = attack_all(readers or list(BEGIN), seconds, seed)
    for name, (inputs, broken) in ends.items():
        print(f"{name}: {inputs} inputs", broken, flush=True)
    return any(broken for _, broken in ends.values())


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
