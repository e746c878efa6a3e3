/**
# The rows of a response

What is printed of one motion at one speed, whichever way it was found. */
#pragma once

#include <complex>

#include "explore/response.hpp"
#include "motion/motion.hpp"

namespace rotor_stator::explore {

struct ResponseRow {
  double frequency;           ///< [Hz]
  Displacements amplitude{};  ///< half peak-to-peak of x_s, y_s, x_r, y_r [m]
  int period = 0;             ///< of a sweep: K as tables print it
  double lyapunov = 0;        ///< of a sweep [1/s]
  double error = 0;           ///< with a tolerance [-]
  double arc = 0;             ///< of a branch [-]
  int newton = 0;
  std::size_t branch = 1;
  double multiplier = -1, multiplier_change = -1;
  std::string verdict = "undecided", bifurcation = "-";
  std::vector<std::complex<double>> harmonics = {};  ///< of --harmonics-of [m]

  Displacements mean{}, rms{};              ///< [m]
  Vec2 force{0, 0};                         ///< half peak-to-peak [N]
  double contact_share = 0, ball_load = 0;  ///< [-], [N]
};

/** What the instants of a motion show: mean, force, contact, load. */
void observe(ResponseRow& row, const Parameters& parameters,
             const motion::Motion& motion);

using ResponseFields = std::vector<Field<ResponseRow>>;

/** The columns that every response has, then `own` ones, then those that are printed when
    they are asked for, of a sweep more than of a branch; how many are printed else. */
struct ResponseColumns {
  ResponseFields fields;
  std::size_t usual;
};
ResponseColumns columns_of(const Parameters& parameters, const ResponseFields& own,
                           bool is_settled = false);

}  // namespace rotor_stator::explore
