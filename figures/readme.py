"""The generated parts of README.md and paper/results.md, and the README's figure: written, or checked.

A generated part stands between `<!-- make readme: NAME -->` and `<!-- end -->`; NAME is a function of
PARTS. Its numbers come from data/generated, data/reference and build/explore. The figure is a copy of
the drawn one; it is stale when its script, style, scene or golden table has changed (their digests are
in figures/readme/inputs.sha256).

The check allows 5 % or one unit of a number's last digit: processors round differently, and the golden
tests compare the tables themselves.

Usage: figures/readme.py --write | --check
"""
import hashlib
import math
import re
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path

from claims import stored
from tables import Table

sys.path.insert(0, "paper")
from include import read_values, render  # noqa: E402

GENERATED, KEPT = Path("data/generated"), Path("data/reference")
PAGES = (Path("README.md"), Path("paper/results.md"))
PART = re.compile(r"(<!-- make readme: (\w+) -->\n).*?(<!-- end -->)", re.DOTALL)
WIDTH = 112

FIGURE = "fig03_response"
PICTURES = Path("figures/readme")
DIGESTS = PICTURES / "inputs.sha256"
INPUTS = [f"figures/{FIGURE}.gp", "figures/style.gp", f"data/scenes/{FIGURE}.toml",
          f"tests/golden/{FIGURE}.tsv"]

# -- README: what came out -------------------------------------------------------------------------

OUTCOME = """\
**Claims.** Of the paper's {{claims.count:.0f}} claims, {{claims.reproduced:.0f}} are reproduced: {{claims.independent}} by
what the paper prints, {{claims.built_in}} with masses or a cage that we chose to fit its text, {{claims.reduced}} with a
reduction of large bodies that is ours. {{claims.partly:.0f}} are reproduced partly, {{claims.not reproduced:.0f}} not, and
{{claims.not tested:.0f}} cannot be tested where it is made. All this is with two natural frequencies of Table 1
exchanged; as printed, {{printed.reproduced:.0f}} claims are reproduced, {{printed.partly:.0f}} partly and
{{printed.not reproduced:.0f}} not, by the same rules. Within the masses that the text admits {{claims.changing:.0f}} of the
verdicts change.

**Resonance.** Rotor peak: {{peak.mm_set_1:.1f}} mm at {{peak.f_set_1:.1f}} Hz (set 1),
{{peak.mm_set_2:.1f}} mm at {{peak.f_set_2:.1f}} Hz (set 2). Paper: about {{paper.peak:.0f}} Hz.

**Contact.** Rotor and stator lose contact during part of the motion at {{loss.first_set_1:.1f}}-{{loss.last_set_1:.1f}} Hz
(set 1) and {{loss.first_set_2:.1f}}-{{loss.last_set_2:.1f}} Hz (set 2).

**Period.** The motion that time integration reaches from rest repeats with every turn at {{periodic_1:.0%}} of the
speeds (set 1) and {{periodic_2:.0%}} (set 2). At the others no solution with the period of rotation can represent it.

**Accuracy.** Against time integration at {{high.f:.0f}} Hz (set 1), six harmonics have an rms error of {{high.rms:.4%}} of
the motion about its mean; the bearing's force is wrong by up to {{high.force:.1%}} of its largest value. At
{{low.f:.0f}} Hz these errors are {{low.rms:.0%}} and {{low.force:.0%}}.

**Stability.** Of {{few.unstable:.0f}} unstable motions of the machine (set 1), the Floquet multipliers of the solutions
with 6 harmonics call {{few.false:.0f}} stable. Of {{many.unstable:.0f}} such motions, those of the solutions with 64 harmonics
call {{many.false:.0f}} stable. The verdicts of this project are about the machine: shooting finds its motion near the
solution, with nothing truncated.

**Time.** For errors of 1 % and 0.1 % of the largest displacement (set 1), each method with the best settings found,
harmonic balance is {{above}} than Runge-Kutta above {{cost.high_from:.0f}} Hz, but {{below}} below {{cost.low_to:.1f}} Hz.
Paper, error not stated: {{paper.ratio:.1f}} times faster.

**Misprints and gaps.** In {{deviations.count:.0f}} places the paper cannot be followed as printed;
the [list of deviations](paper/deviations.md) has the evidence.
"""


def outcome_values():
    """Those of the article, and what only the README says. Verdicts are the kept ones: some are timed."""
    values = read_values(GENERATED / "article.tsv")
    for reading, folder in (("printed", KEPT / "as-printed"), ("claims", KEPT)):
        claims = stored(folder / "claims.tsv")
        verdicts = [row["verdict"] for row in claims]
        for verdict in ("reproduced", "partly", "not reproduced", "not tested"):
            values[f"{reading}.{verdict}"] = verdicts.count(verdict)
    for name, rests_on in (("independent", ["nothing"]), ("built_in", ["masses", "cage"]), ("reduced", ["reduction"])):
        chosen = [row["id"] for row in claims if row["verdict"] == "reproduced" and row["rests_on"] in rests_on]
        values[f"claims.{name}"] = f"{len(chosen)} ({', '.join(chosen)})"
    values["claims.count"] = len(verdicts)
    values["claims.changing"] = sum(len(set(re.findall(r"(not reproduced|partly|reproduced) for m_s", row["range"]))) > 1
                                    for row in stored(KEPT / "claims.tsv"))
    for number in (1, 2):
        values[f"periodic_{number}"] = 1 - values[f"aperiodic.share_set_{number}"]
    orbits = Table(GENERATED / "fig06_orbits.tsv")
    for name, frequency in (("low", orbits["f"].min()), ("high", values["fig05.f"])):
        panel = orbits.where("f", frequency)
        values |= {f"{name}.f": frequency, f"{name}.rms": panel.first("difference_rms"),
                   f"{name}.force": panel.first("difference_force")}
    verdicts = Table(KEPT / "verdicts.tsv").where("set", 1).where("machine_stable", 0)
    for name, m in (("few", 6), ("many", 64)):
        unstable = verdicts.where("m", m)
        values |= {f"{name}.unstable": len(unstable), f"{name}.false": (unstable["series_stable"] == 1).sum()}
    table = Table(KEPT / "tab02_equal_error.tsv")
    values["paper.ratio"] = table.members("paper_ratios")[0][0]
    rk4 = table.where("method", "rk4")
    for name, span in zip(("below", "above"), dict.fromkeys(rk4["range"])):
        rows = rk4.where("range", span)
        values[name] = beside(*(rows.where("target", target).first("ratio") for target in (0.01, 0.001)))
    return values


def beside(*ratios):
    """Two ratios of CPU time in words: `69 and 2.2 times faster`."""
    words = [(f"{max(ratio, 1 / ratio):.2g}", "faster" if ratio >= 1 else "slower") for ratio in ratios]
    (first, one), (second, other) = words
    return f"{first}{'' if one == other else f' times {one}'} and {second} times {other}"


def outcome():
    text = render(OUTCOME, outcome_values(), "the README's results")
    text = re.sub(r"(\d) ?(%|Hz|mm)", r"\1~\2", text)  # ~ keeps a number and its unit on one line
    return "\n".join(textwrap.fill(" ".join(item.split()), WIDTH, initial_indent="- ", subsequent_indent="  ",
                                   break_on_hyphens=False).replace("~", " ")
                     for item in text.strip().split("\n\n"))


# -- README: what explore prints -------------------------------------------------------------------

COMMANDS = {  # the comment, the lines of the header that are shown, the first rows that are shown
    "orbit my.toml --frequency 45": ("what the machine does from rest", "regime|stability|multiplier|error_largest", 2),
    "orbit my.toml --frequency 45 --harmonics 6": ("the solution with 6 harmonics", "stability|multiplier|distance_largest", 2),
    "contact my.toml --frequency 45": ("force of every ball, two periods", None, 2),
    "response my.toml --from 1 --to 60 --count 119": ("amplitudes against speed", None, 2),
}


def shortened(line):
    """Every number with four digits, in columns."""
    def digits(cell):
        return f"{float(cell):.4g}" if re.fullmatch(r"-?\d.*", cell) else cell
    return "".join(f"{digits(cell):<11}" for cell in line.split("\t")).rstrip()


def explore():
    """The commands with the first lines that they print, for a copy of the first data set."""
    lines = ["```console", "$ cp data/set1.toml my.toml"]
    for command, (comment, header, rows) in COMMANDS.items():
        lines.append(f"$ {f'build/explore {command}':<61} # {comment}")
        printed = subprocess.run(["build/explore", *command.replace("my.toml", "data/set1.toml").split()],
                                 text=True, check=True, capture_output=True).stdout.splitlines()
        lines += [line for line in printed if header and re.match(f"# ({header}):", line)]
        table = [line for line in printed if not line.startswith("#")]
        lines += [*map(shortened, table[:rows + 1]), f"... {len(table) - 1 - rows} more rows"]
    return "\n".join([*lines, "```"])


# -- The page of results ---------------------------------------------------------------------------

def speeds(values):
    """A list of speeds as ranges of neighbours in the 0.5 Hz raster of Fig. 3."""
    runs = []
    for value in values:
        if runs and value - runs[-1][1] <= 0.5 + 1e-9:
            runs[-1][1] = value
        else:
            runs.append([value, value])
    return ", ".join(f"{a:g}" if a == b else f"{a:g}-{b:g}" for a, b in runs)


def response():
    """Peak, loss of contact and speeds without T-periodic motion, of each data set."""
    yield "| data set | largest amplitude of x_r | contact lost at times [Hz] | not T-periodic [Hz] |"
    yield "|---|---|---|---|"
    table = Table(GENERATED / "fig03_response.tsv")
    for number in (1, 2):
        up = table.where("set", number).where("curve", 1)
        time = table.where("set", number).where("curve", 3)
        peak = up["amp_x_r"].argmax()
        yield (f"| {number} | {1e3 * up['amp_x_r'][peak]:.2f} mm at {up['f'][peak]:.1f} Hz "
               f"| {speeds(time['f'][time['contact'] < 1])} | {speeds(time['f'][time['periodic'] == 0])} |")


def panels():
    """Per panel: whether the integrated motion is T-periodic, and how far harmonic balance is from it."""
    yield "| figure | speed [Hz] | integrated motion | rms about the mean | force | largest displacement |"
    yield "|---|---|---|---|---|---|"
    for figure in ("fig04_displacements", "fig05_displacements", "fig06_orbits", "fig08_orbits"):
        table = Table(GENERATED / f"{figure}.tsv")
        for panel in sorted(set(table["panel"])):
            rows = table.where("panel", panel)
            start = f"| Fig. {int(figure[3:5])} | {rows.first('f'):g} "
            if rows.first("periodic") == 0:
                yield start + "| not T-periodic | - | - | - |"
            elif rows.first("found") == 0:
                yield start + "| T-periodic | no solution | - | - |"
            else:
                yield start + "| T-periodic | " + " | ".join(
                    f"{100 * rows.first(name):.2g} %"
                    for name in ("difference_rms", "difference_force", "difference")) + " |"


def costs():
    """Per range and error: CPU time of harmonic balance at its best, of Runge-Kutta and of the fastest method."""
    table = Table(KEPT / "tab02_equal_error.tsv")
    yield "| speeds [Hz] | error | harmonic balance | Runge-Kutta | fastest of all |"
    yield "|---|---|---|---|---|"
    for span in dict.fromkeys(table["range"]):
        for target in dict.fromkeys(table.where("range", span)["target"]):
            at = table.where("range", span).where("target", target)
            cpu = dict(zip(at["method"], (f"{1e3 * time:.3g} ms" for time in at["cpu_s"])))
            best = at["method"][at["cpu_s"].argmin()]
            name = {"aft": "harmonic balance", "rk4": "Runge-Kutta"}.get(best, best)
            yield (f"| {span} | {target:g} | {cpu.get('aft', 'not reached')} "
                   f"| {cpu.get('rk4', 'not reached')} | {name}, {cpu[best]} |")


def claims():
    """What the paper says and what the tables say, with the kept verdicts for both readings."""
    yield "| | the paper | found (exchanged reading) | verdict | over the accepted machines | printed reading |"
    yield "|---|---|---|---|---|---|"
    for exchanged, printed in zip(stored(KEPT / "claims.tsv"), stored(KEPT / "as-printed/claims.tsv")):
        cells = ["<br>".join("• " * ("; " in exchanged[name]) + part for part in exchanged[name].split("; "))
                 for name in ("id", "claim", "ours", "verdict", "range")]
        yield f"| {' | '.join(cells)} | {printed['verdict']} |"


PARTS = {part.__name__: part for part in (outcome, explore, response, panels, costs, claims)}

# -- Writing and checking --------------------------------------------------------------------------


def digests():
    """One line per input of the figure: digest of its lines without comments, and file."""
    def digest(file):
        lines = Path(file).read_bytes().splitlines(keepends=True)
        return hashlib.sha256(b"".join(line for line in lines if line[:1] != b"#")).hexdigest()
    return "".join(f"{digest(file)}  {file}\n" for file in INPUTS)


def refreshed(text):
    """A page with its generated parts made anew."""
    def part(match):
        made = PARTS[match[2]]()
        made = made if isinstance(made, str) else "\n".join(made)
        return f"{match[1]}{made}\n{match[3]}"
    return PART.sub(part, text)


NUMBER = re.compile(r"\d+(?:\.\d+)?(?:e[-+]?\d+)?")


def close(old, new):
    """Two numbers as they are written: within 5 %, or one unit of the last digit."""
    mantissa, _, exponent = old.partition("e")
    unit = 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
    return math.isclose(float(old), float(new), rel_tol=0.05, abs_tol=1.001 * unit)


def agree(old, new):
    """The same words, and numbers that are close. An uncertainty may be another one: it is the size of rounding."""
    old, new = (re.sub(r"\+- \S+", "", text) for text in (old, new))

    def words(text):
        return NUMBER.sub("#", text).split()
    return words(old) == words(new) and all(map(close, NUMBER.findall(old), NUMBER.findall(new)))


def write():
    PICTURES.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(f"figures/generated/{FIGURE}.svg", PICTURES / f"{FIGURE}.svg")
    DIGESTS.write_text(digests())
    for page in PAGES:
        page.write_text(refreshed(page.read_text(encoding="utf-8")), encoding="utf-8")
    return 0


def check():
    stale = [str(page) for page in PAGES
             if not agree(page.read_text(encoding="utf-8"), refreshed(page.read_text(encoding="utf-8")))]
    if not DIGESTS.exists() or DIGESTS.read_text() != digests():
        stale.append(f"{PICTURES}/{FIGURE}.svg")
    for what in stale:
        print(f"{what} is stale; make readme refreshes it", file=sys.stderr)
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit({"--write": write, "--check": check}[sys.argv[1]]())
