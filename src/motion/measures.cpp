#include "motion/measures.hpp"

#include <cmath>
#include <complex>

namespace rotor_stator::motion {

namespace {

/** Σ_k w_k q_{i+k}, k = -2 … 2. */
Eigen::VectorXd weighted(const Eigen::VectorXd& q, const double (&w)[5], bool is_closed)
{
  const Eigen::Index n = q.size(), margin = is_closed ? 0 : 2;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(std::max<Eigen::Index>(0, n - 2 * margin));
  for (Eigen::Index i = 0; i < sum.size(); ++i)
    for (int k = 0; k < 5; ++k) sum[i] += w[k] * q[(i + margin + k - 2 + n) % n];
  return sum;
}

double rms(const Eigen::VectorXd& values)
{
  if (values.size() == 0) return 0;
  return std::sqrt((values.array() - values.mean()).square().mean());
}

}  // namespace

Eigen::VectorXd velocity_of(const Eigen::VectorXd& q, double dt, bool is_closed)
{
  return weighted(q, {1, -8, 0, 8, -1}, is_closed) / (12 * dt);
}

Measures measures(const Eigen::VectorXd& q, double dt, double rotor, double turning,
                  bool is_closed)
{
  std::complex<double> sum = 0;
  for (Eigen::Index k = 0; k < q.size(); ++k)
    sum += q[k] * std::polar(2.0, rotor + turning * static_cast<double>(k));
  sum /= static_cast<double>(q.size());
  return {.amplitude = 0.5 * (q.maxCoeff() - q.minCoeff()),
          .velocity_rms = rms(velocity_of(q, dt, is_closed)),
          .acceleration_rms =
              rms(weighted(q, {-1, 16, -30, 16, -1}, is_closed)) / (12 * dt * dt),
          .first = std::abs(sum),
          .lag = std::arg(sum)};
}

}  // namespace rotor_stator::motion
