"""The verdict on each claim of the paper, from the tables and the rules of data/claims.toml.

Usage: figures/claims.py TABLES_DIR OUTPUT.tsv    one reading's claims.tsv
       figures/claims.py --print FILE.tsv...      a readable table of one or more of them
       figures/claims.py --check DIR STORED.tsv   recompute, and compare with the stored verdicts
"""
import sys
from pathlib import Path

import numpy as np
from claim_quantities import (LIMITS, LOW_TO, MIDDLE_TO, NOT_ENOUGH, RULES, force_rise, harmonics_transition, high, high_rest,
                              loaded_once, losing, lost_inside, low, low_permanent, middle, middle_complex, passes, peak,
                              phases, right, share, verdict)
from claim_ranges import Accepted
from project import source_line
from tables import Table, cells_as_numbers

KEPT = Path("data/reference")
MOST_HARMONICS = 16
STUDY_RATIO = 9  # of the paper's own times
HALVES = {True: "reproduced", False: "not reproduced"}
COLUMNS = {"id": "of the claim", "claim": "in words", "paper": "what the paper says", "ours": "what the tables say",
           "verdict": "reproduced, partly, not reproduced or not tested",
           "rests_on": "what of ours the verdict rests on: masses, cage, reduction; or nothing", "evidence": "file: columns",
           "low": "smallest quantity over the accepted machines; of a timed one, over the repetitions",
           "high": "largest", "range": "for which machines the verdict holds", "question": "that is asked"}


class Evidence:
    """The tables of one reading, read when they are first asked for, and the claims' quantities."""

    def __init__(self, folder, change=lambda table: table):
        self.folder = Path(folder)
        self.reading = int(self.folder.name == "as-printed")
        self.change = change  # of the tables by speed, for tests
        self.tables = {}
        # The long studies' tables are kept; these do not depend on the reading.
        printed = "as-printed" if self.reading else ""
        self.kept = {"clearance_stiffness": KEPT / "clearance_stiffness.tsv", "clearance_speed": KEPT / "clearance_speed.tsv",
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
        values = accepted.values(claim)
        if not values:
            return "-", "-", "does not depend on the masses" if value is not None else "-"
        return f"{min(values):.4g}", f"{max(values):.4g}", accepted.words(claim, self.landmark("cage_speed_ratio"))

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

    def fixed(self, number, m):
        """The rows of all speeds with a number of harmonics that was not chosen for a tolerance; where no T-periodic motion
        attracts, some numbers of harmonics have none."""
        return self.table("validity").where("set", number).where("adaptive", 0).where("m", m)

    def attracting(self, number):
        """The speeds, and whether a T-periodic motion attracts."""
        return self.table("validity").where("set", number).where("adaptive", 1)

    def errors(self, number, column="distance"):
        """{m: error at each speed}, infinite where there is no solution or no T-periodic motion attracts."""
        speeds = self.attracting(number)
        every = {}
        for m in range(1, MOST_HARMONICS + 1):
            rows = self.fixed(number, m)
            known = {f: error for f, error, found in zip(rows["f"], rows[column], rows["found"]) if found}
            every[m] = np.array([known.get(f, np.inf) if periodic else np.inf for f, periodic in zip(speeds["f"], speeds["periodic"])])
        return every

    def words_on(self, number, m):
        """How many speeds a number of harmonics is right at, and why not at the others."""
        rows, errors, force = self.attracting(number), self.errors(number)[m], self.errors(number, "distance_force")[m]
        periodic = rows["periodic"] == 1
        wrong = rows["f"][periodic & ~right(errors)]
        return (f"m = {m}: right at {right(errors).sum()} of {len(rows)} speeds; no T-periodic motion attracts at {(~periodic).sum()}; "
                f"error above 10 % at {wrong.size} others{' (' + listed(wrong) + ' Hz)' if 0 < wrong.size <= 8 else ''}, largest "
                f"{percent(errors[periodic])}, force {percent(force[periodic])}")

    def share_right_set_1(self):
        errors, rows = self.errors(1), self.attracting(1)
        passage = round(self.landmark("n") * self.landmark("cage_speed_ratio"))
        slowest = [int(np.argmin(np.where(rows["periodic"] == 1, rows["f"], np.inf)))]
        return share(right(errors[6])), (
            f"{self.words_on(1, 6)}; the passing balls are harmonic {passage}: at {rows['f'][slowest[0]]:g} Hz the error is "
            f"{percent(errors[passage - 1][slowest])} with {passage - 1} and {percent(errors[passage][slowest])} with {passage}")

    def harmonics_transition(self):
        rows = self.attracting(2)
        value = harmonics_transition(rows, self.errors(2))
        inside = rows.rows((rows["f"] > LOW_TO) & (rows["f"] <= MIDDLE_TO))
        words = f"a T-periodic motion attracts at {(inside['periodic'] == 1).sum()} of {len(inside)} speeds of the transition"
        found = "the sentence cannot be tested where it is made" if value is None else f"{named(value)} are right at all of them"
        return value, f"{words}: {found}; over the whole range {self.words_on(2, 10)}"

    def low_permanent(self):
        f_loss = self.landmark("f_loss")
        value = low_permanent(self.regimes(), f_loss)
        rows = low(self.regimes())
        return value, (f"every ball is loaded once at {(loaded_once(rows)).sum()} of {len(rows)} low speeds; rotor and stator are in "
                       f"contact {100 * rows['contact'].mean():.4g} % of the time; closed form of the loss: {f_loss:.2f} Hz")

    def middle_complex(self):
        rows = self.regimes()
        inside, lost = middle(rows), losing(rows)
        words = (f"balls gain and lose contact besides the cage's doing at {(~loaded_once(inside)).sum()} of {len(inside)} speeds of the "
                 f"transition; higher harmonics {100 * inside['higher_harmonics'].mean():.2g} % in its mean; rotor and stator "
                 + (f"separate at {lost.size} speeds from {lost[0]:g} to {lost[-1]:g} Hz, {100 * lost_inside(rows):.0f} % of that time in "
                    f"the transition; closed form {self.landmark('f_loss'):.2f} Hz" if lost.size else "never separate"))
        joint = self.landmark("f_joint")
        peaks = [(k, strongest(rows, k, joint / k)) for k in (5, 4, 3, 2)]
        found = [f"{k}x at {f:g} Hz ({joint / k:.1f})" for k, f in peaks if f is not None]
        return middle_complex(rows), words + (f"; superharmonics of the joint mode (its speed over their order): {', '.join(found)}"
                               if found else "")

    def high_rest(self):
        rows = high(self.regimes())
        value, again = high_rest(self.regimes()), self.landmark("f_gravity")
        top = rows["higher_harmonics"].argmax()
        other = share((rows["contact"] < 1) | (rows["turns"] != 1))
        words = (f"{100 * value:.2g} % in the mean; largest {100 * rows['higher_harmonics'][top]:.2g} % at "
                 f"{rows['f'][top]:g} Hz, half the joint mode is {self.landmark('f_joint') / 2:.1f} Hz; "
                 f"{100 * other:.0f} % of the high speeds without permanent rotating contact")
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

    def least_speed_ratio(self):
        aft, rk4 = self.pairs()
        equal = (rk4["error"] <= aft["error"]) & (rk4["error_force"] <= aft["error_force"])
        ratio = np.where(equal, rk4["cpu_s"] / aft["cpu_s"], 0)
        words = "; ".join(
            f"m = {m:.0f}: {value:.1f} times faster, errors of displacement and force {100 * one:.2g} % and {100 * two:.2g} %, "
            f"{fewer:.0f} times fewer evaluations of the force" for m, value, one, two, fewer in zip(
                aft["harmonics"], ratio, aft["error"], aft["error_force"], rk4["evaluations"] / aft["evaluations"]))
        return ratio.min(), words + (self.other_ratios() if self.reading == 0 else "")

    def other_ratios(self):
        """The same where a largest error is given, and m is free."""
        rows = self.table("tab02_equal_error").where("method", "rk4").where("target", 0.01)
        return "; with any m, for 1 % of the displacement: " + ", ".join(
            f"{max(ratio, 1 / ratio):.2g} times {'faster' if ratio >= 1 else 'slower'} at {span} Hz"
            for span, ratio in zip(rows["range"], rows["ratio"]))

    def spread_of_times(self, claim):
        aft, rk4 = self.pairs()
        least = (rk4["cpu_min_s"] / aft["cpu_max_s"]).min()
        most = (rk4["cpu_max_s"] / aft["cpu_min_s"]).min()
        found = dict.fromkeys(verdict(claim, value) for value in (least, most))
        return f"{least:.4g}", f"{most:.4g}", f"{' to '.join(found)} over the repetitions of the timing"

    def passes_of_contact(self):
        rows = high(self.regimes())
        rotating = rows.where("turns", 1)
        value = passes(rows, self.landmark("cage_speed_ratio"))
        return value, (f"{value:.3g} in two periods, at the {100 * len(rotating) / len(rows):.0f} % of the high "
                       f"speeds with rotating contact; short losses split a passage at "
                       f"{100 * share(rotating['passed_once'] == 0):.0f} % of these, into "
                       f"{rotating['passages'].mean():.2f} loadings per ball in the mean of all")

    def study_halves(self):
        aft, rk4 = (rows.where("harmonics", 6) for rows in self.pairs())
        study, integrated = self.table("clearance_stiffness"), self.table("clearance_speed")
        points, speeds = study["delta"].size, int(study.value("sweep_count"))
        solved = 1 - study["missed"].sum() / (points * speeds)
        ratio = rk4.first("evaluations") / aft.first("evaluations")
        motions = (cells_as_numbers(integrated["period"]) > -np.inf).sum()
        within, out = ratio * solved >= STUDY_RATIO, motions < points
        return int(within) + int(out), (
            f"within reach of the method: {HALVES[within]}, {ratio:.1f} times fewer evaluations for a sweep, and the balance solves "
            f"{100 * solved:.0f} % of the speeds of a study of {points} machines; out of reach of integration: {HALVES[out]}, "
            f"{motions} machines and speeds were integrated from rest for one map")

    def large_growth(self):
        table = self.table("large")
        beams = table.where("kind", "beam")
        fine = beams.rows(beams["n"] >= 1000)
        power = np.polyfit(np.log(fine["n"]), np.log(fine["reduction_s"] + fine["branch_s"]), 1)[0]
        top, brick = fine.rows([-1]), table.where("kind", "brick")
        once = ", ".join(f"{rows['reduction_s'][0]:.2g} s for {kind} of {rows['n'][0]:.0f} degrees of freedom"
                         for kind, rows in (("beams", top), ("bricks", brick)))
        a_point = table["branch_s"] / table["points"]
        whole = table.rows(table["integrated"] == table["n"])
        small = table["error"].max() <= 0.01
        return power if small else np.inf, (
            f"with a reduction of large bodies that the paper does not have: n^{power:.2f} from {fine['n'].min():.0f} to {fine['n'].max():.0f} degrees of freedom, reduced to "
            f"{fine['r'].max():.0f} at most; once {once}; then a branch of 200 points takes {200 * a_point[0]:.2g} s for the "
            f"paper's machine and at most {a_point.max() / a_point[0]:.2g} times that; largest error of a solution "
            f"{percent(table['error'])}, against integration of all degrees of freedom up to {whole['n'].max():.0f}")

    def three_phases_set_2(self):
        (count, lost), (_, ours) = (phases(self.regimes(number)) for number in (2, 1))
        if lost is None:
            return count, f"{count} of 3; contact is never lost"
        return count, (f"{count} of 3; contact is lost between {lost[0]:g} and {lost[1]:g} Hz"
                       + (f", with set 1 between {ours[0]:g} and {ours[1]:g} Hz" if ours else ""))

    def least_share_true(self):
        shares = [share(right(self.errors(number)[10])) for number in (1, 2)]
        return min(shares), (" and ".join(f"set {number}: {self.words_on(number, 10)}" for number in (1, 2))
                             + "; no other nonlinearity tested")


def named(m):
    return f"{m} harmonic{'s' if m > 1 else ''}" if m < NOT_ENOUGH else f"more than {MOST_HARMONICS} harmonics"


def listed(speeds):
    return ", ".join(f"{f:g}" for f in np.sort(speeds))


def percent(errors):
    """The largest error, or that some speed has no solution."""
    found = errors[np.isfinite(errors)]
    missed = errors.size - found.size
    if found.size == 0:
        return "unknown (no solution)"
    largest = 100 * found.max()
    words = f"{largest:.2g} %" if largest < 99.5 else f"{largest:.0f} %"
    return words + (f" ({missed} speed{'s' if missed > 1 else ''} without solution)" if missed else "")


def strongest(rows, order, centre):
    """The speed near `centre` at which a harmonic is largest beside the first; none if that is no peak."""
    near = rows.rows(np.abs(rows["f"] / centre - 1) <= 0.15)
    f = near["f"][near[f"h_{order}"].argmax()]
    return f if near["f"].min() < f < near["f"].max() else None


def judged(folder, **options):
    """Each claim with its quantity, what there is to say beside it, and where to look for its range."""
    evidence = Evidence(folder, **options)
    for claim in RULES["claim"]:
        value, words = getattr(evidence, claim["quantity"])()
        yield claim, value, words, evidence


def write(folder, output):
    header = ["# The paper's claims, judged by the rules of data/claims.toml", source_line(),
              f"# modelled: nothing; the tables of {folder} and data/reference",
              *(f"# column: {name} [-] {meaning}" for name, meaning in COLUMNS.items()), "\t".join(COLUMNS)]
    rows = ["\t".join((claim["id"], claim["claim"], claim["paper"], words, verdict(claim, value),
                       claim.get("rests_on", "nothing"), claim["evidence"],
                       *evidence.ranges(claim, value), claim["question"]))
            for claim, value, words, evidence in judged(folder)]
    Path(output).write_text("\n".join(header + rows) + "\n", encoding="utf-8")


def stored(path):
    """The claims of a table, each as {column: cell}."""
    lines = [line.split("\t") for line in Path(path).read_text(encoding="utf-8").splitlines() if line[:1] != "#"]
    return [dict(zip(lines[0], line)) for line in lines[1:]]


def show(paths):
    for path in paths:
        print(f"\n{path}\n")
        for row in stored(path):
            print(f"{row['id']:4}{row['claim']}\n    asked: {row['question']}\n    paper: {row['paper']}\n"
                  f"    ours:  {row['ours']}\n    {row['verdict'].upper()}   ({row['evidence']})\n"
                  f"    range: {row['low']} ... {row['high']}; {row['range']}")


def check(folder, path):
    """Compares recomputed verdicts with stored ones, with both numbers on a change."""
    before = {row["id"]: row for row in stored(path)}
    changed = 0
    for claim, value, words, _ in judged(folder):
        noise = (0.7, 1, 1.3) if claim.get("timed") else (1,)
        possible = {verdict(claim, value and value * factor) for factor in noise}
        kept = before[claim["id"]]
        if kept["verdict"] not in possible:
            print(f"{claim['id']}: {verdict(claim, value)} ({words}), stored: {kept['verdict']} ({kept['ours']})")
            changed = 1
    return changed


if __name__ == "__main__":
    if sys.argv[1] == "--print":
        show(sys.argv[2:])
    elif sys.argv[1] == "--check":
        sys.exit(check(*sys.argv[2:]))
    else:
        write(*sys.argv[1:])
