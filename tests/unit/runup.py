"""explore runup: a linear rotor integrated apart, motions at fixed speeds, the direction of the change, and what is refused.
"""
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

from tests.support.explore import MACHINE, Case, Table

MASS, FREQUENCY, RATIO, UNBALANCE = 40.0, 150.0, 0.02, 0.05
WIDE = MACHINE.replace("radial_clearance_m = 2e-5", "radial_clearance_m = 1")


def linear(first, last, seconds, per_second=200000):
    """The rotor alone, of complex place z = x + iy at rest in its static place: m z'' + c z' + k z = m_e e (w^2 - i a) e^{i phi} - i m g.
    z less its static place, phi and time at many instants."""
    rate, c, k = 2 * np.pi * (last - first) / seconds, 2 * RATIO * FREQUENCY, FREQUENCY**2

    def slope(t, y):
        w, phi = 2 * np.pi * first + rate * t, 2 * np.pi * first * t + rate * t**2 / 2
        return [y[1], UNBALANCE / MASS * (w**2 - 1j * rate) * np.exp(1j * phi) - c * y[1] - k * y[0]]

    t = np.linspace(0, seconds, int(seconds * per_second) + 1)
    z = solve_ivp(slope, (0, seconds), np.zeros(2, complex), method="DOP853", t_eval=t, rtol=1e-9, atol=1e-14).y[0]
    return z, 2 * np.pi * first * t + rate * t**2 / 2, t


class RunUp(Case):
    def test_a_linear_rotor(self):
        """Every turn from standstill through the resonance at 23.9 Hz within 1e-3 of an integration of another code. Would catch a
        force that lacks the angular acceleration or turns the wrong way, and turns that are cut elsewhere."""
        table = self.table("runup", self.file("wide.toml", WIDE), "--from", 0, "--to", 40, "--seconds", 4)
        z, phi, t = linear(0, 40, 4)
        self.assertEqual(len(table), 80)
        step = 2 * np.pi / 256  # a turn of the table ends with a step
        for k in range(80):
            shorter, longer = ((phi >= 2 * np.pi * k + a) & (phi <= 2 * np.pi * (k + 1) + b) for a, b in ((step, 0), (0, step)))
            for name, place in (("amp_x_r", z.real), ("amp_y_r", z.imag)):
                self.assertGreater(table[name][k], np.ptp(place[shorter]) / 2 * (1 - 1e-3), (name, k))
                self.assertLess(table[name][k], np.ptp(place[longer]) / 2 * (1 + 1e-3), (name, k))
            self.assertAlmostEqual(t[longer].mean(), table["t"][k], delta=0.01 * t[longer][-1])
        self.assertFalse(table["contact_share"].any())
        self.assertGreater(table.value("peak_f"), FREQUENCY / 2 / np.pi)

    def test_a_slow_run_passes_the_steady_motions(self):
        """Within 1 % between 40 and 44 Hz in two minutes, in both directions, also with a damped contact and a cage without a
        common period. Would catch a cage that turns at another speed than the rotor's share."""
        for text in (MACHINE, MACHINE.replace("balls = 16", "balls = 16\ncontact_damping_s_per_m = 0.3")
                     .replace("cage_speed_ratio = 0.5", "cage_speed_ratio = 0.4375")):
            machine = self.file("one.toml", text)
            steady = self.table("response", machine, "--from", 40, "--to", 44, "--count", 5)
            for ends in ((40, 44), (44, 40)):
                run = self.table("runup", machine, "--from", ends[0], "--to", ends[1], "--seconds", 120)
                order = np.argsort(run["f"])
                found = np.interp(steady["f"][1:-1], run["f"][order], run["amp_x_r"][order])
                np.testing.assert_allclose(found, steady["amp_x_r"][1:-1], rtol=0.01)

    def test_lines_of_a_slow_run(self):
        """The lines of every 16 turns near 42 Hz, slowly, are those of the steady motion there, up and down. Would catch angles that
        are not the rotor's, and a window whose sum is not one."""
        steady = self.table("spectrum", self.machine, "--frequency", 42)
        for ends in ((41.5, 42.5), (42.5, 41.5)):
            self.lines("runup", self.machine, "--from", ends[0], "--to", ends[1], "--seconds", 30, "--waterfall", "lines.tsv")
            lines = Table(self.folder / "lines.tsv")
            speeds = lines["f"] / lines["order"]
            near = lines.rows(abs(speeds - speeds[abs(speeds - 42).argmin()]) < 1e-6)
            self.assertEqual(near["name"][0], "1X")
            for name in ("1X", "2X"):
                for column in ("x_s", "y_r"):
                    self.assertAlmostEqual(near.where("name", name).first(column) / steady.where("name", name).first(column), 1, delta=0.02)
        self.refused("--waterfall: needs 16 turns", "runup", self.machine, "--from", 0, "--to", 30, "--seconds", 1, "--waterfall", "a.tsv")

    def test_the_direction_decides(self):
        """A rotor that meets its balls near the resonance is pressed against them up to 43 Hz on the way up and to 25 Hz on the way
        down, as the steady motions in either direction are."""
        machine = self.file("vertical.toml", Path("data/vertical.toml").read_text(encoding="utf-8"))
        up = self.table("runup", machine, "--from", 10, "--to", 60, "--seconds", 50)
        down = self.table("runup", machine, "--from", 60, "--to", 10, "--seconds", 50)
        self.assertAlmostEqual(up.value("peak_f"), 43.2, delta=0.6)
        self.assertAlmostEqual(down.value("peak_f"), 25, delta=0.7)
        self.assertGreater(up.value("peak_x_r"), 1.8 * down.value("peak_x_r"))
        self.assertEqual(up["contact_share"][0], 0)

    def test_what_is_refused(self):
        for words, *options in (
                ("--from 10: must differ", "--from", 10, "--to", 10, "--seconds", 1), ("--from -1", "--from", -1, "--to", 9, "--seconds", 1),
                ("--seconds 0", "--from", 1, "--to", 9, "--seconds", 0), ("is less than a turn", "--from", 0, "--to", 1, "--seconds", 1),
                ("more than 1048576", "--from", 1, "--to", 1e4, "--seconds", 1e4)):
            self.refused(words, "runup", self.machine, *options)
        self.refused("the budget", "runup", self.machine, "--from", 1, "--to", 50, "--seconds", 5, "--budget", 1e4, status=3)
