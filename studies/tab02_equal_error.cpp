/**
# Computing time at equal error

Paper: §3.3, 9.0, 8.2 and 7.5 times faster than RK4 (claim C9).

    make tab02_equal_error

Every method solves the sweep of Table 2 with its cheapest settings that stay below an
error at every speed. Which method is the fastest depends on that error. A method that
never stays below it is named in the header, with the least error that it reaches. Speeds
at which the motion has not the period of rotation are left out and listed, since no error
of a periodic motion is defined there. The two ranges lie below and above the transition
at 25 Hz.

The settings of a method, for harmonic balance the numbers m and N, for Runge-Kutta the
step and the transient, are found by trying, with the true motions at hand: one setting
for all speeds of a range, or another one at each speed, whichever takes less time.

`rk4` integrates one motion at a time, from speed to speed, and is what the paper compares
with. `splitting` is the rule of order four with which `explore` integrates
(time/fixed_step.hpp). `rk4-lanes` and `splitting-lanes` are the same integrators with all
speeds side by side in the registers of the processor. `central` are central differences,
which need one force per step, and `rk8` is the pair of Dormand and Prince of order eight;
both are compiled like `rk4`. `rkf45` and the implicit and multistep methods are GSL's,
whose calls take time of their own.

Other people's programs stand with the figure `peers`: the integrators of SUNDIALS and of
SciPy, which call the same force, and AUTO-07p, which follows the response by collocation.
SciPy's are called from Python, which costs them more per evaluation than the C++
programs; the header of their table has both numbers. AUTO's curve agrees with ours to
drawing accuracy, and has folds that few harmonics do not show.

The error is the largest difference of a displacement over the largest displacement. At
low speeds that is mostly the static sag of the suspension, and an error of the vibration
hides behind it: with `--error mean` the targets bound the root mean square of the
difference about the mean, over that of the motion, instead. The column error_mean has
that error of what is printed.

The CPU time is that of one thread for the whole sweep, the median of several repetitions.
The table has the least and the largest of them, the setting, and the error that was
reached.

Modelled: the speeds with T-periodic motion, below and above 25 Hz. */
#include <algorithm>
#include <cmath>

#include "costs/equal_error.hpp"
#include "io/errors.hpp"
#include "io/program.hpp"

namespace {

using namespace rotor_stator;
using namespace rotor_stator::costs;

/** `error`: "largest" or "mean". */
EqualErrorScene read_equal_error(SceneFile& file, const std::string& error)
{
  if (error != "largest" && error != "mean")
    throw BadInput("--error " + error + ": must be largest or mean");
  StrictToml& toml = file.toml();
  EqualErrorScene scene{
      .parameters = read_parameters(file, "parameters"),
      .frequencies = file.speed_range("speeds_hz"),
      .range_ends = toml.numbers("range_ends_hz", Range::positive),
      .targets = toml.numbers("targets", Range::positive),
      .paper_ratios = toml.numbers("paper_ratios", Range::positive),
      .candidates = read_candidates(toml),
      .repetitions = toml.integer("repetitions", 1, 1000),
      .search = toml.number("search_s", Range::positive),
      .truth = {.settling = read_steady_settings(file)},
      .error = error == "mean" ? &MotionError::mean : &MotionError::displacement};
  if (!std::is_sorted(scene.range_ends.begin(), scene.range_ends.end()))
    toml.fail("range_ends_hz", "must rise");
  if (scene.range_ends.back() < scene.frequencies.back())
    toml.fail("range_ends_hz", "must end at or above the last speed");
  if (!std::is_sorted(scene.targets.rbegin(), scene.targets.rend()))
    toml.fail("targets", "must fall");
  toml.refuse_unknown_keys();
  return scene;
}

using Row = EqualErrorRow;

const std::vector<Field<Row>> equal_error_fields{
    {"range", "Hz", "first and last T-periodic speed of the sweep", &Row::range},
    {"target", "-", "largest error allowed", &Row::target},
    {"method", "-",
     "aft: harmonic balance; rk4; splitting; -lanes: all speeds side by side; central "
     "differences; rk8; GSL's; shooting- with one of them",
     [](auto& r) { return r.schedule.method(); }},
    {"setting", "-",
     "the cheapest that reaches the target; least..most where it differs by speed",
     [](auto& r) { return r.schedule.text(); }},
    {"cpu_s", "s", "CPU of one thread for the whole range, median of the repetitions",
     &Row::median},
    {"error", "-", "largest relative error of displacement over the speeds",
     &Row::displacement},
    {"error_force", "-", "largest relative error of force over the speeds", &Row::force},
    {"ratio", "-", "CPU over that of aft at the same target; 0 where aft has none",
     &Row::ratio},
    {"cpu_min_s", "s", "least", &Row::least},
    {"cpu_max_s", "s", "most", &Row::most},
    {"worst_f", "Hz", "speed with the largest error of displacement",
     &Row::worst_frequency},
    {"speeds", "-", "number of speeds", &Row::speeds},
    {"evaluations", "-", "evaluations of the bearing's force, one instant each",
     &Row::force_instants},
    {"tried", "-", "settings tried", &Row::tried},
    {"error_mean", "-", "largest rms error about the mean over the speeds", &Row::mean}};

Table equal_error_table(const EqualErrorScene& scene, const References& references,
                        const std::vector<EqualErrorRow>& rows)
{
  Table table(
      "CPU time of the same sweep at equal error, every method at its best setting",
      equal_error_fields);
  describe(table, scene.parameters);
  table.value("from", scene.frequencies.front());
  table.value("to", scene.frequencies.back());
  table.value("repetitions", scene.repetitions);
  table.value("bounded", scene.error == &MotionError::mean ? "error_mean" : "error");
  table.note(
      "speeds with T-periodic motion, in order; bounded: the column of the targets");
  table.note(
      format("the search of a method in a range ends after %g s of CPU", scene.search));
  table.note(what_is_timed);
  references.describe(table, scene.truth);
  table.row_line("paper_ratios", {scene.paper_ratios.begin(), scene.paper_ratios.end()});
  table.note("paper_ratios: RK4 to harmonic balance with 6, 8 and 10 harmonics");
  for (const EqualErrorRow& row : rows)
    if (row.reached)
      table.row(equal_error_fields, row);
    else
      table.note(format("not reached: %s, %s Hz, target %g; ",
                        row.schedule.method().c_str(), row.range.c_str(), row.target) +
                 (std::isfinite(row.*scene.error) ? format("best %.2g", row.*scene.error)
                                                  : "no setting solves every speed"));
  return table;
}

}  // namespace

int main(int argc, char** argv)
{
  std::string error = "largest";
  const OwnOption own{
      "--error", "what the targets bound: largest, or mean (rms about the mean)", &error};
  const auto compute = [&](SceneFile& file) {
    const EqualErrorScene scene = read_equal_error(file, error);
    const References references =
        true_motions(scene.parameters, scene.frequencies, scene.truth);
    return equal_error_table(scene, references, at_equal_error(scene, references));
  };
  return run_figure(argc, argv, compute, own);
}
