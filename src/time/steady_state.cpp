#include "time/steady_state.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <numeric>

#include "io/errors.hpp"

namespace rotor_stator {

BatchMean batch_mean(const std::vector<double>& series, std::size_t most_batches)
{
  const std::size_t batches = std::min(most_batches, series.size());
  const auto count = static_cast<double>(series.size());
  const double mean = std::accumulate(series.begin(), series.end(), 0.0) / count;
  double squares = 0;
  for (std::size_t batch = 0; batch < batches; ++batch) {
    const std::size_t first = batch * series.size() / batches;
    const std::size_t last = (batch + 1) * series.size() / batches;
    double part = 0;
    for (std::size_t k = first; k < last; ++k)
      part += series[k] / static_cast<double>(last - first);
    squares += (part - mean) * (part - mean);
  }
  const auto n = static_cast<double>(batches * std::max<std::size_t>(1, batches - 1));
  return {mean, std::sqrt(squares / n)};
}

BatchMean long_mean(const std::vector<double>& series)
{
  BatchMean mean = batch_mean(series);
  mean.error = std::max(mean.error, batch_mean(series, 4).error);
  return mean;
}

/** Beyond this the section alone fills the memory. */
static constexpr double most_periods = 1e7;

double checked_period(double omega, double seconds)
{
  const double period = 2 * std::numbers::pi / omega;
  if (!std::isfinite(period))
    throw NoSolution("the period of rotation is too long to be integrated");
  if (!(seconds / period <= most_periods))
    throw NoSolution(
        format("%g s are more than %g periods of rotation", seconds, most_periods));
  return period;
}

namespace {

/** A motion in progress, with the last points of its Poincaré section. */
class Settling {
public:
  Settling(const Parameters& parameters, double omega, const State& start,
           const SteadySettings& settings)
      : stepper_(make_stepper(parameters, omega, settings.stepper)),
        intervals_(settings.stepper.intervals_per_period),
        cage_ratio_(parameters.bearing.cage_speed_ratio), state_(start)
  {
  }

  /** Whether the cage stands where it stood at t = 0. */
  bool cage_is_home() const
  {
    const double turns = cage_ratio_ * static_cast<double>(periods_);
    return std::abs(turns - std::round(turns)) < 1e-9;
  }

  /** One period; its states are added to `record` if there is one. */
  void advance_one_period(std::size_t window, std::vector<State>* record = nullptr)
  {
    section_.push_back(displacements(state_.position));
    if (section_.size() > window) section_.pop_front();
    size_ = 0;
    for (int k = 0; k < intervals_; ++k) {
      if (record) record->push_back(state_);
      for (double x : displacements(state_.position))
        size_ = std::max(size_, std::abs(x));
      stepper_.advance(periods_ * intervals_ + k, state_);
    }
    ++periods_;
    if (!vector_of(state_).allFinite())
      throw NoSolution(format("time integration diverged after %ld periods", periods_));
  }

  double spread() const { return size_ > 0 ? extent(section_) / size_ : 0; }
  long periods() const { return periods_; }
  long evaluations() const { return stepper_.evaluations(); }

private:
  TimeStepper stepper_;
  int intervals_;
  double cage_ratio_;
  State state_;
  long periods_ = 0;
  double size_ = 0;  ///< largest displacement of the last period [m]
  std::deque<Displacements> section_;
};

}  // namespace

SteadyState steady_state(const Parameters& parameters, double omega, const State& start,
                         const SteadySettings& settings)
{
  const double period =
      checked_period(omega, std::max(settings.window, settings.longest));
  const long window = std::max(4L, std::lround(std::ceil(settings.window / period)));
  const long most =
      std::max(2 * window, std::lround(std::ceil(settings.longest / period)));
  const auto section = static_cast<std::size_t>(window);
  Settling motion(parameters, omega, start, settings);
  std::vector<double> spreads;
  do {
    const long block = std::min(window, most - motion.periods());
    for (long k = 0; k < block; ++k) motion.advance_one_period(section);
    spreads.push_back(motion.spread());
  } while (motion.periods() < most && motion.spread() > settings.settled);

  /** The shown periods start with the cage at home, so that ball j is the ball j of t = 0; a cage
      that needs more than `most_home` periods has no such start within reach. */
  constexpr int most_home = 64;
  for (int k = 0; k < most_home && !motion.cage_is_home(); ++k)
    motion.advance_one_period(section);

  const bool periodic = motion.spread() < settings.periodic;
  const auto transient = std::ssize(spreads) / 2;
  SteadyState steady{.states = {},
                     .first_period = motion.periods(),
                     .spread = motion.spread(),
                     .spread_error = 0,
                     .periodic = periodic,
                     .seconds = static_cast<double>(motion.periods()) * period,
                     .evaluations = 0,
                     .omega = omega};
  long shown = settings.shown_periods;
  if (!periodic) shown = std::max(shown, std::lround(settings.average / period));
  for (long k = 1; k <= shown; ++k) {
    motion.advance_one_period(section, &steady.states);
    if (k % window == 0) spreads.push_back(motion.spread());
  }
  if (!periodic) {
    spreads.erase(spreads.begin(), spreads.begin() + transient);
    const BatchMean mean = long_mean(spreads);
    steady.spread = mean.value;
    steady.spread_error = mean.error;
  }
  steady.evaluations = motion.evaluations();
  return steady;
}

SteadySettings read_steady_settings(SceneFile& scene)
{
  SteadySettings settings;
  StrictToml table = scene.toml().table("time_integration");
  settings.stepper.method = table.string("method");
  const bool fixed_step = settings.stepper.method == "rk4";
  if (fixed_step) settings.stepper.step = table.number("step_s", Range::positive);
  if (!fixed_step)
    settings.stepper.tolerance = table.number("tolerance", Range::positive);
  settings.stepper.intervals_per_period = table.integer("points_per_period", 4, 4096);
  settings.longest = table.number("longest_s", Range::positive);
  settings.shown_periods = table.integer("shown_periods", 1, 1000);
  settings.average = table.number_or("average_s", Range::positive, 0);
  return settings;
}

SteadyState steady_state(const Parameters& parameters, double omega,
                         const SteadySettings& settings)
{
  return steady_state(parameters, omega, static_start(parameters), settings);
}

}  // namespace rotor_stator
