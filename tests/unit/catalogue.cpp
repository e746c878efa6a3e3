/** Hertz's point contact and bearings from the catalogue, against published values and other ways to compute them. */
#include <gsl/gsl_sf_ellint.h>
#include <cmath>
#include <numbers>
#include "model/hertz.hpp"
#include "support/catch.hpp"

#include "model/ball_bearing.hpp"

using namespace rotor_stator;

namespace {

const Solid steel{.young_modulus = 2.1e11, .poisson_ratio = 0.3};

/** The displacement [m] at which a bearing carries `load` [N] on ball 1. */
double displacement_under(double load, const Bearing& bearing)
{
  const BallBearing force(bearing);
  double low = bearing.clearance, high = 1e-3;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    (force.force({1, 0}, {middle, 0}).x < load ? low : high) = middle;
  }
  return low;
}

}  // namespace

TEST_CASE("Elliptic integrals by the arithmetic-geometric mean are those of GSL")
{
  for (double complement : {1.0, 0.99999, 0.9, 0.5, 0.1, 0.03, 1e-3}) {
    /** GSL takes k, whose rounding counts more the nearer it is to 1. */
    const double rounding = 1e-14 + 1e-16 / (complement * complement);
    const double k = std::sqrt((1 - complement) * (1 + complement));
    const auto [first, second, difference] = elliptic_integrals(complement);
    CHECK(first == Approx(gsl_sf_ellint_Kcomp(k, GSL_PREC_DOUBLE)).epsilon(rounding));
    CHECK(second == Approx(gsl_sf_ellint_Ecomp(k, GSL_PREC_DOUBLE)).epsilon(rounding));
    /** K - E = k² ∫ sin²φ/√(1 - k² sin²φ) dφ = k² D. */
    CHECK(difference ==
          Approx(k * k * gsl_sf_ellint_Dcomp(k, GSL_PREC_DOUBLE)).epsilon(rounding));
  }
}

TEST_CASE("Contact parameters are those of Harris's table, and of a ball on a flat")
{
  /** F(ρ), a*, b*, δ* of Harris, table 6.1; κ = a over b. */
  const double table[][4] = {
      {0.1075, 1.0760, 0.9318, 0.9974},  {0.3204, 1.2623, 0.8114, 0.9761},
      {0.4795, 1.4556, 0.7278, 0.9429},  {0.5916, 1.6440, 0.6687, 0.9077},
      {0.7332, 2.011, 0.5881, 0.8394},   {0.83495, 2.494, 0.5186, 0.7602},
      {0.90999, 3.233, 0.4499, 0.6636},  {0.95738, 4.395, 0.3830, 0.5551},
      {0.983797, 6.448, 0.3150, 0.4352},
  };
  for (const auto& [difference, a, b, deformation] : table) {
    const PointContact contact =
        point_contact(100 * (1 - difference), 100 * (1 + difference), steel, steel);
    CHECK(contact.ellipticity == Approx(a / b).epsilon(1e-3));
    CHECK(contact.deformation == Approx(deformation).epsilon(5e-4));
    /** 3/(2π) over the half axes a* and b* times (3/(2 Σρ E*))^{1/3}, for 1 N. */
    const double modulus =
        steel.young_modulus / (2 * (1 - steel.poisson_ratio * steel.poisson_ratio));
    CHECK(contact.pressure == Approx(1.5 / (std::numbers::pi * a * b) *
                                     std::pow(2 * 200 * modulus / 3, 2.0 / 3))
                                  .epsilon(1e-3));
  }
  const PointContact circle = point_contact(100, 100, steel, steel);
  CHECK(circle.ellipticity == Approx(1).epsilon(1e-12));
  CHECK(circle.stiffness ==
        Approx(hertz_contact_stiffness(0.01, steel, steel)).epsilon(1e-12));
}

TEST_CASE("Contacts in series give the stiffness of ROLADYN's 6002")
{
  CHECK(in_series(1.939e10, 2.055e10) == Approx(7.055e9).epsilon(2e-4));
  CHECK(in_series(1e10, 1e10) == Approx(1e10 / std::pow(2, 1.5)).epsilon(1e-12));
}

TEST_CASE("Displacements under load are those of a commercial program after ISO/TS 16281")
{
  /** MASTA, as quoted in the tests of github.com/minzhun/ISO16281: 7 balls of 11.5 mm on 43.5 mm, grooves 0.52 and
      0.53, 1000 N on a ball: 15.1101 µm; 21.223 µm with a clearance of 10 µm on the diameter. It would catch a race
      forgotten, a factor in the moduli, and a clearance that is radial. */
  const BallGeometry geometry{0.0115, 0.0435, 0.52, 0.53};
  Bearing bearing{
      .balls = 7,
      .contact_stiffness = in_series(inner_contact(geometry, steel).stiffness,
                                     outer_contact(geometry, steel).stiffness),
      .clearance = 0,
      .cage_speed_ratio = 0.4,
      .radius_ratio = 0};
  CHECK(displacement_under(1000, bearing) == Approx(15.1101e-6).epsilon(2e-5));
  bearing.clearance = 5e-6;
  CHECK(displacement_under(1000, bearing) == Approx(21.223e-6).epsilon(2e-5));
}
