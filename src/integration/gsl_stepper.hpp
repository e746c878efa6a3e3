/**
# GSL's ODE steppers

Adaptive explicit Runge-Kutta (rkf45, rkck, rk8pd), variable-order multistep (msadams,
msbdf) and the implicit Bulirsch-Stoer method (bsimp); the last two use the analytic
Jacobian of Eq. 7. The step size keeps the local error of each component below the
tolerance times its size: the bearing's length scale for displacements, that length times
the contact mode's frequency for speeds. */
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "integration/time_stepper.hpp"

namespace rotor_stator
{

class GslStepper
{
public:
  GslStepper(const Parameters& parameters, double omega, const StepperSettings& settings);
  ~GslStepper();

  void advance(long interval, State& state);
  long evaluations() const;

private:
  struct Driver;
  std::unique_ptr<Driver> driver_;
  double interval_length_;  ///< T/P [s]
};

const std::vector<std::string>& gsl_methods();

}  // namespace rotor_stator
