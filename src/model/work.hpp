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
class Work
{
public:
  /** Without a bound. */
  Work() = default;

  /** At most `most` operations. */
  explicit Work(double most)
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
  Work part(double share) const;

private:
  struct Account {
    double most, left;
    std::shared_ptr<Account> parent;
  };
  std::shared_ptr<Account> account_;
};

}  // namespace rotor_stator
