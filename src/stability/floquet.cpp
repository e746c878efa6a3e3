#include "stability/floquet.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "balance/fourier_transform.hpp"
#include "io/errors.hpp"
#include "model/rotor_stator.hpp"
#include "stability/eigenvalues.hpp"

namespace rotor_stator {

void sort_by_modulus(Multipliers& multipliers)
{
  /** A conjugate pair has one modulus but for rounding. */
  std::sort(multipliers.begin(), multipliers.end(), [](const auto& a, const auto& b) {
    const double difference = std::abs(a) - std::abs(b);
    return std::abs(difference) > 1e-12 * std::abs(a) ? difference > 0
                                                      : a.imag() > b.imag();
  });
}

Multipliers multipliers_of(const Eigen::MatrixXd& phi)
{
  if (!phi.allFinite())
    throw NoSolution("the disturbances of the motion overflow within one period");
  /** Displacements and speeds on one scale, which keeps the small eigenvalues. */
  const auto d = phi.rows() / 2;
  Eigen::MatrixXd scaled = phi;
  const double up = phi.bottomLeftCorner(d, d).stableNorm();
  const double down = phi.topRightCorner(d, d).stableNorm();
  if (up > 0 && down > 0) {
    const double rate = std::sqrt(up / down);
    scaled.topRightCorner(d, d) *= rate;
    scaled.bottomLeftCorner(d, d) /= rate;
  }
  const Eigen::VectorXcd values = eigenvalues(scaled);
  Multipliers multipliers(values.begin(), values.end());
  sort_by_modulus(multipliers);
  return multipliers;
}

double largest_move(const Multipliers& a, Multipliers b)
{
  double largest = 0;
  for (const auto& mu : a) {
    const auto partner =
        std::min_element(b.begin(), b.end(), [&](const auto& p, const auto& q) {
          return std::abs(p - mu) < std::abs(q - mu);
        });
    largest = std::max(largest, std::abs(*partner - mu) / std::max(1.0, std::abs(mu)));
    b.erase(partner);
  }
  return largest;
}

Floquet floquet(const Vibration& vibration, const PeriodicStiffness& stiffness,
                double period, const FloquetSettings& settings)
{
  const double log_product =
      -period * (vibration.mass.inverse() * vibration.damping).trace();
  MonodromySettings finer = settings.first;
  Monodromy along = monodromy(vibration, stiffness, period, finer);
  Floquet result{.multipliers = multipliers_of(along.phi),
                 .change = std::numeric_limits<double>::infinity(),
                 .liouville = 0,
                 .evaluations = along.evaluations,
                 .settled = false};
  for (int k = 0; k < settings.most_refinements && !result.settled; ++k) {
    finer.tolerance /= 100;
    finer.panel /= 1.5;
    along = monodromy(vibration, stiffness, period, finer);
    Multipliers fine = multipliers_of(along.phi);
    result.change = largest_move(fine, result.multipliers);
    result.settled = result.change <= settings.tolerance;
    result.multipliers = std::move(fine);
    result.evaluations += along.evaluations;
  }
  result.liouville = std::abs(std::expm1(along.log_determinant - log_product));
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

namespace {

/** The bearing along a series of u. */
struct BearingAlong {
  BallBearing bearing;
  double clearance, cage_ratio;
  Eigen::MatrixXd series;

  Vec2 at(double phase) const
  {
    const std::complex<double> turn = std::polar(1.0, phase);
    std::complex<double> power = 1;
    double u_x = series(0, 0), u_y = series(1, 0);
    for (Eigen::Index h = 1; h < series.cols(); h += 2) {
      power *= turn;
      u_x += power.real() * series(0, h) + power.imag() * series(0, h + 1);
      u_y += power.real() * series(1, h) + power.imag() * series(1, h + 1);
    }
    return {u_x, u_y};
  }

  /** ∂F/∂u as the stiffness of x_s, y_s, x_r, y_r. */
  void stiffness(double phase, double* k) const
  {
    const Slopes2 s =
        bearing.reaction(Direction::of(cage_ratio * phase), at(phase)).stiffness;
    Eigen::Matrix2d joint;
    joint << s.xx, s.xy, s.xy, s.yy;
    Eigen::Map<Eigen::Matrix4d>(k) << joint, -joint, -joint, joint;
  }

  /** The phases where a ball's penetration changes its sign, ascending. */
  std::vector<double> contact_changes() const
  {
    const int points = static_cast<int>(std::max<Eigen::Index>(512, 8 * series.cols()));
    std::vector<double> before = penetrations(0), found;
    for (int k = 1; k <= points; ++k) {
      const double step = 2 * std::numbers::pi / points;
      std::vector<double> after = penetrations(k * step);
      for (std::size_t ball = 0; ball < after.size(); ++ball)
        if ((before[ball] > 0) != (after[ball] > 0))
          found.push_back(change_of(ball, (k - 1) * step, k * step));
      before = std::move(after);
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  double penetration(std::size_t ball, Vec2 in_cage) const
  {
    const Direction& d = bearing.balls()[ball];
    return d.cos * in_cage.x + d.sin * in_cage.y - clearance;
  }

  Vec2 in_cage(double phase) const
  {
    return into_frame(Direction::of(cage_ratio * phase), at(phase));
  }

  std::vector<double> penetrations(double phase) const
  {
    const Vec2 u = in_cage(phase);
    std::vector<double> values(bearing.balls().size());
    for (std::size_t ball = 0; ball < values.size(); ++ball)
      values[ball] = penetration(ball, u);
    return values;
  }

  /** The change between two phases, by bisection to rounding. */
  double change_of(std::size_t ball, double a, double b) const
  {
    const bool before = penetration(ball, in_cage(a)) > 0;
    for (double middle; (middle = a + (b - a) / 2) > a && middle < b;)
      ((penetration(ball, in_cage(middle)) > 0) == before ? a : b) = middle;
    return b;
  }
};

}  // namespace

PeriodicStiffness stiffness_along(const Parameters& parameters,
                                  const PeriodicMotion& motion)
{
  const Bearing& bearing = parameters.bearing;
  if (!bearing.is_plain())
    throw NoSolution("multipliers along a series know no contact damping and no defect");
  const BearingAlong along{BallBearing(bearing), bearing.clearance,
                           bearing.cage_speed_ratio,
                           motion.x.reshaped(2, motion.x.size() / 2)};
  return {.at = [along](double phase, double* k) { along.stiffness(phase, k); },
          .breaks = along.contact_changes()};
}

Floquet floquet(const Parameters& parameters, const PeriodicMotion& motion,
                const FloquetSettings& settings)
{
  return floquet(vibration_of(parameters), stiffness_along(parameters, motion),
                 2 * std::numbers::pi / motion.omega, settings);
}

}  // namespace rotor_stator
