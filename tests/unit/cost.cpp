/** What the tables of cost rest on: references, counted operations, fits, and the rivals themselves. No
    time is asserted. */
#include "costs/equal_error.hpp"
#include "support/cases.hpp"

using namespace rotor_stator;
using namespace rotor_stator::costs;
using namespace rotor_stator::motion;
using namespace rotor_stator::tests;

namespace {

const TruthSettings truth_settings{
    .settling = {.stepper = {.method = "rk4", .intervals_per_period = 90},
                 .longest = 12}};

}  // namespace

/** Shooting and harmonic balance share nothing. The rivals converge by the fourth and by the second power of the step. */
TEST_CASE("Harmonic balance and rivals converge to the reference as their order says")
{
  const TrueMotion truth = true_motion(set_1(), 45, truth_settings);
  REQUIRE(truth.periodic);
  CHECK(truth.periodicity_residual < 1e-10);
  CHECK(agreement(set_1(), truth, 512) < 1e-8);
  CHECK(agreement(set_1(), truth, 16) > 1e-6);
  struct Rival {
    Setting coarse;
    double least, most;  ///< ratio of the errors with half the step
  };
  for (const Rival& rival :
       {Rival{{.method = "shooting-rk4",
       .step = 4e-5,
       .transient = 0.3,
       .periodicity_residual = 1e-9},
              6,
              1e3},
        Rival{{.method = "central", .step = 2e-5, .transient = 3}, 3.6, 4.4}}) {
    const auto error = [&](double step) {
      Setting setting = rival.coarse;
      setting.step = step;
      const auto method =
          timed_method({.parameters = set_1(), .frequencies = {45}}, setting);
      method->run();
      const auto found = method->motion(0, 90);
      REQUIRE(found);
      return relative_difference(*found, truth.motion);
    };
    const double ratio = error(rival.coarse.step) / error(rival.coarse.step / 2);
    INFO(rival.coarse.method << ": " << ratio);
    CHECK(ratio > rival.least);
    CHECK(ratio < rival.most);
  }
}

TEST_CASE("Harmonic balance: N of the setting, three transforms or more per evaluation")
{
  const Setting setting{
      .method = "aft", .harmonics = 6, .samples_per_harmonic = 8, .tolerance = 1e-8};
  CHECK(setting.sample_count() == 50);
  const Task task{.parameters = set_1(), .frequencies = {45}};
  const auto aft = timed_method(task, setting);
  aft->run();
  REQUIRE(aft->motion(0, 8));
  const Counts counts = aft->counts();
  CHECK(counts.force_instants % setting.sample_count() == 0);
  const long evaluations = counts.force_instants / setting.sample_count();
  CHECK(evaluations <= 12);
  CHECK(counts.transforms >= 3 * evaluations);
}

namespace {

/** The largest error of a setting over the speeds, apart from the study: the method is run anew and its
    motions are compared with harmonic balance of 256 harmonics. */
double error_apart(const Parameters& parameters, const std::vector<double>& frequencies,
                   const Schedule& schedule)
{
  const auto method = timed_method({parameters, frequencies}, schedule);
  method->run();
  double error = 0;
  for (std::size_t k = 0; k < frequencies.size(); ++k) {
    const auto exact = find_periodic({parameters, hertz(frequencies[k]), 256});
    REQUIRE(exact.found());
    REQUIRE(method->motion(k, 90));
    error = std::max(
        error, relative_difference(*method->motion(k, 90), motion_of(exact.bodies, 90)));
  }
  return error;
}

}  // namespace

TEST_CASE("Below the transition a short transient is a start from which Newton converges")
{
  const Setting setting{.method = "aft",
                        .harmonics = 96,
                        .samples_per_harmonic = 4,
                        .tolerance = 1e-6,
                        .transient = 0.5};
  CHECK(Schedule(setting).text() == "m=96 N>4m tol=1e-06 transient=0.5");
  CHECK(error_apart(set_1(), {9.5, 10, 10.5}, setting) < 1e-3);
}

TEST_CASE("Equal error: what the table calls reached is reached, and aft is its unit")
{
  EqualErrorScene scene{.parameters = set_1(),
                        .frequencies = {40, 41},
                        .range_ends = {60},
                        .targets = {3e-4, 1e-12},
                        .paper_ratios = {9},
                        .candidates = {},
                        .repetitions = 1,
                        .search = 100,
                        .truth = truth_settings};
  const Setting aft{
      .method = "aft", .harmonics = 8, .samples_per_harmonic = 4, .tolerance = 1e-6};
  const Setting rk4{.method = "rk4", .step = 2e-4, .transient = 2};
  /** Cheaper, and not accurate enough. */
  Setting few = aft, coarse = rk4;
  few.harmonics = 1;
  coarse.transient = 0.1;
  scene.candidates = {{"aft", {{few, aft}}}, {"rk4", {{coarse, rk4}}}};
  const std::vector<EqualErrorRow> rows = at_equal_error(
      scene, true_motions(scene.parameters, scene.frequencies, scene.truth));
  REQUIRE(rows.size() == 4);
  CHECK(rows[0].ratio == 1);
  CHECK(rows[2].ratio == rows[2].median / rows[0].median);
  CHECK(rows[0].schedule.text() == "m=8 N>4m tol=1e-06");
  for (const Setting& cheap : {few, coarse})
    CHECK(error_apart(scene.parameters, scene.frequencies, cheap) > 3e-4);
  for (const EqualErrorRow& row : rows) {
    CHECK(row.reached == (row.target == 3e-4));
    CHECK(row.speeds == 2);
    CHECK(row.tried == 2);
    const double error = error_apart(scene.parameters, scene.frequencies, row.schedule);
    CHECK((error <= row.target) == row.reached);
    CHECK(row.displacement == Approx(error).epsilon(0.05));
  }
}

TEST_CASE("Table 2: the RK4 setting reaches the error, and no cheaper one does")
{
  std::vector<Setting> rk4;
  for (double step : {1e-3, 4e-4, 2e-4, 1e-4, 5e-5})
    rk4.push_back({.method = "rk4", .step = step, .transient = 2, .recorded = 90});
  const References references = true_motions(set_1(), {40, 41}, truth_settings);
  const Setting six{.method = "aft", .harmonics = 6, .samples = 32, .paper_sweep = true};
  const Measurement balance = measure(references, six, 1);
  CHECK(balance.displacement > 1e-6);
  CHECK(balance.force_instants % 32 == 0);
  const Setting chosen = cheapest_rk4(rk4, references, balance);
  for (const Setting& setting : rk4) {
    const double error = measure(references, setting, 1).displacement;
    CHECK((error <= balance.displacement) == (setting.step <= chosen.step));
  }
  rk4.resize(1);
  CHECK_THROWS_AS(cheapest_rk4(rk4, references, balance), NoSolution);
}

TEST_CASE("The exponent of a power law is found, through scatter too")
{
  std::vector<double> x, exact, scattered;
  for (int k = 0; k < 9; ++k) {
    x.push_back(std::pow(2.0, k));
    exact.push_back(3e-4 * std::pow(x.back(), 1.7));
    scattered.push_back(exact.back() * (k % 2 == 0 ? 1.05 : 1 / 1.05));
  }
  CHECK(fitted_exponent(x, exact) == Approx(1.7).epsilon(1e-12));
  CHECK(fitted_exponent(x, scattered) == Approx(1.7).margin(0.02));
}

TEST_CASE("Speeds side by side take the steps of each alone and reach its motion")
{
  const Task both{.parameters = set_1(), .frequencies = {30, 45}};
  const Setting setting{.method = "rk4-lanes", .step = 5e-5, .transient = 1};
  const auto lanes = timed_method(both, setting);
  lanes->run();
  const std::vector<double> seconds = lanes->seconds_by_speed();
  REQUIRE(seconds.size() == 2);
  CHECK(seconds[0] > 0);
  long evaluations = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    Task one = both;
    one.frequencies = {both.frequencies[k]};
    const auto alone = timed_method(one, setting);
    alone->run();
    evaluations += alone->counts().force_instants;
    const auto expected = alone->motion(0, 90), found = lanes->motion(k, 90);
    REQUIRE(expected);
    REQUIRE(found);
    CHECK(relative_difference(*found, *expected) == 0);
  }
  CHECK(lanes->counts().force_instants == evaluations);
}

TEST_CASE("A schedule gives each speed its own setting, and its steps are counted once")
{
  const Schedule schedule({Setting{.method = "rk4", .step = 1e-4, .transient = 0.25},
                           Setting{.method = "rk4", .step = 5e-5, .transient = 0.25}});
  CHECK(schedule.text() == "step=5e-05..0.0001 transient=0.25");
  const auto rk4 =
      timed_method({.parameters = set_1(), .frequencies = {30, 31}}, schedule);
  rk4->run();
  const long steps =
      std::lround(8 * std::ceil(1 / (30 * 1e-4)) + 8 * std::ceil(1 / (31 * 5e-5)));
  CHECK(rk4->counts().force_instants == 4 * steps);
  rk4->run();
  CHECK(rk4->counts().force_instants == 4 * steps);
}
