/** Hill's method against the monodromy matrix: where it converges, and where it misleads. */
#include "support/catch.hpp"

#include "motion/other_starts.hpp"
#include "stability/hill.hpp"
#include "support/cases.hpp"

using namespace rotor_stator;
using namespace rotor_stator::motion;
using namespace rotor_stator::tests;

namespace {

/** The bearing's machine along a solution. */
struct Linearised {
  Vibration vibration;
  PeriodicStiffness stiffness;
  double period;
  Floquet floquet;

  Multipliers hill(int harmonics, HillChoice choice) const
  {
    return hill_multipliers(vibration, stiffness, period, harmonics, choice);
  }
  double largest(int harmonics, HillChoice choice = HillChoice::most_symmetric) const
  {
    return std::abs(hill(harmonics, choice).front());
  }
};

Linearised linearised(const std::string& file, double frequency, int harmonics)
{
  const Parameters parameters = read_parameters(SOURCE_DIR "/data/" + file);
  const auto solution = search_periodic({parameters, hertz(frequency), harmonics});
  REQUIRE(solution.found());
  return {vibration_of(parameters), stiffness_along(parameters, solution), 1 / frequency,
          floquet(parameters, solution)};
}

}  // namespace

TEST_CASE("Hill's exponents of a constant system are those of its vibrations")
{
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(2, 2);
  const Eigen::Vector2d stiffness(4, 9);
  const Vibration vibration{one, 0.2 * one, stiffness.asDiagonal()};
  const PeriodicStiffness none{.at = [](double, double* k) { std::fill_n(k, 4, 0.0); }};
  for (HillChoice choice : {HillChoice::least_imaginary, HillChoice::most_symmetric}) {
    const auto found = hill_multipliers(vibration, none, 5, 3, choice);
    REQUIRE(found.size() == 4);
    for (const auto& mu : found)
      CHECK(std::abs(mu) == Approx(std::exp(-0.1 * 5)).epsilon(1e-9));
  }
}

TEST_CASE("Hill's method and the monodromy matrix agree on the largest multiplier")
{
  /** Contact is permanent and H ω passes the contact mode, near 700 Hz. */
  const auto motion = linearised("set1.toml", 60, 10);
  for (HillChoice choice : {HillChoice::least_imaginary, HillChoice::most_symmetric})
    CHECK(motion.largest(24, choice) == Approx(motion.floquet.largest()).epsilon(1e-5));
  CHECK(largest_move(motion.floquet.multipliers,
                     motion.hill(32, HillChoice::most_symmetric)) < 1e-2);
}

TEST_CASE("Hill's method with few harmonics calls an unstable orbit stable")
{
  /** An instability of the contact mode is not in reach of the harmonics of the orbit. */
  const auto motion = linearised("set2.toml", 45, 6);
  CHECK(motion.floquet.unstable());
  CHECK(motion.floquet.largest() == Approx(1.8103).epsilon(1e-4));
  CHECK(motion.largest(6) < 1);
  CHECK(motion.largest(16) < 1);
  CHECK(motion.largest(32) > 1);
}
