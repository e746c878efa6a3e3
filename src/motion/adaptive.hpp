/**
# The bearing's motion to a tolerance

The number of harmonics follows from an error that is asked for. This is `balance/adaptive_balance.hpp` for the rotor and the stator: the error is that of the four displacements,
the largest difference over the period over the largest displacement, and the rms about the mean. */
#pragma once

#include "balance/chosen_orders.hpp"
#include "continuation/sweep.hpp"
#include "motion/find_periodic.hpp"

namespace rotor_stator::motion {

/** Solutions of one machine to a tolerance, at one speed after the other. */
class AdaptiveSweep {
public:
  AdaptiveSweep(const Parameters& parameters, const AdaptiveSettings& settings,
                const OperationBudget& budget = {});
  AdaptiveSweep(const AdaptiveSweep&) = delete;  // chosen_ refers to parameters_

  /** At speed `omega` [rad/s], on chosen orders (balance/chosen_orders.hpp), from the first of these that reaches the
      tolerance: the paper's predictor; short time integration, which goes on from the last solution; quasi-static contact, which
      is the first start without a solution before. Where none does, as `solve_by_levels`. */
  AdaptiveMotion solve(double omega);

private:
  AdaptiveMotion solve_on_chosen(double omega);

  const Parameters parameters_;
  AdaptiveSettings settings_;
  OperationBudget budget_;
  std::optional<ChosenOrders> chosen_;  ///< of machines that these serve
  LagrangePredictor predictor_;
  State last_;  ///< of the last solution, at phase 0
};

/** Chooses orders and samples for the tolerance at speed `omega` [rad/s] alone. */
AdaptiveMotion solve_adaptively(const Parameters& parameters, double omega,
                                const AdaptiveSettings& settings,
                                const OperationBudget& budget = {});

/** Chooses m and N for the tolerance at speed `omega` [rad/s]. Newton starts from quasi-static contact;
    when that fails with several m, from short time integration (not of machines given by matrices), and when that has
    failed too, once from whatever `search_periodic` finds, whose evaluations are not counted. Where no m is enough and integration from rest settles on a motion of period T, from that motion; the
    error is then the distance from it. */
AdaptiveMotion solve_by_levels(const Parameters& parameters, double omega,
                               const AdaptiveSettings& settings,
                               const OperationBudget& budget = {});

/** The solution of a search; `reached` when its error is estimated below the tolerance. */
AdaptiveMotion find_with_error(const Search& search, double tolerance);

/** The error of a solution that is at hand. */
ErrorEstimate estimate_error(const Parameters& parameters, const PeriodicMotion& motion,
                             const OperationBudget& budget = {});

}  // namespace rotor_stator::motion
