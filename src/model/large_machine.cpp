#include "model/large_machine.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "io/table.hpp"

namespace rotor_stator {

using Complex = std::complex<double>;
using Triplets = std::vector<Eigen::Triplet<double, int>>;

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
      Bearing still = joint;
      still.damping = 0;
      const BallBearing bearing(still, rotor_speed);
      for (int k = 0; k < angles; ++k) {
        const double cage =
            joint.cage_phase + angular(1) * k / std::max(joint.balls, 1) / angles;
        const auto [f, s] = bearing.reaction(Direction::of(cage), {u[at], u[at + 1]});
        force.segment<2>(at) += Eigen::Vector2d(f.x, f.y) / angles;
        slope.block<2, 2>(at, at) += s.matrix() / angles;
      }
      at += 2;
    }
    force -= machine.spring * u;
    slope.diagonal().array() -= machine.spring;
    return u - c + h * force;
  };
  Eigen::VectorXd u = quasi_static_contacts(parameters, h.ldlt().solve(c));
  /** Where nothing is stiff the derivative is singular without a share of k_0. */
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
  if (const LargeBodies* own = parameters.bodies->matrices()) return *own;
  Body stator = parameters.stator;
  if (stator.rigid) stator.mass = 1;  // which nothing moves
  const double g = parameters.gravity;
  const Assembly all{
      .bodies = {single_mass(stator, "stator", 0, g),
                 single_mass(parameters.rotor, "rotor", parameters.unbalance, g)},
      .is_rigid = stator.rigid,
      .places = {{0, 1, 2, 3}}};
  return all.assembled(scales(parameters).stiffness);
}

Eigen::MatrixXd mean_contact_stiffness(const Parameters& parameters,
                                       const LargeBodies& machine, double rotor_speed)
{
  /** Few where each ball gets its load and loses it gradually, more where its stiffness
      jumps or few balls carry. */
  constexpr int fewest = 64, most = 4096;
  constexpr double error = 2e-4;
  const auto at = [&](int angles) {
    return at_rest(parameters, machine, angles, rotor_speed).stiffness;
  };
  Eigen::MatrixXd mean = at(fewest);
  for (int angles = 2 * fewest; angles <= most; angles *= 2) {
    const Eigen::MatrixXd finer = at(angles);
    if ((finer - mean).norm() <= error * finer.norm()) break;
    mean = finer;
  }
  return mean;
}

State MatrixMachine::at_rest(const Parameters& parameters, Direction) const
{
  return static_start(parameters);
}

State MatrixMachine::static_start(const Parameters& parameters) const
{
  const Eigen::VectorXd q = rotor_stator::at_rest(parameters, bodies_, 1).q;
  Eigen::VectorXd y = Eigen::VectorXd::Zero(2 * q.size());
  y.head(q.size()) = q;
  return state_of(y);
}

Eigen::VectorXd MatrixMachine::state_scales(const Parameters& parameters) const
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

double MatrixMachine::quickest_contact(const Parameters& parameters) const
{
  const Eigen::PartialPivLU<Eigen::MatrixXd> factors(bodies_.mass);
  double most = 0;
  for (const auto& at : bodies_.places)
    for (const int axis : {0, 1}) {
      Eigen::VectorXd apart = Eigen::VectorXd::Zero(bodies_.mass.rows());
      if (const int rotor = at[2 + axis]; rotor >= 0) apart[rotor] += 1;
      if (const int stator = at[axis]; stator >= 0 && !parameters.stator.rigid)
        apart[stator] -= 1;
      most = std::max(most, apart.dot(factors.solve(apart)));
    }
  const Scales sizes = scales(parameters);
  double stiffness = sizes.stiffness;
  for (const Bearing& ground : parameters.grounds)
    stiffness =
        std::max(stiffness, largest_stiffness(ground.parallel, sizes.load, sizes.length));
  return std::sqrt(stiffness * most);
}

void LargeMachine::describe(Table& table, const Parameters&) const
{
  table.detail(format("bodies: %ld degrees of freedom, %s; k_0 = %.6g N/m",
                      static_cast<long>(bodies_.mass.rows()),
                      bodies_.reductions.empty() ? "all kept" : "reduced",
                      bodies_.spring));
  for (const std::string& line : bodies_.reductions) table.detail(line);
}

void LargeMachine::put_keys(Table& table) const
{
  table.value("degrees_of_freedom", bodies_.mass.rows());
  table.value("reduction_error", bodies_.reduction_error);
}

LinearBody single_mass(const Body& body, const std::string& name, double unbalance,
                       double gravity)
{
  SparseMatrix one(2, 2);
  one.setIdentity();
  const Vec2 load = body.static_load(gravity);
  const double weight = body.rigid ? 0 : gravity * body.mass;
  return {.m = body.mass * one,
          .c = body.damping() * one,
          .g = SparseMatrix(2, 2),
          .k = body.stiffness() * one,
          .name = name,
          .load = Eigen::Vector2d(load.x, load.y),
          .size_of_loads = weight + Eigen::Vector2d(body.load.x, body.load.y).norm(),
          .unbalance = unbalance * Eigen::Vector2cd(1, Complex(0, -1)),
          .joint = {0, 1}};
}

SparseMatrix Assembly::joined(SparseMatrix LinearBody::*part) const
{
  Triplets entries;
  for (int body : {0, 1}) {
    const SparseMatrix& own = bodies[body].*part;
    for (int j = 0; j < own.outerSize(); ++j)
      for (SparseMatrix::InnerIterator it(own, j); it; ++it)
        entries.emplace_back(first(body) + static_cast<int>(it.row()), first(body) + j,
                             it.value());
  }
  SparseMatrix all(size(), size());
  all.setFromTriplets(entries.begin(), entries.end());
  return all;
}

SparseMatrix Assembly::joints() const
{
  Triplets entries;
  for (int b = 0; b < std::ssize(places); ++b)
    for (int axis : {0, 1}) {
      entries.emplace_back(places[b][2 + axis], 2 * b + axis, 1);
      if (!is_rigid && places[b][axis] >= 0)
        entries.emplace_back(places[b][axis], 2 * b + axis, -1);
    }
  SparseMatrix all(size(), 2 * static_cast<int>(places.size()));
  all.setFromTriplets(entries.begin(), entries.end());
  return all;
}

std::pair<std::vector<int>, int> Assembly::order() const
{
  std::vector<int> list;
  const auto add = [&](int dof) {
    if (dof >= 0 && std::ranges::find(list, dof) == list.end()) list.push_back(dof);
  };
  for (const auto& place : places)
    for (int dof : place) add(dof);
  for (int body : {0, 1})
    for (int dof : bodies[body].output) add(first(body) + dof);
  const int shown = static_cast<int>(list.size());
  std::vector<bool> taken(static_cast<std::size_t>(size()));
  for (int dof : list) taken[dof] = true;
  for (int dof = 0; dof < size(); ++dof)
    if (!taken[dof]) list.push_back(dof);
  return {list, shown};
}

void Assembly::require_held(double spring) const
{
  const SparseMatrix d = joints();
  const SparseMatrix held =
      joined(&LinearBody::k) + spring * SparseMatrix(d * d.transpose());
  const Eigen::SimplicialLDLT<SparseMatrix> factors(held);
  constexpr double rounding = 1e-13;
  for (int i = 0; i < size(); ++i) {
    const int dof = factors.permutationPinv().indices()[i];
    const int body = dof >= first(1);
    if (!(factors.vectorD()[i] > rounding * held.coeff(dof, dof)))
      throw BadInput(not_held(bodies[body].name, dof - first(body)));
  }
}

LargeBodies Assembly::assembled(double spring) const
{
  const auto [order, shown] = this->order();
  std::vector<int> place_of(order.size());
  for (int i = 0; i < size(); ++i) place_of[order[i]] = i;
  const auto dense = [&order = order](const SparseMatrix& a) -> Eigen::MatrixXd {
    return Eigen::MatrixXd(a)(order, order);
  };
  Eigen::VectorXd load(size());
  Eigen::VectorXcd unbalance(size());
  load << bodies[0].load, bodies[1].load;
  unbalance << bodies[0].unbalance, bodies[1].unbalance;
  LargeBodies machine{.mass = dense(joined(&LinearBody::m)),
                      .damping = dense(joined(&LinearBody::c)),
                      .gyroscopic = dense(joined(&LinearBody::g)),
                      .stiffness = dense(joined(&LinearBody::k)),
                      .joints = Eigen::MatrixXd(joints())(order, Eigen::all),
                      .load = load(order),
                      .unbalance = unbalance(order),
                      .spring = spring,
                      .shown = shown,
                      .places = places};
  for (auto& place : machine.places)
    for (int& dof : place)
      if (dof >= 0) dof = place_of[dof];
  constexpr const char* names[] = {"x_s", "y_s", "x_r", "y_r"};
  for (std::size_t b = 1; b < bearings; ++b)
    for (int k = 0; k < 4; ++k)
      machine.outputs.emplace_back(numbered(names[k], b), machine.places[b][k]);
  for (int body : {0, 1})
    for (std::size_t axis = 0; axis < bodies[body].output.size(); ++axis)
      machine.outputs.emplace_back(std::string(names[2 * body + axis]) + "_out",
                                   place_of[first(body) + bodies[body].output[axis]]);
  const SparseMatrix& at_nodes = bodies[1].at_nodes;
  Triplets entries;
  for (int j = 0; j < at_nodes.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(at_nodes, j); it; ++it)
      entries.emplace_back(it.row(), place_of[first(1) + j], it.value());
  machine.nodes.resize(at_nodes.rows(), size());
  machine.nodes.setFromTriplets(entries.begin(), entries.end());
  return machine;
}

}  // namespace rotor_stator
