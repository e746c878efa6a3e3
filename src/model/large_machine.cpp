#include "model/large_machine.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "io/table.hpp"
#include "model/assembly.hpp"

namespace rotor_stator {

using Complex = std::complex<double>;

Eigen::MatrixXcd LargeBodies::dynamic_stiffness(std::complex<double> k, double frequency,
                                                double speed) const
{
  const Complex i(0, 1);
  Eigen::MatrixXcd z = i * frequency * (damping + speed * gyroscopic);
  z += stiffness - frequency * frequency * mass;
  return z + k * (joints * joints.transpose());
}

JointForces rigid_joint_forces(const LargeBodies& machine, double speed)
{
  const Eigen::MatrixXd& d = machine.joints;
  const Eigen::LDLT<Eigen::MatrixXd> held(machine.held_stiffness());
  const Eigen::PartialPivLU<Eigen::MatrixXcd> z(
      machine.dynamic_stiffness(machine.spring, speed, speed));
  const Eigen::MatrixXd at_rest = d.transpose() * held.solve(d);
  const Eigen::MatrixXcd turning = d.transpose() * z.solve(d.cast<Complex>());
  const Eigen::VectorXd rest = held.solve(machine.load);
  const Eigen::VectorXcd whirl = z.solve(speed * speed * machine.unbalance);
  return {at_rest.ldlt().solve(d.transpose() * rest),
          turning.partialPivLu().solve(d.transpose() * whirl)};
}

Eigen::VectorXd quasi_static_contacts(const Parameters& parameters,
                                      const Eigen::VectorXd& forces)
{
  Eigen::VectorXd u = Eigen::VectorXd::Zero(forces.size());
  for (Eigen::Index k = 0; const Bearing& bearing : bearings_of(parameters)) {
    const Vec2 answer = quasi_static_contact(bearing, {forces[k], forces[k + 1]});
    u.segment<2>(k) << answer.x, answer.y;
    k += 2;
  }
  return u;
}

namespace {

/** At rest, the joints holding the constant loads: all displacements, and the stiffness
    of the joints, 2b × 2b. Forces are means over so many angles of the cage between two
    balls, from the cage's phase on. */
struct AtRest {
  Eigen::VectorXd q;
  Eigen::MatrixXd stiffness;
};

AtRest at_rest(const Parameters& parameters, const LargeBodies& machine, int angles,
               double rotor_speed = 0)
{
  const Eigen::MatrixXd& d = machine.joints;
  const Eigen::SimplicialLDLT<SparseMatrix> held(machine.held_stiffness().sparseView());
  const Eigen::VectorXd alone = held.solve(machine.load);
  const Eigen::MatrixXd h = d.transpose() * held.solve(d);
  const Eigen::VectorXd c = d.transpose() * alone;
  const std::vector<Bearing> joints = joints_of(parameters);

  /** u - c + H (F - k_0 u) and its derivative. */
  Eigen::VectorXd force(c.size());
  Eigen::MatrixXd slope(c.size(), c.size());
  const auto open = [&](const Eigen::VectorXd& u) -> Eigen::VectorXd {
    slope.setZero();
    force.setZero();
    for (Eigen::Index at = 0; const Bearing& joint : joints) {
      for (int k = 0; k < angles; ++k) {
        const double cage =
            joint.cage_phase + angular(1) * k / std::max(joint.balls, 1) / angles;
        const auto [f, s] = BallBearing(joint, rotor_speed)
                                .reaction(Direction::of(cage), {u[at], u[at + 1]});
        Eigen::Matrix2d one;
        one << s.xx, s.xy, s.yx, s.yy;
        force.segment<2>(at) += Eigen::Vector2d(f.x, f.y) / angles;
        slope.block<2, 2>(at, at) += one / angles;
      }
      at += 2;
    }
    force -= machine.spring * u;
    slope.diagonal().array() -= machine.spring;
    return u - c + h * force;
  };
  Eigen::VectorXd u = quasi_static_contacts(parameters, h.ldlt().solve(c));
  /** Where nothing is stiff at first, the derivative is singular: then with a share of
      k_0 more. */
  bool moves = true;
  for (int step = 0; step < 100 && moves; ++step) {
    const Eigen::VectorXd rest = open(u);
    if (!(rest.norm() > 1e-15 * c.norm())) break;
    const Eigen::MatrixXd tangent =
        Eigen::MatrixXd::Identity(u.size(), u.size()) + h * slope;
    moves = false;
    for (const double more : {0.0, 1e-6, 1e-3, 1.0}) {
      const Eigen::VectorXd change =
          (tangent + more * machine.spring * h).partialPivLu().solve(rest);
      double length = 1;
      while (length > 1e-6 && !(open(u - length * change).norm() < rest.norm()))
        length /= 2;
      moves = length > 1e-6;
      if (!moves) continue;
      u -= length * change;
      break;
    }
  }
  open(u);
  slope.diagonal().array() += machine.spring;
  return {alone - held.solve(d * force), slope};
}

}  // namespace

LargeBodies matrices_of(const Parameters& parameters)
{
  if (const auto* large = dynamic_cast<const LargeMachine*>(parameters.bodies.get()))
    return large->bodies();
  Body stator = parameters.stator;
  if (stator.rigid) stator.mass = 1;  // which nothing moves
  Assembly all{.bodies = {single_mass(stator, "stator", 0),
                          single_mass(parameters.rotor, "rotor", parameters.unbalance)},
               .is_rigid = stator.rigid,
               .places = {{0, 1, 2, 3}}};
  return assembled(all, parameters.gravity, scales(parameters).stiffness);
}

Eigen::MatrixXd mean_contact_stiffness(const Parameters& parameters,
                                       const LargeBodies& machine, double rotor_speed)
{
  return at_rest(parameters, machine, 64, rotor_speed).stiffness;
}

State LargeMachine::at_rest(const Parameters& parameters, Direction) const
{
  return static_start(parameters);
}

State LargeMachine::static_start(const Parameters& parameters) const
{
  const Eigen::VectorXd q = rotor_stator::at_rest(parameters, bodies_, 1).q;
  Eigen::VectorXd y = Eigen::VectorXd::Zero(2 * q.size());
  y.head(q.size()) = q;
  return state_of(y);
}

Eigen::VectorXd LargeMachine::state_scales(const Parameters& parameters) const
{
  const auto n = bodies_.mass.rows();
  const Eigen::VectorXd masses = bodies_.mass.diagonal();
  const double length = scales(parameters).length,
               shown = masses.head(bodies_.shown).mean();
  Eigen::VectorXd sizes(2 * n);
  for (Eigen::Index i = 0; i < n; ++i)
    sizes[i] = length * (i < bodies_.shown ? 1 : std::sqrt(shown / masses[i]));
  sizes.tail(n) = contact_frequency(parameters) * sizes.head(n);
  return sizes;
}

void LargeMachine::describe(Table& table, const Parameters&) const
{
  table.detail(format("bodies: %ld degrees of freedom, %s; k_0 = %.6g N/m",
                      static_cast<long>(bodies_.mass.rows()),
                      bodies_.reductions.empty() ? "all kept" : "reduced",
                      bodies_.spring));
  for (const std::string& line : bodies_.reductions) table.detail(line);
}

void GroundedMasses::describe(Table& table, const Parameters& parameters) const
{
  two_masses()->describe(table, parameters);
}

void LargeMachine::put_keys(Table& table) const
{
  table.value("degrees_of_freedom", bodies_.mass.rows());
  table.value("reduction_error", bodies_.reduction_error);
}

}  // namespace rotor_stator
