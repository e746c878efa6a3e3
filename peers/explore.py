"""Orbits and branches from the project's own explore, and the tables it writes."""

import resource
import subprocess
import sys

import numpy as np
from equation7 import ROOT

sys.path.insert(1, str(ROOT / "figures"))
from tables import Table  # noqa: E402


class Failed(SystemExit):
    """Ends the program with explore's status unless it is caught; explore has said why."""


def child_seconds():
    """CPU seconds of all programs that were run and have ended."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def provenance(table):
    """The header's lines from the source to the parameters."""
    return [line for line in table.header.split("\n")
            if line.startswith(("# source", "# compiler", "# schema", "# parameters", "#   "))]


def explore(command, parameter_file, may_stop=False, **options):
    """The table of `explore orbit` or `explore response`; with `may_stop` also of a branch that did
    not reach its end, and whether it did not."""
    words = [str(ROOT / "build/explore"), command, parameter_file]
    for name, value in options.items():
        words += ["--" + name.replace("_", "-"), str(value)]
    done = subprocess.run(words, cwd=ROOT, stdout=subprocess.PIPE, text=True, check=False)
    if may_stop and done.stdout:
        return Table.of(done.stdout), done.returncode != 0
    if done.returncode:
        raise Failed(done.returncode)
    return Table.of(done.stdout)


def orbit(parameter_file, frequency, harmonics, points):
    """One period by harmonic balance."""
    return explore("orbit", parameter_file, frequency=frequency, harmonics=harmonics,
                   points=points, newton_tolerance=1e-12)


def displacements(table):
    """x_s, y_s, x_r, y_r by columns."""
    return np.column_stack([table[name] for name in ("x_s", "y_s", "x_r", "y_r")])


def slopes(samples):
    """Derivative of one period of samples with respect to the phase, by its Fourier series."""
    count = len(samples)
    harmonics = np.fft.rfftfreq(count, 1 / count)
    if count % 2 == 0:
        harmonics[-1] = 0
    spectrum = 1j * harmonics[:, None] * np.fft.rfft(samples, axis=0)
    return np.fft.irfft(spectrum, count, axis=0)
