"""explore map: the same bytes whatever the number of threads, of runs and of interruptions; rows against single
points of the other commands; what it refuses, and what stands in the row of a point without a result.
"""
import re

import numpy as np

from tests.truth.independent import displacements, errors
from tests.support.explore import MACHINE, SIX, Case, Table, changed, with_table

CLEARANCE = "bearing.radial_clearance_m"
GRID = [*SIX, "--x", "frequency=20:50:5", "--y", f"{CLEARANCE}=0:1e-4:7", "--quantity", "amplitude,contact_share"]


def rows(text):
    """The rows below the names, with their ends."""
    lines = [line for line in text.splitlines(keepends=True) if not line.startswith("#")]
    return "".join(lines[1:])


class Bytes(Case):
    """The table does not know how it came to be."""

    def map(self, *options):
        result = self.run_explore("map", self.machine, *GRID, *options)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout

    def test_threads_and_shards(self):
        """Would catch a line that starts from another one, rows out of order, and a header that tells of the run."""
        whole = self.map("--threads", 1)
        self.assertEqual(self.map("--threads", 2), whole)
        for shards in (1, 3, 7):
            edges = [7 * k // shards for k in range(shards + 1)]
            parts = [self.map("--lines", f"{a}:{b}", "--threads", 2) for a, b in zip(edges, edges[1:])]
            head = whole[:len(whole) - len(rows(whole))]
            self.assertTrue(all(part.startswith(head) for part in parts))
            self.assertEqual("".join(map(rows, parts)), rows(whole))

    def test_cut_off_and_resumed(self):
        """At ten places: within the header, a row, between rows, and after whole lines. Would catch a row twice, a row
        left out, and a line of x that goes on in its middle without the solution before."""
        whole = self.map()
        for k in range(10):
            cut = len(whole) * (2 * k + 1) // 20
            part = self.file("part.tsv", whole[:cut])
            self.assertEqual(self.map("--resume", part), whole, cut)
        self.assertEqual(self.map("--resume", self.file("whole.tsv", whole)), whole)

    def test_one_line_of_points_that_need_no_other(self):
        """Motions from rest are written, and taken over, in parts of a line. Would catch a map that has nothing before its end."""
        asked = ["map", self.machine, "--x", "frequency=40:41:130", "--quantity", "regime"]
        whole = self.run_explore(*asked, "--threads", 1).stdout
        self.assertEqual(self.run_explore(*asked, "--threads", 3).stdout, whole)
        names = whole.splitlines(keepends=True)
        first = next(k for k, line in enumerate(names) if line.startswith("40\t"))
        for kept, taken in ((63, 0), (64, 64), (129, 128), (130, 130)):
            part = [*names[:first], *(line.replace("\tperiodic\t", "\tchaotic\t") for line in names[first:first + kept])]
            found = self.run_explore(*asked, "--resume", self.file("part.tsv", "".join(part))).stdout.splitlines(keepends=True)
            self.assertEqual(sum("\tchaotic\t" in line for line in found), taken)
            self.assertEqual([line.replace("\tchaotic\t", "\tperiodic\t") for line in found], names)

    def test_rotten_rows_are_refused(self):
        """Cells that are no values, too many or too few of them, a status that does not fit. Would catch a row that is taken
        over as it stands; nothing is written before all rows were looked at."""
        whole = self.map()
        row = rows(whole).splitlines()[7]
        cells = row.split("\t")
        for words, rotten in [("'nan' is no value of amplitude", [*cells[:2], "nan", *cells[3:]]),
                              ("'hello' is no value of amplitude", [*cells[:2], "hello", *cells[3:]]),
                              ("'1e-05x' is no value of amplitude", [*cells[:2], "1e-05x", *cells[3:]]),
                              ("a row of 6 cells", [*cells, "ok"]), ("a row of 4 cells", [*cells[:3], "ok"]),
                              ("holds other points", ["hello", *cells[1:]]),
                              ("status of a row", [*cells[:2], "-", *cells[3:]]), ("status of a row", [*cells[:4], "why not"])]:
            part = self.file("part.tsv", whole.replace(row, "\t".join(rotten)))
            self.refused(words, "map", self.machine, *GRID, "--resume", part)


class Values(Case):
    """Rows against the commands for one point."""

    def test_against_orbits(self):
        """Amplitude, mean, contact, forces and verdict of three rows, from the table of `orbit` at the same machine.
        Would catch a key that changes another value, and a quantity of another column."""
        names = "amplitude,mean,contact_share,ball_load,force,stability,multiplier"
        table = self.table("map", self.machine, "--x", "rotor.mass_kg=40:50:2", "--y", f"{CLEARANCE}=2e-5:4e-5:2", *SIX,
                           "--frequency", 45, "--quantity", names)
        self.assertEqual(list(table.columns), ["rotor.mass_kg", CLEARANCE, *names.split(","), "status"])
        for k in range(4):
            machine = self.file("one.toml", MACHINE.replace("mass_kg = 40.0", f"mass_kg = {table['rotor.mass_kg'][k]}")
                                .replace("2e-5", str(table[CLEARANCE][k])))
            orbit = self.table("orbit", machine, "--frequency", 45, "--points", 512, *SIX)
            contact = self.table("contact", machine, "--frequency", 45, "--points", 512, *SIX)
            force = np.hypot(orbit["F_x"], orbit["F_y"])
            for name, value in [("amplitude", np.ptp(orbit["x_r"]) / 2), ("mean", orbit["y_r"].mean()),
                                ("contact_share", (force > 0).mean()), ("force", force.max()),
                                ("ball_load", contact["Q"].max())]:
                self.assertAlmostEqual(table[name][k] / value, 1, delta=1e-4, msg=name)
            self.assertEqual(orbit.value("stability"), table["stability"][k])
            self.assertAlmostEqual(table["multiplier"][k], orbit.value("multiplier"), delta=1e-5)

    def test_time_method(self):
        """At 45 Hz, where 32 harmonics of a base period are exact, rk4 gives the same numbers: with 7, 7.25 and 7.5 balls a turn and, without
        unbalance, over a ball's passing. Would catch a balance over one turn."""
        balanced = self.file("balanced.toml", MACHINE.replace("unbalance_kg_m = 0.05", "unbalance_kg_m = 0.0"))
        for machine in self.machine, balanced:
            over = ["map", machine, "--frequency", 45, "--quantity", "amplitude,mean,contact_share,ball_load",
                    "--y", "bearing.cage_speed_ratio=0.4375:0.46875:3"]
            balance, time_method = (self.table(*over, *how) for how in (["--harmonics", 32], ["--method", "rk4"]))
            self.assertEqual(set(balance["status"]), {"ok"})
            for name, most in (("amplitude", 1e-3), ("mean", 1e-5), ("contact_share", 0), ("ball_load", 0.02)):
                np.testing.assert_allclose(time_method[name], balance[name], rtol=most, err_msg=name)

    def test_a_tolerance_takes_longer_steps(self):
        """Response, map and attractors at the same speeds: within the tolerance of the motions without one, for fewer evaluations.
        Would catch a tolerance that nothing reads, and steps that are too long for it: with four times the step the
        doubled motion at 54 Hz is damped into the unstable one of a single turn."""
        speeds, range_of = "frequency=42:58:5", ["--from", 42, "--to", 58, "--count", 5]
        exact = self.table("response", self.machine, *range_of)
        self.assertTrue((exact["period"] > 0).all())
        for tolerance, least in ((1e-3, 1.8), (1e-5, 1.5)):
            fast = self.table("response", self.machine, *range_of, "--tolerance", tolerance)
            self.assertGreater(exact.value("evaluations") / fast.value("evaluations"), least)
            self.assertTrue((fast["amp_x_r"] != exact["amp_x_r"]).any())
            amplitudes = [fast["amp_x_r"], self.table("map", self.machine, "--x", speeds, "--quantity", "amplitude",
                                                      "--tolerance", tolerance)["amplitude"],
                          self.table("attractors", self.machine, *range_of, "--starts", 0, "--tolerance", tolerance)["amp_x_r"]]
            np.testing.assert_array_equal(fast["period"], exact["period"])
            for found in amplitudes:
                np.testing.assert_allclose(found, exact["amp_x_r"], rtol=tolerance)

    def test_chosen_harmonics_and_error(self):
        table = self.table("map", self.machine, "--y", "frequency=30:45:2", "--method", "aft", "--tolerance", 1e-3,
                           "--quantity", "harmonics,error")
        for k in range(2):
            orbit = self.table("orbit", self.machine, "--frequency", table["frequency"][k], "--method", "aft", "--tolerance", 1e-3)
            self.assertEqual(orbit.value("harmonics"), table["harmonics"][k])
            self.assertAlmostEqual(table["error"][k] / orbit.value("error_rms"), 1, delta=0.01)
            self.assertLess(orbit.error("error"), 1e-3)
        wide = self.file("wide.toml", changed(radial_clearance_m=1))  # where nothing touches
        few, many, six = (self.table("orbit", machine, "--frequency", 30, "--method", "aft", "--tolerance", tolerance).value("harmonics")
                          for machine, tolerance in ((self.machine, 1e-2), (self.machine, 1e-5), (wide, 1e-8)))
        self.assertGreater(many, few)
        self.assertEqual(six, 6)

    def test_multipliers_of_the_harmonics(self):
        """With 64 harmonics at 45 Hz the series is the machine; the distance is that of `orbit`. At 20 Hz the
        series of six harmonics is stable, and the machine is not. Would catch multipliers of another motion."""
        table = self.table("map", self.machine, "--y", "frequency=20:45:2", "--harmonics", 6, "--quantity",
                           "stability,series_stability,distance,evaluations")
        self.assertEqual((table["stability"][0], table["series_stability"][0]), ("unstable", "stable"))
        orbit = self.table("orbit", self.machine, "--frequency", 45, "--harmonics", 6)
        self.assertAlmostEqual(table["distance"][1] / orbit.value("distance_rms"), 1, delta=0.01)
        self.assertAlmostEqual(orbit.value("verdict_evaluations") / table["evaluations"][1], 1, delta=6e-3)
        table = self.table("map", self.machine, "--y", "frequency=45:45:1", "--harmonics", 64, "--quantity",
                           "multiplier,uncertainty,series,series_uncertainty")
        self.assertAlmostEqual(table["series"][0], table["multiplier"][0], delta=2e-4)
        self.assertTrue((0 < table["uncertainty"] < 1e-4) and (0 < table["series_uncertainty"] < 1e-5))
        fine = self.table("map", self.machine, "--y", "frequency=30:45:2", "--harmonics", 256, "--quantity", "multiplier,series")
        np.testing.assert_allclose(fine["series"], fine["multiplier"], rtol=1e-4)

    def test_error_where_nothing_closes(self):
        """A stiff loose bearing at 30 Hz, whose contact vibrates without a period: the error of six harmonics is their
        distance from what the machine does, here over forty turns of another method from rest (means over forty scatter by 5 %).
        Would catch an error against a motion that has not settled, and one that is left out."""
        machine = self.file("loose.toml", changed(contact_stiffness_N_per_m1p5=1e12, radial_clearance_m=8.333333e-5))
        table = self.table("map", machine, "--y", "frequency=30:30:1", "--harmonics", 6, "--quantity", "error")
        six = self.table("orbit", machine, "--frequency", 30, *SIX, "--no-stability", "--points", 256)
        long = self.table("orbit", machine, "--frequency", 30, "--method", "rk8pd", "--periods", 40, "--points", 256)
        self.assertEqual(long.value("regime"), "chaotic")
        off = errors(np.tile(displacements(six), (40, 1)), displacements(long))[1]
        self.assertAlmostEqual(table["error"] / off, 1, delta=0.2)

    def test_period_against_attractors(self):
        """At 20 Hz two turns, at 30 Hz one."""
        table = self.table("map", self.machine, "--y", "frequency=20:30:2", "--quantity", "period,lyapunov")
        self.assertEqual(list(table["period"]), [2, 1])
        self.assertEqual(table.value("method"), "auto")
        balanced = self.table("map", self.machine, "--y", "frequency=30:30:1", *SIX, "--quantity", "period,amplitude")
        self.assertEqual((balanced.value("method"), balanced.value("harmonics")), ("aft", 6))
        for k, frequency in enumerate((20, 30)):
            known = self.table("attractors", self.machine, "--from", frequency, "--to", frequency, "--count", 1,
                               "--starts", 0)
            self.assertAlmostEqual(table["lyapunov"][k], known["lyapunov"][0], delta=1e-9)

    def test_same_word_as_in_a_response(self):
        """Largest forces and shares of contact of a motion that never repeats itself, of 256 base periods in both. Would catch two windows."""
        names = ["contact_share", "ball_load"]
        response = self.table("response", self.machine, "--from", 13, "--to", 14, "--count", 2, "--columns", ",".join(["f", "period", *names]))
        table = self.table("map", self.machine, "--x", "frequency=13:14:2", "--quantity", ",".join(["period", *names]))
        self.assertEqual(list(table["period"]), list(response["period"]))
        self.assertLess(table["period"].min(), 1)
        for name in names:
            self.assertEqual(list(table[name]), list(response[name]))

    def test_contact_is_lost_at_the_speed_of_the_closed_form(self):
        """13.155 Hz (f_loss of Table 1), which knows nothing of clearance and Hertz's law. The narrower the clearance, the narrower is the
        band around it; below it gravity holds the force, above it the force turns with the rotor. Would catch a wrong ratio of the joint's
        forces: 3 % in speed is 7 % in the unbalance."""
        points = [(0.97, 2e-5), (1.03, 2e-5), (1, 1e-6), (0.97, 1e-6), (1.03, 1e-6)]
        listed = self.file("points.csv", f"frequency,{CLEARANCE}\n" + "".join(f"{share * 13.155},{clearance}\n" for share, clearance in points))
        table = self.table("map", self.machine, "--list", listed, "--quantity", "contact_share")
        self.assertEqual([share == 1 for share in table["contact_share"]], [False, False, False, True, True])
        narrow = self.file("narrow.toml", changed(radial_clearance_m=1e-6))
        for share, turns in ((0.97, 0), (1.03, 1)):
            orbit = self.table("orbit", narrow, "--frequency", share * 13.155, "--points", 2048)
            angle = np.unwrap(np.arctan2(orbit["F_y"], orbit["F_x"]))
            self.assertAlmostEqual((angle[-1] - angle[0]) / (2 * np.pi), turns, delta=0.1)

    def test_diametral_clearance_and_class(self):
        """A key drops the other ways to give its value: half of one is the other."""
        named = self.file("named.toml", with_table('[bearing]\ndesignation = "6205"\ninternal_clearance = "C3"'))
        values = [self.table("map", named, "--frequency", 45, "--quantity", "amplitude", "--y", f"bearing.{key}:2")["amplitude"]
                  for key in ("diametral_clearance_um=16:24", "radial_clearance_um=8:12")]
        np.testing.assert_allclose(*values, rtol=1e-6)
        self.assertGreater(np.ptp(values[0]), 1e-7)

    def test_peak_against_response(self):
        """Of the finest response, and its place; by a sweep of 101 speeds. In permanent contact above 20 Hz."""
        table = self.table("map", self.machine, "--y", f"{CLEARANCE}=1e-5:2e-5:2", *SIX,
                           "--sweep", "40:60", "--quantity", "peak,peak_frequency,permanent")
        branch = self.table("response", self.machine, "--from", 40, "--to", 60, *SIX)
        top = branch["amp_x_r"].argmax()
        self.assertAlmostEqual(table["peak"][1] / branch["amp_x_r"][top], 1, delta=2e-3)
        self.assertAlmostEqual(table["peak_frequency"][1], branch["f"][top], delta=0.2)
        self.assertEqual(table["permanent"][1], 1)

    def test_multipliers_along_the_harmonics_know_the_speed(self):
        """Without contact the machine is linear: a seal by speed, and the multipliers of solution and motion are the same."""
        self.file("seal.csv", "f,k_xx,k_xy,k_yx,k_yy,c_xx,c_yy\n0,0,0,0,0,0,0\n100,1e6,4e5,-4e5,1e6,2000,2000\n")
        loose = changed(radial_clearance_m=1e-3, unbalance_kg_m=0.001) + "[bearing.parallel]\ncoefficients = 'seal.csv'\n"
        table = self.table("map", self.file("seal.toml", loose), "--x", "frequency=45:45:1", "--quantity", "multiplier,series", *SIX)
        self.assertAlmostEqual(table["series"][0], table["multiplier"][0], delta=1e-6)

    def test_list(self):
        """Rows of a table are points, or with --x lines: the same numbers as those of a grid."""
        points = self.file("points.csv", f"rotor.mass_kg, {CLEARANCE}\n40, 2e-05\n45 , 3e-05\n")
        some = self.table("map", self.machine, "--list", points, "--frequency", 45, *SIX, "--quantity", "amplitude")
        self.assertEqual(list(some["rotor.mass_kg"]), [40, 45])
        lines = self.table("map", self.machine, "--list", points, "--x", "frequency=45:50:3", *SIX, "--quantity", "amplitude")
        self.assertEqual(list(lines["frequency"]), [45, 47.5, 50] * 2)
        np.testing.assert_allclose(lines["amplitude"][::3], some["amplitude"], rtol=1e-12)

    def test_logarithmic(self):
        table = self.table("map", self.machine, "--x", "bearing.contact_stiffness_N_per_m1p5=1e9:1e12:4:log", *SIX,
                           "--frequency", 45, "--quantity", "amplitude")
        np.testing.assert_allclose(table["bearing.contact_stiffness_N_per_m1p5"], [1e9, 1e10, 1e11, 1e12], rtol=1e-14)

    def test_a_point_without_a_result(self):
        """6.88 balls pass in a turn, which never repeats itself within eight; the map goes on, and says how many."""
        result = self.run_explore("map", self.machine, "--y", "bearing.cage_speed_ratio=0.43:0.445:3", "--frequency", 45, *SIX,
                                  "--quantity", "amplitude")
        table = Table.of(result.stdout)
        self.assertEqual((result.returncode, result.stderr), (0, "2 of 3 points have no result: see their status\n"))
        self.assertEqual([cell == "-" for cell in table["amplitude"]], [True, False, True])
        self.assertIn("6.88 balls pass", table["status"][0])
        none = self.run_explore("map", self.machine, "--y", "bearing.cage_speed_ratio=0.43:0.431:2", "--frequency", 45, *SIX,
                                "--quantity", "amplitude")
        self.assertEqual((none.returncode, len(Table.of(none.stdout)["status"])), (3, 2))
        self.assertIn("2 of 2 points have no result", none.stderr)
        drawn = self.run_explore("map", self.machine, "--y", "bearing.cage_speed_ratio=0.43:0.431:2", "--x", "frequency=45:46:2", *SIX,
                                 "--quantity", "stability", "--plot", "none.svg")
        self.assertEqual((drawn.returncode, drawn.stderr.count("\n")), (3, 1), drawn.stderr)
        self.assertIn("</svg>", (self.folder / "none.svg").read_text(encoding="utf-8"))
        other = self.file("other.toml", MACHINE.replace("cage_speed_ratio = 0.5", "cage_speed_ratio = 0.43"))
        self.refused("a map has none where two frequencies drive", "map", other, "--x", "rotor.mass_kg=30:40:2", "--sweep", "20:60:9",
                     "--quantity", "peak")

    def test_each_point_keeps_its_budget(self):
        """A sweep of 100,000 speeds took more than a minute, the motion from rest with 1,024 balls hours."""
        many = self.file("many.toml", re.sub("balls = 16", "balls = 1024", MACHINE))
        for machine, asked in ((self.machine, "--quantity peak,missed --sweep 1:60:100000 --harmonics 256"),
                               (many, "--quantity period,lyapunov --frequency 13.4 --method rk4 --longest 1e5")):
            result = self.run_explore("map", machine, "--x", f"{CLEARANCE}=1e-5:2e-5:2", *asked.split(), "--budget", 1e5, timeout=20)
            self.assertEqual(result.returncode, 3, result.stderr)
            rows = Table.of(result.stdout)
            self.assertTrue(all("the budget of 1e+05 evaluations of the force is used up" in word for word in rows["status"]))
            self.assertTrue(all(str(cell) in ("-", "-2.0") for name in asked.split()[1].split(",") for cell in rows[name]))


class Refusals(Case):
    def refused_map(self, words, text):
        self.refused(words, "map", self.machine, *text.split())

    def test_axes_and_quantities(self):
        usual = "--frequency 45 --quantity amplitude"
        for words, text in [
                ("bearing.colour is not a known key here (known: ball_diameter_m, ball_radius_m, balls, ", f"--x bearing.colour=1:2:3 {usual}"),
                ("did you mean balls", f"--x bearing.bals=1:2:3 {usual}"),
                ("period is of the motion from rest; leave them out", "--frequency 45 --quantity period,regime --harmonics 6 --x rotor.mass_kg=30:40:2"),
                ("wind is not a known key", f"--x wind.speed=1:2:3 {usual}"),
                ("title must be a string", f"--x title=1:2:3 {usual}"),
                ("--x rotor.mass_kg=-1:1:3: ", f"--x rotor.mass_kg=-1:1:3 {usual}"),
                ("rotor.mass_kg must be > 0", f"--x rotor.mass_kg=-1:1:3 {usual}"),
                ("--y rotor.mass_g=0:1:3: ", f"--x {CLEARANCE}=0:1e-4:3 --y rotor.mass_g=0:1:3 {usual}"),
                (f"--y radial_clearance_m=0:1e-4:3: radial_clearance_m is not a known key here; did you mean {CLEARANCE}?",
                 f"--y radial_clearance_m=0:1e-4:3 {usual}"),
                ("did you mean rotor.mass_g or stator.mass_g?", f"--x mass_g=0:2:3 {usual}"),
                ("a speed is frequency=600rpm:6000rpm:5", "--x frequency_rpm=600:6000:5 --quantity amplitude"),
                ("must be in 1...10000000", f"--x {CLEARANCE}=0:1e-4:0 {usual}"),
                ("must be in 1...10000000", f"--x {CLEARANCE}=0:1e-4:10000001 {usual}"),
                ("log needs", f"--x {CLEARANCE}=0:1e-4:3:log {usual}"),
                ("log needs", f"--x {CLEARANCE}=-1:-2:3:log {usual}"),
                ("from and to must differ", f"--x {CLEARANCE}=1e-4:1e-4:3 {usual}"),
                ("must be KEY=from:to:count[:log]", f"--x {CLEARANCE}=0:1 {usual}"),
                ("must be KEY=from:to:count[:log]", f"--x {CLEARANCE}=0:1:2:lin {usual}"),
                ("must be KEY=from:to:count[:log]", f"--x {CLEARANCE} {usual}"),
                ("decimal", f"--x {CLEARANCE}=0:nan:3 {usual}"),
                ("--x: is missing", usual),
                ("is given twice", f"--x {CLEARANCE}=0:1e-4:3 --y {CLEARANCE}=0:1e-4:3 {usual}"),
                ("missed; measures such as contact_share, ball_load, force", f"--x {CLEARANCE}=0:1e-4:3 --frequency 45 --quantity colour"),
                ("is given twice", f"--x {CLEARANCE}=0:1e-4:3 --frequency 45 --quantity force,force"),
                ("a table takes one of them, not both", f"--x rotor.unbalance_g_mm=1:50:3 --y rotor.unbalance_kg_m=1e-6:1e-5:2 {usual}"),
                ("a table takes one of them, not both", f"--x rotor.stiffness_N_per_m=1e5:1e6:3 --y rotor.natural_frequency_Hz=10:20:2 {usual}"),
                ("--frequency: is missing", f"--x {CLEARANCE}=0:1e-4:3 --quantity amplitude"),
                ("--frequency: is a key", f"--x frequency=1:2:3 {usual}"),
                ("must be a positive speed in Hz", "--x frequency=0:2:3 --quantity amplitude"),
                ("--sweep: is missing", f"--x {CLEARANCE}=0:1e-4:3 --quantity peak"),
                ("--sweep: no quantity", f"--x {CLEARANCE}=0:1e-4:3 --sweep 1:2 {usual}"),
                ("A must be below B", f"--x {CLEARANCE}=0:1e-4:3 --sweep 2:1 --quantity peak"),
                ("those of --sweep", f"--x {CLEARANCE}=0:1e-4:3 --sweep 1:2 --frequency 45 --quantity peak"),
                ("is of harmonic balance", f"--x {CLEARANCE}=0:1e-4:3 --frequency 45 --method rk4 --quantity error"),
                ("for a motion in time", f"--x {CLEARANCE}=0:1e-4:3 --method aft --longest 3 {usual}"),
                ("error is of harmonic balance", f"--x {CLEARANCE}=0:1e-4:3 --frequency 45 --quantity error"),
                ("peak is of harmonic balance", f"--x {CLEARANCE}=0:1e-4:3 --sweep 1:2 --quantity peak"),
                ("--periods: not expected", f"--x {CLEARANCE}=0:1e-4:3 --method rk4 --periods 2 {usual}"),
                ("--tolerance: chooses the harmonics", f"--x {CLEARANCE}=0:1e-4:3 --harmonics 6 --tolerance 1e-3 {usual}"),
                ("one value is KEY=A:A:1", f"--x {CLEARANCE}=0:1e-4:1 {usual}"),
                ("rk8pd", f"--x {CLEARANCE}=0:1e-4:3 --method euler {usual}"),
                ("--threads 0", f"--x {CLEARANCE}=0:1e-4:3 --threads 0 {usual}")]:
            self.refused_map(words, text)

    def test_lines_and_lists(self):
        for lines, words in [("0:4", "must be in 1...3"), ("3:3", "must be in 0...2"), ("-1:2", "0...2"),
                             ("2:1", "must be in 3...3"), ("1", "must be A:B")]:
            self.refused_map(words, f"--y {CLEARANCE}=0:1e-4:3 --lines {lines} --frequency 45 --quantity amplitude")
        self.refused_map("no such file", "--list none.tsv --frequency 45 --quantity amplitude")
        self.file("list.tsv", "bearing.colour\n1\n")
        self.refused_map("is not a known key", "--list list.tsv --frequency 45 --quantity amplitude")
        signed = self.file("list.csv", "frequency,rotor.unbalance_kg_m\n45,+0.05\n45,0.05\n")
        rows = self.rows("map", self.machine, "--list", signed, "--quantity", "amplitude")
        self.assertEqual(rows[1], rows[2])
        self.file("list.csv", "frequency,rotor.unbalance_kg_m\n45,n/a\n45,0.05\n")
        self.refused_map("has no column rotor.unbalance_kg_m of numbers", "--list list.csv --quantity amplitude")
        self.file("list.csv", "frequency,frequency\n45,46\n")
        self.refused_map("has the column frequency twice", "--list list.csv --quantity amplitude")
        self.refused_map("--y: not together", f"--list list.tsv --y {CLEARANCE}=0:1:2 --frequency 45 --quantity force")

    def test_a_table_of_another_map(self):
        """Other quantities, other values of a key, other lines, and no map at all."""
        usual = ["map", self.machine, *SIX, "--x", "frequency=40:45:2", "--y", f"{CLEARANCE}=0:1e-4:3", "--quantity"]
        part = self.file("part.tsv", "".join(f"{line}\n" for line in self.lines(*usual, "amplitude")))
        self.refused("other settings", *usual, "mean", "--resume", part)
        self.refused("other settings", *usual, "amplitude", "--samples", 64, "--resume", part)
        rest = ["map", self.machine, "--x", "frequency=40:45:2", "--quantity", "regime"]
        other = self.file("other.tsv", "".join(f"{line}\n" for line in self.lines(*rest, "--longest", 70)))
        self.refused("other settings", *rest, "--resume", other)
        self.refused("holds other points", *usual, "amplitude", "--lines", "1:3", "--resume", part)
        self.refused("holds other points", *usual, "amplitude", "--lines", "0:2", "--resume", part)
        self.refused("no such file", *usual, "amplitude", "--resume", "none.tsv")
        old = self.file("old.tsv", "# Map of a machine\n# source: rotor_stator 0.1.0 0123456789ab\n# compiler: g++\n# x: frequency=40:45:2\n")
        self.refused("old.tsv: was written by rotor_stator 0.1.0 0123456789ab", *usual, "amplitude", "--resume", old)
