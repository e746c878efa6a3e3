/**
# Hertz contact of a ball with its races (Eqs 1, 2 and 5)

A ball pressed by the penetration $p = \Delta - \delta > 0$ answers with

$$Q = K_H\, p^{3/2}, \tag{1, 5}$$

and with nothing when it is not pressed. */
#pragma once

#include <cmath>

namespace rotor_stator {

/** Contact force Q [N] (Eqs 1 and 5) of a ball with the penetration `p` [m]; K_H in
   N/m^{3/2} (D-08: the paper prints N/m). */
inline double hertz_force(double contact_stiffness, double p)
{
  return p > 0 ? contact_stiffness * p * std::sqrt(p) : 0.0;
}

/** Its derivative dQ/dp [N/m]. */
inline double hertz_stiffness(double contact_stiffness, double p)
{
  return p > 0 ? 1.5 * contact_stiffness * std::sqrt(p) : 0.0;
}

/** Penetration [m] under the force `q` ≥ 0 [N]: the inverse of Eq. 1. */
inline double hertz_penetration(double contact_stiffness, double q)
{
  return std::pow(q / contact_stiffness, 2.0 / 3.0);
}

/** One solid in contact: Young's modulus [Pa] and Poisson's ratio [-]. */
struct Solid {
  double young_modulus;
  double poisson_ratio;
};

/** The contact stiffness [N/m^{3/2}] of a ball of radius R_b = `ball_radius` [m] on a flat:

   $$K_H = \tfrac43 \sqrt{R_b}\, E^*, \qquad 1/E^* = (1-\nu_1^2)/E_1 + (1-\nu_2^2)/E_2. \tag{2}$$

   The figures take K_H from Table 1 instead (D-07:
   on steel Table 1's 1e11 would need a ball of 0.42 m). */
inline double hertz_contact_stiffness(double ball_radius, const Solid& a, const Solid& b)
{
  const double compliance = (1 - a.poisson_ratio * a.poisson_ratio) / a.young_modulus +
                            (1 - b.poisson_ratio * b.poisson_ratio) / b.young_modulus;
  return 4.0 / 3.0 * std::sqrt(ball_radius) / compliance;
}

}  // namespace rotor_stator
