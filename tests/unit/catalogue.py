"""Bearings from the catalogue: their kinematics against the factors that makers publish, what the keys of a catalogue
give, and what is refused.

Usage: tests/unit/catalogue.py   (from the project's root)
"""
import re
import sys
import tomllib
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))
from support.explore import MACHINE, Case  # noqa: E402

CATALOGUE = tomllib.loads(Path("data/bearings/deep_groove.toml").read_text(encoding="utf-8"))
BRIEF = ["--frequency", 100, "--method", "rk8pd", "--longest", 0.01, "--points", 1]
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
    """Data set 1 with another [bearing]."""
    return re.sub(r"(?s)(\[bearing\]\n).*?(?=\n\[gravity)", lambda found: found[1] + bearing + "\n", MACHINE)


def published_digits(factor):
    """Half a unit of the last digit printed."""
    return 0.5 * 10.0 ** -len(repr(factor).partition(".")[2])


class Catalogue(Case):
    def values(self, bearing, *keys):
        table = self.table("orbit", self.file("own.toml", machine(bearing)), *BRIEF)
        return [table.value(key) for key in keys]

    def test_kinematics_agree_with_published_factors(self):
        """A wrong ball, pitch diameter or count, and the ball's spin defined otherwise, would be seen."""
        compared = 0
        for entry in CATALOGUE["bearing"]:
            names = ["FTF", "BSF", "BPFO", "BPFI"]
            orders = self.values(f'designation = "{entry["designation"]}"\nradial_clearance_m = 0',
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
        by_name, by_hand = (self.values(text, *keys) for text in [C3, BY_HAND])
        self.assertEqual(by_name, by_hand)
        self.assertEqual(by_name[0], 9)
        self.assertAlmostEqual(by_name[2], (13e-6 + 28e-6) / 4, delta=1e-18)
        radii = BY_HAND.replace("ball_diameter_m = 0.00794", "ball_radius_m = 0.00397").replace(
            "pitch_diameter_m = 0.03904", "inner_race_radius_m = 0.01555")
        for a, b in zip(self.values(radii, *keys), by_hand):
            self.assertAlmostEqual(a / b, 1, delta=1e-12)

    def test_header_names_what_was_derived(self):
        ball, cage = self.values(C3, "ball_diameter", "cage_speed_ratio")
        self.assertEqual(ball, 0.00794)
        self.assertAlmostEqual(cage, (1 - 0.00794 / 0.03904) / 2, delta=1e-15)
        plain = self.table("orbit", self.machine, "--frequency", 45, "--harmonics", 6, "--points", 1)
        self.assertIsNone(plain.value("ball_diameter", None))

    def test_every_bearing_has_every_class(self):
        """ISO 5753-1: a class lies above the one before, and a bore on a limit belongs to the range below."""
        for entry in CATALOGUE["bearing"]:
            middles = [self.values(f'designation = "{entry["designation"]}"\ninternal_clearance = "{name}"', "clearance")[0]
                       for name in ["C2", "CN", "C3", "C4"]]
            self.assertEqual(middles, sorted(set(middles)))
        thirty, = self.values('designation = "6206"\ninternal_clearance = "C4"', "clearance")
        self.assertAlmostEqual(thirty, (23e-6 + 41e-6) / 4, delta=1e-18)

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
            with self.subTest(words):
                self.refused_machine(words, machine(bearing))

    def test_refusals(self):
        ratios = "\n".join(BY_HAND.splitlines()[3:])
        for bearing, words in [
                (C3.replace("6205", "6299"), 'bearing.designation "6299" is not in the catalogue; there are 6002, 6203,'),
                (C3.replace("C3", "C7"), "must be C2, CN (normal), C3 or C4"),
                (C3 + "\nballs = 9", "designation and balls are both given"),
                (C3 + "\ncage_speed_ratio = 0.4", "designation and cage_speed_ratio are both given"),
                (C3 + "\nball_diameter_m = 0.01", "designation and ball_diameter_m are both given"),
                (C3 + "\ninner_groove_ratio = 0.52", "designation and inner_groove_ratio are both given"),
                (C3 + "\ncontact_stiffness_N_per_m1p5 = 1e10", "are both given"),
                (C3 + "\nradial_clearance_m = 0", "internal_clearance and radial_clearance_m are both given"),
                ('designation = "6205"', "radial_clearance_m is missing; give it, or diametral_clearance_m, or internal"),
                (BY_HAND.replace("diametral_clearance_m = 20.5e-6", 'internal_clearance = "C3"'), "needs designation"),
                (BY_HAND.replace("inner_groove_ratio = 0.52", "inner_groove_ratio = 0.5"),
                 "inner_groove_ratio must be > 0.5"),
                (BY_HAND.replace("poissons_ratio = 0.3", "poissons_ratio = 0.51"), "poissons_ratio must be in 0...0.5"),
                (BY_HAND.replace("poissons_ratio = 0.3", "poissons_ratio = -0.1"), "poissons_ratio must be >= 0"),
                (BY_HAND.replace("youngs_modulus_Pa = 2.07e11\n", ""), "youngs_modulus_Pa is missing"),
                (BY_HAND.replace("pitch_diameter_m = 0.03904\n", ""), "pitch_diameter_m is missing"),
                (BY_HAND.replace("= 0.03904", "= 0.02"), "makes the 9 balls overlap"),
                (BY_HAND.replace("balls = 9", "balls = 1").replace("= 0.03904", "= 0.007"), "overlap"),
                ("balls = 9\ncage_speed_ratio = 0.4\n" + ratios, "does not give the ball's size"),
                (C3.replace("designation", "designaton"), "did you mean designation?"),
                (C3.replace("6205", "").replace('""', "6205"), "designation must be a string")]:
            with self.subTest(words):
                self.refused_machine(words, machine(bearing))


if __name__ == "__main__":
    unittest.main()
