/** Motions side by side with fixed steps and registers of each width: each has the bits that it
    has alone. */
#include <memory>
#include "support/catch.hpp"

#include "support/cases.hpp"
#include "time/fixed_step.hpp"
#include "time/flow.hpp"

using namespace rotor_stator;
using namespace rotor_stator::tests;

namespace {

/** A motion of its own: everything but the number of balls differs from that of the
    others. */
struct Runner {
  Parameters machine = set_1();
  double omega;
  int intervals;
  double step;
  Rule rule;
  long interval;
  State start;

  Runner(int n, Rule undamped)
      : omega(hertz(11 + 7.3 * n)), intervals(n % 3 == 0 ? 1 : 16 + n),
        step(default_step(machine) * (0.4 + 0.17 * n)), interval(n % 2 ? -3 * n : 5 * n)
  {
    Bearing& bearing = machine.bearing;
    bearing.clearance *= 1 + 0.2 * n;
    bearing.contact_stiffness *= 1 + 0.1 * n;
    bearing.cage_speed_ratio = 0.36 + 0.013 * n;
    bearing.cage_phase = 0.4 * n;
    if (n % 3 == 1) bearing.damping = 0.5 * n;
    rule = n % 3 == 1 ? Rule::rk4 : undamped;
    machine.rotor.mass *= 1 + 0.05 * n;
    machine.unbalance *= 1 - 0.05 * n;
    start = static_start(machine);
    start.position.rotor.x += 1e-6 * n;
  }

  std::unique_ptr<FixedStep> flow() const
  {
    return std::make_unique<FixedStep>(machine, omega, intervals, step, rule);
  }
};

/** With registers of this width, if the processor has them. */
template <class Run>
void with_registers(Registers width, Run run)
{
  use_registers(width);
  if (widest_registers() == width) run();
  use_registers(Registers::avx512);
}

}  // namespace

TEST_CASE("The force at all instants of a period has the same bits in any registers")
{
  /** 41 instants: the last group overlaps the one before in all of them. */
  const Parameters machine = set_1();
  const SampledBearing bearing(machine.bearing, 41);
  const Eigen::MatrixXd u = 5e-5 * Eigen::MatrixXd::Random(41, 2);
  std::vector<Eigen::MatrixXd> forces, stiffnesses;
  for (Registers width : {Registers::plain, Registers::avx2, Registers::avx512})
    with_registers(width, [&] {
      bearing(u, forces.emplace_back(), &stiffnesses.emplace_back());
      Eigen::MatrixXd alone;
      bearing(u, alone, nullptr);
      CHECK(alone == forces.front());
      CHECK(forces.back() == forces.front());
      CHECK(stiffnesses.back() == stiffnesses.front());
    });
  CHECK(forces.front().norm() > 0);
}

/** Catches constants, steps or directions of another lane, lanes that stop early or late,
    damping in a lane that has none, sums in another order, and evaluations that are not
    counted. */
TEST_CASE("Motions side by side have the bits that they have alone")
{
  constexpr int most = 8, rounds = 3;
  std::vector<Runner> runners;
  const Rule undamped = GENERATE(Rule::rk4, Rule::splitting);
  for (int n = 0; n < most; ++n) runners.emplace_back(n, undamped);

  std::vector<std::vector<Bits>> alone(most);
  std::vector<long> evaluations;
  with_registers(Registers::plain, [&] {
    for (int n = 0; n < most; ++n) {
      const auto flow = runners[n].flow();
      State state = runners[n].start;
      for (int round = 0; round < rounds; ++round) {
        flow->advance(runners[n].interval + round, state);
        alone[n].push_back(bits(state));
      }
      evaluations.push_back(flow->evaluations());
      CHECK(std::hypot(state.position.relative().x, state.position.relative().y) <
            100 * runners[n].machine.bearing.clearance);
    }
  });
  for (int n = 1; n < most; ++n) CHECK(alone[n] != alone[n - 1]);

  for (Registers width : {Registers::plain, Registers::avx2, Registers::avx512})
    with_registers(width, [&] {
      for (int count : {1, 2, 3, 5, 8})
        for (int first : {0, most - count}) {
          std::vector<std::unique_ptr<FixedStep>> flows;
          std::vector<State> states;
          for (int n = first; n < first + count; ++n) {
            flows.push_back(runners[n].flow());
            states.push_back(runners[n].start);
          }
          for (int round = 0; round < rounds; ++round) {
            std::vector<Passage> passages;
            for (int l = 0; l < count; ++l)
              passages.push_back(
                  {flows[l].get(), runners[first + l].interval + round, &states[l]});
            advance_together(passages);
            for (int l = 0; l < count; ++l) {
              INFO("registers " << static_cast<int>(width) << ", " << count
                                << " motions from " << first << ", motion " << first + l);
              CHECK(bits(states[l]) == alone[first + l][round]);
            }
          }
          for (int l = 0; l < count; ++l)
            CHECK(flows[l]->evaluations() == evaluations[first + l]);
        }
    });
}

TEST_CASE("A state and its neighbour have the bits that they have alone")
{
  for (int n : {0, 1, 4}) {
    const Runner runner(n, Rule::splitting);
    const auto flow = runner.flow(), both = runner.flow();
    State a = runner.start, b = a;
    b.velocity.stator.y += 1e-3;
    State a_alone = a, b_alone = b;
    for (long k = runner.interval; k < runner.interval + 4; ++k) {
      const Passage passages[] = {{both.get(), k, &a}, {both.get(), k, &b}};
      CHECK(advance_together(passages).empty());
      flow->advance(k, a_alone);
      flow->advance(k, b_alone);
      CHECK(bits(a) == bits(a_alone));
      CHECK(bits(b) == bits(b_alone));
    }
    CHECK(both->evaluations() == flow->evaluations());
  }
}
