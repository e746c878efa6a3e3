/**
# The branch of harmonic balance as a curve

    Balance balance(bearing_problem(parameters, samples), harmonics);
    BalanceCurve curve(balance, settings);
    const Branch branch = follow_branch(curve, from, to, x, settings); */
#pragma once

#include "balance/balance.hpp"
#include "continuation/branch.hpp"

namespace rotor_stator {

class BalanceCurve : public Curve {
public:
  /** `balance` must outlive it. */
  BalanceCurve(Balance& balance, const ArcLengthSettings& settings)
      : Curve(settings.arc_unknown_scale, settings.speed_scale), balance_(balance),
        newton_(settings.newton), product_(balance.unknowns())
  {
  }

  Eigen::Index unknowns() const override { return balance_.unknowns(); }
  Eigen::VectorXd residual(const Eigen::VectorXd& y, bool with_slope) override;
  Eigen::MatrixXd slope(const Eigen::VectorXd& y) override;
  Eigen::VectorXd slope_along(const Eigen::VectorXd& y,
                              const Eigen::VectorXd& direction) override;
  double residual_scale() const override { return balance_.problem().residual_scale; }
  double unknown_size() const override
  {
    return balance_.problem().unknown_scale / length_;
  }
  PeriodicMotion motion_at(const Eigen::VectorXd& y) override;
  PeriodicMotion solved(double omega, const Eigen::VectorXd& x) override
  {
    return solve(balance_, omega, x, newton_);
  }
  long evaluations() const override { return balance_.evaluations(); }
  void spend(double operations) const override { balance_.spend(operations); }

private:
  Balance& balance_;
  NewtonSettings newton_;
  Eigen::VectorXd product_;
};

}  // namespace rotor_stator
