#include "time/trajectory_pair.hpp"

#include <algorithm>
#include <cmath>

#include "io/errors.hpp"

namespace rotor_stator {

/** Far above rounding, far below what bends the motion; over the sizes. */
static constexpr double first_distance = 1e-7;

/** The least size of a component over its largest value: the rounding of a displacement
    or speed that is far larger than its size would pass for growth. */
static constexpr double above_rounding = 1e-4;

TrajectoryPair::TrajectoryPair(std::unique_ptr<Flow> flow, int intervals_per_period,
                               double period, const Eigen::VectorXd& sizes,
                               const Instant& start)
    : flow_(std::move(flow)), intervals_(intervals_per_period), period_(period),
      sizes_(sizes), at_(start), neighbour_(beside(vector_of(start.state)))
{
}

void TrajectoryPair::next(std::vector<Passage>& all)
{
  if (interval_ == 0) {
    before_ = at_;
    neighbour_before_ = neighbour_;
    low_ = high_ = displacements(at_.state.position);
    growth_ = 0;
  }
  const long interval = at_.period * intervals_ + interval_;
  all.push_back({flow_.get(), interval, &at_.state});
  all.push_back(
      {.flow = flow_.get(), .first = interval, .state = &neighbour_, .is_beside = true});
}

void TrajectoryPair::arrived()
{
  growth_ += pull_back();
  const Displacements q = displacements(at_.state.position);
  for (std::size_t i = 0; i < 4; ++i) {
    low_[i] = std::min(low_[i], q[i]);
    high_[i] = std::max(high_[i], q[i]);
  }
  if (++interval_ < intervals_) return;
  interval_ = 0;
  ++at_.period;
  section_.push_back(displacements(before_.state.position));
  half_range_ = 0;
  for (std::size_t i = 0; i < 4; ++i)
    half_range_ = std::max(half_range_, 0.5 * (high_[i] - low_[i]));
  growths_.push_back(growth_);
  log_distance_ += growth_;
  highest_ = std::max(highest_, log_distance_);
  if (log_distance_ >= highest_) marks_.clear();
  if (marks_.empty() || marks_.back().log_distance - log_distance_ > 1)
    marks_.push_back({log_distance_, at_});
}

void TrajectoryPair::go_back()
{
  at_ = before_;
  neighbour_ = neighbour_before_;
  interval_ = 0;
}

/** At the first distance, off in all directions, so that none is missed. */
State TrajectoryPair::beside(const Eigen::VectorXd& y) const
{
  const double share = first_distance / std::sqrt(static_cast<double>(sizes_.size()));
  return state_of(y + share * sizes_);
}

double TrajectoryPair::pull_back()
{
  constexpr double met = 1e-8;  ///< rounding keeps neighbours apart that have met
  const Eigen::VectorXd y = vector_of(at_.state), apart = vector_of(neighbour_) - y;
  const double growth = apart.cwiseQuotient(sizes_).norm() / first_distance;
  const bool is_large = (above_rounding * y.array().abs() > sizes_.array()).any();
  if (!y.allFinite() || !(is_large || std::isfinite(growth)))
    throw Diverged(format("time integration diverged %.3g s after its start", seconds()));
  if (is_large) {
    sizes_ = sizes_.cwiseMax(above_rounding * y.cwiseAbs());
    neighbour_ = beside(y);
    return 0;
  }
  neighbour_ = growth > met ? state_of(y + apart / growth) : beside(y);
  return std::log(std::max(growth, met));
}

Exponent TrajectoryPair::exponent() const
{
  const auto from = [&](std::ptrdiff_t first) {
    return batch_mean({growths_.begin() + first, growths_.end()});
  };
  const std::ptrdiff_t count = std::ssize(growths_), quarter = (count - count / 2) / 2;
  const BatchMean rate = from(count / 2);
  const double trend = std::abs(from(count - quarter).value - rate.value);
  return {rate.value / period_, std::max(rate.error, trend) / period_};
}

Instant TrajectoryPair::since(double contraction) const
{
  Instant before = marks_.front().at;
  for (const Mark& mark : marks_)
    if (log_distance_ - mark.log_distance <= contraction) before = mark.at;
  return before;
}

}  // namespace rotor_stator
