/** Motions side by side, with registers of each width, and motions that are settled together: each has the bits
    that it has alone. */
#include "support/cases.hpp"
#include "time/fixed_step.hpp"
#include "time/flow.hpp"
#include "time/settle.hpp"

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

/** Machines, speeds and kinds of motion differ; some have other bearings, whose motions
    are no neighbours in a row. */
struct Case {
  Parameters machine = set_1();
  double omega;

  explicit Case(int n) : omega(hertz(12 + 2.6 * n))
  {
    machine.unbalance *= 1 + 0.02 * n;
    machine.bearing.clearance *= 1 - 0.01 * n;
    if (n % 4 == 1) machine.bearing.clearance *= 5;
    if (n % 5 == 2) machine.bearing.damping = 0.3;
    if (n % 7 == 3) machine.bearing.balls = 9;
  }

  std::unique_ptr<Settling> settling(double budget = 1e9, double step = 0) const
  {
    return std::make_unique<Settling>(
        machine, omega, BasePeriod{}, from_rest(machine, omega),
        SettleRule{.step = step, .longest = 2}, OperationBudget(budget, "--budget"));
  }
};

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
  const Rule undamped = GENERATE(Rule::rk4, Rule::splitting, Rule::central);
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

/** Catches a lane that is given to another motion too early, constants that stay behind,
    and a count that takes in the work of others. */
TEST_CASE("Motions that settle together settle as they do alone")
{
  constexpr int count = 21, broken = 5, poor = 9;
  std::vector<std::unique_ptr<Settling>> together;
  std::vector<Traveller*> travellers;
  for (int n = 0; n < count; ++n) {
    const double step = n == broken ? 1000 * default_step(Case(n).machine) : 0;
    together.push_back(Case(n).settling(n == poor ? 3e5 : 1e9, step));
    travellers.push_back(together.back().get());
  }
  travel(travellers);
  for (int n = 0; n < count; ++n) {
    INFO("motion " << n);
    if (n == broken) {
      CHECK_THROWS_AS(together[n]->settled(), NoSolution);
      continue;
    }
    const Settled& among = together[n]->settled();
    if (n == poor) {
      CHECK(among.kind == Kind::undecided);
      CHECK(among.reason.find("--budget") != std::string::npos);
      CHECK(among.evaluations <= 3e5);
      continue;
    }
    const auto single = Case(n).settling();
    travel(std::vector<Traveller*>{single.get()});
    const Settled& alone = single->settled();
    CHECK(bits(among.at.state) == bits(alone.at.state));
    CHECK(among.at.period == alone.at.period);
    CHECK(among.kind == alone.kind);
    CHECK(among.evaluations == alone.evaluations);
    CHECK(among.lyapunov.value == alone.lyapunov.value);
  }
}

TEST_CASE("Paths side by side have the bits that they have alone")
{
  std::vector<std::unique_ptr<Flow>> flows;
  std::vector<State> states;
  std::vector<std::vector<State>> paths(5);
  std::vector<Passage> passages;
  for (int n = 0; n < 5; ++n) {
    const Case one(n);
    flows.push_back(flow(one.machine, one.omega,
                         {.method = "rk4", .intervals_per_period = 50 + 40 * n}));
    states.push_back(static_start(one.machine));
  }
  for (std::size_t n = 0; n < 5; ++n)
    passages.push_back(
        {flows[n].get(), 7, &states[n], 150 - 20 * static_cast<long>(n), &paths[n]});
  REQUIRE(advance_together(passages).empty());
  for (std::size_t n = 0; n < 5; ++n) {
    const Case one(static_cast<int>(n));
    State state = static_start(one.machine);
    std::vector<State> alone;
    const Passage single{passages[n].flow, passages[n].first, &state, passages[n].count,
                         &alone};
    REQUIRE(advance_together({&single, 1}).empty());
    REQUIRE(paths[n].size() == alone.size());
    for (std::size_t k = 0; k < alone.size(); ++k)
      CHECK(bits(paths[n][k]) == bits(alone[k]));
    CHECK(bits(states[n]) == bits(alone.back()));
    /** And the states at the ends of intervals that are integrated one by one. */
    State step_by_step = static_start(one.machine);
    for (long k = 0; k < 20; ++k) flows[n]->advance(7 + k, step_by_step);
    CHECK((vector_of(step_by_step) - vector_of(alone[19])).norm() <
          1e-12 * vector_of(alone[19]).norm());
  }
}
