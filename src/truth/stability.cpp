#include "truth/stability.hpp"

#include <algorithm>
#include <cmath>

#include "balance/bearing_problem.hpp"
#include "continuation/arc_length.hpp"
#include "io/errors.hpp"
#include "motion/other_starts.hpp"
#include "motion/verdict.hpp"

namespace rotor_stator::truth {

StabilityScene read_stability_scene(SceneFile& file)
{
  StrictToml& toml = file.toml();
  StabilityScene scene{
      .sets = read_parameter_list(file, "parameters"),
      .curves = {},
      .from = toml.number("from_hz", Range::positive),
      .to = toml.number("to_hz", Range::positive),
      .most_evaluations = toml.integer("most_evaluations", 1, 100000000)};
  const auto harmonics = toml.integers("harmonics", 1, 4096);
  if (scene.from >= scene.to) toml.fail("to_hz", "must be above from_hz");
  toml.refuse_unknown_keys();
  for (int set = 1; set <= std::ssize(scene.sets); ++set)
    for (int m : harmonics) scene.curves.push_back({set, m});
  return scene;
}

namespace {

/** Whether a point without multipliers can be left out after `before`: no eye would miss it. */
bool dispensable(const StabilityPoint& point, const StabilityPoint& before)
{
  constexpr double speed = 0.1, amplitude = 0.03;  // [Hz], relative
  if (point.examined() || point.bifurcation != Bifurcation::none) return false;
  if (std::abs(point.frequency - before.frequency) > speed) return false;
  for (std::size_t k = 0; k < point.amplitude.size(); ++k)
    if (std::abs(point.amplitude[k] - before.amplitude[k]) >
        amplitude * before.amplitude[k])
      return false;
  return true;
}

std::vector<StabilityPoint> follow(const StabilityScene& scene,
                                   const StabilityCurve& curve, double from, double to)
{
  const Parameters& machine = scene.sets[curve.set - 1];
  const int samples = default_samples(curve.harmonics);
  StabilityBranch summary{curve, from};
  const PeriodicMotion start =
      motion::search_periodic({machine, angular(from), curve.harmonics, samples});
  if (!start.found()) return {{summary}};
  Balance balance(bearing_problem(machine, samples), curve.harmonics);
  ArcLengthSettings settings = arc_length_settings(machine);
  settings.most_evaluations = scene.most_evaluations;
  const Branch branch =
      follow_branch(balance, angular(from), angular(to), start.x, settings);
  const BranchStability stability =
      motion::machine_stability(machine, balance, branch, settings);
  summary.found = true;
  summary.end = branch.kind;
  summary.missed = stability.missed;
  summary.failed = stability.failed;
  summary.passed = static_cast<int>(branch.points.size());
  FourierTransform transform = amplitude_transform(curve.harmonics);
  std::vector<StabilityPoint> points;
  for (const StablePoint& at : stability.points) {
    StabilityPoint next{summary};
    next.frequency = at.point.motion.omega / angular(1);
    next.arc = at.point.arc;
    next.bifurcation = at.bifurcation;
    next.speed_uncertainty = at.uncertainty / angular(1);
    Eigen::Map<Eigen::Vector4d>(next.amplitude.data()) =
        half_peak_to_peak(body_series(machine, at.point.motion), transform);
    if (at.examined()) {
      next.largest = at.floquet.largest();
      next.uncertainty = at.floquet.uncertainty();
      next.stable = at.floquet.stable_number();
    }
    summary.low = std::min(summary.low, next.frequency);
    summary.high = std::max(summary.high, next.frequency);
    if (points.empty() || !dispensable(next, points.back())) points.push_back(next);
  }
  for (StabilityPoint& point : points) static_cast<StabilityBranch&>(point) = summary;
  return points;
}

}  // namespace

std::vector<StabilityPoint> follow_stability(const StabilityScene& scene,
                                             const StabilityCurve& curve)
{
  std::vector<StabilityPoint> points = follow(scene, curve, scene.from, scene.to);
  if (points.front().end != BranchEnd::goal)
    for (const StabilityPoint& point : follow(scene, curve, scene.to, scene.from))
      points.push_back(point);
  return points;
}

namespace {

/** In the order of BranchEnd. */
const char* const ends[] = {
    "the end of the range", "it came back to where the range begins",
    "it is closed",         "it met itself",
    "the bound on work",    "the bound on points",
    "the bound on the step"};

/** What the branch of these points came to, in a line of the header. */
std::string summary(int number, const std::vector<StabilityPoint>& points)
{
  const StabilityBranch& branch = points.front();
  const int m = branch.harmonics;
  const std::string name = format("curve %d: set %d, m = %d, N = %d, from %g Hz", number,
                                  branch.set, m, default_samples(m), branch.from);
  if (!branch.found) return name + ": no solution found there";
  const auto count = [&](Bifurcation kind) {
    return std::ranges::count(points, kind, &StabilityPoint::bifurcation);
  };
  const auto examined = std::ranges::count_if(points, &StabilityPoint::examined);
  return name + format(
                    ": followed between %.6g and %.6g Hz, %d points, multipliers at %zd, "
                    "not had at %d; %zd folds, %zd plus-one, %zd period doublings, %zd "
                    "Neimark-Sacker, %d not located; stopped at %.6g Hz: %s",
                    branch.low, branch.high, branch.passed, examined, branch.failed,
                    count(Bifurcation::fold), count(Bifurcation::plus_one),
                    count(Bifurcation::period_doubling),
                    count(Bifurcation::neimark_sacker), branch.missed,
                    points.back().frequency, ends[static_cast<int>(branch.end)]);
}

/** With so many digits: tens of thousands of rows are kept. */
double rounded(double value, int digits)
{
  return std::stod(format("%.*g", digits, value));
}

struct Row : StabilityPoint {
  int number;  ///< of the branch
};

const std::vector<Field<Row>> fields{
    {"set", "-", "data set", &Row::set},
    {"curve", "-", "counts the branches, in the order of the scene", &Row::number},
    {"harmonics", "-", "m", &Row::harmonics},
    {"f", "Hz", "speed of rotation", [](auto& p) { return rounded(p.frequency, 12); }},
    {"amp_x_s", "m", "half peak-to-peak of x_s",
     [](auto& p) { return rounded(p.amplitude[0], 7); }},
    {"amp_y_s", "m", "half peak-to-peak of y_s",
     [](auto& p) { return rounded(p.amplitude[1], 7); }},
    {"amp_x_r", "m", "half peak-to-peak of x_r",
     [](auto& p) { return rounded(p.amplitude[2], 7); }},
    {"amp_y_r", "m", "half peak-to-peak of y_r",
     [](auto& p) { return rounded(p.amplitude[3], 7); }},
    {"arc", "-", "scaled arc length from the branch's first point",
     [](auto& p) { return rounded(p.arc, 9); }},
    {"largest_multiplier", "-",
     "modulus; of the motion of Eq. 7 found there; -1 if not examined or not found",
     [](auto& p) { return rounded(p.largest, 9); }},
    {"change", "-", "uncertainty of it",
     [](auto& p) { return rounded(p.uncertainty, 2); }},
    {"stable", "-",
     "the machine: 1 stable, 0 unstable, -1 within the uncertainty, -2 not examined or no motion found",
     &Row::stable},
    {"bifurcation", "-",
     "of the machine: plus-one, period-doubling: a multiplier passes 1, -1; neimark-sacker: "
     "a pair passes the circle; of the m harmonics: fold; - none",
     [](auto& p) { return std::string(name_of(p.bifurcation)); }},
    {"speed_uncertainty", "Hz", "of the machine's bifurcation",
     [](auto& p) { return rounded(p.speed_uncertainty, 2); }}};

}  // namespace

Table stability_table(const StabilityScene& scene,
                      const std::vector<std::vector<StabilityPoint>>& points)
{
  Table table("Stability along the response curves", fields);
  for (const Parameters& machine : scene.sets) describe(table, machine);
  table.note(
      "modelled: harmonic balance by arc length; near each point a motion of Eq. 7 by "
      "shooting, and its Floquet multipliers");
  int number = 0;
  for (const auto& of_curve : points)
    for (auto first = of_curve.begin(); first != of_curve.end();) {
      const auto last = std::find_if(first, of_curve.end(),
                                     [&](auto& p) { return p.from != first->from; });
      table.note(summary(++number, {first, last}));
      for (; first != last; ++first)
        if (first->found) table.row(fields, {*first, number});
      table.gap();
    }
  return table;
}

}  // namespace rotor_stator::truth
