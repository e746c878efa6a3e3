"""The manual: every command of explore with its options, columns and keys, as the program itself names them.

Usage: /usr/bin/python3 paper/manual.py > manual.md   (from the project's root)
"""
import re
import subprocess

# A short run of each command, whose header names the columns.
MACHINE, ROTOR = "data/set1.toml", "data/rotors/overhung.toml"
RUNS = {"check": [MACHINE], "orbit": [MACHINE, "--frequency", "45", "--points", "4"],
        "contact": [MACHINE, "--frequency", "45", "--points", "4", "--columns", "all"],
        "response": [MACHINE, "--from", "40", "--to", "41", "--count", "2", "--columns", "all"],
        "spectrum": [MACHINE, "--frequency", "45", "--columns", "all"],
        "attractors": [MACHINE, "--from", "45", "--to", "46", "--count", "2", "--starts", "0", "--columns", "all"],
        "runup": [MACHINE, "--from", "44", "--to", "46", "--seconds", "1"],
        "campbell": [ROTOR, "--from", "0", "--to", "10", "--count", "2"]}
HEAD = """# Manual

What `explore` knows, as the program itself says it. Each command is `build/explore COMMAND FILE OPTIONS`; FILE is a machine, a TOML
file whose keys are in the [README](../../README.md). A table goes to stdout, one line to stderr where something is wrong; the exit
status is 0, 2 for what you can mend, and 3 where the question was good but has no answer. The [guide](../../paper/guide.md) shows the
commands at work.
"""


def told(*words):
    return subprocess.run(["build/explore", *words], capture_output=True, check=True, text=True).stdout


def cell(text):
    return text.replace("|", "\\|").replace("<", "&lt;").replace("*", "\\*").replace("_", "\\_").replace("$", "\\$")


def options(command):
    """Rows of the help: name, kind with its default, meaning; a long name has its meaning on the next line."""
    listed = told(command, "--help").split("Options:\n", 1)[1]
    for part in re.split(r"^  (?=-)", listed, flags=re.M)[1:]:
        words = re.match(r"(-\S+)(.*?)(?:[ ]{2,}|\n\s+| (?=[a-z]))(.*)", part.strip(), re.S)
        name = words[1].split(",")[-1]
        kind, meaning = words[2].strip(), " ".join(words[3].split())
        if needs := re.match(r"(Needs: \S+) (.*)", kind + " " + meaning):
            kind, meaning = needs[1], needs[2]
        yield name, kind, meaning


def table(names, rows):
    yield "| " + " | ".join(names) + " |"
    yield "|" + "---|" * len(names)
    for row in rows:
        yield "| " + " | ".join(row) + " |"
    yield ""


def columns(command):
    lines = told(command, *RUNS[command]).splitlines()
    for line in lines:
        if found := re.match(r"# column: (\S+) \[(.*?)\] (.*)", line):
            yield f"`{found[1]}`", cell(found[2]), cell(found[3])


def quantities():
    """Of the map: they stand in the meaning of its option."""
    meaning = dict((name, text) for name, _, text in options("map"))["--quantity"]
    for part in re.split(r"; (?=\w+ \[)", meaning.replace(" REQUIRED", "")):
        if found := re.match(r"(\w+) \[(.*?)\] (.*)", part):
            yield f"`{found[1]}`", cell(found[2]), cell(found[3])


def page():
    yield HEAD
    for command, meaning in re.findall(r"^  ([a-z]+) {2,}(.*)$", told("--help").split("Subcommands:")[1], re.M):
        yield f"## {command}\n\n{meaning[0].upper() + meaning[1:]}.\n"
        rows = [(f"`{name}`", cell(kind), "see the quantities below" if (command, name) == ("map", "--quantity") else cell(text))
                for name, kind, text in options(command)]
        yield from table(("option", "value", "meaning"), rows)
        if command in RUNS:
            yield from table(("column", "unit", "meaning"), columns(command))
        if command == "map":
            yield from table(("quantity", "unit", "meaning"), quantities())


if __name__ == "__main__":
    print("\n".join(page()))
