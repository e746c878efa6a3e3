#include "explore/modes.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "io/errors.hpp"
#include "model/parallel.hpp"
#include "time/eigenvalues.hpp"

namespace rotor_stator::explore {

namespace {

constexpr double rigid = 1e-13;     ///< ratio of squares of frequencies
constexpr Eigen::Index most = 120;  ///< modes that C + ωG couples

/** R of A = R Rᵀ; empty where A is not positive. */
Eigen::MatrixXd cholesky(const Eigen::MatrixXd& a)
{
  constexpr double rounding = 1e-13;
  const Eigen::LLT<Eigen::MatrixXd> factors(a);
  const Eigen::MatrixXd r = factors.matrixL();
  const bool is_positive =
      factors.info() == Eigen::Success &&
      (r.diagonal().array().square() > rounding * a.diagonal().array()).all();
  return is_positive ? r : Eigen::MatrixXd();
}

}  // namespace

bool leaves_damping_out(const Parameters& parameters)
{
  return std::ranges::any_of(bearings_of(parameters),
                             [](const Bearing& one) { return one.damping > 0; });
}

LinearMachine::LinearMachine(const Parameters& parameters, const OperationBudget& budget,
                             double speed)
    : parameters_(parameters), speed_(speed), first_(parameters.stator.rigid ? 2 : 0),
      machine_(matrices_of(parameters)), budget_(budget),
      evaluation_(operations_per_evaluation(parameters.bearing.balls)),
      contact_(mean_contact_stiffness(parameters, machine_, angular(speed)))
{
  const auto n = machine_.mass.rows() - first_;
  const auto rows = static_cast<double>(n);
  budget_.spend((1e6 + 10 * rows * rows * rows) / evaluation_);
  const Eigen::MatrixXd& d = machine_.joints;
  const Eigen::MatrixXd even = (contact_ + contact_.transpose()) / 2;
  k_ = (machine_.stiffness + d * even * d.transpose()).bottomRightCorner(n, n);
  skew_ = (d * (contact_ - even) * d.transpose()).bottomRightCorner(n, n);
  for (Eigen::Index at = 0; const Bearing& joint : joints_of(parameters)) {
    const Slopes2 c =
        Parallel(joint.parallel, angular(speed)).reaction({0, 0}, {0, 0}).damping;
    const auto own = d.middleCols<2>(at);
    machine_.damping += own * c.matrix() * own.transpose();
    at += 2;
  }
  mass_ = machine_.mass.bottomRightCorner(n, n);
  factor_ = cholesky(k_);
  double shift = 0;  // σ [1/s²]
  if (factor_.size() == 0) factor_ = cholesky(k_ + (shift = 1) * mass_);
  if (factor_.size() == 0) throw NoSolution("the stiffness at rest is not positive");
  const auto r = factor_.triangularView<Eigen::Lower>();
  const Eigen::MatrixXd half = r.solve(mass_);
  const Eigen::MatrixXd whole = r.solve(half.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> found((whole + whole.transpose()) /
                                                             2);
  const Eigen::VectorXd& values = found.eigenvalues();  // 1/(ω² + σ), ascending
  const auto kept = std::min(most, (values.array() > rigid * values[n - 1]).count());
  if (kept == 0 || !values.allFinite())
    throw NoSolution("the frequencies at rest are beyond what a double holds");
  const Eigen::ArrayXd inertia = values.tail(kept).reverse();
  shapes_ = factor_.transpose().triangularView<Eigen::Upper>().solve(
      found.eigenvectors().rightCols(kept).rowwise().reverse());
  shapes_ *= inertia.rsqrt().matrix().asDiagonal();
  /** What drifts is free within the rounding of K. */
  const Eigen::ArrayXd square = inertia.inverse() - shift;
  omega_ = (square > 1e-3 * shift).select(square.max(0).sqrt(), 0);
}

std::vector<Mode> LinearMachine::modes(double speed, std::size_t most) const
{
  const auto is_by_speed = [](const Bearing& joint) {
    return joint.parallel.linear.size() > 1;
  };
  if (speed != speed_ && std::ranges::any_of(joints_of(parameters_), is_by_speed))
    return LinearMachine(parameters_, budget_, speed).modes(speed, most);
  const auto rows = static_cast<double>(mass_.rows()),
             kept = static_cast<double>(omega_.size());
  budget_.spend((1e4 + 2 * rows * rows * kept + 200 * kept * kept * kept) / evaluation_);
  const Eigen::MatrixXd c =
      machine_.damping.bottomRightCorner(mass_.rows(), mass_.rows()) +
      angular(speed) * machine_.gyroscopic.bottomRightCorner(mass_.rows(), mass_.rows());
  const auto n = omega_.size();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  a.topRightCorner(n, n) = omega_.asDiagonal();
  a.bottomLeftCorner(n, n) = -a.topRightCorner(n, n);
  if (!skew_.isZero(0))
    a.bottomLeftCorner(n, n) -=
        shapes_.transpose() * skew_ * shapes_ *
        (omega_.array() > 0).select(omega_.array().inverse(), 0.0).matrix().asDiagonal();
  a.bottomRightCorner(n, n) = -shapes_.transpose() * c * shapes_;
  const Eigensystem found = eigensystem(a, true);
  constexpr double most_damped = 0.95;
  std::vector<Eigen::Index> order;
  for (Eigen::Index k = 0; k < 2 * n; ++k)
    if (const auto at = found.values[k]; at.imag() > 1e-6 &&
                                         at.imag() < machine_.reduced_to &&
                                         std::abs(at.real()) < most_damped * std::abs(at))
      order.push_back(k);
  std::ranges::sort(order, {}, [&](auto k) { return found.values[k].imag(); });
  order.resize(std::min(order.size(), most));
  std::vector<Mode> list;
  for (const auto k : order) {
    const auto lambda = found.values[k];
    const Eigen::VectorXcd q = shapes_ * found.vectors.col(k).tail(n);
    const Eigen::VectorXcd rest =
        (k_ + skew_) * q + lambda * (c * q) + lambda * lambda * (mass_ * q);
    const auto r = factor_.triangularView<Eigen::Lower>();
    const double residual = r.solve(rest).norm() / (factor_.transpose() * q).norm();
    /** The areas of the ellipses of all places that are shown. */
    double x = 0, y = 0, forward = 0, backward = 0;
    for (int i = 0; i + 1 < machine_.shown - first_; i += 2) {
      x += std::norm(q[i]);
      y += std::norm(q[i + 1]);
      const double area = 2 * (q[i] * std::conj(q[i + 1])).imag();
      (area > 0 ? forward : backward) += std::abs(area);
    }
    constexpr double line = 0.02;  // by the ratio of the axes
    constexpr double few = 0.1;    // that turn the other way
    const auto [less, more] = std::minmax(forward, backward);
    constexpr double rounding = 1e-12;
    const double damping = -lambda.real() / std::abs(lambda);
    list.push_back({lambda.imag() / angular(1),
                    std::abs(damping) > rounding ? damping : 0,
                    more <= line * (x + y) ? Whirl::planar
                    : less > few * more    ? Whirl::mixed
                    : forward > backward   ? Whirl::forward
                                           : Whirl::backward,
                    x > y ? 'x' : 'y', residual});
  }
  return list;
}

std::string doubt(const Mode& mode)
{
  constexpr double well_solved = 2e-6;
  if (mode.residual > well_solved)
    return format(
        "the modes solve their equations to %.1e only: stiffnesses or dampers differ too "
        "much, or C and G couple more than %td modes",
        mode.residual, most);
  if (mode.damping < 0)
    return format("the mode of %.5g Hz grows: its damping ratio is %.3g", mode.frequency,
                  mode.damping);
  return "";
}

}  // namespace rotor_stator::explore
