#include "model/rotor_stator.hpp"

#include <cmath>
#include <numbers>

#include "model/hertz.hpp"

namespace rotor_stator {

RotorStator::RotorStator(const Parameters& parameters, double omega)
    : bearing_(parameters.bearing), omega_(omega), turns_(parameters.turns),
      cage_ratio_(parameters.bearing.cage_speed_ratio),
      unbalance_(parameters.unbalance * (turns_ * omega) * (turns_ * omega)),
      gravity_(parameters.gravity), k_s_(parameters.stator.stiffness()),
      c_s_(parameters.stator.damping()), per_m_s_(1 / parameters.stator.mass),
      k_r_(parameters.rotor.stiffness()), c_r_(parameters.rotor.damping()),
      per_m_r_(1 / parameters.rotor.mass)
{
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
  return std::sqrt((parameters.stator.stiffness() + parameters.rotor.stiffness()) /
                   (parameters.stator.mass + parameters.rotor.mass));
}

Scales scales(const Parameters& parameters)
{
  const double weight =
      (parameters.stator.mass + parameters.rotor.mass) * parameters.gravity;
  const double resonance = joint_resonance(parameters);
  const double unbalance = parameters.unbalance * resonance * resonance;
  const double k_h = parameters.bearing.contact_stiffness;

  /** Without any load the answer is u = 0 and a nanometre of penetration stands for its
      size. */
  const double load = std::max(weight + unbalance, hertz_force(k_h, 1e-9));
  const double penetration = hertz_penetration(k_h, load);
  return {.load = load,
          .penetration = penetration,
          .length = parameters.bearing.clearance + penetration,
          .stiffness = hertz_stiffness(k_h, penetration)};
}

double contact_frequency(const Parameters& parameters)
{
  return std::sqrt(scales(parameters).stiffness *
                   (1 / parameters.stator.mass + 1 / parameters.rotor.mass));
}

Vector8 state_scales(const Parameters& parameters)
{
  const double length = scales(parameters).length;
  Vector8 sizes;
  sizes.head<4>().setConstant(length);
  sizes.tail<4>().setConstant(length * contact_frequency(parameters));
  return sizes;
}

Vec2 rigid_joint_force(const Parameters& parameters, double omega, double phase)
{
  const double k_s = parameters.stator.stiffness(), k_r = parameters.rotor.stiffness();
  const double weight_s = parameters.stator.mass * parameters.gravity;
  const double weight_r = parameters.rotor.mass * parameters.gravity;
  const double gravity = (k_r * weight_s - k_s * weight_r) / (k_s + k_r);

  const double speed = parameters.turns * omega;
  const auto z_s = dynamic_stiffness(parameters.stator, speed).value;
  const auto z_r = dynamic_stiffness(parameters.rotor, speed).value;
  const auto whirl = z_s * parameters.unbalance * speed * speed / (z_s + z_r) *
                     std::polar(1.0, parameters.turns * phase);
  return {whirl.real(), gravity + whirl.imag()};
}

std::vector<double> equal_force_speeds(const Parameters& parameters, double highest)
{
  const double gravity = rigid_joint_force(parameters, 0, 0).y;
  const auto unbalance_prevails = [&](double omega) {
    const Vec2 force = rigid_joint_force(parameters, omega, 0);
    return std::hypot(force.x, force.y - gravity) > std::abs(gravity);
  };
  constexpr int steps = 4000;
  std::vector<double> speeds;
  for (int k = 0; k < steps; ++k) {
    double low = highest * k / steps, high = highest * (k + 1) / steps;
    const bool before = unbalance_prevails(low);
    if (gravity == 0 || unbalance_prevails(high) == before) continue;
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
  const auto sag = [&](const Body& body) {
    return parameters.gravity / (body.natural_frequency * body.natural_frequency);
  };
  const double speed = parameters.turns * omega;
  const auto whirl = parameters.unbalance * speed * speed /
                     dynamic_stiffness(parameters.rotor, speed).value *
                     std::polar(1.0, parameters.turns * phase);
  return {whirl.real(), sag(parameters.stator) - sag(parameters.rotor) + whirl.imag()};
}

Vec2 quasi_static_contact(const Parameters& parameters, Vec2 force)
{
  const double size = std::hypot(force.x, force.y);
  if (size == 0) return {0, 0};
  const double reach = parameters.bearing.clearance +
                       hertz_penetration(parameters.bearing.contact_stiffness, size);
  return {reach * force.x / size, reach * force.y / size};
}

State static_start(const Parameters& parameters)
{
  const Vec2 force = rigid_joint_force(parameters, 0, 0);
  const Vec2 u = quasi_static_contact(parameters, force);
  const double y_s = (force.y - parameters.stator.mass * parameters.gravity) /
                     parameters.stator.stiffness();
  return {.position = {.stator = {0, y_s}, .rotor = {u.x, y_s + u.y}}, .velocity = {}};
}

}  // namespace rotor_stator
