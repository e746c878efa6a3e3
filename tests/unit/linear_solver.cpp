/** GMRES and parts of the Jacobian against dense matrices; and what a solution costs, in counts. */
#include "balance/newton.hpp"
#include "support/cases.hpp"

using namespace rotor_stator;
using namespace rotor_stator::tests;

namespace {

Balance balance_with(int harmonics)
{
  return {bearing_problem(set_1(), default_samples(harmonics)), harmonics};
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
  Parameters own = set_1();
  own.bearing.damping = 8;
  own.bearing.defect = {
      .surface = Defect::Surface::inner_race, .depth = 2e-6, .width = 0.3, .place = 0.4};
  Balance damaged(bearing_problem(own, 64), 9);
  struct Case {
    Balance& balance;
    Eigen::VectorXd x;
    double omega;
  };
  for (const auto& [balance, x, omega] :
       {Case{cubic, waves(cubic.unknowns()), 1.1},
        Case{bearing, 0.98 * quasi_static_start(set_1(), hertz(16), 9), hertz(16)},
        Case{damaged, 0.98 * quasi_static_start(set_1(), hertz(16), 9), hertz(16)}}) {
    const Eigen::MatrixXd dense = balance.jacobian(x, omega);
    const double size = dense.norm();
    Eigen::VectorXd product(dense.rows());
    balance.apply_jacobian(x, omega, waves(dense.rows()), product);
    CHECK((product - dense * waves(dense.rows())).norm() < 1e-12 * size);
    Eigen::MatrixXd low;
    balance.jacobian(x, omega, 4, low);
    CHECK((low - dense.topLeftCorner(18, 18)).norm() < 1e-12 * size);
    Eigen::MatrixXd blocks;
    balance.diagonal_blocks(x, omega, 1, blocks);
    for (int h : {1, 5, 9}) {
      const auto block = dense.block(2 * (2 * h - 1), 2 * (2 * h - 1), 4, 4);
      CHECK((blocks.middleCols(4 * (h - 1), 4) - block).norm() < 1e-12 * size);
    }
  }
}

/** Catches a dense block or a mean stiffness that misses the contact: at these speeds the contact couples 96 to 400 harmonics,
    and at 3 Hz it rests where the load points. */
TEST_CASE("GMRES leads where the dense Jacobian leads, in few iterations at low speeds")
{
  struct Case {
    int harmonics;
    double frequency;
    long most_iterations;
  };
  for (const auto& [harmonics, frequency, most] :
       {Case{96, 6, 300}, Case{512, 3, 300}, Case{512, 11, 300}, Case{512, 16, 300},
        Case{64, 55, 60}, Case{256, 30, 60}}) {
    INFO(frequency << " Hz, m = " << harmonics);
    const int known = frequency < 20 ? 64 : 6;
    const Eigen::VectorXd start =
        motion::find_periodic({set_1(), hertz(frequency), known}).x;
    REQUIRE(start.size() > 0);
    PeriodicMotion motion{.omega = hertz(frequency),
                          .x = resize_harmonics(start, 2, harmonics)},
        reference = motion;
    Balance balance = balance_with(harmonics), other = balance_with(harmonics);
    BalanceSolver solver(balance), dense(other, true);
    REQUIRE(solve(balance, solver, motion));
    REQUIRE(solve(other, dense, reference));
    CHECK((motion.x - reference.x).norm() < 1e-8 * reference.x.norm());
    CHECK(solver.iterations() > 0);
    CHECK(solver.iterations() <= most);
  }
}

TEST_CASE("What a solution costs, in iterations, evaluations and factorisations")
{
  struct Bound {
    int harmonics, iterations, evaluations, factorisations, linear_iterations;
  };
  for (const Bound& bound : {Bound{6, 6, 9, 2, 0}, Bound{10, 9, 12, 3, 0},
                             Bound{64, 7, 8, 2, 60}, Bound{1024, 7, 8, 2, 60}}) {
    INFO("m = " << bound.harmonics);
    Balance balance = balance_with(bound.harmonics);
    BalanceSolver solver(balance);
    PeriodicMotion motion{
        .omega = hertz(30),
        .x = resize_harmonics(motion::find_periodic({set_1(), hertz(30), 6, 64}).x, 2,
                              bound.harmonics)};
    REQUIRE(solve(balance, solver, motion));
    CHECK(motion.newton.iterations <= bound.iterations);
    CHECK(balance.evaluations() <= bound.evaluations);
    CHECK(solver.factorisations() <= bound.factorisations);
    CHECK(solver.iterations() <= bound.linear_iterations);
  }
}
