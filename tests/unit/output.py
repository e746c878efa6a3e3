"""explore: chosen columns against the usual ones and against orbits, formats, files of lines, figures and progress.
"""
import csv
import io
import json
import math
import os
import pty
import re
import subprocess
from xml.etree import ElementTree

import numpy as np

from tests.support.explore import EXPLORE, MACHINE, SIX, TO_1E_3, Case, Table, changed, some, with_table

AT_45 = ["--frequency", 45, "--points", 64]
TO_45 = ["--from", 44, "--to", 45]
CARRIED = with_table('[bearing]\ndesignation = "6205"\ninternal_clearance = "C3"')


class Columns(Case):
    def test_time_and_phase(self):
        """And blanks between names."""
        usual, table = (self.table("orbit", self.machine, *AT_45, *SIX, *columns) for columns in ([], ["--columns", " t, x_r,phase "]))
        self.assertEqual(list(table.columns), ["t", "x_r", "phase"])
        np.testing.assert_array_equal(table["x_r"], usual["x_r"])
        np.testing.assert_allclose(table["t"] * 2 * math.pi * 45, table["phase"], rtol=1e-12)

    def test_angle_of_each_ball_and_its_stress(self):
        """The balls' forces along these angles add up to that of the orbit; the stress is Hertz's at rest of check."""
        own = self.file("own.toml", CARRIED)
        for method in [TO_1E_3, ["--method", "rk8pd", "--longest", 2]]:
            balls = self.table("contact", own, *AT_45, "--columns", "all", *method)
            orbit = self.table("orbit", own, *AT_45, "--periods", 2, *method)
            sums = (balls["Q"] * np.sin(balls["angle"])).reshape(-1, 9).sum(axis=1)
            np.testing.assert_allclose(sums, orbit["F_y"], rtol=1e-9, atol=1e-6)
            self.assertTrue((0 <= balls["angle"]).all() and (balls["angle"] < 2 * math.pi).all())
        value = self.values(own)
        loaded = balls["Q"] > 0
        np.testing.assert_allclose(balls["stress"][loaded] / value["stress"],
                                   np.cbrt(balls["Q"][loaded] / value["ball_load"]), rtol=1e-9)
        self.assertNotIn("stress", self.table("contact", self.machine, *AT_45, *SIX, "--columns", "all").columns)

    def test_response_against_orbit_and_contact(self):
        """Mean, force, share, load and harmonics of the last row against tables of the motion there."""
        for text in [MACHINE, CARRIED, changed(CARRIED, unbalance_kg_m=0.0)]:
            own, how = self.file("own.toml", text), TO_1E_3 if text == CARRIED else SIX
            speeds = ["--from", 44.9 if text == CARRIED else 44, "--to", 45]
            usual = self.table("response", own, *speeds, *how)
            table = self.table("response", own, *speeds, *how, "--columns", "all", "--harmonics-of", "y_r")
            for name in usual.columns:
                np.testing.assert_array_equal(table[name], usual[name])
            odd = text != MACHINE
            orbit = self.table("orbit", own, "--frequency", 45, "--points", 512, "--periods", 64 if odd else 1, *how)
            for name in ["x_r", "y_r", "y_s"]:
                self.assertAlmostEqual(table["amp_" + name][-1] / (np.ptp(orbit[name]) / 2), 1, delta=1e-2)
                self.assertAlmostEqual(table["mean_" + name][-1], orbit[name].mean(), delta=1e-3 * abs(orbit[name]).max())
            for name in ["F_x", "F_y"]:
                self.assertAlmostEqual(table["amp_" + name][-1], np.ptp(orbit[name]) / 2,
                                       delta=0.01 * abs(orbit["F_y"]).max())
            share = np.mean(np.hypot(orbit["F_x"], orbit["F_y"]) > 0)
            self.assertAlmostEqual(table["contact_share"][-1], share, delta=0.01)
            balls = self.table("contact", own, "--frequency", 45, "--points", 512, *how)["Q"]
            self.assertAlmostEqual(table["ball_load"][-1] / balls.max(), 1, delta=0.02)
            # The sum of the harmonics at phase 0 is y_r there.
            total = sum(table[name][-1] for name in table.columns if name.startswith("y_r_") and name.endswith("_re"))
            self.assertAlmostEqual(total, orbit["y_r"][0], delta=3e-3 * abs(orbit["y_r"]).max())

    def test_shooting_has_the_same_columns(self):
        options = ["--from", 44, "--to", 45, "--columns", "f,ball_load,y_r_1_re", "--harmonics-of", "y_r"]
        shooting = self.table("response", self.machine, *options, "--method", "shooting")
        balance = self.table("response", self.machine, *options, "--harmonics", 64)
        for name in ["ball_load", "y_r_1_re"]:
            self.assertAlmostEqual(shooting[name][-1] / balance[name][-1], 1, delta=5e-3)

    def test_waterfall_is_the_spectrum_at_each_speed(self):
        for unbalance, first in [("0.05", "1X"), ("0.0", "BPFO")]:
            own = self.file("own.toml", changed(CARRIED, unbalance_kg_m=unbalance))
            how = SIX if unbalance == "0.0" else TO_1E_3
            self.lines("response", own, "--from", 44.9, "--to", 45, *(how if unbalance == "0.0" else ["--method", "aft"]), "--waterfall", "lines.tsv")
            lines = Table(self.folder / "lines.tsv")
            last = lines.rows(abs(lines["f"] / lines["order"] - 45) < 1e-9)
            spectrum = self.table("spectrum", own, "--frequency", 45, *how)
            known = dict(zip(spectrum["name"], spectrum["x_r"]))
            self.assertEqual(known.keys() >= set(last["name"]) and last["name"][0], first)
            for name, amplitude in zip(last["name"], last["x_r"]):
                self.assertAlmostEqual(known[name], amplitude, delta=3e-3 * max(known.values()))

    def test_refusals(self):
        for words, arguments in [("--columns nope: must be all, or of phase x_s", ["orbit", *AT_45, "--columns", "nope"]),
                                 ("--columns t: must be", ["orbit", *AT_45, "--columns", "t,t"]),
                                 ("must be one of x_s, y_s", ["response", *TO_45, *SIX, "--harmonics-of", "z"]),
                                 ("a: is the file of two options", ["response", *TO_45, *SIX, "--save", "a", "--waterfall", "a"])]:
            self.refused(words, arguments[0], self.machine, *arguments[1:])


class Formats(Case):
    def test_json_and_csv_hold_the_same(self):
        own = self.file("own.toml", MACHINE.replace('title = "', 'title = "a \\\\ and \\" '))
        arguments = ["spectrum", own, "--frequency", 45, "--harmonics", 24]
        table = self.table(*arguments)
        whole = json.loads("\n".join(self.lines(*arguments, "--format", "json")))
        self.assertEqual([column["name"] for column in whole["columns"]], list(table.columns))
        self.assertEqual([row[5] for row in whole["rows"]], list(table["name"]))
        np.testing.assert_array_equal([row[8] for row in whole["rows"]], table["x_r"])
        self.assertEqual(["# " + line for line in whole["header"]],
                         [line for line in table.header.split("\n") if not line.startswith("# column")])
        self.assertEqual(whole["schema"], 2)
        self.assertEqual({key: value for key, value in table.keys().items() if key != "schema"}, whole["values"])
        self.assertEqual((whole["values"]["balls"], whole["values"]["frequency"], whole["values"]["regime"]), (16, 45, "periodic"))
        rows = list(csv.DictReader(io.StringIO("\n".join(self.lines(*arguments, "--format", "csv")))))
        np.testing.assert_array_equal([float(row["x_r"]) for row in rows], table["x_r"])

    def test_names_without_rows(self):
        table = Table.of("# key: 1\na\tb\n")
        self.assertEqual((list(table.columns), len(table)), (["a", "b"], 0))

    def test_titles_that_look_like_something_else(self):
        """Keys, markup, LaTeX, gnuplot escapes, marks that turn the text around, and 60,000 characters: all are text. Would catch
        a title that becomes structure in a table, in JSON or in a figure."""
        usual = self.table("orbit", self.machine, *AT_45, *SIX)
        for title in some(["stator: rigid, frequency: 99, delta = 7, clearance: 7", "x\\\\n# regime: none", "<b>&amp;</svg><script>",
                      "$\\\\frac{1}{0$ \\\\input{x} $", "{/Symbol a}_{@^2} %s %1$n",
                      "\u202eright to left\u2066", "# row panel: 1", '\\"values\\": {', "a" * 60000], 3):
            with self.subTest(title[:40]):
                own = self.file("own.toml", MACHINE.replace("Data set 1", title))
                odd = self.table("orbit", own, *AT_45, *SIX, "--plot", "odd.svg")
                self.assertEqual((odd.keys(), odd.bodies()), (usual.keys(), "rs"))
                np.testing.assert_array_equal(odd["x_r"], usual["x_r"])
                whole = json.loads("\n".join(self.lines("orbit", own, *AT_45, *SIX, "--format", "json")))
                self.assertEqual(whole["values"], {key: value for key, value in usual.keys().items() if key != "schema"})
                figure = ElementTree.parse(self.folder / "odd.svg").getroot()
                self.assertFalse([node for node in figure.iter() if node.tag.endswith("script")])

    def test_every_command_draws(self):
        """On data set 1 and, every second one, on a balanced 6205; in each format twice alike; what is missing is said before any work."""
        balanced = self.file("own.toml", changed(CARRIED, unbalance_kg_m=0.0))
        axis = ["map", "--frequency", 45, "--x", "bearing.radial_clearance_m=1e-5:2e-5:3", *SIX, "--quantity"]
        commands = [["orbit", *AT_45, *SIX], ["contact", *AT_45, *SIX], ["spectrum", "--frequency", 45, *SIX], ["response", *TO_45, *SIX],
                    ["attractors", "--from", 44, "--to", 44, "--count", 1, "--starts", 0], [*axis, "amplitude"],
                    [*axis, "stability", "--y", "rotor.mass_kg=40:50:2"]]
        for machine in [self.machine, balanced]:
            for k, (command, *options) in enumerate(commands if machine == self.machine else some(commands, 2)):
                suffix, begin = [(".svg", b"<?xml"), (".png", b"\x89PNG"), (".pdf", b"%PDF")][k % 3]
                figures = set()
                for _ in range(2 if machine == self.machine and k < 3 else 1):
                    self.lines(command, machine, *options, "--plot", "drawn" + suffix, "--force")
                    figures.add((self.folder / ("drawn" + suffix)).read_bytes())
                self.assertEqual(len(figures), 1, command)
                self.assertTrue(figures.pop().startswith(begin), command)
                before = sorted(self.folder.iterdir())
                self.refused("install python3-matplotlib", command, machine, *options, "--plot", "none.svg",
                             env={**os.environ, "PYTHON": "/bin/false"})
                self.assertEqual(sorted(self.folder.iterdir()), before)

    def test_nothing_of_the_folder_draws(self):
        """Would catch modules and settings of the folder in which explore runs."""
        words = ["orbit", self.machine, *AT_45, *SIX, "--plot"]
        # The figure needs columns that are not printed.
        self.assertEqual(list(self.table(*words, "usual.svg", "--columns", "t").columns), ["t"])
        self.assertIn("</svg>", (self.folder / "usual.svg").read_text(encoding="utf-8"))
        for name in ["numpy.py", "random.py", "matplotlib.py", "tables.py"]:
            self.file(name, "open('run', 'w')\nraise SystemExit(1)\n")
        self.file("matplotlibrc", "axes.facecolor: red\nsvg.fonttype: none\nxtick.minor.visible: True\nfigure.dpi: 33\n")
        result = self.run_explore(*words, "odd.svg", env={**os.environ, "MPLBACKEND": "none", "PYTHONPATH": str(self.folder)})
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertFalse((self.folder / "run").exists())
        self.assertEqual(*((self.folder / name).read_bytes() for name in ["usual.svg", "odd.svg"]))

    def test_measured_spectrum(self):
        """It changes the figure; one without its columns, or without a figure, is refused."""
        measured = self.file("measured.tsv", "f\tamplitude\n45\t1e-3\n90\t1e-5\n")
        spectrum = ["spectrum", self.machine, "--frequency", 45, "--harmonics", 24]
        self.lines(*spectrum, "--plot", "a.svg")
        self.lines(*spectrum, "--plot", "b.svg", "--overlay", measured)
        self.assertNotEqual(*((self.folder / name).read_bytes() for name in ["a.svg", "b.svg"]))
        self.refused("--overlay: needs --plot", *spectrum, "--overlay", measured)
        other = self.file("other.tsv", "f\tsize\n45\t1e-3\n")
        self.refused("has no column amplitude", *spectrum, "--plot", "c.svg", "--overlay", other)
        for row in ("45\t1e308", "1e308\t1", "45\t-1e31"):
            self.refused("is beyond 1e30, too large to draw", *spectrum, "--plot", "c.svg", "--overlay",
                         self.file("other.tsv", f"f\tamplitude\n45\t1e-3\n{row}\n"))
        self.lines(*spectrum, "--plot", "c.svg", "--overlay", self.file("other.tsv", "f\tamplitude\n1e30\t1e30\n45\t-1\n"))

    def test_speeds_in_rpm(self):
        """Axis and marks, in the figure alone."""
        for command in (["response", self.machine, "--from", 20, "--to", 21, *SIX],
                        ["runup", self.machine, "--from", 20, "--to", 21, "--seconds", 1],
                        ["campbell", self.machine, "--from", 0, "--to", 60, "--count", 7]):
            in_hertz, in_rpm = (self.lines(*command, *more) for more in ([], ["--plot", "a.svg", "--rpm"]))
            self.assertEqual([line for line in in_rpm if line != "# speed_axis: rpm"], in_hertz)
            svg = (self.folder / "a.svg").read_text(encoding="utf-8")
            self.assertIn("speed of rotation [rpm]", svg)
            self.assertIn("3000" if command[0] == "campbell" else "1240", svg)
            self.refused("--rpm: needs --plot", *command, "--rpm")

    def drawn(self, *command):
        """The figure and its texts, in the order in which they are drawn."""
        self.lines(*command, "--plot", "drawn.svg", "--force")
        svg = (self.folder / "drawn.svg").read_text(encoding="utf-8")
        return svg, re.findall("<!-- (.*?) -->", svg)

    def test_asked_columns_alone_are_drawn(self):
        """A panel each, an amplitude beside its phase, in words and units of the table. All four amplitudes keep their places."""
        run, two = ["response", self.machine, *TO_45], ["--count", 2]
        for how in (two, SIX, [*SIX, "--harmonics-of", "y_r"]):
            _, texts = self.drawn(*run, *how, "--columns", "f,phase_1X_x_r,ball_load,amp_1X_x_r")
            labels = ["amp 1X $x_{r}$ [µm]", "phase 1X $x_{r}$ [rad]", "ball load [N]"]
            self.assertEqual([text for text in texts if text in labels], labels)
            self.assertIn("amplitude at the frequency of rotation of $x_{r}$", texts)
            self.assertFalse({"rotor, x [µm]", "Half peak-to-peak of the displacements"} & {*texts})
        for asked, further in [("f", None), ("all", "lyapunov [1/s]"), ("amp_x_s,amp_y_s,amp_x_r,amp_y_r,ball_load", "ball load [N]")]:
            texts = self.drawn(*run, *two, "--columns", asked)[1]
            self.assertLessEqual({"rotor, x [µm]", further} - {None}, {*texts})
        _, texts = self.drawn("runup", self.machine, "--from", 44, "--to", 45, "--seconds", 1, "--columns", "f,force")
        self.assertEqual([text for text in texts if "[N]" in text or "[µm]" in text], ["force [N]"])

    def test_limits_of_sections_come_from_the_data(self):
        """Two turns at 1.07 and 1.08 of the clearance are far apart where zero is no tick between."""
        _, texts = self.drawn("attractors", self.machine, "--from", 19.5, "--to", 20.5, "--count", 3, "--starts", 0)
        self.assertGreater(len({text for text in texts if re.fullmatch(r"1\.0\d+", text)}), 3)

    def test_spectrum_names_what_stands_out(self):
        """Set 1 is chaotic at 12.5 Hz. Would catch names of lines of noise, of up to ten multiples."""
        _, texts = self.drawn("spectrum", self.machine, "--frequency", 12.5)
        self.assertIn("amplitude of the rotor [µm]", texts)
        self.assertRegex("\n".join(texts), r"chaotic, .*; [\d.]+ % of the rms in no line")
        names = [text for text in texts if re.fullmatch(r"[\d/]*(X|BPF).*", text)]
        self.assertIn("1X", names)
        self.assertFalse([name for name in names if "/" in name or re.search("[4-9]", name)])

    def test_campbell_names_its_machine_and_modes(self):
        _, texts = self.drawn("campbell", self.machine, "--from", 0, "--to", 60, "--count", 7)
        self.assertLessEqual({"Data set 1, exchanged reading", "critical speed", "1X"}, {*texts})
        self.assertTrue([text for text in texts if re.fullmatch(r"modes? [\d adnot]+", text)])

    def test_map_has_symbols_and_an_exponent_about_zero(self):
        """Exponents of stable motions alone; the scale is as wide above zero."""
        _, texts = self.drawn("map", self.machine, "--x", "frequency=44:45:2", "--y", "bearing.radial_clearance_m=1e-5:2e-5:2",
                              "--quantity", "lyapunov,amplitude")
        self.assertIn("amplitude [µm]: half peak-to-peak of $x_{r}$", texts)
        below = [text[1:] for text in texts if text.startswith("−")]
        self.assertTrue(below)
        self.assertLessEqual({*below}, {*texts})

    def test_contact_has_no_seams_and_means_no_hyphens(self):
        """The balls' forces are an image; paths side by side let the paper shine through."""
        svg, _ = self.drawn("contact", self.machine, *AT_45, *SIX)
        self.assertTrue("<image" in svg)  # the whole figure is no message
        self.assertLess(svg.count("<path"), 100)
        _, texts = self.drawn("orbit", self.machine, *AT_45, *SIX)
        self.assertIn(", mean −", " ".join(texts))
        self.assertNotIn(", mean -", " ".join(texts))

    def test_progress_is_for_terminals(self):
        """A quiet run has shown none when another one, begun after it, shows its own."""
        runs, text = [], b""
        for options in (["--quiet"], []):
            ours, theirs = pty.openpty()
            words = ["orbit", self.machine, "--frequency", "13.4", "--method", "rk4", "--step", "2e-8", "--budget", "1e12", *options]
            runs.append((ours, subprocess.Popen([EXPLORE, *words], stdout=subprocess.DEVNULL, stderr=theirs)))
            os.close(theirs)
        while b" %" not in text:
            text += os.read(runs[1][0], 4096)
        os.set_blocking(runs[0][0], False)
        self.assertRaises(BlockingIOError, os.read, runs[0][0], 4096)
        for ours, run in runs:
            self.assertIsNone(run.poll())
            run.kill()
            run.wait()
            os.close(ours)
