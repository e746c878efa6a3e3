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
