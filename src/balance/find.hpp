/**
# A solution of the balance without a previous one

    PeriodicMotion six = find_near_contact({parameters, omega, 6});

The starts of Newton's method are, in this order: given ones, such as the solution at a
neighbouring speed; quasi-static contact; the solution with fewer harmonics.
motion/find_periodic adds further starts. */
#pragma once

#include <string>
#include <vector>

#include "balance/newton.hpp"
#include "io/budget.hpp"
#include "model/parameters.hpp"

namespace rotor_stator {

/** What is looked for, and how. */
struct BalanceSearch {
  const Parameters& parameters;
  double omega;                              ///< [rad/s]
  int harmonics;                             ///< m
  int samples = default_samples(harmonics);  ///< N
  NewtonSettings newton = {};
  OperationBudget budget = {};
  int turns = 1;  ///< K: a motion of period KT, orders h/K up to m, N a turn
  std::vector<Eigen::VectorXd> starts = {};  ///< coefficients to begin with
};

/** The solution with the series of both bodies; its ω is a K-th of the speed. Not found
    means that Newton converges from no start; of a motion of period KT from none that is
    given. Throws NoSolution when the budget is used up. */
PeriodicMotion find_near_contact(const BalanceSearch& search);

/** The same from one start, 2 × (2m+1) coefficients [m] as a vector. */
PeriodicMotion find_from(const BalanceSearch& search, const std::string& name,
                         const Eigen::VectorXd& x);

}  // namespace rotor_stator
