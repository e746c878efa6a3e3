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
class Observation {
public:
  Observation(const Parameters& machine, double omega, const State& start,
              const AttractorSettings& settings)
      : settings_(settings),
        period_(2 * std::numbers::pi / omega),
        motion_(make_stepper(machine, omega, settings.transient.stepper),
                settings.transient.stepper.intervals_per_period, state_scales(machine),
                start)
  {
  }

  /** Blocks until there is enough to judge by. The first block turns the neighbour into the
      direction of fastest growth, and its rate is not used. */
  Attractor run()
  {
    add_block();
    rates_.clear();
    SectionJudgement judgement;
    do {
      add_block();
      judgement = judged();
    } while (!enough(judgement));
    return summary(judgement);
  }

private:
  void add_block()
  {
    const int count = static_cast<int>(std::ceil(settings_.block / period_));
    double growth = 0;
    for (int k = 0; k < count; ++k) {
      section_.push_back(displacements(motion_.state().position));
      Statistics statistics;
      growth += motion_.advance_one_period([&](const State& state) {
        const Eigen::Array4d q(displacements(state.position).data());
        statistics.add({1, q, q * q, q, q});
      });
      periods_.push_back(statistics);
    }
    rates_.push_back(growth / (count * period_));
  }

  double seconds() const { return static_cast<double>(periods_.size()) * period_; }

  /** The last points decide whether the section closes, the whole observation what the exponent is. */
  SectionJudgement judged() const
  {
    const auto window =
        static_cast<std::size_t>(std::max(std::ceil(settings_.transient.window / period_),
                                          3.0 * settings_.rule.most_period));
    const auto last = section_.size() - std::min(section_.size(), window);
    const std::vector<Displacements> section(section_.begin() + static_cast<long>(last),
                                             section_.end());
    const double size =
        std::max(-periods_.back().low.minCoeff(), periods_.back().high.maxCoeff());
    const Exponent exponent = rates_.size() < 2
                                  ? Exponent{0, std::numeric_limits<double>::infinity()}
                                  : batch_mean(rates_);
    return judge_section(section, size, exponent, settings_.rule);
  }

  bool enough(const SectionJudgement& judgement) const
  {
    if (rates_.size() < 2 || section_.size() < 4) return false;
    const Verdict verdict = judgement.verdict;
    const bool closed = verdict == Verdict::periodic || verdict == Verdict::subharmonic;
    const double needed = closed                        ? settings_.least
                          : verdict == Verdict::chaotic ? settings_.chaotic
                                                        : settings_.most;
    return seconds() >= needed * (1 - 1e-9);
  }

  /** Over the period of a closed motion, over all periods of another. */
  Attractor summary(const SectionJudgement& judgement) const
  {
    Attractor attractor{judgement, {}, {}, {}, motion_.state(), seconds()};
    const auto count = attractor.closed() ? judgement.period : std::ssize(periods_);
    Statistics all;
    for (auto period = periods_.end() - count; period != periods_.end(); ++period)
      all.add(*period);
    for (int i = 0; i < 4; ++i) {
      attractor.mean[i] = all.sum[i] / all.count;
      attractor.rms[i] = std::sqrt(std::max(
          0.0, all.squares[i] / all.count - attractor.mean[i] * attractor.mean[i]));
      attractor.amplitude[i] = 0.5 * (all.high[i] - all.low[i]);
    }
    return attractor;
  }

  const AttractorSettings& settings_;
  double period_;
  TrajectoryPair motion_;
  std::vector<Displacements> section_;
  std::vector<Statistics> periods_;
  std::vector<double> rates_;
};

}  // namespace

Attractor attractor_from(const Parameters& machine, double omega, const State& start,
                         const AttractorSettings& settings)
{
  if (!has_rotation_period(machine.bearing))
    throw NoSolution("attractors: the bearing's force has not the period of rotation");
  const SteadyState steady = steady_state(machine, omega, start, settings.transient);
  Attractor attractor =
      Observation(machine, omega, steady.states.front(), settings).run();
  attractor.seconds += steady.seconds;
  return attractor;
}

bool same_attractor(const Attractor& a, const Attractor& b,
                    const AttractorSettings& settings)
{
  if (a.closed() != b.closed()) return false;
  if (a.closed() && a.judgement.period != b.judgement.period) return false;
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
