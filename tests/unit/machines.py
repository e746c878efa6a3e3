"""Machines of other kinds than the paper's, against an independent integration and published cases.
"""
import re
import tomllib

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq

from tests.truth.independent import Model, displacements, errors
from tests.support.explore import CASES, MACHINE, Case, changed, with_table

VALUES = tomllib.loads(MACHINE)
RIGID = with_table("[stator]\nrigid = true")


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
    def test_kinds_against_the_judge(self):
        """Dampers in N s/m, constant loads, a body that only the bearing carries, a stator that is held; rollers, preload, an outer
        ring that turns. Another factor, a damper or a load of the other body, would show."""
        rolling = (CASES / "rolling.toml").read_text(encoding="utf-8")
        line = f"contact_exponent = {10 / 9!r}\ncontact_stiffness_N_per_mn = 2e8"
        rollers = rolling.replace("contact_stiffness_N_per_m1p5 = 1e10", line)
        loaded = MACHINE.replace("[stator]", "[stator]\nload_N = [300, 200]").replace("[rotor]", "[rotor]\nload_N = [-700.5, 100]")
        kinds = {"damper of the stator": replaced(MACHINE, "stator", "damping_ratio", "damping_N_s_per_m = 1500"),
                 "damper of the rotor": replaced(MACHINE, "rotor", "damping_ratio", "damping_N_s_per_m = 350"), "loads": loaded,
                 "carried rotor": carried("rotor"), "carried stator": carried("stator"), "rigid": RIGID, "hertz": rolling, "rollers": rollers,
                 "preload": changed(rolling, radial_clearance_m=-5e-6), "both": changed(rollers, radial_clearance_m=-5e-6),
                 "outer ring": changed(rolling, cage_speed_ratio="0.625\nouter_ring_speed_ratio = 0.3")}
        for name, text in kinds.items():
            exact = Model(tomllib.loads(text), 45).settled(1, 32)
            own = self.file("own.toml", text)
            for how, most in [([], 1e-4), (["--method", "aft", "--tolerance", "1e-4"], 2e-4)]:
                with self.subTest(name=name, how=how):
                    table = self.table("orbit", own, "--frequency", 45, "--points", 32, *how)
                    self.assertEqual(table.value("regime"), "periodic")
                    self.assertEqual(table.value("stator"), "rigid" if "rigid = true" in text else "moving")
                    self.assertLess(abs(displacements(table) - exact).max(), most * np.ptp(exact, axis=0).max())

    def test_varying_compliance(self):
        """The JIS 6306 of the literature, 20 kg held by nothing else, excited by the passing balls alone: the peaks that
        another program found, 10.9 um in x at 93.1 passages a second and 4.06 um in y at 91.1."""
        branch = self.table("response", CASES / "passing_6306.toml", "--from", 28, "--to", 40, "--harmonics", 30)
        self.assertEqual(branch.value("base"), "passing")  # though a whole number of balls passes in a turn
        self.assertLess(branch["amp_x_s"].max(), 1e-13)
        for name, peak, passages in [("amp_x_r", 10.9e-6, 93.1), ("amp_y_r", 4.06e-6, 91.1)]:
            self.assertAlmostEqual(branch[name].max() / peak, 1, delta=0.003)
            self.assertAlmostEqual(3 * branch["f"][branch[name].argmax()], passages, delta=0.1)

    def test_circular_whirl_of_many_balls(self):
        """Without gravity the sum over 512 balls is an integral over the contact, F(r) = n/pi int K_H (r cos phi - delta)^1.5 cos phi,
        and |r + (G_s + G_r) F(r)| = |G_r| m_e e w^2."""
        delta = 1e-6
        own = self.file("own.toml", changed(balls=512, radial_clearance_m=delta, acceleration_m_per_s2=0))

        def force(r):
            return 512 / np.pi * 1e11 * delta**1.5 * quad(
                lambda phi: np.maximum(r / delta * np.cos(phi) - 1, 0)**1.5 * np.cos(phi), 0, np.arccos(delta / r))[0]

        for frequency in (35, 45, 60):
            w = 2 * np.pi * frequency
            g_s, g_r = (1 / (VALUES[body]["mass_kg"] * (w_0**2 + 2j * VALUES[body]["damping_ratio"] * w_0 * w - w**2))
                        for body in ("stator", "rotor") for w_0 in [VALUES[body]["natural_frequency_rad_per_s"]])
            driven = abs(g_r) * VALUES["rotor"]["unbalance_kg_m"] * w**2
            exact = brentq(lambda r: abs(r + (g_s + g_r) * force(r)) - driven, delta * (1 + 1e-9), 100 * delta, xtol=1e-15)  # noqa: B023
            self.assertGreater(exact, 1.5 * delta)
            orbit = self.table("orbit", own, "--frequency", frequency, "--harmonics", 4, "--samples", 32, "--no-stability")
            np.testing.assert_allclose(np.hypot(orbit["x_r"] - orbit["x_s"], orbit["y_r"] - orbit["y_s"]), exact, rtol=1e-5)

    def test_two_frequencies_against_integration(self):
        """Instant by instant. Catches a wrong frequency in a linear block, a force at the wrong angle of the cage, a line that is
        missing and, in the last case, a transient that is not over."""
        rk8pd = ["--method", "rk8pd"]
        for clearance, balls, cage, frequency, how, tolerance, most in [
                (2e-5, 16, 0.43, 31.1, rk8pd, 1e-3, 1e-3), (2e-5, 16, 0.4173, 56.3, rk8pd, 1e-3, 1e-3),
                (2e-5, 16, 0.381966, 98.6, rk8pd, 1e-3, 1e-3), (2e-5, 9, 0.3983, 45.4, rk8pd, 1e-3, 1e-3),
                (20e-5, 16, 0.43, 139.5, rk8pd, 1e-3, 1e-3), (20e-5, 16, 0.381966, 56.3, rk8pd, 1e-3, 1e-3),
                (2e-5, 16, 0.43, 45.4, [], 1e-4, 2e-4)]:
            own = self.file("own.toml", changed(radial_clearance_m=clearance, balls=balls, cage_speed_ratio=cage))
            ask = ["orbit", own, "--frequency", frequency, "--points", 64, "--periods", 4]
            balance, settled = self.table(*ask, "--method", "aft", "--tolerance", tolerance), self.table(*ask, *how)
            with self.subTest(clearance=clearance, balls=balls, cage=cage, frequency=frequency):
                self.assertLess(max(errors(displacements(balance), displacements(settled))), most)
        self.assertEqual(settled.value("regime"), "quasi-periodic")
        self.assertTrue(0 <= settled.error("error") < 1e-4)

    def test_attractors_with_any_cage(self):
        """With n c = 32/5 a motion of one base period of five turns at 45 Hz, and of two at 20 Hz, where that of c = 1/2 has two turns."""
        for speed, period in [(45, 1), (20, 2)]:
            found = self.table("attractors", self.file("own.toml", changed(cage_speed_ratio=0.4)), "--from", speed, "--to", speed,
                               "--count", 1, "--starts", 0)
            self.assertEqual((found.value("base"), set(found["period"])), ("turns 5", {period}))

    def test_other_keys(self):
        """A stiffness for the natural frequency and an eccentricity for the unbalance: the same motion. Would catch the wrong mass."""
        text = MACHINE
        for body in ("stator", "rotor"):
            k = VALUES[body]["mass_kg"] * VALUES[body]["natural_frequency_rad_per_s"] ** 2
            text = replaced(text, body, "natural_frequency_rad_per_s", f"stiffness_N_per_mm = {k / 1e3!r}")
        e = VALUES["rotor"]["unbalance_kg_m"] / VALUES["rotor"]["mass_kg"]
        text = replaced(text, "rotor", "unbalance_kg_m", f"eccentricity_um = {1e6 * e!r}")
        grade = replaced(MACHINE, "rotor", "unbalance_kg_m", f"balance_grade = {1e3 * e * 2 * np.pi * 50!r}\nbalance_speed_rpm = 3000")
        motion, *others = (displacements(self.table("orbit", self.file("own.toml", keys), "--frequency", 45)) for keys in (MACHINE, text, grade))
        for same in others:
            np.testing.assert_allclose(same, motion, atol=1e-9 * np.ptp(motion))

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
                (replaced(MACHINE, "rotor", "unbalance_kg_m", "balance_grade = 6.3"), "balance_speed_rad_per_s is missing"),
                (replaced(MACHINE, "rotor", "unbalance_kg_m", 'balance_grade = "G6.3"\nbalance_speed_rpm = 3000'),
                 "rotor.balance_grade must be a number, without letters and quotes: 6.3\n"),
                (replaced(MACHINE, "rotor", "natural_frequency_rad_per_s", "natural_frequency_Hz = 25\nstiffness_N_per_mm = 3"),
                 "rotor.stiffness_N_per_mm and natural_frequency_Hz are both given"),
                (both.replace("damping_N_s_per_m", "damping_Ns_per_m"),
                 "did you mean damping_N_s_per_m? (rotor.damping_N_s_per_m is missing: a body without a suspension"),
                (replaced(MACHINE, "rotor", "unbalance_kg_m", "eccentricity_m = 1e308"), "and mass_kg give more than a double holds"),
                (MACHINE.replace("[rotor]", "[rotor]\nload_N = [1]"), "load_N must be [x, y]"),
                (MACHINE.replace("[rotor]", "[rotor]\nload_N = 1"), "load_N must be [x, y]"),
                (MACHINE.replace("[rotor]", "[rotor]\nload_N = [1, inf]"), "load_N must be finite"),
                (RIGID.replace("rigid = true", "rigid = 1"), "rigid must be true or false"),
                (RIGID.replace("rigid = true", "rigid = false"), "stator.mass_kg is missing"),
                (MACHINE.replace("[stator]", "[stator]\nrigid = true"), "stator.damping_ratio is not a known key here: a rigid stator has no other keys"),
                (MACHINE.replace("[rotor]", "[rotor]\nrigid = true"), "rotor.rigid is not a known key here")]:
            self.refused_machine(words, text)
