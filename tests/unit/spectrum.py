"""explore spectrum: frequencies from kinematics, amplitudes from closed forms, from a transform of what orbit prints, and
one method against another.
"""
import math
import re
import tomllib

import numpy as np

from tests.support.explore import FULL, MACHINE, NAMES, Case, changed

VALUES = tomllib.loads(MACHINE)
BALLS = VALUES["bearing"]["balls"]
SIX = ["--harmonics", 6, "--no-stability"]
G = VALUES["gravity"]["acceleration_m_per_s2"]


# Rotation, cage and spin of each symbol.
SYMBOLS = {"X": (1, 0, 0), "BPFO": (0, BALLS, 0), "BPFI": (BALLS, -BALLS, 0), "FTF": (0, 1, 0), "BSF": (0, 0, 1)}


def meaning(name):
    """k_rotation, k_cage, k_spin of a name."""
    terms = re.findall(r"([+-]?)(\d*)(?:/(\d))?(X|BPFO|BPFI|FTF|BSF)", name)
    assert "".join(s + h + ("/" + d if d else "") + x for s, h, d, x in terms) == name, name
    total = np.zeros(3)
    for sign, h, d, symbol in terms:
        total += (-1 if sign == "-" else 1) * int(h or 1) / int(d or 1) * np.array(SYMBOLS[symbol])
    return total


class Spectrum(Case):
    def spectrum(self, text, frequency, *options):
        return self.table("spectrum", self.file("own.toml", text), "--frequency", frequency, *options)

    def by_name(self, table):
        return {name: np.array([table[column][k] for column in NAMES]) for k, name in enumerate(table["name"])}

    def assert_consistent(self, table, frequency, cage):
        """What the columns say of each other."""
        spin = (1 - (1 - 2 * cage) ** 2) / (2 * (1 - 2 * cage)) if cage < 0.5 else 0
        np.testing.assert_allclose(table["f"], frequency * table["order"], rtol=1e-12)
        for k, name in enumerate(table["name"]):
            numbers = [table[column][k] for column in ("k_rotation", "k_cage", "k_spin")]
            if name == "-":
                self.assertEqual(numbers, [0, 0, 0])
                continue
            np.testing.assert_allclose(numbers, meaning(name), err_msg=name)
            self.assertAlmostEqual(table["order"][k], np.dot(numbers, [1, cage, spin]), delta=1e-9)
        largest = np.max([table[column] for column in NAMES], axis=0)
        self.assertTrue((np.diff(largest) <= 0).all() and largest[-1] >= 1e-6 * largest[0])

    def test_a_rotor_that_touches_nothing(self):
        """m_e e ω²/|k - m ω² + i c ω|, one line; another unit or a factor of two would show."""
        text = changed(radial_clearance_m=0.1)
        m, w0, xi = (VALUES["rotor"][key] for key in ("mass_kg", "natural_frequency_rad_per_s", "damping_ratio"))
        for speed, *method in [(speed, *SIX) for speed in (0.5, 10, 23, 24, 60, w0 / 2 / math.pi)] + [
                (30, "--method", "shooting", "--no-stability"), (30, "--method", "rk8pd")]:
            with self.subTest(speed=speed, method=method):
                w = 2 * math.pi * speed
                amplitude = VALUES["rotor"]["unbalance_kg_m"] * w**2 / m / abs(w0**2 - w**2 + 2j * xi * w0 * w)
                table = self.spectrum(text, speed, *method)
                self.assertEqual(list(table["name"]), ["1X"])
                self.assertEqual(table["f"][0], speed)
                within = 1e-10 if "--harmonics" in method else 1e-6
                np.testing.assert_allclose([table["x_r"][0], table["y_r"][0]], amplitude, rtol=within)
                self.assertLess(max(table["x_s"][0], table["y_s"][0]), 1e-9 * amplitude)
                self.assertAlmostEqual(table.value("mean_y_r") / (-G / w0**2), 1, delta=1e-6)
        # The last one, as other commands give it.
        own = self.file("own.toml", text)
        found = self.table("attractors", own, "--from", 30, "--to", 30, "--count", 1, "--starts", 0)
        self.assertAlmostEqual(found["amp_x_r"][0] / amplitude, 1, delta=1e-7)
        orbit = self.table("orbit", own, "--frequency", 30)
        self.assertEqual(self.said(orbit, "regime", "period", "stability"), ["periodic", 1, "stable"])
        self.assertAlmostEqual(orbit.value("multiplier") / math.exp(-xi * w0 / 30), 1, delta=1e-5)
        # An undamped stator at its own resonance divides nothing by zero.
        stator = VALUES["stator"]
        undamped = text.replace(f"damping_ratio = {stator['damping_ratio']}", "damping_ratio = 0")
        self.assertEqual(list(self.spectrum(undamped, stator["natural_frequency_rad_per_s"] / 2 / math.pi, *SIX)["name"]), ["1X"])

    def test_spalls_stand_where_kinematics_says(self):
        """A light rotor, always on its balls; what is new beside the same machine without a spall."""
        cage = 0.41
        text = changed(cage_speed_ratio=cage, unbalance_kg_m=1e-4, radial_clearance_m=0)
        whole = self.by_name(self.spectrum(text, 30))
        size = max(whole["BPFO"])
        for surface, line, sidebands in [("outer_race", "2BPFO", []), ("inner_race", "BPFI", ["BPFI-1X", "BPFI+1X"]),
                                         ("ball", "2BSF", ["2BSF-FTF", "2BSF+FTF"])]:
            for depth in (1e-6, 0) if FULL or surface == "ball" else (1e-6,):
                with self.subTest(surface=surface, depth=depth):
                    spall = f"\n[bearing.defect]\nsurface = '{surface}'\ndepth_m = {depth}\nwidth_rad = 0.2\nangle_rad = -1.5\n"
                    table = self.spectrum(text + spall, 30)
                    self.assertEqual(table.value("defect"), surface)
                    found = self.by_name(table)
                    new = [name for name in [line, *sidebands]
                           if np.abs(found.get(name, 0) - whole.get(name, 0)).max() > 1e-4 * size]
                    self.assertEqual(new, [line, *sidebands] if depth else [])

    def test_spalls_of_races_by_harmonic_balance_and_shooting(self):
        text = MACHINE + "\n[bearing.defect]\nsurface = 'inner_race'\ndepth_m = 1e-6\nwidth_rad = 0.3\n"
        exact = self.by_name(self.spectrum(text, 45, "--method", "rk8pd"))
        size = max(exact["1X"])
        for method in (["--method", "shooting"], ["--method", "aft", "--tolerance", 1e-4]):
            other = self.by_name(self.spectrum(text, 45, *method))
            for name in ["1X", "2X", "3X", "BPFO"]:
                np.testing.assert_allclose(other[name], exact[name], atol=1e-4 * size, err_msg=name)
        self.refused("third frequency", "orbit", self.file("ball.toml", text.replace("inner_race", "ball").replace(
            "cage_speed_ratio = 0.5", "cage_speed_ratio = 0.4")), "--frequency", 45, "--method", "aft")

    def test_against_a_transform_of_what_orbit_prints(self):
        """25 turns of n c = 6.88 close: numpy's transform has a bin for each line, with neither window nor least squares."""
        for cage, turns, options in [(0.43, 25, ["--method", "rk8pd"]),
                                     (0.5, 1, ["--method", "shooting", "--no-stability"]),
                                     (0.5, 1, ["--harmonics", 24, "--no-stability"])]:
            with self.subTest(cage=cage, options=options):
                text = changed(cage_speed_ratio=cage)
                periods = ["--periods", turns] if turns > 1 else []
                orbit = self.table("orbit", self.file("own.toml", text), "--frequency", 45, *options, *periods)
                table = self.spectrum(text, 45, *options)
                self.assert_consistent(table, 45, cage)
                self.assertGreater(len(table), 20)
                size = max(table["y_r"])
                for name in NAMES:
                    bins = 2 * np.abs(np.fft.rfft(orbit[name])) / len(orbit)
                    places = np.rint(table["order"] * turns).astype(int)
                    np.testing.assert_allclose(table[name], bins[places], atol=3e-8 * size if turns > 1 else 1e-13 * size)

    def test_harmonic_balance_against_eighth_order_integration(self):
        """Every line within the tolerance of the largest."""
        for cage, speed in [(0.43, 45), (0.43, 30), (0.5, 30)]:
            with self.subTest(cage=cage, speed=speed):
                text = changed(cage_speed_ratio=cage)
                balance = self.by_name(self.spectrum(text, speed, "--method", "aft", "--tolerance", 1e-3, "--no-stability"))
                integrated = self.by_name(self.spectrum(text, speed, "--method", "rk8pd"))
                size = max(integrated["1X"])
                for name in balance.keys() | integrated.keys():
                    np.testing.assert_allclose(balance.get(name, np.zeros(4)), integrated.get(name, np.zeros(4)),
                                               atol=1e-3 * size, rtol=0, err_msg=name)
                common = balance.keys() & integrated.keys()
                self.assertTrue({"1X", "2X"} <= common and any("BPF" in name for name in common), common)

    def test_harmonic_balance_takes_in_the_passing_balls(self):
        """Six harmonics, the default of orbit, end below BPFO where n c = 8; a tolerance that is given decides."""
        table = self.spectrum(MACHINE, 30, "--method", "aft", "--no-stability")
        self.assertEqual(table.value("harmonics"), 24)
        self.assertTrue({"BPFO-1X", "BPFO", "2BPFO"} <= set(table["name"]))
        chosen = self.spectrum(MACHINE, 30, "--no-stability", "--method", "aft", "--tolerance", 1e-2)
        self.assertNotEqual(chosen.value("harmonics"), 24)

    def test_a_torus_that_has_doubled(self):
        """Halves of the orders and of the passages, by harmonic balance as by integration. Without them harmonic balance
        has no line at (13 - BPFO)/2, or another amplitude."""
        text = changed(cage_speed_ratio=0.3983, balls=9)
        with_halves = [self.spectrum(text, 88.2, *options) for options in (["--method", "aft", "--tolerance", "1e-3"], ["--method", "rk4"])]
        self.assertEqual(with_halves[0].value("stability"), "stable")
        rotation, cage = with_halves[0]["k_rotation"], with_halves[0]["k_cage"]
        np.testing.assert_allclose(with_halves[0]["order"], rotation + 0.3983 * cage, rtol=1e-12)
        self.assertEqual((rotation[1], cage[1]), (6.5, -4.5))
        balance, integrated = (self.by_name(table) for table in with_halves)
        for name in list(integrated)[:8]:
            np.testing.assert_allclose(balance[name], integrated[name], atol=1e-3 * integrated["1X"].max())
            np.testing.assert_allclose(balance[name], integrated[name], rtol=0.15, err_msg=name)

    def test_motion_of_two_turns(self):
        """Half orders, by both ways."""
        balance = self.spectrum(MACHINE, 20, "--method", "aft", "--subharmonic", 2, "--no-stability")
        settled = self.spectrum(MACHINE, 20, "--method", "rk4")
        self.assert_consistent(balance, 20, 0.5)
        self.assert_consistent(settled, 20, 0.5)
        a, b = self.by_name(balance), self.by_name(settled)
        for name in ["1/2X", "BPFO-1/2X", "2BPFO+1/2X"]:
            np.testing.assert_allclose(a[name], b[name], atol=1e-4 * max(a["1X"]), rtol=0)

    def test_motions_with_a_frequency_of_their_own(self):
        """A seal makes the rotor whirl with a frequency of its own, whose multiples and sums with that of the speed are the
        lines; set 1 is chaotic at 12.5 Hz (data/reference/attractors.tsv). Neither may get names by chance."""
        seal = MACHINE.replace("[gravity]", "[bearing.parallel]\nstiffness_N_per_m = [0, 6e4, -6e4, 0]\n"
                               "cubic_stiffness_N_per_m3 = 1e11\n\n[gravity]").replace("= 2e-5", "= 1")
        table = self.spectrum(seal, 14.5, "--method", "rk4")
        self.assertEqual(table.value("regime"), "quasi-periodic")
        self.assert_consistent(table, 14.5, 0.5)
        own = table["order"][table["name"] == "-"]
        self.assertGreater(len(own), 20)
        sums = np.outer(np.arange(-8, 9), [own[0]]).ravel()
        for order in own[:20]:
            off = order - sums
            self.assertLess(np.abs(off - np.rint(off)).min(), 1e-4, order)
        chaos = self.spectrum(MACHINE, 12.5, "--method", "rk4")
        self.assertGreater(np.count_nonzero(chaos["name"] == "-"), 50)
        self.assertGreater(chaos.value("unexplained"), 1e-3)

    def test_refusals(self):
        self.refused_each([("--points 64 --harmonics 6", "--points: is for shooting"),
                           ("--step 1e-5 --method shooting", "--step: is for a motion in time, by rk4, splitting or auto"),
                           ("--points 31 --method rk4", "32"), ("--points 65536 --method rk4", "--points 65536: must be at most 1024"),
                           ("--subharmonic 2 --method rk4", "--subharmonic: is for"), ("--plot lines.txt", "must end in .svg"),
                           ("--method rk5", "must be one of")], "spectrum", self.machine, "--frequency", 45)
        self.refused("budget", "spectrum", self.machine, "--frequency", 45, "--harmonics", 24, "--budget", 1000, "--plot", "a.svg",
                     status=3)
        self.assertFalse((self.folder / "a.svg").exists())
        still = self.file("still.toml", changed(radial_clearance_m=0.01, unbalance_kg_m=0))
        self.refused("nothing moves", "spectrum", still, "--frequency", 45, status=3)
