#include "model/rotor_stator.hpp"

#include <cmath>
#include <numbers>

#include "model/hertz.hpp"
#include "model/parallel.hpp"

namespace rotor_stator {

RotorStator::RotorStator(const Parameters& parameters, double omega)
    : bearing_(parameters.bearing, omega, parameters.turns), omega_(omega)
{
  const Body &s = parameters.stator, &r = parameters.rotor;
  const double speed = parameters.turns * omega;
  equation_ = {.k_s = s.stiffness(),
               .c_s = s.damping(),
               .per_m_s = 1 / s.mass,
               .k_r = r.stiffness(),
               .c_r = r.damping(),
               .per_m_r = 1 / r.mass,
               .unbalance = parameters.unbalance * speed * speed,
               .rest = {s.static_acceleration(parameters.gravity),
                        r.static_acceleration(parameters.gravity)}};
  for (std::size_t k = 0; k < parameters.grounds.size(); ++k) {
    const ParallelElements& elements = parameters.grounds[k].parallel;
    const std::array<int, 4> places =
        parameters.bodies->places(1 + parameters.further.size() + k);
    const bool is_rotor = places[2] == 2;
    grounds_.push_back(
        {Parallel(elements, elements.speed_ratio * parameters.turns * omega), is_rotor,
         is_rotor ? equation_.per_m_r : equation_.per_m_s});
  }
}

double RotorStator::period() const
{
  return 2 * std::numbers::pi / omega_;
}

DynamicStiffness dynamic_stiffness(const Body& body, double frequency)
{
  return {.value = {body.stiffness() - body.mass * frequency * frequency,
                    body.damping() * frequency},
          .slope = {-2 * body.mass * frequency, body.damping()}};
}

double joint_resonance(const Parameters& parameters)
{
  if (parameters.stator.rigid)
    return parameters.rotor.stiffness() > 0 ? parameters.rotor.natural_frequency
                                            : parameters.stator.natural_frequency;
  return std::sqrt((parameters.stator.stiffness() + parameters.rotor.stiffness()) /
                   (parameters.stator.mass + parameters.rotor.mass));
}

double speed_scale(const Parameters& parameters)
{
  const double joint = joint_resonance(parameters);
  return joint > 0 ? joint : contact_frequency(parameters);
}

Scales scales(const Parameters& parameters)
{
  const Body &s = parameters.stator, &r = parameters.rotor;
  const double weight = ((s.rigid ? 0 : s.mass) + r.mass) * parameters.gravity +
                        std::hypot(s.load.x, s.load.y) + std::hypot(r.load.x, r.load.y);
  const double resonance = joint_resonance(parameters);
  const double unbalance = parameters.unbalance * resonance * resonance;
  Scales most{};
  for (const Bearing& bearing : bearings_of(parameters)) {
    const double k_h = bearing.contact_stiffness, n = bearing.exponent,
                 gap = bearing.clearance;
    /** Without any load u = 0, and a nanometre of penetration stands for its size. */
    const double load = std::max(weight + unbalance, hertz_force(k_h, 1e-9, n));
    const double penetration = std::max(-gap, hertz_penetration(k_h, load, n));
    const double length = std::abs(gap) + penetration;
    const double stiffness = hertz_stiffness(k_h, penetration, n) +
                             largest_stiffness(bearing.parallel, load, length);
    most = {std::max(most.load, load), std::max(most.penetration, penetration),
            std::max(most.length, length), std::max(most.stiffness, stiffness)};
  }
  return most;
}

double contact_frequency(const Parameters& parameters)
{
  return std::sqrt(scales(parameters).stiffness *
                   (1 / parameters.stator.mass + 1 / parameters.rotor.mass));
}

Eigen::VectorXd vector_of(const State& state)
{
  const Eigen::Index more = state.inner.size() / 2;
  Eigen::VectorXd y(8 + 2 * more);
  put(state.position, y.data());
  put(state.velocity, y.data() + 4 + more);
  y.segment(4, more) = state.inner.head(more);
  y.tail(more) = state.inner.tail(more);
  return y;
}

State state_of(const Eigen::VectorXd& y)
{
  const Eigen::Index half = y.size() / 2, more = half - 4;
  State state{bodies_at(y.data()), bodies_at(y.data() + half), Eigen::VectorXd(2 * more)};
  state.inner << y.segment(4, more), y.tail(more);
  return state;
}

double Machine::quickest_contact(const Parameters& parameters) const
{
  return contact_frequency(parameters);
}

Eigen::VectorXd Machine::state_scales(const Parameters& parameters) const
{
  const double length = scales(parameters).length;
  Vector8 sizes;
  sizes.head<4>().setConstant(length);
  sizes.tail<4>().setConstant(length * contact_frequency(parameters));
  return sizes;
}

Vec2 static_joint_force(const Parameters& parameters)
{
  const double k_s = parameters.stator.stiffness(), k_r = parameters.rotor.stiffness();
  const Vec2 f_s = parameters.stator.static_load(parameters.gravity);
  const Vec2 f_r = parameters.rotor.static_load(parameters.gravity);
  return {(k_s * f_r.x - k_r * f_s.x) / (k_s + k_r),
          (k_s * f_r.y - k_r * f_s.y) / (k_s + k_r)};
}

Vec2 rigid_joint_force(const Parameters& parameters, double omega, double phase)
{
  const Vec2 rest = static_joint_force(parameters);
  const double speed = parameters.turns * omega;
  const auto z_s = dynamic_stiffness(parameters.stator, speed).value;
  const auto z_r = dynamic_stiffness(parameters.rotor, speed).value;
  const auto whirl = z_s * parameters.unbalance * speed * speed / (z_s + z_r) *
                     std::polar(1.0, parameters.turns * phase);
  return {rest.x + whirl.real(), rest.y + whirl.imag()};
}

std::vector<double> equal_force_speeds(const Parameters& parameters, double highest)
{
  const Vec2 rest = static_joint_force(parameters);
  const auto unbalance_prevails = [&](double omega) {
    const Vec2 force = rigid_joint_force(parameters, omega, 0);
    return std::hypot(force.x - rest.x, force.y - rest.y) > std::hypot(rest.x, rest.y);
  };
  constexpr int steps = 4000;
  std::vector<double> speeds;
  for (int k = 0; k < steps; ++k) {
    double low = highest * k / steps, high = highest * (k + 1) / steps;
    const bool before = unbalance_prevails(low);
    if ((rest.x == 0 && rest.y == 0) || unbalance_prevails(high) == before) continue;
    for (int halving = 0; halving < 40; ++halving) {
      const double middle = 0.5 * (low + high);
      (unbalance_prevails(middle) == before ? low : high) = middle;
    }
    speeds.push_back(0.5 * (low + high));
  }
  return speeds;
}

Vec2 free_displacement(const Parameters& parameters, double omega, double phase)
{
  /** Without a suspension a loaded body sags without end, an unloaded one stays. */
  const auto sag = [&](const Body& body) -> Vec2 {
    const double squared = body.natural_frequency * body.natural_frequency;
    const Vec2 a = body.static_acceleration(parameters.gravity);
    return {a.x == 0 ? 0 : a.x / squared, a.y == 0 ? 0 : a.y / squared};
  };
  const Vec2 s = sag(parameters.stator), r = sag(parameters.rotor);
  const double speed = parameters.turns * omega;
  const auto whirl = parameters.unbalance * speed * speed /
                     dynamic_stiffness(parameters.rotor, speed).value *
                     std::polar(1.0, parameters.turns * phase);
  return {r.x - s.x + whirl.real(), r.y - s.y + whirl.imag()};
}

Vec2 quasi_static_contact(const Bearing& bearing, Vec2 force)
{
  const double size = std::hypot(force.x, force.y);
  if (size == 0) return {0, 0};
  const double k = bearing.contact_stiffness, n = bearing.exponent;
  double reach = std::max(0.0, bearing.clearance + hertz_penetration(k, size, n));
  if (bearing.parallel.any()) {
    /** Nearer, where the elements beside the balls carry a part of the force. */
    const Parallel beside(bearing.parallel, 0);
    double nearer = 0;
    for (int halving = 0; halving < 50; ++halving) {
      const double middle = 0.5 * (nearer + reach);
      const double carried = beside.reaction({middle, 0}, {0, 0}).force.x +
                             hertz_force(k, middle - bearing.clearance, n);
      (carried < size ? nearer : reach) = middle;
    }
  }
  return {reach * force.x / size, reach * force.y / size};
}

namespace {

/** Where the bearing with ball 1 at angle `cage`, and a spring [N/m] beside it, answer
    with `force`: Newton from far enough along that force for balls to touch. The
    potential is convex, so steps that are halved until the error falls arrive. One or two
    balls may not be able to answer; what is left then is a start too. */
Vec2 equilibrium(const Parameters& parameters, Vec2 force, Direction cage = {1, 0},
                 double spring = 0)
{
  const BallBearing bearing(parameters.bearing);
  Vec2 u = quasi_static_contact(parameters.bearing, force);
  const auto off = [&](Vec2 at) {
    const Vec2 f = bearing.force(cage, at) + spring * at;
    return std::hypot(force.x - f.x, force.y - f.y);
  };
  for (int k = 0; k < 4 && off(u) == off({0, 0}); ++k) u = 2.0 * u;
  for (int step = 0; step < 100; ++step) {
    const auto [balls, s] = bearing.reaction(cage, u);
    const Vec2 f = balls + spring * u;
    const double error = off(u), little = 1e-6 * (s.xx + s.yy) + spring;
    if (!(error > 1e-12 * std::hypot(force.x, force.y)) || little == 0) break;
    const Vec2 rest{force.x - f.x, force.y - f.y};
    const double xx = s.xx + little, yy = s.yy + little;
    const double per = 1 / (xx * yy - s.xy * s.xy);
    Vec2 change{per * (yy * rest.x - s.xy * rest.y), per * (xx * rest.y - s.xy * rest.x)};
    for (int halving = 0; halving < 40 && !(off(u + change) < error); ++halving)
      change = 0.5 * change;
    if (!(off(u + change) < error)) break;
    u = u + change;
  }
  return u;
}

/** Both bodies at rest at the displacement `u`, where the bearing has this `force`. */
State standing(const Parameters& parameters, Vec2 u, Vec2 force)
{
  const auto displaced = [&](const Body& body, double sign) -> Vec2 {
    const Vec2 load = body.static_load(parameters.gravity);
    return {(sign * force.x + load.x) / body.stiffness(),
            (sign * force.y + load.y) / body.stiffness()};
  };
  if (parameters.stator.stiffness() == 0) {
    const Vec2 r = displaced(parameters.rotor, -1);
    return {.position = {.stator = r + -1.0 * u, .rotor = r}, .velocity = {}};
  }
  const Vec2 s = displaced(parameters.stator, 1);
  return {.position = {.stator = s, .rotor = s + u}, .velocity = {}};
}

}  // namespace

State Machine::at_rest(const Parameters& parameters, Direction cage) const
{
  const double k_s = parameters.stator.stiffness(), k_r = parameters.rotor.stiffness();
  const double spring = k_s / (k_s + k_r) * k_r;
  const Vec2 force = static_joint_force(parameters);
  const Vec2 u = equilibrium(parameters, force, cage, spring);
  return standing(parameters, u, force + -spring * u);
}

State Machine::static_start(const Parameters& parameters) const
{
  const Vec2 force = static_joint_force(parameters);
  const bool is_carried =
      parameters.stator.stiffness() == 0 || parameters.rotor.stiffness() == 0;
  return standing(parameters,
                  is_carried ? equilibrium(parameters, force)
                             : quasi_static_contact(parameters.bearing, force),
                  force);
}

}  // namespace rotor_stator
