/**
# What a Poincaré section says about a motion

The section holds the four displacements once per period T after the transient. Its spread of order k
is the largest distance between points k periods apart, over the size of the orbit: where it is below
the tolerance the motion has the period kT. A section that does not close is judged by the largest
Lyapunov exponent λ, known to a standard error s:

- chaotic if λ - 3s is above a small rate;
- quasi-periodic if |λ| is below 3s, and 3s is small enough for that to say something; where λ hardly
  scatters, a tenth of the small rate stands for 3s;
- undecided otherwise, for instance a transient that has not ended (λ < 0, no period). */
#pragma once

#include <array>
#include <vector>

#include "stability/lyapunov.hpp"

namespace rotor_stator
{

using Displacements = std::array<double, 4>;  ///< x_s, y_s, x_r, y_r [m]

enum class Verdict {
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
};

struct SectionJudgement {
  Verdict verdict;
  int period;     ///< the k of the least spread; of the first closed one where one closes
  double spread;  ///< largest distance of any two points, k = 1 [-]
  double spread_k;    ///< of order k [-]
  Exponent exponent;  ///< [1/s]
};

/** The largest distance of any two points in one displacement, over `size` [m]. */
double extent(const std::vector<Displacements>& section, double size);

/** The largest distance of two points k periods apart, over `size` [m]; at least k+1 points. */
double spread_of_order(int k, const std::vector<Displacements>& section, double size);

/** Judges a section of at least three points; only orders that it holds three times are tried. */
SectionJudgement judge_section(const std::vector<Displacements>& section, double size,
                               const Exponent& exponent, const VerdictRule& rule = {});

}  // namespace rotor_stator
