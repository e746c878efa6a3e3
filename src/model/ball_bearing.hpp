/**
# The ball bearing (Eqs 3 to 6)

The cage carries the balls round; each is pressed by the motion of the rotor towards it.
Ball j stands at

$$\theta_j = \omega_{cage}\, t + 2\pi (j-1)/n \tag{3}$$

and the rotor (inner ring) approaches it by

$$\Delta_j = \cos\theta_j\,(x_r - x_s) + \sin\theta_j\,(y_r - y_s), \tag{4}$$

which squeezes the ball once it exceeds the clearance; the paper prints the opposite
order, which would be a negative stiffness (D-01). Its force Q_j (Eq. 5) is summed over
the balls (Eq. 6):

$$F = \sum_j Q_j\,(\cos\theta_j, \sin\theta_j), \tag{6}$$

acting as +F on the stator and -F on the rotor. Only the relative motion u = (x_r - x_s,
y_r - y_s) enters.

With contact damping (Hunt and Crossley 1975) the force of a loaded ball is
$Q_j (1 + \lambda\, d\Delta_j/dt)$, but never negative. A spall lets a ball lose h of its
deflection while it passes,

$$h = h_0 \cos^4(\pi\alpha/w), \qquad |\alpha| < w/2,$$

where α is the angle between ball and spall on the race that is damaged; a damaged ball
meets both races once in each turn about itself. Both need more than the cage's angle: the
rates of u, and what else turns.

In the frame that turns with the cage the directions of the balls are constants. The
relative motion is turned into that frame, the balls are summed, and the force is turned
back: one sine and one cosine of the cage angle serve all balls. */
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "model/lanes.hpp"
#include "model/parallel.hpp"
#include "model/parameters.hpp"

namespace rotor_stator {

/** A direction, by its cosine and sine. */
template <class Number>
struct DirectionOf {
  Number cos, sin;
  static DirectionOf of(Number angle) { return {std::cos(angle), std::sin(angle)}; }
};
using Direction = DirectionOf<double>;

/** A direction turned further by another. */
template <class Number>
IN_PLACE DirectionOf<Number> turned(DirectionOf<Number> a, DirectionOf<Number> b)
{
  return {a.cos * b.cos - a.sin * b.sin, a.sin * b.cos + a.cos * b.sin};
}

/** `v` seen from the frame turned by `d`. */
template <class Number>
IN_PLACE Vec2Of<Number> into_frame(DirectionOf<Number> d, Vec2Of<Number> v)
{
  return {d.cos * v.x + d.sin * v.y, d.cos * v.y - d.sin * v.x};
}

/** The inverse of `into_frame`. */
template <class Number = double>
IN_PLACE Vec2Of<Number> out_of_frame(DirectionOf<Number> d, Vec2Of<Number> v)
{
  return {d.cos * v.x - d.sin * v.y, d.sin * v.x + d.cos * v.y};
}

/** The balls of a bearing at the cage angle 0: n cosines and sines. */
struct BallRing {
  int count;
  const double *cos, *sin;
};

/** What Eqs 4 to 6 ask of an undamaged bearing, of one motion or of several. */
template <class Number>
struct ContactLaw {
  Number stiffness;   ///< K_H [N/m^{3/2}]
  Number clearance;   ///< δ [m]
  Number damping;     ///< λ of Hunt and Crossley [s/m]
  Number cage_speed;  ///< ω_cage [rad/s]
};

/** ∂F/∂u [N/m] of an elastic force, which is symmetric. */
template <class Number>
struct SlopeOf {
  Number xx{}, xy{}, yy{};
};

/** Eqs 4 to 6 of an undamaged bearing: the force [N] on the stator for the relative
    displacement u [m] and its rate [m/s], which matters where the contact is damped. With
    `slope` also ∂F/∂u of the undamped bearing. */
template <bool is_damped, class Number>
IN_PLACE Vec2Of<Number> bearing_force(const BallRing& balls,
                                      const ContactLaw<Number>& law,
                                      DirectionOf<Number> cage, Vec2Of<Number> u,
                                      Vec2Of<Number> rate,
                                      SlopeOf<Number>* slope = nullptr)
{
  Vec2Of<Number> sum{};
  if (!any_positive(u.x * u.x + u.y * u.y - law.clearance * law.clearance)) return sum;
  const Vec2Of<Number> v = into_frame(cage, u);
  Vec2Of<Number> w{};
  if constexpr (is_damped)
    w = into_frame(cage, Vec2Of<Number>{rate.x + law.cage_speed * u.y,
                                        rate.y - law.cage_speed * u.x});
  SlopeOf<Number> roots{};
  for (int j = 0; j < balls.count; ++j) {
    const double c = balls.cos[j], s = balls.sin[j];
    const Number approach = c * v.x + s * v.y - law.clearance;  // Δ_j - δ
    if (!any_positive(approach)) continue;
    const Number penetration = positive(approach), sqrt = root(penetration);
    Number q = penetration * sqrt;  // Q_j/K_H, Eq. 5
    if constexpr (is_damped) q = q * positive(1 + law.damping * (c * w.x + s * w.y));
    sum.x += q * c;
    sum.y += q * s;
    if (slope) {  // dQ_j/dΔ_j = 3/2 K_H √(Δ_j - δ)
      roots.xx += sqrt * (c * c);
      roots.xy += sqrt * (c * s);
      roots.yy += sqrt * (s * s);
    }
  }
  if (slope) {  // it turns back with the force: R S Rᵀ
    const Number c = cage.cos, s = cage.sin, k = 1.5 * law.stiffness;
    const Number mixed = 2 * c * s * roots.xy;
    slope->xx = k * (c * c * roots.xx + s * s * roots.yy - mixed);
    slope->xy = k * (c * s * (roots.xx - roots.yy) + (c * c - s * s) * roots.xy);
    slope->yy = k * (s * s * roots.xx + c * c * roots.yy + mixed);
  }
  return out_of_frame(cage, Vec2Of<Number>{law.stiffness * sum.x, law.stiffness * sum.y});
}

/** What turns in a bearing. */
struct Angles {
  Direction rotor, cage;
  Direction spin = {1, 0};  ///< of a damaged ball, seen from the cage
};

/** The bearing with its constant ball directions in the cage frame. */
class BallBearing {
public:
  /** `omega` is the base frequency [rad/s], `turns` those of the rotor in one base
      period: they matter to all but Eq. 5 alone. */
  explicit BallBearing(const Bearing& bearing, double omega = 0, int turns = 1);

  bool is_elastic_hertz() const { return is_elastic_hertz_; }

  /** Where everything stands at `phase` ωt [rad]. */
  Angles angles(double phase) const
  {
    return {Direction::of(turns_ * phase), Direction::of(bearing_.cage_angle(phase)),
            bearing_.defect.spin > 0 ? Direction::of(bearing_.defect.spin * phase)
                                     : Direction{1, 0}};
  }

  /** Eq. 6: force [N] on the stator for the displacement u [m] and its rate [m/s]. */
  Vec2 force(const Angles& at, Vec2 u, Vec2 rate) const
  {
    return is_elastic_hertz() ? elastic_force(at.cage, u)
                              : full_reaction(at, u, rate).force;
  }

  /** Of this the part of the balls, without the elements beside them. */
  Vec2 ball_force(const Angles& at, Vec2 u, Vec2 rate) const
  {
    return is_elastic_hertz() ? elastic_force(at.cage, u)
                              : ball_reaction(at, u, rate).force;
  }

  /** The same with its derivatives. */
  BearingReaction reaction(const Angles& at, Vec2 u, Vec2 rate) const
  {
    return is_elastic_hertz() ? BearingReaction{elastic_reaction(at.cage, u)}
                              : full_reaction(at, u, rate);
  }

  /** The same at rest, the rotor at the angle 0 and ball 1 at the angle `cage`. */
  Vec2 force(Direction cage, Vec2 u) const
  {
    return bearing_.is_intact_hertz() ? elastic_force(cage, u)
                                      : full_reaction({{1, 0}, cage}, u, {}).force;
  }
  ElasticReaction reaction(Direction cage, Vec2 u) const
  {
    return bearing_.is_intact_hertz() ? elastic_reaction(cage, u)
                                      : full_reaction({{1, 0}, cage}, u, {});
  }

  BallRing ring() const
  {
    return {static_cast<int>(cosines_.size()), cosines_.data(), sines_.data()};
  }
  ContactLaw<double> law() const
  {
    return {bearing_.contact_stiffness, bearing_.clearance, bearing_.damping,
            cage_speed_};
  }

  /** Eq. 5: the force Q_j [N] of each ball, j = 1…n in order. */
  std::vector<double> ball_forces(const Angles& at, Vec2 u, Vec2 rate) const;

private:
  struct Contact {
    std::size_t ball;
    Direction direction;
    double force;      ///< Q_j [N]
    double stiffness;  ///< ∂Q_j/∂Δ_j [N/m]
    double damping;    ///< ∂Q_j/∂(dΔ_j/dt) [N s/m]
    double rate;       ///< dΔ_j/dt [m/s]
  };
  template <class Visit>
  void each_contact(const Angles& at, Vec2 u, Vec2 rate, Visit visit) const;
  BearingReaction ball_reaction(const Angles& at, Vec2 u, Vec2 rate) const;
  BearingReaction full_reaction(const Angles& at, Vec2 u, Vec2 rate) const;
  Vec2 elastic_force(Direction cage, Vec2 u) const
  {
    return bearing_force<false>(ring(), law(), cage, u, {});
  }
  ElasticReaction elastic_reaction(Direction cage, Vec2 u) const
  {
    SlopeOf<double> slope;
    const Vec2 force = bearing_force<false>(ring(), law(), cage, u, {}, &slope);
    return {force, {slope.xx, slope.xy, slope.xy, slope.yy}};
  }

  /** What a ball has lost of its deflection, and how fast it loses more. */
  struct Loss {
    double depth, rate;
  };
  Loss loss(std::size_t ball, Direction direction, const Angles& at) const;

  Bearing bearing_;
  bool is_elastic_hertz_;
  double turns_, omega_, cage_speed_;    ///< [-], [rad/s], [rad/s]
  Direction place_;                      ///< of the spall's middle
  std::vector<double> cosines_, sines_;  ///< of the balls at cage angle 0
  Parallel parallel_;
};

/**
## The bearing's force at all instants of a period (Eqs 3 to 6)

Harmonic balance asks for the force at N instants at once. The directions of the cage and
of the balls in its frame are computed once. As many instants as fit into a register are
taken side by side; the balls are summed in the same order whatever its width. */

class SampledBearing {
public:
  /** N = `samples` instants ωt = 2πk/N of one base period, of Eq. 5 alone. */
  SampledBearing(const Bearing& bearing, int samples);

  /** Eq. 6: the force on the stator [N], N × 2, for the relative displacement `u` [m], N
      × 2. With `stiffness` also ∂F_i/∂u_j [N/m] in its column i + 2j, N × 4. */
  void operator()(const Eigen::MatrixXd& u, Eigen::MatrixXd& force,
                  Eigen::MatrixXd* stiffness) const;

private:
  Eigen::MatrixX2d cage_;  ///< cosines and sines; at least of one group
  BallBearing bearing_;
};

}  // namespace rotor_stator
