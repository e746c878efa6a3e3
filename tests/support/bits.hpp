/** The bits of a state: what must be the same to the last one. */
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "model/rotor_stator.hpp"

namespace rotor_stator::tests {

using Bits = std::array<std::uint64_t, 8>;

inline Bits bits(const State& state)
{
  return std::bit_cast<Bits>(std::array{state.position, state.velocity});
}

}  // namespace rotor_stator::tests
