#include "time/settle.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "io/errors.hpp"

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

constexpr double forgotten = -20.7;  ///< ln 1e-9
constexpr double nearer = -16.1;     ///< ln 1e-7

/** From `start`; the neighbour is pulled back at least once in 60 rad of the contact's
    vibration. */
TrajectoryPair pair_from(const Parameters& machine, double omega, const Instant& start,
                         double step, const OperationBudget& budget)
{
  constexpr double longest_phase = 60;
  const double period = 2 * std::numbers::pi / omega;
  const double least = std::ceil(period * contact_frequency(machine) / longest_phase);
  const int intervals = std::max(16, static_cast<int>(least));
  return {flow(machine, omega,
               {.method = "rk4",
                .intervals_per_period = intervals,
                .step = step,
                .budget = budget}),
          intervals, period, state_scales(machine), start};
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

  Settled operator()(const TrajectoryPair& pair) const
  {
    Settled s{.lyapunov = pair.exponent(), .at = pair.at(), .before = pair.since(nearer)};
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
  bool is_at_rest(const TrajectoryPair& pair) const
  {
    const State& state = pair.at().state;
    const double speed =
        vector_of(state).tail(vector_of(state).size() / 2).cwiseAbs().maxCoeff();
    return pair.half_range() < 1e-12 * length_ && speed * pair.period() < 1e-12 * length_;
  }

  /** The fewest base periods after which the section closes. */
  void close(const TrajectoryPair& pair, Settled& s) const
  {
    const auto& all = pair.section();
    constexpr long fewest = 4;
    if (std::ssize(all) < fewest) return;
    const auto window = std::min<long>(std::ssize(all), 3L * rule_.most_period + 1);
    const double size = std::max(pair.half_range(), 1e-9 * length_);
    const auto closing =
        closing_period(std::span(all).last(static_cast<std::size_t>(window)),
                       rule_.closed * size, rule_.most_period);
    /** Where neighbours come nearer slowly, the motion is farther away than two points of
        its section are apart. */
    const double nearer_by = -std::expm1(std::min(0.0, s.lyapunov.value) * pair.period());
    if (!(closing.spread < rule_.closed * size * std::max(1e-3, nearer_by))) return;
    s.kind = Kind::periodic;
    s.period = closing.period;
    s.before.period -= s.at.period;
    s.at.period = 0;
  }

  static bool grows_throughout(const TrajectoryPair& pair)
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
  const auto turn = flow(
      machine, omega,
      {.method = "rk4", .intervals_per_period = 1, .step = rule.step, .budget = budget});
  State state = s.at.state;
  const long first = -periods(2 * forgotten), before = -periods(nearer);
  for (long k = first; k < 0; ++k) {
    if (k == before) s.before = {state, k};
    turn->advance(k, state);
  }
  s.at = {state, 0};
  s.evaluations += static_cast<double>(turn->evaluations());
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
  TrajectoryPair pair = pair_from(machine, omega, start, rule.step, budget);
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
    settled.evaluations = pair.evaluations();
    if (base.is_driven_twice() && settled.contracts && settled.at.period != 0 &&
        settled.kind == Kind::quasi_periodic && can_be_put_on_zero(settled))
      put_on_zero(machine, omega, rule, budget, settled);
  } catch (const NoSolution& ended) {
    if (!budget.used_up() || pair.growths().empty()) throw;
    settled = judge(pair);
    settled.kind = Kind::undecided;
    settled.reason = ended.what();
    settled.evaluations = pair.evaluations();
  }
  return settled;
}

}  // namespace rotor_stator
