"""The claims' quantities on machines whose verdict is known, and the verdicts of the computed tables when rows are
left out or put in another order.

Usage: tests/paper/claims.py   (from the project's root, after `make all`)
"""
import sys
import tomllib
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, "figures")
import claim_quantities as quantities  # noqa: E402
from claim_ranges import spans  # noqa: E402
from claims import judged  # noqa: E402
from tables import Table  # noqa: E402

FOLDERS = (Path("data/generated"), Path("data/generated/as-printed"))
RULE = {claim["id"]: claim for claim in quantities.RULES["claim"]}


def machine(step=0.5, **changes):
    """A machine that moves as the paper says, speed by speed; a change is {speed: value} of a column."""
    f = np.arange(1, 60.01, step)
    middle = (f > 10) & (f <= 19)
    columns = {"f": f, "contact": np.where(middle, 0.8, 1.0), "turns": np.where(f < 13, 0.0, 1.0),
               "higher_harmonics": np.where(middle, 0.2, 0.01), "largest_force": np.where(f > 40, 6000.0, 600.0),
               "amp_x_r": 1 / (1 + (f - 49.9) ** 2), "passed_once": np.where(middle, 0.0, 1.0), "periodic": np.where(middle, 0.0, 1.0)}
    for name, values in changes.items():
        for speed, value in values.items():
            columns[name][np.isclose(f, speed)] = value
    table = object.__new__(Table)
    table.header, table.columns = "", columns
    return table


def halved(table):
    """Every second speed loses its T-periodic motion."""
    changed = table.rows(np.full(len(table), True))
    changed.columns["periodic"] = np.where(np.round(2 * table["f"]).astype(int) % 2, 0.0, table["periodic"])
    return changed


def word(claim, value):
    return quantities.verdict(RULE[claim], value)


class Quantities(unittest.TestCase):
    """Each would catch a quantity that counts the wrong speeds, or forgets one of its conditions."""

    def test_a_machine_as_the_paper_says_reproduces_its_claims(self):
        for step in (0.5, 0.3, 1.0):
            rows = machine(step)
            self.assertAlmostEqual(quantities.peak(rows)[0], 49.9, delta=0.05)
            self.assertEqual(word("C4", quantities.low_permanent(rows, 13.2)), "reproduced")
            self.assertEqual(word("C5", quantities.middle_complex(rows)), "reproduced")
            self.assertEqual(word("C6", quantities.high_rest(rows)), "reproduced")
            self.assertEqual(word("C7", quantities.force_rise(rows)[0]), "reproduced")
            self.assertEqual(quantities.passes(rows, 0.5), 1)
            self.assertEqual(quantities.phases(rows)[0], 3)

    def test_each_condition_of_a_claim_counts(self):
        self.assertEqual(word("C4", quantities.low_permanent(machine(), 9.9)), "not reproduced")
        again = {f: 0.0 for f in (3, 4, 5)}
        self.assertEqual(word("C4", quantities.low_permanent(machine(passed_once=again), 13.2)), "partly")
        once = {f: 1.0 for f in np.arange(10.5, 14.1, 0.5)}
        self.assertEqual(word("C5", quantities.middle_complex(machine(passed_once=once))), "partly")
        self.assertEqual(quantities.lost_inside(machine(contact={3: 0.0})), 18 * 0.2 / (1 + 18 * 0.2))
        smooth = {f: 0.0 for f in np.arange(10.5, 19.1, 0.5)}
        self.assertEqual(quantities.middle_complex(machine(higher_harmonics=smooth)), 0)
        held = {f: 0.0 for f in np.arange(20, 26.1, 0.5)}
        self.assertEqual(word("C6", quantities.high_rest(machine(turns=held))), "partly")
        self.assertEqual(word("C6", quantities.high_rest(machine(contact={f: 0.5 for f in range(20, 30)}))), "partly")
        self.assertEqual(quantities.phases(machine(turns=held))[0], 2)
        self.assertAlmostEqual(quantities.passes(machine(), 7 / 16), 1.125)

    def test_the_harmonics_of_the_transition(self):
        """Only where half of its speeds are T-periodic at least; outside nothing counts, nor do speeds that are not T-periodic."""
        rows = machine()
        errors = {6: np.full(len(rows), 0.2), 10: np.where(rows["f"] < 5, 0.5, 0.05)}
        self.assertIsNone(quantities.harmonics_transition(rows, errors))
        self.assertEqual(word("C3", None), "not tested")
        rows = machine(periodic={f: 1.0 for f in np.arange(12, 19.1, 0.5)})
        self.assertEqual(quantities.harmonics_transition(rows, errors), 10)
        errors[10][np.isclose(rows["f"], 11)] = np.inf
        self.assertEqual(quantities.harmonics_transition(rows, errors), 10)
        errors[10][np.isclose(rows["f"], 15)] = np.inf
        self.assertEqual(quantities.harmonics_transition(rows, errors), quantities.NOT_ENOUGH)

    def test_a_range_names_the_masses_of_each_verdict(self):
        self.assertEqual(spans({10.0: "partly", 12.0: "reproduced", 14.0: "reproduced", 16.0: "partly"}),
                         "partly for m_s in 10, 16 kg; reproduced for m_s in 12...14 kg")


class Tables(unittest.TestCase):
    """The computed tables of both readings."""

    def verdicts(self, folder, change=lambda table: table):
        return {claim["id"]: quantities.verdict(claim, value) for claim, value, *_ in judged(folder, change=change)}

    def test_no_verdict_depends_on_the_step_of_the_sweep(self):
        """Every second speed, from the first or from the second."""
        for folder in FOLDERS:
            whole = self.verdicts(folder)
            for first in (0, 1):
                thinned = self.verdicts(folder, lambda table: table.rows(
                    np.round(2 * table["f"]).astype(int) % 2 == first))  # noqa: B023
                self.assertEqual(thinned, whole, f"{folder}, every second speed")

    def test_speeds_without_a_periodic_motion_count(self):
        """Where fewer speeds are T-periodic, fewer are right: the printed reading, of which half are, cannot pass more easily. Would
        catch shares of T-periodic speeds."""
        for folder in FOLDERS:
            words = dict((claim["id"], (value, ours)) for claim, value, ours, _ in judged(folder))
            fewer = self.shares(folder, lambda table: table if "adaptive" not in table.columns else halved(table))
            for claim in ("C2", "C14"):
                self.assertLess(fewer[claim], 0.6 * words[claim][0] + 0.01)

    def shares(self, folder, change):
        return {claim["id"]: value for claim, value, *_ in judged(folder, change=change)}

    def test_no_verdict_depends_on_the_order_of_the_rows(self):
        for folder in FOLDERS:
            shuffled = self.verdicts(folder, lambda table: table.rows(np.random.default_rng(1).permutation(len(table))))
            self.assertEqual(shuffled, self.verdicts(folder), folder)

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


if __name__ == "__main__":
    unittest.main()
