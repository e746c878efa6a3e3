/**
# Contenders: harmonic balance

One motion, timed with all that a user pays: tables, plans, start and iterations. */
#include <cmath>
#include <map>
#include <memory>
#include <numbers>

#include "balance/bearing_problem.hpp"
#include "continuation/lagrange_predictor.hpp"
#include "scenes/contender_kinds.hpp"
#include "scenes/cpu_time.hpp"
#include "scenes/left_out.hpp"
#include "scenes/scene_file.hpp"

namespace rotor_stator
{

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
    const SweepSettings scaling = sweep_settings(task_.parameters);
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

  Motions motions(int points) const
  {
    Motions motions;
    for (const Eigen::MatrixXd& bodies : solutions_) {
      motions.emplace_back();
      if (bodies.size() > 0) motions.back() = motion_of(bodies, points);
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

}  // namespace rotor_stator
