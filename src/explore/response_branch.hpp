/**
# explore response along a branch of periodic solutions

By harmonic balance with its folds, on demand the branches beside it, multipliers and
bifurcations; or by shooting. */
#pragma once

#include "explore/response.hpp"

namespace rotor_stator::explore {

/** Along a branch: by harmonic balance, or by shooting. */
Exploration branch_by_balance(ResponseTask task);
Exploration branch_by_shooting(const ResponseTask& task);

}  // namespace rotor_stator::explore
