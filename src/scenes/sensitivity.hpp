/**
# Scene: sensitivity to what the paper leaves out

Masses, cage and the two discretisations are not printed. Each is varied alone about its
default: the total mass m_s + m_r at fixed ratio, the ratio m_r/m_s at fixed total, the
cage ratio c = ω_cage/ω, the samples N of the balance, the step h of RK4. What is printed
(natural frequencies, damping ratios, unbalance, bearing) stays.

Outputs are the peak of x_r, the speeds between which contact is lost and the size of the
orbit at one speed. The peak is found by harmonic balance, except against the cage ratio
(where most values have no period of rotation, D-11) and against h (which only time
integration has): there by RK4. An output is computed anew only where the parameter enters
it; N leaves time integration alone, h leaves harmonic balance alone. */
#pragma once

#include "scenes/response_features.hpp"
#include "scenes/scene_file.hpp"

namespace rotor_stator
{

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

}  // namespace rotor_stator
