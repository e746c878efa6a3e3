/**
# Scene files

A scene is what one figure asks to be modelled: which data sets, which speeds, how many
harmonics and samples, how the time integration is set. It is a TOML file in data/scenes/,
checked like the parameters. */
#pragma once

#include <string>
#include <vector>

#include "integration/steady_state.hpp"
#include "model/parameters.hpp"
#include "model/strict_toml.hpp"

namespace rotor_stator
{

/** How the motion of a regime is integrated, by rk4. */
struct RegimeSettings {
  double step_over_default;  ///< RK4's step over `default_step` [-]
  double longest;            ///< integration at most [s]
  double window;          ///< of the Poincaré section, and of contact [s], ≥ 2 periods
  int points_per_period;  ///< of the two recorded periods, those of a ball's passage
};

/** A scene file being read, with the reading of Table 1 (D-09): "exchanged" or
    "as-printed". */
class SceneFile
{
public:
  SceneFile(const std::string& file, const std::string& reading);

  StrictToml& toml() { return toml_; }

  /** The data set named by a key: "set1" is data/set1.toml beside the scenes' folder, or
      data/set1-as-printed.toml under that reading. */
  Parameters parameters(const std::string& key);
  std::vector<Parameters> parameter_list(const std::string& key);

  /** The table [time_integration]. */
  SteadySettings time_integration();

  /** The table [regime]. */
  RegimeSettings regime_settings();

  /** `from`, `to` and `step` in hertz, both ends included. */
  std::vector<double> speed_range(const std::string& key);

private:
  Parameters read_set(const std::string& name) const;

  std::string file_, reading_;
  StrictToml toml_;
};

/** ω [rad/s] of a frequency [Hz]. */
double angular(double hertz);

}  // namespace rotor_stator
