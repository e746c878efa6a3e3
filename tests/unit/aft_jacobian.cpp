/** The analytic Jacobian against central differences, for the bearing and through the
    seam. */
#include "support/cases.hpp"

using namespace rotor_stator;
using namespace rotor_stator::tests;

namespace {

/** ∂R/∂X, column by column, and ∂R/∂ω. */
void agrees_with_differences(Balance& balance, const Eigen::VectorXd& x, double omega,
                             double h, double bound)
{
  const Eigen::MatrixXd jacobian = balance.jacobian(x, omega);
  const auto off = [](const Eigen::VectorXd& exact, const Eigen::VectorXd& after,
                      const Eigen::VectorXd& before, double apart) {
    return ((after - before) / apart - exact).norm() / exact.norm();
  };
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    const Eigen::VectorXd shift = h * Eigen::VectorXd::Unit(x.size(), k);
    const Eigen::VectorXd after = balance.residual(x + shift, omega);
    CHECK(off(jacobian.col(k), after, balance.residual(x - shift, omega), 2 * h) < bound);
  }
  const double step = 1e-5 * omega;
  const Eigen::VectorXd slope = balance.speed_derivative(x, omega),
                        after = balance.residual(x, omega + step);
  CHECK(off(slope, after, balance.residual(x, omega - step), 2 * step) < bound);
}

}  // namespace

/** Catches a rate of the wrong sign or order, a cage that stands still, a spall that does not turn, and an image with the
    wrong sign: (-3, 1) stands at a negative one. */
TEST_CASE("AFT Jacobian of a bearing, also with contact damping and a spall")
{
  Parameters parameters = set_1();
  if (GENERATE(false, true)) {
    parameters.bearing.damping = 8;
    parameters.bearing.defect = {.surface = Defect::Surface::inner_race,
                                 .depth = 2e-6,
                                 .width = 0.3,
                                 .place = 0.4};
  }
  SECTION("one frequency, also at the aliasing N = 2m+1")
  {
    const int m = 5;
    for (int samples : {2 * m + 1, 2 * m + 2, 4 * m + 1, 64}) {
      Balance balance(bearing_problem(parameters, samples), m);
      const Eigen::VectorXd x = 0.98 * quasi_static_start(parameters, hertz(16), m);
      agrees_with_differences(balance, x, hertz(16), 1e-10, 1e-6);
    }
  }
  SECTION("chosen harmonics of two frequencies")
  {
    parameters.bearing.cage_speed_ratio = 0.43;
    const Harmonics kept = orders_up_to(4, parameters.bearing);
    const auto line = line_without_images(kept, orders_up_to(6, parameters.bearing));
    Balance balance(bearing_problem(parameters, line), kept);
    Eigen::VectorXd x = project(0.98 * quasi_static_start(parameters, hertz(16), 3), 2,
                                Harmonics(3), kept);
    for (Eigen::Index k = 14; k < x.size(); ++k)
      x[k] += 1e-7 * std::sin(1.0 + static_cast<double>(k));
    agrees_with_differences(balance, x, hertz(16), 1e-10, 1e-6);
  }
}

TEST_CASE("AFT Jacobian of a two-mass oscillator with coupled forces")
{
  const Oscillator oscillator = two_masses_cubic();
  Balance balance(oscillator.problem(48), 5);
  Eigen::VectorXd x(balance.unknowns());
  for (Eigen::Index k = 0; k < x.size(); ++k)
    x[k] = std::sin(1.0 + static_cast<double>(k));
  agrees_with_differences(balance, x, 1.1, 1e-6, 1e-7);
}
