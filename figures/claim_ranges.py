"""The claims' quantities for every machine that the paper's text admits, and for which of them a verdict holds."""
import tomllib
from pathlib import Path

import numpy as np
from claim_quantities import (RULES, force_rise, harmonics, high_rest, low_permanent, middle,
                              middle_complex, passes, peak, phases, right, verdict)

PAPER_PEAK = RULES["accepted"]["paper_peak_hz"]
ARC_SPEEDS = [max(tomllib.loads(Path(f"data/scenes/{figure}.toml").read_text(encoding="utf-8"))["frequencies_hz"])
              for figure in ("fig07_contact", "fig09_contact")]  # of Figs 7f and 9d
JUDGED = (6, 7, 8, 9, 10, 12, 16)  # the numbers of harmonics of identification.tsv


def errors(rows, m):
    """At every speed, infinite where the motion is not T-periodic."""
    return np.where(rows["periodic"] == 1, rows[f"error_{m}"], np.inf)


def quantities(first, second):
    """Of one machine with the small and the large clearance. The peak was given where it is not the paper's."""
    f_loss, cage = first.first("f_loss"), first.first("cage_speed_ratio")
    arcs = [np.interp(f, rows["f"], rows["loaded_arc"]) for f, rows in zip(ARC_SPEEDS, (first, second))]
    one = {"C1": peak(first)[0]} if first.first("f_joint") == PAPER_PEAK else {}
    return one | {"C2": right(errors(first, 6)),
                  "C3": harmonics({m: errors(middle(second), m) for m in JUDGED}, middle(second)["periodic"] == 1),
                  "C4": low_permanent(first, f_loss, cage), "C5": middle_complex(first, cage),
                  "C6": high_rest(first), "C7": force_rise(first)[0], "C8": arcs[1] / arcs[0],
                  "C10": passes(first, cage), "C13": phases(second)[0]}


class Accepted:
    """The accepted machines of one reading, in families of one joint resonance and one cage."""

    def __init__(self, table, reading):
        table = table.where("reading", reading)
        self.families = {}
        for joint, cage in sorted(set(zip(table["f_joint"], table["cage_speed_ratio"]))):
            family = table.where("f_joint", joint).where("cage_speed_ratio", cage)
            self.families[joint, cage] = {
                mass: quantities(*(family.where("m_s", mass).where("set", number) for number in (1, 2)))
                for mass in np.unique(family["m_s"])}

    def values(self, claim):
        """The claim's quantity of every accepted machine; none if it does not depend on the machine."""
        return [machine[claim["id"]] for family in self.families.values() for machine in family.values()
                if claim["id"] in machine]

    def verdicts(self, claim):
        """{family: {mass: verdict}} of the families for which the claim is judged."""
        return {key: {mass: verdict(claim, machine[claim["id"]]) for mass, machine in family.items()}
                for key, family in self.families.items() if all(claim["id"] in one for one in family.values())}

    def words(self, claim, cage):
        """For which masses the verdict is what: with the paper's peak and the cage of the parameter files, then with
        the others, where that changes the verdicts that occur."""
        main = (PAPER_PEAK, cage)
        said = {key: spans(found) for key, found in self.verdicts(claim).items()}
        words = [said.pop(main)]
        for key, other in said.items():
            if kinds(other) != kinds(words[0]):
                words.append(f"{family_name(key, main)}: {other}")
        return "; ".join(words)


def kinds(words):
    """Which verdicts are named, without the masses."""
    return {part.split(" for ")[0] for part in words.split("; ")}


def family_name(key, main):
    joint, cage = key
    return f"c = {cage:g}" if cage != main[1] else f"joint resonance {joint:g} Hz"


def spans(verdicts):
    """`reproduced for m_s in 12...29 kg; partly for m_s in 34...45 kg` of {mass: verdict}."""
    runs = []
    for mass in sorted(verdicts):
        if runs and runs[-1][0] == verdicts[mass]:
            runs[-1][1].append(mass)
        else:
            runs.append((verdicts[mass], [mass]))
    parts = {}
    for name, masses in runs:
        parts.setdefault(name, []).append(
            f"{masses[0]:.3g}...{masses[-1]:.3g}" if len(masses) > 1 else f"{masses[0]:.3g}")
    return "; ".join(f"{name} for m_s in {', '.join(where)} kg" for name, where in parts.items())
