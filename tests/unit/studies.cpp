/** Regimes, the judgement of a candidate, and studies that go on where they were interrupted. */
#include <atomic>
#include <cmath>
#include <fstream>
#include <numbers>
#include "support/catch.hpp"

#include "continuation/sweep.hpp"
#include "io/journal.hpp"
#include "io/parallel.hpp"
#include "motion/contact.hpp"
#include "studies/clearance_stiffness.hpp"
#include "studies/identification.hpp"
#include "support/cases.hpp"
#include "support/command.hpp"

using namespace rotor_stator;
using namespace rotor_stator::studies;
using namespace rotor_stator::motion;
using namespace rotor_stator::tests;

namespace {

const ClaimRule rule{.low_to = 10,
                     .middle_to = 19,
                     .multi_harmonic = 0.05,
                     .paper_peak = 50,
                     .peak_width = 10,
                     .within = 0.1};

/** A regime as the paper describes it: loss of contact and many harmonics from 10 to 19 Hz. */
Regime as_the_paper_says(double frequency)
{
  const bool middle = frequency > 10 && frequency <= 19;
  Regime regime{};
  regime.frequency = frequency;
  regime.periodic = true;
  regime.contact = middle ? 0.8 : 1.0;
  regime.higher_harmonics = middle ? 0.2 : 0.01;
  regime.passed_once = true;
  regime.passages = 1;
  regime.amp_x_r = 1 / (1 + std::pow(frequency - 50, 2));
  return regime;
}

std::vector<Regime> sixty_speeds()
{
  std::vector<Regime> regimes;
  for (int f = 1; f <= 60; ++f) regimes.push_back(as_the_paper_says(f));
  return regimes;
}

}  // namespace

TEST_CASE("A candidate that is as the paper says scores 1")
{
  const ClaimScore j = score(sixty_speeds(), rule);
  CHECK(j.f_peak == Approx(50));
  CHECK(j.f_loss_first == 11);
  CHECK(j.f_loss_last == 19);
  CHECK(j.passages == Approx(1));
  CHECK(j.score == Approx(1));
}

TEST_CASE("Loss of contact elsewhere, a shifted peak and a second passage cost score")
{
  std::vector<Regime> regimes = sixty_speeds();
  regimes[24].contact = 0.9;        // 25 Hz
  regimes[39].passed_once = false;  // 40 Hz
  for (Regime& r : regimes) r.amp_x_r = 1 / (1 + std::pow(r.frequency - 45, 2));
  const ClaimScore j = score(regimes, rule);
  CHECK(j.c1 == Approx(0.5));
  CHECK(j.c4 == 1);
  CHECK(j.c5 == Approx(9.0 / 10));
  CHECK(j.c6 == Approx(40.0 / 41));
  CHECK(j.c10 == Approx(40.0 / 41));
  CHECK(j.f_loss_last == 25);
}

TEST_CASE("Higher harmonics of a known motion")
{
  Motion motion{32, 0, {}};
  for (int k = 0; k < 32; ++k) {
    const double phase = 2 * std::numbers::pi * k / 32;
    motion.positions.push_back(
        {{std::cos(phase), 5.0}, {2 * std::cos(phase), 0.6 * std::cos(3 * phase)}});
  }
  CHECK(higher_harmonics(motion) == Approx(0.3));
}

TEST_CASE("Passages are counted around the end of the two periods")
{
  const std::vector<std::vector<double>> force{
      {1, 0, 0}, {0, 1, 0}, {0, 1, 0}, {1, 0, 0}};
  CHECK(passages_per_ball(force) == std::vector<int>{1, 1, 0});
}

TEST_CASE("At 45 Hz each ball of set 1 is passed once per 2T, at 13.4 Hz not")
{
  const RegimeSettings settings{
      .step_over_default = 2, .longest = 4, .window = 0.5, .points_per_period = 64};
  const Regime high = regime_at(set_1(), 45, settings);
  CHECK(high.passed_once);
  CHECK(high.permanent_contact());
  CHECK(high.higher_harmonics < 0.01);
  const Regime middle = regime_at(set_1(), 13.4, settings);
  CHECK_FALSE(middle.permanent_contact());
  CHECK_FALSE(middle.periodic);
}

TEST_CASE("An interrupted study goes on where it was, and a changed one starts anew")
{
  const Scratch scratch;
  struct Square {
    int number;
    double square;
    bool operator==(const Square&) const = default;
  };
  std::atomic<int> calls = 0;
  const auto squares = [&](std::size_t piece) {
    ++calls;
    const int k = static_cast<int>(piece);
    return std::vector<Square>(piece % 3, {k, 0.1 * k * k});
  };
  Study study{.name = "squares",
              .journal = scratch.path("journal"),
              .stamp = "squares of small numbers",
              .pieces = 20};
  const auto records = run_study<Square>(study, squares);
  CHECK(calls == 20);
  CHECK(records[6].empty());
  CHECK(records[7] == std::vector<Square>{{7, 0.1 * 49}});
  CHECK(records[8].size() == 2);

  /** Five pieces are lost, and the last kept line is cut off in the middle. */
  std::string journal = read_whole(study.journal);
  for (int lines = 0; lines < 5; ++lines)
    journal.erase(journal.rfind('\n', journal.size() - 2) + 1);
  journal.pop_back();
  std::ofstream(study.journal) << journal;
  calls = 0;
  CHECK(run_study<Square>(study, squares) == records);
  CHECK(calls == 6);

  study.stamp = "other numbers";
  calls = 0;
  run_study<Square>(study, squares);
  CHECK(calls == 20);
}

TEST_CASE("A study that fails says why, and keeps what it has")
{
  const Scratch scratch;
  const Study study{.name = "failing",
                    .journal = scratch.path("journal"),
                    .stamp = "stamp",
                    .pieces = 4};
  const auto fourth = [](std::size_t piece) {
    if (piece == 3) throw std::runtime_error("the fourth piece");
    return std::vector<char>{'a'};
  };
  CHECK_THROWS_WITH(run_study<char>(study, fourth), "the fourth piece");
  CHECK(read_whole(study.journal).find("0 61\n") != std::string::npos);
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

TEST_CASE("A point of the parametric study agrees with the paper's set 1")
{
  const GridPoint point =
      summary(set_1(), sweep(set_1(), angular(std::vector{45.0, 48.0, 50.0, 52.0}), 6));
  CHECK(point.missed == 0);
  CHECK(point.peak.frequency == Approx(50).margin(0.5));
  CHECK(point.peak.amplitude == Approx(12.7e-3).epsilon(0.01));
  CHECK(point.f_loss_first == -1);
}
