/** Steppers: order, agreement, energy, and the verdict on the steady state. */
#include <catch2/catch.hpp>
#include <cmath>

#include "integration/steady_state.hpp"
#include "io/errors.hpp"
#include "support/cases.hpp"

using namespace rotor_stator;
using namespace rotor_stator::tests;

namespace
{

/** x_r after one second at 7 Hz, from the static start. */
double after_one_second(const Parameters& parameters, const StepperSettings& settings)
{
  State state = static_start(parameters);
  const TimeStepper stepper = make_stepper(parameters, hertz(7), settings);
  for (long k = 0; k < 7L * settings.intervals_per_period; ++k) stepper.advance(k, state);
  return state.position.rotor.x;
}

Parameters without_contact()
{
  Parameters parameters = set_1();
  parameters.bearing.clearance = 1;
  return parameters;
}

}  // namespace

TEST_CASE("RK4 has order 4 where Eq. 7 is smooth")
{
  const Parameters parameters = without_contact();
  const auto value = [&](double step) {
    return after_one_second(parameters,
                            {.method = "rk4", .intervals_per_period = 4, .step = step});
  };
  const double exact = value(2e-5);
  const double coarse = std::abs(value(4e-3) - exact),
               fine = std::abs(value(2e-3) - exact);
  CHECK(coarse / fine > 13);
  CHECK(coarse / fine < 19);
}

TEST_CASE("All steppers agree on a second of motion with contact")
{
  const Parameters parameters = set_1();
  const double exact = after_one_second(
      parameters, {.method = "rk8pd", .intervals_per_period = 16, .tolerance = 1e-13});
  for (const std::string& method : time_methods()) {
    INFO(method);
    const double value = after_one_second(
        parameters,
        {.method = method, .intervals_per_period = 16, .step = 2e-5, .tolerance = 1e-9});
    CHECK(value == Approx(exact).epsilon(1e-4));
  }
}

TEST_CASE("The stiff steppers' Jacobian is right: bsimp needs few evaluations")
{
  /** A wrong Jacobian costs bsimp its order and shows as many more steps. */
  const Parameters parameters = without_contact();
  State state = static_start(parameters);
  const TimeStepper stepper = make_stepper(
      parameters, hertz(7),
      {.method = "bsimp", .intervals_per_period = 4, .step = 0, .tolerance = 1e-8});
  for (long k = 0; k < 28; ++k) stepper.advance(k, state);
  CHECK(stepper.evaluations() < 60000);
}

TEST_CASE("A cage that is not in step with the rotor gives an aperiodic verdict")
{
  Parameters parameters = set_1();
  parameters.bearing.cage_speed_ratio = 0.4321;
  SteadySettings settings;
  settings.stepper = {.method = "rk4"};
  settings.longest = 6;
  const SteadyState steady =
      steady_state(parameters, hertz(6), static_start(parameters), settings);
  CHECK_FALSE(steady.periodic);
}

TEST_CASE("The steady state ends where its spread settles, and counts its work")
{
  SteadySettings settings;
  settings.stepper = {.method = "rk4", .intervals_per_period = 32};
  const SteadyState steady =
      steady_state(set_1(), hertz(30), static_start(set_1()), settings);
  CHECK(steady.periodic);
  CHECK(steady.spread <= settings.settled);
  CHECK(steady.seconds < settings.longest);
  CHECK(steady.states.size() == 32);
  CHECK(steady.evaluations > 0);
}

TEST_CASE("A step beyond stability is reported, not returned")
{
  SteadySettings settings;
  settings.stepper = {.method = "rk4", .intervals_per_period = 4, .step = 1e-2};
  CHECK_THROWS_AS(steady_state(set_1(), hertz(10), static_start(set_1()), settings),
                  NoSolution);
}
