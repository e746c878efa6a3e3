#include "stability/branch_stability.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "continuation/locate.hpp"
#include "model/errors.hpp"

namespace rotor_stator
{

namespace
{

using Complex = std::complex<double>;
using Test = double (*)(const Multipliers&);

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

struct Kind {
  Bifurcation bifurcation;
  Test test;
};
constexpr std::array kinds{Kind{Bifurcation::plus_one, through_plus_one},
                           Kind{Bifurcation::period_doubling, through_minus_one},
                           Kind{Bifurcation::neimark_sacker, through_the_circle}};

bool changes(Test test, const StablePoint& a, const StablePoint& b)
{
  return test(a.floquet.multipliers) * test(b.floquet.multipliers) < 0;
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

class Walk
{
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
    std::size_t folds = 0;
    for (const BranchPoint& point : branch.points) {
      StablePoint next = known(point);
      if (folds < branch.folds.size() && point.omega == branch.folds[folds]) {
        next.bifurcation = Bifurcation::fold;
        ++folds;
      }
      if (found_.empty())
        found_.push_back(std::move(next));
      else
        go_to(std::move(next), settings_.most_halvings);
    }
    return {std::move(found_), missed_};
  }

private:
  StablePoint known(const BranchPoint& point) const
  {
    return {point, floquet_at_(point)};
  }

  /** What happens between the last point and `next`, then `next`. */
  void go_to(StablePoint next, int halvings)
  {
    const StablePoint last = found_.back();
    if (halvings > 0 && hides_something(last, next)) {
      if (auto middle = between(last, next)) {
        go_to(std::move(*middle), halvings - 1);
        return go_to(std::move(next), halvings - 1);
      }
    }
    std::vector<StablePoint> passed;
    for (const Kind& kind : kinds)
      if (changes(kind.test, last, next)) add(kind, last, next, passed);
    std::sort(passed.begin(), passed.end(),
              [](const auto& a, const auto& b) { return a.point.arc < b.point.arc; });
    for (StablePoint& point : passed) found_.push_back(std::move(point));
    found_.push_back(std::move(next));
  }

  bool hides_something(const StablePoint& a, const StablePoint& b) const
  {
    const Multipliers &m_a = a.floquet.multipliers, &m_b = b.floquet.multipliers;
    if (rotor_stator::distance(m_a, m_b) > settings_.most_move) return true;
    const auto happened = std::count_if(
        kinds.begin(), kinds.end(), [&](const Kind& k) { return changes(k.test, a, b); });
    return happened > 1 || (happened == 0 && unstable_count(m_a) != unstable_count(m_b));
  }

  /** The point at the mean speed; none at the end of what numbers resolve. */
  std::optional<StablePoint> between(const StablePoint& a, const StablePoint& b) const
  {
    const double omega = 0.5 * (a.point.omega + b.point.omega);
    if (std::abs(a.point.omega - b.point.omega) <= settings_.tolerance * omega) return {};
    try {
      return known(point_between(balance_, a.point, b.point, omega, arc_length_));
    } catch (const NoSolution&) {
      return {};
    }
  }

  void add(const Kind& kind, const StablePoint& a, const StablePoint& b,
           std::vector<StablePoint>& passed)
  {
    const TestFunction test = [&](const BranchPoint& p) {
      return kind.test(floquet_at_(p).multipliers);
    };
    StablePoint point;
    try {
      point = known(
          locate(balance_, a.point, b.point, test, settings_.tolerance, arc_length_));
    } catch (const NoSolution&) {
      ++missed_;
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
           std::abs(fold.point.omega - point.point.omega) <=
               10 * settings_.tolerance * fold.point.omega;
  }

  Balance& balance_;
  const ArcLengthSettings& arc_length_;
  const FloquetAt& floquet_at_;
  const BranchStabilitySettings& settings_;
  std::vector<StablePoint> found_;
  int missed_ = 0;
};

}  // namespace

int unstable_count(const Multipliers& multipliers)
{
  return static_cast<int>(std::count_if(multipliers.begin(), multipliers.end(),
                                        [](Complex mu) { return std::abs(mu) > 1; }));
}

BranchStability stability_along(Balance& balance, const Branch& branch,
                                const ArcLengthSettings& arc_length,
                                const FloquetAt& floquet_at,
                                const BranchStabilitySettings& settings)
{
  return Walk(balance, arc_length, floquet_at, settings).along(branch);
}

}  // namespace rotor_stator
