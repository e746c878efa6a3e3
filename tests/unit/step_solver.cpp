/** Factors that are kept, GMRES and chord steps, against dense Newton at every point; and what a
    solution costs, in counts. */
#include <Eigen/LU>
#include <complex>
#include <numbers>
#include "support/catch.hpp"

#include "balance/bearing_problem.hpp"
#include "balance/equations_in_time.hpp"
#include "balance/newton.hpp"
#include "balance/step_solver.hpp"
#include "continuation/sweep.hpp"
#include "support/allocations.hpp"
#include "support/cases.hpp"

using namespace rotor_stator;
using namespace rotor_stator::tests;

namespace {

/** A start for m harmonics: the solution with 6. */
Eigen::VectorXd start_with(int harmonics, double frequency)
{
  Balance balance(bearing_problem(set_1(), 64), 6);
  const auto motion =
      solve(balance, hertz(frequency), quasi_static_start(set_1(), hertz(frequency), 6));
  REQUIRE(motion.found());
  return resize_harmonics(motion.x, 2, harmonics);
}

Balance balance_with(int harmonics)
{
  return {bearing_problem(set_1(), default_samples(harmonics)), harmonics};
}

/** Newton with a dense matrix, factored at every point. */
Eigen::VectorXd solve_densely(Balance& balance, double omega, Eigen::VectorXd x)
{
  for (int k = 0; k < 20; ++k)
    x -= balance.jacobian(x, omega).partialPivLu().solve(balance.residual(x, omega));
  REQUIRE(balance.residual(x, omega).norm() < 1e-10 * balance.problem().residual_scale);
  return x;
}

Eigen::VectorXd waves(Eigen::Index size)
{
  Eigen::VectorXd v(size);
  for (Eigen::Index k = 0; k < size; ++k) v[k] = std::sin(1.0 + static_cast<double>(k));
  return v;
}

}  // namespace

TEST_CASE("GMRES solves what LU solves, and says when it did not")
{
  const Eigen::Index n = 40;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(n, n) * 3;
  for (Eigen::Index k = 0; k < n; ++k) matrix.col(k) += 0.2 * waves(n + k).tail(n);
  const Eigen::VectorXd b = waves(n);
  const auto apply = [&](const Eigen::VectorXd& v, Eigen::VectorXd& product) {
    product = matrix * v;
  };
  const auto diagonal = [&](const Eigen::VectorXd& v, Eigen::VectorXd& z) {
    z = v.cwiseQuotient(matrix.diagonal());
  };
  Gmres gmres;
  Eigen::VectorXd x;
  const auto report = gmres.solve(apply, diagonal, b, 1e-12, static_cast<int>(n), x);
  CHECK(report.residual <= 1e-12);
  CHECK((matrix * x - b).norm() < 1e-11);
  CHECK((x - matrix.partialPivLu().solve(b)).norm() < 1e-11 * x.norm());
  const auto stopped = gmres.solve(apply, diagonal, b, 1e-12, 1, x);
  CHECK(stopped.iterations == 1);
  CHECK(stopped.residual == Approx((matrix * x - b).norm()));
}

TEST_CASE("Product, leading part and diagonal blocks are those of the dense Jacobian")
{
  const Oscillator oscillator = two_masses_cubic();
  Balance cubic(oscillator.problem(48), 9);
  Balance bearing(bearing_problem(set_1(), 19), 9);
  struct Case {
    Balance& balance;
    Eigen::VectorXd x;
    double omega;
  };
  for (const auto& [balance, x, omega] :
       {Case{cubic, waves(cubic.unknowns()), 1.1},
        Case{bearing, 0.98 * quasi_static_start(set_1(), hertz(16), 9), hertz(16)}}) {
    const Eigen::MatrixXd dense = balance.jacobian(x, omega);
    const double size = dense.norm();
    Eigen::VectorXd product(dense.rows());
    balance.apply_jacobian(x, omega, waves(dense.rows()), product);
    CHECK((product - dense * waves(dense.rows())).norm() < 1e-13 * size);
    Eigen::MatrixXd low;
    balance.jacobian(x, omega, 4, low);
    CHECK((low - dense.topLeftCorner(18, 18)).norm() < 1e-14 * size);
    Eigen::MatrixXd blocks;
    balance.diagonal_blocks(x, omega, 1, blocks);
    for (int h : {1, 5, 9}) {
      const auto block = dense.block(2 * (2 * h - 1), 2 * (2 * h - 1), 4, 4);
      CHECK((blocks.middleCols(4 * (h - 1), 4) - block).norm() < 1e-14 * size);
    }
  }
}

/** Two masses are mostly answered by the equations in time; a problem that does not know its bodies takes GMRES. */
TEST_CASE(
    "With many harmonics both kinds of steps find the solution of the dense Jacobian")
{
  for (const auto& [harmonics, frequency] : {std::pair(64, 55.0), std::pair(256, 30.0)}) {
    INFO("m = " << harmonics);
    const Eigen::VectorXd start = start_with(harmonics, frequency);
    Balance other = balance_with(harmonics);
    const Eigen::VectorXd dense = solve_densely(other, hertz(frequency), start);
    for (const bool knows_bodies : {true, false}) {
      Problem problem = bearing_problem(set_1(), default_samples(harmonics));
      if (!knows_bodies) problem.bodies.reset();
      Balance balance(problem, harmonics);
      const auto motion = solve(balance, hertz(frequency), start);
      REQUIRE(motion.found());
      CHECK((knows_bodies || balance.steps().linear_iterations() > 0));
      CHECK((motion.x - dense).norm() < 1e-9 * dense.norm());
    }
  }
}

namespace {

/** Amplitudes (cosine, sine) of u_x under a unit load cos hωt in x and a constant contact stiffness, over N samples. */
std::complex<double> response_in_time(EquationsInTime& equations, int samples, double h,
                                      double stiffness, double omega)
{
  Eigen::MatrixXd contact = Eigen::MatrixXd::Zero(samples, 4), load(samples, 2), u;
  contact.col(0).setConstant(stiffness);
  contact.col(3).setConstant(stiffness);
  equations.factor(contact, omega);
  REQUIRE(equations.samples() == samples);
  std::complex<double> sum = 0;
  for (int k = 0; k < samples; ++k)
    load.row(k) << std::cos(2 * std::numbers::pi * h * k / samples), 0;
  equations.solve(load, u);
  for (int k = 0; k < samples; ++k)
    sum += u(k, 0) * std::polar(2.0 / samples, -2 * std::numbers::pi * h * k / samples);
  return sum;
}

}  // namespace

/** Second differences without their correction are off by about 2e-6 here; damping, which has none, leaves the order. Near a
    stiffness at which a part of the period held at both ends has a resonance, 2e7 N/m here, rounding shows. */
TEST_CASE("The equations in time have the response of the closed form")
{
  const double omega = hertz(6), h = 3, stiffness = 2.1e7;
  const auto body = [](const Body& b) {
    return PointBody{b.mass, b.damping(), b.stiffness()};
  };
  EquationsInTime equations({body(set_1().stator), body(set_1().rotor)});
  const auto z_s = dynamic_stiffness(set_1().stator, h * omega).value,
             z_r = dynamic_stiffness(set_1().rotor, h * omega).value;
  const std::complex<double> exact = 1.0 / (z_s * z_r / (z_s + z_r) + stiffness);
  const auto error = [&](int samples) {
    return std::abs(response_in_time(equations, samples, h, stiffness, omega) - exact);
  };
  CHECK(error(512) < 2e-7 * std::abs(exact));
  CHECK(error(512) / error(1024) == Approx(4).margin(0.5));
}

TEST_CASE(
    "Newton's steps by the equations in time lead where the dense ones lead, in few iterations")
{
  struct Case {
    int harmonics;
    double frequency;
    long most_iterations;
  };
  for (const auto& [harmonics, frequency, most] :
       {Case{96, 6, 100}, Case{128, 3, 70}, Case{256, 1, 110}}) {
    INFO(frequency << " Hz, m = " << harmonics);
    const Eigen::VectorXd start =
        quasi_static_start(set_1(), hertz(frequency), harmonics);
    Balance balance = balance_with(harmonics), dense = balance_with(harmonics);
    dense.steps().hold();
    const auto motion = solve(balance, hertz(frequency), start),
               reference = solve(dense, hertz(frequency), start);
    REQUIRE(motion.found());
    REQUIRE(reference.found());
    CHECK((motion.x - reference.x).norm() < 1e-8 * reference.x.norm());
    CHECK(balance.steps().linear_iterations() <= most);
  }
}

TEST_CASE("Chord steps lead where Newton's own steps lead")
{
  std::vector<double> omegas;
  for (double f = 1; f <= 60; f += 0.5) omegas.push_back(hertz(f));
  const auto solutions = [&](double contraction) {
    Balance balance = balance_with(6);
    SweepSettings settings = sweep_settings(set_1());
    settings.newton.chord_contraction = contraction;
    return sweep(
        balance, omegas,
        [](double omega) { return quasi_static_start(set_1(), omega, 6); }, settings);
  };
  const auto chord = solutions(0.1), newton = solutions(0);
  for (std::size_t k = 0; k < omegas.size(); ++k) {
    REQUIRE(chord[k].found());
    CHECK((chord[k].x - newton[k].x).norm() < 1e-8 * newton[k].x.norm());
  }
}

TEST_CASE("What a solution costs, in iterations, evaluations and factorisations")
{
  struct Bound {
    int harmonics, iterations, evaluations, factorisations, linear_iterations;
  };
  for (const Bound& bound : {Bound{6, 6, 9, 2, 0}, Bound{10, 9, 12, 3, 0},
                             Bound{64, 7, 8, 7, 12}, Bound{1024, 7, 8, 7, 6}}) {
    INFO("m = " << bound.harmonics);
    Balance balance = balance_with(bound.harmonics);
    const NewtonReport report =
        solve(balance, hertz(30), start_with(bound.harmonics, 30)).newton;
    REQUIRE(report.converged());
    CHECK(report.iterations <= bound.iterations);
    CHECK(balance.evaluations() <= bound.evaluations);
    CHECK(balance.steps().factorisations() <= bound.factorisations);
    CHECK(balance.steps().linear_iterations() <= bound.linear_iterations);
  }
}

TEST_CASE("A solution allocates nothing once its balance has solved another")
{
  if (!counts_allocations()) return;
  for (int harmonics : {6, 10, 64, 256}) {
    INFO("m = " << harmonics);
    Balance balance = balance_with(harmonics);
    PeriodicMotion motion = solve(balance, hertz(30), start_with(harmonics, 30));
    REQUIRE(motion.found());
    motion.omega = hertz(30.5);
    const long before = allocations();
    const bool found = solve(balance, motion);
    const long after = allocations();
    REQUIRE(found);
    CHECK(after - before == 0);
  }
}
