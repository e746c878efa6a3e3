/** Predictor, sweep and arc length, and how much work they are allowed. */
#include "continuation/arc_length.hpp"
#include "continuation/sweep.hpp"
#include "support/cases.hpp"

using namespace rotor_stator;
using namespace rotor_stator::tests;

TEST_CASE(
    "Eq. 20 as corrected extrapolates a straight line exactly and moves on from the last "
    "point")
{
  LagrangePredictor predictor(2.0, 5.0);
  for (int k = 0; k < 4; ++k)
    predictor.add(Eigen::Vector2d(1.0 * k, 3 - 2.0 * k), 10 + 5.0 * k);
  const double chord = std::hypot(std::sqrt(5.0) / 2, 1);
  const auto point = predictor.at_arc(chord);
  CHECK(point.omega == Approx(30));
  CHECK(point.x[0] == Approx(4));
  CHECK(point.x[1] == Approx(-5));
  const Eigen::VectorXd x = predictor.at_speed(27.5);
  CHECK(x[0] == Approx(3.5));
}

TEST_CASE("A predictor that was cleared knows nothing of the points before")
{
  LagrangePredictor predictor(1, 1);
  for (double old : {1.0, 7.0, 8.0})
    predictor.add(Eigen::VectorXd::Constant(1, old), old);
  predictor.clear();
  for (double speed : {10.0, 11.0})
    predictor.add(Eigen::VectorXd::Constant(1, 2 * speed), speed);
  CHECK(predictor.at_speed(12)[0] == Approx(24));
}

TEST_CASE("The predictor has the order of its cubic")
{
  /** Points on a circle: halving the spacing divides the error of a cubic extrapolation
      by 16. */
  const auto error = [](double h) {
    LagrangePredictor predictor(1, 1);
    for (int k = -3; k <= 0; ++k)
      predictor.add(Eigen::VectorXd::Constant(1, std::sin(k * h)), std::cos(k * h));
    const auto point = predictor.at_arc(h);
    return std::hypot(point.x[0] - std::sin(h), point.omega - std::cos(h));
  };
  const double ratio = error(0.1) / error(0.05);
  CHECK(ratio > 11);
}

/** Catches old factors that are kept though they mislead: at every speed Newton with a dense
    matrix, factored at every point, leads to the same solution. */
TEST_CASE("A sweep of set 1 finds every speed, up and down, with few Newton iterations")
{
  const Parameters parameters = set_1();
  Balance balance(bearing_problem(parameters, 32), 6),
      dense(bearing_problem(parameters, 32), 6);
  std::vector<double> omegas;
  for (double f = 1; f <= 60; f += 0.5) omegas.push_back(hertz(f));
  const auto swept = [&] {
    return sweep(
        balance, omegas,
        [&](double omega) { return quasi_static_start(parameters, omega, 6); },
        arc_length_settings(parameters));
  };
  const auto up = swept();
  std::reverse(omegas.begin(), omegas.end());
  const auto down = swept();
  int iterations = 0;  // chord steps included
  for (std::size_t k = 0; k < up.size(); ++k) {
    REQUIRE(up[k].found());
    REQUIRE(down[k].found());
    iterations += up[k].newton.iterations;
    CHECK((up[k].x - down[down.size() - 1 - k].x).norm() < 1e-8 * up[k].x.norm());
    const double omega = up[k].omega;
    Eigen::VectorXd exact = up[k].x;
    for (int newton = 0; newton < 20; ++newton)
      exact -=
          dense.jacobian(exact, omega).partialPivLu().solve(dense.residual(exact, omega));
    REQUIRE(dense.residual(exact, omega).norm() < 1e-10 * dense.problem().residual_scale);
    CHECK((up[k].x - exact).norm() < 1e-8 * exact.norm());
  }
  CHECK(iterations <= 800);
  CHECK(balance.evaluations() <= 2100);
}

TEST_CASE("N = 2m+1 as printed creates folds that N = 64 does not have")
{
  /** A fold is where the Jacobian turns singular: along the branch its determinant changes sign there,
      and nowhere else. */
  for (const auto& [samples, folds] : {std::pair(13, 10), std::pair(64, 0)}) {
    const Parameters parameters = set_1();
    Balance balance(bearing_problem(parameters, samples), 6);
    const Branch branch = follow_branch(balance, hertz(1), hertz(60),
                                        quasi_static_start(parameters, hertz(1), 6),
                                        arc_length_settings(parameters));
    REQUIRE(branch.covered);
    int changes = 0;
    double before = 0;
    for (const BranchPoint& point : branch.points) {
      const double determinant = balance.jacobian(point.motion.x, point.motion.omega)
                                     .partialPivLu()
                                     .determinant();
      changes += determinant * before < 0;
      before = determinant;
    }
    CHECK(branch.points.size() < 600);
    CHECK(branch.points.back().motion.omega == hertz(60));
    CHECK(changes == folds);
    CHECK(branch.folds.size() == static_cast<std::size_t>(folds));
  }
}

TEST_CASE("A branch without a start says so")
{
  const Oscillator oscillator = duffing();
  Balance balance(oscillator.problem(16), 1);
  const Eigen::VectorXd nonsense = Eigen::VectorXd::Constant(3, 1e200);
  CHECK_THROWS_AS(follow_branch(balance, 0.5, 1.5, nonsense,
                                {.newton = {}, .speed_scale = 1, .arc_unknown_scale = 1}),
                  NoSolution);
}
