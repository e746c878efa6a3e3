#include "output/explore_stability.hpp"

#include <algorithm>

#include "model/errors.hpp"
#include "scenes/scene_file.hpp"

namespace rotor_stator
{

namespace
{

/** Operations for one value of the stiffness along m harmonics, with the disturbances' step. */
double stiffness_cost(const Parameters& parameters, int harmonics)
{
  return 300 + 2.0 * parameters.bearing.balls + 5.0 * harmonics;
}

/** Operations for the phases where balls meet or leave their race. */
double contact_changes_cost(const Parameters& parameters, int harmonics)
{
  return std::max(512.0, 16.0 * harmonics) *
         (50 + 5.0 * parameters.bearing.balls + 5.0 * harmonics);
}

/** The multipliers at a point, taken from the account. */
Floquet paid_floquet(const Work& work, const Parameters& parameters,
                     const BranchPoint& point, int harmonics)
{
  work.spend(contact_changes_cost(parameters, harmonics));
  const double evaluation = stiffness_cost(parameters, harmonics);
  const FloquetSettings settings =
      affordable_floquet(parameters, harmonics, work.left());
  try {
    const Floquet found = floquet(parameters, point.omega, point.x, settings);
    work.spend(evaluation * static_cast<double>(found.evaluations));
    return found;
  } catch (const NoSolution&) {
    /** How far it came is not known: all that it was allowed is taken, and where that was all there
        is, the account says so. */
    const auto most = static_cast<double>(settings.first.most_evaluations + 1);
    work.spend(3 * evaluation * most);
    throw;
  }
}

int count_of(const BranchStability& stability, Bifurcation kind)
{
  return static_cast<int>(
      std::count_if(stability.points.begin(), stability.points.end(),
                    [&](const StablePoint& p) { return p.bifurcation == kind; }));
}

}  // namespace

FloquetSettings affordable_floquet(const Parameters& parameters, int harmonics,
                                   double operations)
{
  FloquetSettings settings;
  const double evaluations = operations / 3 / stiffness_cost(parameters, harmonics);
  settings.first.most_evaluations = static_cast<long>(std::min(
      static_cast<double>(settings.first.most_evaluations), std::max(evaluations, 0.0)));
  return settings;
}

BranchStability stability_within(const Work& work, const Parameters& parameters,
                                 Balance& balance, const Branch& branch,
                                 const ArcLengthSettings& settings)
{
  const auto floquet_at = [&](const BranchPoint& point) {
    return paid_floquet(work, parameters, point, balance.harmonics());
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
  std::vector<std::string> notes{text(
      "stability: %d folds, %d plus-one, %d period doublings, %d Neimark-Sacker points, "
      "speeds to %g, relative; %d not located",
      count_of(stability, Bifurcation::fold), count_of(stability, Bifurcation::plus_one),
      count_of(stability, Bifurcation::period_doubling),
      count_of(stability, Bifurcation::neimark_sacker),
      BranchStabilitySettings{}.tolerance, stability.missed)};
  for (const StablePoint& p : stability.points)
    if (p.bifurcation != Bifurcation::none)
      notes.push_back(
          text("%s: %.9g Hz", name_of(p.bifurcation), p.point.omega / angular(1)));
  return notes;
}

std::string missing_stability(const BranchStability& stability, const Work& work)
{
  if (stability.failed == 0)
    return work.used_up() && stability.missed > 0
               ? text("%d bifurcations not located: the work allowed is used up",
                      stability.missed)
               : "";
  const auto first = std::find_if(stability.points.begin(), stability.points.end(),
                                  [](const StablePoint& p) { return !p.examined(); });
  return text("no multipliers at %d of %zu points, the first at %.6g Hz: %s",
              stability.failed, stability.points.size(), first->point.omega / angular(1),
              stability.failure.c_str());
}

}  // namespace rotor_stator
