#include "output/response_task.hpp"

#include "model/errors.hpp"
#include "output/option_checks.hpp"
#include "output/whole_file.hpp"
#include "scenes/motion.hpp"

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
  if (request.operations) require_between("--operations", *request.operations, 1e-6, 1e6);
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
      arc_length_settings(parameters, {.tolerance = request.newton_tolerance});
  settings.most_evaluations = static_cast<long>(request.work);
  const bool upwards =
      request.direction.empty() ? !saved || saved->upwards : request.direction == "up";
  return {request,          std::move(parameters),
          std::move(saved), harmonics,
          checked,          settings,
          upwards,          Work(request.most_operations())};
}

}  // namespace rotor_stator
