#include "output/stability_table.hpp"

#include <algorithm>

#include "model/errors.hpp"
#include "output/provenance.hpp"
#include "scenes/stability_map.hpp"

namespace rotor_stator
{

namespace
{

const std::vector<Column> columns{
    {"set", "-", "data set"},
    {"curve", "-", "counts the branches, in the order of the scene"},
    {"harmonics", "-", "m"},
    {"f", "Hz", "speed of rotation"},
    {"amp_x_s", "m", "half peak-to-peak of x_s"},
    {"amp_y_s", "m", "half peak-to-peak of y_s"},
    {"amp_x_r", "m", "half peak-to-peak of x_r"},
    {"amp_y_r", "m", "half peak-to-peak of y_r"},
    {"arc", "-", "scaled arc length from the branch's first point"},
    {"largest_multiplier", "-", "modulus; of the linearisation along the m harmonics"},
    {"change", "-", "uncertainty of it: its change at the last refinement"},
    {"settled", "-", "1 if no multiplier changes by more than 1e-6"},
    {"stable", "-", "1 stable, 0 unstable, -1 within the uncertainty"},
    {"bifurcation", "-",
     "fold; plus-one, period-doubling: a multiplier passes 1, -1; neimark-sacker: a pair "
     "passes the circle; - none"}};

std::string word(Bifurcation bifurcation)
{
  switch (bifurcation) {
    case Bifurcation::fold:
      return "fold";
    case Bifurcation::plus_one:
      return "plus-one";
    case Bifurcation::period_doubling:
      return "period-doubling";
    case Bifurcation::neimark_sacker:
      return "neimark-sacker";
    default:
      return "-";
  }
}

const char* word(BranchEnd end)
{
  switch (end) {
    case BranchEnd::goal:
      return "the end of the range";
    case BranchEnd::came_back:
      return "it came back to where the range begins";
    case BranchEnd::closed:
      return "it is closed";
    case BranchEnd::on_itself:
      return "it met itself";
    case BranchEnd::points:
      return "the bound on points";
    case BranchEnd::work:
      return "the bound on work";
    default:
      return "the bound on the step";
  }
}

/** What a branch came to, in a line of the header. */
std::string summary(std::size_t number, const StabilityCurve& curve,
                    const StabilityBranch& branch)
{
  const std::string name =
      text("curve %zu: set %d, m = %d, N = %d, from %g Hz", number, curve.set,
           curve.harmonics, default_samples(curve.harmonics), curve.from);
  if (branch.points.empty()) return name + ": no solution found there";
  const auto count = [&](Bifurcation kind) {
    return std::count_if(branch.points.begin(), branch.points.end(),
                         [&](const auto& p) { return p.bifurcation == kind; });
  };
  return name + text(
                    ": %zu points, %zd folds, %zd plus-one, %zd period doublings, %zd "
                    "Neimark-Sacker, %d not located; ended at %.6g Hz: %s",
                    branch.points.size(), count(Bifurcation::fold),
                    count(Bifurcation::plus_one), count(Bifurcation::period_doubling),
                    count(Bifurcation::neimark_sacker), branch.missed,
                    branch.points.back().frequency, word(branch.end));
}

}  // namespace

Table stability_table(const std::string& scene_file, const std::string& reading,
                      const std::string& journal)
{
  const StabilityScene scene = read_stability_scene(scene_file, reading);
  Table table("Stability along the response curves", columns);
  std::vector<std::string> files{scene_file};
  for (const Parameters& parameters : scene.sets) {
    table.describe(parameters);
    files.push_back(parameters.file);
  }
  table.note(
      "modelled: harmonic balance by arc length, Floquet multipliers of the full "
      "system along each solution");
  const auto branches = compute_stability(
      scene, journal, source_revision() + " " + compiler() + " " + stamp_of(files));
  for (std::size_t k = 0; k < branches.size(); ++k) {
    const StabilityCurve& curve = scene.curves[k];
    table.note(summary(k + 1, curve, branches[k]));
    for (const StabilityPoint& p : branches[k].points)
      table.row({curve.set, k + 1, curve.harmonics, p.frequency, p.amplitude[0],
                 p.amplitude[1], p.amplitude[2], p.amplitude[3], p.arc, p.largest,
                 p.uncertainty, p.settled, p.stable, word(p.bifurcation)});
    if (!branches[k].points.empty()) table.gap();
  }
  return table;
}

}  // namespace rotor_stator
