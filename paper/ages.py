"""How old the kept tables are: commits of the code that they rest on, since the one that computed them.

Usage: paper/ages.py   (from the project's root, in a clone)
"""
import re
import shutil
import subprocess
from pathlib import Path

RESTS_ON = ("src", "data/set1.toml", "data/set2.toml")


def age(table):
    """What a table's first lines and the history say; nothing for a table that `make all` computes."""
    table = Path(table)
    if "reference" not in table.parts:
        return ""
    found = re.search(r"^# source: rotor_stator (\S+) ?(\w*)", table.read_text(encoding="utf-8"), re.MULTILINE)
    if not found:
        return ""
    version, revision = found.groups()
    names = [*RESTS_ON, *map(str, Path("studies").glob(f"{table.stem}.*")), *map(str, Path("peers").glob(f"{table.stem}.py"))]
    if not shutil.which("git"):
        return f"kept from version {version}"
    count = subprocess.run(["git", "rev-list", "--count", f"{revision}..HEAD", "--", *names], capture_output=True, encoding="utf-8",
                           check=False)
    if not revision or count.returncode:
        return f"kept from version {version}"
    return f"kept from version {version}, {int(count.stdout)} commits of its code ago"


if __name__ == "__main__":
    for kept in sorted(Path("data/reference").rglob("*.tsv")):
        if told := age(kept):
            print(f"{kept.relative_to('data/reference').with_suffix('')}\t{told}")
