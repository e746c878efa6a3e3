#include "motion/find_periodic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "balance/bearing_problem.hpp"
#include "continuation/arc_length.hpp"
#include "io/errors.hpp"
#include "motion/closed_motion.hpp"
#include "time/settle.hpp"

namespace rotor_stator::motion {

namespace {

constexpr double well_closed = 1e-11;

/** From the end of the branch that starts at 1 Hz, or at half the speed, by arc length
    through all its folds; with few harmonics, since many see a fold at every contact
    resonance. Empty where the branch does not come so far. */
std::optional<Eigen::VectorXd> end_of_branch(const BalanceSearch& search)
{
  constexpr int few = 16;
  const Parameters& parameters = search.parameters;
  const int m = std::min(few, search.harmonics);
  const double omega = search.omega, from_omega = std::min(angular(1), omega / 2);
  ArcLengthSettings settings = arc_length_settings(parameters, search.newton);
  settings.most_evaluations = std::min(150000, 15000000 / (m * m));
  Balance balance(
      bearing_problem(parameters, std::min(search.samples, default_samples(m)),
                      search.budget.part(0.3)),
      m);
  const Branch branch =
      follow_branch(balance, from_omega, omega,
                    quasi_static_start(parameters, from_omega, m), settings);
  if (!branch.covered) return {};
  return branch.points.back().motion.x;
}

/** The distance from the motion that is known; where there is none, or more harmonics
    have not brought the solution nearer by half, from the one that is closed now. */
void add_distance(Judged& at, const BalanceSearch& search, double tolerance)
{
  const double before = at.error.larger();
  Verdict& verdict = at.verdict;
  bool is_near = verdict.found();
  if (is_near) {
    const Motion& exact = verdict.record;
    at.error = difference(motion_of(at.motion.bodies, exact.points_per_period), exact);
    is_near = at.error.larger() <= std::max(tolerance, before / 2);
  }
  if (!is_near) {
    Verdict nearer = judge(search.parameters, at.motion, search.budget, search.turns);
    if (nearer.found() || !verdict.found()) {
      verdict = std::move(nearer);
      at.error = {verdict.distance, verdict.distance_rms};
    }
  }
  verdict.distance = at.error.largest;
  verdict.distance_rms = at.error.rms;
  at.reached = verdict.found() ? at.error.larger() <= tolerance : std::isinf(tolerance);
  at.end = verdict.found()
               ? format(
                     "the nearest motion of Eq. 7 is %.2g away from the solution with "
                     "%d harmonics",
                     at.error.larger(), search.harmonics)
               : format(
                     "no motion of Eq. 7 is known near the solution with %d "
                     "harmonics: ",
                     search.harmonics) +
                     verdict.reason;
}

/** Of a motion of period KT it is known before which one it is. */
void start_from_closed(BalanceSearch& search, Verdict& verdict)
{
  constexpr int points = 256, harmonics = 64;
  ClosedMotion closed = closed_motion(search, points, well_closed);
  search.starts = {relative_series(over_turns(search.parameters, search.turns),
                                   closed.motion, search.turns * harmonics)};
  verdict = judge_through(search.parameters, search.omega, closed.state, search.budget,
                          search.turns);
  verdict.record = std::move(closed.motion);
}

}  // namespace

PeriodicMotion find_periodic(const BalanceSearch& search)
{
  PeriodicMotion motion = find_near_contact(search);
  const auto from = [&](const std::string& name, const Eigen::VectorXd& x) {
    const long before = motion.force_samples;
    motion = find_from(search, name, x);
    motion.force_samples += before;
  };
  if (motion.found()) return motion;
  if (search.turns > 1) {
    if (!search.starts.empty()) return motion;
    const Motion closed = closed_motion(search, search.samples, well_closed).motion;
    from(format("the motion of period %d T that shooting found", search.turns),
         relative_series(over_turns(search.parameters, search.turns), closed,
                         search.turns * search.harmonics));
    return motion;
  }
  try {
    from("time integration", settled_start(search, search.harmonics));
  } catch (const NoSolution&) {
    // nothing to start from
  }
  if (motion.found()) return motion;
  if (const auto x = end_of_branch(search)) from("arc length from a lower speed", *x);
  return motion;
}

Eigen::VectorXd settled_start(const BalanceSearch& search, int harmonics)
{
  const Parameters& parameters = search.parameters;
  const double omega = search.omega;
  const Settled settled = settle(parameters, omega, BasePeriod{},
                                 from_rest(parameters, omega), {}, search.budget);
  if (settled.kind != Kind::rest && settled.period != 1 && !settled.contracts)
    throw NoSolution("integration settles on no motion with one period");
  const int points = default_samples(harmonics);
  return relative_series(parameters,
                         one_period(parameters, omega, settled.at.state,
                                    {.method = "rk8",
                                     .intervals_per_period = points,
                                     .tolerance = 1e-9,
                                     .budget = search.budget}),
                         harmonics);
}

Judged judged(const BalanceSearch& search, const std::optional<double>& tolerance)
{
  Judged at{.motion = find_periodic(search)};
  at.force_samples = at.motion.force_samples;
  at.end = at.motion.newton.reason();
  if (at.motion.found())
    add_distance(at, search, tolerance.value_or(std::numeric_limits<double>::infinity()));
  return at;
}

Judged to_tolerance(BalanceSearch search, double tolerance)
{
  constexpr int first = 6, few = 48, most = 1536, most_samples = 1 << 14;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  constexpr double near = 0.1;  // farther away it is another motion
  const int turns = search.turns;
  Judged at{.error = {infinite, infinite}, .end = "no solution found"};
  try {
    if (turns > 1) start_from_closed(search, at.verdict);
    const Parameters longer = over_turns(search.parameters, turns);
    std::vector<Eigen::VectorXd> known = search.starts;
    bool is_known = false;        ///< whether the solution's own motion is
    bool is_settled = turns > 1;  ///< whether where the machine settles is
    for (int m = first; turns * m <= most && !at.reached; m *= 2) {
      search.harmonics = m;
      search.samples = std::min(default_samples(m), most_samples / turns);
      bool is_thorough = m >= few && !is_known && !is_settled;
      if (is_thorough) try {
          known.push_back(settled_start(search, few));
          search.starts.push_back(known.back());
          is_settled = true;
          is_thorough = false;
        } catch (const NoSolution&) {
          if (search.budget.used_up()) throw;
        }
      PeriodicMotion motion =
          is_thorough ? find_periodic(search) : find_near_contact(search);
      at.force_samples += motion.force_samples;
      if (!motion.found() && !at.motion.found() && m >= 4 * few) break;
      if (!motion.found()) continue;
      search.starts = known;
      search.starts.insert(search.starts.begin(), motion.x);
      at.motion = std::move(motion);
      add_distance(at, search, tolerance);
      is_known = at.verdict.found() && at.error.larger() < near;
      if (is_known)
        search.starts.insert(search.starts.begin(),
                             relative_series(longer, at.verdict.record, 2 * turns * m));
    }
  } catch (const NoSolution& none) {
    at.end = none.what();
  }
  return at;
}

}  // namespace rotor_stator::motion
