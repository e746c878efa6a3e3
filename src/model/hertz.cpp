#include "model/hertz.hpp"

#include <algorithm>
#include <numbers>

namespace rotor_stator {

namespace {

double effective_modulus(const Solid& a, const Solid& b)
{
  return 1 / ((1 - a.poisson_ratio * a.poisson_ratio) / a.young_modulus +
              (1 - b.poisson_ratio * b.poisson_ratio) / b.young_modulus);
}

/** The ellipticity for a `ratio` ≥ 1 of curvatures, which grows with it and is larger. */
double ellipticity_of(double ratio)
{
  double low = 1, high = ratio;
  for (int halving = 0; halving < 100; ++halving) {
    const double middle = std::sqrt(low * high);
    const auto [first, second, difference] = elliptic_integrals(1 / middle);
    (middle * middle * second - first < ratio * difference ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

}  // namespace

EllipticIntegrals elliptic_integrals(double complement)
{
  double a = 1, b = complement;
  double c_squared = (1 - complement) * (1 + complement), weight = 0.5, sum = 0;
  for (int step = 0; step < 40; ++step) {
    sum += weight * c_squared;
    const double c = 0.5 * (a - b), mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
    c_squared = c * c;
    weight *= 2;
    if (c <= 1e-17 * a) break;
  }
  const double first = std::numbers::pi / (2 * a);
  return {first, first * (1 - sum), first * sum};
}

PointContact point_contact(double a, double b, const Solid& first, const Solid& second)
{
  const double kappa = ellipticity_of(std::max(a, b) / std::min(a, b));
  const EllipticIntegrals integrals = elliptic_integrals(1 / kappa);
  const double pi = std::numbers::pi, modulus = effective_modulus(first, second);
  const double deformation =
      2 * integrals.first / pi * std::cbrt(pi / (2 * kappa * kappa * integrals.second));
  return {.ellipticity = kappa,
          .deformation = deformation,
          .stiffness = 4 * std::numbers::sqrt2 / 3 * modulus /
                       (std::sqrt(a + b) * deformation * std::sqrt(deformation)),
          .pressure =
              1.5 / pi *
              std::cbrt(pi * pi / (4 * kappa) * std::pow(modulus * (a + b) / 1.5, 2)) /
              std::cbrt(integrals.second * integrals.second)};
}

namespace {

/** `race`: its curvature in the plane of rotation [1/m], negative of the outer one. */
PointContact ball_on_race(double ball_diameter, double groove_ratio, double race,
                          const Solid& steel)
{
  return point_contact((2 - 1 / groove_ratio) / ball_diameter, 2 / ball_diameter + race,
                       steel, steel);
}

}  // namespace

PointContact inner_contact(const BallGeometry& g, const Solid& steel)
{
  return ball_on_race(g.ball_diameter, g.inner_groove_ratio,
                      2 / (g.pitch_diameter - g.ball_diameter), steel);
}

PointContact outer_contact(const BallGeometry& g, const Solid& steel)
{
  return ball_on_race(g.ball_diameter, g.outer_groove_ratio,
                      -2 / (g.pitch_diameter + g.ball_diameter), steel);
}

double in_series(double stiffness_a, double stiffness_b)
{
  return std::pow(std::pow(stiffness_a, -2.0 / 3) + std::pow(stiffness_b, -2.0 / 3),
                  -1.5);
}

double hertz_contact_stiffness(double ball_radius, const Solid& a, const Solid& b)
{
  return 4.0 / 3.0 * std::sqrt(ball_radius) * effective_modulus(a, b);
}

}  // namespace rotor_stator
