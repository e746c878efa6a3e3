#include "continuation/branch.hpp"

#include <algorithm>
#include <cmath>

#include "io/errors.hpp"

namespace rotor_stator {

Eigen::VectorXd scaled(const BranchPoint& point, const ArcLengthSettings& settings)
{
  Eigen::VectorXd y(point.motion.x.size() + 1);
  y << point.motion.x / settings.arc_unknown_scale,
      point.motion.omega / settings.speed_scale;
  return y;
}

double angle(const Eigen::VectorXd& a, const Eigen::VectorXd& b)
{
  return 2 * std::asin(std::min(1.0, 0.5 * (a - b).norm()));
}

Eigen::VectorXd between(const BranchPoint& a, const BranchPoint& b, double r,
                        const ArcLengthSettings& settings)
{
  const Eigen::VectorXd start = scaled(a, settings);
  const Eigen::VectorXd chord = scaled(b, settings) - start;
  const double h = chord.norm();
  const Eigen::VectorXd rise_a = h * a.tangent - chord, rise_b = chord - h * b.tangent;
  return start + r * chord + r * (1 - r) * ((1 - r) * rise_a + r * rise_b);
}

BranchPoint reversed(BranchPoint point)
{
  point.tangent = -point.tangent;
  return point;
}

Corrector::Corrector(Curve& curve, const ArcLengthSettings& settings)
    : curve_(curve), settings_(settings), n_(curve.unknowns()), matrix_(n_ + 1, n_ + 1)
{
}

double Corrector::last_correction() const
{
  return std::sqrt(settings_.newton.tolerance) * curve_.unknown_size();
}

void Corrector::factor(const Eigen::VectorXd& y, const Eigen::VectorXd& last_row)
{
  matrix_ << curve_.slope(y), curve_.residual_scale() * last_row.transpose();
  factors_.compute(matrix_);
  last_row_ = last_row;
}

NewtonEnd Corrector::verdict(const Correction& correction, double length,
                             double ratio) const
{
  const double residual = correction.motion.newton.delta_1;
  if (!std::isfinite(length)) return NewtonEnd::not_finite;
  if (!std::isfinite(residual) || ratio > settings_.most_contraction)
    return NewtonEnd::no_decrease;
  return residual <= settings_.newton.tolerance && length <= last_correction()
             ? NewtonEnd::converged
             : NewtonEnd::too_many_iterations;
}

Correction Corrector::correct(const Eigen::VectorXd& direction,
                              const Eigen::VectorXd& predicted)
{
  constexpr int most_corrections = 20;  // contracting by a half each time, fewer
  constexpr double most_left = 0.1;
  Correction correction{.y = predicted};
  Eigen::VectorXd& y = correction.y;
  NewtonReport& report = correction.motion.newton;
  Eigen::VectorXd right(n_ + 1);
  /** The condition is linear: after the first correction it holds to rounding. */
  const auto evaluate = [&](bool with_slope) {
    right << -curve_.residual(y, with_slope), 0;
  };
  double last = 0, ratio = 1;
  std::vector<Eigen::VectorXd> steps;  // with these factors: Broyden's updates
  evaluate(true);
  do {
    Eigen::VectorXd step;
    bool needs_factors = ratio > most_left;
    if (!needs_factors) {
      step = factors_.solve(right);
      for (std::size_t k = 0; k + 1 < steps.size(); ++k)
        step += steps[k].dot(step) / steps[k].squaredNorm() * steps[k + 1];
      step /= 1 - steps.back().dot(step) / steps.back().squaredNorm();
      /** Factors of another point do not tell whether Newton's method fails here. */
      needs_factors = !(step.norm() <= settings_.most_contraction * last);
    }
    if (needs_factors) {
      factor(y, direction);
      steps.clear();
      step = factors_.solve(right);
    }
    steps.push_back(step);
    const double length = step.norm();
    y += step;
    /** The tangent of the last point needs the slope. */
    evaluate(length <= last_correction());
    ++report.iterations;
    report.delta_1 = right.norm() / curve_.residual_scale();
    report.delta_2 = length / curve_.unknown_size();
    /** Below that length corrections are rounding. */
    ratio = last > last_correction() ? length / last : 0;
    correction.contraction = std::max(correction.contraction, ratio);
    report.end = verdict(correction, length, ratio);
    last = length;
  } while (report.end == NewtonEnd::too_many_iterations &&
           report.iterations < most_corrections);
  const NewtonReport ended = report;
  correction.motion = curve_.motion_at(y);
  correction.motion.newton = ended;
  return correction;
}

/** The tangent at y, from a guess, by factors of another point. False where that is too
    far away. */
bool Corrector::refine(const Eigen::VectorXd& y, double error, Eigen::VectorXd& tangent)
{
  constexpr int most = 4;
  constexpr double most_left = 0.1;
  const double scale = curve_.residual_scale();
  double before = 0;
  tangent /= scale * last_row_.dot(tangent);
  Eigen::VectorXd rest(n_ + 1);
  for (int k = 0; k < most; ++k) {
    rest << -curve_.slope_along(y, tangent), 1 - scale * last_row_.dot(tangent);
    const Eigen::VectorXd step = factors_.solve(rest);
    const double size = step.norm() / tangent.norm();
    if (!(size <= (k == 0 ? most_left : most_left * before))) return false;
    tangent += step;
    if (size * size <= error) return true;
    before = size;
  }
  return false;
}

Tangent Corrector::tangent(const Eigen::VectorXd& y, const Eigen::VectorXd& previous)
{
  constexpr double small = 1e-6;
  const Eigen::VectorXd right = Eigen::VectorXd::Unit(n_ + 1, n_);
  Eigen::VectorXd direction;
  const bool has_row = last_row_.size() == previous.size() && last_row_ == previous;
  if (has_row) direction = factors_.solve(right);
  if (!has_row || !refine(y, small, direction)) {
    factor(y, previous);
    direction = factors_.solve(right);
  }
  const auto negative = (factors_.matrixLU().diagonal().array() < 0).count();
  const bool even_permutation = factors_.permutationP().determinant() > 0;
  return {direction.normalized(), (negative % 2 == 0) == even_permutation};
}

BranchPoint point_of(Curve& curve, double omega, const Eigen::VectorXd& x, bool upwards,
                     const ArcLengthSettings& settings)
{
  BranchPoint point{curve.solved(omega, x)};
  if (!point.motion.found())
    throw NoSolution(format("no start at omega = %g rad/s: %s", omega,
                            point.motion.newton.reason().c_str()));
  const auto n = point.motion.x.size();
  point.tangent = Corrector(curve, settings)
                      .tangent(curve.scaled(point.motion),
                               (upwards ? 1 : -1) * Eigen::VectorXd::Unit(n + 1, n))
                      .direction;
  return point;
}

ArcLengthSettings arc_length_settings(const Parameters& parameters,
                                      const NewtonSettings& newton)
{
  const SweepSettings same = sweep_settings(parameters);
  return {newton, same.speed_scale, same.arc_unknown_scale};
}

}  // namespace rotor_stator
