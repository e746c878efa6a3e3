#include "integration/allowance.hpp"

#include "model/errors.hpp"

namespace rotor_stator
{

void Allowance::take(long more)
{
  if (!(static_cast<double>(used_ + more) <= most_))
    throw NoSolution(text("not done within %.3g evaluations of Eq. 7", most_));
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
