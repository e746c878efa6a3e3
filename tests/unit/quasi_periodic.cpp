/** Motions with two frequencies: against eighth-order integration, against the same
    machine as one with one frequency, and the rule of the images. */
#include "motion/quasi_periodic.hpp"
#include "balance/torus_line.hpp"
#include "support/cases.hpp"

using namespace rotor_stator;
using namespace rotor_stator::motion;
using namespace rotor_stator::tests;

namespace {

Parameters machine(int set, int balls, double cage)
{
  Parameters parameters = set_1();
  if (set == 2) parameters.bearing.clearance = 20e-5;
  parameters.bearing.balls = balls;
  parameters.bearing.cage_speed_ratio = cage;
  return parameters;
}

/** Over one long period. */
double distance(Motion motion, Motion reference)
{
  motion.points_per_period = reference.points_per_period =
      static_cast<int>(reference.size());
  return std::max(relative_difference(motion, reference),
                  rms_difference(motion, reference));
}

/** Four turns of rk8pd, after `turns` from rest. */
Motion integrated(const Parameters& parameters, double frequency, long turns)
{
  constexpr int points = 64;
  const auto stepper =
      flow(parameters, hertz(frequency),
           {.method = "rk8pd", .intervals_per_period = points, .tolerance = 1e-10});
  State state = static_start(parameters);
  for (long k = 0; k < turns * points; ++k) stepper->advance(k, state);
  return recorded(*stepper, points, state, turns, 4);
}

}  // namespace

/** Catches a wrong frequency in a linear block, a force at the wrong angle of the cage,
    and a line that is missing. */
TEST_CASE("A motion with two frequencies is the one that integration settles on")
{
  struct Case {
    int set, balls;
    double cage, frequency;
  };
  for (const Case& at : {Case{1, 16, 0.43, 31.1},
                         {1, 16, 0.4173, 56.3},
                         {1, 16, 0.381966, 98.6},
                         {1, 9, 0.3983, 45.4},
                         {2, 16, 0.43, 139.5},
                         {2, 16, 0.381966, 56.3}}) {
    INFO("set " << at.set << ", " << at.balls << " balls, c = " << at.cage << ", "
                << at.frequency << " Hz");
    const Parameters parameters = machine(at.set, at.balls, at.cage);
    const Torus found = torus_to_tolerance({parameters, hertz(at.frequency)}, 1e-3);
    REQUIRE(found.reached);
    const long turns = std::lround(5 * at.frequency);
    CHECK(distance(motion_of(parameters, found.motion, 64, 4, turns),
                   integrated(parameters, at.frequency, turns)) < 1e-3);
  }
}

/** Catches a transform that is read between its values, or a record whose start is wrong:
    lines that Newton has to move. */
TEST_CASE(
    "On the lines of time integration, and on all orders up to a sum, one motion is found")
{
  const Parameters parameters = machine(1, 16, 0.43);
  const TorusSearch search{parameters, hertz(45.4)};
  const Torus lines = torus_on_lines(search, 40);
  REQUIRE(lines.reached);
  CHECK(lines.motion.harmonics.count() == 40);
  CHECK(lines.motion.newton.iterations <= 4);
  CHECK(lines.error->larger() < 1e-4);
  /** The largest line that both leave out is that of twice the inner race's passing, (32,
      -2). */
  for (const int m : {3, 19}) {
    const Torus orders = torus_on_orders(search, m);
    REQUIRE(orders.reached);
    CHECK(orders.motion.harmonics.count() == m * (m + 1));
    CHECK(distance(motion_of(parameters, orders.motion, 64, 4),
                   motion_of(parameters, lines.motion, 64, 4)) < 5e-4);
  }
}

/** Both are the same torus, one of them closed. Catches a z or an N that mixes harmonics,
    and phases that depend on the turn. */
TEST_CASE("Where a whole number of balls passes in two turns both ways find one motion")
{
  const Parameters parameters = machine(1, 16, 0.40625);
  constexpr double frequency = 38.2;
  const Torus two = torus_on_orders(
      {.parameters = parameters, .omega = hertz(frequency), .stability = false}, 22);
  REQUIRE(two.reached);
  const PeriodicMotion one =
      find_periodic({over_turns(parameters, 2), hertz(frequency / 2), 128});
  REQUIRE(one.found());
  Motion closed = motion_of(one.bodies, 128);
  closed.points_per_period = 64;
  CHECK(distance(motion_of(parameters, two.motion, 64, 2), closed) < 1e-3);
}

/** Among all pairs, from their definition. */
TEST_CASE("No image falls on a harmonic that is kept")
{
  const Bearing bearing = machine(1, 16, 0.4173).bearing;
  const Harmonics kept = orders_up_to(4, bearing), others = orders_up_to(8, bearing);
  const auto [z, n, turns] = line_without_images(kept, others);
  const auto place = [&](Harmonic h) {
    return ((std::lround(h.k_1 + z * h.k_2)) % n + n) % n;
  };
  for (Harmonic a : kept.list())
    for (const Harmonics& set : {kept, others})
      for (Harmonic b : set.list()) {
        if (a == b) continue;
        CHECK(place(a) != place(b));
        CHECK((place(a) + place(b)) % n != 0);
      }
}
