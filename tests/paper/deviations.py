"""paper/deviations.md: complete entries, no typed result, known keys, and every citation answered.
"""
import math
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

from tests.support.explore import EXPLORE, SANITIZED, Table

PAGE = Path("paper/deviations.md")
HEADING = re.compile(r"^## (D-\d\d) ", re.MULTILINE)
LABELS = ("Printed", "Ours", "Evidence", "Effect")

# What may hold digits: values from the table, code, quotations, places in the paper, formulas.
ALLOWED = [
    r"\{\{[^{}]*\}\}", r"`[^`]*`", r'"[^"]*"', r"D-\d\d", r"\bC\d+\b", r"\(2004\)", r"doi \S+\d",
    r"\b(?:Eqs?\.?|Figs?\.?|Tables?|sections?)\s+\d+(?:(?:, | and | to )\d+)*", r"\bdata set \d\b",
    r"\b\d?m\+1\b", r"\b2[πT]", r"\b[A-Za-z]_\d\b", r"N/m\^\{3/2\}", r"\b[mN] = \d+\b", r"√2",
    r"Δω = 0\b", r"\bω/2\b", r"\([ij]−1\)",
]


def entries():
    """Each entry's text by its name."""
    parts = HEADING.split(PAGE.read_text(encoding="utf-8"))
    return dict(zip(parts[1::2], parts[2::2]))


def paragraph(entry, label):
    """What stands behind a label, up to the next one."""
    found = re.search(rf"\*\*{label}\.\*\*(.*?)(?=\n\*\*[A-Z][a-z]+\.\*\*|\Z)", entry, re.DOTALL)
    return found[1] if found else ""


def typed_numbers(text):
    """The digits of a text that nothing allows."""
    text = re.sub(r"\*\*Printed\.\*\*.*?(?=\n\n)", "", text, flags=re.DOTALL)
    for pattern in ALLOWED:
        text = re.sub(pattern, "", text)
    return re.findall(r"\S*\d\S*", text)


def include(text, table):
    """Runs paper/include.py on two texts."""
    with tempfile.TemporaryDirectory() as folder:
        page, tsv = Path(folder, "page.md"), Path(folder, "table.tsv")
        page.write_text(text, encoding="utf-8")
        tsv.write_text(table, encoding="utf-8")
        return subprocess.run([sys.executable, "paper/include.py", page, tsv],
                              capture_output=True, text=True, check=False)


def evidence():
    """The table of make; with sanitizers the program computes it anew."""
    program = EXPLORE.with_name("deviations")
    return (subprocess.run([program], capture_output=True, text=True, check=True).stdout if SANITIZED
            else Path("data/generated/deviations.tsv").read_text(encoding="utf-8"))


class Page(unittest.TestCase):
    def test_entries_are_numbered_without_gap(self):
        names = HEADING.findall(PAGE.read_text(encoding="utf-8"))
        self.assertEqual(names, [f"D-{k:02}" for k in range(1, len(names) + 1)])

    def test_every_entry_says_printed_ours_evidence_effect(self):
        for name, entry in entries().items():
            for label in LABELS:
                with self.subTest(entry=name, label=label):
                    self.assertTrue(paragraph(entry, label).strip())

    def test_evidence_and_effect_quote_the_table(self):
        for name, entry in entries().items():
            for label in ("Evidence", "Effect"):
                with self.subTest(entry=name, label=label):
                    self.assertIn("{{", paragraph(entry, label))

    def test_no_result_is_typed(self):
        self.assertEqual(typed_numbers(PAGE.read_text(encoding="utf-8")), [])

    def test_the_check_sees_typed_numbers(self):
        for text in ("It is 3.2e-4 away.", "18 folds", "at 45 Hz", "by 12 %", "a factor of 3"):
            with self.subTest(text=text):
                self.assertTrue(typed_numbers(text))

    def test_every_key_is_in_the_table(self):
        table = evidence()
        rendered = include(PAGE.read_text(encoding="utf-8"), table)
        self.assertEqual(rendered.stderr, "")
        self.assertEqual(rendered.returncode, 0)
        self.assertNotIn("{{", rendered.stdout)
        self.assertEqual(sorted(entries()), sorted({line[:4] for line in table.splitlines()
                                                    if line.startswith("D-")}))


    def test_static_contact_and_free_modes(self):
        """The force balances the weights on both suspensions, and is that of the balls; their stiffness joins the bodies, whose
        slowest decay, or growth with the printed sign, is an eigenvalue of two masses."""
        table = Table.of(evidence())
        value, g, m = dict(zip(table["key"], table["value"])), 9.81, np.array([20, 40])
        force, u, k = value["D-08.force"], value["D-08.penetration_hertz"] + 2e-5, m * np.array([500, 150])**2
        self.assertAlmostEqual(((m[1] * g - force) / k[1] - (m[0] * g + force) / k[0]) / u, 1, delta=1e-10)
        along = np.cos(2 * np.pi * np.arange(16) / 16)
        pressed = np.maximum(0, u * along - 2e-5)
        self.assertAlmostEqual(1e11 * pressed**1.5 @ along / force, 1, delta=1e-9)
        stiffness = 1.5e11 * np.sqrt(pressed) @ along**2
        self.assertAlmostEqual(value["D-01.stiffness_ours"] / stiffness, 1, delta=1e-9)
        for sign, name in ((1, "ours"), (-1, "printed")):
            joined = np.diag(k) + sign * stiffness * np.array([[1, -1], [-1, 1]])
            damping = np.diag([2 * 0.05 * 500, 2 * 0.02 * 150])
            rates = np.linalg.eigvals(np.block([[np.zeros((2, 2)), np.eye(2)], [-joined / m[:, None], -damping]])).real
            self.assertAlmostEqual(value[f"D-01.growth_{name}"] / rates.max(), 1, delta=1e-7)
        self.assertAlmostEqual(value["D-16.decay_apart"], 0.02 * 150, delta=1e-8)

    def test_values(self):
        """The printed sign is a negative stiffness that grows, without damping and suspension by l^2 = -k (1/m_s + 1/m_r), and has
        no rest; the printed predictor stays where it is; 13 samples have folds that 64 do not have;
        the plain equations have the solution of the condensed ones, their printed steps and block another one; Eq. 2 gives 1.5e10 for
        steel on a ball of 1 cm, and needs one of 42 cm."""
        table = Table.of(evidence())
        value = dict(zip(table["key"], table["value"]))
        k = value["D-01.stiffness_printed"]
        self.assertLess(k, -10 * value["D-01.suspension"])
        self.assertLess(value["D-01.growth_ours"], 0)
        self.assertAlmostEqual(value["D-01.growth_printed"] / math.sqrt(-k * (1 / 20 + 1 / 40)), 1, delta=0.02)
        self.assertLess(value["D-01.sag_printed"], value["D-01.sag"])
        self.assertEqual(value["D-02.moved_printed"], 0)
        self.assertLess(value["D-02.error_ours"], 0.2 * value["D-02.error_printed"])
        self.assertGreater(value["D-04.error_text"], 0.5)
        self.assertEqual((value["D-05.folds_m6_N13"], value["D-05.folds_m6_N64"]), (10, 0))  # confirmed in continuation.cpp
        self.assertTrue(value["D-06.ours_6"] < 1e-6 and value["D-06.distance_ours"] < 1e-8 and value["D-06.distance_printed"] > 1e-3)
        self.assertGreater(value["D-12.printed_16Hz"], 2 * value["D-12.ours_16Hz"])  # distances to time integration
        self.assertAlmostEqual(value["D-07.K_H"] / (4 / 3 * 0.1 * 2.1e11 / (2 * (1 - 0.3**2))), 1, delta=1e-9)
        self.assertAlmostEqual(value["D-07.K_H"] / 1.54e10, 1, delta=0.01)
        self.assertAlmostEqual(value["D-07.ball_radius_needed"] / 0.42, 1, delta=0.01)
        self.assertLessEqual(value["D-08.penetration_hertz"], (value["D-08.force"] / 1e11) ** (2 / 3))  # of one ball
        self.assertEqual(value["D-20.loadings_c0.5"], 1)  # in 2T, as the paper says of Fig. 7


class Citations(unittest.TestCase):
    def test_every_citation_has_an_entry(self):
        known = entries()
        sources = [path for folder in ("src", "studies", "data", "figures", "tests/unit")
                   for path in Path(folder).rglob("*")
                   if path.suffix in (".cpp", ".hpp", ".toml", ".py", ".gp")
                   and "generated" not in path.parts]
        for path in [*sources, Path("Makefile"), Path("README.md")]:
            for name in re.findall(r"\bD-\d\d\b", path.read_text(encoding="utf-8")):
                with self.subTest(file=str(path), citation=name):
                    self.assertIn(name, known)

    def test_the_code_cites_every_entry(self):
        """Where it departs: not counting the files that compute the evidence."""
        evidence = re.compile(r"deviation|printed_equations|evidence")
        cited = {name for folder in ("src", "studies") for path in Path(folder).rglob("*.?pp")
                 if not evidence.search(str(path))
                 for name in re.findall(r"\bD-\d\d\b", path.read_text(encoding="utf-8"))}
        self.assertEqual(set(entries()) - cited, set())


class Include(unittest.TestCase):
    TABLE = "# a table\nkey\tvalue\tunit\tmeaning\na.b\t1.53846e10\tm\twords\nzero\t0\t-\twords\n"

    def test_values_and_formats(self):
        result = include("{{a.b}}, {{a.b:.2e}}, {{zero:.1e}}", self.TABLE)
        self.assertEqual(result.stdout.splitlines()[-1], "1.54e10, 1.54e10, 0")

    def test_an_unknown_key_ends_with_one_line_and_status_1(self):
        for text in ("first\n{{a.c}}", "first\n{{a.b:.2q}}", "first\n{{a.b"):
            with self.subTest(text=text):
                result = include(text, self.TABLE)
                self.assertEqual(result.returncode, 1)
                self.assertEqual(result.stdout, "")
                self.assertEqual(len(result.stderr.splitlines()), 1)
                self.assertIn("page.md:2", result.stderr)
