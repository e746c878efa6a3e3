#include "explore/response.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

#include "balance/bearing_problem.hpp"
#include "balance/large_problem.hpp"
#include "continuation/arc_length.hpp"
#include "continuation/shooting_branch.hpp"
#include "explore/branch_file.hpp"
#include "explore/settled_response.hpp"
#include "explore/spectrum.hpp"
#include "io/errors.hpp"
#include "io/output_file.hpp"
#include "motion/closed_motion.hpp"
#include "motion/contact.hpp"
#include "motion/judge.hpp"
#include "motion/motion.hpp"
#include "motion/other_starts.hpp"
#include "motion/quasi_periodic.hpp"
#include "time/time_stepper.hpp"

namespace rotor_stator::explore {

namespace {

/** The request, checked, with the machine, the saved branch and the settings that belong to it. */
struct Task {
  const ResponseRequest& request;
  Parameters machine;
  Parameters parameters;  ///< the same, its base period that of the motions
  std::optional<SavedBranch> saved;
  int harmonics, samples;
  ArcLengthSettings settings;
  bool upwards;
  OperationBudget budget;
  double passages = 1;  ///< the base frequency over the speed, without unbalance
  bool has_two_frequencies = false;

  SpeedRange range() const
  {
    const double low = base(request.from), high = base(request.to);
    return upwards ? SpeedRange{low, high} : SpeedRange{high, low};
  }

  /** The base frequency [rad/s] at a speed [Hz], and back. */
  double base(double hertz) const { return angular(hertz) * passages / parameters.turns; }
  double hertz(double omega) const
  {
    return omega * parameters.turns / passages / angular(1);
  }
};

/** Where the balls' passing has not the period of rotation. */
void take_any_cage(const ResponseRequest& request, Task& task)
{
  const int q = turns_to_repeat(task.machine.bearing);
  if (q == 1) return;
  if (request.subharmonic > 1 || request.save || request.restart || request.isolated > 0)
    throw BadInput(
        format("--subharmonic, --save, --restart and --isolated need a whole number of "
               "passing balls in a turn, and n*omega_cage/omega is %.9g",
               passages_per_turn(task.machine.bearing)));
  if (!turns_visibly(task.machine)) {
    task.parameters = over_passage(task.machine);
    task.passages = passages_per_turn(task.machine.bearing);
  } else if (q > 0) {
    task.parameters = over_turns(task.machine, q);
    task.harmonics *= q;
    task.samples *= q;
  } else {
    task.has_two_frequencies = true;
    if (request.samples || request.stability)
      throw BadInput(
          "--samples, --stability: not where n*omega_cage/omega is not a whole number; "
          "orbit judges");
  }
}

Task task_of(const ResponseRequest& request)
{
  require_range(request.from, request.to);
  Parameters parameters = machine_of(request, request.from, request.to);
  if (request.method == "shooting" || request.save || request.restart ||
      request.isolated > 0)
    require_two_masses(parameters, "--method shooting, --save, --restart or --isolated");
  if (request.at && (*request.at < request.from || *request.at > request.to))
    throw BadInput(
        format("--at %g: must be in %g...%g", *request.at, request.from, request.to));
  if (!request.direction.empty() && request.direction != "up" &&
      request.direction != "down")
    throw BadInput("--direction " + request.direction + ": must be up or down");
  std::vector<std::string> inputs{request.parameter_file};
  if (request.restart) inputs.push_back(*request.restart);
  if (request.save) require_writable("--save", *request.save, inputs);
  if (request.waterfall) require_writable("--waterfall", *request.waterfall, inputs);
  if (request.plot) require_writable("--plot", *request.plot, inputs);
  const std::vector<std::string> known{"", "x_s", "y_s", "x_r", "y_r"};
  if (std::ranges::find(known, request.harmonics_of) == known.end())
    throw BadInput("--harmonics-of " + request.harmonics_of +
                   ": must be one of x_s, y_s, x_r, y_r");
  const int turns = request.subharmonic;
  if (turns > 1 && (request.save || request.restart || request.isolated > 0))
    throw BadInput("--subharmonic: not together with --save, --restart or --isolated");
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
  if (request.tolerance &&
      (request.harmonics || request.samples || request.save || request.restart ||
       request.isolated > 0 || turns > 1 || request.stability || request.waterfall))
    throw BadInput(
        "--tolerance: not together with --harmonics, --samples, --save, --restart, "
        "--isolated, --subharmonic, --stability or --waterfall");
  ArcLengthSettings settings =
      arc_length_settings(parameters, {.tolerance = request.newton_tolerance});
  settings.most_evaluations =
      std::numeric_limits<long>::max();  // the budget is the bound
  const OperationBudget budget =
      budget_of(request,
                request.stability || request.method == "shooting" ? 60
                : turns > 1                                       ? 30
                                                                  : 3,
                parameters);
  const bool upwards =
      request.direction.empty() ? !saved || saved->upwards : request.direction == "up";
  Task task{request,          parameters, over_turns(parameters, turns),
            std::move(saved), harmonics,  checked_samples(harmonics, samples),
            settings,         upwards,    budget};
  take_any_cage(request, task);
  return task;
}

/**
## The branch

Where it starts, what it meets, what is beside it. */

/** A saved point, turned and with as many harmonics as are asked for: with others Newton's method goes from it to a solution
    at its speed, unless the branch turns there. */
BranchPoint saved_start(const Task& task, Balance& balance, Table& table)
{
  const ResponseRequest& request = task.request;
  const double at = angular(request.at.value_or(0));
  BranchPoint point =
      restart_point(*task.saved, request.at ? &at : nullptr, task.settings);
  const double omega = point.motion.omega, frequency = omega / angular(1);
  if (omega < angular(request.from) || omega > angular(request.to))
    throw BadInput(format("%s: the point at %.9g Hz is outside --from %g --to %g",
                          request.restart->c_str(), frequency, request.from, request.to));
  if (task.upwards != task.saved->upwards) point = reversed(std::move(point));
  if (task.harmonics != task.saved->harmonics) {
    Eigen::VectorXd& x = point.motion.x;
    const double speed = point.speed_direction();
    point.tangent = resize_harmonics(point.tangent.head(x.size()), 2, task.harmonics);
    x = resize_harmonics(x, 2, task.harmonics);
    const PeriodicMotion there = solve(balance, omega, x, task.settings.newton);
    if (there.found()) x = there.x;
    point.tangent.conservativeResize(x.size() + 1);
    point.tangent[x.size()] = speed;
  }
  table.value("start", "restart");
  table.value("start_frequency", frequency);
  table.value("start_harmonics", task.saved->harmonics);
  return point;
}

/** A solution at the edge of the range, by whatever start finds one. */
PeriodicMotion found_start(const Task& task)
{
  constexpr double near = 1e-2;  ///< few harmonics often miss a subharmonic
  const double omega = task.range().from, hertz = task.hertz(omega);
  const int turns = task.request.subharmonic;
  const motion::Search search{turns > 1 ? task.machine : task.parameters,
                              turns * omega,
                              task.harmonics,
                              task.samples,
                              task.settings.newton,
                              task.budget,
                              turns};
  if (turns > 1 && !task.request.harmonics) {
    motion::Judged at = motion::to_tolerance(search, near);
    if (at.reached) return std::move(at.motion);
    throw NoSolution(
        format("%s: at %g Hz: %s", task.parameters.file.c_str(), hertz, at.end.c_str()));
  }
  PeriodicMotion start = motion::find_periodic(search);
  if (!start.found())
    throw NoSolution(format("%s: no solution found with %d harmonics at --%s %g Hz: %s",
                            task.parameters.file.c_str(), task.harmonics,
                            task.upwards ? "from" : "to", hertz,
                            start.newton.reason().c_str()));
  return start;
}

/** With two frequencies: all orders up to --harmonics, or all lines that the tolerance needs at some speeds of the range;
    the start on them, and the line of its samples. */
std::pair<PeriodicMotion, TorusLine> torus_start(const Task& task)
{
  constexpr int speeds = 5, beyond = 6;
  const Bearing& bearing = task.machine.bearing;
  const auto [from, to] = task.range();
  Harmonics all = orders_up_to(task.harmonics, bearing);
  PeriodicMotion start;
  const int count = task.request.harmonics ? 1 : speeds;
  for (int k = 0; k < count; ++k) {
    const motion::TorusSearch search{task.machine, from + k * (to - from) / (speeds - 1),
                                     task.settings.newton, task.budget, false};
    motion::Torus at =
        task.request.harmonics
            ? motion::torus_on_orders(search, task.harmonics)
            : motion::torus_to_tolerance(search, task.request.tolerance.value_or(1e-3));
    if (k == 0 && !at.reached)
      throw NoSolution(format("%s: no solution found at %g Hz: %s",
                              task.machine.file.c_str(), task.hertz(from),
                              at.end.c_str()));
    /** A torus that has doubled is no point of the branch. */
    const bool is_of_branch = at.reached && at.motion.line.turns == 1;
    if (k == 0)
      all = at.motion.harmonics;
    else if (is_of_branch)
      all = joined(all, at.motion.harmonics);
    if (k == 0) start = std::move(at.motion);
  }
  start.x = project(start.x, 2, start.harmonics, all);
  start.harmonics = all;
  const TorusLine line =
      line_without_images(all, orders_up_to(task.harmonics + beyond, bearing), 1024);
  start.samples = line.samples;
  return {start, line};
}

/**
## The table */

/** A point of a branch with what is printed of it. */
struct Row {
  const StablePoint& at;
  Eigen::VectorXd amplitude;  ///< half peak-to-peak of x_s, y_s, x_r, y_r [m]
  std::size_t branch;
  const Task& task;
  motion::Motion motion = {};  ///< where a column needs its instants
  Eigen::MatrixXd series =
      {};            ///< of x_s, y_s, x_r, y_r, 4 × (2m+1) [m], with --harmonics-of
  double error = 0;  ///< with --tolerance

  double mean(Eigen::Index k) const
  {
    return motion::displacement_samples(motion).col(k).mean();
  }
  double force(double Vec2::*axis) const
  {
    const auto forces = motion::bearing_forces(task.parameters, motion);
    const auto [low, high] = std::ranges::minmax_element(forces, {}, axis);
    return 0.5 * ((*high).*axis - (*low).*axis);
  }
  double ball_load() const
  {
    return motion::largest_ball_load(
        task.parameters, motion, std::ssize(motion.positions) / motion.points_per_period);
  }
};

Eigen::VectorXd amplitude(const Task& task, const PeriodicMotion& motion,
                          FourierTransform& transform)
{
  return task.has_two_frequencies
             ? motion::half_peak_to_peak_of_torus(task.machine, motion)
             : half_peak_to_peak(body_series(task.parameters, motion), transform);
}

using Fields = std::vector<Field<Row>>;

const Fields branch_fields{
    {"f", "Hz", "speed of rotation",
     [](auto& r) { return r.task.hertz(r.at.point.motion.omega); }},
    {"amp_x_s", "m", "half peak-to-peak of x_s", [](auto& r) { return r.amplitude[0]; }},
    {"amp_y_s", "m", "half peak-to-peak of y_s", [](auto& r) { return r.amplitude[1]; }},
    {"amp_x_r", "m", "half peak-to-peak of x_r", [](auto& r) { return r.amplitude[2]; }},
    {"amp_y_r", "m", "half peak-to-peak of y_r", [](auto& r) { return r.amplitude[3]; }},
    {"arc", "-", "scaled arc length from the first point",
     [](auto& r) { return r.at.point.arc; }},
    {"newton", "-", "Newton iterations of the corrector",
     [](auto& r) { return r.at.point.motion.newton.iterations; }}};

const Fields stability_fields{
    {"multiplier", "-",
     "largest modulus of the Floquet multipliers of the motion of Eq. 7 found there; -1",
     [](auto& r) { return r.at.examined() ? r.at.floquet.largest() : -1; }},
    {"multiplier_change", "-", "uncertainty of it: change at the last refinement",
     [](auto& r) { return r.at.examined() ? r.at.floquet.uncertainty() : -1; }},
    {"verdict", "-", "of the machine: stable, unstable, undecided",
     [](auto& r) {
       return std::string(r.at.examined() ? r.at.floquet.verdict() : "undecided");
     }},
    {"bifurcation", "-",
     "of the machine: plus-one, period-doubling: a multiplier passes 1, -1; "
     "neimark-sacker: a pair passes the circle; of the m harmonics: fold; - none",
     [](auto& r) { return std::string(name_of(r.at.bifurcation)); }}};

const Fields further_fields{
    {"mean_x_s", "m", "mean of x_s", [](auto& r) { return r.mean(0); }},
    {"mean_y_s", "m", "mean of y_s", [](auto& r) { return r.mean(1); }},
    {"mean_x_r", "m", "mean of x_r", [](auto& r) { return r.mean(2); }},
    {"mean_y_r", "m", "mean of y_r", [](auto& r) { return r.mean(3); }},
    {"amp_F_x", "N", "half peak-to-peak of F_x",
     [](auto& r) { return r.force(&Vec2::x); }},
    {"amp_F_y", "N", "half peak-to-peak of F_y",
     [](auto& r) { return r.force(&Vec2::y); }},
    {"contact_share", "-", "share of the time with a loaded ball",
     [](auto& r) { return motion::contact_share(r.task.parameters, r.motion); }},
    {"ball_load", "N", "largest force of a ball", &Row::ball_load}};

/** Complex amplitudes a of one displacement, Re a e^{i 2 pi f t}. */
void add_harmonics(Fields& fields, const Task& task, const Harmonics& harmonics)
{
  const std::string& whose = task.request.harmonics_of;
  const Eigen::Index row = whose[2] == 's' ? whose[0] == 'y' : 2 + (whose[0] == 'y');
  const bool two = task.has_two_frequencies;
  for (int k = 0; const Harmonic& h : harmonics.list()) {
    const double order = two ? order_of(h, task.machine.bearing)
                             : h.k_1 * task.passages / task.parameters.turns;
    const std::string name = whose + (two ? format("_%g_%g", 1.0 * h.k_1, 1.0 * h.k_2)
                                          : format("_%g", 1.0 * h.k_1));
    const auto at = [=](const Row& r) {
      return rotor_stator::amplitude(r.series, k)[row];
    };
    fields.push_back({name + "_re", "m", format("order %.9g, real part", order),
                      [=](auto& r) { return at(r).real(); }});
    fields.push_back({name + "_im", "m", format("order %.9g, imaginary part", order),
                      [=](auto& r) { return at(r).imag(); }});
    ++k;
  }
}

/** The fields, and how many of them are printed where no others are asked for. */
std::pair<Fields, std::size_t> fields_of(const Task& task, const Harmonics& harmonics)
{
  const ResponseRequest& request = task.request;
  Fields fields = branch_fields;
  if (request.stability)
    fields.insert(fields.end(), stability_fields.begin(), stability_fields.end());
  if (request.isolated > 0)
    fields.push_back(
        {"branch", "-", "1 the branch followed, then those beside it", &Row::branch});
  if (!request.harmonics_of.empty()) add_harmonics(fields, task, harmonics);
  if (request.tolerance && !task.has_two_frequencies)
    fields.push_back(
        {"error", "-",
         "distance from the nearest motion of Eq. 7: the larger of the largest "
         "difference of a displacement over the largest displacement and the rms about "
         "the mean",
         &Row::error});
  const std::size_t usual = fields.size();
  fields.insert(fields.end(), further_fields.begin(), further_fields.end());
  if (const double pressure = task.machine.bearing.pressure; pressure > 0)
    fields.push_back(
        {"stress", "N/mm^2", "largest pressure of Hertz under ball_load",
         [=](const Row& r) { return 1e-6 * pressure * std::cbrt(r.ball_load()); }});
  return {fields, usual};
}

motion::Lines lines_at(const Task& task, PeriodicMotion motion)
{
  motion.bodies = body_series(task.parameters, motion);
  auto all = motion::lines_of(task.machine.bearing, motion, task.parameters.turns);
  for (motion::Line& line : all.lines) line.order *= task.passages;
  return all;
}

/** The instants of one point: a period, or 64 turns of two frequencies. */
motion::Motion samples_at(const Task& task, PeriodicMotion motion)
{
  motion.bodies = body_series(task.parameters, motion);
  return task.has_two_frequencies
             ? motion::motion_of(task.parameters, motion, 128, 64)
             : motion::motion_of(motion, std::max(256, 4 * task.harmonics + 4));
}

/** The branches beside the followed one, and what was not looked at. */
struct Others {
  std::vector<IsolatedBranch> found;
  std::string missing;
};

/**
## Beside the branch */

/** The branches beside `main`; what is said of each stands in the table's header. */
Others others(const Task& task, Balance& balance, const Branch& main, Table& table)
{
  const auto starts =
      motion::other_starts(task.parameters, task.range(), task.harmonics,
                           {.speeds = task.request.isolated,
                            .seed = static_cast<std::uint64_t>(task.request.seed)},
                           task.budget);
  Others others{
      isolated_branches(balance, main, starts.candidates, task.range(), task.settings),
      {}};
  int number = 1;
  for (const auto& [branch, candidate] : others.found) {
    const auto [low, high] = std::ranges::minmax_element(
        branch.points, {}, [](auto& p) { return p.motion.omega; });
    table.row_line("branch",
                   {++number, task.hertz(low->motion.omega),
                    task.hertz(high->motion.omega), branch.points.size(),
                    branch.folds.size(), branch.covered ? "complete" : "incomplete"});
    table.note(format("branch %d: off the branches before it, found at %g Hz from %s; %s",
                      number, task.hertz(candidate.omega), candidate.start.c_str(),
                      branch.end.c_str()));
  }
  if (task.budget.used_up())
    others.missing =
        "the budget is used up, more with --budget: not every start was followed";
  else if (starts.cut_off > 0)
    others.missing =
        format("the budget cut off %d of %d time integrations, more with --budget",
               starts.cut_off, task.request.isolated);
  table.value("other_branches", others.found.size());
  table.value("other_starts", starts.candidates.size());
  return others;
}

/** Of a branch: points without a verdict, bifurcations seen and not located; then one
    line for each bifurcation. */
void note(Table& table, const Task& task, std::size_t number,
          const BranchStability& stability)
{
  table.row_line("undecided", {number, stability.failed, stability.missed});
  if (stability.failed > 0) {
    const auto first = std::ranges::find(stability.points, false, &StablePoint::examined);
    table.note(format("branch %zu, undecided points: the first at %.6g Hz: %s", number,
                      task.hertz(first->point.motion.omega), stability.failure.c_str()));
  }
  for (const StablePoint& p : stability.points)
    if (p.bifurcation != Bifurcation::none && p.bifurcation != Bifurcation::fold)
      table.row_line("bifurcation",
                     {number, name_of(p.bifurcation), task.hertz(p.point.motion.omega),
                      *decimal(format("%.2g", task.hertz(p.uncertainty)))});
}

/** What was not computed and why; empty when nothing is missing. */
std::string missing_in(const BranchStability& stability, const OperationBudget& budget)
{
  return budget.used_up()
             ? format(
                   "the budget is used up, more with --budget: %d of %zu points are "
                   "undecided, %d bifurcations were seen and not located",
                   stability.failed, stability.points.size(), stability.missed)
             : "";
}

/** What was added to the table. */
struct Added {
  const Fields& fields;
  bool has_further;  ///< columns that need the instants
  Table* lines;      ///< of the followed branch, where they are asked for
  bool touches = false;
  std::string missing = {};  ///< of the multipliers: the first that could not be had
};

/** Adds the rows of branch `number`, and what the header says of its multipliers. `balance` is the one
    that the branch was followed with. */
void add_branch(Table& table, const Task& task, Balance& balance, const Branch& branch,
                std::size_t number, Added& added)
{
  BranchStability stability;
  if (task.request.stability) {
    stability = motion::machine_stability(task.parameters, balance, branch, task.settings,
                                          task.budget);
    note(table, task, number, stability);
    const std::string missing = missing_in(stability, task.budget);
    if (added.missing.empty()) added.missing = missing;
  } else {
    for (const BranchPoint& point : branch.points)
      stability.points.push_back({.point = point, .floquet = {}});
  }
  FourierTransform transform = amplitude_transform(task.harmonics);
  for (const StablePoint& at : stability.points) {
    const PeriodicMotion& motion = at.point.motion;
    added.touches = added.touches || !motion.force.isZero(0);
    Row row{at, amplitude(task, motion, transform), number, task};
    if (added.has_further) row.motion = samples_at(task, motion);
    if (!task.request.harmonics_of.empty())
      row.series = body_series(task.parameters, motion);
    table.row(added.fields, row);
    if (added.lines && number == 1)
      add_lines(*added.lines, task.machine.bearing, task.hertz(motion.omega),
                lines_at(task, motion), 128, 1e-4);
  }
  if (task.request.isolated > 0) table.gap();
}

/** A branch of period KT turns where it meets that of period T, and comes back as the same motions a turn later. */
bool is_whole(const Task& task, const Branch& branch)
{
  return branch.covered ||
         (task.request.subharmonic > 1 && branch.kind == BranchEnd::came_back);
}

std::string stopped_at(const Task& task, double omega, const std::string& end)
{
  return format("%s: the branch stopped at %g Hz, before --%s %g Hz: %s",
                task.parameters.file.c_str(), task.hertz(omega),
                task.upwards ? "to" : "from", task.hertz(task.range().to), end.c_str());
}

/** The first thing that is missing, in the order in which it was asked for. */
std::string unfinished(const Task& task, const Branch& branch,
                       const std::string& isolated, const std::string& stability)
{
  if (is_whole(task, branch) && !isolated.empty())
    return task.parameters.file + ": isolated branches: " + isolated;
  if (is_whole(task, branch))
    return stability.empty() ? "" : task.parameters.file + ": " + stability;
  return stopped_at(task, branch.points.back().motion.omega, branch.end);
}

/** The branch that was followed, as keys. */
void put_branch(Table& table, const Task& task, const std::string& base,
                std::size_t folds, long evaluations)
{
  table.value("kind", "branch");
  table.value("base", base);
  table.value("direction", task.upwards ? "up" : "down");
  table.value("folds", folds);
  table.value("branch_evaluations", evaluations);
}

/** The same branch by a time method. */
Exploration shooting_response(const ResponseRequest& request, const Task& task)
{
  constexpr int points = 256;
  const Parameters& machine = task.machine;
  require_rotation_period(machine, "shooting");
  const SpeedRange range = task.range();
  const motion::Search search{machine,      range.from,           task.harmonics,
                              task.samples, task.settings.newton, task.budget};
  /** On the motion that the machine settles on where that has the period T. */
  const rotor_stator::Settled settled = settle(
      machine, range.from, BasePeriod{}, {static_start(machine), 0}, {}, task.budget);
  std::string start = "time integration";
  State state = settled.at.state;
  if (settled.period != 1) {
    const auto closed = motion::closed_motion(search, points, 1e-11);
    start = closed.start;
    state = closed.state;
  }
  const ShootingBranch branch =
      follow_by_shooting(machine, range.from, range.to, state, {.budget = task.budget});
  const auto [fields, usual] = fields_of(task, Harmonics(task.harmonics));
  Table table("Frequency response along the branch", fields);
  table.choose(request.columns, usual, request.plot.has_value());
  table.value("start", one_word(start));
  describe(table, machine);
  table.value("method", "shooting");
  put_branch(table, task, "turn", branch.folds, branch.evaluations);
  table.value("step", default_step(machine), 4);
  table.note("end of the branch: " + branch.end);
  int undecided = 0;
  std::string why;
  const auto add_multipliers = [&](StablePoint& at, const State& there) {
    try {
      at.floquet =
          motion::multipliers_through(machine, at.point.motion.omega, there, task.budget);
    } catch (const NoSolution& none) {
      if (undecided++ == 0) why = none.what();
    }
  };
  bool touches = false;
  for (const ShootingBranchPoint& point : branch.points) {
    const motion::Motion motion =
        motion::one_period(machine, point.omega, point.state,
                           {.method = "rk4", .intervals_per_period = points});
    const auto amplitude = half_peak_to_peak(motion);
    touches = touches || motion::contact_share(machine, motion) > 0;
    StablePoint at{};
    at.point.motion.omega = point.omega;
    at.point.motion.newton.iterations = point.newton;
    at.point.arc = point.arc;
    if (request.stability) add_multipliers(at, point.state);
    table.row(fields, Row{at, Eigen::Map<const Eigen::Vector4d>(amplitude.data()), 1,
                          task, motion, motion::series_of(motion, task.harmonics)});
  }
  if (request.stability) table.row_line("undecided", {1, undecided, 0});
  if (undecided > 0) table.note("undecided points: " + why);
  const bool is_missing = undecided > 0 && task.budget.used_up();
  const std::string missing =
      !branch.covered ? stopped_at(task, branch.points.back().omega, branch.end)
      : is_missing    ? task.parameters.file + ": " + why
                      : "";
  put_complete(table, missing);
  conclude(table, machine, touches, task.budget);
  return {std::move(table), missing};
}

/** Solutions to a tolerance, each with the harmonics that it needs. */
Exploration response_to_tolerance(const ResponseRequest& request, const Task& task)
{
  const Parameters& parameters = task.parameters;
  const double tolerance = *request.tolerance;
  const auto [fields, usual] = fields_of(task, Harmonics(task.harmonics));
  Table table("Frequency response at evenly spaced speeds", fields);
  const bool has_further = table.choose(request.columns, usual, request.plot.has_value());
  describe(table, task.machine);
  constexpr double seconds_each = 1;  // without a budget of the user's
  std::vector<StablePoint> points;
  std::vector<double> errors;
  std::string missing;
  int missed = 0;
  const int count = request.count.value_or(101);
  for (int k = 0; k < count; ++k) {
    const auto [from, to] = task.range();
    const double omega = from + (to - from) * k / std::max(1, count - 1);
    const OperationBudget share =
        request.budget ? task.budget
                       : budget_of(std::optional<double>(), seconds_each, parameters);
    motion::Search search{
        .parameters = parameters, .omega = omega, .harmonics = 6, .budget = share};
    if (!points.empty()) search.starts = {points.back().point.motion.x};
    motion::Judged at = motion::to_tolerance(search, tolerance);
    if (!at.reached) {
      if (missed++ == 0)
        missing =
            format("%s: tolerance %g not reached at %g Hz: ", task.machine.file.c_str(),
                   tolerance, task.hertz(omega)) +
            at.end;
      continue;
    }
    double arc = 0;
    if (!points.empty()) {
      const PeriodicMotion& last = points.back().point.motion;
      const int m = std::max(last.harmonics.count(), at.motion.harmonics.count());
      const Eigen::VectorXd off =
          resize_harmonics(at.motion.x, 2, m) - resize_harmonics(last.x, 2, m);
      arc = points.back().point.arc +
            std::hypot(off.norm() / task.settings.arc_unknown_scale,
                       (omega - last.omega) / task.settings.speed_scale);
    }
    points.push_back({.point = {std::move(at.motion), arc}, .floquet = {}});
    errors.push_back(at.error.larger());
  }
  if (points.empty()) throw NoSolution(missing);
  table.value("method", "aft");
  table.value("kind", "sweep");
  table.value("tolerance", tolerance);
  table.value("speeds", count);
  table.value("missed_speeds", missed);
  table.note("harmonics and samples chosen for each speed");
  if (missed > 0) table.note("missed speeds: the first: " + missing);
  bool touches = false;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const PeriodicMotion& motion = points[k].point.motion;
    touches = touches || !motion.force.isZero(0);
    Row row{points[k], half_peak_to_peak(motion.bodies), 1, task};
    row.error = errors[k];
    if (has_further)
      row.motion =
          motion::motion_of(motion, std::max(256, 4 * motion.harmonics.count() + 4));
    if (!request.harmonics_of.empty())
      row.series = resize_harmonics(motion.bodies.reshaped(), 4, task.harmonics)
                       .reshaped(4, 2 * task.harmonics + 1);
    table.row(fields, row);
  }
  put_complete(table, missing);
  conclude(table, task.machine, touches, task.budget);
  return {std::move(table), missing};
}

}  // namespace

Exploration explore_response(const ResponseRequest& request)
{
  if (request.method == "auto") return explore_settled_response(request);
  Task task = task_of(request);
  if (request.method == "shooting") return shooting_response(request, task);
  if (request.tolerance && !task.has_two_frequencies)
    return response_to_tolerance(request, task);
  if (task.parameters.large && !task.has_two_frequencies)
    fit_receptances(task.parameters, task.range().from, task.harmonics);
  const std::clock_t read = std::clock();
  PeriodicMotion found;
  TorusLine line{};
  if (task.has_two_frequencies) {
    std::tie(found, line) = torus_start(task);
    task.samples = found.samples;
  } else if (!task.saved) {
    found = found_start(task);
    task.harmonics = found.harmonics.count();
    task.samples = found.samples;
  }
  const auto [fields, usual] = fields_of(
      task, task.has_two_frequencies ? found.harmonics : Harmonics(task.harmonics));
  Table table("Frequency response along the branch", fields);
  const bool has_further = table.choose(request.columns, usual, request.plot.has_value());
  if (!task.saved) table.value("start", one_word(found.start));
  Balance balance =
      task.has_two_frequencies
          ? Balance(bearing_problem(task.parameters, line, task.budget), found.harmonics)
          : Balance(bearing_problem(task.parameters, task.samples, task.budget),
                    task.harmonics);
  const BranchPoint start =
      task.saved ? saved_start(task, balance, table)
                 : point_of(balance, found.omega, found.x, task.upwards, task.settings);
  FourierTransform transform = amplitude_transform(task.harmonics);
  ArcLengthSettings watched = task.settings;
  if (request.watch)
    watched.watch = [&](const BranchPoint& p) {
      request.watch(task.hertz(p.motion.omega), amplitude(task, p.motion, transform));
    };
  const Branch main = follow_branch(balance, start, task.range(), watched);
  describe(table, task.machine);
  const int turns = task.parameters.turns;
  const bool two = task.has_two_frequencies;
  table.value("method", "aft");
  table.value("harmonics", two ? found.harmonics.count() : task.harmonics / turns);
  table.value("samples", two ? line.samples : task.samples / turns);
  put_branch(table, task,
             two                                         ? "two"
             : task.passages != 1                        ? "passing"
             : turns_to_repeat(task.machine.bearing) > 1 ? format("turns %d", turns)
                                                         : "turn",
             main.folds.size(), main.evaluations);
  if (two) table.note(format("harmonics of all points of the branch, z = %d", line.z));
  table.note(
      format("pseudo-arc-length, relative tolerance %g", task.request.newton_tolerance));
  table.note("end of the branch: " + main.end);

  Others beside;
  if (request.isolated > 0) beside = others(task, balance, main, table);
  std::vector<const Branch*> all{&main};
  for (const IsolatedBranch& other : beside.found) all.push_back(&other.branch);

  Table lines("Lines of the motions along the branch", line_columns);
  describe(lines, task.machine);
  Added added{fields, has_further, request.waterfall ? &lines : nullptr};
  for (std::size_t k = 0; k < all.size(); ++k)
    add_branch(table, task, balance, *all[k], k + 1, added);
  if (request.save)
    write_file(*request.save, branch_text(task.parameters, task.harmonics, task.samples,
                                          task.upwards, all));
  if (request.waterfall) write_file(*request.waterfall, lines.text());
  put_complete(table, unfinished(task, main, beside.missing, added.missing));
  conclude(table, task.machine, added.touches, task.budget);
  if (request.times)
    std::fprintf(stderr, "cpu_machine_s: %.5f\ncpu_branch_s: %.5f\n",
                 static_cast<double>(read) / CLOCKS_PER_SEC,
                 static_cast<double>(std::clock() - read) / CLOCKS_PER_SEC);
  return {std::move(table), unfinished(task, main, beside.missing, added.missing)};
}

}  // namespace rotor_stator::explore
