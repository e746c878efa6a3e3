/** What the machine does from rest: kinds, exponents, amplitudes and errors against closed forms and other methods. */
#include "motion/answer.hpp"
#include "support/cases.hpp"
#include "time/flow.hpp"
#include "time/shooting.hpp"

using namespace rotor_stator;
using namespace rotor_stator::tests;

namespace {

motion::Answer from_rest_at(const Parameters& parameters, double frequency)
{
  return motion::answer(parameters, {.omega = hertz(frequency)});
}

}  // namespace

/** 25 over the slowest decay rate would be 4 s. */
TEST_CASE("A motion that closes is seen before t = 0, and is the one of shooting")
{
  const Parameters machine = set_1();
  const double omega = hertz(42);
  const BasePeriod base = base_period(machine);
  const Settled settled = settle(machine, omega, base, from_rest(machine, omega));
  CHECK(settled.period == 1);
  CHECK(settled.seconds < 3);
  CHECK(settled.remainder < 1e-8);
  State closed = settled.at.state;
  REQUIRE(shoot(machine, omega, closed, {}).converged);
  CHECK(apart(machine, closed, settled.at.state) < 1e-4);  // the error of the steps
}

TEST_CASE("A motion that only too long steps keep up is not reported")
{
  /** Set 2 at 9.5 Hz, a motion of two turns for the splitting with the default step. Eq. 7
      leaves it in its first turn and is chaotic: an integration by SciPy's DOP853 shows. */
  Parameters machine = set_1();
  machine.bearing.clearance = 2e-4;
  const double omega = hertz(9.5);
  const BasePeriod base = base_period(machine);
  const Instant start{{.position = {{-5.7199193062519014e-05, 0.00033376616078848625},
                                    {7.558592867442927e-05, -0.00031697237288094503}},
                       .velocity = {{-0.019811625341296008, 0.24004938507478824},
                                    {0.011892988023526261, -0.12668864156578732}}},
                      0};
  const Settled settled = settle(machine, omega, base, start);
  CHECK(settled.kind == Kind::chaotic);
  CHECK(settled.step == step_at(machine, omega) / 4);
  const Settled kept = settle(machine, omega, base, start, {.is_fixed = true});
  CHECK(kept.kind == Kind::undecided);
  CHECK(kept.reason.starts_with("with a quarter of the step"));
}

TEST_CASE("A motion that grows without bound is none")
{
  Parameters machine = set_1();
  machine.stator.damping_ratio = machine.rotor.damping_ratio = -2e-3;
  CHECK_THROWS_WITH(from_rest_at(machine, 30), contains("grows without bound"));
}

TEST_CASE("A wobble that only the steps keep up is not reported")
{
  /** The contact grazes: the steps move the section by 6e-4, as a torus would. */
  const Parameters machine = read_parameters(SOURCE_DIR "/data/vertical.toml");
  const auto settled = [&](double f) {
    return settle(machine, hertz(f), base_period(machine), from_rest(machine, hertz(f)));
  };
  const Settled closed = settled(24);
  CHECK(closed.period == 1);
  CHECK(closed.step == step_at(machine, hertz(24)) / 4);
  CHECK(settled(23.75).kind == Kind::quasi_periodic);
}

TEST_CASE("A start from rest is in equilibrium, whole turns before t = 0")
{
  Parameters parameters = set_1();
  parameters.bearing.cage_speed_ratio = 0.4321;
  const Instant start = from_rest(parameters, hertz(45));
  CHECK(start.period == -180);  // 4 s: the slowest mode decays sooner
  CHECK(from_rest(parameters, hertz(1e19)).period == -1'000'000'000'000);
  parameters.unbalance = 0;
  const RotorStator machine(parameters, 1e-12);
  const double cage = -180 * 0.4321 * 2 * std::numbers::pi;
  const Bodies a = machine.acceleration(start.state.position, {},
                                        {Direction::of(0), Direction::of(cage)});
  for (const double value : displacements(a)) CHECK(std::abs(value) < 1e-6 * 9.81);
}

/** A sum over the wrong number of periods would show. */
TEST_CASE("Neighbours part at the rate of the largest multiplier")
{
  for (const double frequency : {16.0, 20.0, 20.25, 45.0}) {
    const motion::Question question{set_1(), {.omega = hertz(frequency), .longest = 60}};
    motion::Answer answer = motion::settled_answers({&question, 1}).front().get();
    const Exponent measured = answer.settled.lyapunov;
    complete(answer, {.omega = hertz(frequency)});
    const Exponent exact = answer.settled.lyapunov;
    INFO(frequency << " Hz: " << measured.value << " +- " << measured.error << ", "
                   << exact.value);
    CHECK(exact.error < 0.01);
    CHECK(std::abs(measured.value - exact.value) < 0.5 + 3 * measured.error);
  }
}
