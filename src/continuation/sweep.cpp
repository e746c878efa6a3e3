#include "continuation/sweep.hpp"

#include <algorithm>
#include <cmath>

#include "balance/bearing_problem.hpp"

namespace rotor_stator {

void LagrangePredictor::add(Eigen::VectorXd x, double omega)
{
  const Eigen::Index longest =
      empty() ? x.size() : std::max(x.size(), points_.back().x.size());
  x.conservativeResizeLike(Eigen::VectorXd::Zero(longest));
  for (Point& point : points_)
    point.x.conservativeResizeLike(Eigen::VectorXd::Zero(longest));
  double arc = 0;
  if (!empty())
    arc = points_.back().arc + std::hypot((x - points_.back().x).norm() / unknown_scale_,
                                          (omega - points_.back().omega) / speed_scale_);
  points_.push_back({std::move(x), omega, arc});
  if (points_.size() > 4) points_.pop_front();
}

/** Lagrange weights Π_{j≠i} (s - S_j)/(S_i - S_j). */
Eigen::VectorXd LagrangePredictor::weights(double s) const
{
  const auto n = points_.size();
  Eigen::VectorXd weight = Eigen::VectorXd::Ones(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      if (i != j) weight[i] *= (s - points_[j].arc) / (points_[i].arc - points_[j].arc);
  return weight;
}

double LagrangePredictor::speed_at(double s) const
{
  const Eigen::VectorXd weight = weights(s);
  double omega = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) omega += weight[i] * points_[i].omega;
  return omega;
}

PeriodicMotion LagrangePredictor::at_arc(double delta_s) const
{
  const double s = points_.back().arc + delta_s;
  const Eigen::VectorXd weight = weights(s);
  PeriodicMotion point{.omega = speed_at(s),
                       .x = Eigen::VectorXd::Zero(points_.back().x.size())};
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
  const double step = last.arc - before.arc;
  const double guess = step * (omega - last.omega) / (last.omega - before.omega);
  if (!std::isfinite(guess)) return last.x;
  double s_0 = last.arc, f_0 = last.omega - omega;
  double s_1 = s_0 + guess;
  for (int iteration = 0; iteration < 8; ++iteration) {
    const double f_1 = speed_at(s_1) - omega;
    if (std::abs(f_1) <= 1e-12 * std::abs(omega)) break;
    const double s_2 = s_1 - f_1 * (s_1 - s_0) / (f_1 - f_0);
    s_0 = s_1;
    f_0 = f_1;
    s_1 = s_2;
    if (!(std::abs(s_1 - last.arc) <= 4 * std::abs(guess))) return last.x;
  }
  return at_arc(s_1 - last.arc).x;
}

namespace {

/** The state of a sweep between two speeds. */
struct Sweep {
  Balance& balance;
  const ColdStart& cold_start;
  const ArcLengthSettings& settings;
  LagrangePredictor predictor{settings.arc_unknown_scale, settings.speed_scale};
  BalanceSolver solver{balance};  ///< keeps its factors from speed to speed
  double last_omega = 0;

  PeriodicMotion solve_at(double omega)
  {
    constexpr int most_halvings = 4;
    PeriodicMotion motion{.omega = omega, .start = from_predictor};
    if (!predictor.empty()) approach(motion, omega, most_halvings);
    if (!motion.found()) {
      predictor.clear();
      attempt(motion, omega, cold_start(omega));
      motion.start = "cold start";
    }
    if (!motion.found()) motion.x.resize(0);
    motion.omega = omega;
    return motion;
  }

  /** One Newton solution at `omega`; on success the predictor learns it. */
  bool attempt(PeriodicMotion& motion, double omega, Eigen::VectorXd x)
  {
    const int iterations = motion.newton.iterations;
    const long force_samples = motion.force_samples;
    motion.omega = omega;
    motion.x = std::move(x);
    solve(balance, solver, motion, settings.newton);
    motion.newton.iterations += iterations;
    motion.force_samples += force_samples;
    if (!motion.found()) return false;
    predictor.add(motion.x, omega);
    last_omega = omega;
    return true;
  }

  /** From the last solution to the motion's speed, through half-way speeds if it must
      be. */
  bool approach(PeriodicMotion& motion, double omega, int halvings)
  {
    if (attempt(motion, omega, predictor.at_speed(omega))) return true;
    if (halvings == 0) return false;
    const double middle = 0.5 * (last_omega + omega);
    return approach(motion, middle, halvings - 1) &&
           approach(motion, omega, halvings - 1);
  }
};

}  // namespace

/** A joint to the ground moves as its body does: near the resonance of the joined bodies
    about ten times as far as their unbalance is eccentric. */
ArcLengthSettings arc_length_settings(const Parameters& parameters,
                                      const NewtonSettings& newton)
{
  double length = scales(parameters).length;
  if (!parameters.grounds.empty())
    length +=
        10 * parameters.unbalance / (parameters.stator.mass + parameters.rotor.mass);
  return {.newton = newton,
          .speed_scale = speed_scale(parameters),
          .arc_unknown_scale = length};
}

std::vector<PeriodicMotion> sweep(Balance& balance, const std::vector<double>& omegas,
                                  const ColdStart& cold_start,
                                  const ArcLengthSettings& settings)
{
  Sweep state{balance, cold_start, settings};
  std::vector<PeriodicMotion> motions;
  for (double omega : omegas) motions.push_back(state.solve_at(omega));
  return motions;
}

std::vector<PeriodicMotion> sweep(const Parameters& parameters,
                                  const std::vector<double>& omegas, int harmonics,
                                  int samples, const OperationBudget& budget)
{
  if (samples == 0) samples = default_samples(harmonics);
  Balance balance(bearing_problem(parameters, samples, budget), harmonics);
  auto motions = sweep(
      balance, omegas,
      [&](double omega) { return quasi_static_start(parameters, omega, harmonics); },
      arc_length_settings(parameters));
  for (PeriodicMotion& motion : motions)
    if (motion.found()) motion.bodies = body_series(parameters, motion);
  return motions;
}

CurvePoint refined_peak(const std::vector<CurvePoint>& curve)
{
  const auto top = std::ranges::max_element(curve, {}, &CurvePoint::amplitude);
  if (top == curve.begin() || top + 1 == curve.end()) return *top;
  /** Newton's form of the parabola, for neighbours at any distance. */
  const CurvePoint &a = *(top - 1), &b = *top, &c = *(top + 1);
  const double left = (b.amplitude - a.amplitude) / (b.frequency - a.frequency);
  const double right = (c.amplitude - b.amplitude) / (c.frequency - b.frequency);
  const double bend = (right - left) / (c.frequency - a.frequency);
  if (!(bend < 0)) return b;
  const double slope = left + bend * (b.frequency - a.frequency);  // at b
  const double shift = -slope / (2 * bend);
  return {b.frequency + shift, b.amplitude + shift * (slope + bend * shift)};
}

}  // namespace rotor_stator
