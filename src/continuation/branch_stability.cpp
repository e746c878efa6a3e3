#include "continuation/branch_stability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "continuation/locate.hpp"
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

/** The modulus of the multiplier that passes the circle there: of those nearest to +1, to
    -1, of the pair nearest to it. */
double passing_modulus(Bifurcation kind, const Multipliers& multipliers)
{
  const auto off = [kind](Complex mu) {
    if (kind == Bifurcation::plus_one) return std::abs(1.0 - mu);
    if (kind == Bifurcation::period_doubling) return std::abs(1.0 + mu);
    return mu.imag() != 0 ? std::abs(1 - std::abs(mu))
                          : std::numeric_limits<double>::infinity();
  };
  return std::abs(*std::ranges::min_element(multipliers, {}, off));
}

/** Multipliers outside the unit circle. */
auto unstable_count(const StablePoint& point)
{
  const Multipliers& multipliers = point.floquet.multipliers;
  return std::count_if(multipliers.begin(), multipliers.end(),
                       [](Complex mu) { return std::abs(mu) > 1; });
}

bool changes(Bifurcation kind, const StablePoint& a, const StablePoint& b)
{
  return test_value(kind, a.floquet.multipliers) *
             test_value(kind, b.floquet.multipliers) <
         0;
}

struct Walk {
  Curve& curve;
  const ArcLengthSettings& arc_length;
  const FloquetAt& floquet_at;
  const BranchStabilitySettings& settings;
  std::vector<bool> is_fold = {};  ///< of the branch's points
  BranchStability result = {};

  BranchStability along(const Branch& branch)
  {
    mark_folds(branch);
    /** The points themselves first: they are what is left where the work does not go
        further. */
    std::vector<std::pair<std::size_t, StablePoint>> examined;
    for (std::size_t k = 0; k < branch.points.size(); ++k)
      if (settings.chosen.empty() || settings.chosen[k])
        examined.emplace_back(k, known(branch, k));
    retry(branch, examined);
    std::size_t last = 0;
    for (auto& [k, next] : examined) {
      if (k == 0)
        result.points.push_back(std::move(next));
      else
        pass(branch, last, k, std::move(next));
      last = k;
    }
    return std::move(result);
  }

  /** Points whose multipliers could not be had, from the other end, where a neighbour has
      its own. */
  void retry(const Branch& branch,
             std::vector<std::pair<std::size_t, StablePoint>>& examined)
  {
    for (auto point = examined.rbegin(); point != examined.rend(); ++point) {
      if (point->second.examined() || point == examined.rbegin() ||
          !std::prev(point)->second.examined())
        continue;
      --result.failed;
      point->second = known(branch, point->first);
    }
  }

  void mark_folds(const Branch& branch)
  {
    std::size_t folds = 0;
    for (const BranchPoint& point : branch.points) {
      is_fold.push_back(folds < branch.folds.size() &&
                        point.motion.omega == branch.folds[folds]);
      if (is_fold.back()) ++folds;
    }
  }

  StablePoint unknown(const Branch& branch, std::size_t k) const
  {
    return {branch.points[k], {}, is_fold[k] ? Bifurcation::fold : Bifurcation::none};
  }

  StablePoint known(const Branch& branch, std::size_t k)
  {
    StablePoint point = unknown(branch, k);
    try {
      point.floquet = floquet_at(point.point);
    } catch (const NoSolution& error) {
      if (result.failed++ == 0) result.failure = error.what();
    }
    return point;
  }

  static bool is_stable(const StablePoint& point) { return unstable_count(point) == 0; }

  /** From point a of the branch, the last one found, to point b > a, whose multipliers
      are `next`. */
  void pass(const Branch& branch, std::size_t a, std::size_t b, StablePoint next)
  {
    const StablePoint& last = result.points.back();
    if (b == a + 1) return go_to(std::move(next), settings.most_halvings);
    if (last.examined() && next.examined() &&
        (is_stable(last) != is_stable(next) || is_wide(last, next))) {
      const std::size_t middle = a + (b - a) / 2;
      pass(branch, a, middle, known(branch, middle));
      return pass(branch, middle, b, std::move(next));
    }
    for (std::size_t k = a + 1; k < b; ++k) result.points.push_back(unknown(branch, k));
    result.points.push_back(std::move(next));
  }

  /** What happens between the last point and `next`, then `next`. */
  void go_to(StablePoint next, int halvings)
  {
    const StablePoint last = result.points.back();
    if (!last.examined() || !next.examined()) {
      result.points.push_back(std::move(next));
      return;
    }
    if (halvings > 0 && hides_something(last, next)) {
      if (auto middle = between(last, next)) {
        go_to(std::move(*middle), halvings - 1);
        return go_to(std::move(next), halvings - 1);
      }
    }
    std::vector<StablePoint> passed;
    for (const Bifurcation kind : located_kinds)
      if (changes(kind, last, next)) add(kind, last, next, passed);
    std::sort(passed.begin(), passed.end(),
              [](const auto& a, const auto& b) { return a.point.arc < b.point.arc; });
    for (StablePoint& point : passed) result.points.push_back(std::move(point));
    result.points.push_back(std::move(next));
  }

  bool is_wide(const StablePoint& a, const StablePoint& b) const
  {
    return std::abs(a.point.motion.omega - b.point.motion.omega) > settings.widest;
  }

  bool hides_something(const StablePoint& a, const StablePoint& b) const
  {
    if (largest_move(a.floquet.multipliers, b.floquet.multipliers) > settings.most_move ||
        is_wide(a, b))
      return true;
    const auto happened =
        std::count_if(std::begin(located_kinds), std::end(located_kinds),
                      [&](Bifurcation kind) { return changes(kind, a, b); });
    return happened > 1 || (happened == 0 && unstable_count(a) != unstable_count(b));
  }

  StablePoint examined(BranchPoint point) const
  {
    Floquet floquet = floquet_at(point);
    return {std::move(point), std::move(floquet)};
  }

  /** The point at the mean speed; none at the end of what numbers resolve. */
  std::optional<StablePoint> between(const StablePoint& a, const StablePoint& b) const
  {
    const double omega = 0.5 * (a.point.motion.omega + b.point.motion.omega);
    if (std::abs(a.point.motion.omega - b.point.motion.omega) <=
        settings.tolerance * omega)
      return {};
    try {
      return examined(point_between(curve, a.point, b.point, omega, arc_length));
    } catch (const NoSolution&) {
      return {};
    }
  }

  void add(Bifurcation kind, const StablePoint& a, const StablePoint& b,
           std::vector<StablePoint>& passed)
  {
    const TestFunction test = [&](const BranchPoint& p) {
      return test_value(kind, floquet_at(p).multipliers);
    };
    StablePoint point;
    try {
      point =
          examined(locate(curve, a.point, b.point, test, settings.tolerance, arc_length));
    } catch (const NoSolution&) {
      ++result.missed;
      return;
    }
    if (kind == Bifurcation::neimark_sacker &&
        !is_complex_pair(point.floquet.multipliers))
      return;
    if (kind == Bifurcation::plus_one && (at_fold(a, point) || at_fold(b, point))) return;
    point.bifurcation = kind;
    const auto modulus = [kind](const StablePoint& p) {
      return passing_modulus(kind, p.floquet.multipliers);
    };
    const double speeds = std::abs(b.point.motion.omega - a.point.motion.omega);
    point.uncertainty = settings.tolerance * point.point.motion.omega +
                        point.floquet.change * speeds / std::abs(modulus(b) - modulus(a));
    passed.push_back(std::move(point));
  }

  /** Whether +1 is passed at the fold itself, as far as it was located. */
  bool at_fold(const StablePoint& fold, const StablePoint& point) const
  {
    return fold.bifurcation == Bifurcation::fold &&
           std::abs(fold.point.motion.omega - point.point.motion.omega) <=
               10 * settings.tolerance * fold.point.motion.omega;
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
                                const ArcLengthSettings& arc_length,
                                const FloquetAt& floquet_at,
                                const BranchStabilitySettings& settings)
{
  return Walk{curve, arc_length, floquet_at, settings}.along(branch);
}

}  // namespace rotor_stator
