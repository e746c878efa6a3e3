/**
# Hertz contact of a ball with its races (Eq. 5; Eqs 1 and 2)

A ball pressed by the penetration $p > 0$ answers with the force Q; ball j of a bearing,
approached by Δ_j, with Q_j. Eq. 2 stands further down.

$$Q = K_H\, p^{3/2}, \tag{1}$$

$$Q_j = K_H \max(0, \Delta_j - \delta)^{3/2}. \tag{5}$$

Here is the force of a given penetration, for sizes, static deflections and balls with a
defect or another exponent. For a whole bearing of intact balls Eq. 5 is written once
more, in `bearing_force` (ball_bearing.hpp), which serves integration and harmonic
balance. */
#pragma once

#include <cmath>

namespace rotor_stator {

/** Contact force Q [N] (Eqs 1 and 5) of a ball with the penetration `p` [m]; K_H in
   N/m^{3/2} (D-08: the paper prints N/m). Rollers have another exponent, 10/9. */
inline double hertz_force(double contact_stiffness, double p, double exponent = 1.5)
{
  if (exponent != 1.5) return p > 0 ? contact_stiffness * std::pow(p, exponent) : 0.0;
  return p > 0 ? contact_stiffness * p * std::sqrt(p) : 0.0;
}

/** Its derivative dQ/dp [N/m]. */
inline double hertz_stiffness(double contact_stiffness, double p, double exponent = 1.5)
{
  if (exponent != 1.5)
    return p > 0 ? exponent * contact_stiffness * std::pow(p, exponent - 1) : 0.0;
  return p > 0 ? 1.5 * contact_stiffness * std::sqrt(p) : 0.0;
}

/** Penetration [m] under the force `q` ≥ 0 [N]: the inverse of Eq. 1. */
inline double hertz_penetration(double contact_stiffness, double q, double exponent = 1.5)
{
  return std::pow(q / contact_stiffness, exponent == 1.5 ? 2.0 / 3.0 : 1 / exponent);
}

/** One solid in contact: Young's modulus [Pa] and Poisson's ratio [-]. */
struct Solid {
  double young_modulus;
  double poisson_ratio;
};

/** Complete elliptic integrals of the modulus k: the first kind K, the second kind E, and
    K - E, which would lose its digits as a difference for small k. */
struct EllipticIntegrals {
  double first, second, difference;
};

/** Those of √(1 - k²) = `complement`, in 0 … 1 but not 0, by the arithmetic-geometric
    mean. */
EllipticIntegrals elliptic_integrals(double complement);

/** Hertz's contact of two bodies whose sums of curvatures in the two principal planes are
    `a` and `b` > 0 [1/m] (a convex surface counts positive). */
struct PointContact {
  double ellipticity;  ///< κ ≥ 1, long over short half axis of the pressed ellipse
  /** δ* of Harris, its approach over that of a circular contact of the same a + b. */
  double deformation;
  double stiffness;  ///< K [N/m^{3/2}] in Q = K p^{3/2}
  double pressure;   ///< largest [Pa/N^{1/3}], over Q^{1/3}
};

/** With e² = 1 - κ⁻², κ follows from the geometry and gives the rest:

   $$\frac{\max(a, b)}{\min(a, b)} = \frac{\kappa^2 E - K}{K - E}, \qquad
     \delta^* = \frac{2K}{\pi} \left(\frac{\pi}{2\kappa^2 E}\right)^{1/3}, \qquad
     K_H = \frac{4\sqrt2}{3} E^* (a + b)^{-1/2} (\delta^*)^{-3/2}, \qquad
     p_{max} = \frac{3}{2\pi} \left(\frac{\pi^2}{4\kappa E^2}\right)^{1/3}
       \left(\frac{2 (a + b) E^*}{3}\right)^{2/3} Q^{1/3}.$$

   T. A. Harris, Rolling Bearing Analysis, 4th ed. (2001), chapter 6. */
PointContact point_contact(double a, double b, const Solid& first, const Solid& second);

/** Lengths [m], and radii of the grooves over the ball's diameter, > 1/2. */
struct BallGeometry {
  double ball_diameter, pitch_diameter;
  double inner_groove_ratio, outer_groove_ratio;
};

/** A ball against a race, whose radius in the plane of rotation is (d_m ∓ D)/2. */
PointContact inner_contact(const BallGeometry& geometry, const Solid& steel);
PointContact outer_contact(const BallGeometry& geometry, const Solid& steel);

/** Two contacts that carry the same force, their penetrations added. */
double in_series(double stiffness_a, double stiffness_b);

/** The contact stiffness [N/m^{3/2}] of a ball of radius R_b = `ball_radius` [m] on a
    flat:

   $$K_H = \tfrac43 \sqrt{R_b}\, E^*,
   \qquad 1/E^* = (1-\nu_1^2)/E_1 + (1-\nu_2^2)/E_2. \tag{2}$$

   The figures take K_H from Table 1 instead (D-07: it needs a steel ball of 0.42 m). */
double hertz_contact_stiffness(double ball_radius, const Solid& a, const Solid& b);

}  // namespace rotor_stator
