/** The analytic Jacobian against central differences, for the bearing and through the
    seam. */
#include "support/catch.hpp"

#include "balance/bearing_problem.hpp"
#include "support/cases.hpp"

using namespace rotor_stator;
using namespace rotor_stator::tests;

namespace {

/** Largest relative error of a column of ∂R/∂X, and of ∂R/∂ω. */
struct JacobianError {
  double unknowns, speed;
};

JacobianError jacobian_error(Balance& balance, const Eigen::VectorXd& x, double omega,
                             double h)
{
  const Eigen::MatrixXd jacobian = balance.jacobian(x, omega);
  const Eigen::VectorXd slope = balance.speed_derivative(x, omega);
  JacobianError error{0, 0};
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    const Eigen::VectorXd shift = h * Eigen::VectorXd::Unit(x.size(), k);
    const Eigen::VectorXd after = balance.residual(x + shift, omega);
    const Eigen::VectorXd before = balance.residual(x - shift, omega);
    const Eigen::VectorXd column = (after - before) / (2 * h);
    error.unknowns = std::max(error.unknowns,
                              (column - jacobian.col(k)).norm() / jacobian.col(k).norm());
  }
  const double step = 1e-5 * omega;
  const Eigen::VectorXd after = balance.residual(x, omega + step);
  const Eigen::VectorXd before = balance.residual(x, omega - step);
  error.speed = ((after - before) / (2 * step) - slope).norm() / slope.norm();
  return error;
}

}  // namespace

TEST_CASE("AFT Jacobian of the bearing, also at the aliasing N = 2m+1")
{
  const Parameters parameters = set_1();
  const int m = 5;
  for (int samples : {2 * m + 1, 2 * m + 2, 4 * m + 1, 64}) {
    Balance balance(bearing_problem(parameters, samples), m);
    const Eigen::VectorXd x = 0.98 * quasi_static_start(parameters, hertz(16), m);
    const JacobianError error = jacobian_error(balance, x, hertz(16), 1e-10);
    CHECK(error.unknowns < 1e-6);
    CHECK(error.speed < 1e-6);
  }
}

/** Catches an image with the wrong sign: (-3, 1) stands at a negative one. */
TEST_CASE("AFT Jacobian of the bearing on chosen harmonics of two frequencies")
{
  Parameters parameters = set_1();
  parameters.bearing.cage_speed_ratio = 0.43;
  const Harmonics first = orders_up_to(4, parameters.bearing);
  Balance balance(
      bearing_problem(parameters,
                      line_without_images(first, orders_up_to(6, parameters.bearing))),
      first);
  Eigen::VectorXd x = project(0.98 * quasi_static_start(parameters, hertz(16), 3), 2,
                              Harmonics(3), first);
  for (Eigen::Index k = 14; k < x.size(); ++k)
    x[k] += 1e-7 * std::sin(1.0 + static_cast<double>(k));
  const JacobianError error = jacobian_error(balance, x, hertz(16), 1e-10);
  CHECK(error.unknowns < 1e-6);
  CHECK(error.speed < 1e-6);
}

/** Catches a rate of the wrong sign or order, a cage that stands still, and a spall that does not turn. */
TEST_CASE("AFT Jacobian of a bearing with contact damping and a spall")
{
  Parameters parameters = set_1();
  parameters.bearing.damping = 8;
  parameters.bearing.defect = {
      .surface = Defect::Surface::inner_race, .depth = 2e-6, .width = 0.3, .place = 0.4};
  SECTION("one frequency")
  {
    Balance balance(bearing_problem(parameters, 64), 5);
    const Eigen::VectorXd x = 0.98 * quasi_static_start(parameters, hertz(16), 5);
    const JacobianError error = jacobian_error(balance, x, hertz(16), 1e-10);
    CHECK(error.unknowns < 1e-6);
    CHECK(error.speed < 1e-6);
    /** Its products, and the block of one harmonic. */
    const Eigen::MatrixXd jacobian = balance.jacobian(x, hertz(16));
    Eigen::VectorXd product(x.size());
    balance.apply_jacobian(x, hertz(16), x, product);
    CHECK((product - jacobian * x).norm() < 1e-12 * product.norm());
    Eigen::MatrixXd blocks;
    balance.diagonal_blocks(x, hertz(16), 3, blocks);
    const auto block = jacobian.block(10, 10, 4, 4);
    CHECK((blocks.leftCols(4) - block).norm() < 1e-12 * block.norm());
  }
  SECTION("two frequencies")
  {
    parameters.bearing.cage_speed_ratio = 0.43;
    const Harmonics kept = orders_up_to(4, parameters.bearing);
    Balance balance(bearing_problem(parameters, line_without_images(kept, kept)), kept);
    const Eigen::VectorXd x = project(0.98 * quasi_static_start(parameters, hertz(16), 3),
                                      2, Harmonics(3), kept);
    const JacobianError error = jacobian_error(balance, x, hertz(16), 1e-10);
    CHECK(error.unknowns < 1e-6);
    CHECK(error.speed < 1e-6);
  }
}

TEST_CASE("AFT Jacobian of a two-mass oscillator with coupled forces")
{
  const Oscillator oscillator = two_masses_cubic();
  Balance balance(oscillator.problem(48), 5);
  Eigen::VectorXd x(balance.unknowns());
  for (Eigen::Index k = 0; k < x.size(); ++k)
    x[k] = std::sin(1.0 + static_cast<double>(k));
  const JacobianError error = jacobian_error(balance, x, 1.1, 1e-6);
  CHECK(error.unknowns < 1e-7);
  CHECK(error.speed < 1e-7);
}
