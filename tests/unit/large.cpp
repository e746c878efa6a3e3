/** Bodies given by matrices: the exponential stepper and its derivative against the explicit steppers of Eq. 7, and the
    condensed blocks against differences. */
#include <cmath>
#include "support/catch.hpp"

#include "balance/bearing_problem.hpp"
#include "integration/exponential.hpp"
#include "integration/time_stepper.hpp"
#include "motion/find_periodic.hpp"
#include "stability/period_map.hpp"
#include "support/cases.hpp"

using namespace rotor_stator;
using namespace rotor_stator::tests;

namespace {

/** Data set 1, its masses, dampers and springs in matrices. */
Parameters set_1_by_matrices()
{
  Parameters p = set_1();
  const auto diagonal = [](double s, double r) -> Eigen::MatrixXd {
    return Eigen::Vector4d(s, s, r, r).asDiagonal();
  };
  Eigen::MatrixXd joints(4, 2);
  joints << -Eigen::Matrix2d::Identity(), Eigen::Matrix2d::Identity();
  const std::complex<double> i(0, 1);
  Eigen::VectorXcd unbalance(4);
  unbalance << 0, 0, p.unbalance, -i * p.unbalance;
  p.large = std::make_shared<const LargeMachine>(LargeMachine{
      .mass = diagonal(p.stator.mass, p.rotor.mass),
      .damping = diagonal(p.stator.damping(), p.rotor.damping()),
      .gyroscopic = Eigen::MatrixXd::Zero(4, 4),
      .stiffness = diagonal(p.stator.stiffness(), p.rotor.stiffness()),
      .joints = joints,
      .load = -p.gravity * Eigen::Vector4d(0, p.stator.mass, 0, p.rotor.mass),
      .unbalance = unbalance,
      .spring = 3e7,
      .shown = 4,
      .places = {{0, 1, 2, 3}},
      .outputs = {}});
  return p;
}

}  // namespace

TEST_CASE("The exponential stepper follows Eq. 7, and so does its derivative")
{
  const Parameters plain = set_1(), large = set_1_by_matrices();
  const State start = motion::state_of(
      motion::find_periodic({.parameters = plain, .omega = hertz(45), .harmonics = 20}));
  const PeriodMap exact = period_map(plain, hertz(45), start, 1e-13);
  const auto off = [&](double tolerance) {
    return (vector_of(period_map(large, hertz(45), start, tolerance).end) -
            vector_of(exact.end))
               .head<4>()
               .norm() /
           scales(plain).length;
  };
  CHECK(off(1e-6) < 1e-3);
  CHECK(off(1e-12) < 1e-8);
  const PeriodMap varied = period_map(large, hertz(45), start, 1e-13);
  const auto sizes = state_scales(plain);
  const auto scaled = [&](const Eigen::MatrixXd& phi) -> Eigen::MatrixXd {
    return sizes.cwiseInverse().asDiagonal() * phi * sizes.asDiagonal();
  };
  CHECK((scaled(varied.derivative) - scaled(exact.derivative)).norm() <
        1e-4 * scaled(exact.derivative).norm());
}

/** A local error of order 5 needs steps shorter by 10^(4/5) = 6.3 for a tolerance smaller by 10⁴, one of order 3 by
    22; the contacts that open and close cost some more. */
TEST_CASE("The exponential stepper has order 4 where the contact stays")
{
  Parameters large = set_1_by_matrices();
  large.bearing.clearance = 0;
  large.bearing.cage_speed_ratio = 1e-9;
  large.unbalance *= 1e-3;
  const auto evaluations = [&](double tolerance) {
    ExponentialStepper stepper(large, hertz(45), 1, tolerance);
    State state = static_start(large);
    state.position.rotor.y += 1e-7;
    stepper.advance(0, state);
    return static_cast<double>(stepper.evaluations());
  };
  const double ratio = evaluations(1e-11) / evaluations(1e-7);
  CHECK(ratio > 3);
  CHECK(ratio < 10);
}

/** The arc length needs them; the gyroscopic part is there so that the speed in S counts beside the frequency. */
TEST_CASE("Condensed blocks vary with the speed as differences say")
{
  Parameters p = set_1_by_matrices();
  LargeMachine machine = *p.large;
  machine.gyroscopic(2, 3) = 7;
  machine.gyroscopic(3, 2) = -7;
  p.large = std::make_shared<const LargeMachine>(machine);
  const Problem problem = bearing_problem(p, 32);
  const double omega = hertz(33), step = 1e-4;
  for (const double h : {0, 1, 3}) {
    const LinearBlock at = problem.linear(omega, {h, 0}),
                      above = problem.linear(omega + step, {h, 0}),
                      below = problem.linear(omega - step, {h, 0});
    const auto agrees = [&](const auto& slope, const auto& high, const auto& low,
                            double size) {
      CHECK(((high - low) / (2 * step) - slope).norm() < 1e-6 * size / omega);
    };
    agrees(at.a_slope, above.a, below.a, at.a.norm());
    agrees(at.b_slope, above.b, below.b, at.b.norm());
    agrees(at.c_slope, above.c, below.c, at.c.norm() + 1e-12);
  }
}
