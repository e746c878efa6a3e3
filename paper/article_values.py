"""The numbers of the article, each with its name and its meaning, from the tables they come from.

Usage: paper/article_values.py > data/generated/article.tsv   (from the project's root)
"""
import re
import sys
import tomllib
from pathlib import Path

import numpy as np

sys.path[:0] = ["figures", "studies"]
import claim_quantities as quantities  # noqa: E402
from article_results import add_all  # noqa: E402
from claim_score import KINDS, changing, differing, in_words, listed, score, stored  # noqa: E402
from claims import Evidence  # noqa: E402
from project import source_line  # noqa: E402
from tables import Table  # noqa: E402

GENERATED = Path("data/generated")
KEPT = Path("data/reference")
VALUES = []


def add(key, value, unit, meaning):
    """A number, or words made from numbers."""
    VALUES.append((key, value if isinstance(value, str) else f"{float(value):.15g}", unit, meaning))


def paper_values():
    text = quantities.RULES["accepted"]
    add("paper.peak", text["paper_peak_hz"], "Hz", "the peak that the paper names")
    add("paper.balls", tomllib.loads(Path("data/set1.toml").read_text())["bearing"]["balls"], "-", "balls")
    add("paper.loss", text["paper_loss_hz"], "Hz", "the speed of its Fig. 4")
    for claim in quantities.RULES["claim"]:
        if claim["id"] in ("C2", "C3"):
            add(f"paper.m_{int(claim['id'][1]) - 1}", float(claim["paper"]), "-", f"harmonics that suffice in the paper, {claim['id']}")
    for name, speed in zip(("from", "to"), text["loss_hz"]):
        add(f"paper.loss_{name}", speed, "Hz", "its transition")
    add("paper.loss_width", text["loss_hz"][1] - text["loss_hz"][0], "Hz", "its width")


def claim_counts():
    """The scores of both versions of Table 1, and what decides between them."""
    claims, printed = (stored(folder / "claims.tsv") for folder in (GENERATED, GENERATED / "as-printed"))
    add("claims.count", len(claims), "-", "claims")
    for key, one in (("exchanged", claims), ("printed", printed)):
        add(f"claims.{key}", in_words(one), "-", f"how many claims end in which way, {key}")
        add(f"claims.{key}_counts", in_words(one, ids=False), "-", "the same without the claims")
    for name, ids in score(claims).items():
        add(f"claims.exchanged_{name}", len(ids), "-", f"claims {KINDS[name]}, exchanged")
    for key, one in (("changing", claims), ("changing_printed", printed)):
        add(f"claims.{key}", listed(changing(one)), "-", "claims whose verdict depends on masses or cage")
    add("claims.differ", listed(differing(claims, printed)), "-", "claims with another verdict in the printed order")
    by_id = {claim["id"]: claim for claim in claims}
    for name in ("C3", "C11", "C12", "C14"):
        add(f"{name}.verdict", by_id[name]["verdict"], "-", f"verdict on {name}")
    add("C11.found", by_id["C11"]["ours"], "-", "what was found on C11")
    add("claims.confirmed_words", listed([claim["claim"] for claim in claims if claim["id"] in score(claims)["confirmed"]]),
        "-", "the confirmed claims")


def shares_right():
    """C2 and C14: at which share of all speeds few harmonics are right, for both versions of Table 1."""
    evidence, printed = Evidence(GENERATED), Evidence(GENERATED / "as-printed")
    for key, one, number, m in (("C2_exchanged", evidence, 1, 6), ("C2_printed", printed, 1, 6), ("one_exchanged", evidence, 1, 1),
                                ("C14_2_exchanged", evidence, 2, 10)):
        add(f"right.{key}", quantities.right(one.errors(number, m)), "-", f"share of all speeds of set {number} at which {m} harmonics are right")
    for key, one in (("exchanged", evidence), ("printed", printed)):
        periodic = one.periodic(1)
        add(f"C2.periodic_{key}", periodic.mean(), "-", "share of all speeds at which a T-periodic motion attracts")
        add(f"C2.among_{key}", quantities.right(one.errors(1, 6)[periodic]), "-", "share of these at which 6 harmonics are right")
    add("C14.periodic_2", evidence.periodic(2).mean(), "-", "share of all speeds of set 2 at which a T-periodic motion attracts")
    add("C2.largest_right", quantities.right(evidence.errors(1, 6, "distance_largest")), "-", "C2 by the largest error")
    add("C2.limit_least", evidence.same_verdict(evidence.errors(1, 6))[0], "-", "limit of the error from which on the verdict is the same")
    add("C2.without", (~evidence.periodic(1)).sum(), "-", "speeds of set 1 without a T-periodic motion")
    inside = evidence.in_transition(2)
    add("C3.middle", inside.sum(), "-", "speeds of the transition")
    add("C3.transition", (evidence.periodic(2) & inside).sum(), "-", "of them with a T-periodic motion")


def response():
    table = Table(GENERATED / "fig03_response.tsv")
    for number in (1, 2):
        rows = table.where("set", number)
        up, time = rows.where("curve", 1), rows.where("curve", 3)
        peak = up["amp_x_r"].argmax()
        lost = time["f"][time["contact"] < 1]
        add(f"peak.f_set_{number}", up["f"][peak], "Hz", "speed of the largest amp_x_r")
        add(f"peak.mm_set_{number}", 1e3 * up["amp_x_r"][peak], "mm", "largest amp_x_r")
        add(f"loss.first_set_{number}", lost.min(), "Hz", "first speed that loses contact")
        add(f"loss.last_set_{number}", lost.max(), "Hz", "last speed that loses contact")
        add(f"loss.width_set_{number}", np.ptp(lost), "Hz", "between both")
        begun = Table(GENERATED / "regimes.tsv").where("set", number)
        begun = begun["f"][begun["contact"] < 1]
        add(f"loss.begun_first_set_{number}", begun.min(), "Hz", "the same where integration begins on the harmonic-balance solution")
        add(f"loss.begun_last_set_{number}", begun.max(), "Hz", "its last speed")
        add(f"peak.fr_set_{number}", f"{up['f'][peak]:.1f}".replace(".", ","), "Hz", "the same in French")
        aperiodic = (time["periodic"] == 0).mean()
        add(f"aperiodic.share_set_{number}", aperiodic, "-",
            "share of the speeds whose integrated motion is not T-periodic")
        add(f"aperiodic.rest_{number}", 1 - aperiodic, "-", "share of those whose motion is")


def displacements():
    for name in ("fig04", "fig05"):
        table = Table(GENERATED / f"{name}_displacements.tsv")
        add(f"{name}.f", table.first("f"), "Hz", "speed of the figure")
        for key, column in (("rms", "difference_rms"), ("force", "difference_force"), ("spread", "spread"),
                            ("rms_error", "difference_rms_error"), ("spread_error", "spread_error")):
            add(f"{name}.{key}", table.first(column), "-", column)
        add(f"{name}.regime", "T-periodic" if table.first("periodic") == 1 else "not T-periodic", "-",
            "the integrated motion")
    for name in ("fig06", "fig08"):
        table = Table(GENERATED / f"{name}_orbits.tsv")
        if name == "fig06":
            add("fig06.spread", table.where("f", Table(GENERATED / "fig04_displacements.tsv").first("f")).first("spread"), "-", "spread at the speed of Fig. 4, another stretch of time")
        closed = [table.where("panel", panel).first("periodic") == 1 for panel in sorted(set(table["panel"]))]
        add(f"{name}.panels", len(closed), "-", "panels")
        add(f"{name}.open", len(closed) - sum(closed), "-", "of them with a motion that is not T-periodic")


def regimes():
    """The shares and means that claims C4 to C10 are made of, in the words of data/claims.toml."""
    table = Table(GENERATED / "regimes.tsv").where("set", 1)
    low, middle, high = (part(table) for part in (quantities.low, quantities.middle, quantities.high))
    joint = Table(GENERATED / "tab01_parameters.tsv").first("f_joint")
    cage = Table(GENERATED / "tab01_parameters.tsv").first("cage_speed_ratio")
    often = quantities.more_often(low, cage)
    add("C4.low", (low["contact"] == 1).mean(), "-", "low speeds with permanent contact")
    add("C4.often", often.mean(), "-", "low speeds at which single balls lose contact more often")
    add("C4.first", low["f"][often].min(), "Hz", "the first of them")
    add("C5.often", quantities.more_often(middle, cage).mean(), "-", "middle speeds at which they do")
    add("C5.higher", middle["higher_harmonics"].mean(), "-", "higher harmonics in the mean of the middle speeds")
    add("C6.rest", quantities.high_rest(table), "-", "the same of the high speeds")
    top = high["higher_harmonics"].argmax()
    add("C6.most", high["higher_harmonics"][top], "-", "most of them at a high speed")
    add("C6.most_f", high["f"][top], "Hz", "that speed")
    add("C6.half", joint / 2, "Hz", "half the joint resonance")
    add("C10.rotating", (high["turns"] == 1).mean(), "-", "high speeds with rotating contact")
    add("C10.once", (high["passed_once"] == 1).mean(), "-",
        "high speeds at which every ball is loaded without interruption, once in 2T")
    arcs = next(row for row in rows_of(GENERATED / "claims.tsv") if row[0] == "C8")[3]
    first, second = (float(number) for number in re.findall(r"[\d.]+", arcs)[:2])
    add("C8.arc_set_1", first, "degrees", "mean loaded arc of set 1 in Fig. 7f")
    add("C8.arc_set_2", second, "degrees", "mean loaded arc of set 2 in Fig. 9d")


def identification():
    """The masses that the text admits, and what follows from those that are used."""
    accepted = {reading: rest for reading, *rest in Table(KEPT / "identification.tsv").members("accepted")}
    for name, folder, file in (("exchanged", GENERATED, "exchanged"), ("printed", GENERATED / "as-printed", "as-printed")):
        least, most, _, best = accepted[file]
        for key, value in (("from", least), ("to", most), ("best", best)):
            add(f"identification.{key}_{name}", value, "kg", "accepted mass of the stator, or the best guess")
        used = Table(folder / "tab01_parameters.tsv")
        for key, column, factor, unit in (("used", "m_s", 1, "kg"), ("e", "e", 1e3, "mm"), ("loss", "f_loss", 1, "Hz"),
                                          ("again", "f_gravity", 1, "Hz")):
            add(f"identification.{key}_{name}", factor * used.first(column), unit, f"{column} of the masses used")
        curve = Table(folder / "fig03_response.tsv").where("set", 1).where("curve", 1)
        add(f"identification.peak_{name}", 1e3 * curve["amp_x_r"].max(), "mm", "largest amp_x_r of set 1")


def deviations():
    entries = re.findall(r"^## D-\d\d", Path("paper/deviations.md").read_text(), re.MULTILINE)
    add("deviations.count", len(entries), "-", "entries of the page of deviations")
    for key, value, unit, meaning in rows_of(GENERATED / "deviations.tsv"):
        add(key, float(value), unit, meaning)


def environment():
    """What compiled, drew and wove, as a list in a sentence."""
    *most, last = Path("build/environment.txt").read_text().splitlines()
    add("environment.list", f"{', '.join(most)} and {last}", "-", "programs and libraries, with versions")


def citation():
    """Authors and keywords, as CITATION.cff has them."""
    text = Path("CITATION.cff").read_text(encoding="utf-8").split("references:")[0]
    add("code.authors", ", ".join(re.findall(r'^  - name: "(.*)"$', text, re.MULTILINE)), "-", "authors")
    add("code.keywords", ", ".join(re.findall(r'"([^"]*)"', re.search(r"^keywords: (.*)$", text, re.MULTILINE)[1])), "-", "keywords")


def rows_of(path):
    """The cells of a table as words."""
    lines = [line for line in path.read_text().splitlines() if line and not line.startswith("#")]
    return [line.split("\t") for line in lines[1:]]


def main():
    for part in (paper_values, claim_counts, shares_right, citation, response, displacements, regimes, identification, deviations,
                 environment):
        part()
    add_all(add)
    print(f"# The numbers of the article\n{source_line()}\n# column: key [-] name\n# column: value [-] in its unit\n"
          "# column: unit [-] of the value\n# column: meaning [-] what the value is")
    print("key\tvalue\tunit\tmeaning")
    for key, value, unit, meaning in VALUES:
        print(f"{key}\t{value}\t{unit}\t{meaning}")


if __name__ == "__main__":
    main()
