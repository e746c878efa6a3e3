/**
# GSL's ODE steppers

Adaptive explicit Runge-Kutta (rkf45, rkck, rk8pd), variable-order multistep (msadams,
msbdf) and the implicit Bulirsch-Stoer method (bsimp); the last two use the analytic
Jacobian of Eq. 7. The step size keeps the local error of each component below the
tolerance times its size: the bearing's length scale for displacements, that length times
the contact mode's frequency for speeds. */
#pragma once

#include <gsl/gsl_odeiv2.h>

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

  /** A jump to another interval than the next one forgets the history of multistep methods; the step
      size is kept. */
  void advance(long interval, State& state);
  long evaluations() const;

private:
  struct Driver;
  std::unique_ptr<Driver> driver_;
  double interval_length_;  ///< T/P [s]
  long next_ = 0;           ///< the interval that would continue the motion
};

const std::vector<std::string>& gsl_methods();

/** GSL's own type of a method of the list above. */
const gsl_odeiv2_step_type* gsl_step_type(const std::string& method);

/** GSL calls abort() on errors unless told otherwise; whoever calls this checks every return value.
 */
void keep_gsl_from_aborting();

}  // namespace rotor_stator
