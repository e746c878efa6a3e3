#include "motion/closed_motion.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <utility>

#include "io/errors.hpp"
#include "motion/find_periodic.hpp"
#include "time/eigenvalues.hpp"
#include "time/settle.hpp"
#include "time/shooting.hpp"

namespace rotor_stator::motion {

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

Motion record(const BalanceSearch& search, int turns, const State& state, int points,
              double local_error)
{
  return one_period(over_turns(search.parameters, turns), search.omega / turns, state,
                    {.intervals_per_period = points * turns,
                     .tolerance = local_error,
                     .budget = search.budget});
}

/** Looks for motions of period KT at one speed. */
struct Hunt {
  const BalanceSearch& search;
  int turns;
  std::vector<State> found = {};

  /** Where state `start` is after 1, 2, … K turns. */
  std::vector<State> section(const State& start) const
  {
    const auto steps = flow(
        search.parameters, search.omega,
        {.intervals_per_period = 1, .tolerance = hunting_error, .budget = search.budget});
    std::vector<State> points;
    State state = start;
    for (int k = 0; k < turns; ++k) {
      steps->advance(k, state);
      points.push_back(state);
    }
    return points;
  }

  /** Adds the motion that shooting over K turns closes from `start`, if it has no shorter
      period and is not known. */
  void add(State start)
  {
    constexpr double other = 1e-5;
    if (!shot(search, turns, start, hunting_error).converged) return;
    const auto points = section(start);
    const auto far_from = [&](const State& state) {
      return [&](const State& point) {
        return apart(search.parameters, point, state) > other;
      };
    };
    const auto shorter = points.end() - 1;
    if (!std::all_of(points.begin(), shorter, far_from(start))) return;
    for (const State& known : found)
      if (!std::all_of(points.begin(), points.end(), far_from(known))) return;
    found.push_back(start);
  }

  /** Along the eigenvectors of the motion of period dT through `state` whose multipliers
      are near a primitive root of unity of order K/d. */
  void add_along_eigenvectors(const State& state, int d)
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
          add(rotor_stator::state_of(vector_of(state) + size * direction));
    }
  }
};

/** What motions of all periods are looked for from, computed once. */
struct Sources {
  BalanceSearch search;
  Verdict one_turn = {};  ///< on the solution of period T, if there is one
  std::optional<Settled> rest = {};

  explicit Sources(const BalanceSearch& wanted) : search(wanted)
  {
    search.turns = 1;
    search.starts.clear();
    one_turn = judged(search).verdict;
  }

  /** Where the machine settles from rest. */
  const Settled& at_rest()
  {
    if (!rest)
      rest = settle(search.parameters, search.omega, BasePeriod{},
                    {static_start(search.parameters), 0}, {}, search.budget);
    return *rest;
  }

  /** States [m, m/s] at phase 0 of motions with the period KT and none shorter, K ≤ 8;
      those on one motion count as one. */
  std::vector<State> states(int turns)
  {
    Hunt hunt{search, turns};
    if (one_turn.from_there.period == turns) hunt.add(one_turn.from_there.at.state);
    if (hunt.found.empty() && one_turn.floquet.multipliers.size() > 0)
      hunt.add_along_eigenvectors(one_turn.state, 1);
    if (hunt.found.empty() && at_rest().period == turns) hunt.add(at_rest().at.state);
    for (int d = 2; d < turns && hunt.found.empty(); ++d)
      if (turns % d == 0)
        for (const State& state : states(d)) hunt.add_along_eigenvectors(state, d);
    return hunt.found;
  }
};

using Starts = std::vector<std::pair<std::string, std::function<std::vector<State>()>>>;

Starts starts_of(const BalanceSearch& search)
{
  const Parameters& parameters = search.parameters;
  if (search.turns > 1)
    return {{format("a motion of period %d T", search.turns),
             [&] { return Sources(search).states(search.turns); }}};
  return {{"quasi-static contact",
           [&] {
             return std::vector{!parameters.bodies->takes_explicit_steps()
                                    ? static_start(parameters)
                                    : quasi_static_state(parameters, search.omega)};
           }},
          {"few harmonics",
           [&] {
             const PeriodicMotion solution = find_near_contact(search);
             return solution.found() ? std::vector{state_of(parameters, solution)}
                                     : std::vector<State>{};
           }},
          {"time integration", [&] {
             const Instant rest{static_start(parameters), 0};
             return std::vector{
                 settle(parameters, search.omega, BasePeriod{}, rest, {}, search.budget)
                     .at.state};
           }}};
}

}  // namespace

ClosedMotion closed_motion(const BalanceSearch& search, int points, double local_error)
{
  require_rotation_period(search.parameters, "shooting");
  const int turns = search.turns;
  std::string why = "no start";
  for (const auto& [name, states] : starts_of(search))
    for (State state : states()) {
      const Shooting shooting = shot(search, turns, state, local_error);
      why = "from " + name + ": " + shooting.reason;
      if (!shooting.converged) continue;
      State finer = state;
      const Motion motion = record(search, turns, state, points, local_error);
      if (!shot(search, turns, finer, 0.01 * local_error).converged) finer = state;
      const Motion exact = record(search, turns, finer, points, 0.01 * local_error);
      return {name,          state,
              motion,        shooting.correction,
              shooting.maps, difference(motion, exact)};
    }
  throw NoSolution(format("%s: shooting closed no motion of period %s at %g Hz: %s",
                          search.parameters.file.c_str(),
                          turns > 1 ? format("%d T", turns).c_str() : "T",
                          search.omega / angular(1), why.c_str()));
}

}  // namespace rotor_stator::motion
