/** The account that bounds what a run may cost. */
#include "io/budget.hpp"
#include "support/cases.hpp"
#include "time/steady_state.hpp"

using namespace rotor_stator;
using namespace rotor_stator::tests;

TEST_CASE("Copies and parts of an account spend the same money until it is empty")
{
  const OperationBudget budget(100);
  const OperationBudget copy = budget;
  copy.spend(30);
  CHECK(budget.left() == 70);
  const OperationBudget part = budget.part(0.5);
  part.spend(25);
  CHECK(part.left() == 10);
  CHECK_THROWS_AS(part.spend(11), NoSolution);
  CHECK(part.used_up());
  budget.part(1).part(0.5).spend(5);
  CHECK(budget.left() == 40);
  CHECK_FALSE(budget.used_up());
  CHECK_THROWS_AS(budget.spend(41), NoSolution);
  CHECK(budget.used_up());
  CHECK_THROWS_AS(copy.spend(1), NoSolution);
  CHECK_FALSE(OperationBudget().bounded());
  CHECK_NOTHROW(OperationBudget().part(0.5).spend(1e300));
  /** Callbacks are told what cannot be paid for. */
  const OperationBudget own(100, "--budget");
  CHECK(own.pay(80));
  CHECK_FALSE(own.pay(40));
  CHECK(own.used_up());
  CHECK_THROWS_WITH(own.spend(1), contains("100 evaluations") && contains("--budget"));
}

TEST_CASE("Nothing is paid for after the seconds of the clock, in parts too")
{
  OperationBudget budget(100, "--budget");
  budget.end_at(Clock::now(), 60);
  CHECK_THROWS_WITH(budget.part(0.5).spend(1),
                    contains("60s is used up; more with --budget 240s"));
  CHECK(budget.used_up());
  OperationBudget later(100);
  later.end_at(Clock::now() + std::chrono::hours(1), 3600);
  CHECK_NOTHROW(later.spend(1));
}

/** What was once counted too cheap, in counts: no seconds are needed to see it. */
TEST_CASE("What grows faster than the force is paid for as it grows")
{
  const auto paid_for_factors = [](int harmonics) {
    const OperationBudget budget(1e12);
    Balance balance(bearing_problem(set_1(), default_samples(harmonics), budget),
                    harmonics);
    const Eigen::VectorXd x = quasi_static_start(set_1(), hertz(30), harmonics);
    balance.jacobian(x, hertz(30));
    return 1e12 - budget.left();
  };
  CHECK(paid_for_factors(400) > 6 * paid_for_factors(200));
  /** N with a large prime factor, next to one without. */
  CHECK(FourierTransform(20011).operations() > 2 * FourierTransform(20160).operations());
  Parameters crowded = set_1();
  crowded.bearing.balls = 1000;
  CHECK(bearing_problem(crowded, 64, {}).operations >
        10 * bearing_problem(set_1(), 64, {}).operations);
}

TEST_CASE("An integration that breaks down is paid for up to there")
{
  const OperationBudget budget(1e9);
  SteadySettings settings;
  settings.stepper = {
      .method = "rk4", .intervals_per_period = 4, .step = 1e-2, .budget = budget};
  CHECK_THROWS_AS(steady_state(set_1(), hertz(10), settings), NoSolution);
  CHECK(budget.left() <= 1e9 - 4 * 4);
}
