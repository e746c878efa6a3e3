#include "stability/branch_stability.hpp"

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

double through_plus_one(const Multipliers& multipliers)
{
  Complex product = 1;
  for (const Complex& mu : multipliers) product *= 1.0 - mu;
  return product.real();
}

double through_minus_one(const Multipliers& multipliers)
{
  Complex product = 1;
  for (const Complex& mu : multipliers) product *= 1.0 + mu;
  return product.real();
}

double through_the_circle(const Multipliers& multipliers)
{
  Complex product = 1;
  for (std::size_t i = 0; i < multipliers.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) product *= 1.0 - multipliers[i] * multipliers[j];
  return product.real();
}

}  // namespace

const std::array<BifurcationTest, 3> bifurcation_tests{
    {{Bifurcation::plus_one, through_plus_one},
     {Bifurcation::period_doubling, through_minus_one},
     {Bifurcation::neimark_sacker, through_the_circle}}};

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

const char* name_of(Bifurcation bifurcation)
{
  constexpr const char* names[] = {"-", "fold", "plus-one", "period-doubling",
                                   "neimark-sacker"};
  return names[static_cast<int>(bifurcation)];
}

int unstable_count(const Multipliers& multipliers)
{
  return static_cast<int>(std::count_if(multipliers.begin(), multipliers.end(),
                                        [](Complex mu) { return std::abs(mu) > 1; }));
}

namespace {

bool changes(BifurcationTest::Value test, const StablePoint& a, const StablePoint& b)
{
  return test(a.floquet.multipliers) * test(b.floquet.multipliers) < 0;
}

class Walk {
public:
  Walk(Balance& balance, const ArcLengthSettings& arc_length, const FloquetAt& floquet_at,
       const BranchStabilitySettings& settings)
      : balance_(balance),
        arc_length_(arc_length),
        floquet_at_(floquet_at),
        settings_(settings)
  {
  }

  BranchStability along(const Branch& branch)
  {
    mark_folds(branch);
    /** The points themselves first: they are what is left where the work does not go further. */
    std::vector<std::pair<std::size_t, StablePoint>> examined;
    for (std::size_t k = 0; k < branch.points.size(); ++k)
      if (settings_.chosen.empty() || settings_.chosen[k])
        examined.emplace_back(k, known(branch, k));
    std::size_t last = 0;
    for (auto& [k, next] : examined) {
      if (k == 0)
        result_.points.push_back(std::move(next));
      else
        pass(branch, last, k, std::move(next));
      last = k;
    }
    return std::move(result_);
  }

private:
  void mark_folds(const Branch& branch)
  {
    std::size_t folds = 0;
    is_fold_.assign(branch.points.size(), false);
    for (std::size_t k = 0; k < branch.points.size() && folds < branch.folds.size(); ++k)
      if (branch.points[k].motion.omega == branch.folds[folds]) {
        is_fold_[k] = true;
        ++folds;
      }
  }

  StablePoint unknown(const Branch& branch, std::size_t k) const
  {
    return {branch.points[k], {}, is_fold_[k] ? Bifurcation::fold : Bifurcation::none};
  }

  StablePoint known(const Branch& branch, std::size_t k)
  {
    StablePoint point = unknown(branch, k);
    try {
      point.floquet = floquet_at_(point.point);
    } catch (const NoSolution& error) {
      if (result_.failed++ == 0) result_.failure = error.what();
    }
    return point;
  }

  /** From point a of the branch, the last one found, to point b > a, whose multipliers are `next`. */
  void pass(const Branch& branch, std::size_t a, std::size_t b, StablePoint next)
  {
    const StablePoint& last = result_.points.back();
    if (b == a + 1) return go_to(std::move(next), settings_.most_halvings);
    if (last.examined() && next.examined() && is_stable(last) != is_stable(next)) {
      const std::size_t middle = a + (b - a) / 2;
      pass(branch, a, middle, known(branch, middle));
      return pass(branch, middle, b, std::move(next));
    }
    for (std::size_t k = a + 1; k < b; ++k) result_.points.push_back(unknown(branch, k));
    result_.points.push_back(std::move(next));
  }

  static bool is_stable(const StablePoint& point)
  {
    return unstable_count(point.floquet.multipliers) == 0;
  }

  bool worth_a_look(const StablePoint& a, const StablePoint& b) const
  {
    if (!a.examined() || !b.examined()) return false;
    return settings_.among_unstable || is_stable(a) || is_stable(b);
  }

  /** What happens between the last point and `next`, then `next`. */
  void go_to(StablePoint next, int halvings)
  {
    const StablePoint last = result_.points.back();
    if (!worth_a_look(last, next)) {
      result_.points.push_back(std::move(next));
      return;
    }
    if (halvings > 0 && hides_something(last, next)) {
      if (auto middle = between(last, next)) {
        go_to(std::move(*middle), halvings - 1);
        return go_to(std::move(next), halvings - 1);
      }
    }
    std::vector<StablePoint> passed;
    for (const BifurcationTest& kind : bifurcation_tests)
      if (changes(kind.test, last, next)) add(kind, last, next, passed);
    std::sort(passed.begin(), passed.end(),
              [](const auto& a, const auto& b) { return a.point.arc < b.point.arc; });
    for (StablePoint& point : passed) result_.points.push_back(std::move(point));
    result_.points.push_back(std::move(next));
  }

  bool hides_something(const StablePoint& a, const StablePoint& b) const
  {
    const Multipliers &m_a = a.floquet.multipliers, &m_b = b.floquet.multipliers;
    if (largest_move(m_a, m_b) > settings_.most_move) return true;
    const auto happened =
        std::count_if(bifurcation_tests.begin(), bifurcation_tests.end(),
                      [&](const BifurcationTest& k) { return changes(k.test, a, b); });
    return happened > 1 || (happened == 0 && unstable_count(m_a) != unstable_count(m_b));
  }

  StablePoint examined(BranchPoint point) const
  {
    Floquet floquet = floquet_at_(point);
    return {std::move(point), std::move(floquet)};
  }

  /** The point at the mean speed; none at the end of what numbers resolve. */
  std::optional<StablePoint> between(const StablePoint& a, const StablePoint& b) const
  {
    const double omega = 0.5 * (a.point.motion.omega + b.point.motion.omega);
    if (std::abs(a.point.motion.omega - b.point.motion.omega) <=
        settings_.tolerance * omega)
      return {};
    try {
      return examined(point_between(balance_, a.point, b.point, omega, arc_length_));
    } catch (const NoSolution&) {
      return {};
    }
  }

  void add(const BifurcationTest& kind, const StablePoint& a, const StablePoint& b,
           std::vector<StablePoint>& passed)
  {
    const TestFunction test = [&](const BranchPoint& p) {
      return kind.test(floquet_at_(p).multipliers);
    };
    StablePoint point;
    try {
      point = examined(
          locate(balance_, a.point, b.point, test, settings_.tolerance, arc_length_));
    } catch (const NoSolution&) {
      ++result_.missed;
      return;
    }
    if (kind.bifurcation == Bifurcation::neimark_sacker &&
        !is_complex_pair(point.floquet.multipliers))
      return;
    if (kind.bifurcation == Bifurcation::plus_one &&
        (is_fold(a, point) || is_fold(b, point)))
      return;
    point.bifurcation = kind.bifurcation;
    passed.push_back(std::move(point));
  }

  /** Whether +1 is passed at the fold itself, as far as it was located. */
  bool is_fold(const StablePoint& fold, const StablePoint& point) const
  {
    return fold.bifurcation == Bifurcation::fold &&
           std::abs(fold.point.motion.omega - point.point.motion.omega) <=
               10 * settings_.tolerance * fold.point.motion.omega;
  }

  Balance& balance_;
  const ArcLengthSettings& arc_length_;
  const FloquetAt& floquet_at_;
  const BranchStabilitySettings& settings_;
  std::vector<bool> is_fold_;  ///< of the branch's points
  BranchStability result_;
};

}  // namespace

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

BranchStability stability_along(Balance& balance, const Branch& branch,
                                const ArcLengthSettings& arc_length,
                                const FloquetAt& floquet_at,
                                const BranchStabilitySettings& settings)
{
  return Walk(balance, arc_length, floquet_at, settings).along(branch);
}

}  // namespace rotor_stator
