#include "explore/plausible.hpp"

#include <algorithm>
#include <cmath>

#include "io/errors.hpp"

namespace rotor_stator::explore {

namespace {

/** d_m [m]; 0 where the sizes are not known. */
double pitch_diameter(const Bearing& bearing)
{
  return bearing.radius_ratio > 0 ? bearing.ball_diameter / bearing.radius_ratio : 0;
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
  for (const Bearing& bearing : bearings_of(machine))
    if (const double n = speed_value(bearing, highest); n > fastest)
      return format(
          "%g Hz are %.4g turns a minute, n d_m = %.3g mm/min, above "
          "what ball bearings bear: speeds are in Hz, or as 1500rpm",
          highest, printable_size(60 * highest), n);
  return "";
}

std::vector<std::string> doubts(const Parameters& machine, double highest)
{
  /** Largest pitch of a bearing [m]; K_H over the root of the ball's diameter, of steel
      [N/m²]; gravity of any planet [m/s²]; what a suspension sinks by [m]; e [m]. */
  constexpr double widest = 5, steel = 1e11, heaviest = 30, deepest = 0.03,
                   most_eccentric = 3e-3;
  constexpr double most_hertz = 1000;       // of a suspension
  constexpr double least_eccentric = 1e-9;  // a hundredth of G0.4 at 40,000 rpm [m]
  std::vector<std::string> all;
  for (const Bearing& bearing : bearings_of(machine)) {
    if (const double d = printable_size(pitch_diameter(bearing)); d > widest)
      all.push_back(format("a pitch diameter of %.3g m: are lengths in m?", d));
    if (bearing.ball_diameter > 0 && bearing.clearance > 0.1 * bearing.ball_diameter)
      all.push_back(format("the clearance of %g m is more than a tenth of the ball",
                           bearing.clearance));
    else if (!bearing.doubt.empty())
      all.push_back(bearing.doubt);
    if (const double d = bearing.ball_diameter; d > 0 && bearing.exponent == 1.5) {
      const double ratio =
          printable_size(bearing.contact_stiffness / std::sqrt(d) / steel);
      if (ratio < 0.01 || ratio > 100)
        all.push_back(
            format("a contact %.2g times as stiff as that of steel balls of "
                   "this size: is the modulus in Pa?",
                   ratio));
    }
  }
  if (const std::string doubt = doubt_of_speed(machine, highest); !doubt.empty())
    all.push_back(doubt);
  if (machine.gravity > heaviest)
    all.push_back(format("a gravity of %g m/s^2: is it in m/s^2?", machine.gravity));
  for (const Body* body : {&machine.stator, &machine.rotor})
    if (!body->rigid && body->damping_ratio > 0.5)
      all.push_back(format("a damping ratio of %g: 1 is critical, is it in per cent?",
                           body->damping_ratio));
  if (!machine.bodies->takes_explicit_steps()) return all;
  for (const auto& [body, name] :
       {std::pair{&machine.stator, "stator"}, {&machine.rotor, "rotor"}}) {
    const double omega = body->natural_frequency;
    if (!body->rigid && omega > angular(most_hertz))
      all.push_back(format(
          "the %s of %g kg on a suspension of %.4g Hz, %.3g N/m: is the "
          "frequency in Hz?",
          name, body->mass, omega / angular(1), printable_size(body->stiffness())));
    const bool is_alone = !body->rigid && machine.grounds.empty();
    if (is_alone && omega > 0 && machine.gravity / (omega * omega) > deepest)
      all.push_back(
          format("the %s of %g kg sinks by %.3g m on a suspension of %.3g N/m, "
                 "%.3g Hz: are its units right?",
                 name, body->mass, printable_size(machine.gravity / (omega * omega)),
                 body->stiffness(), omega / angular(1)));
  }
  const double e = printable_size(machine.unbalance / machine.rotor.mass);
  /** The ball below bears about five of n parts of the weight (Stribeck). */
  const double pressure =
      machine.bearing.pressure *
      std::cbrt(5 * machine.rotor.mass * machine.gravity / machine.bearing.balls);
  if (pressure > most_pressure)
    all.push_back(format(
        "a rotor of %g kg presses a ball with about %.3g N/mm^2, more "
        "than %g: is its mass in kg?",
        machine.rotor.mass, 1e-6 * printable_size(pressure), 1e-6 * most_pressure));
  if (!machine.rotor.rigid && e > most_eccentric)
    all.push_back(format("an eccentricity of %.3g m: is the unbalance in kg m?", e));
  if (e > 0 && e < least_eccentric)
    all.push_back(
        format("an unbalance of %.3g kg m is an eccentricity of %.1g m, finer than any "
               "rotor is balanced: is it in kg m?",
               machine.unbalance, e));
  return all;
}

}  // namespace rotor_stator::explore
