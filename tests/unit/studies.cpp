/** Regimes, and pieces of work on several threads. */
#include <atomic>
#include "io/parallel.hpp"
#include "motion/contact.hpp"
#include "motion/regime.hpp"
#include "support/cases.hpp"

using namespace rotor_stator;
using namespace rotor_stator::motion;
using namespace rotor_stator::tests;

/** The closed form knows nothing of clearance and Hertz's law. The narrower the clearance, the narrower is the
    band around it in which integration loses contact; below it gravity holds the force, above it the force turns with the rotor.
    Would catch a wrong ratio of the joint's forces: 3 % in speed is 7 % in the unbalance. */
TEST_CASE(
    "Contact is lost at the speed of the closed form, in a band that closes with the "
    "clearance")
{
  Parameters machine = set_1();
  const double loss =
      equal_force_speeds(machine, joint_resonance(machine)).front() / angular(1);
  CHECK(loss == Approx(13.155).epsilon(1e-3));
  const auto at = [&](double clearance, double ratio) {
    machine.bearing.clearance = clearance;
    return regimes_of(machine, {ratio * loss}, {1, 4, 0.5, 1, 2048}).front();
  };
  CHECK(at(2e-5, 0.97).contact < 1);
  CHECK(at(2e-5, 1.03).contact < 1);
  CHECK(at(1e-6, 1).contact < 1);
  const Regime below = at(1e-6, 0.97), above = at(1e-6, 1.03);
  CHECK(below.contact == 1);
  CHECK(below.turns == 0);
  CHECK(above.contact == 1);
  CHECK(above.turns == 1);
}

TEST_CASE(
    "A force that turns with the rotor, one that swings, and one that is zero at times")
{
  std::vector<Vec2> turning, swinging;
  for (int k = 0; k < 64; ++k) {
    const double phase = 4 * std::numbers::pi * k / 64;
    turning.push_back({std::cos(phase), std::sin(phase)});
    swinging.push_back({std::cos(phase), 1.1 + std::sin(phase)});
  }
  CHECK(turns_of(turning) == 2);
  CHECK(turns_of(swinging) == 0);
  for (int k = 5; k < 12; ++k) turning[static_cast<std::size_t>(k)] = {0, 0};
  CHECK(turns_of(turning) == 2);
  CHECK(turns_of({{0, 0}, {0, 0}}) == 0);
}

TEST_CASE("Higher harmonics of a known motion")
{
  Motion motion{32, 0, {}};
  for (int k = 0; k < 32; ++k) {
    const double phase = 2 * std::numbers::pi * k / 32;
    motion.positions.push_back(
        {{std::cos(phase), 5.0}, {2 * std::cos(phase), 0.6 * std::cos(3 * phase)}});
  }
  CHECK(higher_harmonics(motion).all == Approx(0.3));
  CHECK(higher_harmonics(motion).h_3 == Approx(0.3));
  CHECK(higher_harmonics(motion).h_2 == Approx(0).margin(1e-12));
}

TEST_CASE("Passages are counted around the end of the two periods")
{
  const Eigen::MatrixXd force{{1, 0, 0}, {0, 1, 0}, {0, 1, 0}, {1, 0, 0}};
  CHECK(passages_per_ball(force) == std::vector<int>{1, 1, 0});
}

TEST_CASE("At 45 Hz each ball of set 1 is passed once per 2T, at 13.4 Hz not")
{
  const RegimeSettings settings{.step_over_default = 2,
                                .longest = 4,
                                .window = 0.5,
                                .average = 1,
                                .points_per_period = 64};
  const auto regimes = regimes_of(set_1(), {45, 13.4}, settings);
  const Regime &high = regimes[0], &middle = regimes[1];
  CHECK(high.passed_once == 1);
  CHECK(high.contact == 1);
  CHECK(high.all < 0.01);
  CHECK(high.turns == 1);
  CHECK(middle.contact < 1);
  CHECK_FALSE(middle.periodic);
}

/** Would catch an order or a result that depends on the threads, and an exception that stays in one. */
TEST_CASE(
    "Pieces are computed in order by any number of threads, and the first failure is told")
{
  const auto squares =
      computed_in_parallel("squares", 100, [](std::size_t k) { return k * k; });
  REQUIRE(squares.size() == 100);
  for (std::size_t k = 0; k < 100; ++k) CHECK(squares[k] == k * k);
  std::atomic<int> calls = 0;
  const auto failing = [&](std::size_t piece) {
    ++calls;
    if (piece % 10 == 7) throw std::runtime_error("piece " + std::to_string(piece));
  };
  CHECK_THROWS_WITH(in_parallel("failing", 10000, failing), "piece 7");
  CHECK(calls < 5000);
}
