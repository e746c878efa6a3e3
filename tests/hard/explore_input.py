"""Whatever explore is asked, it ends by itself with status 0, 2 or 3 and the output that belongs to it.

    0   a table of finite numbers on stdout, on stderr at most how many points of a map have no result, and a warning of the speed
    2   bad input: one line on stderr, nothing on stdout
    3   no solution: warnings of the machine, then one line on stderr, at most a part of a table on stdout

No run takes minutes, whatever the machine, or leaves a file behind that was not asked for, or half of one. The questions are drawn by hypothesis,
the same in every run; what fails is shrunk to the simplest question that still fails. Other questions:
EXAMPLES=10 (times as many) SEED=7. With ATTACKS=FILE the counts of each test are added to a file (attack.py).

Usage: python3 -m unittest tests/hard/explore_input.py   (from the project's root)
"""
import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from collections import Counter
from functools import cache
from pathlib import Path

os.environ.setdefault("HYPOTHESIS_STORAGE_DIRECTORY", "build/hypothesis")
from hypothesis import HealthCheck, given, seed, settings
from hypothesis import strategies as st

from tests.hard import odd
from tests.machines import SET_1, decade, entries, extreme_machine, of_another_kind, written
from tests.support.explore import EXPLORE, FULL, NO_NUMBER, SANITIZED

# Evaluations of the force: a few milliseconds of work.
LITTLE = "1e5"
GOOD_FILE = written(entries(SET_1)).encode()
LONGEST = 1200 if SANITIZED else 120  # [s] of a run; with LITTLE most take milliseconds
WRITTEN = ("--save", "--section", "--motions", "--waterfall", "--plot", "--to")

# ----------------------------------------------------------------------------------------------------
# What may come of a question

# The title is the reader's, the flags may name NaN.
QUOTED = ("# parameters:", "# compiler:")


def table_fault(text):
    """What is wrong with a table; None when every row has as many finite numbers as there are names."""
    lines = [line for line in text.splitlines() if not line.startswith(QUOTED)]
    for line in lines:
        if NO_NUMBER.search(line):
            return f"not finite: {line}"
    rows = [line.split("\t") for line in lines if line and not line.startswith("#")]
    if len(rows) < 2:
        return "no rows"
    return next((f"cells of row {k}" for k, row in enumerate(rows) if len(row) != len(rows[0])), None)


def fault(status, out, err):
    """What is wrong with the end of a run, or None."""
    if status == 0:
        if not re.fullmatch(r"(\d+ of \d+ points have no result: see their status\n)?(warning: [^\n]*\n)*", err):
            return "status 0 with words on stderr"
        words = out.startswith("Explores") or "Usage:" in out[:200] or re.match(r"rotor_stator \d", out)
        return None if words else table_fault(out)
    if status == 2:
        if out:
            return "status 2 with words on stdout"
        return None if re.fullmatch(r"[^\n]+\n", err) else "status 2 without one line on stderr"
    if status == 3:
        if not re.fullmatch(r"(warning: [^\n]*\n)*(?!warning: )[^\n]+\n", err):
            return "status 3 without one line on stderr behind the warnings"
        if NO_NUMBER.search(err):
            return "status 3 with a reason that is not a number"
        return table_fault(out) if out else None
    return f"status {status}"


def left_behind(folder, files, arguments, status):
    """A file that was changed, not asked for, or not finished."""
    for name, content in files.items():
        if (folder / name).read_bytes() != content:
            return f"{name} was changed"
    more = {file.name for file in folder.iterdir()} - files.keys()
    asked = {name for option, name in zip(arguments, arguments[1:]) if option in WRITTEN}
    asked |= {"M.mtx", "C.mtx", "G.mtx", "K.mtx"} if "." in asked else set()
    if more - asked:
        return f"left behind: {sorted(more)}"
    if more and status == 2:
        return "saved, although the input was bad"
    for file in (folder / name for name in more):
        if file.is_dir() and {part.name for part in file.iterdir()} != {"M.mtx", "C.mtx", "G.mtx", "K.mtx"}:
            return "a folder saved in part"
        if not all(part.read_bytes().endswith(b"\n") for part in (file.iterdir() if file.is_dir() else [file])):
            return "saved in part"
    return None


# ----------------------------------------------------------------------------------------------------
# Values. A strategy is made once: making one costs more than drawing from it.


@cache
def one(*values):
    return st.sampled_from(values)


@cache
def upto(last):
    return st.integers(0, last)


@cache
def one_in(count):
    return upto(count - 1).map((count - 1).__eq__)


@cache
def real(low, high):
    """10^low … 10^high as an option's value."""
    return st.randoms().map(lambda dice: repr(decade(dice, low, high)))


@cache
def whole(low, high):
    return st.randoms().map(lambda dice: f"{decade(dice, low, high):.0f}")


# ----------------------------------------------------------------------------------------------------
# Spoilt files


@st.composite
def entry_spoilt(draw, lines):
    """One entry wrong: in value, in name or in place."""
    at = draw(upto(len(lines) - 1))
    table, key, value = lines[at]
    which = draw(one("value", "swap", "missing", "twice", "longer", "shorter", "moved"))
    lines = list(lines)
    if which == "value":
        lines[at] = [table, key, draw(one(*odd.VALUES))]
    elif which == "swap":
        other = draw(upto(len(lines) - 1))
        lines[at], lines[other] = [table, key, lines[other][2]], [*lines[other][:2], value]
    elif which == "missing":
        del lines[at]
    elif which == "twice":
        lines.insert(at, lines[at])
    elif which == "longer":
        lines[at] = [table, key + draw(one("s", "_", " ", ".", "é", '"', "=", "-")), value]
    elif which == "shorter":
        out = draw(upto(len(key) - 1))
        lines[at] = [table, key[:out] + key[out + 1:], value]
    else:
        lines[at] = [draw(one("", "stator", "rotor", "bearing", "x.y")), key, value]
    return lines


MUCH = st.integers(1, 50_000)
FOREIGN = st.one_of(
    st.sampled_from([f"\n{line}\n".encode() for line in odd.LINES]),
    st.binary(min_size=1, max_size=8),
    st.text(max_size=20).map(str.encode),
    MUCH.map(lambda count: b"[" * count),
    MUCH.map(lambda count: b"{a=" * count),
    MUCH.map(lambda count: b"x = " + b"9" * count + b"\n"),
    MUCH.map(lambda count: b'"' + b"k" * count + b'" = 1\n'),
    MUCH.map(lambda count: b"a" + b".a" * count + b" = 1\n"),
    st.integers(1, 4).map(lambda count: b"\0" * count))


@st.composite
def bytes_spoilt(draw, content):
    """The bytes wrong: cut, replaced, other ends of lines, another encoding, or something foreign."""
    which = draw(st.sampled_from(["foreign"] * 6 + ["cut", "noise", "lines", "encoding"]))
    at = draw(upto(len(content)))
    if which == "cut":
        return content[:at]
    if which == "noise":
        return draw(st.binary(max_size=400))
    if which == "lines":
        return content.replace(b"\n", b"\r\n")
    if which == "encoding":
        return draw(one(b"\xef\xbb\xbf", b"\xff\xfe", b"\xc3")) + content
    return content[:at] + draw(FOREIGN) + content[at:]


@st.composite
def spoilt_files(draw):
    """The file of data set 1 with one to three things wrong."""
    lines = entries(SET_1)
    faults = draw(st.lists(st.sampled_from(["entry", "entry", "bytes"]), min_size=1, max_size=3))
    for _ in range(faults.count("entry")):
        lines = draw(entry_spoilt(lines))
    content = written(lines).encode()
    for _ in range(faults.count("bytes")):
        content = draw(bytes_spoilt(content))
    return content


@st.composite
def spoilt_branches(draw, saved):
    """A saved branch with something wrong: bytes, a cell, a line twice, missing or in another place."""
    if draw(st.booleans()):
        return draw(bytes_spoilt(saved))
    lines = saved.decode().split("\n")
    at = draw(upto(len(lines) - 2))
    which = draw(one("cell", "cell", "twice", "missing", "swap"))
    if which == "cell":
        cells = re.split("([\t ])", lines[at])
        cells[2 * draw(upto(len(cells) // 2))] = draw(one(*odd.CELLS))
        lines[at] = "".join(cells)
    elif which == "twice":
        lines.insert(at, lines[at])
    elif which == "missing":
        del lines[at]
    else:
        other = draw(upto(len(lines) - 2))
        lines[at], lines[other] = lines[other], lines[at]
    return "\n".join(lines).encode()


# ----------------------------------------------------------------------------------------------------
# Options


@st.composite
def chosen(draw, possible):
    """Some of the options: {name: (one in so many, values)}."""
    return [[name, draw(values)] for name, (count, values) in possible.items() if draw(one_in(count))]


@st.composite
def motion_options(draw, extreme):
    """Options of orbit and contact, the `extreme` ones over their whole range."""
    frequency = draw(real(-3, 5) if extreme else real(0, 2))
    if extreme and draw(one_in(10)):
        frequency = draw(real(-300, 300))
    method = draw(one("aft", "aft", "aft", "rk4", "splitting", "rkf45", "rkck", "rk8pd", "msadams",
                                   "msbdf", "bsimp"))
    options = [["--frequency", frequency]]
    if method != "aft" or draw(one_in(2)):
        options.append(["--method", method])
    options += draw(chosen({"--points": (2, whole(0, 3 if extreme else 2)), "--columns": (4, st.just("all"))}))
    if method == "aft":
        return options + draw(chosen({
            "--harmonics": (2, whole(0, 3.6 if extreme else 1.5)),
            "--samples": (4, whole(1, 6 if extreme else 3)),
            "--tolerance": (4, real(-8, -1)), "--subharmonic": (6, st.integers(2, 8).map(str)),
            "--newton-tolerance": (4, real(-15, -3))}))
    return options + draw(chosen({
        "--longest": (4, real(-3, 5 if extreme else 0)),
        **({"--step": (2, real(-12 if extreme else -6, -1))} if method in ("rk4", "splitting") else
           {"--local-error": (2, real(-15, -2))})}))


def span(draw, extreme):
    """--from and --to of a row of speeds."""
    dice = draw(st.randoms())
    start = decade(dice, -4 if extreme else 0, 4 if extreme else 1.5)
    return [["--from", repr(start)], ["--to", repr(start * (1 + decade(dice, -3, 4 if extreme else 0.5)))]]


@st.composite
def response_options(draw, extreme):
    ends = span(draw, extreme)
    options = draw(chosen({
        "--harmonics": (2, whole(0, 2.5 if extreme else 1)), "--samples": (4, whole(1, 5 if extreme else 3)),
        "--newton-tolerance": (4, real(-15, -3)), "--direction": (4, st.sampled_from(["up", "down"])),
        "--columns": (4, st.just("all")), "--harmonics-of": (6, st.sampled_from(["x_s", "y_r"])),
        "--isolated": (8, whole(0, 1)), "--save": (8, st.just("saved.tsv")), "--waterfall": (12, st.just("lines.tsv")),
        "--plot": (60, st.just("figure.svg"))}))
    if draw(one_in(8)):
        options = [["--subharmonic", draw(st.integers(2, 4).map(str))],
                   *(option for option in options if option[0] not in ("--isolated", "--save", "--waterfall"))]
    return [*ends, *options]


@st.composite
def attractors_options(draw, extreme):
    ends = span(draw, extreme)
    options = draw(chosen({"--starts": (2, whole(0, 1)), "--seed": (4, whole(0, 9)),
                           "--section": (4, st.just("saved.tsv")), "--motions": (4, st.just("motions.tsv"))}))
    return [*ends, ["--count", draw(whole(0, 1))], *options]


def spectrum_options(extreme):
    """Those of orbit without --points, which have limits of their own."""
    return motion_options(extreme).map(lambda options: [option for option in options if option[0] != "--points"])


@st.composite
def check_options(draw, extreme):
    dice = draw(st.randoms())
    start = decade(dice, -300 if extreme and draw(one_in(4)) else -4, 4)
    return [["--from", repr(start)], ["--to", repr(start * (1 + decade(dice, -3, 4)))]]


# Exponents of ten of the values of an axis of a map.
AXES = {"frequency": (0, 2), "bearing.radial_clearance_m": (-7, -3), "rotor.mass_kg": (-1, 3), "rotor.unbalance_kg_m": (-6, 0),
        "bearing.contact_stiffness_N_per_m1p5": (7, 13)}
SWEPT = ["peak", "peak_frequency", "permanent", "loss_first", "loss_last", "largest_load", "missed"]
HERE = ["amplitude", "mean", "contact_share", "ball_load", "force", "stability", "multiplier", "uncertainty", "period", "regime", "lyapunov",
        "amp_1X_y_r", "iso_x_r"]
BALANCED = ["harmonics", "distance", "error", "evaluations", "series", "series_stability"]


@st.composite
def map_options(draw, extreme):
    dice = draw(st.randoms())
    is_swept = draw(one_in(4))
    keys = draw(st.lists(one(*list(AXES)[is_swept:]), min_size=1, max_size=2, unique=True))
    options = []
    for option, key in zip(("--x", "--y"), keys):
        wide = 3 if extreme else 0
        ends = sorted(decade(dice, AXES[key][0] - wide, AXES[key][1] + wide) for _ in "ab")
        options.append([option, f"{key}={ends[0]!r}:{ends[1]!r}:{draw(st.integers(1, 4))}" + draw(one("", "", ":log"))])
    if is_swept:
        start = decade(dice, 0, 2)
        options.append(["--sweep", f"{start!r}:{start * (1 + decade(dice, -2, 1))!r}:{draw(whole(0.31, 5 if extreme else 2))}"])
    elif "frequency" not in keys:
        options.append(["--frequency", draw(real(-3, 5) if extreme else real(0, 2))])
    method = draw(one("auto", "aft", "aft", "rk4", "splitting"))
    known = SWEPT if is_swept else HERE + BALANCED * (method == "aft")
    options += [["--quantity", ",".join(draw(st.lists(st.sampled_from(known), min_size=1, max_size=4, unique=True)))]]
    if method == "aft" or is_swept:
        return [*options, ["--harmonics", draw(whole(0, 2.5 if extreme else 1))]]
    return [*options, ["--method", method], *draw(chosen({"--tolerance": (4, real(-8, -1)), "--longest": (4, real(-3, 5))}))]


@st.composite
def campbell_options(draw, extreme):
    dice = draw(st.randoms())
    start = 0.0 if draw(one_in(3)) else decade(dice, -4, 4 if extreme else 2)
    end = start + decade(dice, -3, 5 if extreme else 2)
    return [["--from", repr(start)], ["--to", repr(end)], ["--count", draw(whole(0.31, 3 if extreme else 1))],
            *draw(chosen({"--modes": (3, whole(0, 3)), "--plot": (40, st.just("figure.svg"))}))]


@st.composite
def runup_options(draw, extreme):
    dice = draw(st.randoms())
    speeds = [decade(dice, -3 if extreme else 0, 4 if extreme else 2), draw(one(0.0, 1.0)) * decade(dice, 0, 2)]
    dice.shuffle(speeds)
    return [["--from", repr(speeds[0])], ["--to", repr(speeds[1])], ["--seconds", draw(real(-3, 4 if extreme else 0))],
            *draw(chosen({"--plot": (40, st.just("figure.svg"))}))]


OPTIONS_OF = {"check": check_options, "orbit": motion_options, "contact": motion_options, "spectrum": spectrum_options,
              "response": response_options, "attractors": attractors_options, "map": map_options, "campbell": campbell_options,
              "runup": runup_options}


@st.composite
def questions(draw, extreme):
    """A command and its options, as [name, value]."""
    command = draw(one("orbit", "response", *OPTIONS_OF))
    return command, draw(OPTIONS_OF[command](extreme))


def words_of(command, options):
    return [command, "machine.toml", *(word for option in options for word in option)]


WORDS = st.one_of(st.sampled_from(odd.WORDS), st.sampled_from(odd.WORDS),
                  st.text(st.characters(blacklist_characters="\0", blacklist_categories=["Cs"]), max_size=9),
                  st.integers(1, 5000).map(lambda count: "9" * count),
                  st.integers(1, 5000).map(lambda count: "x" * count))


@st.composite
def options_spoilt(draw, options):
    """One to three options wrong: in value, in name, missing, twice, or another method's."""
    options = list(options)
    for _ in range(draw(st.integers(1, 3))):
        at = draw(upto(len(options) - 1))
        name, value = options[at]
        which = draw(st.sampled_from(["value"] * 4 + ["missing", "twice", "misspelt", "unknown", "foreign"]))
        if which == "value":
            options[at] = [name, draw(st.sampled_from(odd.SAVES) if name in WRITTEN else WORDS)]
        elif which == "missing" and len(options) > 1:
            del options[at]
        elif which == "twice":
            options.append(options[at])
        elif which == "misspelt":
            options[at] = [name + draw(one("s", "=", " ", "-", "é")), value]
        elif which == "unknown":
            options[at] = [draw(one("--colour", "-f", "--", "--from")), value]
        elif which == "foreign":
            options.append(draw(st.sampled_from([
                ["--step", "1e-4"], ["--local-error", "1e-9"], ["--harmonics", "6"], ["--branch", "2"],
                ["--tolerance", "1e-3"], ["--at", "30"], ["--seed", "3"], ["--longest", "1"],
                ["--count", "2"], ["--starts", "1"], ["--plot", "figure.gif"]])))
    return options


@st.composite
def spoilt_questions(draw):
    """The arguments of a question that has one to three things wrong."""
    command, options = draw(questions(extreme=False))
    path = "machine.toml"
    if draw(one_in(12)):
        path = draw(st.one_of(st.sampled_from(odd.PATHS), st.integers(1, 9000).map(lambda k: "p" * k),
                              st.integers(1, 9000).map(lambda k: "/" * k)))
    if draw(one_in(20)):
        command = draw(WORDS)
    options = draw(options_spoilt(options))
    extra = [draw(WORDS)] if draw(one_in(8)) else []
    return [command, path, *(word for option in options for word in option), *extra]


@st.composite
def extreme_questions(draw, flags=True, another_kind=False):
    """A legal machine and legal options, both over their whole range."""
    dice = draw(st.randoms())
    machine = extreme_machine(dice)
    if another_kind:
        machine = of_another_kind(dice, machine)
    command, options = draw(questions(extreme=True))
    words = words_of(command, options)
    if flags and command == "response" and draw(one_in(4)):
        words.append("--stability")
    return written(entries(machine)).encode(), words


@cache
def rotor_files():
    """An overhung rotor by its matrices, and where its nodes are, as explore writes them."""
    folder = Path("data/rotors")
    nodes = subprocess.run([EXPLORE, "shaft", folder.resolve() / "overhung_shaft.toml", "--to", "matrices"], cwd=tempfile.mkdtemp(),
                           stdout=subprocess.PIPE, check=True).stdout
    machine = (folder / "overhung.toml").read_bytes().replace(b'matrices = "overhung"', b'matrices = "."')
    return {"machine.toml": machine, "nodes.tsv": nodes, **{f"{name}.mtx": (folder / f"overhung/{name}.mtx").read_bytes() for name in "MCGK"}}


@st.composite
def rotor_questions(draw):
    """Of a shaft, or of a rotor by its matrices, one of its files spoilt as often as not."""
    command = draw(one("shaft", "shape", "shape", *OPTIONS_OF))
    if command == "shaft":
        files, options = {"machine.toml": Path("data/rotors/overhung_shaft.toml").read_bytes()}, [["--to", draw(one("new", "new", ".", "machine.toml", *odd.SAVES[3:]))]]
    else:
        files, options = dict(rotor_files()), draw(OPTIONS_OF.get(command, motion_options)(extreme=False))
        options += [["--nodes", "nodes.tsv"]] * (command == "shape")
    if draw(st.booleans()):
        name = draw(one(*files))
        files[name] = draw(bytes_spoilt(files[name]))
    return files, words_of(command, options)


# Two branches along one speed, whose every step met all earlier ones; what else was once counted too cheap is counted in
# tests/unit/budget.cpp. [options, changes of data set 1]
ONCE_TOO_CHEAP = [
    ("--from 0.09015749 --to 852.3173 --harmonics 2",
     {"stator": {"natural_frequency_rad_per_s": 33.98298},
      "rotor": {"mass_kg": 0.01087106, "damping_ratio": 1.51218e-218, "unbalance_kg_m": 0.01518976},
      "bearing": {"balls": 2, "contact_stiffness_N_per_m1p5": 5.910089e13, "radial_clearance_m": 0},
      "gravity": {"acceleration_m_per_s2": 0}}),
    ("--from 0.005457668 --to 42.16881 --harmonics 1",
     {"stator": {"mass_kg": 0.0129118, "natural_frequency_rad_per_s": 3.87691, "damping_ratio": 0.003339069},
      "rotor": {"mass_kg": 448.9508, "damping_ratio": 0.1268511},
      "bearing": {"balls": 2, "contact_stiffness_N_per_m1p5": 2.288292e11, "radial_clearance_m": 0},
      "gravity": {"acceleration_m_per_s2": 18.66814}})]


# ----------------------------------------------------------------------------------------------------
# The tests


TIMES = float(os.environ.get("EXAMPLES", 1)) * (1 if FULL else 0.25)  # the questions of each test


class Explore(unittest.TestCase):
    """In one folder, emptied before each question."""

    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory(prefix="rotor_stator_")
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = Path(scratch.name)

    def ask(self, arguments, content=GOOD_FILE, budget=LITTLE, **files):
        """Runs explore; returns its status, after the check of all that it printed and left."""
        files = {"machine.toml": content, **files}
        if budget and arguments[0] not in ("check", "shaft"):
            arguments = [*arguments, "--budget", budget]
        for old in self.folder.iterdir():
            shutil.rmtree(old) if old.is_dir() else old.unlink()
        for name, content in files.items():
            (self.folder / name).write_bytes(content)
        words = [str(EXPLORE).encode(), *(word.encode("utf-8", "surrogateescape") for word in arguments)]
        run = subprocess.run(words, cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True,
                             timeout=LONGEST if LITTLE in arguments else 1800)
        out, err = (text.decode("utf-8", "surrogateescape") for text in (run.stdout, run.stderr))
        wrong = fault(run.returncode, out, err) or left_behind(self.folder, files, arguments, run.returncode)
        assert not wrong, f"{wrong}\nexplore {arguments}\n{err[:2000]}\n" + "\n".join(
            f"{name}: {content[:2000]!r}" for name, content in files.items())
        return run.returncode

    def asked(self, what, count, *drawn, question, budget=LITTLE):
        """How many questions ended with each status: words, file of the machine and other files, of what was drawn."""
        tally = Counter()

        @settings(max_examples=round(count * TIMES), deadline=None, database=None, derandomize="SEED" not in os.environ,
                  print_blob=False, suppress_health_check=list(HealthCheck))
        @seed(int(os.environ.get("SEED", 0)))
        @given(st.tuples(*drawn))
        def run(values):
            words, content, *files = question(*values)
            tally[self.ask(words, content, budget, **dict(*files))] += 1

        run()
        print(dict(tally))
        if "ATTACKS" in os.environ:
            with open(os.environ["ATTACKS"], "a", encoding="utf-8") as file:
                print(json.dumps([what, tally[0], tally[2], tally[3]]), file=file)
        return tally

    def test_spoilt_parameter_files(self):
        tally = self.asked("files of machines, spoilt", 2000, spoilt_files(), questions(extreme=False),
                           question=lambda content, asked: (words_of(*asked), content))
        self.assertGreater(tally[2], tally[0])

    def test_spoilt_options(self):
        tally = self.asked("command lines, spoilt", 1500, spoilt_questions(), question=lambda words: (words, GOOD_FILE))
        self.assertGreater(tally[2], tally[0])

    def test_spoilt_branches_to_restart(self):
        words = ["response", "machine.toml", "--from", "40", "--to", "41"]
        self.assertEqual(self.ask(["orbit", "machine.toml", "--frequency", "45", "--harmonics", "6"], budget=None), 0)
        self.assertEqual(self.ask([*words, "--harmonics", "6", "--save", "saved.tsv"]), 0)
        saved = (self.folder / "saved.tsv").read_bytes()
        tally = self.asked("saved branches, spoilt", 400, spoilt_branches(saved),
                           st.sampled_from([[], ["--at", "40.5"], ["--direction", "down"]]), question=lambda branch, more: (
                               [*words, "--restart", "branch.tsv", *more], GOOD_FILE, {"branch.tsv": branch}))
        self.assertGreater(tally[2], tally[0])

    def test_rotors_given_by_matrices(self):
        tally = self.asked("rotors given by matrices", 600, rotor_questions(),
                           question=lambda asked: (asked[1], asked[0].pop("machine.toml"), asked[0]))
        self.assertGreater(min(tally[0], tally[2]), 0)

    def test_legal_and_extreme_machines_and_options(self):
        tally = self.asked("extreme machines and options", 600, extreme_questions(), question=lambda asked: asked[::-1])
        self.assertGreater(tally[0] + tally[3], tally[2])

    def test_legal_and_extreme_machines_of_another_kind(self):
        tally = self.asked("extreme machines of other kinds", 600, extreme_questions(another_kind=True), question=lambda asked: asked[::-1])
        self.assertGreater(tally[0] + tally[3], tally[2])

    def test_legal_and_extreme_machines_with_the_budget_of_explore(self):
        self.asked("extreme machines without `--budget`", 20, extreme_questions(flags=False), question=lambda asked: asked[::-1],
                   budget="3e6" if SANITIZED else None)

    def test_machines_whose_work_was_once_counted_too_cheap(self):
        for words, changes in ONCE_TOO_CHEAP:
            machine = {table: {**keys, **changes.get(table, {})} for table, keys in SET_1.items()}
            with self.subTest(words=words):
                status = self.ask(["response", "machine.toml", *words.split()], written(entries(machine)).encode(),
                                  "3e6" if SANITIZED else None)
                self.assertIn(status, (0, 3))
