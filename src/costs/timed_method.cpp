#include "costs/timed_method.hpp"

#include <time.h>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <vector>

#include "balance/bearing_problem.hpp"
#include "continuation/sweep.hpp"
#include "integration/rk4.hpp"
#include "integration/time_stepper.hpp"
#include "io/errors.hpp"
#include "io/scene.hpp"
#include "model/rotor_stator.hpp"
#include "motion/find_periodic.hpp"
#include "motion/motion.hpp"
#include "stability/shooting.hpp"

namespace rotor_stator::costs
{

double thread_cpu_seconds()
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

int rounded_up(int harmonics)
{
  int unit = 1;
  while (harmonics > 8 * unit) unit *= 2;
  return (harmonics + unit - 1) / unit * unit;
}

int harmonics_at(const Setting& setting, double frequency)
{
  if (setting.corner == 0) return setting.harmonics;
  const int wanted = static_cast<int>(std::ceil(setting.corner / frequency));
  return std::max(setting.harmonics, rounded_up(wanted));
}

int samples_for(const Setting& setting, int harmonics)
{
  return fast_transform_size(
      std::max(2 * harmonics + 2, setting.samples_per_harmonic * harmonics + 1));
}

std::string Setting::text() const
{
  std::string words;
  const auto add = [&](const std::string& word) {
    words += (words.empty() ? "" : " ") + word;
  };
  if (harmonics > 0) add(format(corner + estimate > 0 ? "m>=%d" : "m=%d", harmonics));
  if (corner > 0) add(format("m*f>=%g", corner));
  if (estimate > 0) add(format("estimate<%g", estimate));
  if (samples_per_harmonic > 0) add(format("N>%dm", samples_per_harmonic));
  if (step > 0) add(format("step=%g", step));
  if (tolerance > 0) add(format("tol=%g", tolerance));
  if (transient > 0) add(format("transient=%g", transient));
  if (closure > 0) add(format("closure=%g", closure));
  return words;
}

Contender make_contender(const Task& task, const Setting& setting)
{
  if (setting.method == "aft") return aft_contender(task, setting);
  if (setting.is_shooting()) return shooting_contender(task, setting);
  return time_contender(task, setting);
}

int LeftOut::harmonics(double part) const
{
  int m = 1;
  while (above(m) > part) ++m;
  return m;
}

int look_ahead(const Parameters& parameters, double omega, int harmonics)
{
  const Scales scale = scales(parameters);
  const double contact_mode = std::sqrt(
      scale.stiffness * (1 / parameters.stator.mass + 1 / parameters.rotor.mass));
  return std::max(2 * harmonics, static_cast<int>(std::ceil(contact_mode / omega)));
}

LeftOut what_is_left_out(const Parameters& parameters, double omega,
                         const Eigen::VectorXd& x, Balance& balance)
{
  const int m = static_cast<int>(x.size() / 4), far = balance.harmonics();
  /** One evaluation of the force, then harmonic by harmonic. */
  LeftOut result{resize_harmonics(x, 2, far), Eigen::VectorXd::Zero(far + 1)};
  const Eigen::VectorXd residual = balance.residual(result.x, omega);
  const double size = body_series(parameters, balance, omega, result.x)
                          .leftCols(3)
                          .cwiseAbs()
                          .rowwise()
                          .sum()
                          .maxCoeff();
  double sum = 0;
  for (int h = far; h > 0; --h) {
    auto u = result.x.segment<4>((2 * h - 1) * 2);  // cosine, then sine coefficients
    if (h > m) {
      const Eigen::Matrix4d block = balance.diagonal_block(h);
      u = -block.partialPivLu().solve(residual.segment<4>((2 * h - 1) * 2));
    }
    result.tail[h] = sum / size;
    sum += std::max(std::hypot(u[0], u[2]), std::hypot(u[1], u[3]));
  }
  result.tail[0] = sum / size;
  return result;
}

Eigen::VectorXd start_after_transient(const Parameters& parameters, double omega,
                                      int harmonics)
{
  constexpr double transient = 0.5;
  const double coarse = 4 * default_step(parameters);  ///< a start needs no more
  const int points = 2 * harmonics + 2;
  const long periods = std::lround(std::ceil(transient * omega / (2 * std::numbers::pi)));
  State state = quasi_static_state(parameters, omega);
  const TimeStepper whole = make_stepper(
      parameters, omega, {.method = "rk4", .intervals_per_period = 1, .step = coarse});
  for (long k = 0; k < periods; ++k) whole.advance(k, state);
  const TimeStepper parts =
      make_stepper(parameters, omega,
                   {.method = "rk4", .intervals_per_period = points, .step = coarse});
  Eigen::VectorXd x =
      motion::relative_series(motion::recorded(parts, points, state), harmonics);
  if (!x.allFinite()) x.setZero();
  return x;
}

/**
## Contenders: harmonic balance

One motion, timed with all that a user pays: tables, plans, start and iterations. */

namespace
{

/** All that one run uses: one balance for each number of harmonics. */
class Balances
{
public:
  Balances(const Task& task, const Setting& setting) : task_(task), setting_(setting) {}

  Balance& with(int harmonics)
  {
    auto& balance = balances_[harmonics];
    if (!balance) balance = std::make_unique<Balance>(problem(harmonics), harmonics);
    return *balance;
  }

  /** Frees the large balances but one, whose factors the next speed can use. */
  void keep_only(int harmonics)
  {
    constexpr int large = 128;
    std::erase_if(balances_, [&](const auto& entry) {
      const bool drop = entry.first > large && entry.first != harmonics;
      if (drop) add(*entry.second, dropped_);
      return drop;
    });
  }

  Counts counts() const
  {
    Counts counts = dropped_;
    for (const auto& [m, balance] : balances_) add(*balance, counts);
    counts.force_seconds = *force_seconds_;
    return counts;
  }

private:
  static void add(Balance& balance, Counts& counts)
  {
    const long samples = balance.problem().samples;
    const long transforms = 4 * balance.evaluations() +
                            4 * balance.steps().factorisations() +
                            4 * balance.steps().linear_iterations();
    counts.force_instants += balance.evaluations() * samples;
    counts.transforms += transforms;
    counts.transformed += transforms * samples;
  }

  Problem problem(int harmonics) const
  {
    Problem problem = bearing_problem(task_.parameters, samples_for(setting_, harmonics));
    if (!task_.profiled) return problem;
    problem.force = [inner = problem.force, seconds = force_seconds_](const auto& q,
                                                                      auto&&... results) {
      const double start = thread_cpu_seconds();
      inner(q, results...);
      *seconds += thread_cpu_seconds() - start;
    };
    return problem;
  }

  const Task& task_;
  const Setting& setting_;
  std::map<int, std::unique_ptr<Balance>> balances_;
  Counts dropped_;  ///< of the freed ones
  std::shared_ptr<double> force_seconds_ = std::make_shared<double>(0);
};

class AftSolver
{
public:
  AftSolver(const Task& task, const Setting& setting) : task_(task), setting_(setting)
  {
    newton_.tolerance = setting.tolerance;
    newton_.most_iterations = 12;  // a new start is cheaper than a long iteration
    newton_.most_halvings = 4;
    longest_ = setting.estimate > 0 ? most_harmonics : 0;
    for (double frequency : task.frequencies)
      longest_ = std::max(longest_, 2 * harmonics_at(setting, frequency));
    if (!task.before) return;
    balances_ = std::make_unique<Balances>(task_, setting_);
    const double frequency = task.before->frequency;
    Eigen::VectorXd x;
    if (solve_from(angular(frequency), harmonics_at(setting_, frequency), x)) before_ = x;
  }

  void run()
  {
    balances_ = std::make_unique<Balances>(task_, setting_);
    solutions_.clear();
    adapted_ = setting_.harmonics;
    const SweepSettings scaling = motion::sweep_settings(task_.parameters);
    LagrangePredictor predictor(scaling.arc_unknown_scale, scaling.speed_scale);
    if (before_.size() > 0)
      predictor.add(padded(before_), angular(task_.before->frequency));
    for (double frequency : task_.frequencies) {
      solutions_.emplace_back();
      balances_->keep_only(first_harmonics(frequency));
      const double omega = angular(frequency);
      Eigen::VectorXd x;
      if (!predictor.empty()) x = predictor.at_speed(omega);
      if (solve_at(frequency, x)) predictor.add(padded(x), omega);
    }
  }

  motion::Motions motions(int points) const
  {
    motion::Motions motions;
    for (const Eigen::MatrixXd& bodies : solutions_) {
      motions.emplace_back();
      if (bodies.size() > 0) motions.back() = motion::motion_of(bodies, points);
    }
    return motions;
  }

  Counts counts() const { return balances_ ? balances_->counts() : Counts{}; }

private:
  static constexpr int most_harmonics = 1024;

  /** The predictor's vectors all have one length. */
  Eigen::VectorXd padded(const Eigen::VectorXd& x) const
  {
    return resize_harmonics(x, 2, longest_);
  }

  int first_harmonics(double frequency) const
  {
    return setting_.estimate > 0 ? adapted_ : harmonics_at(setting_, frequency);
  }

  /** From `x`, or cold if it is empty; with as many harmonics as the setting asks for, or half as
      many more where those have no solution. */
  bool solve_at(double frequency, Eigen::VectorXd& x)
  {
    const double omega = angular(frequency);
    int m = first_harmonics(frequency);
    if (!solve_from(omega, m, x)) {
      m += (m + 1) / 2;
      if (!solve_from(omega, m, x)) return false;
    }
    while (setting_.estimate > 0) {
      const int far = rounded_up(look_ahead(task_.parameters, omega, m));
      const LeftOut left_out =
          what_is_left_out(task_.parameters, omega, x, balances_->with(far));
      const int wanted =
          std::min(most_harmonics, rounded_up(left_out.harmonics(setting_.estimate)));
      adapted_ = std::max(setting_.harmonics, wanted);
      if (wanted <= m) break;
      m = wanted;
      x = left_out.x;
      if (!solve_from(omega, m, x)) return false;
    }
    return true;
  }

  /** From `x`; without it, or where that fails, from quasi-static contact, which is near with few
      harmonics only, and then from time integration. */
  bool solve_from(double omega, int m, Eigen::VectorXd& x)
  {
    constexpr int few = 12;
    if (x.size() > 0 && converges(omega, m, x)) return true;
    if (m <= few) {
      x = quasi_static_start(task_.parameters, omega, m);
      if (converges(omega, m, x)) return true;
    }
    x = start_after_transient(task_.parameters, omega, m);
    return converges(omega, m, x);
  }

  bool converges(double omega, int m, Eigen::VectorXd& x)
  {
    Balance& balance = balances_->with(m);
    x = resize_harmonics(x, 2, m);
    if (!solve(balance, omega, x, newton_).converged()) return false;
    if (!solutions_.empty())
      solutions_.back() = body_series(task_.parameters, balance, omega, x);
    return true;
  }

  Task task_;
  Setting setting_;
  NewtonSettings newton_;
  Eigen::VectorXd before_;
  int longest_;      ///< harmonics of the predictor's vectors
  int adapted_ = 0;  ///< harmonics that the estimate asked for last
  std::unique_ptr<Balances> balances_;
  std::vector<Eigen::MatrixXd> solutions_;  ///< of both bodies; empty where not found
};

}  // namespace

Contender aft_contender(const Task& task, const Setting& setting)
{
  return contender<AftSolver>(task, setting);
}

/**
## Contenders: time integration and shooting

One motion, timed with its transient, or with the start and the maps of shooting. */

namespace
{

/** A state of the motion at phase 0, `periods` after t = 0. */
struct Reached {
  double frequency;  ///< [Hz]
  long periods;
  State state;
};

StepperSettings stepper_settings(const Setting& setting, int intervals)
{
  const std::string method = setting.is_shooting()
                                 ? setting.method.substr(std::string("shooting-").size())
                                 : setting.method;
  return {.method = method,
          .intervals_per_period = intervals,
          .step = setting.step,
          .tolerance = setting.tolerance};
}

/** One period from each state, by the same method at the same setting. */
motion::Motions periods_from(const Task& task, const Setting& setting, int points,
                             const std::vector<std::optional<Reached>>& reached)
{
  motion::Motions motions;
  for (const auto& start : reached) {
    motions.emplace_back();
    if (!start) continue;
    State state = start->state;
    try {
      const TimeStepper stepper = make_stepper(task.parameters, angular(start->frequency),
                                               stepper_settings(setting, points));
      motions.back() = motion::recorded(stepper, points, state, start->periods);
    } catch (const NoSolution&) {
      // the state was no motion
    }
  }
  return motions;
}

/** A transient of whole periods at each speed. */
class Transients
{
public:
  Transients(const Task& task, const Setting& setting) : task_(task), setting_(setting) {}

  void run()
  {
    reached_.clear();
    counts_ = {};
    State state = task_.before ? task_.before->state : static_start(task_.parameters);
    for (double frequency : task_.frequencies) {
      const TimeStepper stepper = make_stepper(task_.parameters, angular(frequency),
                                               stepper_settings(setting_, 1));
      const long periods = std::lround(std::ceil(setting_.transient * frequency - 1e-9));
      reached_.emplace_back();
      try {
        for (long k = 0; k < periods; ++k) stepper.advance(k, state);
        reached_.back() = {frequency, periods, state};
      } catch (const NoSolution&) {
        state = static_start(task_.parameters);
      }
      counts_.force_instants += stepper.evaluations();
    }
  }

  motion::Motions motions(int points) const
  {
    return periods_from(task_, setting_, points, reached_);
  }
  Counts counts() const { return counts_; }

private:
  Task task_;
  Setting setting_;
  std::vector<std::optional<Reached>> reached_;
  Counts counts_;
};

/** Newton on the period map at each speed. */
class Shots
{
public:
  Shots(const Task& task, const Setting& setting) : task_(task), setting_(setting) {}

  void run()
  {
    reached_.clear();
    counts_ = {};
    const SweepSettings scaling = motion::sweep_settings(task_.parameters);
    LagrangePredictor predictor(1, scaling.speed_scale);
    jacobian_.reset();
    if (task_.before)
      predictor.add(scaled(task_.before->state), angular(task_.before->frequency));
    for (double frequency : task_.frequencies) {
      reached_.emplace_back();
      const double omega = angular(frequency);
      State state =
          predictor.empty() ? cold_start(omega) : unscaled(predictor.at_speed(omega));
      if (!shot(omega, state)) {
        predictor.clear();
        jacobian_.reset();
        state = cold_start(omega);
        if (!shot(omega, state)) continue;
      }
      predictor.add(scaled(state), omega);
      reached_.back() = {frequency, 0, state};
    }
  }

  motion::Motions motions(int points) const
  {
    return periods_from(task_, setting_, points, reached_);
  }
  Counts counts() const { return counts_; }

private:
  /** Quasi-static contact, and a transient if the setting has one. */
  State cold_start(double omega)
  {
    State state = quasi_static_state(task_.parameters, omega);
    const TimeStepper stepper =
        make_stepper(task_.parameters, omega, stepper_settings(setting_, 1));
    const double periods = std::ceil(setting_.transient * omega / (2 * std::numbers::pi));
    for (long k = 0; k < std::lround(periods); ++k) stepper.advance(k, state);
    counts_.force_instants += stepper.evaluations();
    return state;
  }

  bool shot(double omega, State& state)
  {
    const StepperSettings stepper = stepper_settings(setting_, 1);
    const Shooting result = shoot(task_.parameters, omega, state,
                                  {.method = stepper.method,
                                   .tolerance = setting_.tolerance,
                                   .step = setting_.step,
                                   .closure = setting_.closure,
                                   .final_derivative = false},
                                  &jacobian_);
    counts_.force_instants += result.evaluations;
    counts_.maps += result.maps;
    counts_.derivatives += result.derivatives;
    return result.converged;
  }

  Eigen::VectorXd scaled(const State& state) const
  {
    return vector_of(state).cwiseQuotient(state_scales(task_.parameters));
  }
  State unscaled(const Eigen::VectorXd& y) const
  {
    return state_of(Vector8(y.cwiseProduct(state_scales(task_.parameters))));
  }

  Task task_;
  Setting setting_;
  ClosureJacobian jacobian_;
  std::vector<std::optional<Reached>> reached_;
  Counts counts_;
};

}  // namespace

Contender time_contender(const Task& task, const Setting& setting)
{
  return contender<Transients>(task, setting);
}

Contender shooting_contender(const Task& task, const Setting& setting)
{
  return contender<Shots>(task, setting);
}

namespace
{

/** Every group for each of `values`, one of which is written into each setting by `put`. */
template <class Values, class Put>
SettingGroup each(const SettingGroup& group, const Values& values, Put put)
{
  SettingGroup all;
  for (const Setting& setting : group)
    for (const auto& value : values) {
      all.push_back(setting);
      put(all.back(), value);
    }
  return all;
}

std::vector<SettingGroup> aft_groups(StrictToml& table)
{
  std::vector<SettingGroup> groups;
  const auto tolerances = table.numbers("newton_tolerances", Range::positive);
  const auto per_harmonic = table.integers("samples_per_harmonic", 2, 64);
  const auto harmonics = table.integers("harmonics", 1, 1024);
  const auto add = [&](const SettingGroup& accuracies) {
    const SettingGroup group = each(accuracies, per_harmonic, [](Setting& s, int value) {
      s.samples_per_harmonic = value;
    });
    groups.push_back(
        each(group, tolerances, [](Setting& s, double value) { s.tolerance = value; }));
  };
  for (int m : harmonics) add({{.method = "aft", .harmonics = m}});
  if (!table.has("least_harmonics")) return groups;
  const auto least = table.integers("least_harmonics", 1, 1024);
  const auto from_least = [&](const Setting& accuracy) {
    add(each({accuracy}, least, [](Setting& s, int value) { s.harmonics = value; }));
  };
  for (double corner : table.numbers("corners_hz", Range::positive))
    from_least({.method = "aft", .corner = corner});
  for (double estimate : table.numbers("estimates", Range::positive))
    from_least({.method = "aft", .estimate = estimate});
  return groups;
}

std::vector<SettingGroup> time_groups(StrictToml& table, const std::string& method)
{
  const bool shooting = method.starts_with("shooting-");
  const bool fixed_step = method.ends_with("rk4");
  const auto accuracies =
      table.numbers(fixed_step ? "steps_s" : "tolerances", Range::positive);
  const auto transients = table.numbers("transients_s", Range::positive);
  const auto closures =
      shooting ? table.numbers("closures", Range::positive) : std::vector<double>{0};
  std::vector<SettingGroup> groups;
  for (double accuracy : accuracies) {
    Setting setting{.method = method};
    (fixed_step ? setting.step : setting.tolerance) = accuracy;
    const SettingGroup group =
        each({setting}, closures, [](Setting& s, double value) { s.closure = value; });
    groups.push_back(
        each(group, transients, [](Setting& s, double value) { s.transient = value; }));
  }
  return groups;
}

void require_known(const StrictToml& toml, const std::string& method)
{
  std::vector<std::string> known{"aft", "rk4", "shooting-rk4"};
  for (const std::string& name : gsl_methods()) known.push_back(name);
  for (const char* name : {"shooting-rkf45", "shooting-rkck", "shooting-rk8pd"})
    known.push_back(name);
  if (std::find(known.begin(), known.end(), method) != known.end()) return;
  std::string list;
  for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
  toml.fail("methods", "must be some of " + list);
}

}  // namespace

std::vector<Candidates> read_candidates(StrictToml& toml)
{
  std::vector<Candidates> all;
  for (const std::string& method : toml.strings("methods")) {
    require_known(toml, method);
    StrictToml table = toml.table(method);
    all.push_back(
        {method, method == "aft" ? aft_groups(table) : time_groups(table, method)});
    table.refuse_unknown_keys();
  }
  return all;
}

}  // namespace rotor_stator::costs
