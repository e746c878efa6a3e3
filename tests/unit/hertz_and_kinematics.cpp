/** Eqs 1 to 6 against closed forms, and the force at all instants at once against the plain formula, ball by ball; Hertz's
    point contact and bearings from the catalogue against published values and other ways to compute them. */
#include <gsl/gsl_sf_ellint.h>
#include "model/ball_bearing.hpp"
#include "model/catalogue.hpp"
#include "model/hertz.hpp"
#include "support/cases.hpp"

using namespace rotor_stator;

namespace {

Bearing bearing_with(int balls, double clearance)
{
  return {.balls = balls,
          .contact_stiffness = 1e11,
          .clearance = clearance,
          .cage_speed_ratio = 0.5,
          .radius_ratio = 0};
}

struct Reaction {
  Eigen::Vector2d force = Eigen::Vector2d::Zero();
  Eigen::Matrix2d stiffness = Eigen::Matrix2d::Zero();
};

/** Eqs 3 to 6 with the balls' own angles: no cage frame, nothing skipped. */
Reaction plain_reaction(const Bearing& bearing, double phase, const Eigen::Vector2d& u)
{
  Reaction sum;
  for (int j = 0; j < bearing.balls; ++j) {
    const double theta =
        bearing.cage_speed_ratio * phase + 2 * std::numbers::pi * j / bearing.balls;
    const Eigen::Vector2d ball(std::cos(theta), std::sin(theta));
    const double p = ball.dot(u) - bearing.clearance;
    sum.force += hertz_force(bearing.contact_stiffness, p) * ball;
    sum.stiffness +=
        hertz_stiffness(bearing.contact_stiffness, p) * ball * ball.transpose();
  }
  return sum;
}

/** Largest errors over the sizes that |u| gives. */
struct Errors {
  double force = 0, stiffness = 0, without = 0;
};

Errors errors(const Bearing& bearing, int samples, double size)
{
  const SampledBearing sampled(bearing, samples);
  const BallBearing at_once(bearing);
  Eigen::MatrixXd u(samples, 2), force, stiffness, alone;
  for (int k = 0; k < samples; ++k)
    u.row(k) << size * std::cos(0.3 + 1.7 * k), size * std::sin(0.3 + 1.7 * k);
  sampled(u, force, &stiffness);
  sampled(u, alone, nullptr);
  Errors e;
  e.without = (force - alone).cwiseAbs().maxCoeff();
  for (int k = 0; k < samples; ++k) {
    const auto plain =
        plain_reaction(bearing, 2 * std::numbers::pi * k / samples, u.row(k));
    const Eigen::Matrix2d slope = stiffness.row(k).reshaped(2, 2);
    e.force = std::max(e.force, (force.row(k).transpose() - plain.force).norm());
    e.stiffness = std::max(e.stiffness, (slope - plain.stiffness).norm());
    const Direction cage =
        Direction::of(bearing.cage_speed_ratio * 2 * std::numbers::pi * k / samples);
    const Vec2 one{u(k, 0), u(k, 1)};
    const auto [f, s] = at_once.reaction(cage, one);
    const Vec2 alone_at = at_once.force(cage, one);
    e.force = std::max({e.force, (Eigen::Vector2d(f.x, f.y) - plain.force).norm(),
                        (Eigen::Vector2d(alone_at.x, alone_at.y) - plain.force).norm()});
    Eigen::Matrix2d own;
    own << s.xx, s.xy, s.xy, s.yy;
    e.stiffness = std::max(e.stiffness, (own - plain.stiffness).norm());
  }
  e.force /= hertz_force(bearing.contact_stiffness, size);
  e.stiffness /= hertz_stiffness(bearing.contact_stiffness, size);
  return e;
}

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

TEST_CASE("Hertz force, its slope and its inverse are consistent")
{
  CHECK(hertz_force(1e11, 4e-6) == Approx(1e11 * 8e-9));
  CHECK(hertz_force(1e11, 0) == 0);
  CHECK(hertz_force(1e11, -1e-6) == 0);
  CHECK(hertz_stiffness(1e11, 4e-6) == Approx(1.5 * 1e11 * 2e-3));
  CHECK(hertz_penetration(1e11, hertz_force(1e11, 3e-6)) == Approx(3e-6));
}

TEST_CASE("Hunt and Crossley: one ball, with the cage's turning, and never a pull")
{
  Bearing damped = bearing_with(4, 1e-5);
  damped.damping = 3;
  const double omega = 100, cage_speed = 50;
  const BallBearing bearing(damped, omega);
  const Vec2 u{1.5e-5, 2e-6};  // on ball 1, and along the race
  const double rate = 0.01 + cage_speed * u.y;
  const Angles at{{1, 0}, {1, 0}};
  CHECK(bearing.force(at, u, {0.01, 0.2}).x ==
        Approx(hertz_force(1e11, 5e-6) * (1 + 3 * rate)));
  CHECK(bearing.force(at, u, {-0.5, 0}).x == 0);
}

TEST_CASE("A spall takes its depth from the ball over it, and nothing beyond its width")
{
  Bearing damaged = bearing_with(4, 1e-5);
  const double width = 0.2, place = 0.7;
  damaged.defect = {.depth = 2e-6, .width = width, .place = place};
  /** Ball 1 in the spall's frame at this angle; the rotor is turned by 0.3. */
  const auto loaded = [&](Defect::Surface surface, double angle) {
    damaged.defect.surface = surface;
    const BallBearing bearing(damaged, 100);
    const bool is_inner = surface == Defect::Surface::inner_race;
    const double ball =
        surface == Defect::Surface::ball ? 0.1 : angle + place + (is_inner ? 0.3 : 0);
    const Direction to = Direction::of(ball);
    const Angles at{Direction::of(0.3), to, Direction::of(angle + place)};
    return bearing.ball_forces(at, {1.5e-5 * to.cos, 1.5e-5 * to.sin}, {0, 0})[0];
  };
  using enum Defect::Surface;
  for (const auto surface : {outer_race, inner_race, Defect::Surface::ball}) {
    CHECK(loaded(surface, 0) == Approx(hertz_force(1e11, 3e-6)));
    CHECK(loaded(surface, width / 4) == Approx(hertz_force(1e11, 4.5e-6)));
    CHECK(loaded(surface, 0.51 * width) == Approx(hertz_force(1e11, 5e-6)));
    CHECK(loaded(surface, 1.5) == Approx(hertz_force(1e11, 5e-6)));
  }
  CHECK(loaded(Defect::Surface::ball, std::numbers::pi) ==
        Approx(hertz_force(1e11, 3e-6)));  // the other race
}

TEST_CASE("The force at all instants is the plain sum over the balls")
{
  for (int balls : {1, 2, 7, 16, 256})
    for (int samples : {3, 7, 8, 9, 50, 97}) {
      INFO(balls << " balls, " << samples << " samples");
      for (double size : {2.05e-5, 2.3e-5, 1e-4}) {
        const Errors e = errors(bearing_with(balls, 2e-5), samples, size);
        CHECK(e.force < 1e-14 * balls);
        CHECK(e.stiffness < 2e-14 * balls);
        CHECK(e.without == 0);
      }
      const Errors closed = errors(bearing_with(balls, 0), samples, 3e-6);
      CHECK(closed.force < 1e-14 * balls);
    }
}

TEST_CASE("Grazing contact: a penetration of rounding size gives a force of that size")
{
  /** The penetration itself is known to 1e-16 of |u| only: its square root to 1e-8. */
  for (double over : {0.0, 1e-15, 1e-12, 1e-9}) {
    const Errors e = errors(bearing_with(16, 2e-5), 64, 2e-5 * (1 + over));
    CHECK(e.force < 1e-14);
    CHECK(e.stiffness < 3e-8);
  }
}

TEST_CASE("Elements beside the balls: derivatives against difference quotients")
{
  ParallelElements elements{.cubic = 3e13, .stop_stiffness = 2e6, .stop_gap = 1e-5};
  elements.linear = {{100, {4e4, 1e4, -1e4, 5e4}, {20, 3, -4, 30}},
                     {300, {8e4, 2e4, 1e4, 4e4}, {10, 0, 4, 60}}};
  const double omega = 110, turns = 1.5;  // of the rotor in a base period
  const auto force = [&](Vec2 u, Vec2 rate, double at) {
    BearingReaction sum{};
    Parallel(elements, turns * at).add(u, rate, at, sum);
    return sum;
  };
  for (const Vec2 u : {Vec2{4e-6, -3e-6}, Vec2{8e-6, 9e-6}}) {
    const Vec2 rate{0.002, -0.001};
    const BearingReaction at = force(u, rate, omega);
    /** The force's change with a shift of u, of its rate, and of ω; along u(φ) the rate grows with ω. */
    const auto slope_is = [&](Vec2 du, Vec2 dv, double by, double x, double y) {
      const auto shifted = [&](double sign) {
        const double faster = 1 + sign * by / omega;
        return force(u + sign * du, faster * rate + sign * dv, faster * omega).force;
      };
      const Vec2 high = shifted(1), low = shifted(-1);
      const double step = 2 * (du.x + du.y + dv.x + dv.y + by);
      CHECK((high.x - low.x) / step == Approx(x).epsilon(1e-6));
      CHECK((high.y - low.y) / step == Approx(y).epsilon(1e-6));
    };
    const double h = 1e-10, g = 1e-6;
    slope_is({h, 0}, {}, 0, at.stiffness.xx, at.stiffness.yx);
    slope_is({0, h}, {}, 0, at.stiffness.xy, at.stiffness.yy);
    slope_is({}, {0, g}, 0, at.damping.xy, at.damping.yy);
    slope_is({}, {}, 1e-3, at.speed_slope.x, at.speed_slope.y);
  }
}

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
