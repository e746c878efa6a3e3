/** Attractors of the machine: exponents against closed form and multipliers, verdicts against other steps
   and methods, coexistence, and what is read back from tables. */
#include <cmath>
#include <fstream>
#include <numbers>
#include "support/catch.hpp"

#include "io/errors.hpp"
#include "io/number_table.hpp"
#include "motion/attractor.hpp"
#include "stability/eigenvalues.hpp"
#include "stability/period_map.hpp"
#include "support/cases.hpp"

using namespace rotor_stator;
using namespace rotor_stator::motion;
using namespace rotor_stator::tests;

namespace {

AttractorSettings settings()
{
  return {.stepper = {.method = "rk4", .intervals_per_period = 64},
          .longest = 6,
          .least = 5,
          .chaotic = 10,
          .most = 100};
}

}  // namespace

TEST_CASE("Without contact the exponent is the slower body's damping")
{
  Parameters parameters = set_1();
  parameters.bearing.clearance = 1;
  const auto attractor =
      attractor_from(parameters, hertz(30), static_start(parameters), settings());
  CHECK(attractor.periodic());
  const double slowest =
      std::min(parameters.rotor.damping_ratio * parameters.rotor.natural_frequency,
               parameters.stator.damping_ratio * parameters.stator.natural_frequency);
  CHECK(attractor.exponent.value == Approx(-slowest).epsilon(0.02));
}

TEST_CASE("On a T-periodic motion the exponent is that of the largest multiplier")
{
  const Parameters parameters = set_1();
  const double frequency = 16;
  const auto attractor =
      attractor_from(parameters, hertz(frequency), static_start(parameters), settings());
  REQUIRE(attractor.periodic());
  const auto map = period_map(parameters, hertz(frequency), attractor.state, 1e-10);
  const double modulus = eigenvalues(map.derivative).cwiseAbs().maxCoeff();
  CHECK(attractor.exponent.value == Approx(std::log(modulus) * frequency).margin(0.1));
}

/** Would catch a sum over the wrong number of periods. */
TEST_CASE("The exponent from the multipliers of 2T is that of a neighbour")
{
  const Parameters parameters = set_1();
  AttractorSettings longer = settings();
  longer.least = 40;
  for (double frequency : {20.0, 20.25}) {
    const Attractor doubled =
        attractor_from(parameters, hertz(frequency), static_start(parameters), longer);
    REQUIRE(doubled.period == 2);
    const Exponent sharp = closed_exponent(doubled, parameters, hertz(frequency), {});
    INFO(sharp.value << " +- " << sharp.error << ", neighbour " << doubled.exponent.value
                     << " +- " << doubled.exponent.error);
    CHECK(sharp.error < 0.01);
    CHECK(std::abs(sharp.value - doubled.exponent.value) <
          0.1 + 3 * doubled.exponent.error);
  }
}

TEST_CASE("A machine without loads rests, and that is a motion of period T")
{
  Parameters parameters = set_1();
  parameters.gravity = parameters.unbalance = 0;
  const auto attractor = attractor_from(
      parameters, hertz(30), random_state(parameters, hertz(30), 1), settings());
  CHECK(attractor.periodic());
  CHECK(attractor.amplitude[2] < 1e-9);
}

namespace {

struct KnownMotion {
  const char* set;
  double frequency;
  Verdict verdict;
  int period;  ///< k of a closed motion
};
const KnownMotion known_motions[] = {
    {"set1", 13, Verdict::chaotic, 0},  {"set1", 20, Verdict::subharmonic, 2},
    {"set1", 30, Verdict::periodic, 1}, {"set1", 54, Verdict::subharmonic, 2},
    {"set2", 10, Verdict::chaotic, 0},  {"set2", 45, Verdict::periodic, 1}};

Attractor from_rest(const KnownMotion& motion, const AttractorSettings& settings)
{
  const Parameters parameters =
      read_parameters(std::string(SOURCE_DIR "/data/") + motion.set + ".toml");
  const Attractor attractor = attractor_from(parameters, hertz(motion.frequency),
                                             static_start(parameters), settings);
  INFO(motion.set << " " << motion.frequency << " Hz, exponent "
                  << attractor.exponent.value);
  CHECK(attractor.verdict == motion.verdict);
  if (attractor.closed()) CHECK(attractor.period == motion.period);
  return attractor;
}

}  // namespace

/** Would catch a step too long for the contact. */
TEST_CASE("Half the step gives the same verdicts and exponents")
{
  for (const KnownMotion& motion : known_motions) {
    AttractorSettings usual = settings(), half = usual;
    half.stepper.step = default_step(read_parameters(std::string(SOURCE_DIR "/data/") +
                                                     motion.set + ".toml")) /
                        2;
    const Exponent a = from_rest(motion, usual).exponent;
    const Exponent b = from_rest(motion, half).exponent;
    CHECK(a.value == Approx(b.value).margin(5 * std::hypot(a.error, b.error)));
  }
}

/** The kind of a section only: an adaptive stepper takes other steps for the neighbour. */
TEST_CASE("An adaptive method of order 8 finds the same sections closed")
{
  SteadySettings order_8;
  order_8.stepper = {.method = "rk8pd", .intervals_per_period = 8, .tolerance = 1e-11};
  order_8.longest = 8;
  order_8.shown_periods = 32;
  for (const KnownMotion& motion : known_motions) {
    const Parameters parameters =
        read_parameters(std::string(SOURCE_DIR "/data/") + motion.set + ".toml");
    const SteadyState steady = steady_state(parameters, hertz(motion.frequency),
                                            static_start(parameters), order_8);
    std::vector<Displacements> section;
    for (std::size_t k = 0; k < steady.states.size(); k += 8) {
      const Bodies& q = steady.states[k].position;
      section.push_back({q.stator.x, q.stator.y, q.rotor.x, q.rotor.y});
    }
    const auto judgement = judge_section(section, 1e-5, {1, 0.1});
    INFO(motion.set << " " << motion.frequency << " Hz, spread " << judgement.spread_k);
    CHECK(judgement.verdict == motion.verdict);
    if (motion.period > 0) CHECK(judgement.period == motion.period);
  }
}

TEST_CASE("Random states repeat with the seed and differ between seeds")
{
  const Parameters parameters = set_1();
  const auto state = [&](int seed) {
    return vector_of(
        random_state(parameters, hertz(30), static_cast<std::uint64_t>(seed)));
  };
  CHECK(state(1) == state(1));
  CHECK((state(1) - state(2)).norm() > 0);
}

TEST_CASE("Coexisting motions at 25 and 25.25 Hz are two attractors, whatever the start")
{
  /** Seven starts reach each motion twice at least. Which of them ended on one motion follows from the
      states alone: those of a closed motion meet at phase 0, at once or a period later. */
  const Parameters parameters = set_1();
  const Vector8 sizes = state_scales(parameters);
  for (double frequency : {25.0, 25.25}) {
    const auto later = [&](const State& state) {
      return period_map(parameters, hertz(frequency), state, 1e-11).end;
    };
    const auto meet = [&](const State& a, const State& b) {
      return (vector_of(a) - vector_of(b)).cwiseQuotient(sizes).norm() < 1e-4;
    };
    std::vector<Attractor> reached;
    for (std::uint64_t seed = 5; seed <= 11; ++seed)
      reached.push_back(attractor_from(parameters, hertz(frequency),
                                       random_state(parameters, hertz(frequency), seed),
                                       settings()));
    int together = 0, apart = 0;
    for (std::size_t i = 0; i < reached.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const State &a = reached[i].state, &b = reached[j].state;
        const bool one = meet(a, b) || meet(a, later(b));
        ++(one ? together : apart);
        INFO(frequency << " Hz, starts " << i << " and " << j);
        CHECK(same_attractor(reached[i], reached[j], settings()) == one);
      }
    /** Two groups of seven: 2 + 5 or 3 + 4. */
    CHECK(together + apart == 21);
    CHECK((apart == 10 || apart == 12));
  }
}

TEST_CASE(
    "The distance of a motion to itself is zero, to rest one, and blind to the mean")
{
  Motion motion{8, 0, {}}, rest{8, 0, std::vector<Bodies>(8)};
  for (int k = 0; k < 8; ++k)
    motion.positions.push_back({{1e-5 * k, -1e-5}, {2e-5, 4e-5 * (k % 3)}});
  CHECK(rms_difference(motion, motion) == 0);
  CHECK(rms_difference(rest, motion) == Approx(1));
  Motion sagging = motion;
  for (Bodies& q : sagging.positions) q.stator.y -= 1e-3, q.rotor.y -= 1e-3;
  CHECK(rms_difference(sagging, motion) == Approx(0).margin(1e-12));
  CHECK(relative_difference(sagging, motion) > 10);
}

TEST_CASE("A table of numbers is read back, and a damaged one refused with its line")
{
  const std::string file = PROGRAM_DIR "/number_table_test.tsv";
  const auto written = [&](const std::string& content) {
    std::ofstream(file) << content;
    return NumberTable(file);
  };
  const NumberTable table = written("# a header\nf\tx\n1\t-2.5e-3\n\n3\t4\n");
  CHECK(table.rows() == 2);
  CHECK(table.at(0, "x") == -2.5e-3);
  CHECK(table.at(1, "f") == 3);
  CHECK_THROWS_AS(table.at(0, "y"), BadInput);
  CHECK_THROWS_WITH(written("f\tx\n1\n"), contains(":2: 1 cells, must be 2"));
  CHECK_THROWS_WITH(written("f\tx\n1\ta\n"), contains("'a' is not a finite number"));
  CHECK_THROWS_AS(written("f\tx\n"), BadInput);
  CHECK_THROWS_AS(NumberTable("no such file"), BadInput);
}
