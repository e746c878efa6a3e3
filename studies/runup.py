"""Run-up and coast-down of a rotor that meets the balls only near its resonance.

A motion at a fixed speed has all the time to settle; a machine that starts or stops has not. Here the rotor of data set 2
stands on a vertical shaft, with so little unbalance that it runs without contact at low and at high speed. Where the amplitude
reaches the clearance, the balls make it stiffer, and the resonance bends to higher speeds. Between its two ends there are two
steady motions: a large one, pressed against the race, and a small one without contact. Which one a machine follows depends on
where it comes from. Upwards it stays in contact and falls off the upper end; downwards it jumps onto the balls at the lower one.

`explore runup` integrates Eq. 7 while the speed changes evenly. The faster the speed changes, the later is the resonance met,
the smaller is its peak, and the longer the rotor beats after it: the free vibration that the passage has left meets the forced
one. A slow run follows the steady motions, which `explore response --direction up` and `down` find speed by speed.

The angles of rotor and cage are given; the drive that this takes is not modelled. A weak motor may not get through such a
resonance at all (the Sommerfeld effect), and the model does not know it.

Usage: studies/runup.py data/scenes/runup.toml > runup.tsv   (from the project's root; seconds)
"""
import sys
import tomllib
from pathlib import Path

import numpy as np

sys.path.insert(1, str(Path(__file__).parents[1] / "figures"))
from rotor_stator import run  # noqa: E402
from tables import print_columns, print_header  # noqa: E402

COLUMNS = [
    ("seconds", "s", "that the speed takes from end to end; 0 for steady motions"),
    ("direction", "-", "1 upwards, -1 downwards"),
    ("f", "Hz", "speed of rotation"),
    ("amp_x_r", "m", "half of the largest less the smallest x of the rotor, in a turn; of steady motions in a period"),
    ("contact_share", "-", "share of the turn with contact; of a steady motion of its period")]


def of_bins(table, width):
    """The turn with the largest amplitude in each bin of speed."""
    bins = np.floor(table["f"] / width).astype(int)
    chosen = [max(np.flatnonzero(bins == k), key=lambda i: table["amp_x_r"][i]) for k in np.unique(bins)]
    return table.rows(np.array(chosen))


def runs(scene):
    """Each run as its seconds, direction and table."""
    machine = f"data/{scene['parameters']}.toml"
    ends = scene["speeds_hz"]["from"], scene["speeds_hz"]["to"]
    names = [name for name, *_ in COLUMNS[2:]]
    for direction, word in (1, "up"), (-1, "down"):
        first, last = ends[::direction]
        for seconds in scene["seconds"]:
            passed = run("runup", machine, from_=first, to=last, seconds=seconds, columns=names)
            yield seconds, direction, of_bins(passed, scene["bins_hz"])
        yield 0, direction, run("response", machine, from_=ends[0], to=ends[1], count=scene["steady_speeds"], direction=word,
                                columns=names)


def main(file):
    scene = tomllib.loads(Path(file).read_text(encoding="utf-8"))
    found = list(runs(scene))
    peaks = [("peak", [seconds, direction, table["f"][k], table["amp_x_r"][k]])
             for seconds, direction, table in found for k in [int(np.argmax(table["amp_x_r"]))]]
    print_header(scene["title"], [table for *_, table in found[:1]],
                 "peak: seconds, direction, speed [Hz] and amplitude [m] of the largest amplitude",
                 "of several turns in a bin of speed the one with the largest amplitude", rows=peaks, bin=scene["bins_hz"])
    print_columns(COLUMNS)
    for seconds, direction, table in found:
        for row in zip(*(table[name] for name, *_ in COLUMNS[2:])):
            print(f"{seconds:g}", direction, *(f"{value:.9g}" for value in row), sep="\t")


if __name__ == "__main__":
    main(sys.argv[1])
