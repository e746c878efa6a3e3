#include "motion/judge.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "balance/bearing_problem.hpp"
#include "balance/fourier_transform.hpp"
#include "balance/newton.hpp"
#include "io/errors.hpp"

namespace rotor_stator::motion {

namespace {

constexpr double rough_error = 1e-7, roughly_closed = 1e-5;
constexpr double local_error = 1e-11, finer = 1e-13, well_closed = 1e-8;

bool are_opposite(const Verdict& a, const Verdict& b)
{
  return (a.floquet.stable() && b.floquet.unstable()) ||
         (a.floquet.unstable() && b.floquet.stable());
}

/** The solution's states at eight phases, from the series of all coordinates. */
Eighths eighths_of(const Parameters& parameters, const PeriodicMotion& solution)
{
  const Eigen::MatrixXd series = parameters.bodies->all_series(parameters, solution);
  const Eigen::MatrixXd q = sample_series(series, eighths);
  const Eigen::MatrixXd v =
      solution.omega * sample_series(differentiate(series), eighths);
  Eighths at;
  for (int k = 0; k < eighths; ++k) {
    Eigen::VectorXd y(2 * q.cols());
    y << q.row(k).transpose(), v.row(k).transpose();
    at.push_back(rotor_stator::state_of(y));
  }
  return at;
}

/** The displacements of both bodies: rms difference over the sizes, at all eight phases.
    */
double apart(const Eighths& a, const Eighths& b, double size)
{
  double sum = 0;
  for (std::size_t i = 0; i < eighths; ++i)
    sum += (vector_of(a[i]) - vector_of(b[i])).head<4>().squaredNorm();
  return std::sqrt(sum / eighths) / size;
}

/** Closes motions of Eq. 7 with one base period, and judges them. */
class Closer {
public:
  Closer(const Parameters& parameters, double omega, OperationBudget budget)
      : parameters_(parameters), omega_(omega), budget_(std::move(budget)),
        size_(state_scales(parameters)[0])
  {
  }

  Shooting roughly(Eighths& motion, std::optional<int> alone = {})
  {
    return shot(motion, {.tolerance = rough_error,
                         .closed = roughly_closed,
                         .most_maps = alone ? 10 : 20,
                         .alone = alone});
  }

  /** Puts `motion` on the one near it; returns its multipliers, whose uncertainty is what
      a second closing changes. Throws NoSolution. */
  Floquet exactly(Eighths& motion)
  {
    const auto closed = [&](double error, double wanted) {
      const Shooting closing =
          shot(motion, {.tolerance = error, .closed = wanted, .most_maps = 20});
      if (!closing.converged) throw NoSolution(closing.reason);
      return multipliers_of(closing.derivative);
    };
    const Multipliers first = closed(local_error, well_closed);
    Floquet floquet{.multipliers = closed(finer, 1e2 * well_closed)};
    floquet.change = largest_move(floquet.multipliers, first);
    /** Receptances that are wrong by ε move no exponent by more than ε times the
        contact's frequency. */
    floquet.change += parameters_.bodies->reduction_error() *
                      contact_frequency(parameters_) * angular(1) / omega_;
    floquet.converged = floquet.change <= 0.1;
    return floquet;
  }

  /** One period, each eighth from its own state. */
  Motion record(const Eighths& motion, int instants)
  {
    const auto stepper = flow(
        parameters_, omega_,
        {.intervals_per_period = instants, .tolerance = local_error, .budget = budget_});
    Motion record{instants, 0, {}};
    for (int k = 0; k < instants;) {
      State state = motion[static_cast<std::size_t>(k * eighths / instants)];
      for (const int end = k + instants / eighths; k < end; ++k) {
        motion::add(record, state);
        stepper->advance(k, state);
      }
    }
    evaluations_ += static_cast<double>(stepper->evaluations());
    return record;
  }

  double size() const { return size_; }
  double evaluations() const { return evaluations_; }

private:
  Shooting shot(Eighths& motion, ShootingSettings settings)
  {
    settings.budget = budget_;
    const Shooting shooting = shoot(parameters_, omega_, motion, settings);
    evaluations_ += static_cast<double>(shooting.evaluations);
    return shooting;
  }

  const Parameters& parameters_;
  double omega_;
  OperationBudget budget_;
  double size_;
  double evaluations_ = 0;
};

/** The motions around one solution. */
class Search {
public:
  Search(const Parameters& parameters, const PeriodicMotion& solution,
         const OperationBudget& budget)
      : parameters_(parameters), solution_(solution), budget_(budget),
        closer_(parameters, solution.omega, budget),
        start_(eighths_of(parameters, solution)),
        judged_(motion_of(solution.bodies, instants_of(parameters, solution.omega)))
  {
  }

  /** From the solution, and from `further` motions that may be near it. */
  void run(const std::vector<Eighths>& further)
  {
    Eighths motion = start_;
    Shooting own = closer_.roughly(motion);
    if (own.first.size() > 0) own_distance_ = distance_of(own.first);
    if (!own.converged) {
      motion = raised();
      const double away = apart(motion, start_, closer_.size());
      own = closer_.roughly(motion);
      if (own.converged) own_distance_ = away + distance_of(own.first);
    }
    reason_ = own.reason;
    if (own.converged) add(motion);
    for (Eighths other : further)
      if (closer_.roughly(other).converged) add(other);
    /** Where Newton converges at once no other motion is as near. */
    if (motions_.size() == 1 && own.contraction < quick) return;
    for (int k = 0; k < eighths && !budget_.used_up(); ++k) {
      motion = start_;
      if (closer_.roughly(motion, k).converged) add(motion);
    }
    if (motions_.empty() && budget_.used_up()) reason_ = "the budget is used up";
  }

  /** The nearest one. */
  Verdict nearest() const
  {
    constexpr double as_near = 2;
    Verdict nearest{.reason = reason_,
                    .refused_distance = refused_distance_,
                    .state = start_.front()};
    if (!motions_.empty())
      nearest = *std::ranges::min_element(motions_, {}, &Verdict::distance_rms);
    for (const Verdict& other : motions_)
      if (are_opposite(nearest, other) &&
          other.distance_rms < as_near * nearest.distance_rms) {
        nearest = {.reason = format("of two motions of its period near it one is %s, "
                                    "%.3g rms away, the other one %s, %.3g",
                                    nearest.floquet.verdict(), nearest.distance_rms,
                                    other.floquet.verdict(), other.distance_rms),
                   .state = start_.front()};
        break;
      }
    nearest.evaluations = evaluations_ + closer_.evaluations();
    return nearest;
  }

private:
  static constexpr double quick = 0.3;  ///< second correction over the first one [-]

  /** Adds the motion that is closed from here. */
  void add(const Eighths& motion)
  {
    constexpr double same = 1e-5, near = 10, floor = 1e-4;
    const auto is_known = [&](const Eighths& at, double within) {
      return std::ranges::any_of(motions_, [&](const Verdict& known) {
        return apart(at, known.at, closer_.size()) < within;
      });
    };
    if (is_known(motion, same)) return;
    const double away = apart(motion, start_, closer_.size());
    if (!(away <= near * own_distance_ + floor)) {
      reason_ = "the motion of its period found from it is too far away to be its own";
      refused_distance_ =
          away * closer_.size() / std::max(largest_displacement(judged_), 1e-300);
      return;
    }
    try {
      Verdict exact{.at = motion};
      exact.floquet = closer_.exactly(exact.at);
      if (is_known(exact.at, 0.01 * same)) return;
      exact.state = exact.at.front();
      exact.record = closer_.record(exact.at, judged_.points_per_period);
      exact.distance = relative_difference(judged_, exact.record);
      exact.distance_rms = rms_difference(judged_, exact.record);
      const auto half = half_peak_to_peak(exact.record);
      exact.moves = *std::ranges::max_element(half) > 1e-12 * closer_.size();
      motions_.push_back(std::move(exact));
    } catch (const NoSolution& none) {
      reason_ = none.what();
    }
  }

  /** The same solution with four times as many harmonics, where Newton finds it. */
  Eighths raised()
  try {
    const int m = 4 * solution_.harmonics.count(), most = 192 * parameters_.turns;
    if (m > most) return start_;
    Balance balance(bearing_problem(parameters_, fast_transform_size(8 * m + 1), budget_),
                    m);
    PeriodicMotion more = solve(balance, solution_.omega,
                                resize_harmonics(solution_.x, balance.problem().dofs, m));
    evaluations_ += static_cast<double>(more.force_samples);
    if (!more.found()) return start_;
    more.bodies = body_series(parameters_, more);
    return eighths_of(parameters_, more);
  } catch (const NoSolution&) {
    return start_;
  }

  /** The displacements of a correction of all eight states, as `apart` measures them. */
  double distance_of(const Eigen::VectorXd& correction) const
  {
    const Eigen::Index n = state_scales(parameters_).size();
    const Eigen::Index states = correction.size() / n;
    double sum = 0;
    for (Eigen::Index i = 0; i < states; ++i)
      sum += correction.segment(i * n, 4).squaredNorm();
    return std::sqrt(sum / static_cast<double>(states));
  }

  const Parameters& parameters_;
  const PeriodicMotion& solution_;
  OperationBudget budget_;
  Closer closer_;
  Eighths start_;
  Motion judged_;
  double own_distance_ = 0, refused_distance_ = 0, evaluations_ = 0;
  std::vector<Verdict> motions_;
  std::string reason_;
};

/** What the machine does from `state`, disturbed by 1e-3 of the sizes. */
void add_settled(const Parameters& parameters, double omega, const State& state,
                 const OperationBudget& budget, Verdict& verdict)
{
  constexpr double disturbance = 1e-3, left = 1e-2;
  constexpr long before = 200;  ///< base periods until the section is looked at
  const Eigen::VectorXd sizes = state_scales(parameters);
  try {
    const State start = rotor_stator::state_of(vector_of(state) + disturbance * sizes);
    verdict.from_there =
        settle(parameters, omega, BasePeriod{}, {start, -before}, {}, budget);
    const Eigen::VectorXd moved =
        (vector_of(verdict.from_there.at.state) - vector_of(state)).cwiseQuotient(sizes);
    if (verdict.found() && verdict.floquet.unstable() &&
        moved.cwiseAbs().maxCoeff() < left) {
      verdict.from_there.kind = Kind::undecided;
      verdict.from_there.period = 0;
      verdict.from_there.reason = "it has not left the unstable motion yet";
    }
  } catch (const NoSolution& error) {
    verdict.why_lost = error.what();
  }
}

/** The states of the motion through `state` at phase 0. */
Eighths eighths_from(const Parameters& parameters, double omega, State state,
                     const OperationBudget& budget)
{
  const auto stepper =
      flow(parameters, omega,
           {.intervals_per_period = eighths, .tolerance = local_error, .budget = budget});
  Eighths at;
  for (int k = 0; k < eighths; ++k) {
    at.push_back(state);
    stepper->advance(k, state);
  }
  return at;
}

}  // namespace

Floquet multipliers_through(const Parameters& parameters, double omega,
                            const State& state, const OperationBudget& budget)
{
  Eighths motion = eighths_from(parameters, omega, state, budget);
  return Closer(parameters, omega, budget).exactly(motion);
}

Verdict judge_through(const Parameters& parameters, double omega, const State& state,
                      const OperationBudget& budget, int turns)
{
  Verdict verdict{.state = state};
  const Parameters longer = over_turns(parameters, turns);
  Closer closer(longer, omega / turns, budget);
  try {
    Eighths motion = eighths_from(longer, omega / turns, state, budget);
    verdict.floquet = closer.exactly(motion);
    verdict.state = motion.front();
  } catch (const NoSolution& error) {
    verdict.reason = error.what();
  }
  verdict.evaluations = closer.evaluations();
  if (!verdict.stable()) add_settled(parameters, omega, state, budget, verdict);
  return verdict;
}

Verdict nearest_motion(const Parameters& parameters, const PeriodicMotion& solution,
                       const OperationBudget& budget, const std::vector<Eighths>& further)
{
  Search search(parameters, solution, budget);
  search.run(further);
  return search.nearest();
}

Verdict judge(const Parameters& parameters, const PeriodicMotion& solution,
              const OperationBudget& budget, int turns)
{
  if (!std::isfinite(1 / solution.omega))
    return {.reason = "the period of rotation is too long to be integrated"};
  Verdict verdict =
      nearest_motion(over_turns(parameters, turns), solution, budget.part(0.5));
  if (!verdict.stable())
    add_settled(parameters, turns * solution.omega, verdict.state, budget, verdict);
  return verdict;
}

}  // namespace rotor_stator::motion
