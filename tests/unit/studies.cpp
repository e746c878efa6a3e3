/** Regimes, and pieces of work on several threads. */
#include <atomic>
#include "io/parallel.hpp"
#include "motion/contact.hpp"
#include "motion/regime.hpp"
#include "support/cases.hpp"

using namespace rotor_stator;
using namespace rotor_stator::motion;
using namespace rotor_stator::tests;

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
