"""The article's numbers and words on cost, truth, stability and hard cases.

Words are made here from numbers, so that no sentence of the article says which of two is larger unless
a table says so. A list is one value; its lines are joined by \\n, which include.py turns into lines.
"""
import re
import tomllib
from pathlib import Path

import numpy as np
from tables import Table, explore

GENERATED, KEPT = Path("data/generated"), Path("data/reference")
METHODS = {"aft": "harmonic balance", "rk4": "Runge-Kutta of order 4", "rkf45": "Runge-Kutta-Fehlberg",
           "rk8pd": "Runge-Kutta of order 8", "msadams": "Adams", "msbdf": "BDF", "bsimp": "Bulirsch-Stoer",
           "shooting-rk4": "shooting by Runge-Kutta of order 4",
           "shooting-rk8pd": "shooting by Runge-Kutta of order 8"}


def times(seconds):
    """A CPU time in a unit that suits it."""
    unit, factor = ("s", 1) if seconds >= 1 else ("ms", 1e3) if seconds >= 1e-3 else ("µs", 1e6)
    return f"{seconds * factor:.2g} {unit}" if seconds * factor < 99.5 else f"{seconds * factor:.0f} {unit}"


def power(error):
    """An error as 1 % or, where small, as a power of ten."""
    if error >= 1e-4:
        return f"{100 * error:.2g} %"
    exponent = int(np.floor(np.log10(error)))
    return rf"${error / 10.0 ** exponent:.2g}\cdot 10^{{{exponent}}}$"


def costs(add):
    """Each range and error: the methods in the order of their time, and those that do not reach it."""
    table, lines = Table(KEPT / "tab02_equal_error.tsv"), []
    for reach in dict.fromkeys(table["range"]):
        for target in sorted(set(table["target"]), reverse=True):
            rows = table.where("range", reach).where("target", target)
            best = rows["cpu_s"].argmin()
            cells = [timed(rows, name) for name in ("aft", "shooting-rk4", "rk4")]
            lines.append([reach, power(target), *cells, METHODS[rows["method"][best]]])
    add("table.costs", markdown(["speeds [Hz]", "error", "harmonic balance", "shooting, RK4", "RK4", "fastest of all"], lines), "-",
        "CPU time of the sweep at equal error, with the error of the force")
    low, high = dict.fromkeys(table["range"])
    for reach, name in ((low, "low"), (high, "high")):
        for rival in ("rk4", "shooting-rk4"):
            rows = table.where("range", reach).where("method", rival)
            add(f"cost.{name}_{rival.split('-')[0]}",
                " and ".join(faster(rows.where("target", target).first("ratio")) + f" at {power(target)}"
                             for target in (0.01, 0.001)), "-", f"harmonic balance beside {rival}, {reach} Hz")
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


def timed(rows, method):
    """CPU time and error of the force of a method, or that it does not reach the error."""
    rows = rows.where("method", method)
    return f"{times(rows.first('cpu_s'))} ({100 * rows.first('error_force'):.2g} %)" if len(rows) else "not reached"


def markdown(names, lines):
    """A table of Markdown as one value, its columns as wide as their longest cell."""
    dashes = ["-" * min(30, max(5, *(len(str(cell)) for cell in column))) for column in zip(names, *lines)]
    return r"\n".join("| " + " | ".join(map(str, line)) + " |" for line in (names, dashes, *lines))


def faster(ratio):
    return f"{ratio:.2g} times faster" if ratio >= 1 else f"{1 / ratio:.2g} times slower"


def growth(add):
    table = Table(KEPT / "cost_growth.tsv")
    for kind in ("harmonics", "balls", "speeds"):
        add(f"growth.{kind}", table.where("against", kind).first("exponent_cpu"), "-",
            f"exponent of the CPU time against {kind}")
    begin = float(re.search(r"exponents from harmonics = (\d+)", table.header)[1])
    rows = table.where("against", "harmonics")
    size, cpu = np.log(rows["size"]), np.log(rows["cpu_s"])
    few = rows["size"] <= begin
    add("growth.from", begin, "-", "harmonics from which on the exponent is fitted")
    add("growth.few", np.polyfit(size[few], cpu[few], 1)[0], "-", "exponent up to there")
    add("growth.last", (cpu[-1] - cpu[-2]) / (size[-1] - size[-2]), "-", "exponent of the last doubling")


def peers(add):
    """AUTO-07p beside harmonic balance, from the header of its table."""
    header = Table(KEPT / "peers_auto.tsv").header
    runs = re.findall(r"^# run (\w+): from [^:]*: \d+ points, (\d+) folds, from (\S+) to (\S+) Hz;",
                      header, re.MULTILINE)
    ours = re.findall(r"^# run (\w+): harmonic balance, m = (\d+), .*?folds: (\d+),", header, re.MULTILINE)
    for run, folds, low, high in runs:
        counts = ", ".join(f"{count} with {m} harmonics" for name, m, count in ours if name == run)
        far = re.search(rf"^# run {run}: distance .* largest (\S+) at", header, re.MULTILINE)
        add(f"auto.{run}_distance", float(far[1]), "-", "largest difference of amplitudes over the largest one")
        add(f"auto.{run}", f"{folds} folds between {float(low):.0f} and {float(high):.0f} Hz, harmonic balance "
            f"over the same speeds {counts}", "-", "folds by AUTO-07p and by harmonic balance")


def truth(add):
    """Shares of the speeds with a T-periodic attractor, and the harmonics that reach it."""
    limit = min(tomllib.loads(Path("data/claims.toml").read_text())["regimes"]["distance_limits"])
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
        add(f"truth.exponent_{number}", single["exponent"].max(), "1/s", "largest Lyapunov exponent")
        validity = Table(KEPT / "validity.tsv").where("set", number).where("periodic", 1)
        wanted = 6 if number == 1 else 10
        fixed = validity.where("adaptive", 0).where("m", wanted)
        near = (fixed["found"] == 1) & (fixed["distance"] <= limit)
        add(f"truth.near_{number}", near.mean(), "-", "share of these speeds within the limit with the paper's m")
        chosen = validity.where("adaptive", 1)
        good = (chosen["found"] == 1) & (chosen["distance"] >= 0) & (chosen["distance"] <= limit)
        add(f"truth.adaptive_{number}", good.mean() if len(chosen) else 0, "-", "the same, m chosen")
        add(f"truth.tight_{number}", (good & (chosen["distance"] <= tight)).mean(), "-", "share within that")
        add(f"truth.adaptive_m_{number}", chosen["m"][good].max() if good.any() else 0, "-", "its largest m")


def judged(add):
    """How often the multipliers of m harmonics are right, and what a verdict on the machine costs."""
    table = Table(KEPT / "verdicts.tsv")
    found, lines = table.where("found", 1), []
    for number in np.unique(table["set"]).astype(int):
        for m in np.unique(table["m"]).astype(int):
            rows = found.where("set", number).where("m", m)
            known = rows.rows(rows["machine_stable"] >= 0)
            stable = known["machine_stable"] == 1
            said = [known[f"{method}_stable"] == word for method in ("series", "hill") for word in (1, 0)]
            wrong = [(one & (~stable if k % 2 == 0 else stable)).sum() for k, one in enumerate(said)]
            lines.append([number, m, len(rows), stable.sum(), (~stable).sum(), *wrong])
            for method, false in zip(("series", "hill"), wrong[::2]):
                add(f"verdicts.{method}_{number}_{m}", false, "-", 'unstable motions that the method calls "stable"')
            add(f"verdicts.unstable_{number}_{m}", (~stable).sum(), "-", "unstable motions of the machine")
    add("table.verdicts", markdown(
        ["set", "m", "solutions", "machine stable", "machine unstable", 'series: false "stable"', 'series: false "unstable"',
         'Hill: false "stable"', 'Hill: false "unstable"'], lines), "-", "false verdicts by the multipliers of m harmonics")
    near = found.where("set", 1).where("m", 6)
    k = np.abs(near["f"] - 20).argmin()
    for key, column in (("f", "f"), ("machine", "machine"), ("series", "series"), ("distance", "distance")):
        add(f"verdicts.near20_{key}", near[column][k], "-", f"{column} of the solution of set 1 nearest to 20 Hz, m = 6")
    add("verdicts.m_most", found["m"].max(), "-", "most harmonics of the table")
    add("verdicts.speeds", len(np.unique(table["f"])), "-", "speeds of each set")
    add("verdicts.hill", int(re.search(r"Hill's method with m harmonics, at most (\d+)", table.header)[1]), "-",
        "largest number of harmonics of Hill's method")
    add("verdicts.solutions", len(found), "-", "solutions judged")
    add("verdicts.decided", (found["machine_stable"] >= 0).mean(), "-", "share with a verdict on the machine")
    add("verdicts.alone", (found["machine"] < 0).sum(), "-", "solutions without a motion of the machine near them")
    add("verdicts.median", np.median(found["evaluations"]), "-", "evaluations of the force for a verdict")
    add("verdicts.most", found["evaluations"].max(), "-", "the most of them")


def verdicts(add):
    """Each claim's verdict, and the claims whose verdict changes within the masses that the text admits."""
    table = Table(GENERATED / "claims.tsv")
    for key, verdict in zip(table["id"], table["verdict"]):
        add(f"{key}.verdict", verdict, "-", f"verdict on {key}")
    changing = [key for key, words in zip(table["id"], table["range"])
                if len(set(re.findall(r"(not reproduced|partly|reproduced) for m_s", words))) > 1]
    add("claims.changing", ", ".join(changing), "-", "claims whose verdict depends on the masses")


def settings(add):
    """What the programs take for T-periodic and for the same motion."""
    for key, file, name in (("spread", "motion/attractor.hpp", "closed"), ("near", "motion/verdict.hpp", "same_motion"),
                            ("kept", "model/large_machine.cpp", "most_kept"), ("receptance", "model/reduction.cpp", "wanted")):
        text = Path(f"src/{file}").read_text()
        add(f"settings.{key}", float(re.search(rf"\b{name} = ([\d.e-]+)[;,]", text)[1]), "-", f"{name} of src/{file}")


def parameters(add):
    """All parameters of the model, from the files of both data sets and of the printed reading."""
    files = [tomllib.loads(Path(f"data/{name}.toml").read_text()) for name in ("set1", "set2", "set1-as-printed")]
    rows = [("mass of the stator", "$m_s$", "kg", "stator", "mass_kg", 1, "bounded by the text (D-13)"),
            ("mass of the rotor", "$m_r$", "kg", "rotor", "mass_kg", 1, "bounded by the text (D-13)"),
            ("natural frequency of the stator", "$\\omega_0^s$", "rad/s", "stator", "natural_frequency_rad_per_s", 1,
             "Table 1, exchanged (D-09)"),
            ("natural frequency of the rotor", "$\\omega_0^r$", "rad/s", "rotor", "natural_frequency_rad_per_s", 1,
             "Table 1, exchanged (D-09)"),
            ("damping ratio of the stator", "$\\xi_s$", "-", "stator", "damping_ratio", 1, "Table 1"),
            ("damping ratio of the rotor", "$\\xi_r$", "-", "rotor", "damping_ratio", 1, "Table 1"),
            ("unbalance", "$m_e e$", "kg m", "rotor", "unbalance_kg_m", 1, "Table 1"),
            ("number of balls", "$n$", "-", "bearing", "balls", 1, "§2.4"),
            ("contact stiffness", "$K_H$", "N/m^1.5^", "bearing", "contact_stiffness_N_per_m1p5", 1, "Table 1"),
            ("radial clearance", "$\\delta$", "µm", "bearing", "radial_clearance_m", 1e6, "Table 1"),
            ("cage over rotor speed", "$\\omega_{cage}/\\omega$", "-", "bearing", "cage_speed_ratio", 1, "not printed (D-11)"),
            ("gravity", "$g$", "m/s^2^", "gravity", "acceleration_m_per_s2", 1, "not printed")]
    add("table.parameters", markdown(
        ["parameter", "symbol", "unit", "set 1", "set 2", "set 1, printed reading", "source"],
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
        for key, value in (("median", np.median(off)), ("largest", off.max()), ("found_least", min(found)),
                           ("found_most", max(found)), ("stable_least", min(stable)), ("stable_most", max(stable)),
                           ("stable_half", (half["stable"] == 1).mean())):
            add(f"cage.{key}_{number}", value, "-", "amplitudes and solutions at other cage ratios, beside 1/2")
    asked(add, "catalogue", "data/live/bearing-6205.toml", 45,
          passages=r"BPFO = n c = (\S+),", harmonics=r"; (\d+) harmonics,", unknowns=r", (\d+) unknowns", error=r"# error: (\S+) of",
          rate=r"part by (\S+) \+- \S+ a turn", stability=r"# stability: (\w+)")


def asked(add, name, machine, f, **patterns):
    """What the header of an orbit says of it."""
    header = explore("orbit", machine, "--frequency", f, "--tolerance", 1e-3, "--points", 8).stdout
    add(f"{name}.f", f, "Hz", f"speed asked for of {machine}")
    for key, pattern in patterns.items():
        found = re.search(pattern, header)[1]
        try:
            add(f"{name}.{key}", float(found), "-", f"{key} of {machine}")
        except ValueError:
            add(f"{name}.{key}", found, "-", f"{key} of {machine}")


def maps(add):
    """Clearance against contact stiffness."""
    table = Table(KEPT / "clearance_stiffness.tsv")
    for key, column, factor, unit in (("delta", "delta", 1e6, "µm"), ("K_H", "K_H", 1, "N/m^1.5"), ("peak", "f_peak", 1, "Hz"),
                                      ("force", "largest_force", 1e-3, "kN")):
        add(f"map.{key}_least", factor * table[column].min(), unit, f"least {column}")
        add(f"map.{key}_most", factor * table[column].max(), unit, f"largest {column}")
    speeds = float(re.search(r"(\d+) speeds from", table.header)[1])
    band = np.where(table["f_loss_first"] < 0, 0, table["f_loss_last"] - table["f_loss_first"])
    few = table["missed"] > speeds / 4
    for key, chosen in (("few", few), ("other", ~few)):
        add(f"map.band_{key}", np.median(band[chosen]), "Hz", "median width of the band of lost contact")
    add("map.machines", len(table), "-", "machines")
    add("map.missed", table["missed"].sum() / (len(table) * speeds), "-", "share of speeds without a solution")
    add("map.missed_most", table["missed"].max(), "-", "most speeds without a solution of one machine")
    add("map.speeds", speeds, "-", "speeds of each machine")


def large(add):
    """A flexible shaft, condensed to its bearing."""
    asked(add, "shaft", "data/rotors/overhung.toml", 30, size=r"bodies: (\d+) degrees", m=r"m = (\d+),", error=r"# error: (\S+) of",
          multiplier=r"multiplier (\S+) \+-", stability=r"# stability: (\w+)", distance=r"# distance: (\S+) of")


def add_all(add):
    for part in (settings, parameters, accuracy, cages, maps, large, costs, growth, peers, truth, judged, verdicts):
        part(add)
