#include "time/steady_state.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "io/errors.hpp"
#include "io/toml_file.hpp"
#include "time/side_by_side.hpp"

namespace rotor_stator {

namespace {

/** The period T [s]. Throws NoSolution unless `seconds` of it can be integrated. */
double checked_period(double omega, double seconds)
{
  constexpr double most_periods = 1e7;  // beyond this the section alone fills the memory
  const double period = 2 * std::numbers::pi / omega;
  if (!std::isfinite(period))
    throw NoSolution("the period of rotation is too long to be integrated");
  if (!(seconds / period <= most_periods))
    throw NoSolution(
        format("%g s are more than %g periods of rotation", seconds, most_periods));
  return period;
}

/** One run, base period after base period. */
class Steadying : public Traveller {
public:
  using Ended = std::function<void(SteadyState)>;
  Steadying(const SteadyRun& run, Ended ended)
      : run_(run), ended_(std::move(ended)), state_(run.start),
        period_(checked_period(run.omega,
                               std::max(run.settings.window, run.settings.longest))),
        window_(std::max(4L, std::lround(std::ceil(run.settings.window / period_)))),
        most_(std::max(2 * window_,
                       std::lround(std::ceil(run.settings.longest / period_)))),
        flow_(flow(run.parameters, run.omega, run.settings.stepper)),
        left_(window_), steady_{.omega = run.omega}
  {
  }

  void next(std::vector<Passage>& all) override
  {
    if (phase_ == Phase::ended) return;
    const int intervals = run_.settings.stepper.intervals_per_period;
    path_.assign(1, state_);
    all.push_back({flow_.get(), periods() * intervals, &state_, intervals, &path_});
  }

  void arrived() override
  {
    add_period();
    --left_;
    switch (phase_) {
      case Phase::settling: return settle();
      case Phase::going_home: return go_home();
      case Phase::shown: return show();
      case Phase::ended: break;
    }
  }

  void lost(std::exception_ptr why) override { std::rethrow_exception(why); }

private:
  enum class Phase { settling, going_home, shown, ended };

  long periods() const { return std::ssize(section_); }

  void add_period()
  {
    section_.push_back(displacements(path_.front().position));
    path_.pop_back();  // the first instant of the next one
    size_ = 0;
    for (const State& state : path_)
      for (const double x : displacements(state.position))
        size_ = std::max(size_, std::abs(x));
    if (phase_ == Phase::shown)
      steady_.states.insert(steady_.states.end(), path_.begin(), path_.end());
    if (!vector_of(state_).allFinite())
      throw NoSolution(format("time integration diverged after %ld periods", periods()));
  }

  double spread() const
  {
    const auto last = static_cast<std::size_t>(std::min(window_, periods()));
    return size_ > 0 ? extent(std::span(section_).last(last)) / size_ : 0;
  }

  void settle()
  {
    if (left_ > 0) return;
    spreads_.push_back(spread());
    left_ = std::min(window_, most_ - periods());
    if (left_ > 0 && spreads_.back() > run_.settings.settled) return;
    phase_ = Phase::going_home;
    left_ = most_home;
    go_home();
  }

  /** The shown periods start with the cage at home, where it stood at t = 0, so that ball
      j is the ball j of t = 0; a cage that needs more than `most_home` periods has no
      such start within reach. */
  void go_home()
  {
    const double turns =
        run_.parameters.bearing.cage_speed_ratio * static_cast<double>(periods());
    if (left_ > 0 && !(std::abs(turns - std::round(turns)) < 1e-9)) return;
    steady_.first_period = periods();
    steady_.spread = spread();
    steady_.periodic = steady_.spread < run_.settings.periodic;
    steady_.seconds = static_cast<double>(periods()) * period_;
    transient_ = std::ssize(spreads_) / 2;
    left_ = run_.settings.shown_periods;
    if (!steady_.periodic)
      left_ = std::max(left_, std::lround(run_.settings.average / period_));
    phase_ = Phase::shown;
  }

  void show()
  {
    if ((periods() - steady_.first_period) % window_ == 0) spreads_.push_back(spread());
    if (left_ > 0) return;
    if (!steady_.periodic) {
      const BatchMean mean = long_mean({spreads_.begin() + transient_, spreads_.end()});
      steady_.spread = mean.value;
      steady_.spread_error = mean.error;
    }
    steady_.evaluations = flow_->evaluations();
    phase_ = Phase::ended;
    path_ = {};
    section_ = {};
    ended_(std::move(steady_));
  }

  static constexpr long most_home = 64;
  const SteadyRun& run_;
  Ended ended_;
  State state_;
  double period_;
  long window_, most_;  ///< base periods
  std::unique_ptr<Flow> flow_;
  Phase phase_ = Phase::settling;
  long left_;  ///< base periods, until what the phase waits for
  std::vector<State> path_;
  std::vector<Displacements> section_;
  double size_ = 0;  ///< the largest displacement of the last period [m]
  std::vector<double> spreads_;
  std::ptrdiff_t transient_ = 0;  ///< of the spreads
  SteadyState steady_;
};

}  // namespace

void steady_states(std::span<const SteadyRun> runs,
                   const std::function<void(std::size_t, SteadyState)>& ended)
{
  std::vector<std::unique_ptr<Steadying>> all;
  std::vector<Traveller*> travellers;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    all.push_back(std::make_unique<Steadying>(
        runs[k], [&ended, k](SteadyState steady) { ended(k, std::move(steady)); }));
    travellers.push_back(all.back().get());
  }
  travel(travellers);
}

SteadyState steady_state(const Parameters& parameters, double omega,
                         const SteadySettings& settings)
{
  SteadyState steady;
  const SteadyRun run{parameters, omega, static_start(parameters), settings};
  steady_states({&run, 1},
                [&](std::size_t, SteadyState one) { steady = std::move(one); });
  return steady;
}

SteadySettings read_steady_settings(SceneFile& scene)
{
  SteadySettings settings;
  StrictToml table = scene.toml().table("time_integration");
  settings.stepper.method = table.string("method");
  if (has_fixed_step(settings.stepper.method))
    settings.stepper.step =
        table.number("step_s", Range::positive) / steps_of_rk4(settings.stepper.method);
  else
    settings.stepper.tolerance = table.number("tolerance", Range::positive);
  settings.stepper.intervals_per_period = table.integer("points_per_period", 4, 4096);
  settings.longest = table.number("longest_s", Range::positive);
  settings.shown_periods = table.integer("shown_periods", 1, 1000);
  settings.average = table.number_or("average_s", Range::positive, 0);
  return settings;
}

}  // namespace rotor_stator
