/**
# A curve of solutions

What is followed by its arc length: n equations in the n + 1 scaled unknowns y = (X/ℓ,
ω/ω_ref). Harmonic balance and shooting are two of them. */
#pragma once

#include <Eigen/Core>

#include "balance/balance.hpp"
#include "balance/periodic_motion.hpp"
#include "model/parameters.hpp"

namespace rotor_stator {

class Curve {
public:
  /** ℓ and ω_ref [rad/s]. */
  Curve(double unknown_scale, double speed_scale)
      : length_(unknown_scale), speed_(speed_scale)
  {
  }
  virtual ~Curve() = default;

  virtual Eigen::Index unknowns() const = 0;  ///< n

  /** F at y; `with_slope` says that its slope will be asked for there. */
  virtual Eigen::VectorXd residual(const Eigen::VectorXd& y, bool with_slope) = 0;

  /** ∂F/∂y, n × (n+1), and its product with a direction. */
  virtual Eigen::MatrixXd slope(const Eigen::VectorXd& y) = 0;
  virtual Eigen::VectorXd slope_along(const Eigen::VectorXd& y,
                                      const Eigen::VectorXd& direction) = 0;

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
  virtual void spend(double operations) const = 0;

  double omega(const Eigen::VectorXd& y) const { return y[y.size() - 1] * speed_; }
  Eigen::VectorXd x(const Eigen::VectorXd& y) const
  {
    return y.head(y.size() - 1) * length_;
  }
  Eigen::VectorXd scaled(const PeriodicMotion& motion) const
  {
    Eigen::VectorXd y(motion.x.size() + 1);
    y << motion.x / length_, motion.omega / speed_;
    return y;
  }
  double speed_scale() const { return speed_; }

protected:
  double length_, speed_;
};

}  // namespace rotor_stator
