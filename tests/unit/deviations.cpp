/** What the printed equations do, against closed forms and bounds: the numbers that
 * paper/deviations.md quotes. */
#include <fstream>
#include <sstream>
#include "continuation/sweep.hpp"
#include "deviations/evidence.hpp"
#include "deviations/printed_equations.hpp"
#include "model/hertz.hpp"
#include "support/cases.hpp"
#include "time/settle.hpp"

using namespace rotor_stator;
using namespace rotor_stator::deviations;
using namespace rotor_stator::motion;
using namespace rotor_stator::tests;

namespace {

DeviationScene scene()
{
  SceneFile file(SOURCE_DIR "/data/scenes/deviations.toml", "exchanged");
  return read_deviation_scene(file);
}

/** The scene with other text in one place. */
DeviationScene scene_with(const std::string& from, const std::string& to)
{
  DeviationScene changed = scene();
  std::ostringstream content;
  content << std::ifstream(changed.toml.file()).rdbuf();
  std::string text = content.str();
  text.replace(text.find(from), from.size(), to);
  changed.toml = StrictToml(changed.toml.file(), text);
  return changed;
}

double value(const EvidenceList& list, const std::string& key)
{
  for (const Evidence& evidence : list)
    if (evidence.key == key) return evidence.value;
  FAIL("no " << key);
  return 0;
}

}  // namespace

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

TEST_CASE("D-01: the printed sign is a negative stiffness that grows and has no rest")
{
  const auto list = sign_of_approach(scene());
  const double k = value(list, "D-01.stiffness_printed");
  CHECK(k < 0);
  CHECK(-k > 10 * value(list, "D-01.suspension"));
  CHECK(value(list, "D-01.growth_ours") < 0);

  /** Without damping and suspension: λ² = -k (1/m_s + 1/m_r). */
  const Parameters p = set_1();
  const double bare = std::sqrt(-k * (1 / p.stator.mass + 1 / p.rotor.mass));
  CHECK(value(list, "D-01.growth_printed") == Approx(bare).epsilon(0.02));
  CHECK(value(list, "D-01.sag_printed") < value(list, "D-01.sag"));
}

TEST_CASE("D-02: the printed predictor returns the last point exactly")
{
  LagrangePredictor unscaled(1, 1);
  PeriodicMotion last;
  for (int k = 0; k < 4; ++k) {
    last = {.omega = 100 + 1.7 * k,
            .x = Eigen::Vector2d(std::sin(0.3 * k), 1e-5 * k * k)};
    unscaled.add(last.x, last.omega);
  }
  const PeriodicMotion next = unscaled.at_arc(0);
  CHECK(next.x == last.x);
  CHECK(next.omega == last.omega);

  const auto list = printed_predictor(scene());
  CHECK(value(list, "D-02.moved_printed") == 0);
  CHECK(value(list, "D-02.error_ours") < 0.2 * value(list, "D-02.error_printed"));
}

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
  CHECK(value(names_of_gamma(scene()), "D-04.error_text") > 0.5);
}

TEST_CASE("D-05: N = 13 for six harmonics has folds that N = 64 does not have")
{
  const auto list =
      samples_as_printed(scene_with("harmonics = [6, 8, 10]\ncommon_samples = [64, 256]",
                                    "harmonics = [6]\ncommon_samples = [64]"));
  CHECK(value(list, "D-05.folds_m6_N13") == 10);  // confirmed in continuation.cpp
  CHECK(value(list, "D-05.folds_m6_N64") == 0);
}

TEST_CASE("The plain equations have the solution of the condensed ones")
{
  const Parameters p = set_1();
  const auto solution = require_periodic({p, hertz(30), 4, 32});
  PlainBalance plain(p, hertz(30), 4, 32);
  const Eigen::VectorXd x = solution.bodies.reshaped();
  CHECK(plain.residual(x).norm() < 1e-6 * plain.load().norm());
  CHECK(plain.step(x).norm() < 1e-8 * x.norm());

  /** D-06: the printed step does not vanish there. */
  CHECK(plain.step(x, Form::printed).norm() > 1e-3 * x.norm());

  /** D-12: nor is it a solution with the printed block, unless there is one harmonic. */
  PlainBalance printed(p, hertz(30), 4, 32, Form::printed);
  CHECK(printed.residual(x).norm() > 1e-5 * printed.load().norm());
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

TEST_CASE("D-07, D-08: the ball that Table 1 would need, and the unit of K_H")
{
  CHECK(value(radius_of_hertz(scene()), "D-07.ball_radius_needed") ==
        Approx(0.42).epsilon(0.01));
  const auto list = unit_of_stiffness(scene());
  CHECK(value(list, "D-08.penetration_hertz") <=
        hertz_penetration(1e11, value(list, "D-08.force")));
}

TEST_CASE("D-20: with c = 1/2 a ball is loaded once in 2T, as the paper says of Fig. 7")
{
  const DeviationScene half = scene_with("[0.5, 0.4375, 0.43]", "[0.5]");
  CHECK(value(passages_over_2t(half), "D-20.loadings_c0.5") == 1);
}
