"""What explore prints: its fixed columns, one method against another, branches that are saved, interrupted or
isolated, stability along a branch against that of single orbits, and attractors against orbits and the kept study.
"""
import math
import os
import re
import sys
from pathlib import Path

import numpy as np

from tests.truth.independent import displacements, errors
from tests.support.explore import AMPLITUDES, FULL, MACHINE, NAMES, SETS, TO_1E_3, Case, Table, changed, some

KEPT = Path("data/reference/attractors.tsv").resolve()
WHOLE = ["--from", "1", "--to", "60"]


def distances(section, states, row):
    """Of each point of a section from a state, over its largest displacement."""
    state = np.array([states[name][row] for name in NAMES])
    return [abs(state - [section[name][k] for name in NAMES]).max() / abs(state).max() for k in range(len(section))]


def row_difference(a, i, b, j):
    """Largest relative difference of speed and amplitudes in one row of each table."""
    return max(abs(a[n][i] / b[n][j] - 1) for n in ["f", *AMPLITUDES])


class Motion(Case):
    def orbit(self, file, frequency, *options):
        return self.table("orbit", file, "--points", 64, "--frequency", frequency, *options)

    def test_any_cage(self):
        """Set 1 with c = 0.43: more turns are the same motion, further on; contact adds up to the force of the orbit."""
        odd = self.file("odd.toml", changed(cage_speed_ratio=0.43))
        one, three = self.orbit(odd, 45, *TO_1E_3), self.orbit(odd, 45, *TO_1E_3, "--periods", 3)
        np.testing.assert_allclose(three["phase"], 2 * math.pi * np.arange(192) / 64, rtol=1e-12)
        np.testing.assert_array_equal(three["x_r"][:64], one["x_r"])
        self.assertEqual(list(one.columns), ["phase", "x_s", "y_s", "x_r", "y_r", "F_x", "F_y"])
        self.assertGreater(abs(three["F_x"][64:128] - three["F_x"][:64]).max(), 1)
        self.assertEqual((one.value("base"), one.value("method")), ("two", "aft"))
        self.assertIn("15,-1", one.members("harmonics")[0])
        self.assertEqual(one.value("harmonics") + 1, len(one.members("harmonics")[0]))  # and the mean
        self.assertTrue({"error_largest", "error_rms", "regime"} <= one.keys().keys())
        balls = self.table("contact", odd, "--points", 64, "--frequency", 45, *TO_1E_3)
        ball, turn = np.array(balls["ball"]), np.array(balls["t_over_T"])
        angle = 2 * math.pi * (0.43 * turn + (ball - 1) / 16)
        force = (np.array(balls["Q"]) * np.cos(angle)).reshape(-1, 16).sum(axis=1)
        np.testing.assert_allclose(force, three["F_x"][:128], rtol=1e-9, atol=1e-6)
        self.assertEqual((list(balls.columns), len(balls), balls["Q"].min()), (["t_over_T", "ball", "Q"], 2 * 64 * 16, 0))

    def test_few_instants_are_those_of_many(self):
        """Fewer than a series of 24 harmonics needs."""
        few, many = (self.table("orbit", self.machine, "--frequency", 45, "--harmonics", 24, "--points", points) for points in (8, 64))
        self.same(few, {name: many[name][::8] for name in NAMES}, 1e-12)

    def test_verdict_on_two_frequencies(self):
        """At 98.6 Hz with c = 0.4173 the torus has doubled, and integration leaves the one that has not."""
        for cage, frequency, is_doubled in [(0.43, 45.4, False), (0.4173, 98.6, True)]:
            odd = self.file("odd.toml", changed(cage_speed_ratio=cage))
            table = self.orbit(odd, frequency, *TO_1E_3)
            self.assertEqual(self.said(table, "stability", "regime", "stays"), ["stable", "quasi-periodic", "yes"])
            self.assertEqual(any(pair.endswith(",-0.5") for pair in table.members("harmonics")[0]), is_doubled)

    def test_a_torus_that_doubles_late(self):
        """With 7 balls the motion from rest leaves the torus of whole orders after some hundred turns; k_1 alone is then halved."""
        seven = changed(balls=7, cage_speed_ratio=0.3917)
        own = self.file("seven.toml", seven)
        table = self.orbit(own, 105, "--tolerance", 1e-3)
        self.assertEqual(self.said(table, "regime", "stability"), ["quasi-periodic", "stable"])
        self.assertLess(table.error("error"), 1e-3)

    def test_a_cage_that_repeats_after_two_turns_and_a_rotor_without_unbalance(self):
        half = changed(cage_speed_ratio=0.40625)
        table = self.orbit(self.file("half.toml", half), 45, "--harmonics", 6, "--periods", 4)
        self.assertEqual(table.value("base"), "turns 2")
        self.assertAlmostEqual(table.value("base_period"), 2 / 45, delta=1e-15)
        np.testing.assert_array_equal(table["x_r"][64:128], table["x_r"][:64])
        self.assertGreater(abs(table["x_r"][32:64] - table["x_r"][:32]).max(), 1e-9)
        integrated = self.orbit(self.file("half.toml", half), 45)
        self.assertEqual(integrated.value("base"), "turns 2")
        np.testing.assert_array_equal(table["phase"][:64], integrated["phase"])
        np.testing.assert_allclose(table["x_r"][:64], integrated["x_r"], rtol=0, atol=0.01 * np.ptp(integrated["x_r"]))
        still = self.file("still.toml", changed(cage_speed_ratio=0.43, unbalance_kg_m=0.0))
        table = self.orbit(still, 45, "--harmonics", 6)
        self.assertEqual(table.value("base"), "passing")
        self.assertAlmostEqual(table.value("base_period"), 1 / (45 * 16 * 0.43), delta=1e-15)
        # Also where a whole number of balls passes in a turn: six harmonics of a turn would all be zero.
        whole = self.file("whole.toml", changed(unbalance_kg_m=0.0))
        integrated, solved = (self.orbit(whole, 30, *how) for how in ([], ["--harmonics", 24]))
        self.assertEqual((integrated.value("base"), solved.value("base")), ("passing", "passing"))
        np.testing.assert_allclose(solved["y_r"], integrated["y_r"], rtol=0, atol=0.01 * np.ptp(integrated["y_r"]))


class Branch(Case):
    def response(self, *options):
        how = [] if {"--harmonics", "--restart"} & set(options) else ["--harmonics", 6]
        return self.table("response", self.machine, *WHOLE, *how, *options)

    def cut_off(self, *options):
        """A table that ends before its end, and why."""
        result = self.run_explore("response", *options)
        self.assertEqual(result.returncode, 3, result.stderr)
        return Table.of(result.stdout), result.stderr

    def test_the_advice_of_a_used_up_budget_arrives(self):
        """Set 2 with ten harmonics: a branch of a thousand folds, printed in part. What the message names goes further, and to the end."""
        options = [SETS[2], *WHOLE, "--harmonics", 10]
        table, why = self.cut_off(*options)
        found = re.search(r"stopped at (\S+) Hz, before --to 60 Hz: .*; more with --budget (\S+)$", why.strip())
        self.assertAlmostEqual(table["f"][-1] / float(found[1]), 1, delta=1e-5)
        self.assertEqual((table.value("complete"), len(table) > 10), ("no", True))
        whole = self.table("response", *options, "--budget", found[2])
        self.assertAlmostEqual(whole["f"][-1], 60)
        np.testing.assert_array_equal(whole["f"][:len(table)], table["f"])

    def test_to_a_tolerance_at_evenly_spaced_speeds(self):
        """Against shooting, which shares neither the orders nor their estimate; down as up."""
        for direction, speeds in [("up", np.linspace(28, 46, 7)), ("down", np.linspace(46, 28, 7))]:
            table = self.table("response", self.machine, "--from", 28, "--to", 46, *TO_1E_3, "--count", 7,
                               "--direction", direction)
            self.assertEqual(list(table.columns), ["f", *AMPLITUDES, "error"])
            np.testing.assert_allclose(table["f"], speeds, rtol=1e-12)
            self.assertLessEqual(max(table["error"]), 1e-3)
        for k, speed in enumerate(speeds):
            exact = self.table("orbit", self.machine, "--frequency", speed, "--method", "shooting", "--no-stability")
            for name in AMPLITUDES:
                self.assertAlmostEqual(table[name][k] / (np.ptp(exact[name[4:]]) / 2), 1, delta=3e-3)

    def test_harmonics_of_a_motion_of_several_turns_can_be_asked_again(self):
        """With n c = 63/8: as many as a tolerance chose give the same solution."""
        own = self.file("own.toml", changed(cage_speed_ratio=0.4921875))
        run = ["orbit", own, "--frequency", 45, "--no-stability"]
        chosen = self.table(*run, "--method", "aft", "--tolerance", 1e-2)
        again = self.table(*run, "--harmonics", int(chosen.value("harmonics")), "--samples", int(chosen.value("samples")))
        np.testing.assert_allclose(again["x_r"], chosen["x_r"], atol=1e-9 * abs(chosen["x_r"]).max())

    def test_a_sweep_goes_on_after_the_seconds_that_it_may_take(self):
        """The rows of an interrupted sweep and those that --resume adds are the rows of the whole one. Would catch a row that
        the clock has changed; the footer says whether anything touches."""
        sweep = ["response", self.machine, "--from", 20, "--to", 40, "--count", 41]
        whole = "\n".join(self.lines(*sweep)) + "\n"
        table = Table.of(whole)
        self.assertEqual([table.value(key) for key in ("complete", "contact")], ["yes", "yes"])
        part = self.run_explore(*sweep, "--budget", "0.3s")
        self.assertIn(part.returncode, (0, 3))
        if part.returncode:
            self.assertIn("the budget of 0.3 s is used up at", part.stderr)
            if part.stdout:
                self.assertTrue(whole.startswith(part.stdout.split("# complete")[0]))
                rest = self.rows(*sweep, "--resume", self.file("part.tsv", part.stdout))
                self.assertEqual(rest, [row for row in whole.splitlines() if row[0] != "#"])
        thirds = ["response", self.machine, "--from", 20, "--to", 30, "--count", 20]  # of no short decimals
        whole = self.lines(*thirds)
        part = [row for row in whole if not row.startswith("# ") or row.split(":")[0] not in ("# complete", "# contact", "# evaluations")]
        holed = [row for row in part[:-13] if not row.startswith("20.5263")]  # a speed that was lost
        for kept in (part[:-13], holed):
            rest = self.rows(*thirds, "--resume", self.file("part.tsv", "\n".join(kept) + "\n"))
            self.assertEqual(rest, [row for row in whole if row[0] != "#"])
        blank = self.file("blank.tsv", "\n".join([*part[:-13], "", *part[-13:]]) + "\n")
        self.refused("holds other points", *thirds, "--resume", blank)
        with open(self.folder / "part.tsv", "a", encoding="utf-8") as rows:
            self.refused("is where the rows go", *thirds, "--resume", "part.tsv", stdout=rows)
        self.refused("needs f as the first", *thirds, "--columns", "amp_x_r,f", "--resume", "part.tsv")
        self.refused("leave out --plot", *thirds, "--columns", "f,amp_x_r", "--resume", "part.tsv", "--plot", "a.svg")
        damped = self.file("damped.toml", MACHINE.replace("cage_speed_ratio", "contact_damping_s_per_m = 5.0\ncage_speed_ratio"))
        self.assertEqual(self.table("response", damped, "--from", 40, "--to", 42, "--count", 3).value("contact"), "yes")
        loose = self.file("loose.toml", MACHINE.replace("= 2e-5", "= 2e-2"))
        self.assertEqual(self.table("response", loose, "--from", 20, "--to", 22, "--count", 3).value("contact"), "no")

    def test_from_end_to_end_with_the_peak_near_50_hz_either_way(self):
        up, down = self.response(), self.response("--direction", "down")
        self.assertEqual(list(up.columns), ["f", *AMPLITUDES, "arc", "newton"])
        np.testing.assert_allclose([up["f"][0], up["f"][-1], down["f"][0]], [1, 60, 60], rtol=1e-9)
        self.assertAlmostEqual(up["f"][up["amp_x_r"].argmax()], 50, delta=1)
        self.assertLess(row_difference(down, -1, up, 0), 1e-9)
        self.assertLess(row_difference(down, 0, up, -1), 1e-9)

    def test_a_branch_does_not_turn_round_onto_itself(self):
        branch = self.table("response", self.machine, "--from", 1, "--to", 100, "--harmonics", 6, "--samples", 50)
        self.assertAlmostEqual(branch["f"][-1], 100)
        self.assertEqual(branch.value("folds") % 2, 0)

    def test_a_saved_branch_is_continued_either_way(self):
        table = self.response("--save", "branch.tsv")
        for options, row in ((["--at", 30], -1), (["--at", 30, "--direction", "down"], 0),
                             (["--direction", "down"], 0)):
            with self.subTest(options):
                part = self.response("--restart", "branch.tsv", *options)
                self.assertLess(row_difference(part, -1, table, row), 1e-9)
        with self.subTest("with more harmonics the saved points are starts"):
            warm = self.response("--restart", "branch.tsv", "--at", 30, "--harmonics", 12)
            self.assertLess(row_difference(warm, -1, self.response("--harmonics", 12), -1), 1e-9)

    def test_a_branch_is_continued_from_the_very_end_of_its_range(self):
        for first, then in (("--from 29 --to 30 --direction up", "--from 30 --to 31"),
                            ("--from 26 --to 27 --direction down", "--from 25 --to 26")):
            with self.subTest(first):
                self.table("response", self.machine, *first.split(), "--harmonics", 6, "--save", "branch.tsv")
                self.table("response", self.machine, *then.split(), "--restart", "branch.tsv")

    def test_what_is_no_saved_branch_of_this_machine_is_refused_by_line(self):
        self.response("--save", "branch.tsv")
        saved = (self.folder / "branch.tsv").read_text(encoding="utf-8")
        last = saved.rstrip("\n").rindex("\n") + 1
        form = "changed.tsv:1: '# Branch of harmonic balance' is expected"
        old = "# format: branch of harmonic balance, version 1\n# source: rotor_stator 0.1.0 0123456789ab\n# compiler: g++\n"
        for content, words in [
                ("", form), ("f\tamp\n1\t2\n", form), ("# a table\n", form),
                (old, "written by rotor_stator 0.1.0 0123456789ab"),
                (saved.replace("# machine: fnv-", "# machine: fnv-0"), "another machine"),
                (saved.replace("# harmonics: 6", "# harmonics: 7"), "the names of the columns"),
                (saved.replace("# harmonics: 6", "# harmonics: many"),
                 "# harmonics: many: must be in 1...4096"),
                (saved.replace("# direction: up", "# direction: left"), "must be up or down"),
                (saved[:-20], "the line is cut off"),
                (saved + "1\tnan\n", "is not a finite number"),
                (saved + saved[last:], "arc must increase"),
                (saved[:last] + re.sub(r"^1\t[^\t]*", "1\tinf", saved[last:]),
                 "'inf' is not a finite number")]:
            self.assertNotEqual(content, saved)
            self.file("changed.tsv", content)
            result = self.refused(words, "response", self.machine, *WHOLE, "--restart", "changed.tsv")
            self.assertIn("changed.tsv:", result.stderr)
        self.refused("there is no branch 2", "response", self.machine, *WHOLE, "--restart", "branch.tsv",
                     "--branch", 2)
        self.refused("another machine", "response", SETS[2], *WHOLE, "--restart", "branch.tsv")
        for old, new in [("\ncage_speed", "\ncontact_damping_s_per_m = 5.0\ncage_speed"), ("[rotor]", "[rotor]\nload_N = [1, 0]"),
                         ("contact_stiffness_N_per_m1p5", "contact_exponent = 1.4\ncontact_stiffness_N_per_mn")]:
            other = self.file("other.toml", MACHINE.replace(old, new))
            self.refused("another machine", "response", other, *WHOLE, "--restart", "branch.tsv")
        same = self.file("same.toml", "# in other words\n" + MACHINE.replace("= 2e-5", "= 2.0e-05"))
        self.table("response", same, "--from", 60, "--to", 60.1, "--restart", "branch.tsv")

    def test_a_search_for_isolated_branches_that_was_cut_off_says_so(self):
        table, reason = self.cut_off(SETS[2], *WHOLE, "--harmonics", 6, "--isolated", 10, "--budget", "2.8e7")
        self.assertIn("cut off", reason)
        self.assertEqual(table.value("complete"), "no")

    def test_a_branch_beside_the_followed_one_is_reported_and_printed(self):
        table = self.table("response", SETS[2], *WHOLE, "--harmonics", 6, "--isolated", 10, "--seed", 2)
        number, low, high, points, _, word = table.members("branch")[0]
        self.assertEqual((number, points, word), (2, (table["branch"] == 2).sum(), "complete"))
        self.assertEqual((low, high), (table.where("branch", 2)["f"].min(), table.where("branch", 2)["f"].max()))
        self.assertEqual(list(np.unique(table["branch"])), [1, 2])
        main, other = table.where("branch", 1), table.where("branch", 2)
        # It begins and ends at the same point, and that is no row of the first branch.
        self.assertLess(row_difference(other, 0, other, -1), 1e-12)
        self.assertGreater(min(row_difference(other, 0, main, k) for k in range(len(main))), 1e-6)


class Shooting(Case):
    """Time methods as equals of harmonic balance."""

    def orbit(self, frequency, *options):
        return self.table("orbit", self.machine, "--points", 64, "--frequency", frequency, *options)

    def test_it_closes_the_motion_that_integration_settles_on(self):
        """Also by default, to a tolerance."""
        for frequency in (6, 45):
            settled = self.orbit(frequency, "--method", "rk8pd")
            for how, most in ((["--method", "shooting"], 1e-7), (["--tolerance", 1e-4], 1e-4)):
                with self.subTest(frequency, how=how):
                    closed = self.orbit(frequency, *how)
                    self.assertLess(errors(displacements(closed), displacements(settled))[0], most)
                    said = self.said(closed, "method", "stability", "regime", "base")
                    self.assertEqual(said, ["shooting", "stable", "periodic", "turn"])

    def test_unstable_motions_and_those_of_two_turns_are_the_balance_s(self):
        for turns in ([], ["--subharmonic", 2]):
            with self.subTest(turns):
                closed = self.orbit(20, "--method", "shooting", *turns)
                series = self.orbit(20, "--harmonics", 96, *turns)
                self.assertLess(errors(displacements(closed), displacements(series))[0], 1e-3)
                keys = ("stability", "multiplier", "multiplier_uncertainty")
                (word, number, error), (other_word, other, other_error) = (self.said(table, *keys) for table in (closed, series))
                self.assertEqual(word, other_word)
                self.assertLess(abs(number - other), error + other_error)

    def test_the_branch_is_that_of_many_harmonics(self):
        end = 60 if FULL else 44
        times, series = (self.table("response", self.machine, "--from", 38, "--to", end, *how)
                         for how in (["--method", "shooting"], ["--harmonics", 24]))
        self.assertEqual(list(times.columns), list(series.columns))
        self.assertEqual((times["f"][0], times["f"][-1]), (38, end))
        at = times["f"][1:-1]
        for name in AMPLITUDES:
            near = np.interp(at, series["f"], series[name])
            self.assertLess(np.max(np.abs(times[name][1:-1] / near - 1)), 5e-3)

    def test_a_balanced_rotor_is_followed_turn_by_turn(self):
        """Where nothing but the passing balls excites, one passage would be the base period elsewhere."""
        own = self.file("own.toml", changed(unbalance_kg_m=0, radial_clearance_m=0))
        table = self.table("response", own, "--from", 40, "--to", 41, "--method", "shooting")
        self.assertEqual((table.value("base"), table["f"][-1]), ("turn", 41))

    def test_a_branch_turns_back_where_an_attractor_ends(self):
        """The kept study has two T-periodic attractors of set 1 at 34.25 Hz and one at 34.5 Hz."""
        table = self.table("response", self.machine, "--from", 33, "--to", 36, "--method", "shooting")
        f = np.array(table["f"])
        turns = [k for k in range(1, len(f) - 1) if (f[k] - f[k - 1]) * (f[k + 1] - f[k]) < 0]
        self.assertEqual((table.value("folds"), len(turns), f[-1]), (2, 2, 36))
        kept = Table(KEPT).where("set", 1)
        for low, high, count in [(34.25, f[turns[0]], 2), (f[turns[0]], 34.5, 1)]:
            self.assertLess(low, high)
            at = kept.where("f", low if count == 2 else high)
            self.assertEqual(len(set(at["motion"])), count)

    def test_what_it_cannot_do_is_refused(self):
        slow = self.file("slow.toml", changed(cage_speed_ratio=0.43))
        self.refused("cage_speed_ratio: shooting needs", "orbit", slow, "--frequency", 30, "--method", "shooting")
        self.refused("must be one of auto, aft, shooting", "response", self.machine, "--from", 30, "--to", 40, "--method", "rk4")
        self.refused("--save: is for", "response", self.machine, "--from", 30, "--to", 40, "--method", "shooting", "--save", "x")


class Stability(Case):
    def test_each_verdict_is_that_of_the_orbit_there(self):
        """By harmonic balance and by shooting, from a start of its own."""
        for low, high, how, harmonics in [(19.9, 20.6, ["--harmonics", 6], 6), (40, 42, ["--method", "shooting"], 64),
                                          (20.1, 20.2, ["--method", "shooting"], 64)]:
            table = self.table("response", self.machine, "--from", low, "--to", high, *how, "--stability")
            self.assertEqual(len(table.columns), 11)
            examined = np.flatnonzero(table["bifurcation"] == "-")
            for k in examined[::max(1, len(examined) // 6)]:
                with self.subTest(how=how, frequency=table["f"][k]):
                    orbit = self.table("orbit", self.machine, "--points", 1, "--frequency", repr(float(table["f"][k])), "--harmonics", harmonics)
                    multiplier = orbit.value("multiplier")
                    self.assertEqual(table["verdict"][k], orbit.value("stability"))
                    self.assertAlmostEqual(table["multiplier"][k] / multiplier, 1, delta=1e-3)
                    self.assertLess(table["multiplier_change"][k], 1e-3 * max(1, multiplier))

    def test_what_the_budget_does_not_allow_is_said(self):
        result = self.run_explore("response", self.machine, *WHOLE, "--harmonics", 6, "--stability", "--budget", "2.7e7")
        self.assertEqual(result.returncode, 3)
        self.assertIn("points judged are undecided", result.stderr)
        self.assertIn("used up", result.stderr)
        self.assertNotIn("nan", result.stdout)
        table = Table.of(result.stdout)
        known = (table["verdict"] != "undecided").sum()
        self.assertGreater(known, 0)
        self.assertLess(known, len(table))
        self.assertAlmostEqual(table["f"][-1], 60)
        self.assertEqual(table["multiplier"][-1], -1)


class Attractors(Case):
    def at(self, frequency, *options):
        return self.table("attractors", self.machine, "--from", frequency, "--to", frequency, "--count", 1, *options)

    def test_between_the_doublings_the_period_is_two_from_every_start(self):
        table = self.table("attractors", self.machine, "--from", 19.75, "--to", 20.25, "--count", 3, "--section", "section.tsv")
        self.assertEqual(list(table.columns)[:10], ["f", "motion", "period", "starts", "lyapunov",
                                                    "lyapunov_uncertainty", *AMPLITUDES])
        np.testing.assert_array_equal(table["f"], [19.75, 20, 20.25])
        np.testing.assert_array_equal(table["period"], [2, 2, 2])
        # At the edges one neighbour in speed is missing.
        np.testing.assert_array_equal(table["starts"], [5, 6, 5])
        kinds = [table[f"from_{kind}"] for kind in ("rest", "below", "above", "random")]
        np.testing.assert_array_equal(sum(kinds), table["starts"])
        self.assertTrue((table["lyapunov"] + 3 * table["lyapunov_uncertainty"] < 0).all())
        # Two points at each speed; at 20 Hz rk8pd from rest stands on one of them at phase 0. 1e-5 is for the steps of rk4.
        section = Table(self.folder / "section.tsv")
        self.assertEqual(len(section), 6)
        orbit = self.table("orbit", self.machine, "--frequency", 20, "--method", "rk8pd", "--points", 1)
        apart = distances(section.where("f", 20), orbit, 0)
        self.assertLess(min(apart), 1e-5)
        self.assertGreater(max(apart), 1e-4)

    def test_the_motions_are_those_of_another_method(self):
        """Two turns at 20 Hz with their force, begun at one of two points; sixteen of a motion that does not close."""
        self.at(20, "--starts", 0, "--motions", "motions.tsv")
        found = Table(self.folder / "motions.tsv")
        np.testing.assert_allclose(found["t_over_T"], np.arange(512) / 256)
        orbit = self.table("orbit", self.machine, "--frequency", 20, "--method", "rk8pd", "--points", 256, "--periods", 2)
        shift = -256 * int(np.argmin(distances(orbit.rows([0, 256]), found, 0)))
        for names, near in ((NAMES, 1e-5), (["F_x", "F_y"], 1e-3)):
            one, other = (np.array([table[name] for name in names]) for table in (found, orbit))
            self.assertLess(abs(one - np.roll(other, shift, axis=1)).max() / abs(other).max(), near)
        self.at(13.4, "--starts", 0, "--motions", "motions.tsv")
        self.assertEqual(len(Table(self.folder / "motions.tsv")), 16 * 256)

    def test_the_exponent_is_that_of_the_multiplier(self):
        """Both are of Eq. 7 without truncation: 1e-5 per turn leaves room for steps alone; with two turns it is what the truncation
        of the orbit leaves."""
        for frequency, how, turns, most in ((30, ["--harmonics", 6], 1, 1e-5), (45, ["--harmonics", 6], 1, 1e-5),
                                            (20.25, ["--method", "aft", "--subharmonic", 2], 2, 1e-4)):
            with self.subTest(frequency=frequency):
                orbit = self.table("orbit", self.machine, "--points", 1, "--frequency", frequency, *how)
                table = self.at(frequency, "--starts", 2)
                np.testing.assert_array_equal(table["period"], [turns])
                self.assertAlmostEqual(table["lyapunov"][0], math.log(orbit.value("multiplier")) / turns, delta=most)

    def test_chaos_and_what_is_not_known(self):
        """At 14.5 Hz the exponent is too near zero: the kept study could not decide either."""
        table = self.at(13.4)
        np.testing.assert_array_equal(table["period"], [0])
        self.assertGreater(table["lyapunov"][0], 5 * table["lyapunov_uncertainty"][0])
        kept = Table(KEPT).where("set", 1).where("f", 14.5)
        self.assertIn(-2, kept["period"])
        table = self.at(14.5, "--starts", 1)
        np.testing.assert_array_equal(table["period"], [-2])
        self.assertGreater(table["undecided"][0], 0)

    def test_two_attractors_at_one_speed_are_two_rows_and_those_of_the_kept_study(self):
        kept = Table(KEPT).where("set", 1)
        table = self.table("attractors", self.machine, "--from", 25, "--to", 25.25, "--count", 2, "--starts", 8, "--section", "section.tsv")
        section = Table(self.folder / "section.tsv")
        for frequency in (25, 25.25):
            rows, known = (part.where("f", frequency) for part in (table, kept))
            points = section.where("f", frequency)
            reached = []
            for number in (1, 2):
                one = known.where("motion", number)
                # The kept points are RK4's, these are closed by shooting.
                near = points.rows(np.array(distances(points, one, 0)) < 3e-6)
                self.assertEqual(len(near), 1)
                self.assertEqual(near["period"][0], one["period"][0])
                reached.append(near["motion"][0])
            with self.subTest(frequency=frequency):
                self.assertEqual(sorted(reached), [1, 2])
                np.testing.assert_array_equal(rows["motion"], [1, 2])

    def test_the_threads_change_nothing_not_even_where_the_budget_ends(self):
        for budget, status in ((), 0), (("--budget", "1e7"), 3):
            one, three = (self.run_explore("attractors", self.machine, "--from", 20, "--to", 22, "--count", 5, *budget,
                                           env={**os.environ, "OMP_NUM_THREADS": threads}) for threads in "13")
            with self.subTest(budget=budget):
                self.assertEqual((one.returncode, one.stdout, one.stderr), (status, three.stdout, three.stderr))
        self.assertIn("machine.toml: partial, ", one.stderr)
        self.assertIn("the budget is used up, more with --budget", one.stderr)
        self.assertEqual(Table.of(one.stdout).value("complete"), "no")
        self.assertTrue(0 < Table.of(one.stdout)["starts"].sum() < 28)


class Rounding(Case):
    """Searches that once depended on rounding, which differs between processors, since their last start came from a
    chaotic motion. Set, speed [Hz], harmonics."""

    CASES = [(2, 20, 24), (2, 36.5, 6), (2, 24.5, 10), (2, 19, 24), (2, 7, 64), (1, 12.5, 24), (1, 14, 64)]
    WITHOUT_AVX2 = {**os.environ, "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-AVX2_Usable,-FMA_Usable"}

    def orbit(self, case, frequency, **how):
        """None where no solution is found."""
        result = self.run_explore("orbit", SETS[case[0]], "--frequency", repr(frequency),
                                  "--harmonics", case[2], "--points", 64, "--no-stability", **how)
        self.assertIn(result.returncode, (0, 3), result.stderr)
        return None if result.returncode else Table.of(result.stdout)

    def test_a_search_ends_alike_whatever_the_rounding(self):
        """Speeds that differ by some 1e-15 and sines without fused products must give the same solution or none."""
        has_avx2 = "avx2" in Path("/proc/cpuinfo").read_text(encoding="utf-8").split()
        if not has_avx2:
            print("no AVX2 here: other sines are not compared", file=sys.stderr)
        for case in some(self.CASES, 3):
            with self.subTest(case):
                first = self.orbit(case, float(case[1]))
                others = [self.orbit(case, case[1] * (1 + k * 1e-15)) for k in (-2, 1, 3)]
                if has_avx2:
                    others.append(self.orbit(case, float(case[1]), env=self.WITHOUT_AVX2))
                self.assertEqual([other is None for other in others], [first is None] * len(others))
                for other in others:
                    if first is not None:
                        self.assertLess(errors(displacements(other), displacements(first))[0], 1e-6)
