/**
# The largest Lyapunov exponent

The exponent tells whether a motion is chaotic. It is the mean rate at which two neighbouring motions part,

$$\lambda = \lim_{t \to \infty} \frac{1}{t} \ln \frac{|\delta(t)|}{|\delta(0)|},$$

after Benettin: both motions are integrated by the same stepper, and after every output interval the
neighbour is pulled back to its first distance along the line that joins them. No force needs a
derivative, and the contact's missing second derivative does no harm. On a T-periodic motion λ is
ln|μ|/T of the largest Floquet multiplier. The growth is added up over blocks; the scatter of the means
of ten batches of them gives the standard error. */
#pragma once

#include <functional>
#include <vector>

#include "time/period_map.hpp"
#include "time/steady_state.hpp"

namespace rotor_stator {

/** λ [1/s] and its standard error [1/s]: `batch_mean` of the growth rates of equal blocks in order. */
using Exponent = BatchMean;

/** A motion with a neighbour. */
class TrajectoryPair {
public:
  /** `stepper`: of fixed step, since an adaptive one takes other steps for the neighbour and its
      error would pass for growth. `scales`: sizes of the components, which make the distance a number. */
  TrajectoryPair(TimeStepper stepper, int intervals_per_period,
                 const Eigen::VectorXd& scales, const State& start,
                 long first_period = 0);

  /** Advances by one period; `visit`, if any, sees the state at the start of each interval.
      Returns ln of the growth of the distance [-]. Throws NoSolution when the motion diverges. */
  double advance_one_period(const std::function<void(const State&)>& visit = {});

  const State& state() const { return state_; }

private:
  double pull_back();

  TimeStepper stepper_;
  int intervals_;
  Eigen::VectorXd scales_;
  State state_, neighbour_;
  long periods_;  ///< since t = 0
};

/**
## What a Poincaré section says about a motion

The section holds the four displacements once per period T after the transient. Its spread of order k
is the largest distance between points k periods apart, over the size of the orbit: where it is below
the tolerance the motion has the period kT. A section that does not close is judged by the largest
Lyapunov exponent λ, known to a standard error s:

- chaotic if λ - 3s is above a small rate;
- quasi-periodic if |λ| is below 3s, and 3s is small enough for that to say something; where λ hardly
  scatters, a tenth of the small rate stands for 3s;
- quasi-periodic too if λ + 3s < 0 and two frequencies drive the machine: neighbours come to a motion that
  both phases decide;
- undecided otherwise, for instance a transient that has not ended (λ < 0, no period). */

enum class SectionKind {
  undecided = 0,
  periodic = 1,     ///< with period T
  subharmonic = 2,  ///< with period kT, k > 1
  quasi_periodic = 3,
  chaotic = 4
};

struct VerdictRule {
  double periodic = 1e-6;  ///< largest spread of a closed section [-]
  int most_period = 16;    ///< k
  double zero_rate = 0.1;  ///< the small rate [1/s]
  bool is_driven_twice = false;
};

struct SectionJudgement {
  SectionKind verdict;
  int period;     ///< the k of the least spread; of the first closed one where one closes
  double spread;  ///< largest distance of any two points, k = 1 [-]
  double spread_k;    ///< of order k [-]
  Exponent exponent;  ///< [1/s]
};

/** Judges a section of at least three points; only orders that it holds three times are tried. */
SectionJudgement judge_section(const std::vector<Displacements>& section, double size,
                               const Exponent& exponent, const VerdictRule& rule = {});

}  // namespace rotor_stator
