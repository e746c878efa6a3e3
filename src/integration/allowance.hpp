/**
# What a time integration may cost

The evaluations of Eq. 7 are counted as they are made, and paid for one by one where there is an
account: an integration that breaks down has been paid up to there. */
#pragma once

#include "model/work.hpp"

namespace rotor_stator
{

class Allowance
{
public:
  /** At most `most` evaluations: 1e9 are half a minute of RK4. */
  explicit Allowance(double most = 1e9) : most_(most) {}

  /** At `price` operations each from `work`. */
  Allowance(double most, Work work, double price)
      : most_(most), work_(std::move(work)), price_(price)
  {
  }

  /** Counts `more` evaluations and pays for them. Throws NoSolution when there are not so many left. */
  void take(long more);

  /** The same for one, false instead of thrown: for callbacks that C calls. */
  bool took_one();

  long used() const { return used_; }

private:
  double most_;
  Work work_;
  double price_ = 0;
  long used_ = 0;
};

}  // namespace rotor_stator
