#include "time/lyapunov.hpp"

#include <algorithm>
#include <cmath>

#include "io/errors.hpp"

namespace rotor_stator {

/** Far above rounding, far below what bends the motion. */
static constexpr double first_distance = 1e-7;

/** The neighbour starts off in all directions, so that none is missed. */
TrajectoryPair::TrajectoryPair(TimeStepper stepper, int intervals_per_period,
                               const Eigen::VectorXd& scales, const State& start,
                               long first_period)
    : stepper_(std::move(stepper)), intervals_(intervals_per_period), scales_(scales),
      state_(start), periods_(first_period)
{
  const double share = first_distance / std::sqrt(static_cast<double>(scales.size()));
  neighbour_ = state_of(vector_of(start) + share * scales);
}

double TrajectoryPair::advance_one_period(const std::function<void(const State&)>& visit)
{
  double growth = 0;
  for (long k = 0; k < intervals_; ++k) {
    if (visit) visit(state_);
    const long interval = periods_ * intervals_ + k;
    if (stepper_.advance_both) {
      stepper_.advance_both(interval, state_, neighbour_);
    } else {
      stepper_.advance(interval, state_);
      stepper_.advance(interval, neighbour_);
    }
    growth += pull_back();
  }
  ++periods_;
  return growth;
}

double TrajectoryPair::pull_back()
{
  const Eigen::VectorXd y = vector_of(state_);
  const Eigen::VectorXd apart = vector_of(neighbour_) - y;
  const double growth = apart.cwiseQuotient(scales_).norm() / first_distance;
  if (!std::isfinite(growth) || !(growth > 0))
    throw NoSolution(format(growth == 0 ? "neighbouring motions met after %ld periods"
                                        : "time integration diverged after %ld periods",
                            periods_));
  neighbour_ = state_of(y + apart / growth);
  return std::log(growth);
}

namespace {

/** The largest distance of two points k periods apart, over `size` [m]; at least k+1 points. */
double spread_of_order(int k, const std::vector<Displacements>& section, double size)
{
  double widest = 0;
  const auto apart = static_cast<std::size_t>(k);
  for (std::size_t n = apart; n < section.size(); ++n)
    for (std::size_t i = 0; i < 4; ++i)
      widest = std::max(widest, std::abs(section[n][i] - section[n - apart][i]));
  return widest / size;
}

SectionKind verdict_of(const SectionJudgement& j, const VerdictRule& rule)
{
  if (j.spread < rule.periodic) return SectionKind::periodic;
  if (j.period > 1 && j.spread_k < rule.periodic) return SectionKind::subharmonic;
  const double doubt = 3 * j.exponent.error;
  if (j.exponent.value - doubt > rule.zero_rate) return SectionKind::chaotic;
  const bool known = doubt < 2 * rule.zero_rate;
  const bool zero = std::abs(j.exponent.value) <= std::max(doubt, 0.1 * rule.zero_rate);
  if (known && zero) return SectionKind::quasi_periodic;
  if (rule.is_driven_twice && j.exponent.value + doubt < 0)
    return SectionKind::quasi_periodic;
  return SectionKind::undecided;
}

}  // namespace

SectionJudgement judge_section(const std::vector<Displacements>& section, double size,
                               const Exponent& exponent, const VerdictRule& rule)
{
  const double whole = extent(section) / size;
  SectionJudgement judgement{SectionKind::undecided, 1, whole, whole, exponent};
  const int most = std::min(rule.most_period, static_cast<int>(section.size()) / 3);
  for (int k = 2; k <= most && !(judgement.spread_k < rule.periodic); ++k) {
    const double spread = spread_of_order(k, section, size);
    if (spread >= judgement.spread_k) continue;
    judgement.period = k;
    judgement.spread_k = spread;
  }
  judgement.verdict = verdict_of(judgement, rule);
  return judgement;
}

}  // namespace rotor_stator
