/** The branch of explore response: where it starts, what it meets, what is beside it. */
#include "balance/bearing_problem.hpp"
#include "model/errors.hpp"
#include "output/branch_file.hpp"
#include "output/explore_tables.hpp"
#include "output/option_checks.hpp"
#include "output/whole_file.hpp"
#include "scenes/motion.hpp"
#include "scenes/other_starts.hpp"
#include "scenes/response.hpp"

namespace rotor_stator
{

namespace
{

void check(const ResponseRequest& request)
{
  require_positive("--from", request.from);
  require_positive("--to", request.to);
  if (request.from >= request.to)
    throw BadInput(text("--from %g: must be below --to %g", request.from, request.to));
  require_between("--newton-tolerance", request.newton_tolerance, 1e-15, 1e-3);
  require_between("--work", request.work, 1, 1e12);
  require_between("--operations", request.operations, 1e-6, 1e6);
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

/** What a run of explore response works with. */
struct Task {
  const ResponseRequest& request;
  Parameters parameters;
  std::optional<SavedBranch> saved;
  int harmonics, samples;
  ArcLengthSettings settings;
  bool upwards;
  Work work;

  SpeedRange range() const
  {
    const double low = angular(request.from), high = angular(request.to);
    return upwards ? SpeedRange{low, high} : SpeedRange{high, low};
  }
};

Task task_of(const ResponseRequest& request)
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
      arc_length_settings(parameters, {.tolerance = request.newton_tolerance});
  settings.most_evaluations = static_cast<long>(request.work);
  const bool upwards =
      request.direction.empty() ? !saved || saved->upwards : request.direction == "up";
  return {request,          std::move(parameters),
          std::move(saved), harmonics,
          checked,          settings,
          upwards,          Work(request.operations * 1e9)};
}

/** A saved point, turned and with as many harmonics as are asked for. */
BranchPoint saved_start(const Task& task, Table& table)
{
  const ResponseRequest& request = task.request;
  const double at = angular(request.at.value_or(0));
  BranchPoint point =
      restart_point(*task.saved, request.at ? &at : nullptr, task.settings);
  const double frequency = point.omega / angular(1);
  if (frequency < request.from || frequency > request.to)
    throw BadInput(text("%s: the point at %.9g Hz is outside --from %g --to %g",
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
  table.note(text("start: %s at %.12g Hz, %d harmonics", request.restart.c_str(),
                  frequency, task.saved->harmonics));
  return point;
}

/** A solution at the edge of the range, by whatever start finds one. */
BranchPoint found_start(const Task& task, Balance& balance, Table& table)
{
  const double omega = task.range().from;
  const PeriodicSolution start =
      find_periodic(task.parameters, omega, task.harmonics, task.samples,
                    task.settings.newton, task.work);
  if (!start.found())
    throw NoSolution(text("%s: no solution found with %d harmonics at --%s %g Hz: %s",
                          task.parameters.file.c_str(), task.harmonics,
                          task.upwards ? "from" : "to", omega / angular(1),
                          start.newton.reason().c_str()));
  table.note("start: " + start.start);
  return point_of(balance, omega, start.x, task.upwards, task.settings);
}

/** One row per point; with `number` in front where there may be several branches. */
void add_rows(Table& table, const Task& task, Balance& balance, const Branch& branch,
              std::optional<std::size_t> number)
{
  for (const BranchPoint& point : branch.points) {
    balance.residual(point.x, point.omega);
    const Eigen::VectorXd amplitude =
        half_peak_to_peak(body_series(task.parameters, balance, point.omega, point.x));
    std::vector<Cell> row{point.omega / angular(1),
                          amplitude[0],
                          amplitude[1],
                          amplitude[2],
                          amplitude[3],
                          point.arc,
                          point.newton.iterations};
    if (number) row.emplace_back(*number);
    table.row(std::move(row));
  }
  if (number) table.gap();
}

std::string summary(const Branch& branch)
{
  double low = branch.points.front().omega, high = low;
  for (const BranchPoint& point : branch.points) {
    low = std::min(low, point.omega);
    high = std::max(high, point.omega);
  }
  return text("%.9g to %.9g Hz, %zu points, %zu folds, %ld evaluations of the force, %s",
              low / angular(1), high / angular(1), branch.points.size(),
              branch.folds.size(), branch.evaluations,
              ((branch.covered ? "ended: " : "incomplete: ") + branch.end).c_str());
}

std::vector<Column> response_columns(bool numbered)
{
  std::vector<Column> columns{{"f", "Hz", "speed of rotation"},
                              {"amp_x_s", "m", "half peak-to-peak of x_s"},
                              {"amp_y_s", "m", "half peak-to-peak of y_s"},
                              {"amp_x_r", "m", "half peak-to-peak of x_r"},
                              {"amp_y_r", "m", "half peak-to-peak of y_r"},
                              {"arc", "-", "scaled arc length from the first point"},
                              {"newton", "-", "Newton iterations of the corrector"}};
  if (numbered)
    columns.push_back({"branch", "-", "1 the branch followed, then those beside it"});
  return columns;
}

/** The branches beside `main`; what is said of each stands in the table's header. */
std::vector<IsolatedBranch> others(const Task& task, Balance& balance, const Branch& main,
                                   Table& table)
{
  const auto starts =
      other_starts(task.parameters, task.range(), task.harmonics,
                   {.speeds = task.request.isolated,
                    .seed = static_cast<std::uint64_t>(task.request.seed)},
                   task.work);
  auto found = isolated_branches(balance, main, starts, task.range(), task.settings);
  int number = 1;
  for (const IsolatedBranch& other : found)
    table.note(text("branch %d: off the branches before it, found at %g Hz from %s; %s",
                    ++number, other.omega / angular(1), other.origin.c_str(),
                    summary(other.branch).c_str()));
  if (task.work.used_up())
    table.note("the work allowed is used up: not every start was followed");
  else if (found.empty())
    table.note(text("no other branch found from %zu starts", starts.size()));
  return found;
}

void describe(Table& table, const Task& task, const Branch& branch)
{
  table.describe(task.parameters);
  table.note(
      text("method: aft, m = %d, N = %d, relative tolerance %g, pseudo-arc-length %s",
           task.harmonics, task.samples, task.request.newton_tolerance,
           task.upwards ? "up" : "down"));
  table.note(text("folds: %zu", branch.folds.size()));
  table.note(text("work: %ld evaluations of the force", branch.evaluations));
  table.note((branch.covered ? "ended: " : "incomplete: ") + branch.end);
}

std::string unfinished(const Task& task, const Branch& branch)
{
  if (branch.covered && task.request.isolated > 0 && task.work.used_up())
    return text("%s: the search for isolated branches used up the work allowed",
                task.parameters.file.c_str());
  if (branch.covered) return "";
  return text("%s: the branch stopped at %g Hz, before --%s %g Hz: %s",
              task.parameters.file.c_str(), branch.points.back().omega / angular(1),
              task.upwards ? "to" : "from", task.range().to / angular(1),
              branch.end.c_str());
}

}  // namespace

Exploration explore_response(const ResponseRequest& request)
{
  const Task task = task_of(request);
  const bool numbered = request.isolated > 0;
  Table table("Frequency response along the branch", response_columns(numbered));
  Balance balance(bearing_problem(task.parameters, task.samples, task.work),
                  task.harmonics);
  const BranchPoint start =
      task.saved ? saved_start(task, table) : found_start(task, balance, table);
  const Branch main = follow_branch(balance, start, task.range(), task.settings);
  describe(table, task, main);

  std::vector<IsolatedBranch> beside;
  if (numbered) beside = others(task, balance, main, table);

  /** The table is written, whatever work is left. */
  Balance shown(bearing_problem(task.parameters, task.samples), task.harmonics);
  add_rows(table, task, shown, main, numbered ? std::optional(1UL) : std::nullopt);
  std::vector<const Branch*> all{&main};
  for (const IsolatedBranch& other : beside) {
    all.push_back(&other.branch);
    add_rows(table, task, shown, other.branch, all.size());
  }
  if (!request.save.empty())
    write_file(request.save, branch_text(task.parameters, task.harmonics, task.samples,
                                         task.upwards, all));
  return {std::move(table), unfinished(task, main)};
}

}  // namespace rotor_stator
