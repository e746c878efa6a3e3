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
class Finder {
public:
  explicit Finder(const BalanceSearch& search)
      : search_(search), parameters_(over_turns(search.parameters, search.turns)),
        balance_(
            bearing_problem(parameters_, search.turns * search.samples, search.budget),
            search.turns * search.harmonics)
  {
  }

  bool from(const std::string& name, const Eigen::VectorXd& x)
  {
    const long before = motion_.force_samples;
    motion_ = {
        .omega = search_.omega / search_.turns,
        .x = resize_harmonics(x, balance_.problem().dofs, balance_.harmonics().count()),
        .start = name};
    solve(balance_, motion_, search_.newton);
    motion_.force_samples += before;
    if (search_.turns > 1 && repeats_sooner(motion_, search_.turns))
      motion_.newton.end = NewtonEnd::no_decrease;
    if (motion_.found()) motion_.bodies = body_series(parameters_, motion_);
    return motion_.found();
  }

  bool from_given()
  {
    return std::ranges::any_of(search_.starts, [&](const Eigen::VectorXd& x) {
      return from("a known motion", x);
    });
  }

  /** Only its low harmonics mean much: with more than 128, Newton goes most of its way on
      fewer. */
  bool from_contact()
  {
    constexpr int most = 128;
    const int m = search_.harmonics;
    return m <= most && from("quasi-static contact",
                             quasi_static_start(parameters_, search_.omega, m));
  }

  bool from_fewer()
  {
    constexpr int few = 64, least = 3;
    BalanceSearch fewer = search_;
    fewer.harmonics = std::min(search_.harmonics / 2, few);
    if (fewer.harmonics < least) return false;
    fewer.samples = default_samples(fewer.harmonics);
    const PeriodicMotion start = find_near_contact(fewer);
    motion_.force_samples += start.force_samples;
    return start.found() && from("fewer harmonics", start.x);
  }

  PeriodicMotion motion() { return std::move(motion_); }

private:
  const BalanceSearch& search_;
  Parameters parameters_;
  Balance balance_;
  PeriodicMotion motion_ = {};
};

}  // namespace

PeriodicMotion find_near_contact(const BalanceSearch& search)
{
  Finder finder(search);
  if (!finder.from_given() && search.turns == 1 && !finder.from_contact())
    finder.from_fewer();
  return finder.motion();
}

PeriodicMotion find_from(const BalanceSearch& search, const std::string& name,
                         const Eigen::VectorXd& x)
{
  Finder finder(search);
  finder.from(name, x);
  return finder.motion();
}

}  // namespace rotor_stator
