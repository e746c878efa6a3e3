/** The plain equations, and gamma; what the other printed ones do is judged in tests/paper/deviations.py. */
#include "deviations/evidence.hpp"
#include "deviations/printed_equations.hpp"
#include "support/cases.hpp"

using namespace rotor_stator;
using namespace rotor_stator::deviations;
using namespace rotor_stator::tests;

TEST_CASE("D-04, D-21: gamma with parentheses inverts the samples, and only so")
{
  for (int m : {1, 3, 6}) {
    const int n = 2 * m + 1;
    const auto defect = [&](Form form) {
      return (gamma_matrix(m, n, form) * gamma_inverse(m, n) -
              Eigen::MatrixXd::Identity(n, n))
          .norm();
    };
    CHECK(defect(Form::corrected) < 1e-13);
    CHECK(defect(Form::printed) > 0.1);
  }
}

TEST_CASE("The plain Jacobian is the slope of the plain residual")
{
  const Parameters p = set_1();
  PlainBalance plain(p, hertz(12), 3, 32);
  const Eigen::VectorXd x = require_periodic({p, hertz(12), 3, 32}).bodies.reshaped();
  const Eigen::MatrixXd jacobian = plain.at(x).jacobian;
  const double h = 1e-10;
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(x.size(), k);
    const Eigen::VectorXd above = plain.residual(x + step);
    const Eigen::VectorXd slope = (above - plain.residual(x - step)) / (2 * h);
    CHECK((slope - jacobian.col(k)).norm() < 1e-4 * jacobian.col(k).norm());
  }
}
