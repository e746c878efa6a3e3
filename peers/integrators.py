"""The outside integrators behind one call: SUNDIALS CVODE and SciPy.

integrate(case, method, tolerance, start, times, begin=0) gives the states at the times,
n x 8, and after each time the numbers of evaluations of Eq. 7, of Jacobians and of steps so
far, n x 3. The
tolerance is relative, and absolute in each component times that component's size. Output times
shorten no step, except Radau's, whose interpolant is of a lower order than its steps.
"""

from ctypes import c_long

import numpy as np
from equation7 import LIBRARY, SIZE, pointer
from scipy.integrate import DOP853, Radau, odeint


class Broken(Exception):
    """An integration that its method gave up."""


def cvode(case, bdf_order, tolerance, start, times, begin=0):
    states, counts = np.empty((len(times), SIZE)), np.empty((len(times), 3), dtype=np.int64)
    flag = LIBRARY.cvode_integrate(case.handle, bdf_order, tolerance, begin, pointer(start),
                                   len(times), pointer(times), pointer(states),
                                   pointer(counts, c_long))
    if flag < 0:
        raise Broken(f"CVODE's flag {flag}")
    return states, counts


def step_to(solver, time):
    """Whole steps until a time is passed; returns their number."""
    steps = 0
    while solver.t < time:
        solver.step()
        steps += 1
        if solver.status == "failed":
            raise Broken(f"step size at t = {solver.t:g} s")
    return steps


def dop853(case, tolerance, start, times, begin=0):
    solver = DOP853(case.derivative, begin, start, times[-1] + 1 / case.frequency,
                    rtol=tolerance, atol=tolerance * case.sizes())
    states, counts = [], []
    total, interpolant = np.zeros(3, dtype=np.int64), None
    case.counts()
    for time in times:
        steps = step_to(solver, time)
        if steps or interpolant is None:
            interpolant = solver.dense_output()
        total += *case.counts(), steps
        states.append(interpolant(time))
        counts.append(total.copy())
    return np.array(states), np.array(counts)


def radau(case, tolerance, start, times, begin=0):
    solver = Radau(case.derivative, begin, start, times[0], jac=case.jacobian,
                   rtol=tolerance, atol=tolerance * case.sizes())
    states, counts, total = [], [], np.zeros(3, dtype=np.int64)
    case.counts()
    for time in times:
        # SciPy has no way to move the end of a solver; the step size goes on from where it was.
        solver.t_bound, solver.status = time, "running"
        steps = step_to(solver, time)
        total += *case.counts(), steps
        states.append(solver.y.copy())
        counts.append(total.copy())
    return np.array(states), np.array(counts)


def lsoda(case, tolerance, start, times, begin=0):
    """ODEPACK's LSODA by odeint, whose loop over the steps is compiled."""
    states, info = odeint(case.derivative, start, np.concatenate([[begin], times]),
                          tfirst=True, Dfun=case.jacobian, rtol=tolerance, atol=tolerance * case.sizes(),
                          mxstep=10**8, full_output=True)
    if info["message"] != "Integration successful.":
        raise Broken(info["message"])
    return states[1:], np.column_stack([info["nfe"], info["nje"], info["nst"]])


def integrate(case, method, tolerance, start, times, begin=0):
    return METHODS[method](case, tolerance, start, times, begin)


METHODS = {
    "cvode-adams": lambda case, *rest: cvode(case, 0, *rest),
    "cvode-bdf": lambda case, *rest: cvode(case, 5, *rest),
    "cvode-bdf2": lambda case, *rest: cvode(case, 2, *rest),
    "scipy-dop853": dop853,
    "scipy-lsoda": lsoda,
    "scipy-radau": radau,
}
