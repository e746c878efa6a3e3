"""The verdict on each claim of the paper, from the tables and the rules of data/claims.toml.

Usage: figures/claims.py TABLES_DIR OUTPUT.tsv    one reading's claims.tsv
       figures/claims.py --print FILE.tsv...      a readable table of one or more of them
       figures/claims.py --check DIR STORED.tsv   recompute, and compare with the stored verdicts
"""
import re
import sys
import tomllib
from pathlib import Path

import numpy as np
from project import source_line
from tables import Table

RULES = tomllib.loads(Path("data/claims.toml").read_text(encoding="utf-8"))
REGIMES = RULES["regimes"]
MOST_HARMONICS = 16


def share(condition):
    """Share of true values; 0 of none."""
    return float(np.mean(condition)) if condition.size else 0.0


class Evidence:
    """The tables of one reading, read when they are first asked for, and the claims' quantities."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.tables = {}
        # The long studies' tables are kept; the parametric study does not depend on the reading.
        kept = Path("data/reference")
        printed = "as-printed" if self.folder.name == "as-printed" else ""
        self.kept = {"clearance_stiffness": kept / "clearance_stiffness.tsv",
                     "validity": kept / printed / "validity.tsv"}

    def table(self, name):
        if name not in self.tables:
            self.tables[name] = Table(self.kept.get(name, self.folder / f"{name}.tsv"))
        return self.tables[name]

    def ranges(self, number):
        """The regimes of a data set at low, middle and high speeds."""
        rows = self.table("regimes").where("set", number)
        low, middle = REGIMES["low_to_hz"], REGIMES["middle_to_hz"]
        f = rows["f"]
        return (rows.rows(f <= low), rows.rows((f > low) & (f <= middle)), rows.rows(f > middle))

    # -- quantities of claims.toml: a number, and what there is to say beside it ----------------

    def peak_frequency(self):
        rows = self.table("fig03_response").where("set", 1).where("curve", 1)
        top = rows["amp_x_r"].argmax()
        return rows["f"][top], f"{rows['f'][top]:.1f} Hz, {1e3 * rows['amp_x_r'][top]:.2f} mm"

    def fixed(self, number):
        """The rows of a data set with a number of harmonics that was not chosen for a tolerance."""
        return self.table("validity").where("set", number).where("adaptive", 0)

    def harmonics(self, number):
        """Smallest m from which on the distance stays below each limit at all speeds."""
        rows = self.fixed(number)
        worst = {}
        for m in range(1, MOST_HARMONICS + 1):
            at = rows.where("m", m)
            worst[m] = at["distance"].max() if at["found"].all() else np.inf
        words = []
        for limit in REGIMES["distance_limits"]:
            below = [m for m in worst if worst[m] <= limit]
            words.append(f"{100 * limit:g} %: {below[0] if below else 'none'}")
        above = [m for m in worst if not worst[m] <= REGIMES["distance_limits"][0]]
        smallest = max(above, default=0) + 1
        stays = smallest if smallest <= MOST_HARMONICS else "none"
        gaps = [m for m in worst if not np.isfinite(worst[m])]
        missed = (f"; {len(gaps)} of the {MOST_HARMONICS} m leave speeds without solution, from m = {gaps[0]} on"
                  if gaps else "")
        return smallest, f"first m below {', '.join(words)}; staying below: {stays}{missed}"

    def harmonics_set_1(self):
        value, words = self.harmonics(1)
        rows = self.fixed(1).where("m", 6)
        found = rows.where("found", 1)
        words += (f"; m = 6: largest distance {100 * found['distance'].max():.2g} %, force "
                  f"{100 * found['distance_force'].max():.3g} %")
        return value, words

    def harmonics_set_2(self):
        value, words = self.harmonics(2)
        rows = self.fixed(2).where("m", 10)
        missed = int((rows["found"] == 0).sum())
        return value, f"{words}; m = 10: the sweep misses {missed} speeds"

    def low_permanent(self, number=1):
        value = share(self.ranges(number)[0]["contact"] == 1)
        return value, f"{100 * value:.0f} % of the low speeds"

    def middle_complex(self, number=1):
        middle = self.ranges(number)[1]
        everywhere = self.table("regimes").where("set", number)
        lost = everywhere["f"][everywhere["contact"] < 1]
        if lost.size == 0:
            return 0.0, "contact is never lost"
        many = middle["higher_harmonics"] >= REGIMES["multi_harmonic"]
        inside = (lost > REGIMES["low_to_hz"]) & (lost <= REGIMES["middle_to_hz"])
        value = share((middle["contact"] < 1) | many) * share(inside)
        return value, (f"contact lost at {lost.size} speeds, {lost.min():g}-{lost.max():g} Hz; "
                       f"{100 * share(many):.0f} % of the middle speeds multi-harmonic")

    def high_simple(self, number=1):
        high = self.ranges(number)[2]
        value = share((high["contact"] == 1)
                      & (high["higher_harmonics"] < REGIMES["multi_harmonic"]))
        return value, f"{100 * value:.0f} % of the high speeds"

    def force_rise(self):
        rows = self.table("regimes").where("set", 1)
        peak = rows["largest_force"][rows["amp_x_r"].argmax()]
        first = self.ranges(1)[2]["largest_force"][0]
        return peak / first, f"{first:.0f} N to {peak:.0f} N, {peak / first:.1f} times"

    def arc_ratio(self):
        arcs = []
        for figure in ("fig07_contact", "fig09_contact"):
            table = self.table(figure)
            last = table.where("panel", table["panel"].max())
            arcs.append(360 * share(last["Q"] > 0))
        return arcs[1] / arcs[0], f"{arcs[0]:.0f} and {arcs[1]:.0f} degrees, ratio {arcs[1] / arcs[0]:.2f}"

    def least_speed_ratio(self):
        aft = self.table("tab02_timing").where("method", "aft")
        pairs = ", ".join(f"{ratio:.1f} at {100 * error:.2g} %"
                          for ratio, error in zip(aft["ratio"], aft["error"]))
        return aft["ratio"].min(), f"times faster, at the error of displacement: {pairs}"

    def high_once(self):
        value = share(self.ranges(1)[2]["passed_once"] == 1)
        return value, f"{100 * value:.0f} % of the high speeds"

    def study_hours_rk4(self):
        timing, study = self.table("tab02_timing"), self.table("clearance_stiffness")
        aft = timing.where("method", "aft").where("harmonics", 6)
        rk4 = timing.where("method", "rk4").where("harmonics", 6)
        points, speeds = study["delta"].size, int(re.search(r"(\d+) speeds", study.header)[1])
        hours = points * rk4.first("cpu_s") / 3600
        ours = points * aft.first("cpu_s") / 3600
        missed = study["missed"].sum() / (points * speeds)
        words = (f"{points} times the sweep of set 1: RK4 {60 * hours:.2g} min, harmonic balance {60 * ours:.2g} min, "
                 f"{100 * missed:.0f} % of its speeds without solution")
        return (hours if ours < 1 and missed < 0.05 else -1.0), words

    def not_tested(self):
        return None, "not tested"

    def three_phases_set_2(self):
        parts = [part(2)[0] for part in (self.low_permanent, self.middle_complex, self.high_simple)]
        words = ", ".join(f"{claim} {value:.2f}" for claim, value in zip(("C4", "C5", "C6"), parts))
        return min(parts), f"quantities for set 2: {words}"

    def least_share_true(self):
        shares = []
        for number in (1, 2):
            rows = self.fixed(number).where("m", 10)
            near = rows["distance"] <= REGIMES["distance_limits"][0]
            shares.append(share((rows["found"] == 1) & near))
        return min(shares), " and ".join(f"{100 * s:.0f} %" for s in shares) + (
            " of the speeds of sets 1 and 2, small and large clearance; no other nonlinearity tested")


def verdict(claim, value):
    if value is None:
        return "not tested"
    for name in ("reproduced", "partly"):
        low, high = claim[name]
        if low <= value <= high:
            return name
    return "not reproduced"


def judged(folder):
    """Each claim with its quantity and what there is to say beside it."""
    evidence = Evidence(folder)
    for claim in RULES["claim"]:
        value, words = getattr(evidence, claim["quantity"])()
        yield claim, value, words


def write(folder, output):
    header = ["# The paper's claims, judged by the rules of data/claims.toml", source_line(),
              f"# modelled: nothing; the tables of {folder} and data/reference",
              "# column: id [-] of the claim", "# column: claim [-] in words",
              "# column: paper [-] what the paper says", "# column: ours [-] what the tables say",
              "# column: verdict [-] reproduced, partly, not reproduced or not tested",
              "# column: evidence [-] file: columns",
              "id\tclaim\tpaper\tours\tverdict\tevidence"]
    rows = ["\t".join((claim["id"], claim["claim"], claim["paper"], words, verdict(claim, value),
                       claim["evidence"])) for claim, value, words in judged(folder)]
    Path(output).write_text("\n".join(header + rows) + "\n", encoding="utf-8")


def stored(path):
    lines = Path(path).read_text(encoding="utf-8").splitlines()
    return [line.split("\t") for line in lines if not line.startswith("#")][1:]


def show(paths):
    for path in paths:
        print(f"\n{path}\n")
        for number, claim, paper, ours, judgement, evidence in stored(path):
            print(f"{number:4}{claim}\n    paper: {paper}\n    ours:  {ours}\n"
                  f"    {judgement.upper()}   ({evidence})")


def check(folder, path):
    """Compares recomputed verdicts with stored ones, with both numbers on a change."""
    before = {row[0]: row for row in stored(path)}
    changed = 0
    for claim, value, words in judged(folder):
        noise = (0.7, 1, 1.3) if claim.get("timed") else (1,)
        possible = {verdict(claim, value and value * factor) for factor in noise}
        _, _, _, kept_words, kept, _ = before[claim["id"]]
        if kept not in possible:
            print(f"{claim['id']}: {verdict(claim, value)} ({words}), stored: {kept} ({kept_words})")
            changed = 1
    return changed


if __name__ == "__main__":
    if sys.argv[1] == "--print":
        show(sys.argv[2:])
    elif sys.argv[1] == "--check":
        sys.exit(check(*sys.argv[2:]))
    else:
        write(*sys.argv[1:])
