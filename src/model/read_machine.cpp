#include "model/read_machine.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>

#include "io/errors.hpp"
#include "model/catalogue.hpp"
#include "model/hertz.hpp"
#include "model/large_machine.hpp"
#include "model/parallel.hpp"

namespace rotor_stator {

namespace {

using Complex = std::complex<double>;
using Triplets = std::vector<Eigen::Triplet<double, int>>;

/** Degrees of freedom of a body that may all be asked for. */
constexpr int most_asked = 2100;

/** Bearings, and elements to the ground. */
constexpr std::size_t most_joints = 4;

/** A matrix, `sign` times its transpose; if not `required`, its file may be missing. */
SparseMatrix read_one(const std::filesystem::path& file, double sign, bool required,
                      int size)
{
  std::error_code error;
  const auto found = std::filesystem::symlink_status(file, error).type();
  if (!required && found == std::filesystem::file_type::not_found)
    return SparseMatrix(size, size);
  const SparseMatrix matrix = read_matrix(file);
  if (size > 0 && matrix.rows() != size)
    throw BadInput(format("%s: has %ld rows, and M.mtx %d", file.c_str(),
                          static_cast<long>(matrix.rows()), size));
  const SparseMatrix image = sign * SparseMatrix(matrix.transpose());
  /** Of what the two degrees of freedom have: a stiff support elsewhere hides nothing. */
  constexpr double rounding = 1e-8;
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(matrix.rows());
  const auto each = [](const SparseMatrix& a, const auto& act) {
    for (int k = 0; k < a.outerSize(); ++k)
      for (SparseMatrix::InnerIterator at(a, k); at; ++at)
        act(at.row(), at.col(), std::abs(at.value()));
  };
  each(matrix, [&](auto i, auto j, double value) {
    for (const auto one : {i, j}) largest[one] = std::max(largest[one], value);
  });
  each(matrix - image, [&](auto i, auto j, double value) {
    if (value > rounding * std::sqrt(largest[i] * largest[j]))
      throw BadInput(
          format("%s: is not %s in row %ld, column %ld", file.c_str(),
                 sign > 0 ? "symmetric" : "antisymmetric, as gyroscopic moments are",
                 static_cast<long>(i + 1), static_cast<long>(j + 1)));
  });
  return 0.5 * (matrix + image);
}

/** Numbers of degrees of freedom, from 0. */
std::vector<int> read_dofs(StrictToml& table, const std::string& key, int size,
                           bool is_pair)
{
  constexpr const char* pair = "[x, y], two degrees of freedom";
  std::vector<int> dofs = table.integers(key, 1, size, is_pair ? pair : "an array");
  if (is_pair && dofs[0] == dofs[1]) table.fail(key, std::string("must be ") + pair);
  for (int& dof : dofs) --dof;
  return dofs;
}

/** The nodes that are asked for. */
void read_nodes(const NumberTable& table, LinearBody& body)
{
  Triplets ones;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    for (const char* axis : {"x", "y"}) {
      const double dof = table.at(row, axis);
      if (!(dof >= 1 && dof <= body.size() && dof == std::floor(dof)))
        table.fail(row, format("%s must be a degree of freedom of the rotor, 1...%d",
                               axis, body.size()));
      body.nodes.push_back(static_cast<int>(dof) - 1);
      ones.emplace_back(static_cast<int>(ones.size()), body.nodes.back(), 1);
    }
    if (table.at(row, "x") == table.at(row, "y"))
      table.fail(row, "x and y must be two degrees of freedom");
  }
  body.at_nodes.resize(std::ssize(body.nodes), body.size());
  body.at_nodes.setFromTriplets(ones.begin(), ones.end());
}

LinearBody read_matrices(StrictToml& table, const std::string& name, double gravity)
{
  const auto folder =
      std::filesystem::path(table.file()).parent_path() / table.string("matrices");
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error))
    table.fail("matrices", "names no folder: " + folder.string());
  LinearBody body{.m = read_one(folder / "M.mtx", 1, true, 0), .name = name};
  const int n = body.size();
  const std::string mass_file = (folder / "M.mtx").string();
  for (int i = 0; i < n; ++i)
    if (!(body.m.coeff(i, i) > 0))
      throw BadInput(
          format("%s: degree of freedom %d has no mass", mass_file.c_str(), i + 1));
  if (Eigen::SimplicialLLT<SparseMatrix>(body.m).info() != Eigen::Success)
    throw BadInput(mass_file + ": is not positive definite");
  body.k = read_one(folder / "K.mtx", 1, true, n);
  body.c = read_one(folder / "C.mtx", 1, false, n);
  body.g = read_one(folder / "G.mtx", -1, false, n);
  body.keeps_all = table.has("all_dofs") && table.flag("all_dofs");
  if (body.keeps_all && n > most_asked)
    table.fail("all_dofs", format("is for at most %d degrees of freedom", most_asked));
  body.unbalance = Eigen::VectorXcd::Zero(n);
  if (table.has("bearing_dofs")) body.joint = read_dofs(table, "bearing_dofs", n, true);
  if (table.has("output_dofs")) body.output = read_dofs(table, "output_dofs", n, true);
  if (gravity > 0 && !table.has("vertical_dofs"))
    table.missing("vertical_dofs", ": where the weight acts; [] for a body without it");
  Eigen::VectorXd upright = Eigen::VectorXd::Zero(n);
  if (table.has("vertical_dofs"))
    for (int dof : read_dofs(table, "vertical_dofs", n, false)) upright[dof] = 1;
  body.load = Eigen::VectorXd::Zero(n) - gravity * (body.m * upright);
  body.size_of_loads = gravity * upright.dot(body.m * upright);
  if (table.has("unbalance"))
    for (StrictToml& one : table.tables("unbalance")) {
      const std::vector<int> dofs = read_dofs(one, "dofs", n, true);
      const Complex moment = std::polar(one.number("moment_kg_m", Range::not_negative),
                                        one.number_or("phase_rad", Range::any, 0));
      body.unbalance[dofs[0]] += moment;
      body.unbalance[dofs[1]] += Complex(0, -1) * moment;
    }
  return body;
}

/** A single mass that vibrates about as body 0 or 1 does: in the shape that one force on
    all bearings gives it. */
Body equivalent(const Assembly& all, int number, double spring)
{
  const LinearBody& body = all.bodies[number];
  Eigen::VectorXd force = Eigen::VectorXd::Zero(body.size());
  SparseMatrix held = body.k;
  for (std::size_t joint = 0; joint < all.places.size(); ++joint)
    for (int axis = 0; axis < 4; ++axis) {
      const int dof = all.places[joint][axis] - all.first(number);
      if (dof < 0 || dof >= body.size()) continue;
      held.coeffRef(dof, dof) += spring;
      if (axis % 2 == 1 && joint < all.bearings) force[dof] = 1;
    }
  const Eigen::VectorXd shape = Eigen::SimplicialLDLT<SparseMatrix>(held).solve(force);
  const double count = force.sum(), sag = force.dot(shape) / count;
  const double stiffness = shape.dot(body.k * shape) / (sag * sag);
  const double mass = shape.dot(body.m * shape) / (sag * sag);
  const bool is_held = stiffness > 1e-6 * count * spring;
  return {.mass = mass,
          .natural_frequency = is_held ? std::sqrt(stiffness / mass) : 0,
          .damping_ratio = 0,
          .damper = shape.dot(body.c * shape) / (sag * sag)};
}

/** Of [bearing] between the bearing_dofs of both bodies, or of one [[bearing]]. */
std::array<int, 4> read_place(StrictToml* table, const Assembly& all)
{
  std::array<int, 4> place{};
  for (int body : {0, 1}) {
    const LinearBody& one = all.bodies[body];
    const std::string key = body == 0 ? "stator_dofs" : "rotor_dofs";
    const bool is_given = table && table->has(key);
    if (!is_given && one.joint.empty()) {
      if (table) table->missing(key);
      throw BadInput(one.name + ".bearing_dofs is missing: [x, y], from 1");
    }
    const std::vector<int> dofs =
        is_given ? read_dofs(*table, key, one.size(), true) : one.joint;
    for (int axis : {0, 1}) place[2 * body + axis] = all.first(body) + dofs[axis];
  }
  return place;
}

void read_bearings(StrictToml& root, Parameters& parameters, Assembly& all)
{
  if (!root.has_tables("bearing")) {
    parameters.bearing = read_bearing(root.table("bearing"), parameters.derived);
    all.places = {read_place(nullptr, all)};
    return;
  }
  std::vector<Bearing> list;
  for (StrictToml& table : root.tables("bearing")) {
    std::vector<std::string> derived;
    list.push_back(read_bearing(table, derived));
    for (const std::string& line : derived)
      parameters.derived.push_back(format("bearing %zu: ", list.size()) + line);
    list.back().cage_phase = table.number_or("cage_phase_rad", Range::any, 0);
    all.places.push_back(read_place(&table, all));
    for (std::size_t k = 0; k + 1 < list.size(); ++k)
      if (all.places[k] == all.places.back())
        table.fail("rotor_dofs", "and stator_dofs are those of another bearing too");
  }
  if (list.empty() || list.size() > most_joints)
    root.fail("bearing", format("must be 1...%zu tables [[bearing]]", most_joints));
  parameters.bearing = list[0];
  parameters.further.assign(list.begin() + 1, list.end());
  all.bearings = list.size();
}

/** What stands between a body and the ground: one table, or several. */
void read_grounds(StrictToml& table, int number, Parameters& parameters, Assembly& all)
{
  if (!table.has(ground_key)) return;
  const LinearBody& body = all.bodies[number];
  const int first = all.first(number);
  std::vector<StrictToml> list;
  if (table.has_tables(ground_key))
    list = table.tables(ground_key);
  else
    list.push_back(table.table(ground_key));
  for (StrictToml& one : list) {
    const bool is_mass = !table.has("matrices");
    if (is_mass && std::ranges::count(one.keys(), "dofs") > 0)
      one.fail("dofs", "is of bodies given by matrices");
    const std::vector<int> dofs =
        is_mass ? body.joint : read_dofs(one, "dofs", body.size(), true);
    all.places.push_back({-1, -1, first + dofs[0], first + dofs[1]});
    Bearing joint{};
    joint.parallel = read_parallel(one);
    joint.place = body.name + "." + ground_key;
    if (!is_mass) joint.place += format(" at dofs %d, %d", dofs[0] + 1, dofs[1] + 1);
    parameters.grounds.push_back(joint);
  }
  if (all.places.size() > most_joints)
    table.fail(ground_key, format("makes %zu joints with the bearings: at most %zu",
                                  all.places.size(), most_joints));
}

/** Keeps the coordinates of a body that bearings, loads and outputs need. */
Reduction reduce_body(Assembly& all, int body, const ReductionRange& range)
{
  LinearBody& own = all.bodies[body];
  std::vector<int> kept;
  const auto place_of = [&](int dof) {
    const auto at = std::ranges::find(kept, dof) - kept.begin();
    if (at == std::ssize(kept)) kept.push_back(dof);
    return static_cast<int>(at);
  };
  const int begin = all.first(body), end = begin + own.size();
  for (auto& place : all.places)
    for (int& dof : place)
      if (dof >= begin && dof < end) dof = begin + place_of(dof - begin);
  const std::size_t joints = kept.size();
  for (int& dof : own.output) dof = place_of(dof);
  const Reduction done = reduce(own, kept, joints, range);
  for (auto& place : all.places)
    for (int& dof : place)
      if (dof >= end) dof += begin + own.size() - end;
  return done;
}

/** Both bodies and the bearings. */
void read_bodies(StrictToml& root, Parameters& parameters, const ModelRange& asked)
{
  StrictToml tables[] = {root.table("stator"), root.table("rotor")};
  const bool has_matrices[] = {tables[0].has("matrices"), tables[1].has("matrices")};
  const double gravity = parameters.gravity;
  Assembly all{.bodies = {}, .is_rigid = parameters.stator.rigid};
  for (int body : {0, 1}) {
    const char* const name = body == 0 ? "stator" : "rotor";
    all.bodies.push_back(
        has_matrices[body]
            ? read_matrices(tables[body], name, gravity)
            : single_mass(body == 0 ? parameters.stator : parameters.rotor, name,
                          body == 0 ? 0 : parameters.unbalance, gravity));
  }
  for (const LinearBody& body : all.bodies)
    for (const SparseMatrix* one : {&body.m, &body.c, &body.g, &body.k}) {
      const auto count = static_cast<std::size_t>(one->nonZeros()),
                 columns = static_cast<std::size_t>(one->outerSize());
      parameters.identity.add(std::as_bytes(std::span(one->valuePtr(), count)));
      parameters.identity.add(std::as_bytes(std::span(one->innerIndexPtr(), count)));
      parameters.identity.add(std::as_bytes(std::span(one->outerIndexPtr(), columns)));
    }
  if (all.is_rigid && tables[0].has(ground_key))
    tables[0].fail(ground_key, "is for a body that moves, and this one is rigid");
  read_bearings(root, parameters, all);
  for (int body : {0, 1}) read_grounds(tables[body], body, parameters, all);
  std::vector<std::pair<int, int>> bearing_nodes;
  if (asked.nodes && has_matrices[1]) {
    LinearBody& rotor = all.bodies[1];
    read_nodes(*asked.nodes, rotor);
    for (int b = 0; b < static_cast<int>(all.bearings); ++b)
      for (int i = 0; i < std::ssize(rotor.nodes); i += 2)
        if (all.first(1) + rotor.nodes[i] == all.places[b][2] &&
            all.first(1) + rotor.nodes[i + 1] == all.places[b][3])
          bearing_nodes.emplace_back(b, i / 2);
  }
  /** The spring is that of a ball that carries all weights and loads, the stiffest. */
  const double loads = all.bodies[0].size_of_loads + all.bodies[1].size_of_loads;
  double spring = 0, passages = 0;
  for (const Bearing& bearing : bearings_of(parameters)) {
    passages = std::max(passages, passages_per_turn(bearing));
    const double k_h = bearing.contact_stiffness, n = bearing.exponent;
    const double load = std::max(loads, hertz_force(k_h, 1e-6, n));
    spring = std::max(spring, hertz_stiffness(k_h, hertz_penetration(k_h, load, n), n));
  }
  parameters.unbalance = (all.bodies[0].unbalance.cwiseAbs().sum() +
                          all.bodies[1].unbalance.cwiseAbs().sum()) /
                         2;
  const double from = angular(0.9 * asked.from), to = angular(1.1 * asked.to);
  const ReductionRange range{from, to,
                             to * std::max(16 * passages, 1.0 * asked.harmonics), spring};
  std::vector<Reduction> reductions;
  for (int body : {0, 1})
    if (!all.bodies[body].keeps_all && all.bodies[body].size() > asked.largest)
      reductions.push_back(reduce_body(all, body, range));

  if (has_matrices[1]) parameters.rotor = equivalent(all, 1, spring);
  if (has_matrices[0]) parameters.stator = equivalent(all, 0, spring);
  if (all.is_rigid) {
    /** Coordinates that no force reaches, damped within the contact's vibration. */
    const double omega = std::sqrt(spring / parameters.rotor.mass);
    all.bodies[0] = single_mass(
        {.mass = 1, .natural_frequency = omega, .damping_ratio = 0.7}, "stator", 0, 0);
  }
  Assembly holding = all;
  holding.places.resize(all.bearings);
  for (std::size_t k = 0; k < parameters.grounds.size(); ++k)
    if (parameters.grounds[k].parallel.holds())
      holding.places.push_back(all.places[all.bearings + k]);
  holding.require_held(spring);
  LargeBodies machine = all.assembled(spring);
  machine.size_of_loads = loads;
  for (const auto& [note, error, highest] : reductions) {
    machine.reductions.push_back(note);
    machine.reduction_error = std::max(machine.reduction_error, error);
    machine.reduced_to = std::min(machine.reduced_to, highest);
  }
  machine.bearing_nodes = std::move(bearing_nodes);
  if (asked.from < asked.to) {
    machine.slowest = from;
    machine.fastest = to;
    machine.fits = std::make_shared<RationalFits>();
  }
  if (has_matrices[0] || has_matrices[1])
    parameters.bodies = std::make_shared<const LargeMachine>(std::move(machine));
  else
    parameters.bodies = std::make_shared<const MatrixMachine>(std::move(machine));
}

}  // namespace

Parameters read_machine(StrictToml root, const ModelRange& asked)
{
  if (root.has_tables("segment"))
    root.fail("segment",
              "is of a shaft: explore shaft makes its matrices, a folder that "
              "a machine names as rotor.matrices");
  const Parameters parameters =
      read_parameters(std::move(root), [&](StrictToml& table, Parameters& machine) {
        read_bodies(table, machine, asked);
      });
  for (const Bearing& joint : parameters.grounds)
    if (!joint.parallel.any())
      throw BadInput(parameters.file + ": " + joint.place +
                     " has nothing that holds or damps the body");
  return parameters;
}

}  // namespace rotor_stator
