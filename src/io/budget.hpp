/**
# A bound on work

A question that is legal can still ask for hours: a stiff contact, many balls, many harmonics. Work is
counted in elementary operations, of which a core does about one per nanosecond, and never in
seconds: the same question ends in the same way on every machine. */
#pragma once

#include <memory>

namespace rotor_stator
{

/** A shared account of operations: copies spend from the same account. */
class OperationBudget
{
public:
  /** Without a bound. */
  OperationBudget() = default;

  /** At most `most` operations. */
  explicit OperationBudget(double most)
      : account_(std::make_shared<Account>(Account{most, most, nullptr}))
  {
  }

  bool bounded() const { return account_ != nullptr; }

  /** What is left; infinite without a bound. */
  double left() const;

  /** Whether something could not be paid for from this account, or nothing is left. */
  bool used_up() const { return left() <= 0; }

  /** Takes `operations` from the account. Throws NoSolution when they are not there. */
  void spend(double operations) const;

  /** An account of its own with a part of what is left; what it spends is spent here too. */
  OperationBudget part(double share) const;

private:
  struct Account {
    double most, left;
    std::shared_ptr<Account> parent;
  };
  std::shared_ptr<Account> account_;
};

/**
## What a time integration may cost

The evaluations of Eq. 7 are counted as they are made, and paid for one by one where there is an
account: an integration that breaks down has been paid up to there. */

class Allowance
{
public:
  /** At most `most` evaluations: 1e9 are half a minute of RK4. */
  explicit Allowance(double most = 1e9) : most_(most) {}

  /** At `price` operations each from `work`. */
  Allowance(double most, OperationBudget work, double price)
      : most_(most), work_(std::move(work)), price_(price)
  {
  }

  /** Counts `more` evaluations and pays for them. Throws NoSolution when there are not so many left. */
  void take(long more);

  /** The same for one, false instead of thrown: for callbacks that C calls. */
  bool took_one();

  long used() const { return used_; }

private:
  double most_;
  OperationBudget work_;
  double price_ = 0;
  long used_ = 0;
};

}  // namespace rotor_stator
