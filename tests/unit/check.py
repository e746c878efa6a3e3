"""explore check: rest, frequencies, loss of contact and warnings against closed forms.
"""
import math
from pathlib import Path

import numpy as np

from tests.machines import table
from tests.support.explore import MACHINE, Case, Table, with_table

BALLS, HERTZ, G = 1024, 1e9, 9.81
RADIAL = math.gamma(1.75) / (2 * math.sqrt(math.pi) * math.gamma(2.25))  # mean of cos^{5/2} over the loaded half
MANY = table("bearing", balls=BALLS, contact_stiffness_N_per_m1p5=HERTZ, radial_clearance_m=0, cage_speed_ratio=0.4)
HELD = 'title = "a rotor that its bearing carries"\n' + table("stator", rigid=True) + table(
    "rotor", mass_kg=2.0, natural_frequency_rad_per_s=0, damping_N_s_per_m=10, unbalance_kg_m=1e-4) + table("gravity", acceleration_m_per_s2=9.81)
NAMED = '[bearing]\ndesignation = "6205"\n'
LOOSE = NAMED + 'internal_clearance = "C3"\n'


class Check(Case):
    def checked(self, text, *options):
        """The values, the table; what is doubted is said on stderr too."""
        result = self.run_explore("check", self.file("own.toml", text), *options)
        found = Table.of(result.stdout)
        self.assertEqual(result.returncode, 0)
        self.assertTrue(all(f"#   {line}" in found.header for line in result.stderr.splitlines()), result.stderr)
        return dict(zip(found["name"], found["value"])), found

    def test_a_rotor_on_very_many_balls(self):
        """Stribeck's load of the lowest ball, 4.37 W/n, sag, stiffness along and across the load, frequencies."""
        values, _ = self.checked(HELD + MANY, "--from", 0.1, "--to", 80)
        weight = 2 * G
        sag = (weight / (BALLS * HERTZ * RADIAL)) ** (2 / 3)
        self.assertAlmostEqual(4.37 * RADIAL, 1, delta=1e-3)
        for name, value in [("static_force", weight), ("static_y", -sag), ("ball_load", weight / (BALLS * RADIAL)),
                            ("f_1_y", math.sqrt(1.5 * weight / sag / 2) / (2 * math.pi)),
                            ("f_1_x", math.sqrt(weight / sag / 2) / (2 * math.pi)),
                            ("contact_loss", math.sqrt(weight / 1e-4) / (2 * math.pi))]:
            self.assertAlmostEqual(values.get(name, math.nan) / value, 1, delta=1e-4, msg=name)
        self.assertAlmostEqual(values["loaded_balls"], BALLS / 2, delta=1)
        self.assertAlmostEqual(values["passage_f_1_x"] * 0.4 * BALLS, values["f_1_x"], delta=1e-9 * values["f_1_x"])
        self.assertNotIn("f_r", values)

    def test_two_bodies(self):
        """Frequencies from the matrices of both bodies; the critical speed within the range only."""
        text = with_table(MANY)
        values, _ = self.checked(text)
        m, k = np.array([20, 40.]), np.array([20 * 500.**2, 40 * 150.**2])
        self.assertAlmostEqual(values["f_s"], 500 / (2 * math.pi), delta=1e-9)
        self.assertAlmostEqual(values["f_r"], 150 / (2 * math.pi), delta=1e-9)
        u = -values["static_y"]
        force = BALLS * HERTZ * RADIAL * u ** 1.5
        free = 40 * G / k[1] - 20 * G / k[0]
        self.assertAlmostEqual((u + force * sum(1 / k)) / free, 1, delta=1e-4)  # at rest
        for axis, spring in [("x", force / u), ("y", 1.5 * force / u)]:
            stiffness = np.diag(k) + spring * np.array([[1, -1], [-1, 1]])
            damping = np.diag([2 * 0.05 * 500, 2 * 0.02 * 150])
            rates = np.linalg.eigvals(np.block([[np.zeros((2, 2)), np.eye(2)], [-stiffness / m[:, None], -damping]])).imag
            for order, frequency in enumerate(np.sort(rates[rates > 0]) / (2 * math.pi), 1):
                self.assertAlmostEqual(values[f"f_{order}_{axis}"] / frequency, 1, delta=1e-4)
        self.assertNotIn("passage_f_2_x", self.checked(text, "--to", values["f_2_x"] / (0.4 * BALLS) - 1e-6, "--from", 1e-3)[0])

    def test_what_is_worth_a_word(self):
        """No ball is loaded where nothing presses; preload is never lost; a rotor that nothing damps; an unbalance within the
        weight; 90,000 turns a minute of a bearing that is small enough."""
        def words(text, *options):
            return "\n".join(line for line in self.checked(text, *options)[1].header.splitlines() if "warning:" in line)
        self.assertIn("both masses in contact it is 49.91 Hz", words(Path("data/vertical.toml").read_text(encoding="utf-8")))
        small = table("bearing", balls=7, ball_diameter_mm=3.175, pitch_diameter_mm=14, contact_stiffness_N_per_m1p5=7e9, radial_clearance_um=-1.5)
        values, found = self.checked(HELD + small, "--from", 10, "--to", "1500")
        self.assertEqual((values.get("contact_loss"), found.value("warnings")), (None, 0))
        self.assertIn("90000 turns a minute", words(HELD + NAMED, "--from", 10, "--to", 1500))
        self.assertIn("nothing damps the rotor", words(HELD.replace("s_per_m = 10", "s_per_m = 0") + NAMED))
        heavy = HELD.replace("unbalance_kg_m = 0.0001", "balance_grade = 16\nbalance_speed_rpm = 300\nload_N = [0, -100]")
        self.assertEqual(words(heavy + NAMED, "--from", 1, "--to", 5), "")
        self.assertIn("times the clearance", words(heavy + NAMED))

    def test_critical_speeds_are_crossings(self):
        """A seal overdamps the first mode from some speed on: nothing resonates where it ends."""
        self.file("seal.csv", "f,k_xx,k_xy,k_yx,k_yy,c_xx,c_xy,c_yx,c_yy\n60,0,0,0,0,10,0,0,10\n100,0,0,0,0,10000,0,0,10\n")
        own = self.file("own.toml", 'title = "a seal"\n' + table("stator", rigid=True) + table(
            "rotor", mass_kg=5, natural_frequency_Hz=30, damping_ratio=0.02, unbalance_kg_m=1e-5) + table("rotor.ground", coefficients="seal.csv")
            + table("bearing", balls=8, contact_stiffness_N_per_m1p5=1e8, radial_clearance_m=1e-5, cage_speed_ratio=0.4)
            + table("gravity", acceleration_m_per_s2=9.81))
        result = self.run_explore("campbell", own, "--from", 5, "--to", 200, "--count", 40, "--critical")
        found = Table.of(result.stdout)
        order = np.where(found["line"] == "1X", 1, 3.2)
        self.assertEqual(len(found), 4)
        np.testing.assert_allclose(found["frequency"], order * found["f"], rtol=1e-6)

    def test_warnings(self):
        """Each where it holds, one on data set 1: its centre of mass lies 1.25 mm away, 62.5 times the clearance."""
        far = MACHINE.replace("radial_clearance_m = 2e-5", "radial_clearance_m = 20")
        self.assertEqual(self.checked(far)[1].value("warnings"), 2)
        rest = self.checked(far)[0]
        self.assertEqual((rest["loaded_balls"], rest["ball_load"]), (0, 0))
        self.assertEqual(self.checked(MACHINE)[1].value("warnings"), 1)
        self.assertIn("is 62.5 times the clearance", self.checked(MACHINE)[1].header)
        self.assertEqual(self.checked(HELD + LOOSE)[1].value("warnings"), 0)
        self.assertEqual(self.checked(HELD + NAMED + "diametral_clearance_m = 2e-3")[1].value("warnings"), 1)
        heavy = HELD.replace("mass_kg = 2.0", "mass_kg = 2000") + NAMED + 'internal_clearance = "C3"'
        values, found = self.checked(heavy)
        self.assertGreater(values["stress"], 4000)
        self.assertEqual(found.value("warnings"), 2)

    def test_a_factor_of_a_thousand(self):
        """Every value typed in another unit is doubted, in check and in the header of a motion; closed forms of the values."""
        values, _ = self.checked(HELD + LOOSE, "--to", 25)
        e, omega = 1e-4 / 2, 2 * math.pi * 25
        for name, value in [("eccentricity", e), ("weight", 2 * G), ("unbalance_force", 1e-4 * omega**2), ("balance_grade", 1e3 * e * omega),
                            ("speed_value", 39.04 * 1500)]:
            self.assertAlmostEqual(values[name] / value, 1, delta=1e-6, msg=name)
        for old, new, word in [("unbalance_kg_m = 0.0001", "unbalance_kg_m = 20", "is the unbalance in kg m?"),
                               ("unbalance_kg_m = 0.0001", "unbalance_kg_m = 0.02", "is the unbalance in kg m?"),
                               ("rigid = true", "mass_kg = 10\nstiffness_N_per_m = 2526\ndamping_ratio = 0.05", "the stator of 10 kg sinks by 0.0388 m"),
                               ("mass_kg = 2.0", "mass_kg = 2.0\nload_N = [0, 19.62]", "do the loads lift the rotor"),
                               ("mass_kg = 2.0", "mass_kg = 2000", "is its mass in kg?"),
                               ("rigid = true", "mass_kg = 10\nnatural_frequency_Hz = 3900\ndamping_ratio = 0.05", "is the frequency in Hz, or the stiffness in N/m?"),
                               ("unbalance_kg_m = 0.0001", "unbalance_kg_m = 1e-8", "finer than any rotor is balanced"),
                               ("rigid = true", "mass_kg = 10\nnatural_frequency_Hz = 80\ndamping_N_s_per_m = 3e5", "is the damping in N s/m?"),
                               ("unbalance_kg_m = 0.0001", "balance_grade = 6.3\nbalance_speed_rpm = 25", "is its speed in rpm?"),
                               ("damping_N_s_per_m = 10", "damping_N_s_per_m = 8e5", "is it in N s/m?"),
                               ("mass_kg = 2.0", "mass_kg = 2.0\nload_N = [0, -1e9]", "the machine gives way by"),
                               ("= 9.81", "= 9810", "is it in m/s^2?")]:
            self.assertIn(old, HELD)
            self.assertIn(word, self.checked(HELD.replace(old, new) + LOOSE)[1].header)
        self.file("seal.tsv", "f\tc_xx\n600\t1\n3000\t2\n")
        for more, word in [(LOOSE + "contact_damping_s_per_m = 1000", "a contact damping of 1000 s/m"),
                            (LOOSE + '[bearing.defect]\nsurface = "outer_race"\ndepth_mm = 2\nwidth_rad = 0.1', "a spall of 0.002 m depth"),
                            (LOOSE + '[bearing.defect]\nsurface = "outer_race"\ndepth_um = 2\nwidth_rad = 0.1\nangle_rad = -90', "an angle of -90 rad"),
                            (LOOSE + "[bearing.parallel]\nstop_stiffness_N_per_m = 1e6\nstop_gap_m = 80", "a stop after 80 m"),
                            (LOOSE + '[bearing.parallel]\ncoefficients = "seal.tsv"', "coefficients up to 3000 Hz"),
                            (NAMED + "contact_angle_rad = 1.5", "a contact angle of 1.5 rad"),
                            (NAMED + "radial_clearance_um = 2e-5", "a clearance of 2e-11 m"),
                            (NAMED + "radial_clearance_um = -200", "a preload of 0.0002 m"),
                            (NAMED + "radial_clearance_um = -1000", "more than a tenth of the ball"),
                            (MANY.replace(f"= {BALLS}", "= 9").replace(f"= {HERTZ}", "= 2.7e5"), "a contact stiffness of 2.7e+05 N/m^1.5"),
                            (MANY.replace(f"_m1p5 = {HERTZ}", "_mn = 5e10\ncontact_exponent = 1.11"), "a contact stiffness of 5e+10 N/m^1.11")]:
            self.assertIn(word, self.checked(HELD + more)[1].header)
        self.assertIn("1500 Hz are 90000 turns a minute", self.run_explore("orbit", self.file("set1.toml", MACHINE), "--frequency", 1500, "--points", 2).stderr)
        radial = HELD + NAMED.replace("6205", "6205 C3") + "radial_clearance_m = 2.05e-5"
        self.assertIn("41 um on the diameter, where C3 has at most 28: is it radial?", self.checked(radial)[1].header)
        plain = HELD + NAMED + "radial_clearance_um = 32"
        self.assertIn("64 um on the diameter, where C5 has at most 53: is it radial?", self.checked(plain)[1].header)
        sizes = table("bearing", balls=9, ball_diameter_m=7.94, pitch_diameter_m=39.04, inner_groove_ratio=0.52, outer_groove_ratio=0.53,
                      youngs_modulus_Pa=207000, poissons_ratio=0.3, diametral_clearance_m=0.02)
        for word in ("are lengths in m?", "is the modulus in Pa?"):
            self.assertIn(word, self.checked(HELD + sizes)[1].header)
        self.assertIn("a groove ratio of 4.1", self.checked(HELD + sizes.replace("= 0.52", "= 4.1"))[1].header)
        own, words = self.file("named.toml", HELD + LOOSE), "speeds are in Hz, or as 1500rpm"
        for asked in (["orbit", own, "--frequency", 1797, "--points", 4],
                      ["map", own, "--x", "frequency=10:1797:2", "--quantity", "amplitude"]):
            fast = self.run_explore(*asked)
            self.assertIn("#   warning: 1797 Hz", fast.stdout)
            self.assertIn(words, fast.stdout)
            self.assertRegex(fast.stderr, rf"\Awarning: 1797 Hz.*{words}\n\Z")
            self.assertFalse(self.run_explore(*asked, "--quiet").stderr)
        wide = ["map", own, "--frequency", 25, "--x", "bearing.radial_clearance_m=0:30:2", "--quantity", "amplitude"]
        self.assertRegex(self.run_explore(*wide).stderr, r"\Awarning: the clearance of 30 m is more than a tenth of the ball\n")
        self.assertIn(words, self.run_explore("campbell", own, "--from", 0, "--to", 1797, "--count", 2).stdout)
        self.assertNotIn("warning", self.table("orbit", self.folder / "named.toml", "--frequency", "1797rpm", "--points", 4).header)
