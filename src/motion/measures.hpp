/**
# Measures of a vibration

What standards and analysers ask of one displacement q, sampled at evenly spaced instants:
half of its largest less its smallest value; the rms of its velocity and acceleration
about their means, by central differences of order four (20 samples in a period: 0.03 %
and 0.01 % low); and its part at the speed of rotation, q ≈ A cos(ωt - ψ), by a sum over whole
turns. ISO 20816 bounds the rms velocity of bearing housings, in mm/s.

    const Measures m = measures(samples, dt, 0, omega * dt, true); */
#pragma once

#include <Eigen/Core>

namespace rotor_stator::motion {

struct Measures {
  double amplitude;         ///< [m]
  double velocity_rms;      ///< [m/s]
  double acceleration_rms;  ///< [m/s²]
  double first, lag;        ///< A [m] and ψ [rad] in (-π, π]
};

/** dq/dt of samples `dt` apart: of a closed motion at every one of them, else at all but
    the two at either end. */
Eigen::VectorXd velocity_of(const Eigen::VectorXd& q, double dt, bool is_closed);

/** `rotor`: its angle ωt at the first sample, `turning` from one to the next [rad]. */
Measures measures(const Eigen::VectorXd& q, double dt, double rotor, double turning,
                  bool is_closed);

}  // namespace rotor_stator::motion
