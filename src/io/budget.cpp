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
  for (Account* account = account_.get(); account; account = account->parent.get()) {
    if (!(evaluations <= account->left)) {
      account->left = 0;
      return account;
    }
    account->left -= evaluations;
    if (account->watch) account->watch(1 - account->left / account->most);
  }
  return nullptr;
}

bool OperationBudget::pay(double evaluations) const
{
  return !short_of(evaluations);
}

void OperationBudget::spend(double evaluations) const
{
  const Account* account = short_of(evaluations);
  if (!account) return;
  const Account* whole = account;
  while (whole->parent) whole = whole->parent.get();
  const std::string more = account->option.empty() ? ""
                                                   : "; more with " + account->option +
                                                         format(" %.2g", 4 * whole->most);
  throw NoSolution(format("the %s of %.3g evaluations of the force is used up%s",
                          account->parent ? "share" : "budget", account->most,
                          more.c_str()));
}

OperationBudget OperationBudget::part(double share) const
{
  if (!account_) return {};
  OperationBudget inner(share * account_->left, account_->option);
  inner.account_->parent = account_;
  return inner;
}

}  // namespace rotor_stator
