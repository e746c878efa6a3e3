#include "explore/response.hpp"

#include "balance/bearing_problem.hpp"
#include "explore/stability.hpp"
#include "explore/tables.hpp"
#include "io/errors.hpp"
#include "io/whole_file.hpp"
#include "motion/find_periodic.hpp"
#include "motion/motion.hpp"
#include "motion/other_starts.hpp"

namespace rotor_stator::explore
{

namespace
{

void check(const ResponseRequest& request)
{
  require_positive("--from", request.from);
  require_positive("--to", request.to);
  if (request.from >= request.to)
    throw BadInput(format("--from %g: must be below --to %g", request.from, request.to));
  require_between("--newton-tolerance", request.newton_tolerance, 1e-15, 1e-3);
  require_range("--isolated", request.isolated, 0, 10000);
  require_range("--seed", request.seed, 0, 1000000000);
  require_range("--branch", request.branch, 1, 1000000);
  if (request.at) require_between("--at", *request.at, request.from, request.to);
  if (!request.direction.empty() && request.direction != "up" &&
      request.direction != "down")
    throw BadInput("--direction " + request.direction + ": must be up or down");
  if (request.restart.empty() && (request.at || request.branch != 1))
    throw BadInput("--at and --branch: only with --restart");
  if (!request.save.empty()) require_writable(request.save);
}

}  // namespace

ResponseTask task_of(const ResponseRequest& request)
{
  Parameters parameters = read_parameters(request.parameter_file);
  check(request);
  std::optional<SavedBranch> saved;
  if (!request.restart.empty())
    saved = read_branch(request.restart, parameters, request.branch);
  const int harmonics = request.harmonics.value_or(saved ? saved->harmonics : 6);
  std::optional<int> samples = request.samples;
  if (!samples && saved && saved->harmonics == harmonics) samples = saved->samples;
  const int checked = checked_samples(harmonics, samples);
  /** The starts beside the branch, nine at each speed, must fit into the memory. */
  require_range("--isolated", request.isolated, 0, 500000 / harmonics);
  ArcLengthSettings settings =
      motion::arc_length_settings(parameters, {.tolerance = request.newton_tolerance});
  settings.most_evaluations =
      std::numeric_limits<long>::max();  // the budget is the bound
  const bool upwards =
      request.direction.empty() ? !saved || saved->upwards : request.direction == "up";
  const OperationBudget budget =
      checked_budget(request.budget, request.stability ? 3e10 : 3e9, parameters);
  return {request,          std::move(parameters),
          std::move(saved), harmonics,
          checked,          settings,
          upwards,          budget};
}

/**
## The branch of explore response

Where it starts, what it meets, what is beside it. */

namespace
{

/** A saved point, turned and with as many harmonics as are asked for. */
BranchPoint saved_start(const ResponseTask& task, Table& table)
{
  const ResponseRequest& request = task.request;
  const double at = angular(request.at.value_or(0));
  BranchPoint point =
      restart_point(*task.saved, request.at ? &at : nullptr, task.settings);
  const double frequency = point.omega / angular(1);
  if (point.omega < angular(request.from) || point.omega > angular(request.to))
    throw BadInput(format("%s: the point at %.9g Hz is outside --from %g --to %g",
                          request.restart.c_str(), frequency, request.from, request.to));
  if (task.upwards != task.saved->upwards) point = reversed(std::move(point));
  if (task.harmonics != task.saved->harmonics) {
    const double speed = point.tangent[point.x.size()];
    point.tangent =
        resize_harmonics(point.tangent.head(point.x.size()), 2, task.harmonics);
    point.x = resize_harmonics(point.x, 2, task.harmonics);
    point.tangent.conservativeResize(point.x.size() + 1);
    point.tangent[point.x.size()] = speed;
  }
  table.note(format("start: %s at %.12g Hz, %d harmonics", request.restart.c_str(),
                    frequency, task.saved->harmonics));
  return point;
}

/** A solution at the edge of the range, by whatever start finds one. */
BranchPoint found_start(const ResponseTask& task, Balance& balance, Table& table)
{
  const double omega = task.range().from;
  const motion::PeriodicSolution start =
      motion::find_periodic(task.parameters, omega, task.harmonics, task.samples,
                            task.settings.newton, task.budget);
  if (!start.found())
    throw NoSolution(format("%s: no solution found with %d harmonics at --%s %g Hz: %s",
                            task.parameters.file.c_str(), task.harmonics,
                            task.upwards ? "from" : "to", omega / angular(1),
                            start.newton.reason().c_str()));
  table.note("start: " + start.start);
  return point_of(balance, omega, start.x, task.upwards, task.settings);
}

/** A branch, and on demand its multipliers. */
struct Examined {
  const Branch& branch;
  std::optional<BranchStability> stability;
};

/** One row per point; with `number` at the end where there may be several branches. */
void add_rows(Table& table, const ResponseTask& task, Balance& balance,
              const Examined& examined, std::optional<std::size_t> number)
{
  FourierTransform transform = amplitude_transform(task.harmonics);
  const auto add = [&](const BranchPoint& point, std::vector<Cell> more) {
    balance.residual(point.x, point.omega);
    const Eigen::VectorXd a = half_peak_to_peak(
        body_series(task.parameters, balance, point.omega, point.x), transform);
    std::vector<Cell> row{point.omega / angular(1), a[0], a[1], a[2], a[3], point.arc,
                          point.newton.iterations};
    row.insert(row.end(), more.begin(), more.end());
    if (number) row.emplace_back(*number);
    table.row(std::move(row));
  };
  if (examined.stability)
    for (const StablePoint& p : examined.stability->points)
      add(p.point, stability_cells(p));
  else
    for (const BranchPoint& point : examined.branch.points) add(point, {});
  if (number) table.gap();
}

std::string summary(const Branch& branch)
{
  double low = branch.points.front().omega, high = low;
  for (const BranchPoint& point : branch.points) {
    low = std::min(low, point.omega);
    high = std::max(high, point.omega);
  }
  return format(
      "%.9g to %.9g Hz, %zu points, %zu folds, %ld evaluations of the force, %s",
      low / angular(1), high / angular(1), branch.points.size(), branch.folds.size(),
      branch.evaluations,
      ((branch.covered ? "ended: " : "incomplete: ") + branch.end).c_str());
}

std::vector<Column> response_columns(bool stability, bool numbered)
{
  std::vector<Column> columns{{"f", "Hz", "speed of rotation"},
                              {"amp_x_s", "m", "half peak-to-peak of x_s"},
                              {"amp_y_s", "m", "half peak-to-peak of y_s"},
                              {"amp_x_r", "m", "half peak-to-peak of x_r"},
                              {"amp_y_r", "m", "half peak-to-peak of y_r"},
                              {"arc", "-", "scaled arc length from the first point"},
                              {"newton", "-", "Newton iterations of the corrector"}};
  if (stability)
    for (Column& column : stability_columns()) columns.push_back(std::move(column));
  if (numbered)
    columns.push_back({"branch", "-", "1 the branch followed, then those beside it"});
  return columns;
}

/** The branches beside the followed one, and what was not looked at. */
struct Others {
  std::vector<IsolatedBranch> found;
  std::string missing;
};

/** The branches beside `main`; what is said of each stands in the table's header. */
Others others(const ResponseTask& task, Balance& balance, const Branch& main,
              Table& table)
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
  for (const IsolatedBranch& other : others.found)
    table.note(format("branch %d: off the branches before it, found at %g Hz from %s; %s",
                      ++number, other.omega / angular(1), other.origin.c_str(),
                      summary(other.branch).c_str()));
  if (task.budget.used_up())
    others.missing =
        "the budget is used up, more with --budget: not every start was followed";
  else if (starts.cut_off > 0)
    others.missing =
        format("the budget cut off %d of %d time integrations, more with --budget",
               starts.cut_off, task.request.isolated);
  if (!others.missing.empty()) table.note("incomplete: " + others.missing);
  if (others.found.empty())
    table.note(format("no other branch found from %zu starts", starts.candidates.size()));
  return others;
}

/** The rows of all branches, and what their header says of the multipliers: which are missing. */
std::string add_branches(Table& table, const ResponseTask& task, Balance& balance,
                         const std::vector<const Branch*>& all, bool numbered)
{
  /** The table is written, whatever work is left. */
  Balance shown(bearing_problem(task.parameters, task.samples), task.harmonics);
  std::string missing;
  for (std::size_t k = 0; k < all.size(); ++k) {
    Examined examined{*all[k], {}};
    if (task.request.stability) {
      examined.stability =
          stability_within(task.budget, task.parameters, balance, *all[k], task.settings);
      const std::string prefix = numbered ? format("branch %zu, ", k + 1) : "";
      for (const std::string& note : stability_notes(*examined.stability))
        table.note(prefix + note);
      const std::string here = missing_stability(*examined.stability, task.budget);
      if (!here.empty()) table.note("incomplete: " + prefix + here);
      if (missing.empty()) missing = here;
    }
    add_rows(table, task, shown, examined,
             numbered ? std::optional(k + 1) : std::nullopt);
  }
  return missing;
}

void describe(Table& table, const ResponseTask& task, const Branch& branch)
{
  describe(table, task.parameters);
  table.note(
      format("method: aft, m = %d, N = %d, relative tolerance %g, pseudo-arc-length %s",
             task.harmonics, task.samples, task.request.newton_tolerance,
             task.upwards ? "up" : "down"));
  table.note(format("folds: %zu", branch.folds.size()));
  table.note(format("work: %ld evaluations of the force", branch.evaluations));
  table.note((branch.covered ? "ended: " : "incomplete: ") + branch.end);
}

/** The first thing that is missing, in the order in which it was asked for. */
std::string unfinished(const ResponseTask& task, const Branch& branch,
                       const std::string& isolated, const std::string& stability)
{
  if (branch.covered && !isolated.empty())
    return task.parameters.file + ": isolated branches: " + isolated;
  if (branch.covered)
    return stability.empty() ? "" : task.parameters.file + ": " + stability;
  return format("%s: the branch stopped at %g Hz, before --%s %g Hz: %s",
                task.parameters.file.c_str(), branch.points.back().omega / angular(1),
                task.upwards ? "to" : "from", task.range().to / angular(1),
                branch.end.c_str());
}

}  // namespace

Exploration explore_response(const ResponseRequest& request)
{
  const ResponseTask task = task_of(request);
  const bool numbered = request.isolated > 0;
  Table table("Frequency response along the branch",
              response_columns(request.stability, numbered));
  Balance balance(bearing_problem(task.parameters, task.samples, task.budget),
                  task.harmonics);
  const BranchPoint start =
      task.saved ? saved_start(task, table) : found_start(task, balance, table);
  const Branch main = follow_branch(balance, start, task.range(), task.settings);
  describe(table, task, main);

  Others beside;
  if (numbered) beside = others(task, balance, main, table);

  std::vector<const Branch*> all{&main};
  for (const IsolatedBranch& other : beside.found) all.push_back(&other.branch);
  const std::string without_multipliers =
      add_branches(table, task, balance, all, numbered);
  if (!request.save.empty())
    write_file(request.save, branch_text(task.parameters, task.harmonics, task.samples,
                                         task.upwards, all));
  return {std::move(table), unfinished(task, main, beside.missing, without_multipliers)};
}

}  // namespace rotor_stator::explore
