"""Equation 7 at one speed, from the C++ library, for Python: cases, starts and forces.

The library is build/peers/libequation7.so (peers/equation7.hpp says what each function does).
"""

import ctypes
from ctypes import POINTER, c_char_p, c_double, c_int, c_long, c_void_p
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parents[1]
SIZE = 8


def load():
    """The library with the types of its functions."""
    library = ctypes.CDLL(str(ROOT / "build/peers/libequation7.so"))
    library.equation7_open.restype = c_void_p
    library.equation7_open.argtypes = [c_char_p, c_double]
    library.equation7_close.argtypes = [c_void_p]
    # Plain addresses: what an integrator calls often must not convert arrays each time.
    library.equation7_derivative.argtypes = [c_void_p, c_double, c_void_p, c_void_p]
    library.equation7_jacobian.argtypes = [c_void_p, c_double, c_void_p, c_void_p]
    library.equation7_sizes.argtypes = [c_void_p, POINTER(c_double)]
    library.equation7_static_start.argtypes = [c_void_p, POINTER(c_double)]
    library.equation7_forces.argtypes = [c_void_p, c_int] + 3 * [POINTER(c_double)]
    library.equation7_derivatives.argtypes = [c_void_p, c_int, c_int] + 2 * [POINTER(c_double)]
    library.equation7_counts.argtypes = [c_void_p, POINTER(c_long)]
    library.cvode_integrate.argtypes = [c_void_p, c_int] + 2 * [c_double] + [
        POINTER(c_double), c_int, POINTER(c_double), POINTER(c_double), POINTER(c_long)]
    library.equation7_base.restype = c_double
    library.equation7_base.argtypes = [c_void_p, POINTER(c_int)]
    library.equation7_flow.restype = c_long
    library.equation7_flow.argtypes = [c_void_p, c_char_p, c_double, c_int, c_long,
                                       POINTER(c_double), c_int, POINTER(c_double)]
    return library


LIBRARY = load()


def pointer(array, kind=c_double):
    """The address of a contiguous array's numbers."""
    return array.ctypes.data_as(POINTER(kind))


class Case:
    """One machine at one speed [Hz]."""

    def __init__(self, parameter_file, frequency):
        self.parameter_file, self.frequency = parameter_file, frequency
        self.handle = LIBRARY.equation7_open(str(ROOT / parameter_file).encode(), frequency)
        if not self.handle:
            raise SystemExit(2)
        self._in, self._out, self._slopes = np.empty(SIZE), np.empty(SIZE), np.empty(SIZE**2)
        self._addresses = [a.ctypes.data for a in (self._in, self._out, self._slopes)]

    def __del__(self):
        if self.handle:
            LIBRARY.equation7_close(self.handle)

    def derivative(self, t, y):
        """dy/dt, a new array."""
        self._in[:] = y
        LIBRARY.equation7_derivative(self.handle, t, self._addresses[0], self._addresses[1])
        return self._out.copy()

    def derivatives(self, times, states, rounds):
        """Evaluates all states `rounds` times, without Python in between; to time it."""
        LIBRARY.equation7_derivatives(self.handle, rounds, len(times), pointer(times),
                                      pointer(states))

    def jacobian(self, t, y):
        """d(dy/dt)/dy."""
        self._in[:] = y
        LIBRARY.equation7_jacobian(self.handle, t, self._addresses[0], self._addresses[2])
        return self._slopes.reshape(SIZE, SIZE).T

    def sizes(self):
        """What a tolerance of 1 means for each component."""
        sizes = np.empty(SIZE)
        LIBRARY.equation7_sizes(self.handle, pointer(sizes))
        return sizes

    def static_start(self):
        """At rest under the static load."""
        start = np.empty(SIZE)
        LIBRARY.equation7_static_start(self.handle, pointer(start))
        return start

    def forces(self, times, states):
        """Eq. 6 [N] at the states, n x 2."""
        forces = np.empty((len(times), 2))
        LIBRARY.equation7_forces(self.handle, len(times), pointer(times),
                                 pointer(np.ascontiguousarray(states)), pointer(forces))
        return forces

    def counts(self):
        """Evaluations and Jacobians since the last call."""
        counts = np.empty(2, dtype=np.int64)
        LIBRARY.equation7_counts(self.handle, pointer(counts, c_long))
        return counts

    def base(self):
        """Frequency [Hz] of the base period, and whether two frequencies drive."""
        twice = c_int()
        return LIBRARY.equation7_base(self.handle, ctypes.byref(twice)), bool(twice.value)

    def flow(self, method, accuracy, intervals, first, start, count):
        """States at the ends of `count` intervals of the base period by a stepper of this
        project, and the number of evaluations."""
        states = np.empty((count, SIZE))
        start = np.ascontiguousarray(start)
        done = LIBRARY.equation7_flow(self.handle, method.encode(), accuracy, intervals,
                                      first, pointer(start), count, pointer(states))
        if done < 0:
            raise SystemExit(1)
        return states, done
