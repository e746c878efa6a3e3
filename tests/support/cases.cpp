#include "support/cases.hpp"

namespace rotor_stator::tests {

Problem Oscillator::problem(int samples) const
{
  const auto all_samples = [law = law](const Eigen::MatrixXd& q, Eigen::MatrixXd& force,
                                       Eigen::MatrixXd* slopes) {
    force.resize(q.rows(), q.cols());
    if (slopes) slopes->resize(q.rows(), q.cols() * q.cols());
    for (Eigen::Index k = 0; k < q.rows(); ++k) {
      const LocalForce local = law(q.row(k));
      force.row(k) = local.force;
      if (slopes) slopes->row(k) = local.stiffness.reshaped();
    }
  };
  return {.dofs = static_cast<int>(mass.rows()),
          .samples = samples,
          .residual_scale = 1,
          .unknown_scale = 1,
          .linear =
              [o = *this](double omega, Harmonic h, LinearBlock& block) {
                block = second_order_block(o.mass, o.damping, o.stiffness, o.load, omega,
                                           h.k_1);
              },
          .force = all_samples};
}

Oscillator duffing()
{
  const auto one = [](double value) { return Eigen::MatrixXd::Constant(1, 1, value); };
  return {one(1), one(0.05), one(1), one(0.18), [](const Eigen::VectorXd& q) {
            return LocalForce{0.1 * q.array().cube(), 0.3 * q.array().square()};
          }};
}

Oscillator two_masses_cubic()
{
  Eigen::Matrix2d mass, damping, stiffness;
  mass << 1, 0, 0, 0.05;
  stiffness << 1 + 0.0453, -0.0453, -0.0453, 0.0453;
  damping << 0.002 + 0.013, -0.013, -0.013, 0.013;
  return {mass, damping, stiffness, Eigen::Vector2d(0.11, 0),
          [](const Eigen::VectorXd& q) {
            const double d = q[0] - q[1], f = 0.0042 * d * d * d, k = 3 * 0.0042 * d * d;
            Eigen::Matrix2d slope;
            slope << 3 * q[0] * q[0] + k, -k, -k, k;
            return LocalForce{Eigen::Vector2d(q[0] * q[0] * q[0] + f, -f), slope};
          }};
}

void check_same(const std::vector<double>& found, const std::vector<double>& known,
                double tolerance)
{
  REQUIRE(found.size() == known.size());
  for (std::size_t k = 0; k < found.size(); ++k)
    CHECK(found[k] == Approx(known[k]).epsilon(tolerance));
}

Parameters set_1()
{
  return read_parameters(SOURCE_DIR "/data/set1.toml");
}

double hertz(double frequency)
{
  return 2 * std::numbers::pi * frequency;
}

}  // namespace rotor_stator::tests
