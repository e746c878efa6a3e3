/**
# Orders chosen by their size

A motion with the period of rotation has orders up to the contact's resonance and beyond, and few of them are large: at
36 Hz of set 1 four, of which the last is order 15. The balance is solved on few orders that are chosen (Grolet and Thouverez
2012). What they leave out is found by the equations of motion at finer samples (equations_in_time.hpp),
which answer the residual there at all orders up to a third of the samples: a step of Newton's method but for some
hundredths, in O(N) operations. It is measured by how far it moves the bodies, since a resonance of the contact hides a
large error behind a small residual. Where further steps, each 0.7 of the one before, would together stay within the tolerance, the
error is clear at once. Otherwise the next step says what is left, and its length replaces the 0.7; where that is more than a third,
GMRES takes the step further.

Where more than sixteen orders are needed, or Newton fails on fewer, the same steps go on until they converge; but a predictor
that fails at once is given up. That solution has all orders up to a third of the samples.

What the samples leave out, the orders above and the aliases among those below, is one more step, at finer samples: 5/3 or 7/4
times as many (5/2 of 32), whose aliases differ. Twice as many could share the one that matters: a whirl over 20 balls excites
order 101, which falls on order 5 of 48 samples and of 96. The spectrum of a Hertz contact falls as k^{-5/2}: what the finer
samples leave out themselves is then 0.39 of the step, or less; one half is added. Samples are doubled, far from it quadrupled,
until the sum is below the tolerance.

Orders that the tolerance may notice are kept. From speed to speed orders, samples, tables and factors serve again. */
#pragma once

#include <map>

#include "balance/adaptive_balance.hpp"
#include "balance/bearing_problem.hpp"

namespace rotor_stator {

/** Of two masses whose bearing is plain. `parameters` must outlive it. */
class ChosenOrders {
public:
  ChosenOrders(const Parameters& parameters, const AdaptiveSettings& settings,
               const OperationBudget& budget = {});
  ~ChosenOrders();

  /** Whether the machine is one that this can solve. */
  static bool serves(const Parameters& parameters);

  /** What a start is: a guess, whose orders mean little; the extrapolation of solutions before, whose orders and samples
      are kept; or an integrated motion, which has all orders. */
  enum class From { guess, predictor, integration };

  /** The solution at `omega` [rad/s] from coefficients of any number of harmonics. Its harmonics are all up to the highest order that was chosen, with zeros for those that were not. Not
      `reached` where no steps converge, or the settings allow no more harmonics. */
  AdaptiveMotion solve(double omega, const Eigen::VectorXd& x, From from);

  /** Whether the last start was a predictor that failed at once on few orders. */
  bool has_jumped() const { return has_jumped_; }

private:
  struct Grid;
  struct Steps;
  Grid& grid(int samples);
  Grid& finer_than(const Grid& at);
  Eigen::MatrixXd left_out_by(Grid& at, const Eigen::VectorXd& x, double omega);
  enum class OnFew { reached, more_orders, needs_all, not_found };
  OnFew solve_on_few(double omega, Eigen::VectorXd& x);
  bool solve_on_all(double omega, Eigen::VectorXd& x);

  const Parameters& parameters_;
  AdaptiveSettings settings_;
  OperationBudget budget_;
  std::vector<int> orders_;  ///< chosen, ascending, 0 first
  int samples_ = 0;          ///< by which they are measured
  bool has_jumped_ = false;
  std::unique_ptr<Balance> balance_;
  std::vector<int> on_;                         ///< the orders that this is on
  std::map<int, std::unique_ptr<Grid>> grids_;  ///< by number of samples
  AdaptiveMotion result_;
};

}  // namespace rotor_stator
