"""[bearing.parallel], [rotor.ground]: springs, dampers and a stop beside the balls or to the ground, against closed forms of a whirling
rotor, and what is refused.

The balls never touch (they are 2 mm away), so that the rotor z = x + iy obeys m z'' + (c + c_k) z' + (k + k_d - i q) z + f(|z|) z = m_e e w^2 e^{iwt}.
"""
import tomllib

import numpy as np

from tests.machines import table
from tests.support.explore import MACHINE, NAMES, Case

MASS, FREQUENCY, RATIO, UNBALANCE = 3.0, 300.0, 0.03, 6e-5
BARE = 'title = "A rotor between springs"\n' + table("stator", rigid=True) + table(
    "rotor", mass_kg=MASS, natural_frequency_rad_per_s=FREQUENCY, damping_ratio=RATIO, unbalance_kg_m=UNBALANCE) + table(
    "bearing", balls=8, contact_stiffness_N_per_m1p5=1e10, radial_clearance_m=2e-3, cage_speed_ratio=0.375) + table(
    "gravity", acceleration_m_per_s2=0.0) + "[bearing.parallel]\n"
SLOW = 2 * RATIO * FREQUENCY * MASS  # N s/m
CUBIC = "cubic_stiffness_N_per_m3 = 3e13\n"
STOP = "stop_stiffness_N_per_m = 2e6\nstop_gap_m = 1e-5\n"
SEAL = "stiffness_N_per_m = [4e4, 1e4, -1e4, 4e4]\ndamping_N_s_per_m = [20.0, 3.0, -3.0, 20.0]\n"
METHODS = ([], ["--method", "rk4"], ["--method", "rkf45"], ["--method", "shooting"], ["--harmonics", 3])
GROUND = BARE.replace("[bearing.parallel]", "[rotor.ground]")  # beside a rigid stator the same


def whirl(hertz, of_radius=lambda r: 0, stiffness=0, damping=0):
    """The radius of the circular whirl: the largest root of |m_e e w^2 / (its stiffness at this radius)| = r, by bisection from above."""
    w = 2 * np.pi * hertz

    def excess(r):
        z = MASS * (FREQUENCY**2 - w**2) + of_radius(r) + stiffness + 1j * w * (SLOW + damping)
        return r - UNBALANCE * w**2 / abs(z)

    radii = np.geomspace(1e-2, 1e-8, 20001)
    k = np.flatnonzero(np.array([excess(r) for r in radii]) <= 0)[0]
    low, high = radii[k], radii[k - 1]
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if excess(middle) <= 0 else (low, middle)
    return low


class Parallel(Case):
    def radius(self, text, hertz, *method, bare=BARE):
        """Of the orbit, which must be a circle."""
        orbit = self.table("orbit", self.file("one.toml", bare + text), "--frequency", hertz, *method)
        self.assertEqual(orbit.value("contact"), "no")
        r = np.hypot(orbit["x_r"], orbit["y_r"])
        self.assertLess(np.ptp(r), 1e-6 * r.mean())
        return r.mean()

    def test_whirl(self):
        """A hardening spring, a stop and a seal, each by integration, shooting and harmonic balance within 1e-6 of the closed form.
        Would catch a wrong sign of any coefficient, and one that a method leaves out."""
        for text, hertz, closed in (
                (CUBIC, 60, whirl(60, lambda r: 3e13 * r**2)), (STOP, 60, whirl(60, lambda r: 2e6 * max(0, 1 - 1e-5 / r))),
                (SEAL, 70, whirl(70, stiffness=4e4 - 1e4j, damping=20 - 3j)),
                (CUBIC + STOP + SEAL, 70, whirl(70, lambda r: 3e13 * r**2 + 2e6 * max(0, 1 - 1e-5 / r), 4e4 - 1e4j, 20 - 3j))):
            for bare in (BARE, GROUND):
                for method in METHODS:
                    with self.subTest(text=text, bare=bare, method=method):
                        self.assertAlmostEqual(self.radius(text, hertz, *method, bare=bare) / closed, 1, delta=2e-6)

    def test_cross_coupling_destabilises(self):
        """m z'' + c z' + (k - iq) z = 0 is unstable above q = c sqrt(k/m): the multiplier of the orbit on both sides, and the modes."""
        limit = SLOW * FREQUENCY
        for q in (0.9 * limit, 1.1 * limit):
            roots = np.roots([MASS, SLOW, MASS * FREQUENCY**2 - 1j * q])
            worst = roots[np.argmax(roots.real)]
            for bare in (BARE, GROUND):
                machine = self.file("one.toml", bare + f"stiffness_N_per_m = [0, {q}, {-q}, 0]\n")
                orbit = self.table("orbit", machine, "--frequency", 70, "--harmonics", 3)
                self.assertAlmostEqual(orbit.value("multiplier"), np.exp(worst.real / 70), delta=1e-8)
                self.assertEqual(orbit.value("stability"), "stable" if q < limit else "unstable")
                modes = self.table("campbell", machine, "--from", 70, "--to", 70, "--count", 1)
                forward = np.flatnonzero(modes["whirl"] == 1)[0]
                self.assertAlmostEqual(modes["damping"][forward], -worst.real / abs(worst), delta=1e-9)
                self.assertAlmostEqual(modes["frequency"][forward], abs(worst.imag) / 2 / np.pi, delta=1e-6)

    def test_coefficients_by_speed(self):
        """Linear between the rows of a table, constant beyond them; in a branch, its multipliers and a slow run-up too. Would catch a table
        that is read at another speed than the rotor's, and a branch that does not know how the coefficients change."""
        self.file("seal.csv", "f,k_xx,k_yy,c_xx,c_yy,k_xy,k_yx\n20,0,0,0,0,0,0\n\n60,8e4,8e4,40,40,2e4,-2e4\n")
        text = 'coefficients = "seal.csv"\n'
        for hertz, share in {10: 0, 40: 0.5, 60: 1, 90: 1}.items():
            exact = whirl(hertz, stiffness=share * (8e4 - 2e4j), damping=40 * share)
            for bare in (BARE, GROUND):
                self.assertAlmostEqual(self.radius(text, hertz, bare=bare) / exact, 1, delta=2e-6)

        def closed(f):
            return whirl(f, stiffness=(f - 20) / 40 * (8e4 - 2e4j), damping=f - 20)

        machine, ground = self.file("one.toml", BARE + text), self.file("ground.toml", GROUND + text)
        for options in (["--count", 7], ["--harmonics", 2]):
            for one in (machine, ground):
                curve = self.table("response", one, "--from", 30, "--to", 60, *options)
                np.testing.assert_allclose(curve["amp_x_r"], [closed(f) for f in curve["f"]], rtol=1e-5)
        run = self.table("runup", machine, "--from", 30, "--to", 60, "--seconds", 120)
        speeds = np.arange(35, 56, 5.0)
        np.testing.assert_allclose(np.interp(speeds, run["f"], run["amp_x_r"]), [closed(f) for f in speeds], rtol=0.01)
        self.assertFalse(run["contact_share"].any())
        modes = self.table("campbell", machine, "--from", 40, "--to", 40, "--count", 1)
        roots = np.roots([MASS, SLOW + 20, MASS * FREQUENCY**2 + 4e4 - 1e4j])
        self.assertAlmostEqual(modes["damping"][np.flatnonzero(modes["whirl"] == 1)[0]], np.min(-roots.real / abs(roots)), delta=1e-9)

    def test_beside_balls_that_touch(self):
        """Set 1 with a seal and a stop at 45 Hz: balance, shooting and integration find one motion; the balls carry part of its force."""
        text = MACHINE + "[bearing.parallel]\n" + STOP.replace("1e-5", "2e-5") + SEAL
        machine = self.file("one.toml", text)
        orbits = [self.table("orbit", machine, "--frequency", 45, *method, "--points", 64)
                  for method in ([], ["--method", "shooting"], ["--method", "aft", "--tolerance", 1e-5])]
        for orbit in orbits:
            self.assertEqual(orbit.value("contact"), "yes")
            for name in NAMES:
                np.testing.assert_allclose(orbit[name], orbits[0][name], atol=2e-5 * np.ptp(orbits[0][name]))
        balls = self.table("contact", machine, "--frequency", 45, "--points", 64)
        self.assertLess(balls["Q"].max(), np.hypot(orbits[0]["F_x"], orbits[0]["F_y"]).max())

    def test_two_bodies_to_the_ground(self):
        """Set 1 with springs between both bodies and the ground is set 1 on stiffer suspensions: the same solution, verdict, motion and
        rest. Would catch an element at the wrong body, and one that the start, the verdict or `check` leaves out."""
        springs = {"stator": 8e5, "rotor": 2e5}
        grounds, stiffer = MACHINE, MACHINE
        for body, spring in springs.items():
            values = tomllib.loads(MACHINE)[body]
            m, w, ratio = values["mass_kg"], values["natural_frequency_rad_per_s"], values["damping_ratio"]
            old = f"natural_frequency_rad_per_s = {w}\ndamping_ratio = {ratio}\n"
            self.assertIn(old, stiffer)
            stiffer = stiffer.replace(old, f"stiffness_N_per_m = {m * w * w + spring!r}\ndamping_N_s_per_m = {2 * ratio * m * w!r}\n")
            grounds += f"[{body}.ground]\nstiffness_N_per_m = [{spring}, 0, 0, {spring}]\n"
        machines = self.file("grounds.toml", grounds), self.file("stiffer.toml", stiffer)
        for ratio, harmonics in ((0.5, 6), (0.43, 5)):  # one frequency and two
            branches = [self.table("response", self.file("branch.toml", text.replace("ratio = 0.5", f"ratio = {ratio}")), "--from", 40, "--to", 45,
                                   "--harmonics", harmonics) for text in (grounds, stiffer)]
            self.assertLess(len(branches[0]), 3 * len(branches[1]))
            for name in ("amp_x_r", "amp_y_s"):
                self.assertAlmostEqual(branches[0][name][-1] / branches[1][name][-1], 1, delta=1e-3)
        for speed, *options in ((45, "--harmonics", 6, "--newton-tolerance", "1e-13"), (30,)):
            one, other = (self.table("orbit", machine, "--frequency", speed, "--points", 64, *options) for machine in machines)
            for name in NAMES:
                np.testing.assert_allclose(one[name], other[name], rtol=0, atol=(1e-9 if options else 1e-5) * np.ptp(other[name]))
            self.assertAlmostEqual(one.value("multiplier"), other.value("multiplier"), delta=1e-4)
            self.assertEqual(one.value("stability"), other.value("stability"))
        rest, exact = (self.values(machine) for machine in machines)
        for name in ("static_force", "static_y", "eccentricity", "balance_grade", "f_1_x", "f_1_y", "f_2_x", "f_2_y"):
            self.assertAlmostEqual(rest[name] / exact[name], 1, delta=1e-6, msg=name)

    def test_bodies_that_the_ground_alone_holds(self):
        """A branch goes on where neither body has a suspension: its arc length had no size of speeds."""
        free = MACHINE.replace("s = 500.0", "s = 0").replace("s = 150.0", "s = 0").replace("damping_ratio = 0.05", "damping_N_s_per_m = 1000")
        free = free.replace("damping_ratio = 0.02", "damping_N_s_per_m = 240") + "[stator.ground]\nstiffness_N_per_m = [5.9e6, 0, 0, 5.9e6]\n"
        own = self.file("own.toml", free)
        branch, orbit = self.table("response", own, "--from", 44, "--to", 45, "--harmonics", 6), self.table("orbit", own, "--frequency", 45, "--harmonics", 6)
        self.assertAlmostEqual(branch["amp_x_r"][-1] / (np.ptp(orbit["x_r"]) / 2), 1, delta=1e-3)

    def test_a_rotor_that_hangs_in_a_spring(self):
        """Beside the balls and to the ground, where nothing else holds it: its place at rest in closed form. Would catch an equilibrium that
        is given up where the spring is not stiff yet, as without displacement."""
        load = MASS * 9.81
        for bare in (BARE, GROUND):
            free = bare.replace(f"= {FREQUENCY}", "= 0").replace(f"damping_ratio = {RATIO}", "damping_N_s_per_m = 20").replace("s2 = 0.0", "s2 = 9.81")
            values = self.values(self.file("free.toml", free + CUBIC))
            self.assertAlmostEqual(values["static_y"] / -np.cbrt(load / 3e13), 1, delta=1e-9)
            self.assertAlmostEqual(values["f_1_y"] / (np.sqrt(3 * 3e13 * np.cbrt(load / 3e13)**2 / MASS) / 2 / np.pi), 1, delta=1e-4)

    def test_what_is_refused(self):
        self.file("falls.csv", "f,k_xx\n20,1\n10,2\n")
        self.file("odd.csv", "f,k_zz\n20,1\n")
        for words, text in (
                ("stop_gap_m", "stop_stiffness_N_per_m = 1e6\n"), ("stop_stiffness_N_per_m", "stop_gap_m = 1e-6\n"),
                ("must be [xx, xy, yx, yy]", "stiffness_N_per_m = [1, 2]\n"), ("must be [xx, xy, yx, yy]", "stiffness_N_per_m = 1e6\n"),
                ("_um is not a known key here; did you mean stop_stiffness_N_per_mm?", "stop_stiffness_N_per_um = 1\n"),
                ("cubic_stiffness_N_per_m3 must be >= 0", "cubic_stiffness_N_per_m3 = -1\n"),
                ("not together with coefficients", 'coefficients = "falls.csv"\nstiffness_N_per_m = [1, 2, 3, 4]\n'),
                ("rise from row to row", 'coefficients = "falls.csv"\n'), ("column k_zz", 'coefficients = "odd.csv"\n'),
                ("coefficients names no file: ", 'coefficients = "no.csv"\n'), ("cubic_stifness", "cubic_stifness_N_per_m3 = 1\n")):
            self.refused_machine(words, BARE + text)
            self.refused_machine(words, GROUND + text)
        for words, text in (("rotor.ground has nothing", BARE + "[rotor.ground]\n"), ("this one is rigid", BARE + "[stator.ground]\n" + CUBIC),
                            ("at most 4", MACHINE + 4 * ("[[rotor.ground]]\n" + CUBIC)), ("rotor.ground.dofs is of bodies given by matrices", GROUND + "dofs = [1, 2]\n" + CUBIC),
                            ("K is singular", MACHINE.replace("s = 500.0", "s = 0").replace("s = 150.0", "s = 0").replace("ratio = 0.05", "ratio = 0")
                             .replace("damping_ratio = 0.02", "damping_ratio = 0") + "[stator.ground]\nstiffness_N_per_m = [1e6, 0, 0, 0]\n")):
            self.refused_machine(words, text)
