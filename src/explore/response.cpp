#include "explore/response.hpp"

#include "explore/response_branch.hpp"
#include "explore/response_sweep.hpp"

namespace rotor_stator::explore {

Exploration explore_response(const ResponseRequest& request)
{
  if (request.method == "auto") return settled_response(request);
  const ResponseTask task = response_task(request);
  if (request.method == "shooting") return branch_by_shooting(task);
  if (request.tolerance && !task.has_two_frequencies) return response_to_tolerance(task);
  return branch_by_balance(task);
}

}  // namespace rotor_stator::explore
