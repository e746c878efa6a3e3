#include "continuation/branch_stability.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>

#include "io/errors.hpp"

namespace rotor_stator {

namespace {

using Complex = std::complex<double>;

constexpr Bifurcation located_kinds[] = {
    Bifurcation::plus_one, Bifurcation::period_doubling, Bifurcation::neimark_sacker};

/** The quantity that changes its sign at a bifurcation. */
double test_value(Bifurcation kind, const Multipliers& multipliers)
{
  Complex product = 1;
  if (kind == Bifurcation::neimark_sacker)
    for (std::size_t i = 0; i < multipliers.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        product *= 1.0 - multipliers[i] * multipliers[j];
  else
    for (const Complex& mu : multipliers)
      product *= kind == Bifurcation::plus_one ? 1.0 - mu : 1.0 + mu;
  return product.real();
}

/** Whether the two multipliers with the product nearest to 1 are a complex pair. */
bool is_complex_pair(const Multipliers& multipliers)
{
  double least = std::numeric_limits<double>::infinity();
  bool complex = false;
  for (std::size_t i = 0; i < multipliers.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double off = std::abs(1.0 - multipliers[i] * multipliers[j]);
      if (off >= least) continue;
      least = off;
      complex = multipliers[i].imag() != 0;
    }
  return complex;
}

/** How far a multiplier is from where it passes the circle there: from +1, from -1, one
    of a pair from the circle. */
double distance(Bifurcation kind, Complex mu)
{
  if (kind == Bifurcation::plus_one) return std::abs(1.0 - mu);
  if (kind == Bifurcation::period_doubling) return std::abs(1.0 + mu);
  return mu.imag() != 0 ? std::abs(1 - std::abs(mu))
                        : std::numeric_limits<double>::infinity();
}

/** The nearest. */
Complex passing(Bifurcation kind, const Multipliers& multipliers)
{
  return *std::ranges::min_element(multipliers, {},
                                   [kind](Complex mu) { return distance(kind, mu); });
}

/** Multipliers outside the unit circle. */
auto unstable_count(const StablePoint& point)
{
  return std::ranges::count_if(point.floquet.multipliers,
                               [](Complex mu) { return std::abs(mu) > 1; });
}

bool changes(Bifurcation kind, const StablePoint& a, const StablePoint& b)
{
  return test_value(kind, a.floquet.multipliers) *
             test_value(kind, b.floquet.multipliers) <
         0;
}

constexpr double tolerance = 1e-7;  ///< of the bifurcations' speeds, relative

struct Walk {
  Curve& curve;
  const FloquetAt& floquet_at;
  double widest;
  std::vector<StablePoint> own = {};  ///< points of the branch
  BranchStability result = {};

  BranchStability along(const Branch& branch, const std::vector<bool>& chosen)
  {
    for (std::size_t folds = 0; const BranchPoint& point : branch.points) {
      const bool is_fold =
          folds < branch.folds.size() && point.motion.omega == branch.folds[folds];
      if (is_fold) ++folds;
      own.push_back({point, {}, is_fold ? Bifurcation::fold : Bifurcation::none});
    }
    /** The points themselves first: they are what is left where the work does not go
        further. */
    std::vector<std::size_t> places;
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (!chosen.empty() && !chosen[k]) continue;
      places.push_back(k);
      examine(own[k]);
    }
    /** Points whose multipliers could not be had, from the other end, where a neighbour
        has its own. */
    for (std::size_t i = places.size(); i-- > 1;) {
      StablePoint& before = own[places[i - 1]];
      if (before.examined() || !own[places[i]].examined()) continue;
      --result.failed;
      examine(before);
    }
    result.points.push_back(own.front());
    for (std::size_t i = 1; i < places.size(); ++i) pass(places[i - 1], places[i]);
    return std::move(result);
  }

  void examine(StablePoint& point)
  {
    try {
      point.floquet = floquet_at(point.point);
    } catch (const NoSolution& error) {
      if (result.failed++ == 0) result.failure = error.what();
    }
  }

  /** From point a of the branch, the last one found, to point b > a. */
  void pass(std::size_t a, std::size_t b)
  {
    constexpr int most_halvings = 6;  // of a step of the branch
    if (b == a + 1) return go_to(own[b], most_halvings);
    if (own[a].examined() && own[b].examined() &&
        ((unstable_count(own[a]) == 0) != (unstable_count(own[b]) == 0) ||
         is_wide(own[a], own[b]))) {
      const std::size_t middle = a + (b - a) / 2;
      examine(own[middle]);
      pass(a, middle);
      return pass(middle, b);
    }
    const char* const verdict = own[a].verdict();
    const bool is_of_both = std::string(verdict) == own[b].verdict();
    for (std::size_t k = a + 1; k <= b; ++k) {
      if (is_of_both) own[k].neighbours = verdict;
      result.points.push_back(own[k]);
    }
  }

  /** What happens between the last point and `next`, then `next`. */
  void go_to(StablePoint next, int halvings)
  {
    const StablePoint last = result.points.back();
    const bool are_examined = last.examined() && next.examined();
    if (are_examined && halvings > 0 && hides_something(last, next))
      if (auto middle = between(last, next)) {
        go_to(std::move(*middle), halvings - 1);
        return go_to(std::move(next), halvings - 1);
      }
    std::vector<StablePoint> passed;
    if (are_examined)
      for (const Bifurcation kind : located_kinds)
        if (changes(kind, last, next)) add(kind, last, next, passed);
    std::ranges::sort(passed, {}, [](const StablePoint& p) { return p.point.arc; });
    std::ranges::move(passed, std::back_inserter(result.points));
    result.points.push_back(std::move(next));
  }

  bool is_wide(const StablePoint& a, const StablePoint& b) const
  {
    return std::abs(a.point.motion.omega - b.point.motion.omega) > widest;
  }

  bool hides_something(const StablePoint& a, const StablePoint& b) const
  {
    constexpr double most_move = 0.5;  // of a multiplier, over max(1, |μ|)
    if (largest_move(a.floquet.multipliers, b.floquet.multipliers) > most_move ||
        is_wide(a, b))
      return true;
    const auto happened = std::ranges::count_if(
        located_kinds, [&](Bifurcation kind) { return changes(kind, a, b); });
    return happened > 1 || (happened == 0 && unstable_count(a) != unstable_count(b));
  }

  /** The point at the mean speed; none at the end of what numbers resolve. */
  std::optional<StablePoint> between(const StablePoint& a, const StablePoint& b) const
  {
    const double omega = 0.5 * (a.point.motion.omega + b.point.motion.omega);
    if (std::abs(a.point.motion.omega - b.point.motion.omega) <= tolerance * omega)
      return {};
    try {
      const BranchPoint middle = point_between(curve, a.point, b.point, omega);
      return StablePoint{middle, floquet_at(middle)};
    } catch (const NoSolution&) {
      return {};
    }
  }

  void add(Bifurcation kind, const StablePoint& a, const StablePoint& b,
           std::vector<StablePoint>& passed)
  try {
    const TestFunction test = [&](const BranchPoint& p) {
      return test_value(kind, floquet_at(p).multipliers);
    };
    StablePoint point{locate(curve, a.point, b.point, test, tolerance), {}, kind};
    point.floquet = floquet_at(point.point);
    if (kind == Bifurcation::neimark_sacker &&
        !is_complex_pair(point.floquet.multipliers))
      return;
    if (kind == Bifurcation::plus_one && (at_fold(a, point) || at_fold(b, point))) return;
    /** Where nothing passes, the multipliers of another motion begin. */
    constexpr double passes = 0.05;
    if (!(distance(kind, passing(kind, point.floquet.multipliers)) < passes)) {
      ++result.missed;
      return;
    }
    const auto modulus = [kind](const StablePoint& p) {
      return std::abs(passing(kind, p.floquet.multipliers));
    };
    const double speeds = std::abs(b.point.motion.omega - a.point.motion.omega);
    point.uncertainty = tolerance * point.point.motion.omega +
                        point.floquet.change * speeds / std::abs(modulus(b) - modulus(a));
    passed.push_back(std::move(point));
  } catch (const NoSolution&) {
    ++result.missed;
  }

  /** Whether +1 is passed at the fold itself, as far as it was located. */
  static bool at_fold(const StablePoint& fold, const StablePoint& point)
  {
    return fold.bifurcation == Bifurcation::fold &&
           std::abs(fold.point.motion.omega - point.point.motion.omega) <=
               10 * tolerance * fold.point.motion.omega;
  }
};

}  // namespace

const char* name_of(Bifurcation bifurcation)
{
  constexpr const char* names[] = {"-", "fold", "plus-one", "period-doubling",
                                   "neimark-sacker"};
  return names[static_cast<int>(bifurcation)];
}

std::vector<bool> evenly_chosen(const Branch& branch, double width, int most)
{
  const auto interval = [&](const BranchPoint& p) {
    return static_cast<long>(std::floor(p.motion.omega / width));
  };
  std::map<long, int> count, met;
  for (const BranchPoint& p : branch.points) ++count[interval(p)];
  std::vector<bool> chosen;
  for (const BranchPoint& p : branch.points) {
    const int every = (count[interval(p)] + most - 1) / most;
    chosen.push_back(met[interval(p)]++ % every == 0);
  }
  if (!chosen.empty()) chosen.front() = chosen.back() = true;
  return chosen;
}

BranchStability stability_along(Curve& curve, const Branch& branch,
                                const FloquetAt& floquet_at,
                                const std::vector<bool>& chosen, double widest)
{
  return Walk{curve, floquet_at, widest}.along(branch, chosen);
}

}  // namespace rotor_stator
