"""Checks before anything is timed: what is supplied to the integrators, and the integrators.

Usage: /usr/bin/python3 peers/check.py data/scenes/peers.toml
"""

import sys
import tomllib

import numpy as np
from equation7 import ROOT, SIZE, Case
from integrators import METHODS, integrate


def jacobian_error(case, t, y):
    """Largest difference of the analytic Jacobian to central differences, by rows."""
    steps, numeric = 1e-6 * case.sizes(), np.empty((SIZE, SIZE))
    for k, step in enumerate(steps):
        off = step * np.eye(SIZE)[k]
        numeric[:, k] = (case.derivative(t, y + off) - case.derivative(t, y - off)) / (2 * step)
    rows = np.abs(numeric).max(axis=1)
    return (np.abs(case.jacobian(t, y) - numeric).max(axis=1) / rows).max()


def main(scene_file):
    scene = tomllib.loads((ROOT / scene_file).read_text(encoding="utf-8"))
    for entry in scene["cases"]:
        case = Case(entry["parameters"], entry["frequency_hz"])
        period, start = 1 / case.frequency, case.static_start()
        times = period * np.arange(1, 9) / 8
        states = {method: integrate(case, method, 1e-9, start, times)[0] for method in METHODS}
        worst = max(jacobian_error(case, t, y) for t, y in zip(times, states["cvode-adams"]))
        if not worst < 1e-6:
            sys.exit(f"{entry}: the Jacobian is off by {worst:.2g}")
        truth = states["scipy-dop853"][:, :4]
        for method, found in states.items():
            off = np.abs(found[:, :4] - truth).max() / np.abs(truth).max()
            if not off < 1e-5:
                sys.exit(f"{entry}: {method} is off by {off:.2g} after one period")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(f"usage: {sys.argv[0]} SCENE.toml")
    main(sys.argv[1])
