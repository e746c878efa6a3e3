/** The verdict on a motion, against motions whose kind is known, and its independence of the stepper. */
#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <fstream>
#include <numbers>

#include "model/errors.hpp"
#include "model/number_table.hpp"
#include "scenes/known_attractors.hpp"
#include "scenes/validity.hpp"
#include "stability/shooting.hpp"
#include "support/cases.hpp"

using namespace rotor_stator;
using namespace rotor_stator::tests;

namespace
{

/** A section of the points f(n) in one displacement, n = 0…99. */
std::vector<Displacements> section_of(const std::function<double(int)>& f)
{
  std::vector<Displacements> section;
  for (int n = 0; n < 100; ++n) section.push_back({f(n), 0, 0, 0});
  return section;
}

Verdict verdict(const std::function<double(int)>& f, const Exponent& exponent)
{
  return judge_section(section_of(f), 1, exponent).verdict;
}

/** One oscillator ẍ = a(x, ẋ, t) of angular frequency ω in the first displacement of a state, by
    classical Runge-Kutta with `steps` steps per period, one per output interval. */
TimeStepper oscillator(const std::function<double(double, double, double)>& a,
                       double omega, int steps)
{
  const double h = 2 * std::numbers::pi / omega / steps;
  return {.advance =
              [=](long interval, State& state) {
                using Pair = std::complex<double>;  // x + i ẋ
                const double t = static_cast<double>(interval) * h;
                const auto slope = [&](Pair y, double at) {
                  return Pair(y.imag(), a(y.real(), y.imag(), at));
                };
                const Pair y(state.position.stator.x, state.velocity.stator.x);
                const Pair k_1 = slope(y, t), k_2 = slope(y + 0.5 * h * k_1, t + h / 2);
                const Pair k_3 = slope(y + 0.5 * h * k_2, t + h / 2);
                const Pair k_4 = slope(y + h * k_3, t + h);
                const Pair end = y + h / 6 * (k_1 + 2.0 * k_2 + 2.0 * k_3 + k_4);
                state = {.position = {{end.real(), 0}, {0, 0}},
                         .velocity = {{end.imag(), 0}, {0, 0}}};
              },
          .evaluations = [] { return 0L; }};
}

/** What is said of an oscillator after `skipped` periods, from `periods` more. */
SectionJudgement observed(TimeStepper stepper, double omega, int steps, int skipped,
                          int periods, const VerdictRule& rule)
{
  Neighbours motion(std::move(stepper), steps, Vector8::Ones(),
                    {.position = {{0.1, 0}, {0, 0}}, .velocity = {}});
  std::vector<Displacements> section;
  std::vector<double> rates;
  for (int k = 0; k < skipped + periods; ++k) {
    if (k >= skipped) section.push_back({motion.state().position.stator.x, 0, 0, 0});
    const double growth = motion.advance_one_period();
    if (k >= skipped) rates.push_back(growth * omega / (2 * std::numbers::pi));
  }
  return judge_section(section, 1, exponent_of(rates), rule);
}

AttractorSettings settings()
{
  return read_attractor_scene(SOURCE_DIR "/data/scenes/attractors.toml", "exchanged")
      .settings;
}

}  // namespace

TEST_CASE("Sections of known kinds are told apart")
{
  const Exponent none{-1, 0.1}, zero{0.001, 0.01}, positive{5, 0.5};
  const double golden = (std::sqrt(5) - 1) / 2;
  const auto circle = [&](int n) { return std::cos(2 * std::numbers::pi * golden * n); };
  CHECK(verdict([](int) { return 0.3; }, none) == Verdict::periodic);
  CHECK(verdict([](int n) { return 1e-7 * (n % 7); }, none) == Verdict::periodic);
  CHECK(verdict(circle, zero) == Verdict::quasi_periodic);
  CHECK(verdict(circle, positive) == Verdict::chaotic);
  CHECK(verdict(circle, {5, 2}) == Verdict::undecided);
  CHECK(verdict(circle, {-0.06, 0.01}) == Verdict::undecided);
  CHECK(verdict(circle, {-0.06, 0.03}) == Verdict::quasi_periodic);
  CHECK(verdict(circle, {0.001, 1}) == Verdict::undecided);
  CHECK(verdict(circle, none) == Verdict::undecided);
  for (int k : {2, 5, 16}) {
    const auto judgement =
        judge_section(section_of([&](int n) { return n % k; }), 1, none);
    CHECK(judgement.verdict == Verdict::subharmonic);
    CHECK(judgement.period == k);
    CHECK(judgement.spread == k - 1);
  }
  CHECK(verdict([](int n) { return n % 17; }, none) == Verdict::undecided);
}

TEST_CASE("A few points cannot show a long period")
{
  const std::vector<Displacements> section{{0}, {1}, {0}, {1}, {0}};
  CHECK(judge_section(section, 1, {-1, 0.1}).verdict == Verdict::undecided);
}

TEST_CASE("The standard error of alternating rates shrinks with batches")
{
  std::vector<double> rates;
  for (int k = 0; k < 80; ++k) rates.push_back(k % 2);
  const Exponent exponent = exponent_of(rates);
  CHECK(exponent.value == Approx(0.5));
  CHECK(exponent.error == Approx(0).margin(1e-12));
  const Exponent three = exponent_of({1, 2, 3});
  CHECK(three.value == Approx(2));
  CHECK(three.error == Approx(1 / std::sqrt(3.0)));
}

TEST_CASE("A damped linear oscillator is T-periodic, an undamped one quasi-periodic")
{
  const double omega = 1;
  const auto forced = [](double damping) {
    return [damping](double x, double v, double t) {
      return std::cos(t) - 2 * x - damping * v;
    };
  };
  const auto damped =
      observed(oscillator(forced(0.2), omega, 100), omega, 100, 60, 100, {});
  CHECK(damped.verdict == Verdict::periodic);
  CHECK(damped.exponent.value == Approx(-0.1).epsilon(0.02));
  const auto free = observed(oscillator(forced(0), omega, 100), omega, 100, 60, 400,
                             {.zero_rate = 0.01});
  CHECK(free.verdict == Verdict::quasi_periodic);
  CHECK(std::abs(free.exponent.value) < 1e-3);
}

/** Ueda's oscillator ẍ + 0.05 ẋ + x³ = 7.5 cos t; its exponent 0.1034 is that of Sprott, Chaos and
    Time-Series Analysis (2003), appendix A. */
TEST_CASE("Ueda's oscillator is chaotic with the published exponent")
{
  const auto law = [](double x, double v, double t) {
    return 7.5 * std::cos(t) - 0.05 * v - x * x * x;
  };
  const auto judgement =
      observed(oscillator(law, 1, 200), 1, 200, 50, 2000, {.zero_rate = 0.01});
  CHECK(judgement.verdict == Verdict::chaotic);
  CHECK(judgement.exponent.value == Approx(0.1034).margin(0.01));
  CHECK(judgement.exponent.error < 0.01);
}

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
  CHECK(attractor.judgement.exponent.value == Approx(-slowest).epsilon(0.02));
}

TEST_CASE("On a T-periodic motion the exponent is that of the largest multiplier")
{
  const Parameters parameters = set_1();
  const double frequency = 16;
  const auto attractor =
      attractor_from(parameters, hertz(frequency), static_start(parameters), settings());
  REQUIRE(attractor.periodic());
  const auto map = period_map(parameters, hertz(frequency), attractor.state, 1e-10);
  const double modulus =
      Eigen::MatrixXd(map.derivative).eigenvalues().cwiseAbs().maxCoeff();
  CHECK(attractor.judgement.exponent.value ==
        Approx(std::log(modulus) * frequency).margin(0.1));
}

namespace
{

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
                  << attractor.judgement.exponent.value);
  CHECK(attractor.judgement.verdict == motion.verdict);
  if (attractor.closed()) CHECK(attractor.judgement.period == motion.period);
  return attractor;
}

}  // namespace

/** Would catch a step too long for the contact. */
TEST_CASE("Half the step gives the same verdicts and exponents")
{
  for (const KnownMotion& motion : known_motions) {
    AttractorSettings usual = settings(), half = usual;
    half.transient.stepper.step =
        default_step(
            read_parameters(std::string(SOURCE_DIR "/data/") + motion.set + ".toml")) /
        2;
    const Exponent a = from_rest(motion, usual).judgement.exponent;
    const Exponent b = from_rest(motion, half).judgement.exponent;
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

TEST_CASE("Coexisting motions at 25 Hz are two attractors")
{
  const Parameters parameters = set_1();
  const auto random = [&](int seed) {
    return attractor_from(
        parameters, hertz(25),
        random_state(parameters, hertz(25), static_cast<std::uint64_t>(seed)),
        settings());
  };
  std::vector<Attractor> different;
  for (int seed = 1; seed <= 12 && different.size() < 2; ++seed) {
    const Attractor a = random(seed);
    CHECK(same_attractor(a, a, settings()));
    if (different.empty() || !same_attractor(a, different.front(), settings()))
      different.push_back(a);
  }
  CHECK(different.size() == 2);
}

TEST_CASE("The distance of a motion to itself is zero, to rest one")
{
  const Parameters parameters = set_1();
  Motion motion{8, 0, {}}, rest{8, 0, std::vector<Bodies>(8)};
  for (int k = 0; k < 8; ++k)
    motion.positions.push_back({{1e-5 * k, -1e-5}, {2e-5, 4e-5 * (k % 3)}});
  CHECK(distance(parameters, motion, motion).displacement == 0);
  CHECK(distance(parameters, motion, motion).force == 0);
  CHECK(distance(parameters, rest, motion).displacement == Approx(1));
  CHECK(distance(parameters, rest, motion).force == Approx(1));
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
  CHECK_THROWS_WITH(written("f\tx\n1\n"), Catch::Contains(":2: 1 cells, must be 2"));
  CHECK_THROWS_WITH(written("f\tx\n1\ta\n"), Catch::Contains("\"a\" is not a number"));
  CHECK_THROWS_AS(written("f\tx\n"), BadInput);
  CHECK_THROWS_AS(NumberTable("no such file"), BadInput);
}
