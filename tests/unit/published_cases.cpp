/** Duffing, two masses with cubic springs, two masses with a unilateral spring: the
   numbers of the public examples NLvib 01 to 03 (Krack and Gross, Harmonic Balance for
   Nonlinear Vibration Problems, 2019), recomputed with that tool or independently; and
   the stability along their branches. */
#include "continuation/arc_length.hpp"
#include "continuation/branch_stability.hpp"
#include "support/cases.hpp"

using namespace rotor_stator;
using namespace rotor_stator::tests;

namespace {

/** The highest point of a curve given at three points, by the parabola through them. */
struct Peak {
  double omega, height;
};

Peak peak_of(const std::vector<BranchPoint>& points,
             const std::function<double(const Eigen::VectorXd&)>& height)
{
  std::size_t top = 1;
  for (std::size_t k = 1; k + 1 < points.size(); ++k)
    if (height(points[k].motion.x) > height(points[top].motion.x)) top = k;
  /** Parabolas in the arc length, which stays regular at the peak. */
  Eigen::Matrix3d powers;
  Eigen::Matrix<double, 3, 2> values;
  for (int i = 0; i < 3; ++i) {
    const BranchPoint& point = points[top - 1 + static_cast<std::size_t>(i)];
    const double s = point.arc - points[top].arc;
    powers.row(i) << 1, s, s * s;
    values.row(i) << height(point.motion.x), point.motion.omega;
  }
  const Eigen::Matrix<double, 3, 2> fit = powers.inverse() * values;
  const double s = -fit(1, 0) / (2 * fit(2, 0));
  const Eigen::Vector2d at = fit.transpose() * Eigen::Vector3d(1, s, s * s);
  return {at[1], at[0]};
}

ArcLengthSettings steps(double most_step)
{
  return {.newton = {}, .speed_scale = 1, .arc_unknown_scale = 1, .most_step = most_step};
}

Oscillator two_masses_unilateral()
{
  Eigen::Matrix2d stiffness;
  stiffness << 1, -1, -1, 2;
  return {Eigen::Matrix2d::Identity(), 0.03 * stiffness, stiffness,
          Eigen::Vector2d(0, 0.1), [](const Eigen::VectorXd& q) {
            const bool touching = q[0] > 1;
            Eigen::Matrix2d slope = Eigen::Matrix2d::Zero();
            slope(0, 0) = touching ? 100 : 0;
            return LocalForce{Eigen::Vector2d(touching ? 100 * (q[0] - 1) : 0, 0), slope};
          }};
}

/** The amplitude of the first harmonic of the last of so many variables. */
double first_harmonic(const Eigen::VectorXd& x, int dofs)
{
  return std::hypot(x[2 * dofs - 1], x[3 * dofs - 1]);
}

/** The derivative of the period map of an oscillator with d masses, linearised along the series `x` at
    `omega`, by RK4 with so many steps. 2d × 2d, displacements first. */
Eigen::MatrixXd monodromy(const Oscillator& oscillator, const Eigen::VectorXd& x,
                          double omega, int steps)
{
  const auto d = oscillator.mass.rows();
  const Eigen::MatrixXd q = sample_series(x.reshaped(d, x.size() / d), 2 * steps);
  const Eigen::MatrixXd per_mass = oscillator.mass.inverse();
  const auto rate = [&](int half_step, const Eigen::MatrixXd& y) {
    const Eigen::MatrixXd k =
        oscillator.stiffness + oscillator.law(q.row(half_step % (2 * steps))).stiffness;
    Eigen::MatrixXd slope(2 * d, 2 * d);
    slope << y.bottomRows(d),
        -per_mass * (k * y.topRows(d) + oscillator.damping * y.bottomRows(d));
    return slope;
  };
  Eigen::MatrixXd phi = Eigen::MatrixXd::Identity(2 * d, 2 * d);
  const double h = 2 * std::numbers::pi / omega / steps;
  for (int k = 0; k < 2 * steps; k += 2) {
    const Eigen::MatrixXd s_1 = rate(k, phi), s_2 = rate(k + 1, phi + h / 2 * s_1),
                          s_3 = rate(k + 1, phi + h / 2 * s_2),
                          s_4 = rate(k + 2, phi + h * s_3);
    phi += h / 6 * (s_1 + 2 * s_2 + 2 * s_3 + s_4);
  }
  return phi;
}

/** The multipliers along the series `x` of an oscillator with a smooth stiffness, by RK4,
    and their change from half as many steps. */
Floquet floquet(const Oscillator& oscillator, const Eigen::VectorXd& x, double omega)
{
  constexpr int steps = 1000;
  Floquet result{.multipliers = multipliers_of(monodromy(oscillator, x, omega, steps))};
  result.change = largest_move(
      result.multipliers, multipliers_of(monodromy(oscillator, x, omega, steps / 2)));
  result.converged = result.change <= 1e-6;
  return result;
}

/** An oscillator's branch, from rest where there is no other start. */
struct Followed {
  Oscillator oscillator;
  Balance balance;
  BalanceCurve curve;
  Branch branch;

  Followed(Oscillator of, int harmonics, int samples, double from, double to,
           double most_step, const Eigen::VectorXd* start = nullptr)
      : oscillator(std::move(of)), balance(oscillator.problem(samples), harmonics),
        curve(balance, steps(most_step)),
        branch(follow_branch(
            curve, from, to,
            start ? *start : Eigen::VectorXd::Zero(balance.unknowns()).eval()))
  {
  }

  BranchStability stability(const std::vector<bool>& chosen = {}, long* asked = nullptr)
  {
    const auto floquet_at = [&](const BranchPoint& p) {
      if (asked) ++*asked;
      return floquet(oscillator, p.motion.x, p.motion.omega);
    };
    return stability_along(curve, branch, floquet_at, chosen);
  }
};

/** Speeds of the bifurcations of these kinds, in order. */
std::vector<double> speeds(const BranchStability& stability,
                           const std::vector<Bifurcation>& kinds)
{
  std::vector<double> found;
  for (const StablePoint& p : stability.points)
    if (std::ranges::count(kinds, p.bifurcation)) found.push_back(p.point.motion.omega);
  return found;
}

}  // namespace

TEST_CASE(
    "Duffing: peak and both folds with 1, 7 and 15 harmonics, up and down, at any step")
{
  const auto amplitude = [](const Eigen::VectorXd& x) { return first_harmonic(x, 1); };
  struct Expected {
    int harmonics;
    double peak, at, upper_fold, lower_fold;
  };
  const Expected cases[] = {{1, 2.841625, 1.266633, 1.267537, 1.115586},
                            {7, 2.830198, 1.268716, 1.269602, 1.115700},
                            {15, 2.830198, 1.268716, 1.269602, 1.115700}};
  for (const Expected& expected : cases)
    for (double most_step : {0.5, 0.05, 0.01, 0.005}) {
      Followed up(duffing(), expected.harmonics, 128, 0.5, 1.6, most_step);
      const Followed down(duffing(), expected.harmonics, 128, 1.6, 0.5, most_step);
      const Branch& branch = up.branch;
      REQUIRE(branch.covered);
      REQUIRE(down.branch.covered);
      check_same(branch.folds, {expected.upper_fold, expected.lower_fold}, 1e-6);
      check_same(down.branch.folds, {branch.folds.rbegin(), branch.folds.rend()}, 1e-8);
      CHECK(branch.points.back().motion.omega == 1.6);
      CHECK(branch.points.back().arc ==
            Approx(down.branch.points.back().arc).epsilon(1e-3));
      /** A fold is a point of its branch, with a tangent across the speed. */
      for (double fold : branch.folds) {
        const auto point = std::ranges::find(
            branch.points, fold, [](const BranchPoint& p) { return p.motion.omega; });
        REQUIRE(point != branch.points.end());
        CHECK(std::abs(point->speed_direction()) < 1e-4);
        CHECK(up.balance.residual(point->motion.x, fold).norm() < 1e-9);
      }
      if (most_step != 0.01) continue;
      const Peak peak = peak_of(branch.points, amplitude);
      CHECK(peak.height == Approx(expected.peak).epsilon(1e-6));
      CHECK(peak.omega == Approx(expected.at).epsilon(2e-6));
    }
}

TEST_CASE("Two masses with cubic springs: peak with 7 harmonics")
{
  const Branch branch = Followed(two_masses_cubic(), 7, 64, 0.8, 1.4, 0.004).branch;
  REQUIRE(branch.covered);
  std::vector<BranchPoint> first_resonance;
  for (const BranchPoint& point : branch.points)
    if (point.motion.omega < 1.15) first_resonance.push_back(point);
  const Peak peak = peak_of(first_resonance, [](const Eigen::VectorXd& x) {
    const Eigen::VectorXd first = x(Eigen::seq(0, Eigen::last, 2));            // mass
    return std::sqrt(first[0] * first[0] + first.tail(14).squaredNorm() / 2);  // rms
  });
  CHECK(peak.height == Approx(0.418505).epsilon(3e-6));
  /** The top is flat: the published speed was read from a curve of finite step. */
  CHECK(peak.omega == Approx(1.02698).epsilon(3e-5));
}

TEST_CASE("Unilateral spring: amplitudes converge with the harmonics as published")
{
  struct Expected {
    double omega;
    double amplitude[4];
  };
  const Expected cases[] = {{0.600, {0.663533, 0.660069, 0.659752, 0.659746}},
                            {0.635, {0.687087, 0.678706, 0.678129, 0.678124}},
                            {0.700, {0.796600, 0.779220, 0.778403, 0.778395}},
                            {0.750, {0.961567, 0.936591, 0.935637, 0.935626}}};
  const int harmonics[4] = {7, 21, 41, 81};

  /** The contact branch with few harmonics, by arc length; more harmonics start from
      fewer. */
  Balance coarse(two_masses_unilateral().problem(1024), 7);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(coarse.unknowns());
  double omega = 0.59;
  for (const Expected& expected : cases) {
    const Branch branch = follow_branch(coarse, omega, expected.omega, x, steps(0.02));
    REQUIRE(branch.covered);
    x = branch.points.back().motion.x;
    omega = expected.omega;
    Eigen::VectorXd fine = x;
    for (int k = 0; k < 4; ++k) {
      Balance balance(two_masses_unilateral().problem(k == 0 ? 1024 : 16384),
                      harmonics[k]);
      fine = resize_harmonics(fine, 2, harmonics[k]);
      const auto solution = solve(balance, expected.omega, fine);
      REQUIRE(solution.found());
      fine = solution.x;
      CHECK(first_harmonic(fine, 2) ==
            Approx(expected.amplitude[k]).epsilon(k == 0 ? 3e-6 : 1.5e-6));
    }
  }
}

TEST_CASE("Two masses, cubic springs: Neimark-Sacker points and folds as published")
{
  Followed followed(two_masses_cubic(), 15, 128, 0.8, 1.4, 0.05);
  REQUIRE(followed.branch.covered);
  const BranchStability stability = followed.stability();
  CHECK(stability.missed == 0);
  const auto circle = speeds(stability, {Bifurcation::neimark_sacker});
  REQUIRE(circle.size() == 2);
  /** The published speed is lower by 1e-4, its conditions unknown. */
  CHECK(circle[0] == Approx(1.1126).margin(2e-4));
  CHECK(circle[1] == Approx(1.1957).margin(5e-5));
  const auto folds = speeds(stability, {Bifurcation::fold});
  REQUIRE(folds.size() == 2);
  CHECK(folds[0] == Approx(1.214626).margin(1e-6));
  CHECK(folds[1] == Approx(1.206219).margin(1e-6));
  for (const StablePoint& p : stability.points) {
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
  CHECK(speeds(stability, {Bifurcation::period_doubling}).empty());
}

TEST_CASE("Where some points are skipped, a change of stability is found all the same")
{
  Followed followed(two_masses_cubic(), 5, 64, 1.05, 1.2, 0.005);
  long asked_for_all = 0, asked = 0;
  const auto all = followed.stability({}, &asked_for_all);
  const auto some = followed.stability(evenly_chosen(followed.branch, 0.05, 4), &asked);
  CHECK(asked < asked_for_all / 2);
  CHECK(some.points.size() >= followed.branch.points.size());

  /** The same speeds of the bifurcations, and at each point the same verdict or none. */
  const std::vector<Bifurcation> any{Bifurcation::fold, Bifurcation::plus_one,
                                     Bifurcation::period_doubling,
                                     Bifurcation::neimark_sacker};
  REQUIRE_FALSE(speeds(all, any).empty());
  check_same(speeds(some, any), speeds(all, any), 1e-6);
  long unexamined = 0;
  for (const StablePoint& p : some.points) {
    if (!p.examined()) ++unexamined;
    for (const StablePoint& q : all.points)
      if (q.point.arc == p.point.arc) {
        CHECK(std::string(p.verdict()) == q.verdict());
        if (p.examined()) CHECK(p.floquet.largest() == Approx(q.floquet.largest()));
      }
  }
  CHECK(unexamined > 10);
}

TEST_CASE("A point whose multipliers cannot be had is kept without them")
{
  Followed followed(two_masses_cubic(), 5, 64, 1.1, 1.13, 0.02);
  const Branch& branch = followed.branch;
  const auto stability = stability_along(
      followed.curve, branch,
      [](const BranchPoint&) -> Floquet { throw NoSolution("no more work"); });
  CHECK(stability.points.size() == branch.points.size());
  CHECK(stability.failed == static_cast<int>(branch.points.size()));
  CHECK(stability.failure == "no more work");
  for (const StablePoint& p : stability.points) CHECK_FALSE(p.examined());
}

TEST_CASE("Where the multipliers of another motion begin nothing bifurcates")
{
  Followed followed(two_masses_cubic(), 5, 64, 1.1, 1.13, 0.02);
  const auto stability =
      stability_along(followed.curve, followed.branch, [](const BranchPoint& p) {
        const double mu = p.motion.omega < 1.115 ? 8.5 : -21;
        return Floquet{.multipliers = {mu, 0.5}, .converged = true};
      });
  CHECK(speeds(stability, {Bifurcation::plus_one, Bifurcation::period_doubling}).empty());
  CHECK(stability.missed == 2);
}

TEST_CASE("Bifurcations are the same whichever way the branch is walked")
{
  Followed up(two_masses_cubic(), 5, 64, 1.1, 1.13, 0.02);
  const Eigen::VectorXd start = up.branch.points.back().motion.x;
  Followed down(two_masses_cubic(), 5, 64, 1.13, 1.1, 0.03, &start);
  const auto circle = speeds(up.stability(), {Bifurcation::neimark_sacker});
  REQUIRE(circle.size() == 1);
  check_same(speeds(down.stability(), {Bifurcation::neimark_sacker}), circle, 1e-6);
}
