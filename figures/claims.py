"""The verdict on each claim of the paper, from the tables and the rules of data/claims.toml.

Usage: figures/claims.py TABLES_DIR OUTPUT.tsv    one version's claims.tsv
       figures/claims.py --print FILE.tsv...      a readable table of one or more of them
       figures/claims.py --check DIR STORED.tsv   recompute, and compare with the stored verdicts
"""
import sys
from pathlib import Path

import numpy as np
from claim_quantities import (LIMITS, LOW_TO, MIDDLE_TO, NOT_ENOUGH, RULES, force_rise, harmonics, high, high_rest, losing,
                              low, low_permanent, middle, middle_complex, more_often, passes, peak,
                              phases, right, share, verdict)
from claim_ranges import Accepted
from claim_score import in_words, stored
from project import source_line
from tables import Table, two_digits

KEPT = Path("data/reference")
MOST_HARMONICS = 16
COLUMNS = {"id": "of the claim", "claim": "in words", "paper": "what the paper says", "ours": "what the tables say",
           "verdict": "reproduced, partly, not reproduced or not tested", "built_in": "what was chosen so that it holds",
           "evidence": "file: columns",
           "low": "smallest quantity over the accepted machines; of a timed one, over the repetitions",
           "high": "largest", "range": "for which machines the verdict holds", "question": "that is asked"}


class Evidence:
    """The tables of one version of Table 1, read when they are first asked for, and the claims' quantities."""

    def __init__(self, folder, change=lambda table: table):
        self.folder = Path(folder)
        self.reading = int(self.folder.name == "as-printed")
        self.change = change  # of the tables by speed, for tests
        self.tables = {}
        # The long studies' tables are kept; these do not depend on the version of Table 1.
        printed = "as-printed" if self.reading else ""
        self.kept = {"clearance_stiffness": KEPT / "clearance_stiffness.tsv",
                     "tab02_equal_error": KEPT / "tab02_equal_error.tsv",
                     "validity": KEPT / printed / "validity.tsv", "large": KEPT / "large.tsv"}

    def table(self, name):
        if name not in self.tables:
            table = Table(self.kept.get(name, self.folder / f"{name}.tsv"))
            self.tables[name] = self.change(table) if name in ("regimes", "validity") else table
        return self.tables[name]

    def regimes(self, number=1):
        return self.table("regimes").where("set", number)

    def landmark(self, name, number=1):
        """A value of Table 1 or a speed that follows from it."""
        return self.table("tab01_parameters").where("set", number).first(name)

    def ranges(self, claim, value):
        """Smallest and largest quantity, and for which machines the verdict holds."""
        if claim["id"] == "C9":
            return self.spread_of_times(claim)
        accepted = self.accepted()
        if not accepted.verdicts(claim):
            return "-", "-", "not computed for other masses" if value is not None else "-"
        found = [one for one in accepted.values(claim) if one is not None]
        ends = (f"{min(found):.4g}", f"{max(found):.4g}") if found else ("-", "-")
        return *ends, accepted.words(claim, self.landmark("cage_speed_ratio"))

    def accepted(self):
        if "accepted" not in self.tables:
            self.tables["accepted"] = Accepted(Table(KEPT / "identification.tsv"), self.reading)
        return self.tables["accepted"]

    # -- quantities of claims.toml: a number, and what there is to say beside it ----------------

    def peak_frequency(self):
        f, amplitude = peak(self.table("fig03_response").where("set", 1).where("curve", 1))
        eccentricity = self.landmark("e")
        return f, (f"{f:.1f} Hz, {1e3 * amplitude:.2f} mm, {amplitude / eccentricity:.1f} times the eccentricity "
                   f"m_e e/m_r = {1e3 * eccentricity:.3g} mm")

    def fixed(self, number):
        """The rows of solutions with a number of harmonics that was not chosen for a tolerance."""
        return self.table("validity").where("set", number).where("adaptive", 0)

    def speeds(self, number):
        return np.unique(self.table("validity").where("set", number)["f"])

    def errors(self, number, m, column="distance"):
        """At every speed; infinite where there is no T-periodic motion or no solution."""
        rows = self.fixed(number).where("m", m)
        rows = rows.rows((rows["periodic"] == 1) & (rows["found"] == 1))
        at = dict(zip(rows["f"], rows[column]))
        return np.array([at.get(f, np.inf) for f in self.speeds(number)])

    def periodic(self, number):
        """Whether a T-periodic motion attracts, at every speed."""
        rows = self.table("validity").where("set", number).where("periodic", 1)
        return np.isin(self.speeds(number), rows["f"])

    def in_transition(self, number):
        """Whether a speed lies in the transition of the text, at every speed."""
        speeds = self.speeds(number)
        return (speeds > LOW_TO) & (speeds <= MIDDLE_TO)

    def share_right_set_1(self):
        """The quantity, where the speeds are lost, and what it is by other limits and norms and with fewer harmonics."""
        errors, periodic, speeds = self.errors(1, 6), self.periodic(1), self.speeds(1)
        wrong = periodic & (errors > LIMITS["accurate"])
        passage = round(self.landmark("n") * self.landmark("cage_speed_ratio"))
        slowest = np.flatnonzero(periodic)[0]
        words = [f"right at {percent_of(right(errors))} of {speeds.size} speeds: no T-periodic motion attracts at "
                 f"{np.sum(~periodic)}, the error is above 10 % at {np.sum(wrong)}"
                 f"{' (' + listed(speeds[wrong]) + ' Hz)' if 0 < np.sum(wrong) <= 8 else ''}, {percent(errors[periodic])} at most, that of "
                 f"the force {percent(self.errors(1, 6, 'distance_force')[periodic])} of its vibration; where a T-periodic motion attracts, 6 harmonics "
                 f"are right at {percent_of(right(errors[periodic]))}"]
        least, most = self.same_verdict(errors)
        words.append("the verdict is the same for " + (
            f"limits of the error from {percent(np.array([least]))} to {percent(np.array([most]))}" if np.isfinite(most) else
            f"every limit of the error from {percent(np.array([least]))} on" if least > 0 else "every limit of the error"))
        words.append(f"if the largest error counts, over the largest displacement, {percent_of(right(self.errors(1, 6, 'distance_largest')))}; "
                     f"with one harmonic {percent_of(right(self.errors(1, 1)))}, with 16 {percent_of(right(self.errors(1, MOST_HARMONICS)))}; "
                     f"the passing balls are harmonic {passage}: at {speeds[slowest]:g} Hz the error is "
                     f"{percent(self.errors(1, passage - 1)[[slowest]])} with {passage - 1} and "
                     f"{percent(self.errors(1, passage)[[slowest]])} with {passage}")
        return right(errors), "; ".join(words)

    @staticmethod
    def same_verdict(errors):
        """Between which limits of the error the verdict on C2 is that of the limit of the rules."""
        claim = next(claim for claim in RULES["claim"] if claim["id"] == "C2")
        limits = np.concatenate([[0.0], np.sort(errors[np.isfinite(errors)])])
        said = np.array([verdict(claim, share(errors <= limit)) for limit in limits])
        ours = int(np.searchsorted(limits, LIMITS["accurate"], side="right")) - 1
        other = np.flatnonzero(said != said[ours])
        before, after = other[other < ours], other[other > ours]
        return (limits[before[-1] + 1] if before.size else 0.0, limits[after[0]] if after.size else np.inf)

    def harmonics_in_transition(self):
        periodic, inside = self.periodic(2), self.in_transition(2)
        value = harmonics({m: self.errors(2, m)[inside] for m in range(1, MOST_HARMONICS + 1)}, periodic[inside])
        outside = right(self.errors(2, 10)[periodic & ~inside])
        return value, (f"{'cannot be tested where it is made' if value is None else named(value)}: a T-periodic motion attracts at "
                       f"{np.sum(periodic & inside)} of {np.sum(inside)} speeds of the transition; at the {np.sum(periodic & ~inside)} "
                       f"other speeds with one, 10 harmonics are right at {percent_of(outside)}")

    def low_permanent(self):
        f_loss, cage = self.landmark("f_loss"), self.landmark("cage_speed_ratio")
        rows = low(self.regimes())
        often = more_often(rows, cage)
        return low_permanent(self.regimes(), f_loss, cage), (
            f"single balls lose contact more often than the cage makes them at {percent_of(share(often))} of the low speeds"
            f"{' (' + listed(rows['f'][often]) + ' Hz)' if 0 < np.sum(often) <= 8 else ''}; rotor and stator touch "
            f"{100 * rows['contact'].mean():.4g} % of the time, and always at {percent_of(share(rows['contact'] == 1))} of the low speeds; "
            f"by closed form the weight exceeds the unbalance up to {f_loss:.2f} Hz")

    def middle_complex(self):
        rows, cage = self.regimes(), self.landmark("cage_speed_ratio")
        value, lost, between = middle_complex(rows, cage), losing(rows), middle(rows)
        words = (f"single balls gain and lose contact at {percent_of(share(more_often(between, cage)))} of the middle speeds, where the higher "
                 f"harmonics are {100 * between['higher_harmonics'].mean():.2g} % in the mean; rotor and stator separate "
                 + (f"at {lost.size} speeds from {lost[0]:g} to {lost[-1]:g} Hz" if lost.size else "nowhere")
                 + f", by closed form about {self.landmark('f_loss'):.2f} Hz")
        joint = self.landmark("f_joint")
        peaks = [(k, strongest(rows, k, joint / k)) for k in (5, 4, 3, 2)]
        found = [f"{k}x at {f:g} Hz ({joint / k:.1f})" for k, f in peaks if f is not None]
        return value, words + (f"; superharmonics of the joint mode (its speed over their order): {', '.join(found)}"
                               if found else "")

    def high_rest(self):
        rows = high(self.regimes())
        value, again = high_rest(self.regimes()), self.landmark("f_gravity")
        top = rows["higher_harmonics"].argmax()
        other = share((rows["contact"] < 1) | (rows["turns"] != 1))
        plain = np.mean(rows["higher_harmonics"] + 1 - rows["contact"])
        counted = f", {100 * value:.2g} % where a speed without rotating contact counts 100 %" if value != plain else ""
        words = (f"higher harmonics and separation {100 * plain:.2g} % in the mean{counted}; largest {100 * rows['higher_harmonics'][top]:.2g} % at "
                 f"{rows['f'][top]:g} Hz, half the joint mode is {self.landmark('f_joint') / 2:.1f} Hz; "
                 f"rotor and stator touch at all times, and the contact rotates, at {100 * (1 - other):.0f} % of the high speeds; single balls may still lose it (C10)")
        if again > 0:
            words += f"; by closed form gravity prevails again from {again:.1f} Hz on"
        return value, words

    def force_rise(self):
        value, first, top = force_rise(self.regimes())
        return value, f"{first:.0f} N to {top:.0f} N, {value:.1f} times"

    def last_panel(self, figure):
        table = self.table(figure)
        return table.where("panel", table["panel"].max())

    def arc_ratio(self):
        first, second = (360 * share(self.last_panel(figure)["Q"] > 0)
                         for figure in ("fig07_contact", "fig09_contact"))
        return second / first, f"{first:.0f} and {second:.0f} degrees, ratio {second / first:.2f}"

    def pairs(self):
        """The rows of harmonic balance with 6, 8 and 10 harmonics, and those of RK4 at their errors."""
        timing = self.table("tab02_timing")
        return timing.where("method", "aft"), timing.where("method", "rk4")

    def ratios_of_times(self, slower, faster):
        """RK4 over harmonic balance by these columns; 0 where RK4 misses an error."""
        aft, rk4 = self.pairs()
        equal = (rk4["error"] <= aft["error"]) & (rk4["error_force"] <= aft["error_force"])
        return np.where(equal, rk4[slower] / aft[faster], 0)

    def least_speed_ratio(self):
        aft, rk4 = self.pairs()
        ratio = self.ratios_of_times("cpu_s", "cpu_s")
        compared = self.compared()
        words = (f"{', '.join(f'{one:.1f}' for one in ratio[:-1])} and {ratio[-1]:.1f} times faster at the {percent_of(compared)} of the "
                 "speeds where the motion from rest is T-periodic; ") + "; ".join(
            f"m = {m:.0f}: {value:.1f} times faster, errors of displacement and force {100 * one:.2g} % and {100 * two:.2g} %, "
            f"{fewer:.0f} times fewer evaluations of the force" for m, value, one, two, fewer in zip(
                aft["harmonics"], ratio, aft["error"], aft["error_force"], rk4["evaluations"] / aft["evaluations"]))
        return ratio.min() * compared, words + (self.other_ratios() if self.reading == 0 else "")

    def compared(self):
        """Share of the speeds of the timed sweep with a T-periodic motion."""
        timing = self.table("tab02_timing")
        without = timing.members("not_periodic")
        return 1 - (len(without[0]) if without else 0) / timing.value("speeds")

    def other_ratios(self):
        """The same where a largest error is given, and m is free."""
        rows = self.table("tab02_equal_error").where("method", "rk4").where("target", 0.01)
        return "; with any m, for 1 % of the displacement: " + ", ".join(
            f"{max(ratio, 1 / ratio):.2g} times {'faster' if ratio >= 1 else 'slower'} at {span} Hz"
            for span, ratio in zip(rows["range"], rows["ratio"]))

    def spread_of_times(self, claim):
        least, most = (self.compared() * self.ratios_of_times(one, other).min()
                       for one, other in (("cpu_min_s", "cpu_max_s"), ("cpu_max_s", "cpu_min_s")))
        found = dict.fromkeys(verdict(claim, value) for value in (least, most))
        return f"{least:.4g}", f"{most:.4g}", f"{' to '.join(found)} over the repetitions of the timing"

    def passes_of_contact(self):
        rows = high(self.regimes())
        rotating = rows.where("turns", 1)
        value = passes(rows, self.landmark("cage_speed_ratio"))
        return value, (f"passed {value:.3g} times in two periods, in the mean; the contact rotates at {percent_of(len(rotating) / len(rows))} of the high "
                       f"speeds; contact is interrupted for a short while at {percent_of(share(rotating['passed_once'] == 0))} of these, "
                       f"{rotating['passages'].mean():.2f} loadings per ball in the mean")

    def study_ratio(self):
        aft, rk4 = (rows.where("harmonics", 6) for rows in self.pairs())
        ratio = rk4.first("cpu_s") / aft.first("cpu_s")
        if self.reading:
            return None, (f"the study was not computed in this order; a sweep at the error of 6 harmonics is {ratio:.1f} times faster")
        study = self.table("clearance_stiffness")
        points, speeds = len(study), int(study.value("sweep_count"))
        solved = 1 - study["missed"].sum() / (points * speeds)
        seconds = rk4.first("cpu_s") / self.table("tab02_timing").value("speeds") * points * speeds
        return ratio * solved, (f"{ratio:.1f} times faster for a sweep at the error of 6 harmonics, {ratio * solved:.1f} weighted by the "
                                f"{100 * solved:.0f} % of the speeds of the study that it solves; by integration, {points} machines with {speeds} speeds each "
                                f"would take {seconds:.2g} s of one processor of today if each took as long as a speed of set 1")

    def large_problems(self):
        """No quantity: the paper names no size, and the reduction is ours."""
        table = self.table("large")
        beams = table.where("kind", "beam")
        fine = beams.rows(beams["n"] >= 1000)
        power = np.polyfit(np.log(fine["n"]), np.log(fine["reduction_s"] + fine["branch_s"]), 1)[0]
        top, brick = fine.rows([-1]), table.where("kind", "brick")
        once = ", ".join(f"{rows['reduction_s'][0]:.2g} s for {kind} of {rows['n'][0]:.0f} degrees of freedom"
                         for kind, rows in (("beams", top), ("bricks", brick)))
        a_point = table["branch_s"] / table["points"]
        whole = table.rows(table["integrated"] == table["n"])
        return None, (
            "tested was the method with a reduction of ours, which the paper does not have: its cost grows as "
            f"n^{power:.2f} from {fine['n'].min():.0f} to {fine['n'].max():.0f} degrees of freedom, reduced to "
            f"{fine['r'].max():.0f} at most; once {once}; then a branch of 200 points takes {200 * a_point[0]:.2g} s for the "
            f"paper's machine and at most {a_point.max() / a_point[0]:.2g} times that; largest error of a solution "
            f"{percent(table['error'])}, against integration of all degrees of freedom up to {whole['n'].max():.0f}")

    def three_phases_set_2(self):
        (count, lost), (_, ours) = (phases(self.regimes(number)) for number in (2, 1))
        if lost is None:
            return count, f"{count} of 3 phases; contact is never lost"
        return count, (f"{count} of 3 phases; contact is lost between {lost[0]:g} and {lost[1]:g} Hz"
                       + (f", with set 1 between {ours[0]:g} and {ours[1]:g} Hz" if ours else ""))

    def both_clearances(self):
        """No quantity: no continuous nonlinearity is compared."""
        shares = [right(self.errors(number, 10)) for number in (1, 2)]
        speeds = self.speeds(1).size
        among = [right(self.errors(number, 10)[self.periodic(number)]) for number in (1, 2)]
        return None, (f"no continuous nonlinearity was compared; with the small and the large clearance 10 harmonics are right at "
                      f"{percent_of(shares[0])} and {percent_of(shares[1])} of {speeds} speeds, T-periodic motions attract at "
                      f"{percent_of(self.periodic(1).mean())} and {percent_of(self.periodic(2).mean())}, and where one does they are right at "
                      f"{percent_of(among[0])} and {percent_of(among[1])}")


def named(m):
    return f"{m} harmonic{'s' if m > 1 else ''}" if m < NOT_ENOUGH else f"more than {MOST_HARMONICS} harmonics"


def listed(speeds):
    return ", ".join(f"{f:g}" for f in np.sort(speeds))


def percent_of(part):
    return f"{100 * part:.0f} %"


def percent(errors):
    """The largest error, or that some speed has no solution."""
    found = errors[np.isfinite(errors)]
    missed = errors.size - found.size
    if found.size == 0:
        return "unknown (no solution)"
    return f"{two_digits(100 * found.max())} %" + (f" ({missed} speed{'s' if missed > 1 else ''} without solution)" if missed else "")


def strongest(rows, order, centre):
    """The speed near `centre` at which a harmonic is largest beside the first; none if that is no peak."""
    near = rows.rows(np.abs(rows["f"] / centre - 1) <= 0.15)
    f = near["f"][near[f"h_{order}"].argmax()]
    return f if near["f"].min() < f < near["f"].max() else None


def judged(folder, **options):
    """Each claim with its verdict, quantity, what there is to say beside it, and where to look for its range."""
    evidence = Evidence(folder, **options)
    for claim in RULES["claim"]:
        value, words = getattr(evidence, claim["quantity"])()
        yield claim, verdict(claim, value), value, words, evidence


def write(folder, output):
    header = ["# The paper's claims, judged by the rules of data/claims.toml", source_line(),
              f"# modelled: nothing; the tables of {folder} and data/reference",
              *(f"# column: {name} [-] {meaning}" for name, meaning in COLUMNS.items()), "\t".join(COLUMNS)]
    rows = ["\t".join((claim["id"], claim["claim"], claim["paper"], words, found, claim.get("built_in", "-"), claim["evidence"],
                       *evidence.ranges(claim, value), claim["question"]))
            for claim, found, value, words, evidence in judged(folder)]
    Path(output).write_text("\n".join(header + rows) + "\n", encoding="utf-8")


def show(paths):
    for path in paths:
        claims = stored(path)
        print(f"\n{path}: {in_words(claims)}\n")
        for row in claims:
            print(f"{row['id']:4}{row['claim']}\n    asked: {row['question']}\n    paper: {row['paper']}\n"
                  f"    ours:  {row['ours']}\n    {row['verdict'].upper()}   ({row['evidence']})\n"
                  f"    range: {row['low']} ... {row['high']}; {row['range']}")


def check(folder, path):
    """Compares recomputed verdicts with stored ones, with both numbers on a change."""
    before = {row["id"]: row for row in stored(path)}
    changed = 0
    for claim, found, value, words, _ in judged(folder):
        kept = before[claim["id"]]
        if kept["verdict"] not in possible(claim, value):
            print(f"{claim['id']}: {found} ({words}), stored: {kept['verdict']} ({kept['ours']})")
            changed = 1
    return changed


def possible(claim, value):
    """The verdicts within the noise of a timed quantity, or the one."""
    noise = (0.7, 1, 1.3) if claim.get("timed") else (1,)
    return {verdict(claim, value and value * factor) for factor in noise}


if __name__ == "__main__":
    if sys.argv[1] == "--print":
        show(sys.argv[2:])
    elif sys.argv[1] == "--check":
        sys.exit(check(*sys.argv[2:]))
    else:
        write(*sys.argv[1:])
