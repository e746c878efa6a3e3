"""The article's numbers and words on cost, truth, stability and hard cases.

Words are made here from numbers, so that no sentence of the article says which of two is larger unless
a table says so. A list is one value; its lines are joined by \\n, which include.py turns into lines.
"""
import re
import tomllib
from pathlib import Path

import numpy as np
from tables import Table

GENERATED, KEPT = Path("data/generated"), Path("data/reference")
METHODS = {"aft": "harmonic balance", "rk4": "Runge-Kutta of order 4", "rkf45": "Runge-Kutta-Fehlberg",
           "rk8pd": "Runge-Kutta of order 8", "msadams": "Adams", "msbdf": "BDF", "bsimp": "Bulirsch-Stoer",
           "shooting-rk4": "shooting by Runge-Kutta of order 4",
           "shooting-rk8pd": "shooting by Runge-Kutta of order 8"}
FRENCH = {"reproduced": "reproduite", "partly": "reproduite en partie", "not reproduced": "non reproduite",
          "not tested": "non examinée"}


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
    table = Table(KEPT / "tab02_equal_error.tsv")
    missed = re.findall(r"^# not reached: (\S+), (\S+) Hz, target (\S+);", table.header, re.MULTILINE)
    lines = []
    for reach in dict.fromkeys(table["range"]):
        for target in sorted(set(table["target"]), reverse=True):
            rows = table.where("range", reach).where("target", target)
            order = ", ".join(f"{METHODS.get(rows['method'][k], rows['method'][k])} {times(rows['cpu_s'][k])} "
                              f"({100 * rows['error_force'][k]:.2g} %)" for k in np.argsort(rows["cpu_s"]))
            without = [METHODS.get(name, name) for name, at, error in missed
                       if at == reach and np.isclose(float(error), target)]
            lines.append(f"- {reach} Hz, error {power(target)}: {order}."
                         + (f" Not reached within the bound on time by {', '.join(without)}." if without else ""))
    add("cost.list", r"\n".join(lines), "-", "CPU of the sweep at equal error, methods in order")
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
    words = [f"with {m:.0f} harmonics {ratio:.2g} at an error of {power(error)}, Runge-Kutta {power(other)} "
             f"(the paper: {slow / paper:.1f})"
             for m, ratio, error, other, paper in zip(timing["harmonics"], timing["ratio"], timing["error"],
                                                      rivals["error"], timing["paper_cpu"])]
    add("cost.paper", "; ".join(words), "-", "Runge-Kutta's time over that of harmonic balance")


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
        end = re.search(rf"^# run {run}: .*?; ended at (\S+) Hz: ([^;]*);", header, re.MULTILINE)
        add(f"auto.{run}_end", f"{float(end[1]):.1f} Hz ({end[2]})", "-", "where AUTO-07p ended, and why")
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


def stability(add):
    """The branches in the order of the table's header, one line each."""
    table, lines = Table(KEPT / "stability.tsv"), []
    for curve in np.unique(table["curve"]):
        rows = table.where("curve", curve)
        decided = rows["stable"] >= 0
        unstable = (rows["stable"][decided] == 0).mean() if decided.any() else 0
        kinds = [f"{(rows['bifurcation'] == kind).sum()} {name}" for kind, name in
                 (("fold", "folds"), ("plus-one", "multipliers through one"),
                  ("period-doubling", "period doublings"), ("neimark-sacker", "Neimark-Sacker points"))]
        examined = (rows["stable"] > -2).sum()
        lines.append(f"- data set {rows.first('set'):.0f}, {rows.first('harmonics'):.0f} harmonics, from "
                     f"{rows['f'][0]:.3g} to {rows['f'][-1]:.3g} Hz: of {examined} points examined "
                     f"{decided.sum()} have a verdict, {100 * unstable:.2g} % of them unstable; {', '.join(kinds)}.")
    add("stability.list", r"\n".join(lines), "-", "stability along the followed branches")
    one = table.where("set", 1)
    one = one.rows((one["bifurcation"] != "-") & (one["bifurcation"] != "fold"))
    few, more = (one.where("harmonics", m) for m in np.unique(one["harmonics"])[:2])
    same = [np.abs(more["f"][more["bifurcation"] == kind] / f - 1).min(initial=1)
            for f, kind in zip(few["f"], few["bifurcation"])]
    add("stability.count", len(few), "-", "bifurcations of set 1 along the branch with fewest harmonics")
    add("stability.same", sum(off < 1e-6 for off in same), "-", "of them at the same speed along the next one")
    others = [f for f, off in zip(few["f"], same) if off >= 1e-6]
    add("stability.first", min(others, default=0), "Hz", "the first of the others")
    add("stability.last", max(others, default=0), "Hz", "the last of them")
    add("stability.fewer", few.first("harmonics"), "-", "harmonics of that branch")
    add("stability.more", more.first("harmonics"), "-", "harmonics of the next one")


def judged(add):
    """How often the multipliers of m harmonics are right, and what a verdict on the machine costs."""
    table = Table(KEPT / "verdicts.tsv")
    found, lines = table.where("found", 1), []
    for number in np.unique(table["set"]).astype(int):
        for m in np.unique(table["m"]).astype(int):
            rows = found.where("set", number).where("m", m)
            known = rows.rows(rows["machine_stable"] >= 0)
            words = []
            for method, name in (("series", "along the series"), ("hill", "Hill's method")):
                said, truth = known[f"{method}_stable"], known["machine_stable"]
                words.append(f"{name} {((said == 1) & (truth == 0)).sum()} false \"stable\", "
                             f"{((said == 0) & (truth == 1)).sum()} false \"unstable\"")
            lines.append(f"- data set {number}, {m} harmonics: {len(known)} of {len(rows)} solutions decided, "
                         f"{(known['machine_stable'] == 0).sum()} of them unstable; {'; '.join(words)}.")
    add("verdicts.list", r"\n".join(lines), "-", "false verdicts by the multipliers of m harmonics")
    add("verdicts.speeds", len(np.unique(table["f"])), "-", "speeds of each set")
    add("verdicts.hill", int(re.search(r"Hill's method with m harmonics, at most (\d+)", table.header)[1]), "-",
        "largest number of harmonics of Hill's method")
    add("verdicts.solutions", len(found), "-", "solutions judged")
    add("verdicts.decided", (found["machine_stable"] >= 0).mean(), "-", "share with a verdict on the machine")
    add("verdicts.alone", (found["machine"] < 0).sum(), "-", "solutions without a motion of the machine near them")
    add("verdicts.median", np.median(found["evaluations"]), "-", "evaluations of the force for a verdict")
    add("verdicts.most", found["evaluations"].max(), "-", "the most of them")


def estimates(add):
    table = Table(KEPT / "adaptive.tsv")
    known = table.rows((table["reached"] == 1) & (table["effectivity"] > 0))
    add("adaptive.asked", len(table), "-", "errors asked for")
    add("adaptive.claimed", (table["reached"] == 1).sum(), "-", "estimates below the error asked for")
    add("adaptive.known", len(known), "-", "of them with a known true error")
    add("adaptive.true", (known["error"] <= known["tolerance"]).sum(), "-", "of these truly within it")
    for share, name in ((0.05, "low"), (0.5, "middle"), (0.95, "high")):
        add(f"adaptive.{name}", np.quantile(known["effectivity"], share), "-", "estimate over true error")
    add("adaptive.cost", np.median(table["ratio"][table["ratio"] > 0]), "-",
        "median cost over that of the best fixed number of harmonics")
    add("adaptive.compared", (table["ratio"] > 0).sum(), "-", "cases of that comparison")
    add("adaptive.dear", (table["ratio"] > 2).sum(), "-", "of them above 2")
    add("adaptive.dearest", table["ratio"].max(), "-", "largest ratio")


def hard(add):
    table, lines = Table(KEPT / "hard_cases.tsv"), []
    for method in dict.fromkeys(table["method"]):
        rows = table.where("method", method)
        verdict, other = rows["verdict"], (rows["verdict"] == "solved") & (rows["regime"] != "T-periodic")
        counts = ", ".join(f"{(verdict == name).sum()} {word}" for name, word in
                           (("solved", "solved and confirmed"), ("refused", "refused with a reason"),
                            ("silent error", "silently wrong"), ("unconfirmed", "unconfirmed")))
        name = {"aft predictor": "harmonic balance with the paper's predictor",
                "aft arc length": "harmonic balance by arc length"}.get(method, METHODS.get(method, method))
        more = f" ({other.sum()} of those solved are motions without the period T)" if other.any() else ""
        lines.append(f"- {name}: {counts}{more}.")
    add("hard.list", r"\n".join(lines), "-", "how the hard cases end")


def verdicts(add):
    """Each claim's verdict and our words on it; those that are not reproduced as a list."""
    table = Table(GENERATED / "claims.tsv")
    lines = []
    for key, claim, ours, verdict in zip(*(table[name] for name in ("id", "claim", "ours", "verdict"))):
        add(f"{key}.verdict", verdict, "-", f"verdict on {key}")
        add(f"{key}.verdict_fr", FRENCH[verdict], "-", f"verdict on {key}, in French")
        if verdict in ("not reproduced", "partly"):
            lines.append(f"- {key}, {claim}: {verdict}. {ours[0].upper()}{ours[1:]}.")
    add("claims.open", r"\n".join(lines), "-", "claims that are not, or only partly, reproduced")


def add_all(add):
    for part in (costs, growth, peers, truth, stability, judged, estimates, hard, verdicts):
        part(add)
