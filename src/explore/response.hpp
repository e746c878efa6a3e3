/**
# explore response

The frequency response of one machine: what it does speed by speed, or along its branch of
periodic solutions with folds, on demand the branches beside it, the Floquet multipliers
and the bifurcations.

All ways share the rows, which show one motion at one speed whichever way it was found. A
task is the request for solutions, checked, with the machine counted over the period of
its motions. */
#pragma once

#include <complex>

#include "continuation/arc_length.hpp"
#include "explore/branch_file.hpp"
#include "explore/measures.hpp"
#include "explore/orbit.hpp"

namespace rotor_stator::explore {

struct ResponseRequest : RangeRequest {
  /** What the machine does; or a branch, by a method that `is_periodic`. */
  std::string method = "auto";
  /** "rest", "up", "down", or empty: rest; of a branch the saved one's, or up. */
  std::string direction;
  File resume;         ///< of an interrupted sweep
  double longest = 0;  ///< as of a motion [s]
  File save, restart, waterfall;
  int branch = 1;            ///< number in the file `restart`
  std::optional<double> at;  ///< speed to restart from [Hz]
  int isolated = 0;          ///< speeds at which isolated branches are looked for
  int seed = 1;
  std::string harmonics_of = {};  ///< a displacement, or empty
  /** Of solutions at evenly spaced speeds, each with its own orders. */
  std::optional<double> tolerance;
  std::optional<int> count;  ///< so many; without it 101, of large bodies 21
  bool stability = false;    ///< multipliers at each point, and the bifurcations
  bool times = false;        ///< CPU seconds on stderr
  /** Sees the points of the main branch while it is followed: speed [Hz], half
      peak-to-peak [m]. */
  std::function<void(double f, const Eigen::VectorXd& amplitude)> watch = {};
};

/** One that is not along a branch writes its table to stdout as it goes. */
Exploration explore_response(const ResponseRequest& request);

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
  std::vector<double> measured = {};
};

using ResponseFields = std::vector<Field<ResponseRow>>;

/** The columns that every response has, then `own` ones, then those that are printed when
    they are asked for: of a sweep the exponent, and measures; how many are printed
    else. */
struct ResponseColumns {
  ResponseFields fields;
  std::size_t usual;
  Measures measures;
};
ResponseColumns columns_of(const ResponseRequest& request, const Parameters& parameters,
                           const ResponseFields& own, bool is_settled = false);

struct ResponseTask {
  const ResponseRequest& request;
  Parameters machine;
  Parameters parameters;  ///< the same, its base period that of the motions
  std::optional<SavedBranch> saved;
  int harmonics, samples;
  ArcLengthSettings settings;
  bool upwards;
  OperationBudget budget;
  double passages = 1;  ///< the base frequency over the speed, without unbalance
  bool has_two_frequencies = false;
  std::string base_period = "turn";  ///< in a word

  SpeedRange range() const
  {
    const double low = base(request.from), high = base(request.to);
    return upwards ? SpeedRange{low, high} : SpeedRange{high, low};
  }

  /** The base frequency [rad/s] at a speed [Hz], and back. */
  double base(double hertz) const { return angular(hertz) * passages / parameters.turns; }
  double hertz(double omega) const
  {
    return omega * parameters.turns / passages / angular(1);
  }
};

/** The columns of --harmonics-of, none without it, and their values from the series of
    x_s, y_s, x_r, y_r. */
ResponseFields harmonic_fields(const ResponseTask& task, const Harmonics& harmonics);
std::vector<std::complex<double>> harmonics_of(const ResponseTask& task,
                                               const Eigen::MatrixXd& series);

}  // namespace rotor_stator::explore
