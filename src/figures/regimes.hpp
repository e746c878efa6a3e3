/**
# The table of the regimes, by which most claims are judged (code)

The columns of the table, and the motion at each speed. */
#pragma once

#include "motion/regime.hpp"

namespace rotor_stator::figures {

struct RegimeScene {
  std::vector<Parameters> machines;
  std::vector<double> frequencies;  ///< [Hz]
  motion::RegimeSettings settings;
};

RegimeScene read_regimes(SceneFile& file);

Table regime_table(const RegimeScene& scene);

/** The row of data set `set` at one speed. */
void add_regime(Table& table, int set, const motion::Regime& regime);

}  // namespace rotor_stator::figures
