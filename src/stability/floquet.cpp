#include "stability/floquet.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "balance/fourier_transform.hpp"
#include "model/errors.hpp"
#include "model/rotor_stator.hpp"

namespace rotor_stator
{

namespace
{

using Multipliers = std::vector<std::complex<double>>;

Multipliers eigenvalues(const Eigen::MatrixXd& phi)
{
  if (!phi.allFinite())
    throw NoSolution("the disturbances of the motion overflow within one period");
  const Eigen::VectorXcd values = phi.eigenvalues();
  Multipliers sorted(values.begin(), values.end());
  /** A conjugate pair has one modulus but for rounding; its upper half comes first. */
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    const double difference = std::abs(a) - std::abs(b);
    return std::abs(difference) > 1e-12 * std::abs(a) ? difference > 0
                                                      : a.imag() > b.imag();
  });
  return sorted;
}

/** The largest distance of a multiplier to its nearest partner among the coarser ones. */
double change(const Multipliers& fine, Multipliers coarse)
{
  double largest = 0;
  for (const auto& mu : fine) {
    const auto partner =
        std::min_element(coarse.begin(), coarse.end(), [&](const auto& a, const auto& b) {
          return std::abs(a - mu) < std::abs(b - mu);
        });
    largest = std::max(largest, std::abs(*partner - mu) / std::max(1.0, std::abs(mu)));
    coarse.erase(partner);
  }
  return largest;
}

/** Of the product of the multipliers against its closed form; the product of all is the
    determinant, whose small factors an eigenvalue solver would lose. */
double liouville_error(const Vibration& vibration, const Eigen::MatrixXd& phi,
                       double period)
{
  const double exact = -period * (vibration.mass.inverse() * vibration.damping).trace();
  return std::abs(phi.determinant() / std::exp(exact) - 1);
}

/** Steps that resolve the fastest vibration along the motion. */
int first_steps(const Vibration& vibration, const StiffnessAlong& stiffness,
                double period, double steps_per_radian)
{
  constexpr int looked_at = 512;
  const Eigen::MatrixXd table = stiffness(looked_at);
  const Eigen::MatrixXd per_mass = vibration.mass.inverse();
  const auto d = vibration.mass.rows();
  double fastest = 0;
  for (Eigen::Index row = 0; row < table.rows(); ++row)
    fastest = std::max(
        fastest,
        (per_mass * (vibration.stiffness + table.row(row).reshaped(d, d))).norm());
  const double steps = steps_per_radian * std::sqrt(fastest) * period;
  int power = 64;
  while (power < steps && power < (1 << 24)) power *= 2;
  return power;
}

}  // namespace

Floquet floquet(const Vibration& vibration, const StiffnessAlong& stiffness,
                double period, const FloquetSettings& settings)
{
  int steps = first_steps(vibration, stiffness, period, settings.steps_per_radian);
  if (steps > settings.most_steps)
    throw NoSolution(
        text("a period would need %d steps of the linearised motion; at "
             "most %d are taken",
             steps, settings.most_steps));
  Multipliers coarse = eigenvalues(monodromy(vibration, stiffness(2 * steps), period));
  Floquet result{.multipliers = coarse,
                 .change = std::numeric_limits<double>::infinity(),
                 .liouville = 0,
                 .steps = steps,
                 .settled = false};
  int agreements = 0;
  while (agreements < 2 && 2 * steps <= settings.most_steps) {
    steps *= 2;
    const Eigen::MatrixXd phi = monodromy(vibration, stiffness(2 * steps), period);
    result.multipliers = eigenvalues(phi);
    result.change = change(result.multipliers, coarse);
    result.liouville = liouville_error(vibration, phi, period);
    result.steps = steps;
    agreements = result.change <= settings.tolerance ? agreements + 1 : 0;
    coarse = result.multipliers;
  }
  result.settled = agreements >= 2;
  return result;
}

Vibration vibration_of(const Parameters& parameters)
{
  const auto diagonal = [&](double stator, double rotor) -> Eigen::MatrixXd {
    return Eigen::Vector4d(stator, stator, rotor, rotor).asDiagonal();
  };
  const Body &s = parameters.stator, &r = parameters.rotor;
  return {.mass = diagonal(s.mass, r.mass),
          .damping = diagonal(s.damping(), r.damping()),
          .stiffness = diagonal(s.stiffness(), r.stiffness())};
}

StiffnessAlong stiffness_along(const Parameters& parameters, const Eigen::VectorXd& x)
{
  const Eigen::MatrixXd series = x.reshaped(2, x.size() / 2);
  return [parameters, series](int n) {
    const BallBearing bearing(parameters.bearing);
    const Eigen::MatrixXd u = sample_series(series, n);
    Eigen::MatrixXd table(n, 16);
    for (int k = 0; k < n; ++k) {
      const double cage =
          parameters.bearing.cage_speed_ratio * 2 * std::numbers::pi * k / n;
      const Stiffness2 s =
          bearing.reaction(Direction::of(cage), {u(k, 0), u(k, 1)}).stiffness;
      Eigen::Matrix2d joint;
      joint << s.xx, s.xy, s.xy, s.yy;
      Eigen::Matrix4d both;
      both << joint, -joint, -joint, joint;
      table.row(k) = both.reshaped();
    }
    return table;
  };
}

Floquet floquet(const Parameters& parameters, double omega, const Eigen::VectorXd& x,
                const FloquetSettings& settings)
{
  return floquet(vibration_of(parameters), stiffness_along(parameters, x),
                 2 * std::numbers::pi / omega, settings);
}

}  // namespace rotor_stator
