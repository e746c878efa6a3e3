/** Without gravity and with many balls the whirl is circular and the ball sum is an
   integral:

    F(ρ) = n/2π ∫ K_H (ρ cos φ - δ)₊^{3/2} cos φ dφ,  |ρ + (G_s + G_r) F(ρ)| = |G_r| m_e e
   ω². */
#include <gsl/gsl_integration.h>

#include <cmath>
#include <complex>
#include <numbers>
#include "model/hertz.hpp"
#include "support/catch.hpp"

#include "motion/find_periodic.hpp"
#include "motion/motion.hpp"
#include "support/cases.hpp"

using namespace rotor_stator;
using namespace rotor_stator::motion;
using namespace rotor_stator::tests;

namespace {

struct Whirl {
  Parameters parameters;
  double omega;
  double rho;  ///< while integrating

  /** Radial force at the radius r > δ, by the integral over the loaded arc. */
  double force(double r) const
  {
    const double delta = parameters.bearing.clearance;
    Whirl at = *this;
    at.rho = r;
    gsl_function f{[](double phi, void* data) {
                     const auto& w = *static_cast<Whirl*>(data);
                     return hertz_force(
                                w.parameters.bearing.contact_stiffness,
                                w.rho * std::cos(phi) - w.parameters.bearing.clearance) *
                            std::cos(phi);
                   },
                   &at};
    gsl_integration_workspace* workspace = gsl_integration_workspace_alloc(200);
    double result, error;
    gsl_integration_qag(&f, 0, std::acos(delta / r), 0, 1e-11, 200, GSL_INTEG_GAUSS31,
                        workspace, &result, &error);
    gsl_integration_workspace_free(workspace);
    return 2 * result * parameters.bearing.balls / (2 * std::numbers::pi);
  }

  double imbalance(double r) const
  {
    const auto g_s = 1.0 / dynamic_stiffness(parameters.stator, omega).value;
    const auto g_r = 1.0 / dynamic_stiffness(parameters.rotor, omega).value;
    return std::abs(r + (g_s + g_r) * force(r)) -
           std::abs(g_r) * parameters.unbalance * omega * omega;
  }

  double radius() const
  {
    double low = parameters.bearing.clearance * (1 + 1e-9), high = 100 * low;
    for (int k = 0; k < 80; ++k) {
      const double middle = 0.5 * (low + high);
      (imbalance(middle) > 0 ? high : low) = middle;
    }
    return low;
  }
};

}  // namespace

TEST_CASE("Circular whirl of 512 balls without gravity agrees with its integral to 1e-5")
{
  Parameters parameters = set_1();
  parameters.gravity = 0;
  parameters.bearing.balls = 512;
  parameters.bearing.clearance = 1e-6;
  for (double frequency : {35.0, 45.0, 60.0}) {
    const Whirl whirl{parameters, hertz(frequency), 0};
    const double radius = whirl.radius();
    REQUIRE(radius / parameters.bearing.clearance >= 1.5);
    const auto solution = find_periodic({parameters, hertz(frequency), 4, 32});
    REQUIRE(solution.found());
    CHECK(harmonic_amplitude(solution.x, 2, 0, 1) == Approx(radius).epsilon(1e-5));
    CHECK(harmonic_amplitude(solution.x, 2, 1, 1) == Approx(radius).epsilon(1e-5));
  }
}
