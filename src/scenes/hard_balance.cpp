/**
# Hard cases: harmonic balance

The paper's predictor and the arc length, each refined until the answer can be stated with an error. */
#include <algorithm>
#include <cmath>

#include "balance/bearing_problem.hpp"
#include "continuation/arc_length.hpp"
#include "model/errors.hpp"
#include "scenes/hard_methods.hpp"
#include "scenes/regime.hpp"

namespace rotor_stator
{

namespace
{

/** The branch is followed with no more than the paper's harmonics; the rest is added at the speed
    itself. */
constexpr int most_followed = 10;

/** A few seconds to the speed, and ten for the refinement there: two dense solutions with
    1024 harmonics. */
constexpr double most_work = 6e9, most_refining_work = 20e9;

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
  const Parameters& p = hard.parameters;
  const auto points = sweep(
      balance, swept_speeds(hard),
      [&](double omega) { return quasi_static_start(p, omega, balance.harmonics()); },
      sweep_settings(p));
  if (!points.back().found())
    throw NoSolution(text("the sweep with m = %d found nothing at %g Hz: %s",
                          balance.harmonics(), hard.frequency,
                          points.back().newton.reason().c_str()));
  return points.back().x;
}

Eigen::VectorXd by_arc_length(const HardCase& hard, Balance& balance)
{
  const Parameters& p = hard.parameters;
  const Branch branch =
      follow_branch(balance, angular(hard.from), angular(hard.frequency),
                    quasi_static_start(p, angular(hard.from), balance.harmonics()),
                    arc_length_settings(p));
  if (!branch.covered)
    throw NoSolution(text("the branch with m = %d ended before %g Hz: ",
                          balance.harmonics(), hard.frequency) +
                     branch.end);
  return branch.points.back().x;
}

/** Newton with these harmonics, from a solution with others. */
PeriodicSolution solved(const HardCase& hard, Resolution with,
                        const Eigen::VectorXd& start, const Work& work)
{
  const Parameters& p = hard.parameters;
  const double omega = angular(hard.frequency);
  Balance balance(bearing_problem(p, with.samples, work), with.harmonics);
  PeriodicSolution solution{omega, with.harmonics, with.samples, {}, {}, {}, {}};
  solution.x = resize_harmonics(start, 2, with.harmonics);
  solution.newton = solve(balance, omega, solution.x, {});
  if (!solution.found())
    throw NoSolution(text("Newton with m = %d, N = %d: ", with.harmonics, with.samples) +
                     solution.newton.reason());
  solution.bodies = body_series(p, balance, omega, solution.x);
  return solution;
}

/** The start along the branch, with its harmonics doubled until they are the case's. */
PeriodicSolution reached(const HardCase& hard, Approach approach, const Work& work)
{
  Resolution with = followed(hard);
  if (hard.from == hard.frequency)
    return solved(
        hard, {hard.harmonics, hard.samples},
        quasi_static_start(hard.parameters, angular(hard.frequency), hard.harmonics),
        work);
  Balance balance(bearing_problem(hard.parameters, with.samples, work), with.harmonics);
  Eigen::VectorXd x = approach(hard, balance);
  while (2 * with.harmonics < hard.harmonics) {
    with = {2 * with.harmonics, default_samples(2 * with.harmonics)};
    x = solved(hard, with, x, work).x;
  }
  return solved(hard, {hard.harmonics, hard.samples}, x, work);
}

/** The balance refined once: its distance is the error that is stated. */
void refine(const HardCase& hard, const PeriodicSolution& solution, const HardRule& rule,
            const Work& work, Answer& answer)
{
  const PeriodicSolution finer =
      solved(hard, {2 * hard.harmonics, 2 * hard.samples}, solution.x, work);
  const int points =
      std::max(compared_points, fast_transform_size(4 * hard.harmonics + 2));
  const Motion coarse = motion_of(solution.bodies, points);
  const Motion fine = motion_of(finer.bodies, points);
  answer.finer = finer.x;
  answer.stated = distance(coarse, fine);
  const double force = relative_force_difference(hard.parameters, coarse, fine);
  answer.stated_force = std::isfinite(force) ? force : 0;
  if (!(answer.stated <= rule.accuracy))
    throw NoSolution(text("m = %d is too few: 2m and 2N move it by %.2g of its size",
                          hard.harmonics, answer.stated));
  answer.claimed = true;
}

Answer by_balance(const HardCase& hard, const HardRule& rule, Approach approach)
{
  Answer answer;
  const Work work(most_work);
  try {
    const PeriodicSolution solution = reached(hard, approach, work);
    answer.reason = hard.from == hard.frequency ? "cold" : text("from %g Hz", hard.from);
    answer.residual = solution.newton.delta_1;
    answer.harmonics = hard.harmonics;
    answer.samples = hard.samples;
    answer.motion = motion_of(solution.bodies, compared_points);
    answer.state = state_of(solution);
    answer.x = solution.x;
    refine(hard, solution, rule, Work(most_refining_work), answer);
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

}  // namespace rotor_stator
