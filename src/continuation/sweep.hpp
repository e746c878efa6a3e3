/**
# The paper's predictor (Eqs 19 to 21)

The last four solutions (X_i, ω_i) are points on a curve whose arc length is measured by
chords,

$$\delta s_{i+1} = \sqrt{\|X_{i+1} - X_i\|^2 / \ell^2 + (\omega_{i+1} - \omega_i)^2 /
\omega_{ref}^2}, \tag{19}$$

with X scaled by a length ℓ and ω by a reference speed: as printed, metres are added to
rad/s and ω alone decides (D-03). Summed up,

$$S_0 = 0, \quad S_{i+1} = S_i + \delta s_{i+1}, \quad S_4 = S_3 + \Delta s, \tag{21}$$

they are the argument of the cubic through the four points, which is read at S_4:

$$(X_4, \omega_4) = \sum_{i=0}^{3} \Big(\prod_{j \ne i} \frac{S_4 - S_j}{S_i - S_j}\Big)\,
(X_i, \omega_i). \tag{20}$$

As printed, with S_3 in the numerator, it returns the last point unchanged (D-02). With fewer points the polynomial has a lower degree. */
#pragma once

#include <Eigen/Core>
#include <deque>
#include <functional>
#include <vector>

#include "balance/newton.hpp"

namespace rotor_stator
{

class LagrangePredictor
{
public:
  LagrangePredictor(double unknown_scale, double speed_scale)
      : unknown_scale_(unknown_scale), speed_scale_(speed_scale)
  {
  }

  void add(const Eigen::VectorXd& x, double omega);
  void clear()
  {
    points_.clear();
    distance_.clear();
  }
  bool empty() const { return points_.empty(); }

  /** Eq. 20 at S_3 + Δs: the extrapolated (X, ω). */
  struct Point {
    Eigen::VectorXd x;
    double omega;
  };
  Point at_distance(double delta_s) const;

  /** The extrapolated X at a prescribed speed: Δs is chosen so that ω(S_4) = ω. */
  Eigen::VectorXd at_speed(double omega) const;

private:
  Eigen::VectorXd weights(double s) const;
  double speed_at(double s) const;
  double chord(const Point& a, const Point& b) const;

  double unknown_scale_, speed_scale_;
  std::deque<Point> points_;     ///< at most four
  std::deque<double> distance_;  ///< S_i (Eq. 21)
};

/**
## A sweep at prescribed speeds, as the paper does it

At each speed Newton starts from the paper's predictor. When it fails, the gap to the
speed is halved (the solutions in between feed the predictor and are not kept); when that
fails too the speed has no solution on this branch, which is recorded, and the next speed
starts anew. */

struct SweepSettings {
  NewtonSettings newton;
  double speed_scale;        ///< ω_ref [rad/s] of Eq. 19
  double arc_unknown_scale;  ///< ℓ of Eq. 19
  int most_halvings = 4;
};

struct SweepPoint {
  double omega;       ///< [rad/s]
  Eigen::VectorXd x;  ///< empty when no solution was found
  NewtonReport
      newton;  ///< of the last attempt; `iterations` counts all attempts at this speed
  bool
      restarted;  ///< from a cold start: it may lie on another branch than the last point

  bool found() const { return newton.converged(); }
};

/** A start for Newton where no previous solution is at hand. */
using ColdStart = std::function<Eigen::VectorXd(double omega)>;

/** Solves at each of `omegas` in order and calls `visit` at each found point, while the
   balance still holds its residual. */
std::vector<SweepPoint> sweep(Balance& balance, const std::vector<double>& omegas,
                              const ColdStart& cold_start, const SweepSettings& settings,
                              const std::function<void(const SweepPoint&)>& visit = {});

}  // namespace rotor_stator
