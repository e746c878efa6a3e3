"""The numbers of the article, each with its name and its meaning, from the tables they come from.

Usage: paper/article_values.py > data/generated/article.tsv   (from the project's root)
"""
import re
import sys
import tomllib
from pathlib import Path

import numpy as np

sys.path.insert(0, "figures")
from article_results import add_all  # noqa: E402
from project import source_line  # noqa: E402
from tables import Table  # noqa: E402

GENERATED = Path("data/generated")
KEPT = Path("data/reference")
VALUES = []


def add(key, value, unit, meaning):
    """A number, or words made from numbers."""
    VALUES.append((key, value if isinstance(value, str) else f"{float(value):.15g}", unit, meaning))


def paper_values():
    score = tomllib.loads(Path("data/claims.toml").read_text())["score"]
    add("paper.peak", score["paper_peak_hz"], "Hz", "the peak that the paper names")


def claim_counts():
    verdicts = Table(GENERATED / "claims.tsv")["verdict"]
    add("claims.count", len(verdicts), "-", "claims")
    for verdict in ("reproduced", "partly", "not reproduced", "not tested"):
        add(f"claims.{verdict.replace(' ', '_')}", sum(verdicts == verdict), "-",
            f"claims {verdict}, exchanged reading")


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
        add(f"peak.fr_set_{number}", f"{up['f'][peak]:.1f}".replace(".", ","), "Hz", "the same in French")
        aperiodic = (time["periodic"] == 0).mean()
        add(f"aperiodic.share_set_{number}", aperiodic, "-",
            "share of the speeds whose integrated motion is not T-periodic")
        add(f"aperiodic.fr_set_{number}", f"{100 * aperiodic:.0f} %", "-", "the same in French")


def displacements():
    for name in ("fig04", "fig05"):
        table = Table(GENERATED / f"{name}_displacements.tsv")
        add(f"{name}.f", table.first("f"), "Hz", "speed of the figure")
        for key, column in (("rms", "difference_rms"), ("force", "difference_force"), ("spread", "spread")):
            add(f"{name}.{key}", table.first(column), "-", column)
        add(f"{name}.regime", "T-periodic" if table.first("periodic") == 1 else "not T-periodic", "-",
            "the integrated motion")
    for name in ("fig06", "fig08"):
        table = Table(GENERATED / f"{name}_orbits.tsv")
        closed = [table.where("panel", panel).first("periodic") == 1 for panel in sorted(set(table["panel"]))]
        add(f"{name}.panels", len(closed), "-", "panels")
        add(f"{name}.open", len(closed) - sum(closed), "-", "of them with a motion that is not T-periodic")


def regimes():
    """The shares that claims C4 to C10 are made of, in the words of data/claims.toml."""
    table = Table(GENERATED / "regimes.tsv").where("set", 1)
    f = table["f"]
    low, middle, high = table.rows(f <= 10), table.rows((f > 10) & (f <= 19)), table.rows(f > 19)
    simple = (high["contact"] == 1) & (high["higher_harmonics"] < 0.05)
    add("C4.low", (low["contact"] == 1).mean(), "-", "low speeds with permanent contact")
    add("C5.multi", (middle["higher_harmonics"] >= 0.05).mean(), "-",
        "middle speeds with orbits of many harmonics")
    add("C6.simple", simple.mean(), "-", "high speeds with simple motion")
    add("C10.once", (high["passed_once"] == 1).mean(), "-",
        "high speeds at which every ball is loaded once in 2T")
    arcs = next(row for row in rows_of(GENERATED / "claims.tsv") if row[0] == "C8")[3]
    first, second = (float(number) for number in re.findall(r"[\d.]+", arcs)[:2])
    add("C8.arc_set_1", first, "degrees", "mean loaded arc of set 1 in Fig. 7f")
    add("C8.arc_set_2", second, "degrees", "mean loaded arc of set 2 in Fig. 9d")


def identification():
    table = Table(KEPT / "identification.tsv")
    for reading, name in ((0, "exchanged"), (1, "printed")):
        add(f"identification.best_{name}", table.where("reading", reading)["score"].max(), "-",
            f"best score of the {name} reading")
        used = tomllib.loads(Path(f"data/set1{'' if reading == 0 else '-as-printed'}.toml").read_text())
        rows = table.where("reading", reading)
        off = (np.abs(rows["m_s"] / used["stator"]["mass_kg"] - 1) + np.abs(rows["m_r"] / used["rotor"]["mass_kg"] - 1)
               + np.abs(rows["cage_speed_ratio"] - used["bearing"]["cage_speed_ratio"]))
        add(f"identification.used_{name}", rows["score"][off.argmin()], "-", "score of the masses used, on the grid")


def deviations():
    entries = re.findall(r"^## D-\d\d", Path("paper/deviations.md").read_text(), re.MULTILINE)
    add("deviations.count", len(entries), "-", "entries of the page of deviations")
    for key, value, unit, meaning in rows_of(GENERATED / "deviations.tsv"):
        add(key, float(value), unit, meaning)


def environment():
    """What compiled, drew and wove, as a list in a sentence."""
    *most, last = Path("build/environment.txt").read_text().splitlines()
    add("environment.list", f"{', '.join(most)} and {last}", "-", "programs and libraries, with versions")


def rows_of(path):
    """The cells of a table as words."""
    lines = [line for line in path.read_text().splitlines() if line and not line.startswith("#")]
    return [line.split("\t") for line in lines[1:]]


def main():
    for part in (paper_values, claim_counts, response, displacements, regimes, identification, deviations,
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
