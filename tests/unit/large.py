"""Bodies given by matrices: the paper's machine in that form, what is refused, and flexible shafts: the printed force is
that of the printed motion, and all degrees of freedom answer it as printed.
"""
import importlib.util
import os
import re
import subprocess
import sys
import time
import tomllib
import types
import unittest
from pathlib import Path

import numpy as np
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import spsolve

from scipy.io import mmread
from tests.machines import table
from tests.truth.independent import errors
from tests.unit.shaft import STEEL, disk, segment, support
from tests.support.explore import EXPLORE, FORCES, FULL, MACHINE, NAMES, SANITIZED, SETS, Case, Table, some

GRAVITY = 9.81
BRIEF = ["--frequency", 45, "--harmonics", 6, "--points", 4, "--no-stability"]
BEARING = {"balls": 8, "cage": 0.375, "phase": 0, "stiffness": 1e10, "clearance": 1e-5}
OTHER = {"balls": 10, "cage": 0.3, "phase": -0.2, "stiffness": 7e9, "clearance": 1.5e-5}


def matrix_market(matrix, kind="general"):
    """`kind`: general, or the triangle of a symmetric matrix that is written: upper, lower; or array."""
    n = len(matrix)
    if kind == "array":
        return f"%%MatrixMarket matrix array real general\n{n} {n}\n" + "".join(f"{x!r}\n" for x in matrix.T.flat)
    rows = [f"{i + 1} {j + 1} {float(matrix[i, j])!r}\n" for i in range(n) for j in range(n) if matrix[i, j] != 0
            and (kind == "general" or (i >= j if kind == "lower" else i <= j))]
    stored = kind if kind == "general" else "symmetric"
    return f"%%MatrixMarket matrix coordinate real {stored}\n% written by a test\n{n} {n} {len(rows)}\n" + "".join(rows)


class Large(Case):
    def folder_of(self, name, m, c=None, g=None, k=None, kind="general"):
        (self.folder / name).mkdir(exist_ok=True)
        for letter, matrix in [("M", m), ("C", c), ("G", g), ("K", k)]:
            if matrix is not None:
                self.file(f"{name}/{letter}.mtx", matrix_market(matrix, "general" if letter == "G" else kind))

    def paper_machine(self, number=1):
        values = tomllib.loads(SETS[number].read_text(encoding="utf-8"))
        text = f'title = "Set {number} by matrices"\n'
        for body in ["stator", "rotor"]:
            v = values[body]
            m, w = v["mass_kg"], v["natural_frequency_rad_per_s"]
            one = np.eye(2)
            self.folder_of(body, m * one, 2 * v["damping_ratio"] * m * w * one, None, m * w * w * one)
            text += f'[{body}]\nmatrices = "{body}"\nbearing_dofs = [1, 2]\nvertical_dofs = [2]\n'
        text += f"unbalance = [{{ dofs = [1, 2], moment_kg_m = {values['rotor']['unbalance_kg_m']} }}]\n"
        return text + table("bearing", **values["bearing"]) + table("gravity", **values["gravity"])

    def test_the_papers_machine(self):
        """Another sign of a force, a wrong weight, a spring k_0 that does not cancel, a verdict that forgets a
        coordinate: each would show."""
        options = ["--harmonics", 6, "--newton-tolerance", "1e-13"]
        for number, speeds in [(1, [20, 30, 45, 90]), (2, [45, 90])]:
            own = self.file("own.toml", self.paper_machine(number))
            for speed in speeds:
                with self.subTest(number=number, speed=speed):
                    a = self.table("orbit", own, "--frequency", speed, *options)
                    b = self.table("orbit", SETS[number], "--frequency", speed, *options)
                    self.same(a, b, 1e-10, NAMES, FORCES)
                    self.assertEqual(*(self.said(table, "stability", "regime", "period") for table in (a, b)))

    def test_a_branch_of_a_body_that_shows_more(self):
        """Outputs beside x_s ... y_r: the arc begins at 0 and Newton's steps are few, the harmonics are those of the amplitude."""
        own = self.file("shaft.toml", self.shaft(4, [(0, BEARING), (4, BEARING)], 0)[0])
        branch = self.table("response", own, "--from", 40, "--to", 40.5, "--harmonics", 6, "--columns", "f,arc,newton")
        self.assertEqual(branch["arc"][0], 0)
        self.assertLess(branch["newton"].max(), 30)
        sweep = self.table("response", own, "--from", 40, "--to", 40.5, "--count", 2, "--method", "aft", "--tolerance", 1e-2, "--harmonics-of", "x_r",
                           "--columns", "f,error,x_r_1_re,x_r_1_im,amp_1X_x_r")
        self.assertTrue((0 < sweep["error"]).all() and (sweep["error"] < 1e-2).all())
        np.testing.assert_allclose(np.hypot(sweep["x_r_1_re"], sweep["x_r_1_im"]), sweep["amp_1X_x_r"], rtol=1e-6)

    def test_the_period_is_that_of_all_bearings(self):
        """Of the second one 3.2 balls pass in a turn."""
        text = self.shaft(4, [(0, {**BEARING, "balls": 8, "cage": 0.375}), (4, {**BEARING, "balls": 8, "cage": 0.4})], 0)[0]
        self.refused("3.2 balls pass in a turn", "orbit", self.file("shaft.toml", text), "--frequency", 45, "--method", "shooting")

    def test_unbalance_of_the_stator(self):
        """It alone excites; its period is the turn's, by harmonic balance as by integration."""
        text = self.paper_machine()
        line = re.search(r"^unbalance.*\n", text, re.MULTILINE)[0]
        own = self.file("own.toml", text.replace(line, "").replace("[rotor]\n", line + "[rotor]\n"))
        balance, integrated = (self.table("orbit", own, "--frequency", 45, *how) for how in (["--harmonics", 12], []))
        self.assertEqual(balance.value("base"), "turn")
        for name in NAMES:
            self.assertAlmostEqual(np.ptp(balance[name]) / np.ptp(integrated[name]), 1, delta=0.01)

    def test_bearings_that_are_not_plain(self):
        """Contact damping, a spall, preload, rollers and a seal: single masses by matrices answer as two masses do, by harmonic
        balance, verdict and integration. A rate or a slope that is left out would show."""
        seal = "[bearing.parallel]\nstiffness_N_per_m = [0, 2e5, -2e5, 0]\ndamping_N_s_per_m = [500, 20, -20, 500]\nstop_stiffness_N_per_m = 1e8\n" \
               "stop_gap_m = 2.1e-5\n"
        damped, hertz = "balls = 16\ncontact_damping_s_per_m = 2.0\n", "contact_stiffness_N_per_m1p5 = "
        plain = self.paper_machine()
        for changes, more in some([([("balls = 16\n", damped)], ""), ([("clearance_m = 2e-05\n", "clearance_m = -5e-6\n")], ""),
                              ([("balls = 16\n", "balls = 16\ncontact_exponent = 1.1\n"), (hertz + "100000000000.0", "contact_stiffness_N_per_mn = 1e9")], ""),
                              ([("balls = 16\n", damped)], '[bearing.defect]\nsurface = "inner_race"\ndepth_m = 2e-6\nwidth_rad = 0.3\n'), ([], seal)], 2):
            files = []
            for name, text in [("own.toml", plain), ("paper.toml", MACHINE.replace("2e-5\n", "2e-05\n").replace("1e11", "100000000000.0"))]:
                for old, new in changes:
                    self.assertIn(old, text)
                    text = text.replace(old, new)
                files.append(self.file(name, text + more))
            with self.subTest(changes=changes, more=more):
                for accuracy, options in [(1e-8, ["--harmonics", 12, "--newton-tolerance", "1e-12"]), (2e-5, [])]:
                    a, b = (self.table("orbit", file, "--frequency", 45, "--points", 64, *options) for file in files)
                    self.same(a, b, accuracy, NAMES, FORCES)
                    self.assertAlmostEqual(a.value("multiplier"), b.value("multiplier"), delta=1e-4)
                    self.assertEqual(*(self.said(table, "stability", "regime", "period") for table in (a, b)))

    def test_damped_bearings_in_either_order(self):
        """The force of the second bearing is that of the first where their order is turned round: rates at another place would show."""
        pair, tables = [(0, {**BEARING, "phase": 0.3}), (4, {**OTHER, "balls": 8, "cage": 0.375})], []
        for bearings in [pair, pair[::-1]]:
            text = self.shaft(4, bearings, 0)[0].replace("contact_stiff", "contact_damping_s_per_m = 1.0\ncontact_stiff")
            own = self.file("shaft.toml", text)
            tables.append([self.table("orbit", own, "--frequency", 40, "--points", 64, *options)
                           for options in [["--harmonics", 12, "--no-stability"], ["--method", "gauss", "--local-error", 1e-9, "--longest", 0.1]]])
        for one, other in zip(*tables):
            for a, b in ((one, other), (other, one)):
                second = {name: a[f"{name}_2"] for name in NAMES + FORCES}
                self.same(second, b, 1e-6, NAMES, FORCES)
        solution = ["--harmonics", 12, "--no-stability", "--points", 2048]
        forces, balls = self.table("orbit", own, "--frequency", 40, *solution), self.table("contact", own, "--frequency", 40, *solution)
        measured = [*self.measured_by_bearing("map", own, "--x", "frequency=40:40:1", "--harmonics", 12),
                    *self.measured_by_bearing("response", own, "--from", 40, "--to", 40.2, "--harmonics", 12)]
        for k, row in enumerate(measured):
            of = balls["Q"][balls["bearing"] == 1 + k % 2].reshape(2 * 2048, -1)
            right = [of.max(), (of > 0).any(1).mean(), *(np.ptp(forces[name + ["", "_2"][k % 2]]) / 2 for name in FORCES)]
            np.testing.assert_allclose(row, right, rtol=5e-3)

    def measured_by_bearing(self, command, own, *options):
        """Of the first, then of the second: largest force of a ball, share of contact, amplitudes of the force."""
        names = [[f"ball_load{tail}", f"contact_share_{b}", f"amp_F_x{tail}", f"amp_F_y{tail}"] for b, tail in [(1, ""), (2, "_2")]]
        table = self.table(command, own, *options, {"map": "--quantity", "response": "--columns"}[command], ",".join(["f", *sum(names, [])][command == "map":]))
        return [[table[name][0] for name in one] for one in names]

    def test_kinds_of_files(self):
        """A triangle that is read as the whole matrix, or one matrix transposed, would give other numbers."""
        text, whole, *_ = self.shaft(2, [(2, BEARING)], 4e6)
        own, rows = self.file("own.toml", text), []
        for kind in ["general", "upper", "lower", "array"]:
            self.folder_of("shaft", *(matrix[2:, 2:] for matrix in whole), kind)
            rows.append(self.rows("orbit", own, *BRIEF))
        for other in rows[1:]:
            self.assertEqual(rows[0], other)

    def test_matrices_of_calculix(self):
        """An upper triangle that is read as the whole matrix would be refused or give another motion."""
        run = ["orbit", self.file("own.toml", self.paper_machine()), "--frequency", 45, "--points", 4]
        before = self.table(*run)
        k, m = 40 * 150.0**2, 40
        self.file("job.sti", f"1 1 {k}\n1 2 0.\n2 2 {k}\n")
        self.file("job.mas", f"1 1 {m}\n2 2 {m}\n")
        self.file("job.dof", "7.1\n7.2\n")
        printed = subprocess.run([sys.executable, "peers/calculix.py", self.folder / "job", self.folder / "rotor"],
                                 check=True, capture_output=True, encoding="utf-8").stdout
        self.assertEqual(printed.splitlines()[1:], ["1\t7\t1", "2\t7\t2"])
        self.assertIn("symmetric\n2 2 3\n1 1 900000.0\n2 1 0.\n", (self.folder / "rotor/K.mtx").read_text(encoding="utf-8"))
        np.testing.assert_allclose(self.table(*run)["x_r"], before["x_r"], rtol=1e-9)

    def test_whirl_is_forward_backward_planar_or_mixed(self):
        """Two places, joined by springs that make them move alike along x and against each other along y: the areas of the ellipses of both, from eigenvectors here."""
        turn, f = np.array([[0, 1.0], [-1, 0]]), 45
        m, k = np.diag([4.0, 4, 3, 3]), np.diag([4e5, 4.2e5, 9e5, 9.1e5])
        k[:2, 2:] = k[2:, :2] = np.diag([-2e5, 2e5])
        g = np.block([[2 * turn, 0 * turn], [0 * turn, 0 * turn]])
        self.folder_of("rotor", m, 1e-6 * k, g, k)
        own = self.file("own.toml", 'title = "own"\n[stator]\nrigid = true\n[rotor]\nmatrices = "rotor"\nbearing_dofs = [1, 2]\n'
                        "output_dofs = [3, 4]\nvertical_dofs = []\n[bearing]\nballs = 9\ncontact_stiffness_N_per_m1p5 = 1e10\n"
                        "radial_clearance_m = 1e-5\ncage_speed_ratio = 0.4\n[gravity]\nacceleration_m_per_s2 = 0\n")
        table = self.table("campbell", own, "--from", f, "--to", f, "--count", 1)
        c = 1e-6 * k + 2 * np.pi * f * g
        values, vectors = np.linalg.eig(np.block([[np.zeros((4, 4)), np.eye(4)], [-np.linalg.solve(m, k), -np.linalg.solve(m, c)]]))
        kinds = []
        for mode in sorted((mode for mode in range(8) if values[mode].imag > 0), key=lambda mode: values[mode].imag):
            x, y = vectors[0:4:2, mode], vectors[1:4:2, mode]
            areas = 2 * (x * y.conj()).imag
            less, more = sorted([areas[areas > 0].sum(), -areas[areas < 0].sum()])
            size = (abs(x)**2 + abs(y)**2).sum()
            kinds.append(0 if more < 0.02 * size else 2 if less > 0.1 * more else 1 if areas.sum() > 0 else -1)
        self.assertEqual(list(table["whirl"]), kinds)
        self.assertIn(2, kinds)

    def test_matrices_of_ross(self):
        """Methods as those of ROSS's Rotor. A transposed G would turn the whirl round; it is the only matrix that shows it."""
        spec = importlib.util.spec_from_file_location("from_ross", "peers/from_ross.py")
        script = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(script)
        own = self.file("own.toml", self.paper_machine())
        k, m, g = np.diag([9e5, 8e5]), 40 * np.eye(2), np.array([[0, 7.0], [-7, 0]])
        rotor = types.SimpleNamespace(M=lambda _: m, K=lambda _: k, C=lambda _: 0 * m, G=lambda: g)
        tables = []
        for write in [lambda: self.folder_of("rotor", m, 0 * m, g, k), lambda: script.write(rotor, self.folder / "rotor")]:
            write()
            tables.append(self.table("orbit", own, "--frequency", 45, "--points", 4, "--no-stability"))
        np.testing.assert_allclose(tables[1]["x_r"], tables[0]["x_r"], rtol=1e-12)

    def test_refused(self):
        good = self.paper_machine()
        run = ["orbit", self.file("own.toml", good), "--frequency", 45, "--points", 4]

        def with_file(name, text, words):
            path = self.folder / name
            kept = path.read_text(encoding="utf-8")
            self.file(name, text)
            self.refused(words, *run)
            path.write_text(kept, encoding="utf-8")

        head = "%%MatrixMarket matrix coordinate real general\n"
        for text, words in [
                ("", "must be %%MatrixMarket"), ("\0" * 5000, "line"),
                ("%%MatrixMarket matrix coordinate pattern general\n2 2 1\n1 1\n", "pattern"),
                ("%%MatrixMarket matrix coordinate complex general\n2 2 1\n1 1 1 0\n", "complex"),
                ("%%MatrixMarket matrix coordinate real hermitian\n2 2 1\n1 1 1\n", "hermitian"),
                ("%%MatrixMarket vector coordinate real general\n2 2 1\n1 1 1\n", "must be %%MatrixMarket"),
                (head, "sizes"), (head + "2 3 1\n1 1 1\n", "square"), (head + "3 3 1\n1 1 1\n", "M.mtx 2"),
                (head + "2 2 2\n1 1 1\n", "ends after 1 of 2"), (head + "2 2 1\n1 1 1\n2 2 1\n", "ended"),
                (head.replace("general", "symmetric") + "2 2 2\n1 2 1\n2 1 1\n", "triangles"), (head + "2 2 1\n1 3 1\n", "1...2"),
                (head + "2 2 1\n0 1 1\n", "1...2"), (head + "2 2 1\n1 1 nan\n", "finite"),
                (head + "2 2 1\n1 1 1 1\n", "more"), (head + "2 2 1\n1 1\n", "lacks"),
                (head + "2 2 1\n1 1 x\n", "something else"),
                (head + "2 2 1\n1 1 +-5\n", "something else"), (head + "2 2 1\n1 1 5\0 7\n", "something else"),
                (head + "2 2 1\n1 2 1\n", "symmetric"), (head + "2 2 3\n1 1 1e16\n2 2 1e5\n1 2 1e6\n", "symmetric in row"),
                (head + "2 2 1000000000000\n1 1 1\n", "entries"), (head + "100000 100000 2000000000\n1 1 1\n", "can hold"),
                (head + "2 2 2\n1 1 1e5\n2 2 -1e12\n", "singular")]:
            with_file("rotor/K.mtx", text, words)
        with_file("rotor/M.mtx", head + "2 2 1\n1 1 1\n", "freedom 2 has no mass")
        with_file("rotor/M.mtx", head + "2 2 4\n1 1 1\n2 2 1\n1 2 2\n2 1 2\n", "positive definite")
        self.file("rotor/G.mtx", head + "2 2 2\n1 2 1\n2 1 1\n")
        self.refused("antisymmetric", *run)
        (self.folder / "rotor/G.mtx").unlink()
        for old, new, words in [
                ('"rotor"', '"nowhere"', "no folder"), ("[1, 2]\nvertical_dofs = [2]\nunb", "[1, 3]\nunb", "1...2"),
                ("dofs = [1, 2], mom", "dofs = [1, 5], mom", "1...2"), ("dofs = [1, 2], mom", "dofs = [2, 2], mom", "[x, y]"),
                ("vertical_dofs = [2]\nunb", "unb", "vertical_dofs"), ("moment_kg_m = ", "moment_kg_m = -", "moment"),
                ("bearing_dofs = [1, 2]\nvertical_dofs = [2]\n[rotor]", "vertical_dofs = [2]\n[rotor]", "bearing_dofs"),
                ("[rotor]\n", "[rotor]\nmass_kg = 1\n", "mass_kg")]:
            self.assertIn(old, good)
            self.refused(words, "orbit", self.file("bad.toml", good.replace(old, new)), *run[2:])
        self.refused("gauss", *run, "--method", "rk4")
        self.refused("gauss", "orbit", self.machine, *run[2:], "--method", "gauss")

    def shaft(self, elements, bearings, spring, name="shaft"):
        """A shaft with a disk in the middle, weight and unbalance there. `bearings`: (node, parameters), between the shaft
        and a stator that is a single mass. Its left end stands on a spring. The text of its file, and the matrices of all."""
        self.lines("shaft", self.file("beam.toml", STEEL + segment(elements, 0.8) + f"[[disk]]\nnode = {elements // 2 + 1}\n"
                                      "mass_kg = 12\npolar_inertia_kg_m2 = 0.15\ndiametral_inertia_kg_m2 = 0.08\n" + support(1, spring, spring)
                                      + "[damping]\nover_mass_1_per_s = 100\nover_stiffness_s = 2e-6\n"), "--to", name, "--force")
        m, c, g, k = (mmread(self.folder / f"{name}/{letter}.mtx").toarray() for letter in "MCGK")
        n, middle, phase = len(m), 2 * elements, 0.7
        vertical = [4 * node + 1 for node in range(elements + 1)]
        m_s, w_s, ratio = 25, 400, 0.12  # of the stator
        text = 'title = "flexible shaft"\n' + table("stator", mass_kg=m_s, natural_frequency_rad_per_s=w_s, damping_ratio=ratio)
        text += table("rotor", matrices=name, output_dofs=[middle + 1, middle + 2], vertical_dofs=[dof + 1 for dof in vertical])
        text += (f"unbalance = [{{ dofs = [{middle + 1}, {middle + 2}], moment_kg_m = 2e-3, phase_rad = {phase} }},"
                 " { dofs = [1, 2], moment_kg_m = 3e-4 }]\n" + table("gravity", acceleration_m_per_s2=GRAVITY))
        joints = []
        for node, b in bearings:
            text += table("[bearing]", rotor_dofs=[4 * node + 1, 4 * node + 2], stator_dofs=[1, 2], balls=b["balls"], cage_speed_ratio=b["cage"],
                          cage_phase_rad=b["phase"], contact_stiffness_N_per_m1p5=b["stiffness"], radial_clearance_m=b["clearance"])
            d = np.zeros((n + 2, 2))
            d[[0, 1], [0, 1]], d[[2 + 4 * node, 3 + 4 * node], [0, 1]] = -1, 1
            joints.append((d, b))
        whole = [np.block([[np.eye(2) * s, np.zeros((2, n))], [np.zeros((n, 2)), a]]) for s, a in
                 [(m_s, m), (2 * ratio * m_s * w_s, c), (0, g), (m_s * w_s**2, k)]]
        up = np.zeros(n + 2)
        up[[1] + [2 + dof for dof in vertical]] = 1
        unbalance = np.zeros(n + 2, complex)
        unbalance[2 + middle:4 + middle] += 2e-3 * np.exp(1j * phase) * np.array([1, -1j])
        unbalance[2:4] += 3e-4 * np.array([1, -1j])
        return text, whole, joints, -GRAVITY * whole[0] @ up, unbalance, middle

    def answers(self, elements, bearings, spring, speeds):
        """With the force that is printed all degrees of freedom answer, harmonic by harmonic, as is printed; and the force
        is Eqs 3 to 6 of the paper, but for the sign of Eq. 4, at the printed motion. Yields tables, whole answers."""
        samples, harmonics = 256, 20
        text, whole, joints, weight, unbalance, middle = self.shaft(elements, bearings, spring)
        m, c, g, k = (csc_matrix(a) for a in whole)
        own, phi = self.file("shaft.toml", text), 2 * np.pi * np.arange(samples) / samples
        for speed in speeds:
            run = [own, "--frequency", speed, "--points", samples, "--samples", samples, "--harmonics", harmonics, "--no-stability"]
            table, w, shown = self.table("orbit", *run), 2 * np.pi * speed, []
            load = np.zeros((samples, len(weight))) + weight + np.real(np.outer(np.exp(1j * phi), w**2 * unbalance))
            for number, ((node, b), (d, _)) in enumerate(zip(bearings, joints), 1):
                tail = f"_{number}" if number > 1 else ""
                x_s, y_s, x_r, y_r, *force = (table[name + tail] for name in [*NAMES, "F_x", "F_y"])
                shown += [(0, x_s), (1, y_s), (2 + 4 * node, x_r), (3 + 4 * node, y_r)]
                angle = b["cage"] * phi + b["phase"] + 2 * np.pi * np.arange(b["balls"])[:, None] / b["balls"]
                pressed = np.maximum(0, np.cos(angle) * (x_r - x_s) + np.sin(angle) * (y_r - y_s) - b["clearance"])
                for along, printed in zip((np.cos(angle), np.sin(angle)), force):
                    np.testing.assert_allclose((b["stiffness"] * pressed**1.5 * along).sum(0), printed, rtol=0, atol=1e-6 * abs(force[1]).max())
                # A spring across the joint keeps the matrix regular, and is taken off the force.
                load += (3e7 * np.array([x_r - x_s, y_r - y_s]) - force).T @ d.T
            shown += [(2 + middle, table["x_r_out"]), (3 + middle, table["y_r_out"])]
            places, motions = [dof for dof, _ in shown], np.array([column for _, column in shown]).T
            found, load = (np.fft.rfft(a, axis=0) / samples for a in (motions, load))
            held = k + 3e7 * sum(csc_matrix(d @ d.T) for d, _ in joints)
            answer = [spsolve((held - (h * w)**2 * m + 1j * h * w * (c + w * g)).tocsc(), load[h]) for h in range(harmonics + 1)]
            np.testing.assert_allclose(np.array(answer)[:, places], found[:harmonics + 1], rtol=0, atol=1e-6 * abs(motions).max())
            yield run, table, np.array(answer)

    def test_commands(self):
        """Columns of several bearings; the branch passes through the orbit; the time method settles on the same motion;
        bearings whose balls pass at different rates are for time methods."""
        text = self.shaft(4, [(0, BEARING), (4, OTHER)], 0)[0]
        own = self.file("shaft.toml", text)
        speed = ["--frequency", 60, "--points", 100]
        orbit = self.table("orbit", own, *speed, "--harmonics", 32)
        settled = self.table("orbit", own, *speed, "--method", "gauss", "--longest", 1)
        for name in ["x_s", "y_r", "F_y", "F_y_2", "x_r_2", "y_r_out"]:
            self.assertLess(errors(orbit[name], settled[name])[1], 0.03, name)
        contact = self.table("contact", own, *speed, "--harmonics", 20)
        self.assertEqual(set(contact["bearing"]), {1, 2})
        self.assertEqual(len(contact["Q"]), 200 * (8 + 10))
        branch = self.table("response", own, "--from", 60, "--to", 61, "--harmonics", 20)
        for name in NAMES:
            self.assertAlmostEqual(branch[f"amp_{name}"][0], np.ptp(orbit[name]) / 2, delta=1e-3 * np.ptp(orbit[name]))
        logged = subprocess.run([EXPLORE, "response", own, "--from", "60", "--to", "61", "--harmonics", "6", "--times"],
                                check=True, capture_output=True, encoding="utf-8").stderr
        self.assertRegex(logged, r"^cpu_machine_s: \d+\.\d+\ncpu_branch_s: \d+\.\d+\n$")
        lines = self.table("spectrum", own, "--frequency", 60, "--harmonics", 20)
        self.assertEqual(lines["name"][0], "1X")
        other = self.file("other.toml", text.replace("cage_speed_ratio = 0.3\n", "cage_speed_ratio = 0.4\n"))
        self.refused("harmonic balance takes one number", "orbit", other, *speed, "--method", "aft")
        self.lines("orbit", other, *speed, "--method", "gauss", "--longest", 0.2)

    def test_resumed_with_other_matrices(self):
        """Would catch rows of two machines in one map."""
        own = self.file("own.toml", self.paper_machine())
        words = ["map", own, "--x", "frequency=40:45:2", "--quantity", "amplitude", "--harmonics", 6]
        whole = "\n".join(self.lines(*words)) + "\n"
        part = self.file("part.tsv", whole[:whole.rindex("\n4")])
        self.assertEqual("\n".join(self.lines(*words, "--resume", part)) + "\n", whole)
        for file in self.folder.glob("*/C.mtx"):
            file.write_text(re.sub(r"(?m)^1 1 .*", "1 1 77.0", file.read_text(encoding="utf-8")), encoding="utf-8")
        self.refused("other settings", *words, "--resume", part)

    def test_map_and_attractors(self):
        """The machine of a point, its start from the point before and its verdict are those of orbit; a settled motion is
        the same one, and its exponent the logarithm of the multiplier."""
        text = self.shaft(4, [(4, BEARING)], 4e6)[0].replace("[[bearing]]", "[bearing]").replace("stator_dofs = [1, 2]\n", "")
        text = text.replace("rotor_dofs = [17, 18]\n", "").replace("cage_phase_rad = 0\n", "")
        own = self.file("shaft.toml", text.replace("output_dofs", "bearing_dofs = [17, 18]\noutput_dofs"))
        found = self.table("map", own, "--x", "frequency=40:50:2", "--y", "bearing.radial_clearance_m=1e-5:1.2e-5:2",
                           "--quantity", "amplitude,multiplier", "--harmonics", 20)
        self.assertEqual(list(found["status"]), ["ok"] * 4)
        wide = self.file("wide.toml", own.read_text(encoding="utf-8").replace("1e-05", "1.2e-05"))
        for row, (machine, speed) in enumerate([(own, 40), (own, 50), (wide, 40), (wide, 50)]):
            orbit = self.table("orbit", machine, "--frequency", speed, "--harmonics", 20)
            self.assertAlmostEqual(np.ptp(orbit["x_r"]) / 2, found["amplitude"][row], delta=1e-3 * found["amplitude"][row])
            self.assertAlmostEqual(orbit.value("multiplier"), found["multiplier"][row], delta=1e-3)
        settled = self.table("attractors", own, "--from", 40, "--to", 50, "--count", 2)
        self.assertEqual(list(settled["period"]), [1, 1])
        for row in [0, 1]:
            self.assertAlmostEqual(settled["amp_x_r"][row], found["amplitude"][row], delta=0.03 * found["amplitude"][row])
            self.assertAlmostEqual(settled["lyapunov"][row], np.log(found["multiplier"][row]), delta=2e-3)
        self.refused("series knows no bodies given by matrices", "map", own, "--x", "frequency=40:50:2", "--quantity", "series",
                     "--harmonics", 6)
        self.refused("or gauss", "map", own, "--x", "frequency=40:50:2", "--quantity", "amplitude", "--method", "rk4")

    def test_two_frequencies(self):
        """A shaft's contacts vibrate at high multiples of the passing balls: without those above 16 no solution is found. The lines
        of the solution, which integration confirms, are those of the integrated motion."""
        run = ["spectrum", Path("data/rotors/two_disks.toml").resolve(), "--frequency", 45]
        found = self.table(*run, "--method", "aft", "--tolerance", 2e-3)
        self.assertEqual((found.value("regime"), found.value("stability")), ("quasi-periodic", "stable"))
        settled = self.table(*run, "--method", "gauss", "--longest", 3, "--local-error", 1e-6)
        for name in ["BPFO", "1X", "2BPFO", "4BPFO", "BPFO+1X", "9BPFO-1X"]:
            one, other = [t["x_r"][t["name"] == name][0] for t in [found, settled]]
            self.assertAlmostEqual(one, other, delta=0.02 * other, msg=name)

    def test_accelerations_of_the_quickest_mode(self):
        """The shaft's end at the bearing vibrates on its contact at 3 kHz, far above what its whole mass would: accelerations
        are those of sixteen times as many instants. They were up to a half of the largest wrong."""
        self.file("shaft.toml", STEEL + segment(3, 0.935, 0.0325) + disk(2, 0.2136, 0.0325, 0.0412) + disk(3, 0.1695, 0.0325, 0.0277)
                  + "[damping]\nover_mass_1_per_s = 46.7\nover_stiffness_s = 1.66e-5\n")
        self.lines("shaft", "shaft.toml", "--to", "shaft")
        bearing = {"balls": 8, "contact_stiffness_N_per_m1p5": 7e9, "radial_clearance_m": 1.2e-5, "cage_speed_ratio": 0.398, "contact_damping_s_per_m": 0.06}
        own = self.file("own.toml", 'title = "a shaft on two bearings"\n' + table("stator", mass_kg=34, natural_frequency_Hz=170, damping_ratio=0.08)
                        + table("rotor", matrices="shaft", vertical_dofs=[2, 6, 10, 14]) + "unbalance = [{ dofs = [5, 6], moment_kg_m = 4e-4, "
                        "phase_rad = 0.3 }, { dofs = [9, 10], moment_kg_m = 3e-4, phase_rad = -1.3 }]\n" + table("[bearing]", rotor_dofs=[1, 2], **bearing)
                        + table("[bearing]", rotor_dofs=[13, 14], **bearing) + table("bearing.parallel", cubic_stiffness_N_per_m3=1e15,
                        damping_N_s_per_m=[200, 30, -30, 200]) + table("gravity", acceleration_m_per_s2=GRAVITY))
        few, many = (self.table("orbit", own, "--frequency", 21.5, "--points", points, "--columns", "t,a_y_r,a_y_r_2")
                     for points in (128, 2048))
        for name in ("a_y_r", "a_y_r_2"):
            self.assertLess(abs(few[name] - many[name][::16]).max(), 5e-3 * abs(many[name]).max())

    def test_printed_error_of_an_integrated_motion(self):
        """Half the step is half the step: an error between two runs of equal steps was 5e-18."""
        run = ["orbit", Path("data/rotors/two_disks.toml").resolve(), "--frequency", 45]
        usual, exact = self.table(*run), self.table(*run, "--method", "gauss", "--local-error", 1e-11)
        self.assertGreater(usual.value("error_rms"), 1e-9)
        for name in NAMES[2:]:
            self.assertLess(errors(usual[name], exact[name])[1], usual.value("error_rms"))

    def test_one_bearing(self):
        """A wrong G, phase, output or cage angle would show."""
        list(self.answers(4, [(4, {**BEARING, "phase": 0.3, "clearance": 2e-5})], 4e6, [18, 30, 42, 55, 70, 95]))

    def test_two_bearings(self):
        """Two unlike bearings carry the shaft alone: a force at the wrong one would show."""
        list(self.answers(4, [(0, {**BEARING, "phase": 0.3}), (4, OTHER)], 0, [18, 30, 42, 55, 70, 95]))

    def test_a_tolerance_is_kept(self):
        """Against the motion on which the stepper settles: an error that is not seen at the bearing would show."""
        for bearings, spring, speeds in [([(4, {**BEARING, "phase": 0.3, "clearance": 2e-5})], 4e6, [30, 70]), ([(0, BEARING), (4, OTHER)], 0, [70, 30])]:
            own = self.file("shaft.toml", self.shaft(4, bearings, spring)[0])
            for speed in some(speeds, 2):
                ask = ["orbit", own, "--frequency", speed, "--points", 100, "--columns", "all"]
                found = self.table(*ask, "--method", "aft", "--tolerance", 1e-3)
                exact = self.table(*ask, "--method", "gauss", "--local-error", 1e-8, "--longest", 2)
                self.assertEqual(found.value("stability"), "stable")
                for name in [*NAMES, "x_r_out", "y_r_out"]:
                    self.assertLess(errors(found[name], exact[name])[1], 2e-3, (speed, name))

    def test_reduced_against_all(self):
        """1,004 degrees of freedom. A basis that lacks a shape, or a reduced G of the other sign, would show; so would an error
        that the header hides, and a row of the basis at another node: a table of shapes is the same answer at all nodes."""
        elements = 250
        nodes, dofs = self.nodes(elements, 2)
        for run, table, answer in self.answers(elements, [(elements, {**BEARING, "phase": 0.3})], 4e6, [15, 30, 45, 60, 95]):
            self.assertTrue(10 < table.value("degrees_of_freedom") < 102)
            self.assertTrue(0 < table.value("reduction_error") < 1e-8)
            if table.value("frequency") != 45:
                continue
            shape = self.table("shape", *run, "--nodes", nodes)
            places = np.array([shape["x"], shape["y"]]).reshape(2, -1, 256).transpose(2, 1, 0).reshape(256, -1)
            found, size = np.fft.rfft(places, axis=0)[:21] / 256, abs(places).max()
            np.testing.assert_allclose(answer[:, 2 + np.array(dofs)], found, rtol=0, atol=1e-6 * size)
            self.file("coarse.toml", self.shaft(10, [(10, {**BEARING, "phase": 0.3})], 4e6, "coarse")[0])
            rough = self.table("shape", "coarse.toml", *run[1:], "--nodes", self.nodes(10, 2)[0])
            self.assertEqual((rough.value("reduction_error"), rough.value("degrees_of_freedom")), (0, 46))
            for node in [0, 2, 4, 6, 8, 10]:
                for axis in "xy":
                    np.testing.assert_allclose(rough.where("node", node + 1)[axis], shape.where("node", 25 * node + 1)[axis], rtol=0,
                                               atol=1e-3 * size)

    def test_check(self):
        """The rest of the paper's machine is the same by matrices. Two bearings carry a shaft by the lever rule, and its frequencies
        are those of all its matrices with the stiffness that campbell prints."""
        own, paper = self.values(self.file("own.toml", self.paper_machine())), self.values(self.machine)
        for name in ["BPFO", "BPFI", "static_force", "static_y", "loaded_balls", "ball_load"]:
            self.assertAlmostEqual(own[name] / paper[name], 1, delta=1e-6, msg=name)
        text, whole, joints, weight, *_ = self.shaft(8, [(2, BEARING), (8, OTHER)], 0)
        machine = self.file("shaft.toml", text)
        values = self.values(machine)
        load, place = -weight[3::4], np.arange(9) / 8
        share = (load * (place - 0.25)).sum() / 0.75
        self.assertAlmostEqual(values["static_force_2"] / share, 1, delta=1e-3)
        self.assertAlmostEqual(values["static_force"] / (load.sum() - share), 1, delta=1e-3)
        self.assertEqual((values["BPFO"], values["BPFO_2"]), (3, 3))
        m, c, _, k = whole
        bearings = self.table("campbell", machine, "--from", 1, "--to", 2, "--count", 2).members("bearing")
        self.assertEqual(len(bearings), 2)
        for (_, xx, xy, yy), (d, _) in zip(bearings, joints):
            k = k + d @ np.array([[xx, xy], [xy, yy]]) @ d.T
        n = len(m)
        values_of_all = np.linalg.eigvals(np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(m, k), -np.linalg.solve(m, c)]]))
        exact = np.sort(values_of_all.imag[values_of_all.imag > 1e-6])[:8] / (2 * np.pi)
        np.testing.assert_allclose([values[f"f_{i}"] for i in range(1, 9)], exact, rtol=1e-4)

    def test_campbell_at_one_speed(self):
        """The rows of that speed; nothing that needs two; and what the budget does not pay for."""
        machine = Path("data/rotors/overhung.toml").resolve()
        one, two, usual = (self.table("campbell", machine, "--from", 30, "--to", to, *count)
                           for to, count in ((30, []), (31, ["--count", 2]), (80, [])))
        self.assertTrue(len(one) > 2 and set(one["f"]) == {30})
        np.testing.assert_array_equal(np.unique(usual["f"]), np.linspace(30, 80, 51))
        np.testing.assert_array_equal(one["frequency"], two.where("f", 30)["frequency"])
        for more in (["--to", 31], ["--to", 30, "--critical"], ["--to", 30, "--plot", "a.svg"]):
            self.refused("--count 1: is for --from equal to --to", "campbell", machine, "--from", 30, "--count", 1, *more)
        result = self.run_explore("campbell", machine, "--from", 0, "--to", 100, "--count", 10000, "--budget", 1e7)
        part = Table.of(result.stdout)
        self.assertEqual((result.returncode, part.value("complete")), (3, "no"))
        self.assertIn("the budget of 1e+07 evaluations of the force is used up; more with --budget", result.stderr)
        self.assertTrue(0 < len(np.unique(part["f"])) < 10000)

    @unittest.skipUnless(FULL, "of make test-all: it measures a time")
    def test_a_body_of_very_many_pieces(self):
        """Unconnected degrees of freedom are put in order, and looked at, in a time that grows as their number does: 300,000
        of them took 16 s."""
        (self.folder / "pieces").mkdir()
        for name, value in (("M", 1), ("C", 10), ("G", 0), ("K", 1e6)):
            rows = "".join(f"{k} {k} {value}\n" for k in range(1, 300001))
            self.file(f"pieces/{name}.mtx", f"%%MatrixMarket matrix coordinate real general\n300000 300000 300000\n{rows}")
        text = Path("data/rotors/overhung.toml").read_text(encoding="utf-8").replace('"overhung"', '"pieces"')
        began = time.process_time() + sum(os.times()[2:4])
        self.table("check", self.file("pieces.toml", text))
        self.assertLess(time.process_time() + sum(os.times()[2:4]) - began, 80 if SANITIZED else 8)

    def nodes(self, elements, every=1):
        """The table of a shaft's nodes, and the degrees of freedom of x and y from 0."""
        picked = range(0, elements + 1, every)
        rows = [f"{node + 1}\t{0.8 * node / elements!r}\t{4 * node + 1}\t{4 * node + 2}\n" for node in picked]
        own = self.file("nodes.tsv", "node\tz\tx\ty\n" + "".join(rows))
        return own, [4 * node + axis for node in picked for axis in [0, 1]]

    def test_shape_against_orbit(self):
        """By every method, at both bearings and the output: a coordinate at another place, or a motion that is not that of
        orbit, would show."""
        text = self.shaft(4, [(1, BEARING), (4, {**OTHER, "balls": 8, "cage": 0.375})], 4e6)[0]
        own, nodes = self.file("shaft.toml", text), self.nodes(4)[0]
        slow = self.file("slow.toml", text.replace("ratio = 0.375", "ratio = 0.4375"))  # repeats itself after two turns
        torus = text.replace("ratio = 0.375", "ratio = 0.3815966")
        still = self.file("still.toml", torus.replace("kg_m = 2e-3", "kg_m = 0").replace("kg_m = 3e-4", "kg_m = 0"))
        torus = self.file("torus.toml", torus)
        for machine, options in [
                (own, ["--harmonics", 20]), (own, ["--method", "aft", "--tolerance", 1e-3]),
                (own, ["--method", "shooting", "--local-error", 1e-6]), (own, ["--method", "gauss", "--local-error", 1e-4, "--longest", 0.05, "--periods", 3]),
                (slow, ["--harmonics", 4]), (still, ["--harmonics", 8, "--periods", 2]),
                (torus, ["--harmonics", 5, "--periods", 3])]:
            with self.subTest(machine=machine.name, options=options):
                run = [machine, "--frequency", 60, "--points", 32, "--no-stability", *options]
                if "gauss" in options:
                    run.remove("--no-stability")
                orbit = self.table("orbit", *run, "--columns", "all")
                shape = self.table("shape", *run, "--nodes", nodes, "--columns", "all")
                self.assertEqual(len(shape), 5 * len(orbit))
                self.assertEqual(shape.members("bearing"), [[1, 2, 0.2], [2, 5, 0.8]])
                size = max(abs(shape[axis]).max() for axis in "xy")
                for node, tail in [(2, ""), (5, "_2"), (3, "_out")]:
                    at = shape.where("node", node)
                    for name in ["phase", "t"]:
                        np.testing.assert_array_equal(at[name], orbit[name])
                    for axis in "xy":
                        np.testing.assert_allclose(at[axis], orbit[f"{axis}_r{tail}"], rtol=0, atol=1e-12 * size)
        run = [self.file("own.toml", self.paper_machine()), "--frequency", 20, "--points", 16, "--method", "aft", "--subharmonic", 2, "--no-stability"]
        shape = self.table("shape", *run, "--nodes", self.file("one.tsv", "z\tx\ty\n0\t1\t2\n"))
        self.same({f"{axis}_r": shape[axis] for axis in "xy"}, self.table("orbit", *run), 1e-12, NAMES[2:])

    def test_shape_refused(self):
        own = self.file("shaft.toml", self.shaft(4, [(4, BEARING)], 4e6)[0])
        run = BRIEF
        for text, words in [
                ("", "not a table"), ("z\tx\ty\n", "rows"), ("x\ty\n1\t2\n", "no column z"), ("z\ty\n1\t2\n", "no column x"),
                ("z\tx\ty\n0\t1\t2\n0\t1\t1\n", "nodes.tsv:3: x and y"), ("z\tx\ty\n0\t1\t21\n", "nodes.tsv:2: y must be"),
                ("z\tx\ty\n0\t0\t2\n", "1...20"), ("z\tx\ty\n0\t1.5\t2\n", "1...20"), ("z\tx\ty\nnan\t1\t2\n", "nodes.tsv:2: 'nan'"),
                ("z\tx\ty\n-\t1\t2\n", "finite"), ("z\tx\ty\n0\t1\n", "2 cells")]:
            self.refused(words, "shape", own, *run, "--nodes", self.file("nodes.tsv", text))
        nodes = self.nodes(4)[0]
        self.refused("--nodes", "shape", own, *run)
        self.refused("nowhere.tsv", "shape", own, *run, "--nodes", "nowhere.tsv")
        self.refused("rotor.matrices is missing", "shape", self.machine, *run, "--nodes", nodes)
        self.refused("gauss", "shape", own, *run[:2], "--nodes", nodes, "--method", "rk4")
        self.refused("rows", "shape", own, "--frequency", 45, "--nodes", nodes, "--points", 65536, "--method", "aft", "--subharmonic", 4)
        plain = self.table("shape", own, *run, "--nodes", self.file("plain.tsv", "z\tx\ty\n0.5\t5\t6\n0.1\t17\t18\n"))
        self.assertEqual(list(plain["node"]), [1] * 4 + [2] * 4)
        self.assertEqual(plain.members("bearing"), [[1, 2, 0.1]])
        for suffix in ["svg", "png"]:
            self.lines("shape", own, *run, "--nodes", nodes, "--plot", f"shape.{suffix}")
            self.assertGreater((self.folder / f"shape.{suffix}").stat().st_size, 1000)

    def test_reduced_body_that_nothing_holds(self):
        """One bearing and no spring leave the shaft free to tilt; a degree of freedom that no force reaches, as torsion may
        be, is free to drift."""
        own = self.file("shaft.toml", self.shaft(60, [(60, BEARING)], 0)[0])
        self.refused("K is singular", "orbit", own, "--frequency", 30)
        own = self.file("shaft.toml", self.shaft(60, [(60, BEARING)], 4e6)[0])
        stiffness = self.folder / "shaft/K.mtx"
        lines = stiffness.read_text(encoding="utf-8").splitlines()
        kept = [line for line in lines[3:] if "101" not in line.split()[:2]]
        self.file("shaft/K.mtx", "\n".join([*lines[:2], f"244 244 {len(kept)}", *kept, ""]))
        self.refused("degree of freedom 101 (torsion", "orbit", own, "--frequency", 30)
