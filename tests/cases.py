"""Cases that people met, and what is right there: the motion by default, its kind, its
amplitude, its error.

Machines are in cases/. Numbers come from integrations, shooting and closed forms written
apart from this project; where a motion is compared instant by instant, from the judge
(truth/judge.cpp), which shares no code with src.

Usage: tests/cases.py (from the project's root)
"""
import math
import sys
import tomllib
import unittest
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

sys.path[:0] = [str(Path(__file__).parent), str(Path(__file__).parent / "truth")]
from independent import NAMES, Model  # noqa: E402
from support.explore import MACHINE, Case  # noqa: E402
from support.keys import keys_of, number  # noqa: E402
from tables import Table  # noqa: E402

CASES = Path("tests/cases").resolve()


def machine(name):
    return CASES / f"{name}.toml"


def matrix_market(path):
    """A file of coordinates, symmetric or antisymmetric ones too."""
    lines = path.read_text(encoding="utf-8").splitlines()
    sign = {"general": 0, "symmetric": 1, "skew-symmetric": -1}[lines[0].split()[-1]]
    rows = [line.split() for line in lines if not line.startswith("%")]
    matrix = np.zeros((int(rows[0][0]), int(rows[0][1])))
    for i, j, value in rows[1:]:
        matrix[int(i) - 1, int(j) - 1] = float(value)
        if i != j and sign:
            matrix[int(j) - 1, int(i) - 1] = sign * float(value)
    return matrix


def supported(stiffness, *nodes):
    """The tables of equal springs along x and y at nodes of a shaft."""
    return "".join(f"[[support]]\nnode = {node}\n"
                   f"stiffness_N_per_m = [{stiffness}, {stiffness}]\n" for node in nodes)


def half_span(column):
    return np.ptp(column) / 2


class Rolling:
    """The machine of cases/rolling.toml by its equations: 2 kg on eight elements."""

    def __init__(self, stiffness=1e10, exponent=1.5, clearance=5e-6, cage=0.375):
        self.stiffness, self.exponent = stiffness, exponent
        self.clearance, self.cage = clearance, cage

    def orbit(self, frequency, points):
        """One turn, the unbalance along x and element 1 at angle 0 when it begins."""
        omega, places = 2 * math.pi * frequency, 2 * math.pi * np.arange(8) / 8

        def rates(t, state):
            x, y, v_x, v_y = state
            angles = self.cage * omega * t + places
            pressed = np.maximum(
                x * np.cos(angles) + y * np.sin(angles) - self.clearance, 0)
            loads = self.stiffness * pressed ** self.exponent
            whirl = 1e-4 * omega**2
            return [v_x, v_y,
                    (whirl * math.cos(omega * t) - 1e3 * v_x
                     - (loads * np.cos(angles)).sum()) / 2,
                    (whirl * math.sin(omega * t) - 1e3 * v_y - 100
                     - (loads * np.sin(angles)).sum()) / 2 - 9.81]
        before, turn = -20 / frequency, 1 / frequency
        times = turn * np.arange(points) / points
        found = solve_ivp(rates, (before, turn), [0, -1e-5, 0, 0], method="DOP853",
                          t_eval=times, rtol=1e-9, atol=1e-14)
        return found.y[0], found.y[1]


class Cases(Case):
    def asked(self, command, name, *options):
        """Keys and table of a command that answers."""
        text = "\n".join(self.lines(command, machine(name), *options))
        return keys_of(text), Table.of(text)

    def errors_hold(self, name, frequency, tolerance, turns, factor=1.5):
        """What is printed of a motion with two frequencies, beside the judge's, which
        starts from rest long before: its errors are those that are printed, or below the
        tolerance."""
        keys, table = self.asked("orbit", name, "--frequency", frequency, "--tolerance",
                                 tolerance, "--periods", turns, "--points", 64)
        model = Model(tomllib.loads(machine(name).read_text(encoding="utf-8")), frequency)
        before = math.ceil(60 * frequency)
        theirs = model.judged(model.settle(model.rest(-before / frequency), -before,
                                           before, turns, turns, 64)).rows
        held = np.zeros(len(table))
        ours = np.stack([table.columns.get(of, held) for of in NAMES], axis=1)
        apart, size = ours - theirs, np.linalg.norm(theirs - theirs.mean(axis=0))
        found = {"error_largest": abs(apart).max() / abs(theirs).max(),
                 "error_rms": np.linalg.norm(apart - apart.mean(axis=0)) / size}
        for key, error in found.items():
            self.assertLessEqual(number(keys, key), tolerance)
            self.assertLessEqual(error, factor * max(number(keys, key), 1e-5),
                                 (name, key))

    def test_contacts_of_other_kinds(self):
        """Rollers, preload, an outer ring that turns: the orbit of an integration by
        DOP853 from the same rest, and the dimensions' cage by rolling without slip."""
        text = machine("rolling").read_text(encoding="utf-8")
        gap, cage = "radial_clearance_m = 5e-6", "cage_speed_ratio = 0.375"
        hertz = "contact_stiffness_N_per_m1p5 = 1e10"
        line = f"contact_exponent = {10 / 9!r}\ncontact_stiffness_N_per_mn = 2e8"
        tight = "radial_clearance_m = -5e-6"
        turning = "cage_speed_ratio = 0.625\nouter_ring_speed_ratio = 0.3"
        for name, changes, rolling in [
                ("hertz", {}, Rolling()),
                ("rollers", {hertz: line}, Rolling(stiffness=2e8, exponent=10 / 9)),
                ("preload", {gap: tight}, Rolling(clearance=-5e-6)),
                ("both", {hertz: line, gap: tight},
                 Rolling(stiffness=2e8, exponent=10 / 9, clearance=-5e-6)),
                ("outer ring", {cage: turning}, Rolling(cage=0.625))]:
            own = text
            for old, new in changes.items():
                own = own.replace(old, new)
            path = self.file(f"{name}.toml", own)
            x, y = rolling.orbit(50, 32)
            size = max(np.ptp(x), np.ptp(y))
            for how in [[], ["--method", "aft", "--tolerance", "1e-4"]]:
                with self.subTest(name=name, how=how):
                    table = Table.of("\n".join(self.lines(
                        "orbit", path, "--frequency", 50, "--points", 32, *how)))
                    self.assertEqual(table.value("regime"), "periodic")
                    self.assertLess(max(abs(table["x_r"] - x).max(),
                                        abs(table["y_r"] - y).max()), 2e-4 * size)

    def test_kinematics_with_a_contact_angle_and_a_turning_outer_ring(self):
        """bearingFaultBands of MathWorks for 8 elements of 2 cm on 12 cm at 15 degrees; a
        cage between two races that roll on the balls, and the balls' spin against it."""
        text = machine("rolling").read_text(encoding="utf-8")
        sizes = "ball_diameter_mm = 20\npitch_diameter_mm = 120\n"

        def orders(given):
            path = self.file("own.toml", text.replace("cage_speed_ratio = 0.375", given))
            table = Table.of("\n".join(self.lines("check", path)))
            return [table.value(key, None)
                    for key in ("cage_speed_ratio", "bpfo", "bpfi", "bsf")]
        published = [0.419506, 3.35605, 4.64395, 2.92225]
        np.testing.assert_allclose(orders(sizes + "contact_angle_deg = 15"), published,
                                   rtol=2e-6)
        np.testing.assert_allclose(
            orders(sizes + f"contact_angle_rad = {math.pi / 12!r}"), published, rtol=2e-6)
        for outer in (0.3, -0.2):
            inside, outside = 50, 70 * outer  # speeds of the races' surfaces
            centre = (inside + outside) / 2 / 60
            spin = abs(inside - 50 * centre) / 10
            np.testing.assert_allclose(
                orders(sizes + f"outer_ring_speed_ratio = {outer}"),
                [centre, 8 * (centre - outer), 8 * (1 - centre), spin], rtol=1e-12)
        for given, words in [
                (sizes + "contact_angle_deg = 90", "contact_angle_deg must be below"),
                (sizes + "outer_ring_speed_ratio = 1", "must be in -1 < ratio < 1"),
                (sizes + "outer_ring_speed_ratio = -0.9", "lets the cage stand still"),
                ("cage_speed_ratio = 0.625", "0 < c <= 0.5, or give outer_ring_speed_rati"),
                ("cage_speed_ratio = 0.375\ncontact_exponent = 1.1",
                 "contact_exponent needs contact_stiffness_N_per_mn")]:
            self.refused_machine(words, text.replace("cage_speed_ratio = 0.375", given))

    def test_tables_from_elsewhere(self):
        """A measured spectrum in the forms of spreadsheets draws the same figure; lists and
        nodes of our own CSV give the same rows."""
        plain = "f\tamplitude\n50\t1e-7\n179.2\t1.5e-6\n"
        forms = {"plain": plain, "windows": plain.replace("\n", "\r\n"),
                 "mark": "\ufeff" + plain, "comma": plain.replace("\t", ","),
                 "open end": plain.replace("\t", ",")[:-1],
                 "decimal comma": plain.replace("\t", ";").replace(".", ","),
                 "quotes": plain.replace("\t", ",").replace("f,", '"f",')}
        figures = {}
        for name, text in forms.items():
            overlay = self.file("overlay.tsv", "")
            overlay.write_bytes(text.encode())
            self.lines("spectrum", machine("motor"), "--frequency", 50, "--plot", "s.svg",
                       "--overlay", overlay)
            figures[name] = (self.folder / "s.svg").read_bytes()
        for name, figure in figures.items():
            self.assertEqual(figure, figures["plain"], name)
        for text, words in [("f,amplitude\n50,1e-7\n51,x\n", ":3: 'x' is not a finite"),
                            ("f,amplitude\n50,1e-7,3\n", ":2: 3 cells, must be 2"),
                            ("f,g\n50,1e-7\n", "has no column amplitude of numbers")]:
            self.refused(words, "spectrum", machine("motor"), "--frequency", 50, "--plot",
                         "s.svg", "--overlay", self.file("bad.csv", text))
        ask = ["map", machine("rolling"), "--quantity", "amplitude"]
        lists = [self.file("list.tsv", "frequency\trotor.mass_kg\n40\t2\n50\t2.5\n")]
        lists.append(self.file("list.csv", lists[0].read_text().replace("\t", ",")))
        rows = [[line for line in self.lines(*ask, "--list", path)
                 if not line.startswith("#")] for path in lists]
        self.assertEqual(rows[0], rows[1])
        self.assertEqual(len(rows[0]), 3)
        speeds = ["response", machine("rolling"), "--from", 40, "--to", 50, "--count", 2]
        kept = self.file("kept.csv", "\n".join(self.lines(*speeds, "--format", "csv")))
        self.refused("CSV has none", *speeds, "--resume", kept)
        ross = self.file("ross.toml", 'ross_version = "2.0.0"\n[parameters]\n')
        for command in ("check", "shaft"):
            self.refused("peers/from_ross.py", command, ross,
                         *(["--to", "m"] if command == "shaft" else []))

    def test_matrices_from_elsewhere(self):
        """The same machine from entries that add up, from Fortran's exponents, from a
        comment after blanks and with the line ends of Windows."""
        body = machine("rolling").read_text(encoding="utf-8")
        body = body[:body.index("[rotor]")] + """[rotor]
matrices = "m"
output_dofs = [1, 2]
vertical_dofs = [2]
unbalance = [{ dofs = [1, 2], moment_kg_m = 1e-4 }]
[[bearing]]
rotor_dofs = [1, 2]
""" + body[body.index("balls"):]
        path = self.file("own.toml", body)
        (self.folder / "m").mkdir()
        head = "%%MatrixMarket matrix coordinate real "
        self.file("m/K.mtx", head + "symmetric\n2 2 2\n1 1 1e6\n2 2 1e6\n")

        def asked(mass):
            self.file("m/M.mtx", head + mass)
            return [line for line in self.lines("check", path) if line[0] != "#"]
        expected = asked("symmetric\n2 2 2\n1 1 5\n2 2 5\n")
        for mass in ["general\n2 2 3\n1 1 2.5\n1 1 2.5\n2 2 5\n",
                     "symmetric\n2 2 5\n1 1 4\n1 1 1\n2 2 5\n2 1 1e-3\n2 1 -1e-3\n",
                     "symmetric\n  % comment\n2 2 2\n1 1 5.0D+00\n2 2 0.5d1\n",
                     "symmetric\r\n2 2 2\r\n1 1 5\r\n2 2 5\r\n"]:
            self.assertEqual(asked(mass), expected, mass)
        self.file("m/M.mtx", head + "symmetric\n2 2 4\n1 1 5\n2 1 0.1\n1 2 0.1\n2 2 5\n")
        self.refused("M.mtx:5: both triangles have entries", "check", path)

    def test_lines_of_two_bearings(self):
        """The first bearing first in the header, each line of it with its number, and the
        second one's frequencies by name where dimensions put them."""
        self.lines("shaft", machine("shaft"), "--to", "m")
        path = self.file("two.toml", machine("two_bearings").read_text(encoding="utf-8"))
        text = self.lines("spectrum", path, "--frequency", 40)
        heads = [line for line in text if line.startswith("#   bearing ")]
        self.assertEqual([line[4:15] for line in heads],
                         [f"bearing {k}: " for k in (1, 2, 1, 1, 1, 2, 2, 2)])
        self.assertIn("6306: D = 0.0119062 m", heads[2])
        self.assertIn("6308: D = 0.015081 m", heads[5])
        orders = {name: [float(cells[1]), float(cells[8])] for cells in
                  (line.split("\t") for line in text if line[0].isdigit())
                  if (name := cells[5]) != "-"}
        first, second = (8 * (1 - ball / pitch) / 2
                         for ball, pitch in [(11.9062, 52.009), (15.081, 65)])
        for name, order in [("BPFO", first), ("2BPFO_2+1X", 2 * second + 1),
                            ("2BPFO_2", 2 * second), ("1X", 1)]:
            self.assertAlmostEqual(orders[name][0], order, delta=1e-9)
        self.assertAlmostEqual(orders["1X"][1] / 1.07308e-6, 1, delta=2e-4)

    def test_passing_balls_alone(self):
        """A balanced rotor on eight balls: amplitudes by Runge-Kutta, 12,288 steps a
        turn."""
        amplitudes = {25: 3.65835e-6, 30: 4.89086e-6, 33: 6.95581e-6, 80: 5.15938e-7,
                      100: 3.00318e-7}
        for frequency, amplitude in amplitudes.items():
            with self.subTest(frequency=frequency):
                for how in [["--method", "aft", "--tolerance", "1e-4"], []]:
                    keys, table = self.asked("orbit", "passing_6306", "--frequency",
                                             frequency, *how)
                    if not how:
                        self.assertEqual(keys["base"], "passing")
                    # From rest the motion at 33 Hz is another one that does not repeat.
                    if how or frequency != 33:
                        self.assertEqual((keys["regime"], keys["stability"]),
                                         ("periodic", "stable"))
                        self.assertAlmostEqual(half_span(table["x_r"]) / amplitude, 1,
                                               delta=2e-4)

    def test_one_word_for_a_kind(self):
        """3.585 balls pass in a turn: two frequencies with the unbalance, one without
        it."""
        for name, regime, period in [("motor", "quasi-periodic", -1),
                                     ("motor_balanced", "periodic", 1)]:
            for method in ("auto", "aft", "rk4", "rk8"):
                with self.subTest(name=name, method=method):
                    keys, _ = self.asked("orbit", name, "--frequency", 50, "--method",
                                         method)
                    self.assertEqual((keys["regime"], keys["stability"]),
                                     (regime, "stable"))
            _, table = self.asked("attractors", name, "--from", 50, "--to", 51,
                                  "--count", 2, "--starts", 1)
            self.assertEqual(list(table["period"]), [period, period])
            self.assertTrue((table["lyapunov"] < 0).all())

    def test_rest_is_one_motion(self):
        """Disturbances decay by exp(-xi omega_0 t)."""
        for name, speeds in [("jeffcott_at_rest", (10, 30, 50)), ("set1_at_rest", (45,))]:
            for speed in speeds:
                with self.subTest(name=name, speed=speed):
                    keys, table = self.asked("orbit", name, "--frequency", speed)
                    self.assertEqual((keys["regime"], keys["stability"]),
                                     ("rest", "stable"))
                    self.assertEqual(max(abs(table[of]).max() for of in ("x_r", "y_r")),
                                     0)
                    if "multiplier" in keys and name == "jeffcott_at_rest":
                        rate = 0.02 * 628.318530717959
                        decay = math.exp(-rate * number(keys, "base_period"))
                        self.assertAlmostEqual(number(keys, "multiplier"), decay,
                                               delta=1e-4)
        _, table = self.asked("attractors", "jeffcott_at_rest", "--from", 10, "--to", 50,
                              "--count", 3)
        self.assertEqual(list(table["f"]), [10, 30, 50])
        self.assertEqual(abs(table["amp_x_r"]).max(), 0)

    def test_one_meaning_of_amplitude(self):
        """Half of largest less smallest over 256 turns, by Runge-Kutta."""
        right, speeds = 1.262981e-6, ["--from", 50, "--to", 51, "--count", 2]
        _, orbit = self.asked("orbit", "motor", "--frequency", 50, "--periods", 256)
        _, response = self.asked("response", "motor", *speeds)
        _, of_map = self.asked("map", "motor", "--x", "frequency=50:51:2", "--quantity",
                               "amplitude")
        _, attractors = self.asked("attractors", "motor", *speeds, "--starts", 1)
        for name, value in [("orbit", half_span(orbit["x_r"])),
                            ("response", response["amp_x_r"][0]),
                            ("map", of_map["amplitude"][0]),
                            ("attractors", attractors["amp_x_r"][0])]:
            with self.subTest(name):
                self.assertAlmostEqual(value / right, 1, delta=1e-3)

    def test_a_catalogue_bearing_over_the_speed(self):
        _, table = self.asked("map", "motor", "--x", "frequency=10:400:4", "--quantity",
                              "amplitude,ball_load")
        self.assertEqual(len(table), 4)
        self.assertTrue((np.array(table["amplitude"], float) > 0).all())
        self.assertTrue((np.array(table["ball_load"], float) > 0).all())
        for first in (10, 40):
            _, table = self.asked("response", "motor", "--from", first, "--to", 400)
            np.testing.assert_allclose(np.array(table["f"], float),
                                       np.linspace(first, 400, 101))
            self.assertTrue((np.array(table["amp_x_r"], float) > 0).all())

    def test_errors_of_two_frequencies_hold(self):
        self.errors_hold("spall_of_the_inner_race", 60.6, 1e-2, 100)
        self.errors_hold("long_transient", 86.58, 1e-3, 100)

    def test_the_nearest_motion_is_judged(self):
        """An unstable motion (multiplier 1.4538) is nearer than a stable one."""
        keys, _ = self.asked("orbit", "two_motions", "--frequency", 40.953,
                             "--harmonics", 11)
        self.assertIn(keys["stability"], ("unstable", "undecided"))

    def test_strongly_unstable_motions(self):
        """Within 1e-6 of motions whose disturbances grow 32,177 and 17,565 times a turn,
        by another shooting."""
        for name, frequency in [("grows_32177", 71.23), ("grows_17565", 77.32)]:
            with self.subTest(name):
                keys, _ = self.asked("orbit", name, "--frequency", frequency,
                                     "--harmonics", 500)
                self.assertIn(keys["stability"], ("unstable", "undecided"))

    def test_a_soft_mounting_far_above_its_resonances(self):
        """Variational equations along the motion: -1.6e-4 a turn at 300 Hz and -1.6e-5 at
        3,000 Hz."""
        for frequency, words in [(300, {"stable"}), (3000, {"stable", "undecided"})]:
            with self.subTest(frequency=frequency):
                keys, _ = self.asked("orbit", "soft_mounting", "--frequency", frequency)
                self.assertIn(keys["stability"], words)
                self.assertNotEqual(keys["regime"], "chaotic")


class Linear(Case):
    """Natural frequencies of shafts, published or by LAPACK's symmetric eigenproblem of
    K and M, gyroscopic terms in its first sixteen modes."""

    ROTOR = """title = "the bearing is never touched"
[stator]
rigid = true
[rotor]
matrices = "m"
bearing_dofs = [1, 2]
vertical_dofs = []
[bearing]
balls = 8
cage_speed_ratio = 0.375
contact_stiffness_N_per_m1p5 = 1e10
radial_clearance_m = 1.0
[gravity]
acceleration_m_per_s2 = 9.81
"""

    HELD = """title = "a pin at one end, a 6308 at the other"
[stator]
rigid = true
[rotor]
matrices = "m"
vertical_dofs = [2, 6, 10, 14, 18, 22, 26]
[[bearing]]
rotor_dofs = [25, 26]
designation = "6308"
internal_clearance = "CN"
[gravity]
acceleration_m_per_s2 = 9.81
"""

    def modes(self, shaft, *speeds, rotor=ROTOR):
        """Frequencies and damping ratios at the first speed."""
        self.lines("shaft", self.file("shaft.toml", shaft), "--to", "m")
        table = self.table("campbell", self.file("rotor.toml", rotor), "--from", speeds[0], "--to", speeds[1],
                           "--count", 2, "--modes", 10)
        first = table.where("f", table["f"][0])
        return first["frequency"], first["damping"]

    def test_a_rigid_support(self):
        """As its stiffness grows the frequencies at 10 Hz tend to those of the pinned shaft."""
        pinned = [22.902093, 23.003923, 152.201128, 157.865066, 283.866147, 297.177125]
        soft = [22.87227, 22.97367, 151.42965, 157.00955, 281.02846, 293.80377]
        for k, expected in [(1e8, soft), (1e12, pinned), (1e16, pinned), (1e20, pinned)]:
            with self.subTest(k=k):
                found, _ = self.modes("""title = "pinned"
[material]
youngs_modulus_Pa = 211e9
shear_modulus_Pa = 81.2e9
density_kg_per_m3 = 7810
[[segment]]
length_m = 1.5
diameter_m = 0.05
elements = 6
[[disk]]
node = 4
outer_diameter_m = 0.28
bore_m = 0.05
thickness_m = 0.07
""" + supported(k, 1), 10, 20, rotor=self.HELD)
                np.testing.assert_allclose(found[:6], expected, rtol=1e-5)

    def test_a_free_hollow_shaft(self):
        """Isotropic at rest: each frequency twice, without damping; speeds from 0."""
        found, damping = self.modes("""title = "nearly free"
[material]
youngs_modulus_Pa = 210e9
shear_modulus_Pa = 80.769230769e9
density_kg_per_m3 = 7850
[[segment]]
length_m = 0.3
diameter_m = 0.03008
bore_m = 0.007
elements = 10
""" + supported(1e3, 1, 11), "0rpm", "60 rpm")
        pairs = np.repeat([5.657116, 9.759929, 1536.0617, 4040.4630, 7487.4650], 2)
        np.testing.assert_allclose(found, pairs, rtol=1e-6)
        self.assertFalse(damping.any())

    def test_a_massless_shaft(self):
        """A disk on a shaft of any small density: a mass m on the stiffness of a beam with
        shear within 3e-3; within 2e-4 of each other."""
        length, diameter = 1.0, 0.02
        found = []
        for density in (1e-6, 1e-3, 1e-1):
            found.append(self.modes(f"""title = "Laval"
[material]
youngs_modulus_Pa = 211e9
shear_modulus_Pa = 81.2e9
density_kg_per_m3 = {density}
[[segment]]
length_m = {length}
diameter_m = {diameter}
elements = 8
[[disk]]
node = 5
mass_kg = 10
polar_inertia_kg_m2 = 0.05
diametral_inertia_kg_m2 = 0.026
""" + supported(1e12, 1, 9), 0, 10)[0][:2])
        bending = 48 * 211e9 * math.pi * diameter**4 / 64 / length**3
        shear = 4 * 81.2e9 * 0.9 * math.pi * diameter**2 / 4 / length
        laval = math.sqrt(1 / (1 / bending + 1 / shear) / 10) / 2 / math.pi
        np.testing.assert_allclose(found, laval, rtol=3e-3)
        np.testing.assert_allclose(np.array(found) / found[0], 1, rtol=2e-4)

    def test_one_linearisation(self):
        """97.697 Hz is the root of the mean force's slope at the displacement where that
        force is the weight. With much damping the response to the passing balls is
        largest where they meet it, and a mass as matrices has the same frequencies."""
        right, text = 97.697, machine("passing_6306").read_text(encoding="utf-8")
        speeds = ["--from", 1, "--to", 300]
        values = self.table("check", machine("passing_6306"), *speeds)
        values = dict(zip(values["name"], values["value"]))
        self.assertAlmostEqual(values["f_1_x"] / right, 1, delta=1e-4)
        self.assertAlmostEqual(values["passage_f_1_x"] / (right / 3), 1, delta=1e-4)
        critical = self.table("campbell", machine("passing_6306"), *speeds, "--count", 30,
                              "--critical")
        self.assertAlmostEqual(critical["f"][0] / right, 1, delta=1e-4)
        whirl = self.table("campbell", machine("passing_6306"), "--from", 0, "--to", 100,
                           "--count", 2)
        self.assertAlmostEqual(whirl["frequency"][0] / values["f_1_x"], 1, delta=1e-6)
        damped = self.file("damped.toml", text.replace("m = 200.0", "m = 2000.0"))
        response = self.table("response", damped, "--from", 25, "--to", 45, "--count",
                              101)
        peak = response["f"][np.argmax(response["amp_x_r"])]
        self.assertAlmostEqual(peak, values["passage_f_1_x"], delta=0.5)
        one = "%%MatrixMarket matrix coordinate real general\n2 2 2\n1 1 {0}\n2 2 {0}\n"
        for name, value in [("M", 20), ("C", 200), ("K", 0)]:
            self.file(f"{name}.mtx", one.format(value))
        start, end = text.index("mass_kg"), text.index("[bearing]")
        large = self.file("large.toml", text[:start] + 'matrices = "."\nbearing_dofs = '
                          "[1, 2]\nvertical_dofs = [2]\n" + text[end:])
        matrices = self.table("check", large, *speeds)
        matrices = dict(zip(matrices["name"], matrices["value"]))
        for name, same in [("f_1", "f_1_x"), ("f_2", "f_1_y")]:
            self.assertAlmostEqual(matrices[name] / values[same], 1, delta=1e-6)


class Measures(Case):
    def test_measures_of_a_linear_shaft(self):
        """A shaft on its supports, its disk unbalanced: the receptance of its matrices at
        the other disk gives all measures, by every command."""
        self.lines("shaft", machine("friswell_shaft"), "--to", "shaft")
        k = matrix_market(self.folder / "shaft" / "K.mtx")  # damps the fast modes too
        entries = [f"{i + 1} {j + 1} {3e-5 * k[i, j]!r}" for i, j in np.argwhere(k)]
        self.file("shaft/C.mtx", "\n".join([
            "%%MatrixMarket matrix coordinate real general",
            f"{len(k)} {len(k)} {len(entries)}", *entries, ""]))
        self.file("own.toml", machine("on_supports").read_text(encoding="utf-8").replace(
            "bearing_dofs", "output_dofs = [17, 18]\nunbalance = [{ dofs = [9, 10], "
            "moment_kg_m = 1e-3, phase_rad = 0.3 }]\nbearing_dofs"))
        m, c, g, k = (matrix_market(self.folder / "shaft" / f"{name}.mtx")
                      for name in "MCGK")
        names = ["amp_x_r_out", "amp_v_x_r_out", "amp_a_x_r_out", "peak_x_r_out",
                 "rms_v_y_r_out", "iso_x_r_out", "amp_1X_x_r_out", "phase_1X_x_r_out",
                 "phase_1X_v_x_r_out", "mean_x_r_out"]
        for f in (60,):
            omega = 2 * np.pi * f
            force = np.zeros(len(m), complex)
            force[8:10] = 1e-3 * omega**2 * np.exp(0.3j) * np.array([1, -1j])
            q = np.linalg.solve(k + 1j * omega * (c + omega * g) - omega**2 * m, force)
            x, y = abs(q[16]), abs(q[17])
            right = [x, omega * x, omega**2 * x, x, omega * y / math.sqrt(2),
                     1e3 * omega * x / math.sqrt(2), x, np.angle(q[16]),
                     np.angle(1j * q[16]), 0]
            speeds = ["--from", f, "--to", f + 1, "--count", 2]
            for command in (["orbit", "--frequency", f], ["response", *speeds],
                            ["attractors", *speeds, "--starts", 0],
                            ["orbit", "--frequency", f, "--harmonics", 3],
                            ["response", "--from", f, "--to", f + 1, "--harmonics", 3],
                            ["map", "--x", f"frequency={f}:{f + 1}:2"]):
                with self.subTest(f=f, command=command):
                    how = "--quantity" if command[0] == "map" else "--columns"
                    table = self.table(command[0], "own.toml", *command[1:], how,
                                       ",".join(names))
                    found = [float(table[name][0]) for name in names]
                    # A motion in time still has some of its transient.
                    within = 1e-6 if "--harmonics" in command else 2e-4
                    np.testing.assert_allclose(found, right, rtol=within, atol=1e-11)
        table = self.table("orbit", "own.toml", "--frequency", f, "--columns",
                           "phase,v_x_r_out,a_y_r_out")
        turning = np.exp(1j * table["phase"])
        for name, value in [("v_x_r_out", 1j * omega * q[16]),
                            ("a_y_r_out", -omega**2 * q[17])]:
            np.testing.assert_allclose(table[name], (value * turning).real,
                                       atol=1e-4 * abs(value))

    def test_rates_at_the_ends_of_a_record_that_does_not_close(self):
        """By harmonic balance, with two frequencies, and one turn of a motion of five:
        neither end is joined to the other."""
        for ratio in (0.43, 0.4):
            text = MACHINE.replace("cage_speed_ratio = 0.5", f"cage_speed_ratio = {ratio}")
            table = self.table("orbit", self.file("other.toml", text), "--frequency", 45,
                               "--method", "aft", "--tolerance", 1e-2, "--points", 2048,
                               "--columns", "x_r,v_x_r")
            x, rate = table["x_r"], table["v_x_r"]
            between = (x[1:] - x[:-1]) * 2048 * 45
            largest = abs(rate).max()
            self.assertLess(abs(between[0] - rate[:2].mean()), 0.02 * largest)
            self.assertLess(abs(between[-1] - rate[-2:].mean()), 0.02 * largest)

    def test_measures_of_a_motion_that_never_closes(self):
        """A rotor in a 6205: velocities are those of the equations of motion, by
        Runge-Kutta; the amplitude means what it does elsewhere."""
        names = ["amp_x_r", "rms_v_x_r", "amp_1X_x_r", "iso_x_r", "rms_a_x_r"]
        found = {}
        for command in (["orbit", "--frequency", 50],
                        ["response", "--from", 50, "--to", 51, "--count", 2],
                        ["attractors", "--from", 50, "--to", 51, "--count", 2, "--starts",
                         0], ["map", "--x", "frequency=50:51:2"]):
            how = "--quantity" if command[0] == "map" else "--columns"
            table = self.table(command[0], machine("motor"), *command[1:], how,
                               ",".join(names))
            found[command[0]] = [float(table[name][0]) for name in names]
        model = Model(tomllib.loads(machine("motor").read_text(encoding="utf-8")), 50)
        turns, points = 256, 256
        rows = np.array(model.judged(model.settle(model.rest(-60), -3000, 3000, turns,
                                                  turns, points)).rows)
        x = rows[:, 2]
        n, step = len(x), 1 / (50 * points)
        window = 1 - np.cos(2 * np.pi * np.arange(n) / n)
        lines = np.fft.rfft((x - x.mean()) * window)
        hertz = np.fft.rfftfreq(n, step)
        power = 2 * abs(lines / n)**2 / (window**2).mean() * (2 * np.pi * hertz)**2
        right = [half_span(x), math.sqrt(power.sum()), 2 * abs(lines[turns]) / n,
                 1e3 * math.sqrt(power[(hertz >= 10) & (hertz <= 1000)].sum()),
                 math.sqrt((power * (2 * np.pi * hertz)**2).sum())]
        for command, values in found.items():
            with self.subTest(command):
                np.testing.assert_allclose(values, right, rtol=2e-3)


class Speeds(Case):
    def test_units(self):
        """Speeds in rpm are those in Hz; both ends of a range have one unit."""
        for command, hertz, rpm in (
                ("orbit", ["--frequency", 45], ["--frequency", "2700rpm"]), ("orbit", ["--frequency", 45], ["--frequency", "2700 rpm"]),
                ("response", ["--from", 45, "--to", "46Hz", "--count", 2], ["--from", "2700rpm", "--to", "2760rpm", "--count", 2]),
                ("map", ["--x", "frequency=45:46:2", "--quantity", "mean"], ["--x", "frequency=2700rpm:2760rpm:2", "--quantity", "mean"])):
            rows = [[line for line in self.lines(command, self.machine, *asked) if not line.startswith("#")]
                    for asked in (hertz, rpm)]
            self.assertEqual(*rows)
        self.refused("--to 50: is in Hz, the other end in rpm", "response", self.machine, "--from", "2700rpm", "--to", 50)
        self.refused("--from 0: must be in 1e-300", "response", self.machine, "--from", 0, "--to", 50)
        self.refused("in Hz or as 1500rpm", "orbit", self.machine, "--frequency", "45 rps")


if __name__ == "__main__":
    unittest.main()
