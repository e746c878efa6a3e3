/** Transforms, and how the error falls with the sample count N. */
#include "costs/timed_method.hpp"
#include "support/cases.hpp"

using namespace rotor_stator;
using namespace rotor_stator::costs;
using namespace rotor_stator::motion;
using namespace rotor_stator::tests;

namespace {

/** The order p of an error that falls as m^-p. */
double order(const std::vector<double>& m, const std::vector<double>& errors)
{
  return -fitted_exponent(m, errors);
}

}  // namespace

TEST_CASE("Series to samples and back is the identity")
{
  Eigen::MatrixXd series(2, 9);
  for (Eigen::Index k = 0; k < series.size(); ++k)
    series(k) = std::cos(static_cast<double>(k));
  for (int samples : {9, 10, 16, 35}) {
    FourierTransform transform(samples);
    Eigen::MatrixXd values, back(2, 9);
    transform.to_samples(series, values);
    transform.to_series(values, back);
    CHECK((back - series).norm() < 1e-14);
  }
}

TEST_CASE("Samples of a series at few points are those of the series")
{
  Eigen::MatrixXd series = Eigen::MatrixXd::Zero(1, 41);
  series(0, 0) = 2;
  series(0, 39) = 1;  // cos 20φ
  const Eigen::MatrixXd values = sample_series(series, 8);
  for (int k = 0; k < 8; ++k)
    CHECK(values(k, 0) == Approx(2 + std::cos(20 * 2 * std::numbers::pi * k / 8)));
}

TEST_CASE("A motion has no harmonics above those that its instants resolve")
{
  Motion motion{16, 0, {}};
  for (int k = 0; k < 16; ++k)
    motion.positions.push_back(
        {{0, 0}, {std::cos(2 * std::numbers::pi * 7 * k / 16), 1}});
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(4, 2 * 40 + 1);
  expected(2, 2 * 7 - 1) = expected(3, 0) = 1;
  CHECK((series_of(motion, 40) - expected).norm() < 1e-14);
  CHECK((relative_series({}, motion, 40) - expected.bottomRows(2).reshaped()).norm() <
        1e-14);
}

TEST_CASE("Half peak-to-peak of a known motion")
{
  Eigen::MatrixXd series = Eigen::MatrixXd::Zero(1, 5);
  series << 7, 3, 4, 0, 0;
  CHECK(half_peak_to_peak(series)[0] == Approx(5).epsilon(1e-8));
}

/** Catches a default N that grows more slowly than m^{7/5} (largest error) or m^{8/5} (rms): with 8m+1 the
    orders are 2.7 and 2.5. The orders 7/2 and 4 are those of a force that begins as d^{3/2}. */
TEST_CASE("With the default N the error falls with m in the order of truncation")
{
  const Parameters machine = set_1();
  const auto motion_with = [&](int m, int samples) {
    const PeriodicMotion motion = find_periodic(
        {machine, hertz(30), m, samples, NewtonSettings{.tolerance = 1e-12}});
    REQUIRE(motion.found());
    return motion_of(motion.bodies, 2048);
  };
  const Motion truth = motion_with(1024, 1 << 16);
  std::vector<double> sizes, largest, rms, coarse_largest, coarse_rms;
  for (int m : {32, 64, 96, 128, 192, 256, 384, 512}) {
    const Motion motion = motion_with(m, default_samples(m));
    /** At m = 32 a resonance of the contact adds a hundred times as much. */
    CHECK(relative_difference(motion, truth) < 50 * std::pow(m, -3.5));
    if (m < 64) continue;
    const Motion coarse = motion_with(m, fast_transform_size(8 * m + 1));
    sizes.push_back(m);
    largest.push_back(relative_difference(motion, truth));
    rms.push_back(rms_difference(motion, truth));
    coarse_largest.push_back(relative_difference(coarse, truth));
    coarse_rms.push_back(rms_difference(coarse, truth));
  }
  CHECK(order(sizes, largest) > 3.5);
  CHECK(order(sizes, rms) > 3.9);
  CHECK(order(sizes, coarse_largest) < 3);
  CHECK(order(sizes, coarse_rms) < 3);
}

TEST_CASE("Up to 64 harmonics the default N is 8m+1, and at least 32")
{
  for (int m = 1; m <= 64; ++m)
    CHECK(default_samples(m) == fast_transform_size(std::max(32, 8 * m + 1)));
  CHECK(default_samples(512) == 14580);
  CHECK(default_samples(4096) < (1 << 17) + (1 << 12));
}
