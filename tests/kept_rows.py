"""Rows of the kept tables of studies, computed anew: three of each table, drawn by the hash of the kept table.

Rows are drawn among those with one value: motions that repeat themselves and that nothing else competes with. A study that
continues solutions from speed to speed is compared where the answer does not depend on the way.
"""
import hashlib
import tomllib
import unittest
from pathlib import Path

import numpy as np

import identification
import robustness
import sensitivity
from rotor_stator import attempt, map_at
from tables import Table, cells_as_numbers

ROWS = 3
SETS = {1: "data/set1.toml", 2: "data/set2.toml"}


class Kept:
    """A kept table, and which of its rows are drawn."""

    def __init__(self, name):
        path = Path("data/reference", f"{name}.tsv")
        self.table = Table(path)
        self.random = np.random.default_rng(int.from_bytes(hashlib.sha256(path.read_bytes()).digest()[:8], "big"))

    def drawn(self, chosen):
        """Three of the rows for which `chosen` is true, each as a table of one row."""
        rows = np.flatnonzero(chosen)
        return [self.table.rows([k]) for k in self.random.choice(rows, ROWS, replace=False)]


class Rows(unittest.TestCase):
    def at_points(self, name, chosen, keys, options, names):
        """Rows of a kept table by one map: the keys it takes from columns, and {column: (quantity, relative error)}."""
        kept = Kept(name)
        for row in kept.drawn(chosen(kept.table)):
            own = {option: value(row) if callable(value) else value for option, value in options.items()}
            new = map_at(SETS[int(row.first("set")) if "set" in row.columns else 1], list(keys), [[repr(float(row.first(key))) for key in keys.values()]],
                         quantity=",".join(quantity for quantity, _ in names.values()), **own)
            for column, (quantity, most) in names.items():
                with self.subTest(name, column=column):
                    np.testing.assert_allclose(cells_as_numbers(new[quantity]), [float(row.first(column))], rtol=most, atol=1e-12,
                                               err_msg=f"{row.columns}")

    def test_maps(self):
        """Motions from rest that repeat with every turn, lose no contact, and have no other beside them; the peak of a sweep, where
        the bearing is stiff; sweeps in which contact is never lost."""
        clearance, stiffness = "bearing.radial_clearance_m", "bearing.contact_stiffness_N_per_m1p5"
        self.at_points("clearance_speed", lambda t: (cells_as_numbers(t["period"]) == 1) & (cells_as_numbers(t["contact_share"]) == 1)
                       & (t["frequency"] > 26) & (t[clearance] < 4e-5), {"frequency": "frequency", clearance: clearance}, {},
                       {"period": ("period", 0), "contact_share": ("contact_share", 0), "lyapunov": ("lyapunov", 0.05)})
        self.at_points("stiffness_border", lambda t: (t["status"] == "ok") & (cells_as_numbers(t["permanent"]) == 1),
                       {clearance: clearance, stiffness: stiffness}, {"harmonics": 6, "sweep": "1:60:60"},
                       {name: (name, 1e-6) for name in ("peak", "peak_frequency", "permanent")})
        self.at_points("clearance_stiffness", lambda t: (t["f_loss_first"] == -1) & (t["missed"] == 0),
                       {clearance: "delta", stiffness: "K_H"}, {"harmonics": 6, "sweep": "1:60:60"},
                       {"amp_peak": ("peak", 1e-6), "f_peak": ("peak_frequency", 1e-6), "largest_force": ("largest_load", 1e-6),
                        "missed": ("missed", 1e-6)})

    def test_points(self):
        """The one motion of a speed, where all starts end on one that repeats with every turn; multipliers of the machine, and those
        along the harmonics; points of curves with a stable motion nearby, above the transition; distances of stable solutions with
        few harmonics from the machine's motion; motions from rest with another cage, above the resonance."""
        at, fixed = {"frequency": "f"}, {"method": "aft", "harmonics": lambda row: int(row.first("m"))}
        self.at_points("attractors", lambda t: (t["motion"] == 1) & (t["period"] == 1) & (t["starts"] >= 6), at, {},
                       {"period": ("period", 0), "amp_x_s": ("amp_x_s", 0.01), "amp_y_r": ("amp_y_r", 0.01)})  # 256 instants in a turn
        self.at_points("verdicts", lambda t: (t["machine_stable"] == 1) & (t["distance"] < 0.01), at, fixed,
                       {"machine": ("multiplier", 1e-3), "distance": ("distance", 1e-3), "series": ("series", 1e-3)})
        self.at_points("stability", lambda t: (t["set"] == 1) & (t["stable"] == 1) & (t["f"] > 40) & (t["largest_multiplier"] > 0), at,
                       {"method": "aft", "harmonics": lambda row: int(row.first("harmonics"))},
                       {"amp_x_r": ("amplitude", 1e-3), "largest_multiplier": ("multiplier", 1e-3)})
        self.at_points("validity", lambda t: (t["stable"] == 1) & (t["adaptive"] == 0) & (t["nearest_periodic"] == 1)
                       & (t["distance"] < 0.1), at, fixed, {"distance": ("distance", 0.05)})  # 256 instants there
        self.at_points("cage", lambda t: (t["f"] > 40) & (t["found"] == 1) & (t["stable"] == 1), {**at, "bearing.cage_speed_ratio": "c"},
                       {"method": "rk4", "longest": 6, "budget": 1e10},
                       {name: (name, 0.01) for name in ("amplitude", "contact_share", "ball_load")})

    def test_adaptive(self):
        """The harmonics that a tolerance needs, and the printed error."""
        kept = Kept("adaptive")
        for row in kept.drawn((kept.table["reached"] == 1) & (kept.table["f"] > 30)):
            new = attempt("orbit", SETS[int(row.first("set"))], frequency=row.first("f"), method="aft", tolerance=row.first("tolerance"), points=2048,
                          no_stability=True)
            self.assertEqual(new.value("harmonics"), row.first("m"))
            self.assertAlmostEqual(new.error("error") / row.first("estimate"), 1, delta=0.02)

    def test_sensitivity(self):
        """Peaks and losses of contact of machines with one other parameter."""
        kept = Kept("sensitivity")
        study = sensitivity.Study("data/scenes/sensitivity.toml")
        for row in kept.drawn((kept.table["peak_by"] == "aft") & ~np.isin(kept.table["parameter"], ["step", "samples"])):
            case = study.varied(row.first("parameter"), float(row.first("value")))
            frequency, height = study.peak(case, True)
            np.testing.assert_allclose((frequency, height), (row.first("f_peak"), row.first("amp_peak")), rtol=1e-4)

    def test_identification(self):
        """Machines at three speeds each, where the motion has the period of rotation."""
        kept = Kept("identification")
        for row in kept.drawn((kept.table["periodic"] == 1) & (kept.table["set"] == 1) & (kept.table["f"] > 25) & (kept.table["f"] < 60)):
            base = identification.Base(f"data/set1{list(identification.READINGS.values())[int(row.first('reading'))]}.toml")
            f = float(row.first("f"))
            scene = {"speeds_hz": {"from": f, "to": f + 1, "step": 1.0}, "regime": {"longest_s": 5.0}}
            machine = (row.first("f_joint"), tuple(row.first(name) for name in ("m_s", "m_r", "cage_speed_ratio")))
            new = identification.rows_of_machine(base, *machine, scene)[0]
            names = [name for name, *_ in identification.COLUMNS[2:]]
            for name in ("periodic", "turns", "largest_force", "amp_x_r", "error_6"):
                np.testing.assert_allclose(new[names.index(name)], row.first(name), rtol=5e-3, atol=1e-6, err_msg=f"{name} of {row.columns}")

    def test_robustness(self):
        """Errors of machines with another damping."""
        kept = Kept("robustness")
        scene = tomllib.loads(Path("data/scenes/robustness.toml").read_text(encoding="utf-8"))
        for row in kept.drawn((kept.table["period"] == 1) & (kept.table["f"] > 30)):
            file = SETS[int(row.first("set"))]
            name = scene["machine"][int(row.first("machine")) - 1]["name"]
            values, keys = next((values, keys) for one, times, values, keys in robustness.machines_of(scene, robustness.parameters(file))
                                if (one, times, values[keys.index(robustness.DAMPINGS[0])])
                                == (name, row.first("suspension"), row.first("contact_damping")))
            new = map_at(file, ["frequency", *keys], [[float(row.first("f")), *values]], harmonics=6, quantity="error")
            np.testing.assert_allclose(2 if new.first("error") == "-" else float(new.first("error")), row.first("error_6"), rtol=1e-3)
