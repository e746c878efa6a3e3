/**
# The largest Lyapunov exponent

The mean rate at which two neighbouring motions part,

$$\lambda = \lim_{t \to \infty} \frac{1}{t} \ln \frac{|\delta(t)|}{|\delta(0)|},$$

after Benettin: both motions are integrated by the same stepper, and after every output interval the
neighbour is pulled back to its first distance along the line that joins them. No force needs a
derivative, and the contact's missing second derivative does no harm. On a T-periodic motion λ is
ln|μ|/T of the largest Floquet multiplier. The growth is added up over blocks; the scatter of the means
of ten batches of them gives the standard error. */
#pragma once

#include <functional>
#include <vector>

#include "integration/time_stepper.hpp"
#include "stability/period_map.hpp"

namespace rotor_stator
{

/** λ [1/s] and its standard error [1/s]. */
struct Exponent {
  double value, error;
};

/** Mean of the growth rates [1/s] of equal blocks in order, at least two, and its standard error from
    the means of at most ten batches. */
Exponent exponent_of(const std::vector<double>& rates);

/** A motion with a neighbour. */
class Neighbours
{
public:
  /** `stepper`: of fixed step, since an adaptive one takes other steps for the neighbour and its
      error would pass for growth. `scales`: sizes of the eight components, which make the distance a number. */
  Neighbours(TimeStepper stepper, int intervals_per_period, const Vector8& scales,
             const State& start);

  /** Advances by one period; `visit`, if any, sees the state at the start of each interval.
      Returns ln of the growth of the distance [-]. Throws NoSolution when the motion diverges. */
  double advance_one_period(const std::function<void(const State&)>& visit = {});

  const State& state() const { return state_; }

private:
  double pull_back();

  TimeStepper stepper_;
  int intervals_;
  Vector8 scales_;
  State state_, neighbour_;
  long periods_ = 0;
};

}  // namespace rotor_stator
