#include "explore/check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "explore/modes.hpp"
#include "explore/plausible.hpp"
#include "io/errors.hpp"
#include "model/catalogue.hpp"
#include "model/read_machine.hpp"
#include "model/rotor_stator.hpp"

namespace rotor_stator::explore {

namespace {

constexpr double turn = 2 * std::numbers::pi;

/** One bearing at rest, means over the angles of the cage between two balls. */
struct Rest {
  Vec2 u{0, 0};                  ///< [m]
  double force = 0, loaded = 0;  ///< of the bearing [N]; balls
  double most = 0;               ///< the largest force of a ball at any angle [N]
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
    motion::add(motion,
                turned.bodies->at_rest(turned, Direction::of(turned.bearing.cage_phase)));
    for (std::size_t b = 0; Rest & rest : rests) {
      const Bearing own = bearings_of(turned)[b];
      const BallBearing bearing(own);
      const auto cage = Direction::of(own.cage_phase);
      const Vec2 u = motion::relative_at(motion, 0, machine.bodies->places(b));
      const Vec2 force = bearing.reaction(cage, u).force;
      const auto q = bearing.ball_forces({{1, 0}, cage}, u, {0, 0});
      rest.u = rest.u + share * u;
      rest.force += share * std::hypot(force.x, force.y);
      for (double one : q) rest.loaded += one > 0 ? share : 0;
      rest.most = std::max(rest.most, std::ranges::max(q));
      ++b;
    }
  }
  return rests;
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

/** Where two masses that stay in contact resonate. */
std::string words_of_joint(const Parameters& machine)
{
  const bool is_pair = machine.bodies->takes_explicit_steps() && !machine.stator.rigid &&
                       !machine.rotor.rigid && machine.grounds.empty();
  return is_pair ? format("; of both masses in contact it is %.4g Hz",
                          joint_resonance(machine) / turn)
                 : "";
}

}  // namespace

Exploration explore_check(const CheckRequest& request)
{
  Table table("What the machine is", {{"name", "word", "of the value"},
                                      {"value", "-", "in its unit"},
                                      {"unit", "word", "of the value"},
                                      {"meaning", "word", "of the value"}});
  table.choose(request.columns, 4, false);
  const Parameters machine = doubted(
      read_machine(StrictToml(request.parameter_file), {.largest = largest_linear}),
      request.to);
  require_range(request.from, request.to);
  const std::vector<Rest> rests = rest_of(machine);
  describe(table, machine);
  auto warnings = static_cast<int>(table.warnings().size());
  const auto warn = [&](const std::string& text) {
    ++warnings;
    table.note("warning: " + text);
  };
  const auto add = [&](const std::string& name, double value, const char* unit,
                       const std::string& meaning) {
    table.row({name, value, unit, meaning});
  };
  const std::string at_end = format("at %g Hz", request.to);
  for (std::size_t b = 0; const Bearing& bearing : bearings_of(machine)) {
    const std::string tail = numbered("", b);
    const Rest& rest = rests[b++];
    const KinematicOrders orders = kinematic_orders(bearing);
    /** What is below rounding of the mean over the cage's angles is none. */
    const auto seen = [&](double u) {
      return std::abs(u) > 1e-12 * std::hypot(rest.u.x, rest.u.y) ? u : 0;
    };
    const double stress = printable_size(1e-6 * bearing.pressure * std::cbrt(rest.most));
    if (stress > 1e-6 * most_pressure)
      warn(format("the stress of %.4g N/mm^2 at rest is above %g", stress,
                  1e-6 * most_pressure));
    add("BPFO" + tail, orders.outer, "1/turn", "balls passing a point of the outer race");
    add("BPFI" + tail, orders.inner, "1/turn", "balls passing a point of the inner race");
    add("static_force" + tail, rest.force, "N", "of the bearing at rest");
    add("static_x" + tail, seen(rest.u.x), "m", "rotor against stator at rest");
    add("static_y" + tail, seen(rest.u.y), "m", "rotor against stator at rest");
    add("loaded_balls" + tail, rest.loaded, "-", "at rest, mean over the cage's angle");
    add("ball_load" + tail, rest.most, "N", "largest force of a ball at rest");
    if (stress > 0)
      add("stress" + tail, stress, "N/mm^2", "largest pressure of Hertz at rest");
    if (const double n = speed_value(bearing, request.to); n > 0)
      add("speed_value" + tail, n, "mm/min", "n d_m " + at_end);
  }
  const auto is_loaded = [](const Rest& rest) { return rest.loaded > 0; };
  if (std::ranges::none_of(rests, is_loaded))
    warn("no ball is loaded at rest: " +
         (machine.gravity > 0
              ? "do the loads lift the rotor?"
              : "frequencies are those without contact" + words_of_joint(machine)));
  const bool is_large = !machine.bodies->takes_explicit_steps();
  if (!is_large) {
    const double omega = angular(request.to),
                 e = printable_size(machine.unbalance / machine.rotor.mass),
                 thrown = machine.unbalance * omega * omega;
    add("eccentricity", e, "m", "e, unbalance over the rotor's mass");
    add("weight", printable_size(machine.rotor.mass * machine.gravity), "N",
        "of the rotor");
    add("unbalance_force", printable_size(thrown), "N", at_end);
    add("balance_grade", printable_size(1e3 * e * omega), "mm/s",
        "e omega " + at_end + ", the G of ISO 21940-11");
    if (const double gap = machine.bearing.clearance;
        gap > 0 && e > 10 * gap && thrown > rests.front().force)
      warn(format("the eccentricity of %.3g m is %.3g times the clearance", e,
                  printable_size(e / gap)));
  }
  if (!is_large && is_bare(machine) && never_touches(request, machine))
    warn(format("nothing touches from %g to %g Hz: the clearance of %g m is never closed",
                request.from, request.to, machine.bearing.clearance));
  const bool is_alone = !is_large && machine.grounds.empty();
  if (is_alone && !machine.stator.rigid)
    add("f_s", machine.stator.natural_frequency / turn, "Hz", "natural, without contact");
  if (is_alone && machine.rotor.natural_frequency > 0)
    add("f_r", machine.rotor.natural_frequency / turn, "Hz", "natural, without contact");
  /** Two masses vibrate mainly along x or y. */
  int modes[] = {0, 0};
  for (const Mode& mode : LinearMachine(machine).modes(0, 8)) {
    const std::string name =
        is_large ? format("f_%d", ++modes[0])
                 : format("f_%d_%c", ++modes[mode.axis == 'y'], mode.axis);
    add(name, mode.frequency, "Hz",
        "natural, damped; the bearing's mean force over the cage's angle, "
        "linear where it carries the load");
    const double speed = mode.frequency / passages_per_turn(machine.bearing);
    if (!is_large && speed >= request.from && speed <= request.to)
      add("passage_" + name, speed, "Hz", "speed at which the passing balls meet it");
    if (const std::string words = doubt(mode); !words.empty()) warn(words);
  }
  if (is_large)
    table.note(
        "modes at rest; those of a turning rotor, and where the balls meet them: "
        "campbell --critical");
  if (leaves_damping_out(machine))
    table.note("damping of the contact is not in the modes");
  if (!machine.grounds.empty())
    table.note("f_s, f_r, contact_loss: of machines without elements to the ground");
  if (is_alone && machine.bearing.clearance >= 0)
    if (const auto lost = equal_force_speeds(machine, angular(request.to)); !lost.empty())
      add("contact_loss", lost.front() / turn, "Hz",
          "speed at which the unbalance lifts the static load, at u = 0");
  table.value("warnings", warnings);
  return {std::move(table)};
}

}  // namespace rotor_stator::explore
