"""What the model's motion does, by the judge (judge.cpp), which shares no code with src.

A machine is the dictionary of a parameter file. Hertz's stiffness, the kinematics, the
rest and the base period are computed here anew. Kinds and words are those of explore's
header.
"""
import dataclasses
import math
import os
import subprocess
import tomllib
from fractions import Fraction
from pathlib import Path

import numpy as np
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk

JUDGE = Path(os.environ.get("BUILD", "build"), "tests", "judge").resolve()
FILE = Path("data/bearings/deep_groove.toml")
CATALOGUE = tomllib.loads(FILE.read_text(encoding="utf-8"))
NAMES = ["x_s", "y_s", "x_r", "y_r"]
POINTS, KEPT = 512, 32  # instants of a period, periods that are kept
# Each of two in which the exponent is measured; longer ones where it does not decide [s].
WINDOWS = [8.0, 32.0, 128.0]
LONGEST = 120.0         # of a transient [s]
SAME = 1e-4             # of the largest displacement: what a finer step may change
TOLERANCE = 1e-9        # of the judge's local error


def ask(*words):
    """What the judge says of one case."""
    line = " ".join(repr(float(w)) if isinstance(w, float) else str(w) for w in words)
    answer = subprocess.run([JUDGE], input=line + "\n", stdout=subprocess.PIPE, text=True,
                            check=True).stdout
    return np.array(answer.split(), float)


def ellipse(ball, pitch, groove, inside):
    """Sum of the curvatures of a ball in the groove of a race, ratio k > 1 of the axes of
    their contact, and its m = 1 - 1/k^2: Harris, Rolling Bearing Analysis."""
    sign = 1 if inside else -1
    along, across = 2 / ball + 2 * sign / (pitch - sign * ball), (2 - 1 / groove) / ball
    total, share = along + across, (along - across) / (along + across)

    def excess(k):
        m = 1 - 1 / k**2
        return ((k**2 + 1) * ellipe(m) - 2 * ellipk(m)) / ((k**2 - 1) * ellipe(m)) - share

    k = brentq(excess, 1.001, 1000)
    return total, k, 1 - 1 / k**2


def hertz(ball, pitch, groove, inside, young, poisson):
    """K in Q = K p^1.5 [N/m^1.5]."""
    total, k, m = ellipse(ball, pitch, groove, inside)
    approach = 2 * ellipk(m) / math.pi * (math.pi / (2 * k**2 * ellipe(m))) ** (1 / 3)
    # p = approach (3 Q (1 - nu^2) / (total E))^(2/3) total / 2, two equal elastic bodies
    return (approach * total / 2) ** -1.5 * total * young / (3 * (1 - poisson**2))


def bearing_of(table):
    """n, K, its exponent, delta, c of the table [bearing]."""
    if "designation" not in table:
        delta = table.get("radial_clearance_m", table.get("diametral_clearance_m", 0) / 2)
        exponent = table.get("contact_exponent", 1.5)
        stiffness = table["contact_stiffness_N_per_m" + ("1p5" if exponent == 1.5 else "n")]
        return table["balls"], stiffness, exponent, delta, table["cage_speed_ratio"]
    named = table["designation"]
    entry = next(one for one in CATALOGUE["bearing"] if one["designation"] == named)
    ball, pitch = entry["ball_diameter_m"], entry["pitch_diameter_m"]
    steel = CATALOGUE["steel"]["youngs_modulus_Pa"], CATALOGUE["steel"]["poissons_ratio"]
    k = [hertz(ball, pitch, entry[f"{side}_groove_ratio"], side == "inner", *steel)
         for side in ("inner", "outer")]
    range_ = next(one for one in CATALOGUE["clearance"]
                  if one["above_m"] < entry["bore_m"] <= one["up_to_m"])
    return (entry["balls"], sum(one ** (-2 / 3) for one in k) ** -1.5, 1.5,
            sum(range_[table["internal_clearance"]]) / 4, (1 - ball / pitch) / 2)


def displacements(table):
    """Of a table's motion, a row for each instant; zero for a stator that is held."""
    zero = np.zeros(len(table))
    return np.stack([table.columns.get(name, zero) for name in NAMES], axis=1)


def state_at_zero(rows, period):
    """Displacements and rates of the first row of a motion that closes after `period`."""
    orders = 2j * np.pi * np.arange(len(rows) // 2 + 1)[:, None] / period
    rates = np.fft.irfft(orders * np.fft.rfft(rows, axis=0), axis=0, n=len(rows))[0]
    return np.concatenate([rows[0], rates])


def errors(ours, theirs):
    """Of displacements: the largest over the largest displacement, and rms about the mean
    over that motion's rms."""
    def scatter(q):
        return np.linalg.norm(q - q.mean(axis=0))
    return abs(ours - theirs).max() / abs(theirs).max(), scatter(ours - theirs) / scatter(theirs)


@dataclasses.dataclass
class Judged:
    """What the judge finds. `rows` are `KEPT` base periods from t = 0, `POINTS` of
    each."""
    kinds: list          # in both windows
    period: int          # K; 0 where nothing closes
    exponents: list      # value, error, value, error [1/s]
    statistics: np.ndarray  # of x_s y_s x_r y_r means, then rms about them: value, error
    rows: np.ndarray
    own: float = 0.0     # difference from itself with a finer step

    @property
    def kind(self):
        """None where the two windows, or two steps, contradict each other."""
        first, its_error, second, error = self.exponents
        apart = self.period == 0 and abs(first - second) > 5 * math.hypot(its_error, error)
        same = len(set(self.kinds)) == 1 and not apart and self.own < SAME
        return self.kinds[0] if same else None


class Model:
    """Eq. 7 of a machine at one speed."""

    def __init__(self, machine, frequency):
        self.frequency = frequency
        self.n, self.k_h, self.exponent, self.delta, self.c = bearing_of(machine["bearing"])
        self.damping = machine["bearing"].get("contact_damping_s_per_m", 0)
        self.unbalance = machine["rotor"]["unbalance_kg_m"]
        spall = machine["bearing"].get("defect", {})
        self.spall = [spall.get(key, 0) for key in ("depth_m", "width_rad", "angle_rad")]
        self.spall.append(int(spall.get("surface") == "inner_race"))
        g = machine["gravity"]["acceleration_m_per_s2"]
        self.m, self.k, self.d, self.loads = [], [], [], []
        for body in (machine["stator"], machine["rotor"]):
            if body.get("rigid"):
                # Nothing moves it, and what is disturbed comes back fast.
                body, weight = {"mass_kg": 1e30, "natural_frequency_rad_per_s": 1000,
                                "damping_ratio": 1}, 0
            else:
                weight = g
            m, w = body["mass_kg"], body["natural_frequency_rad_per_s"]
            x, y = body.get("load_N", [0, 0])
            self.m.append(m), self.k.append(m * w * w)
            self.loads.append((x, y - m * weight))
            self.d.append(body.get("damping_N_s_per_m",
                                   2 * body.get("damping_ratio", 0) * m * w))
        passages = self.n * self.c
        near = Fraction(passages).limit_denominator(8)
        rotates = self.unbalance + self.spall[3]
        self.two = rotates > 0 and abs(near - passages) > 1e-9
        self.turns = 1 if self.two else near.denominator if rotates > 0 else 1 / passages
        self.base = self.turns / frequency

    def words(self):
        bodies = [value for of in zip(self.m, self.k, self.d) for value in of]
        return ["eq7", *bodies, self.unbalance, self.n, self.k_h, self.exponent, self.delta,
                self.c, self.damping, *self.spall,
                *self.loads[0], *self.loads[1], self.frequency, self.turns]

    def lead(self):
        """How long a transient lasts by the linear decay on a closed contact [s]."""
        load = max(np.hypot(*np.sum(self.loads, axis=0)), 1e-6)
        contact = 1.5 * self.k_h ** (2 / 3) * load ** (1 / 3)
        stiff = np.diag(self.k) + contact * np.array([[1, -1], [-1, 1]])
        mass = np.array(self.m)[:, None]
        matrix = np.block([[np.zeros((2, 2)), np.eye(2)],
                           [-stiff / mass, -np.diag(self.d) / mass]])
        if self.m[0] > 1e20:
            matrix = matrix[1::2, 1::2]
        rates = -np.linalg.eigvals(matrix).real
        return min(max(25 / max(rates.min(), 1e-6), 4), 25)

    def rest(self, time):
        """The state at rest with the cage at its angle of that time: the least energy, by
        Newton's method."""
        angle = 2 * np.pi * (np.arange(self.n) / self.n + self.c * self.frequency * time)
        row = np.stack([-np.cos(angle), -np.sin(angle), np.cos(angle), np.sin(angle)],
                       axis=1)
        springs, load = np.repeat(self.k, 2), np.concatenate(self.loads)
        held = self.m[0] > 1e20
        springs[:2] = 1 if held else springs[:2]

        def energy(q):
            p = np.maximum(0, row @ q - self.delta)
            stored = self.k_h * np.sum(p ** (self.exponent + 1)) / (self.exponent + 1)
            return springs @ q**2 / 2 + stored - load @ q

        size = abs(self.delta) + (np.linalg.norm(load) / self.k_h) ** (2 / 3) + 1e-12
        q, damping = np.zeros(4), np.linalg.norm(load) / size * 1e-3 + 1e-9
        if load.any():
            total = np.sum(self.loads, axis=0)
            q[2:] = total / np.linalg.norm(total) * size
            q += np.zeros(4) if held else np.tile(total / sum(self.k), 2)
        for _ in range(500):
            p = np.maximum(0, row @ q - self.delta)
            force = springs * q + self.k_h * row.T @ p**self.exponent - load
            slopes = self.exponent * self.k_h * p ** (self.exponent - 1)
            stiff = np.diag(springs) + (row.T * slopes) @ row
            if held:
                force[:2], stiff[:2], stiff[:, :2] = 0, 0, 0
                stiff[:2, :2] = np.eye(2)
            step = -np.linalg.solve(stiff + damping * np.eye(4), force)
            if abs(step).max() < 1e-14 * size:
                break
            better = energy(q + step) <= energy(q)
            q, damping = (q + step, damping / 4) if better else (q, damping * 8)
        return np.concatenate([q, np.zeros(4)])

    def settle(self, state, first, transient, observed, kept=KEPT, points=POINTS,
               tolerance=TOLERANCE):
        """The judge's words; those of the rows come last. `kept` periods after the
        transient."""
        return ask("settle", first, transient, observed, transient, kept, points, tolerance,
                   *self.words(), *state)

    def settled(self, turns, points):
        """The motion in the turns after t = 0, as long after rest as a transient lasts."""
        before = math.ceil(self.lead() / self.base)
        state = self.rest(-before * self.base)
        return self.judged(self.settle(state, -before, before, turns, turns, points)).rows

    def closed(self, state):
        """The largest multiplier and the state at phase 0 of the motion of one base period
        that the judge's Newton iteration reaches from a state; None where it does not."""
        answer = ask(*self.words(), *state)
        return (abs(complex(*answer[1:3])), answer[3:]) if answer[0] else None

    def kind(self, period, exponent, error):
        if period:
            return "periodic"
        if exponent - 3 * error > 0:
            return "chaotic"
        neutral = abs(exponent) <= 3 * error < 0.1
        torus = exponent + 3 * error < 0 if self.two else neutral
        return "quasi-periodic" if torus else "undecided"

    def judged(self, answer):
        if answer[0] < 0:
            return Judged(["overflow"] * 2, 0, [0, 0, 0, 0], np.zeros((8, 2)),
                          np.zeros((0, 4)))
        period = 0 if self.two else int(answer[0])
        statistics = answer[5:21].reshape(8, 2)
        mean, square = statistics[:4], statistics[4:]
        rms = np.sqrt(np.maximum(1e-300, square[:, 0] - mean[:, 0] ** 2))
        error = (square[:, 1] + 2 * abs(mean[:, 0]) * mean[:, 1]) / (2 * rms)
        spread = np.stack([rms, error], axis=1)
        return Judged([self.kind(period, *answer[1:3]), self.kind(period, *answer[3:5])],
                      period, list(answer[1:5]),
                      np.concatenate([mean, spread]), answer[21:].reshape(-1, 4))

    def from_rest(self):
        """The motion after a start from rest that leaves t = 0 with the unbalance and
        ball 1 along x. The start is earlier where disturbances live longer or a finer
        step disagrees, the windows are longer where the exponent does not decide."""
        lead, window = self.lead(), WINDOWS[0]
        while True:
            before = math.ceil(lead / self.base)
            state = self.rest(-before * self.base)
            found = self.judged(self.settle(state, -before, before,
                                            self.observed(window)))
            contracts = -np.mean(found.exponents[::2]) * lead
            if 0 < contracts < 18 and found.kind != "chaotic" and lead < LONGEST:
                lead = min(20 / contracts * lead, LONGEST)
                continue
            if found.kind in (None, "undecided") and window < WINDOWS[-1]:
                window = WINDOWS[WINDOWS.index(window) + 1]
                continue
            if found.kind not in ("periodic", "quasi-periodic"):
                return found
            finer = self.judged(self.settle(state, -before, before, KEPT,
                                            tolerance=TOLERANCE / 32))
            found.own = abs(found.rows - finer.rows).max() / abs(finer.rows).max()
            if found.own < SAME or lead >= LONGEST:
                return found
            lead = min(4 * lead, LONGEST)

    def observed(self, window):
        return math.ceil(2 * window / self.base) + KEPT

    def from_state(self, state, first, periods, points):
        """The motion from a state at the start of the period `first`; its rows are that
        many base periods, `points` of each."""
        for window in WINDOWS:
            observed = max(periods, self.observed(window))
            found = self.judged(self.settle(state, first, 0, observed, periods, points))
            if found.kind not in (None, "undecided"):
                break
        return found


def model_of(file, frequency):
    return Model(tomllib.loads(file.read_text(encoding="utf-8")), frequency)
