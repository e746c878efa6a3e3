/**
# Stability in the tables of explore

Floquet multipliers within a bound on work, and what is said of them. */
#pragma once

#include "io/budget.hpp"
#include "io/table.hpp"
#include "stability/branch_stability.hpp"

namespace rotor_stator::explore
{

/** The multipliers along the coefficients `x`, paid for from `budget`. Throws NoSolution when it is used
    up. */
Floquet paid_floquet(const OperationBudget& budget, const Parameters& parameters,
                     double omega, const Eigen::VectorXd& x);

/** The multipliers and bifurcations of a branch, as far as `budget` goes; `balance` is the one the branch
    was followed with. */
BranchStability stability_within(const OperationBudget& budget,
                                 const Parameters& parameters, Balance& balance,
                                 const Branch& branch, const ArcLengthSettings& settings);

std::vector<Column> stability_columns();

/** The cells of these columns; -1 for a multiplier that was not computed. */
std::vector<Cell> stability_cells(const StablePoint& point);

/** One line in all, then one line per bifurcation. */
std::vector<std::string> stability_notes(const BranchStability& stability);

/** What was not computed and why; empty when nothing is missing. */
std::string missing_stability(const BranchStability& stability,
                              const OperationBudget& budget);

}  // namespace rotor_stator::explore
