/**
# What a response of solutions is asked for

The request, checked, with the machine counted over the period of its motions. */
#pragma once

#include "continuation/arc_length.hpp"
#include "explore/branch_file.hpp"
#include "explore/response_table.hpp"

namespace rotor_stator::explore {

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

/** Throws BadInput for options that contradict each other. */
ResponseTask response_task(const ResponseRequest& request);

/** The columns of --harmonics-of, none without it, and their values from the series of
    x_s, y_s, x_r, y_r. */
ResponseFields harmonic_fields(const ResponseTask& task, const Harmonics& harmonics);
std::vector<std::complex<double>> harmonics_of(const ResponseTask& task,
                                               const Eigen::MatrixXd& series);

}  // namespace rotor_stator::explore
