#include "model/registers.hpp"

#include <algorithm>

namespace rotor_stator {

static Registers registers_of_processor()
{
#ifdef HAS_WIDE_REGISTERS
  if (__builtin_cpu_supports("avx512f")) return Registers::avx512;
  if (__builtin_cpu_supports("avx2")) return Registers::avx2;
#endif
  return Registers::plain;
}

static Registers& registers_in_use()
{
  static Registers in_use = registers_of_processor();
  return in_use;
}

Registers widest_registers()
{
  return registers_in_use();
}

void use_registers(Registers widest)
{
  registers_in_use() = std::min(widest, registers_of_processor());
}

}  // namespace rotor_stator
