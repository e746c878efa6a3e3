#include "deviations/printed_equations.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

namespace rotor_stator::deviations {

static constexpr int dofs = 4;  ///< x_s, y_s, x_r, y_r

/** Row i and column j are counted from 1 as in Eq. 13. For the corrected argument 2m+1 is
    the number of samples. */
Eigen::MatrixXd gamma_matrix(int harmonics, int samples, Form form)
{
  Eigen::MatrixXd gamma(2 * harmonics + 1, samples);
  for (int j = 1; j <= samples; ++j) {
    gamma(0, j - 1) = 1.0 / samples;
    for (int i = 2; i <= 2 * harmonics + 1; ++i) {
      const double turns = (j - 1) * (i - i % 2) * std::numbers::pi;
      const double angle =
          form == Form::printed ? turns / (2 * harmonics) + 1 : turns / samples;
      gamma(i - 1, j - 1) =
          2.0 / samples * (i % 2 == 0 ? std::cos(angle) : std::sin(angle));
    }
  }
  return gamma;
}

Eigen::MatrixXd gamma_inverse(int harmonics, int samples)
{
  Eigen::MatrixXd inverse = 0.5 * samples * gamma_matrix(harmonics, samples).transpose();
  inverse.col(0).setOnes();
  return inverse;
}

PlainBalance::PlainBalance(const Parameters& parameters, double omega, int harmonics,
                           int samples, Form block)
    : bearing_(parameters.bearing), gamma_(gamma_matrix(harmonics, samples)),
      inverse_(gamma_inverse(harmonics, samples))
{
  for (int k = 0; k < samples; ++k)
    cage_.push_back(Direction::of(parameters.bearing.cage_speed_ratio * 2 *
                                  std::numbers::pi * k / samples));
  const Body &s = parameters.stator, &r = parameters.rotor;
  const auto diagonal = [](double stator, double rotor) {
    return Eigen::Vector4d(stator, stator, rotor, rotor).asDiagonal().toDenseMatrix();
  };
  const Eigen::Matrix4d mass = diagonal(s.mass, r.mass);
  const Eigen::Matrix4d damping = diagonal(s.damping(), r.damping());
  const Eigen::Matrix4d stiffness = diagonal(s.stiffness(), r.stiffness());
  const int size = dofs * (2 * harmonics + 1);
  linear_ = Eigen::MatrixXd::Zero(size, size);
  linear_.topLeftCorner<dofs, dofs>() = stiffness;
  for (int j = 1; j <= harmonics; ++j) {
    const int cosine = (2 * j - 1) * dofs, sine = cosine + dofs;
    const double frequency = j * omega;
    const double printed = block == Form::printed ? omega : frequency;
    linear_.block<dofs, dofs>(cosine, cosine) = stiffness - printed * printed * mass;
    linear_.block<dofs, dofs>(cosine, sine) = frequency * damping;
    linear_.block<dofs, dofs>(sine, cosine) = -frequency * damping;
    linear_.block<dofs, dofs>(sine, sine) = stiffness - frequency * frequency * mass;
  }
  const double unbalance = parameters.unbalance * omega * omega;
  load_ = Eigen::VectorXd::Zero(size);
  load_[1] = -parameters.stator.mass * parameters.gravity;
  load_[3] = -parameters.rotor.mass * parameters.gravity;
  load_[dofs + 2] = unbalance;      // x_r, cosine
  load_[2 * dofs + 3] = unbalance;  // y_r, sine
}

PlainBalance::Linearised PlainBalance::at(const Eigen::VectorXd& x) const
{
  Eigen::Matrix<double, 2, dofs> joint;  // u = x_r - x_s; its force acts on both bodies
  joint << -1, 0, 1, 0, 0, -1, 0, 1;
  const Eigen::MatrixXd samples = x.reshaped(dofs, gamma_.rows()) * inverse_.transpose();
  Eigen::MatrixXd force(dofs, gamma_.cols()), jacobian = linear_;
  for (Eigen::Index k = 0; k < gamma_.cols(); ++k) {
    const Eigen::Vector2d u = joint * samples.col(k);
    const auto [f, s] = bearing_.reaction(cage_[k], {u.x(), u.y()});
    force.col(k) = joint.transpose() * Eigen::Vector2d(f.x, f.y);
    const Eigen::Matrix2d stiffness{{s.xx, s.xy}, {s.xy, s.yy}};
    const Eigen::Matrix4d slope = joint.transpose() * stiffness * joint;
    for (Eigen::Index p = 0; p < gamma_.rows(); ++p)
      for (Eigen::Index q = 0; q < gamma_.rows(); ++q)
        jacobian.block<dofs, dofs>(dofs * p, dofs * q) +=
            gamma_(p, k) * inverse_(k, q) * slope;
  }
  const Eigen::MatrixXd force_series = force * gamma_.transpose();
  return {linear_ * x + force_series.reshaped() - load_, jacobian};
}

Eigen::VectorXd PlainBalance::step(const Eigen::VectorXd& x, Form form) const
{
  auto [right, jacobian] = at(x);
  if (form == Form::printed) right = right - linear_ * x + jacobian * x;
  return -jacobian.partialPivLu().solve(right);
}

StaticContact static_contact(const Parameters& parameters)
{
  const Vec2 u = parameters.bodies->at_rest(parameters, {1, 0}).position.relative();
  const auto [force, slope] = BallBearing(parameters.bearing).reaction({1, 0}, u);
  return {u.y, force.y, slope.yy};
}

}  // namespace rotor_stator::deviations
