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

std::string doubt_of_speed(const Parameters& machine, double highest)
{
  constexpr double fastest = 2e6;  // n d_m of ball bearings [mm/min]
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
      [N/m²]; gravity of any planet [m/s²]. */
  constexpr double widest = 5, steel = 1e11, heaviest = 30;
  std::vector<std::string> all;
  for (const Bearing& bearing : bearings_of(machine)) {
    if (const double d = printable_size(pitch_diameter(bearing)); d > widest)
      all.push_back(format("a pitch diameter of %.3g m: are lengths in m?", d));
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
  const double e = printable_size(machine.unbalance / machine.rotor.mass);
  if (machine.machine->takes_explicit_steps() && !machine.rotor.rigid && e > 0.1)
    all.push_back(format("an eccentricity of %.3g m: is the unbalance in kg m?", e));
  return all;
}

}  // namespace rotor_stator::explore
