"""Runs the follow-up guide and the page on varying compliance as a reader would: its files written and its commands run, in order, in a copy of
the project. The copy's compiler takes every object whose source is the same from the project's own build, so
that only what the guide adds is compiled.
"""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

COPY = Path("build/guide")
BLOCK = re.compile(r"^```(?:(?P<plain>\w+)|\{\.\w+ (?P<kind>file|append)=\"(?P<file>[^\"]+)\"\})\n"
                   r"(?P<text>.*?)^```$", re.DOTALL | re.MULTILINE)

# CMake starts this with the compiler's command line, in the build folder of the copy.
LAUNCHER = """#!/bin/sh
for word; do
  case $before in -o) object=$word;; -c) source=$word;; esac
  before=$word
done
built=$PROJECT/build/$object
if [ -f "$built" ] && cmp -s "$source" "$PROJECT/${source#"$COPY/"}"; then
  exec cp "$built" "$object"
fi
echo "$source" >> "$COPY/build/compiled"
exec "$@"
"""


def copy_project():
    shutil.rmtree(COPY, ignore_errors=True)
    shutil.copytree(".", COPY, ignore=shutil.ignore_patterns(".git", "build", "build-*", "generated"))
    (COPY / "build").mkdir()
    launcher = COPY / "build" / "launcher"
    launcher.write_text(LAUNCHER, encoding="utf-8")
    launcher.chmod(0o755)
    return {**{name: value for name, value in os.environ.items() if not name.startswith("MAKE")},
            "CMAKE_CXX_COMPILER_LAUNCHER": str(launcher.resolve()),
            "PROJECT": str(Path.cwd()), "COPY": str(COPY.resolve())}


def run(block, environment):
    """One block; false if its command failed."""
    if block["kind"]:
        if block["file"].endswith(".hpp"):
            sys.exit(f"the guide changes {block['file']}: objects of the project cannot be taken")
        with (COPY / block["file"]).open("a" if block["kind"] == "append" else "w", encoding="utf-8") as file:
            file.write(block["text"])
    elif block["plain"] == "sh":
        return subprocess.run(["bash", "-euo", "pipefail", "-c", block["text"]], cwd=COPY,
                              env=environment).returncode == 0
    return True


def main():
    environment = copy_project()
    subprocess.run(["make", "build/explore"], cwd=COPY, check=True, env=environment)
    text = "".join(Path("paper", page).read_text(encoding="utf-8") for page in ("guide.md", "varying_compliance.md"))
    blocks = list(BLOCK.finditer(text))
    commands = sum(block["plain"] == "sh" for block in blocks)
    for block in blocks:
        if not run(block, environment):
            print(f"the guide fails at:\n{block['text']}", file=sys.stderr)
            return 1
    compiled = (COPY / "build" / "compiled").read_text(encoding="utf-8").splitlines()
    print(f"{len(blocks)} blocks, {commands} of them commands; compiled: {len(compiled)}")
    return 0 if commands >= 4 else 1


if __name__ == "__main__":
    sys.exit(main())
