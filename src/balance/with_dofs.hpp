/**
# The number of unknowns as a constant

Small matrices of a size that the compiler knows are multiplied without loops. */
#pragma once

#include <type_traits>

namespace rotor_stator
{

/** Calls `work` with `dofs` = 1 … 4 as a std::integral_constant. */
template <class Work>
void with_dofs(int dofs, Work work)
{
  switch (dofs) {
    case 1:
      return work(std::integral_constant<int, 1>{});
    case 2:
      return work(std::integral_constant<int, 2>{});
    case 3:
      return work(std::integral_constant<int, 3>{});
    default:
      return work(std::integral_constant<int, 4>{});
  }
}

}  // namespace rotor_stator
