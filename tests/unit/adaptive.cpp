/** The error estimate against true errors: of small oscillators against many harmonics, of the bearing
    against shooting; and the choice of m by it. */
#include "support/catch.hpp"

#include "continuation/arc_length.hpp"
#include "motion/adaptive.hpp"
#include "motion/other_starts.hpp"
#include "support/cases.hpp"
#include "support/command.hpp"
#include "time/shooting.hpp"

using namespace rotor_stator;
using namespace rotor_stator::motion;
using namespace rotor_stator::tests;

namespace {

constexpr double least_effectivity = 0.3, most_effectivity = 10;

/** The unknowns themselves are observed. */
ObservedProblem observed(const Oscillator& oscillator)
{
  return {[oscillator](int samples) { return oscillator.problem(samples); },
          [](const PeriodicMotion& motion) {
            return Eigen::MatrixXd(
                motion.x.reshaped(motion.force.rows(), motion.force.cols()));
          }};
}

PeriodicMotion solved(const ObservedProblem& problem, double omega,
                      const Eigen::VectorXd& start, int harmonics, int samples)
{
  Balance balance(problem.problem(samples), harmonics);
  PeriodicMotion motion =
      solve(balance, omega, resize_harmonics(start, balance.problem().dofs, harmonics));
  REQUIRE(motion.found());
  motion.bodies = problem.series(motion);
  return motion;
}

void check_estimate(const ObservedProblem& problem, const PeriodicMotion& coarse,
                    const PeriodicMotion& fine)
{
  const ErrorEstimate estimate = estimate_error(problem, coarse).estimate;
  const double error = series_difference(coarse.bodies, fine.bodies);
  INFO("m = " << coarse.harmonics.count() << ", omega = " << coarse.omega << ": estimate "
              << estimate.displacement << ", error " << error);
  CHECK(estimate.settled);
  CHECK(estimate.displacement > least_effectivity * error);
  CHECK(estimate.displacement < most_effectivity * error);
}

AdaptiveMotion adapted(double frequency, const AdaptiveSettings& settings)
{
  return solve_adaptively(set_1(), hertz(frequency), settings);
}

/** One period of the exact motion that shooting finds from a solution. */
Motion exact_motion(const PeriodicMotion& solution, int points)
{
  constexpr double tolerance = 1e-13;
  State state = state_of(solution);
  const Shooting shooting =
      shoot(set_1(), solution.omega, state, {.tolerance = tolerance, .closed = 1e-9});
  INFO(shooting.reason);
  REQUIRE(shooting.converged);
  return one_period(set_1(), solution.omega, state,
                    {.intervals_per_period = points, .tolerance = tolerance});
}

double true_error(const PeriodicMotion& solution)
{
  constexpr int points = 1024;
  return relative_difference(motion_of(solution.bodies, points),
                             exact_motion(solution, points));
}

}  // namespace

TEST_CASE("Duffing: the estimate is the error against 161 harmonics")
{
  const ObservedProblem problem = observed(duffing());
  for (double omega : {0.25, 0.6, 1.0}) {
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(1);
    const PeriodicMotion fine = solved(problem, omega, rest, 161, 2048);
    for (int m : {1, 3, 5})
      check_estimate(problem, solved(problem, omega, rest, m, 64), fine);
  }
}

TEST_CASE("Unilateral spring: the estimate is the error against 161 harmonics")
{
  const ObservedProblem problem = observed(two_masses_unilateral());
  Balance coarse(problem.problem(1024), 7);
  const Branch branch = follow_branch(
      coarse, 0.59, 0.7, Eigen::VectorXd::Zero(coarse.unknowns()),
      {.newton = {}, .speed_scale = 1, .arc_unknown_scale = 1, .most_step = 0.02});
  REQUIRE(branch.covered);
  const PeriodicMotion start = solved(problem, 0.7, branch.points.back().motion.x, 7, 64);
  const PeriodicMotion fine = solved(problem, 0.7, start.x, 161, 4096);
  /** A spring that sets in with a step of stiffness asks for many samples. */
  for (int m : {7, 11, 21, 41})
    check_estimate(problem, solved(problem, 0.7, fine.x, m, 1024), fine);
}

TEST_CASE("Bearing: the estimate is the distance to the motion that shooting finds")
{
  for (double frequency : {6.0, 30.0, 45.0})
    for (int m : {6, 12, 24, 48}) {
      const PeriodicMotion solution = search_periodic({set_1(), hertz(frequency), m});
      REQUIRE(solution.found());
      const ErrorEstimate estimate = estimate_error(set_1(), solution);
      const double error = true_error(solution);
      INFO(frequency << " Hz, m = " << m << ": estimate " << estimate.displacement
                     << ", error " << error);
      CHECK(estimate.settled);
      CHECK(estimate.displacement > least_effectivity * error);
      CHECK(estimate.displacement < most_effectivity * error);
    }
}

TEST_CASE("The chosen number of harmonics keeps the tolerance, and not by far")
{
  for (double frequency : {6.0, 30.0, 45.0}) {
    int fewer = 0;
    for (double tolerance : {1e-3, 1e-5}) {
      const AdaptiveMotion at = adapted(frequency, {.tolerance = tolerance});
      INFO(frequency << " Hz, tolerance " << tolerance << ": " << at.end);
      REQUIRE(at.reached);
      CHECK(at.motion.error->displacement <= tolerance);
      CHECK(true_error(at.motion) < tolerance / least_effectivity);
      CHECK(at.motion.harmonics.count() > fewer);
      fewer = at.motion.harmonics.count();
    }
    CHECK(fewer < 300);
  }
}

/** Catches a tolerance that bounds only the largest error over the largest displacement: at 3 Hz the sag is
    fifteen times the vibration, and eight harmonics are 0.6 % off by that and 10 % by the rms. */
TEST_CASE("The tolerance bounds the rms about the mean too")
{
  const AdaptiveMotion at = adapted(3, {.tolerance = 1e-2});
  REQUIRE(at.reached);
  const Motion exact = exact_motion(at.motion, 1024);
  CHECK(rms_difference(motion_of(at.motion.bodies, 1024), exact) <
        1e-2 / least_effectivity);
}

TEST_CASE("Without contact the first harmonics are enough")
{
  Parameters parameters = set_1();
  parameters.bearing.clearance = 1;
  const AdaptiveMotion at = solve_adaptively(parameters, hertz(30), {.tolerance = 1e-8});
  CHECK(at.reached);
  CHECK(at.motion.harmonics.count() == AdaptiveSettings{}.first_harmonics);
  CHECK(at.motion.error->displacement < 1e-12);
}

TEST_CASE("A tolerance out of reach ends with where and why")
{
  const AdaptiveMotion at = adapted(6, {.tolerance = 1e-8, .most_harmonics = 30});
  CHECK(at.motion.found());
  CHECK_FALSE(at.reached);
  CHECK(at.motion.error->displacement > 1e-8);
  CHECK(at.end.find("with 30 harmonics is estimated as") != std::string::npos);
}

/** Catches an estimate that hides a resonance behind a small residual, or forgets what the number
    of samples does. */
TEST_CASE("Speed by speed the estimate is the error, and within the tolerance")
{
  for (const auto& [from, tolerance] :
       {std::pair(2.0, 1e-3), std::pair(6.0, 1e-2), std::pair(21.0, 1e-3),
        std::pair(28.0, 1e-3), std::pair(40.0, 1e-3), std::pair(45.0, 1e-6)}) {
    for (int k = 0; k < 4; ++k) {
      const double frequency = from + 0.5 * k;
      const AdaptiveMotion at = adapted(frequency, {.tolerance = tolerance});
      INFO(frequency << " Hz, tolerance " << tolerance << ": " << at.end);
      REQUIRE(at.reached);
      const Motion exact = exact_motion(at.motion, 1024),
                   found = motion_of(at.motion.bodies, 1024);
      const double displacement = relative_difference(found, exact),
                   rms = rms_difference(found, exact);
      CHECK(displacement < tolerance);
      CHECK(rms < tolerance);
      CHECK(displacement < 1.5 * at.motion.error->displacement);
      CHECK(rms < 1.5 * at.motion.error->rms);
    }
  }
}

/** At 15 and 24 Hz few harmonics lead nowhere from quasi-static contact. */
TEST_CASE("Where quasi-static contact is no start, short time integration is a cheap one")
{
  for (double frequency : {15.0, 24.0}) {
    INFO(frequency << " Hz");
    const AdaptiveMotion at = adapted(frequency, {.tolerance = 1e-3});
    REQUIRE(at.reached);
    CHECK(at.motion.start == "short time integration");
    CHECK(at.motion.error->harmonics > 0);  // estimated, by no long integration
    CHECK(at.force_samples < 300000);
    CHECK(relative_difference(motion_of(at.motion.bodies, 1024),
                              exact_motion(at.motion, 1024)) < 1e-3 / least_effectivity);
  }
}

TEST_CASE("The choice is the same at every call")
{
  const AdaptiveMotion a = adapted(24, {.tolerance = 1e-4}),
                       b = adapted(24, {.tolerance = 1e-4});
  CHECK(a.motion.harmonics.count() == b.motion.harmonics.count());
  CHECK(a.motion.x == b.motion.x);
  CHECK(a.force_samples == b.force_samples);
}

TEST_CASE("At most twice the work of the best fixed number of harmonics")
{
  for (double frequency : {30.0, 45.0}) {
    const AdaptiveMotion at = adapted(frequency, {.tolerance = 1e-5});
    REQUIRE(at.reached);
    const double error = true_error(at.motion);
    const Motion exact = exact_motion(at.motion, 1024);
    long least = 0;
    for (int m = 8; m < 8 * at.motion.harmonics.count(); m += 2) {
      const PeriodicMotion fixed = find_near_contact({set_1(), hertz(frequency), m});
      if (!fixed.found()) continue;
      if (relative_difference(motion_of(fixed.bodies, 1024), exact) > error) continue;
      if (least == 0 || fixed.force_samples < least) least = fixed.force_samples;
    }
    INFO(frequency << " Hz: " << at.force_samples << " against " << least);
    REQUIRE(least > 0);
    CHECK(at.force_samples <= 2 * least);
  }
}

TEST_CASE("explore: a tolerance chooses m and says the error, or why not")
{
  const std::string orbit =
      "explore orbit data/set1.toml --frequency 45 --points 64 --method aft ";
  const Outcome chosen = run_program(orbit + "--tolerance 1e-5");
  REQUIRE(chosen.status == 0);
  CHECK(chosen.out.find("\n# error_largest: ") != std::string::npos);
  CHECK(chosen.out.find("\n# harmonics: 6\n") == std::string::npos);
  const Outcome given = run_program(orbit + "--tolerance 1e-2 --harmonics 6");
  REQUIRE(given.status == 0);
  CHECK(given.out.find("\n# harmonics: 6\n") != std::string::npos);
  CHECK(given.out.find("\n# error_largest: ") != std::string::npos);
  const Outcome missed = run_program(orbit + "--tolerance 1e-5 --harmonics 6");
  CHECK(missed.status == 3);
  CHECK(missed.out.empty());
  CHECK(missed.err.find("tolerance 1e-05 not reached at 45 Hz: the error with 6") !=
        std::string::npos);
}
