#include "io/budget.hpp"

#include <limits>

#include "io/errors.hpp"

namespace rotor_stator {

double OperationBudget::left() const
{
  return account_ ? account_->left : std::numeric_limits<double>::infinity();
}

const OperationBudget::Account* OperationBudget::short_of(double evaluations) const
{
  bool is_short = false;
  const Account* whole = nullptr;
  for (Account* account = account_.get(); account; account = account->parent.get()) {
    whole = account;
    if (is_short) continue;
    is_short = !(evaluations <= account->left) ||
               (account->seconds > 0 && Clock::now() >= account->end);
    account->left = is_short ? 0 : account->left - evaluations;
    if (account->watch && !is_short) account->watch(1 - account->left / account->most);
  }
  return is_short ? whole : nullptr;
}

bool OperationBudget::used_up() const
{
  for (const Account* account = account_.get(); account; account = account->parent.get())
    if (account->left < 1e-3 * account->most) return true;
  return false;
}

bool OperationBudget::pay(double evaluations) const
{
  return !short_of(evaluations);
}

void OperationBudget::spend(double evaluations) const
{
  const Account* account = short_of(evaluations);
  if (!account) return;
  const auto in_words = [&](double times, const char* unit) {
    return account->seconds > 0
               ? format("%gs", times * account->seconds)
               : format("%.*g%s", times > 1 ? 2 : 3, times * account->most, unit);
  };
  throw NoSolution("the budget of " + in_words(1, " evaluations of the force") +
                   " is used up" +
                   (account->option.empty()
                        ? ""
                        : "; more with " + account->option + " " + in_words(4, "")));
}

OperationBudget OperationBudget::part(double share) const
{
  if (!account_) return {};
  OperationBudget inner(share * account_->left, account_->option);
  inner.account_->parent = account_;
  return inner;
}

}  // namespace rotor_stator
