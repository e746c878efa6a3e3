#include "model/assembly.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "io/errors.hpp"

namespace rotor_stator {

namespace {

using Complex = std::complex<double>;
using Triplets = std::vector<Eigen::Triplet<double, int>>;

/** The columns that go beyond those of two masses. */
std::vector<std::pair<std::string, int>> outputs_of(const Assembly& all,
                                                    const std::vector<int>& place_of)
{
  std::vector<std::pair<std::string, int>> list;
  constexpr const char* names[] = {"x_s", "y_s", "x_r", "y_r"};
  for (std::size_t b = 1; b < all.bearings; ++b)
    for (int k = 0; k < 4; ++k)
      list.emplace_back(format("%s_%zu", names[k], b + 1), place_of[all.places[b][k]]);
  for (int body : {0, 1})
    for (std::size_t axis = 0; axis < all.bodies[body].output.size(); ++axis)
      list.emplace_back(std::string(names[2 * body + static_cast<int>(axis)]) + "_out",
                        place_of[all.first(body) + all.bodies[body].output[axis]]);
  return list;
}

}  // namespace

LinearBody single_mass(const Body& body, const std::string& name, double unbalance)
{
  SparseMatrix one(2, 2);
  one.setIdentity();
  return {
      {body.mass * one, body.damping() * one, SparseMatrix(2, 2), body.stiffness() * one},
      name,
      {1},
      Eigen::Vector2d(body.load.x, body.load.y),
      unbalance * Eigen::Vector2cd(1, Complex(0, -1)),
      {0, 1}};
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
    const bool is_rotor = dof >= first(1);
    if (factors.vectorD()[i] > rounding * held.coeff(dof, dof)) continue;
    throw BadInput(format(
        "%s: K is singular, and no bearing holds what it leaves free: found at degree "
        "of freedom %d (torsion and axial motion must be held too)",
        bodies[is_rotor].name.c_str(), dof - (is_rotor ? first(1) : 0) + 1));
  }
}

LargeBodies assembled(const Assembly& all, double gravity, double spring)
{
  const auto [order, shown] = all.order();
  const int n = all.size();
  std::vector<int> place_of(order.size());
  for (int i = 0; i < n; ++i) place_of[order[i]] = i;
  const auto dense = [&order = order](const SparseMatrix& a) -> Eigen::MatrixXd {
    return Eigen::MatrixXd(a)(order, order);
  };
  const SparseMatrix mass = all.joined(&LinearBody::m);
  Eigen::VectorXd load(n), upright(n);
  Eigen::VectorXcd unbalance(n);
  load << all.bodies[0].load, all.bodies[1].load;
  unbalance << all.bodies[0].unbalance, all.bodies[1].unbalance;
  upright << all.bodies[0].upright(), all.bodies[1].upright();
  load -= gravity * (mass * upright);
  LargeBodies machine{.mass = dense(mass),
                      .damping = dense(all.joined(&LinearBody::c)),
                      .gyroscopic = dense(all.joined(&LinearBody::g)),
                      .stiffness = dense(all.joined(&LinearBody::k)),
                      .joints = Eigen::MatrixXd(all.joints())(order, Eigen::all),
                      .load = load(order),
                      .unbalance = unbalance(order),
                      .spring = spring,
                      .shown = shown,
                      .places = all.places,
                      .outputs = outputs_of(all, place_of)};
  for (auto& place : machine.places)
    for (int& dof : place)
      if (dof >= 0) dof = place_of[dof];
  const SparseMatrix& at_nodes = all.bodies[1].at_nodes;
  Triplets entries;
  for (int j = 0; j < at_nodes.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(at_nodes, j); it; ++it)
      entries.emplace_back(it.row(), place_of[all.first(1) + j], it.value());
  machine.nodes.resize(at_nodes.rows(), n);
  machine.nodes.setFromTriplets(entries.begin(), entries.end());
  return machine;
}

}  // namespace rotor_stator
