#include "model/work.hpp"

#include <limits>

#include "model/errors.hpp"

namespace rotor_stator
{

double Work::left() const
{
  return account_ ? account_->left : std::numeric_limits<double>::infinity();
}

void Work::spend(double operations) const
{
  for (Account* account = account_.get(); account; account = account->parent.get()) {
    if (!(operations <= account->left)) {
      account->left = 0;
      throw NoSolution(text("the work allowed, %.3g billion operations, is used up",
                            account->most / 1e9));
    }
    account->left -= operations;
  }
}

Work Work::part(double share) const
{
  if (!account_) return {};
  Work inner(share * account_->left);
  inner.account_->parent = account_;
  return inner;
}

}  // namespace rotor_stator
