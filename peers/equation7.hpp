/**
# Equation 7 for outside integrators

First-order form, y = (x_s, y_s, x_r, y_r, and their speeds), on the model's own
`RotorStator::acceleration` and `BallBearing::reaction`, so that every integrator pays the
same for a force. The C functions below are what SciPy calls through ctypes. */
#pragma once

#include "model/rotor_stator.hpp"

namespace rotor_stator {

/** One machine at one speed, with the counts of what was asked of it. */
struct CountedEquation7 {
  static constexpr int size = 8;

  Parameters parameters;
  RotorStator system;
  long evaluations = 0;  ///< of Eq. 7
  long jacobians = 0;

  CountedEquation7(const Parameters& p, double omega) : parameters(p), system(p, omega) {}

  Angles angles(double t) const { return system.bearing().angles(system.omega() * t); }

  /** dy/dt [m/s, m/s²] at the time t [s]. */
  void derivative(double t, const double* y, double* dydt);

  /** ∂(dy/dt)/∂y, 8 × 8 by columns. */
  void jacobian(double t, const double* y, double* dfdy);

  /** What a tolerance of 1 means for each component: the bearing's length [m], and that length
      times the contact mode's frequency [m/s]. */
  void sizes(double* y) const;
};

}  // namespace rotor_stator

extern "C" {

using rotor_stator::CountedEquation7;

/** Null after a line on stderr when the file cannot be read; `frequency` in Hz. */
CountedEquation7* equation7_open(const char* parameter_file, double frequency);
void equation7_close(CountedEquation7* equation);

void equation7_derivative(CountedEquation7* equation, double t, const double* y,
                          double* dydt);
void equation7_jacobian(CountedEquation7* equation, double t, const double* y,
                        double* dfdy);
void equation7_sizes(const CountedEquation7* equation, double* y);
void equation7_static_start(const CountedEquation7* equation, double* y);

/** Eq. 6 [N] for `n` states by rows at the times t [s]; `forces` is n × 2. */
void equation7_forces(const CountedEquation7* equation, int n, const double* t,
                      const double* y, double* forces);

/** Evaluates `n` states by rows `rounds` times, to time an evaluation. */
void equation7_derivatives(CountedEquation7* equation, int rounds, int n, const double* t,
                           const double* y);

/** Evaluations and Jacobians since the last call. */
void equation7_counts(CountedEquation7* equation, long* counts);

/** CVODE from y at the time `begin` through the increasing `times` [s]: the states there,
    n × 8 by rows, and after each the numbers of evaluations, Jacobians and steps so far,
    n × 3. `bdf_order` is the highest order of BDF with Newton and the analytic Jacobian; 0
    chooses Adams with fixed-point iteration. Returns CVODE's flag. */
int cvode_integrate(CountedEquation7* equation, int bdf_order, double tolerance,
                    double begin, const double* start, int n, const double* times,
                    double* states, long* counts);

/** Frequency [Hz] of the base period, and whether two frequencies drive. */
double equation7_base(const CountedEquation7* equation, int* is_driven_twice);

/** A stepper of this project, alone: "rk4" with the longest step `accuracy` [s], or "rk8"
    with that local error. From the state at the start of interval `first`, `intervals` in a
    base period, over `n` of them: the states at their ends, n × 8 by rows. Returns the
    number of evaluations, -1 after a line on stderr. */
long equation7_flow(const CountedEquation7* equation, const char* method, double accuracy,
                    int intervals, long first, const double* start, int n,
                    double* states);
}
