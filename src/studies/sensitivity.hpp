/**
# Sensitivity to what the paper leaves out

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

#include "balance/newton.hpp"
#include "io/table.hpp"
#include "io/toml_file.hpp"
#include "studies/features.hpp"

namespace rotor_stator::studies {

enum class Unpublished { mass, mass_ratio, cage_ratio, samples, step };

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
  bool usual;  ///< at the default
  /** What is computed for this point: what its parameter enters, of several equal ones the
      first. The rest is that of the defaults. */
  bool peak = false, balance = false, integration = false;
  std::array<std::optional<Measured>, output_count> outputs = {};  ///< [Hz] or [m]
  double spread = 0;  ///< Poincaré spread of the integrated orbit [-]
  bool periodic = false;

  bool computes(int output) const
  {
    return output <= amp_peak ? peak : output >= amp_x_aft ? balance : integration;
  }

  /** The outputs `first` and the one after it. */
  void set(Output first, const Measured& one, const Measured& other)
  {
    outputs[first] = one;
    outputs[first + 1] = other;
  }
};

struct SensitivityScene {
  Model usual;                                ///< all parameters at their defaults
  std::vector<SensitivityPoint> points = {};  ///< by parameter and rising value
  std::vector<double> peak_speeds, time_peak_speeds, loss_speeds;  ///< [Hz]
  double orbit_frequency;                                          ///< [Hz]
  int orbit_periods;
};

SensitivityScene read_sensitivity_scene(SceneFile& file);

/** `usual` with one parameter changed. */
Model varied(Model usual, Unpublished parameter, double value);

/** Whether the peak against this parameter is found by time integration. */
bool peak_by_integration(Unpublished parameter);

/** Outputs that were not computed, from the points at the defaults where they were. */
void fill_from_defaults(std::vector<SensitivityPoint>& points);

/** One row per parameter and value. */
Table sensitivity_table(const SensitivityScene& scene,
                        const std::vector<SensitivityPoint>& points);

/**
## Normalised derivatives */

/** d ln(output)/d ln(parameter) between two values of the parameter. */
struct NormalisedDerivative {
  Unpublished parameter;
  Output output;
  double low, high;  ///< values of the parameter
  Measured slope;    ///< [-]
};

/** The points of a scene as `sensitivity_table` has written them. Throws BadInput when it is the table
    of another scene. */
std::vector<SensitivityPoint> read_sensitivity(const SensitivityScene& scene,
                                               const std::string& table);

/** Per parameter and output the difference between the nearest values on both sides of
   the default where the output exists; on one side only, the default itself stands for
   the other. Left out where there is no such pair. */
std::vector<NormalisedDerivative> normalised_derivatives(
    const std::vector<SensitivityPoint>& points);

/** One row per parameter and output: the normalised derivative at the default. */
Table derivative_table(const SensitivityScene& scene,
                       const std::vector<NormalisedDerivative>& derivatives);

}  // namespace rotor_stator::studies
