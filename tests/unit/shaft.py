"""explore shaft: whirl frequencies of rotors whose values are published, and what is refused.

The rotors are examples 5.9.1, 5.9.2 and 5.9.9 of Friswell, Penny, Garvey and Lees, Dynamics of Rotating Machines (2010),
with the frequencies that ROSS prints for them.
"""
import resource

import numpy as np
from scipy.io import mmread

from tests.machines import table
from tests.support.explore import CASES, Case, with_table

PASSING = CASES / "passing_6306.toml"
# A pin at one end of six elements, a 6308 at the other.
HELD = 'title = "held"\n' + table("stator", rigid=True) + table("rotor", matrices="shaft", vertical_dofs=[2, 6, 10, 14, 18, 22, 26]) + table(
    "[bearing]", rotor_dofs=[25, 26], designation="6308", internal_clearance="CN") + table("gravity", acceleration_m_per_s2=9.81)


def material(young, shear, density):
    return 'title = "shaft"\n' + table("material", youngs_modulus_Pa=young, shear_modulus_Pa=shear, density_kg_per_m3=density)


STEEL = material(211e9, 81.2e9, 7810)


def segment(elements, length=1.5, diameter=0.05, bore=0):
    bored = f"bore_m = {bore}\n" if bore else ""
    return f"[[segment]]\nlength_m = {length}\ndiameter_m = {diameter}\n{bored}elements = {elements}\n"


def disk(node, diameter, bore=0.05, thickness=0.07):
    return f"[[disk]]\nnode = {node}\nouter_diameter_m = {diameter}\nbore_m = {bore}\nthickness_m = {thickness}\n"


def support(node, x, y):
    return f"[[support]]\nnode = {node}\nstiffness_N_per_m = [{x}, {y}]\n"


def two_disks(elements, x, y):
    third = elements // 3
    return (STEEL + segment(elements) + disk(third + 1, 0.28) + disk(2 * third + 1, 0.35) + support(1, x, y)
            + support(elements + 1, x, y))


OVERHUNG = STEEL + segment(6) + disk(7, 0.35) + support(1, 1e7, 1e7) + support(5, 1e7, 1e7)


class Shaft(Case):
    def matrices(self, text):
        self.lines("shaft", self.file("shaft.toml", text), "--to", "shaft")
        return [mmread(self.folder / f"shaft/{name}.mtx").toarray() for name in "MCGK"]

    def whirl(self, text, rpm):
        """Frequencies [rad/s], ascending."""
        m, c, g, k = self.matrices(text)
        n, speed = len(m), rpm * np.pi / 30
        a = np.block([[np.zeros((n, n)), np.eye(n)],
                      [-np.linalg.solve(m, k), -np.linalg.solve(m, c + speed * g)]])
        values = np.linalg.eigvals(a).imag
        return np.sort(values[values > 0])

    def test_whole_or_not_at_all(self):
        """Would catch two matrices of one shaft beside two of another, a folder without all four, and the matrices of others."""
        def no_room():
            resource.setrlimit(resource.RLIMIT_FSIZE, (16000, 16000))
        large = ["shaft", self.file("large.toml", STEEL + segment(40))]
        self.refused("M.mtx: cannot be written", *large, "--to", "new", status=3, preexec_fn=no_room)
        self.assertFalse((self.folder / "new").exists())
        self.matrices(OVERHUNG)
        old = {file.name: file.read_text(encoding="utf-8") for file in (self.folder / "shaft").iterdir()}
        self.refused("G.mtx: cannot be written", "shaft", self.file("other.toml", STEEL + segment(12)), "--to", "shaft",
                     status=3, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (7500, 7500)))
        self.assertEqual({file.name: file.read_text(encoding="utf-8") for file in (self.folder / "shaft").iterdir()}, old)
        other = self.file("shaft/C.mtx", "%%MatrixMarket matrix coordinate real general\n1 1 1\n1 1 1\n")
        self.refused("--force replaces it", *large, "--to", "shaft")
        self.assertIn("1 1 1\n1 1 1", other.read_text(encoding="utf-8"))
        self.lines(*large, "--to", "shaft", "--force")

    def test_published_frequencies(self):
        """A shear coefficient, a rotary inertia or gyroscopic moments that are wrong or missing change these digits."""
        for name, text, rpm, published in [
                ("5.9.1", two_disks(6, 1e6, 1e6), 0, [86.66, 86.66, 274.31, 274.31, 716.78]),
                ("5.9.2", two_disks(6, 1e6, 8e5), 4000, [82.33, 86.86, 239.64, 287.25, 583.49]),
                ("5.9.9", OVERHUNG, 0, [90.14, 90.14, 630.73, 630.73, 830.43, 830.43])]:
            with self.subTest(name=name, rpm=rpm):
                for value, printed in zip(self.whirl(text, rpm), published):
                    self.assertLess(abs(value - printed), 0.1 if printed > 1000 else 0.01)

    def untouched(self, text, dofs=([1, 2], [1, 2])):
        """A machine whose bearing does not touch: the shaft on its own supports."""
        self.lines("shaft", self.file("shaft.toml", text), "--to", "shaft", "--force")
        return self.file("machine.toml", 'title = "on its supports"\n' + table("stator", rigid=True) + table(
            "rotor", matrices="shaft", bearing_dofs=dofs[0], output_dofs=dofs[1]) + table("gravity", acceleration_m_per_s2=0) + table(
            "bearing", balls=8, contact_stiffness_N_per_m1p5=1e10, radial_clearance_m=1e-3, cage_speed_ratio=0.4))

    def modes(self, machine, *speeds):
        """Frequencies and damping ratios at the first speed."""
        modes = self.table("campbell", machine, "--from", speeds[0], "--to", speeds[1], "--count", 2, "--modes", 10)
        first = modes.where("f", modes["f"][0])
        return first["frequency"], first["damping"]

    def test_a_rigid_support(self):
        """As its stiffness grows the frequencies at 10 Hz tend to those of the pinned shaft, by LAPACK."""
        pinned = [22.902093, 23.003923, 152.201128, 157.865066, 283.866147, 297.177125]
        soft = [22.87227, 22.97367, 151.42965, 157.00955, 281.02846, 293.80377]
        for k, expected in [(1e8, soft), (1e12, pinned), (1e16, pinned), (1e20, pinned)]:
            with self.subTest(k=k):
                self.untouched(STEEL + segment(6) + disk(4, 0.28) + support(1, k, k))
                np.testing.assert_allclose(self.modes(self.file("held.toml", HELD), 10, 20)[0][:6], expected, rtol=1e-5)

    def test_a_free_hollow_shaft(self):
        """Isotropic at rest: each frequency, by LAPACK, twice, without damping; speeds from 0."""
        found, damping = self.modes(self.untouched(material(210e9, 80.769230769e9, 7850) + segment(10, 0.3, 0.03008, 0.007)
                                                   + support(1, 1e3, 1e3) + support(11, 1e3, 1e3)), "0rpm", "60 rpm")
        pairs = np.repeat([5.657116, 9.759929, 1536.0617, 4040.4630, 7487.4650], 2)
        np.testing.assert_allclose(found, pairs, rtol=1e-6)
        self.assertFalse(damping.any())

    def test_a_massless_shaft(self):
        """A disk on a shaft of any small density: a mass m on the stiffness of a beam with shear within 3e-3; within 2e-4 of
        each other."""
        inertia = "[[disk]]\nnode = 5\nmass_kg = 10\npolar_inertia_kg_m2 = 0.05\ndiametral_inertia_kg_m2 = 0.026\n"
        found = [self.modes(self.untouched(material(211e9, 81.2e9, density) + segment(8, 1.0, 0.02) + inertia
                                           + support(1, 1e12, 1e12) + support(9, 1e12, 1e12)), 0, 10)[0][:2]
                 for density in (1e-6, 1e-3, 1e-1)]
        bending, shear = 48 * 211e9 * np.pi * 0.02**4 / 64, 4 * 81.2e9 * 0.9 * np.pi * 0.02**2 / 4
        np.testing.assert_allclose(found, np.sqrt(1 / (1 / bending + 1 / shear) / 10) / 2 / np.pi, rtol=3e-3)
        np.testing.assert_allclose(np.array(found) / found[0], 1, rtol=2e-4)

    def test_campbell_of_published_shafts(self):
        """Radians for hertz, the sign of G, a stator that is held among the modes: each would show."""
        for text, dofs, published, whirl in [
                (two_disks(6, 1e6, 1e6), ([9, 10], [17, 18]), [85.39, 87.80, 251.78, 294.71, 600.18], [-1, 1, -1, 1, -1]),
                (OVERHUNG, ([5, 6], [25, 26]), [76.19, 103.91, 565.99, 634.23, 647.75, 1174.2], [-1, 1])]:
            own = self.untouched(text, dofs)
            whirling = self.table("campbell", own, "--from", 1e-3, "--to", 4000 / 60, "--count", 41, "--modes", 6)
            last = whirling.rows(whirling["f"] > 66.66)
            for value, printed in zip(2 * np.pi * last["frequency"], published):
                self.assertLess(abs(value - printed), 0.1 if printed > 1000 else 0.01)
            self.assertEqual(list(last["whirl"][:len(whirl)]), whirl)
            self.assertLess(abs(last["damping"]).max(), 1e-6)

            # A critical speed is one at which the matrices have a mode of that frequency.
            critical = self.table("campbell", own, "--from", 1, "--to", 30, "--count", 9, "--modes", 6, "--critical")
            self.assertGreater(len(critical), 3)
            for speed, line, mode, frequency in zip(*(critical[name] for name in ("f", "line", "mode", "frequency"))):
                self.assertAlmostEqual(frequency / speed, {"1X": 1, "BPFO": 3.2}[line], places=6)
                self.assertAlmostEqual(self.whirl(text, 60 * speed)[int(mode) - 1] / (2 * np.pi), frequency, places=4)

    def test_one_linearisation(self):
        """97.697 Hz is the root of the mean force's slope at the displacement where that force is the weight. With much damping
        the response to the passing balls is largest where they meet it, and a mass as matrices has the same frequencies."""
        right, text = 97.697, PASSING.read_text(encoding="utf-8")
        speeds = ["--from", 1, "--to", 300]
        values = self.values(PASSING, *speeds)
        self.assertAlmostEqual(values["f_1_x"] / right, 1, delta=1e-4)
        self.assertAlmostEqual(values["passage_f_1_x"] / (right / 3), 1, delta=1e-4)
        critical = self.table("campbell", PASSING, *speeds, "--count", 30, "--critical")
        self.assertAlmostEqual(critical["f"][0] / right, 1, delta=1e-4)
        whirl = self.table("campbell", PASSING, "--from", 0, "--to", 100, "--count", 2)
        self.assertAlmostEqual(whirl["frequency"][0] / values["f_1_x"], 1, delta=1e-6)
        self.assertEqual(set(whirl["whirl"]), {0})
        damped = self.file("damped.toml", text.replace("m = 200.0", "m = 2000.0"))
        response = self.table("response", damped, "--from", 25, "--to", 45, "--count", 101)
        peak = response["f"][np.argmax(response["amp_x_r"])]
        self.assertAlmostEqual(peak, values["passage_f_1_x"], delta=0.5)
        one = "%%MatrixMarket matrix coordinate real general\n2 2 2\n1 1 {0}\n2 2 {0}\n"
        for name, value in [("M", 20), ("C", 200), ("K", 0)]:
            self.file(f"{name}.mtx", one.format(value))
        large = self.file("large.toml", with_table('[rotor]\nmatrices = "."\nbearing_dofs = [1, 2]\nvertical_dofs = [2]', text))
        matrices = self.values(large, *speeds)
        for name, same in [("f_1", "f_1_x"), ("f_2", "f_1_y")]:
            self.assertAlmostEqual(matrices[name] / values[same], 1, delta=1e-6)

    def test_units_of_a_shaft(self):
        """What no shaft has is doubted; the mass is that of all bodies on it."""
        plain = STEEL + segment(6) + disk(4, 0.28)
        for old, new, words in [("211000000000.0", "211", "a modulus of 211 Pa"), ("81200000000.0", "795e9", "the moduli give a Poisson's ratio of -0.867"),
                                ("7810", "7.81", "a density of 7.81 kg/m^3"), ("length_m = ", "length_m = 1000", "a shaft of")]:
            self.assertIn(old, plain)
            run = self.run_explore("shaft", self.file("doubtful.toml", plain.replace(old, new)), "--to", self.folder / "doubtful")
            self.assertEqual(run.returncode, 0)
            self.assertIn("warning: " + words, run.stderr)
        made = self.table("shaft", self.file("plain.toml", plain), "--to", self.folder / "plain")
        volume = np.pi / 4 * (0.05**2 * 1.5 + (0.28**2 - 0.05**2) * 0.07)
        self.assertAlmostEqual(made.value("mass") / (7810 * volume), 1, delta=1e-9)

    def test_hollow_shaft(self):
        """A slender free hollow shaft bends a little slower than the beam of Euler and Bernoulli; M holds its mass."""
        m, _, _, k = self.matrices(STEEL + segment(30, bore=0.03))
        area = np.pi / 4 * (0.05**2 - 0.03**2)
        upright = np.zeros(len(m))
        upright[1::4] = 1
        self.assertAlmostEqual(upright @ m @ upright / (7810 * area * 1.5), 1, places=12)
        moment = np.pi / 64 * (0.05**4 - 0.03**4)
        beam = 4.730040744862704**2 * np.sqrt(211e9 * moment / (7810 * area)) / 1.5**2
        first = np.sqrt(np.sort(np.linalg.eigvals(np.linalg.solve(m, k)).real)[4])
        self.assertLess(first, beam)
        self.assertGreater(first, 0.99 * beam)

    def test_other_ways(self):
        """A disk by its inertia is that by its dimensions; a mass adds to the diagonal; damping is what it says."""
        squares, mass = 0.28**2 + 0.05**2, 7810 * np.pi / 4 * (0.28**2 - 0.05**2) * 0.07
        text = STEEL + segment(2)
        inertia = (f"[[disk]]\nnode = 2\nmass_kg = {mass!r}\npolar_inertia_kg_m2 = {mass * squares / 8!r}\n"
                   f"diametral_inertia_kg_m2 = {mass * (squares / 16 + 0.07**2 / 12)!r}\n")
        for a, b in zip(self.matrices(text + disk(2, 0.28)), self.matrices(text + inertia)):
            np.testing.assert_allclose(a, b, rtol=1e-12, atol=1e-9)
        m, _, _, k = self.matrices(text)
        heavier, c, _, _ = self.matrices(text + "[[mass]]\nnode = 3\nmass_kg = 2\n" + support(1, 0, 0)
                                         + "damping_N_s_per_m = [3, 4]\n[damping]\nover_mass_1_per_s = 5\n"
                                         "over_stiffness_s = 1e-6\n")
        added = np.zeros(12)
        added[8:10] = 2
        np.testing.assert_allclose(heavier, m + np.diag(added), rtol=1e-14, atol=0)
        dampers = np.zeros(12)
        dampers[:2] = 3, 4
        np.testing.assert_allclose(c, np.diag(dampers) + 5 * heavier + 1e-6 * k, rtol=1e-12, atol=1e-12)

    def test_refused(self):
        good = two_disks(6, 1e6, 1e6)
        for old, new, words in [("node = 3", "node = 8", "1...7"), ("bore_m = 0.05", "bore_m = 0.4", "below"),
                                ("elements = 6", "elements = 0", "elements"), ("[1000000.0, 1000000.0]", "[1]", "[x, y]"),
                                ("density_kg_per_m3 = 7810", "density_kg_per_m3 = 0", "density"),
                                ("title", "titel", "title"), ("thickness_m = 0.07\n", "", "thickness_m"),
                                ("[[segment]]", "[[segmnt]]", "segment")]:
            self.assertIn(old, good)
            self.refused(words, "shaft", self.file("bad.toml", good.replace(old, new, 1)), "--to", "shaft")
        self.assertFalse((self.folder / "shaft").exists())
        own = self.file("good.toml", good)
        self.refused("--to", "shaft", own, "--to", own)
        self.refused("segment is of a shaft: explore shaft makes its matrices", "orbit", own, "--frequency", 20)
        self.refused("--to", "shaft", own, "--to", "no/such/folder")
