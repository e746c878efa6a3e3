#include "continuation/lagrange_predictor.hpp"

#include <cmath>

namespace rotor_stator
{

double LagrangePredictor::chord(const Point& a, const Point& b) const
{
  return std::hypot((b.x - a.x).norm() / unknown_scale_,
                    (b.omega - a.omega) / speed_scale_);
}

void LagrangePredictor::add(const Eigen::VectorXd& x, double omega)
{
  Point point{x, omega};
  distance_.push_back(points_.empty() ? 0.0
                                      : distance_.back() + chord(points_.back(), point));
  points_.push_back(std::move(point));
  if (points_.size() > 4) {
    points_.pop_front();
    distance_.pop_front();
  }
}

/** Lagrange weights Π_{j≠i} (s - S_j)/(S_i - S_j). */
Eigen::VectorXd LagrangePredictor::weights(double s) const
{
  const auto n = distance_.size();
  Eigen::VectorXd weight = Eigen::VectorXd::Ones(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      if (i != j) weight[i] *= (s - distance_[j]) / (distance_[i] - distance_[j]);
  return weight;
}

double LagrangePredictor::speed_at(double s) const
{
  const Eigen::VectorXd weight = weights(s);
  double omega = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) omega += weight[i] * points_[i].omega;
  return omega;
}

LagrangePredictor::Point LagrangePredictor::at_distance(double delta_s) const
{
  const double s = distance_.back() + delta_s;
  const Eigen::VectorXd weight = weights(s);
  Point point{Eigen::VectorXd::Zero(points_.back().x.size()), speed_at(s)};
  for (std::size_t i = 0; i < points_.size(); ++i) point.x += weight[i] * points_[i].x;
  return point;
}

Eigen::VectorXd LagrangePredictor::at_speed(double omega) const
{
  const Point& last = points_.back();
  if (points_.size() < 2) return last.x;

  /** Secant iterations on ω(S) = ω, started by the last chord. When they leave the
     neighbourhood (the curve turns back) the last point is the best guess there is. */
  const Point& before = points_[points_.size() - 2];
  const double step = distance_.back() - distance_[distance_.size() - 2];
  const double guess = step * (omega - last.omega) / (last.omega - before.omega);
  if (!std::isfinite(guess)) return last.x;
  double s_0 = distance_.back(), f_0 = last.omega - omega;
  double s_1 = s_0 + guess;
  for (int iteration = 0; iteration < 8; ++iteration) {
    const double f_1 = speed_at(s_1) - omega;
    if (std::abs(f_1) <= 1e-12 * std::abs(omega)) break;
    const double s_2 = s_1 - f_1 * (s_1 - s_0) / (f_1 - f_0);
    s_0 = s_1;
    f_0 = f_1;
    s_1 = s_2;
    if (!(std::abs(s_1 - distance_.back()) <= 4 * std::abs(guess))) return last.x;
  }
  return at_distance(s_1 - distance_.back()).x;
}

}  // namespace rotor_stator
