/**
# Scene: frequency response (Fig. 3)

Amplitudes of both bodies against speed, for each data set: harmonic balance swept up and
swept down with the paper's predictor, and time integration at fewer speeds to say where
the branch is a motion. The amplitude is half the peak-to-peak value over the period (the
paper does not say which it draws, D-10; nor the range, D-19). Only amplitudes and the
share of contact are kept. */
#pragma once

#include "continuation/sweep.hpp"
#include "io/scene.hpp"
#include "io/table.hpp"
#include "motion/motion.hpp"

namespace rotor_stator::figures
{

struct ResponseScene {
  std::vector<Parameters> sets;
  std::vector<int> harmonics;          ///< m of each set
  std::vector<double> balance_speeds;  ///< [Hz]
  std::vector<double> time_speeds;     ///< [Hz]
  SteadySettings time_integration;
};

enum class Curve { speed_up = 1, speed_down = 2, time_integration = 3 };

struct ResponsePoint {
  int set;  ///< 1, 2, … in the scene's order
  Curve curve;
  int segment;                      ///< counts the gaps where no solution was found
  double frequency;                 ///< [Hz]
  std::array<double, 4> amplitude;  ///< of x_s, y_s, x_r, y_r: half peak-to-peak [m]
  double contact_share;             ///< of the period, with at least one loaded ball [-]
  int newton_iterations;            ///< 0 for time integration
  double spread;                    ///< Poincaré spread [-]; 0 for harmonic balance
  bool periodic;                    ///< true for harmonic balance by construction
};

ResponseScene read_response_scene(const std::string& file, const std::string& reading);

/** All curves of all sets, in order. */
std::vector<ResponsePoint> compute_response(const ResponseScene& scene);

/** Fig. 3. */
Table response_table(const ResponseScene& scene);

}  // namespace rotor_stator::figures
