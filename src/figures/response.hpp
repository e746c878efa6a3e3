/**
# The table of the frequency response (Fig. 3, code)

The amplitude is half the peak-to-peak value over the period; the paper does not say which
it draws (D-10), nor over what range (D-19). */
#pragma once

#include "continuation/sweep.hpp"
#include "time/steady_state.hpp"

namespace rotor_stator::figures {

struct DataSet {
  int number;  ///< 1, 2, … in the scene's order
  Parameters machine;
  int harmonics;  ///< m
};

struct ResponseScene {
  std::vector<DataSet> sets;
  std::vector<double> balance_speeds;  ///< [Hz], upwards
  std::vector<double> time_speeds;     ///< [Hz]
  SteadySettings time_integration;
};

ResponseScene read_response(SceneFile& file);

Table response_table(const ResponseScene& scene);

enum class Curve { speed_up = 1, speed_down = 2, time_integration = 3 };

/** The amplitudes along a sweep, with a gap wherever no solution was found. */
void add_curve(Table& table, const DataSet& set, Curve curve,
               const std::vector<PeriodicMotion>& solutions);

/** Those of the motions that settle from rest at the scene's speeds for time integration,
    looked at twelve times in a vibration of the contact. */
void add_settled(Table& table, const DataSet& set, const ResponseScene& scene);

}  // namespace rotor_stator::figures
