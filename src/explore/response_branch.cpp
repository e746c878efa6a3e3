#include "explore/response_branch.hpp"

#include <algorithm>
#include <ctime>

#include "balance/bearing_problem.hpp"
#include "explore/spectrum.hpp"
#include "io/errors.hpp"
#include "io/output_file.hpp"
#include "motion/contact.hpp"
#include "motion/find_periodic.hpp"
#include "motion/judge.hpp"
#include "motion/quasi_periodic.hpp"

namespace rotor_stator::explore {

namespace {

/**
## Where the branch starts */

/** A saved point, turned and with as many harmonics as are asked for: with others
    Newton's method goes from it to a solution at its speed, unless the branch turns
    there. */
BranchPoint saved_start(const ResponseTask& task, Curve& curve, Table& table)
{
  const ResponseRequest& request = task.request;
  BranchPoint point = restart_point(*task.saved, request.at, curve);
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
    const PeriodicMotion there = curve.solved(omega, x);
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
PeriodicMotion found_start(const ResponseTask& task)
{
  constexpr double near = 1e-2;  // few harmonics often miss a subharmonic
  const double omega = task.range().from, hertz = task.hertz(omega);
  const int turns = task.request.subharmonic;
  const BalanceSearch search{turns > 1 ? task.machine : task.parameters,
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
    throw NoSolution(
        format("%s: no solution found with %d harmonics at --%s %g Hz: %s; "
               "a sweep without --harmonics has all speeds",
               task.parameters.file.c_str(), task.harmonics, task.upwards ? "from" : "to",
               hertz, start.newton.reason().c_str()));
  return start;
}

/** With two frequencies: all orders up to --harmonics, or all lines that the tolerance
    needs at some speeds of the range; the start on them, with the line of its samples. */
PeriodicMotion torus_start(const ResponseTask& task)
{
  constexpr int speeds = 5, beyond = 6;
  const Bearing& bearing = task.machine.bearing;
  const bool is_given = task.request.harmonics.has_value();
  const auto [from, to] = task.range();
  Harmonics all = orders_up_to(task.harmonics, bearing);
  PeriodicMotion start;
  for (const double omega : evenly_spaced(from, to, is_given ? 1 : speeds)) {
    const motion::TorusSearch search{task.machine, omega, task.settings.newton,
                                     task.budget, false};
    const motion::Torus at =
        is_given
            ? motion::torus_on_orders(search, task.harmonics)
            : motion::torus_to_tolerance(search, task.request.tolerance.value_or(1e-3));
    if (!start.found() && !at.reached)
      throw NoSolution(format("%s: no solution found at %g Hz: %s",
                              task.machine.file.c_str(), task.hertz(from),
                              at.end.c_str()));
    /** A torus that has doubled is no point of the branch. */
    const bool is_of_branch = at.reached && at.motion.line.turns == 1;
    if (!start.found()) {
      start = at.motion;
      all = at.motion.harmonics;
    } else if (is_of_branch) {
      all = joined(all, at.motion.harmonics);
    }
  }
  const auto dofs = 2 * static_cast<int>(joints_of(task.machine).size());
  start.x = project(start.x, dofs, start.harmonics, all);
  start.harmonics = all;
  start.line =
      line_without_images(all, orders_up_to(task.harmonics + beyond, bearing), 1024);
  start.samples = start.line.samples;
  return start;
}

/**
## The columns */

const ResponseFields stability_fields{
    {"multiplier", "-",
     "largest modulus of the Floquet multipliers of the motion of Eq. 7 found there; -1 "
     "not found, or left out as one of many points close together",
     &ResponseRow::multiplier},
    {"multiplier_change", "-", "uncertainty of it: change at the last refinement",
     &ResponseRow::multiplier_change},
    {"verdict", "-",
     "of the machine: stable, unstable, undecided; of a point left out that of both "
     "neighbours",
     &ResponseRow::verdict},
    {"bifurcation", "-",
     "of the machine: plus-one, period-doubling: a multiplier passes 1, -1; "
     "neimark-sacker: a pair passes the circle; of the m harmonics: fold; - none",
     &ResponseRow::bifurcation}};

ResponseColumns branch_columns(const ResponseTask& task, const Harmonics& harmonics)
{
  ResponseFields own{
      {"arc", "-", "scaled arc length from the first point", &ResponseRow::arc},
      {"newton", "-", "Newton iterations of the corrector", &ResponseRow::newton}};
  if (task.request.stability) own = own + stability_fields;
  if (task.request.isolated > 0)
    own.push_back({"branch", "-", "1 the branch followed, then those beside it",
                   &ResponseRow::branch});
  own = own + harmonic_fields(task, harmonics);
  return columns_of(task.request, task.machine, own);
}

void put_multipliers(ResponseRow& row, const Floquet& floquet)
{
  row.multiplier = floquet.largest();
  row.multiplier_change = floquet.uncertainty();
  row.verdict = floquet.verdict();
}

/** The branch that was followed, as keys. */
void put_branch(Table& table, const ResponseTask& task, const Branch& branch)
{
  table.value("kind", "branch");
  table.value("base", task.base_period);
  table.value("direction", task.upwards ? "up" : "down");
  table.value("folds", branch.folds.size());
  table.value("branch_evaluations", branch.evaluations);
}

std::string stopped_at(const ResponseTask& task, const Branch& branch)
{
  return format(
      "%s: the branch stopped at %g Hz, before --%s %g Hz: %s%s",
      task.parameters.file.c_str(), task.hertz(branch.points.back().motion.omega),
      task.upwards ? "to" : "from", task.hertz(task.range().to), branch.end.c_str(),
      branch.kind == BranchEnd::work
          ? ""
          : "; another end of the range or more harmonics may lead on, a sweep "
            "without a method has all speeds");
}

/**
## Harmonic balance */

/** A branch that is followed, and what is printed of it and of those beside it. */
class BalanceBranch {
public:
  BalanceBranch(const ResponseTask& task, const PeriodicMotion& found, Table& table,
                const ResponseColumns& columns, bool has_further)
      : task_(task), table_(table), columns_(columns), has_further_(has_further),
        balance_(
            task.has_two_frequencies
                ? Balance(bearing_problem(task.parameters, found.line, task.budget),
                          found.harmonics)
                : Balance(bearing_problem(task.parameters, task.samples, task.budget),
                          task.harmonics)),
        curve_(balance_, task.settings)
  {
    describe(lines, task.machine);
    const BranchPoint start = task.saved
                                  ? saved_start(task, curve_, table)
                                  : point_of(curve_, found.omega, found.x, task.upwards);
    all.push_back(follow_branch(curve_, start, task.range(), [&](const BranchPoint& p) {
      if (task.request.watch)
        task.request.watch(task.hertz(p.motion.omega), amplitude(p.motion));
    }));
  }

  /** Looks for branches beside it; what is said of each stands in the table's header. */
  void look_beside()
  {
    const OperationBudget& budget = task_.budget;
    const auto starts = motion::other_starts(
        task_.parameters, task_.range(), task_.harmonics, task_.request.isolated,
        static_cast<std::uint64_t>(task_.request.seed), budget);
    const auto beside =
        isolated_branches(curve_, all[0], starts.candidates, task_.range());
    for (const auto& [branch, candidate] : beside) {
      all.push_back(branch);
      const auto [low, high] = std::ranges::minmax_element(
          branch.points, {}, [](auto& p) { return p.motion.omega; });
      table_.row_line("branch",
                      {all.size(), task_.hertz(low->motion.omega),
                       task_.hertz(high->motion.omega), branch.points.size(),
                       branch.folds.size(), branch.covered ? "complete" : "incomplete"});
      table_.note(
          format("branch %zu: off the branches before it, found at %g Hz from %s; %s",
                 all.size(), task_.hertz(candidate.omega), candidate.start.c_str(),
                 branch.end.c_str()));
    }
    if (budget.used_up())
      missing_beside_ =
          "the budget is used up, more with --budget: not every start was followed";
    else if (starts.cut_off > 0)
      missing_beside_ =
          format("the budget cut off %d of %d time integrations, more with --budget",
                 starts.cut_off, task_.request.isolated);
    table_.value("other_branches", beside.size());
    table_.value("other_starts", starts.candidates.size());
  }

  void add_rows()
  {
    for (std::size_t number = 1; const Branch& branch : all) {
      for (const StablePoint& at : multipliers_of(branch, number).points)
        add_row(at, number);
      if (task_.request.isolated > 0) table_.gap();
      ++number;
    }
  }

  /** The first thing that is missing, in the order in which it was asked for. */
  std::string unfinished() const
  {
    /** A branch of period KT meets that of period T, and comes back as the same motions a
        turn later. */
    const Branch& main = all[0];
    const bool is_whole = main.covered || (task_.request.subharmonic > 1 &&
                                           main.kind == BranchEnd::came_back);
    const std::string& file = task_.parameters.file;
    if (!is_whole) return stopped_at(task_, main);
    if (!missing_beside_.empty()) return file + ": isolated branches: " + missing_beside_;
    return missing_multipliers_.empty() ? "" : file + ": " + missing_multipliers_;
  }

  std::vector<Branch> all;  ///< the one that is followed, then those beside it
  Table lines{"Lines of the motions along the branch", line_columns};  ///< of the first
  bool touches = false;

private:
  /** Of x_s, y_s, x_r, y_r, whatever else a large body shows. */
  Eigen::Vector4d amplitude(const PeriodicMotion& motion)
  {
    return (task_.has_two_frequencies
                ? motion::half_peak_to_peak_of_torus(task_.machine, motion)
                : half_peak_to_peak(body_series(task_.parameters, motion)))
        .head<4>();
  }

  BranchStability multipliers_of(const Branch& branch, std::size_t number);
  void add_row(const StablePoint& at, std::size_t number);

  const ResponseTask& task_;
  Table& table_;
  const ResponseColumns& columns_;
  bool has_further_;  ///< columns that need the instants
  Balance balance_;
  BalanceCurve curve_;
  std::string missing_beside_, missing_multipliers_;
};

/** With the multipliers where they are asked for. The header says how many points have no
    verdict, which bifurcations were seen and not located, and where the others are. */
BranchStability BalanceBranch::multipliers_of(const Branch& branch, std::size_t number)
{
  BranchStability stability;
  if (!task_.request.stability) {
    for (const BranchPoint& point : branch.points)
      stability.points.push_back({.point = point, .floquet = {}});
    return stability;
  }
  stability = motion::machine_stability(task_.parameters, curve_, branch, task_.budget);
  table_.row_line("undecided", {number, stability.failed, stability.missed});
  if (stability.failed > 0) {
    const auto first = std::ranges::find(stability.points, false, &StablePoint::examined);
    table_.note(format("branch %zu, undecided points: the first at %.6g Hz: %s", number,
                       task_.hertz(first->point.motion.omega),
                       stability.failure.c_str()));
  }
  for (const StablePoint& p : stability.points)
    if (p.bifurcation != Bifurcation::none && p.bifurcation != Bifurcation::fold)
      table_.row_line("bifurcation",
                      {number, name_of(p.bifurcation), task_.hertz(p.point.motion.omega),
                       *decimal(format("%.2g", task_.hertz(p.uncertainty)))});
  const auto examined = std::ranges::count_if(stability.points, &StablePoint::examined);
  if (missing_multipliers_.empty() && task_.budget.used_up())
    missing_multipliers_ = format(
        "the budget is used up, more with --budget: %d of %td points judged are "
        "undecided, %d bifurcations were seen and not located",
        stability.failed, stability.failed + examined, stability.missed);
  return stability;
}

void BalanceBranch::add_row(const StablePoint& at, std::size_t number)
{
  PeriodicMotion motion = at.point.motion;
  touches = touches || motion::touches(task_.parameters, motion);
  ResponseRow row{.frequency = task_.hertz(motion.omega),
                  .arc = at.point.arc,
                  .newton = motion.newton.iterations,
                  .branch = number,
                  .bifurcation = name_of(at.bifurcation)};
  std::ranges::copy(amplitude(motion), row.amplitude.begin());
  row.verdict = at.verdict();
  if (at.examined()) put_multipliers(row, at.floquet);
  const bool has_lines = task_.request.waterfall && number == 1;
  if (has_further_ || has_lines || !task_.request.harmonics_of.empty())
    motion.bodies = body_series(task_.parameters, motion);
  row.harmonics = harmonics_of(task_, motion.bodies);
  const Measures& measures = columns_.measures;
  if (has_further_ && task_.has_two_frequencies) {
    const auto [points, turns] = measures.recording(task_.parameters, motion.omega, 128);
    const motion::Motion record =
        motion::motion_of(task_.parameters, motion, points, turns);
    row.measured = measures.of(record_of(task_.parameters, record, false));
  } else if (has_further_) {
    row.measured =
        measures.of(task_.parameters, motion, std::max(256, 4 * task_.harmonics + 4));
  }
  table_.row(columns_.fields, row);
  if (!has_lines) return;
  auto found = motion::lines_of(task_.machine.bearing, motion, task_.parameters.turns);
  for (motion::Line& line : found.lines) line.order *= task_.passages;
  add_lines(lines, bearings_of(task_.machine), row.frequency, found, 128, 1e-4);
}

}  // namespace

Exploration branch_by_balance(ResponseTask task)
{
  const ResponseRequest& request = task.request;
  const bool two = task.has_two_frequencies;
  if (!two)
    task.parameters.bodies->prepare(task.parameters, task.range().from, task.harmonics);
  const std::clock_t read = std::clock();
  PeriodicMotion found;
  if (!task.saved) {
    found = two ? torus_start(task) : found_start(task);
    if (!two) task.harmonics = found.harmonics.count();
    task.samples = found.samples;
  }
  const ResponseColumns columns =
      branch_columns(task, two ? found.harmonics : Harmonics(task.harmonics));
  Table table("Frequency response along the branch", columns.fields);
  const bool has_further =
      table.choose(request.columns, columns.usual, request.plot.has_value());
  if (!task.saved) table.value("start", one_word(found.start));
  BalanceBranch branch(task, found, table, columns, has_further);
  describe(table, task.machine);
  const int turns = task.parameters.turns;
  table.value("method", "aft");
  table.value("harmonics", two ? found.harmonics.count() : task.harmonics / turns);
  table.value("samples", two ? found.line.samples : task.samples / turns);
  put_branch(table, task, branch.all[0]);
  if (two)
    table.note(format("harmonics of all points of the branch, z = %d", found.line.z));
  table.note(
      format("pseudo-arc-length, relative tolerance %g", request.newton_tolerance));
  table.note("end of the branch: " + branch.all[0].end);
  if (request.isolated > 0) branch.look_beside();
  branch.add_rows();
  std::vector<NamedContent> files;
  if (request.save)
    files.push_back({*request.save, branch_text(task.parameters, task.harmonics,
                                                task.samples, task.upwards, branch.all)});
  if (request.waterfall) files.push_back({*request.waterfall, branch.lines.text()});
  const std::string unfinished = branch.unfinished();
  put_complete(table, unfinished);
  conclude(table, task.machine, branch.touches, task.budget);
  if (request.times && unfinished.empty())
    std::fprintf(stderr, "cpu_machine_s: %.5f\ncpu_branch_s: %.5f\n",
                 static_cast<double>(read) / CLOCKS_PER_SEC,
                 static_cast<double>(std::clock() - read) / CLOCKS_PER_SEC);
  return {std::move(table), std::move(files), unfinished};
}

Exploration branch_by_shooting(const ResponseTask& task)
{
  constexpr int points = 256;
  const ResponseRequest& request = task.request;
  const Parameters& machine = task.machine;
  require_rotation_period(machine, "shooting");
  const auto [from, to] = task.range();
  /** On the motion that the machine settles on where that has the period T. */
  const Settled settled =
      settle(machine, from, BasePeriod{}, {static_start(machine), 0}, {}, task.budget);
  std::string start = "time integration";
  State state = settled.at.state;
  if (settled.period != 1) {
    const auto closed = motion::closed_motion(
        {machine, from, task.harmonics, task.samples, task.settings.newton, task.budget},
        points, 1e-11);
    start = closed.start;
    state = closed.state;
  }
  ShootingCurve curve(machine, task.budget);
  const Branch branch = follow_branch(curve, from, to, curve.unknowns_of(state));
  const auto [fields, usual, measures] = branch_columns(task, Harmonics(task.harmonics));
  Table table("Frequency response along the branch", fields);
  const bool has_further = table.choose(request.columns, usual, request.plot.has_value());
  table.value("start", one_word(start));
  describe(table, machine);
  table.value("method", "shooting");
  put_branch(table, task, branch);
  table.note("end of the branch: " + branch.end);
  int undecided = 0;
  bool touches = false;
  std::string why;
  for (const auto& [solution, arc, tangent] : branch.points) {
    const State there = curve.state(solution.x);
    const int finer = measures.recording(machine, solution.omega, points).points;
    const motion::Motion motion = motion::one_period(machine, solution.omega, there,
                                                     {.intervals_per_period = finer});
    touches = touches || motion::contact_share(machine, motion) > 0;
    ResponseRow row{
        .frequency = task.hertz(solution.omega),
        .arc = arc,
        .newton = solution.newton.iterations,
        .harmonics = harmonics_of(task, motion::series_of(motion, task.harmonics))};
    const Eigen::MatrixXd q = motion::displacement_samples(motion);
    for (int i = 0; i < 4; ++i) row.amplitude[i] = half_range(q.col(i), true);
    if (has_further) row.measured = measures.of(record_of(machine, motion, true));
    if (request.stability) try {
        put_multipliers(row, motion::multipliers_through(machine, solution.omega, there,
                                                         task.budget));
      } catch (const NoSolution& none) {
        if (undecided++ == 0) why = none.what();
      }
    table.row(fields, row);
  }
  if (request.stability) table.row_line("undecided", {1, undecided, 0});
  if (undecided > 0) table.note("undecided points: " + why);
  const bool is_missing = undecided > 0 && task.budget.used_up();
  const std::string missing = !branch.covered ? stopped_at(task, branch)
                              : is_missing    ? machine.file + ": " + why
                                              : "";
  put_complete(table, missing);
  conclude(table, machine, touches, task.budget);
  return {std::move(table), {}, missing};
}

}  // namespace rotor_stator::explore
