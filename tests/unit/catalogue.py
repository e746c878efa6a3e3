"""Bearings from the catalogue: their kinematics against the factors that makers publish, what the keys of a catalogue
give, and what is refused.
"""
import math
import re
import tomllib
from pathlib import Path

import numpy as np
from scipy.special import ellipe

from tests.truth.independent import CATALOGUE, ellipse
from tests.support.explore import FULL, MACHINE, Case, Table, with_table

C3 = 'designation = "6205"\ninternal_clearance = "C3"'
BY_HAND = """balls = 9
ball_diameter_m = 0.00794
pitch_diameter_m = 0.03904
inner_groove_ratio = 0.52
outer_groove_ratio = 0.53
youngs_modulus_Pa = 2.07e11
poissons_ratio = 0.3
diametral_clearance_m = 20.5e-6"""


def machine(bearing):
    return with_table(f"[bearing]\n{bearing}")


def published_digits(factor):
    """Half a unit of the last digit printed."""
    return 0.5 * 10.0 ** -len(repr(factor).partition(".")[2])


def static_factor(ratio):
    """f0 of ISO 76: the load in N of one ball of 1 mm, over 5, that presses 4200 N/mm^2 on the inner race (grooves 0.52)
    or on the outer one (0.53), whichever is less, by the ellipse of Hertz."""
    def load(groove, inside):
        total, kappa, m = ellipse(1, 1 / ratio, groove, inside)
        # Semi-axes a = (6 kappa^2 E Q/(pi total stiffness))^(1/3), b = a/kappa; pressure 3 Q/(2 pi a b).
        per_load = (6 * kappa**2 * ellipe(m) / (np.pi * total * 2.07e5 / (1 - 0.3**2))) ** (1 / 3)
        return (4200 * 2 * np.pi * per_load**2 / (3 * kappa)) ** 3
    return min(load(0.52, True), load(0.53, False)) / 5


class Catalogue(Case):
    def checked(self, bearing):
        """The header of every table of this machine, from the one that asks for no motion."""
        result = self.run_explore("check", self.file("own.toml", machine(bearing)))
        self.assertEqual(result.returncode, 0, result.stderr)
        return Table.of(result.stdout)

    def header(self, bearing, *keys):
        table = self.checked(bearing)
        return [table.value(key) for key in keys]

    def test_file_of_the_readme(self):
        """It is whole, and its damping is that of the ratio beside it at the lowest natural frequency."""
        text = re.search(r'(?s)```toml\n(title = .*?)```', Path("README.md").read_text(encoding="utf-8"))[1]
        value, rotor = self.values(self.file("own.toml", text)), tomllib.loads(text)["rotor"]
        lowest = min(value[name] for name in value if re.fullmatch(r"f_\w+", name))
        self.assertAlmostEqual(rotor["damping_N_s_per_m"] / (4 * np.pi * 0.03 * rotor["mass_kg"] * lowest), 1, delta=0.01)

    def test_kinematics_agree_with_published_factors(self):
        """A wrong ball, pitch diameter or count, and the ball's spin defined otherwise, would be seen."""
        compared = 0
        for entry in CATALOGUE["bearing"]:
            names = ["FTF", "BSF", "BPFO", "BPFI"]
            orders = self.header(f'designation = "{entry["designation"]}"\nradial_clearance_m = 0',
                                 "cage_speed_ratio", "bsf", "bpfo", "bpfi")
            self.assertTrue(entry["published_source"] and entry["source"])
            for name, order in zip(names, orders):
                if "published" in entry:
                    factor = entry["published"][name]
                    self.assertLessEqual(abs(order - factor), 1e-3 * factor + published_digits(factor),
                                         (entry["designation"], name))
            compared += "published" in entry
        self.assertGreaterEqual(compared, 8)
        there = {entry["designation"] for entry in CATALOGUE["bearing"]}
        self.assertLessEqual({"6002", "6203", "6205", "6206", "6208", "6210", "6306", "6308"}, there)

    def test_a_designation_is_its_dimensions(self):
        """The same machine by designation and class, and by hand: K_H, clearance and cage in every digit."""
        keys = ["balls", "contact_stiffness", "clearance", "cage_speed_ratio"]
        by_name, by_hand = (self.header(text, *keys) for text in [C3, BY_HAND])
        self.assertEqual(by_name, by_hand)
        self.assertEqual(by_name[0], 9)
        self.assertAlmostEqual(by_name[2], (13e-6 + 28e-6) / 4, delta=1e-18)
        radii = BY_HAND.replace("ball_diameter_m = 0.00794", "ball_radius_m = 0.00397").replace(
            "pitch_diameter_m = 0.03904", "inner_race_radius_m = 0.01555")
        for a, b in zip(self.header(radii, *keys), by_hand):
            self.assertAlmostEqual(a / b, 1, delta=1e-12)

    def test_header_names_what_was_derived(self):
        ball, cage = self.header(C3, "ball_diameter", "cage_speed_ratio")
        self.assertEqual(ball, 0.00794)
        self.assertAlmostEqual(cage, (1 - 0.00794 / 0.03904) / 2, delta=1e-15)
        plain = self.table("orbit", self.machine, "--frequency", 45, "--harmonics", 6, "--points", 1)
        self.assertIsNone(plain.value("ball_diameter", None))

    def test_every_bearing_has_every_class(self):
        """ISO 5753-1: a class lies above the one before, and a bore on a limit belongs to the range below. Of the bearings whose bores
        lie in one range the first and the last, with FULL in the environment all."""
        known = {}
        for entry in sorted(CATALOGUE["bearing"], key=lambda entry: entry["bore_m"]):
            known.setdefault(next(one["up_to_m"] for one in CATALOGUE["clearance"] if entry["bore_m"] <= one["up_to_m"]), []).append(entry)
        self.assertGreater(len(known), 5)
        for entry in CATALOGUE["bearing"] if FULL else [end for range_ in known.values() for end in (range_[0], range_[-1])]:
            middles = [self.header(f'designation = "{entry["designation"]}"\ninternal_clearance = "{name}"', "clearance")[0]
                       for name in ["C2", "CN", "C3", "C4", "C5"]]
            self.assertEqual(middles, sorted(set(middles)))
        thirty, = self.header('designation = "6206"\ninternal_clearance = "C4"', "clearance")
        self.assertAlmostEqual(thirty, (23e-6 + 41e-6) / 4, delta=1e-18)

    def test_balls_by_ratings_give_them(self):
        """C0r = f0 n D^2 (ISO 76), with f0 from the contact of 4200 N/mm^2 at grooves of 0.52 and 0.53, and Cr = 1.3 fc
        n^(2/3) D^1.8 (ISO 281, table 2): another ball, count or pitch misses the maker's numbers."""
        table = np.array([[0.05, 46.7], [0.06, 49.1], [0.07, 51.1], [0.08, 52.8], [0.09, 54.3], [0.1, 55.5], [0.12, 57.5],
                          [0.14, 58.8], [0.16, 59.6], [0.18, 59.9], [0.2, 59.9], [0.22, 59.6], [0.24, 59.0], [0.26, 58.2],
                          [0.28, 57.1], [0.3, 56.0], [0.32, 54.6], [0.34, 53.2], [0.36, 51.7], [0.38, 50.0]])
        rated = [entry for entry in CATALOGUE["bearing"] if "ratings" in entry]
        self.assertGreaterEqual(len(rated), 40)
        for entry in rated:
            with self.subTest(entry["designation"]):
                ball, ratings = 1e3 * entry["ball_diameter_m"], entry["ratings"]
                ratio = ball / (1e3 * entry["pitch_diameter_m"])
                f0, n = static_factor(ratio), entry["balls"]
                dynamic = 1.3 * np.interp(ratio, *table.T) * n ** (2 / 3) * ball ** 1.8
                self.assertAlmostEqual(f0 * n * ball**2 / ratings["C0r_N"], 1, delta=0.025)
                self.assertAlmostEqual(dynamic / ratings["Cr_N"], 1, delta=0.01)
                self.assertAlmostEqual(f0 / ratings.get("f0", f0), 1, delta=0.02)
                self.assertAlmostEqual(64 * ball / 25.4, round(64 * ball / 25.4), delta=1e-3)

    def test_designations_as_people_write_them(self):
        """Maker, seals, cage and grease change nothing and are named; a class of clearance is that of the key."""
        keys = ["balls", "contact_stiffness", "clearance", "cage_speed_ratio"]
        expected = self.header(C3, *keys)
        for text in ["6205 C3", "6205/C3", "6205C3", "SKF 6205-2RS1/C3", "SKF6205-2Z/C3", "6205-2Z/C3GJN", "6205 zz c3", "6205/P63", "6205/C3H", "6205-C3E", "6205.2ZR.C3", "6205/HC5C3", "6205+C3"]:
            with self.subTest(text):
                self.assertEqual(self.header(f'designation = "{text}"', *keys), expected)
        for text, unused in [("SKF 6205-2RS", "SKF 2RS"), ("6205-2RS JEM", "2RS JEM"), ("6205ZZ", "ZZ"), ("6205ZZC3", "ZZ"), ("6205 LLUC3", "LLU"), ("6205/HC5", "HC5"), ("6205-C-2HRS", "C 2HRS")]:
            with self.subTest(text):
                self.assertIn(f"bearing data of Case Western Reserve University; not used: {unused}", self.checked(C3.replace("6205", text)).header)
        own = self.header('designation = "6201-2Z"\ninternal_clearance = "C0"', *keys)
        for text in ["6201 CN", "6201 Cn"]:
            self.assertEqual(own, self.header(f'designation = "{text}"\ninternal_clearance = "C0"', *keys))
        self.assertEqual(own, self.header('designation = "6201-2Z"', *keys))  # ISO 5753-1: no mark
        self.assertIn("clearance: CN, as nothing else is named, 3 to 18 um", self.checked('designation = "6201-2RSJEM"').header)
        self.assertAlmostEqual(own[2], (3e-6 + 18e-6) / 4, delta=1e-18)
        self.assertAlmostEqual(*self.header('designation = "6205 C5"', "clearance"), (30e-6 + 53e-6) / 4, delta=1e-18)
        mounted = 'designation = "6205 C3"\nradial_clearance_m = 6e-6'
        self.assertEqual(self.header(mounted, "clearance"), [6e-6])
        self.assertIn("C3 of the designation is not used", self.checked(mounted).header)
        for bearing, words in [
                (C3.replace("6205", "6205 C4"), 'internal_clearance "C3" contradicts C4 of designation'),
                (C3.replace("6205", "6205DDUC4"), 'internal_clearance "C3" contradicts C4 of designation'),
                ('designation = "6205 C3/C4"', "names two classes of clearance"),
                ('designation = "6205/C6"', "C6 is no class of clearance"),
                (C3.replace("6205", "NU205"), "is a cylindrical roller bearing"),
                (C3.replace("6205", "7205 BECBP"), "is an angular contact ball bearing"),
                (C3.replace("6205", "62051"), "is not in the catalogue"),
                (C3.replace("6205", "6205 " + "x" * 200_000), "has more than 100 characters"),
                (C3.replace("6205", "SKF"), "holds no number such as 6205")]:
            self.refused_machine(words, machine(bearing))

    def test_keys_in_other_units(self):
        """The same orbit, digit by digit, from keys in the units of the workshop; both units, or a length that is no
        length, are refused; a map sets the key in either unit."""
        def values(text, *extra):
            return self.rows("orbit", self.file("own.toml", text), "--frequency", 45, "--harmonics", 6, *extra)
        expected = values(MACHINE.replace("natural_frequency_rad_per_s = 500.0",
                                          f"natural_frequency_rad_per_s = {160 * math.pi!r}"))
        other = MACHINE.replace("natural_frequency_rad_per_s = 500.0", "natural_frequency_Hz = 80")
        self.assertEqual(values(other), expected)
        self.assertEqual(values(other.replace("frequency_Hz = 80", "frequency_rpm = 4800")), expected)
        for mine in ["radial_clearance_um = 20", "radial_clearance_mm = 0.02"]:
            self.assertEqual(values(other.replace("radial_clearance_m = 2e-5", mine)), expected)
        self.assertEqual(values(other.replace("unbalance_kg_m = 0.05", "unbalance_g_mm = 50000")), expected)
        for key, unit, number in [("mass_kg", "mass_t", 1e-3), ("mass_kg", "mass_lb", 1 / 0.45359237)]:
            old = re.search(rf"{key} = ([\d.]+)", MACHINE)
            here, there = [[float(cell) for row in values(text)[1:] for cell in row.split("\t")]
                           for text in [MACHINE, MACHINE.replace(old[0], f"{unit} = {float(old[1]) * number!r}", 1)]]
            np.testing.assert_allclose(there, here, rtol=1e-6, atol=1e-9)
        damper = other.replace("damping_ratio = 0.05", "damping_N_s_per_m = 500")
        self.assertEqual(values(damper.replace("N_s_per_m = 500", "N_s_per_mm = 0.5")), values(damper))
        mm = BY_HAND.replace("ball_diameter_m = 0.00794", "ball_diameter_mm = 7.94").replace(
            "youngs_modulus_Pa = 2.07e11", "youngs_modulus_GPa = 207")
        keys = ["contact_stiffness", "clearance", "cage_speed_ratio"]
        self.assertEqual(self.header(mm, *keys), self.header(BY_HAND, *keys))
        self.assertEqual(self.header(mm.replace("GPa = 207", "MPa = 207000"), *keys), self.header(BY_HAND, *keys))
        for old, new, words in [
                ("radial_clearance_m = 2e-5", "radial_clearance_m = 2e-5\nradial_clearance_um = 20",
                 "bearing.radial_clearance_um and radial_clearance_m are both given"),
                ("natural_frequency_rad_per_s = 500.0", "natural_frequency_Hz = -5", "stator.natural_frequency_Hz must be >= 0, got -5"),
                ("radial_clearance_m = 2e-5", "radial_clearnce_um = 20", "did you mean radial_clearance_um?"),
                ("damping_ratio = 0.05", "damping_N_s_per_um = 5", "damping_ratio is missing")]:
            self.refused_change(old, new, words)
        maps = [[row.split("\t")[-1] for row in self.rows("map", self.file("own.toml", text), "--x", axis, "--frequency", 45,
                                                           "--harmonics", 6, "--quantity", "amplitude")]
                for text in [MACHINE, MACHINE.replace("radial_clearance_m = 2e-5", "radial_clearance_um = 20")]
                for axis in ["bearing.radial_clearance_m=1e-5:2e-5:2", "bearing.radial_clearance_um=10:20:2"]]
        self.assertEqual(maps, maps[:1] * 4)

    def test_refusals_of_damping_and_spalls(self):
        def spall(**values):
            values = {"surface": "'outer_race'", "depth_m": 1e-6, "width_rad": 0.2, **values}
            return C3 + "\n[bearing.defect]\n" + "\n".join(f"{key} = {value}" for key, value in values.items())
        for bearing, words in [
                (C3 + "\ncontact_damping_s_per_m = -1", "contact_damping_s_per_m must be >= 0"),
                (spall(surface="'cage'"), '"cage": must be "outer_race", "inner_race" or "ball"'),
                (spall(depth_m=-1e-6), "depth_m must be >= 0"),
                (spall(width_rad=0), "width_rad must be > 0"),
                (spall(width_rad=0.7), "must not exceed the spacing of the balls 2 pi/n, 0.698131701 rad"),
                (spall(surface="'ball'", width_rad=3.2), "must not exceed half a turn of the ball"),
                (spall(surface="'ball'", ball=10), "bearing.defect.ball"),
                (spall(ball=1), "bearing.defect.ball is not a known key"),
                (BY_HAND.replace("pitch_diameter_m = 0.03904", "pitch_diameter_m = 1e300") +
                 "\n[bearing.defect]\nsurface = 'ball'\ndepth_m = 0\nwidth_rad = 1", "1/2"),
                (C3 + "\ndefect = 1", "bearing.defect")]:
            self.refused_machine(words, machine(bearing))

    def test_refusals(self):
        ratios = "\n".join(BY_HAND.splitlines()[3:])
        for bearing, words in [
                (C3.replace("6205", "6299"), 'bearing.designation "6299" is not in the catalogue; did you mean 6209?; give the'),
                (C3.replace("6205", "SKF 6025"), 'designation "SKF 6025" is not in the catalogue; did you mean 6205?; give the'),
                (C3.replace("6205", "9999"), '"9999" is not in the catalogue; there are 60/22, '),
                (C3.replace("C3", "C7"), "must be C2, CN or C0 (normal), C3, C4 or C5"),
                (C3 + "\nballs = 9", "designation and balls are both given"),
                (C3 + "\ncage_speed_ratio = 0.4", "designation and cage_speed_ratio are both given"),
                (C3 + "\nball_diameter_m = 0.01", "designation and ball_diameter_m are both given"),
                (C3 + "\ninner_groove_ratio = 0.52", "designation and inner_groove_ratio are both given"),
                (C3 + "\ncontact_stiffness_N_per_m1p5 = 1e10", "are both given"),
                (C3 + "\nradial_clearance_m = 0", "internal_clearance and radial_clearance_m are both given"),
                ('designation = "6205"\nradial_clearence_m = 1e-5', "radial_clearence_m is not a known key here; did you mean radial_clearance_m?"),
                (BY_HAND.replace("diametral_clearance_m = 20.5e-6", 'internal_clearance = "C3"'), "needs designation"),
                (BY_HAND.replace("inner_groove_ratio = 0.52", "inner_groove_ratio = 0.5"),
                 "inner_groove_ratio must be > 0.5"),
                (BY_HAND.replace("poissons_ratio = 0.3", "poissons_ratio = 0.51"), "poissons_ratio must be in 0...0.5"),
                (BY_HAND.replace("poissons_ratio = 0.3", "poissons_ratio = -0.1"), "poissons_ratio must be >= 0"),
                (BY_HAND.replace("youngs_modulus_Pa = 2.07e11\n", ""), "youngs_modulus_Pa is missing"),
                (BY_HAND.replace("pitch_diameter_m = 0.03904\n", ""), "pitch_diameter_m is missing"),
                (BY_HAND.replace("ball_diameter_m = 0.00794\n", ""), "bearing.ball_diameter_m is missing\n"),
                (BY_HAND.replace("= 0.03904", "= 0.02"), "makes the 9 balls overlap"),
                (BY_HAND.replace("balls = 9", "balls = 1").replace("= 0.03904", "= 0.007"), "overlap"),
                ("balls = 9\ncage_speed_ratio = 0.4\n" + ratios, "does not give the ball's size"),
                (C3.replace("designation", "designaton"), "did you mean designation?"),
                (C3.replace("6205", "").replace('""', "6205"), "designation must be a string")]:
            self.refused_machine(words, machine(bearing))

    def test_what_is_missing_makes_nothing_else_unknown(self):
        """Each key alone left out of machines that have, between them, all keys."""
        more = "\ncontact_angle_deg = 5\nouter_ring_speed_ratio = 0.1\ncontact_damping_s_per_m = 1e-6"
        radii = "ball_radius_m = 0.004\ninner_race_radius_m = 0.016\ncontact_stiffness_N_per_mn = 1e10\ncontact_exponent = 1.4"
        for text in [machine(f"balls = 9\n{radii}\nradial_clearance_m = 0"), machine(C3 + more), machine(
                BY_HAND + more + "\n[bearing.defect]\nsurface = 'ball'\ndepth_m = 0\nwidth_deg = 9\n[bearing.parallel]").replace(
                "natural_frequency_rad_per_s = 150.0", "stiffness_N_per_mm = 9e2\nload_N = [0, 1]\nground = {cubic_stiffness_N_per_m3 = 1}").replace(
                "unbalance_kg_m = 0.05", "balance_grade = 6.3\nbalance_speed_rpm = 3000"), MACHINE]:
            lines = text.splitlines()
            for k, line in enumerate(lines):
                if "=" in line:
                    with self.subTest(line):
                        without = self.file("own.toml", "\n".join(lines[:k] + lines[k + 1:]))
                        self.assertNotIn("not a known key", self.run_explore("check", without).stderr)
