#include "motion/find_periodic.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>

#include "balance/bearing_problem.hpp"
#include "io/errors.hpp"
#include "time/eigenvalues.hpp"
#include "time/settle.hpp"
#include "time/shooting.hpp"

namespace rotor_stator::motion {

/**
## A motion closed by shooting */

namespace {

constexpr double hunting_error = 1e-11;

/** Shooting over `turns` turns. */
Shooting shot(const BalanceSearch& search, int turns, State& state, double local_error)
{
  return shoot(over_turns(search.parameters, turns), search.omega / turns, state,
               {.tolerance = local_error,
                .closed = std::max(1e-9, 10 * local_error),
                .most_maps = turns > 1 ? 30 : 60,
                .budget = search.budget});
}

/** Where the machine settles from rest under the constant loads. */
Settled settled_from_load(const BalanceSearch& search)
{
  return settle(search.parameters, search.omega, BasePeriod{},
                {static_start(search.parameters), 0}, {}, search.budget);
}

/** Looks for motions of period KT at one speed; what all K need is computed once. */
struct Hunt {
  BalanceSearch search;
  Verdict one_turn = {};  ///< on the solution of period T, if there is one
  Once<Settled> rest = {};

  explicit Hunt(const BalanceSearch& wanted) : search(wanted)
  {
    search.turns = 1;
    search.starts.clear();
    one_turn = judged(search).verdict;
  }

  /** Where the machine settles from rest. */
  const Settled& at_rest()
  {
    return rest([&] { return settled_from_load(search); });
  }

  /** States [m, m/s] at phase 0 of motions with the period KT and none shorter, K ≤ 8;
      those on one motion count as one. */
  std::vector<State> states(int turns)
  {
    std::vector<State> found;
    if (one_turn.from_there.period == turns)
      add(one_turn.from_there.at.state, turns, found);
    if (found.empty() && one_turn.floquet.multipliers.size() > 0)
      add_along_eigenvectors(one_turn.state, 1, turns, found);
    if (found.empty() && at_rest().period == turns) add(at_rest().at.state, turns, found);
    for (int d = 2; d < turns && found.empty(); ++d)
      if (turns % d == 0)
        for (const State& state : states(d))
          add_along_eigenvectors(state, d, turns, found);
    return found;
  }

  /** Adds the motion that shooting over K turns closes from `start`, if it has no shorter
      period and is not known. */
  void add(State start, int turns, std::vector<State>& found) const
  {
    constexpr double same = 1e-5;
    if (!shot(search, turns, start, hunting_error).converged) return;
    const auto steps = flow(
        search.parameters, search.omega,
        {.intervals_per_period = 1, .tolerance = hunting_error, .budget = search.budget});
    std::vector<State> section;  // after 1, 2, … K turns
    State state = start;
    for (int k = 0; k < turns; ++k) {
      steps->advance(k, state);
      section.push_back(state);
    }
    const auto passes = [&](const State& other, int first) {
      return std::any_of(section.begin(), section.begin() + first, [&](const State& at) {
        return !(apart(search.parameters, at, other) > same);
      });
    };
    const auto is_known = [&](const State& known) { return passes(known, turns); };
    if (passes(start, turns - 1) || std::ranges::any_of(found, is_known)) return;
    found.push_back(start);
  }

  /** Along the eigenvectors of the motion of period dT through `state` whose multipliers
      are near a primitive root of unity of order K/d. */
  void add_along_eigenvectors(const State& state, int d, int turns,
                              std::vector<State>& found) const
  {
    const Eigen::VectorXd sizes = state_scales(search.parameters);
    const PeriodMap map = period_map(
        over_turns(search.parameters, d), search.omega / d, state,
        {.intervals_per_period = 1, .tolerance = hunting_error, .budget = search.budget});
    const auto [values, vectors] = eigensystem(
        sizes.cwiseInverse().asDiagonal() * map.derivative * sizes.asDiagonal(), true);
    const int order = turns / d;
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      const std::complex<double> mu = values[i];
      const double angle = std::arg(mu) * order / (2 * std::numbers::pi);
      const int root = static_cast<int>(std::lround(angle));
      /** Of a pair one is enough. */
      if (mu.imag() < 0 || std::abs(mu) < 0.5 || std::abs(angle - root) > 0.25 ||
          std::gcd(root, order) != 1)
        continue;
      const Eigen::VectorXd along = vectors.col(i).real();
      const Eigen::VectorXd direction =
          along.cwiseProduct(sizes) / along.cwiseAbs().maxCoeff();
      const std::size_t known = found.size();
      for (double size : {0.003, -0.003, 0.01, -0.01, 0.03, -0.03, 0.1, -0.1, 0.3, -0.3})
        if (found.size() == known)
          add(rotor_stator::state_of(vector_of(state) + size * direction), turns, found);
    }
  }
};

/** From where shooting starts, and what it is called. */
struct Start {
  std::string name;
  std::function<std::vector<State>()> states;
};

std::vector<Start> starts_of(const BalanceSearch& search)
{
  const Parameters& parameters = search.parameters;
  if (search.turns > 1)
    return {{format("a motion of period %d T", search.turns),
             [&] { return Hunt(search).states(search.turns); }}};
  const auto contact = [&] {
    return std::vector{parameters.bodies->takes_explicit_steps()
                           ? quasi_static_state(parameters, search.omega)
                           : static_start(parameters)};
  };
  const auto balance = [&] {
    const PeriodicMotion solution = find_near_contact(search);
    return solution.found() ? std::vector{state_of(parameters, solution)}
                            : std::vector<State>{};
  };
  const auto settled = [&] { return std::vector{settled_from_load(search).at.state}; };
  return {{"quasi-static contact", contact},
          {"few harmonics", balance},
          {"time integration", settled}};
}

}  // namespace

ClosedMotion closed_motion(const BalanceSearch& search, int points, double local_error)
{
  require_rotation_period(search.parameters, "shooting");
  const int turns = search.turns;
  const auto record = [&](const State& state, double error) {
    return one_period(over_turns(search.parameters, turns), search.omega / turns, state,
                      {.intervals_per_period = points * turns,
                       .tolerance = error,
                       .budget = search.budget});
  };
  std::string why = "no start";
  for (const auto& [name, states] : starts_of(search))
    for (State state : states()) {
      const Shooting shooting = shot(search, turns, state, local_error);
      why = "from " + name + ": " + shooting.reason;
      if (!shooting.converged) continue;
      State finer = state;
      const Motion motion = record(state, local_error);
      if (!shot(search, turns, finer, 0.01 * local_error).converged) finer = state;
      const Motion exact = record(finer, 0.01 * local_error);
      return {name,          state,
              motion,        shooting.correction,
              shooting.maps, difference(motion, exact)};
    }
  throw NoSolution(format("%s: shooting closed no motion of period %s at %g Hz: %s",
                          search.parameters.file.c_str(),
                          turns > 1 ? format("%d T", turns).c_str() : "T",
                          search.omega / angular(1), why.c_str()));
}

/**
## Harmonic balance */

namespace {

constexpr double well_closed = 1e-11;

/** One base period of what Eq. 7 settles on from rest, as coefficients of the relative
    motion [m]. Throws NoSolution where the integration breaks down, or the motion neither
    closes nor attracts its neighbours: where a chaotic one is differs from processor to
    processor. */
Eigen::VectorXd settled_start(const BalanceSearch& search, int harmonics)
{
  const Parameters& parameters = search.parameters;
  const double omega = search.omega;
  const Settled settled = settle(parameters, omega, BasePeriod{},
                                 from_rest(parameters, omega), {}, search.budget);
  if (settled.kind != Kind::rest && settled.period != 1 && !settled.contracts)
    throw NoSolution("integration settles on no motion with one period");
  const Motion motion = one_period(parameters, omega, settled.at.state,
                                   {.intervals_per_period = default_samples(harmonics),
                                    .tolerance = 1e-9,
                                    .budget = search.budget});
  return relative_series(parameters, motion, harmonics);
}

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
  Verdict& verdict = at.verdict;
  bool is_near = verdict.found();
  if (is_near) {
    const double before = verdict.distance.larger();
    const Motion& exact = verdict.record;
    verdict.distance =
        difference(motion_of(at.motion.bodies, exact.points_per_period), exact);
    is_near = verdict.distance.larger() <= std::max(tolerance, before / 2);
  }
  if (!is_near) {
    Verdict nearer = judge(search.parameters, at.motion, search.budget, search.turns);
    if (nearer.found() || !verdict.found()) verdict = std::move(nearer);
  }
  const double away = verdict.distance.larger();
  at.reached = verdict.found() ? away <= tolerance : std::isinf(tolerance);
  at.end =
      verdict.found()
          ? format(
                "the nearest motion of Eq. 7 is %.2g away from the solution with %d "
                "harmonics",
                away, search.harmonics)
          : format("no motion of Eq. 7 is known near the solution with %d harmonics: %s",
                   search.harmonics, verdict.reason.c_str());
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
  Judged at{.end = "no solution found"};
  try {
    if (turns > 1) start_from_closed(search, at.verdict);
    at.verdict.distance = {infinite, infinite};
    const Parameters longer = over_turns(search.parameters, turns);
    std::vector<Eigen::VectorXd> known = search.starts;
    bool is_known = false;                     ///< whether the solution's own motion is
    bool is_settled = turns > 1;               ///< whether where the machine settles is
    bool may_settle = true;                    ///< on a motion of one turn
    const int each = search.parameters.turns;  // so that a turn has whole numbers
    for (int least = first; turns * least <= most && !at.reached; least *= 2) {
      const int m = (least + each - 1) / each * each;
      search.harmonics = m;
      const int samples = std::min(default_samples(m), most_samples / turns);
      search.samples = (samples + each - 1) / each * each;
      bool is_thorough = m >= few && !is_known && !is_settled;
      if (is_thorough && may_settle) try {
          known.push_back(settled_start(search, few));
          search.starts.push_back(known.back());
          is_settled = true;
          is_thorough = false;
        } catch (const NoSolution&) {
          if (search.budget.used_up()) throw;
          may_settle = false;
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
      is_known = at.verdict.found() && at.verdict.distance.larger() < near;
      if (is_known)
        search.starts.insert(search.starts.begin(),
                             relative_series(longer, at.verdict.record, 2 * turns * m));
    }
  } catch (const NoSolution& none) {
    at.end = none.what();
  }
  return at;
}

double uniform(std::mt19937_64& generator)
{
  return 2 * static_cast<double>(generator() >> 11) * 0x1p-53 - 1;
}

OtherStarts other_starts(const Parameters& parameters, SpeedRange range, int harmonics,
                         int speeds, std::uint64_t seed, const OperationBudget& budget)
{
  constexpr int randoms = 8;  // at each speed
  /** The motion of the rings is free to be several clearances wide. */
  const double size = 2 * scales(parameters).length;
  std::mt19937_64 generator(seed);
  const OperationBudget half = budget.part(0.5);
  OtherStarts starts;
  for (int k = 1; k <= speeds; ++k) {
    const double omega = range.from + (range.to - range.from) * k / (speeds + 1);
    const auto add = [&](Eigen::VectorXd x, const std::string& name) {
      starts.candidates.push_back(
          {.omega = omega, .harmonics = harmonics, .x = std::move(x), .start = name});
    };
    const OperationBudget share = half.part(1.0 / (speeds - k + 1));
    try {
      add(settled_start({.parameters = parameters,
                         .omega = omega,
                         .harmonics = harmonics,
                         .budget = share},
                        harmonics),
          "time integration");
    } catch (const NoSolution&) {
      // cut off, broken down or not settled: only random starts here
      starts.cut_off += share.used_up();
    }
    for (int j = 1; j <= randoms; ++j) {
      Eigen::VectorXd x(2 * (2 * harmonics + 1));
      for (Eigen::Index i = 0; i < x.size(); ++i) {
        const double order = static_cast<double>((i / 2 + 1) / 2);
        x[i] = size * uniform(generator) / ((1 + order) * (1 + order));
      }
      add(std::move(x), format("random start %d of seed %llu", j,
                               static_cast<unsigned long long>(seed)));
    }
  }
  return starts;
}

}  // namespace rotor_stator::motion
