/** Monodromy, Floquet multipliers and shooting, against closed forms, differences, a published
   case and each other. */
#include "support/catch.hpp"

#include "balance/bearing_problem.hpp"
#include "continuation/arc_length.hpp"
#include "io/errors.hpp"
#include "motion/find_periodic.hpp"
#include "support/cases.hpp"
#include "time/eigenvalues.hpp"
#include "time/floquet.hpp"
#include "time/flow.hpp"
#include "time/shooting.hpp"

using namespace rotor_stator;
using namespace rotor_stator::motion;
using namespace rotor_stator::tests;

namespace {

PeriodicMotion solution_at(const Parameters& parameters, double frequency, int harmonics)
{
  const auto solution = find_periodic({parameters, hertz(frequency), harmonics});
  REQUIRE(solution.found());
  return solution;
}

}  // namespace

TEST_CASE("Multipliers without contact are those of two damped oscillators")
{
  Parameters parameters = set_1();
  parameters.bearing.clearance = 1;
  const double omega = hertz(30), period = 2 * std::numbers::pi / omega;
  const auto motion =
      series_multipliers(parameters, {.omega = omega, .x = Eigen::VectorXd::Zero(2)});
  std::vector<double> expected;
  for (const Body* body : {&parameters.rotor, &parameters.stator})
    expected.insert(expected.end(), 4,
                    std::exp(-body->damping_ratio * body->natural_frequency * period));
  REQUIRE(motion.multipliers.size() == 8);
  for (int i = 0; i < 8; ++i)
    CHECK(std::abs(motion.multipliers[i]) == Approx(expected[i]).epsilon(1e-6));
  CHECK(motion.stable());
}

/** Catches disturbances of other masses or dampings, and steps too long for the contact. */
TEST_CASE("The product of the multipliers is Liouville's, in contact, above 20 Hz")
{
  const Parameters parameters = set_1();
  const Body &s = parameters.stator, &r = parameters.rotor;
  const double decay =
      4 * (s.damping_ratio * s.natural_frequency + r.damping_ratio * r.natural_frequency);
  for (double frequency : {20.5, 25.0, 30.0, 45.0, 55.0})
    for (int harmonics : {6, 32}) {
      const auto solution = solution_at(parameters, frequency, harmonics);
      const auto motion = series_multipliers(parameters, solution);
      std::complex<double> product = 1;
      for (const auto& mu : motion.multipliers) product *= mu;
      INFO(frequency);
      CHECK(motion.settled);
      CHECK(std::abs(product / std::exp(-decay / frequency) - 1.0) < 1e-6);
    }
}

TEST_CASE("The derivative of the period map is that of its differences")
{
  Parameters parameters = set_1();
  SECTION("Hertz") {}
  SECTION("with contact damping and a spall that turns")
  {
    parameters.bearing.damping = 5;
    parameters.bearing.defect = {
        .surface = Defect::Surface::inner_race, .depth = 2e-6, .width = 0.3};
  }
  const auto solution = solution_at(parameters, 45, 32);
  const Vector8 y = vector_of(state_of(solution)), sizes = state_scales(parameters);
  const auto map = [&](const Vector8& at) {
    return period_map(parameters, solution.omega, state_of(at),
                      {.intervals_per_period = 1, .tolerance = 1e-13});
  };
  const Matrix8 exact = map(y).derivative;
  for (int j = 0; j < 8; ++j) {
    const double h = 1e-6 * sizes[j];
    const Vector8 step = h * Vector8::Unit(j);
    const Vector8 difference =
        (vector_of(map(y + step).end) - vector_of(map(y - step).end)) / (2 * h);
    const Vector8 error = (difference - exact.col(j)).cwiseQuotient(sizes) * sizes[j];
    CHECK(error.norm() < 1e-5);
  }
}

TEST_CASE("Shooting and harmonic balance find the same motion and the same multipliers")
{
  const Parameters parameters = set_1();
  for (double frequency : {30.0, 45.0}) {
    const auto solution = solution_at(parameters, frequency, 256);
    State state = state_of(solution_at(parameters, frequency, 6));
    const Shooting shooting =
        shoot(parameters, solution.omega, state, {.tolerance = 1e-13, .closed = 1e-11});
    INFO(frequency << " Hz: " << shooting.reason);
    REQUIRE(shooting.converged);
    const Vector8 error = (vector_of(state) - vector_of(state_of(solution)))
                              .cwiseQuotient(state_scales(parameters));
    CHECK(error.head<4>().norm() < 1e-6);
    const auto motion = series_multipliers(parameters, solution);
    const Eigen::VectorXcd values = eigenvalues(shooting.derivative);
    CHECK(values.cwiseAbs().maxCoeff() == Approx(motion.largest()).epsilon(1e-4));
  }
}

TEST_CASE("Shooting says why it stops")
{
  State state = static_start(set_1());
  const Shooting shooting = shoot(set_1(), hertz(45), state, {.most_maps = 1});
  CHECK_FALSE(shooting.converged);
  CHECK(shooting.reason.find("1 periods") != std::string::npos);
}

TEST_CASE(
    "Unilateral spring: multipliers as published, the false period doubling included")
{
  const Oscillator oscillator = two_masses_unilateral();
  Balance coarse(oscillator.problem(1024), 7);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(coarse.unknowns());
  double omega = 0.59;
  const auto leading = [&](double at, int harmonics) {
    const Branch branch = follow_branch(
        coarse, omega, at, x,
        {.newton = {}, .speed_scale = 1, .arc_unknown_scale = 1, .most_step = 0.02});
    REQUIRE(branch.covered);
    x = branch.points.back().motion.x;
    omega = at;
    Balance fine(oscillator.problem(16384), harmonics);
    const auto solution = solve(fine, at, resize_harmonics(x, 2, harmonics));
    REQUIRE(solution.found());
    const auto motion = floquet(oscillator, solution.x, at, 4000, 2e-3);
    CHECK(motion.settled);
    return motion.multipliers.front();
  };
  /** The stiffness jumps, which leaves multipliers to about 2e-3. */
  const auto neimark_sacker = leading(0.6, 81);
  CHECK(neimark_sacker.real() == Approx(-0.266).margin(1e-3));
  CHECK(neimark_sacker.imag() == Approx(1.363).margin(1e-3));
  CHECK(std::abs(leading(0.635, 81)) == Approx(0.886).margin(1e-3));
  CHECK(leading(0.7, 21).real() == Approx(-1.605).margin(3e-3));
  CHECK(std::abs(leading(0.7, 81)) == Approx(0.858).margin(1e-3));
  CHECK(leading(0.75, 81).real() == Approx(-1.197).margin(2e-3));
}
