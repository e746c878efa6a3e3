/** The account that bounds all work, and the evaluations that are paid from it. */
#include <catch2/catch.hpp>

#include "io/budget.hpp"
#include "io/errors.hpp"

using namespace rotor_stator;

TEST_CASE("Copies of an account spend the same money")
{
  const OperationBudget work(100);
  const OperationBudget copy = work;
  copy.spend(30);
  CHECK(work.left() == 70);
  CHECK_FALSE(work.used_up());
  CHECK_FALSE(OperationBudget().bounded());
  CHECK_NOTHROW(OperationBudget().part(0.5).spend(1e300));
}

TEST_CASE("What cannot be paid for empties the account")
{
  const OperationBudget work(100);
  CHECK_THROWS_AS(work.spend(101), NoSolution);
  CHECK(work.used_up());
  CHECK_THROWS_AS(work.spend(1), NoSolution);
}

TEST_CASE("A part spends from the whole, and ends before it")
{
  const OperationBudget work(100);
  const OperationBudget part = work.part(0.5);
  part.spend(40);
  CHECK(work.left() == 60);
  CHECK(part.left() == 10);
  CHECK_THROWS_AS(part.spend(11), NoSolution);
  CHECK(part.used_up());
  CHECK_FALSE(work.used_up());
  work.part(1).part(0.5).spend(30);
  CHECK(work.left() == 30);
}

TEST_CASE("Evaluations are counted, paid for and refused")
{
  Allowance counted(10);
  counted.take(10);
  CHECK(counted.used() == 10);
  CHECK_FALSE(counted.took_one());
  CHECK(counted.used() == 10);
  CHECK_THROWS_AS(counted.take(1), NoSolution);

  const OperationBudget work(100);
  Allowance paid(1e9, work, 20);
  paid.take(4);
  CHECK(work.left() == 20);
  CHECK(paid.took_one());
  CHECK_FALSE(paid.took_one());
  CHECK(paid.used() == 5);
  CHECK(work.used_up());
}
