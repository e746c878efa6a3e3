/**
# What explore response works with

The request, checked, with the machine, the saved branch and the settings that belong to it. */
#pragma once

#include "continuation/arc_length.hpp"
#include "explore/branch_file.hpp"
#include "explore/tables.hpp"
#include "io/budget.hpp"
#include "io/scene.hpp"

namespace rotor_stator::explore
{

struct ResponseTask {
  const ResponseRequest& request;
  Parameters parameters;
  std::optional<SavedBranch> saved;
  int harmonics, samples;
  ArcLengthSettings settings;
  bool upwards;
  OperationBudget budget;

  SpeedRange range() const
  {
    const double low = angular(request.from), high = angular(request.to);
    return upwards ? SpeedRange{low, high} : SpeedRange{high, low};
  }
};

/** Throws BadInput for options out of range and files that cannot be read. */
ResponseTask task_of(const ResponseRequest& request);

}  // namespace rotor_stator::explore
