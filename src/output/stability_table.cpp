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
    {"largest_multiplier", "-",
     "modulus; of the linearisation along the m harmonics; -1 if not examined"},
    {"change", "-", "uncertainty of it: its change at the last refinement"},
    {"settled", "-", "1 if no multiplier changes by more than 1e-6"},
    {"stable", "-", "1 stable, 0 unstable, -1 within the uncertainty, -2 not examined"},
    {"bifurcation", "-",
     "fold; plus-one, period-doubling: a multiplier passes 1, -1; neimark-sacker: a pair "
     "passes the circle; - none"}};

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

/** With so many digits: tens of thousands of rows are kept. */
double short_number(double value, int digits)
{
  return std::stod(text("%.*g", digits, value));
}

/** What a branch came to, in a line of the header. */
std::string summary(std::size_t number, const StabilityCurve& curve,
                    const StabilityBranch& branch)
{
  const std::string name =
      text("curve %zu: set %d, m = %d, N = %d, from %g Hz", number, curve.set,
           curve.harmonics, default_samples(curve.harmonics), branch.from);
  if (branch.points.empty()) return name + ": no solution found there";
  const auto count = [&](Bifurcation kind) {
    return std::count_if(branch.points.begin(), branch.points.end(),
                         [&](const auto& p) { return p.bifurcation == kind; });
  };
  const auto examined = std::count_if(branch.points.begin(), branch.points.end(),
                                      [](const auto& p) { return p.stable != -2; });
  return name + text(
                    ": followed between %.6g and %.6g Hz, %d points, multipliers at %zd, "
                    "not had at %d; %zd folds, %zd plus-one, %zd period doublings, %zd "
                    "Neimark-Sacker, %d not located; stopped at %.6g Hz: %s",
                    branch.low, branch.high, branch.passed, examined, branch.failed,
                    count(Bifurcation::fold), count(Bifurcation::plus_one),
                    count(Bifurcation::period_doubling),
                    count(Bifurcation::neimark_sacker), branch.missed,
                    branch.points.back().frequency, word(branch.end));
}

void add_rows(Table& table, std::size_t number, const StabilityCurve& curve,
              const StabilityBranch& branch)
{
  for (const StabilityPoint& p : branch.points)
    table.row({curve.set, number, curve.harmonics, short_number(p.frequency, 12),
               short_number(p.amplitude[0], 7), short_number(p.amplitude[1], 7),
               short_number(p.amplitude[2], 7), short_number(p.amplitude[3], 7),
               short_number(p.arc, 9), short_number(p.largest, 9),
               short_number(p.uncertainty, 2), p.settled, p.stable,
               std::string(name_of(p.bifurcation))});
  if (!branch.points.empty()) table.gap();
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
  table.note(text(
      "multipliers: of at most %d points per hertz, those added between them and where "
      "stability changes; bifurcations between two unstable points are not looked for",
      scene.examined_per_hz));
  const auto curves = compute_stability(
      scene, journal, source_revision() + " " + compiler() + " " + stamp_of(files));
  std::size_t number = 0;
  for (std::size_t k = 0; k < curves.size(); ++k)
    for (const StabilityBranch& branch : curves[k]) {
      const StabilityCurve& curve = scene.curves[k];
      table.note(summary(++number, curve, branch));
      add_rows(table, number, curve, branch);
    }
  return table;
}

}  // namespace rotor_stator
