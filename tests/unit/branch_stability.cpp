/** Stability along branches and the bifurcations on them, against published cases. */
#include <algorithm>
#include <numbers>
#include <utility>
#include "support/catch.hpp"

#include "balance/bearing_problem.hpp"
#include "continuation/arc_length.hpp"
#include "continuation/branch_stability.hpp"
#include "io/errors.hpp"
#include "support/cases.hpp"

using namespace rotor_stator;
using namespace rotor_stator::tests;

namespace {

ArcLengthSettings steps(double most_step)
{
  return {.newton = {},
          .speed_scale = 1,
          .arc_unknown_scale = 1,
          .first_step = most_step / 4,
          .most_step = most_step};
}

struct Followed {
  Branch branch;
  BranchStability stability;

  /** Speeds of the bifurcations of one kind, in order. */
  std::vector<double> speeds(Bifurcation kind) const
  {
    std::vector<double> found;
    for (const StablePoint& p : stability.points)
      if (p.bifurcation == kind) found.push_back(p.point.motion.omega);
    return found;
  }
};

Followed follow(const Oscillator& oscillator, int harmonics, int samples, double from,
                double to, double most_step, const Eigen::VectorXd* start = nullptr)
{
  Balance balance(oscillator.problem(samples), harmonics);
  const Eigen::VectorXd x = start ? *start : Eigen::VectorXd::Zero(balance.unknowns());
  BalanceCurve curve(balance, steps(most_step));
  Followed followed{follow_branch(curve, from, to, x), {}};
  const auto floquet_at = [&](const BranchPoint& p) {
    return floquet(oscillator, p.motion.x, p.motion.omega);
  };
  followed.stability = stability_along(curve, followed.branch, floquet_at);
  return followed;
}

}  // namespace

TEST_CASE("Two masses, cubic springs: Neimark-Sacker points and folds as published")
{
  const Oscillator oscillator = two_masses_cubic();
  const auto followed = follow(oscillator, 15, 128, 0.8, 1.4, 0.05);
  REQUIRE(followed.branch.covered);
  CHECK(followed.stability.missed == 0);
  const auto circle = followed.speeds(Bifurcation::neimark_sacker);
  REQUIRE(circle.size() == 2);
  /** The published speed is lower by 1e-4, its conditions unknown. */
  CHECK(circle[0] == Approx(1.1126).margin(2e-4));
  CHECK(circle[1] == Approx(1.1957).margin(5e-5));
  const auto folds = followed.speeds(Bifurcation::fold);
  REQUIRE(folds.size() == 2);
  CHECK(folds[0] == Approx(1.214626).margin(1e-6));
  CHECK(folds[1] == Approx(1.206219).margin(1e-6));
  for (const StablePoint& p : followed.stability.points) {
    if (p.bifurcation == Bifurcation::neimark_sacker) {
      CHECK(std::abs(p.floquet.largest() - 1) < 1e-5);
      CHECK(std::abs(p.floquet.multipliers.front().imag()) > 1e-3);
    }
    if (p.bifurcation != Bifurcation::fold) continue;
    double nearest = 1;
    for (const auto& mu : p.floquet.multipliers)
      nearest = std::min(nearest, std::abs(mu - 1.0));
    CHECK(nearest < 1e-4);
  }
  CHECK(followed.speeds(Bifurcation::period_doubling).empty());
}

TEST_CASE("Where some points are skipped, a change of stability is found all the same")
{
  const Oscillator oscillator = two_masses_cubic();
  Balance balance(oscillator.problem(64), 5);
  BalanceCurve curve(balance, steps(0.005));
  const Branch branch =
      follow_branch(curve, 1.05, 1.2, Eigen::VectorXd::Zero(balance.unknowns()));
  long asked = 0;
  const auto floquet_at = [&](const BranchPoint& p) {
    ++asked;
    return floquet(oscillator, p.motion.x, p.motion.omega);
  };
  const auto all = stability_along(curve, branch, floquet_at);
  const long asked_for_all = std::exchange(asked, 0);
  const auto some =
      stability_along(curve, branch, floquet_at, evenly_chosen(branch, 0.05, 4));
  CHECK(asked < asked_for_all / 2);
  CHECK(some.points.size() >= branch.points.size());

  /** The same speeds of the bifurcations, and at each point the same verdict or none. */
  const auto speeds = [](const BranchStability& stability) {
    std::vector<double> found;
    for (const StablePoint& p : stability.points)
      if (p.bifurcation != Bifurcation::none) found.push_back(p.point.motion.omega);
    return found;
  };
  const auto exact = speeds(all), found = speeds(some);
  REQUIRE(found.size() == exact.size());
  REQUIRE_FALSE(found.empty());
  for (std::size_t k = 0; k < found.size(); ++k)
    CHECK(found[k] == Approx(exact[k]).epsilon(1e-6));
  long unexamined = 0;
  for (const StablePoint& p : some.points) {
    if (!p.examined()) ++unexamined;
    for (const StablePoint& q : all.points)
      if (p.examined() && q.point.arc == p.point.arc)
        CHECK(p.floquet.largest() == Approx(q.floquet.largest()));
  }
  CHECK(unexamined > 10);
}

TEST_CASE("A point whose multipliers cannot be had is kept without them")
{
  const Oscillator oscillator = two_masses_cubic();
  Balance balance(oscillator.problem(64), 5);
  BalanceCurve curve(balance, steps(0.02));
  const Branch branch =
      follow_branch(curve, 1.1, 1.13, Eigen::VectorXd::Zero(balance.unknowns()));
  const auto stability = stability_along(
      curve, branch,
      [](const BranchPoint&) -> Floquet { throw NoSolution("no more work"); });
  CHECK(stability.points.size() == branch.points.size());
  CHECK(stability.failed == static_cast<int>(branch.points.size()));
  CHECK(stability.failure == "no more work");
  for (const StablePoint& p : stability.points) CHECK_FALSE(p.examined());
}

TEST_CASE("Bifurcations are the same whichever way the branch is walked")
{
  const auto up = follow(two_masses_cubic(), 5, 64, 1.1, 1.13, 0.02);
  const Eigen::VectorXd start = up.branch.points.back().motion.x;
  const auto down = follow(two_masses_cubic(), 5, 64, 1.13, 1.1, 0.03, &start);
  const auto a = up.speeds(Bifurcation::neimark_sacker);
  const auto b = down.speeds(Bifurcation::neimark_sacker);
  REQUIRE(a.size() == 1);
  REQUIRE(b.size() == 1);
  CHECK(a[0] == Approx(b[0]).epsilon(1e-6));
}
