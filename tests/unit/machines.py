"""Machines of other kinds than the paper's, against closed forms: a damper in N s/m, constant loads, a body that only
the bearing carries, a rigid stator.

Usage: tests/unit/machines.py   (from the project's root)
"""
import math
import re
import sys
import tomllib
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))
from support.explore import MACHINE, Case  # noqa: E402

VALUES = tomllib.loads(MACHINE)
NAMES = ["x_s", "y_s", "x_r", "y_r"]
G = VALUES["gravity"]["acceleration_m_per_s2"]
STIFFNESS = {body: VALUES[body]["mass_kg"] * VALUES[body]["natural_frequency_rad_per_s"] ** 2
             for body in ["stator", "rotor"]}
WEIGHT = {body: VALUES[body]["mass_kg"] * G for body in ["stator", "rotor"]}
RIGID = re.sub(r"(?s)(\[stator\]\n).*?(?=\n\[rotor)", r"\1rigid = true\n", MACHINE)
NO_GRAVITY = MACHINE.replace("s2 = 9.81", "s2 = 0")


def replaced(text, body, key, new):
    """The first line of a key after the table of a body, replaced."""
    table = text.index(f"[{body}]")
    return text[:table] + re.sub(f"{key} = .*", new, text[table:], count=1)


def carried(body):
    """The body without a suspension, its damper kept."""
    values = VALUES[body]
    damper = 2 * values["damping_ratio"] * values["mass_kg"] * values["natural_frequency_rad_per_s"]
    text = replaced(MACHINE, body, "natural_frequency_rad_per_s", "natural_frequency_rad_per_s = 0")
    return replaced(text, body, "damping_ratio", f"damping_N_s_per_m = {damper!r}")


class Machines(Case):
    def orbit(self, text, frequency=45, *options):
        """Without a verdict."""
        if "--method" not in options:
            how = [] if "--harmonics" in options else ["--method", "aft"] if "--tolerance" in options else ["--harmonics", 6]
            options = ["--no-stability", *how, *options]
        return self.table("orbit", self.file("own.toml", text), "--frequency", frequency, "--points", 64, *options)

    def assert_same_motion(self, a, b, tolerance):
        size = max(abs(b[name]).max() for name in NAMES)
        for name in NAMES:
            np.testing.assert_allclose(a[name], b[name], atol=tolerance * size, rtol=0)

    def test_damper(self):
        """c = 2 ξ m ω_0: another factor, or the damper of the other body, would show."""
        by_ratio = self.orbit(MACHINE)
        for body in ["stator", "rotor"]:
            values = VALUES[body]
            c = 2 * values["damping_ratio"] * values["mass_kg"] * values["natural_frequency_rad_per_s"]
            with self.subTest(body):
                table = self.orbit(replaced(MACHINE, body, "damping_ratio", f"damping_N_s_per_m = {c!r}"))
                self.assert_same_motion(table, by_ratio, 1e-9)

    def test_loads_replace_gravity(self):
        loads = NO_GRAVITY
        for body in ["stator", "rotor"]:
            loads = loads.replace(f"[{body}]", f"[{body}]\nload_N = [0, {-WEIGHT[body]!r}]")
        for method in [[], ["--method", "rk8pd", "--longest", 1]]:
            self.assert_same_motion(self.orbit(loads, 45, *method), self.orbit(MACHINE, 45, *method), 1e-8)

    def test_means_balance_the_loads(self):
        """Over a period the suspensions carry the constant forces, and the bearing hands on the rotor's share."""
        text = MACHINE.replace("[stator]", "[stator]\nload_N = [300, 200]")
        text = text.replace("[rotor]", "[rotor]\nload_N = [-700.5, 100]")
        for method in [["--harmonics", 20], ["--method", "rk8pd"]]:
            table = self.orbit(text, 45, *method)
            for axis, s, r in [("x", 300, -700.5), ("y", 200 - WEIGHT["stator"], 100 - WEIGHT["rotor"])]:
                mean = {name: table[name].mean() for name in [f"{axis}_s", f"{axis}_r", f"F_{axis}"]}
                self.assertAlmostEqual(STIFFNESS["stator"] * mean[f"{axis}_s"] + STIFFNESS["rotor"] * mean[f"{axis}_r"],
                                       s + r, delta=1e-3 * (abs(s) + abs(r)))
                self.assertAlmostEqual(STIFFNESS["stator"] * mean[f"{axis}_s"], mean[f"F_{axis}"] + s, delta=20)

    def test_a_body_that_the_bearing_carries(self):
        """Its weight passes through the bearing: the mean force is known."""
        for body, sign in [("rotor", -1), ("stator", 1)]:
            with self.subTest(body):
                text = carried(body)
                balance = self.orbit(text, 45, "--tolerance", 1e-3)
                force = self.orbit(text, 45, "--method", "rk8pd")
                self.assertEqual(force.value("regime"), "periodic")
                self.assertAlmostEqual(force["F_y"].mean(), sign * WEIGHT[body], delta=0.02 * abs(force["F_y"]).max())
                self.assert_same_motion(balance, force, 2e-3)

    def test_rigid_stator(self):
        """The motion is that beside a stator a million times heavier and stiffer, without weight."""
        heavy = replaced(replaced(MACHINE, "stator", "mass_kg", "mass_kg = 2e8"), "stator", "natural_frequency_rad_per_s",
                         f"natural_frequency_rad_per_s = 5000\nload_N = [0, {2e8 * G!r}]")
        for method in [["--harmonics", 12], ["--method", "rk8pd"]]:
            rigid, other = self.orbit(RIGID, 45, *method), self.orbit(heavy, 45, *method)
            self.assertEqual((rigid.value("stator"), other.value("stator")), ("rigid", "moving"))
            self.assertLess(max(abs(rigid["x_s"]).max(), abs(rigid["y_s"]).max()), 1e-13)
            self.assert_same_motion(rigid, other, 1e-4)

    def test_rigid_stator_without_contact(self):
        """m_e e ω²/|k - m ω² + i c ω| around the sag, closed form; the verdict is that of the rotor alone."""
        wide = replaced(RIGID, "bearing", "radial_clearance_m", "radial_clearance_m = 0.05")
        rotor, omega = VALUES["rotor"], 2 * math.pi * 45
        table = self.table("orbit", self.file("wide.toml", wide), "--frequency", 45, "--points", 64, "--harmonics", 6)
        k, c = STIFFNESS["rotor"], 2 * rotor["damping_ratio"] * rotor["mass_kg"] * rotor["natural_frequency_rad_per_s"]
        amplitude = rotor["unbalance_kg_m"] * omega**2 / abs(k - rotor["mass_kg"] * omega**2 + 1j * c * omega)
        self.assertAlmostEqual(table["x_r"].max() / amplitude, 1, delta=2e-3)
        self.assertAlmostEqual(table["y_r"].mean() / (-WEIGHT["rotor"] / k), 1, delta=1e-9)
        multiplier = math.exp(-c / (2 * rotor["mass_kg"]) / 45)
        self.assertAlmostEqual(table.value("multiplier") / multiplier, 1, delta=1e-6)

    def test_a_rotor_carried_by_its_bearing_in_a_rigid_stator(self):
        """Varying compliance has no other springs. At rest on one ball: the sag of the contact, closed form."""
        text = replaced(replaced(RIGID, "rotor", "natural_frequency_rad_per_s", "natural_frequency_rad_per_s = 0"),
                        "rotor", "damping_ratio", "damping_N_s_per_m = 2000")
        text = text.replace("unbalance_kg_m = 0.05", "unbalance_kg_m = 0")
        text = replaced(text, "bearing", "balls", "balls = 8").replace("radial_clearance_m = 2e-5",
                                                                       "radial_clearance_m = 0")
        table = self.orbit(text, 0.5, "--method", "rk8pd")
        self.assertAlmostEqual(table["F_y"].mean() / -WEIGHT["rotor"], 1, delta=1e-3)
        # 8 balls, clearance 0: with one straight below, that ball and the two beside it at 45 degrees carry.
        k_h = VALUES["bearing"]["contact_stiffness_N_per_m1p5"]
        sag = (WEIGHT["rotor"] / (k_h * (1 + 2 * math.cos(math.pi / 4) ** 2.5))) ** (2 / 3)
        self.assertAlmostEqual(-table["y_r"][0] / sag, 1, delta=0.02)

    def test_varying_compliance(self):
        """The JIS 6306 of the literature, 20 kg held by nothing else, excited by the passing balls alone: the peaks that
        another program found, 10.9 um in x at 93.1 passages a second and 4.06 um in y at 91.1, and integration."""
        text = """title = "JIS 6306"
[stator]
rigid = true
[rotor]
mass_kg = 20.0
natural_frequency_rad_per_s = 0
damping_N_s_per_m = 200.0
unbalance_kg_m = 0
[bearing]
balls = 8
contact_stiffness_N_per_m1p5 = 1.334e10
diametral_clearance_m = 40e-6
cage_speed_ratio = 0.375
[gravity]
acceleration_m_per_s2 = 9.81
"""
        branch = self.table("response", self.file("own.toml", text), "--from", 28, "--to", 40, "--harmonics", 30)
        for name, peak, passages in [("amp_x_r", 10.9e-6, 93.1), ("amp_y_r", 4.06e-6, 91.1)]:
            self.assertAlmostEqual(branch[name].max() / peak, 1, delta=0.003)
            self.assertAlmostEqual(3 * branch["f"][branch[name].argmax()], passages, delta=0.1)
        slow, turns = 85 / 3, ["--method", "rk8pd", "--longest", 10]
        integrated = self.orbit(text, slow, *turns)
        # Integration counts passing balls, three in a turn of the solution.
        solution = self.orbit(text, slow, "--harmonics", 60)
        self.assertEqual(integrated.value("base"), "passing")
        for name in NAMES[2:]:
            self.assertAlmostEqual(np.ptp(solution[name]) / np.ptp(integrated[name]), 1, delta=1e-2)
        # The motion knows nothing of the rotor's turning: with the cage slower by a third, the rotor may turn faster.
        faster = self.orbit(text.replace("0.375", "0.25"), 1.5 * slow, *turns)
        for name in NAMES[2:]:
            self.assertAlmostEqual(np.ptp(faster[name]) / np.ptp(integrated[name]), 1, delta=1e-2)

    def test_attractors_and_response_take_them(self):
        rigid = self.file("rigid.toml", RIGID)
        table = self.table("response", rigid, "--from", 44, "--to", 46, "--harmonics", 6)
        self.assertLess(table["amp_x_s"].max(), 1e-13)
        self.lines("attractors", rigid, "--from", 45, "--to", 46, "--count", 1, "--starts", 0)
        branch = self.folder / "branch.tsv"
        self.lines("response", self.machine, "--from", 44, "--to", 46, "--harmonics", 6, "--save", branch)
        loaded = self.file("loaded.toml", MACHINE.replace("[rotor]", "[rotor]\nload_N = [1, 0]"))
        self.refused("another machine", "response", loaded, "--from", 44, "--to", 46, "--restart", branch)

    def test_attractors_of_a_balanced_rotor(self):
        """A 6205 without unbalance has the base period of its passing balls: against harmonic balance at that speed."""
        text = carried("rotor")
        text = re.sub(r"(?s)\[bearing\].*?(?=\n\[)", '[bearing]\ndesignation = "6205"\ninternal_clearance = "C3"\n', text)
        own = self.file("own.toml", re.sub("unbalance_kg_m = .*", "unbalance_kg_m = 0", text))
        found = self.table("attractors", own, "--from", 60, "--to", 62, "--count", 2, "--starts", 0)
        self.assertEqual(found.value("base"), "passing")
        self.assertEqual(sorted(set(found["f"])), [60, 62])
        orbit = self.table("orbit", own, "--frequency", 60, "--harmonics", 60, "--points", 64, "--periods", 30)
        self.assertEqual(found["period"][0], 1)
        for name in NAMES:
            self.assertAlmostEqual(found["amp_" + name][0] / (np.ptp(orbit[name]) / 2), 1, delta=3e-3)

    def test_attractors_with_any_cage(self):
        """With two frequencies a torus, its amplitudes those of harmonic balance over many turns; with n c = 32/5 a motion of
        one base period of five turns at 45 Hz, and of two at 20 Hz, where that of c = 1/2 has two turns."""
        def attractors(cage, speed):
            own = self.file("own.toml", re.sub("cage_speed_ratio = .*", f"cage_speed_ratio = {cage}", MACHINE))
            return own, self.table("attractors", own, "--from", speed, "--to", speed + 1, "--count", 1, "--starts", 0)
        own, torus = attractors(0.43, 45)
        self.assertEqual(list(torus["period"]), [-1])
        self.assertEqual(torus.value("base"), "two")
        self.assertLess(torus["lyapunov"][0] + 3 * torus["lyapunov_uncertainty"][0], 0)
        orbit = self.table("orbit", own, "--frequency", 45, "--method", "aft", "--tolerance", 1e-3, "--points", 64, "--periods", 60)
        for name in NAMES:
            self.assertAlmostEqual(torus["amp_" + name][0] / (np.ptp(orbit[name]) / 2), 1, delta=3e-3)
        closed = attractors(0.4, 45)[1]
        self.assertEqual((closed.value("base"), list(closed["period"])), ("turns 5", [1]))
        self.assertEqual(set(attractors(0.4, 20)[1]["period"]), {2})

    def test_other_keys(self):
        """A stiffness for the natural frequency and an eccentricity for the unbalance: the same motion. Would catch the wrong mass."""
        text = MACHINE
        for body in ("stator", "rotor"):
            text = replaced(text, body, "natural_frequency_rad_per_s", f"stiffness_N_per_mm = {STIFFNESS[body] / 1e3!r}")
        e = VALUES["rotor"]["unbalance_kg_m"] / VALUES["rotor"]["mass_kg"]
        text = replaced(text, "rotor", "unbalance_kg_m", f"eccentricity_um = {1e6 * e!r}")
        self.assert_same_motion(self.orbit(text), self.orbit(MACHINE), 1e-10)

    def test_refusals(self):
        zero = "natural_frequency_rad_per_s = 0"
        both = replaced(replaced(carried("rotor"), "stator", "natural_frequency_rad_per_s", zero), "stator",
                        "damping_ratio", "damping_ratio = 0")
        for text, words in [
                (both, "rotor.natural_frequency_rad_per_s and the stator's must not both be 0"),
                (replaced(MACHINE, "stator", "natural_frequency_rad_per_s", zero), "stator.damping_ratio damps nothing"),
                (MACHINE.replace("[rotor]", "[rotor]\ndamping_N_s_per_m = 3"),
                 "rotor.damping_N_s_per_m and damping_ratio are both given"),
                (replaced(MACHINE, "rotor", "damping_ratio", ""), "damping_ratio is missing; give it, or damping_N"),
                (MACHINE.replace("[rotor]", "[rotor]\neccentricity_m = 1"), "rotor.eccentricity_m and unbalance_kg_m are both given"),
                (replaced(MACHINE, "rotor", "unbalance_kg_m", "eccentricity_m = 1e308"), "and mass_kg give more than a double holds"),
                (MACHINE.replace("[rotor]", "[rotor]\nload_N = [1]"), "load_N must be [x, y]"),
                (MACHINE.replace("[rotor]", "[rotor]\nload_N = 1"), "load_N must be a non-empty array"),
                (MACHINE.replace("[rotor]", "[rotor]\nload_N = [1, inf]"), "load_N must be finite"),
                (RIGID.replace("rigid = true", "rigid = 1"), "rigid must be true or false"),
                (RIGID.replace("rigid = true", "rigid = false"), "stator.mass_kg is missing"),
                (MACHINE.replace("[stator]", "[stator]\nrigid = true"), "stator.damping_ratio is not a known key here"),
                (MACHINE.replace("[rotor]", "[rotor]\nrigid = true"), "rotor.rigid is not a known key here")]:
            with self.subTest(words):
                self.refused_machine(words, text)


if __name__ == "__main__":
    unittest.main()
