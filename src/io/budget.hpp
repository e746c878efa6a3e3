/**
# A bound on what a run may cost

A legal question can still ask for hours. What a run does is counted in evaluations of the
bearing's force as RK4 makes them (Eq. 6 at one instant, all n balls), and not in seconds:
the same question ends in the same way on every machine. Who asks for seconds of the clock
gives that up.

Everything else that takes time (transforms, factorisations, the overhead of a stepper) is
charged with as many evaluations as take that time. Prices are in elementary operations,
of which a core does about one per nanosecond. */
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

namespace rotor_stator {

/** Elementary operations of one evaluation of the force of n balls. */
constexpr double operations_per_evaluation(int balls)
{
  return 15 + 1.35 * balls;
}

using Clock = std::chrono::steady_clock;

/** A shared account of evaluations of the force: copies spend from the same account. */
class OperationBudget {
public:
  /** Without a bound. */
  OperationBudget() = default;

  /** At most so many evaluations; `option` gives more, for the message. */
  explicit OperationBudget(double evaluations, std::string option = "")
      : account_(std::make_shared<Account>(Account{evaluations, evaluations, option}))
  {
  }

  /** Calls `watch` with the share that is spent, whenever something is. */
  void watch(std::function<void(double share)> watch) { account_->watch = watch; }

  /** Nothing can be paid from `end` on, `seconds` after the start of the run. */
  void end_at(Clock::time_point end, double seconds)
  {
    account_->end = end;
    account_->seconds = seconds;
  }

  bool bounded() const { return account_ != nullptr; }

  /** Of the clock, 0 for any. */
  double seconds() const { return account_->seconds; }

  /** What was spent of a bounded account, and what it began with [evaluations]. */
  double spent() const { return account_->most - account_->left; }
  double most() const { return account_->most; }

  /** What is left; infinite without a bound. */
  double left() const;

  /** Whether something could not be paid for, or less than a thousandth is left. */
  bool used_up() const;

  /** Takes `evaluations` from the account. Throws NoSolution when they are not there. */
  void spend(double evaluations) const;

  /** The same, false instead of thrown: for callbacks that C calls. */
  bool pay(double evaluations) const;

  /** An account of its own with a part of what is left; it spends from here too. */
  OperationBudget part(double share) const;

private:
  struct Account {
    double most, left;
    std::string option;
    std::shared_ptr<Account> parent = nullptr;
    std::function<void(double share)> watch = {};
    double seconds = 0;  ///< of the clock, 0 for any
    Clock::time_point end = {};
  };

  /** The account that a user knows, the outermost, where one has not `evaluations` left
      and is emptied; null where all had and paid. */
  const Account* short_of(double evaluations) const;

  std::shared_ptr<Account> account_;
};

}  // namespace rotor_stator
