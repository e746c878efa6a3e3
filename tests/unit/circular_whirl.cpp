/** Without gravity and with many balls the whirl is circular and the ball sum is an
   integral:

    F(ρ) = n/2π ∫ K_H (ρ cos φ - δ)₊^{3/2} cos φ dφ,  |ρ + (G_s + G_r) F(ρ)| = |G_r| m_e e
   ω². */
#include "support/cases.hpp"

using namespace rotor_stator;
using namespace rotor_stator::motion;
using namespace rotor_stator::tests;

TEST_CASE("Circular whirl of 512 balls without gravity agrees with its integral to 1e-5")
{
  Parameters parameters = set_1();
  parameters.gravity = 0;
  parameters.bearing.balls = 512;
  parameters.bearing.clearance = 1e-6;
  /** F(r), by the midpoint rule over the loaded arc. */
  const auto force = [bearing = parameters.bearing](double r) {
    constexpr int points = 10000;
    const double arc = std::acos(bearing.clearance / r);
    double sum = 0;
    for (int k = 0; k < points; ++k) {
      const double phi = arc * (k + 0.5) / points;
      sum += std::pow(r * std::cos(phi) - bearing.clearance, 1.5) * std::cos(phi);
    }
    return bearing.contact_stiffness * bearing.balls * sum * arc / points /
           std::numbers::pi;
  };
  for (double frequency : {35.0, 45.0, 60.0}) {
    const double omega = hertz(frequency);
    const auto g_s = 1.0 / dynamic_stiffness(parameters.stator, omega).value;
    const auto g_r = 1.0 / dynamic_stiffness(parameters.rotor, omega).value;
    double exact = parameters.bearing.clearance * (1 + 1e-9), high = 100 * exact;
    for (int halving = 0; halving < 80; ++halving) {
      const double r = 0.5 * (exact + high);
      const bool is_above = std::abs(r + (g_s + g_r) * force(r)) >
                            std::abs(g_r) * parameters.unbalance * omega * omega;
      (is_above ? high : exact) = r;
    }
    REQUIRE(exact / parameters.bearing.clearance >= 1.5);
    const auto solution = find_periodic({parameters, hertz(frequency), 4, 32});
    REQUIRE(solution.found());
    for (int axis : {0, 1})
      CHECK(harmonic_amplitude(solution.x, 2, axis, 1) == Approx(exact).epsilon(1e-5));
  }
}
