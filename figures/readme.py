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

from claim_score import KINDS, changing, in_words, listed, score, stored
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
**Claims.** Of the paper's {{claims.count:.0f}} claims, judged by written rules: {{claims.words}}. A claim counts as
confirmed only if nothing in the model was chosen so that it holds.

**Table 1.** We exchange two natural frequencies of the paper's Table 1. In the printed order the same rules give:
{{claims.printed}}. Six harmonics meet a motion that repeats with every turn within 10 % (rms) at {{right.C2_exchanged:.0%}} of the speeds with the exchanged order,
at {{right.C2_printed:.0%}} with the printed one; at most of the others no such motion attracts.

**Masses.** The paper prints neither masses nor cage. Its text only bounds the masses; with other masses or another cage
that it admits the verdicts on {{claims.changing}} change.

**Resonance.** Rotor peak: {{peak.mm_set_1:.1f}} mm at {{peak.f_set_1:.1f}} Hz (set 1),
{{peak.mm_set_2:.1f}} mm at {{peak.f_set_2:.1f}} Hz (set 2). Paper: about {{paper.peak:.0f}} Hz.

**Contact.** Rotor and stator lose contact during part of the motion at {{loss.first_set_1:.1f}}-{{loss.last_set_1:.1f}} Hz
(set 1) and {{loss.first_set_2:.1f}}-{{loss.last_set_2:.1f}} Hz (set 2).

**Period.** The motion that time integration reaches from rest repeats with every turn at {{periodic_1:.0%}} of the
speeds (set 1) and {{periodic_2:.0%}} (set 2). At the others no solution with the period of rotation can represent it.

**Accuracy.** Where the unbalance dominates, few harmonics give the displacements: at {{high.f:.0f}} Hz (set 1) the rms error of
six harmonics is {{high.rms:.4%}} of the motion about its mean, and the bearing's force is wrong by up to {{high.force:.1%}} of its
largest value there (with the large clearance and ten harmonics {{accuracy.large_force:.0%}}). At {{low.f:.0f}} Hz these errors are {{low.rms:.0%}} and {{low.force:.0%}}.

**Stability.** Set 1: {{few.unstable:.0f}} of the judged solutions with 6 harmonics lie next to unstable motions. Their own Floquet
multipliers call {{few.false:.0f}} of these stable; with 64 harmonics it is {{many.false:.0f}} of {{many.unstable:.0f}}. The
paper says nothing of stability.

**Misprints and gaps.** In {{deviations.count:.0f}} places the paper cannot be followed as printed;
the [list of deviations](paper/deviations.md) has the evidence.

**Time.** Computing time of harmonic balance against Runge-Kutta of order four, each with the best settings found
(set 1); ratios below three rank nothing. The paper reports {{paper.ratio:.1f}} times faster with six harmonics and names no error.

TABLE
"""


def outcome_values():
    """Those of the article, and what only the README says. Verdicts are the kept ones: some are timed."""
    values = read_values(GENERATED / "article.tsv")
    claims, printed = (stored(folder / "claims.tsv") for folder in (KEPT, KEPT / "as-printed"))
    values |= {"claims.count": len(claims), "claims.words": in_words(claims), "claims.printed": in_words(printed),
               "claims.changing": listed(changing(claims))}
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
    values["paper.ratio"] = Table(KEPT / "tab02_equal_error.tsv").members("paper_ratios")[0][0]
    return values


def faster(ratio):
    return f"{max(ratio, 1 / ratio):.2g} times {'faster' if ratio >= 1 else 'slower'}"


def speed_table():
    """Harmonic balance beside Runge-Kutta by the error allowed and the range of speed."""
    rows = Table(KEPT / "tab02_equal_error.tsv").where("method", "rk4")
    spans = list(dict.fromkeys(rows["range"]))
    yield f"| largest error of a displacement | {' | '.join(f'{span} Hz' for span in spans)} |"
    yield "|---" * (1 + len(spans)) + "|"
    for target in (0.01, 0.001):
        at = rows.where("target", target)
        yield f"| {100 * target:g} % | {' | '.join(faster(at.where('range', span).first('ratio')) for span in spans)} |"


def outcome():
    text = render(OUTCOME, outcome_values(), "the README's results")
    text = re.sub(r"(\d) ?(%|Hz|mm)", r"\1~\2", text)  # ~ keeps a number and its unit on one line
    items = "\n".join(textwrap.fill(" ".join(item.split()), WIDTH, initial_indent="- ", subsequent_indent="  ",
                                    break_on_hyphens=False).replace("~", " ")
                      for item in text.strip().split("\n\n"))
    return items.replace("- TABLE", "\n".join(["", *speed_table()]))


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
    yield "| data set | largest amplitude of x_r | speeds with loss of contact [Hz] | not T-periodic [Hz] |"
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


def scores():
    """How many claims end in which way, for both versions of Table 1."""
    yield "| natural frequencies | " + " | ".join(KINDS.values()) + " |"
    yield "|---" * (1 + len(KINDS)) + "|"
    for name, folder in (("exchanged", KEPT), ("in the printed order", KEPT / "as-printed")):
        yield f"| {name} | " + " | ".join(f"{len(ids)}: {', '.join(ids)}" if ids else "0"
                                         for ids in score(stored(folder / "claims.tsv")).values()) + " |"
    yield ""
    for name, folder in (("Exchanged", KEPT), ("In the printed order", KEPT / "as-printed")):
        yield f"{name}: {in_words(stored(folder / 'claims.tsv'))}."
        yield ""


def claims():
    """What the paper says and what the tables say, with the kept verdicts for both versions of Table 1."""
    yield "| | the paper | found (exchanged) | verdict | over the accepted masses | found (printed order) | verdict |"
    yield "|---|---|---|---|---|---|---|"
    for exchanged, printed in zip(stored(KEPT / "claims.tsv"), stored(KEPT / "as-printed/claims.tsv")):
        cells = ["<br>".join("• " * ("; " in text) + part for part in text.split("; "))
                 for text in (*(exchanged[name] for name in ("id", "claim", "ours", "verdict", "range")), printed["ours"],
                              printed["verdict"])]
        if exchanged["built_in"] != "-":
            cells[3] += f" (by the choice of {exchanged['built_in']})"
        yield f"| {' | '.join(cells)} |"


PARTS = {part.__name__: part for part in (outcome, explore, response, panels, costs, scores, claims)}

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
