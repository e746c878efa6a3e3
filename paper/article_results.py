"""The article's numbers and words on cost, truth, stability and hard cases.

Words are made here from numbers, so that no sentence of the article says which of two is larger unless
a table says so. A list is one value; its lines are joined by \\n, which include.py turns into lines.
"""
import re
import tomllib
from pathlib import Path

import map_scaling
import numpy as np
from claim_quantities import LIMITS, RULES
from claim_score import listed, stored
from rotor_stator import run
from tables import Table, cells_as_numbers, two_digits

GENERATED, KEPT = Path("data/generated"), Path("data/reference")
REQUIRED = next(rule["reproduced"][0] for rule in RULES["claim"] if rule["id"] == "C2")
METHODS = {"aft": "harmonic balance", "rk4": "Runge-Kutta of order 4",
           "rk4-lanes": "the same, all speeds side by side",
           "splitting": "splitting of order 4", "splitting-lanes": "the splitting, all speeds side by side",
           "central": "central differences", "rk8": "Runge-Kutta of order 8",
           "rkf45": "Runge-Kutta-Fehlberg", "msadams": "Adams", "msbdf": "BDF",
           "bsimp": "Bulirsch-Stoer", "shooting-rk4": "shooting by Runge-Kutta of order 4",
           "shooting-rk8": "shooting by Runge-Kutta of order 8"}


def times(seconds):
    """A CPU time in a unit that suits it."""
    unit, factor = ("s", 1) if seconds >= 1 else ("ms", 1e3) if seconds >= 1e-3 else ("µs", 1e6)
    return f"{two_digits(seconds * factor)} {unit}"


def power(error):
    """An error as 1 % or, where small, as a power of ten."""
    if error >= 1e-4:
        return f"{two_digits(100 * error)} %"
    exponent = int(np.floor(np.log10(error)))
    return rf"${error / 10.0 ** exponent:.2g}\cdot 10^{{{exponent}}}$"


def cheapest(table, reach, target, method):
    """The row of a method with the least time of those that stay below an error; a setting for a smaller one may be cheaper."""
    rows = table.where("range", reach).where("method", method)
    rows = rows.rows(rows["target"] <= target)
    return rows.rows([rows["cpu_s"].argmin()]) if len(rows) else rows


def costs(add):
    """Each range and error: the methods in the order of their time, and those that do not reach it."""
    table, lines = Table(KEPT / "tab02_equal_error.tsv"), []
    for reach in dict.fromkeys(table["range"]):
        for target in sorted(set(table["target"]), reverse=True):
            rows = {method: cheapest(table, reach, target, method) for method in dict.fromkeys(table["method"])}
            best = min((method for method in rows if len(rows[method])), key=lambda method: rows[method].first("cpu_s"))  # noqa: B023
            for method in dict.fromkeys(("aft", "shooting-rk4", "rk4", "rk4-lanes", "splitting-lanes", best)):
                lines.append([reach, power(target), METHODS[method] + (", least time" if method == best else ""),
                              *timed(rows[method])])
    add("table.costs", markdown(["speeds [Hz]", "error allowed", "method", "setting", "CPU time", "error of the force"], lines), "-",
        "CPU time of the sweep at no more than a given error")
    low, high = dict.fromkeys(table["range"])
    for reach, name in ((low, "low"), (high, "high")):
        for rival, key in (("rk4", "rk4"), ("rk4-lanes", "lanes"), ("shooting-rk4", "shooting"), ("splitting-lanes", "splitting")):
            ratios = [(cheapest(table, reach, target, rival).first("cpu_s") / cheapest(table, reach, target, "aft").first("cpu_s"), target)
                      for target in (0.01, 0.001)]
            add(f"cost.{name}_{key}", " and ".join(f"{faster(ratio)} at {power(target)}" for ratio, target in ratios),
                "-", f"harmonic balance beside {rival}, {reach} Hz")
    ours = table.where("range", high).where("target", 0.01).where("method", "aft")
    add("cost.high_m_1", re.match(r"m=([\d.]+)", ours.first("setting"))[1].replace("..", " to "), "-", "its harmonics at the larger error, upper range")
    add("cost.high_force_1", ours.first("error_force"), "-", "its error of the force there")
    add("cost.low_to", float(low.split("-")[1]), "Hz", "end of the lower range")
    add("cost.high_from", float(high.split("-")[0]), "Hz", "begin of the upper range")
    timing = Table(GENERATED / "tab02_timing.tsv")
    rivals, timing = timing.where("method", "rk4"), timing.where("method", "aft")
    slow = rivals.first("paper_cpu")
    add("cost.force_least", timing["error_force"].min(), "-", "least error of the force of the timed sweeps of harmonic balance")
    add("cost.force_most", timing["error_force"].max(), "-", "largest of them")
    words = [f"with {m:.0f} harmonics {ratio:.2g} at an error of {power(error)}, Runge-Kutta {power(other)} "
             f"(the paper: {slow / paper:.1f})"
             for m, ratio, error, other, paper in zip(timing["harmonics"], timing["ratio"], timing["error"],
                                                      rivals["error"], timing["paper_cpu"])]
    add("cost.paper", "; ".join(words), "-", "Runge-Kutta's time over that of harmonic balance")


def timed(row):
    """Setting, CPU time and error of the force of a method, or that it does not reach the error."""
    if not len(row):
        return ["", "not reached", ""]
    return [f"`{row.first('setting')}`", times(row.first("cpu_s")), f"{two_digits(100 * row.first('error_force'))} %"]


def markdown(names, lines):
    """A table of Markdown as one value, its columns as wide as their longest word or, where longer, their cells in the mean, up to 90."""
    columns = [[str(cell) for cell in column] for column in zip(names, *lines)]
    widths = [max(5, *(len(word) + 3 for cell in column for word in cell.split()), min(90, sum(map(len, column)) // len(column)))
              for column in columns]
    return r"\n".join("| " + " | ".join(map(str, line)) + " |" for line in (names, ["-" * width for width in widths], *lines))


def faster(ratio):
    return f"{ratio:.2g} times faster" if ratio >= 1 else f"{1 / ratio:.2g} times slower"


def peers(add):
    """AUTO-07p beside harmonic balance, from the header of its table."""
    table = Table(KEPT / "peers_auto.tsv")
    distances = {run: rest for run, *rest in table.members("distance")}
    for run, _, folds, low, high in table.members("run"):
        counts = ", ".join(f"{count:.0f} with {m:.0f} harmonics" for name, m, _, count in table.members("balance") if name == run)
        speeds, _, largest, at = distances[run]
        add(f"auto.{run}_speeds", speeds, "-", "compared speeds")
        add(f"auto.{run}_high", high, "Hz", "its highest speed")
        add(f"auto.{run}_at", at, "Hz", "speed of the largest")
        add(f"auto.{run}_distance", largest, "-", "largest difference of amplitudes over the largest one")
        add(f"auto.{run}", f"{folds:.0f} folds between {low:.0f} and {high:.0f} Hz, harmonic balance "
            f"over the same speeds {counts}", "-", "folds by AUTO-07p and by harmonic balance")


def outside(add):
    """How near SUNDIALS and SciPy come to the reference of their table, at worst over its motions."""
    found = Table(KEPT / "peers.tsv").members("nearest")
    add("outside.motions", sum(method == "cvode-adams" for *_, method, _ in found), "-", "motions compared")
    for key in ("cvode-adams", "cvode-bdf", "scipy-dop853", "scipy-lsoda"):
        add(f"outside.{key}", max(error for *_, method, error in found if method == key), "-",
            "largest over the motions of its least error")


ANSWERING = {"this": "this project", "this-balance": "harmonic balance", "rk4": "RK4 alone",
             "cvode": "CVODE", "scipy-lsoda": "LSODA", "scipy-dop853": "DOP853"}


def answers(add):
    """Which method answers which question of users: of those whose median error is below the target."""
    table = Table(KEPT / "tab03_answers.tsv")
    reached = table.rows(cells_as_numbers(table["error"]) <= table["target"])
    fastest, ratios = [], {"least": [], "cvode": [], "scipy": []}
    for question, *_ in sorted(table.members("question")):
        at = {}
        for target in sorted(set(table["target"]), reverse=True):
            rows = reached.where("question", question).where("target", target)
            best = rows["method"][rows["cpu_s"].argmin()] if len(rows) else ""
            at.setdefault(ANSWERING.get(best, "no method"), []).append(f"{100 * target:.2g} %")
            ours = rows.where("method", "this")
            if not len(ours):
                continue
            ratios["least"].append(ours.first("cpu_s") / rows["cpu_s"].min())
            for key in ("cvode", "scipy"):
                times_taken = rows["cpu_s"][np.char.startswith(rows["method"], key)]
                if times_taken.size:
                    ratios[key].append(times_taken.min() / ours.first("cpu_s"))
        named = listed([f"{method} at {listed(targets)}" for method, targets in at.items()])
        fastest.append(f"({question}) {named if len(at) > 1 else next(iter(at))}")
    spans = {key: f"{min(found):.2g} to {max(found):.2g}" for key, found in ratios.items() if found}
    add("answers.fastest", f"The least CPU time takes, in question {'; '.join(fastest)}.", "-",
        "fastest of the methods whose median error is below the target")
    add("answers.this", f"The command of this project, for which nothing is chosen, takes {spans['least']} "
        "times the least CPU time; steps and transients of RK4 are chosen with the reference at hand.",
        "-", "CPU time over the least one")
    add("answers.others", f"CVODE takes {spans['cvode']} times the CPU time of this project's command, "
        f"the faster method of SciPy {spans['scipy']} times.", "-", "CPU time over that of the command")


def truth(add):
    """Shares of the speeds with a T-periodic attractor, and the harmonics that reach it."""
    limit = min(LIMITS["distance_limits"])
    add("truth.limit", limit, "-", "distance that counts as reached")
    tight = tomllib.loads(Path("data/scenes/validity.toml").read_text())["tolerance"]
    add("truth.tolerance", tight, "-", "error that was asked for with m chosen")
    for number in (1, 2):
        rows = Table(GENERATED / "truth_intervals.tsv").where("set", number)
        count = rows["speeds"]
        add(f"truth.all_{number}", count.sum(), "-", "speeds looked at")
        for share, name in ((1, "only"), (0.5, "beside"), (0, "none")):
            add(f"truth.{name}_{number}", count[rows["T_periodic"] == share].sum() / count.sum(), "-",
                "share of the speeds with only T-periodic attractors, with others beside, with others alone")
        single = Table(KEPT / "attractors.tsv").where("set", number)
        add(f"truth.exponent_{number}", (single["f"] * single["lyapunov"]).max(), "1/s", "largest Lyapunov exponent")
        chosen = Table(KEPT / "validity.tsv").where("set", number).where("periodic", 1).where("adaptive", 1)
        good = (chosen["found"] == 1) & (chosen["distance"] >= 0) & (chosen["distance"] <= limit)
        add(f"truth.tight_{number}", (good & (chosen["distance"] <= tight)).mean(), "-", "share of the speeds that reach the error asked for")
        add(f"truth.adaptive_m_{number}", chosen["m"][good].max() if good.any() else 0, "-", "its largest m")
    every = Table(KEPT / "validity.tsv").where("set", 1)
    fixed = every.where("periodic", 1).where("adaptive", 0).where("m", 6)
    missed = fixed["f"][(fixed["found"] == 0) | (fixed["distance"] > LIMITS["accurate"])]
    add("C2.all", len(np.unique(every["f"])), "-", "all speeds")
    add("C2.missed", len(missed), "-", "those with a T-periodic attractor and an rms error above the limit")
    add("C2.missed_low", (missed <= 10).sum(), "-", "of them up to 10 Hz")
    add("C2.low", (np.unique(every["f"]) <= 10).sum(), "-", "speeds up to 10 Hz")
    add("C2.where", listed([f"{f:g}" for f in missed]), "Hz", "these speeds")
    add("C2.required", REQUIRED, "-", "share of the speeds that makes a claim about a range reproduced")
    add("C2.limit", LIMITS["accurate"], "-", "the limit of the rule")


def beside_chaos(add):
    """Solutions with the paper's harmonics where no motion of set 2 repeats, at the higher of these speeds."""
    rows = Table(KEPT / "validity.tsv").where("set", 2).where("adaptive", 0).where("m", 10).where("periodic", 0).where("found", 1)
    rows = rows.rows((rows["f"] >= 24.5) & (rows["f"] <= 37.5))
    for key, value in (("from", rows["f"].min()), ("to", rows["f"].max()), ("rms", rows["distance"].max()),
                       ("force_least", rows["distance_force"].min()), ("force_most", rows["distance_force"].max())):
        add(f"chaos.{key}", value, "-", "solutions with 10 harmonics of set 2 beside chaotic motion: speeds, rms errors")


def contact(add):
    """The natural frequency of rotor against stator on the contact's stiffness at rest."""
    values = Table(GENERATED / "deviations.tsv")
    masses = Table(GENERATED / "tab01_parameters.tsv").where("set", 1)
    stiffness = float(values["value"][list(values["key"]).index("D-01.stiffness_ours")])
    f = np.sqrt(stiffness * (1 / masses.first("m_s") + 1 / masses.first("m_r"))) / (2 * np.pi)
    add("contact.f", f, "Hz", "contact's frequency of set 1 at rest")
    add("contact.harmonic_3", f / 3, "-", "the same as a harmonic of 3 Hz")
    (m_s, k_s, c_s), (m_r, k_r, c_r) = ((m, m * w**2, 2 * xi * m * w) for m, w, xi in (
        [masses.first(f"{name}_{body}") for name in ("m", "omega_0", "xi")] for body in "sr"))
    w = 2 * np.pi * 45
    static = masses.first("g") * abs(m_r * k_s - m_s * k_r) / (k_s + k_r)
    turning = masses.first("m_e_e") * w**2 * abs((k_s - m_s * w**2 + 1j * c_s * w)
                                                            / (k_s + k_r - (m_s + m_r) * w**2 + 1j * (c_s + c_r) * w))
    fast = f * (turning / static)**(1 / 6)
    add("contact.f_45", fast, "Hz", "contact's frequency under F_1 at 45 Hz instead of F_0: a stiffness that goes like F^(1/3)")
    add("contact.harmonic_45", fast / 45, "-", "the same as a harmonic of 45 Hz")


def needed(add):
    """The smallest number of harmonics with a given rms error at single speeds of set 1."""
    rows = Table(KEPT / "validity.tsv").where("set", 1).where("adaptive", 0)
    most = rows["m"].max()
    for key, column in (("displacement", "distance"), ("force", "distance_force")):
        for limit in (0.1, 0.01):
            words = []
            for f in (3, 6, 16, 45):
                one = rows.where("f", f)
                right = one["m"][(one["found"] == 1) & (one[column] <= limit)]
                words.append(f"{right.min():.0f}" if len(right) else f"more than {most:.0f}")
            add(f"needed.{key}_{100 * limit:.0f}", listed(words if len(set(words)) > 1 else [f"{words[0]} at each"]), "-", f"harmonics for an rms error of {limit} at 3, 6, 16 and 45 Hz")
    add("needed.speeds", listed(["3", "6", "16", "45"]), "Hz", "these speeds")


def judged(add):
    """How often the multipliers of m harmonics are right, and what a verdict on the machine costs."""
    table = Table(KEPT / "verdicts.tsv")
    found, lines = table.where("found", 1), []
    for number in np.unique(table["set"]).astype(int):
        for m in np.unique(table["m"]).astype(int):
            rows = found.where("set", number).where("m", m)
            known = rows.rows(rows["machine_stable"] >= 0)
            stable = known["machine_stable"] == 1
            wrong = [((known["series_stable"] == 1) & ~stable).sum(), ((known["series_stable"] == 0) & stable).sum()]
            lines.append([number, m, len(rows), stable.sum(), (~stable).sum(), *wrong])
            if (number, m) == (1, 6):
                add("verdicts.series_1_6", wrong[0], "-", 'unstable motions that the series calls "stable"')
                add("verdicts.unstable_1_6", (~stable).sum(), "-", "unstable motions of the machine")
    add("table.verdicts", markdown(
        ["set", "m", "solutions", "stable motions", "unstable motions", 'falsely "stable"', 'falsely "unstable"'],
        lines), "-", "false verdicts by the multipliers of m harmonics")
    known = found.rows(found["machine_stable"] >= 0)
    for number in (1, 2):
        add(f"verdicts.decided_{number}", (found.where("set", number)["machine_stable"] >= 0).mean(), "-", "share with a verdict on the machine")
    false = (known["series_stable"] >= 0) & (known["series_stable"] != known["machine_stable"])
    add("verdicts.known", len(known), "-", "decided verdicts of the machine")
    add("verdicts.false", false.sum(), "-", "false verdicts of the series")
    add("verdicts.false_near", (false & (known["distance"] <= 0.01)).sum(), "-", "of them with an rms distance of at most 1 %")
    finest = known.where("m", known["m"].max())
    add("verdicts.most_count", len(finest), "-", "verdicts on solutions with the most harmonics")
    add("verdicts.most_unstable", (finest["machine_stable"] == 0).sum(), "-", "of them unstable")
    near = found.where("set", 1).where("m", 6)
    k = np.abs(near["f"] - 20).argmin()
    for key, column in (("f", "f"), ("machine", "machine"), ("series", "series"), ("distance", "distance")):
        add(f"verdicts.near20_{key}", near[column][k], "-", f"{column} of the solution of set 1 nearest to 20 Hz, m = 6")
    add("verdicts.m_most", found["m"].max(), "-", "most harmonics of the table")
    add("verdicts.speeds", len(np.unique(table["f"])), "-", "speeds of each set")


def verdicts(add):
    """The claims with what was found and both verdicts, and the version of the programs."""
    claims, printed = (stored(folder / "claims.tsv") for folder in (GENERATED, GENERATED / "as-printed"))
    lines = [[claim["id"], claim["claim"], found(claim), claim["verdict"] + (
        f", by the choice of {claim['built_in']}" if claim["verdict"] == "reproduced" and claim["built_in"] != "-" else ""),
        other["verdict"]] for claim, other in zip(claims, printed)]
    add("table.claims", markdown(["", "the paper", "found", "verdict", "in the printed order"], lines), "-", "the verdicts")
    add("code.version", re.search(r"VERSION (\d\S+) LANGUAGES", Path("CMakeLists.txt").read_text())[1], "-", "version of the programs")


def found(claim):
    """What was found in one sentence: the first of each half."""
    parts = claim["ours"].split("; ")
    return "; ".join(parts[:2] if claim["id"] == "C14" else parts[:1])


def settings(add):
    """What the programs take for T-periodic and for a solution's own motion."""
    for key, file, name in (("spread", "time/settle.cpp", "closed"), ("near", "motion/judge.cpp", "near"),
                            ("kept", "model/read_machine.hpp", "largest"), ("receptance", "model/reduction.cpp", "wanted")):
        text = Path(f"src/{file}").read_text()
        add(f"settings.{key}", float(re.search(rf"\b{name} = ([\d.e-]+)[;,]", text)[1]), "-", f"{name} of src/{file}")


def parameters(add):
    """All parameters of the model, from the files of both data sets and of the printed order."""
    files = [tomllib.loads(Path(f"data/{name}.toml").read_text()) for name in ("set1", "set2", "set1-as-printed")]
    rows = [("mass of the stator", "$m_s$", "kg", "stator", "mass_kg", 1, "bounded by the text (D-13)"),
            ("mass of the rotor", "$m_r$", "kg", "rotor", "mass_kg", 1, "bounded by the text (D-13)"),
            ("natural frequency of the stator", "$\\omega_0^s$", "rad/s", "stator", "natural_frequency_rad_per_s", 1,
             "the paper's Table 1, exchanged (D-09)"),
            ("natural frequency of the rotor", "$\\omega_0^r$", "rad/s", "rotor", "natural_frequency_rad_per_s", 1,
             "the paper's Table 1, exchanged (D-09)"),
            ("damping ratio of the stator", "$\\xi_s$", "-", "stator", "damping_ratio", 1, "the paper's Table 1"),
            ("damping ratio of the rotor", "$\\xi_r$", "-", "rotor", "damping_ratio", 1, "the paper's Table 1"),
            ("unbalance", "$m_e e$", "kg m", "rotor", "unbalance_kg_m", 1, "the paper's Table 1"),
            ("number of balls", "$n$", "-", "bearing", "balls", 1, "its §2.4"),
            ("contact stiffness", "$K_H$", "N/m^1.5^", "bearing", "contact_stiffness_N_per_m1p5", 1, "the paper's Table 1"),
            ("radial clearance", "$\\delta$", "µm", "bearing", "radial_clearance_m", 1e6, "the paper's Table 1"),
            ("cage over rotor speed", "$\\omega_{cage}/\\omega$", "-", "bearing", "cage_speed_ratio", 1, "not printed (D-11)"),
            ("gravity", "$g$", "m/s^2^", "gravity", "acceleration_m_per_s2", 1, "not printed")]
    add("table.parameters", markdown(
        ["parameter", "symbol", "unit", "set 1", "set 2", "set 1, printed order", "source"],
        [[words, symbol, unit, *(scientific(factor * file[part][key]) for file in files), source]
         for words, symbol, unit, part, key, factor, source in rows]), "-", "the parameters of the model")


def scientific(value):
    """1e11 as a power of ten, other numbers as they are."""
    return f"10^{np.log10(value):g}^" if value > 1e6 else f"{value:g}"


def accuracy(add):
    """What six harmonics get right at a low and at a high speed, and the passing of the balls at the lowest."""
    panels, large = Table(GENERATED / "fig06_orbits.tsv"), Table(GENERATED / "fig08_orbits.tsv")
    for name, table, f in (("slow", panels, panels["f"].min()), ("fast", panels, 45), ("large", large, 45)):
        rows = table.where("f", f)
        for key, column in (("f", "f"), ("rms", "difference_rms"), ("force", "difference_force")):
            add(f"accuracy.{name}_{key}", rows.first(column), "-", f"{column} of Fig. 6 or 8 at {f:g} Hz")
    fixed = Table(KEPT / "validity.tsv").where("adaptive", 0)
    for number in (1, 2):
        rows = fixed.where("set", number)
        rows = rows.where("f", rows["f"].min())
        for m in (6, 7, 8, 10, 16):
            for key, column in (("rms", "distance"), ("force", "distance_force")):
                add(f"passage.{key}_{number}_{m}", rows.where("m", m).first(column), "-", f"{column} at the lowest speed")
    add("passage.f", rows.first("f"), "Hz", "the lowest speed")
    slow = run("orbit", "data/set1.toml", frequency=rows.first("f"), points=4096)
    force = np.array([slow["F_x"], slow["F_y"]])
    vibration = np.sqrt(np.mean(np.sum((force.T - force.mean(axis=1)) ** 2, axis=1)))
    add("passage.newton", vibration, "N", "rms of the force about its mean at the lowest speed")
    add("passage.static", np.hypot(*force.mean(axis=1)), "N", "its mean")
    add("passage.micrometre", 1e6 * np.ptp(slow["x_r"]) / 2, "µm", "half peak-to-peak of x_r there")


def cages(add):
    """Other cage ratios beside 1/2, and two machines whose balls do not pass a whole number of times a turn."""
    table = Table(KEPT / "cage.tsv")
    others = table.rows(table["c"] != 0.5)
    add("cage.least", others["c"].min(), "-", "smallest of the other cage ratios")
    add("cage.most", others["c"].max(), "-", "largest of them")
    for number in (1, 2):
        rows = table.where("set", number)
        half, ratios = rows.where("c", 0.5), [c for c in np.unique(rows["c"]) if c != 0.5]
        off = np.concatenate([np.abs(rows.where("c", c)["amplitude"] / half["amplitude"] - 1) for c in ratios])
        found = [rows.where("c", c)["found"].mean() for c in ratios]
        stable = [(rows.where("c", c)["stable"] == 1).mean() for c in ratios]
        load = np.concatenate([np.abs(rows.where("c", c)["ball_load"] / half["ball_load"] - 1) for c in ratios])
        for key, value in (("load_median", np.median(load)), ("load_largest", load.max()), ("found_half", half["found"].mean()),
                           ("median", np.median(off)), ("largest", off.max()), ("found_least", min(found)),
                           ("found_most", max(found)), ("stable_least", min(stable)), ("stable_most", max(stable)),
                           ("stable_half", (half["stable"] == 1).mean())):
            add(f"cage.{key}_{number}", value, "-", "amplitudes and solutions at other cage ratios, beside 1/2")
    add("cage.tolerance", table.value("tolerance"), "-", "tolerance of harmonic balance")
    table = asked(add, "catalogue", "data/live/bearing-6205.toml", 45,
                  {"harmonics": "harmonics", "unknowns": "unknowns", "error": "error_largest", "stability": "stability"})
    add("catalogue.passages", table.value("balls") * table.value("cage_speed_ratio"), "-", "balls that pass in a turn")
    add("catalogue.rate", table.value("lyapunov") / 45, "-", "growth of a neighbour's distance in a turn")


def asked(add, name, machine, f, keys):
    """What the header of an orbit says of it."""
    table = run("orbit", machine, frequency=f, method="aft", tolerance=1e-3, points=8)
    add(f"{name}.f", f, "Hz", f"speed asked for of {machine}")
    for key, source in keys.items():
        add(f"{name}.{key}", table.value(source), "-", f"{key} of {machine}")
    return table


def maps(add):
    """Clearance against contact stiffness."""
    table = Table(KEPT / "clearance_stiffness.tsv")
    for key, column, factor, unit in (("delta", "delta", 1e6, "µm"), ("K_H", "K_H", 1, "N/m^1.5"), ("peak", "f_peak", 1, "Hz"),
                                      ("force", "largest_force", 1e-3, "kN")):
        add(f"map.{key}_least", factor * table[column].min(), unit, f"least {column}")
        add(f"map.{key}_most", factor * table[column].max(), unit, f"largest {column}")
    speeds = table.value("sweep_count")
    band = np.where(table["f_loss_first"] < 0, 0, table["f_loss_last"] - table["f_loss_first"])
    few = table["missed"] > speeds / 4
    for key, chosen in (("few", few), ("other", ~few)):
        add(f"map.band_{key}", np.median(band[chosen]), "Hz", "median width of the band of lost contact")
    add("map.machines", len(table), "-", "machines")
    add("map.missed", table["missed"].sum() / (len(table) * speeds), "-", "share of speeds without a solution")
    add("map.missed_most", table["missed"].max(), "-", "most speeds without a solution of one machine")
    add("map.speeds", speeds, "-", "speeds of each machine")


def two_maps(add):
    """Clearance against speed and against stiffness, and how random points of them were checked."""
    for key, name in (("speed", "clearance_speed"), ("stiffness", "stiffness_border")):
        for quantity, value in map_scaling.MAPS[name].values_of(Table(KEPT / f"{name}.tsv")).items():
            add(f"two.{key}_{quantity}", value, "-", f"{quantity} of the map {name}")
    checks = Table(KEPT / "map_checks.tsv")
    for number, key in ((1, "speed"), (2, "stiffness")):
        agrees = checks.where("map", number)["agrees"]
        add(f"two.{key}_checked", (agrees >= 0).sum(), "-", "random points compared with the judge")
        add(f"two.{key}_agree", (agrees == 1).sum(), "-", "of them agree")
        add(f"two.{key}_other", (agrees == 2).sum(), "-", "of them at another of several motions")


def large(add):
    """A flexible shaft, condensed to its bearing; beams and bricks that are reduced first."""
    table = Table(KEPT / "large.tsv")
    full = table["n"] == table["integrated"]
    for key, value in (("full", table["n"][full].max()), ("reduced_from", table["n"][~full].min()), ("error", table["error"].max()),
                       ("reduction", table["reduction_error"].max())):
        add(f"large.{key}", value, "-", "most degrees of freedom integrated in full, fewest reduced, largest errors")
    a_point = table["branch_s"] / table["points"]
    add("large.branch_ratio", a_point.max() / a_point[0], "-", "CPU time of a point of the branch over that of the paper's machine, largest")
    for kind in ("beam", "brick"):
        rows = table.where("kind", kind)
        add(f"large.{kind}_n", rows["n"][-1], "-", "degrees of freedom of the largest body")
        add(f"large.{kind}_s", rows["reduction_s"][-1], "s", "CPU time of its reading, reduction and fits")
    asked(add, "shaft", "data/rotors/overhung.toml", 30,
          {"size": "degrees_of_freedom", "m": "harmonics", "error": "error_largest", "multiplier": "multiplier", "stability": "stability",
           "distance": "distance_largest"})


def damped(add):
    """What the damping decides: shares of the speeds with a T-periodic motion from rest, of the machine that is used."""
    table = Table(KEPT / "robustness.tsv").where("machine", 1)
    strongest = table["contact_damping"].max()
    dampings = {"contact": strongest, "steel_less": 0.3, "steel_more": 1}
    for name, value in dampings.items():
        add(f"damped.{name}", value, "s/m", "contact damping")
    for number in (1, 2):
        rows = table.where("set", number)
        for times in (1, 3):
            part = rows.where("contact_damping", 0).where("suspension", times)
            add(f"damped.set_{number}_x{times}", (part["period"] == 1).mean(), "-", "share with so many times the suspensions' damping")
        for name, value in dampings.items():
            part = rows.where("contact_damping", value).where("suspension", 1)
            add(f"damped.{name}_{number}", (part["period"] == 1).mean(), "-", f"share with a contact damping of {value:g} s/m")


def printed(add):
    """The printed error of solutions drawn at random over the true one."""
    table = Table(KEPT / "printed_error.tsv")
    known = table.rows(table["true"] > 0)
    ratio = np.maximum(known["true"] / known["printed"], known["true_rms"] / known["printed_rms"])
    add("printed.drawn", len(table), "-", "machines drawn")
    add("printed.count", len(known), "-", "solutions compared with an independent integrator")
    add("printed.above", (ratio > 1.1).mean(), "-", "share of the solutions whose true error is more than a tenth above the printed one")


def orders(add):
    """How fast the error of RK4 falls with its step, where single balls gain and lose contact in every period."""
    reference = 1e-8  # below, the error of the reference and of closing takes part
    table = Table(KEPT / "work_precision.tsv")
    observed = []
    for case in np.unique(table["case"]):
        rows = table.where("case", case).where("method", "shooting-rk4").where("start", "nothing")
        known = {float(setting.split()[0][5:]): error for setting, error in zip(rows["setting"], rows["error"])
                 if setting.endswith("closure=1e-06") and error > reference}
        steps = sorted((step for step in known if step <= 1e-4), reverse=True)
        observed += [np.log(known[a] / known[b]) / np.log(a / b) for a, b in zip(steps, steps[1:])]
    add("order.median", np.median(observed), "-", "observed order of RK4 between two steps, median")


def add_all(add):
    for part in (settings, parameters, accuracy, cages, maps, two_maps, large, costs, peers, outside, answers, truth, damped, printed, orders,
                 beside_chaos, contact, needed, judged, verdicts):
        part(add)
