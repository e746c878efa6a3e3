/**
# The variational equations of Eq. 7

Eight small disturbances of the state at once. Displacement (or speed) i of disturbance j
is in row j and column i, so that the eight of one displacement lie side by side in
memory, where the compiler's vectors share them. */
#pragma once

#include <Eigen/Core>
#include <array>

#include "model/rotor_stator.hpp"

namespace rotor_stator
{

using Disturbances = Eigen::Matrix<double, 8, 4>;

class DisturbanceRates
{
public:
  explicit DisturbanceRates(const Parameters& parameters)
  {
    int k = 0;
    for (const Body* body : {&parameters.stator, &parameters.rotor}) {
      per_mass_[k] = 1 / body->mass;
      damping_[k] = body->damping() / body->mass;
      stiffness_[k] = body->stiffness() / body->mass;
      ++k;
    }
  }

  /** Accelerations of the disturbances `q` and their speeds `v`, with the bearing's stiffness `s`
      [N/m] at that instant of the motion. */
  template <class Q, class V>
  Disturbances acceleration(const Stiffness2& s, const Q& q, const V& v) const
  {
    using Eight = Eigen::Matrix<double, 8, 1>;
    const Eight u_x = q.col(2) - q.col(0), u_y = q.col(3) - q.col(1);
    const Eight force[2] = {s.xx * u_x + s.xy * u_y, s.xy * u_x + s.yy * u_y};
    Disturbances a;
    for (int i = 0; i < 4; ++i) {
      const int body = i / 2;
      const double per_mass = body == 0 ? per_mass_[0] : -per_mass_[1];
      a.col(i) = per_mass * force[i % 2] - damping_[body] * v.col(i) -
                 stiffness_[body] * q.col(i);
    }
    return a;
  }

private:
  std::array<double, 2> per_mass_, damping_,
      stiffness_;  ///< 1/m, c/m, k/m of both bodies
};

}  // namespace rotor_stator
