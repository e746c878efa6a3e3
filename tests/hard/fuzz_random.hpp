/**
# The dice of the fuzzer

The distributions of the standard library differ between implementations; these do not. */
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "io/errors.hpp"

namespace rotor_stator::tests
{

class Dice
{
public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}

  /** 0 … sides - 1. */
  int roll(int sides) { return static_cast<int>(engine_() % sides); }
  bool one_in(int sides) { return roll(sides) == 0; }

  template <class T>
  const T& pick(const std::vector<T>& list)
  {
    return list[roll(static_cast<int>(list.size()))];
  }

  /** 10^low … 10^high. */
  double decade(double low, double high)
  {
    return std::pow(10.0, low + (high - low) * roll(1 << 20) / (1 << 20));
  }
  std::string decade_text(double low, double high)
  {
    return format("%.6e", decade(low, high));
  }

private:
  std::mt19937_64 engine_;
};

}  // namespace rotor_stator::tests
