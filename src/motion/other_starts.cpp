#include "motion/other_starts.hpp"

#include <numbers>

#include "balance/bearing_problem.hpp"
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

/** The solution at the end of the branch that starts at 1 Hz, or at half the speed, by arc length
    through all its folds; few harmonics only, since many see a fold at every contact resonance. */
Eigen::VectorXd along_the_branch(const Search& search)
{
  constexpr int most_harmonics = 16;
  const int harmonics = search.harmonics;
  if (harmonics > most_harmonics) return {};
  const double from = std::min(2 * std::numbers::pi, search.omega / 2);
  ArcLengthSettings settings = arc_length_settings(search.parameters, search.newton);
  /** One start among others, not a study: as long for many harmonics as for few. */
  settings.most_evaluations = std::min(150000, 15000000 / (harmonics * harmonics));
  Balance balance(
      bearing_problem(search.parameters, search.samples, search.budget.part(0.3)),
      harmonics);
  const Branch branch =
      follow_branch(balance, from, search.omega,
                    quasi_static_start(search.parameters, from, harmonics), settings);
  return branch.covered ? branch.points.back().motion.x : Eigen::VectorXd();
}

}  // namespace

PeriodicMotion search_periodic(const Search& search)
{
  return find_periodic(search, {{"arc length from a lower speed",
                                 [&] { return along_the_branch(search); }}});
}

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
      starts.candidates.push_back(
          {.omega = omega,
           .harmonics = harmonics,
           .x = integrated_start(parameters, omega, harmonics, share),
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
