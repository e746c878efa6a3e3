#include "continuation/sweep.hpp"

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

namespace
{

/** The state of a sweep between two speeds. */
class Sweep
{
public:
  Sweep(Balance& balance, const ColdStart& cold_start, const SweepSettings& settings)
      : balance_(balance),
        cold_start_(cold_start),
        settings_(settings),
        predictor_(settings.arc_unknown_scale, settings.speed_scale)
  {
  }

  SweepPoint solve_at(double omega)
  {
    SweepPoint point{omega, {}, {}, false};
    if (!predictor_.empty()) approach(point, omega, settings_.most_halvings);
    if (!point.found()) {
      predictor_.clear();
      point.restarted = true;
      attempt(point, omega, cold_start_(omega));
    }
    if (!point.found()) point.x.resize(0);
    return point;
  }

private:
  /** One Newton solution at `omega`; on success the predictor learns it. */
  bool attempt(SweepPoint& point, double omega, Eigen::VectorXd x)
  {
    const int before = point.newton.iterations;
    point.newton = solve(balance_, omega, x, settings_.newton);
    point.newton.iterations += before;
    if (!point.found()) return false;
    predictor_.add(x, omega);
    last_omega_ = omega;
    point.x = std::move(x);
    return true;
  }

  /** From the last solution to the point's speed, through half-way speeds if it must be.
   */
  bool approach(SweepPoint& point, double omega, int halvings)
  {
    if (attempt(point, omega, predictor_.at_speed(omega))) return true;
    if (halvings == 0) return false;
    const double middle = 0.5 * (last_omega_ + omega);
    return approach(point, middle, halvings - 1) && approach(point, omega, halvings - 1);
  }

  Balance& balance_;
  const ColdStart& cold_start_;
  const SweepSettings& settings_;
  LagrangePredictor predictor_;
  double last_omega_ = 0;
};

}  // namespace

std::vector<SweepPoint> sweep(Balance& balance, const std::vector<double>& omegas,
                              const ColdStart& cold_start, const SweepSettings& settings,
                              const std::function<void(const SweepPoint&)>& visit)
{
  Sweep state(balance, cold_start, settings);
  std::vector<SweepPoint> points;
  for (double omega : omegas) {
    points.push_back(state.solve_at(omega));
    if (visit && points.back().found()) visit(points.back());
  }
  return points;
}

}  // namespace rotor_stator
