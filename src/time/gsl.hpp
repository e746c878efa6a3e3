/**
# GSL's ODE steppers

These serve for comparison with ours: adaptive explicit Runge-Kutta (rkf45, rkck, rk8pd),
variable-order multistep (msadams, msbdf) and the implicit Bulirsch-Stoer method (bsimp).
The last two use the analytic Jacobian of Eq. 7. The step size keeps the local error of
each component below the tolerance times its size.

Nothing else in the library needs GSL's steppers. */
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "time/flow.hpp"

namespace rotor_stator {

std::vector<std::string> gsl_methods();

/** By one of these methods. */
std::unique_ptr<Flow> gsl_flow(const Parameters& parameters, double omega,
                               const StepSettings& settings);

/** ∂(Eq. 7)/∂y, 8 × 8 by rows, and ∂(Eq. 7)/∂t at y = (x_s, y_s, x_r, y_r, and their
    speeds): what the implicit methods ask for. */
void equation_7_slopes(const Parameters& parameters, const RotorStator& system, double t,
                       const double y[], double* dfdy, double* dfdt);

}  // namespace rotor_stator
