"""Studies of many points: what Snakemake makes of a file in studies/, when it is left alone, when a job fails and when it
is killed; and what the studies' own scripts compute from what explore prints.

Usage: tests/unit/studies.py   (from the project's root)
"""
import os
import shutil
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

import numpy as np

for folder in ("tests", "figures", "studies"):  # a study may be called like its figure
    sys.path.insert(0, folder)
import adaptive  # noqa: E402
import sensitivity  # noqa: E402
from sensitivity_derivatives import derivative  # noqa: E402
from stability import rows_of  # noqa: E402
from support.explore import EXPLORE, Case, Table  # noqa: E402

STUDY = """machine: {machine}
x: frequency=20:50:5
y: bearing.radial_clearance_m=0:1e-4:7
quantities: [amplitude, contact_share]
shards: {shards}
minutes: 1
"""


@unittest.skipUnless(shutil.which("snakemake"), "needs the Debian package snakemake")
class Shards(Case):
    """A study in a folder of its own."""

    def setUp(self):
        super().setUp()
        shutil.copytree("studies", self.folder / "studies")
        whole = self.lines("map", self.machine, "--x", "frequency=20:50:5", "--y", "bearing.radial_clearance_m=0:1e-4:7",
                           "--quantity", "amplitude,contact_share")
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
        self.assertAlmostEqual(adaptive.error_of(larger, exact), 0.05)
        self.assertAlmostEqual(adaptive.error_of(shifted, exact), 0.02)

    def test_row(self):
        """At 30 Hz the estimate is within what is asked of it, and no fixed m of the row does as well for half its cost;
        what is not reached has no numbers. Would catch words of another line of the header."""
        loose, lost = adaptive.rows_of(self.MACHINE, 30, [1e-3, 1e-8], 64)
        self.assertTrue(loose["reached"] and 0.3 < loose["effectivity"] < 10 and loose["error"] < 1e-3, loose)
        self.assertTrue(loose["error_fixed"] <= loose["error"] and loose["m_fixed"] > 0 and 0 < loose["ratio"] < 2, loose)
        self.assertEqual((lost["reached"], lost["m"], lost["cost"], lost["ratio"]), (0, -1, -1, -1))

    def test_another_motion(self):
        """At 24 Hz shooting alone closes a mirrored motion; the solutions keep their own."""
        row, = adaptive.rows_of(self.MACHINE, 24, [1e-2], 64)
        self.assertLess(row["error"], 1e-3)
        self.assertEqual(row["own_branch"], 0)
        self.assertGreater(row["m_fixed"], 0)


class Stability(unittest.TestCase):
    def test_thinning_and_uncertainties(self):
        """A point without multipliers goes where its neighbour is near; a bifurcation gets its own uncertainty, in the
        order of the header. Would catch those of another point where a fold stands between."""
        names = "f amp_x_s amp_y_s amp_x_r amp_y_r arc multiplier multiplier_change verdict bifurcation".split()
        rows = [(20.0, 0.9, "stable", "-"), (20.05, -1, "undecided", "-"), (20.06, -1, "undecided", "fold"),
                (20.1, 1.0, "undecided", "period-doubling"), (20.3, -1, "undecided", "-"), (20.4, 1.0, "undecided", "plus-one")]
        text = "# period-doubling: 20.1 +- 1e-05 Hz\n# plus-one: 20.4 +- 0.002 Hz\n" + "\t".join(names) + "\n"
        text += "".join(f"{f}\t1\t1\t1\t1\t{f}\t{mu}\t1e-6\t{verdict}\t{kind}\n" for f, mu, verdict, kind in rows)
        found = rows_of(Table.of(text))
        self.assertEqual([row[0] for row in found], ["20", "20.06", "20.1", "20.3", "20.4"])
        self.assertEqual([row[-1] for row in found], ["0", "0", "1e-05", "0", "0.002"])
        self.assertEqual([row[-3] for row in found], ["1", "-2", "-1", "-2", "-1"])


if __name__ == "__main__":
    unittest.main()
