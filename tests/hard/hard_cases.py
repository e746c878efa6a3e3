"""The hard cases: every method ends with a confirmed answer or with a reason, and never with a wrong answer that
claims success. The verdicts of the kept table are formed anew from its numbers, and every 34th case is computed
again, with FULL in the environment every seventeenth. `make hard_cases` computes all.
"""
import subprocess
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path

import hard_cases
from tables import Table

from tests.support.explore import FULL, SANITIZED

SCENE = "data/scenes/hard_cases.toml"
RULE = tomllib.loads(Path(SCENE).read_text(encoding="utf-8"))
EVERY = 43 if SANITIZED else 17 if FULL else 34


def rows(table):
    return [{name: column[k] for name, column in table.columns.items()} for k in range(len(table))]


class HardCases(unittest.TestCase):
    def check_ends(self, table):
        for row in rows(table):
            with self.subTest(case=row["case"], method=row["method"], note=row["note"], check=row["check"]):
                self.assertEqual(row["verdict"], hard_cases.verdict(row, RULE))
                self.assertNotEqual(row["verdict"], "silent error")
                if row["status"] == 3:
                    self.assertGreater(len(row["note"]), 10)
                    self.assertEqual(row["check_error"], -1)
                elif row["regime"] == "T-periodic":
                    self.assertTrue(0 <= row["stated_error"] <= RULE["accuracy"])

    def test_every_case_is_solved_or_refused(self):
        kept = Table("data/reference/hard_cases.tsv")
        cases = set(kept["case"])
        self.assertGreaterEqual(len(cases), 60)
        self.assertEqual(len(kept), len(hard_cases.METHODS) * len(cases))
        self.check_ends(kept)
        self.assertLess(sum(kept["verdict"] == "unconfirmed"), 0.03 * len(kept))

    def test_cases_computed_again(self):
        run = subprocess.run([sys.executable, "studies/hard_cases.py", SCENE, "--every", str(EVERY)], check=True,
                             stdout=subprocess.PIPE, encoding="utf-8")
        again = rows(Table.of(run.stdout))
        self.check_ends(Table.of(run.stdout))
        cases = {row["case"] for row in again}
        kept = [row for row in rows(Table("data/reference/hard_cases.tsv")) if row["case"] in cases]
        self.assertEqual(*([[row[name] for name in ("case", "method", "verdict", "regime")] for row in some] for some in (again, kept)))

    def test_the_check_finds_a_wrong_answer_that_claims_success(self):
        case = next(case for case in hard_cases.cases_of(RULE) if case[0] == "balls of finite size, 30 Hz")
        with tempfile.TemporaryDirectory() as folder:
            one = hard_cases.Case(case, RULE, folder)
            for method in ("auto", "aft", "shooting"):
                table, _ = one.orbit(*one.words(method))
                ends = []
                for factor in (1, 1.02):
                    table.columns["x_r"] = factor * table.columns["x_r"]
                    row = {"status": 3, "check_error": -1, "check_multiplier": -1, "check": "none"}
                    one.answer(table, row)
                    one.check(table, method, row)
                    ends.append(hard_cases.verdict(row, RULE))
                self.assertEqual(ends, ["solved", "silent error"], method)
