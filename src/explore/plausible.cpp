#include "explore/plausible.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/errors.hpp"

namespace rotor_stator::explore {

namespace {

/** d_m [m]; 0 where the sizes are not known. */
double pitch_diameter(const Bearing& bearing)
{
  return bearing.radius_ratio > 0 ? bearing.ball_diameter / bearing.radius_ratio : 0;
}

/** Of a body on its suspension, damper and all. */
double damping_ratio_of(const Body& body)
{
  const double critical = 2 * body.mass * body.natural_frequency;
  return critical > 0 ? printable_size(body.damping() / critical) : body.damping_ratio;
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

/** About the speed; empty where bearings turn so fast. */
static std::string doubt_of_speed(const Parameters& machine, double highest)
{
  constexpr double fastest = 1.3e6;  // n d_m of deep groove ball bearings [mm/min]
  constexpr double fastest_hertz = 1000;
  for (const Bearing& bearing : bearings_of(machine))
    if (const double n = speed_value(bearing, highest); n > fastest)
      return format(
          "%g Hz are %.4g turns a minute, n d_m = %.3g mm/min, above "
          "what ball bearings bear: speeds are in Hz, or as 1500rpm",
          highest, printable_size(60 * highest), n);
  if (highest > fastest_hertz)
    return format("%g Hz are %.4g turns a minute: speeds are in Hz, or as 1500rpm",
                  highest, printable_size(60 * highest));
  return "";
}

namespace {

using Doubts = std::vector<std::string>;

/** Of K_H, of steel balls: over the root of the diameter, or where that is not known. */
void add_stiffness(Doubts& all, const Bearing& bearing)
{
  constexpr double steel = 1e11;                    // [N/m²]
  constexpr double softest = 3e8, stiffest = 1e13;  // of balls of 1 mm to 10 m [N/m^1.5]
  if (bearing.exponent != 1.5) return;
  const double k = bearing.contact_stiffness, d = bearing.ball_diameter;
  const double ratio = printable_size(k / std::sqrt(d) / steel);
  if (d > 0 && (ratio < 0.01 || ratio > 100))
    all.push_back(
        format("a contact %.2g times as stiff as that of steel balls of "
               "this size: is the modulus in Pa?",
               ratio));
  if (d == 0 && (k < softest || k > stiffest))
    all.push_back(
        format("a contact stiffness of %.3g N/m^1.5, that of no steel ball: is "
               "it in N/m^1.5?",
               k));
}

void add_bearing(Doubts& all, const Bearing& bearing)
{
  constexpr double widest = 5, deepest_spall = 1e-3, widest_gap = 0.01;  // [m]
  constexpr double most_damped = 100;  // λ [s/m]; steel has 0.08 to 0.32
  constexpr double fullest = 0.97;     // of the pitch circle, by balls side by side
  const double d = bearing.ball_diameter, depth = bearing.defect.depth;
  if (const double pitch = printable_size(pitch_diameter(bearing)); pitch > widest)
    all.push_back(format("a pitch diameter of %.3g m: are lengths in m?", pitch));
  if (d > 0 && std::abs(bearing.clearance) > 0.1 * d)
    all.push_back(format("the clearance of %g m is more than a tenth of the ball",
                         bearing.clearance));
  else if (!bearing.doubt.empty())
    all.push_back(bearing.doubt);
  add_stiffness(all, bearing);
  if (const double share = bearing.balls *
                           std::asin(std::min(1.0, bearing.radius_ratio)) /
                           std::numbers::pi;
      share > fullest)
    all.push_back(format("%d balls fill %.3g of the pitch circle: are radii diameters?",
                         bearing.balls, share));
  if (depth > (d > 0 ? 0.1 * d : deepest_spall))
    all.push_back(format("a spall of %g m depth: is it in m?", depth));
  if (bearing.damping > most_damped)
    all.push_back(format("a contact damping of %g s/m: steel has about 0.1 to 0.3",
                         bearing.damping));
  for (const double angle :
       {bearing.defect.place, bearing.defect.width, bearing.cage_phase})
    if (std::abs(angle) > angular(1))
      all.push_back(format("an angle of %g rad, more than a turn: is it in rad?", angle));
  if (bearing.parallel.stop_gap > widest_gap)
    all.push_back(format("a stop after %g m: is it in m?", bearing.parallel.stop_gap));
}

/** About the unbalance and what the rotor weighs. */
void add_rotor(Doubts& all, const Parameters& machine)
{
  constexpr double most_eccentric = 3e-3;   // [m]
  constexpr double least_eccentric = 1e-8;  // a tenth of G0.4 at 40,000 rpm [m]
  const Body& rotor = machine.rotor;
  const double e = printable_size(machine.unbalance / rotor.mass);
  /** The ball below bears about five of n parts of the weight (Stribeck). */
  const double pressure =
      machine.bearing.pressure *
      std::cbrt(5 * rotor.mass * machine.gravity / machine.bearing.balls);
  if (pressure > most_pressure)
    all.push_back(
        format("a rotor of %g kg presses a ball with about %.3g N/mm^2, more "
               "than %g: is its mass in kg?",
               rotor.mass, 1e-6 * printable_size(pressure), 1e-6 * most_pressure));
  if (!rotor.rigid && e > most_eccentric)
    all.push_back(format("an eccentricity of %.3g m: is the unbalance in kg m?", e));
  if (e > 0 && e < least_eccentric)
    all.push_back(
        format("an unbalance of %.3g kg m is an eccentricity of %.1g m, finer than any "
               "rotor is balanced: is it in kg m?",
               machine.unbalance, e));
}

}  // namespace

std::vector<std::string> doubts(const Parameters& machine, double highest)
{
  constexpr double heaviest = 30;      // gravity of any planet [m/s²]
  constexpr double deepest = 0.03;     // what a suspension sinks by [m]
  constexpr double most_hertz = 1000;  // of a suspension
  Doubts all;
  for (const Bearing& bearing : bearings_of(machine)) add_bearing(all, bearing);
  if (const std::string doubt = doubt_of_speed(machine, highest); !doubt.empty())
    all.push_back(doubt);
  if (machine.gravity > heaviest)
    all.push_back(format("a gravity of %g m/s^2: is it in m/s^2?", machine.gravity));
  for (const Body* body : {&machine.stator, &machine.rotor})
    if (const double ratio = damping_ratio_of(*body);
        !body->rigid && ratio > (body->damper > 0 ? 2 : 0.5))
      all.push_back(
          format("a damping ratio of %.3g: 1 is critical, %s?", ratio,
                 body->damper > 0 ? "is the damping in N s/m" : "is it in per cent"));
  if (!machine.bodies->takes_explicit_steps()) return all;
  for (const auto& [body, name] :
       {std::pair{&machine.stator, "stator"}, {&machine.rotor, "rotor"}}) {
    const double omega = body->natural_frequency;
    if (!body->rigid && omega > angular(most_hertz))
      all.push_back(format(
          "the %s of %g kg on a suspension of %.4g Hz, %.3g N/m: is the "
          "frequency in Hz, or the stiffness in N/m?",
          name, body->mass, omega / angular(1), printable_size(body->stiffness())));
    const bool is_alone = !body->rigid && machine.grounds.empty();
    if (is_alone && omega > 0 && machine.gravity / (omega * omega) > deepest)
      all.push_back(
          format("the %s of %g kg sinks by %.3g m on a suspension of %.3g N/m, "
                 "%.3g Hz: are its units right?",
                 name, body->mass, printable_size(machine.gravity / (omega * omega)),
                 body->stiffness(), omega / angular(1)));
  }
  add_rotor(all, machine);
  return all;
}

}  // namespace rotor_stator::explore
