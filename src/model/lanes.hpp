/**
# Numbers side by side

`Lanes<8>` is a row of eight doubles that a processor adds, multiplies and takes roots of
at once, as far as its registers are wide. What is written once for a `Number` then serves
one motion (double) or several of them (lanes), with the same bits for each: no sum is
reordered and no product fused.

    template <class Number>
    IN_PLACE Number pressed_by(Number k, Number approach)
    {
      const Number p = positive(approach);
      return k * p * root(p);
    }

Functions of lanes are `IN_PLACE`, a part of the function that is compiled for the
registers at hand. */
#pragma once

#include <cmath>

#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__)
#define HAS_WIDE_REGISTERS
#endif

/** What a function compiled for wide registers calls must be a part of it, else it is
    compiled once, for the narrowest ones. */
#define IN_PLACE [[gnu::always_inline]] inline

namespace rotor_stator {

/** The registers that rows of lanes are compiled for, by the doubles that one holds,
    chosen when the program starts. GCC takes wider rows through the memory. */
enum class Registers { plain = 2, avx2 = 4, avx512 = 8 };

inline Registers registers_of_processor()
{
#ifdef HAS_WIDE_REGISTERS
  if (__builtin_cpu_supports("avx512f")) return Registers::avx512;
  if (__builtin_cpu_supports("avx2")) return Registers::avx2;
#endif
  return Registers::plain;
}

/** Those in use, which tests narrow. */
inline Registers& widest_registers()
{
  static Registers widest = registers_of_processor();
  return widest;
}

#ifdef HAS_WIDE_REGISTERS
template <class Work>
__attribute__((target("avx2"))) void in_avx2(const Work& work)
{
  work();
}

template <class Work>
__attribute__((target("avx512f"))) void in_avx512(const Work& work)
{
  work();
}
#endif

/** Calls `work`, always inline, in a function that is compiled for these registers. */
template <class Work>
void in_registers(Registers registers, const Work& work)
{
#ifdef HAS_WIDE_REGISTERS
  if (registers == Registers::avx512) return in_avx512(work);
  if (registers == Registers::avx2) return in_avx2(work);
#endif
  static_cast<void>(registers);
  work();
}

template <int count>
using Lanes [[gnu::vector_size(count * sizeof(double))]] = double;

/** How many motions a number belongs to. */
template <class Number>
inline constexpr int lanes_in = static_cast<int>(sizeof(Number) / sizeof(double));

/** p where it is positive, else 0. */
template <class Number>
IN_PLACE Number positive(Number p)
{
  if constexpr (lanes_in<Number> == 1) {
    return p > 0 ? p : 0;
  } else {
    Number row;
    for (int l = 0; l < lanes_in<Number>; ++l) row[l] = p[l] > 0 ? p[l] : 0;
    return row;
  }
}

template <class Number>
IN_PLACE Number root(Number p)
{
  if constexpr (lanes_in<Number> == 1) {
    return std::sqrt(p);
  } else {
    Number row;
    for (int l = 0; l < lanes_in<Number>; ++l) row[l] = __builtin_sqrt(p[l]);
    return row;
  }
}

/** Whether p is positive in any lane, whatever the others hold: halves are laid over each
    other, since a loop over the lanes would go through the memory. */
template <class Number>
IN_PLACE bool any_positive(Number p)
{
  if constexpr (lanes_in<Number> == 1) {
    return p > 0;
  } else if constexpr (lanes_in<Number> == 2) {
    return p[0] > 0 || p[1] > 0;
  } else if constexpr (lanes_in<Number> == 4) {
    const Lanes<2> low = __builtin_shufflevector(p, p, 0, 1),
                   high = __builtin_shufflevector(p, p, 2, 3);
    return any_positive(low > 0 ? low : high);
  } else {
    const Lanes<4> low = __builtin_shufflevector(p, p, 0, 1, 2, 3),
                   high = __builtin_shufflevector(p, p, 4, 5, 6, 7);
    return any_positive(low > 0 ? low : high);
  }
}

/** The number in lane `l`. */
template <class Number>
IN_PLACE double lane(const Number& row, int l)
{
  if constexpr (lanes_in<Number> == 1)
    return row;
  else
    return row[l];
}

}  // namespace rotor_stator
