#include "scenes/unit_costs.hpp"

#include "balance/fourier_transform.hpp"
#include "scenes/cpu_time.hpp"

namespace rotor_stator
{

namespace
{

/** Enough of it for the clock. */
constexpr int instants = 20000;
constexpr int repetitions = 5;

}  // namespace

double force_seconds(const Parameters& parameters, const Motion& motion)
{
  const BallBearing bearing(parameters.bearing);
  std::vector<Direction> cage;
  for (std::size_t k = 0; k < motion.size(); ++k)
    cage.push_back(Direction::of(parameters.bearing.cage_speed_ratio * motion.phase(k)));
  volatile double kept = 0;
  const CpuTime time = time_of(repetitions, [&] {
    double sum = 0;
    for (int k = 0; k < instants; ++k) {
      const std::size_t at = k % motion.size();
      sum += bearing.force(cage[at], motion.positions[at].relative()).x;
    }
    kept = sum;
  });
  return time.median / instants;
}

double transform_seconds(int samples)
{
  FourierTransform transform(samples);
  const int times = std::max(1, instants / samples);
  Eigen::MatrixXd values = Eigen::MatrixXd::Ones(samples, 1);
  Eigen::MatrixXd series = Eigen::MatrixXd::Zero(1, 2 * (samples / 4) + 1);
  const CpuTime time = time_of(repetitions, [&] {
    for (int k = 0; k < times; ++k) {
      transform.to_series(values, series);
      transform.to_samples(series, values);
    }
  });
  return time.median / (2 * times);
}

double clock_seconds()
{
  const CpuTime time = time_of(repetitions, [] {
    for (int k = 0; k < instants / 10; ++k) (void)thread_cpu_seconds();
  });
  return 10 * time.median / instants;
}

}  // namespace rotor_stator
