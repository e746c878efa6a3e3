/**
# Features of a response: a peak, the loss of contact, the size of an orbit

What a whole response curve is reduced to when many machines are compared. Each feature is
found by the method that is asked for and nothing else is kept. */
#pragma once

#include <optional>

#include "continuation/sweep.hpp"
#include "motion/motion.hpp"
#include "stability/lyapunov.hpp"

namespace rotor_stator::studies {

/** A machine and how it is computed. */
struct Model {
  Parameters machine;
  int harmonics;                    ///< m
  int samples;                      ///< N
  SteadySettings time_integration;  ///< with RK4's step
};

/** A number, and how far off it may be: half the distance of two speeds, or the standard
   error of a mean. */
using Measured = BatchMean;

/** The largest amplitude of x_r by harmonic balance swept up over `frequencies` [Hz], equally
   spaced; then on a finer grid about it, whose vertex is that of a parabola. Throws NoSolution
   when the largest is at an end. */
CurvePoint balance_peak(const Model& model, const std::vector<double>& frequencies);

/** The same by time integration from rest at each speed. */
CurvePoint integrated_peak(const Model& model, const std::vector<double>& frequencies);

/** The first and the last speed [Hz] at which the bearing is unloaded for some time. */
struct ContactLoss {
  Measured first, last;
};

/** By time integration from rest at each of `frequencies` [Hz], from both ends until contact is lost,
   then by bisection between neighbours with and without loss. Near both ends loss comes and goes
   within hundredths of a hertz (set 1: at 12.05 Hz, not at 12.1 to 12.2), so that windows between
   two neighbours can be missed; half the neighbours' distance is the uncertainty. Empty when
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
OrbitSize orbit_size(const motion::Motion& motion);

/** What time integration settles on from rest at a speed [Hz], with as many periods as the model shows,
    or so many; and its motion. */
SteadyState settled(Model model, double frequency, int shown_periods = 0);
motion::Motion motion_of(const Model& model, const SteadyState& steady);

}  // namespace rotor_stator::studies
