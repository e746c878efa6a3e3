/**
# Wider registers

The same operations for wider registers, chosen when the program starts. No sum is
reordered and none fused, so the bits do not depend on the choice. */
#pragma once

#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__)
#define WIDEST_REGISTERS __attribute__((target_clones("avx512f", "avx2", "default")))
#define HAS_WIDE_REGISTERS
#else
#define WIDEST_REGISTERS
#endif

/** What such a function calls must be a part of it, else it is compiled once, for the
    narrowest registers. */
#define IN_PLACE [[gnu::always_inline]] inline

namespace rotor_stator {

/** The registers that rows of lanes are compiled for: of 2, 4 and 8 doubles. GCC takes
    wider rows through the memory. */
enum class Registers { plain, avx2, avx512 };
Registers widest_registers();

/** For tests: at most these are used from now on. */
void use_registers(Registers widest);

}  // namespace rotor_stator
