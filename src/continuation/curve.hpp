/**
# A curve of solutions

A curve is given by n equations in the n + 1 scaled unknowns y = (X/ℓ, ω/ω_ref), of
harmonic balance or of shooting, and followed by its arc length.

    Balance balance(bearing_problem(parameters, samples), harmonics);
    BalanceCurve curve(balance, settings);
    const Branch branch = follow_branch(curve, from, to, x);

The unknowns of shooting are the state at phase 0 over its sizes; its equations say P(s;
ω) = s. Φ comes from the variational equations, ∂P/∂ω from a difference of two maps.

    ShootingCurve curve(parameters, budget);
    const Branch branch = follow_branch(curve, from, to, curve.unknowns_of(state));
    const State state = curve.state(branch.points.back().motion.x); */
#pragma once

#include <Eigen/Core>

#include "balance/balance.hpp"
#include "balance/newton.hpp"
#include "continuation/sweep.hpp"
#include "time/shooting.hpp"

namespace rotor_stator {

class Curve {
public:
  explicit Curve(const ArcLengthSettings& settings) : settings_(settings) {}
  virtual ~Curve() = default;

  virtual Eigen::Index unknowns() const = 0;  ///< n

  /** F at y; `with_slope` says that its slope will be asked for there. */
  virtual Eigen::VectorXd residual(const Eigen::VectorXd& y, bool with_slope) = 0;

  /** ∂F/∂y, n × (n+1), and its product with a direction. */
  virtual Eigen::MatrixXd slope(const Eigen::VectorXd& y) = 0;
  virtual Eigen::VectorXd slope_along(const Eigen::VectorXd& y,
                                      const Eigen::VectorXd& direction)
  {
    return slope(y) * direction;
  }

  /** Sizes of F and of X/ℓ, for the relative tolerances. */
  virtual double residual_scale() const = 0;
  virtual double unknown_size() const = 0;

  /** The solution at y. */
  virtual PeriodicMotion motion_at(const Eigen::VectorXd& y) = 0;

  /** The solution at one speed near `x`, which may be far away. */
  virtual PeriodicMotion solved(double omega, const Eigen::VectorXd& x) = 0;

  /** Of the force so far. */
  virtual long evaluations() const = 0;

  /** Pays for work beside the equations. */
  virtual void spend(double /*operations*/) const {}

  const ArcLengthSettings& settings() const { return settings_; }
  double omega(const Eigen::VectorXd& y) const
  {
    return y[y.size() - 1] * settings_.speed_scale;
  }
  Eigen::VectorXd x(const Eigen::VectorXd& y) const
  {
    return y.head(y.size() - 1) * settings_.arc_unknown_scale;
  }
  Eigen::VectorXd scaled(const PeriodicMotion& motion) const
  {
    Eigen::VectorXd y(motion.x.size() + 1);
    y << motion.x / settings_.arc_unknown_scale, motion.omega / settings_.speed_scale;
    return y;
  }

protected:
  ArcLengthSettings settings_;
};

class BalanceCurve : public Curve {
public:
  /** `balance` must outlive it. */
  BalanceCurve(Balance& balance, const ArcLengthSettings& settings)
      : Curve(settings), balance_(balance)
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
    return balance_.problem().unknown_scale / settings_.arc_unknown_scale;
  }
  PeriodicMotion motion_at(const Eigen::VectorXd& y) override;
  PeriodicMotion solved(double omega, const Eigen::VectorXd& x) override
  {
    return solve(balance_, omega, x, settings_.newton);
  }
  long evaluations() const override { return balance_.evaluations(); }
  void spend(double operations) const override { balance_.spend(operations); }

private:
  Balance& balance_;
};

class ShootingCurve : public Curve {
public:
  ShootingCurve(const Parameters& parameters, const OperationBudget& budget);

  Eigen::VectorXd unknowns_of(const State& state) const
  {
    return vector_of(state).cwiseQuotient(sizes_);
  }
  State state(const Eigen::VectorXd& x) const { return state_of(x.cwiseProduct(sizes_)); }

  Eigen::Index unknowns() const override { return sizes_.size(); }
  Eigen::VectorXd residual(const Eigen::VectorXd& y, bool with_slope) override;
  Eigen::MatrixXd slope(const Eigen::VectorXd& y) override;
  double residual_scale() const override { return 1; }
  double unknown_size() const override { return 1 / settings_.arc_unknown_scale; }
  PeriodicMotion motion_at(const Eigen::VectorXd& y) override
  {
    return {.omega = omega(y), .x = x(y)};
  }
  PeriodicMotion solved(double omega, const Eigen::VectorXd& x) override;
  long evaluations() const override { return evaluations_; }

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
