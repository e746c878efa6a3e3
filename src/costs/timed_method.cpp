#include "costs/timed_method.hpp"

#include <time.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "balance/bearing_problem.hpp"
#include "balance/newton.hpp"
#include "continuation/sweep.hpp"
#include "io/errors.hpp"
#include "model/rotor_stator.hpp"
#include "motion/find_periodic.hpp"
#include "time/shooting.hpp"
#include "time/time_stepper.hpp"

namespace rotor_stator::costs {

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

void TimedMethod::run(const std::function<bool(std::size_t speed)>& goes_on)
{
  counts_ = {};
  begin();
  for (std::size_t k = 0; k < task_.frequencies.size(); ++k) {
    solve(k);
    if (goes_on && !goes_on(k)) return;
  }
}

namespace {

/** Whole periods that last so many seconds at least. */
long periods_in(double seconds, double omega)
{
  return std::lround(std::ceil(seconds * omega / (2 * std::numbers::pi)));
}

/** From phase 0 by a stepper with one interval per period. */
void advance_periods(const TimeStepper& whole, long periods, State& state)
{
  for (long k = 0; k < periods; ++k) whole.advance(k, state);
}

/**
## Harmonic balance */
class BalanceSweep : public TimedMethod {
public:
  BalanceSweep(const Task& task, const Setting& setting) : TimedMethod(task, setting)
  {
    for (double frequency : task.frequencies)
      longest_ = std::max(longest_, harmonics_at(setting, frequency));
    if (!task.before) return;
    const double frequency = task.before->frequency;
    PeriodicMotion known{.omega = angular(frequency)};
    if (finds(harmonics_at(setting, frequency), known)) before_ = known.x;
  }

  std::optional<motion::Motion> motion(std::size_t speed, int points) const override
  {
    const auto bodies = bodies_.find(angular(task_.frequencies[speed]));
    if (bodies == bodies_.end()) return {};
    return motion::motion_of(bodies->second, points);
  }

  /** Of all balances, those freed included. */
  Counts counts() const override
  {
    Counts counts = counts_;
    for (const auto& [m, solved] : balances_) add(*solved, counts);
    counts.force_seconds = *force_seconds_;
    return counts;
  }

private:
  /** A balance, and the factors that it keeps from speed to speed. */
  struct Solver {
    Balance balance;
    BalanceSolver solver;
    Solver(const Problem& problem, int m, bool is_dense)
        : balance(problem, m), solver(balance, is_dense)
    {
    }
  };

  void begin() override
  {
    balances_.clear();
    bodies_.clear();
    *force_seconds_ = 0;
    SweepSettings settings = sweep_settings(task_.parameters);
    predictor_ = {settings.arc_unknown_scale, settings.speed_scale};
    if (before_.size() > 0) learn(angular(task_.before->frequency), before_);
    if (!setting_.paper_sweep) return;
    /** The paper's sweep goes over all speeds at once. */
    settings.newton.tolerance = setting_.tolerance;
    const int m = setting_.harmonics;
    for (const PeriodicMotion& found : sweep(
             balance(m), angular(task_.frequencies),
             [&](double omega) { return quasi_static_start(task_.parameters, omega, m); },
             settings))
      if (found.found()) bodies_[found.omega] = body_series(task_.parameters, found);
  }

  void solve(std::size_t speed) override
  {
    if (setting_.paper_sweep) return;
    const double frequency = task_.frequencies[speed];
    const int m = harmonics_at(setting_, frequency);
    /** Frees the large balances but one, whose factors this speed can use. */
    constexpr int large = 128;
    std::erase_if(balances_, [&](const auto& entry) {
      const bool freed = entry.first > large && entry.first != m;
      if (freed) add(*entry.second, counts_);
      return freed;
    });
    PeriodicMotion found{.omega = angular(frequency)};
    if (!finds(m, found)) return;
    learn(found.omega, found.x);
    bodies_[found.omega] = body_series(task_.parameters, found);
  }

  /** The predictor's vectors all have one length. */
  void learn(double omega, const Eigen::VectorXd& x)
  {
    predictor_.add(resize_harmonics(x, 2, longest_), omega);
  }

  /** From the setting's transient; without one, or where that fails, from the predictor; then from
      quasi-static contact, which is near with few harmonics only; then from half a second of integration,
      and from longer ones with half as many harmonics more. */
  bool finds(int m, PeriodicMotion& found)
  {
    constexpr int few = 12;
    const auto at_once = [&](const Eigen::VectorXd& x) {
      found.x = resize_harmonics(x, 2, m);
      Balance& at = balance(m);
      return rotor_stator::solve(at, balances_[m]->solver, found, newton_);
    };
    const auto from = [&](const Eigen::VectorXd& x) { return at_once(x); };
    const auto after = [&](double) {
      const motion::Search search{task_.parameters, found.omega, m};
      return at_once(motion::settled_start(search, m));
    };
    if ((setting_.transient > 0 && after(setting_.transient)) ||
        (!predictor_.empty() && from(predictor_.at_speed(found.omega))) ||
        (m <= few && from(quasi_static_start(task_.parameters, found.omega, m))) ||
        after(0.5))
      return true;
    m += (m + 1) / 2;
    return after(1) || after(2);
  }

  /** One balance for each number of harmonics; of a profiled task the force is timed. */
  Balance& balance(int m)
  {
    auto& known = balances_[m];
    if (known) return known->balance;
    Problem problem = bearing_problem(task_.parameters, samples_for(setting_, m));
    if (task_.profiled)
      problem.force = [inner = problem.force, seconds = force_seconds_](
                          const auto& q, auto&&... results) {
        const double start = thread_cpu_seconds();
        inner(q, results...);
        *seconds += thread_cpu_seconds() - start;
      };
    known = std::make_unique<Solver>(problem, m, setting_.algebra == "dense");
    return known->balance;
  }

  static void add(const Solver& solved, Counts& counts)
  {
    const Balance& balance = solved.balance;
    const long samples = balance.problem().samples;
    const long transforms = 4 * (balance.evaluations() + solved.solver.factorisations() +
                                 solved.solver.iterations());
    counts.force_instants += balance.evaluations() * samples;
    counts.transforms += transforms;
    counts.transformed += transforms * samples;
  }

  /** A new start is cheaper than a long iteration. */
  const NewtonSettings newton_{
      .tolerance = setting_.tolerance, .most_iterations = 12, .most_halvings = 4};
  Eigen::VectorXd before_;  ///< the solution that is known, if any
  int longest_ = 0;         ///< harmonics of the predictor's vectors
  LagrangePredictor predictor_{1, 1};
  std::map<int, std::unique_ptr<Solver>> balances_;  ///< by m
  std::map<double, Eigen::MatrixXd> bodies_;         ///< series found, by speed [rad/s]
  std::shared_ptr<double> force_seconds_ = std::make_shared<double>(0);
};

/** Harmonic balance to a tolerance. */
class ToleranceSweep : public TimedMethod {
public:
  using TimedMethod::TimedMethod;

  std::optional<motion::Motion> motion(std::size_t speed, int points) const override
  {
    if (bodies_[speed].size() == 0) return {};
    return motion::motion_of(bodies_[speed], points);
  }

private:
  void begin() override
  {
    bodies_.assign(task_.frequencies.size(), {});
    before_.resize(0);
  }

  void solve(std::size_t speed) override
  {
    motion::Search search{.parameters = task_.parameters,
                          .omega = angular(task_.frequencies[speed]),
                          .harmonics = 6};
    if (before_.size() > 0) search.starts = {before_};
    const motion::Judged at = motion::to_tolerance(search, setting_.tolerance);
    counts_.force_instants += at.force_samples;
    before_ = at.reached ? at.motion.x : Eigen::VectorXd();
    if (at.reached) bodies_[speed] = at.motion.bodies;
  }

  Eigen::VectorXd before_;               ///< the last solution
  std::vector<Eigen::MatrixXd> bodies_;  ///< series found, by speed
};

/**
## Time integration and shooting

Both end in a state of the motion at each speed; one period from it, by the same method at the same
setting, is the motion. */
class Integration : public TimedMethod {
public:
  using TimedMethod::TimedMethod;

  std::optional<motion::Motion> motion(std::size_t speed, int points) const override
  {
    const auto& start = reached_[speed];
    if (!start) return {};
    State state = start->state;
    try {
      const TimeStepper parts = stepper(angular(task_.frequencies[speed]), points);
      return motion::recorded(parts, points, state, start->periods);
    } catch (const NoSolution&) {
      return {};  // the state was no motion
    }
  }

protected:
  void begin() override { reached_.assign(task_.frequencies.size(), {}); }

  TimeStepper stepper(double omega, int intervals) const
  {
    return make_stepper(task_.parameters, omega,
                        {.method = stepper_method_,
                         .intervals_per_period = intervals,
                         .step = setting_.step,
                         .tolerance = setting_.tolerance});
  }

  const std::string stepper_method_ = setting_.method.substr(
      setting_.is_shooting() ? std::string("shooting-").size() : 0);

  /** A state of the motion at phase 0, `periods` after t = 0. */
  struct Reached {
    long periods;
    State state;
  };
  std::vector<std::optional<Reached>> reached_;
};

/** A transient of whole periods at each speed. */
class TransientSweep : public Integration {
  using Integration::Integration;

  void begin() override
  {
    Integration::begin();
    state_ = task_.before ? task_.before->state : static_start(task_.parameters);
  }

  void solve(std::size_t speed) override
  {
    const double frequency = task_.frequencies[speed];
    const TimeStepper whole = stepper(angular(frequency), 1);
    const long periods = std::lround(std::ceil(setting_.transient * frequency - 1e-9));
    try {
      advance_periods(whole, periods, state_);
      reached_[speed] = {periods, state_};
      if (setting_.recorded > 0) {
        const TimeStepper parts = stepper(angular(frequency), setting_.recorded);
        motion::recorded(parts, setting_.recorded, state_, periods);
        counts_.force_instants += parts.evaluations();
      }
    } catch (const NoSolution&) {
      state_ = static_start(task_.parameters);
    }
    counts_.force_instants += whole.evaluations();
  }

  State state_;
};

/** Newton on the period map at each speed. */
class ShootingSweep : public Integration {
  using Integration::Integration;

  void begin() override
  {
    Integration::begin();
    predictor_ = {1, sweep_settings(task_.parameters).speed_scale};
    jacobian_.reset();
    if (task_.before) learn(angular(task_.before->frequency), task_.before->state);
  }

  void solve(std::size_t speed) override
  {
    const double omega = angular(task_.frequencies[speed]);
    State state =
        predictor_.empty()
            ? cold_start(omega)
            : state_of(Vector8(predictor_.at_speed(omega).cwiseProduct(scales_)));
    if (!shot(omega, state)) {
      predictor_.clear();
      jacobian_.reset();
      state = cold_start(omega);
      if (!shot(omega, state)) return;
    }
    learn(omega, state);
    reached_[speed] = {0, state};
  }

  /** Quasi-static contact, and a transient if the setting has one. */
  State cold_start(double omega)
  {
    State state = quasi_static_state(task_.parameters, omega);
    const TimeStepper whole = stepper(omega, 1);
    advance_periods(whole, periods_in(setting_.transient, omega), state);
    counts_.force_instants += whole.evaluations();
    return state;
  }

  bool shot(double omega, State& state)
  {
    const Shooting result = shoot(task_.parameters, omega, state,
                                  {.method = stepper_method_,
                                   .tolerance = setting_.tolerance,
                                   .step = setting_.step,
                                   .periodicity_residual = setting_.periodicity_residual,
                                   .final_derivative = false},
                                  &jacobian_);
    counts_.force_instants += result.evaluations;
    counts_.maps += result.maps;
    counts_.derivatives += result.derivatives;
    return result.converged;
  }

  void learn(double omega, const State& state)
  {
    predictor_.add(vector_of(state).cwiseQuotient(scales_), omega);
  }

  const Vector8 scales_ = state_scales(task_.parameters);
  LagrangePredictor predictor_{1, 1};
  PeriodicityJacobian jacobian_;
};

/** Adds the error at one speed, if there is a motion to compare with. */
void add(MotionError& error, const TimedMethod& method, const References& sweep,
         std::size_t speed)
{
  const auto& truth = sweep.motions[speed];
  if (truth)
    error.add(sweep.parameters, sweep.frequencies[speed],
              method.motion(speed, truth->points_per_period), *truth);
}

}  // namespace

std::unique_ptr<TimedMethod> timed_method(const Task& task, const Setting& setting)
{
  if (setting.is_shooting()) return std::make_unique<ShootingSweep>(task, setting);
  if (setting.method == "aft-tolerance")
    return std::make_unique<ToleranceSweep>(task, setting);
  if (setting.method != "aft") return std::make_unique<TransientSweep>(task, setting);
  return std::make_unique<BalanceSweep>(task, setting);
}

Measurement measure(const References& sweep, const Setting& setting, int repetitions)
{
  const auto method = timed_method(sweep, setting);
  const CpuTime cpu = time_of(repetitions, [&] { method->run(); });
  Measurement result{cpu, method->counts(), {}, setting, repetitions};
  for (std::size_t speed = 0; speed < sweep.frequencies.size(); ++speed)
    add(result, *method, sweep, speed);
  return result;
}

MotionError error_up_to(double bound, const References& sweep, const Setting& setting)
{
  const auto method = timed_method(sweep, setting);
  MotionError error;
  method->run([&](std::size_t speed) {
    add(error, *method, sweep, speed);
    return error.displacement <= bound;
  });
  return error;
}

}  // namespace rotor_stator::costs
