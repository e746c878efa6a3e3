/**
# The paper's predictor (Eqs 19 to 21)

The last four solutions (X_i, ω_i) are points on a curve whose arc length is measured by
chords,

$$\delta s_{i+1} = \sqrt{\|X_{i+1} - X_i\|^2 / \ell^2 + (\omega_{i+1} - \omega_i)^2 /
\omega_{ref}^2}, \tag{19}$$

with X scaled by a length ℓ and ω by a reference speed: as printed, metres are added to
rad/s and ω alone decides (D-03). The cubic through them is read at S_4 = S_3 + Δs (Eq. 20
with S_4 in the numerator; as printed, with S_3, it returns the last point unchanged,
D-02). With fewer points the polynomial has a lower degree. */
#pragma once

#include <Eigen/Core>
#include <deque>

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

}  // namespace rotor_stator
