#include "model/ball_bearing.hpp"

#include <numbers>

namespace rotor_stator
{

BallBearing::BallBearing(const Bearing& bearing)
    : contact_stiffness_(bearing.contact_stiffness),
      clearance_(bearing.clearance),
      clearance_squared_(bearing.clearance * bearing.clearance)
{
  for (int j = 0; j < bearing.balls; ++j)
    balls_.push_back(Direction::of(2 * std::numbers::pi * j / bearing.balls));
}

BearingReaction BallBearing::reaction(Direction cage, Vec2 u) const
{
  if (u.x * u.x + u.y * u.y <= clearance_squared_) return {};
  const Vec2 v = into_frame(cage, u);
  Vec2 sum{0, 0};
  Stiffness2 slope{0, 0, 0};
  for (const Direction& ball : balls_) {
    const double p = ball.cos * v.x + ball.sin * v.y - clearance_;
    if (p <= 0) continue;
    const double root = std::sqrt(p);
    sum.x += p * root * ball.cos;
    sum.y += p * root * ball.sin;
    slope.xx += root * ball.cos * ball.cos;
    slope.xy += root * ball.cos * ball.sin;
    slope.yy += root * ball.sin * ball.sin;
  }

  /** The stiffness turns back with the force: R S Rᵀ. */
  const double c = cage.cos, s = cage.sin, k = 1.5 * contact_stiffness_;
  const double mixed = 2 * c * s * slope.xy;
  return {.force = out_of_frame(cage,
                                {contact_stiffness_ * sum.x, contact_stiffness_ * sum.y}),
          .stiffness = {
              .xx = k * (c * c * slope.xx + s * s * slope.yy - mixed),
              .xy = k * (c * s * (slope.xx - slope.yy) + (c * c - s * s) * slope.xy),
              .yy = k * (s * s * slope.xx + c * c * slope.yy + mixed)}};
}

void BallBearing::ball_forces(Direction cage, Vec2 u, std::vector<double>& q) const
{
  const Vec2 v = into_frame(cage, u);
  q.resize(balls_.size());
  for (std::size_t j = 0; j < balls_.size(); ++j)
    q[j] = hertz_force(contact_stiffness_,
                       balls_[j].cos * v.x + balls_[j].sin * v.y - clearance_);
}

}  // namespace rotor_stator
