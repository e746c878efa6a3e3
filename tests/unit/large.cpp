/** Bodies given by matrices: the implicit stepper and its derivative against the explicit steppers of Eq. 7, and the
    condensed blocks against differences. */
#include "model/rational_fit.hpp"
#include "support/cases.hpp"
#include "time/flow.hpp"
#include "time/gauss.hpp"
#include "time/period_map.hpp"

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
  p.bodies = std::make_shared<const LargeMachine>(
      LargeBodies{.mass = diagonal(p.stator.mass, p.rotor.mass),
                  .damping = diagonal(p.stator.damping(), p.rotor.damping()),
                  .gyroscopic = Eigen::MatrixXd::Zero(4, 4),
                  .stiffness = diagonal(p.stator.stiffness(), p.rotor.stiffness()),
                  .joints = joints,
                  .load = -p.gravity * Eigen::Vector4d(0, p.stator.mass, 0, p.rotor.mass),
                  .unbalance = unbalance,
                  .spring = 3e7,
                  .shown = 4,
                  .places = {{0, 1, 2, 3}}});
  return p;
}

}  // namespace

TEST_CASE("The stepper of Gauss follows Eq. 7, and so does its derivative")
{
  const Parameters plain = set_1(), large = set_1_by_matrices();
  const State start = motion::state_of(
      motion::find_periodic({.parameters = plain, .omega = hertz(45), .harmonics = 20}));
  const PeriodMap exact = period_map(plain, hertz(45), start,
                                     {.intervals_per_period = 1, .tolerance = 1e-13});
  const auto off = [&](double tolerance) {
    return (vector_of(period_map(large, hertz(45), start,
                                 {.intervals_per_period = 1, .tolerance = tolerance})
                          .end) -
            vector_of(exact.end))
               .head<4>()
               .norm() /
           scales(plain).length;
  };
  CHECK(off(1e-6) < 1e-3);
  CHECK(off(1e-12) < 1e-8);
  const PeriodMap varied = period_map(large, hertz(45), start,
                                      {.intervals_per_period = 1, .tolerance = 1e-13});
  const auto sizes = state_scales(plain);
  const auto scaled = [&](const Eigen::MatrixXd& phi) -> Eigen::MatrixXd {
    return sizes.cwiseInverse().asDiagonal() * phi * sizes.asDiagonal();
  };
  CHECK((scaled(varied.derivative) - scaled(exact.derivative)).norm() <
        1e-4 * scaled(exact.derivative).norm());
}

/** Half the step leaves a sixteenth of the error. The tolerance is so wide that no step is divided. */
TEST_CASE("The stepper of Gauss has order 4 where the contact stays")
{
  Parameters large = set_1_by_matrices();
  large.bearing.clearance = 0;
  large.bearing.cage_speed_ratio = 1e-9;
  large.unbalance *= 1e-3;
  const auto end = [&](int intervals, double tolerance) -> Eigen::VectorXd {
    GaussStepper stepper(matrices_of(large), large, hertz(45), intervals, tolerance);
    State state = static_start(large);
    state.position.rotor.y += 1e-7;
    for (int k = 0; k < intervals; ++k) stepper.advance(k, state);
    return vector_of(state).head(4);
  };
  const Eigen::VectorXd exact = end(64, 1e-13);
  const double coarse = (end(512, 1e3) - exact).norm(),
               fine = (end(1024, 1e3) - exact).norm();
  CHECK(coarse < 1e-2 * 1e-7);
  CHECK(coarse / fine > 14);
  CHECK(coarse / fine < 18);
}

/** A stepper that is new makes its steps by the sparse factors, one that has made many by their matrix. Would catch a load
    of another phase, and a matrix of another step or without a body's turning. */
TEST_CASE("The steps of Gauss by one matrix are those by its factors")
{
  Parameters large = set_1_by_matrices();
  LargeBodies machine = matrices_of(large);
  machine.gyroscopic(2, 3) = 7;
  machine.gyroscopic(3, 2) = -7;
  large.turns = 3;
  const int intervals = 1024;
  const double wide = 1e3, omega = hertz(45) / large.turns;
  GaussStepper lasting(machine, large, omega, intervals, wide);
  State one = static_start(large), other = one;
  double largest = 0;
  for (long k = 0; k < 1000; ++k) {
    lasting.advance(k, one);
    GaussStepper(machine, large, omega, intervals, wide).advance(k, other);
    largest = std::max(largest, vector_of(one).head(4).norm());
  }
  CHECK((vector_of(one) - vector_of(other)).head(4).norm() < 1e-9 * largest);
  CHECK((vector_of(one) - vector_of(static_start(large))).head(4).norm() > 0.1 * largest);
}

/** The arc length needs them; the gyroscopic part is there so that the speed in S counts beside the frequency. */
TEST_CASE("Condensed blocks vary with the speed as differences say")
{
  Parameters p = set_1_by_matrices();
  LargeBodies machine = matrices_of(p);
  machine.gyroscopic(2, 3) = 7;
  machine.gyroscopic(3, 2) = -7;
  p.bodies = std::make_shared<const LargeMachine>(machine);
  const Problem problem = bearing_problem(p, 32);
  const double omega = hertz(33), step = 1e-4;
  for (const double h : {0, 1, 3}) {
    LinearBlock at, above, below;
    problem.linear(omega, {h, 0}, at);
    problem.linear(omega + step, {h, 0}, above);
    problem.linear(omega - step, {h, 0}, below);
    const auto agrees = [&](const auto& slope, const auto& high, const auto& low,
                            double size) {
      CHECK(((high - low) / (2 * step) - slope).norm() < 1e-6 * size / omega);
    };
    agrees(at.a_slope, above.a, below.a, at.a.norm());
    agrees(at.b_slope, above.b, below.b, at.b.norm());
    agrees(at.c_slope, above.c, below.c, at.c.norm() + 1e-12);
  }
}

/** Sharp poles between the first samples would be missed by a fit that does not look there; the slopes serve Newton. */
TEST_CASE("A rational fit finds sharp poles, and their slopes")
{
  const std::complex<double> i(0, 1);
  const auto f = [&](double x) -> Eigen::VectorXcd {
    std::complex<double> many = 0;  // more poles than the first samples can tell
    for (int k = 1; k < 20; ++k) many += 0.1 / (x - 0.25 * k + 2e-3 * i);
    return Eigen::Vector2cd(many + 0.3 / (x - 1.234 + 1e-3 * i), std::exp(0.1 * x));
  };
  const RationalFit fit(f, 0.1, 5, 1e-9);
  REQUIRE(fit.covers(3));
  CHECK(!fit.covers(5.1));
  const double largest = f(1.234).cwiseAbs().maxCoeff(), step = 1e-6;
  for (int k = 0; k < 500; ++k) {
    const double x = 0.1 + 4.9 * (k + 0.37) / 500;
    const auto [value, slope] = fit.at(x);
    const Eigen::VectorXcd by_difference = (f(x + step) - f(x - step)) / (2 * step);
    CHECK((value - f(x)).norm() < 1e-7 * largest);
    CHECK((slope - by_difference).norm() < 1e-4 * by_difference.norm() + 1e-5 * largest);
  }
}
