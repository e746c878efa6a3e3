#include "stability/monodromy.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <numbers>

#include "io/errors.hpp"

namespace rotor_stator {

namespace {

/** A stretch of the period, and whether k may be rough at its ends. */
struct Panel {
  double begin, end;
  bool rough_begin, rough_end;

  double width() const { return end - begin; }
  double phase(double tau) const
  {
    const auto [a, b, c] = cubic();
    return begin + width() * tau * (a + tau * (b + tau * c));
  }
  double slope(double tau) const
  {
    const auto [a, b, c] = cubic();
    return width() * (a + tau * (2 * b + tau * 3 * c));
  }

private:
  /** The share of the width passed at τ: aτ + bτ² + cτ³, flat at rough ends. */
  std::array<double, 3> cubic() const
  {
    if (rough_begin) return rough_end ? std::array{0., 3., -2.} : std::array{0., 1., 0.};
    return rough_end ? std::array{2., -1., 0.} : std::array{1., 0., 0.};
  }
};

/** The equation with d = D known to the compiler, in the scaled velocity w = dq̃/dt / r. */
template <int D>
class Disturbances {
public:
  using Square = Eigen::Matrix<double, D, D>;
  using Columns = Eigen::Matrix<double, D, 2 * D>;
  using Propagator = Eigen::Matrix<double, 2 * D, 2 * D>;

  Disturbances(const Vibration& vibration, const PeriodicStiffness& stiffness,
               double period, const MonodromySettings& settings)
      : per_mass_(vibration.mass.inverse()), damping_(per_mass_ * vibration.damping),
        constant_(per_mass_ * vibration.stiffness), stiffness_(stiffness),
        seconds_(period / (2 * std::numbers::pi)), settings_(settings)
  {
    for (int k = 0; k < 16; ++k)
      rate_ = std::max(rate_, squared_rate(2 * std::numbers::pi * (k + 0.5) / 16));
    rate_ = std::sqrt(rate_);
  }

  Monodromy over_the_period()
  {
    std::vector<double> ends = stiffness_.breaks;
    ends.push_back(2 * std::numbers::pi);
    double begin = 0;
    for (double end : ends) {
      if (end > begin) cross({begin, end, true, true});
      begin = end;
    }
    if (!total_.allFinite())
      throw NoSolution("the disturbances of the motion overflow within one period");
    Eigen::MatrixXd phi = total_;
    phi.topRightCorner(D, D) /= rate_;
    phi.bottomLeftCorner(D, D) *= rate_;
    return {std::move(phi), log_determinant_, evaluations_};
  }

private:
  /** M⁻¹(K + k). */
  Square squared_frequencies(double phase)
  {
    Square k;
    stiffness_.at(phase, k.data());
    ++evaluations_;
    return constant_ + per_mass_ * k;
  }
  double squared_rate(double phase) { return squared_frequencies(phase).norm(); }

  /** Cuts the panel into such as the extrapolation can do, and multiplies them up. */
  void cross(const Panel& panel)
  {
    if (evaluations_ > settings_.most_evaluations)
      throw NoSolution(
          format("the disturbances need more than %ld evaluations of the stiffness over "
                 "one period",
                 settings_.most_evaluations));
    double fastest = 0;
    for (double tau : {0.2, 0.5, 0.8})
      fastest = std::max(fastest, squared_rate(panel.phase(tau)));
    const bool shortest = panel.width() < 1e-12;
    const bool too_long = std::sqrt(fastest) * panel.width() * seconds_ > settings_.panel;
    const bool done = (shortest || !too_long) && extrapolate(panel);
    if (!done && !shortest) {
      const double middle = panel.begin + panel.width() / 2;
      cross({panel.begin, middle, panel.rough_begin, false});
      cross({middle, panel.end, false, panel.rough_end});
      return;
    }
    total_ = (product_ * total_).eval();
    log_determinant_ += std::log(std::abs(product_.determinant()));
  }

  /** The panel's propagator, by as many columns of the extrapolation as it takes; false when they
      are not enough. */
  bool extrapolate(const Panel& panel)
  {
    constexpr int most = 7;
    std::array<Propagator, most> row;
    for (int i = 0; i < most; ++i) {
      Propagator finest = midpoint_rule(panel, 2 * (i + 1));
      Propagator last = finest;
      for (int k = 1; k <= i; ++k) {
        const double ratio = static_cast<double>(i + 1) / (i + 1 - k);
        last = finest;
        finest += (finest - row[k - 1]) / (ratio * ratio - 1);
        row[k - 1] = last;
      }
      row[i] = finest;
      const double size = std::max(1.0, finest.cwiseAbs().maxCoeff());
      product_ = finest;
      if (i > 1 && (finest - last).cwiseAbs().maxCoeff() <= settings_.tolerance * size)
        return true;
    }
    return false;
  }

  /** Gragg's modified midpoint rule with n steps in τ, smoothed at its end. */
  Propagator midpoint_rule(const Panel& panel, int n)
  {
    const double h = 1.0 / n;
    q_.setZero();
    w_.setZero();
    q_.template leftCols<D>().setIdentity();
    w_.template rightCols<D>().setIdentity();
    Columns q_before = q_, w_before = w_;
    advance(panel, 0, h, q_, w_);
    for (int k = 1; k < n; ++k) {
      advance(panel, k * h, 2 * h, q_before, w_before);
      q_before.swap(q_);
      w_before.swap(w_);
    }
    advance(panel, 1, h, q_before, w_before);
    Propagator propagator;
    propagator << 0.5 * (q_ + q_before), 0.5 * (w_ + w_before);
    return propagator;
  }

  /** Adds `length` times the slopes at the present (q, w) and τ to another pair. */
  void advance(const Panel& panel, double tau, double length, Columns& q, Columns& w)
  {
    const double step = length * panel.slope(tau) * seconds_;
    if (step == 0) return;
    const Columns q_now = q_;
    q += step * rate_ * w_;
    w -= step * (squared_frequencies(panel.phase(tau)) * q_now / rate_ + damping_ * w_);
  }

  Square per_mass_, damping_, constant_;
  const PeriodicStiffness& stiffness_;
  double seconds_;  ///< per radian of the phase
  const MonodromySettings& settings_;
  double rate_ = 0;  ///< r [1/s]
  Columns q_, w_;    ///< the disturbances that began as the unit vectors
  Propagator product_, total_ = Propagator::Identity();
  double log_determinant_ = 0;
  long evaluations_ = 0;
};

}  // namespace

Monodromy monodromy(const Vibration& vibration, const PeriodicStiffness& stiffness,
                    double period, const MonodromySettings& settings)
{
  switch (vibration.mass.rows()) {
    case 1:
      return Disturbances<1>(vibration, stiffness, period, settings).over_the_period();
    case 2:
      return Disturbances<2>(vibration, stiffness, period, settings).over_the_period();
    case 4:
      return Disturbances<4>(vibration, stiffness, period, settings).over_the_period();
    default: throw BadInput("a monodromy matrix is computed for 1, 2 or 4 displacements");
  }
}

}  // namespace rotor_stator
