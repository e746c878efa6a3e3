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
#include "continuation/branch.hpp"
#include "explore/measures.hpp"
#include "explore/orbit.hpp"
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
  std::vector<double> measured = {};
};

/** What the instants of a motion of this base frequency [rad/s] show: mean, force,
    contact, load and measures. */
void observe(ResponseRow& row, const Parameters& parameters, const motion::Motion& motion,
             double omega, bool is_closed, const Measures& measures);

using ResponseFields = std::vector<Field<ResponseRow>>;

/** The columns that every response has, then `own` ones, then those that are printed when
    they are asked for, of a sweep more than of a branch, and measures; how many are
    printed else. */
struct ResponseColumns {
  ResponseFields fields;
  std::size_t usual;
  Measures measures;
};
ResponseColumns columns_of(const ResponseRequest& request, const Parameters& parameters,
                           const ResponseFields& own, bool is_settled = false);

struct SavedBranch {
  int harmonics, samples;  ///< m and N
  bool upwards;            ///< the walk led to higher speeds
  /** With the speed's part of the tangent alone, none corrected yet. */
  std::vector<BranchPoint> points;
};

/** The text of a file with the branches of one machine, numbered from 1. */
std::string branch_text(const Parameters& parameters, int harmonics, int samples,
                        bool upwards, const std::vector<Branch>& branches);

/** Reads branch `number`. Throws BadInput with file and line when the file is not one of
    these, is of another machine, is cut off, or has no such branch. */
SavedBranch read_branch(const std::string& file, const Parameters& parameters,
                        int number);

/** The point of the branch nearest to `omega` [rad/s], with the direction of the branch
    there as its tangent; the last point without `omega`. */
BranchPoint restart_point(const SavedBranch& branch, const double* omega,
                          const Curve& curve);

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

/** Speed by speed, written to stdout row by row; what is returned has all of it, for --plot
    and JSON. Throw NoSolution where no speed has a value. */
Exploration settled_response(const ResponseRequest& request);
Exploration response_to_tolerance(const ResponseTask& task);

/** Along a branch: by harmonic balance, or by shooting. */
Exploration branch_by_balance(ResponseTask task);
Exploration branch_by_shooting(const ResponseTask& task);

}  // namespace rotor_stator::explore
