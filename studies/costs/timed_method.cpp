#include "costs/timed_method.hpp"

#include <time.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <ranges>

#include "balance/bearing_problem.hpp"
#include "balance/fourier_transform.hpp"
#include "balance/newton.hpp"
#include "continuation/sweep.hpp"
#include "io/errors.hpp"
#include "model/rotor_stator.hpp"
#include "time/fixed_step.hpp"
#include "time/shooting.hpp"
#include "time/side_by_side.hpp"

namespace rotor_stator::costs {

std::string Setting::stepper() const
{
  if (is_ensemble()) return method.substr(0, method.find("-lanes"));
  return is_shooting() ? method.substr(method.find('-') + 1) : method;
}

int Setting::sample_count() const
{
  return samples > 0 ? samples
                     : fast_transform_size(std::max(
                           2 * harmonics + 2, samples_per_harmonic * harmonics + 1));
}

std::string Schedule::text() const
{
  std::string words;
  const auto add = [&](const std::string& before, auto part, const char* after = "") {
    const auto [least, most] =
        std::ranges::minmax(std::views::transform(settings_, part));
    if (most <= 0) return;
    words += (words.empty() ? "" : " ") + before + format("%g", 1.0 * least);
    if (least < most) words += format("..%g", 1.0 * most);
    words += after;
  };
  add("m=", &Setting::harmonics);
  add("N>", &Setting::samples_per_harmonic, "m");
  add("step=", &Setting::step);
  add("tol=", &Setting::tolerance);
  add("transient=", &Setting::transient);
  add("closure=", &Setting::periodicity_residual);
  return words;
}

/** A group for each number of harmonics and each start: which is cheaper depends on the
    speeds. */
static std::vector<SettingGroup> balances(StrictToml table)
{
  const auto transients = table.numbers("transients_s", Range::not_negative);
  const auto per_harmonic = table.integers("samples_per_harmonic", 2, 64);
  const auto tolerances = table.numbers("newton_tolerances", Range::positive);
  std::vector<SettingGroup> groups;
  for (int harmonics : table.integers("harmonics", 1, 4096))
    for (double transient : transients) {
      SettingGroup& group = groups.emplace_back();
      for (int samples : per_harmonic)
        for (double tolerance : tolerances)
          group.push_back({.method = "aft",
                           .harmonics = harmonics,
                           .samples_per_harmonic = samples,
                           .tolerance = tolerance,
                           .transient = transient});
    }
  return groups;
}

/** A group for each step or local error. */
static std::vector<SettingGroup> integrations(StrictToml table, const std::string& method)
{
  const Setting plain{.method = method};
  const bool fixed_step = has_fixed_step(plain.stepper()) || method == "central";
  const auto transients = table.numbers("transients_s", Range::positive);
  const auto residuals = plain.is_shooting() ? table.numbers("closures", Range::positive)
                                             : std::vector<double>{0};
  std::vector<SettingGroup> groups;
  for (double accuracy :
       table.numbers(fixed_step ? "steps_s" : "tolerances", Range::positive)) {
    SettingGroup& group = groups.emplace_back();
    for (double residual : residuals)
      for (double transient : transients) {
        Setting& one = group.emplace_back(plain);
        (fixed_step ? one.step : one.tolerance) = accuracy;
        one.periodicity_residual = residual;
        one.transient = transient;
      }
  }
  return groups;
}

std::vector<Candidates> read_candidates(StrictToml& toml)
{
  std::vector<std::string> known{"aft"};
  known.insert(known.end(), time_methods().begin(), time_methods().end());
  known.insert(known.end(), {"rk4-lanes", "splitting-lanes", "central", "shooting-rk4",
                             "shooting-rk8"});
  std::vector<Candidates> all;
  for (const std::string& method : toml.strings("methods")) {
    if (std::ranges::find(known, method) == known.end())
      toml.fail("methods", "must be some of " + joined(known, ", "));
    StrictToml table = toml.table(method);
    all.push_back(
        {method, method == "aft" ? balances(table) : integrations(table, method)});
  }
  return all;
}

static double thread_cpu_seconds()
{
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

CpuTime time_of(int repetitions, const std::function<void()>& work)
{
  std::vector<double> seconds;
  for (int k = 0; k < repetitions; ++k) {
    const double start = thread_cpu_seconds();
    work();
    seconds.push_back(thread_cpu_seconds() - start);
  }
  std::sort(seconds.begin(), seconds.end());
  return {seconds[seconds.size() / 2], seconds.front(), seconds.back()};
}

void TimedMethod::begin()
{
  counts_ = {};
  state_ = task_.before ? task_.before->state : static_start(task_.parameters);
}

void TimedMethod::run()
{
  begin();
  for (std::size_t k = 0; k < task_.frequencies.size(); ++k) solve(k);
}

std::vector<double> TimedMethod::seconds_by_speed()
{
  std::vector<double> seconds;
  for (std::size_t k = 0; k < task_.frequencies.size(); ++k) {
    const auto one = [&] {
      if (k == 0) begin();
      solve(k);
    };
    seconds.push_back(time_of(1, one).median);
  }
  return seconds;
}

std::unique_ptr<Flow> TimedMethod::stepper(std::size_t speed, int intervals) const
{
  const double omega = angular(task_.frequencies[speed]);
  const Setting& setting = schedule_.at(speed);
  if (setting.method == "central") {
    require_bearing_of(setting.method, task_.parameters);
    return std::make_unique<FixedStep>(task_.parameters, omega, intervals, setting.step,
                                       Rule::central);
  }
  const std::string method = setting.stepper();
  return flow(task_.parameters, omega,
              {.method = method,
               .intervals_per_period = intervals,
               .step = setting.step / steps_of_rk4(method),
               .tolerance = setting.tolerance});
}

/** The fewest that last so many seconds. */
static long whole_periods(double seconds, double omega)
{
  return std::lround(std::ceil(seconds * omega / (2 * std::numbers::pi) - 1e-9));
}

long TimedMethod::advance(Flow& whole, double seconds, double omega)
{
  const long before = whole.evaluations();
  const long periods = whole_periods(seconds, omega);
  for (long k = 0; k < periods; ++k) whole.advance(k, state_);
  counts_.force_instants += whole.evaluations() - before;
  return periods;
}

namespace {

class BalanceSweep : public TimedMethod {
public:
  BalanceSweep(const Task& task, const Schedule& schedule) : TimedMethod(task, schedule)
  {
    if (!task.before) return;
    begin();
    PeriodicMotion known{.omega = angular(task.before->frequency)};
    if (finds(known)) before_ = known.x;
  }

  std::optional<motion::Motion> motion(std::size_t speed, int points) const override
  {
    if (bodies_[speed].size() == 0) return {};
    return motion::motion_of(bodies_[speed], points);
  }

  Counts counts() const override
  {
    Counts counts = counts_;
    for (const auto& [size, one] : balances_) {
      const long evaluations = one->balance.evaluations();
      counts.force_instants += evaluations * size.second;
      counts.transforms +=
          4 * (evaluations + one->solver.factorisations() + one->solver.iterations());
    }
    return counts;
  }

private:
  struct Solved {
    Balance balance;
    BalanceSolver solver{balance};  ///< keeps its factors from speed to speed
  };

  void begin() override
  {
    TimedMethod::begin();
    bodies_.assign(task_.frequencies.size(), {});
    balances_.clear();
    const ArcLengthSettings settings = arc_length_settings(task_.parameters);
    predictor_ = {settings.arc_unknown_scale, settings.speed_scale};
    if (before_.size() > 0) predictor_.add(before_, angular(task_.before->frequency));
    setting_ = schedule_.at(0);
    if (!setting_.paper_sweep) return;
    /** The paper's sweep goes over all speeds at once. */
    const auto found = sweep(task_.parameters, angular(task_.frequencies),
                             setting_.harmonics, setting_.sample_count());
    for (std::size_t k = 0; k < found.size(); ++k) {
      bodies_[k] = found[k].bodies;
      counts_.force_instants += found[k].force_samples;
    }
  }

  void solve(std::size_t speed) override
  {
    if (setting_.paper_sweep) return;
    setting_ = schedule_.at(speed);
    PeriodicMotion found{.omega = angular(task_.frequencies[speed])};
    if (!finds(found)) return;
    predictor_.add(found.x, found.omega);
    bodies_[speed] = body_series(task_.parameters, found);
  }

  /** The balance of this m and N. */
  Solved& solved()
  {
    auto& one = balances_[{setting_.harmonics, setting_.sample_count()}];
    if (one) return *one;
    Problem problem = bearing_problem(task_.parameters, setting_.sample_count());
    if (task_.profiled)
      problem.force = [inner = problem.force, &seconds = counts_.force_seconds](
                          const auto& q, auto&&... results) {
        const double start = thread_cpu_seconds();
        inner(q, results...);
        seconds += thread_cpu_seconds() - start;
      };
    one.reset(new Solved{Balance(std::move(problem), setting_.harmonics)});
    return *one;
  }

  bool finds(PeriodicMotion& found)
  {
    constexpr int few = 12;
    Solved& one = solved();
    /** A new start is cheaper than a long iteration. */
    const NewtonSettings newton{
        .tolerance = setting_.tolerance, .most_iterations = 12, .most_halvings = 4};
    const auto from = [&](Eigen::VectorXd x) {
      found.x = resize_harmonics(std::move(x), 2, setting_.harmonics);
      return rotor_stator::solve(one.balance, one.solver, found, newton);
    };
    if (setting_.transient > 0 && from(integrated(found.omega, setting_.transient)))
      return true;
    if (!predictor_.empty() && from(predictor_.at_speed(found.omega))) return true;
    if (setting_.harmonics <= few &&
        from(quasi_static_start(task_.parameters, found.omega, setting_.harmonics)))
      return true;
    for (double seconds : {0.5, 1.0, 2.0})
      if (from(integrated(found.omega, seconds))) return true;
    return false;
  }

  /** The period after so many seconds of RK4, with steps that are too long for a result
      but not unstable. It goes on from where it ended last. */
  Eigen::VectorXd integrated(double omega, double seconds)
  {
    const Parameters& p = task_.parameters;
    const int points = 2 * setting_.harmonics + 2;
    const double step = (p.bearing.damping > 0 ? 5 : 8) * default_step(p);
    const auto rk4 = [&](int intervals) {
      return flow(p, omega,
                  {.method = "rk4", .intervals_per_period = intervals, .step = step});
    };
    advance(*rk4(1), seconds, omega);
    const auto parts = rk4(points);
    const motion::Motion last = motion::recorded(*parts, points, state_);
    counts_.force_instants += parts->evaluations();
    if (vector_of(state_).allFinite())
      return motion::relative_series(p, last, setting_.harmonics);
    state_ = static_start(p);
    return quasi_static_start(p, omega, setting_.harmonics);
  }

  Setting setting_;         ///< of the speed at hand
  Eigen::VectorXd before_;  ///< the solution that is known, if any
  std::map<std::pair<int, int>, std::unique_ptr<Solved>> balances_;  ///< by m and N
  LagrangePredictor predictor_{1, 1};
  std::vector<Eigen::MatrixXd> bodies_;  ///< series found, by speed
};

/** Time integration and shooting end in a state at each speed; one period from it, by the
    same method at the same setting, is the motion. */
class Integration : public TimedMethod {
protected:
  using TimedMethod::TimedMethod;

  std::optional<motion::Motion> motion(std::size_t speed, int points) const override
  {
    if (!reached_[speed]) return {};
    auto [periods, state] = *reached_[speed];
    try {
      return motion::recorded(*stepper(speed, points), points, state, periods);
    } catch (const NoSolution&) {
      return {};  // the state was no motion
    }
  }

  void begin() override
  {
    TimedMethod::begin();
    reached_.assign(task_.frequencies.size(), {});
  }

  /** A transient at each speed. */
  void solve(std::size_t speed) override
  {
    const double omega = angular(task_.frequencies[speed]);
    const Setting& setting = schedule_.at(speed);
    try {
      const long periods = advance(*stepper(speed, 1), setting.transient, omega);
      reached_[speed] = {periods, state_};
      if (setting.recorded == 0) return;
      const auto parts = stepper(speed, setting.recorded);
      motion::recorded(*parts, setting.recorded, state_, periods);
      counts_.force_instants += parts->evaluations();
    } catch (const NoSolution&) {
      state_ = static_start(task_.parameters);
    }
  }

  /** A state of the motion at phase 0, so many periods after t = 0. */
  std::vector<std::optional<std::pair<long, State>>> reached_;
};

/** Newton on the period map at each speed. */
class ShootingSweep : public Integration {
  using Integration::Integration;

  void begin() override
  {
    Integration::begin();
    predictor_ = {1, arc_length_settings(task_.parameters).speed_scale};
    jacobian_.resize(0, 0);
    if (task_.before) learn(angular(task_.before->frequency));
  }

  void solve(std::size_t speed) override
  {
    const double omega = angular(task_.frequencies[speed]);
    if (!predictor_.empty())
      state_ = state_of(predictor_.at_speed(omega).cwiseProduct(scales_));
    if (predictor_.empty() || !shot(speed)) {
      predictor_.clear();
      jacobian_.resize(0, 0);
      state_ = quasi_static_state(task_.parameters, omega);
      advance(*stepper(speed, 1), schedule_.at(speed).transient, omega);
      if (!shot(speed)) return;
    }
    learn(omega);
    reached_[speed] = {0, state_};
  }

  bool shot(std::size_t speed)
  {
    const Setting& setting = schedule_.at(speed);
    const Shooting result =
        shoot(task_.parameters, angular(task_.frequencies[speed]), state_,
              {.method = setting.stepper(),
               .tolerance = setting.tolerance,
               .step = setting.step,
               .closed = setting.periodicity_residual,
               .quasi_newton = true},
              &jacobian_);
    counts_.force_instants += result.evaluations;
    return result.converged;
  }

  void learn(double omega)
  {
    predictor_.add(vector_of(state_).cwiseQuotient(scales_), omega);
  }

  const Vector8 scales_ = state_scales(task_.parameters);
  LagrangePredictor predictor_{1, 1};
  Eigen::MatrixXd jacobian_;
};

/** All speeds side by side, each from quasi-static contact. */
class Ensemble : public Integration {
  using Integration::Integration;

  void begin() override
  {
    Integration::begin();
    flows_.clear();
    std::vector<Passage> passages;
    for (std::size_t k = 0; k < reached_.size(); ++k) {
      const double omega = angular(task_.frequencies[k]);
      auto& [periods, state] =
          reached_[k].emplace(whole_periods(schedule_.at(k).transient, omega),
                              quasi_static_state(task_.parameters, omega));
      flows_.push_back(stepper(k, 1));
      passages.push_back({flows_.back().get(), 0, &state, periods});
    }
    const std::vector<Failure> failures = advance_together(passages);
    for (const auto& flow : flows_) counts_.force_instants += flow->evaluations();
    for (const Failure& failure : failures) reached_[failure.passage].reset();
  }

  void solve(std::size_t /*speed*/) override {}

  /** The whole, shared as the evaluations are. */
  std::vector<double> seconds_by_speed() override
  {
    const double whole = time_of(1, [&] { begin(); }).median;
    const auto all = static_cast<double>(std::max(1L, counts_.force_instants));
    std::vector<double> seconds;
    for (const auto& one : flows_)
      seconds.push_back(whole * static_cast<double>(one->evaluations()) / all);
    return seconds;
  }

  std::vector<std::unique_ptr<Flow>> flows_;
};

}  // namespace

std::unique_ptr<TimedMethod> timed_method(const Task& task, const Schedule& schedule)
{
  if (schedule.at(0).is_shooting())
    return std::make_unique<ShootingSweep>(task, schedule);
  if (schedule.method() == "aft") return std::make_unique<BalanceSweep>(task, schedule);
  if (schedule.at(0).is_ensemble()) return std::make_unique<Ensemble>(task, schedule);
  return std::make_unique<Integration>(task, schedule);
}

static MotionError error_of(const Parameters& parameters,
                            const std::optional<motion::Motion>& motion,
                            const TrueMotion& truth)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!motion) return {infinity, infinity, infinity};
  /** Of a motion that has diverged it may be no number. */
  const auto known = [&](double error) {
    return std::isfinite(error) ? error : infinity;
  };
  return {.displacement = known(motion::relative_difference(*motion, truth.motion)),
          .force =
              known(motion::relative_force_difference(parameters, *motion, truth.motion)),
          .mean = known(motion::rms_difference(*motion, truth.motion))};
}

Measurement measure(const References& sweep, const Schedule& schedule, int repetitions)
{
  const auto method = timed_method(sweep, schedule);
  std::vector<double> seconds;
  const CpuTime time = time_of(repetitions, [&] {
    if (repetitions == 1)
      seconds = method->seconds_by_speed();
    else
      method->run();
  });
  Measurement result{time, method->counts(), {}, schedule, repetitions, seconds};
  for (std::size_t speed = 0; const TrueMotion& truth : sweep.truths) {
    MotionError& error = result.errors.emplace_back();
    if (truth.periodic)
      error = error_of(sweep.parameters,
                       method->motion(speed, truth.motion.points_per_period), truth);
    if (error.displacement > result.displacement) {
      result.displacement = error.displacement;
      result.worst_frequency = truth.frequency;
    }
    result.force = std::max(result.force, error.force);
    result.mean = std::max(result.mean, error.mean);
    ++speed;
  }
  return result;
}

double fitted_exponent(const std::vector<double>& x, const std::vector<double>& y)
{
  const Eigen::ArrayXd log_x = Eigen::ArrayXd::Map(x.data(), std::ssize(x)).log();
  const Eigen::ArrayXd log_y = Eigen::ArrayXd::Map(y.data(), std::ssize(y)).log();
  const Eigen::ArrayXd off = log_x - log_x.mean();
  return (off * log_y).sum() / off.square().sum();
}

}  // namespace rotor_stator::costs
