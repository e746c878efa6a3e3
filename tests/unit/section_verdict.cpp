/** The verdict on a section, against sections and oscillators whose kind is known. */
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include "support/catch.hpp"

#include "time/lyapunov.hpp"

using namespace rotor_stator;

namespace {

/** A section of the points f(n) in one displacement, n = 0…99. */
std::vector<Displacements> section_of(const std::function<double(int)>& f)
{
  std::vector<Displacements> section;
  for (int n = 0; n < 100; ++n) section.push_back({f(n), 0, 0, 0});
  return section;
}

SectionKind verdict(const std::function<double(int)>& f, const Exponent& exponent)
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
  TrajectoryPair motion(std::move(stepper), steps, Vector8::Ones(),
                        {.position = {{0.1, 0}, {0, 0}}, .velocity = {}});
  std::vector<Displacements> section;
  std::vector<double> rates;
  for (int k = 0; k < skipped + periods; ++k) {
    if (k >= skipped) section.push_back({motion.state().position.stator.x, 0, 0, 0});
    const double growth = motion.advance_one_period();
    if (k >= skipped) rates.push_back(growth * omega / (2 * std::numbers::pi));
  }
  return judge_section(section, 1, batch_mean(rates), rule);
}

}  // namespace

TEST_CASE("Sections of known kinds are told apart")
{
  const Exponent none{-1, 0.1}, zero{0.001, 0.01}, positive{5, 0.5};
  const double golden = (std::sqrt(5) - 1) / 2;
  const auto circle = [&](int n) { return std::cos(2 * std::numbers::pi * golden * n); };
  CHECK(verdict([](int) { return 0.3; }, none) == SectionKind::periodic);
  CHECK(verdict([](int n) { return 1e-7 * (n % 7); }, none) == SectionKind::periodic);
  CHECK(verdict(circle, zero) == SectionKind::quasi_periodic);
  CHECK(verdict(circle, positive) == SectionKind::chaotic);
  CHECK(verdict(circle, {5, 2}) == SectionKind::undecided);
  CHECK(verdict(circle, {-0.06, 0.01}) == SectionKind::undecided);
  CHECK(verdict(circle, {-0.06, 0.03}) == SectionKind::quasi_periodic);
  CHECK(verdict(circle, {0.001, 1}) == SectionKind::undecided);
  CHECK(verdict(circle, none) == SectionKind::undecided);
  for (int k : {2, 5, 16}) {
    const auto judgement =
        judge_section(section_of([&](int n) { return n % k; }), 1, none);
    CHECK(judgement.verdict == SectionKind::subharmonic);
    CHECK(judgement.period == k);
    CHECK(judgement.spread == k - 1);
  }
  CHECK(verdict([](int n) { return n % 17; }, none) == SectionKind::undecided);
}

TEST_CASE("A few points cannot show a long period")
{
  const std::vector<Displacements> section{{0}, {1}, {0}, {1}, {0}};
  CHECK(judge_section(section, 1, {-1, 0.1}).verdict == SectionKind::undecided);
}

TEST_CASE("The standard error of alternating rates shrinks with batches")
{
  std::vector<double> rates;
  for (int k = 0; k < 80; ++k) rates.push_back(k % 2);
  const Exponent exponent = batch_mean(rates);
  CHECK(exponent.value == Approx(0.5));
  CHECK(exponent.error == Approx(0).margin(1e-12));
  const Exponent three = batch_mean({1, 2, 3});
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
  CHECK(damped.verdict == SectionKind::periodic);
  CHECK(damped.exponent.value == Approx(-0.1).epsilon(0.02));
  const auto free = observed(oscillator(forced(0), omega, 100), omega, 100, 60, 400,
                             {.zero_rate = 0.01});
  CHECK(free.verdict == SectionKind::quasi_periodic);
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
  CHECK(judgement.verdict == SectionKind::chaotic);
  CHECK(judgement.exponent.value == Approx(0.1034).margin(0.01));
  CHECK(judgement.exponent.error < 0.01);
}
