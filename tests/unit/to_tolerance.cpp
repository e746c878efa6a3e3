/** Harmonic balance to a tolerance: the error that it prints against the motion that
    shooting closes, and what it says where there is none. */
#include "support/cases.hpp"
#include "time/shooting.hpp"

using namespace rotor_stator;
using namespace rotor_stator::motion;
using namespace rotor_stator::tests;

namespace {

Judged found(Parameters parameters, double frequency, double tolerance)
{
  return to_tolerance(
      {.parameters = parameters, .omega = hertz(frequency), .harmonics = 6}, tolerance);
}

}  // namespace

/** At 3 Hz the sag is fifteen times the vibration: catches a tolerance that bounds only
    the largest error over the largest displacement. At 15 and 24 Hz few harmonics lead
    nowhere from quasi-static contact. */
TEST_CASE("The error of a solution is its distance from the motion that shooting closes")
{
  constexpr int points = 1024;
  for (const auto& [frequency, tolerance] :
       {std::pair(3.0, 1e-2), std::pair(6.0, 1e-2), std::pair(6.5, 1e-4),
        std::pair(15.0, 1e-3), std::pair(21.0, 1e-3), std::pair(24.0, 1e-3),
        std::pair(30.0, 1e-5), std::pair(41.5, 1e-3), std::pair(45.0, 1e-6)}) {
    const Judged at = found(set_1(), frequency, tolerance);
    INFO(frequency << " Hz, tolerance " << tolerance << ": " << at.end);
    REQUIRE(at.reached);
    const Error error = at.verdict.distance;
    CHECK(error.larger() <= tolerance);
    CHECK(at.motion.harmonics.count() % 6 == 0);
    State state = state_of(at.motion);
    const double omega = at.motion.omega;
    REQUIRE(
        shoot(set_1(), omega, state, {.tolerance = 1e-13, .closed = 1e-11}).converged);
    const Error off =
        difference(motion_of(at.motion.bodies, points),
                   one_period(set_1(), omega, state,
                              {.intervals_per_period = points, .tolerance = 1e-13}));
    CHECK(off.largest < 1.25 * error.largest + 1e-9);  // at four times the instants
    CHECK(off.rms < 1.05 * error.rms + 1e-9);
  }
}

TEST_CASE("A solution at another speed is the first start")
{
  const Judged at = found(set_1(), 45, 1e-4);
  const Parameters machine = set_1();
  const Judged next = to_tolerance({.parameters = machine,
                                    .omega = hertz(45.5),
                                    .harmonics = 6,
                                    .starts = {at.motion.x}},
                                   1e-4);
  REQUIRE(next.reached);
  CHECK(next.motion.start == "a known motion");
}
