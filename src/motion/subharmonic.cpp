#include "motion/subharmonic.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "balance/bearing_problem.hpp"
#include "io/errors.hpp"
#include "motion/judge.hpp"
#include "motion/other_starts.hpp"
#include "time/eigenvalues.hpp"
#include "time/flow.hpp"
#include "time/settle.hpp"
#include "time/shooting.hpp"

namespace rotor_stator::motion {

namespace {

constexpr double local_error = 1e-11, other = 1e-5;

/** Looks for motions of period KT at one speed. */
struct Hunt {
  const Parameters& parameters;
  double omega;
  int turns;
  OperationBudget budget;
  std::vector<State> found = {};

  /** Where state `start` is after 1, 2, … K turns. */
  std::vector<State> section(const State& start) const
  {
    const auto stepper =
        flow(parameters, omega,
             {.intervals_per_period = 1, .tolerance = local_error, .budget = budget});
    std::vector<State> points;
    State state = start;
    for (int k = 0; k < turns; ++k) {
      stepper->advance(k, state);
      points.push_back(state);
    }
    return points;
  }

  /** Adds the motion that shooting over K turns closes from `start`, if it has no shorter period and is not known. */
  void add(State start)
  {
    const Shooting shooting = shoot(
        over_turns(parameters, turns), omega / turns, start,
        {.tolerance = local_error, .closed = 1e-9, .most_maps = 30, .budget = budget});
    if (!shooting.converged) return;
    const auto points = section(start);
    const auto far_from = [&](const State& state) {
      return [&](const State& point) { return apart(parameters, point, state) > other; };
    };
    const auto shorter = points.end() - 1;
    if (!std::all_of(points.begin(), shorter, far_from(start))) return;
    for (const State& known : found)
      if (!std::all_of(points.begin(), points.end(), far_from(known))) return;
    found.push_back(start);
  }

  /** Along the eigenvectors of the motion of period dT through `state` whose multipliers are near a primitive root of
      unity of order K/d. */
  void add_along_eigenvectors(const State& state, int d)
  {
    const Eigen::VectorXd sizes = state_scales(parameters);
    const PeriodMap map = period_map(
        over_turns(parameters, d), omega / d, state,
        {.intervals_per_period = 1, .tolerance = local_error, .budget = budget});
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

/** Whether only every p-th harmonic is there, for a prime p that divides K: then the period is shorter. */
bool repeats_sooner(const PeriodicMotion& motion, int turns)
{
  const Eigen::Map<const Eigen::MatrixXd> u(motion.x.data(), 2,
                                            motion.harmonics.coefficients());
  const int m = motion.harmonics.count();
  for (int p : {2, 3, 5, 7}) {
    if (turns % p != 0) continue;
    double all = 0, others = 0;
    for (int h = 1; h <= m; ++h) {
      const double size = u.middleCols(2 * h - 1, 2).squaredNorm();
      all += size;
      if (h % p != 0) others += size;
    }
    if (std::sqrt(others) <= other * std::sqrt(all)) return true;
  }
  return false;
}

/** What motions of all periods are looked for from, computed once. */
struct Sources {
  const Search& search;
  std::optional<Verdict> one_turn;  ///< on the solution of period T, if there is one
  std::optional<Settled> rest = {};

  /** Where the machine settles from rest. */
  const Settled& at_rest()
  {
    if (!rest)
      rest = settle(search.parameters, search.omega, BasePeriod{},
                    {static_start(search.parameters), 0}, {}, search.budget);
    return *rest;
  }
};

Sources sources_of(const Search& search)
{
  const PeriodicMotion solution = search_periodic(search);
  if (!solution.found()) return {search, {}};
  return {search, judge(search.parameters, solution, search.budget.part(0.5))};
}

/** States [m, m/s] at phase 0 of motions with the period KT and none shorter, K ≤ 8; those on one motion count as
    one. Empty when none was found. */
std::vector<State> states_of(Sources& from, int turns)
{
  const Search& search = from.search;
  Hunt hunt{search.parameters, search.omega, turns, search.budget};
  if (const auto& one = from.one_turn) {
    if (one->from_there.period == turns) hunt.add(one->from_there.at.state);
    if (hunt.found.empty() && one->found()) hunt.add_along_eigenvectors(one->state, 1);
  }
  if (hunt.found.empty() && from.at_rest().period == turns)
    hunt.add(from.at_rest().at.state);
  for (int d = 2; d < turns && hunt.found.empty(); ++d)
    if (turns % d == 0)
      for (const State& state : states_of(from, d)) hunt.add_along_eigenvectors(state, d);
  return hunt.found;
}

}  // namespace

PeriodicMotion solved_near(const Search& search, int turns, const State& state)
{
  const Parameters longer = over_turns(search.parameters, turns);
  const double omega = search.omega / turns;
  const int m = turns * search.harmonics, n = turns * search.samples;
  const Motion exact = one_period(
      longer, omega, state,
      {.intervals_per_period = n, .tolerance = local_error, .budget = search.budget});
  Balance balance(bearing_problem(longer, n, search.budget), m);
  PeriodicMotion motion =
      solve(balance, omega, relative_series(longer, exact, m), search.newton);
  motion.start = turns > 1
                     ? format("the motion of period %d T that shooting found", turns)
                     : "time integration";
  if (!motion.found()) return motion;
  if (repeats_sooner(motion, turns)) motion.newton.end = NewtonEnd::no_decrease;
  motion.bodies = body_series(longer, motion);
  const Motion series = motion_of(motion.bodies, n);
  motion.error = error_against(exact, series, n);
  return motion;
}

std::vector<State> subharmonic_states(const Search& search, int turns)
{
  Sources sources = sources_of(search);
  return states_of(sources, turns);
}

PeriodicMotion find_subharmonic(const Search& search, int turns,
                                std::optional<double> tolerance)
{
  constexpr int most_harmonics = 512;
  const auto states = subharmonic_states(search, turns);
  const auto none = [&](const std::string& why) {
    return NoSolution(format("%s: at %.9g Hz %s", search.parameters.file.c_str(),
                             search.omega / angular(1), why.c_str()));
  };
  if (states.empty()) throw none(format("no motion of period %d T was found", turns));
  int m = search.harmonics;
  for (;; m *= 2) {
    for (const State& state : states) {
      PeriodicMotion motion = solved_near(
          {search.parameters, search.omega, m,
           std::max(search.samples, default_samples(m)), search.newton, search.budget},
          turns, state);
      if (motion.found() && (!tolerance || motion.error->larger() <= *tolerance))
        return motion;
    }
    if (!tolerance || 2 * m > most_harmonics) break;
  }
  throw none(
      format("shooting found a motion of period %d T, and no solution with orders up "
             "to %d is near it; more with --harmonics",
             turns, m));
}

}  // namespace rotor_stator::motion
