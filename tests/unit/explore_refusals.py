"""explore with files and options that are wrong or could surprise: each is refused with status 2 and one
line that says what is wrong, before anything is computed, or does what it says.
"""
import os
import re
import resource
import signal
import subprocess
import time
import unittest
from pathlib import Path

from tests.support.explore import EXPLORE, MACHINE, ORBIT, RESPONSE, Case, with_table


OWN = "# Branch of harmonic balance\n# source: rotor_stator 0.1.0\n"  # a file of --save
OTHER = OWN.replace("Branch of harmonic balance", "Orbit")


class Values(Case):
    """Parameter files and options whose values are wrong."""

    def test_parameters(self):
        line = MACHINE.split("mass_kg")[0].count("\n") + 1
        cage = "cage_speed_ratio = 0.5"
        for old, new, words in [
                ("mass_kg = 20.0", "mass_kg = 0.0", f":{line}: stator.mass_kg must be > 0"),
                ("mass_kg = 20.0", "mass_kg = -1", "stator.mass_kg must be > 0"),
                ("mass_kg = 20.0", "mass_t = 1e306", "stator.mass_t must be finite"),
                ("mass_kg = 20.0", "mass_g = 1e-323", "stator.mass_g must be > 0"),
                ("mass_kg = 20.0", "mass_kg = nan", "stator.mass_kg must be finite"),
                ("mass_kg = 20.0", "mass_kg = inf", "stator.mass_kg must be finite"),
                ("mass_kg = 20.0", 'mass_kg = "heavy"', "stator.mass_kg must be a number"),
                ("mass_kg = 20.0", "mass_kg = 20.0\ncolour = 1",
                 f":{line + 1}: stator.colour is not a known key"),
                ("mass_kg = 20.0", "", "stator.mass_kg is missing"),
                ("rad_per_s = 500.0", "rad_per_s = -1", "natural_frequency_rad_per_s must be >= 0"),
                ("damping_ratio = 0.05", "damping_ratio = -0.1", "damping_ratio must be >= 0"),
                ("unbalance_kg_m = 0.05", "unbalance_kg_m = -1", "rotor.unbalance_kg_m"),
                ("balls = 16", "balls = 0", "bearing.balls must be in 1...1024"),
                ("balls = 16", "balls = 1025", "bearing.balls must be in 1...1024"),
                ("balls = 16", "balls = 16.5", "bearing.balls must be a whole number"),
                ("m1p5 = 1e11", "m1p5 = 0", "contact_stiffness_N_per_m1p5 must be > 0"),
                (cage, "cage_speed_ratio = 0.6", "0 < c <= 0.5"),
                (cage, "cage_speed_ratio = 0.0", "cage_speed_ratio"),
                (cage, "", "cage_speed_ratio is missing"),
                (cage, cage + "\nball_radius_m = 0.01\ninner_race_radius_m = 0.07", "both given"),
                (cage, "ball_radius_m = 0.01", "inner_race_radius_m is missing"),
                (cage, "ball_radius_m = 0.03\ninner_race_radius_m = 0.07", "overlap"),
                ("[gravity]", "[wind]", "wind is not a known key here (gravity is missing)"),
                ("[stator]", "[housing]", "housing is not a known key here (stator is missing)"),
                ("acceleration_m_per_s2", "g", "gravity.g is not a known key here (gravity.acceleration_m_per_s2 is missing)"),
                ("damping_ratio = 0.05", "damping_ratio_percent = 5",
                 f":{line + 2}: stator.damping_ratio_percent is not a known key here (stator.damping_ratio is missing; give it, or"),
                ("unbalance_kg_m", "unbalance_gmm", "did you mean unbalance_g_mm? (rotor.unbalance_kg_m is missing"),
                *(("unbalance_kg_m", f"unbalance_{unit}", "did you mean unbalance_g_mm?") for unit in ("g_m", "gcm")),
                ("unbalance_kg_m", "unbalance_KG_m", "did you mean unbalance_kg_m?"),
                ("s2 = 9.81", "s2 = -9.81", "gravity.acceleration"),
                ("title = ", "title = 3 #", "title must be a string"),
                ("[stator]", "stator = 1\n[other]", "stator must be a table, [stator]"),
                ("[rotor]", "[[rotor]]", "rotor must be a table, [rotor]"),
                ("[bearing]", "[[bearing]]", "bearing must be [bearing]; several are of bodies given by matrices"),
                ("[stator]", "[stator", "not TOML"),
                *((known, unknown, f"{unknown} is not a known key here; did you mean {known}?") for known, unknown in
                  [("balls", "bals"), ("mass_kg", "mass"), ("cage_speed_ratio", "cage_speed_ration"), ("balls", "Balls")]),
                *(('title = "', f'title = "{character}', "title must be one line")
                  for character in ["\\n", "\\t", "\\u0007", "\\u0085", "\\u2028"])]:
            self.refused_change(old, new, words)

    def test_files_that_are_no_parameter_files(self):
        self.refused_machine("is empty", "")
        self.refused_machine("not TOML", "just some words")
        self.refused_machine("; decimals have a point", MACHINE.replace("mass_kg = 20.0", "mass_kg = 20,0"))
        self.refused("no such file", "orbit", "no/such/file.toml", *ORBIT)
        self.refused("is a directory", "orbit", self.folder, *ORBIT)

    def test_options(self):
        self.refused_each([
                ("", "--frequency"),
                ("--frequency 30 --harmonics 0", "--harmonics 0: must be in 1...4096"),
                ("--frequency 30 --harmonics 4097", "1...4096"),
                ("--frequency 30 --harmonics 10 --samples 20", "--samples 20: must be in 21"),
                ("--frequency 30 --method euler", "rk8pd"), ("--frequency 30 --points 0", "--points"),
                ("--frequency 30 --colour red", "--colour"),
                ("--frequency 30 --tolerance 0", "--tolerance"),
                ("--frequency 30 --tolerance 1e6", "must be in 1e-08...0.1"),
                ("--frequency 30 --tolerance nan", "--tolerance nan"),
                ("--frequency 30 --tolerance 1e-4 --samples 64", "--harmonics"),
                ("--frequency 30 --newton-tolerance 0", "--newton-tolerance"),
                ("--frequency 30 --newton-tolerance 1e6", "must be in 1e-15...0.001"),
                ("--frequency 30 --method rk8pd --local-error 1e10", "--local-error"),
                ("--frequency 30 --method rk4 --step 0", "--step"),
                ("--frequency 30 --step 1", "--step 1: is too long, a turn takes 0.0333 s"),
                *((f"--frequency {speed}", f"--frequency {speed}: must be a positive speed in Hz, or as 1500rpm\n")
                  for speed in ("-25", "0", "1500rad/s", "25,0")),
                ("--frequency 30 --subharmonic 0", "--subharmonic 0: must be in 1...8"),
                ("--frequency 30 --subharmonic 9", "1...8"), ("--frequency 30 --subharmonic 1.5", "--subharmonic"),
                ("--frequency 30 --subharmonic 2 --method rk4", "--subharmonic: is for the methods aft")], "orbit", self.machine)
        self.refused_each([
                ("--from 10 --to 10 --count 2", "--from 10 Hz: must be below --to 10 Hz"), ("--from 20 --to 10", "--from"),
                ("--from 0 --to 10", "--from"), ("--from 1 --to inf", "--to"),
                ("--from 1 --to 10 --newton-tolerance 1", "--newton-tolerance 1"),
                ("--from 1 --to 2 --direction left", "must be rest, up or down"),
                ("--from 1 --to 2 --method aft --direction rest", "--direction rest: must be up or down"),
                ("--from 1 --to 2 --isolated -1", "--isolated -1: must be in 0"),
                ("--from 1 --to 2 --method aft --subharmonic 2 --isolated 3", "--subharmonic: not together"),
                ("--from 1 --to 2 --subharmonic -2", "--subharmonic -2: must be in 1...8"),
                ("--from 1 --to 2 --tolerance 1", "--tolerance 1: must be"),
                ("--from 1 --to 2 --tolerance 1e-3 --harmonics 6", "--tolerance: not together with --harmonics"),
                ("--from 1 --to 2 --tolerance 1e-3 --count 0", "--count 0"), ("--from 1 --to 2 --count 0", "--count 0"),
                ("--from 1 --to 2 --harmonics 6 --count 5", "--count: of a branch needs --tolerance"),
                ("--from 1 --to 2 --method shooting --count 5", "--count: of a branch needs --tolerance"),
                ("--from 1 --to 2 --tolerance 1e-3 --method shooting", "--tolerance: is for --method auto or aft"),
                ("--from 1 --to 2 --restart no/such/file", "no such file"),
                ("--from 1 --to 2 --restart .", "is a directory"),
                ("--from 1 --to 2 --restart /dev/zero", "is no regular file"),
                ("--from 1 --to 2 --restart " + "x" * 300, "File name too long"),
                ("--from 1 --to 2 --restart machine.toml", "machine.toml:1: '# Branch of")], "response", self.machine)
        self.refused_each([
                ("--count 0", "--count 0: must be in 1...10000"), ("--count 1.5", "--count"),
                ("--count 3 --starts -1", "--starts -1: must be in 0...1000"), ("--count 3 --starts 1e3", "--starts"),
                ("--count 10000 --starts 18", "--starts 18: must be in 0...17 with --count 10000"),
                ("--count 3 --budget 0", "--budget"), ("--count 3 --harmonics 6", "--harmonics"),
                ("--count 3 --plot bifurcations", "must end in .svg, .png or .pdf"),
                ("--count 3 --plot a.gif", "must end in .svg, .png or .pdf"),
                ("--count 3 --plot no/such/folder.svg", "its folder does not exist"),
                ("--count 3 --section no/such/file", "its folder does not exist"),
                ("--count 3 --section machine.toml", "is the input"),
                ("--count 3 --motions machine.toml", "is the input"),
                ("--count 3 --section same.tsv --motions same.tsv", "is the file of two options"),
                ("--count 3 --section same.svg --plot same.svg", "is the file of two options"),
                ("--count 3 --columns v_x_r", "--columns v_x_r: must be"),
                ("--count 3 --starts 1.5", "--starts")], "attractors", self.machine, "--from", 10, "--to", 20)
        self.refused("--from 10 Hz: must be below --to 10 Hz", "attractors", self.machine, "--from", 10, "--to", 10, "--count", 3)
        self.refused_each([("--from 3 --to 2", "--from 3 Hz: must be below --to 2 Hz"), ("--format xml", "must be one of tsv, csv, json")],
                          "check", self.machine)
        self.refused("closed no motion of period 2 T", "orbit", self.machine, *ORBIT, "--method", "aft", "--subharmonic", 2,
                     "--budget", 1e9, status=3)
        self.refused("; is --step 0.001 too long?", "orbit", self.machine, *ORBIT, "--step", 1e-3, status=3)
        self.refused("--count 1: is for --from equal to --to", "response", self.machine, *RESPONSE, "--count", 1, "--method", "aft", "--tolerance", 1e-3)
        for flag in ("--quiet=7", "--no-stability=5"):
            self.refused("disallowed flag override", "orbit", self.machine, *ORBIT, flag)
        self.refused("subcommand")
        self.refused("subcommand", "dance")

    def test_a_cage_that_does_not_repeat(self):
        odd = self.file("odd.toml", MACHINE.replace("cage_speed_ratio = 0.5", "cage_speed_ratio = 0.4321"))
        self.refused("--samples: chosen", "orbit", odd, *ORBIT, "--harmonics", 6, "--samples", 64)
        self.refused("--lines: is of motions with two frequencies", "orbit", self.machine, *ORBIT, "--lines", 6)
        self.refused("--subharmonic 2: needs a whole number", "orbit", odd, *ORBIT, "--method", "aft", "--subharmonic", 2)
        for options in (["--save", "a"], ["--isolated", 3], ["--subharmonic", 2]):
            self.refused("need a whole number of passing balls", "response", odd, *RESPONSE, "--method", "aft", *options)
        self.refused("orbit judges", "response", odd, *RESPONSE, "--method", "aft", "--stability")
        for periods in ("0", "1001", "1.5"):
            self.refused("--periods", "orbit", odd, *ORBIT, "--periods", periods)
        # Nine turns are nearly a period: what is right over sixteen turns is not over 250.
        slow = self.file("slow.toml", MACHINE.replace("cage_speed_ratio = 0.5", "cage_speed_ratio = 0.381966"))
        self.refused("not reached at 24.3 Hz", "orbit", slow, "--frequency", 24.3, "--method", "aft", "--tolerance", 1e-3, status=3)
        self.refused("not reached at 18.7 Hz", "orbit", odd, "--frequency", 18.7, "--method", "aft", "--tolerance", 1e-6, status=3)

    def test_no_solution(self):
        self.refused("no solution found with 24 harmonics at 13.4 Hz", "orbit",
                     Path("data/set2.toml").resolve(), "--frequency", "13.4", "--harmonics", "24", status=3)

    def test_scenes(self):
        """Of programs that compute figures and costs; one with too many speeds took 47 GB and a minute."""
        (self.folder / "scenes").mkdir()
        for name in ("set1", "set2"):
            self.file(f"{name}.toml", Path(f"data/{name}.toml").read_text(encoding="utf-8"))
        for program, old, new, words in [
                ("fig03_response", "step = 0.1 }", "step = 1e-8 }", "balance_hz.step gives more than 100000 speeds"),
                ("fig05_displacements", "title", "titel", "title is missing"),
                ("regimes", "points_per_period = 256", "points_per_period = 8", "points_per_period"),
                ("tab02_equal_error", "[1e-2, 1e-3, 1e-6]", "[1e-6, 1e-3, 1e-2]", "targets"),
                ("tab02_equal_error", "[25.0, 60.0]", "[60.0, 25.0]", "range_ends_hz"),
                ("tab02_equal_error", '"rkf45"', '"rkf46"', "methods"), ("tab02_equal_error", "closures", "closure", "closures"),
                ("tab02_equal_error", "[bsimp]", "colour = 1\n[bsimp]", "colour"),
                ("work_precision", "50.0, 45.0]", "50.0]", "speeds_hz"), ("work_precision", "below_hz = 0.5", "below_hz = 7.0", "below_hz"),
                ("cost_growth", "below_hz = 29.5", "below_hz = 30.5", "below_hz"), ("cost_growth", "[8, 16, ", "[16, 8, ", "harmonics"),
                ("cost_growth", "samples_per_harmonic = 8", "samples_per_harmonic = 1", "samples_per_harmonic")]:
            scene = Path(f"data/scenes/{program}.toml").read_text(encoding="utf-8")
            self.assertIn(old, scene)
            self.refused(words, self.file("scenes/bad.toml", scene.replace(old, new, 1)), program=EXPLORE.with_name(program))
        figure, deviations = (EXPLORE.with_name(program) for program in ("fig05_displacements", "deviations"))
        self.refused("no such file", "no/such/scene.toml", program=figure)
        self.refused("must be exchanged or as-printed", "scenes/bad.toml", "--reading", "upside-down", program=figure)
        self.refused("must be exchanged;", Path("data/scenes/deviations.toml").resolve(), "--reading", "as-printed", program=deviations)


class Save(Case):
    """What --save must never replace, and that it replaces a file whole or not at all."""

    def save(self, name):
        return ["response", self.machine, *RESPONSE, "--harmonics", 6, "--save", name]

    def test_only_regular_files(self):
        old = self.file("old.tsv", "old")
        (self.folder / "link").symlink_to(old)
        (self.folder / "dangling").symlink_to("nowhere")
        (self.folder / "folder").mkdir()
        os.mkfifo(self.folder / "fifo")
        for name, words in [("link", "symbolic link"), ("dangling", "symbolic link"),
                            ("folder", "is a directory"), ("fifo", "no regular file"),
                            ("/dev/null", "no regular file"), ("", "the name is empty"),
                            ("no/such/file", "folder does not exist")]:
            self.refused(words, *self.save(name))
        self.assertEqual(old.read_text(), "old")
        self.assertTrue((self.folder / "dangling").is_symlink())

    def test_not_its_input(self):
        os.link(self.machine, self.folder / "hard_link.toml")
        (self.folder / "folder").mkdir()
        for name in ["machine.toml", "folder/../machine.toml", "hard_link.toml"]:
            self.refused("is the input", *self.save(name))
        self.assertEqual(self.machine.read_text(), MACHINE)
        self.assertEqual(self.run_explore(*self.save("branch.tsv")).returncode, 0)
        self.refused("is the input", *self.save("branch.tsv"), "--restart", "branch.tsv")

    def test_not_the_standard_output(self):
        with open(self.folder / "table.tsv", "w") as out:
            self.refused("is the standard output", *self.save("table.tsv"), stdout=out)

    def test_writes_beside_and_through_no_link(self):
        victim = self.file("victim", "untouched")
        (self.folder / "branch.tsv.tmp").symlink_to(victim)
        os.mkfifo(self.folder / "other.tsv.tmp")
        self.file("branch.tsv", OWN).chmod(0o600)
        for name in ["branch.tsv", "other.tsv"]:
            self.assertEqual(self.run_explore(*self.save(name)).returncode, 0)
            self.assertTrue((self.folder / name).read_text().startswith("# Branch of harmonic balance\n"))
        self.assertEqual(victim.read_text(), "untouched")
        self.assertEqual((self.folder / "branch.tsv").stat().st_mode & 0o777, 0o600)
        self.assertEqual(len(list(self.folder.iterdir())), 6)

    def test_full_disk_keeps_the_old_file(self):
        """Would catch a table that is lost with its side file."""
        old = self.file("branch.tsv", OWN)
        before = sorted(self.folder.iterdir())
        table = self.lines(*self.save("other.tsv"))
        (self.folder / "other.tsv").unlink()

        def no_room():
            signal.signal(signal.SIGXFSZ, signal.SIG_DFL)
            resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
        result = self.run_explore(*self.save("branch.tsv"), preexec_fn=no_room)
        self.assertEqual((result.returncode, result.stdout.splitlines()), (3, table))
        self.assertEqual(result.stderr, "branch.tsv: cannot be written: File too large\n")
        self.assertEqual(old.read_text(), OWN)
        self.assertEqual(sorted(self.folder.iterdir()), before)


    def test_only_what_this_program_wrote(self):
        """Of its own kind, unless forced. Would catch notes, a matrix or a measurement that a slip of the pen replaces."""
        matrix = "%%MatrixMarket matrix coordinate real general\n% written by rotor_stator\n1 1 1\n1 1 1\n"
        for option, text in [("--save", "notes"), ("--save", OTHER), ("--waterfall", OWN), ("--save", "# a\n# b\n"), ("--waterfall", matrix), ("--plot", OWN),
                             ("--save", "<?xml rotor_stator"), ("--plot", "<?xml>")]:
            with self.subTest(option=option, text=text):
                old = self.file("old.svg", text)
                words = ["response", self.machine, *RESPONSE, "--harmonics", 6, option, old]
                self.refused(f"no file of {option} that this program wrote; --force replaces it", *words)
                self.assertEqual(old.read_text(), text)
                self.lines(*words, "--force")
                self.lines(*words)
        self.file("empty.tsv", "")
        self.lines(*self.save("empty.tsv"))

    @unittest.skipIf(os.geteuid() == 0, "root may write to all")
    def test_no_protected_file(self):
        self.file("branch.tsv", OWN).chmod(0o444)
        self.refused("is write-protected", *self.save("branch.tsv"))

    def test_one_file_of_two_options(self):
        """Whatever their names, there or not yet."""
        (self.folder / "folder").mkdir()
        for other in ["./new.tsv", "folder/../new.tsv"]:
            self.refused("is the file of two options", *self.save("new.tsv"), "--waterfall", other)
        os.link(self.file("old.tsv", OWN), self.folder / "link.tsv")
        self.refused("is the file of two options", *self.save("old.tsv"), "--waterfall", "link.tsv", "--force")
        self.file("measured.svg", "f\tamplitude\n45\t1e-6\n")
        self.refused("is the input", "spectrum", self.machine, "--frequency", 45, "--overlay", "measured.svg", "--plot",
                     "./measured.svg")

    def test_stopped(self):
        """Would catch what a stopped run leaves behind."""
        python = self.file("python", "#!/bin/sh\ntouch begun\nexec sleep 3\n")
        python.chmod(0o755)
        (self.folder / "tmp").mkdir()
        for number in (signal.SIGINT, signal.SIGTERM):
            run = subprocess.Popen([EXPLORE, "orbit", self.machine, *ORBIT, "--plot", "a.svg"], cwd=self.folder,
                                   stdout=subprocess.DEVNULL,
                                   env={**os.environ, "PYTHON": python, "TMPDIR": str(self.folder / "tmp")})
            while not (self.folder / "begun").exists():
                time.sleep(0.01)
            self.assertTrue(list((self.folder / "tmp").iterdir()))
            run.send_signal(number)
            self.assertEqual(run.wait(), -number)
            self.assertFalse(list((self.folder / "tmp").iterdir()))
            (self.folder / "begun").unlink()


class Files(Case):
    """Parameter files and saved branches."""

    def test_nested_too_deeply(self):
        for text in {"dotted key": "a." * 40000 + "a = 1\n",
                     "table": "[" + "a." * 40000 + "a]\n",
                     "arrays": "a = " + "[" * 40000 + "]" * 40000 + "\n",
                     "inline tables": "a = " + "{a = " * 40000 + "1" + "}" * 40000 + "\n",
                     "after a string": 'b = [ """x"""",\n{' + '"a" . ' * 40000 + "a = 1}]\n"}.values():
            self.refused_machine("levels", MACHINE + text)

    def test_names_that_the_system_refuses(self):
        """Would catch an exception that ends the program without a line of its own."""
        (self.folder / "loop").symlink_to("loop")
        machine = with_table('[rotor]\nmatrices = "{}"')
        for name in ["x" * 300, "loop", "machine.toml"]:
            self.refused_machine("rotor.matrices names no folder", machine.format(name))
        (self.folder / "loops").mkdir()
        (self.folder / "loops/M.mtx").symlink_to("M.mtx")
        self.refused_machine("Too many levels of symbolic links", machine.format("loops"))
        self.refused("TMPDIR", "orbit", self.machine, *ORBIT, "--plot", "a.svg", env={**os.environ, "TMPDIR": "/no/such"})
        for name in ["loop", "x" * 300]:
            self.refused("is no folder", "shaft", Path("data/rotors/overhung_shaft.toml").resolve(), "--to", name)
        long = ".".join("a" * 40000)
        self.refused("more than 256 levels", "map", self.machine, "--x", long + "=1:2:2", "--quantity", "amplitude")
        self.refused("more than 256 levels", "map", self.machine, "--list", self.file("list.tsv", long + "\n1\n"),
                     "--frequency", 45, "--quantity", "amplitude")

    def test_more_threads_than_pieces(self):
        grid = ["map", self.machine, "--x", "frequency=20:21:2", "--quantity", "amplitude", "--harmonics", 6]
        result = self.run_explore(*grid, env={**os.environ, "OMP_NUM_THREADS": "100000"})
        self.assertEqual((result.returncode, result.stdout.splitlines()), (0, self.lines(*grid)))

    def test_dots_that_nest_nothing(self):
        self.lines("orbit", self.file("dots.toml", "# " + "." * 99 + "\n" + MACHINE.replace(
            'title = "', 'title = "' + "." * 99)), *ORBIT, "--harmonics", 6)

    def test_too_long(self):
        self.refused_machine("is longer than 1000000 bytes", MACHINE + "#" * 1000000)
        for arguments in (["orbit", "huge", *ORBIT], ["response", self.machine, *RESPONSE, "--restart", "huge"]):
            with open(self.folder / "huge", "w") as huge:
                huge.truncate(100 * 10**9)
                self.refused("is longer than", *arguments)

    def test_no_line_from_a_file_name(self):
        """Nor one that a script could not open, after the work: of what is read and of what is written."""
        self.file("a\n# regime: none\nb.toml", MACHINE)
        for name, shown in (("a\n# regime: none\nb.toml", r"'a\x0a...'"), ("a\tb.svg", r"'a\x09...'"), ("é\udcff.svg", r"'é\xff...'"),
                            ("\udce9\udc80.svg", r"'\xe9...'"), ("\u2028.svg", r"'\xe2...'")):
            for asked in (["orbit", name, *ORBIT], ["orbit", self.machine, *ORBIT, "--plot", name],
                          ["spectrum", self.machine, "--frequency", 45, "--plot", "a.svg", "--overlay", name],
                          ["response", self.machine, *RESPONSE, "--harmonics", 6, "--save", name], ["shaft", self.machine, "--to", name]):
                self.refused(shown + ": names of files hold neither", *asked)
        self.lines("orbit", self.file("é 🙂.toml", MACHINE), *ORBIT, "--harmonics", 6)

    def test_clearance_that_is_never_closed(self):
        wide = self.file("wide.toml", re.sub("(radial_clearance_m = ).*", r"\g<1>20", MACHINE))
        for command, options in [("orbit", ORBIT), ("contact", ORBIT), ("response", RESPONSE)]:
            with self.subTest(command):
                for machine, word in [(wide, "no"), (self.machine, "yes")]:
                    self.assertEqual(self.table(command, machine, *options, "--harmonics", 6).value("contact"), word)


class Options(Case):
    def test_decimal_numbers_only(self):
        table = self.table("orbit", self.machine, *ORBIT, "--harmonics", "010")
        self.assertEqual((table.value("harmonics"), table.value("samples")), (10, 84))
        for option, values in {"--harmonics": ["0x10", "6.5", "1e1", "", "six", "99999999999", "-1"],
                               "--frequency": ["0x1p3", "fast", "inf", "nan", "1e400", "1e-400", "1e-320", "", "0", "-3"],
                               "--budget": ["0", "1e16", "infinity"]}.items():
            for value in values:
                rest = [] if option == "--frequency" else ["--frequency", "45"]
                self.refused(f"{option} {value}: must be ", "orbit", self.machine, option, value, *rest)

    def test_unknown_option_with_a_suggestion(self):
        self.refused("--harmonic: not expected; did you mean --harmonics?",
                     "orbit", self.machine, *ORBIT, "--harmonic", "6")
        self.refused("--freqency: not expected; did you mean --frequency?",
                     "orbit", self.machine, "--freqency=45")
        for command, word, own in [("orbit", "--rpm", "--frequency 1500rpm"), ("orbit", "--speed", "--frequency 1500rpm"),
                                   ("check", "--frequency", "--from 1500rpm"), ("response", "--step", "--count")]:
            self.refused(f"{word}: not expected; did you mean {own}?", command, self.machine, word, "25")
        self.refused("orbits: not expected; did you mean orbit?; subcommands: check, orbit, contact, response",
                     "orbits", self.machine, *ORBIT)

    def test_ignored_options(self):
        branch = "is of a branch of solutions; give --harmonics M"
        for command, words, options in [
                ("orbit rk8pd", "is for ", "harmonics 6, samples 64, newton-tolerance 1e-9, subharmonic 2, step 1e-5"),
                ("orbit rk4", "is for ", "harmonics 6, subharmonic 2, local-error 1e-9"),
                ("orbit splitting", "is for ", "harmonics 6, subharmonic 2, local-error 1e-9"),
                ("orbit auto", "is for ", "subharmonic 2"),
                ("orbit shooting", "is for ", "harmonics 6, samples 64, newton-tolerance 1e-9, step 1e-5, longest 3"),
                ("orbit aft", "is for ", "local-error 1e-9, step 1e-5, longest 3"),
                ("response auto", branch, "stability, save a, isolated 3, subharmonic 2, waterfall a, harmonics-of x_r, times"),
                ("response aft", "is for a sweep", "longest 3, resume a"),
                ("response shooting", "is for a sweep", "longest 3, resume a")]:
            name, method = command.split()
            speeds = {"orbit": ORBIT, "response": RESPONSE}[name]
            for option in options.split(", "):
                first, *value = f"--{option}".split()
                self.refused(f"{first}: {words}", name, self.machine, *speeds, "--method", method, first, *value)
        two = self.file("two.toml", MACHINE.replace("cage_speed_ratio = 0.5", "cage_speed_ratio = 0.39"))
        self.refused("one of them with two frequencies", "orbit", two, *ORBIT, "--harmonics", 3, "--tolerance", 1e-8)
        self.refused_each([("--count 1", "--count 1: is for --from equal to --to"), ("--seed 20", "--seed requires --isolated"),
                           ("--at 20", "--at requires --restart"), ("--branch 20", "--branch requires --restart")],
                          "response", self.machine, *RESPONSE)

    def test_help_and_version(self):
        help_of_orbit = "\n".join(self.lines("orbit", "--help"))
        for name in ["aft", "rk4", "splitting", "rkf45", "rkck", "rk8pd", "msadams", "msbdf", "bsimp"]:
            self.assertIn(name, help_of_orbit)
        version = re.search("project.*VERSION ([0-9.]+)", Path("CMakeLists.txt").read_text())[1]
        self.assertIn(version, self.lines("--version")[0])
        for arguments in [["--help"], ["orbit", "--help"], ["--version"], ["orbit", self.machine, *ORBIT]]:
            with open("/dev/full", "w") as full:
                self.refused("standard output", *arguments, status=3, stdout=full)

    def test_budget(self):
        """It bounds all commands, and is named with what was reached."""
        for how in (["--method", "aft"], [], ["--method", "rk4"]):  # the motion may take 0.7 of the budget, the rest is for what is said of it
            self.refused("the budget of 1e+03 evaluations of the force is used up; more with --budget 4e+03",
                         "orbit", self.machine, *ORBIT, *how, "--budget", "1e3", status=3)
        table = self.table("orbit", self.machine, *ORBIT, "--method", "rk4", "--step", "2e-5", "--budget", "1e7")
        transient, spent, budget = (table.value(key) for key in ("transient", "evaluations", "budget"))
        self.assertEqual(budget, 1e7)
        # Four evaluations a step in the transient; the verdict, and half the step for the error, take less than four times as much.
        self.assertTrue(1 <= spent / (4 * transient / 2e-5) < 5, (spent, transient))
        for seconds in ("0s", "s", "-1s", "1e9s", "1 s"):
            self.refused(f"--budget {seconds[:-1]}: must be", "orbit", self.machine, *ORBIT, "--budget", seconds)
        self.refused("the budget of 0.001s is used up; more with --budget 0.004s", "orbit", self.machine, *ORBIT, "--budget",
                     "0.001s", status=3)
        result = self.run_explore("response", self.machine, "--from", "1", "--to", "60", "--harmonics", 6, "--budget", "3e5")
        self.assertEqual(result.returncode, 3)
        self.assertRegex(result.stderr, r"stopped at [0-9.]+ Hz, before --to 60 Hz: the budget .* --budget")
