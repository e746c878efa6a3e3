#include "explore/stability.hpp"

#include <algorithm>
#include <numbers>

#include "io/errors.hpp"
#include "io/scene.hpp"

namespace rotor_stator::explore
{

namespace
{

int count_of(const BranchStability& stability, Bifurcation kind)
{
  return static_cast<int>(
      std::count_if(stability.points.begin(), stability.points.end(),
                    [&](const StablePoint& p) { return p.bifurcation == kind; }));
}

}  // namespace

Floquet paid_floquet(const OperationBudget& budget, const Parameters& parameters,
                     double omega, const Eigen::VectorXd& x)
{
  const double balls = parameters.bearing.balls;
  const auto harmonics = static_cast<double>(x.size() / 4);
  /** The phases where balls meet or leave their race; then the stiffness, value by value, each with its
      step of the disturbances. */
  const double share = 1 / operations_per_evaluation(parameters.bearing.balls);
  budget.spend(share * std::max(512.0, 16 * harmonics) *
               (50 + 5 * balls + 5 * harmonics));
  PeriodicStiffness stiffness = stiffness_along(parameters, x);
  stiffness.at = [at = std::move(stiffness.at), budget,
                  value = share * (300 + 2 * balls + 5 * harmonics)](double phase,
                                                                     double* k) {
    budget.spend(value);
    at(phase, k);
  };
  return floquet(vibration_of(parameters), stiffness, 2 * std::numbers::pi / omega);
}

BranchStability stability_within(const OperationBudget& budget,
                                 const Parameters& parameters, Balance& balance,
                                 const Branch& branch, const ArcLengthSettings& settings)
{
  const auto floquet_at = [&](const BranchPoint& point) {
    return paid_floquet(budget, parameters, point.omega, point.x);
  };
  return stability_along(balance, branch, settings, floquet_at);
}

std::vector<Column> stability_columns()
{
  return {{"multiplier", "-",
           "largest modulus of the Floquet multipliers along the m harmonics; -1"},
          {"multiplier_change", "-", "uncertainty of it: change at the last refinement"},
          {"verdict", "-", "stable, unstable, undecided within the uncertainty, unknown"},
          {"bifurcation", "-",
           "fold; plus-one, period-doubling: a multiplier passes 1, -1; "
           "neimark-sacker: a pair passes the circle; - none"}};
}

std::vector<Cell> stability_cells(const StablePoint& point)
{
  const std::string name = name_of(point.bifurcation);
  if (!point.examined()) return {-1, -1, std::string("unknown"), name};
  const Floquet& floquet = point.floquet;
  return {floquet.largest(), floquet.uncertainty(), std::string(floquet.verdict()), name};
}

std::vector<std::string> stability_notes(const BranchStability& stability)
{
  std::vector<std::string> notes{format(
      "stability: %d folds, %d plus-one, %d period doublings, %d Neimark-Sacker points, "
      "speeds to %g, relative; %d not located",
      count_of(stability, Bifurcation::fold), count_of(stability, Bifurcation::plus_one),
      count_of(stability, Bifurcation::period_doubling),
      count_of(stability, Bifurcation::neimark_sacker),
      BranchStabilitySettings{}.tolerance, stability.missed)};
  for (const StablePoint& p : stability.points)
    if (p.bifurcation != Bifurcation::none)
      notes.push_back(
          format("%s: %.9g Hz", name_of(p.bifurcation), p.point.omega / angular(1)));
  return notes;
}

std::string missing_stability(const BranchStability& stability,
                              const OperationBudget& budget)
{
  if (stability.failed == 0)
    return budget.used_up()
               ? format(
                     "the budget is used up, more with --budget: bifurcations may be missing, %d were "
                     "seen and not located",
                     stability.missed)
               : "";
  const auto first = std::find_if(stability.points.begin(), stability.points.end(),
                                  [](const StablePoint& p) { return !p.examined(); });
  return format("no multipliers at %d of %zu points, the first at %.6g Hz: %s",
                stability.failed, stability.points.size(),
                first->point.omega / angular(1), stability.failure.c_str());
}

}  // namespace rotor_stator::explore
