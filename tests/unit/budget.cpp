/** The account that bounds what a run may cost. */
#include "support/catch.hpp"

#include "io/budget.hpp"
#include "io/errors.hpp"

using namespace rotor_stator;

TEST_CASE("Copies of an account spend the same money")
{
  const OperationBudget budget(100);
  const OperationBudget copy = budget;
  copy.spend(30);
  CHECK(budget.left() == 70);
  CHECK_FALSE(budget.used_up());
  CHECK_FALSE(OperationBudget().bounded());
  CHECK_NOTHROW(OperationBudget().part(0.5).spend(1e300));
}

TEST_CASE("What cannot be paid for empties the account")
{
  const OperationBudget budget(100);
  CHECK_THROWS_AS(budget.spend(101), NoSolution);
  CHECK(budget.used_up());
  CHECK_THROWS_AS(budget.spend(1), NoSolution);
}

TEST_CASE("A part spends from the whole, and ends before it")
{
  const OperationBudget budget(100);
  const OperationBudget part = budget.part(0.5);
  part.spend(40);
  CHECK(budget.left() == 60);
  CHECK(part.left() == 10);
  CHECK_THROWS_AS(part.spend(11), NoSolution);
  CHECK(part.used_up());
  CHECK_FALSE(budget.used_up());
  budget.part(1).part(0.5).spend(30);
  CHECK(budget.left() == 30);
}

TEST_CASE("Callbacks are told what cannot be paid for")
{
  const OperationBudget budget(100, "--budget");
  CHECK(budget.pay(80));
  CHECK_FALSE(budget.pay(40));
  CHECK(budget.used_up());
  CHECK_THROWS_WITH(budget.spend(1),
                    Catch::Contains("100 evaluations") && Catch::Contains("--budget"));
}
