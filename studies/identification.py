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

Usage: studies/identification.py data/scenes/identification.toml > identification.tsv   (from the project's root)
"""
import os
import re
import subprocess
import sys
import tempfile
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

sys.path.insert(1, str(Path(__file__).parents[1] / "figures"))
from rotor_stator import map_at, run  # noqa: E402
from tables import Table, print_columns, print_header  # noqa: E402

READINGS = {"exchanged": "", "as-printed": "-as-printed"}
HARMONICS = (6, 7, 8, 9, 10, 12, 16)
MEASURES = [  # of build/regimes
    ("periodic", "-", "1 if the motion has the period of rotation"),
    ("contact", "-", "share of the time with at least one loaded ball"),
    ("turns", "-", "turns of the bearing's force per period"),
    ("higher_harmonics", "-", "rms of harmonics 2 and above over the first"),
    ("passed_once", "-", "share of pairs of periods in which every ball is loaded exactly once"),
    ("passages", "-", "times a ball is loaded in two periods, mean over the balls"),
    ("loaded_arc", "rad", "mean over time of the loaded arc"),
    ("largest_force", "N", "largest force on one ball"),
    ("amp_x_r", "m", "half peak-to-peak of x_r")]
COLUMNS = [
    ("reading", "-", "of Table 1: 0 exchanged, 1 as printed"), ("set", "-", "data set"), ("m_s", "kg", "mass of the stator"),
    ("m_r", "kg", "mass of the rotor"), ("f_joint", "Hz", "joint resonance"), ("cage_speed_ratio", "-", "omega_cage/omega"),
    ("f_loss", "Hz", "closed form of the loss of contact"), ("f", "Hz", "speed of rotation"), *MEASURES,
    *((f"error_{m}", "-", "" if m > 6 else "rms error about the mean with so many harmonics; -1 where the motion is not "
       "T-periodic, 2 where there is no solution") for m in HARMONICS)]


def accepted_cages(balls):
    """Cage ratios k/n for which the balls do not overlap, the largest first: omega_cage/omega <= 1/2."""
    least = 0.5 * (1 - np.sin(np.pi / balls))
    return [k / balls for k in range(balls // 2, 0, -1) if k > least * balls]


class Base:
    """A parameter file whose masses and cage are varied."""

    def __init__(self, file):
        self.file = file
        self.text = Path(file).read_text(encoding="utf-8")
        machine = tomllib.loads(self.text)
        bodies = [machine[body] for body in ("stator", "rotor")]
        self.omegas = [body["natural_frequency_rad_per_s"] for body in bodies]
        self.dampings = [body["damping_ratio"] for body in bodies]
        self.unbalance, self.gravity = machine["rotor"]["unbalance_kg_m"], machine["gravity"]["acceleration_m_per_s2"]
        self.balls = machine["bearing"]["balls"]

    def masses(self, mass, joint):
        """m_s and the m_r that puts the joint resonance at `joint` [Hz]."""
        stator, rotor = (omega**2 for omega in self.omegas)
        omega = (2 * np.pi * joint) ** 2
        return mass, mass * (stator - omega) / (omega - rotor)

    def mass_losing_at(self, joint, speed):
        """The stator's mass [kg] with which gravity and unbalance load the rigid joint equally at a speed [Hz]. The static force
        is proportional to the masses, whose ratio is fixed; that of the unbalance is independent of them."""
        stator, rotor = self.masses(1, joint)
        k_s, k_r = (mass * omega**2 for mass, omega in zip((stator, rotor), self.omegas))
        static = self.gravity * abs(rotor - k_r * (stator + rotor) / (k_s + k_r))
        omega = 2 * np.pi * speed
        z_s, z_r = (mass * (natural**2 - omega**2 + 2j * damping * natural * omega)
                    for mass, natural, damping in zip((stator, rotor), self.omegas, self.dampings))
        return abs(z_s / (z_s + z_r)) * self.unbalance * omega**2 / static

    def ends(self, joint, losses):
        """The least and the largest mass of the stator that lose contact between two speeds; in the printed order the largest
        loses it before the last of these."""
        masses = [self.mass_losing_at(joint, loss) for loss in np.linspace(*losses, 901)]
        return min(masses), max(masses)

    def accepted(self, joint, losses, count):
        """So many points at equal ratios of the stator's mass, between these."""
        return [self.masses(mass, joint) for mass in np.geomspace(*self.ends(joint, losses), count)]

    def write(self, file, stator, rotor, cage):
        """The machine with these masses and this cage."""
        masses = iter((stator, rotor))
        text = re.sub(r"(?m)^mass_kg = .*", lambda _: f"mass_kg = {next(masses)!r}", self.text)
        Path(file).write_text(re.sub(r"(?m)^cage_speed_ratio = .*", f"cage_speed_ratio = {cage!r}", text), encoding="utf-8")


def candidates(base, text, count):
    """(joint resonance, (m_s, m_r, cage)): the accepted masses at the paper's peak with every cage, and with the first cage at
    the ends of the accepted peaks."""
    cages = accepted_cages(base.balls)
    families = [(text["paper_peak_hz"], cage) for cage in cages] + [(peak, cages[0]) for peak in text["peak_hz"]]
    masses = {joint: base.accepted(joint, text["loss_hz"], count) for joint in {joint for joint, _ in families}}
    return [(joint, (*pair, cage)) for joint, cage in families for pair in masses[joint]]


def errors_of(file, speeds, m):
    """rms errors at so many speeds [Hz] of the solutions with m harmonics, each found on its own; 2 where there is none."""
    if not len(speeds):
        return []
    table = map_at(file, ["frequency"], [[repr(float(f))] for f in speeds], harmonics=m, quantity="error")
    return [2 if cell == "-" else float(cell) for cell in table["error"]]


def rows_of_machine(base, joint, point, scene):
    """The cells of one machine from m_s on, speed by speed, by programs that read it from a file."""
    speeds = scene["speeds_hz"]
    with tempfile.TemporaryDirectory() as folder:
        machine, questions = Path(folder, "data", "machine.toml"), Path(folder, "data", "scenes", "regimes.toml")
        questions.parent.mkdir(parents=True)
        base.write(machine, *map(float, point))
        regime = scene["regime"]
        questions.write_text('parameters = ["machine"]\n' + "speeds_hz = {{ from = {from}, to = {to}, step = {step} }}\n".format(**speeds)
                             + "[regime]\nstep_over_default = 2.0\n"
                             f"longest_s = {regime['longest_s']}\nwindow_s = {regime['longest_s'] / 10}\n"
                             f"average_s = {2 * regime['longest_s']}\npoints_per_period = 64\n", encoding="utf-8")
        found = subprocess.run(["build/regimes", questions], stdout=subprocess.PIPE, encoding="utf-8", check=True)
        table = Table.of(found.stdout)
        check = run("check", machine, to=2 * joint)
        loss = dict(zip(check["name"], check["value"]))["contact_loss"]
        periodic = table["periodic"] == 1
        errors = np.full((len(table), len(HARMONICS)), -1.0)
        for k, m in enumerate(HARMONICS):
            errors[periodic, k] = errors_of(machine, table["f"][periodic], m)
    stator, rotor, cage = point
    return [(stator, rotor, joint, cage, float(loss), f, *cells, *error) for f, cells, error in
            zip(table["f"], np.transpose([table[name] for name, *_ in MEASURES]), errors)]


def main(file):
    scene = tomllib.loads(Path(file).read_text(encoding="utf-8"))
    text = tomllib.loads(Path("data/claims.toml").read_text(encoding="utf-8"))["accepted"]
    accepted, bases = [], []
    for reading, suffix in READINGS.items():
        bases += [Base(f"data/{name}{suffix}.toml") for name in scene["parameters"]]
        low, high = bases[-1].ends(text["paper_peak_hz"], text["loss_hz"])
        shown = bases[-1].mass_losing_at(text["paper_peak_hz"], text["paper_loss_hz"])
        accepted.append(("accepted", [reading, *(float(f"{mass:.4g}") for mass in (low, high)), text["paper_loss_hz"], float(f"{shown:.4g}")]))
    asked = [(number, base, *machine) for number, base in enumerate(bases)
             for machine in candidates(base, text, scene["grid"]["masses"])]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        found = list(pool.map(lambda one: rows_of_machine(*one[1:], scene), asked))
    print_header("Motions of the machines that the paper's text admits",
                 [run("check", base.file) for base in bases],
                 f"modelled: rk4, at most {scene['regime']['longest_s']:g} s of transient; masses and cage as in the rows; [accepted] of "
                 "data/claims.toml",
                 "row accepted: reading, least and largest mass of the stator [kg], speed of loss of contact [Hz], mass with that",
                 rows=accepted)
    print_columns(COLUMNS)
    for (number, *_), rows in zip(asked, found):
        reading, data_set = divmod(number, len(scene["parameters"]))
        for row in rows:
            print("\t".join(f"{cell:.5g}" for cell in (reading, data_set + 1, *row)))


if __name__ == "__main__":
    main(*sys.argv[1:])
