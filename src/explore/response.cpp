#include "explore/response.hpp"

#include <algorithm>
#include <limits>

#include "balance/torus_line.hpp"
#include "explore/response_branch.hpp"
#include "explore/response_sweep.hpp"
#include "io/errors.hpp"
#include "model/base_period.hpp"

namespace rotor_stator::explore {

namespace {

using Row = ResponseRow;

const ResponseFields usual_fields =
    ResponseFields{{"f", "Hz", "speed of rotation", &Row::frequency}} +
    displacement_fields<Row>("amp_", "half peak-to-peak of ", &Row::amplitude);

/** Measures that are among all columns. */
const std::string further_columns =
    "mean_x_s,mean_y_s,mean_x_r,mean_y_r,rms_x_s,rms_y_s,rms_x_r,rms_y_r,amp_F_x,amp_F_y,"
    "contact_share,ball_load,stress";

/** The row of the displacement whose harmonics are asked for. Throws BadInput. */
Eigen::Index displacement_row(const ResponseRequest& request)
{
  constexpr std::array names{"x_s", "y_s", "x_r", "y_r"};
  const auto found = std::ranges::find(names, request.harmonics_of);
  if (found == names.end())
    throw BadInput("--harmonics-of " + request.harmonics_of +
                   ": must be one of x_s, y_s, x_r, y_r");
  return found - names.begin();
}

/** Throws BadInput for options that do not belong together, before anything is read. */
void require_options(const ResponseRequest& request)
{
  const bool is_beside = request.save || request.restart || request.isolated > 0;
  if (request.at && (*request.at < request.from || *request.at > request.to))
    throw BadInput(
        format("--at %g: must be in %g...%g", *request.at, request.from, request.to));
  if (!request.direction.empty() && request.direction != "up" &&
      request.direction != "down")
    throw BadInput("--direction " + request.direction + ": must be up or down");
  if (!request.harmonics_of.empty()) displacement_row(request);
  if (request.subharmonic > 1 && is_beside)
    throw BadInput("--subharmonic: not together with --save, --restart or --isolated");
  if (request.tolerance &&
      (request.harmonics || request.samples || is_beside || request.subharmonic > 1 ||
       request.stability || request.waterfall || request.times))
    throw BadInput(
        "--tolerance: not together with --harmonics, --samples, --save, --restart, "
        "--isolated, --subharmonic, --stability, --waterfall or --times");
}

/** Where the balls' passing has not the period of rotation, or nothing else moves. */
void take_any_cage(const ResponseRequest& request, ResponseTask& task)
{
  const BasePeriod base = base_period(task.machine);
  const bool is_whole = has_rotation_period(task.machine.bearing);
  const bool needs_turn =
      request.subharmonic > 1 || request.save || request.restart || request.isolated > 0;
  const bool is_over_turn = needs_turn || request.method == "shooting" ||
                            base.kind != BasePeriod::Kind::passing;
  if (is_whole && is_over_turn) return;
  if (needs_turn)
    throw BadInput(
        format("--subharmonic, --save, --restart and --isolated need a whole number of "
               "passing balls in a turn, and n*omega_cage/omega is %.9g",
               passages_per_turn(task.machine.bearing)));
  task.base_period = base.words();
  task.parameters = over(base, task.machine, 0).machine;
  task.harmonics *= base.turns;
  task.samples *= base.turns;
  if (base.kind == BasePeriod::Kind::passing) task.passages = base.per_turn;
  task.has_two_frequencies = base.is_driven_twice();
  if (!task.has_two_frequencies) return;
  if (request.count)
    throw BadInput("--count: with two frequencies the branch chooses its speeds");
  if (request.samples || request.stability)
    throw BadInput(std::string(request.stability ? "--stability" : "--samples") +
                   ": not where n*omega_cage/omega is not a whole number; orbit judges");
}

}  // namespace

ResponseColumns columns_of(const ResponseRequest& request, const Parameters& parameters,
                           const ResponseFields& own, bool is_settled)
{
  ResponseFields all = usual_fields + own;
  const std::size_t usual = all.size();
  if (is_settled)
    all.push_back(
        {"lyapunov", "1/s", "growth rate of neighbouring motions", &Row::lyapunov});
  Measures measures = add_measures(
      all, request.columns == "all" ? further_columns : request.columns, parameters);
  return {all, usual, measures};
}

ResponseFields harmonic_fields(const ResponseTask& task, const Harmonics& harmonics)
{
  const std::string& whose = task.request.harmonics_of;
  if (whose.empty()) return {};
  ResponseFields fields;
  const bool two = task.has_two_frequencies;
  for (std::size_t k = 0; const Harmonic& h : harmonics.list()) {
    const double order = two ? order_of(h, task.machine.bearing)
                             : h.k_1 * task.passages / task.parameters.turns;
    const std::string name =
        whose + format("_%g", h.k_1) + (two ? format("_%g", h.k_2) : "");
    fields.push_back({name + "_re", "m", format("order %.9g, real part", order),
                      [=](auto& r) { return r.harmonics[k].real(); }});
    fields.push_back({name + "_im", "m", format("order %.9g, imaginary part", order),
                      [=](auto& r) { return r.harmonics[k].imag(); }});
    ++k;
  }
  return fields;
}

std::vector<std::complex<double>> harmonics_of(const ResponseTask& task,
                                               const Eigen::MatrixXd& series)
{
  if (task.request.harmonics_of.empty()) return {};
  std::vector<std::complex<double>> all;
  for (int k = 0; 2 * k < series.cols(); ++k)
    all.push_back(amplitude(series, k)[displacement_row(task.request)]);
  return all;
}

/** The request, checked. */
static ResponseTask response_task(const ResponseRequest& request)
{
  require_range(request.from, request.to);
  if (request.count) require_range(request.from, request.to, request.count);
  const Parameters parameters = machine_of(request, request.from, request.to);
  if (request.method == "shooting" || request.save || request.restart ||
      request.isolated > 0)
    require_two_masses(parameters, "--method shooting, --save, --restart or --isolated");
  require_options(request);
  std::optional<SavedBranch> saved;
  if (request.restart) saved = read_branch(*request.restart, parameters, request.branch);
  const int harmonics = request.harmonics.value_or(saved ? saved->harmonics : 6);
  std::optional<int> samples = request.samples;
  if (!samples && saved && saved->harmonics == harmonics) samples = saved->samples;
  /** The starts beside the branch, nine at each speed, must fit into the memory. */
  const int most_isolated = 500000 / harmonics;
  if (request.isolated > most_isolated)
    throw BadInput(format("--isolated %d: must be in 0...%d with %d harmonics",
                          request.isolated, most_isolated, harmonics));
  ArcLengthSettings settings =
      arc_length_settings(parameters, {.tolerance = request.newton_tolerance});
  settings.most_evaluations =
      std::numeric_limits<long>::max();  // the budget is the bound
  const bool is_longer =
      request.subharmonic > 1 || base_period(parameters).is_driven_twice();
  const double seconds = request.stability || request.method == "shooting" ? 60
                         : is_longer                                       ? 30
                                                                           : 3;
  const bool upwards =
      request.direction.empty() ? !saved || saved->upwards : request.direction == "up";
  ResponseTask task{
      request,          parameters, over_turns(parameters, request.subharmonic),
      std::move(saved), harmonics,  checked_samples(harmonics, samples),
      settings,         upwards,    budget_of(request, seconds, parameters)};
  take_any_cage(request, task);
  return task;
}

Exploration explore_response(const ResponseRequest& request)
{
  if (request.method == "auto") return settled_response(request);
  const ResponseTask task = response_task(request);
  if (request.method == "shooting") return branch_by_shooting(task);
  if (request.tolerance && !task.has_two_frequencies) return response_to_tolerance(task);
  return branch_by_balance(task);
}

}  // namespace rotor_stator::explore
