/** Transforms, and the default sample count N. */
#include "support/cases.hpp"

using namespace rotor_stator;
using namespace rotor_stator::motion;
using namespace rotor_stator::tests;

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

TEST_CASE("Up to 64 harmonics the default N is 8m+1, and at least 32")
{
  for (int m = 1; m <= 64; ++m)
    CHECK(default_samples(m) == fast_transform_size(std::max(32, 8 * m + 1)));
  CHECK(default_samples(512) == 14580);
  CHECK(default_samples(4096) < (1 << 17) + (1 << 12));
}
