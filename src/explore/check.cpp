#include "explore/check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "explore/campbell.hpp"
#include "io/errors.hpp"
#include "model/catalogue.hpp"
#include "model/large_machine.hpp"
#include "model/rotor_stator.hpp"

namespace rotor_stator::explore {

namespace {

constexpr double turn = 2 * std::numbers::pi;

/** One bearing at rest, means over the angles of the cage between two balls. */
struct Rest {
  Vec2 u{0, 0}, stiffness{0, 0};  ///< [m]; of the contact in x and y [N/m]
  double force = 0, loaded = 0;   ///< of the bearing [N]; balls
  double most = 0;                ///< the largest force of a ball at any angle [N]
};

/** All bearings. Their cages turn together, each between two of its balls. */
std::vector<Rest> rest_of(const Parameters& machine)
{
  constexpr int angles = 64;
  constexpr double share = 1.0 / angles;
  std::vector<Rest> rests(1 + machine.further.size());
  for (int k = 0; k < angles; ++k) {
    Parameters turned = machine;
    const auto turn_cage = [&](Bearing& one) {
      one.cage_phase += turn * share * k / one.balls;
    };
    turn_cage(turned.bearing);
    std::ranges::for_each(turned.further, turn_cage);
    motion::Motion motion{1, 0, {}};
    motion::add(motion, rest_state(turned, Direction::of(turned.bearing.cage_phase)));
    for (std::size_t b = 0; Rest & rest : rests) {
      const Bearing own = bearings_of(turned)[b];
      const BallBearing bearing(own);
      const auto cage = Direction::of(own.cage_phase);
      const Vec2 u = motion::at_bearing(turned, motion, b).motion.positions[0].relative();
      const auto [force, stiffness] = bearing.reaction(cage, u);
      const auto q = bearing.ball_forces({{1, 0}, cage}, u, {0, 0});
      rest.u = rest.u + share * u;
      rest.stiffness = rest.stiffness + share * Vec2{stiffness.xx, stiffness.yy};
      rest.force += share * std::hypot(force.x, force.y);
      for (double one : q) rest.loaded += one > 0 ? share : 0;
      rest.most = std::max(rest.most, std::ranges::max(q));
      ++b;
    }
  }
  return rests;
}

/** Frequencies [Hz] of both bodies joined by a spring, ascending, without that of a body
    which nothing holds. */
std::vector<double> joined_frequencies(const Parameters& machine, double spring)
{
  const Body &s = machine.stator, &r = machine.rotor;
  const double a = (r.stiffness() + spring) / r.mass;
  if (s.rigid) return {std::sqrt(a) / turn};
  const double b = (s.stiffness() + spring) / s.mass, half = (a + b) / 2;
  const double root = std::hypot((a - b) / 2, spring / std::sqrt(s.mass * r.mass));
  if (half - root <= 1e-12 * half) return {std::sqrt(half + root) / turn};
  return {std::sqrt(half - root) / turn, std::sqrt(half + root) / turn};
}

/** Whether the motion without contact, a circle about its mean, stays within the
    clearance at all speeds. */
bool never_touches(const CheckRequest& request, const Parameters& machine)
{
  constexpr int speeds = 1000;
  for (int k = 0; k <= speeds; ++k) {
    const double hertz = request.from + (request.to - request.from) * k / speeds;
    const Vec2 u = free_displacement(machine, angular(hertz), 0);
    const Vec2 v = free_displacement(machine, angular(hertz), turn / 2);
    const double twice =
        std::hypot(u.x + v.x, u.y + v.y) + std::hypot(u.x - v.x, u.y - v.y);
    if (!(twice <= 2 * machine.bearing.clearance)) return false;
  }
  return true;
}

}  // namespace

Exploration explore_check(const CheckRequest& request)
{
  Table table("What the machine is", {{"name", "word", "of the value"},
                                      {"value", "-", "in its unit"},
                                      {"unit", "word", "of the value"},
                                      {"meaning", "word", "of the value"}});
  table.choose(request.columns, 4, false);
  const Parameters machine = read_machine(StrictToml(request.parameter_file));
  require_range(request.from, request.to);
  const std::vector<Rest> rests = rest_of(machine);
  describe(table, machine);
  int warnings = 0;
  const auto warn = [&](const std::string& text) {
    ++warnings;
    table.note("warning: " + text);
  };
  for (std::size_t b = 0; const Bearing& bearing : bearings_of(machine)) {
    const Rest& rest = rests[b++];
    const std::string tail = b == 1 ? "" : format("_%zu", b);
    const KinematicOrders orders = kinematic_orders(bearing);
    const double stress = 1e-6 * bearing.pressure * std::cbrt(rest.most);
    const double gap = bearing.clearance, ball = bearing.ball_diameter;
    if (ball > 0 && gap > 0.1 * ball)
      warn(format("the clearance of %g m is more than a tenth of the ball", gap));
    if (stress > 4000)
      warn(format("the stress of %.4g N/mm^2 at rest is above 4000", stress));
    const auto add = [&](const char* name, double value, const char* unit,
                         const char* meaning) {
      table.row({name + tail, value, unit, meaning});
    };
    add("BPFO", orders.outer, "1/turn", "balls passing a point of the outer race");
    add("BPFI", orders.inner, "1/turn", "balls passing a point of the inner race");
    add("static_force", rest.force, "N", "of the bearing at rest");
    add("static_x", rest.u.x, "m", "rotor against stator at rest");
    add("static_y", rest.u.y, "m", "rotor against stator at rest");
    add("loaded_balls", rest.loaded, "-", "at rest, mean over the cage's angle");
    add("ball_load", rest.most, "N", "largest force of a ball at rest");
    if (stress > 0) add("stress", stress, "N/mm^2", "largest pressure of Hertz at rest");
  }
  if (!machine.machine->takes_explicit_steps()) {
    for (std::size_t k = 1; double frequency : natural_frequencies(machine, 8))
      table.row({format("f_%zu", k++), frequency, "Hz",
                 "natural, damped, with the mean contact stiffness at rest"});
    table.value("warnings", warnings);
    return {std::move(table)};
  }
  const Rest& rest = rests[0];
  if (never_touches(request, machine))
    warn(format("nothing touches from %g to %g Hz: the clearance of %g m is never closed",
                request.from, request.to, machine.bearing.clearance));
  /** A frequency and, in the range, the speed at which the passing balls meet it. */
  const auto add = [&](const std::string& name, double frequency, const char* meaning,
                       double order = 1) {
    const double speed = frequency / order;
    if (speed > 0 && (order == 1 || (speed >= request.from && speed <= request.to)))
      table.row({name, speed, "Hz", meaning});
  };
  const double passages = passages_per_turn(machine.bearing);
  if (!machine.stator.rigid)
    add("f_s", machine.stator.natural_frequency / turn, "natural, without contact");
  add("f_r", machine.rotor.natural_frequency / turn, "natural, without contact");
  for (const auto& [axis, spring] :
       {std::pair{"x", rest.stiffness.x}, {"y", rest.stiffness.y}})
    for (int k = 1; double frequency : joined_frequencies(machine, spring)) {
      const std::string name = format("f_%d_%s", k++, axis);
      if (spring == 0) continue;
      add(name, frequency, "natural, with the mean contact stiffness at rest");
      add("passage_" + name, frequency, "speed at which the passing balls meet it",
          passages);
    }
  const auto lost = equal_force_speeds(machine, angular(request.to));
  if (!lost.empty())
    table.row({"contact_loss", lost.front() / turn, "Hz",
               "speed at which the unbalance lifts the static load, at u = 0"});
  table.value("warnings", warnings);
  return {std::move(table)};
}

}  // namespace rotor_stator::explore
