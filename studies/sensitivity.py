"""Sensitivity to what the paper leaves out: total mass, ratio of the masses, cage, samples N, step h of rk4.

Each is varied alone about its default: the total mass m_s + m_r at fixed ratio, the ratio m_r/m_s at fixed total, the
cage ratio, N of harmonic balance, h of rk4. Outputs: the peak of x_r, the speeds between which contact is lost, and the
size of the orbit at one speed. The peak is found by harmonic balance, except against the cage ratio (most values have
no period of rotation, D-11) and against h: there by rk4. Everything is asked of `explore map` and `explore orbit`;
what a parameter does not enter is computed once.

A flat row of the figure says that the paper could leave that parameter out without harm to this result; a steep one that
the result could not be reproduced without it, except by luck. Masses are of the second kind. Samples and step should be
of the first, since they belong to the method and not to the machine.

Usage: studies/sensitivity.py data/scenes/sensitivity.toml > sensitivity.tsv   (from the project's root)
"""
import os
import sys
import tempfile
import tomllib
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

sys.path.insert(1, str(Path(__file__).parents[1] / "figures"))
from rotor_stator import attempt, map_at  # noqa: E402
from tables import print_columns  # noqa: E402

PARAMETERS = [("mass", "mass_kg", "kg"), ("mass_ratio", "mass_ratio", "-"), ("cage_ratio", "cage_ratio", "-"),
              ("samples", "samples", "-"), ("step", "step_s", "s")]
KEYS = ("stator.mass_kg", "rotor.mass_kg", "bearing.cage_speed_ratio")
FINER, HALVINGS = 4, 5
COLUMNS = [
    ("parameter", "word", "mass: m_s + m_r; mass_ratio: m_r/m_s at the default m_s + m_r; cage_ratio: "
     "omega_cage/omega; samples: N; step: longest h of rk4"),
    ("value", "see unit", "of the parameter"), ("unit", "word", "of the parameter"), ("default", "-", "1 at the default"),
    ("f_peak", "Hz", "speed of the largest x_r"), ("amp_peak", "m", "half peak-to-peak of x_r there"),
    ("f_loss_first", "Hz", "lowest speed with loss of contact; -1: none"),
    ("f_loss_last", "Hz", "highest speed with loss of contact; -1: none"),
    ("amp_x_13p4", "m", "half peak-to-peak of x_r, integrated, mean over the periods"),
    ("amp_y_13p4", "m", "the same of y_r"),
    ("amp_x_13p4_aft", "m", "half peak-to-peak of x_r, harmonic balance; -1: none"),
    ("amp_y_13p4_aft", "m", "the same of y_r; -1: none"),
    ("error_f_loss_first", "Hz", "half a step of the search: loss comes and goes near the ends"),
    ("error_f_loss_last", "Hz", "the same"),
    ("error_x_13p4", "m", "standard error of amp_x_13p4"), ("error_y_13p4", "m", "standard error of amp_y_13p4"),
    ("lyapunov_13p4", "1/s", "growth rate of neighbouring motions"),
    ("periodic_13p4", "-", "1 if the motion has the period of rotation"),
    ("peak_by", "word", "aft: harmonic balance; rk4: time integration")]


@dataclass(frozen=True)
class Model:
    """What a point is computed with; `masses_and_cage` in the order of KEYS."""
    masses_and_cage: tuple
    samples: int
    step: float


class Study:
    """The scene, the machine at its defaults, and the questions to explore."""

    def __init__(self, file):
        self.scene = tomllib.loads(Path(file).read_text(encoding="utf-8"))
        self.machine = f"data/{self.scene['parameters']}.toml"
        machine = tomllib.loads(Path(self.machine).read_text(encoding="utf-8"))
        self.time = self.scene["time_integration"]
        masses = machine["stator"]["mass_kg"], machine["rotor"]["mass_kg"]
        self.usual = Model((*masses, machine["bearing"]["cage_speed_ratio"]), self.scene["samples"], self.time["step_s"])
        self.balls = machine["bearing"]["balls"]
        self.header = ""

    def varied(self, parameter, value):
        """The model with one parameter changed."""
        stator, rotor, cage = self.usual.masses_and_cage
        total, ratio = stator + rotor, rotor / stator
        if parameter == "samples":
            return Model(self.usual.masses_and_cage, value, self.usual.step)
        if parameter == "step":
            return Model(self.usual.masses_and_cage, self.usual.samples, value)
        if parameter == "cage_ratio":
            return Model((stator, rotor, value), self.usual.samples, self.usual.step)
        total, ratio = (value, ratio) if parameter == "mass" else (total, value)
        return Model((total / (1 + ratio), total - total / (1 + ratio), cage), self.usual.samples, self.usual.step)

    def method(self, model, by_balance):
        """The options that say how."""
        if by_balance:
            return {"method": "aft", "harmonics": self.scene["harmonics"], "samples": model.samples}
        return {"method": "rk4", "step": model.step, "longest": self.time["longest_s"]}

    def response(self, model, quantity, speeds, by_balance):
        """A quantity at speeds [Hz] in any order, 0 without a solution."""
        where = {"x": f"frequency={speeds[0]:.17g}:{speeds[-1]:.17g}:{len(speeds)}"} if len(speeds) > 1 else {"frequency": f"{speeds[0]:.17g}"}
        table = map_at(self.machine, KEYS, [model.masses_and_cage], quantity=quantity, threads=1, **where, **self.method(model, by_balance))
        self.header = self.header or table.header
        column = table[quantity]
        return column if column.dtype.kind == "f" else np.array([0 if c == "-" else float(c) for c in column])

    @cache
    def peak(self, model, by_balance):
        """Speed and height of the largest x_r: on the scene's speeds, on finer ones about it, then of a parabola."""
        around = self.scene["peak_hz" if by_balance else "time_peak_hz"]
        speeds = np.arange(around["from"], around["to"] + around["step"] / 2, around["step"])
        for finer in (False, True):
            if finer:
                speeds = speeds[top] + np.arange(-FINER, FINER + 1) * around["step"] / FINER
            curve = self.response(model, "amplitude", speeds, by_balance)
            top = curve.argmax()
            if top in (0, speeds.size - 1):
                sys.exit("the largest amplitude is at an end of the speeds looked at")
        slope, bend = (curve[top + 1] - curve[top - 1]) / 2, curve[top + 1] - 2 * curve[top] + curve[top - 1]
        shift = -slope / bend
        return speeds[top] + shift * (speeds[1] - speeds[0]), curve[top] + slope * shift / 2

    @cache
    def losses(self, model):
        """First and last speed at which contact is lost, -1 if none: in the scene's raster, then halved."""
        raster = self.scene["contact_loss_hz"]
        speeds = np.arange(raster["from"], raster["to"] + raster["step"] / 2, raster["step"])
        lost = np.flatnonzero(self.response(model, "contact_share", speeds, False) < 1)
        if lost.size == 0:
            return (-1, 0), (-1, 0)
        return tuple(self.onset(model, speeds, at, at + outward) for at, outward in ((lost[0], -1), (lost[-1], 1)))

    def onset(self, model, speeds, at, beside):
        """Between a speed that loses contact and its neighbour that does not. Near the ends loss comes and goes
        within hundredths of a hertz, so that half the neighbours' distance is the uncertainty."""
        if not 0 <= beside < speeds.size:
            return speeds[at], 0
        loses, keeps = speeds[at], speeds[beside]
        uncertainty = abs(loses - keeps) / 2
        for _ in range(HALVINGS):
            middle = (loses + keeps) / 2
            if self.response(model, "contact_share", [middle], False)[0] < 1:
                loses = middle
            else:
                keeps = middle
        return (loses + keeps) / 2, uncertainty

    def orbit(self, model, **options):
        """The orbit at the scene's speed, of the machine written with these masses and this cage."""
        text = Path(self.machine).read_text(encoding="utf-8")
        for old, new in zip(self.usual.masses_and_cage, model.masses_and_cage):
            key = KEYS[self.usual.masses_and_cage.index(old)].split(".")[1]
            text = text.replace(f"{key} = {old}", f"{key} = {new:.17g}", 1)
        with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
            file.write(text)
            file.flush()
            return attempt("orbit", file.name, frequency=self.scene["orbit_hz"], **options)

    @cache
    def balance_size(self, model):
        """Half peak-to-peak of x_r and y_r by harmonic balance, -1 without a solution."""
        passages = self.balls * model.masses_and_cage[2]
        table = None
        if abs(passages - round(passages)) < 1e-9:
            table = self.orbit(model, no_stability=True, points=4096, **self.method(model, True))
        return (-1, -1) if table is None else tuple(np.ptp(table[name]) / 2 for name in ("x_r", "y_r"))

    @cache
    def integrated_size(self, model):
        """The same by rk4, each the mean over the periods with its standard error; growth rate; whether the period is a turn's."""
        points = self.time["points_per_period"]
        table = self.orbit(model, points=points, periods=self.scene["orbit_periods"], **self.method(model, False))
        sizes = [mean_and_error((crests(table[name], points) + crests(-table[name], points)) / 2)
                 for name in ("x_r", "y_r")]
        return *sizes, table.value("lyapunov"), int(table.value("regime") == "periodic" and table.value("period") == 1)

    def row(self, parameter, value):
        """The cells after the unit."""
        model = self.varied(parameter, value)
        by_balance = parameter not in ("cage_ratio", "step")
        balanced = Model(model.masses_and_cage, model.samples, self.usual.step)
        integrated = Model(model.masses_and_cage, self.usual.samples, model.step)
        first, last = self.losses(integrated)
        x, y, lyapunov, periodic = self.integrated_size(integrated)
        return [int(model == self.usual), *self.peak(balanced if by_balance else integrated, by_balance),
                first[0], last[0], x[0], y[0], *self.balance_size(balanced), first[1], last[1], x[1], y[1],
                lyapunov, periodic, "aft" if by_balance else "rk4"]


def crests(values, points):
    """The largest value of each period, of a parabola where it is higher than both its neighbours."""
    around = np.concatenate([values[points - 1:points], values, values[-points:][:1]])
    top = np.arange(0, values.size, points) + values.reshape(-1, points).argmax(axis=1)
    before, largest, after = around[top], around[top + 1], around[top + 2]
    bend = before - 2 * largest + after
    is_crest = (before <= largest) & (after <= largest) & (bend < 0)
    return np.where(is_crest, largest - (after - before)**2 / (8 * np.where(is_crest, bend, 1)), largest)


def mean_and_error(values):
    """The standard error is that of the means of ten blocks of neighbours."""
    blocks = [block.mean() for block in np.array_split(values, 10)]
    return values.mean(), np.sqrt(np.square(np.array(blocks) - values.mean()).sum() / 90)


def main(file):
    study = Study(file)
    points = [(name, value, unit) for name, key, unit in PARAMETERS for value in study.scene["values"][key]]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        rows = list(pool.map(lambda point: study.row(*point[:2]), points))
    print("# Sensitivity to the parameters that the paper leaves out")
    print(*(line for line in study.header.split("\n")[1:] if line.startswith(("# source", "# compiler", "# schema", "# param", "#   "))),
          sep="\n")
    print(f"# harmonics: {study.scene['harmonics']}\n# samples: {study.scene['samples']}")
    print(f"# note: modelled: {file}; one parameter at a time, the others at their defaults")
    print_columns(COLUMNS)
    for (name, value, unit), cells in zip(points, rows):
        print("\t".join(cell if isinstance(cell, str) else f"{cell:.15g}" for cell in (name, value, unit, *cells)))


if __name__ == "__main__":
    main(*sys.argv[1:])
