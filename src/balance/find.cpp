#include "balance/find.hpp"

#include <algorithm>
#include <cmath>

#include "balance/bearing_problem.hpp"

namespace rotor_stator {

namespace {

/** Whether only every p-th harmonic is there, for a prime p that divides K: then the
    period is shorter. */
bool repeats_sooner(const PeriodicMotion& motion, int turns)
{
  constexpr double unnoticed = 1e-5;
  const Eigen::Map<const Eigen::MatrixXd> u(motion.x.data(), motion.force.rows(),
                                            motion.force.cols());
  for (int p : {2, 3, 5, 7}) {
    if (turns % p != 0) continue;
    double all = 0, others = 0;
    for (int h = 1; h <= motion.harmonics.count(); ++h) {
      const double size = u.middleCols(2 * h - 1, 2).squaredNorm();
      all += size;
      if (h % p != 0) others += size;
    }
    if (std::sqrt(others) <= unnoticed * std::sqrt(all)) return true;
  }
  return false;
}

/** Newton from one start after the other. */
struct Finder {
  const BalanceSearch& search;
  Parameters parameters = over_turns(search.parameters, search.turns);
  Balance balance{
      bearing_problem(parameters, search.turns* search.samples, search.budget),
      search.turns* search.harmonics};
  PeriodicMotion motion = {};

  bool from(const std::string& name, const Eigen::VectorXd& x)
  {
    const long before = motion.force_samples;
    motion =
        solve(balance, search.omega / search.turns,
              resize_harmonics(x, balance.problem().dofs, balance.harmonics().count()),
              search.newton);
    motion.start = name;
    motion.force_samples += before;
    if (motion.found() && search.turns > 1 && repeats_sooner(motion, search.turns))
      motion.newton.end = NewtonEnd::shorter_period;
    if (motion.found()) motion.bodies = body_series(parameters, motion);
    return motion.found();
  }
};

}  // namespace

PeriodicMotion find_near_contact(const BalanceSearch& search)
{
  constexpr int most_from_contact = 128, few = 64, least = 3;
  const int m = search.harmonics;
  Finder finder{search};
  for (const Eigen::VectorXd& x : search.starts)
    if (finder.from("a known motion", x)) return finder.motion;
  if (search.turns > 1) return finder.motion;
  /** Its low harmonics alone mean much: with more, Newton goes most of its way on few. */
  if (m <= most_from_contact &&
      finder.from("quasi-static contact",
                  quasi_static_start(finder.parameters, search.omega, m)))
    return finder.motion;
  BalanceSearch fewer = search;
  fewer.harmonics = std::min(m / 2, few);
  if (fewer.harmonics < least) return finder.motion;
  fewer.samples = default_samples(fewer.harmonics);
  const PeriodicMotion start = find_near_contact(fewer);
  finder.motion.force_samples += start.force_samples;
  if (start.found()) finder.from("fewer harmonics", start.x);
  return finder.motion;
}

PeriodicMotion find_from(const BalanceSearch& search, const std::string& name,
                         const Eigen::VectorXd& x)
{
  Finder finder{search};
  finder.from(name, x);
  return finder.motion;
}

}  // namespace rotor_stator
