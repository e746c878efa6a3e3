#include "time/settle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>

#include "io/errors.hpp"
#include "time/eigenvalues.hpp"

namespace rotor_stator {

const char* word(Kind kind)
{
  constexpr const char* words[] = {"undecided", "rest", "periodic", "quasi-periodic",
                                   "chaotic"};
  return words[static_cast<int>(kind)];
}

double apart(const Parameters& machine, const State& a, const State& b)
{
  return (vector_of(a) - vector_of(b))
      .cwiseQuotient(state_scales(machine))
      .cwiseAbs()
      .maxCoeff();
}

Eigen::VectorXcd free_modes(const Parameters& machine, double joint_stiffness)
{
  const Body &s = machine.stator, &r = machine.rotor;
  const double k = joint_stiffness;
  Eigen::Matrix4d a = Eigen::Matrix4d::Zero();  // of x_s, x_r and their speeds
  a.topRightCorner<2, 2>().setIdentity();
  a.bottomLeftCorner<2, 2>() << -(s.stiffness() + k) / s.mass, k / s.mass, k / r.mass,
      -(r.stiffness() + k) / r.mass;
  a(2, 2) = -s.damping() / s.mass;
  a(3, 3) = -r.damping() / r.mass;
  if (!a.allFinite()) return {};  // no step is short enough, which is said there
  return eigenvalues(a);
}

namespace {

/** The slowest decay rate and the lowest natural frequency [1/s] of both bodies joined by
    a loaded contact; a frequency of 0 is left out. */
struct SlowestMode {
  double decay = std::numeric_limits<double>::infinity(), frequency = decay;
};

SlowestMode slowest_mode(const Parameters& machine)
{
  SlowestMode slowest;
  for (const auto& value : free_modes(machine, scales(machine).stiffness)) {
    slowest.decay = std::min(slowest.decay, std::max(0.0, -value.real()));
    if (std::abs(value) > 0)
      slowest.frequency = std::min(slowest.frequency, std::abs(value));
  }
  return slowest;
}

}  // namespace

Instant from_rest(const Parameters& machine, double omega)
{
  constexpr double shortest = 4, longest = 25, decays = 25;  // [s], [s], [-]
  constexpr double most = 1e12;  // periods; more are beyond any budget
  const double seconds =
      std::clamp(decays / slowest_mode(machine).decay, shortest, longest);
  const double speed = rotor_speed(machine, omega);
  const double turns = std::ceil(seconds * speed / (2 * std::numbers::pi));
  const auto periods =
      std::lround(std::min(std::ceil(turns * omega / speed - 1e-9), most));
  const double cage =
      2 * std::numbers::pi *
      std::fmod(machine.bearing.cage_speed_ratio * static_cast<double>(periods), 1.0);
  return {
      machine.bodies->at_rest(machine, Direction::of(machine.bearing.cage_phase - cage)),
      -periods};
}

namespace {

constexpr double forgotten = -20.7;  ///< ln 1e-9
constexpr double nearer = -16.1;     ///< ln 1e-7

/** So long a motion is watched before a growth rate is believed, at least [s]. */
double least_seconds(const Parameters& machine, double omega)
{
  constexpr double slow_periods = 20, shortest = 2, longest = 25;
  const double turn = 2 * std::numbers::pi;
  return std::min(
      longest, std::max({shortest, slow_periods * turn / slowest_mode(machine).frequency,
                         most_period * turn / omega}));
}

/** With what the rule leaves open. The longest time is sixty seconds, or those in which
    the slowest linear mode decays to e^-40, at most a thousand. */
SettleRule filled(SettleRule rule, const Parameters& machine, double omega)
{
  constexpr double least_steps = 32;  // of a base period
  if (rule.step == 0) rule.step = step_at(machine, omega);
  rule.step = std::min(rule.step, 2 * std::numbers::pi / omega / least_steps);
  if (rule.longest == 0)
    rule.longest = std::clamp(40 / slowest_mode(machine).decay, 60.0, 1000.0);
  return rule;
}

}  // namespace

Settling::Settling(const Parameters& machine, double omega, const BasePeriod& base,
                   const Instant& start, const SettleRule& rule,
                   const OperationBudget& budget)
    : machine_(machine), omega_(omega), base_(base), rule_(filled(rule, machine, omega)),
      budget_(budget), length_(scales(machine).length),
      least_(least_seconds(machine, omega)), start_(start), pair_(pair_from_start())
{
}

void Settling::next(std::vector<Passage>& all)
{
  if (has_ended_) return;
  if (to_zero_)
    all.push_back({to_zero_.get(), at_.period, &at_.state});
  else
    pair_.next(all);
}

void Settling::arrived()
{
  if (to_zero_) {
    if (++at_.period == before_.period) before_.state = at_.state;
    if (at_.period < 0) return;
    settled_.at = at_;
    settled_.before = before_;
    settled_.evaluations += static_cast<double>(to_zero_->evaluations());
    has_ended_ = true;
    return;
  }
  pair_.arrived();
  if (!pair_.is_between_periods()) return;
  /** Beyond that no bearing is left. */
  constexpr double lengths = 1e5, metres = 1;
  if (pair_.half_range() > std::max(metres, lengths * length_))
    throw NoSolution(
        format("the motion grows without bound: by more than %.3g m after %.3g s",
               pair_.half_range(), pair_.seconds()));
  /** After t = 0; earlier where the motion may have closed: any base period begins it. */
  const bool may_be_over = pair_.at().period >= 0 ||
                           (!base_.is_driven_twice() && pair_.contraction() <= forgotten);
  const bool is_due = periods_ == 0 || --periods_ == 0;
  if (pair_.at().period == 0 || (is_due && may_be_over)) look();
}

std::unique_ptr<Flow> Settling::flow_of(double step, int intervals) const
{
  return flow(machine_, omega_,
              {.method = rule_.method,
               .intervals_per_period = intervals,
               .step = step,
               .budget = budget_});
}

/** The neighbour is pulled back at least once in 60 rad of the contact's vibration; short
    base periods are cut into fewer intervals. */
TrajectoryPair Settling::pair_from_start() const
{
  constexpr double longest_phase = 60, steps_of_interval = 32;  // of rk4
  const double period = 2 * std::numbers::pi / omega_;
  const double least = std::ceil(period * contact_frequency(machine_) / longest_phase);
  const double usual =
      std::clamp(std::ceil(period / (steps_of_interval * rule_.step)), 4.0, 8.0);
  const int intervals = static_cast<int>(std::max(usual, least));
  return {flow_of(rule_.step, intervals), intervals, period, state_scales(machine_),
          start_};
}

/** At the pair, when the transient may be over. */
void Settling::look()
{
  settled_ = seen();
  const bool is_early = pair_.at().period < 0;
  if (began_ < 0 && !is_early) began_ = pair_.seconds();
  if (settled_.kind == Kind::undecided &&
      (is_early || pair_.seconds() - began_ < rule_.longest)) {
    periods_ = std::max<std::size_t>(4, pair_.growths().size() / 8);
    return;
  }
  if (!rule_.is_fixed && is_subtle()) {
    start_ = pair_.at();
    if (machine_.bodies->takes_explicit_steps()) rule_.method = "rk4";
    return begin_anew();
  }
  if (!is_resolved()) {
    if (!rule_.is_fixed) return begin_anew();
    settled_.kind = Kind::undecided;
    settled_.period = 0;
    settled_.reason =
        format("with a quarter of the step of %.3g s it is another motion", rule_.step);
  }
  settled_.evaluations = spent_beside_ + pair_.evaluations();
  if (base_.is_driven_twice() && settled_.contracts && settled_.at.period != 0 &&
      settled_.kind == Kind::quasi_periodic && can_be_put_on_zero())
    put_on_zero();
  else
    has_ended_ = true;
}

/** Whether the steps may decide what it is: neighbours meet though nothing closes, or
    they part so slowly that it takes long to tell. */
bool Settling::is_subtle() const
{
  const bool is_locked = settled_.kind == Kind::undecided && settled_.contracts &&
                         !base_.is_driven_twice() && is_over();
  const double late =
      std::max(rule_.longest / 2, 3 * least_);  // the first look: 2 least_
  return is_locked || (settled_.kind == Kind::chaotic && pair_.seconds() > late);
}

/** Follows the motion over so many base periods with its steps and with steps a quarter
    as long. `see` is shown both states after each interval, and may change the second. */
template <class See>
void Settling::follow_by_both(int periods, const See& see)
{
  const int intervals = pair_.intervals();
  const auto same = flow_of(rule_.step, intervals),
             finer = flow_of(rule_.step / 4, intervals);
  const long first = settled_.at.period * intervals;
  State state = settled_.at.state, by_finer = state;
  for (long k = first; k < first + static_cast<long>(periods) * intervals; ++k) {
    finer->advance(k, by_finer);
    same->advance(k, state);
    see(k + 1, state, by_finer);
  }
  spent_beside_ += static_cast<double>(same->evaluations() + finer->evaluations());
}

/** Whether steps a quarter as long go the same way, interval by interval over one base
    period. In units of the sizes the intervals end 0.6 to 7 apart where only the steps
    keep a motion up, and at most 0.0012 apart elsewhere, where it is chaotic too (both
    sets in both readings, 3,320 starts). */
bool Settling::is_resolved()
{
  constexpr double least_range = 1e-9, apart_at_most = 0.02;
  double most = 0;
  follow_by_both(1, [&](long, const State& state, State& by_finer) {
    most = std::max(most, apart(machine_, state, by_finer));
    by_finer = state;
  });
  const double range = std::clamp(pair_.half_range() / length_, least_range, 1.0);
  if (!(most <= apart_at_most * range)) return false;
  return settled_.kind != Kind::quasi_periodic || base_.is_driven_twice() ||
         wobble_is_resolved();
}

/** Whether steps a quarter as long follow the points of the section over 32 base periods,
    to a tenth of the width that these take. Where the contact grazes, steps alone may
    keep up a small wobble of a motion that closes: shorter ones leave it by all of its
    width. */
bool Settling::wobble_is_resolved()
{
  constexpr int periods = 32;
  constexpr double largest_share = 0.1;
  double width = 0, most = 0;
  follow_by_both(periods, [&](long end, const State& state, const State& by_finer) {
    if (end % pair_.intervals() != 0) return;
    width = std::max(width, apart(machine_, state, settled_.at.state));
    most = std::max(most, apart(machine_, state, by_finer));
  });
  return most <= largest_share * width;
}

/** Whether the pair has forgotten where it came from. A motion that was chaotic before
    may be so again: its neighbours must meet twice as closely, if there is time. */
bool Settling::is_over() const
{
  constexpr double chaotic = 5;  // ln of the growth
  const bool is_twice = pair_.growth() > chaotic && pair_.seconds() < rule_.longest;
  return pair_.contraction() <= (is_twice ? 2 : 1) * forgotten;
}

/** What the pair says of the motion so far. */
Settled Settling::seen() const
{
  Settled s{.lyapunov = pair_.exponent(),
            .remainder = std::exp(std::max(-700.0, pair_.contraction())),
            .at = pair_.at(),
            .step = rule_.step,
            .before = pair_.since(nearer),
            .seconds = pair_.seconds()};
  /** What steps of RK4, or the longer ones of the splitting, change at most in the rate
      of what turns with the base period. */
  const double angle = 2 * std::numbers::pi * rule_.step / pair_.period();
  s.doubt = 3 * s.lyapunov.error + std::pow(angle, 5) / 120 / rule_.step;
  const double rate = s.lyapunov.value, doubt = s.doubt;
  const bool is_long = s.seconds > rule_.longest / 2;
  constexpr double least = 0.01;  // ln of a contraction that is one
  s.contracts = rate + doubt + least / s.seconds < 0;
  if (is_at_rest()) {
    s.kind = Kind::rest;
    return s;
  }
  if (closes(s)) return s;
  if (s.at.period < 0) return s;
  if (!(0.5 * s.seconds >= least_ * (1 - 1e-9)))
    s.reason = format("%.3g s are too short to tell", s.seconds);
  else if (rate > (is_long ? 1 : 2) * doubt && grows_throughout())
    s.kind = Kind::chaotic;
  else if (base_.is_driven_twice() && s.contracts)
    s.kind = is_over() ? Kind::quasi_periodic : Kind::undecided;
  else if (!base_.is_driven_twice() && std::abs(rate) <= doubt && doubt < 0.1 && is_long)
    s.kind = Kind::quasi_periodic;
  if (s.kind != Kind::undecided || !s.reason.empty()) return s;
  if (s.contracts && is_over())
    s.reason = format(
        "neighbours contract by %.3g/s, but the motion does not repeat itself within %d "
        "base periods",
        -rate, most_period);
  else if (s.contracts)
    s.reason = format(
        "neighbours contract by %.3g/s, but the transient is not over after %.3g s",
        -rate, s.seconds);
  else if (rate - doubt > 0)
    s.reason = format(
        "neighbours part by %.3g/s, but more and more slowly or too little in %.3g s to "
        "be called chaos",
        rate, s.seconds);
  else
    s.reason = format(
        "the growth rate of neighbours, %.2g +- %.1g/s, is not known well enough after "
        "%.3g s",
        rate, doubt, s.seconds);
  return s;
}

bool Settling::is_at_rest() const
{
  const State& state = pair_.at().state;
  const Eigen::VectorXd y = vector_of(state);
  const double speed = y.tail(y.size() / 2).cwiseAbs().maxCoeff();
  const double least = 1e-12 * length_;
  return pair_.half_range() < least && speed * pair_.period() < least;
}

/** Whether the section closes, and after how many base periods at the fewest. Where
    neighbours come nearer slowly, the motion is farther away than two points of its
    section are apart. A difference that alternates while it decays closes after two
    periods before it closes after one: K counts when all fewer periods leave the section
    much farther apart than what is left of the transient. */
bool Settling::closes(Settled& s) const
{
  constexpr double closed = 1e-6;  ///< spread of the section, over the vibration [-]
  constexpr double least_nearer = 1e-3, much_farther = 100;
  const auto& all = pair_.section();
  const double size = std::max(pair_.half_range(), 1e-9 * length_);
  const auto nearer_by = [&](int periods) {
    const double rate = std::min(0.0, s.lyapunov.value);
    return std::max(least_nearer, -std::expm1(rate * periods * pair_.period()));
  };
  const int k = closing_period(all, closed * size * nearer_by(1));
  /** Where two frequencies drive, a motion closes if no ball touches: after a turn. */
  if (k == 0 || (base_.is_driven_twice() && k > 1)) return false;
  const auto last = std::span(all).last(3 * k + 1);
  const double left = extent(last, k) / nearer_by(k);
  for (int fewer = 1; fewer < k; ++fewer)
    if (extent(last, fewer) < much_farther * left) return false;
  s.period = k;
  s.kind = Kind::periodic;
  s.before.period -= s.at.period;
  s.at.period = 0;
  return true;
}

/** Neighbours that part more and more slowly, or hardly in the last quarter, are on their
    way to a motion that is not chaotic. */
bool Settling::grows_throughout() const
{
  constexpr double least = 5;  // ln of the growth
  const auto& all = pair_.growths();
  const auto last = all.end() - std::ssize(all) / 4, before = last - std::ssize(all) / 4;
  return std::accumulate(last, all.end(), 0.0) >
         std::max(least, 0.5 * std::accumulate(before, last, 0.0));
}

/** Whether that takes at most so many evaluations, and no more than the budget has left;
    else the motion begins where it was reached. */
bool Settling::can_be_put_on_zero() const
{
  constexpr double most = 1e8, motions = 2;
  const double seconds = 2 * forgotten / settled_.lyapunov.value;
  return seconds * settled_.evaluations / (motions * settled_.seconds) <
         std::min(most, budget_.left());
}

/** A motion that has contracted after t = 0, put on t = 0: from its state so much earlier
    that the jump of the phases is forgotten. */
void Settling::put_on_zero()
{
  const double period = 2 * std::numbers::pi / omega_;
  const auto periods = [&](double logarithm) {
    return std::lround(std::ceil(logarithm / (settled_.lyapunov.value * period)));
  };
  to_zero_ = flow_of(rule_.step, 1);
  at_ = {settled_.at.state, -periods(2 * forgotten)};
  before_ = {settled_.at.state, -periods(nearer)};
}

/** From the start, with a quarter of the step. Throws NoSolution when a period would need
    too many of them. */
void Settling::begin_anew()
{
  rule_.is_fixed = true;  // from now on
  rule_.step /= 4;
  spent_beside_ += pair_.evaluations();
  periods_ = 0;
  began_ = -1;
  pair_ = pair_from_start();
}

/** The budget has ended, or the integration has broken down. */
void Settling::lost(std::exception_ptr why)
{
  if (!to_zero_ && !rule_.is_fixed && !budget_.used_up()) {
    try {
      return begin_anew();
    } catch (const NoSolution&) {
      why = std::current_exception();
    }
  }
  has_ended_ = true;
  if (to_zero_ && budget_.used_up()) return;  // the motion begins where it was reached
  if (!to_zero_) pair_.go_back();
  if (!budget_.used_up() || pair_.growths().empty()) {
    lost_ = why;
    return;
  }
  settled_ = seen();
  settled_.kind = Kind::undecided;
  settled_.period = 0;
  settled_.evaluations = spent_beside_ + pair_.evaluations();
  try {
    std::rethrow_exception(why);
  } catch (const NoSolution& ended) {
    settled_.reason = ended.what();
  }
}

const Settled& Settling::settled() const
{
  if (lost_) std::rethrow_exception(lost_);
  return settled_;
}

Settled settle(const Parameters& machine, double omega, const BasePeriod& base,
               const Instant& start, const SettleRule& rule,
               const OperationBudget& budget)
{
  Settling one(machine, omega, base, start, rule, budget);
  travel(std::vector<Traveller*>{&one});
  return one.settled();
}

}  // namespace rotor_stator
