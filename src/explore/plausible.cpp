#include "explore/plausible.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/errors.hpp"
#include "model/large_machine.hpp"

namespace rotor_stator::explore {

namespace {

/** d_m [m]; 0 where the sizes are not known. */
double pitch_diameter(const Bearing& bearing)
{
  return bearing.radius_ratio > 0 ? bearing.ball_diameter / bearing.radius_ratio : 0;
}

constexpr double fastest_hertz = 1000;

/** About the speed; empty where bearings turn so fast. */
std::string doubt_of_speed(const Parameters& machine, double highest)
{
  constexpr double fastest = 1.3e6;  // n d_m of deep groove ball bearings [mm/min]
  bool is_known = true;
  for (const Bearing& bearing : bearings_of(machine)) {
    const double n = speed_value(bearing, highest);
    is_known = is_known && n > 0;
    if (n > fastest)
      return format(
          "%g Hz are %.6g turns a minute, n d_m = %.3g mm/min, above "
          "what ball bearings bear: speeds are in Hz, or as 1500rpm",
          highest, printable_size(60 * highest), n);
  }
  if (highest > fastest_hertz && !is_known)
    return format("%g Hz are %.6g turns a minute: speeds are in Hz, or as 1500rpm",
                  highest, printable_size(60 * highest));
  return "";
}

constexpr double most_eccentric = 3e-3;  // [m]
constexpr double deepest = 0.03;         // what a suspension sinks by [m]

/** Of K_H, of steel balls: over the root of the diameter, or where that is not known; of
    the line contact of rollers of 1 to 300 mm. */
void add_stiffness(Doubts& all, const Bearing& bearing)
{
  constexpr double softest_line = 3e7, stiffest_line = 3e10;  // [N/m^(10/9)]
  constexpr double steel = 1e11;                              // [N/m²]
  constexpr double softest = 3e8, stiffest = 1e13;  // of balls of 1 mm to 10 m [N/m^1.5]
  const double k = bearing.contact_stiffness, d = bearing.ball_diameter;
  const bool is_line = bearing.exponent > 1.05 && bearing.exponent < 1.2;
  all.add(
      is_line && (k < softest_line || k > stiffest_line),
      format("a contact stiffness of %.3g N/m^%.3g, that of no steel roller: is it in "
             "N/m^n?",
             k, bearing.exponent));
  if (bearing.exponent != 1.5) return;
  const double ratio = printable_size(k / std::sqrt(d) / steel);
  all.add(d > 0 && (ratio < 0.01 || ratio > 100),
          format("a contact %.2g times as stiff as that of steel balls of this size: is "
                 "the modulus in Pa?",
                 ratio));
  all.add(d == 0 && (k < softest || k > stiffest),
          format("a contact stiffness of %.3g N/m^1.5, that of no steel ball: is it in "
                 "N/m^1.5?",
                 k));
}

void add_bearing(Doubts& all, const Bearing& bearing)
{
  constexpr double widest = 5, deepest_spall = 1e-3;  // [m]
  constexpr double most_preload = 6e-5;               // of balls of unknown size [m]
  constexpr double least_clearance = 1e-8;            // [m]
  constexpr double steepest = 1.1;     // of ball screws' bearings 60 degrees [rad]
  constexpr double most_damped = 100;  // λ [s/m]; steel has 0.08 to 0.32
  constexpr double fullest = 0.97;     // of the pitch circle, by balls side by side
  const double d = bearing.ball_diameter, depth = bearing.defect.depth;
  const double pitch = printable_size(pitch_diameter(bearing));
  all.add(pitch > widest, format("a pitch diameter of %.3g m: are lengths in m?", pitch));
  const bool is_wide = d > 0 && std::abs(bearing.clearance) > 0.1 * d;
  all.add(is_wide, format("the clearance of %g m is more than a tenth of the ball",
                          bearing.clearance));
  all.add(!is_wide && !bearing.doubt.empty(), bearing.doubt);
  const double preload = std::max(0.0, -bearing.clearance);
  const double pressure = bearing.pressure * std::sqrt(preload) *
                          std::pow(bearing.contact_stiffness, 1.0 / 3);
  all.add((d == 0 && preload > most_preload) || (!is_wide && pressure > most_pressure),
          format("a preload of %g m: is it in m?", preload));
  all.add(bearing.clearance > 0 && bearing.clearance < least_clearance,
          format("a clearance of %g m: is it in m?", bearing.clearance));
  all.add(bearing.contact_angle > steepest,
          format("a contact angle of %g rad: is it in rad?", bearing.contact_angle));
  add_stiffness(all, bearing);
  const double share =
      bearing.balls * std::asin(std::min(1.0, bearing.radius_ratio)) / std::numbers::pi;
  all.add(share > fullest,
          format("%d balls fill %.3g of the pitch circle: are radii diameters?",
                 bearing.balls, share));
  all.add(depth > (d > 0 ? 0.1 * d : deepest_spall),
          format("a spall of %g m depth: is it in m?", depth));
  all.add(
      bearing.damping > most_damped,
      format("a contact damping of %g s/m: steel has about 0.1 to 0.3", bearing.damping));
  for (const double angle :
       {bearing.defect.place, bearing.defect.width, bearing.cage_phase})
    all.add(std::abs(angle) > angular(1),
            format("an angle of %g rad, more than a turn: is it in rad?", angle));
}

/** About what stands beside the balls. */
void add_parallel(Doubts& all, const ParallelElements& elements)
{
  constexpr double widest_gap = 3e-3;  // [m]
  all.add(elements.stop_gap > widest_gap,
          format("a stop after %g m: is it in m?", elements.stop_gap));
  const double last =
      elements.linear.empty() ? 0 : elements.linear.back().speed / angular(1);
  all.add(last > fastest_hertz,
          format("coefficients up to %g Hz: is their f in Hz?", last));
}

/** About the unbalance and what the rotor weighs. */
void add_rotor(Doubts& all, const Parameters& machine)
{
  constexpr double least_eccentric = 1e-8;  // a tenth of G0.4 at 40,000 rpm [m]
  const Body& rotor = machine.rotor;
  const double e = printable_size(machine.unbalance / rotor.mass);
  /** The ball below bears about five of n parts of the weight (Stribeck). */
  const double pressure =
      machine.bearing.pressure *
      std::cbrt(5 * rotor.mass * machine.gravity / machine.bearing.balls);
  all.add(pressure > most_pressure,
          format("a rotor of %g kg presses a ball with about %.3g N/mm^2, more than %g: "
                 "is its mass in kg?",
                 rotor.mass, 1e-6 * printable_size(pressure), 1e-6 * most_pressure));
  all.add(!rotor.rigid && e > most_eccentric,
          format("an eccentricity of %.3g m: is the unbalance in kg m?", e));
  all.add(e > 0 && e < least_eccentric,
          format("an unbalance of %.3g kg m is an eccentricity of %.1g m, finer than any "
                 "rotor is balanced: is it in kg m?",
                 machine.unbalance, e));
}

/** About stiffnesses that carry the constant loads. */
void add_sag(Doubts& all, const Parameters& machine)
{
  const auto rest = vector_of(machine.bodies->static_start(machine));
  /** The other coordinates of a large body are no displacements. */
  const LargeBodies* large = machine.bodies->matrices();
  double sag = rest.head(large ? large->shown : rest.size() / 2).cwiseAbs().maxCoeff();
  for (const Bearing& bearing : bearings_of(machine))
    sag -= std::max(0.0, bearing.clearance);
  all.add(sag > deepest,
          format("the machine gives way by %.3g m at rest: are the units of its "
                 "stiffnesses and loads right?",
                 printable_size(sag)));
}

/** About the damping of a free rotor, which vibrates on the bearing. */
void add_damper(Doubts& all, const Parameters& machine)
{
  const Body& rotor = machine.rotor;
  if (rotor.rigid || rotor.natural_frequency > 0) return;
  const bool is_undamped = machine.stator.rigid && rotor.damper == 0 &&
                           std::ranges::none_of(joints_of(machine), &Bearing::is_damped);
  all.add(
      is_undamped,
      "nothing damps the rotor: its damping_N_s_per_m may decide whether it is chaotic");
  const double critical =
      2 * std::sqrt(rotor.mass * scales(machine).stiffness * machine.bearing.balls);
  all.add(rotor.damper > 2 * critical,
          format("a damping of %.3g N s/m, %.3g times the critical one of %.3g kg on the "
                 "bearing: is it in N s/m?",
                 rotor.damper, printable_size(rotor.damper / critical), rotor.mass));
}

/** About bodies given by matrices. */
void add_bodies(Doubts& all, const Parameters& machine)
{
  const double weight = machine.bodies->matrices()->size_of_loads;
  const double e = printable_size(machine.unbalance * machine.gravity / weight);
  all.add(weight > 0 && e > most_eccentric,
          format("the unbalance of %.3g kg m is an eccentricity of %.3g m of all that "
                 "weighs: is it in kg m?",
                 machine.unbalance, e));
  add_sag(all, machine);
}

}  // namespace

double printable_size(double value)
{
  return std::min(value, 1e300);
}

double speed_value(const Bearing& bearing, double hertz)
{
  return printable_size(1e3 * pitch_diameter(bearing) * 60 * hertz);
}

Doubts doubts(const Parameters& machine, double highest)
{
  constexpr double heaviest = 30, lightest = 1.5;  // gravity of planets and the moon
  constexpr double lightest_stator = 5e-3;         // over the mass of the rotor
  constexpr double most_hertz = 1000;              // of a suspension
  constexpr double fastest_over_graded = 20;
  Doubts all;
  for (const Bearing& bearing : bearings_of(machine)) add_bearing(all, bearing);
  for (const Bearing& joint : joints_of(machine)) add_parallel(all, joint.parallel);
  const std::string too_fast = doubt_of_speed(machine, highest);
  all.add(!too_fast.empty(), too_fast);
  const double graded = machine.balance_speed / angular(1);
  all.add(graded > 0 && highest > fastest_over_graded * graded,
          format("a balance grade at %g Hz of a machine at %g Hz: is its speed in rpm?",
                 graded, highest));
  all.add(
      machine.gravity > heaviest || (machine.gravity > 0 && machine.gravity < lightest),
      format("a gravity of %g m/s^2: is it in m/s^2?", machine.gravity));
  for (const Body* body : {&machine.stator, &machine.rotor}) {
    const double critical = 2 * body->mass * body->natural_frequency;
    const double ratio =
        critical > 0 ? printable_size(body->damping() / critical) : body->damping_ratio;
    const bool is_damper = body->damper > 0;
    all.add(!body->rigid && ratio > (is_damper ? 2 : 0.5),
            format("a damping ratio of %.3g: 1 is critical, %s?", ratio,
                   is_damper ? "is the damping in N s/m" : "is it in per cent"));
  }
  if (!machine.bodies->takes_explicit_steps()) {
    add_bodies(all, machine);
    return all;
  }
  for (const auto& [body, name] :
       {std::pair{&machine.stator, "stator"}, {&machine.rotor, "rotor"}}) {
    if (body->rigid) continue;
    const double omega = body->natural_frequency, hertz = omega / angular(1);
    const double sinks = machine.gravity / (omega * omega);
    all.add(omega > angular(most_hertz),
            format("the %s of %g kg on a suspension of %.4g Hz, %.3g N/m: is the "
                   "frequency in Hz, or the stiffness in N/m?",
                   name, body->mass, hertz, printable_size(body->stiffness())));
    all.add(machine.grounds.empty() && omega > 0 && sinks > deepest,
            format("the %s of %g kg sinks by %.3g m on a suspension of %.3g N/m, %.3g "
                   "Hz: are its units right?",
                   name, body->mass, printable_size(sinks), body->stiffness(), hertz));
  }
  all.add(
      !machine.stator.rigid && machine.stator.mass < lightest_stator * machine.rotor.mass,
      format("a stator of %g kg about a rotor of %g kg: are their masses in kg?",
             machine.stator.mass, machine.rotor.mass));
  add_rotor(all, machine);
  if (all.empty()) add_sag(all, machine);
  if (all.empty()) add_damper(all, machine);
  return all;
}

Parameters doubted(Parameters machine, double highest)
{
  machine.doubts = doubts(machine, highest);
  return machine;
}

}  // namespace rotor_stator::explore
