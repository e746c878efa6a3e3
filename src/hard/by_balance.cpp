#include "hard/by_balance.hpp"

#include <algorithm>
#include <cmath>

#include "balance/bearing_problem.hpp"
#include "continuation/arc_length.hpp"
#include "continuation/sweep.hpp"
#include "io/errors.hpp"

namespace rotor_stator::hard {

namespace {

/** The branch is followed with no more than the paper's harmonics; the rest is added at the speed
    itself. */
constexpr int most_followed = 10;

/** A few seconds to the speed, and ten for the refinement there: two dense solutions with
    1024 harmonics. */
constexpr double most_operations = 6e9, most_refining_operations = 20e9;

struct Resolution {
  int harmonics, samples;
};

Resolution followed(const HardCase& hard)
{
  const int m = std::min(hard.harmonics, most_followed);
  const bool printed = hard.samples == 2 * hard.harmonics + 1;
  return {m, m == hard.harmonics ? hard.samples
             : printed           ? 2 * m + 1
                                 : default_samples(m)};
}

/** A start for Newton at the case's speed; throws NoSolution when it was not reached. */
using Approach = Eigen::VectorXd (*)(const HardCase& hard, Balance& balance);

/** Equal steps of at most half a hertz, at least 20 and at most 400. */
std::vector<double> swept_speeds(const HardCase& hard)
{
  const int steps =
      static_cast<int>(std::clamp((hard.frequency - hard.from) / 0.5, 20.0, 400.0));
  std::vector<double> omegas;
  for (int k = 0; k <= steps; ++k)
    omegas.push_back(angular(hard.from + (hard.frequency - hard.from) * k / steps));
  return omegas;
}

Eigen::VectorXd by_predictor(const HardCase& hard, Balance& balance)
{
  const Parameters& p = hard.machine;
  const int m = balance.harmonics().highest();
  const auto points = sweep(
      balance, swept_speeds(hard),
      [&](double omega) { return quasi_static_start(p, omega, m); }, sweep_settings(p));
  if (!points.back().found())
    throw NoSolution(format("the sweep with m = %d found nothing at %g Hz: %s", m,
                            hard.frequency, points.back().newton.reason().c_str()));
  return points.back().x;
}

Eigen::VectorXd by_arc_length(const HardCase& hard, Balance& balance)
{
  const Parameters& p = hard.machine;
  const int m = balance.harmonics().highest();
  const Branch branch =
      follow_branch(balance, angular(hard.from), angular(hard.frequency),
                    quasi_static_start(p, angular(hard.from), m), arc_length_settings(p));
  if (!branch.covered)
    throw NoSolution(
        format("the branch with m = %d ended before %g Hz: ", m, hard.frequency) +
        branch.end);
  return branch.points.back().motion.x;
}

/** Newton with these harmonics, from a solution with others. */
PeriodicMotion solved(const HardCase& hard, Resolution with, const Eigen::VectorXd& start,
                      const OperationBudget& budget)
{
  const Parameters& p = hard.machine;
  Balance balance(bearing_problem(p, with.samples, budget), with.harmonics);
  PeriodicMotion solution =
      solve(balance, angular(hard.frequency), resize_harmonics(start, 2, with.harmonics));
  if (!solution.found())
    throw NoSolution(
        format("Newton with m = %d, N = %d: ", with.harmonics, with.samples) +
        solution.newton.reason());
  solution.bodies = body_series(p, solution);
  return solution;
}

/** The start along the branch, with its harmonics doubled until they are the case's. */
PeriodicMotion reached(const HardCase& hard, Approach approach,
                       const OperationBudget& budget)
{
  Resolution with = followed(hard);
  if (hard.from == hard.frequency)
    return solved(
        hard, {hard.harmonics, hard.samples},
        quasi_static_start(hard.machine, angular(hard.frequency), hard.harmonics),
        budget);
  Balance balance(bearing_problem(hard.machine, with.samples, budget), with.harmonics);
  Eigen::VectorXd x = approach(hard, balance);
  while (2 * with.harmonics < hard.harmonics) {
    with = {2 * with.harmonics, default_samples(2 * with.harmonics)};
    x = solved(hard, with, x, budget).x;
  }
  return solved(hard, {hard.harmonics, hard.samples}, x, budget);
}

/** The balance refined once: its distance is the error that is stated. */
void refine(const HardCase& hard, const PeriodicMotion& solution, const HardRule& rule,
            const OperationBudget& budget, Answer& answer)
{
  const PeriodicMotion finer =
      solved(hard, {2 * hard.harmonics, 2 * hard.samples}, solution.x, budget);
  const int points =
      std::max(compared_points, fast_transform_size(4 * hard.harmonics + 2));
  const motion::Motion coarse = motion::motion_of(solution.bodies, points);
  const motion::Motion fine = motion::motion_of(finer.bodies, points);
  answer.finer = finer;
  answer.stated = motion_difference(coarse, fine);
  const double force = motion::relative_force_difference(hard.machine, coarse, fine);
  answer.stated_force = std::isfinite(force) ? force : 0;
  claim(rule, format("m = %d is too few: 2m and 2N", hard.harmonics), answer);
}

Answer by_balance(const HardCase& hard, const HardRule& rule, Approach approach)
{
  Answer answer;
  const double each = operations_per_evaluation(hard.machine.bearing.balls);
  const OperationBudget budget(most_operations / each);
  try {
    const PeriodicMotion solution = reached(hard, approach, budget);
    answer.reason =
        hard.from == hard.frequency ? "cold" : format("from %g Hz", hard.from);
    answer.residual = solution.newton.delta_1;
    answer.harmonics = hard.harmonics;
    answer.samples = hard.samples;
    answer.motion = motion::motion_of(solution.bodies, compared_points);
    answer.state = motion::state_of(solution);
    answer.solution = solution;
    refine(hard, solution, rule, OperationBudget(most_refining_operations / each),
           answer);
  } catch (const NoSolution& refusal) {
    answer.reason = refusal.what();
  }
  return answer;
}

}  // namespace

Answer answer_by_predictor(const HardCase& hard, const HardRule& rule)
{
  return by_balance(hard, rule, by_predictor);
}

Answer answer_by_arc_length(const HardCase& hard, const HardRule& rule)
{
  return by_balance(hard, rule, by_arc_length);
}

}  // namespace rotor_stator::hard
