/** Floquet multipliers and shooting, against closed forms and each other. */
#include "motion/judge.hpp"
#include "support/cases.hpp"
#include "time/eigenvalues.hpp"
#include "time/flow.hpp"
#include "time/period_map.hpp"
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
      CHECK(motion.converged);
      CHECK(std::abs(product / std::exp(-decay / frequency) - 1.0) < 1e-6);
    }
}

TEST_CASE("Shooting says why it stops")
{
  State state = static_start(set_1());
  const Shooting shooting = shoot(set_1(), hertz(45), state, {.most_maps = 1});
  CHECK_FALSE(shooting.converged);
  CHECK(shooting.reason.find("1 periods") != std::string::npos);
  const Shooting away = shoot(set_1(), hertz(45), state, {.farthest = 1e-3});
  CHECK_FALSE(away.converged);
  CHECK(away.maps <= 2);
  CHECK(away.reason == "what closes is farther away than asked for");
}

TEST_CASE("A machine at rest is stable, and its distances are numbers")
{
  Parameters parameters = set_1();
  parameters.unbalance = 0;
  parameters.gravity = 0;
  const Verdict verdict = judge(parameters, solution_at(parameters, 45, 6));
  CHECK(verdict.stable());
  CHECK_FALSE(verdict.moves);
  CHECK(verdict.distance.largest == 0);
  CHECK(verdict.distance.rms == 0);
}

/** Catches segments in a wrong order, and phases that are not counted from the first. */
TEST_CASE("Shooting over segments and from any of the phases close one motion")
{
  const Parameters parameters = set_1();
  State state = state_of(solution_at(parameters, 45, 32));
  const Shooting plain =
      shoot(parameters, hertz(45), state, {.tolerance = 1e-12, .closed = 1e-10});
  REQUIRE(plain.converged);
  Eighths start(eighths, state);
  for (int k = 1; k < eighths; ++k) {
    start[k] = start[k - 1];
    flow(parameters, hertz(45), {.intervals_per_period = eighths})
        ->advance(k - 1, start[k]);
  }
  for (State& at : start) at.position.rotor.x *= 1 + 1e-4;
  for (const std::optional<int> alone : {std::optional<int>(), std::optional<int>(3)}) {
    Eighths motion = start;
    const Shooting closing = shoot(parameters, hertz(45), motion,
                                   {.tolerance = 1e-11, .closed = 1e-8, .alone = alone});
    INFO(closing.reason);
    REQUIRE(closing.converged);
    const Eigen::VectorXd apart = (vector_of(motion.front()) - vector_of(state))
                                      .cwiseQuotient(state_scales(parameters));
    CHECK(apart.norm() < 1e-6);
    CHECK(multipliers_of(closing.derivative).front().real() ==
          Approx(multipliers_of(plain.derivative).front().real()).epsilon(1e-5));
  }
}
