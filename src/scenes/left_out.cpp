#include "scenes/left_out.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "integration/time_stepper.hpp"
#include "model/quasi_static_state.hpp"
#include "scenes/motion.hpp"

namespace rotor_stator
{

int LeftOut::harmonics(double part) const
{
  int m = 1;
  while (above(m) > part) ++m;
  return m;
}

int look_ahead(const Parameters& parameters, double omega, int harmonics)
{
  const Scales scale = scales(parameters);
  const double contact_mode = std::sqrt(
      scale.stiffness * (1 / parameters.stator.mass + 1 / parameters.rotor.mass));
  return std::max(2 * harmonics, static_cast<int>(std::ceil(contact_mode / omega)));
}

LeftOut what_is_left_out(const Parameters& parameters, double omega,
                         const Eigen::VectorXd& x, Balance& balance)
{
  const int m = static_cast<int>(x.size() / 4), far = balance.harmonics();
  /** One evaluation of the force, then harmonic by harmonic. */
  LeftOut result{resize_harmonics(x, 2, far), Eigen::VectorXd::Zero(far + 1)};
  const Eigen::VectorXd residual = balance.residual(result.x, omega);
  const double size = body_series(parameters, balance, omega, result.x)
                          .leftCols(3)
                          .cwiseAbs()
                          .rowwise()
                          .sum()
                          .maxCoeff();
  double sum = 0;
  for (int h = far; h > 0; --h) {
    auto u = result.x.segment<4>((2 * h - 1) * 2);  // cosine, then sine coefficients
    if (h > m) {
      const Eigen::Matrix4d block = balance.diagonal_block(h);
      u = -block.partialPivLu().solve(residual.segment<4>((2 * h - 1) * 2));
    }
    result.tail[h] = sum / size;
    sum += std::max(std::hypot(u[0], u[2]), std::hypot(u[1], u[3]));
  }
  result.tail[0] = sum / size;
  return result;
}

Eigen::VectorXd start_after_transient(const Parameters& parameters, double omega,
                                      int harmonics)
{
  constexpr double transient = 0.5;
  const double coarse = 4 * default_step(parameters);  ///< a start needs no more
  const int points = 2 * harmonics + 2;
  const long periods = std::lround(std::ceil(transient * omega / (2 * std::numbers::pi)));
  State state = quasi_static_state(parameters, omega);
  const TimeStepper whole = make_stepper(
      parameters, omega, {.method = "rk4", .intervals_per_period = 1, .step = coarse});
  for (long k = 0; k < periods; ++k) whole.advance(k, state);
  const TimeStepper parts =
      make_stepper(parameters, omega,
                   {.method = "rk4", .intervals_per_period = points, .step = coarse});
  Eigen::VectorXd x = relative_series(recorded(parts, points, state), harmonics);
  if (!x.allFinite()) x.setZero();
  return x;
}

}  // namespace rotor_stator
