#include "time/steady_state.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "io/errors.hpp"
#include "io/scene_file.hpp"
#include "time/section.hpp"

namespace rotor_stator {

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

SteadyState steady_state(const Parameters& parameters, double omega, const State& start,
                         const SteadySettings& settings)
{
  const double period =
      checked_period(omega, std::max(settings.window, settings.longest));
  const long window = std::max(4L, std::lround(std::ceil(settings.window / period)));
  const long most =
      std::max(2 * window, std::lround(std::ceil(settings.longest / period)));
  const int intervals = settings.stepper.intervals_per_period;
  const auto steps = flow(parameters, omega, settings.stepper);
  SteadyState steady{.omega = omega};
  State state = start;
  std::vector<Displacements> section;
  double size = 0;  // largest displacement of the last period
  const auto periods = [&] { return std::ssize(section); };
  const auto advance_one_period = [&](bool is_shown) {
    const long first = periods() * intervals;
    section.push_back(displacements(state.position));
    size = 0;
    for (long k = first; k < first + intervals; ++k) {
      if (is_shown) steady.states.push_back(state);
      for (double x : displacements(state.position)) size = std::max(size, std::abs(x));
      steps->advance(k, state);
    }
    if (!vector_of(state).allFinite())
      throw NoSolution(
          format("time integration diverged after %ld periods", long{periods()}));
  };
  const auto spread = [&] {
    const auto last = std::min<long>(window, periods());
    const auto latest = std::span(section).last(static_cast<std::size_t>(last));
    return size > 0 ? extent(latest) / size : 0;
  };

  std::vector<double> spreads;
  do {
    const long block = std::min<long>(window, most - periods());
    for (long k = 0; k < block; ++k) advance_one_period(false);
    spreads.push_back(spread());
  } while (periods() < most && spreads.back() > settings.settled);

  /** The shown periods start with the cage at home, where it stood at t = 0, so that ball
      j is the ball j of t = 0; a cage that needs more than `most_home` periods has no
      such start within reach. */
  constexpr int most_home = 64;
  const auto cage_is_home = [&] {
    const double turns =
        parameters.bearing.cage_speed_ratio * static_cast<double>(periods());
    return std::abs(turns - std::round(turns)) < 1e-9;
  };
  for (int k = 0; k < most_home && !cage_is_home(); ++k) advance_one_period(false);

  steady.first_period = periods();
  steady.spread = spread();
  steady.periodic = steady.spread < settings.periodic;
  steady.seconds = static_cast<double>(periods()) * period;
  const auto transient = std::ssize(spreads) / 2;
  long shown = settings.shown_periods;
  if (!steady.periodic) shown = std::max(shown, std::lround(settings.average / period));
  for (long k = 1; k <= shown; ++k) {
    advance_one_period(true);
    if (k % window == 0) spreads.push_back(spread());
  }
  if (!steady.periodic) {
    const BatchMean mean = long_mean({spreads.begin() + transient, spreads.end()});
    steady.spread = mean.value;
    steady.spread_error = mean.error;
  }
  steady.evaluations = steps->evaluations();
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
