#include "continuation/locate.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "continuation/branch.hpp"
#include "io/errors.hpp"

namespace rotor_stator {

namespace {

/** An end of the bracket: a point and the quantity there, the latter as the Illinois
    method weighs it. */
struct End {
  BranchPoint point;
  double value, weighed;
};

/** The bracket with the zero, and its narrowing. */
struct Bracket {
  const TestFunction& test;
  const ArcLengthSettings& settings;
  Corrector corrector;
  const BranchPoint &from, &to;
  End a = valued(from), b = valued(to);
  std::optional<bool> moved_first = {};  ///< which end the last cut moved

  bool has_zero() const { return a.value * b.value <= 0; }
  double width() const { return b.point.arc - a.point.arc; }

  /** Bound on the difference of speed between any two points of the bracket [rad/s]. */
  double speed_width() const
  {
    return width() * settings.speed_scale *
           std::max(std::abs(a.point.speed_direction()),
                    std::abs(b.point.speed_direction()));
  }

  const BranchPoint& best() const
  {
    return std::abs(a.value) <= std::abs(b.value) ? a.point : b.point;
  }
  bool exact() const { return a.value == 0 || b.value == 0; }

  double secant() const { return a.weighed / (a.weighed - b.weighed); }

  /** Replaces one end by the point at 0 < r < 1. */
  void cut(double r)
  {
    End end = valued(corrected(r));
    const bool first = end.value * a.value > 0;
    End &moved = first ? a : b, &stays = first ? b : a;
    if (moved_first == first) stays.weighed /= 2;
    moved_first = first;
    moved = std::move(end);
  }

  End valued(const BranchPoint& point)
  {
    const double value = test(point);
    if (!std::isfinite(value))
      throw NoSolution(
          format("the quantity to locate is not a number at omega = %.6g rad/s",
                 point.motion.omega));
    return {point, value, value};
  }

  BranchPoint corrected(double r)
  {
    const Eigen::VectorXd start = scaled(a.point, settings);
    const Eigen::VectorXd chord = scaled(b.point, settings) - start;
    Correction correction =
        corrector.correct(chord.normalized(), between(a.point, b.point, r, settings));
    PeriodicMotion& motion = correction.motion;
    if (!motion.found())
      throw NoSolution(format("no point between omega = %.9g and %.9g rad/s: %s",
                              a.point.motion.omega, b.point.motion.omega,
                              motion.newton.reason().c_str()));
    const double share = (correction.y - start).dot(chord) / chord.squaredNorm();
    Tangent tangent = corrector.tangent(correction.y, chord.normalized());
    return {std::move(motion), a.point.arc + share * width(),
            std::move(tangent.direction)};
  }
};

}  // namespace

BranchPoint locate(Curve& curve, const BranchPoint& a, const BranchPoint& b,
                   const TestFunction& test, double tolerance,
                   const ArcLengthSettings& settings)
{
  Bracket bracket{test, settings, {curve, settings}, a, b};
  if (!bracket.has_zero())
    throw NoSolution(format("no change of sign between omega = %.9g and %.9g rad/s",
                            a.motion.omega, b.motion.omega));
  const double least_width = 1e-14 * std::max(1.0, std::abs(b.arc));
  double before = bracket.width();
  for (int cuts = 1; !bracket.exact() && bracket.width() > least_width &&
                     bracket.speed_width() > tolerance * std::abs(a.motion.omega);
       ++cuts) {
    const bool slow = cuts % 3 == 0 && bracket.width() > 0.5 * before;
    if (cuts % 3 == 0) before = bracket.width();
    bracket.cut(slow ? 0.5 : std::clamp(bracket.secant(), 1e-3, 1 - 1e-3));
  }
  return bracket.best();
}

BranchPoint point_between(Curve& curve, const BranchPoint& a, const BranchPoint& b,
                          double omega, const ArcLengthSettings& settings)
{
  constexpr double tolerance = 1e-10;
  BranchPoint point = locate(
      curve, a, b, [omega](const BranchPoint& p) { return p.motion.omega - omega; },
      tolerance, settings);
  /** To the last digit of the speed, unless it is a fold's. */
  PeriodicMotion exact = curve.solved(omega, point.motion.x);
  if (exact.found()) {
    exact.newton = point.motion.newton;
    point.motion = std::move(exact);
  }
  return point;
}

namespace {

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

bool turns_between(Corrector& corrector, const BranchPoint& a, const BranchPoint& b,
                   const ArcLengthSettings& settings)
{
  if (cubic_turns(a, b, settings.speed_scale)) return true;
  const double steep =
      std::min(std::abs(a.speed_direction()), std::abs(b.speed_direction()));
  if (steep > angle(a.tangent, b.tangent)) return false;
  const Eigen::VectorXd direction = (a.tangent + b.tangent).normalized();
  Correction correction = corrector.correct(direction, between(a, b, 0.5, settings));
  if (!correction.motion.found()) return true;
  const BranchPoint middle{std::move(correction.motion), 0.5 * (a.arc + b.arc),
                           corrector.tangent(correction.y, direction).direction};
  return middle.speed_direction() * (a.speed_direction() + b.speed_direction()) < 0 ||
         cubic_turns(a, middle, settings.speed_scale) ||
         cubic_turns(middle, b, settings.speed_scale);
}

}  // namespace rotor_stator
