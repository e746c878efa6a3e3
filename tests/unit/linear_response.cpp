/** Without contact each body answers its own load: closed forms. */
#include <complex>
#include "support/catch.hpp"

#include "motion/find_periodic.hpp"
#include "motion/motion.hpp"
#include "support/cases.hpp"

using namespace rotor_stator;
using namespace rotor_stator::motion;
using namespace rotor_stator::tests;

namespace {

/** Largest relative error of the four displacements against the closed form without
    contact. */
double error_without_contact(const Parameters& parameters, double frequency,
                             int harmonics)
{
  const double omega = hertz(frequency);
  const auto solution = find_periodic({parameters, omega, harmonics});
  REQUIRE(solution.found());
  const std::complex<double> z{
      parameters.rotor.stiffness() - parameters.rotor.mass * omega * omega,
      parameters.rotor.damping() * omega};
  const auto whirl = parameters.unbalance * omega * omega / z;
  const double sag_s =
      -parameters.gravity / std::pow(parameters.stator.natural_frequency, 2);
  const double sag_r =
      -parameters.gravity / std::pow(parameters.rotor.natural_frequency, 2);

  const Motion motion = motion_of(solution.bodies, 32);
  double error = 0;
  for (std::size_t k = 0; k < motion.size(); ++k) {
    const auto turned = whirl * std::polar(1.0, motion.phase(k));
    const Bodies& q = motion.positions[k];
    for (double difference : {q.stator.x, q.stator.y - sag_s, q.rotor.x - turned.real(),
                              q.rotor.y - (sag_r + turned.imag())})
      error = std::max(error, std::abs(difference));
  }
  return error / std::abs(whirl);
}

}  // namespace

TEST_CASE("Linear response without contact is exact to 1e-10")
{
  Parameters parameters = set_1();
  parameters.bearing.clearance = 0.1;
  for (double frequency : {0.5, 10.0, 23.0, 24.0, 60.0})
    CHECK(error_without_contact(parameters, frequency, 6) < 1e-10);
}

TEST_CASE("An undamped stator at its own resonance divides nothing by zero")
{
  Parameters parameters = set_1();
  parameters.stator.damping_ratio = 0;
  const auto solution =
      find_periodic({parameters, parameters.stator.natural_frequency, 6, 64});
  REQUIRE(solution.found());
  CHECK(solution.bodies.allFinite());
}
