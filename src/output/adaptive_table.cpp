#include "output/adaptive_table.hpp"

#include "model/errors.hpp"
#include "output/provenance.hpp"
#include "scenes/adaptive_study.hpp"
#include "scenes/resumable.hpp"

namespace rotor_stator
{

namespace
{

const std::vector<Column> columns{
    {"set", "-", "data set"},
    {"f", "Hz", "speed of rotation"},
    {"tolerance", "-", "wanted error of displacement"},
    {"reached", "-", "1 when the estimate is below the tolerance"},
    {"m", "-", "harmonics chosen; -1 when the tolerance was not reached"},
    {"N", "-", "samples chosen"},
    {"estimate", "-", "estimated error of displacement"},
    {"error", "-", "distance to the exact periodic motion; -1 when none was found"},
    {"effectivity", "-", "estimate over error; -1 without error"},
    {"own_branch", "-", "1: against another exact motion than the other tolerances"},
    {"searched", "-",
     "1: quasi-static contact was no start; the search is not in the cost"},
    {"cost", "-", "evaluations of the force times samples"},
    {"m_fixed", "-", "cheapest fixed m with at most that error; -1 when none"},
    {"error_fixed", "-", "its error"},
    {"cost_fixed", "-", "its cost"},
    {"ratio", "-", "cost over that of the fixed m"}};

/** A speed's rows one after the other, as a journal keeps them. */
Row numbers(const std::vector<AdaptivePoint>& points)
{
  Row row;
  const auto over = [](double a, double b) { return a > 0 && b > 0 ? a / b : -1; };
  for (const AdaptivePoint& p : points)
    row.insert(
        row.end(),
        {static_cast<double>(p.set), p.frequency, p.tolerance,
         static_cast<double>(p.reached), static_cast<double>(p.harmonics),
         static_cast<double>(p.samples), p.estimate, p.error, over(p.estimate, p.error),
         static_cast<double>(p.own_branch), static_cast<double>(p.started_otherwise),
         p.force_samples, static_cast<double>(p.fixed_harmonics), p.fixed_error,
         p.fixed_force_samples, over(p.force_samples, p.fixed_force_samples)});
  return row;
}

}  // namespace

Table adaptive_table(const std::string& scene_file, const std::string& journal)
{
  const AdaptiveStudy study = read_adaptive_study(scene_file, "exchanged");
  Table table("Error estimate, true error and cost of the adaptive number of harmonics",
              columns);
  std::vector<std::string> files{scene_file};
  for (const Parameters& parameters : study.sets) {
    table.describe(parameters);
    files.push_back(parameters.file);
  }
  table.note(
      text("modelled: harmonic balance; exact motions by shooting; fixed m up to %d",
           study.most_fixed_harmonics));
  const auto rows = run_study(
      {.name = "speeds",
       .journal = journal,
       .stamp = std::string(source_revision()) + " " + compiler() + " " + stamp_of(files),
       .pieces = study.speeds(),
       .work = [&](std::size_t k) { return numbers(adaptive_points(study, k)); }});
  for (const Row& row : rows)
    for (std::size_t k = 0; k < row.size(); k += columns.size())
      table.row({row.begin() + k, row.begin() + k + columns.size()});
  return table;
}

}  // namespace rotor_stator
