/**
# The period map and its derivative

The period map P takes a state over one period T = 2π/ω of Eq. 7. Its derivative Φ solves
the variational equations

$$\dot{\delta q} = \delta v,
\qquad M\, \dot{\delta v} = -(K + k(t))\,\delta q - C\,\delta v,$$

where k(t) is the bearing's stiffness on the motion itself. Both are integrated together,
72 equations, by rk4 or rk8; the step is chosen by the state alone, which is what the
answer depends on.

    const PeriodMap map = period_map(parameters, omega, state,
                                     {.intervals_per_period = 1, .tolerance = 1e-12}); */
#pragma once

#include <Eigen/Core>

#include "time/flow.hpp"

namespace rotor_stator {

struct PeriodMap {
  State end;
  Eigen::MatrixXd derivative;  ///< Φ
  long evaluations;            ///< of the bearing's force and stiffness
};

/** Over one interval of those into which `settings` cut a base period, counted from t =
    0; for no more than the state, `with_derivative` is false. Throws NoSolution when the
    integration breaks down or the budget is used up. */
PeriodMap period_map(const Parameters& parameters, double omega, const State& start,
                     const StepSettings& settings, long interval = 0,
                     bool with_derivative = true);

/**
## The variational equations of Eq. 7

Eight small disturbances of the state at once. Displacement (or speed) i of disturbance j
is in row j and column i, so that the eight of one displacement lie side by side in
memory, where the compiler's vectors share them. */

using Disturbances = Eigen::Matrix<double, 8, 4>;

class DisturbanceRates {
public:
  explicit DisturbanceRates(const Parameters& p)
      : bodies_{of(p.stator), of(p.rotor)}, is_damped_(p.bearing.is_damped())
  {
  }

  /** Accelerations of the disturbances `q` and their speeds `v`, with the bearing's
      reaction at that instant of the motion. */
  template <class Q, class V>
  Disturbances acceleration(const BearingReaction& bearing, const Q& q, const V& v) const
  {
    using Eight = Eigen::Matrix<double, 8, 1>;
    const Eight u_x = q.col(2) - q.col(0), u_y = q.col(3) - q.col(1);
    const Slopes2& s = bearing.stiffness;
    Eight force[2] = {s.xx * u_x + s.xy * u_y, s.yx * u_x + s.yy * u_y};
    if (is_damped_) {
      const Eight w_x = v.col(2) - v.col(0), w_y = v.col(3) - v.col(1);
      const Slopes2& d = bearing.damping;
      force[0] += d.xx * w_x + d.xy * w_y;
      force[1] += d.yx * w_x + d.yy * w_y;
    }
    Disturbances a;
    for (int i = 0; i < 4; ++i) {
      const Rates& body = bodies_[i / 2];
      const double per_mass = i < 2 ? body.per_mass : -body.per_mass;
      a.col(i) =
          per_mass * force[i % 2] - body.damping * v.col(i) - body.stiffness * q.col(i);
    }
    return a;
  }

private:
  struct Rates {
    double per_mass, damping, stiffness;  ///< 1/m, c/m, k/m
  };
  static Rates of(const Body& b)
  {
    return {1 / b.mass, b.damping() / b.mass, b.stiffness() / b.mass};
  }

  Rates bodies_[2];
  bool is_damped_;
};

}  // namespace rotor_stator
