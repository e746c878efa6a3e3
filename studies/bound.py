r"""A bound of the error of harmonic balance, once.

The error that `explore` prints beside a solution is its distance from another computed motion. For one motion of data set 1 this page
derives a bound from the solution alone: within it, Eq. 7 has a motion of period T.

Let $q$ be a solution with m harmonics, a trigonometric polynomial, and $u = Pq$ the relative motion of the rings. Its residual
$r = M\ddot q + C\dot q + Kq + P^T F(u, t) - p(t)$ in Eq. 7, with the loads $p$, holds the harmonics of the Hertz force above m,
which the balance leaves out; it is evaluated at many instants. A motion $q + e$ of period T solves Eq. 7 exactly if

$$ e = e_1 - L^{-1} P^T N(Pe), \quad e_1 = -L^{-1} r, \quad N(d) = F(u + d, t) - F(u, t) - F'(u, t)\,d, $$

with the linearisation $Le = M\ddot e + C\dot e + (K + P^T F'(u, t) P)\,e$. No multiplier of $L$ is one, so that among motions of
period T its inverse is an integral, $L^{-1} f = \int_0^T G(t, s) f(s)\,ds$. With the fundamental matrix $\Phi$, $G$ is the block of
$\Phi(t)\,(I - \Phi(T))^{-1}\,\Phi(s)^{-1}$ that leads from speeds to displacements, times $M^{-1}$; for $s > t$ a factor $\Phi(T)$
stands before $\Phi(s)^{-1}$.

By Eq. 4 the penetration $z_j$ of ball j is linear in $u$: with the direction $n_j$ of the ball, $d$ changes it by $a = n_j \cdot d$. Hence
$N = \sum_j \nu_j n_j$ with $\nu = K_H\,((z + a)_+^{3/2} - z_+^{3/2} - \frac32 z_+^{1/2} a)$. This is convex in a; for
$|a| \le \alpha$ it lies between 0 and

$$ b(z, \alpha) = K_H \begin{cases} 0, & z \le -\alpha \\ \alpha^{3/2}, & |z| < \alpha \\
(z - \alpha)^{3/2} - z^{3/2} + \frac32 z^{1/2} \alpha, & z \ge \alpha, \end{cases} $$

and its slope is at most $b' = \frac32 K_H$ times 0, $\alpha^{1/2}$ and $z^{1/2} - (z - \alpha)^{1/2}$. Take all $d$ of period T with
$|d(t) - Pe_1(t)| \le \sigma$ at all times; there $\alpha_j = |n_j \cdot Pe_1| + \sigma$. If

$$ h(\sigma) = \max_t \int_0^T \sum_j |P\,G(t, s) P^T n_j(s)|\; b(z_j(s), \alpha_j(s))\,ds \;\le\; \sigma, $$

and the same integral of $b'$ is below one (`contraction`), then $d \mapsto P e_1 - P L^{-1} P^T N(d)$ maps this set into itself and
contracts it. By Banach's theorem it leaves exactly one of these $d$ unchanged, which gives a solution of Eq. 7. Its displacements
are within $\max |e_1|$ plus the `remainder` of those of $q$; the remainder is the largest $h$ with the row of a displacement in
place of the first $P$. The radius $\sigma$ is found by iterating $h$ from $h(0)$.

Displacements of the table are over the largest one of the motion; -1 stands where the argument does not close. Where it does, the
remainder is far smaller than $e_1$, and the bound is little above the truth (`excess`). From the second row to the third, m reaches a
multiple of the number of balls that pass in a turn, and the argument begins to close. Before, no radius that was tried, up to twice
the largest $|Pe_1|$, is enough: the vibration of the contact is little damped, and the integral of $|G|$ large. But the last
solution bounds the others too, by its distance from them (`by_last`), even the one with the paper's number of harmonics. The
printed estimate is the truth at fewer instants, which miss narrow peaks.

What is not rigorous: the arithmetic is floating-point, without intervals. $\Phi$ and $e_1$ come from Runge-Kutta steps; between
them $e_1$ is bounded by its second derivative, sampled. The integral takes the largest $b$ in each interval between instants, but
$G$ in the middle of cells of s; the maximum is over some t. The last columns show what half of each grid changes. With many
harmonics the intervals, not the touching balls, decide the remainder: it is then too large, and still does not matter.

Usage: studies/bound.py data/scenes/bound.toml > bound.tsv   (from the project's root; less than a minute)
"""
import sys
import tomllib
from pathlib import Path

import numpy as np

sys.path.insert(1, str(Path(__file__).parents[1] / "figures"))
from rotor_stator import run  # noqa: E402
from tables import print_columns, print_header  # noqa: E402

NAMES = ("x_s", "y_s", "x_r", "y_r")
RELATIVE = np.hstack([-np.eye(2), np.eye(2)])  # P: u = P q; the bearing's force F on the stator is -P' F on both bodies
COLUMNS = [
    ("m", "-", "harmonics"),
    ("residual", "-", "largest residual of Eq. 7 over the largest force"),
    ("first_order", "-", "largest displacement of e1"),
    ("remainder", "-", "bound of those of e - e1; -1: not closed"),
    ("bound", "-", "of the largest error; -1: not closed"),
    ("truth", "-", "largest error, against shooting"),
    ("estimate", "-", "the same as explore prints it"),
    ("excess", "-", "bound over truth, less 1; -1: not closed"),
    ("by_last", "-", "bound by way of the last row"),
    ("contraction", "-", "Lipschitz constant; -1: not closed"),
    ("halved", "-", "change of the bound with half of each grid, relative; -1: not closed"),
    ("halved_remainder", "-", "that of the remainder")]


class Machine:
    """Eq. 7 in the rotor's angle phi = omega t: mass q'' + damping q' + stiffness q + P' F(P q, phi) = load(phi)."""

    def __init__(self, file, frequency):
        table = tomllib.loads(Path(file).read_text(encoding="utf-8"))
        bodies, bearing = [table[name] for name in ("stator", "rotor")], table["bearing"]
        mass, natural, ratio = (np.repeat([body[key] for body in bodies], 2)
                                for key in ("mass_kg", "natural_frequency_rad_per_s", "damping_ratio"))
        omega = 2 * np.pi * frequency
        self.mass, self.damping, self.stiffness = omega**2 * mass, omega * 2 * ratio * mass * natural, mass * natural**2
        self.weight = -mass * table["gravity"]["acceleration_m_per_s2"] * [0, 1, 0, 1]
        self.unbalance = omega**2 * bodies[1]["unbalance_kg_m"]
        self.hertz, self.clearance = bearing["contact_stiffness_N_per_m1p5"], bearing["radial_clearance_m"]
        self.balls, self.cage = bearing["balls"], bearing["cage_speed_ratio"]

    def load(self, phi):
        zero = np.zeros_like(phi)
        return self.weight + self.unbalance * np.column_stack([zero, zero, np.cos(phi), np.sin(phi)])

    def directions(self, phi):
        """Of the balls (Eq. 3): phi x balls x 2."""
        angles = self.cage * phi[:, None] + 2 * np.pi * np.arange(self.balls) / self.balls
        return np.stack([np.cos(angles), np.sin(angles)], axis=-1)


class Solution:
    """The trigonometric polynomial q of m harmonics through the columns of an orbit, at `instants` of a period and at its end: its
    residual, and the penetration of each ball."""

    def __init__(self, machine, orbit, m, instants):
        columns = np.column_stack([orbit[name] for name in NAMES])
        series = np.fft.rfft(columns, axis=0)[:m + 1] / len(columns)
        self.machine, self.phi = machine, 2 * np.pi * np.arange(instants + 1) / instants
        order = 1j * np.arange(m + 1)[:, None]
        self.q, rate, acceleration = (self._sampled(order**power * series) for power in range(3))
        self.directions = machine.directions(self.phi)
        self.penetration = np.einsum("tjx,tx->tj", self.directions, self.q @ RELATIVE.T) - machine.clearance  # Eq. 4
        self.forces = machine.hertz * np.maximum(self.penetration, 0)**1.5  # Eq. 5
        self.bearing = np.einsum("tj,tjx->tx", self.forces, self.directions)  # Eq. 6
        self.residual = (machine.mass * acceleration + machine.damping * rate + machine.stiffness * self.q
                         + self.bearing @ RELATIVE - machine.load(self.phi))

    def _sampled(self, series):
        values = np.fft.irfft(series, len(self.phi) - 1, axis=0) * (len(self.phi) - 1)
        return np.vstack([values, values[:1]])


class Linearisation:
    """L e = mass e'' + damping e' + (stiffness + P' F' P) e along a solution, in steps of two of its instants. At their ends: the
    fundamental matrix `flow`, and `first`, the periodic e1 with L e1 = -residual; `between` is by how much an e1 between two of
    them may be larger than at both, by its second derivative."""

    def __init__(self, solution):
        machine, phi = solution.machine, solution.phi
        slopes = 1.5 * machine.hertz * np.maximum(solution.penetration, 0)**0.5
        contact = np.einsum("tj,tjx,tjy->txy", slopes, solution.directions, solution.directions)
        a = np.zeros((len(phi), 9, 9))  # the rate of displacements, their rates and 1
        a[:, :4, 4:8] = np.eye(4)
        a[:, 4:8, :4] = -(np.diag(machine.stiffness) + RELATIVE.T @ contact @ RELATIVE) / machine.mass[:, None]
        a[:, 4:8, 4:8] = -np.diag(machine.damping / machine.mass)
        a[:, 4:8, 8] = -solution.residual / machine.mass
        step, unit = 2 * phi[1], np.eye(9)
        start, middle, end = a[:-1:2], a[1::2], a[2::2]  # Runge-Kutta of order four
        second = middle @ (unit + step / 2 * start)
        third = middle @ (unit + step / 2 * second)
        steps = unit + step / 6 * (start + 2 * second + 2 * third + end @ (unit + step * third))
        flow = np.empty((len(steps) + 1, 9, 9))
        flow[0] = unit
        for k, one in enumerate(steps):
            np.matmul(one, flow[k], out=flow[k + 1])
        self.flow, self.mass, self.steps = flow[:, :8, :8], machine.mass, len(steps)
        self.closing = np.linalg.inv(np.eye(8) - self.flow[-1])  # (I - Phi(T))^-1
        state = self.flow @ (self.closing @ flow[-1, :8, 8]) + flow[:, :8, 8]
        self.first = state[:, :4]
        self.between = step**2 / 8 * np.abs(np.einsum("tpq,tq->tp", a[::2, 4:8, :8], state) + a[::2, 4:8, 8]).max()

    def green(self, out, t, s, impulses):
        """out G(t, s) impulse, of impulses on the displacements at the steps s: rows of out x t x s."""
        excited = np.linalg.solve(self.flow[s], np.hstack([0 * impulses, impulses / self.mass])[..., None])[..., 0]
        after = np.einsum("oq,tqk->otk", out, self.flow[t][:, :4]) @ self.closing
        return np.where(s < t[:, None], after @ excited.T, after @ self.flow[-1] @ excited.T)


class Bound:
    """The argument for one solution: `first`, largest |e1|, and where it `closes` the `remainder`, the `bound` and `lipschitz`."""

    def __init__(self, solution, cells, times):
        self.solution, self.cells = solution, cells
        line = Linearisation(solution)
        self.first = np.abs(line.first).max() + line.between
        u = np.zeros((len(solution.phi), 2))  # of e1
        u[::2] = line.first @ RELATIVE.T
        u[1::2] = (u[:-1:2] + u[2::2]) / 2
        change = np.abs(np.einsum("tjx,tx->tj", solution.directions, u)) + 3 * line.between
        self.change = np.maximum(change[1:], change[:-1])
        slack = np.abs(np.diff(solution.penetration, 2, axis=0)).max(initial=0) / 8
        self.lowest = np.minimum(solution.penetration[1:], solution.penetration[:-1]) - slack
        self.highest = np.maximum(solution.penetration[1:], solution.penetration[:-1]) + slack
        most = 2 * np.linalg.norm(u, axis=1).max()  # where the radius is given up
        self.loaded = (self.highest.reshape(cells, -1, solution.machine.balls).max(axis=1) > -self.change.max() - 2 * most)
        cell, ball = np.nonzero(self.loaded)
        s = (2 * cell + 1) * (line.steps // cells) // 2
        impulses = solution.directions[2 * s, ball] @ RELATIVE
        t = np.arange(times) * (line.steps // times)
        kernel = np.hypot(*line.green(RELATIVE, t, s, impulses))

        def h(radius):
            return (kernel @ self.weights(radius)).max()

        radius = 1.01 * h(0)
        while radius < most and h(radius) > radius:
            radius = 1.01 * h(radius)
        self.lipschitz = (kernel @ self.weights(radius, 1)).max()
        self.closes = bool(radius < most and self.lipschitz < 1)
        weights = self.weights(radius)
        self.remainder = max((np.abs(row) @ weights).max() for row in line.green(np.eye(4), t, s, impulses))
        self.bound = self.first + self.remainder

    def weights(self, radius, derivative=0):
        """K_H b, or K_H b', integrated over each cell for each of its loaded balls."""
        values = largest(self.lowest, self.highest, self.change + radius, derivative)
        integrals = values.reshape(self.cells, -1, values.shape[1]).sum(axis=1) * self.solution.phi[1]
        return self.solution.machine.hertz * integrals[self.loaded]


def largest(lowest, highest, change, derivative=0):
    """The largest b(z, change), or b', over K_H, of the penetrations z from lowest to highest."""
    z = np.maximum(lowest, change)
    if derivative:
        near, far = 1.5 * change**0.5, 1.5 * (z**0.5 - (z - change)**0.5)
    else:
        near, far = change**1.5, (z - change)**1.5 - z**1.5 + 1.5 * z**0.5 * change
    return np.where(lowest >= change, far, np.where(highest <= -change, 0, near))


def orbit(scene, **how):
    return run("orbit", f"data/{scene['parameters']}.toml", frequency=scene["frequency_hz"], points=scene["points"], budget=1e12, **how)


def row_of(scene, machine, m, solution, truth, last):
    """The argument, and its row; `last` is that of the last row."""
    grids = [[scene[name] // parts for name in ("instants", "cells", "times")] for parts in (1, 2)]
    whole, half = (Bound(Solution(machine, solution, m, instants), cells, times) for instants, cells, times in grids)
    at = whole.solution
    size, error = np.abs(at.q).max(), max(np.abs(solution[name] - truth[name]).max() for name in NAMES)
    closed = [whole.remainder / size, whole.bound / size] if whole.closes else [-1, -1]
    by_last = whole.bound
    if last:  # a polynomial of m harmonics is nowhere larger than at n instants, over cos(pi m/n)
        by_last = np.abs(at.q - last.solution.q).max() / np.cos(np.pi * max(scene["harmonics"]) / scene["instants"]) + last.bound
    halved = [-1, -1]
    if whole.closes and half.closes:
        halved = [abs(half.bound / whole.bound - 1), abs(half.remainder / whole.remainder - 1)]
    return whole, [m, np.abs(at.residual).max() / np.linalg.norm(at.bearing, axis=1).max(), whole.first / size, *closed, error / size,
                   solution.value("distance_largest"), whole.bound / error - 1 if whole.closes else -1, by_last / size,
                   whole.lipschitz if whole.closes else -1, *halved]


def main(file):
    scene = tomllib.loads(Path(file).read_text(encoding="utf-8"))
    machine = Machine(f"data/{scene['parameters']}.toml", scene["frequency_hz"])
    truth = orbit(scene, method="shooting", local_error=scene["local_error"])
    solutions = {m: orbit(scene, harmonics=m) for m in scene["harmonics"]}
    rows, last = [], None
    for m, solution in reversed(solutions.items()):
        whole, row = row_of(scene, machine, m, solution, truth, last)
        if not last and not whole.closes:
            sys.exit(f"the argument does not close with {m} harmonics")
        last = last or whole
        rows.insert(0, row)
    print_header(scene["title"], [truth], "displacements are over the largest one of the motion",
                 frequency=scene["frequency_hz"], truth_error=truth.value("error_largest"), instants=scene["instants"],
                 cells=scene["cells"], times=scene["times"])
    print_columns(COLUMNS)
    for row in rows:
        print("\t".join(f"{cell:.6g}" for cell in row))


if __name__ == "__main__":
    main(*sys.argv[1:])
