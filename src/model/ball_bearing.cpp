#include "model/ball_bearing.hpp"

#include <algorithm>
#include <cstring>
#include <numbers>

#include "model/hertz.hpp"

namespace rotor_stator {

BallBearing::BallBearing(const Bearing& bearing, double omega, int turns)
    : bearing_(bearing), is_elastic_hertz_(bearing.is_elastic_hertz()), turns_(turns),
      omega_(omega), cage_speed_(bearing.cage_speed_ratio * omega),
      place_(Direction::of(bearing.defect.place)),
      parallel_(bearing.parallel, bearing.parallel.speed_ratio * (turns * omega))
{
  for (int j = 0; j < bearing.balls; ++j) {
    const Direction ball = Direction::of(2 * std::numbers::pi * j / bearing.balls);
    cosines_.push_back(ball.cos);
    sines_.push_back(ball.sin);
  }
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
    speed = cage_speed_ - (turns ? turns_ * omega_ : 0);
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
  const double k_h = bearing_.contact_stiffness, n = bearing_.exponent;
  for (std::size_t j = 0; j < cosines_.size(); ++j) {
    const double approach = cosines_[j] * v.x + sines_[j] * v.y - bearing_.clearance;
    if (approach <= 0) continue;
    const Direction ball = turned({cosines_[j], sines_[j]}, at.cage);
    const Loss lost = is_damaged ? loss(j, ball, at) : Loss{0, 0};
    const double penetration = approach - lost.depth;
    if (penetration <= 0) continue;
    const double faster = ball.cos * w.x + ball.sin * w.y - lost.rate;
    const double share = 1 + bearing_.damping * faster;
    if (share <= 0) continue;
    const double hertz = hertz_force(k_h, penetration, n);
    visit(Contact{j, ball, share * hertz, share * hertz_stiffness(k_h, penetration, n),
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
  std::vector<double> q(cosines_.size(), 0.0);
  each_contact(at, u, rate, [&](const Contact& on) { q[on.ball] = on.force; });
  return q;
}

namespace {

constexpr int most_instants = 8;  ///< of a group

/** Of as many instants as lanes from the first on. */
template <class Number>
IN_PLACE Number read(const double* from)
{
  Number row;
  std::memcpy(&row, from, sizeof row);
  return row;
}

template <class Number>
IN_PLACE void write(const Number& row, double* to)
{
  std::memcpy(to, &row, sizeof row);
}

/** The force at N instants, and its slopes where they are asked for. */
struct Samples {
  BallRing balls;
  ContactLaw<double> law;
  const Eigen::MatrixX2d& cage;
  const Eigen::MatrixXd& u;
  Eigen::MatrixXd& force;
  Eigen::MatrixXd* stiffness;

  /** The last group overlaps the one before where N is no multiple of the lanes. */
  template <class Number, bool with_stiffness>
  IN_PLACE void evaluate() const
  {
    constexpr Eigen::Index instants = lanes_in<Number>;
    const ContactLaw<Number> laws{
        Number{} + law.stiffness, Number{} + law.clearance, {}, {}};
    for (Eigen::Index begin = 0; begin < u.rows(); begin += instants) {
      const Eigen::Index k = std::min(begin, u.rows() - instants);
      SlopeOf<Number> slope{};
      const auto f = bearing_force<false>(
          balls, laws,
          DirectionOf<Number>{read<Number>(&cage(k, 0)), read<Number>(&cage(k, 1))},
          Vec2Of<Number>{read<Number>(&u(k, 0)), read<Number>(&u(k, 1))},
          Vec2Of<Number>{}, with_stiffness ? &slope : nullptr);
      write(f.x, &force(k, 0));
      write(f.y, &force(k, 1));
      if constexpr (with_stiffness) {
        write(slope.xx, &(*stiffness)(k, 0));
        write(slope.xy, &(*stiffness)(k, 1));
        write(slope.xy, &(*stiffness)(k, 2));
        write(slope.yy, &(*stiffness)(k, 3));
      }
    }
  }
};

template <Registers registers>
void evaluate(const Samples& samples)
{
  in_registers(
      registers, [&]() __attribute__((always_inline)) {
        using Number = Lanes<static_cast<int>(registers)>;
        if (samples.stiffness)
          samples.evaluate<Number, true>();
        else
          samples.evaluate<Number, false>();
      });
}

void evaluate(const Samples& samples)
{
#ifdef HAS_WIDE_REGISTERS
  if (widest_registers() == Registers::avx512)
    return evaluate<Registers::avx512>(samples);
  if (widest_registers() == Registers::avx2) return evaluate<Registers::avx2>(samples);
#endif
  evaluate<Registers::plain>(samples);
}

}  // namespace

SampledBearing::SampledBearing(const Bearing& bearing, int samples)
    : cage_(std::max(samples, most_instants), 2), bearing_(bearing)
{
  for (Eigen::Index k = 0; k < cage_.rows(); ++k) {
    const Direction cage = Direction::of(
        bearing.cage_angle(2 * std::numbers::pi * static_cast<double>(k) / samples));
    cage_.row(k) << cage.cos, cage.sin;
  }
}

/** Fewer instants than lanes are filled up with motions at rest. */
void SampledBearing::operator()(const Eigen::MatrixXd& u, Eigen::MatrixXd& force,
                                Eigen::MatrixXd* stiffness) const
{
  if (u.rows() < cage_.rows()) {
    Eigen::MatrixXd filled = Eigen::MatrixXd::Zero(cage_.rows(), 2);
    filled.topRows(u.rows()) = u;
    (*this)(filled, force, stiffness);
    force.conservativeResize(u.rows(), 2);
    if (stiffness) stiffness->conservativeResize(u.rows(), 4);
    return;
  }
  force.resize(cage_.rows(), 2);
  if (stiffness) stiffness->resize(cage_.rows(), 4);
  evaluate({bearing_.ring(), bearing_.law(), cage_, u, force, stiffness});
}

}  // namespace rotor_stator
