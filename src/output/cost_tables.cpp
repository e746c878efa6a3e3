#include "output/cost_tables.hpp"

#include <cmath>

#include "model/errors.hpp"

namespace rotor_stator
{

namespace
{

const char* const timed =
    "timed: the whole solution on one thread, tables and plans, start, transient or iteration; "
    "writing the motion down is timed for none";

const std::vector<Column> work_columns{
    {"case", "-", "number of the case in the header"},
    {"f", "Hz", "speed"},
    {"start", "-",
     "nothing: static load or quasi-static contact; below: the motion below"},
    {"method", "-", "aft: harmonic balance; rk4; GSL's; shooting- with one of them"},
    {"setting", "-", "m, N, tolerance, step [s], transient [s], closure"},
    {"found", "-", "whether it gave a motion"},
    {"cpu_s", "s", "CPU of one thread, median of the repetitions"},
    {"cpu_min_s", "s", "least"},
    {"cpu_max_s", "s", "most"},
    {"repetitions", "-", "fewer for the long runs"},
    {"error", "-", "largest relative error of displacement; -1 when not found"},
    {"error_force", "-", "largest relative error of force; -1 when not found"},
    {"force_share", "-", "of the CPU time in the bearing's force"},
    {"transform_share", "-", "of the CPU time in Fourier transforms"},
    {"evaluations", "-", "evaluations of the bearing's force, one instant each"},
    {"transforms", "-", "Fourier transforms of one series"},
    {"maps", "-", "periods integrated by shooting"},
    {"derivatives", "-", "of them with the variational equations"}};

const std::vector<Column> equal_error_columns{
    {"range", "Hz", "first and last T-periodic speed of the sweep"},
    {"target", "-", "largest error of displacement allowed"},
    {"method", "-", "aft: harmonic balance; rk4; GSL's; shooting- with one of them"},
    {"setting", "-", "the cheapest that reaches the target"},
    {"cpu_s", "s", "CPU of one thread for the whole range, median of the repetitions"},
    {"error", "-", "largest relative error of displacement over the speeds"},
    {"error_force", "-", "largest relative error of force over the speeds"},
    {"ratio", "-", "CPU over that of aft at the same target; 0 where aft has none"},
    {"cpu_min_s", "s", "least"},
    {"cpu_max_s", "s", "most"},
    {"repetitions", "-", "fewer for the long runs"},
    {"worst_f", "Hz", "speed with the largest error of displacement"},
    {"speeds", "-", "number of speeds"},
    {"evaluations", "-", "evaluations of the bearing's force, one instant each"},
    {"tried", "-", "settings tried"}};

const std::vector<Column> growth_columns{
    {"against", "-", "what grows: harmonics, balls or speeds"},
    {"size", "-", "how many of it"},
    {"cpu_s", "s", "CPU of one thread, median of the repetitions"},
    {"cpu_min_s", "s", "least"},
    {"cpu_max_s", "s", "most"},
    {"memory", "byte",
     "peak of memory above that of a process with one speed and one harmonic"},
    {"found", "-", "speeds with a solution"},
    {"of", "-", "speeds asked for"},
    {"exponent_cpu", "-", "of the fitted power law, the same for all sizes of the kind"},
    {"exponent_memory", "-", "the same for memory; 0 where there is too little to fit"}};

std::string list_of(const std::vector<double>& values)
{
  std::string list;
  for (double value : values) list += text(" %g", value);
  return list.empty() ? " none" : list;
}

}  // namespace

Table work_precision_table(const WorkPrecisionScene& scene)
{
  Table table("Work against precision: one periodic motion, every method", work_columns);
  const WorkPrecision result = compute_work_precision(scene);
  table.note(text("known motion below: %g Hz below the speed; %d repetitions",
                  scene.below, scene.repetitions));
  table.note(timed);
  table.note(text(
      "reference: shooting by rk8pd, tolerance %g; agreement: with harmonic balance, m = %d",
      scene.truth.tolerance, scene.reference_harmonics));
  for (std::size_t k = 0; k < result.cases.size(); ++k) {
    const WorkCase& c = result.cases[k];
    table.note(
        text("case %d: %g Hz, %s; Poincare spread %.2g, closure %.2g, agreement %.2g",
             c.number, c.truth.frequency, scene.sets[k].file.c_str(), c.truth.spread,
             c.truth.closure, c.agreement));
  }
  for (const WorkPoint& p : result.points)
    table.row({p.number, p.frequency, std::string(p.continued ? "below" : "nothing"),
               p.setting.method, p.setting.text(), p.found ? 1 : 0, p.cpu.median,
               p.cpu.least, p.cpu.most, p.repetitions, p.error, p.error_force,
               p.force_share, p.transform_share, p.counts.force_instants,
               p.counts.transforms, p.counts.maps, p.counts.derivatives});
  return table;
}

Table equal_error_table(const EqualErrorScene& scene)
{
  Table table(
      "CPU time of the same sweep at equal error, every method at its best setting",
      equal_error_columns);
  table.describe(scene.parameters);
  const EqualErrorResult result = compute_equal_error(scene);
  table.note(text(
      "modelled: speeds of %g to %g Hz with T-periodic motion, in order; %d repetitions",
      scene.frequencies.front(), scene.frequencies.back(), scene.repetitions));
  table.note(
      text("the search of a method in a range ends after %g s of CPU", scene.search));
  table.note(timed);
  table.note(text(
      "reference: shooting by rk8pd, tolerance %g, closure below %.2g, from time integration with Poincare spread below %.2g",
      scene.truth.tolerance, result.closure, result.spread));
  table.note("not T-periodic, left out [Hz]:" + list_of(result.aperiodic));
  table.note("the paper's ratios of RK4 to harmonic balance with 6, 8 and 10 harmonics:" +
             list_of(scene.paper_ratios));
  for (const NotReached& n : result.not_reached)
    table.note(
        std::isfinite(n.best)
            ? text("not reached: %s, %g-%g Hz, target %g; best %.2g", n.method.c_str(),
                   n.from, n.to, n.target, n.best)
            : text("not reached: %s, %g-%g Hz, target %g; no setting solves every speed",
                   n.method.c_str(), n.from, n.to, n.target));
  for (const EqualErrorRow& r : result.rows)
    table.row({text("%g-%g", r.from, r.to), r.target, r.setting.method, r.setting.text(),
               r.cpu.median, r.error.displacement, r.error.force, r.ratio, r.cpu.least,
               r.cpu.most, r.repetitions, r.error.worst_frequency, r.speeds,
               r.counts.force_instants, r.tried});
  return table;
}

Table cost_growth_table(const CostGrowthScene& scene)
{
  Table table("Growth of the cost of harmonic balance", growth_columns);
  table.describe(scene.parameters);
  const auto rows = compute_cost_growth(scene);
  table.note(
      text("against harmonics: one solution at %g Hz from that at %g Hz with the same m",
           scene.frequency, scene.below));
  table.note(
      text("against balls: a sweep of %d speeds from %g to %g Hz, m = %d, cage ratio %g",
           scene.sweep_speeds, scene.sweep_from, scene.sweep_to, scene.sweep_harmonics,
           scene.parameters.bearing.cage_speed_ratio));
  table.note(text("against speeds: the same sweep with more or fewer speeds, n = %d",
                  scene.parameters.bearing.balls));
  table.note(text("N above %d m; Newton's tolerance %g; %d repetitions",
                  scene.samples_per_harmonic, scene.newton_tolerance, scene.repetitions));
  table.note(text("exponents from harmonics = %d, balls = %d, speeds = %d, bytes = %g on",
                  scene.fitted_harmonics, scene.fitted_balls, scene.fitted_speeds,
                  scene.least_memory));
  for (const Growth& g : rows)
    table.row({g.against, g.size, g.cpu.median, g.cpu.least, g.cpu.most, g.memory,
               g.found, g.speeds, g.exponent_cpu, g.exponent_memory});
  return table;
}

}  // namespace rotor_stator
