/** What the printed equations do, against closed forms and bounds: the numbers that
 * paper/deviations.md quotes. */
#include "deviations/evidence.hpp"
#include "deviations/printed_equations.hpp"
#include "support/cases.hpp"
#include "time/settle.hpp"

using namespace rotor_stator;
using namespace rotor_stator::deviations;
using namespace rotor_stator::motion;
using namespace rotor_stator::tests;

TEST_CASE("The static contact balances the weights, and its stiffness is a slope")
{
  const Parameters p = set_1();
  const StaticContact contact = static_contact(p);
  const double y_s = (contact.force - p.stator.mass * p.gravity) / p.stator.stiffness();
  const double y_r = (-contact.force - p.rotor.mass * p.gravity) / p.rotor.stiffness();
  CHECK(y_r - y_s == Approx(contact.displacement).epsilon(1e-10));

  const BallBearing bearing(p.bearing);
  const double h = 1e-11;
  const auto force = [&](double u) { return bearing.force({1, 0}, {0, u}).y; };
  CHECK((force(contact.displacement + h) - force(contact.displacement - h)) / (2 * h) ==
        Approx(contact.stiffness).epsilon(1e-5));
}

TEST_CASE("Free modes: the decay of each body apart, and of both as one when joined")
{
  const Parameters p = set_1();
  const Eigen::VectorXd apart = free_modes(p, 0).real();
  CHECK(apart.maxCoeff() ==
        Approx(-p.rotor.damping_ratio * p.rotor.natural_frequency).epsilon(1e-9));
  CHECK(apart.minCoeff() ==
        Approx(-p.stator.damping_ratio * p.stator.natural_frequency).epsilon(1e-9));
  const double joined =
      (p.stator.damping() + p.rotor.damping()) / 2 / (p.stator.mass + p.rotor.mass);
  CHECK(free_modes(p, 1e12).real().maxCoeff() == Approx(-joined).epsilon(1e-4));
}

TEST_CASE("D-02: the printed predictor returns the last point exactly")
{
  std::vector<PeriodicMotion> known;
  for (int k = 0; k < 4; ++k)
    known.push_back(
        {.omega = 100 + 1.7 * k, .x = Eigen::Vector2d(std::sin(0.3 * k), 1e-5 * k * k)});
  const PeriodicMotion next = printed_prediction(known);
  CHECK(next.x == known.back().x);
  CHECK(next.omega == known.back().omega);
}

TEST_CASE("D-04, D-21: gamma with parentheses inverts the samples, and only so")
{
  for (int m : {1, 3, 6}) {
    const int n = 2 * m + 1;
    const auto defect = [&](Argument argument) {
      return (gamma_matrix(m, n, argument) * gamma_inverse(m, n) -
              Eigen::MatrixXd::Identity(n, n))
          .norm();
    };
    CHECK(defect(Argument::parenthesised) < 1e-13);
    CHECK(defect(Argument::printed) > 0.1);
  }
}

TEST_CASE("The plain equations have the solution of the condensed ones")
{
  const Parameters p = set_1();
  const auto solution = require_periodic(p, 30, 4, 32);
  PlainBalance plain(p, hertz(30), 4, 32);
  const Eigen::VectorXd x = solution.bodies.reshaped();
  CHECK(plain.residual(x).norm() < 1e-6 * plain.load().norm());
  CHECK(plain.corrected_step(x).norm() < 1e-8 * x.norm());

  /** D-06: the printed step does not vanish there. */
  CHECK(plain.printed_step(x).norm() > 1e-3 * x.norm());

  /** D-12: nor is it a solution with the printed block, unless there is one harmonic. */
  PlainBalance printed(p, hertz(30), 4, 32, FirstEntry::printed);
  CHECK(printed.residual(x).norm() > 1e-5 * printed.load().norm());
}

TEST_CASE("The plain Jacobian is the slope of the plain residual")
{
  const Parameters p = set_1();
  PlainBalance plain(p, hertz(12), 3, 32);
  const Eigen::VectorXd x = require_periodic(p, 12, 3, 32).bodies.reshaped();
  const Eigen::MatrixXd jacobian = plain.at(x).jacobian;
  const double h = 1e-10;
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(x.size(), k);
    const Eigen::VectorXd above = plain.residual(x + step);
    const Eigen::VectorXd slope = (above - plain.residual(x - step)) / (2 * h);
    CHECK((slope - jacobian.col(k)).norm() < 1e-4 * jacobian.col(k).norm());
  }
}
