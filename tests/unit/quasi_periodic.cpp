/** Motions with two frequencies: against the same machine as one with one frequency, and
    the rule of the images. */
#include "motion/quasi_periodic.hpp"
#include "balance/torus_line.hpp"
#include "support/cases.hpp"

using namespace rotor_stator;
using namespace rotor_stator::motion;
using namespace rotor_stator::tests;

namespace {

Parameters with_cage(double ratio)
{
  Parameters parameters = set_1();
  parameters.bearing.cage_speed_ratio = ratio;
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

}  // namespace

/** Catches a transform that is read between its values, or a record whose start is wrong:
    lines that Newton has to move. */
TEST_CASE(
    "On the lines of time integration, and on all orders up to a sum, one motion is found")
{
  const Parameters parameters = with_cage(0.43);
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
  const Parameters parameters = with_cage(0.40625);
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
  const Bearing bearing = with_cage(0.4173).bearing;
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
