/** Verdicts on solutions, against motions that another shooting has closed. */
#include "motion/judge.hpp"
#include "support/cases.hpp"
#include "time/flow.hpp"
#include "time/shooting.hpp"

using namespace rotor_stator;
using namespace rotor_stator::motion;
using namespace rotor_stator::tests;

namespace {

motion::Verdict judged(const Parameters& parameters, double frequency, int harmonics)
{
  const auto solution = find_periodic({parameters, hertz(frequency), harmonics});
  REQUIRE(solution.found());
  return judge(parameters, solution);
}

Parameters case_of(const char* name)
{
  return read_parameters(std::string(SOURCE_DIR "/tests/cases/") + name + ".toml");
}

}  // namespace

/** The multipliers of an independent shooting. Catches another motion, 2 to 4 % away, that
    closes more easily. */
TEST_CASE("What grows 32,177 times in a turn is closed, and called unstable")
{
  const motion::Verdict first = judged(case_of("grows_32177"), 71.23, 500);
  CHECK(std::string(first.word()) == "unstable");
  CHECK(first.floquet.largest() == Approx(32177).epsilon(1e-4));
  CHECK(first.distance.largest < 1e-5);
  const motion::Verdict second = judged(case_of("grows_17565"), 77.32, 500);
  CHECK(std::string(second.word()) == "unstable");
  CHECK(second.floquet.largest() == Approx(17565).epsilon(1e-4));
  CHECK(second.distance.largest < 1e-5);
}

/** A stable motion is 2.13e-4 away, an unstable one 1.76e-4. */
TEST_CASE("Beside two motions of opposite kinds that are as near nothing is decided")
{
  const motion::Verdict verdict = judged(case_of("two_motions"), 40.953, 11);
  CHECK(std::string(verdict.word()) == "undecided");
  CHECK(verdict.reason.find("two motions") != std::string::npos);
}

TEST_CASE("A machine at rest is stable, and its distances are numbers")
{
  Parameters parameters = set_1();
  parameters.unbalance = 0;
  parameters.gravity = 0;
  const motion::Verdict verdict = judged(parameters, 45, 6);
  CHECK(verdict.stable());
  CHECK_FALSE(verdict.moves);
  CHECK(verdict.distance.largest == 0);
  CHECK(verdict.distance.rms == 0);
}

/** Catches segments in a wrong order, and phases that are not counted from the first. */
TEST_CASE("Shooting over segments and from any of the phases close one motion")
{
  const Parameters parameters = set_1();
  const auto solution = find_periodic({parameters, hertz(45), 32});
  REQUIRE(solution.found());
  State state = state_of(solution);
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
