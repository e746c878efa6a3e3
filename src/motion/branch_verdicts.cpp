#include "motion/branch_verdicts.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "balance/bearing_problem.hpp"
#include "io/errors.hpp"
#include "motion/judge.hpp"

namespace rotor_stator::motion {

namespace {

/** The multipliers point after point of a branch: shooting starts from the two nearest
    motions along it too. */
class Along {
public:
  Along(const Parameters& parameters, const OperationBudget& budget)
      : parameters_(parameters), budget_(budget),
        most_(std::max(2e6, 0.04 * std::min(budget.left(), 2e9)))
  {
  }

  Floquet operator()(const BranchPoint& point)
  {
    PeriodicMotion solution = point.motion;
    solution.bodies = body_series(parameters_, solution);
    const Verdict verdict = nearest_motion(
        parameters_, solution, budget_.part(std::min(1.0, most_ / budget_.left())),
        starts_near(point));
    if (!verdict.found()) throw NoSolution(verdict.reason);
    found_.push_back({point.arc, solution.omega, verdict.at});
    return verdict.floquet;
  }

private:
  struct Found {
    double arc, omega;
    Eighths at;
  };

  /** On the line through the two motions nearest along the branch, of those whose speed
      differs by at most 1 % of the joint resonance. */
  std::vector<Eighths> starts_near(const BranchPoint& point) const
  {
    auto near = found_;
    const double reach = 0.01 * joint_resonance(parameters_) / parameters_.turns;
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

  const Parameters& parameters_;
  OperationBudget budget_;
  double most_;  ///< evaluations at one point
  std::vector<Found> found_ = {};
};

}  // namespace

BranchStability machine_stability(const Parameters& parameters, Curve& curve,
                                  const Branch& branch,
                                  const ArcLengthSettings& arc_length,
                                  const OperationBudget& budget)
{
  const double width = 0.004 * joint_resonance(parameters) / parameters.turns;
  Along multipliers(parameters, budget);
  return stability_along(curve, branch, arc_length, std::ref(multipliers),
                         {.chosen = evenly_chosen(branch, width, 2), .widest = width});
}

}  // namespace rotor_stator::motion
