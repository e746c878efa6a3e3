#include "model/quasi_static_state.hpp"

#include <cmath>
#include <numbers>

namespace rotor_stator
{

State quasi_static_state(const Parameters& parameters, double omega)
{
  /** F = gravity + Re(whirl (1, -i) e^{iφ}); the stator answers with its receptance, the rotor stands
      off by u, which follows the force. */
  const Vec2 at_0 = rigid_joint_force(parameters, omega, 0);
  const Vec2 at_90 = rigid_joint_force(parameters, omega, std::numbers::pi / 2);
  const double gravity = at_90.y - at_0.x;
  const std::complex<double> whirl(at_0.x, at_0.y - gravity);
  const auto response = whirl / dynamic_stiffness(parameters.stator, omega).value;
  const double sag = (gravity - parameters.stator.mass * parameters.gravity) /
                     parameters.stator.stiffness();
  const auto stator = [&](double phase) -> Vec2 {
    const auto turned = response * std::polar(1.0, phase);
    return {turned.real(), sag + turned.imag()};
  };
  const auto relative = [&](double phase) {
    return quasi_static_contact(parameters, rigid_joint_force(parameters, omega, phase));
  };
  constexpr double little = 1e-4;
  const auto speed = [&](const auto& path) -> Vec2 {
    const Vec2 a = path(-little), b = path(little);
    return {omega * (b.x - a.x) / (2 * little), omega * (b.y - a.y) / (2 * little)};
  };
  const Vec2 s = stator(0), u = relative(0), v_s = speed(stator), v_u = speed(relative);
  return {.position = {.stator = s, .rotor = {s.x + u.x, s.y + u.y}},
          .velocity = {.stator = v_s, .rotor = {v_s.x + v_u.x, v_s.y + v_u.y}}};
}

}  // namespace rotor_stator
