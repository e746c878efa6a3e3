"""Identification: masses and cage that the paper leaves out.

The paper gives neither masses nor the radii that fix the speed of the cage, and prints natural frequencies that may be
exchanged (D-09). Its text bounds them without any simulation. Rotor and stator joined rigidly resonate where the response has
its peak, around 50 Hz: that is the ratio of the masses. The joint carries a static force from gravity and a rotating one from
the unbalance. The text has gravity predominant up to 10 Hz and the unbalance above 19 Hz, so that both are equal in between:
that bounds the mass of the stator. Fig. 4 shows the transition at 13.4 Hz; the mass for which both are equal just there is the
best guess. A cage for which the force has the period of rotation, with balls that do not overlap, has one of two speeds.

All accepted machines are integrated at 60 speeds, for both clearances, and their motions are compared with harmonic balance.
From this table `make claims` computes each claim's quantity for every accepted machine, and says for which masses its verdict
holds. No claim's verdict takes part in the choice.

Above, the figure shows against the stator's mass the closed form of the loss of contact, and the speeds at which integration
loses contact; below, the verdict of every claim for every accepted machine. Circles stand at the masses used everywhere else.

The kept table was made by the program that this script replaced. Of 144 rows computed anew all that are T-periodic agree in the
five digits that are kept; averages of aperiodic motion differ by up to 16 %, since the masses differ in the seventh digit.

Usage: studies/identification.py data/scenes/identification.toml > identification.tsv   (from the project's root)
"""
import sys
import tempfile
import tomllib
from pathlib import Path

import numpy as np

sys.path.insert(1, str(Path(__file__).parents[1] / "figures"))
from tables import Table, explore, print_columns, print_header  # noqa: E402

KEYS = ("stator.mass_kg", "rotor.mass_kg", "bearing.cage_speed_ratio")
READINGS = {"exchanged": "", "as-printed": "-as-printed"}
# name, unit, meaning, the map's quantity
QUANTITIES = [
    ("periodic", "-", "1 if the motion has the period of rotation", "periodic"),
    ("contact", "-", "share of the time with at least one loaded ball", "settled_contact"),
    ("turns", "-", "turns of the bearing's force per period", "turns"),
    ("higher_harmonics", "-", "rms of harmonics 2 and above over the first", "higher_harmonics"),
    ("passed_once", "-", "share of pairs of periods in which every ball is loaded exactly once", "passed_once"),
    ("passages", "-", "times a ball is loaded in two periods, mean over the balls", "passages"),
    ("loaded_arc", "rad", "mean over time of the loaded arc", "loaded_arc"),
    ("largest_force", "N", "largest force on one ball", "settled_load"),
    ("amp_x_r", "m", "half peak-to-peak of x_r", "settled_amplitude"),
    *((f"error_{m}", "-", "" if m > 6 else "rms error about the mean with so many harmonics; -1 where the motion is not "
       "T-periodic, 2 where there is no solution", f"error_{m}") for m in (6, 7, 8, 9, 10, 12, 16))]
COLUMNS = [
    ("reading", "-", "of Table 1: 0 exchanged, 1 as printed"), ("set", "-", "data set"), ("m_s", "kg", "mass of the stator"),
    ("m_r", "kg", "mass of the rotor"), ("f_joint", "Hz", "joint resonance"), ("cage_speed_ratio", "-", "omega_cage/omega"),
    ("f_loss", "Hz", "closed form of the loss of contact"), ("f", "Hz", "speed of rotation"),
    *(quantity[:3] for quantity in QUANTITIES)]


def accepted_cages(balls):
    """Cage ratios k/n for which the balls do not overlap, the largest first: omega_cage/omega <= 1/2."""
    least = 0.5 * (1 - np.sin(np.pi / balls))
    return [k / balls for k in range(balls // 2, 0, -1) if k > least * balls]


def mapped(file, points, quantities, *options):
    """The map at a list of points (m_s, m_r, cage)."""
    with tempfile.NamedTemporaryFile("w", suffix=".tsv") as table:
        table.write("\n".join("\t".join(map(str, line)) for line in [KEYS, *points]) + "\n")
        table.flush()
        result = explore("map", file, "--method", "rk4", "--list", table.name, "--quantity", ",".join(quantities), *options)
    return Table.of(result.stdout)


def numbers(column, missing):
    """A column with a number in place of -."""
    return np.array([missing if cell == "-" else float(cell) for cell in column])


class Base:
    """A parameter file whose masses and cage are varied."""

    def __init__(self, file):
        self.file = file
        machine = tomllib.loads(Path(file).read_text(encoding="utf-8"))
        self.omegas = [machine[body]["natural_frequency_rad_per_s"] for body in ("stator", "rotor")]
        self.mass, self.balls = machine["stator"]["mass_kg"], machine["bearing"]["balls"]

    def masses(self, mass, joint):
        """m_s and the m_r that puts the joint resonance at `joint` [Hz]."""
        stator, rotor = (omega**2 for omega in self.omegas)
        omega = (2 * np.pi * joint) ** 2
        return mass, mass * (stator - omega) / (omega - rotor)

    def mass_losing_at(self, joint, speed):
        """The stator's mass [kg] from which on gravity and unbalance load the rigid joint equally above a speed [Hz] only:
        that speed rises with the mass."""
        low, high = 1e-3 * self.mass, 1e3 * self.mass
        for _ in range(4):  # a hundredth of the interval's logarithm is left each time
            tried = np.geomspace(low, high, 101)
            points = [(*self.masses(mass, joint), 0.5) for mass in tried]
            equal = numbers(mapped(self.file, points, ["force_balance"], "--frequency", 1)["force_balance"], np.inf)
            above = int(np.argmax(equal > speed))
            low, high = tried[above - 1], tried[above]
        return low

    def accepted(self, joint, losses, count):
        """So many points at equal ratios of the stator's mass, between those that lose contact at two speeds."""
        ends = [self.mass_losing_at(joint, loss) for loss in losses]
        return [self.masses(mass, joint) for mass in np.geomspace(*ends, count)]


def candidates(base, text, count):
    """(joint resonance, (m_s, m_r, cage)): the accepted masses at the paper's peak with every cage, and with the first cage at
    the ends of the accepted peaks."""
    cages = accepted_cages(base.balls)
    families = [(text["paper_peak_hz"], cage) for cage in cages] + [(peak, cages[0]) for peak in text["peak_hz"]]
    masses = {joint: base.accepted(joint, text["loss_hz"], count) for joint in {joint for joint, _ in families}}
    return [(joint, (*pair, cage)) for joint, cage in families for pair in masses[joint]]


def rows_of(base, machines, scene):
    """The table of a map, and its cells from m_s on, machine by machine and speed by speed."""
    speeds = scene["speeds_hz"]
    count = round((speeds["to"] - speeds["from"]) / speeds["step"]) + 1
    names = [quantity for *_, quantity in QUANTITIES]
    table = mapped(base.file, [point for _, point in machines], ["force_balance", *names], "--x",
                   f"frequency={speeds['from']}:{speeds['to']}:{count}", "--longest", scene["regime"]["longest_s"])
    cells = [numbers(table[name], -1 if name.startswith("error") else 0) for name in names]
    joints = np.repeat([joint for joint, _ in machines], count)
    return table, list(zip(table[KEYS[0]], table[KEYS[1]], joints, table[KEYS[2]], table["force_balance"], table["frequency"],
                           *cells))


def main(file):
    scene = tomllib.loads(Path(file).read_text(encoding="utf-8"))
    text = tomllib.loads(Path("data/claims.toml").read_text(encoding="utf-8"))["accepted"]
    found, accepted = [], []
    for reading, suffix in READINGS.items():
        bases = [Base(f"data/{name}{suffix}.toml") for name in scene["parameters"]]
        low, high, shown = (bases[0].mass_losing_at(text["paper_peak_hz"], loss)
                            for loss in (*text["loss_hz"], text["paper_loss_hz"]))
        accepted.append(("accepted", [reading, *(float(f"{mass:.4g}") for mass in (low, high)), text["paper_loss_hz"], float(f"{shown:.4g}")]))
        found += [rows_of(base, candidates(base, text, scene["grid"]["masses"]), scene) for base in bases]
    print_header("Motions of the machines that the paper's text admits", [table for table, _ in found],
                 f"modelled: rk4 at {len(np.unique(found[0][0]['frequency']))} speeds, at most {scene['regime']['longest_s']:g} s "
                 "each; masses and cage as in the rows; [accepted] of data/claims.toml",
                 "row accepted: reading, least and largest mass of the stator [kg], speed of loss of contact [Hz], mass with that",
                 rows=accepted)
    print_columns(COLUMNS)
    for number, (_, rows) in enumerate(found):
        reading, data_set = divmod(number, len(scene["parameters"]))
        for row in rows:
            print("\t".join(f"{cell:.5g}" for cell in (reading, data_set + 1, *row)))


if __name__ == "__main__":
    main(*sys.argv[1:])
