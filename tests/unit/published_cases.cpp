/** Duffing, two masses with cubic springs, two masses with a unilateral spring: the
   numbers of the public examples NLvib 01 to 03 (Krack and Gross, Harmonic Balance for
   Nonlinear Vibration Problems, 2019), recomputed with that tool or independently. */
#include <Eigen/LU>
#include "support/catch.hpp"

#include "continuation/arc_length.hpp"
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

ArcLengthSettings fine_steps(double most_step)
{
  return {.newton = {}, .speed_scale = 1, .arc_unknown_scale = 1, .most_step = most_step};
}

Branch branch_of(const Oscillator& oscillator, int harmonics, int samples, double from,
                 double to, double most_step)
{
  Balance balance(oscillator.problem(samples), harmonics);
  const Eigen::VectorXd x = Eigen::VectorXd::Zero(balance.unknowns());
  return follow_branch(balance, from, to, x, fine_steps(most_step));
}

}  // namespace

TEST_CASE("Duffing: peak and both folds with 1, 7 and 15 harmonics")
{
  const auto amplitude = [](const Eigen::VectorXd& x) {
    return harmonic_amplitude(x, 1, 0, 1);
  };
  struct Expected {
    int harmonics;
    double peak, at, upper_fold, lower_fold;
  };
  const Expected cases[] = {{1, 2.841625, 1.266633, 1.267537, 1.115586},
                            {7, 2.830198, 1.268716, 1.269602, 1.115700},
                            {15, 2.830198, 1.268716, 1.269602, 1.115700}};
  for (const Expected& expected : cases) {
    const Branch branch = branch_of(duffing(), expected.harmonics, 128, 0.5, 1.6, 0.01);
    REQUIRE(branch.covered);
    REQUIRE(branch.folds.size() == 2);
    const Peak peak = peak_of(branch.points, amplitude);
    CHECK(peak.height == Approx(expected.peak).epsilon(1e-6));
    CHECK(peak.omega == Approx(expected.at).epsilon(2e-6));
    CHECK(branch.folds[0] == Approx(expected.upper_fold).epsilon(1e-6));
    CHECK(branch.folds[1] == Approx(expected.lower_fold).epsilon(1e-6));
  }
}

TEST_CASE("Two masses with cubic springs: peak with 7 harmonics")
{
  const Branch branch = branch_of(two_masses_cubic(), 7, 64, 0.8, 1.4, 0.004);
  REQUIRE(branch.covered);
  std::vector<BranchPoint> first_resonance;
  for (const BranchPoint& point : branch.points)
    if (point.motion.omega < 1.15) first_resonance.push_back(point);
  const Peak peak =
      peak_of(first_resonance, [](const Eigen::VectorXd& x) { return rms(x, 2, 0); });
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
    const Branch branch =
        follow_branch(coarse, omega, expected.omega, x, fine_steps(0.02));
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
      CHECK(harmonic_amplitude(fine, 2, 1, 1) ==
            Approx(expected.amplitude[k]).epsilon(k == 0 ? 3e-6 : 1.5e-6));
    }
  }
}
