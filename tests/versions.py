"""One version everywhere: that of CMakeLists.txt in CITATION.cff, codemeta.json, CHANGELOG.md and the
headers of all computed tables; every scene in data/tables.mk. A kept table may be of an earlier version, but must name one or the
revision that computed it.
"""
import json
import re
import sys
from pathlib import Path

GENERATED, KEPT = Path("data/generated"), Path("data/reference")


def found(pattern, file):
    match = re.search(pattern, Path(file).read_text(encoding="utf-8"), re.MULTILINE)
    return match[1] if match else None


def computed():
    """The tables of `make all`; what other targets left behind may be of an earlier version."""
    kept = {table.name for table in KEPT.glob("*.tsv")} - {"claims.tsv"} | {"bench.tsv"}
    return [table for table in sorted(GENERATED.rglob("*.tsv")) if table.name not in kept]


def versions():
    yield "CITATION.cff", found(r"^version: (\S+)", "CITATION.cff")
    yield "codemeta.json", json.loads(Path("codemeta.json").read_text(encoding="utf-8"))["version"]
    yield "CHANGELOG.md", found(r"^## (\d\S*)", "CHANGELOG.md")
    for table in computed():
        yield str(table), found(r"^# source: rotor_stator (\S+)", table)


def main():
    version = found(r"project\(rotor_stator VERSION (\S+)", "CMakeLists.txt")
    faults = [f"{file}: version {other}, CMakeLists.txt has {version}"
              for file, other in versions() if other != version]
    faults += [f"{table}: no revision" for table in sorted(KEPT.glob("*.tsv"))
               if not found(r"^# source: (\S+)", table)]
    listed = Path("data/tables.mk").read_text(encoding="utf-8").split()
    faults += [f"{scene}: not in data/tables.mk" for scene in sorted(Path("data/scenes").glob("*.toml"))
               if scene.stem not in listed]
    for fault in faults:
        print(fault, file=sys.stderr)
    print(f"version {version}, {len(computed())} tables, {len(faults)} faults")
    return 1 if faults or len(computed()) < 20 else 0


if __name__ == "__main__":
    sys.exit(main())
