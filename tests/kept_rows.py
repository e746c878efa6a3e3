"""Rows of the kept tables of studies, computed anew: three of each table, drawn by the hash of the kept table.

Rows are drawn among those with one value: motions that repeat themselves and that nothing else competes with. A study that
continues solutions from speed to speed is compared where the answer does not depend on the way.

Usage: tests/kept_rows.py   (from the project's root, after `make all`)
"""
import hashlib
import sys
import tomllib
import unittest
from pathlib import Path

import numpy as np

for folder in ("figures", "studies"):  # a study may be called like its figure
    sys.path.insert(0, folder)
import identification  # noqa: E402
import robustness  # noqa: E402
import sensitivity  # noqa: E402
from rotor_stator import attempt, map_at  # noqa: E402
from tables import Table, cells_as_numbers  # noqa: E402

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


def point(row, keys):
    return [repr(float(row.first(key))) for key in keys]


class Rows(unittest.TestCase):
    def compare(self, new, old, names, most):
        """Columns of the table computed anew, by the names of the kept one."""
        for new_name, old_name in names.items():
            np.testing.assert_allclose(cells_as_numbers(new[new_name]), [float(row.first(old_name)) for row in old], rtol=most,
                                       atol=1e-12, err_msg=f"{old_name} of {[row.columns for row in old]}")

    def test_map_of_clearance_and_speed(self):
        """Motions from rest that repeat with every turn, lose no contact, and have no other beside them."""
        keys = ("frequency", "bearing.radial_clearance_m")
        kept = Kept("clearance_speed")
        rows = kept.drawn((cells_as_numbers(kept.table["period"]) == 1) & (cells_as_numbers(kept.table["contact_share"]) == 1)
                          & (kept.table["frequency"] > 26) & (kept.table["bearing.radial_clearance_m"] < 4e-5))
        new = map_at(SETS[1], keys, [point(row, keys) for row in rows], quantity="period,lyapunov,contact_share")
        self.compare(new, rows, {"period": "period", "contact_share": "contact_share"}, 0)
        self.compare(new, rows, {"lyapunov": "lyapunov"}, 0.05)

    def test_map_of_the_border(self):
        """The peak of a sweep, where the bearing is stiff."""
        keys = ("bearing.radial_clearance_m", "bearing.contact_stiffness_N_per_m1p5")
        kept = Kept("stiffness_border")
        rows = kept.drawn((kept.table["status"] == "ok") & (cells_as_numbers(kept.table["permanent"]) == 1))
        new = map_at(SETS[1], keys, [point(row, keys) for row in rows], harmonics=6, sweep="1:60:60", frequency=30,
                        quantity="peak,peak_frequency,permanent,error")
        self.compare(new, rows, {"peak": "peak", "peak_frequency": "peak_frequency", "permanent": "permanent"}, 1e-6)

    def test_clearance_and_stiffness(self):
        """Sweeps in which contact is never lost."""
        kept = Kept("clearance_stiffness")
        rows = kept.drawn((kept.table["f_loss_first"] == -1) & (kept.table["missed"] == 0))
        new = map_at(SETS[1], ("bearing.radial_clearance_m", "bearing.contact_stiffness_N_per_m1p5"),
                        [point(row, ("delta", "K_H")) for row in rows], harmonics=6, sweep="1:60:60",
                        quantity="peak,peak_frequency,largest_load,missed")
        self.compare(new, rows, {"peak": "amp_peak", "peak_frequency": "f_peak", "largest_load": "largest_force", "missed": "missed"}, 1e-6)

    def test_attractors(self):
        """The one motion of a speed, where all starts end on one that repeats with every turn."""
        kept = Kept("attractors")
        rows = kept.drawn((kept.table["motion"] == 1) & (kept.table["period"] == 1) & (kept.table["starts"] >= 6))
        for row in rows:
            new = map_at(SETS[int(row.first("set"))], ("frequency",), [point(row, ("f",))], quantity="period,amp_x_s,amp_y_r")
            self.compare(new, [row], {"period": "period"}, 0)
            self.compare(new, [row], {"amp_x_s": "amp_x_s", "amp_y_r": "amp_y_r"}, 0.01)  # 256 instants in a turn

    def test_verdicts(self):
        """Multipliers of the machine, and those along the harmonics."""
        kept = Kept("verdicts")
        rows = kept.drawn((kept.table["machine_stable"] == 1) & (kept.table["distance"] < 0.01))
        for row in rows:
            new = map_at(SETS[int(row.first("set"))], ("frequency",), [point(row, ("f",))], method="aft",
                            harmonics=int(row.first("m")), quantity="multiplier,distance,series")
            self.compare(new, [row], {"multiplier": "machine", "distance": "distance", "series": "series"}, 1e-3)

    def test_stability(self):
        """Points of the curves with a stable motion nearby, above the transition: amplitude and multiplier."""
        kept = Kept("stability")
        rows = kept.drawn((kept.table["set"] == 1) & (kept.table["stable"] == 1) & (kept.table["f"] > 40) & (kept.table["largest_multiplier"] > 0))
        for row in rows:
            new = map_at(SETS[int(row.first("set"))], ("frequency",), [point(row, ("f",))], method="aft",
                            harmonics=int(row.first("harmonics")), quantity="amplitude,multiplier")
            self.compare(new, [row], {"amplitude": "amp_x_r", "multiplier": "largest_multiplier"}, 1e-3)

    def test_validity(self):
        """Distances of stable solutions with few harmonics from the machine's motion."""
        kept = Kept("validity")
        rows = kept.drawn((kept.table["stable"] == 1) & (kept.table["adaptive"] == 0) & (kept.table["nearest_periodic"] == 1)
                          & (kept.table["distance"] < 0.1))
        for row in rows:
            new = map_at(SETS[int(row.first("set"))], ("frequency",), [point(row, ("f",))], method="aft",
                            harmonics=int(row.first("m")), quantity="distance")
            self.compare(new, [row], {"distance": "distance"}, 0.05)  # 256 instants there

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

    def test_cage(self):
        """Amplitude and contact of motions from rest with another cage, above the resonance."""
        kept = Kept("cage")
        for row in kept.drawn((kept.table["f"] > 40) & (kept.table["found"] == 1) & (kept.table["stable"] == 1)):
            new = map_at(SETS[int(row.first("set"))], ("frequency", "bearing.cage_speed_ratio"), [point(row, ("f", "c"))],
                            method="rk4", longest=6, quantity="amplitude,contact_share,ball_load", budget=1e10)
            self.compare(new, [row], {name: name for name in ("amplitude", "contact_share", "ball_load")}, 0.01)


if __name__ == "__main__":
    unittest.main()
