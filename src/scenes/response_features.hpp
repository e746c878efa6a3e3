/**
# Features of a response: a peak, the loss of contact, the size of an orbit

What a whole response curve is reduced to when many machines are compared. Each feature is
found by the method that is asked for and nothing else is kept. */
#pragma once

#include <optional>

#include "scenes/motion.hpp"

namespace rotor_stator
{

/** A machine and how it is computed. */
struct Model {
  Parameters parameters;
  int harmonics;                    ///< m
  int samples;                      ///< N
  SteadySettings time_integration;  ///< with RK4's step
};

/** A number, and how far off it may be: half the distance of two speeds, or the standard
   error of a mean. */
struct Measured {
  double value;
  double uncertainty = 0;
};
using MaybeMeasured = std::optional<Measured>;

/** The largest amplitude of x_r [m] and its speed [Hz]. */
struct Peak {
  double frequency, amplitude;
};

/** By harmonic balance swept up over `frequencies` [Hz], equally spaced; then on a finer
   grid about the largest, whose vertex is that of a parabola. Throws NoSolution when the
   largest is at an end. */
Peak balance_peak(const Model& model, const std::vector<double>& frequencies);

/** The same by time integration from rest at each speed. */
Peak integrated_peak(const Model& model, const std::vector<double>& frequencies);

/** The first and the last speed [Hz] at which the bearing is unloaded for some time. */
struct ContactLoss {
  Measured first, last;
};

/** By time integration from rest at each of `frequencies` [Hz], then by bisection between
   neighbours with and without loss. Near both ends loss comes and goes within hundredths
   of a hertz (set 1: at 12.05 Hz, not at 12.1 to 12.2), so that windows between two
   neighbours can be missed; half the neighbours' distance is the uncertainty. Empty when
   contact is permanent at all of them. */
std::optional<ContactLoss> contact_loss(const Model& model,
                                        const std::vector<double>& frequencies);

/** Half peak-to-peak of x_r and y_r [m]. */
struct OrbitSize {
  Measured x, y;
};

/** Of the m-harmonic solution; empty where there is none, also when the cage has not the
   period of rotation (D-11). */
std::optional<OrbitSize> balance_orbit_size(const Model& model, double frequency);

/** Of the integrated motion: the mean over its periods, of each period's half
   peak-to-peak; the standard error is that of ten blocks of consecutive periods. */
OrbitSize orbit_size(const Motion& motion);

/** The motion that time integration settles on from rest at a speed [Hz]. */
SteadyState steady_state_at(const Model& model, double frequency);

}  // namespace rotor_stator
