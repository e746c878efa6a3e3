#include "model/ball_bearing.hpp"

#include <algorithm>
#include <numbers>

#include "model/hertz.hpp"
#include "model/registers.hpp"

namespace rotor_stator {

BallBearing::BallBearing(const Bearing& bearing, double omega, int turns)
    : bearing_(bearing), is_plain_(bearing.is_plain()), turns_(turns), omega_(omega),
      rotor_speed_(turns * omega), cage_speed_(bearing.cage_speed_ratio * omega),
      place_(Direction::of(bearing.defect.place)),
      parallel_(bearing.parallel, bearing.parallel.speed_ratio * rotor_speed_),
      contact_stiffness_(bearing.contact_stiffness), clearance_(bearing.clearance),
      clearance_squared_(bearing.clearance * bearing.clearance)
{
  for (int j = 0; j < bearing.balls; ++j) {
    balls_.push_back(Direction::of(2 * std::numbers::pi * j / bearing.balls));
    cosines_.push_back(balls_.back().cos);
    sines_.push_back(balls_.back().sin);
  }
}

ElasticReaction BallBearing::plain_reaction(Direction cage, Vec2 u) const
{
  if (u.x * u.x + u.y * u.y <= clearance_squared_) return {};
  const Vec2 v = into_frame(cage, u);
  Vec2 sum{0, 0};
  struct {
    double xx = 0, xy = 0, yy = 0;
  } slope;
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
  const double xy = k * (c * s * (slope.xx - slope.yy) + (c * c - s * s) * slope.xy);
  return {.force = out_of_frame(cage,
                                {contact_stiffness_ * sum.x, contact_stiffness_ * sum.y}),
          .stiffness = {.xx = k * (c * c * slope.xx + s * s * slope.yy - mixed),
                        .xy = xy,
                        .yx = xy,
                        .yy = k * (s * s * slope.xx + c * c * slope.yy + mixed)}};
}

namespace {

Direction opposite(Direction d)
{
  return {d.cos, -d.sin};
}

}  // namespace

BallBearing::Loss BallBearing::loss(std::size_t ball, Direction direction,
                                    const Angles& at) const
{
  const Defect& spall = bearing_.defect;
  Direction met =
      turned(at.spin, opposite(place_));  // from the spall's middle to the contact
  double speed = spall.spin * omega_;
  if (spall.surface != Defect::Surface::ball) {
    const bool turns = spall.surface == Defect::Surface::inner_race;
    met = turned(direction, opposite(place_));
    if (turns) met = turned(met, opposite(at.rotor));
    speed = cage_speed_ - (turns ? rotor_speed_ : 0);
  } else if (ball + 1 != static_cast<std::size_t>(spall.ball)) {
    return {0, 0};
  } else if (met.cos < 0) {
    met = {-met.cos, -met.sin};  // on the other race
  }
  const double share = std::atan2(met.sin, met.cos) / spall.width;
  if (std::abs(share) >= 0.5) return {0, 0};
  const double c = std::cos(std::numbers::pi * share);
  const double slope = -4 * std::numbers::pi / spall.width * c * c * c *
                       std::sin(std::numbers::pi * share);
  return {spall.depth * c * c * c * c, spall.depth * slope * speed};
}

/** Deflections change by the rates of u and by the cage's turning along the race. */
template <class Visit>
void BallBearing::each_contact(const Angles& at, Vec2 u, Vec2 rate, Visit visit) const
{
  const Vec2 v = into_frame(at.cage, u);
  const Vec2 w{rate.x + cage_speed_ * u.y, rate.y - cage_speed_ * u.x};
  const bool is_damaged = !bearing_.is_damaged(Defect::Surface::none);
  for (std::size_t j = 0; j < balls_.size(); ++j) {
    const double near = balls_[j].cos * v.x + balls_[j].sin * v.y - clearance_;
    if (near <= 0) continue;
    const Direction ball = turned(balls_[j], at.cage);
    const Loss lost = is_damaged ? loss(j, ball, at) : Loss{0, 0};
    const double pressed = near - lost.depth;
    if (pressed <= 0) continue;
    const double faster = ball.cos * w.x + ball.sin * w.y - lost.rate;
    const double share = 1 + bearing_.damping * faster;
    if (share <= 0) continue;
    const double n = bearing_.exponent;
    const double hertz = hertz_force(contact_stiffness_, pressed, n);
    visit(Contact{j, ball, share * hertz,
                  share * hertz_stiffness(contact_stiffness_, pressed, n),
                  bearing_.damping * hertz, faster});
  }
}

BearingReaction BallBearing::ball_reaction(const Angles& at, Vec2 u, Vec2 rate) const
{
  BearingReaction sum{};
  each_contact(at, u, rate, [&](const Contact& on) {
    const auto [c, s] = on.direction;
    const double turning = on.damping * cage_speed_;
    const double by_speed = omega_ > 0 ? on.damping * on.rate / omega_ : 0;
    sum.force.x += on.force * c;
    sum.force.y += on.force * s;
    sum.stiffness.xx += c * (on.stiffness * c - turning * s);
    sum.stiffness.xy += c * (on.stiffness * s + turning * c);
    sum.stiffness.yx += s * (on.stiffness * c - turning * s);
    sum.stiffness.yy += s * (on.stiffness * s + turning * c);
    sum.damping.xx += on.damping * c * c;
    sum.damping.xy += on.damping * c * s;
    sum.damping.yy += on.damping * s * s;
    sum.speed_slope.x += by_speed * c;
    sum.speed_slope.y += by_speed * s;
  });
  sum.damping.yx = sum.damping.xy;
  return sum;
}

BearingReaction BallBearing::full_reaction(const Angles& at, Vec2 u, Vec2 rate) const
{
  BearingReaction sum = ball_reaction(at, u, rate);
  if (bearing_.parallel.any()) parallel_.add(u, rate, omega_, sum);
  return sum;
}

std::vector<double> BallBearing::ball_forces(const Angles& at, Vec2 u, Vec2 rate) const
{
  std::vector<double> q(balls_.size(), 0.0);
  each_contact(at, u, rate, [&](const Contact& on) { q[on.ball] = on.force; });
  return q;
}

namespace {

/** Instants of a group, one per lane: loops of this fixed length become vector
    instructions. */
constexpr int lanes = 8;

/** Columns of N numbers. */
struct Columns {
  const double *cos, *sin;  ///< of the cage
  const double *x, *y;      ///< relative displacement [m]
  double *f_x, *f_y;        ///< force [N]
  double *xx, *xy, *yy;     ///< stiffness [N/m]
};

struct Balls {
  Eigen::Index count;
  const double *cos, *sin;  ///< in the cage frame
  double contact_stiffness, clearance;
};

/** Whether a ball touches nowhere in the rectangle of a group's motions: c x + s y ≤ δ.
    Rounding is monotone, so this holds for the rounded numbers too. */
struct Rectangle {
  double left, right, bottom, top;

  Rectangle(const double* x, const double* y)
      : left(x[0]), right(x[0]), bottom(y[0]), top(y[0])
  {
    for (int l = 1; l < lanes; ++l) {
      left = std::min(left, x[l]);
      right = std::max(right, x[l]);
      bottom = std::min(bottom, y[l]);
      top = std::max(top, y[l]);
    }
  }
  bool is_clear_of(double c, double s, double clearance) const
  {
    return std::max(c * left, c * right) + std::max(s * bottom, s * top) <= clearance;
  }
};

/** Relative motion in the cage frame [m], and the sums over the balls: the force over
    K_H, the stiffness over 3/2 K_H. */
struct Group {
  double x[lanes], y[lanes];
  double f_x[lanes] = {}, f_y[lanes] = {};
  double xx[lanes] = {}, xy[lanes] = {}, yy[lanes] = {};
};

/** R S Rᵀ. */
IN_PLACE void put_stiffness(const Group& g, double hertz, const Columns& at,
                            Eigen::Index k)
{
  for (int l = 0; l < lanes; ++l) {
    const double c = at.cos[k + l], s = at.sin[k + l], mixed = 2 * c * s * g.xy[l];
    at.xx[k + l] = 1.5 * hertz * (c * c * g.xx[l] + s * s * g.yy[l] - mixed);
    at.xy[k + l] =
        1.5 * hertz * (c * s * (g.xx[l] - g.yy[l]) + (c * c - s * s) * g.xy[l]);
    at.yy[k + l] = 1.5 * hertz * (s * s * g.xx[l] + c * c * g.yy[l] + mixed);
  }
}

/** One group, from instant k on. */
template <bool with_stiffness>
IN_PLACE void evaluate_group(const Balls& balls, const Columns& at, Eigen::Index k)
{
  const double *c = at.cos + k, *s = at.sin + k;
  Group g;
  for (int l = 0; l < lanes; ++l) {
    g.x[l] = c[l] * at.x[k + l] + s[l] * at.y[k + l];
    g.y[l] = c[l] * at.y[k + l] - s[l] * at.x[k + l];
  }
  const Rectangle rectangle(g.x, g.y);
  for (Eigen::Index j = 0; j < balls.count; ++j) {
    const double cos = balls.cos[j], sin = balls.sin[j];
    if (rectangle.is_clear_of(cos, sin, balls.clearance)) continue;
    for (int l = 0; l < lanes; ++l) {
      const double p = cos * g.x[l] + sin * g.y[l] - balls.clearance;  // Δ_j - δ
      const double pressed = p > 0 ? p : 0.0;
      const double root = std::sqrt(pressed), q = pressed * root;  // Eq. 5 over K_H
      g.f_x[l] += q * cos;
      g.f_y[l] += q * sin;
      if constexpr (with_stiffness) {
        g.xx[l] += root * (cos * cos);
        g.xy[l] += root * (cos * sin);
        g.yy[l] += root * (sin * sin);
      }
    }
  }
  const double hertz = balls.contact_stiffness;
  for (int l = 0; l < lanes; ++l) {
    at.f_x[k + l] = hertz * (c[l] * g.f_x[l] - s[l] * g.f_y[l]);
    at.f_y[k + l] = hertz * (s[l] * g.f_x[l] + c[l] * g.f_y[l]);
  }
  if constexpr (with_stiffness) put_stiffness(g, hertz, at, k);
}

/** All groups; the last one overlaps the one before where N is no multiple of the
    lanes. */
WIDEST_REGISTERS void evaluate_force(const Balls& balls, const Columns& at,
                                     Eigen::Index n)
{
  for (Eigen::Index k = 0; k < n; k += lanes)
    evaluate_group<false>(balls, at, std::min(k, n - lanes));
}

WIDEST_REGISTERS void evaluate_both(const Balls& balls, const Columns& at, Eigen::Index n)
{
  for (Eigen::Index k = 0; k < n; k += lanes)
    evaluate_group<true>(balls, at, std::min(k, n - lanes));
}

}  // namespace

SampledBearing::SampledBearing(const Bearing& bearing, int samples)
    : samples_(samples), cage_(std::max(samples, lanes), 2), balls_(bearing.balls, 2),
      contact_stiffness_(bearing.contact_stiffness), clearance_(bearing.clearance)
{
  const auto row = [](Direction d) { return Eigen::RowVector2d(d.cos, d.sin); };
  for (Eigen::Index k = 0; k < cage_.rows(); ++k)
    cage_.row(k) = row(Direction::of(bearing.cage_phase +
                                     bearing.cage_speed_ratio * 2 * std::numbers::pi *
                                         static_cast<double>(k) / samples));
  const BallBearing plain(bearing);
  for (int j = 0; j < bearing.balls; ++j) balls_.row(j) = row(plain.balls()[j]);
}

void SampledBearing::operator()(const Eigen::MatrixXd& u, Eigen::MatrixXd& force,
                                Eigen::MatrixXd* stiffness) const
{
  if (samples_ < lanes) return force_of_few(u, force, stiffness);
  force.resize(samples_, 2);
  if (stiffness) stiffness->resize(samples_, 4);
  const auto column = [&](Eigen::Index k) {
    return stiffness ? stiffness->col(k).data() : nullptr;
  };
  const Balls balls{balls_.rows(), balls_.col(0).data(), balls_.col(1).data(),
                    contact_stiffness_, clearance_};
  const Columns at{cage_.col(0).data(), cage_.col(1).data(), u.col(0).data(),
                   u.col(1).data(),     force.col(0).data(), force.col(1).data(),
                   column(0),           column(1),           column(3)};
  if (!stiffness) return evaluate_force(balls, at, samples_);
  evaluate_both(balls, at, samples_);
  stiffness->col(2) = stiffness->col(1);
}

/** Fewer instants than lanes: filled up with motions at rest. */
void SampledBearing::force_of_few(const Eigen::MatrixXd& u, Eigen::MatrixXd& force,
                                  Eigen::MatrixXd* stiffness) const
{
  Eigen::MatrixXd filled = Eigen::MatrixXd::Zero(lanes, 2);
  filled.topRows(samples_) = u;
  SampledBearing wide = *this;
  wide.samples_ = lanes;
  wide(filled, force, stiffness);
  force.conservativeResize(samples_, 2);
  if (stiffness) stiffness->conservativeResize(samples_, 4);
}

}  // namespace rotor_stator
