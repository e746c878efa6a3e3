"""explore with files and options that could surprise: each is refused with status 2 and one line, before
anything is computed, or does what it says.

Usage: tests/explore_files.py EXPLORE   (from the project's root)
"""
import os
import re
import resource
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

EXPLORE = str(Path(sys.argv.pop(1) if len(sys.argv) > 1 else "build/explore").resolve())
MACHINE = Path("data/set1.toml").read_text()
RESPONSE = ["--from", "20", "--to", "21"]
ORBIT = ["--frequency", "45", "--points", "4"]


class Case(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.folder = Path(self.scratch.name)
        self.machine = self.file("machine.toml", MACHINE)

    def file(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def run_explore(self, *arguments, **how):
        how.setdefault("stdout", subprocess.PIPE)
        result = subprocess.run([EXPLORE, *map(str, arguments)], stderr=subprocess.PIPE, text=True,
                                timeout=120, cwd=self.folder, **how)
        self.assertGreaterEqual(result.returncode, 0, result.stderr)
        return result

    def refused(self, words, *arguments, status=2, **how):
        result = self.run_explore(*arguments, **how)
        self.assertEqual(result.returncode, status, (arguments, result.stderr))
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertIn(words, result.stderr)
        self.assertFalse(result.stdout)
        return result

    def refused_machine(self, words, text):
        self.refused(words, "orbit", self.file("bad.toml", text), *ORBIT)

    def table(self, *arguments):
        result = self.run_explore(*arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout.splitlines()


class Save(Case):
    """What --save must never replace, and that it replaces a file whole or not at all."""

    def save(self, name):
        return ["response", self.machine, *RESPONSE, "--save", name]

    def test_only_regular_files(self):
        old = self.file("old.tsv", "old")
        (self.folder / "link").symlink_to(old)
        (self.folder / "dangling").symlink_to("nowhere")
        (self.folder / "folder").mkdir()
        os.mkfifo(self.folder / "fifo")
        for name, words in [("link", "symbolic link"), ("dangling", "symbolic link"),
                            ("folder", "is a directory"), ("fifo", "no regular file"),
                            ("/dev/null", "no regular file"), ("", "the name is empty"),
                            ("no/such/file", "folder does not exist")]:
            with self.subTest(name):
                self.refused(words, *self.save(name))
        self.assertEqual(old.read_text(), "old")
        self.assertTrue((self.folder / "dangling").is_symlink())

    def test_not_its_input(self):
        os.link(self.machine, self.folder / "hard_link.toml")
        (self.folder / "folder").mkdir()
        for name in ["machine.toml", "folder/../machine.toml", "hard_link.toml"]:
            with self.subTest(name):
                self.refused("is the input", *self.save(name))
        self.assertEqual(self.machine.read_text(), MACHINE)
        self.assertEqual(self.run_explore(*self.save("branch.tsv")).returncode, 0)
        self.refused("is the input", *self.save("branch.tsv"), "--restart", "branch.tsv")

    def test_not_the_standard_output(self):
        with open(self.folder / "table.tsv", "w") as out:
            self.refused("is the standard output", *self.save("table.tsv"), stdout=out)

    def test_writes_beside_and_through_no_link(self):
        victim = self.file("victim", "untouched")
        (self.folder / "branch.tsv.tmp").symlink_to(victim)
        os.mkfifo(self.folder / "other.tsv.tmp")
        self.file("branch.tsv", "old").chmod(0o600)
        for name in ["branch.tsv", "other.tsv"]:
            self.assertEqual(self.run_explore(*self.save(name)).returncode, 0)
            self.assertTrue((self.folder / name).read_text().startswith("# format:"))
        self.assertEqual(victim.read_text(), "untouched")
        self.assertEqual((self.folder / "branch.tsv").stat().st_mode & 0o777, 0o600)
        self.assertEqual(len(list(self.folder.iterdir())), 6)

    def test_full_disk_keeps_the_old_file(self):
        old = self.file("branch.tsv", "old")
        before = sorted(self.folder.iterdir())

        def no_room():
            signal.signal(signal.SIGXFSZ, signal.SIG_DFL)
            resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
        self.refused("cannot be written", *self.save("branch.tsv"), status=3, preexec_fn=no_room)
        self.assertEqual(old.read_text(), "old")
        self.assertEqual(sorted(self.folder.iterdir()), before)


class Files(Case):
    """Parameter files and saved branches."""

    def test_nested_too_deeply(self):
        for name, text in {"dotted key": "a." * 40000 + "a = 1\n",
                           "table": "[" + "a." * 40000 + "a]\n",
                           "arrays": "a = " + "[" * 40000 + "]" * 40000 + "\n",
                           "inline tables": "a = " + "{a = " * 40000 + "1" + "}" * 40000 + "\n",
                           "after a string": 'b = [ """x"""",\n{' + '"a" . ' * 40000 + "a = 1}]\n"}.items():
            with self.subTest(name):
                self.refused_machine("levels", MACHINE + text)

    def test_dots_that_nest_nothing(self):
        self.table("orbit", self.file("dots.toml", "# " + "." * 99 + "\n" + MACHINE.replace(
            'title = "', 'title = "' + "." * 99)), *ORBIT)

    def test_too_long(self):
        self.refused_machine("is longer than 1000000 bytes", MACHINE + "#" * 1000000)
        for name, arguments in [("machine", ["orbit", "huge", *ORBIT]),
                                ("branch", ["response", self.machine, *RESPONSE, "--restart", "huge"])]:
            with self.subTest(name), open(self.folder / "huge", "w") as huge:
                huge.truncate(100 * 10**9)
                self.refused("is longer than", *arguments)

    def test_no_control_characters(self):
        for character in ["\\n", "\\t", "\\u0007", "\\u0085", "\\u2028"]:
            with self.subTest(character):
                self.refused_machine("title must be one line",
                                     MACHINE.replace('title = "', 'title = "' + character))

    def test_no_line_from_a_file_name(self):
        lines = self.table("orbit", self.file("a\n# regime: none\nb.toml", MACHINE), *ORBIT)
        self.assertEqual([line for line in lines if line.startswith("# regime")],
                         ["# regime: periodic"])
        self.assertEqual(len([line for line in lines if not line.startswith("#")]), 5)
        self.refused("no such file", "orbit", "no\nsuch\nfile", *ORBIT)

    def test_unknown_key_with_a_suggestion(self):
        for known, unknown in [("balls", "bals"), ("mass_kg", "mass"),
                               ("cage_speed_ratio", "cage_speed_ration"), ("balls", "Balls")]:
            with self.subTest(unknown):
                self.refused_machine(f"{unknown} is not a known key here; did you mean {known}?",
                                     MACHINE.replace(known, unknown, 1))
        self.refused_machine("colour is not a known key", MACHINE.replace("balls", "colour = 1\nballs"))
        self.refused_machine("balls is missing", re.sub("balls.*", "", MACHINE))

    def test_clearance_that_is_never_closed(self):
        wide = self.file("wide.toml", re.sub("(radial_clearance_m = ).*", r"\g<1>20", MACHINE))
        for command, options in [("orbit", ORBIT), ("contact", ORBIT), ("response", RESPONSE)]:
            with self.subTest(command):
                self.assertIn("# warning: no ball touches its race: the clearance of 20 m is never closed",
                              self.table(command, wide, *options))
                self.assertFalse([line for line in self.table(command, self.machine, *options)
                                  if line.startswith("# warning")])


class Options(Case):
    def test_decimal_numbers_only(self):
        lines = self.table("orbit", self.machine, *ORBIT, "--harmonics", "010")
        self.assertTrue(any("m = 10, N = 84" in line for line in lines))
        for option, values in {"--harmonics": ["0x10", "6.5", "1e1", "", "six", "99999999999", "-1"],
                               "--frequency": ["0x1p3", "inf", "nan", "1e400", "1e-400", "", "0", "-3"],
                               "--budget": ["0", "1e16", "infinity"]}.items():
            for value in values:
                with self.subTest(option + " " + value):
                    rest = [] if option == "--frequency" else ["--frequency", "45"]
                    self.refused(f"{option} {value}: must be ", "orbit", self.machine, option, value, *rest)

    def test_unknown_option_with_a_suggestion(self):
        self.refused("--harmonic: not expected; did you mean --harmonics?",
                     "orbit", self.machine, *ORBIT, "--harmonic", "6")
        self.refused("--freqency: not expected; did you mean --frequency?",
                     "orbit", self.machine, "--freqency=45")
        self.refused("orbits: not expected; did you mean orbit?; subcommands: orbit, contact, response",
                     "orbits", self.machine, *ORBIT)

    def test_ignored_options(self):
        for method, options in {
                "rk8pd": ["--harmonics 6", "--samples 64", "--tolerance 1e-3", "--newton-tolerance 1e-9",
                          "--no-stability", "--step 1e-5"],
                "rk4": ["--harmonics 6", "--local-error 1e-9"],
                "aft": ["--local-error 1e-9", "--step 1e-5", "--longest 3"]}.items():
            for option in options:
                with self.subTest(method + " " + option):
                    self.refused(f"{option.split()[0]}: is for ", "orbit", self.machine, *ORBIT,
                                 "--method", method, *option.split())
        for option, needed in [("--seed", "--isolated"), ("--at", "--restart"), ("--branch", "--restart")]:
            self.refused(f"{option} requires {needed}", "response", self.machine, *RESPONSE, option, "20")

    def test_help_and_version(self):
        help_of_orbit = "\n".join(self.table("orbit", "--help"))
        for name in ["aft", "rk4", "rkf45", "rkck", "rk8pd", "msadams", "msbdf", "bsimp"]:
            self.assertIn(name, help_of_orbit)
        version = re.search("project.*VERSION ([0-9.]+)", Path("CMakeLists.txt").read_text())[1]
        self.assertIn(version, self.table("--version")[0])
        for arguments in [["--help"], ["orbit", "--help"], ["--version"], ["orbit", self.machine, *ORBIT]]:
            with self.subTest(arguments), open("/dev/full", "w") as full:
                self.refused("standard output", *arguments, status=3, stdout=full)

    def test_budget(self):
        """It bounds all commands, and is named with what was reached."""
        self.refused("the budget of 1e+04 evaluations of the force is used up; more with --budget",
                     "orbit", self.machine, *ORBIT, "--method", "rk4", "--budget", "1e4", status=3)
        lines = self.table("orbit", self.machine, *ORBIT, "--method", "rk4", "--budget", "1e7")
        counted = next(int(m[1]) for line in lines if (m := re.search("rest, ([0-9]+) evaluations", line)))
        self.assertIn(f"# budget: {counted:.3g} of 1e+07",
                      next(line for line in lines if line.startswith("# budget")))
        result = self.run_explore("response", self.machine, "--from", "1", "--to", "60", "--budget", "3e5")
        self.assertEqual(result.returncode, 3)
        self.assertRegex(result.stderr, r"stopped at [0-9.]+ Hz, before --to 60 Hz: the budget .* --budget")


if __name__ == "__main__":
    unittest.main()
