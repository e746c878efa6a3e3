"""Running explore, for the tests; BUILD in the environment names another build folder than build."""
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np
from tables import Table

EXPLORE = Path(os.environ.get("BUILD", "build"), "explore").resolve()
CASES = Path("tests/cases").resolve()
SETS = {number: Path(f"data/set{number}.toml").resolve() for number in (1, 2)}
MACHINE = SETS[1].read_text(encoding="utf-8")
NAMES, FORCES = ["x_s", "y_s", "x_r", "y_r"], ["F_x", "F_y"]
AMPLITUDES = [f"amp_{name}" for name in NAMES]
RESPONSE = ["--from", "20", "--to", "21"]
ORBIT = ["--frequency", "45", "--points", "4"]
SIX, TO_1E_3 = ["--harmonics", 6], ["--method", "aft", "--tolerance", 1e-3]  # with one frequency, with one or two
SANITIZED = "SANITIZED" in os.environ  # slower, ten times and more
FULL = "FULL" in os.environ  # as `make test-all` sets it
NO_NUMBER = re.compile(r"(?<![^\W_])(nan|inf|infinity)(?![^\W_])", re.IGNORECASE)


def some(cases, every):
    """Each `every`-th of them, the first included; all with FULL."""
    return list(cases)[::1 if FULL else every]


def changed(text=MACHINE, **values):
    """The machine with other values of these keys, wherever they stand."""
    for key, value in values.items():
        text, count = re.subn(rf"(?m)^{key} = .*$", f"{key} = {value}", text)
        assert count > 0, key
    return text


def with_table(table, text=MACHINE):
    """The machine with this table instead of its own of the same name."""
    name = re.escape(table.partition("\n")[0])
    text, count = re.subn(rf"(?s){name}\n.*?(?=\n\[|\Z)", lambda _: f"{table}\n", text)
    assert count == 1, name
    return text


class Case(unittest.TestCase):
    """A folder of its own with data set 1 in machine.toml, where explore runs."""

    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.folder = Path(self.scratch.name)
        self.machine = self.file("machine.toml", MACHINE)

    def file(self, name, text):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path

    def run_explore(self, *arguments, program=EXPLORE, **how):
        how.setdefault("stdout", subprocess.PIPE)
        result = subprocess.run([program, *map(str, arguments)], stderr=subprocess.PIPE, cwd=self.folder,
                                encoding="utf-8", errors="surrogateescape", **how)
        self.assertGreaterEqual(result.returncode, 0, result.stderr)
        return result

    def refused(self, words, *arguments, status=2, **how):
        with self.subTest(words, arguments=arguments):
            result = self.run_explore(*arguments, **how)
            self.assertEqual(result.returncode, status, result.stderr)
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
            self.assertIn(words, result.stderr)
            self.assertFalse(result.stdout)
            return result

    def refused_each(self, cases, *command):
        """Pairs of a command's further options, in one string, and words of the message."""
        for options, words in cases:
            self.refused(words, *command, *options.split())

    def refused_machine(self, words, text):
        self.refused(words, "orbit", self.file("bad.toml", text), *ORBIT)

    def refused_change(self, old, new, words):
        """The machine with one piece of text replaced."""
        self.assertIn(old, MACHINE)
        self.refused_machine(words, MACHINE.replace(old, new, 1))

    def same(self, one, other, within, *groups):
        """Columns of two tables differ by at most this share of the largest value in their group."""
        for names in groups or [NAMES]:
            size = within * max(abs(other[name]).max() for name in names)
            for name in names:
                np.testing.assert_allclose(one[name], other[name], rtol=0, atol=size, err_msg=name)

    def said(self, table, *keys):
        """Values of keys of the header, None where it has none."""
        return [table.value(key, None) for key in keys]

    def lines(self, *arguments):
        """All that is printed where all goes well."""
        result = self.run_explore(*arguments)
        self.assertEqual((result.returncode, result.stderr), (0, ""), arguments)
        return result.stdout.splitlines()

    def table(self, *arguments):
        return Table.of("\n".join(self.lines(*arguments)))

    def rows(self, *arguments):
        """The lines that are no header."""
        return [line for line in self.lines(*arguments) if not line.startswith("#")]

    def values(self, *check):
        """What `check` says, by name."""
        table = self.table("check", *check)
        return dict(zip(table["name"], table["value"]))
