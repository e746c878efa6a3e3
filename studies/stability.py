"""Stability of the response curves of Fig. 3, which the paper does not mention.

Each curve is a branch of `explore response --stability`, followed by its arc length so that it may turn back. The multipliers
and bifurcations are those of the motion of Eq. 7 that shooting finds near each point; with few harmonics those of the
series itself can be wrong where the amplitude is right. The folds are those of the m harmonics: their number grows with
m, because the contact has no damping and each further harmonic can excite another contact resonance. A curve that does
not reach the end of the range is followed from there too. Points without multipliers are left out where the curve does
not need them.

Usage: studies/stability.py data/scenes/stability.toml > stability.tsv   (from the project's root)
"""
import os
import sys
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(1, str(Path(__file__).parents[1] / "figures"))
from rotor_stator import attempt  # noqa: E402
from tables import STABILITY, print_columns, print_header  # noqa: E402

AMPLITUDES = ("amp_x_s", "amp_y_s", "amp_x_r", "amp_y_r")
OF_CURVE = ("direction", "samples", "folds", "complete", "evaluations")
NOT_EXAMINED = -2
NEAR, ALIKE = 0.1, 0.03  # [Hz], relative: no eye would miss a point so near the one before
COLUMNS = [
    ("set", "-", "data set"), ("curve", "-", "counts the branches, in the order of the scene"), ("harmonics", "-", "m"),
    ("f", "Hz", "speed of rotation"), *((name, "m", f"half peak-to-peak of {name[4:]}") for name in AMPLITUDES),
    ("arc", "-", "scaled arc length from the branch's first point"),
    ("largest_multiplier", "-", "modulus; of the motion of Eq. 7 found there; -1 if not examined or not found"),
    ("change", "-", "uncertainty of it"),
    ("stable", "-", "the machine: 1 stable, 0 unstable, -1 within the uncertainty, -2 not examined or no motion found"),
    ("bifurcation", "-", "of the machine: plus-one, period-doubling: a multiplier passes 1, -1; neimark-sacker: a pair "
     "passes the circle; of the m harmonics: fold; - none"),
    ("speed_uncertainty", "Hz", "of the machine's bifurcation")]


def followed(file, scene, m, direction):
    """The branch, as far as explore followed it; None without a solution to begin with."""
    return attempt("response", file, from_=scene["from_hz"], to=scene["to_hz"], harmonics=m, direction=direction, stability=True, budget=1e15)


def dispensable(table, k, before):
    """Whether a point without multipliers can be left out after the one before."""
    if table["multiplier"][k] >= 0 or table["bifurcation"][k] != "-" or abs(table["f"][k] - table["f"][before]) > NEAR:
        return False
    return all(abs(table[name][k] - table[name][before]) <= ALIKE * table[name][before] for name in AMPLITUDES)


def rows_of(table):
    """The cells from f on."""
    uncertainties = (uncertainty for *_, uncertainty in table.members("bifurcation"))
    rows, kept = [], None
    for k in range(len(table)):
        of_machine = table["bifurcation"][k] not in ("-", "fold")
        uncertainty = next(uncertainties) if of_machine else 0
        if kept is not None and dispensable(table, k, kept):
            continue
        kept = k
        examined = table["multiplier"][k] >= 0
        stable = STABILITY[table["verdict"][k]] if examined else NOT_EXAMINED
        rows.append([f"{table['f'][k]:.12g}", *(f"{table[name][k]:.7g}" for name in AMPLITUDES),
                     f"{table['arc'][k]:.9g}", f"{table['multiplier'][k]:.9g}", f"{table['multiplier_change'][k]:.2g}",
                     str(stable), table["bifurcation"][k], f"{uncertainty:.2g}"])
    return rows


def curve(scene, number, m):
    """The branches of one data set with m harmonics: up, and down where the first does not reach the end."""
    file = f"data/{scene['parameters'][number]}.toml"
    up = followed(file, scene, m, "up")
    return [up] if up is not None and up.value("complete") == "yes" else [up, followed(file, scene, m, "down")]


def main(file):
    scene = tomllib.loads(Path(file).read_text(encoding="utf-8"))
    curves = [(number, m) for number in range(len(scene["parameters"])) for m in scene["harmonics"]]
    with ThreadPoolExecutor(os.cpu_count()) as pool:  # the long ones first
        tables = list(pool.map(lambda at: curve(scene, *at), reversed(curves)))[::-1]
    branches = [(number, m, table) for (number, m), found in zip(curves, tables) for table in found if table]
    sets = {number: table for number, _, table in reversed(branches)}
    curves = [("curve", [count, number + 1, m, float(table["f"][0]), *(table.value(key) for key in OF_CURVE), *table.members("undecided")[0][1:]])
              for count, (number, m, table) in enumerate(branches, 1)]
    print_header("Stability along the response curves", [sets[number] for number in sorted(sets)],
                 f"row curve: number, set, m, first speed [Hz], {', '.join(OF_CURVE)}, undecided points, bifurcations not located",
                 rows=curves)
    print_columns(COLUMNS)
    for count, (number, m, table) in enumerate(branches, 1):
        for row in rows_of(table):
            print("\t".join([str(number + 1), str(count), str(m), *row]))
        print()


if __name__ == "__main__":
    main(*sys.argv[1:])
