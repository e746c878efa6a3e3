"""The quantities of data/claims.toml that follow from motions, speed by speed, of one machine.

`rows` is a Table with a row for each speed of one data set: f, contact, turns, higher_harmonics, largest_force,
amp_x_r, and what else a function names. The same functions judge the machine of the parameter files (regimes.tsv)
and every other machine that the text admits (identification.tsv). No function depends on the order of the rows.
"""
import tomllib
from pathlib import Path

import numpy as np

RULES = tomllib.loads(Path("data/claims.toml").read_text(encoding="utf-8"))
LIMITS = RULES["regimes"]
LOW_TO, MIDDLE_TO = LIMITS["low_to_hz"], LIMITS["middle_to_hz"]
NOT_ENOUGH = 17  # harmonics: none of those tried suffices


def share(condition):
    """Share of true values; 0 of none."""
    return float(np.mean(condition)) if condition.size else 0.0


def low(rows):
    return rows.rows(rows["f"] <= LOW_TO)


def middle(rows):
    return rows.rows((rows["f"] > LOW_TO) & (rows["f"] <= MIDDLE_TO))


def high(rows):
    return rows.rows(rows["f"] > MIDDLE_TO)


def losing(rows):
    """The speeds at which contact is lost at times."""
    return np.sort(rows["f"][rows["contact"] < 1])


def peak(rows):
    """C1: speed of the largest amp_x_r, and that amplitude, by the parabola through the highest points."""
    order = np.argsort(rows["f"])
    f, a = rows["f"][order], rows["amp_x_r"][order]
    top = int(np.argmax(a))
    if top in (0, a.size - 1):
        return f[top], a[top]
    curve = np.polyfit(f[top - 1:top + 2] - f[top], a[top - 1:top + 2] / a[top], 2)
    shift = -curve[1] / (2 * curve[0])
    return f[top] + shift, a[top] * np.polyval(curve, shift)


def loaded_once(rows):
    """Whether every ball gains and loses contact only as the cage carries it on, speed by speed."""
    return rows["passed_once"] == 1


def low_permanent(rows, f_loss):
    """C4."""
    return share(loaded_once(low(rows))) if f_loss >= LOW_TO else 0.0


def middle_complex(rows):
    """C5."""
    if middle(rows)["higher_harmonics"].mean() < LIMITS["multi_harmonic"]:
        return 0.0
    return share(~loaded_once(middle(rows)))


def lost_inside(rows):
    """Share of the time without contact, over all speeds, that lies in the middle range; 0 if there is none."""
    lost = np.sum(1 - rows["contact"])
    return min(1.0, float(np.sum(1 - middle(rows)["contact"]) / lost)) if lost > 0 else 0.0  # rounding


def rest(rows):
    """Mean of the higher harmonics and the time without contact; a speed without rotating contact counts 1."""
    if len(rows) == 0:
        return 1.0
    moving = rows["higher_harmonics"] + 1 - rows["contact"]
    return float(np.mean(np.where(rows["turns"] == 1, moving, 1.0)))


def high_rest(rows):
    """C6."""
    return rest(high(rows))


def force_rise(rows):
    """C7, and the two forces."""
    order = np.argsort(rows["f"])
    first = np.interp(MIDDLE_TO, rows["f"][order], rows["largest_force"][order])
    top = rows["largest_force"][rows["amp_x_r"].argmax()]
    return top / first, first, top


def passes(rows, cage):
    """C10: of the force's direction over a ball in two periods, where the contact rotates."""
    rotating = high(rows)
    turns = rotating["turns"][rotating["turns"] == 1]
    return float(np.mean(np.abs(2 * turns - 2 * cage))) if turns.size else 0.0


def phases(rows):
    """C13: how many of the three are found, and the speeds between which contact is lost."""
    lost = losing(rows)
    if lost.size == 0:
        return 1 + (rest(high(rows)) <= LIMITS["multi_harmonic"]), None
    before = rows.rows(rows["f"] < lost[0])
    after = rows.rows(rows["f"] > lost[-1])
    held = share(before["turns"] == 0) >= 0.9
    return 1 + held + (rest(after) <= LIMITS["multi_harmonic"]), (lost[0], lost[-1])


def right(errors):
    """Speed by speed; the error is infinite without a solution, or where no T-periodic motion attracts."""
    return errors <= LIMITS["accurate"]


def harmonics_transition(rows, errors):
    """C3: smallest m that is right at every T-periodic speed of the middle range, {m: error at each speed of `rows`}; none if
    fewer than half of its speeds are T-periodic."""
    inside = (rows["f"] > LOW_TO) & (rows["f"] <= MIDDLE_TO)
    asked = inside & (rows["periodic"] == 1)
    if asked.sum() < inside.sum() / 2:
        return None
    enough = [m for m in sorted(errors) if right(errors[m][asked]).all()]
    return enough[0] if enough else NOT_ENOUGH


def verdict(claim, value):
    if value is None:
        return "not tested"
    for name in ("reproduced", "partly"):
        least, most = claim[name]
        if least <= value <= most:
            return name
    return "not reproduced"
