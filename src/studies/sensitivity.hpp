/**
# Features of a response: a peak, the loss of contact, the size of an orbit

What a whole response curve is reduced to when many machines are compared. Each feature is
found by the method that is asked for and nothing else is kept. */
#pragma once

#include <optional>

#include "io/scene.hpp"
#include "io/table.hpp"
#include "motion/motion.hpp"

namespace rotor_stator::studies
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
OrbitSize orbit_size(const motion::Motion& motion);

/** The motion that time integration settles on from rest at a speed [Hz]. */
SteadyState steady_state_at(const Model& model, double frequency);

/**
## Scene: sensitivity to what the paper leaves out

Masses, cage and the two discretisations are not printed. Each is varied alone about its
default: the total mass m_s + m_r at fixed ratio, the ratio m_r/m_s at fixed total, the
cage ratio c = ω_cage/ω, the samples N of the balance, the step h of RK4. What is printed
(natural frequencies, damping ratios, unbalance, bearing) stays.

Outputs are the peak of x_r, the speeds between which contact is lost and the size of the
orbit at one speed. The peak is found by harmonic balance, except against the cage ratio
(where most values have no period of rotation, D-11) and against h (which only time
integration has): there by RK4. An output is computed anew only where the parameter enters
it; N leaves time integration alone, h leaves harmonic balance alone. */

enum class Unpublished { mass, mass_ratio, cage_ratio, samples, step };

/** The values of one parameter, rising; one of them is its default. */
struct Variation {
  Unpublished parameter;
  std::vector<double> values;
  std::size_t usual;  ///< index of the default
};

struct SensitivityScene {
  Model usual;  ///< all parameters at their defaults
  std::vector<Variation> variations;
  std::vector<double> peak_speeds, time_peak_speeds, loss_speeds;  ///< [Hz]
  double orbit_frequency;                                          ///< [Hz]
  int orbit_periods;
};

/** The outputs, in the order of SensitivityPoint::outputs. */
enum Output {
  f_peak,
  amp_peak,
  f_loss_first,
  f_loss_last,
  amp_x,
  amp_y,
  amp_x_aft,
  amp_y_aft,
  output_count
};

struct SensitivityPoint {
  Unpublished parameter;
  double value;
  bool usual;                                       ///< at the default
  std::array<MaybeMeasured, output_count> outputs;  ///< [Hz] or [m]
  double spread;  ///< Poincaré spread of the integrated orbit [-]
  bool periodic;
};

SensitivityScene read_sensitivity_scene(const std::string& file,
                                        const std::string& reading);

/** Only what derivatives at the defaults need: the default and its neighbours, and the
   cage ratios with a period of rotation. */
SensitivityScene near_defaults(SensitivityScene scene);

/** `usual` with one parameter changed. */
Model varied(Model usual, Unpublished parameter, double value);

/** Whether the peak against this parameter is found by time integration. */
bool peak_by_integration(Unpublished parameter);

/** All values of all parameters, in order. */
std::vector<SensitivityPoint> compute_sensitivity(const SensitivityScene& scene);

/** d ln(output)/d ln(parameter) between two values of the parameter. */
struct NormalisedDerivative {
  Unpublished parameter;
  Output output;
  double low, high;  ///< values of the parameter
  Measured slope;    ///< [-]
};

/** Per parameter and output the difference between the nearest values on both sides of
   the default where the output exists; on one side only, the default itself stands for
   the other. Left out where there is no such pair. */
std::vector<NormalisedDerivative> normalised_derivatives(
    const std::vector<SensitivityPoint>& points);

/**
## The tables of the sensitivity to unpublished parameters */

/** One row per parameter and value. */
Table sensitivity_table(const SensitivityScene& scene);

/** One row per parameter and output: the normalised derivative at the default. */
Table sensitivity_derivative_table(const SensitivityScene& scene);

}  // namespace rotor_stator::studies
