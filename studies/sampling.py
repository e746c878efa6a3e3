"""The sample rule: how many samples per period m harmonics need.

Paper: §3.1, where N = 2m+1 (D-05, D-14). The default number of samples, N = max(8m+1, 2/3 m^{8/5}) rounded up to a fast size,
makes the error of sampling fall with m as fast as that of truncation. A solution with m harmonics has both errors. That of
truncation comes from the harmonics above m, which are missing; at a given m it cannot be avoided. That of sampling comes from
evaluating the force at N instants: its harmonics above N/2 are folded back onto those that are kept; more samples make it smaller.

The orders follow from the force of a ball, which grows as d^{3/2} from the instant of contact. The harmonics k of such a force
fall as k^{-5/2}, and those of the displacement as k^{-9/2}, since a body responds to fast forces with its mass. Truncation leaves
out all harmonics above m: the largest error of the displacement falls as m^{-7/2}, its rms as m^{-4}. Sampling disturbs the
harmonics that are kept: the error falls as N^{-5/2}. With a fixed N/m sampling therefore decides in the end, and the error falls
as m^{-5/2} only. N must grow as m^{7/5} to keep the order of the largest error, and as m^{8/5} to keep that of the rms. At 30 Hz
of data set 1 the largest error falls as m^{-2.7} from m = 64 to 512 with N = 8m+1, as m^{-3.7} with the default, and as m^{-3.6}
with 64 samples per harmonic; its rms as m^{-2.5}, m^{-4.1} and m^{-4.1}.

The panels show the error of sampling over that of truncation, against the samples per harmonic, at four motions; the rms of the
displacement about its mean above, the largest error of the force below. Below the dotted line sampling adds less than truncation,
and further samples gain little. The paper's choice is the left end of each curve. Rings mark the default. Up to m = 64 it is 8m+1,
where the rings are below the line at data set 1 and at most a third above it at data set 2; 2/3 m^{8/5} is smaller there, so that
solutions with few harmonics keep their N. From m = 64 on the rings stay at about the height that they have there. They stand
further to the right: at m = 512, N is 14580 and the force is evaluated 3.5 times as often as with 8m+1. Beyond N = 2^17 rounding
limits the accuracy, and N is not raised further until 8m+1 is larger.

The force could instead be integrated exactly between the instants at which balls meet and leave the races. Then a ball needs
about πm points per period of contact, instead of N. These points are not equally spaced, and the sums over them cost more than
fast transforms: counted in multiplications, 6 to 10 times as much as the default when summed directly, the same at m = 128 and
about a third at m = 512 with fast transforms for unequal points. It would save time only with several hundred harmonics, and is
not done here.

Usage: studies/sampling.py data/scenes/sampling.toml > sampling.tsv   (from the project's root; less than a minute)
"""
import os
import sys
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(1, str(Path(__file__).parents[1] / "figures"))
from rotor_stator import attempt  # noqa: E402
from tables import displacement_errors, print_columns, print_header  # noqa: E402

POINTS = 1024
COLUMNS = [
    ("panel", "-", "number of the machine and speed"), ("f", "Hz", "speed of rotation"), ("m", "-", "harmonics"),
    ("N", "-", "samples per period"), ("default", "-", "1 if this is the default N of that m"),
    ("found", "-", "1 if Newton converged with this N"),
    ("sampling_rms", "-", "rms error of displacement about the mean against the same m finely sampled; 0 if not found"),
    ("sampling", "-", "the same, largest difference over largest displacement"),
    ("sampling_force", "-", "the same of the bearing's force"),
    ("truncation_rms", "-", "rms error of displacement about the mean of that m, finely sampled, against the reference"),
    ("truncation", "-", "the same, largest difference over largest displacement"),
    ("truncation_force", "-", "the same of the bearing's force")]


def fast_size(least):
    """The even number from there on that has no factor above 7."""
    n = max(2, least + least % 2)
    while rest(n) > 1:
        n += 2
    return n


def rest(n):
    """What is left of a number without its factors 2, 3, 5 and 7."""
    for factor in (2, 3, 5, 7):
        while n % factor == 0:
            n //= factor
    return n


def orbit(machine, speed, m, *samples):
    """The orbit with m harmonics and, by default, its usual N; None without a solution."""
    return attempt("orbit", machine, *samples, frequency=speed, harmonics=m, points=POINTS, no_stability=True, budget=1e12)


def errors(orbit, exact):
    """Those of the displacements; the largest difference over the largest force."""
    forces = [table["F_x"] + 1j * table["F_y"] for table in (orbit, exact)]
    return [*displacement_errors(orbit, exact), abs(forces[0] - forces[1]).max() / abs(forces[1]).max()]


def rows_of(machine, speed, m, scene):
    """The cells from m on of one motion and number of harmonics."""
    exact = orbit(machine, speed, scene["reference_harmonics"])
    fine = orbit(machine, speed, m, "--samples", fast_size(scene["fine_over_m"] * m + 1))
    usual = int(orbit(machine, speed, m).value("samples"))
    truncation, rows = errors(fine, exact), []
    for samples in sorted({usual, *(fast_size(over * m + 1) for over in scene["samples_over_m"])}):
        coarse = orbit(machine, speed, m, "--samples", samples)
        sampling = [0, 0, 0] if coarse is None else errors(coarse, fine)
        rows.append([m, samples, int(samples == usual), int(coarse is not None), *sampling, *truncation])
    return fine, rows


def main(file):
    scene = tomllib.loads(Path(file).read_text(encoding="utf-8"))
    motions = list(zip((f"data/{name}.toml" for name in scene["parameters"]), scene["speeds_hz"]))
    cases = [(panel, m) for panel in range(len(motions)) for m in scene["harmonics"]]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        found = list(pool.map(lambda case: rows_of(*motions[case[0]], case[1], scene), cases))
    tables = [table for table, _ in found[::len(scene["harmonics"])]]
    print_header("Error of sampling the force, against the error of truncating the series", tables,
                 f"modelled: harmonic balance; finely sampled: N = {scene['fine_over_m']} m; reference: m = "
                 f"{scene['reference_harmonics']}",
                 rows=[("panel", [k, name, speed]) for k, (name, speed) in enumerate(zip(scene["parameters"], scene["speeds_hz"]), 1)])
    print_columns(COLUMNS)
    for (panel, _), (_, rows) in zip(cases, found):
        for row in rows:
            print("\t".join(f"{cell:.12g}" for cell in (panel + 1, motions[panel][1], *row)))


if __name__ == "__main__":
    main(*sys.argv[1:])
