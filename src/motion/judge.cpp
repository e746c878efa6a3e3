#include "motion/judge.hpp"

#include <algorithm>
#include <cmath>

#include "balance/bearing_problem.hpp"
#include "balance/find.hpp"
#include "balance/fourier_transform.hpp"
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

/** Closes motions of Eq. 7 with one base period, and judges them. */
struct Closer {
  const Parameters& parameters;
  double omega;
  OperationBudget budget;
  double size = state_scales(parameters)[0];
  double evaluations = 0;

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
    floquet.change += parameters.bodies->reduction_error() *
                      contact_frequency(parameters) * angular(1) / omega;
    floquet.converged = floquet.change <= 0.1;
    return floquet;
  }

  /** The states of the motion through `state` at phase 0. */
  Eighths through(State state)
  {
    const auto stepper = flow(
        parameters, omega,
        {.intervals_per_period = eighths, .tolerance = local_error, .budget = budget});
    Eighths at;
    for (int k = 0; k < eighths; ++k) {
      at.push_back(state);
      stepper->advance(k, state);
    }
    evaluations += static_cast<double>(stepper->evaluations());
    return at;
  }

  /** One period, each eighth from its own state. */
  Motion record(const Eighths& motion, int instants)
  {
    const auto stepper = flow(
        parameters, omega,
        {.intervals_per_period = instants, .tolerance = local_error, .budget = budget});
    Motion record{instants, 0, {}};
    for (int k = 0; k < instants;) {
      State state = motion[k * eighths / instants];
      for (const int end = k + instants / eighths; k < end; ++k) {
        motion::add(record, state);
        stepper->advance(k, state);
      }
    }
    evaluations += static_cast<double>(stepper->evaluations());
    return record;
  }

  Shooting shot(Eighths& motion, ShootingSettings settings)
  {
    settings.budget = budget;
    const Shooting shooting = shoot(parameters, omega, motion, settings);
    evaluations += static_cast<double>(shooting.evaluations);
    return shooting;
  }

  /** The displacements of both bodies: rms difference over the sizes, at all eight
      phases. */
  double apart(const Eighths& a, const Eighths& b) const
  {
    double sum = 0;
    for (std::size_t i = 0; i < eighths; ++i)
      sum += (vector_of(a[i]) - vector_of(b[i])).head<4>().squaredNorm();
    return std::sqrt(sum / eighths) / size;
  }

  /** The same of a correction of all eight states, over the sizes. */
  double distance_of(const Eigen::VectorXd& correction) const
  {
    const Eigen::Index n = state_scales(parameters).size(),
                       states = correction.size() / n;
    return std::sqrt(correction.reshaped(n, states).topRows(4).squaredNorm() /
                     static_cast<double>(states));
  }
};

/** The motions around one solution. */
struct Search {
  const Parameters& parameters;
  const PeriodicMotion& solution;
  OperationBudget budget;
  Closer closer{parameters, solution.omega, budget};
  Eighths start = eighths_of(parameters, solution);
  Motion judged = motion_of(solution.bodies, instants_of(parameters, solution.omega));
  double own_distance = 0, refused_distance = 0;
  std::vector<Verdict> motions = {};
  std::string reason = {};

  /** From the solution, and from `further` motions that may be near it. */
  void run(const std::vector<Eighths>& further)
  {
    constexpr double quick = 0.3;  // second correction over the first one
    Eighths motion = start;
    Shooting own = closer.roughly(motion);
    if (own.first.size() > 0) own_distance = closer.distance_of(own.first);
    if (!own.converged) {
      motion = raised();
      const double away = closer.apart(motion, start);
      own = closer.roughly(motion);
      if (own.converged) own_distance = away + closer.distance_of(own.first);
    }
    reason = own.reason;
    if (own.converged) add(motion);
    for (Eighths other : further)
      if (closer.roughly(other).converged) add(other);
    /** Where Newton converges at once no other motion is as near. */
    if (motions.size() == 1 && own.contraction < quick) return;
    for (int k = 0; k < eighths && !budget.used_up(); ++k) {
      motion = start;
      if (closer.roughly(motion, k).converged) add(motion);
    }
    if (motions.empty() && budget.used_up()) reason = "the budget is used up";
  }

  /** The nearest one. */
  Verdict nearest() const
  {
    constexpr double as_near = 2;
    const auto distance = [](const Verdict& one) { return one.distance.rms; };
    Verdict nearest{
        .reason = reason, .refused_distance = refused_distance, .state = start.front()};
    if (!motions.empty()) nearest = *std::ranges::min_element(motions, {}, distance);
    for (const Verdict& other : motions)
      if (are_opposite(nearest, other) && distance(other) < as_near * distance(nearest)) {
        nearest = {.reason = format("of two motions of its period near it one is %s, "
                                    "%.3g rms away, the other one %s, %.3g",
                                    nearest.word(), distance(nearest), other.word(),
                                    distance(other)),
                   .state = start.front()};
        break;
      }
    nearest.evaluations = closer.evaluations;
    return nearest;
  }

  /** Adds the motion that is closed from here. */
  void add(const Eighths& motion)
  {
    constexpr double same = 1e-5, near = 10, floor = 1e-4;
    const auto is_known = [&](const Eighths& at, double within) {
      return std::ranges::any_of(motions, [&](const Verdict& known) {
        return closer.apart(at, known.at) < within;
      });
    };
    if (is_known(motion, same)) return;
    const double away = closer.apart(motion, start);
    if (!(away <= near * own_distance + floor)) {
      reason = "the motion of its period found from it is too far away to be its own";
      const double largest = displacement_samples(judged).cwiseAbs().maxCoeff();
      refused_distance = away * closer.size / std::max(largest, 1e-300);
      return;
    }
    try {
      Verdict exact{.at = motion};
      exact.floquet = closer.exactly(exact.at);
      if (is_known(exact.at, 0.01 * same)) return;
      exact.state = exact.at.front();
      exact.record = closer.record(exact.at, judged.points_per_period);
      exact.distance = difference(judged, exact.record);
      exact.moves =
          std::ranges::max(half_peak_to_peak(exact.record)) > 1e-12 * closer.size;
      motions.push_back(std::move(exact));
    } catch (const NoSolution& none) {
      reason = none.what();
    }
  }

  /** The same solution with four times as many harmonics, where Newton finds it. */
  Eighths raised()
  try {
    const int m = 4 * solution.harmonics.count(), most = 192 * parameters.turns;
    if (m > most) return start;
    const PeriodicMotion more = find_from({.parameters = parameters,
                                           .omega = solution.omega,
                                           .harmonics = m,
                                           .samples = fast_transform_size(8 * m + 1),
                                           .budget = budget},
                                          "fewer harmonics", solution.x);
    closer.evaluations += static_cast<double>(more.force_samples);
    return more.found() ? eighths_of(parameters, more) : start;
  } catch (const NoSolution&) {
    return start;
  }
};

/** The motion nearest to a solution over one base period; shooting starts from `further`
    motions too. */
Verdict nearest_motion(const Parameters& parameters, const PeriodicMotion& solution,
                       const OperationBudget& budget,
                       const std::vector<Eighths>& further = {})
{
  Search search{parameters, solution, budget};
  search.run(further);
  return search.nearest();
}

/** What the machine does from the verdict's state, disturbed by 1e-3 of the sizes. */
void add_settled(const Parameters& parameters, double omega, const State& state,
                 const OperationBudget& budget, Verdict& verdict)
try {
  constexpr double disturbance = 1e-3, left = 1e-2;
  constexpr long before = 200;  ///< base periods until the section is looked at
  const State start =
      rotor_stator::state_of(vector_of(state) + disturbance * state_scales(parameters));
  verdict.from_there =
      settle(parameters, omega, BasePeriod{}, {start, -before}, {}, budget);
  if (verdict.found() && verdict.floquet.unstable() &&
      apart(parameters, verdict.from_there.at.state, state) < left) {
    verdict.from_there.kind = Kind::undecided;
    verdict.from_there.period = 0;
    verdict.from_there.reason = "it has not left the unstable motion yet";
  }
} catch (const NoSolution& error) {
  verdict.why_lost = error.what();
}

}  // namespace

Floquet multipliers_through(const Parameters& parameters, double omega,
                            const State& state, const OperationBudget& budget)
{
  Closer closer{parameters, omega, budget};
  Eighths motion = closer.through(state);
  return closer.exactly(motion);
}

Verdict judge_through(const Parameters& parameters, double omega, const State& state,
                      const OperationBudget& budget, int turns)
{
  Verdict verdict{.state = state};
  const Parameters longer = over_turns(parameters, turns);
  Closer closer{longer, omega / turns, budget};
  try {
    Eighths motion = closer.through(state);
    verdict.floquet = closer.exactly(motion);
    verdict.state = motion.front();
  } catch (const NoSolution& error) {
    verdict.reason = error.what();
  }
  verdict.evaluations = closer.evaluations;
  if (!verdict.stable()) add_settled(parameters, omega, state, budget, verdict);
  return verdict;
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

/**
## Along a branch */

namespace {

/** A motion that was found at a point of the branch. */
struct Found {
  double arc, omega;
  Eighths at;
};

/** On the line through the two motions nearest along the branch, of those whose speed
    differs by at most `reach` [rad/s]. */
std::vector<Eighths> starts_near(const BranchPoint& point, std::vector<Found> near,
                                 double reach)
{
  std::erase_if(near, [&](const Found& motion) {
    return std::abs(motion.omega - point.motion.omega) > reach;
  });
  std::ranges::sort(
      near, {}, [&](const Found& motion) { return std::abs(motion.arc - point.arc); });
  if (near.empty()) return {};
  if (near.size() == 1 || near[0].arc == near[1].arc) return {near[0].at};
  const double r = (point.arc - near[0].arc) / (near[1].arc - near[0].arc);
  Eighths between;
  for (std::size_t i = 0; i < eighths; ++i)
    between.push_back(rotor_stator::state_of((1 - r) * vector_of(near[0].at[i]) +
                                             r * vector_of(near[1].at[i])));
  return {between};
}

}  // namespace

BranchStability machine_stability(const Parameters& parameters, Curve& curve,
                                  const Branch& branch, const OperationBudget& budget)
{
  const double width = 0.004 * speed_scale(parameters) / parameters.turns;
  const double reach = 0.01 * speed_scale(parameters) / parameters.turns;
  const double most = std::max(2e6, 0.04 * std::min(budget.left(), 2e9));
  std::vector<Found> found;
  const auto multipliers_at = [&](const BranchPoint& point) {
    PeriodicMotion solution = point.motion;
    solution.bodies = body_series(parameters, solution);
    const Verdict verdict = nearest_motion(
        parameters, solution, budget.part(std::min(1.0, most / budget.left())),
        starts_near(point, found, reach));
    if (!verdict.found()) throw NoSolution(verdict.reason);
    found.push_back({point.arc, solution.omega, verdict.at});
    return verdict.floquet;
  };
  return stability_along(curve, branch, multipliers_at, evenly_chosen(branch, width, 2),
                         width);
}

}  // namespace rotor_stator::motion
