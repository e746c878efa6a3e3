/**
# A motion and its neighbour

The largest Lyapunov exponent is the mean rate at which two neighbouring motions separate,

$$\lambda = \lim_{t \to \infty} \frac{1}{t} \ln \frac{|\delta(t)|}{|\delta(0)|},$$

after Benettin: both motions are integrated by the same stepper, and after every output
interval the neighbour is pulled back to its first distance along the line that joins
them. On a T-periodic motion λ is ln|μ|/T of the largest Floquet multiplier. */
#pragma once

#include <memory>
#include <vector>

#include "time/section.hpp"
#include "time/side_by_side.hpp"

namespace rotor_stator {

/** λ [1/s] and its standard error [1/s]. */
using Exponent = BatchMean;

/** A state at the start of base period `period`, counted from t = 0. */
struct Instant {
  State state;
  long period = 0;
};

class TrajectoryPair {
public:
  /** `flow`: of fixed step or one that gives both the same steps (`advance_beside`), else
      its error would pass for growth.
      `sizes` of the components make the distance a number; where the motion is far larger
      than they are, they grow, and the neighbour begins anew. */
  TrajectoryPair(std::unique_ptr<Flow> flow, int intervals_per_period, double period,
                 const Eigen::VectorXd& sizes, const Instant& start);

  /** Both over the next interval, and what follows from where they are then. Throws
      NoSolution when the motion diverges. */
  void next(std::vector<Passage>& all);
  void arrived();

  bool is_between_periods() const { return interval_ == 0; }

  /** Back to the start of a base period in which a passage has failed. */
  void go_back();

  const Instant& at() const { return at_; }

  /** Half peak-to-peak of the largest displacement in the last base period [m]. */
  double half_range() const { return half_range_; }

  /** The displacements at the start of each base period. */
  const std::vector<Displacements>& section() const { return section_; }

  /** ln of the growth of the distance in each base period. */
  const std::vector<double>& growths() const { return growths_; }

  /** λ of the later half of all base periods. Its error is that of the mean of ten
      batches, or what the last quarter differs by: the transient may not be over. */
  Exponent exponent() const;

  /** ln of what is left of any distance since it was largest; at most 0. And ln of how
      much larger than at the start that was. */
  double contraction() const { return log_distance_ - highest_; }
  double growth() const { return highest_; }

  /** The last instant since which any distance has shrunk by a factor whose logarithm is
      `contraction` < 0; without one, where it was largest. */
  Instant since(double contraction) const;

  int intervals() const { return intervals_; }
  double period() const { return period_; }
  double seconds() const { return static_cast<double>(growths_.size()) * period_; }
  double evaluations() const { return static_cast<double>(flow_->evaluations()); }

private:
  State beside(const Eigen::VectorXd& y) const;
  double pull_back();

  struct Mark {
    double log_distance;
    Instant at;
  };

  std::unique_ptr<Flow> flow_;
  int intervals_;
  double period_;
  Eigen::VectorXd sizes_;
  Instant at_, before_;  ///< now, and at the start of the base period
  State neighbour_, neighbour_before_;
  int interval_ = 0;  ///< of the base period
  Displacements low_{}, high_{};
  double growth_ = 0;
  double half_range_ = 0, log_distance_ = 0, highest_ = 0;
  std::vector<double> growths_;
  std::vector<Displacements> section_;
  std::vector<Mark> marks_ = {};
};

}  // namespace rotor_stator
