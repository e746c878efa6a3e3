#include "motion/find_periodic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "balance/bearing_problem.hpp"
#include "continuation/arc_length.hpp"
#include "io/errors.hpp"
#include "motion/closed_motion.hpp"
#include "time/settle.hpp"

namespace rotor_stator::motion {

namespace {

constexpr double well_closed = 1e-11;

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
  explicit Finder(const Search& search)
      : search_(search), longer_(over_turns(search.parameters, search.turns)),
        balance_(bearing_problem(longer_, search.turns * search.samples, search.budget),
                 search.turns * search.harmonics)
  {
  }

  PeriodicMotion run()
  {
    for (const Eigen::VectorXd& x : search_.starts)
      if (from("a known motion", x)) return std::move(motion_);
    if (search_.turns > 1 && search_.starts.empty()) from_closed();
    if (search_.turns == 1 && !from_contact() && !from_fewer() && search_.is_thorough &&
        !from_settled())
      from_branch();
    return std::move(motion_);
  }

private:
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
    if (motion_.found()) motion_.bodies = body_series(longer_, motion_);
    return motion_.found();
  }

  /** Only its low harmonics mean much: with more than 128, Newton goes most of its way on
      fewer. */
  bool from_contact()
  {
    constexpr int most = 128;
    const int m = search_.harmonics;
    return m <= most &&
           from(quasi_static_name, quasi_static_start(longer_, search_.omega, m));
  }

  bool from_fewer()
  {
    constexpr int few = 64, least = 3;
    Search fewer = search_;
    fewer.harmonics = std::min(search_.harmonics / 2, few);
    if (fewer.harmonics < least) return false;
    fewer.samples = default_samples(fewer.harmonics);
    fewer.is_thorough = false;
    const PeriodicMotion start = find_periodic(fewer);
    motion_.force_samples += start.force_samples;
    return start.found() && from("fewer harmonics", start.x);
  }

  bool from_settled()
  try {
    return from("time integration", settled_start(search_, search_.harmonics));
  } catch (const NoSolution&) {
    return false;
  }

  /** From the end of the branch that starts at 1 Hz, or at half the speed, by arc length
      through all its folds; with few harmonics, since many see a fold at every contact
      resonance. */
  bool from_branch()
  {
    constexpr int few = 16;
    const int m = std::min(few, search_.harmonics);
    const double omega = search_.omega, from_omega = std::min(angular(1), omega / 2);
    ArcLengthSettings settings = arc_length_settings(longer_, search_.newton);
    settings.most_evaluations = std::min(150000, 15000000 / (m * m));
    Balance balance(
        bearing_problem(longer_, std::min(search_.samples, default_samples(m)),
                        search_.budget.part(0.3)),
        m);
    const Branch branch = follow_branch(
        balance, from_omega, omega, quasi_static_start(longer_, from_omega, m), settings);
    return branch.covered &&
           from("arc length from a lower speed", branch.points.back().motion.x);
  }

  bool from_closed()
  {
    const Motion closed = closed_motion(search_, search_.samples, well_closed).motion;
    return from(format("the motion of period %d T that shooting found", search_.turns),
                relative_series(longer_, closed, balance_.harmonics().count()));
  }

  const Search& search_;
  Parameters longer_;
  Balance balance_;
  PeriodicMotion motion_ = {};
};

/** The distance from the motion that is known; where there is none, or more harmonics
    have not brought the solution nearer by half, from the one that is closed now. */
void add_distance(Judged& at, const Search& search, double tolerance)
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
void start_from_closed(Search& search, Verdict& verdict)
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

PeriodicMotion find_periodic(const Search& search)
{
  return Finder(search).run();
}

Eigen::VectorXd settled_start(const Search& search, int harmonics)
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

Judged judged(const Search& search, const std::optional<double>& tolerance)
{
  Judged at{.motion = find_periodic(search)};
  at.force_samples = at.motion.force_samples;
  at.end = at.motion.newton.reason();
  if (at.motion.found())
    add_distance(at, search, tolerance.value_or(std::numeric_limits<double>::infinity()));
  return at;
}

Judged to_tolerance(Search search, double tolerance)
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
      search.is_thorough = m >= few && !is_known && !is_settled;
      if (search.is_thorough) try {
          known.push_back(settled_start(search, few));
          search.starts.push_back(known.back());
          is_settled = true;
          search.is_thorough = false;
        } catch (const NoSolution&) {
          if (search.budget.used_up()) throw;
        }
      PeriodicMotion motion = find_periodic(search);
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
