#include "io/budget.hpp"

#include <limits>

#include "io/errors.hpp"

namespace rotor_stator
{

double OperationBudget::left() const
{
  return account_ ? account_->left : std::numeric_limits<double>::infinity();
}

void OperationBudget::spend(double operations) const
{
  for (Account* account = account_.get(); account; account = account->parent.get()) {
    if (!(operations <= account->left)) {
      account->left = 0;
      throw NoSolution(format("the work allowed, %.3g billion operations, is used up",
                              account->most / 1e9));
    }
    account->left -= operations;
  }
}

OperationBudget OperationBudget::part(double share) const
{
  if (!account_) return {};
  OperationBudget inner(share * account_->left);
  inner.account_->parent = account_;
  return inner;
}

void Allowance::take(long more)
{
  if (!(static_cast<double>(used_ + more) <= most_))
    throw NoSolution(format("not done within %.3g evaluations of Eq. 7", most_));
  if (work_.bounded()) work_.spend(static_cast<double>(more) * price_);
  used_ += more;
}

bool Allowance::took_one()
{
  try {
    take(1);
  } catch (const NoSolution&) {
    return false;
  }
  return true;
}

}  // namespace rotor_stator
