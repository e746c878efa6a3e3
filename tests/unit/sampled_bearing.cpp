/** The force at all instants at once against the plain formula, ball by ball. */
#include <numbers>
#include "support/catch.hpp"

#include "model/ball_bearing.hpp"
#include "model/hertz.hpp"

using namespace rotor_stator;

namespace {

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

Bearing bearing_with(int balls, double clearance)
{
  Bearing bearing{};
  bearing.balls = balls;
  bearing.contact_stiffness = 1e11;
  bearing.clearance = clearance;
  bearing.cage_speed_ratio = 0.5;
  return bearing;
}

/** Largest errors over the sizes that |u| gives. */
struct Errors {
  double force = 0, stiffness = 0, without = 0;
};

Errors errors(const Bearing& bearing, int samples, double size)
{
  const SampledBearing sampled(bearing, samples);
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
  }
  e.force /= hertz_force(bearing.contact_stiffness, size);
  e.stiffness /= hertz_stiffness(bearing.contact_stiffness, size);
  return e;
}

}  // namespace

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

TEST_CASE("Outside contact the force at all instants is nothing")
{
  const SampledBearing sampled(bearing_with(16, 2e-5), 50);
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(50, 2), force, stiffness;
  u.col(1).setConstant(-2e-5);
  sampled(u, force, &stiffness);
  CHECK(force.norm() == 0);
  CHECK(stiffness.norm() == 0);
}

TEST_CASE("Grazing contact: a penetration of rounding size gives a force of that size")
{
  /** The penetration itself is known to 1e-16 of |u| only: its square root to 1e-8. */
  for (double over : {1e-15, 1e-12, 1e-9}) {
    const Errors e = errors(bearing_with(16, 2e-5), 64, 2e-5 * (1 + over));
    CHECK(e.force < 1e-14);
    CHECK(e.stiffness < 3e-8);
  }
}
