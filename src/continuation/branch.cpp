#include "continuation/branch.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "io/errors.hpp"

namespace rotor_stator {

double angle(const Eigen::VectorXd& a, const Eigen::VectorXd& b)
{
  return 2 * std::asin(std::min(1.0, 0.5 * (a - b).norm()));
}

Eigen::VectorXd between(const Curve& curve, const BranchPoint& a, const BranchPoint& b,
                        double r)
{
  const Eigen::VectorXd start = curve.scaled(a.motion);
  const Eigen::VectorXd chord = curve.scaled(b.motion) - start;
  const double h = chord.norm();
  const Eigen::VectorXd rise_a = h * a.tangent - chord, rise_b = chord - h * b.tangent;
  return start + r * chord + r * (1 - r) * ((1 - r) * rise_a + r * rise_b);
}

BranchPoint reversed(BranchPoint point)
{
  point.tangent = -point.tangent;
  return point;
}

/** Second over first Newton correction [-]: above it the corrector fails. */
static constexpr double most_contraction = 0.5;

Corrector::Corrector(Curve& curve)
    : curve_(curve), n_(curve.unknowns()), matrix_(n_ + 1, n_ + 1)
{
}

double Corrector::last_correction() const
{
  return std::sqrt(curve_.settings().newton.tolerance) * curve_.unknown_size();
}

void Corrector::factor(const Eigen::VectorXd& y, const Eigen::VectorXd& last_row)
{
  matrix_ << curve_.slope(y), curve_.residual_scale() * last_row.transpose();
  factors_.compute(matrix_);
  last_row_ = last_row;
}

Correction Corrector::correct(const Eigen::VectorXd& direction,
                              const Eigen::VectorXd& predicted)
{
  constexpr int most_corrections = 20;  // contracting by a half each time, fewer
  constexpr double most_left = 0.1;
  Correction correction{.y = predicted};
  Eigen::VectorXd& y = correction.y;
  NewtonReport report;
  const double tolerance = curve_.settings().newton.tolerance;
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
      needs_factors = !(step.norm() <= most_contraction * last);
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
    report.end = !std::isfinite(length) ? NewtonEnd::not_finite
                 : !std::isfinite(report.delta_1) || ratio > most_contraction
                     ? NewtonEnd::no_decrease
                 : report.delta_1 <= tolerance && length <= last_correction()
                     ? NewtonEnd::converged
                     : NewtonEnd::too_many_iterations;
    last = length;
  } while (report.end == NewtonEnd::too_many_iterations &&
           report.iterations < most_corrections);
  correction.motion = curve_.motion_at(y);
  correction.motion.newton = report;
  return correction;
}

/** The tangent at y, from a guess, by factors of another point. False where that is too
    far away. */
bool Corrector::refine(const Eigen::VectorXd& y, Eigen::VectorXd& tangent)
{
  constexpr int most = 4;
  constexpr double most_left = 0.1, error = 1e-6;
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
  const Eigen::VectorXd right = Eigen::VectorXd::Unit(n_ + 1, n_);
  Eigen::VectorXd direction;
  const bool has_row = last_row_.size() == previous.size() && last_row_ == previous;
  if (has_row) direction = factors_.solve(right);
  if (!has_row || !refine(y, direction)) {
    factor(y, previous);
    direction = factors_.solve(right);
  }
  const auto negative = (factors_.matrixLU().diagonal().array() < 0).count();
  const bool even_permutation = factors_.permutationP().determinant() > 0;
  return {direction.normalized(), (negative % 2 == 0) == even_permutation};
}

BranchPoint point_of(Curve& curve, double omega, const Eigen::VectorXd& x, bool upwards)
{
  BranchPoint point{curve.solved(omega, x)};
  if (!point.motion.found())
    throw NoSolution(format("no start at omega = %g rad/s: %s", omega,
                            point.motion.newton.reason().c_str()));
  const auto n = point.motion.x.size();
  point.tangent = Corrector(curve)
                      .tangent(curve.scaled(point.motion),
                               (upwards ? 1 : -1) * Eigen::VectorXd::Unit(n + 1, n))
                      .direction;
  return point;
}

/**
## Where a quantity vanishes along a branch */

namespace {

/** An end of the bracket: a point and the quantity there, the latter as the Illinois
    method weighs it. */
struct End {
  BranchPoint point;
  double value, weighed;
};

/** The point of the branch beside that at 0 < r < 1 of the chord from `a` to `b`. */
BranchPoint corrected(Corrector& corrector, const BranchPoint& a, const BranchPoint& b,
                      double r)
{
  const Curve& curve = corrector.curve();
  const Eigen::VectorXd start = curve.scaled(a.motion);
  const Eigen::VectorXd chord = curve.scaled(b.motion) - start;
  Correction correction = corrector.correct(chord.normalized(), between(curve, a, b, r));
  PeriodicMotion& motion = correction.motion;
  if (!motion.found())
    throw NoSolution(format("no point between omega = %.9g and %.9g rad/s: %s",
                            a.motion.omega, b.motion.omega,
                            motion.newton.reason().c_str()));
  const double share = (correction.y - start).dot(chord) / chord.squaredNorm();
  Tangent tangent = corrector.tangent(correction.y, chord.normalized());
  return {std::move(motion), a.arc + share * (b.arc - a.arc),
          std::move(tangent.direction)};
}

/** By the cubic of the speed: both its extrema are inside the step. */
bool cubic_turns(const BranchPoint& a, const BranchPoint& b, double speed_scale)
{
  const double h = b.arc - a.arc, rise = b.motion.omega - a.motion.omega;
  const double d_a = a.speed_direction() * speed_scale * h;
  const double d_b = b.speed_direction() * speed_scale * h;
  if (d_a * d_b <= 0) return false;
  /** dω/dr = d_a + 2cr + 3er² has its extremum at r = -c/3e. */
  const double c = 3 * rise - 2 * d_a - d_b, e = d_a + d_b - 2 * rise;
  const double r = -c / (3 * e);
  return r > 0 && r < 1 && (d_a + c * r) * d_a < 0;
}

}  // namespace

BranchPoint locate(Curve& curve, const BranchPoint& a, const BranchPoint& b,
                   const TestFunction& test, double tolerance)
{
  const auto valued = [&test](BranchPoint point) {
    const double value = test(point);
    if (!std::isfinite(value))
      throw NoSolution(
          format("the quantity to locate is not a number at omega = %.6g rad/s",
                 point.motion.omega));
    return End{std::move(point), value, value};
  };
  End first = valued(a), last = valued(b);
  if (first.value * last.value > 0)
    throw NoSolution(format("no change of sign between omega = %.9g and %.9g rad/s",
                            a.motion.omega, b.motion.omega));
  Corrector corrector(curve);
  const double least_width = 1e-14 * std::max(1.0, std::abs(b.arc));
  const auto width = [&] { return last.point.arc - first.point.arc; };
  /** Bound on the difference of speed between any two points of the bracket [rad/s]. */
  const auto speed_width = [&] {
    return width() * curve.settings().speed_scale *
           std::max(std::abs(first.point.speed_direction()),
                    std::abs(last.point.speed_direction()));
  };
  double before = width();
  std::optional<bool> moved_first;  // which end the last cut moved
  for (int cuts = 1; first.value != 0 && last.value != 0 && width() > least_width &&
                     speed_width() > tolerance * std::abs(a.motion.omega);
       ++cuts) {
    const bool is_slow = cuts % 3 == 0 && width() > 0.5 * before;
    if (cuts % 3 == 0) before = width();
    const double secant = first.weighed / (first.weighed - last.weighed);
    const double r = is_slow ? 0.5 : std::clamp(secant, 1e-3, 1 - 1e-3);
    End end = valued(corrected(corrector, first.point, last.point, r));
    const bool moves_first = end.value * first.value > 0;
    End &moved = moves_first ? first : last, &stays = moves_first ? last : first;
    if (moved_first == moves_first) stays.weighed /= 2;
    moved_first = moves_first;
    moved = std::move(end);
  }
  return std::abs(first.value) <= std::abs(last.value) ? first.point : last.point;
}

BranchPoint point_between(Curve& curve, const BranchPoint& a, const BranchPoint& b,
                          double omega)
{
  constexpr double tolerance = 1e-10;
  BranchPoint point = locate(
      curve, a, b, [omega](const BranchPoint& p) { return p.motion.omega - omega; },
      tolerance);
  /** To the last digit of the speed, unless it is a fold's. */
  PeriodicMotion exact = curve.solved(omega, point.motion.x);
  if (exact.found()) {
    exact.newton = point.motion.newton;
    point.motion = std::move(exact);
  }
  return point;
}

bool turns_between(Corrector& corrector, const BranchPoint& a, const BranchPoint& b)
{
  const Curve& curve = corrector.curve();
  const double speed_scale = curve.settings().speed_scale;
  if (cubic_turns(a, b, speed_scale)) return true;
  const double steep =
      std::min(std::abs(a.speed_direction()), std::abs(b.speed_direction()));
  if (steep > angle(a.tangent, b.tangent)) return false;
  const Eigen::VectorXd direction = (a.tangent + b.tangent).normalized();
  Correction correction = corrector.correct(direction, between(curve, a, b, 0.5));
  if (!correction.motion.found()) return true;
  const BranchPoint middle{std::move(correction.motion), 0.5 * (a.arc + b.arc),
                           corrector.tangent(correction.y, direction).direction};
  return middle.speed_direction() * (a.speed_direction() + b.speed_direction()) < 0 ||
         cubic_turns(a, middle, speed_scale) || cubic_turns(middle, b, speed_scale);
}

}  // namespace rotor_stator
