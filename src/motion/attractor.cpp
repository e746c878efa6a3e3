#include "motion/attractor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "balance/torus_line.hpp"
#include "io/errors.hpp"
#include "motion/other_starts.hpp"
#include "stability/floquet.hpp"
#include "stability/shooting.hpp"

namespace rotor_stator::motion {

double apart(const Parameters& parameters, const State& a, const State& b)
{
  return (vector_of(a) - vector_of(b))
      .cwiseQuotient(state_scales(parameters))
      .cwiseAbs()
      .maxCoeff();
}

namespace {

/** The fewest periods [s] that are not shorter than `seconds`, at least one. */
long periods_in(double seconds, double period)
{
  return std::max(1L, std::lround(std::ceil(seconds / period)));
}

/** A state after the transient, and the periods that it took. */
struct Forgotten {
  State state;
  long periods = 0;
};

/** Integrates block after block until the section closes, or is seen to stay open. Throws NoSolution when the
    integration diverges. */
Forgotten after_transient(const TimeStepper& stepper, const State& start, double size,
                          const VerdictRule& rule, long block, long most_blocks)
{
  constexpr double open = 1e-4;
  Forgotten at{start};
  std::vector<double> least;
  for (long blocks = 0; blocks < most_blocks; ++blocks) {
    std::vector<Displacements> section;
    for (long k = 0; k < block; ++k) {
      stepper.advance(at.periods++, at.state);
      if (k >= block - 3 * rule.most_period)
        section.push_back(displacements(at.state.position));
    }
    if (!vector_of(at.state).allFinite())
      throw NoSolution(format("time integration diverged after %ld periods", at.periods));
    least.push_back(judge_section(section, size, {}, rule).spread_k);
    if (least.back() <= rule.periodic) break;
    if (least.size() < 4) continue;
    /** Neither closed nor on the way to it over the last three blocks. */
    const auto [low, high] = std::minmax_element(least.end() - 3, least.end());
    if (*low > open && *low > 0.3 * *high && least.back() > 0.7 * *(least.end() - 3))
      break;
  }
  return at;
}

/** Sums and extremes of the displacements over instants. */
struct Statistics {
  double count = 0;
  Eigen::Array4d sum = Eigen::Array4d::Zero(), squares = sum;
  Eigen::Array4d low = Eigen::Array4d::Constant(1e300), high = -low;

  void add(const Statistics& other)
  {
    count += other.count;
    sum += other.sum;
    squares += other.squares;
    low = low.min(other.low);
    high = high.max(other.high);
  }
};

/** A motion observed after its transient. */
struct Observation {
  const AttractorSettings& settings;
  double period;    ///< of rotation [s]
  double smallest;  ///< size of a displacement that counts [m]
  long block;       ///< periods over which a growth rate is taken
  TrajectoryPair motion;
  std::vector<Displacements> section = {};
  std::vector<Statistics> periods = {};
  std::vector<double> rates = {};

  double seconds() const { return static_cast<double>(periods.size()) * period; }

  void add_block()
  {
    double growth = 0;
    for (long k = 0; k < block; ++k) {
      section.push_back(displacements(motion.state().position));
      Statistics& statistics = periods.emplace_back();
      growth += motion.advance_one_period([&](const State& state) {
        const Eigen::Array4d q(displacements(state.position).data());
        statistics.add({1, q, q * q, q, q});
      });
    }
    rates.push_back(growth / (static_cast<double>(block) * period));
  }

  /** The last points decide whether the section closes, the whole observation what the exponent is. */
  SectionJudgement judged() const
  {
    const auto window =
        static_cast<std::size_t>(std::max(block, 3L * settings.rule.most_period));
    const auto last = section.size() - std::min(section.size(), window);
    const double size = std::max(
        {smallest, -periods.back().low.minCoeff(), periods.back().high.maxCoeff()});
    return judge_section({section.begin() + static_cast<long>(last), section.end()}, size,
                         rates.size() < 2
                             ? Exponent{0, std::numeric_limits<double>::infinity()}
                             : batch_mean(rates),
                         settings.rule);
  }

  bool enough(const Attractor& attractor) const
  {
    if (rates.size() < 2 || section.size() < 4) return false;
    const double needed = attractor.closed() ? settings.least
                          : attractor.verdict == Verdict::chaotic ||
                                  (settings.rule.is_driven_twice && attractor.decided())
                              ? settings.chaotic
                              : settings.most;
    return seconds() >= needed * (1 - 1e-9);
  }

  /** Over the period of a closed motion, over all periods of another. */
  void summarise(Attractor& attractor) const
  {
    const auto count = attractor.closed() ? attractor.period : std::ssize(periods);
    Statistics all;
    for (auto one = periods.end() - count; one != periods.end(); ++one) all.add(*one);
    for (int i = 0; i < 4; ++i) {
      attractor.mean[i] = all.sum[i] / all.count;
      attractor.rms[i] = std::sqrt(std::max(
          0.0, all.squares[i] / all.count - attractor.mean[i] * attractor.mean[i]));
      attractor.amplitude[i] = 0.5 * (all.high[i] - all.low[i]);
    }
  }
};

}  // namespace

Attractor attractor_from(const Parameters& machine, double omega, const State& start,
                         const AttractorSettings& asked)
{
  AttractorSettings settings = asked;
  const int turns = turns_to_repeat(machine.bearing);
  settings.rule.is_driven_twice = turns == 0;
  const StepperSettings& stepper = settings.stepper;
  const double period = checked_period(omega, settings.longest + settings.most);
  const auto repeated = [&](long periods) {
    return turns > 1 ? (periods + turns - 1) / turns * turns : periods;
  };
  const long block = repeated(
      std::max(periods_in(settings.block, period), 3L * settings.rule.most_period));
  const Eigen::VectorXd sizes = state_scales(machine);
  const Forgotten settled = after_transient(
      make_stepper(machine, omega,
                   {.method = "rk4",
                    .intervals_per_period = 1,
                    .step = stepper.step > 0 ? stepper.step : default_step(machine),
                    .budget = stepper.budget}),
      start, sizes[0],
      {.periodic = settings.settled, .most_period = settings.rule.most_period}, block,
      periods_in(settings.longest / static_cast<double>(block), period));
  Observation seen{settings,
                   period,
                   1e-6 * sizes[0],
                   repeated(periods_in(settings.block, period)),
                   {make_stepper(machine, omega, stepper), stepper.intervals_per_period,
                    sizes, settled.state, turns == 1 ? 0 : settled.periods}};
  /** The first block turns the neighbour into the direction of fastest growth, and its rate is not
      used; then blocks until there is enough to judge by. */
  seen.add_block();
  seen.rates.clear();
  Attractor attractor{};
  do {
    const bool was_closed = attractor.closed();
    seen.add_block();
    static_cast<SectionJudgement&>(attractor) = seen.judged();
    /** What came before belongs to the transient. */
    if (attractor.closed() && !was_closed && seen.rates.size() > 1) seen.rates.clear();
  } while (!seen.enough(attractor));
  seen.summarise(attractor);
  attractor.state = seen.motion.state();
  attractor.first_period = turns == 1 ? 0 : settled.periods + std::ssize(seen.periods);
  return attractor;
}

Motion motion_along(const Attractor& attractor, const Parameters& machine, double omega,
                    int points_per_period, int periods, const OperationBudget& budget)
{
  const TimeStepper stepper = make_stepper(
      machine, omega,
      {.method = "rk4", .intervals_per_period = points_per_period, .budget = budget});
  State state = attractor.state;
  Motion motion = recorded(stepper, points_per_period, state, attractor.first_period,
                           attractor.closed() ? attractor.period : periods);
  motion.omega = omega;
  return motion;
}

Exponent closed_exponent(const Attractor& attractor, const Parameters& machine,
                         double omega, const OperationBudget& budget)
{
  constexpr double local_error = 1e-11, finer = 1e-13, near = 1e-3;
  const Parameters turned = over_turns(machine, attractor.period);
  omega /= attractor.period;
  State state = attractor.state;
  const Shooting shooting = shoot(turned, omega, state,
                                  {.tolerance = local_error,
                                   .periodicity_residual = 1e-9,
                                   .final_derivative = false,
                                   .budget = budget});
  if (!shooting.converged || apart(machine, state, attractor.state) > near)
    throw NoSolution("shooting did not close the motion: " + shooting.reason);
  const auto maps = period_map_twice(turned, omega, state, local_error, finer, budget);
  const auto largest = [](const PeriodMap& map) {
    return std::abs(multipliers_of(map.derivative).front());
  };
  const double first = largest(maps.first), second = largest(maps.finer);
  const double change = std::abs(second - first);
  if (!(second > 10 * (change + std::numeric_limits<double>::epsilon())))
    throw NoSolution(format("the multiplier %g is known to %g only", second, change));
  const double period = 2 * std::numbers::pi / omega;
  return {std::log(second) / period, std::abs(std::log(second / first)) / period};
}

bool same_attractor(const Attractor& a, const Attractor& b,
                    const AttractorSettings& settings)
{
  if (a.closed() != b.closed()) return false;
  if (a.decided() && b.decided() && a.verdict != b.verdict) return false;
  if (a.closed() && a.period != b.period) return false;
  double apart = 0, size = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    apart =
        std::max({apart, std::abs(a.mean[i] - b.mean[i]), std::abs(a.rms[i] - b.rms[i])});
    size = std::max({size, a.rms[i], b.rms[i]});
  }
  return apart <= size * (a.closed() ? settings.same_periodic : settings.same_aperiodic);
}

State random_state(const Parameters& machine, double omega, std::uint64_t seed)
{
  std::mt19937_64 generator(seed);
  const auto random = [&] { return 2 * uniform(generator); };
  const double joined = std::abs(dynamic_stiffness(machine.stator, omega).value +
                                 dynamic_stiffness(machine.rotor, omega).value);
  const double amplitude = machine.unbalance * omega * omega / joined;
  const Eigen::VectorXd scales = state_scales(machine);
  Eigen::VectorXd y = vector_of(static_start(machine));
  const Eigen::Index speeds = y.size() / 2;
  for (int i = 0; i < 2; ++i) {
    const double position = random() * amplitude, speed = random() * amplitude * omega;
    for (int body : {0, 2}) {
      y[body + i] += position;
      y[speeds + body + i] += speed;
    }
    y[2 + i] += random() * scales[2 + i];
    y[speeds + 2 + i] += random() * scales[speeds + 2 + i];
  }
  return rotor_stator::state_of(y);
}

}  // namespace rotor_stator::motion
