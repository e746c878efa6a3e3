"""Studies of many points: what Snakemake makes of a file in studies/, when it is left alone, when a job fails and when it
is killed; and what the studies' own scripts compute from what explore prints.
"""
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import types
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

import adaptive
import attractors
import bound
import identification
import map_scaling
import sampling
import sensitivity
import validity
import verdicts
from sensitivity_derivatives import derivative
from tables import displacement_errors
from stability import rows_of
from tests.truth.independent import displacements, errors
from tests.support.explore import EXPLORE, FULL, Case, Table

STUDY = """machine: {machine}
x: frequency=20:50:5
y: bearing.radial_clearance_m=0:1e-4:7
quantities: [amplitude, contact_share]
options: --harmonics 6
shards: {shards}
minutes: 1
"""


def computed_anew(study, changes):
    """The table of a study, of its scene with these changes, each of which must have a place there."""
    scene = Path(f"data/scenes/{study}.toml").read_text(encoding="utf-8")
    for old, new in changes:
        if old not in scene:
            raise AssertionError(f"{old} is not in the scene of {study}")
        scene = scene.replace(old, new)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, f"{study}.toml")
        file.write_text(scene, encoding="utf-8")
        return Table.of(subprocess.run([sys.executable, f"studies/{study}.py", file], capture_output=True, check=True,
                                       text=True).stdout)


@unittest.skipUnless(shutil.which("snakemake"), "needs the Debian package snakemake")
class Shards(Case):
    """A study in a folder of its own, of a machine whose name the shell would take apart."""

    def setUp(self):
        super().setUp()
        shutil.copytree("studies", self.folder / "studies")
        self.machine = self.machine.rename(self.folder / "my $(machine).toml")
        whole = self.lines("map", self.machine, "--x", "frequency=20:50:5", "--y", "bearing.radial_clearance_m=0:1e-4:7",
                           "--quantity", "amplitude,contact_share", "--harmonics", 6)
        self.whole = "".join(f"{line}\n" for line in whole)

    def study(self, shards, program=EXPLORE, **how):
        """Snakemake at work on the study; its merged table."""
        self.file("studies/mine.yaml", STUDY.format(machine=self.machine, shards=shards))
        return subprocess.Popen(["snakemake", "--snakefile", "studies/Snakefile", "--cores", "2", "--rerun-incomplete",
                                 "build/studies/mine/map.tsv"], cwd=self.folder, stdout=subprocess.DEVNULL,
                                stderr=subprocess.DEVNULL, env={**os.environ, "EXPLORE": str(program)}, **how)

    def table(self):
        return (self.folder / "build/studies/mine/map.tsv").read_text(encoding="utf-8")

    def test_shards(self):
        """Would catch a line that is left out or twice at the edge of a shard, and a header within the rows."""
        for shards in (1, 3, 7):
            self.assertEqual(self.study(shards).wait(), 0)
            self.assertEqual(self.table(), self.whole, shards)
            shutil.rmtree(self.folder / "build")

    def test_killed(self):
        """A program that dies within a shard, then a controller that is killed with all it started: what is there is
        whole shards, and going on gives the same bytes. Would catch a half-written shard that counts."""
        dying = self.file("dying", f'#!/bin/sh\ncase "$*" in *0:2*) {EXPLORE} "$@" | head -c 900; kill -9 $$;; '
                          f'*) sleep 1; exec {EXPLORE} "$@";; esac\n')
        dying.chmod(0o755)
        self.assertNotEqual(self.study(3, dying).wait(), 0)
        self.assertFalse((self.folder / "build/studies/mine/0-2.tsv").exists())
        slow = self.file("slow", f'#!/bin/sh\nsleep 2\n{EXPLORE} "$@"\nsleep 600\n')
        slow.chmod(0o755)
        controller = self.study(3, slow, start_new_session=True)
        time.sleep(6)
        os.killpg(controller.pid, signal.SIGKILL)
        controller.wait()
        subprocess.run(["snakemake", "--snakefile", "studies/Snakefile", "--unlock", "build/studies/mine/map.tsv"],
                       cwd=self.folder, check=True, capture_output=True)
        self.assertEqual(self.study(3).wait(), 0)
        self.assertEqual(self.table(), self.whole)


class Sensitivity(unittest.TestCase):
    def setUp(self):
        self.study = sensitivity.Study("data/scenes/sensitivity.toml")

    def test_masses(self):
        """The total at fixed ratio, the ratio at fixed total; the default is none of them changed."""
        for parameter, value, masses in [("mass", 90, (30, 60)), ("mass_ratio", 3, (15, 45)), ("mass", 60, (20, 40))]:
            np.testing.assert_allclose(self.study.varied(parameter, value).masses_and_cage[:2], masses)
        self.assertEqual(self.study.varied("samples", 50), self.study.usual)
        self.assertEqual(self.study.varied("step", 2e-5), self.study.usual)

    def test_peak(self):
        """Both bodies as one mass on both suspensions, driven by m_e e omega^2: with omega_0^2 = K/M and zeta = C/(2 M
        omega_0) the peak is at omega_0/sqrt(1 - 2 zeta^2). Would catch masses or keys in the wrong place."""
        stator, rotor = 50.0, 10.0  # m_r/m_s = 0.2
        stiffness = stator * 500**2 + rotor * 150**2
        damping = 2 * (0.05 * stator * 500 + 0.02 * rotor * 150)
        omega = np.sqrt(stiffness / (stator + rotor))
        zeta = damping / (2 * (stator + rotor) * omega)
        expected = omega / np.sqrt(1 - 2 * zeta**2) / (2 * np.pi)
        amplitude = 0.05 / (2 * (stator + rotor) * zeta * np.sqrt(1 - zeta**2))
        frequency, height = self.study.peak(self.study.varied("mass_ratio", 0.2), True)
        self.assertAlmostEqual(frequency / expected, 1, delta=0.01)
        self.assertAlmostEqual(height / amplitude, 1, delta=0.05)

    def test_losses(self):
        """In the band of Fig. 3, between neighbours of the raster; never where gravity holds the bearing."""
        self.study.scene["contact_loss_hz"] = {"from": 11.0, "to": 15.0, "step": 1.0}
        (first, uncertainty), (last, _) = self.study.losses(self.study.usual)
        self.assertTrue(12 < first < 13 and 14 < last < 15, (first, last))
        self.assertEqual(uncertainty, 0.5)
        self.study.scene["contact_loss_hz"] = {"from": 2.0, "to": 4.0, "step": 1.0}
        self.assertEqual(self.study.losses(self.study.varied("mass", 60.1)), ((-1, 0), (-1, 0)))

    def test_integrated_size(self):
        """At 13.4 Hz the default is chaotic, and 30 kg of mass have the period of rotation. Would catch a motion that is
        printed over other periods, and a regime that is read from another key."""
        for mass, size, most, is_periodic in [(60, (8.209e-5, 7.775e-5), 3e-3, 0), (30, (1.466564e-4, 1.501652e-4), 1e-5, 1)]:
            x, y, lyapunov, periodic = self.study.integrated_size(self.study.varied("mass", mass))
            np.testing.assert_allclose((x[0], y[0]), size, rtol=most)
            self.assertEqual((periodic, lyapunov < 0), (is_periodic, bool(is_periodic)))

    def test_derivatives_of_a_power_law(self):
        """Its exponents; the nearest values that have the output, or the default and one side."""
        table = Table.of("parameter\tvalue\tunit\tdefault\tf_peak\tf_loss_first\terror_f_loss_first\n" + "".join(
            f"mass\t{value}\tkg\t{usual}\t{5 * value**3}\t{loss}\t0.1\n" for value, usual, loss in
            [(1, 0, 1), (1.8, 0, -1), (2, 1, 2**-0.5), (2.3, 0, -1)]))
        np.testing.assert_allclose(derivative(table, "f_peak"), (3, 0, 1.8, 2.3), atol=1e-12)
        slope, uncertainty, low, high = derivative(table, "f_loss_first")
        self.assertAlmostEqual(slope, -0.5)
        self.assertAlmostEqual(uncertainty, (0.1 + 0.1 * 2**0.5) / np.log(2))
        self.assertEqual((low, high), (1, 2))

    def test_crests(self):
        """Of a sine between its samples, to the fourth order of their distance."""
        phase = 2 * np.pi * np.arange(40 * 5) / 40
        np.testing.assert_allclose(sensitivity.crests(3 * np.sin(phase + 0.07), 40), 3, rtol=2e-5)

    def test_mean_and_error(self):
        """Ten blocks of equal values: their mean, and the standard error of ten numbers."""
        values = np.repeat(np.arange(10.0), 20)
        mean, error = sensitivity.mean_and_error(values)
        self.assertAlmostEqual(mean, 4.5)
        self.assertAlmostEqual(error, np.arange(10).std(ddof=1) / np.sqrt(10))


class Adaptive(unittest.TestCase):
    MACHINE = "data/set1.toml"

    def test_errors_of_a_known_motion(self):
        """Against a sine of 1 about 9: 0.05 more of it is 0.5 % of the largest displacement and 5 % about the mean; a
        shift of 0.2 is 2 % and nothing about the mean. Would catch one norm alone, and a mean that counts."""
        sine = np.sin(2 * np.pi * np.arange(64) / 64)
        exact, larger, shifted = ({name: q for name in ("x_s", "y_s", "x_r", "y_r")}
                                  for q in (9 + sine, 9 + 1.05 * sine, 9.2 + sine))
        np.testing.assert_allclose(displacement_errors(larger, exact), (0.05, 0.005), rtol=1e-9)
        np.testing.assert_allclose(displacement_errors(shifted, exact), (0, 0.02), atol=1e-12)

    def test_row(self):
        """At 30 Hz the estimate is within what is asked of it, and no fixed m of the row does as well for half its cost;
        what is not reached (at 13.5 Hz the machine is chaotic) has no numbers. Would catch words of another line of the header."""
        loose, = adaptive.rows_of(self.MACHINE, 30, [1e-3], 64)
        lost = adaptive.rows_of(self.MACHINE, 13.5, [1e-8], 8)[0] if FULL else adaptive.chosen(self.MACHINE, 13.5, 1e-8, None)
        self.assertTrue(loose["reached"] and 0.3 < loose["effectivity"] < 10 and loose["error"] < 1e-3, loose)
        self.assertTrue(loose["error_fixed"] <= loose["error"] and loose["m_fixed"] > 0 and 0 < loose["ratio"] < 2, loose)
        self.assertEqual((lost["reached"], lost["m"], lost["cost"], lost["ratio"]), (0, -1, -1, -1))

    def test_another_motion(self):
        """At 24 Hz shooting alone closes a mirrored motion, and 256 harmonics an unstable one 0.2 % away; the solutions keep
        their own."""
        row, = adaptive.rows_of(self.MACHINE, 24, [1e-3], 64)
        self.assertLess(row["error"], 1e-3)
        self.assertEqual(row["own_branch"], 0)


class Maps(unittest.TestCase):
    """What the page says of the maps, for maps of which it is known."""

    def test_border(self):
        """An error of (δ/20 µm)² (K_H/1e11) per cent has its border at 20 µm for 1e11, at 6.3 µm for 1e12, and is 250 % in the
        corner; a point without result counts neither way. Would catch keys that are mixed up, and missing cells taken for right ones."""
        errors = [(delta, level, 0.01 * (delta / 2e-5)**2 * level / 1e11) for level in np.geomspace(1e10, 1e12, 21) for delta in np.linspace(0, 1e-4, 1001)]
        rows = [f"{delta:.9g}\t{level:.9g}\t0.01\t50\t0.5\t{error if delta else '-'}\tok\t{(1.2 if delta > 5e-5 else 1) * error}"
                for delta, level, error in errors]
        names = [map_scaling.DELTA, map_scaling.STIFFNESS, "peak", "peak_frequency", "permanent", "error", "status", "error_back"]
        said = map_scaling.of_stiffness(Table.of("\n".join(["# frequency: 30", "\t".join(names), *rows])))
        self.assertAlmostEqual(said["first_um"], 6.4, delta=0.01)
        self.assertAlmostEqual(said["worst"], 2.5)
        self.assertAlmostEqual(said["open"], 1 / 1001)
        self.assertAlmostEqual(said["moved"], 0.5)

    def test_shares(self):
        """Ten points: the shares add to one, and the loss of contact is counted among the aperiodic ones alone."""
        cells = [(10, 1e-5, 1, 1), (20, 1e-5, 2, 1), (30, 1e-5, 1, 0.9), (10, 2e-5, 0, 1), (20, 2e-5, 0, 0.5), (30, 2e-5, 0, 0.5),
                 (10, 3e-5, -1, 1), (20, 3e-5, -2, 0.5), (30, 3e-5, 0, 0.5), (40, 3e-5, 8, 0.5)]
        rows = ["\t".join(f"{cell:g}" for cell in row) + "\tok" for row in cells]
        said = map_scaling.of_speeds(Table.of("\n".join(["\t".join([map_scaling.X, map_scaling.DELTA, "period", "contact_share", "status"]), *rows])))
        for name, value in {"once": 0.2, "more": 0.2, "aperiodic": 0.4, "quasi": 0.1, "open": 0.1, "first_um": 20, "unlost": 0.25,
                            "lost_closed": 2 / 6, "band_from": 20, "band_to": 40}.items():
            self.assertAlmostEqual(said[name], value, msg=name)

    def test_page_on_paper(self):
        """A thousand million points of a tenth of a second on 100 cores in shards of ten minutes: 1e8 s of work, 11.6 days."""
        self.assertEqual(map_scaling.written(1e8 / 100), "12 days")
        self.assertEqual([map_scaling.written(s) for s in (30, 90, 7200, 3.2e8)], ["30 s", "1.5 minutes", "2 hours", "10 years"])


class Sampling(Case):
    SCENE = {"samples_over_m": [2, 3], "fine_over_m": 128, "reference_harmonics": 256}

    def test_the_usual_number_samples_finer_than_the_series_is_truncated(self):
        """Up to 64 harmonics; 2m+1 samples do not. Would catch errors of the wrong pair of orbits."""
        for machine, speed in (("data/set1.toml", 6), ("data/set2.toml", 45)):
            for m in (6, 64):
                rows = np.array(sampling.rows_of(machine, speed, m, self.SCENE)[1])
                usual, few = rows[rows[:, 2] == 1][0], rows[0]
                self.assertEqual((usual[1], few[1]), (sampling.fast_size(8 * m + 1), sampling.fast_size(2 * m + 1)))
                self.assertTrue((usual[5:7] < usual[8:10]).all(), (machine, m))
                self.assertGreater(few[4], usual[4])

    def test_the_error_falls_in_the_order_of_truncation(self):
        """With the default N. With 8m+1 samples the orders are 2.7 (largest error) and 2.5 (rms); 7/2 and 4 are those of a force that
        begins as d^(3/2). Would catch a default N that grows more slowly than m^(7/5) or m^(8/5)."""
        def motion(m, *samples):
            return displacements(self.table("orbit", self.machine, "--frequency", 30, "--points", 2048, "--no-stability",
                                            "--newton-tolerance", 1e-12, "--budget", 1e11, "--harmonics", m, *samples))

        truth, sizes = motion(1024, "--samples", 2**16), np.array([64, 96, 128, 192, 256, 384, 512])
        # At m = 32 a resonance of the contact adds a hundred times as much.
        self.assertLess(errors(motion(32), truth)[0], 50 * 32**-3.5)
        fine = np.array([errors(motion(m), truth) for m in sizes])
        coarse = np.array([errors(motion(m, "--samples", sampling.fast_size(8 * m + 1)), truth) for m in sizes])
        self.assertTrue((fine[:, 0] < 50 * sizes**-3.5).all(), fine)
        orders, coarse_orders = (-np.polyfit(np.log(sizes), np.log(off), 1)[0] for off in (fine, coarse))
        self.assertTrue((orders > (3.5, 3.9)).all() and (coarse_orders < 3).all(), (orders, coarse_orders))

    def test_fast_sizes(self):
        """The even numbers without a factor above 7, up to 40."""
        self.assertEqual(sorted({sampling.fast_size(k) for k in range(1, 41)}),
                         [2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 24, 28, 30, 32, 36, 40])


def table_of(header="", **columns):
    """A table with these columns."""
    rows = ["\t".join(columns), *("\t".join(f"{cell:.12g}" for cell in row) for row in zip(*columns.values()))]
    return Table.of(header + "\n".join(rows))


class Attractors(unittest.TestCase):
    def test_rows(self):
        """Two motions at one speed: both points of the first, three of the second, which does not close. Would catch the
        points of another motion or speed."""
        motions = table_of(f=[20, 20], **{name: [k, k + 0.5] for k, name in enumerate(attractors.OF_MOTION)} | {"motion": [1, 2]})
        section = table_of(f=[20] * 7 + [21], motion=[1, 1, 2, 2, 2, 2, 2, 1], **{name: range(8) for name in attractors.OF_POINT})
        rows = list(attractors.rows_of(motions, section, 3))
        self.assertEqual([(row[1], row[-5], row[-4]) for row in rows], [(1, 1, 0), (1, 2, 1), (2, 1, 2), (2, 2, 3), (2, 3, 4)])
        self.assertEqual({len(row) + 1 for row in rows}, {len(attractors.COLUMNS)})
        self.assertEqual([row[2] for row in rows], [1, 1, 1.5, 1.5, 1.5])


class Validity(unittest.TestCase):
    def motion(self, size, turns=1, shift=0.0, header=""):
        """A circle, whose centre is shifted, and a force of one harmonic."""
        t = 2 * np.pi * np.arange(8 * turns) / 8
        x, y = size * np.cos(t) + shift, size * np.sin(t)
        return table_of(header, x_s=x, y_s=y, x_r=x, y_r=y, F_x=2 * x, F_y=3 * y)

    def test_row(self):
        """The nearer of two motions, one over two turns and shifted, which the rms error does not see. Would catch an error over
        the solution's size or along the first turn alone."""
        solution = self.motion(1.0, header="# harmonics: 6\n# stability: unstable\n# error_largest: 0.1\n# error_rms: 0.2\n")
        known = [(1, self.motion(2.0)), (2, self.motion(1.25, 2, 0.5))]
        row = validity.row_of(solution, known, True)
        np.testing.assert_allclose(row, [6, 1, 0.2, 0.2, 0, 0, 0.2, 1, 0.75 / 1.75], atol=0.02)
        self.assertEqual(validity.row_of(solution, known[:1], False)[4:8], [1, 0, -1, 1])
        self.assertEqual(validity.row_of(solution, known[1:], False)[7], 0)
        nothing = validity.row_of(None, known, True)
        self.assertEqual(nothing, [0, 0, -1, -1, 0, -1, -1, 1, -1])
        self.assertEqual({len(nothing), len(row)}, {len(validity.COLUMNS) - 3})

    def test_kept(self):
        """Two speeds of set 1 anew, with permanent contact and one motion. Would catch cells in another order, and rows that
        depend on the speeds around them."""
        kept = Table("data/reference/validity.tsv").where("set", 1)
        table = computed_anew("validity", [(', "set2"', ""), ("from = 1.0, to = 60.0", "from = 45.0, to = 45.5"),
                                           ("random_starts = 4", "random_starts = 0")])
        kept = kept.rows((kept["f"] >= 45) & (kept["f"] <= 45.5))
        self.assertEqual(list(table.columns), list(kept.columns))
        for name in kept.columns:
            np.testing.assert_allclose(table[name], kept[name], rtol=1e-4, err_msg=name)


class Verdicts(unittest.TestCase):
    def test_rows(self):
        """Of a solution that is judged, one without a motion near it, and none at all."""
        names = verdicts.QUANTITIES
        judged = verdicts.row(dict(zip(names, "0.9 1e-6 stable 0.01 5000 1.2 1e-7 unstable".split())))
        self.assertEqual(judged, "1 0.9 1e-6 1 0.01 5000 1.2 1e-7 0".split())
        alone = verdicts.row(dict(zip(names, "- - undecided - 5000 1.2 1e-7 undecided".split())))
        self.assertEqual(alone, "1 -1 -1 -1 -1 5000 1.2 1e-7 -1".split())
        none = verdicts.row(dict.fromkeys(names, "-"))
        self.assertEqual(none, "0 -1 -1 -1 -1 0 -1 -1 -1".split())
        self.assertEqual(len(none) + 3, len(verdicts.COLUMNS))

    def test_kept(self):
        """The first two speeds anew, with the fewest harmonics. Would catch quantities in another order, and solutions
        that start from their neighbours."""
        kept = Table("data/reference/verdicts.tsv").where("set", 1).where("m", 6)
        table = computed_anew("verdicts", [(", \"set2\"", ""), ("59.73", "1.73"), ("[6, 10, 24, 64]", "[6]")])
        self.assertEqual(list(table.columns), list(kept.columns))
        for name in ("f", "machine", "machine_stable", "distance", "series", "series_stable"):
            np.testing.assert_allclose(table[name], kept[name][:2], rtol=1e-4, err_msg=name)


class Answers(unittest.TestCase):
    def setUp(self):
        """peers/answers.py without the compiled equations, which `make peers` builds."""
        stub = types.SimpleNamespace(ROOT=Path("."), SIZE=8, Case=None, LIBRARY=None, pointer=None)
        with mock.patch.dict(sys.modules, equation7=stub), mock.patch.object(sys, "path", ["peers", *sys.path]):
            import answers
        self.answers = answers

    def test_readings(self):
        """Half peak-to-peak of a sine between its samples, and the fewest base periods after which a section repeats itself."""
        t = np.arange(0, 2 * np.pi + 0.1, 0.2)
        self.assertAlmostEqual(self.answers.half_range(3 + np.sin(t + 0.05), np.cos(t + 0.05), 0.2), 1, delta=1e-5)
        self.assertGreater(1 - np.ptp(np.sin(t + 0.05)) / 2, 1e-4)  # the samples alone
        section = np.zeros((32, 4))
        self.assertEqual(self.answers.closing(section, 1, 16, 1e-3), 1)
        section[::3] = 1
        self.assertEqual(self.answers.closing(section, 1, 16, 1e-3), 3)
        section[:, 0] += np.sqrt(2) * np.arange(32)
        self.assertEqual(self.answers.closing(section, 1, 16, 1e-3), 0)

    def test_kept(self):
        """Every question, method and target; our commands keep the two looser targets in the median. Would catch a table of another
        scene, and errors that are not ours."""
        table = Table("data/reference/tab03_answers.tsv")
        for question in "abcd":
            for target in (1e-2, 1e-3, 1e-5):
                rows = table.where("question", question).where("target", target)
                self.assertLessEqual({"this", "cvode", "rk4", "scipy-lsoda", "scipy-dop853"}, set(rows["method"]))
                if target > 1e-5:
                    self.assertLessEqual(float(rows.where("method", "this").first("error")), target)


class ABound(unittest.TestCase):
    """The argument of bound.py, where the answer is known otherwise."""
    INSTANTS, CELLS, TIMES = 8192, 512, 64

    def at_45_hz(self, m):
        """A solution of data set 1, with its orbit."""
        scene = {"parameters": "set1", "frequency_hz": 45.0, "points": 4096}
        orbit = bound.orbit(scene, harmonics=m)
        return bound.Solution(bound.Machine("data/set1.toml", 45), orbit, m, self.INSTANTS), orbit

    def test_without_contact_it_is_the_error(self):
        """A clearance that is never closed: the motion is a closed form, and of a solution with wrong harmonics the bound is what they
        are off. Would catch a wrong residual, load or inverse."""
        machine = bound.Machine("data/set1.toml", 45)
        machine.clearance = 1.0
        phi = 2 * np.pi * np.arange(64) / 64
        whirl = machine.unbalance / (machine.stiffness[2] - machine.mass[2] + 1j * machine.damping[2])
        sag = machine.weight / machine.stiffness
        exact = [0 * phi + sag[0], 0 * phi + sag[1], (whirl * np.exp(1j * phi)).real + sag[2], (whirl * np.exp(1j * phi)).imag + sag[3]]
        off = [1e-6 * np.sin(phi + 1), 2e-6 * np.cos(2 * phi), 3e-6 + 0 * phi, 5e-6 * np.sin(3 * phi) + 1e-6]
        found = bound.Bound(bound.Solution(machine, dict(zip(bound.NAMES, np.add(exact, off))), 3, self.INSTANTS), self.CELLS, self.TIMES)
        self.assertTrue(found.closes)
        self.assertEqual(found.remainder, 0)
        self.assertAlmostEqual(found.bound / 6e-6, 1, delta=1e-5)

    def test_greens_function(self):
        """With contact, the integral over all s of G times the residual is e1. Would catch a wrong side of s = t and a wrong sign."""
        solution, _ = self.at_45_hz(16)
        line = bound.Linearisation(solution)
        s, t = np.arange(line.steps), np.array([0, 1000, line.steps // 2])
        answer = line.green(np.eye(4), t, s, -solution.residual[:-1:2]).sum(axis=2).T * 2 * solution.phi[1]
        np.testing.assert_allclose(answer, line.first[t], atol=1e-4 * np.abs(line.first).max())

    def test_the_force_is_within_its_bound(self):
        """What is left of a ball's force beside its linear part, and of its slope, at penetrations and changes of all sizes: never above
        the bound of the largest change, and at it somewhere in each case, out of contact, near its border and pressed."""
        alpha = 0.3
        z, a = np.meshgrid(np.linspace(-1, 1, 201), np.linspace(-alpha, alpha, 101), indexing="ij")
        root, changed = np.sqrt(np.maximum(z, 0)), np.sqrt(np.maximum(z + a, 0))
        for order, values in enumerate((changed**3 - root**3 - 1.5 * root * a, 1.5 * abs(changed - root))):
            most, bounds = values.max(axis=1), bound.largest(z[:, 0], z[:, 0], alpha, order)
            self.assertTrue((most <= bounds + 1e-12).all())
            for reached in z[:, 0] < -alpha, abs(z[:, 0]) < 1e-9, z[:, 0] > alpha + 1e-9:
                np.testing.assert_allclose(most[reached], bounds[reached], rtol=1e-9, atol=1e-12)
            wide = bound.largest(z[:, 0] - 0.0501, z[:, 0] + 0.0501, alpha, order)
            self.assertTrue((wide[5:-5] >= [bounds[k - 5:k + 6].max() - 1e-12 for k in range(5, 196)]).all())

    def test_second_order(self):
        """What shooting finds differs from the solution by e1 up to the remainder, which is far smaller; a solution that is too
        far away is not bounded."""
        solution, orbit = self.at_45_hz(64)
        line, argument = bound.Linearisation(solution), bound.Bound(solution, self.CELLS, self.TIMES)
        scene = {"parameters": "set1", "frequency_hz": 45.0, "points": 4096}
        truth = bound.orbit(scene, method="shooting", local_error=1e-13)
        error = np.column_stack([truth[name] - orbit[name] for name in bound.NAMES])
        self.assertTrue(argument.closes)
        self.assertLess(argument.remainder, 0.01 * argument.first)
        np.testing.assert_allclose(line.first[:-1], error, atol=argument.remainder + 1e-4 * argument.first)
        self.assertFalse(bound.Bound(self.at_45_hz(6)[0], self.CELLS, self.TIMES).closes)

    def test_rows(self):
        """Above the truth, with the last solution's bound too, and hardly above it where the argument closes; e1 alone is below it."""
        table = computed_anew("bound", [("[6, 39, 40, 64, 128, 512]", "[6, 40, 128]"), ("65536", "32768"), ("4096", "1024"), ("512 ", "128 ")])
        closed = table.rows(table["bound"] >= 0)
        np.testing.assert_array_equal(closed["m"], [40, 128])
        self.assertTrue((table["by_last"] >= table["truth"]).all() and (table["truth"] > 0.99 * table["estimate"]).all())
        self.assertTrue((closed["excess"] > 0).all() and (closed["excess"] < 0.03).all(), closed["excess"])
        self.assertLess(closed.first("first_order"), closed.first("truth"))
        np.testing.assert_allclose(closed["bound"], closed["truth"] * (1 + closed["excess"]), rtol=1e-4)


class Identification(unittest.TestCase):
    def setUp(self):
        self.base = identification.Base("data/set1.toml")

    def test_masses(self):
        """Those that lose contact at 10 and 19 Hz, put into the forces of the rigid joint: gravity and unbalance are equal
        there; the masses resonate at 50 Hz; that for 13.4 Hz is between. Would catch a wrong ratio of the masses."""
        gravity, unbalance = 9.81, 0.05
        masses = [self.base.mass_losing_at(50, speed) for speed in (10, 13.4, 19)]
        for mass, speed in zip(masses, (10, 13.4, 19)):
            stator, rotor = self.base.masses(mass, 50)
            k_s, k_r = stator * 500**2, rotor * 150**2
            self.assertAlmostEqual(np.sqrt((k_s + k_r) / (stator + rotor)) / (2 * np.pi), 50)
            omega = 2 * np.pi * speed
            static = gravity * abs(rotor - k_r * (stator + rotor) / (k_s + k_r))
            z_s = stator * (500**2 - omega**2 + 2j * 0.05 * 500 * omega)
            z_r = rotor * (150**2 - omega**2 + 2j * 0.02 * 150 * omega)
            self.assertAlmostEqual(abs(z_s / (z_s + z_r)) * unbalance * omega**2 / static, 1, delta=1e-5)
        self.assertEqual(masses, sorted(masses))
        np.testing.assert_allclose(self.base.ends(50, (10, 19)), masses[::2])
        least, largest = identification.Base("data/set1-as-printed.toml").ends(50, (10, 19))  # there a larger mass loses it at 17.6 Hz
        np.testing.assert_allclose((least, largest), (3.3982, 6.4593), rtol=1e-4)
        self.assertAlmostEqual(masses[1], 20.8, delta=0.2)

    def test_cages(self):
        """Of 16 balls that do not overlap, two cages have the period of rotation."""
        self.assertEqual(identification.accepted_cages(16), [0.5, 0.4375])
        self.assertEqual(identification.accepted_cages(3), [1 / 3])


class Stability(unittest.TestCase):
    def test_thinning_and_uncertainties(self):
        """A point without multipliers goes where its neighbour is near; a bifurcation gets its own uncertainty, in the
        order of the header. Would catch those of another point where a fold stands between."""
        names = "f amp_x_s amp_y_s amp_x_r amp_y_r arc multiplier multiplier_change verdict bifurcation".split()
        rows = [(20.0, 0.9, "stable", "-"), (20.05, -1, "undecided", "-"), (20.06, -1, "undecided", "fold"),
                (20.1, 1.0, "undecided", "period-doubling"), (20.3, -1, "undecided", "-"), (20.4, 1.0, "undecided", "plus-one")]
        text = "# row bifurcation: 1 period-doubling 20.1 1e-05\n# row bifurcation: 1 plus-one 20.4 0.002\n" + "\t".join(names) + "\n"
        text += "".join(f"{f}\t1\t1\t1\t1\t{f}\t{mu}\t1e-6\t{verdict}\t{kind}\n" for f, mu, verdict, kind in rows)
        found = rows_of(Table.of(text))
        self.assertEqual([row[0] for row in found], ["20", "20.06", "20.1", "20.3", "20.4"])
        self.assertEqual([row[-1] for row in found], ["0", "0", "1e-05", "0", "0.002"])
        self.assertEqual([row[-3] for row in found], ["1", "-2", "-1", "-2", "-1"])
