/**
# The branch of shooting as a curve

The unknowns are the state at phase 0 over its sizes, and the speed; the equations say
P(s; ω) = s. Φ comes from the variational equations, ∂P/∂ω from a difference of two maps.

    ShootingCurve curve(parameters, budget);
    const Branch branch =
        follow_branch(curve, from, to, curve.unknowns_of(state), curve.settings());
    const State state = curve.state(branch.points.back().motion.x); */
#pragma once

#include "continuation/branch.hpp"
#include "time/shooting.hpp"

namespace rotor_stator {

class ShootingCurve : public Curve {
public:
  ShootingCurve(const Parameters& parameters, const OperationBudget& budget);

  ArcLengthSettings settings() const;
  Eigen::VectorXd unknowns_of(const State& state) const
  {
    return vector_of(state).cwiseQuotient(sizes_);
  }
  State state(const Eigen::VectorXd& x) const { return state_of(x.cwiseProduct(sizes_)); }

  Eigen::Index unknowns() const override { return sizes_.size(); }
  Eigen::VectorXd residual(const Eigen::VectorXd& y, bool with_slope) override;
  Eigen::MatrixXd slope(const Eigen::VectorXd& y) override;
  Eigen::VectorXd slope_along(const Eigen::VectorXd& y,
                              const Eigen::VectorXd& direction) override
  {
    return slope(y) * direction;
  }
  double residual_scale() const override { return 1; }
  double unknown_size() const override { return 1 / length_; }
  PeriodicMotion motion_at(const Eigen::VectorXd& y) override
  {
    return {.omega = omega(y), .x = x(y)};
  }
  PeriodicMotion solved(double omega, const Eigen::VectorXd& x) override;
  long evaluations() const override { return evaluations_; }
  void spend(double) const override {}

private:
  Eigen::VectorXd ends(const Eigen::VectorXd& y, double omega);

  const Parameters& parameters_;
  Eigen::VectorXd sizes_;
  StepSettings steps_;
  long evaluations_ = 0;
  Eigen::VectorXd at_;  ///< where the slope was computed last
  Eigen::MatrixXd slope_;
};

}  // namespace rotor_stator
