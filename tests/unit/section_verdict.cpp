/** Sections and growth rates, against sections and oscillators whose kind is known. */
#include "support/cases.hpp"
#include "time/trajectory_pair.hpp"

using namespace rotor_stator;

namespace {

/** A section of the points f(n) in one displacement, n = 0…99. */
std::vector<Displacements> section_of(const std::function<double(int)>& f)
{
  std::vector<Displacements> section;
  for (int n = 0; n < 100; ++n) section.push_back({f(n), 0, 0, 0});
  return section;
}

/** One oscillator ẍ = a(x, ẋ, t) of angular frequency ω in the first displacement of a
    state, by classical Runge-Kutta with `steps` steps per period, one per interval. */
class Oscillator : public Flow {
public:
  using Law = std::function<double(double, double, double)>;
  Oscillator(Law a, double omega, int steps)
      : a_(std::move(a)), h_(2 * std::numbers::pi / omega / steps)
  {
  }
  void advance(long interval, State& state) override
  {
    using Pair = std::complex<double>;  // x + i ẋ
    const double t = static_cast<double>(interval) * h_;
    const auto slope = [&](Pair y, double at) {
      return Pair(y.imag(), a_(y.real(), y.imag(), at));
    };
    const Pair y(state.position.stator.x, state.velocity.stator.x);
    const Pair k_1 = slope(y, t), k_2 = slope(y + 0.5 * h_ * k_1, t + h_ / 2);
    const Pair k_3 = slope(y + 0.5 * h_ * k_2, t + h_ / 2);
    const Pair k_4 = slope(y + h_ * k_3, t + h_);
    const Pair end = y + h_ / 6 * (k_1 + 2.0 * k_2 + 2.0 * k_3 + k_4);
    state = {.position = {{end.real(), 0}, {0, 0}},
             .velocity = {{end.imag(), 0}, {0, 0}}};
  }
  long evaluations() const override { return 0; }

private:
  Law a_;
  double h_;
};

void advance_one_period(TrajectoryPair& motion)
{
  std::vector<Passage> both;
  do {
    both.clear();
    motion.next(both);
    REQUIRE(advance_together(both).empty());
    motion.arrived();
  } while (!motion.is_between_periods());
}

/** An oscillator of angular frequency 1 after so many periods. */
TrajectoryPair observed(const Oscillator::Law& law, int steps, int periods)
{
  TrajectoryPair motion(std::make_unique<Oscillator>(law, 1, steps), steps,
                        2 * std::numbers::pi, Vector8::Ones(),
                        {{.position = {{0.1, 0}, {0, 0}}, .velocity = {}}, 0});
  for (int k = 0; k < periods; ++k) advance_one_period(motion);
  return motion;
}

bool closes(const TrajectoryPair& motion)
{
  return closing_period(motion.section(), 1e-6) > 0;
}

}  // namespace

TEST_CASE("The period of a section is the fewest points after which it closes")
{
  constexpr double closed = 1e-6;
  const double golden = (std::sqrt(5) - 1) / 2;
  const auto circle = [&](int n) { return std::cos(2 * std::numbers::pi * golden * n); };
  const auto period = [&](const std::function<double(int)>& f) {
    return closing_period(section_of(f), closed);
  };
  CHECK(period([](int) { return 0.3; }) == 1);
  CHECK(period([](int n) { return 1e-7 * (n % 7); }) == 1);
  CHECK(period(circle) == 0);
  for (int k : {2, 5, 16}) {
    CHECK(period([&](int n) { return n % k; }) == k);
    CHECK(extent(section_of([&](int n) { return n % k; })) == k - 1);
  }
  CHECK(period([](int n) { return n % 17; }) == 0);
  /** A few points cannot show a long period. */
  const std::vector<Displacements> few{{0}, {1}, {0}, {1}, {0}};
  CHECK(closing_period(few, 0.1) == 0);
}

TEST_CASE("The standard error of alternating rates shrinks with batches")
{
  std::vector<double> rates;
  for (int k = 0; k < 80; ++k) rates.push_back(k % 2);
  const BatchMean exponent = batch_mean(rates);
  CHECK(exponent.value == Approx(0.5));
  CHECK(exponent.error == Approx(0).margin(1e-12));
  const BatchMean three = batch_mean({1, 2, 3});
  CHECK(three.value == Approx(2));
  CHECK(three.error == Approx(1 / std::sqrt(3.0)));
}

TEST_CASE("A damped linear oscillator closes, an undamped one neither closes nor parts")
{
  const auto forced = [](double damping) {
    return [damping](double x, double v, double t) {
      return std::cos(t) - 2 * x - damping * v;
    };
  };
  const TrajectoryPair damped = observed(forced(0.2), 100, 160);
  CHECK(closes(damped));
  CHECK(damped.exponent().value == Approx(-0.1).epsilon(0.02));
  CHECK(damped.contraction() < -90);
  const TrajectoryPair free = observed(forced(0), 100, 460);
  CHECK_FALSE(closes(free));
  CHECK(std::abs(free.exponent().value) < 1e-3);
}

/** Ueda's oscillator ẍ + 0.05 ẋ + x³ = 7.5 cos t; its exponent 0.1034 is that of Sprott,
    Chaos and Time-Series Analysis (2003), appendix A. */
TEST_CASE("Ueda's oscillator is chaotic with the published exponent")
{
  const auto law = [](double x, double v, double t) {
    return 7.5 * std::cos(t) - 0.05 * v - x * x * x;
  };
  const TrajectoryPair motion = observed(law, 200, 4000);
  CHECK_FALSE(closes(motion));
  CHECK(motion.exponent().value == Approx(0.1034).margin(0.01));
  CHECK(motion.exponent().error < 0.01);
}
