"""The claims' quantities on machines whose verdict is known; the verdicts of the computed tables when rows are left
out or put in another order; both versions of Table 1 by the same rules, and their scores in README and results.
"""
import tomllib
import unittest
from functools import cache
from pathlib import Path
from unittest import mock

import numpy as np

import claim_quantities as quantities
from claim_ranges import spans
from claim_score import in_words, score, stored
from claims import judged, possible
from tables import Table

FOLDERS = (Path("data/generated"), Path("data/generated/as-printed"))
KEPT = Path("data/reference")
RULE = {claim["id"]: claim for claim in quantities.RULES["claim"]}


def machine(step=0.5, **changes):
    """A machine that moves as the paper says, speed by speed; a change is {speed: value} of a column."""
    f = np.arange(1, 60.01, step)
    middle = (f > 10) & (f <= 19)
    columns = {"f": f, "contact": np.where(middle, 0.8, 1.0), "turns": np.where(f < 13, 0.0, 1.0),
               "passages": np.where(middle, 3.0, 1.0),
               "higher_harmonics": np.where(middle, 0.2, 0.01), "largest_force": np.where(f > 40, 6000.0, 600.0),
               "amp_x_r": 1 / (1 + (f - 49.9) ** 2)}
    for name, values in changes.items():
        for speed, value in values.items():
            columns[name][np.isclose(f, speed)] = value
    table = object.__new__(Table)
    table.header, table.columns = "", columns
    return table


def word(claim, value):
    return quantities.verdict(RULE[claim], value)


class Quantities(unittest.TestCase):
    """Each would catch a quantity that counts the wrong speeds, or forgets one of its conditions."""

    def test_a_machine_as_the_paper_says_reproduces_its_claims(self):
        for step in (0.5, 0.3, 1.0):
            rows = machine(step)
            self.assertAlmostEqual(quantities.peak(rows)[0], 49.9, delta=0.05)
            self.assertEqual(word("C4", quantities.low_permanent(rows, 13.2, 0.5)), "reproduced")
            self.assertEqual(word("C5", quantities.middle_complex(rows, 0.5)), "reproduced")
            self.assertEqual(word("C6", quantities.high_rest(rows)), "reproduced")
            self.assertEqual(word("C7", quantities.force_rise(rows)[0]), "reproduced")
            self.assertEqual(quantities.passes(rows, 0.5), 1)
            self.assertEqual(quantities.phases(rows)[0], 3)

    def test_each_condition_of_a_claim_counts(self):
        def low(limit=13.2, **changes):
            return word("C4", quantities.low_permanent(machine(**changes), limit, 0.5))
        self.assertEqual(low(9.9), "not reproduced")
        self.assertEqual(low(contact={f: 0.5 for f in (3, 4, 5)}), "partly")
        self.assertEqual(low(passages={f: 1.5 for f in (3, 4, 5)}), "partly")
        self.assertEqual(low(passages={f: 1.02 for f in (3, 4, 5)}), "reproduced")
        between = np.arange(10.5, 19.1, 0.5)
        self.assertEqual(quantities.middle_complex(machine(higher_harmonics={f: 0.0 for f in between}), 0.5), 0)
        self.assertEqual(word("C5", quantities.middle_complex(machine(passages={f: 1.0 for f in between[:12]}), 0.5)), "partly")
        held = {f: 0.0 for f in np.arange(20, 26.1, 0.5)}
        self.assertEqual(word("C6", quantities.high_rest(machine(turns=held))), "partly")
        self.assertEqual(word("C6", quantities.high_rest(machine(contact={f: 0.5 for f in range(20, 30)}))), "partly")
        self.assertEqual(quantities.phases(machine(turns=held))[0], 2)
        self.assertAlmostEqual(quantities.passes(machine(), 7 / 16), 1.125)
        self.assertLess(quantities.passes(machine(turns=held), 0.5), 0.95)

    def test_balls_are_counted_beside_the_turning_of_any_cage(self):
        """7/16: 14/16 passages in two periods, or 18/16 where the contact rotates, and an eighth for the counting."""
        for turns, whole in ((0, 14 / 16), (1, 18 / 16)):
            rows = machine(turns={f: turns for f in machine()["f"]}, passages={f: whole + 1 / 8 for f in machine()["f"]})
            self.assertFalse(quantities.more_often(rows, 7 / 16).any())
            self.assertTrue(quantities.more_often(machine(passages={f: 1.5 for f in machine()["f"]}), 7 / 16).all())

    def test_the_smallest_number_of_harmonics_that_suffices_at_every_speed(self):
        """Also where more harmonics have no solution somewhere: that decides nothing about fewer. Where most speeds
        have nothing that is T-periodic, no number is right and none is asked for."""
        errors = {6: np.array([0.2, 0.01]), 7: np.array([0.05, 0.1]), 8: np.array([np.inf, 0.01])}
        both, one, two = np.array([1, 1]), np.array([1, 0, 0]), np.array([1, 1, 0])
        self.assertEqual(quantities.harmonics(errors, both), 7)
        self.assertEqual(quantities.harmonics({6: errors[6]}, both), quantities.NOT_ENOUGH)
        self.assertIsNone(quantities.harmonics({6: np.array([0.01, np.inf, np.inf])}, one))
        self.assertEqual(quantities.harmonics({6: np.array([0.01, 0.01, np.inf])}, two), quantities.NOT_ENOUGH)
        self.assertEqual(quantities.harmonics({6: np.array([np.inf, np.inf])}, both), quantities.NOT_ENOUGH)

    def test_a_speed_without_a_periodic_motion_is_not_right(self):
        self.assertEqual(quantities.right(np.array([0.01, 0.2, np.inf, 0.1])), 0.5)

    def test_a_range_names_the_masses_of_each_verdict(self):
        self.assertEqual(spans({10.0: "partly", 12.0: "reproduced", 14.0: "reproduced", 16.0: "partly"}),
                         "partly for m_s in 10, 16 kg; reproduced for m_s in 12...14 kg")


class Tables(unittest.TestCase):
    """The computed tables of both readings, each file read once."""

    @classmethod
    def setUpClass(cls):
        cls.enterClassContext(mock.patch("claims.Table", cache(Table)))

    def verdicts(self, folder, change=lambda table: table):
        return {claim["id"]: found for claim, found, *_ in judged(folder, change=change)}

    def test_no_verdict_depends_on_the_step_of_the_sweep(self):
        """Every second speed, from the first or from the second."""
        for folder in FOLDERS:
            whole = self.verdicts(folder)
            for first in (0, 1):
                thinned = self.verdicts(folder, lambda table: table.rows(
                    np.round(2 * table["f"]).astype(int) % 2 == first))  # noqa: B023
                self.assertEqual(thinned, whole, f"{folder}, every second speed")

    def test_no_verdict_depends_on_the_order_of_the_rows(self):
        for folder in FOLDERS:
            shuffled = self.verdicts(folder, lambda table: table.rows(np.random.default_rng(1).permutation(len(table))))
            self.assertEqual(shuffled, self.verdicts(folder), folder)

    def test_a_motion_that_is_not_periodic_counts_against_both_versions(self):
        """C2 falls when more speeds lose their T-periodic motion: none leaves the count."""
        def chaotic_above_30_hz(table):
            if "periodic" not in table.columns or "adaptive" not in table.columns:
                return table
            columns = {**table.columns, "periodic": np.where(table["f"] > 30, 0, table["periodic"])}
            changed = table.rows(np.ones(len(table), bool))
            changed.columns = columns
            return changed

        for folder in FOLDERS:
            before, after = ({claim["id"]: value for claim, _, value, *_ in judged(folder, change=change)}
                             for change in (lambda table: table, chaotic_above_30_hz))
            self.assertLess(after["C2"], before["C2"] - 0.2, folder)

    def test_both_versions_are_judged_by_the_same_rules(self):
        """Every claim in both, each verdict that of its quantity by the limits of claims.toml, each counted once."""
        texts = [Path(page).read_text(encoding="utf-8") for page in ("README.md", "paper/results.md")]
        for folder, kept in zip(FOLDERS, (KEPT, KEPT / "as-printed")):
            for claim, found, value, *_ in judged(folder):
                self.assertEqual(claim, RULE[claim["id"]])
                self.assertIn(found, possible(claim, value), f"{folder}, {claim['id']}")
            claims = stored(kept / "claims.tsv")
            self.assertEqual([claim["id"] for claim in claims], list(RULE))
            self.assertEqual(sorted(sum(score(claims).values(), [])), sorted(RULE))
            for claim in claims:
                self.assertEqual(claim["built_in"], RULE[claim["id"]].get("built_in", "-"))
            for text in texts:
                self.assertIn(in_words(claims), " ".join(text.split()))

    def test_each_ball_is_passed_once_per_2T_at_45_hz_and_not_at_13_5_hz(self):
        rows = Table(FOLDERS[0] / "regimes.tsv").where("set", 1)
        high, middle = (rows.where("f", speed) for speed in (45, 13.5))
        self.assertEqual([high.first(name) for name in ("passed_once", "contact", "turns", "periodic")], [1, 1, 1, 1])
        self.assertLess(high.first("higher_harmonics"), 0.01)
        self.assertLess(middle.first("contact"), 1)
        self.assertEqual(middle.first("periodic"), 0)

    def test_the_closed_form_of_the_loss_of_contact(self):
        """Against the two rigid bodies as one oscillator, by hand: its response gives the force of the joint."""
        for folder, reading in zip(FOLDERS, ("", "-as-printed")):
            file = tomllib.loads(Path(f"data/set1{reading}.toml").read_text(encoding="utf-8"))
            (m_s, w_s, xi_s), (m_r, w_r, xi_r) = (
                (file[body]["mass_kg"], file[body]["natural_frequency_rad_per_s"], file[body]["damping_ratio"])
                for body in ("stator", "rotor"))
            k, c = m_s * w_s ** 2 + m_r * w_r ** 2, 2 * (xi_s * m_s * w_s + xi_r * m_r * w_r)
            g = file["gravity"]["acceleration_m_per_s2"]
            sag = (m_s + m_r) * g / k
            omega = 2 * np.pi * Table(folder / "tab01_parameters.tsv").first("f_loss")
            swing = file["rotor"]["unbalance_kg_m"] * omega ** 2 / (k - (m_s + m_r) * omega ** 2 + 1j * c * omega)
            static = abs(m_s * g - m_s * w_s ** 2 * sag)
            rotating = abs((m_s * w_s ** 2 - m_s * omega ** 2 + 2j * xi_s * m_s * w_s * omega) * swing)
            self.assertAlmostEqual(rotating / static, 1, delta=1e-4)
        self.assertAlmostEqual(Table(FOLDERS[0] / "tab01_parameters.tsv").first("f_loss") / 13.155, 1, delta=1e-3)
