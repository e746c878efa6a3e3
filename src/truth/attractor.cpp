#include "truth/attractor.hpp"

#include <cmath>
#include <numbers>

#include "io/errors.hpp"
#include "motion/other_starts.hpp"

namespace rotor_stator::truth {

AttractorSettings read_attractor_settings(StrictToml table)
{
  const VerdictRule rule{.periodic = table.number("periodic", Range::positive),
                         .most_period = table.integer("most_period", 1, 1000),
                         .zero_rate = table.number("zero_rate_per_s", Range::positive)};
  const int points = table.integer("points_per_period", 4, 4096);
  return {.transient = {.stepper = {.method = "rk4", .intervals_per_period = points},
                        .settled = table.number("settled", Range::positive),
                        .periodic = rule.periodic,
                        .longest = table.number("longest_transient_s", Range::positive)},
          .block = table.number("block_s", Range::positive),
          .least = table.number("least_s", Range::positive),
          .chaotic = table.number("chaotic_s", Range::positive),
          .most = table.number("most_s", Range::positive),
          .rule = rule,
          .same_periodic = table.number("same_periodic", Range::positive),
          .same_aperiodic = table.number("same_aperiodic", Range::positive)};
}

namespace {

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
  double period;  ///< of rotation [s]
  TrajectoryPair motion;
  std::vector<Displacements> section = {};
  std::vector<Statistics> periods = {};
  std::vector<double> rates = {};

  double seconds() const { return static_cast<double>(periods.size()) * period; }

  void add_block()
  {
    const int count = static_cast<int>(std::ceil(settings.block / period));
    double growth = 0;
    for (int k = 0; k < count; ++k) {
      section.push_back(displacements(motion.state().position));
      Statistics& statistics = periods.emplace_back();
      growth += motion.advance_one_period([&](const State& state) {
        const Eigen::Array4d q(displacements(state.position).data());
        statistics.add({1, q, q * q, q, q});
      });
    }
    rates.push_back(growth / (count * period));
  }

  /** The last points decide whether the section closes, the whole observation what the exponent is. */
  SectionJudgement judged() const
  {
    const auto window = static_cast<std::size_t>(std::max(
        std::ceil(settings.transient.window / period), 3.0 * settings.rule.most_period));
    const auto last = section.size() - std::min(section.size(), window);
    const double size =
        std::max(-periods.back().low.minCoeff(), periods.back().high.maxCoeff());
    return judge_section({section.begin() + static_cast<long>(last), section.end()}, size,
                         rates.size() < 2
                             ? Exponent{0, std::numeric_limits<double>::infinity()}
                             : batch_mean(rates),
                         settings.rule);
  }

  bool enough(const Attractor& attractor) const
  {
    if (rates.size() < 2 || section.size() < 4) return false;
    const double needed = attractor.closed()                      ? settings.least
                          : attractor.verdict == Verdict::chaotic ? settings.chaotic
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
                         const AttractorSettings& settings)
{
  if (!has_rotation_period(machine.bearing))
    throw NoSolution("attractors: the bearing's force has not the period of rotation");
  const SteadyState steady = steady_state(machine, omega, start, settings.transient);
  const auto& stepper = settings.transient.stepper;
  Observation seen{settings,
                   2 * std::numbers::pi / omega,
                   {make_stepper(machine, omega, stepper), stepper.intervals_per_period,
                    state_scales(machine), steady.states.front()}};
  /** The first block turns the neighbour into the direction of fastest growth, and its rate is not
      used; then blocks until there is enough to judge by. */
  seen.add_block();
  seen.rates.clear();
  Attractor attractor{};
  do {
    seen.add_block();
    static_cast<SectionJudgement&>(attractor) = seen.judged();
  } while (!seen.enough(attractor));
  seen.summarise(attractor);
  attractor.state = seen.motion.state();
  attractor.seconds = seen.seconds() + steady.seconds;
  return attractor;
}

bool same_attractor(const Attractor& a, const Attractor& b,
                    const AttractorSettings& settings)
{
  if (a.closed() != b.closed()) return false;
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
  const auto random = [&] { return 2 * motion::uniform(generator); };
  const double joined = std::abs(dynamic_stiffness(machine.stator, omega).value +
                                 dynamic_stiffness(machine.rotor, omega).value);
  const double amplitude = machine.unbalance * omega * omega / joined;
  const Vector8 scales = state_scales(machine);
  Vector8 y = vector_of(static_start(machine));
  for (int i = 0; i < 2; ++i) {
    const double position = random() * amplitude, speed = random() * amplitude * omega;
    for (int body : {0, 2}) {
      y[body + i] += position;
      y[4 + body + i] += speed;
    }
    y[2 + i] += random() * scales[2 + i];
    y[6 + i] += random() * scales[6 + i];
  }
  return state_of(y);
}

}  // namespace rotor_stator::truth
