"""The quantities of data/claims.toml that follow from motions, speed by speed, of one machine.

`rows` is a Table with a row for each speed of one data set: f, contact, turns, passages,
higher_harmonics, largest_force, amp_x_r, and what else a function names. The same functions judge
the masses of the parameter files (regimes.tsv) and all others that the text admits
(identification.tsv), with both versions of Table 1. No function depends on the order of the rows.
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


def more_often(rows, cage):
    """Where balls are loaded more often than the turning of the cage and of the contact brings about. Two periods
    are no whole number of turns of the cage unless it is 1/2: a ball may then be counted at both of their ends."""
    expected = np.maximum(2 * cage, 2 * np.abs(rows["turns"] - cage))
    return rows["passages"] > (1 + LIMITS["more_often"]) * expected + (0 if cage == 0.5 else 1 / 8)


def low_permanent(rows, f_loss, cage):
    """C4."""
    slow = low(rows)
    return share((slow["contact"] == 1) & ~more_often(slow, cage)) if f_loss >= LOW_TO else 0.0


def middle_complex(rows, cage):
    """C5."""
    between = middle(rows)
    if between["higher_harmonics"].mean() < LIMITS["multi_harmonic"]:
        return 0.0
    return share(more_often(between, cage))


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
    """C10: of the force's direction over a ball in two periods; 0 where the contact does not rotate."""
    turns = high(rows)["turns"]
    return float(np.mean(np.where(turns == 1, np.abs(2 * turns - 2 * cage), 0.0))) if turns.size else 0.0


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
    """C2, C14: share of the speeds with a small error; `errors` is infinite where nothing is T-periodic."""
    return share(errors <= LIMITS["accurate"])


def harmonics(errors, periodic):
    """C3: smallest m whose error, {m: at each speed}, is small at all of them; none if a T-periodic motion attracts at
    fewer than half of the speeds."""
    if share(periodic) < 0.5:
        return None
    enough = [m for m in sorted(errors) if (errors[m] <= LIMITS["accurate"]).all()]
    return enough[0] if enough else NOT_ENOUGH


def verdict(rule, value):
    if value is None:
        return "not tested"
    for name in ("reproduced", "partly"):
        least, most = rule[name]
        if least <= value <= most:
            return name
    return "not reproduced"
