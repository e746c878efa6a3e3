"""Runs the follow-up guide as a reader would: its files written and its commands run, in order, in a
copy of the repository that is kept between runs so that little is built anew.

Usage: tests/guide.py   (from the project's root)
"""
import filecmp
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

COPY = Path("build/guide")
BLOCK = re.compile(r"^```(?:(?P<plain>\w+)|\{\.\w+ (?P<kind>file|append)=\"(?P<file>[^\"]+)\"\})\n"
                   r"(?P<text>.*?)^```$", re.DOTALL | re.MULTILINE)


def copy_repository():
    """The tracked files, each copied only if it differs; what an earlier run added is removed."""
    tracked = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"],
                             text=True, check=True, capture_output=True).stdout.split("\n")
    files = {Path(name) for name in tracked if name and Path(name).is_file()}
    for folder in ("src", "data", "figures"):
        for old in (COPY / folder).rglob("*"):
            name = old.relative_to(COPY)
            if old.is_file() and name not in files and "generated" not in name.parts:
                old.unlink()
    for file in files:
        target = COPY / file
        if not target.exists() or not filecmp.cmp(file, target, shallow=False):
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(file, target)


def run(block):
    """One block; false if its command failed."""
    if block["kind"] == "file":
        (COPY / block["file"]).write_text(block["text"])
    elif block["kind"] == "append":
        with (COPY / block["file"]).open("a") as file:
            file.write(block["text"])
    elif block["plain"] == "sh":
        environment = {k: v for k, v in os.environ.items() if not k.startswith("MAKE")}
        return subprocess.run(["bash", "-euo", "pipefail", "-c", block["text"]], cwd=COPY,
                              env=environment).returncode == 0
    return True


def main():
    copy_repository()
    subprocess.run(["make", "build/explore"], cwd=COPY, check=True)
    blocks = list(BLOCK.finditer(Path("paper/guide.md").read_text()))
    commands = sum(block["plain"] == "sh" for block in blocks)
    for block in blocks:
        if not run(block):
            print(f"the guide fails at:\n{block['text']}", file=sys.stderr)
            return 1
    print(f"{len(blocks)} blocks, {commands} of them commands")
    return 0 if commands >= 4 else 1


if __name__ == "__main__":
    sys.exit(main())
