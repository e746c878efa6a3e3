/**
# The balance with the speed among its unknowns

n equations in the n+1 scaled unknowns y = (X/ℓ, ω/ω_ref), closed by one linear condition
d·(y - y_predicted) = 0. With d near the branch's tangent the bordered Jacobian stays
regular where the branch folds back in ω (Keller 1977). The corrector is Newton without
damping: where it does not contract, the step was too long, and a damped Newton would look for
another solution far away. */
#pragma once

#include "continuation/branch.hpp"

namespace rotor_stator
{

/** How Newton ended, and how fast it was (Den Heijer and Rheinboldt 1981). */
struct Correction {
  NewtonReport newton;
  double contraction = 0;  ///< the largest ‖Δy_{k+1}‖/‖Δy_k‖ above rounding [-]
};

/** The unit tangent, and the sign of the bordered Jacobian's determinant: along a branch that is
    followed in one direction the sign stays the same, through folds too. */
struct Tangent {
  Eigen::VectorXd direction;
  bool positive;
};

class ExtendedBalance
{
public:
  ExtendedBalance(Balance& balance, const ArcLengthSettings& settings);

  /** The point of the branch at scaled `y`. */
  BranchPoint point(const Eigen::VectorXd& y, double arc, const NewtonReport& newton,
                    const Eigen::VectorXd& tangent) const;

  /** The longest last correction with which Newton may end [-]. */
  double last_correction() const;

  /** Pays for work beside the balance. */
  void spend(double operations) const { balance_.spend(operations); }

  /** Newton on the balance and direction·(y - predicted) = 0, from `y` = `predicted`. */
  Correction correct(const Eigen::VectorXd& direction, const Eigen::VectorXd& predicted,
                     Eigen::VectorXd& y);

  /** At the last residual, on the side of `previous`. */
  Tangent tangent(const Eigen::VectorXd& previous);

private:
  double omega(const Eigen::VectorXd& y) const;
  Eigen::VectorXd unknowns(const Eigen::VectorXd& y) const;
  NewtonEnd verdict(const Correction& correction, double length) const;
  const Eigen::MatrixXd& bordered(const Eigen::VectorXd& last_row);
  const Eigen::VectorXd& residual(const Eigen::VectorXd& y);

  Balance& balance_;
  const ArcLengthSettings& settings_;
  Eigen::Index n_;
  Eigen::MatrixXd matrix_;
};

/** The solution near `x` at `omega` with its tangent, on the side of higher speeds if `upwards`. Throws
    NoSolution when there is none. */
BranchPoint point_of(Balance& balance, double omega, Eigen::VectorXd x, bool upwards,
                     const ArcLengthSettings& settings);

}  // namespace rotor_stator
