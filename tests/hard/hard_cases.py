"""The hard cases: every method ends with a confirmed answer or with a reason, and never with a wrong answer that
claims success. The verdicts of the kept table are formed anew from its numbers, and every fifth of its rows, so
that each method has its turn, is computed again. `make hard_cases` computes all.

Usage: tests/hard/hard_cases.py   (from the project's root)
"""
import os
import subprocess
import sys
import tomllib
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "figures"))
from tables import Table  # noqa: E402

PROGRAM = Path(os.environ.get("BUILD", "build"), "hard_cases")
SANITIZED = "SANITIZED" in os.environ
RULE = tomllib.loads(Path("data/scenes/hard_cases.toml").read_text(encoding="utf-8"))


def verdict(row):
    """What the rule of the list makes of the numbers of a row."""
    error, multiplier = row["check_error"], row["check_multiplier"]
    if row["status"] == 3:
        return "refused"
    if row["check"] == "none" or error < 0:
        return "unconfirmed"
    if row["regime"] == "aperiodic":
        return "solved" if error <= RULE["most_change"] else "silent error"
    if multiplier >= 0 and (row["stability"] == "stable" and multiplier > 1.001
                            or row["stability"] == "unstable" and multiplier < 0.999):
        return "silent error"
    stated = max(row["stated_error"], RULE["least_error"])
    allowed = min(RULE["most_error"], RULE["most_error_ratio"] * stated)
    return "solved" if error <= allowed else "silent error"


def rows(table):
    return [{name: column[k] for name, column in table.columns.items()} for k in range(len(table))]


class HardCases(unittest.TestCase):
    def check_refusal(self, row):
        self.assertGreater(len(row["note"]), 10)
        self.assertEqual((row["residual"], row["check_error"]), (-1, -1))

    def check_claim(self, row):
        self.assertGreaterEqual(row["residual"], 0)
        self.assertGreaterEqual(row["stated_error"], 0)
        if row["regime"] == "T-periodic":
            self.assertLessEqual(row["stated_error"], RULE["accuracy"])
            self.assertGreaterEqual(row["multiplier"], 0)

    def check_ends(self, table):
        for row in rows(table):
            with self.subTest(case=row["case"], method=row["method"], note=row["note"], check=row["check"]):
                self.assertEqual(row["verdict"], verdict(row))
                self.assertIn(row["verdict"], ("solved", "refused"))
                (self.check_refusal if row["status"] == 3 else self.check_claim)(row)

    def test_every_case_is_solved_or_refused(self):
        kept = Table("data/reference/hard_cases.tsv")
        cases = set(kept["case"])
        self.assertGreaterEqual(len(cases), 60)
        self.assertEqual(len(kept), 4 * len(cases))
        self.check_ends(kept)

    def test_rows_computed_again(self):
        every = 37 if SANITIZED else 5
        run = subprocess.run([PROGRAM, "--every", str(every)], check=True, stdout=subprocess.PIPE,
                             encoding="utf-8")
        again = Table.of(run.stdout)
        self.check_ends(again)
        kept = rows(Table("data/reference/hard_cases.tsv"))[::every]
        self.assertEqual([[row[name] for name in ("case", "method", "verdict", "regime")] for row in rows(again)],
                         [[row[name] for name in ("case", "method", "verdict", "regime")] for row in kept])


if __name__ == "__main__":
    unittest.main()
