/** Motions that are settled together, with others or alone: the same bits. */
#include <memory>
#include "support/catch.hpp"

#include "io/errors.hpp"
#include "support/cases.hpp"
#include "time/fixed_step.hpp"
#include "time/settle.hpp"

using namespace rotor_stator;
using namespace rotor_stator::tests;

namespace {

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
