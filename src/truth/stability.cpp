#include "truth/stability.hpp"

#include <algorithm>
#include <cmath>

#include "balance/bearing_problem.hpp"
#include "continuation/arc_length.hpp"
#include "io/errors.hpp"
#include "io/table.hpp"
#include "motion/other_starts.hpp"

namespace rotor_stator::truth
{

StabilityScene read_stability_scene(const std::string& file, const std::string& reading)
{
  SceneFile scene_file(file, reading);
  StrictToml& toml = scene_file.toml();
  StabilityScene scene{.sets = read_parameter_list(scene_file, "parameters"),
                       .curves = {},
                       .from = toml.number("from_hz", Range::positive),
                       .to = toml.number("to_hz", Range::positive),
                       .most_evaluations = toml.integer("most_evaluations", 1, 100000000),
                       .examined_per_hz = toml.integer("examined_per_hz", 1, 1000000)};
  const auto harmonics = toml.integers("harmonics", 1, 4096);
  if (scene.from >= scene.to) toml.fail("to_hz", "must be above from_hz");
  toml.refuse_unknown_keys();
  for (int set = 1; set <= static_cast<int>(scene.sets.size()); ++set)
    for (int m : harmonics) scene.curves.push_back({set, m});
  return scene;
}

namespace
{

StabilityPoint shown(const Parameters& parameters, FourierTransform& transform,
                     const StablePoint& p)
{
  const Eigen::VectorXd amplitude =
      half_peak_to_peak(body_series(parameters, p.point.motion), transform);
  StabilityPoint point{p.point.motion.omega / angular(1),
                       {amplitude[0], amplitude[1], amplitude[2], amplitude[3]},
                       p.point.arc,
                       -1,
                       -1,
                       false,
                       -2,
                       p.bifurcation};
  if (!p.examined()) return point;
  point.largest = p.floquet.largest();
  point.uncertainty = p.floquet.uncertainty();
  point.settled = p.floquet.settled;
  point.stable = p.floquet.stable_number();
  return point;
}

/** Whether a point without multipliers can be left out after `before`: no eye would miss it. */
bool dispensable(const StabilityPoint& point, const StabilityPoint& before)
{
  constexpr double speed = 0.1, amplitude = 0.03;  // [Hz], relative
  if (point.stable != -2 || point.bifurcation != Bifurcation::none) return false;
  if (std::abs(point.frequency - before.frequency) > speed) return false;
  for (std::size_t k = 0; k < point.amplitude.size(); ++k)
    if (std::abs(point.amplitude[k] - before.amplitude[k]) >
        amplitude * before.amplitude[k])
      return false;
  return true;
}

/** The branches of a curve as one row of a journal, and back. */
void append(Row& row, const StabilityBranch& branch)
{
  row.insert(row.end(),
             {static_cast<double>(branch.points.size()), branch.from,
              static_cast<double>(branch.end), static_cast<double>(branch.missed),
              static_cast<double>(branch.failed), static_cast<double>(branch.passed),
              branch.low, branch.high});
  for (const StabilityPoint& p : branch.points)
    row.insert(row.end(), {p.frequency, p.amplitude[0], p.amplitude[1], p.amplitude[2],
                           p.amplitude[3], p.arc, p.largest, p.uncertainty,
                           static_cast<double>(p.settled), static_cast<double>(p.stable),
                           static_cast<double>(p.bifurcation)});
}

std::vector<StabilityBranch> from_row(const Row& row)
{
  std::vector<StabilityBranch> branches;
  for (auto n = row.begin(); n != row.end();) {
    const auto points = static_cast<std::size_t>(*n++);
    const double from = *n++;
    StabilityBranch branch{{}, from, static_cast<BranchEnd>(*n++), 0, 0, 0, from, from};
    for (int* count : {&branch.missed, &branch.failed, &branch.passed})
      *count = static_cast<int>(*n++);
    branch.low = *n++;
    branch.high = *n++;
    for (std::size_t k = 0; k < points; ++k, n += 11)
      branch.points.push_back({n[0],
                               {n[1], n[2], n[3], n[4]},
                               n[5],
                               n[6],
                               n[7],
                               n[8] != 0,
                               static_cast<int>(n[9]),
                               static_cast<Bifurcation>(n[10])});
    branches.push_back(std::move(branch));
  }
  return branches;
}

StabilityBranch follow(const StabilityScene& scene, const StabilityCurve& curve,
                       double from, double to)
{
  const Parameters& parameters = scene.sets[curve.set - 1];
  const int samples = default_samples(curve.harmonics);
  StabilityBranch result{{}, from, BranchEnd::step, 0, 0, 0, from, from};
  const PeriodicMotion start =
      motion::search_periodic(parameters, angular(from), curve.harmonics, samples);
  if (!start.found()) return result;
  Balance balance(bearing_problem(parameters, samples), curve.harmonics);
  ArcLengthSettings settings = arc_length_settings(parameters);
  settings.most_evaluations = scene.most_evaluations;
  const Branch branch =
      follow_branch(balance, angular(from), angular(to), start.x, settings);
  const BranchStability stability =
      stability_along(balance, branch, settings,
                      [&](const BranchPoint& p) { return floquet(parameters, p.motion); },
                      {.chosen = evenly_chosen(branch, angular(1), scene.examined_per_hz),
                       .among_unstable = false});
  result.end = branch.kind;
  result.missed = stability.missed;
  result.failed = stability.failed;
  result.passed = static_cast<int>(branch.points.size());
  FourierTransform transform = amplitude_transform(curve.harmonics);
  for (const StablePoint& point : stability.points) {
    StabilityPoint next = shown(parameters, transform, point);
    result.low = std::min(result.low, next.frequency);
    result.high = std::max(result.high, next.frequency);
    if (result.points.empty() || !dispensable(next, result.points.back()))
      result.points.push_back(next);
  }
  return result;
}

}  // namespace

std::vector<StabilityBranch> follow_stability(const StabilityScene& scene,
                                              const StabilityCurve& curve)
{
  std::vector<StabilityBranch> branches{follow(scene, curve, scene.from, scene.to)};
  if (branches[0].points.empty() || branches[0].end != BranchEnd::goal)
    branches.push_back(follow(scene, curve, scene.to, scene.from));
  return branches;
}

std::vector<std::vector<StabilityBranch>> compute_stability(const StabilityScene& scene,
                                                            const std::string& journal,
                                                            const std::string& stamp)
{
  /** The last first: a set's curve with the most harmonics takes longest. */
  const std::vector<StabilityCurve> pieces(scene.curves.rbegin(), scene.curves.rend());
  const auto rows =
      run_study({.name = "branches",
                 .journal = journal,
                 .stamp = stamp,
                 .pieces = pieces.size(),
                 .work = [&](std::size_t k) {
                   Row row;
                   for (const auto& branch : follow_stability(scene, pieces[k]))
                     append(row, branch);
                   return row;
                 }});
  std::vector<std::vector<StabilityBranch>> branches;
  for (auto row = rows.rbegin(); row != rows.rend(); ++row)
    branches.push_back(from_row(*row));
  return branches;
}

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
  return std::stod(format("%.*g", digits, value));
}

/** What a branch came to, in a line of the header. */
std::string summary(std::size_t number, const StabilityCurve& curve,
                    const StabilityBranch& branch)
{
  const std::string name =
      format("curve %zu: set %d, m = %d, N = %d, from %g Hz", number, curve.set,
             curve.harmonics, default_samples(curve.harmonics), branch.from);
  if (branch.points.empty()) return name + ": no solution found there";
  const auto count = [&](Bifurcation kind) {
    return std::count_if(branch.points.begin(), branch.points.end(),
                         [&](const auto& p) { return p.bifurcation == kind; });
  };
  const auto examined = std::count_if(branch.points.begin(), branch.points.end(),
                                      [](const auto& p) { return p.stable != -2; });
  return name + format(
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
    describe(table, parameters);
    files.push_back(parameters.file);
  }
  table.note(
      "modelled: harmonic balance by arc length, Floquet multipliers of the full "
      "system along each solution");
  table.note(format(
      "multipliers: of at most %d points per hertz, those added between them and where "
      "stability changes; bifurcations between two unstable points are not looked for",
      scene.examined_per_hz));
  const auto curves = compute_stability(scene, journal, stamp_of(files));
  std::size_t number = 0;
  for (std::size_t k = 0; k < curves.size(); ++k)
    for (const StabilityBranch& branch : curves[k]) {
      const StabilityCurve& curve = scene.curves[k];
      table.note(summary(++number, curve, branch));
      add_rows(table, number, curve, branch);
    }
  return table;
}

}  // namespace rotor_stator::truth
