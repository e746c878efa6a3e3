#include "time/settle.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "io/errors.hpp"
#include "time/gauss.hpp"
#include "time/rk4.hpp"
#include "time/time_stepper.hpp"

namespace rotor_stator {

const char* word(Kind kind)
{
  switch (kind) {
    case Kind::rest: return "rest";
    case Kind::periodic: return "periodic";
    case Kind::quasi_periodic: return "quasi-periodic";
    case Kind::chaotic: return "chaotic";
    case Kind::undecided: break;
  }
  return "undecided";
}

namespace {

/** Gauss's rule as a flow. */
class GaussFlow : public Flow {
public:
  template <class... Arguments>
  explicit GaussFlow(Arguments&&... arguments)
      : stepper_(std::forward<Arguments>(arguments)...)
  {
  }
  void advance(long interval, State& state) override
  {
    stepper_.advance(interval, state);
  }
  long evaluations() const override { return stepper_.evaluations(); }

private:
  GaussStepper stepper_;
};

}  // namespace

std::unique_ptr<Flow> fixed_step_flow(const Parameters& machine, double omega,
                                      int intervals, double step,
                                      const OperationBudget& budget)
{
  if (machine.large)
    return std::make_unique<GaussFlow>(machine, omega, intervals, 1e-8, budget);
  return std::make_unique<Rk4>(machine, omega, intervals,
                               step > 0 ? step : step_at(machine, omega), budget);
}

/** A contact of Hertz is stiffer with the third root of its force, and vibrates faster with the sixth. */
double step_at(const Parameters& machine, double omega)
{
  constexpr double much = 30;
  const double step = default_step(machine);
  if (machine.large) return step;
  double force = 0;
  for (const double phase : {0.0, 0.5, 1.0, 1.5}) {
    const Vec2 f = rigid_joint_force(machine, omega, phase);
    force = std::max(force, std::hypot(f.x, f.y));
  }
  const double ratio = force / (much * scales(machine).load);
  return std::isfinite(ratio) && ratio > 1 ? step / std::pow(ratio, 1.0 / 6) : step;
}

double apart(const Parameters& machine, const State& a, const State& b)
{
  return (vector_of(a) - vector_of(b))
      .cwiseQuotient(state_scales(machine))
      .cwiseAbs()
      .maxCoeff();
}

/** Eigenvalues of one direction: x_s, x_r and their speeds. */
SlowestMode slowest_mode(const Parameters& machine)
{
  const Body &s = machine.stator, &r = machine.rotor;
  const double joint = scales(machine).stiffness;
  Eigen::Matrix4d a = Eigen::Matrix4d::Zero();
  a.topRightCorner<2, 2>().setIdentity();
  a.bottomLeftCorner<2, 2>() << -(s.stiffness() + joint) / s.mass, joint / s.mass,
      joint / r.mass, -(r.stiffness() + joint) / r.mass;
  a(2, 2) = -s.damping() / s.mass;
  a(3, 3) = -r.damping() / r.mass;
  SlowestMode slowest{std::numeric_limits<double>::infinity(),
                      std::numeric_limits<double>::infinity()};
  for (const auto& value : Eigen::EigenSolver<Eigen::Matrix4d>(a, false).eigenvalues()) {
    slowest.decay = std::min(slowest.decay, std::max(0.0, -value.real()));
    if (std::abs(value) > 0)
      slowest.frequency = std::min(slowest.frequency, std::abs(value));
  }
  return slowest;
}

Instant from_rest(const Parameters& machine, double omega)
{
  constexpr double shortest = 4, longest = 25, decays = 25;  // [s], [s], [-]
  const double seconds =
      std::clamp(decays / slowest_mode(machine).decay, shortest, longest);
  const double speed = rotor_speed(machine, omega);
  const double turns = std::ceil(seconds * speed / (2 * std::numbers::pi));
  const auto periods = std::lround(std::ceil(turns * omega / speed - 1e-9));
  const double cage =
      2 * std::numbers::pi *
      std::fmod(machine.bearing.cage_speed_ratio * static_cast<double>(periods), 1.0);
  return {rest_state(machine, Direction::of(machine.bearing.cage_phase - cage)),
          -periods};
}

namespace {

constexpr double first_distance = 1e-7;  ///< of the neighbour, over the sizes
constexpr double forgotten = -20.7;      ///< ln 1e-9
constexpr double nearer = -16.1;         ///< ln 1e-7

/** A motion and its neighbour on their way. */
class Pair {
public:
  Pair(const Parameters& machine, double omega, const Instant& start, double step,
       const OperationBudget& budget)
      : sizes_(state_scales(machine)), period_(2 * std::numbers::pi / omega),
        intervals_(std::max(
            16, static_cast<int>(
                    std::ceil(period_ * contact_frequency(machine) / longest_phase)))),
        flow_(fixed_step_flow(machine, omega, intervals_, step, budget)), at_(start),
        neighbour_(beside(vector_of(start.state)))
  {
  }

  /** Over one base period; where that cannot be paid for, the motion stays where it was. */
  void advance()
  {
    const Instant before = at_;
    const State neighbour = neighbour_;
    try {
      advance_one_period();
    } catch (const NoSolution&) {
      at_ = before;
      neighbour_ = neighbour;
      throw;
    }
  }

  /** ln of what is left of any distance since it was largest. */
  double contraction() const { return log_distance_ - highest_; }

  /** An instant since which neighbours have come so much nearer, if there is one. */
  Instant since(double contraction) const
  {
    Instant before = marks_.front().at;
    for (const Mark& mark : marks_)
      if (log_distance_ - mark.log_distance <= contraction) before = mark.at;
    return before;
  }

  const Instant& at() const { return at_; }
  double half_range() const { return half_range_; }
  double period() const { return period_; }
  double seconds() const { return static_cast<double>(growths_.size()) * period_; }
  const std::vector<double>& growths() const { return growths_; }
  const std::vector<Displacements>& section() const { return section_; }
  long evaluations() const { return flow_->evaluations(); }

private:
  static constexpr double longest_phase =
      60;  ///< of the contact's vibration between two pulls

  void advance_one_period()
  {
    const Displacements first = displacements(at_.state.position);
    Displacements low = first, high = first;
    double growth = 0;
    for (long k = 0; k < intervals_; ++k) {
      flow_->advance(at_.period * intervals_ + k, at_.state, neighbour_);
      growth += pull_back();
      const Displacements q = displacements(at_.state.position);
      for (std::size_t i = 0; i < 4; ++i) {
        low[i] = std::min(low[i], q[i]);
        high[i] = std::max(high[i], q[i]);
      }
    }
    ++at_.period;
    section_.push_back(first);
    half_range_ = 0;
    for (std::size_t i = 0; i < 4; ++i)
      half_range_ = std::max(half_range_, 0.5 * (high[i] - low[i]));
    growths_.push_back(growth);
    log_distance_ += growth;
    highest_ = std::max(highest_, log_distance_);
    if (log_distance_ >= highest_) marks_.clear();
    if (marks_.empty() || marks_.back().log_distance - log_distance_ > 1)
      marks_.push_back({log_distance_, at_});
  }

  /** A neighbour at the first distance, off in all directions, so that none is missed. */
  State beside(const Eigen::VectorXd& y) const
  {
    const double share = first_distance / std::sqrt(static_cast<double>(sizes_.size()));
    return state_of(y + share * sizes_);
  }

  double pull_back()
  {
    const Eigen::VectorXd y = vector_of(at_.state);
    const Eigen::VectorXd apart = vector_of(neighbour_) - y;
    const double growth = apart.cwiseQuotient(sizes_).norm() / first_distance;
    if (!std::isfinite(growth))
      throw NoSolution(
          format("time integration diverged %.3g s after its start", seconds()));
    /** Rounding keeps neighbours apart that have met. */
    if (!(growth > 1e-8)) {
      neighbour_ = beside(y);
      return std::log(1e-8);
    }
    neighbour_ = state_of(y + apart / growth);
    return std::log(growth);
  }

  struct Mark {
    double log_distance;
    Instant at;
  };

  Eigen::VectorXd sizes_;
  double period_;
  int intervals_;
  std::unique_ptr<Flow> flow_;
  Instant at_;
  State neighbour_;
  double half_range_ = 0, log_distance_ = 0, highest_ = 0;
  std::vector<double> growths_;  ///< ln of the growth in each base period
  std::vector<Displacements> section_;
  std::vector<Mark> marks_ = {};
};

/** The growth rates of the later half of all base periods, in ten batches [1/s]. */
Exponent exponent_of(const Pair& pair)
{
  const auto& all = pair.growths();
  Exponent rate = batch_mean({all.begin() + std::ssize(all) / 2, all.end()});
  return {rate.value / pair.period(), rate.error / pair.period()};
}

/** The kind of a motion by what was seen of it so far. */
class Judge {
public:
  Judge(const Parameters& machine, double omega, const BasePeriod& base,
        const SettleRule& rule)
      : base_(base), rule_(rule), length_(scales(machine).length)
  {
    constexpr double slow_periods = 20, least_seconds = 2;
    least_ =
        std::max({least_seconds,
                  slow_periods * 2 * std::numbers::pi / slowest_mode(machine).frequency,
                  rule.most_period * 2 * std::numbers::pi / omega});
    least_ = std::min(least_, 25.0);
  }

  Settled operator()(const Pair& pair) const
  {
    Settled s{
        .lyapunov = exponent_of(pair), .at = pair.at(), .before = pair.since(nearer)};
    s.remainder = std::exp(std::max(-700.0, pair.contraction()));
    s.amplitude = pair.half_range();
    s.seconds = pair.seconds();
    const double rate = s.lyapunov.value, doubt = 3 * s.lyapunov.error;
    s.contracts = rate + doubt < 0;
    if (is_at_rest(pair)) {
      s.kind = Kind::rest;
      return s;
    }
    if (!base_.is_driven_twice()) close(pair, s);
    if (s.kind == Kind::periodic) return s;
    const bool is_long_enough = 0.5 * pair.seconds() >= least_ * (1 - 1e-9);
    if (!is_long_enough)
      s.reason = format("%.3g s are too short to tell", pair.seconds());
    else if (rate - doubt > 0 && grows_throughout(pair))
      s.kind = Kind::chaotic;
    else if (base_.is_driven_twice() && s.contracts)
      s.kind = pair.contraction() <= forgotten ? Kind::quasi_periodic : Kind::undecided;
    else if (std::abs(rate) <= doubt && doubt < 0.1 && pair.seconds() > rule_.longest / 2)
      s.kind = Kind::quasi_periodic;
    if (s.kind == Kind::undecided && s.reason.empty())
      s.reason = s.contracts
                     ? format(
                           "neighbours contract by %.3g/s, but the transient is not over "
                           "after %.3g s",
                           -rate, pair.seconds())
                     : format(
                           "the growth rate of neighbours, %.2g +- %.1g/s, is not known "
                           "well enough after %.3g s",
                           rate, doubt, pair.seconds());
    return s;
  }

private:
  bool is_at_rest(const Pair& pair) const
  {
    const State& state = pair.at().state;
    const double speed =
        vector_of(state).tail(vector_of(state).size() / 2).cwiseAbs().maxCoeff();
    return pair.half_range() < 1e-12 * length_ && speed * pair.period() < 1e-12 * length_;
  }

  /** The fewest base periods after which the section closes. */
  void close(const Pair& pair, Settled& s) const
  {
    const auto& all = pair.section();
    constexpr long fewest = 4;
    if (std::ssize(all) < fewest) return;
    const auto window = std::min<long>(std::ssize(all), 3L * rule_.most_period + 1);
    const std::vector<Displacements> last(all.end() - window, all.end());
    const double size = std::max(pair.half_range(), 1e-9 * length_);
    const SectionJudgement judged = judge_section(
        last, size, {}, {.periodic = rule_.closed, .most_period = rule_.most_period});
    /** Where neighbours come nearer slowly, the motion is farther away than two points of its section are apart. */
    const double nearer_by = -std::expm1(std::min(0.0, s.lyapunov.value) * pair.period());
    if (!(judged.spread_k < rule_.closed * std::max(1e-3, nearer_by))) return;
    s.kind = Kind::periodic;
    s.period = judged.period;
    s.before.period -= s.at.period;
    s.at.period = 0;
  }

  static bool grows_throughout(const Pair& pair)
  {
    const auto& all = pair.growths();
    const auto quarter = std::ssize(all) / 4;
    double third = 0, fourth = 0;
    for (auto k = all.end() - 2 * quarter; k != all.end() - quarter; ++k) third += *k;
    for (auto k = all.end() - quarter; k != all.end(); ++k) fourth += *k;
    return third > 0 && fourth > 0;
  }

  const BasePeriod& base_;
  const SettleRule& rule_;
  double length_, least_;  ///< [m], [s]
};

/** Whether that takes at most so many evaluations; else the motion begins where it was reached. */
bool can_be_put_on_zero(const Settled& s)
{
  constexpr double most = 1e8, motions = 2;
  const double seconds = 2 * forgotten / s.lyapunov.value;
  return seconds * s.evaluations / (motions * s.seconds) < most;
}

/** A motion that has contracted after t = 0, put on t = 0: from its state so much earlier that the jump of the phases is
    forgotten. */
void put_on_zero(const Parameters& machine, double omega, const SettleRule& rule,
                 const OperationBudget& budget, Settled& s)
{
  const double period = 2 * std::numbers::pi / omega;
  const auto periods = [&](double logarithm) {
    return std::lround(std::ceil(logarithm / (s.lyapunov.value * period)));
  };
  const auto flow = fixed_step_flow(machine, omega, 1, rule.step, budget);
  State state = s.at.state;
  const long first = -periods(2 * forgotten), before = -periods(nearer);
  for (long k = first; k < 0; ++k) {
    if (k == before) s.before = {state, k};
    flow->advance(k, state);
  }
  s.at = {state, 0};
  s.evaluations += static_cast<double>(flow->evaluations());
}

/** Sixty seconds, or those in which the slowest linear mode decays to e^-40, at most a thousand. */
SettleRule with_longest(SettleRule rule, const Parameters& machine)
{
  if (rule.longest > 0) return rule;
  rule.longest = std::clamp(40 / slowest_mode(machine).decay, 60.0, 1000.0);
  return rule;
}

}  // namespace

Settled settle(const Parameters& machine, double omega, const BasePeriod& base,
               const Instant& start, const SettleRule& rule,
               const OperationBudget& budget)
{
  Pair pair(machine, omega, start, rule.step, budget);
  const SettleRule whole = with_longest(rule, machine);
  const Judge judge(machine, omega, base, whole);
  Settled settled;
  try {
    while (pair.at().period < 0 || pair.growths().empty()) pair.advance();
    settled = judge(pair);
    const double began = pair.seconds();
    while (settled.kind == Kind::undecided && pair.seconds() - began < whole.longest) {
      const auto more = std::max<std::size_t>(16, pair.growths().size() / 8);
      for (std::size_t k = 0; k < more; ++k) pair.advance();
      settled = judge(pair);
    }
    settled.evaluations = static_cast<double>(pair.evaluations());
    if (base.is_driven_twice() && settled.contracts && settled.at.period != 0 &&
        settled.kind == Kind::quasi_periodic && can_be_put_on_zero(settled))
      put_on_zero(machine, omega, rule, budget, settled);
  } catch (const NoSolution& ended) {
    if (!budget.used_up() || pair.growths().empty()) throw;
    settled = judge(pair);
    settled.kind = Kind::undecided;
    settled.reason = ended.what();
    settled.evaluations = static_cast<double>(pair.evaluations());
  }
  return settled;
}

}  // namespace rotor_stator
