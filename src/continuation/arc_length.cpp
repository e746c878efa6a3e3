#include "continuation/arc_length.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "model/errors.hpp"

namespace rotor_stator
{

namespace
{

/** The balance in scaled unknowns y = (X/ℓ, ω/ω_ref), with one linear constraint. */
class Extended
{
public:
  Extended(Balance& balance, const ArcLengthSettings& settings)
      : balance_(balance),
        settings_(settings),
        n_(balance.unknowns()),
        matrix_(n_ + 1, n_ + 1)
  {
  }

  Eigen::VectorXd scaled(const Eigen::VectorXd& x, double omega) const
  {
    Eigen::VectorXd y(n_ + 1);
    y << x / settings_.arc_unknown_scale, omega / settings_.speed_scale;
    return y;
  }
  double omega(const Eigen::VectorXd& y) const { return y[n_] * settings_.speed_scale; }
  Eigen::VectorXd unknowns(const Eigen::VectorXd& y) const
  {
    return y.head(n_) * settings_.arc_unknown_scale;
  }

  /** Jacobian of the balance bordered by `last_row`, at the last residual. */
  const Eigen::MatrixXd& bordered(const Eigen::VectorXd& last_row)
  {
    matrix_.topLeftCorner(n_, n_) = balance_.jacobian() * settings_.arc_unknown_scale;
    matrix_.topRightCorner(n_, 1) = balance_.speed_derivative() * settings_.speed_scale;
    matrix_.row(n_) = residual_scale() * last_row.transpose();
    return matrix_;
  }

  /** The unit tangent at the last residual, on the side of `previous`, and the sign of the
      bordered Jacobian's determinant: along a branch that is followed in one direction the sign
      stays the same, through folds too. */
  struct Tangent {
    Eigen::VectorXd direction;
    bool positive;
  };
  Tangent tangent(const Eigen::VectorXd& previous)
  {
    const Eigen::VectorXd right = Eigen::VectorXd::Unit(n_ + 1, n_);
    const Eigen::PartialPivLU<Eigen::MatrixXd> factors(bordered(previous));
    const auto negative = (factors.matrixLU().diagonal().array() < 0).count();
    const bool even_permutation = factors.permutationP().determinant() > 0;
    return {factors.solve(right).normalized(), (negative % 2 == 0) == even_permutation};
  }

  /** Newton on the balance and t·(y - predicted) = 0, from `predicted`. */
  NewtonReport correct(const Eigen::VectorXd& tangent, const Eigen::VectorXd& predicted,
                       Eigen::VectorXd& y)
  {
    y = predicted;
    const Equations equations{
        .residual_scale = residual_scale(),
        .unknown_scale = balance_.problem().unknown_scale / settings_.arc_unknown_scale,
        .residual =
            [&](const Eigen::VectorXd& at, Eigen::VectorXd& residual) {
              residual.resize(n_ + 1);
              residual << balance_.residual(unknowns(at), omega(at)),
                  residual_scale() * tangent.dot(at - predicted);
            },
        .jacobian = [&]() -> const Eigen::MatrixXd& { return bordered(tangent); }};
    return newton(equations, y, settings_.newton);
  }

private:
  double residual_scale() const { return balance_.problem().residual_scale; }

  Balance& balance_;
  const ArcLengthSettings& settings_;
  Eigen::Index n_;
  Eigen::MatrixXd matrix_;
};

/** Speed of the fold between two points with speed directions of opposite sign: the
   extremum of the cubic that takes both speeds and both slopes. */
double fold_speed(const BranchPoint& a, const BranchPoint& b, double speed_scale)
{
  const double h = b.arc - a.arc, rise = b.omega - a.omega;
  const double d_a = a.speed_direction * speed_scale * h;
  const double d_b = b.speed_direction * speed_scale * h;
  /** ω = ω_a + d_a r + c r² + e r³ for 0 ≤ r ≤ 1, and dω/dr = 0. */
  const double c = 3 * rise - 2 * d_a - d_b, e = d_a + d_b - 2 * rise;
  const double root = std::sqrt(std::max(0.0, c * c - 3 * e * d_a));
  const double r = -d_a / (c + std::copysign(root, d_b - d_a));
  return a.omega + r * (d_a + r * (c + r * e));
}

/** The walk along the branch, one accepted point after the other. */
class Walk
{
public:
  Walk(Balance& balance, double from, double to, const ArcLengthSettings& settings,
       const std::function<void(const BranchPoint&)>& visit)
      : balance_(balance),
        settings_(settings),
        visit_(visit),
        from_(from),
        to_(to),
        forward_(to > from ? 1.0 : -1.0),
        extended_(balance, settings),
        step_(settings.first_step)
  {
  }

  Branch run(Eigen::VectorXd x)
  {
    start(std::move(x));
    while (!done_) advance();
    return std::move(branch_);
  }

private:
  void start(Eigen::VectorXd x)
  {
    const NewtonReport report = solve(balance_, from_, x, settings_.newton);
    if (!report.converged())
      throw NoSolution(
          text("no start at omega = %g rad/s: %s", from_, report.reason().c_str()));
    y_ = extended_.scaled(x, from_);
    const auto last = y_.size() - 1;
    tangent_ = extended_.tangent(forward_ * Eigen::VectorXd::Unit(last + 1, last));
    accept({from_, 0, tangent_.direction[last], report, std::move(x)});
  }

  void accept(BranchPoint point)
  {
    if (!branch_.points.empty()) {
      const BranchPoint& previous = branch_.points.back();
      if (previous.speed_direction * point.speed_direction < 0)
        branch_.folds.push_back(fold_speed(previous, point, settings_.speed_scale));
    }
    if (visit_) visit_(point);
    branch_.points.push_back(std::move(point));
  }

  void stop(bool covered, const std::string& why)
  {
    branch_.covered = covered;
    branch_.end = why;
    done_ = true;
  }

  std::string place() const
  {
    return text(" at omega = %.6g rad/s", extended_.omega(y_));
  }

  /** One step: predict, correct, and keep it unless it failed or turned too far. */
  void advance()
  {
    if (static_cast<int>(branch_.points.size()) >= settings_.most_points)
      return stop(false, text("%d points", settings_.most_points) + place());
    if (step_ < settings_.least_step)
      return stop(false, text("the step fell below %g", settings_.least_step) + place());
    Eigen::VectorXd y;
    const NewtonReport report =
        extended_.correct(tangent_.direction, y_ + step_ * tangent_.direction, y);
    if (!report.converged()) return shorten();
    const auto tangent = extended_.tangent(tangent_.direction);
    if (tangent.direction.dot(tangent_.direction) < std::cos(settings_.most_turn))
      return shorten();
    /** Another sign is another leg of a hairpin, followed the wrong way; at the shortest steps it
        is a branch point, and is passed. */
    if (tangent.positive != tangent_.positive && step_ > 100 * settings_.least_step)
      return shorten();

    const double omega = extended_.omega(y);
    if (forward_ * (omega - to_) >= 0) return finish(y);
    if (forward_ * (omega - from_) < 0)
      return stop(false, "the branch came back" + place());
    const double arc = branch_.points.back().arc + (y - y_).norm();
    y_ = y;
    tangent_ = tangent;
    accept({omega, arc, tangent.direction[y.size() - 1], report, extended_.unknowns(y)});
    const double wish = std::sqrt(static_cast<double>(settings_.wanted_iterations) /
                                  std::max(1, report.iterations));
    step_ = std::min(settings_.most_step, step_ * std::clamp(wish, 0.5, 1.5));
  }

  void shorten() { step_ /= 2; }

  /** The last point, at ω = `to`, between the last accepted point and `beyond`. */
  void finish(const Eigen::VectorXd& beyond)
  {
    const double r =
        (to_ - extended_.omega(y_)) / (extended_.omega(beyond) - extended_.omega(y_));
    Eigen::VectorXd x = extended_.unknowns(y_ + r * (beyond - y_));
    const NewtonReport report = solve(balance_, to_, x, settings_.newton);
    if (!report.converged()) return shorten();
    const Eigen::VectorXd y = extended_.scaled(x, to_);
    const double arc = branch_.points.back().arc + (y - y_).norm();
    accept({to_, arc, extended_.tangent(tangent_.direction).direction[y.size() - 1],
            report, std::move(x)});
    stop(true, "the end of the range");
  }

  Balance& balance_;
  const ArcLengthSettings& settings_;
  const std::function<void(const BranchPoint&)>& visit_;
  double from_, to_, forward_;
  Extended extended_;
  double step_;
  Eigen::VectorXd y_;
  Extended::Tangent tangent_;
  Branch branch_{};
  bool done_ = false;
};

}  // namespace

Branch follow_branch(Balance& balance, double from, double to, Eigen::VectorXd x,
                     const ArcLengthSettings& settings,
                     const std::function<void(const BranchPoint&)>& visit)
{
  return Walk(balance, from, to, settings, visit).run(std::move(x));
}

}  // namespace rotor_stator
