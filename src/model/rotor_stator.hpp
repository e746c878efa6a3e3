/**
# Rotor and stator (Eq. 7)

The equations of motion of both bodies, joined by the force F of the bearing:

$$\begin{aligned}
m_s \ddot{x}_s + c_s \dot{x}_s + k_s x_s &= F_x \\
m_s \ddot{y}_s + c_s \dot{y}_s + k_s y_s &= F_y - m_s g \\
m_r \ddot{x}_r + c_r \dot{x}_r + k_r x_r &= -F_x + m_e e\,\omega^2 \cos\omega t \\
m_r \ddot{y}_r + c_r \dot{y}_r + k_r y_r &= -F_y + m_e e\,\omega^2 \sin\omega t - m_r g
\end{aligned} \tag{7}$$

Each body is linear on its own suspension; the bearing's force F(u, t) is all that joins
them. */
#pragma once

#include <array>
#include <bit>
#include <complex>
#include <vector>

#include "model/ball_bearing.hpp"
#include "model/parameters.hpp"

namespace rotor_stator {

/** Displacements of both bodies [m], or their speeds [m/s]. */
template <class Number>
struct BodiesOf {
  Vec2Of<Number> stator, rotor;

  IN_PLACE Vec2Of<Number> relative() const
  {
    return {rotor.x - stator.x, rotor.y - stator.y};
  }
};
using Bodies = BodiesOf<double>;

/** x_s, y_s, x_r, y_r. */
using Displacements = std::array<double, 4>;
inline Displacements displacements(const Bodies& bodies)
{
  return std::bit_cast<Displacements>(bodies);
}

/** Displacements [m] and speeds [m/s]. */
struct State {
  Bodies position, velocity;
  /** The further displacements of a large machine, then their speeds. */
  Eigen::VectorXd inner = {};
};

/** The same as a vector, 8 of two masses: the displacements, then the speeds. */
using Vector8 = Eigen::Matrix<double, 8, 1>;
using Matrix8 = Eigen::Matrix<double, 8, 8>;
Eigen::VectorXd vector_of(const State& state);
State state_of(const Eigen::VectorXd& y);

/** Four numbers of such a vector. */
inline Bodies bodies_at(const double* y)
{
  return {{y[0], y[1]}, {y[2], y[3]}};
}
inline void put(const Bodies& bodies, double* y)
{
  const Displacements q = displacements(bodies);
  std::copy(q.begin(), q.end(), y);
}

/** Eq. 7 at one rotor speed without its bearing, of one motion or of several side by
    side: what does not change along a motion. */
template <class Number>
struct Equation7 {
  Number k_s, c_s, per_m_s, k_r, c_r, per_m_r;  ///< [N/m], [N s/m], [1/kg]
  Number unbalance;                             ///< m_e e ω² [N]
  BodiesOf<Number> rest;                        ///< static accelerations [m/s²]

  /** Accelerations [m/s²] for the bearing's force `f` [N] on the stator. */
  IN_PLACE BodiesOf<Number> acceleration(const BodiesOf<Number>& q,
                                         const BodiesOf<Number>& v,
                                         DirectionOf<Number> rotor,
                                         Vec2Of<Number> f) const
  {
    return {{(f.x - c_s * v.stator.x - k_s * q.stator.x) * per_m_s + rest.stator.x,
             (f.y - c_s * v.stator.y - k_s * q.stator.y) * per_m_s + rest.stator.y},
            {(unbalance * rotor.cos - f.x - c_r * v.rotor.x - k_r * q.rotor.x) * per_m_r +
                 rest.rotor.x,
             (unbalance * rotor.sin - f.y - c_r * v.rotor.y - k_r * q.rotor.y) * per_m_r +
                 rest.rotor.y}};
  }
};

/** An element between a body and the ground, a term of Eq. 7 that the paper has not. */
struct Ground {
  Parallel element;
  bool is_rotor;
  double per_mass;  ///< [1/kg]
};

/** Eq. 7 at one rotor speed with its bearing. */
class RotorStator {
public:
  /** `omega` is the base frequency [rad/s], the rotor's speed if it turns once in it. */
  RotorStator(const Parameters& parameters, double omega);

  /** Accelerations [m/s²]. */
  Bodies acceleration(const Bodies& q, const Bodies& v, const Angles& at) const
  {
    return acceleration(q, v, at.rotor, bearing_.force(at, q.relative(), v.relative()));
  }

  /** The same for a bearing force `f` [N] that is known already. */
  Bodies acceleration(const Bodies& q, const Bodies& v, Direction rotor, Vec2 f) const
  {
    Bodies a = equation_.acceleration(q, v, rotor, f);
    for (const Ground& one : grounds_) {
      const auto body = one.is_rotor ? &Bodies::rotor : &Bodies::stator;
      const Vec2 held = one.element.reaction(q.*body, v.*body).force;
      (a.*body).x -= one.per_mass * held.x;
      (a.*body).y -= one.per_mass * held.y;
    }
    return a;
  }

  double omega() const { return omega_; }
  double period() const;
  const BallBearing& bearing() const { return bearing_; }
  const Equation7<double>& equation() const { return equation_; }
  const std::vector<Ground>& grounds() const { return grounds_; }

private:
  BallBearing bearing_;
  double omega_;
  Equation7<double> equation_;
  std::vector<Ground> grounds_;
};

/** Dynamic stiffness Z(Ω) = K - mΩ² + i c Ω of a body alone [N/m], and dZ/dΩ. */
struct DynamicStiffness {
  std::complex<double> value, slope;
};
DynamicStiffness dynamic_stiffness(const Body& body, double frequency);

/** Sizes that make the equations dimensionless; of several bearings the largest. */
struct Scales {
  /** Weights and loads of both bodies plus the unbalance at the joint resonance [N]. */
  double load;
  double penetration;  ///< of one ball under that load [m]
  double length;       ///< clearance plus penetration: the size of u [m]
  double stiffness;    ///< of one ball under that load, and of what is beside it [N/m]
};
Scales scales(const Parameters& parameters);

/** The vibration [rad/s] of both bodies against one ball that is pressed by that load. */
double contact_frequency(const Parameters& parameters);

/** Sizes of the components of a state, for tolerances and norms. */
inline Eigen::VectorXd state_scales(const Parameters& parameters)
{
  return parameters.bodies->state_scales(parameters);
}

/** Resonance [rad/s] of rotor and stator moving as one body on both suspensions; beside a
    rigid stator that of the rotor, on the contact if it has no suspension. */
double joint_resonance(const Parameters& parameters);

/** The same, a size of speeds [rad/s]; where elements to the ground alone hold both
    bodies, the contact's frequency. */
double speed_scale(const Parameters& parameters);

/** The static part of `rigid_joint_force`, (k_s f_r - k_r f_s)/(k_s + k_r) [N]. */
Vec2 static_joint_force(const Parameters& parameters);

/** The steady force [N] of the bearing that would keep u = 0 at `phase` ωt [rad]:
    F = (Z_s f_r - Z_r f_s)/(Z_s + Z_r) for weights and loads and for the unbalance. */
Vec2 rigid_joint_force(const Parameters& parameters, double omega, double phase);

/** The speeds [rad/s] up to `highest` at which the static part of that force, from
    weights and loads, is as large as its rotating part, from the unbalance; ascending. At
    the first the force of the joint passes through zero: a contact that can only push is
    lost. None without them. */
std::vector<double> equal_force_speeds(const Parameters& parameters, double highest);

/** The relative displacement [m] of both bodies without any contact, u = G_r f_r - G_s
   f_s, at `phase` ωt [rad]; infinite where the undamped rotor resonates. */
Vec2 free_displacement(const Parameters& parameters, double omega, double phase);

/** The relative displacement [m] that the bearing needs to answer with `force`, all of it
   on one ball and the elements beside it: along the force, at most by the clearance plus
   the Hertz penetration. A start for iterations. */
Vec2 quasi_static_contact(const Bearing& bearing, Vec2 force);

/** Where time integration starts: at rest, the static load on one ball; where the bearing
    alone carries a body, on those that balance it with ball 1 at angle 0. */
inline State static_start(const Parameters& parameters)
{
  return parameters.bodies->static_start(parameters);
}

/**
## Sums and multiples of vectors and of pairs of bodies

What a time integrator does with slopes. */

template <class Number>
IN_PLACE Vec2Of<Number> operator+(Vec2Of<Number> a, Vec2Of<Number> b)
{
  return {a.x + b.x, a.y + b.y};
}
template <class Factor, class Number>
IN_PLACE Vec2Of<Number> operator*(Factor s, Vec2Of<Number> a)
{
  return {s * a.x, s * a.y};
}
template <class Number>
IN_PLACE BodiesOf<Number> operator+(const BodiesOf<Number>& a, const BodiesOf<Number>& b)
{
  return {a.stator + b.stator, a.rotor + b.rotor};
}
template <class Factor, class Number>
IN_PLACE BodiesOf<Number> operator*(Factor s, const BodiesOf<Number>& a)
{
  return {s * a.stator, s * a.rotor};
}

}  // namespace rotor_stator
