#include "motion/other_starts.hpp"

#include "io/errors.hpp"

namespace rotor_stator::motion {

double uniform(std::mt19937_64& generator)
{
  return 2 * static_cast<double>(generator() >> 11) * 0x1p-53 - 1;
}

namespace {

Eigen::VectorXd random_coefficients(double size, int harmonics,
                                    std::mt19937_64& generator)
{
  Eigen::VectorXd x(2 * (2 * harmonics + 1));
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    const double order = static_cast<double>((k / 2 + 1) / 2);
    x[k] = size * uniform(generator) / ((1 + order) * (1 + order));
  }
  return x;
}

}  // namespace

FoundStarts other_starts(const Parameters& parameters, SpeedRange range, int harmonics,
                         const OtherStarts& wanted, const OperationBudget& budget)
{
  /** The motion of the rings is free to be several clearances wide. */
  const double size = 2 * scales(parameters).length;
  std::mt19937_64 generator(wanted.seed);
  const OperationBudget half = budget.part(0.5);
  FoundStarts starts;
  for (int k = 1; k <= wanted.speeds; ++k) {
    const double omega = range.from + (range.to - range.from) * k / (wanted.speeds + 1);
    const OperationBudget share = half.part(1.0 / (wanted.speeds - k + 1));
    try {
      starts.candidates.push_back({.omega = omega,
                                   .harmonics = harmonics,
                                   .x = settled_start({.parameters = parameters,
                                                       .omega = omega,
                                                       .harmonics = harmonics,
                                                       .budget = share},
                                                      harmonics),
                                   .start = "time integration"});
    } catch (const NoSolution&) {
      // cut off, broken down or not settled: only random starts here
      starts.cut_off += share.used_up();
    }
    for (int j = 1; j <= wanted.random; ++j)
      starts.candidates.push_back(
          {.omega = omega,
           .harmonics = harmonics,
           .x = random_coefficients(size, harmonics, generator),
           .start = format("random start %d of seed %llu", j,
                           static_cast<unsigned long long>(wanted.seed))});
  }
  return starts;
}

}  // namespace rotor_stator::motion
