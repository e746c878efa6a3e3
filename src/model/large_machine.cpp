#include "model/large_machine.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "io/errors.hpp"
#include "io/matrix_market.hpp"
#include "io/table.hpp"
#include "model/catalogue.hpp"
#include "model/hertz.hpp"
#include "model/reduction.hpp"

namespace rotor_stator {

namespace {

using Complex = std::complex<double>;
using Triplets = std::vector<Eigen::Triplet<double, int>>;

/** Degrees of freedom of a body that may all be asked for. */
constexpr int most_asked = 2100;

/** A body that moves in its own degrees of freedom, counted from 0. */
struct LinearBody : BodyMatrices {
  std::string name;
  std::vector<int> vertical = {};
  Eigen::VectorXd load = {};                 ///< beside the weight [N]
  Eigen::VectorXcd unbalance = {};           ///< [kg m]
  std::vector<int> joint = {}, output = {};  ///< x and y
  std::vector<int> nodes = {};               ///< x and y of each node that is asked for
  SparseMatrix at_nodes = {};  ///< their displacements over the body's coordinates
  bool keeps_all = false;

  int size() const { return static_cast<int>(m.rows()); }

  /** Ones where the weight acts. */
  Eigen::VectorXd upright() const
  {
    Eigen::VectorXd ones = Eigen::VectorXd::Zero(size());
    for (int dof : vertical) ones[dof] = 1;
    return ones;
  }
};

/** The name of a matrix, the sign of its transpose, and whether its file may be
    missing. */
struct Named {
  const char* name;
  double sign;
  bool required;
};

SparseMatrix read_one(const std::filesystem::path& folder, const Named& named, int size)
{
  const std::string file = (folder / (std::string(named.name) + ".mtx")).string();
  std::error_code error;
  const auto found = std::filesystem::status(file, error).type();
  if (!named.required && found == std::filesystem::file_type::not_found)
    return SparseMatrix(size, size);
  const SparseMatrix matrix = read_matrix(file);
  if (size > 0 && matrix.rows() != size)
    throw BadInput(format("%s: has %ld rows, and M.mtx %d", file.c_str(),
                          static_cast<long>(matrix.rows()), size));
  const SparseMatrix image = named.sign * SparseMatrix(matrix.transpose());
  constexpr double rounding = 1e-8;
  if (SparseMatrix(matrix - image).norm() > rounding * matrix.norm())
    throw BadInput(format(
        "%s: is not %s", file.c_str(),
        named.sign > 0 ? "symmetric" : "antisymmetric, as gyroscopic moments are"));
  return 0.5 * (matrix + image);
}

/** Every degree of freedom needs mass, and no motion may have none. */
void require_mass(const SparseMatrix& m, const std::string& file)
{
  for (int i = 0; i < m.rows(); ++i)
    if (!(m.coeff(i, i) > 0))
      throw BadInput(format("%s: degree of freedom %d has no mass", file.c_str(), i + 1));
  if (Eigen::SimplicialLLT<SparseMatrix>(m).info() != Eigen::Success)
    throw BadInput(file + ": is not positive definite");
}

/** Numbers of degrees of freedom, from 0. */
std::vector<int> read_dofs(StrictToml& table, const std::string& key, int size,
                           bool is_pair)
{
  std::vector<int> dofs = table.integers(key, 1, size, !is_pair);
  if (is_pair && (dofs.size() != 2 || dofs[0] == dofs[1]))
    table.fail(key, "must be [x, y], two degrees of freedom");
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

LinearBody read_matrices(StrictToml& table, const std::string& name, bool has_weight)
{
  const auto folder =
      std::filesystem::path(table.file()).parent_path() / table.string("matrices");
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error))
    table.fail("matrices", "names no folder: " + folder.string());
  LinearBody body{{read_one(folder, {"M", 1, true}, 0), {}, {}, {}}, name};
  const int n = body.size();
  require_mass(body.m, (folder / "M.mtx").string());
  body.k = read_one(folder, {"K", 1, true}, n);
  body.c = read_one(folder, {"C", 1, false}, n);
  body.g = read_one(folder, {"G", -1, false}, n);
  body.keeps_all = table.has("all_dofs") && table.flag("all_dofs");
  if (body.keeps_all && n > most_asked)
    table.fail("all_dofs", format("is for at most %d degrees of freedom", most_asked));
  body.load = Eigen::VectorXd::Zero(n);
  body.unbalance = Eigen::VectorXcd::Zero(n);
  if (table.has("bearing_dofs")) body.joint = read_dofs(table, "bearing_dofs", n, true);
  if (table.has("output_dofs")) body.output = read_dofs(table, "output_dofs", n, true);
  if (has_weight && !table.has("vertical_dofs"))
    table.missing("vertical_dofs", ": where the weight acts; [] for a body without it");
  if (table.has("vertical_dofs"))
    body.vertical = read_dofs(table, "vertical_dofs", n, false);
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

/** A single mass, the same in x and y. */
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

/** A single mass that vibrates about as the body does: in the shape that one force on all
    bearings gives it. */
Body equivalent(const LinearBody& body, const std::vector<std::array<int, 2>>& joints,
                double spring)
{
  Eigen::VectorXd force = Eigen::VectorXd::Zero(body.size());
  SparseMatrix held = body.k;
  for (const auto& joint : joints)
    for (int dof : joint) {
      held.coeffRef(dof, dof) += spring;
      if (dof == joint[1]) force[dof] = 1;
    }
  const Eigen::VectorXd shape = Eigen::SimplicialLDLT<SparseMatrix>(held).solve(force);
  const double count = force.sum(), sag = force.dot(shape) / count;
  const double stiffness = count / sag - count * spring;
  const double mass = shape.dot(body.m * shape) / (sag * sag);
  const bool is_held = stiffness > 1e-6 * count * spring;
  Body one{.mass = mass,
           .natural_frequency = is_held ? std::sqrt(stiffness / mass) : 0,
           .damping_ratio = 0};
  one.damper = shape.dot(body.c * shape) / (sag * sag);
  return one;
}

/** The whole machine, its coordinates in the order of the files. */
struct Assembly {
  std::vector<LinearBody> bodies;  ///< stator and rotor
  bool is_rigid;                   ///< the stator
  std::vector<std::array<int, 4>> places = {};

  int first(int body) const { return body == 0 ? 0 : bodies[0].size(); }
  int size() const { return bodies[0].size() + bodies[1].size(); }

  SparseMatrix joined(SparseMatrix LinearBody::*part) const
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

  SparseMatrix joints() const
  {
    Triplets entries;
    for (int b = 0; b < std::ssize(places); ++b)
      for (int axis : {0, 1}) {
        entries.emplace_back(places[b][2 + axis], 2 * b + axis, 1);
        if (!is_rigid) entries.emplace_back(places[b][axis], 2 * b + axis, -1);
      }
    SparseMatrix all(size(), 2 * static_cast<int>(places.size()));
    all.setFromTriplets(entries.begin(), entries.end());
    return all;
  }

  /** Degrees of freedom, those first that are shown; their number. */
  std::pair<std::vector<int>, int> order() const
  {
    std::vector<int> list;
    const auto add = [&](int dof) {
      if (std::ranges::find(list, dof) == list.end()) list.push_back(dof);
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

  /** Throws BadInput for what neither K nor a bearing holds. */
  void require_held(double spring) const
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
};

/** One bearing: [bearing] between the bearing_dofs of both bodies, or one of
    [[bearing]]. */
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
    StrictToml table = root.table("bearing");
    parameters.bearing = read_bearing(table, parameters.derived);
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
  constexpr std::size_t most = 4;
  if (list.empty() || list.size() > most)
    root.fail("bearing", format("must be 1...%zu tables [[bearing]]", most));
  parameters.bearing = list[0];
  parameters.further.assign(list.begin() + 1, list.end());
}

/** The columns that go beyond those of two masses. */
std::vector<std::pair<std::string, int>> outputs_of(const Assembly& all,
                                                    const std::vector<int>& place_of)
{
  std::vector<std::pair<std::string, int>> list;
  constexpr const char* names[] = {"x_s", "y_s", "x_r", "y_r"};
  for (std::size_t b = 1; b < all.places.size(); ++b)
    for (int k = 0; k < 4; ++k)
      list.emplace_back(format("%s_%zu", names[k], b + 1), place_of[all.places[b][k]]);
  for (int body : {0, 1})
    for (std::size_t axis = 0; axis < all.bodies[body].output.size(); ++axis)
      list.emplace_back(std::string(names[2 * body + static_cast<int>(axis)]) + "_out",
                        place_of[all.first(body) + all.bodies[body].output[axis]]);
  return list;
}

LargeBodies machine_of(const Assembly& all, double gravity, double spring)
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
    for (int& dof : place) dof = place_of[dof];
  const SparseMatrix& at_nodes = all.bodies[1].at_nodes;
  Triplets entries;
  for (int j = 0; j < at_nodes.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(at_nodes, j); it; ++it)
      entries.emplace_back(it.row(), place_of[all.first(1) + j], it.value());
  machine.nodes.resize(at_nodes.rows(), n);
  machine.nodes.setFromTriplets(entries.begin(), entries.end());
  return machine;
}

/** Puts coordinates that the bearings, loads and outputs need in the place of a body's
    own; their number and errors go into `machine`. */
void reduce_body(Assembly& all, int body, const ReductionRange& range, double gravity,
                 double spring, std::vector<std::string>& notes, double& error)
{
  LinearBody& own = all.bodies[body];
  BodyPorts ports{.joints = {},
                  .kept = {},
                  .load = own.load - gravity * (own.m * own.upright()),
                  .unbalance = own.unbalance,
                  .spring = spring,
                  .nodes = own.nodes};
  const auto kept = [&](int dof) {
    const auto at = std::ranges::find(ports.kept, dof);
    const auto place = static_cast<int>(at - ports.kept.begin());
    if (at == ports.kept.end()) ports.kept.push_back(dof);
    return place;
  };
  const int begin = all.first(body), more = all.size() - begin - own.size();
  for (auto& place : all.places)
    for (int axis : {0, 1}) {
      int& dof = place[2 * body + axis];
      dof = begin + kept(dof - begin);
    }
  ports.joints = ports.kept;
  for (int& dof : own.output) dof = kept(dof);
  const ReducedBody small = reduce(own, ports, range, own.name);
  notes.push_back(format(
      "%s: %d degrees of freedom reduced to %ld, error of the receptances %.2g at %d "
      "random points of 0...%.4g Hz",
      own.name.c_str(), own.size(), static_cast<long>(small.basis.cols()), small.error,
      small.points, small.highest / (2 * std::numbers::pi)));
  error = std::max(error, small.error);
  const int change = static_cast<int>(small.basis.cols()) - own.size();
  static_cast<BodyMatrices&>(own) = small.matrices;
  own.vertical.clear();
  if (!own.nodes.empty())
    own.at_nodes = Eigen::MatrixXd(own.at_nodes * small.basis).sparseView();
  own.load = small.basis.transpose() * ports.load;
  own.unbalance = small.basis.transpose() * ports.unbalance;
  if (more > 0)
    for (auto& place : all.places)
      for (int axis : {2, 3}) place[axis] += change;
}

/** Both bodies and the bearings. */
void read_bodies(StrictToml& root, Parameters& parameters, const ModelRange& asked)
{
  StrictToml tables[] = {root.table("stator"), root.table("rotor")};
  const double gravity = parameters.gravity;
  Assembly all{.bodies = {}, .is_rigid = parameters.stator.rigid};
  for (int body : {0, 1}) {
    const Body& mass = body == 0 ? parameters.stator : parameters.rotor;
    all.bodies.push_back(
        tables[body].has("matrices")
            ? read_matrices(tables[body], body == 0 ? "stator" : "rotor", gravity > 0)
            : single_mass(mass, body == 0 ? "stator" : "rotor",
                          body == 0 ? 0 : parameters.unbalance));
  }
  for (const LinearBody& body : all.bodies)
    for (const SparseMatrix* one : {&body.m, &body.c, &body.g, &body.k}) {
      const auto count = static_cast<std::size_t>(one->nonZeros()),
                 columns = static_cast<std::size_t>(one->outerSize());
      parameters.identity.add(std::as_bytes(std::span(one->valuePtr(), count)));
      parameters.identity.add(std::as_bytes(std::span(one->innerIndexPtr(), count)));
      parameters.identity.add(std::as_bytes(std::span(one->outerIndexPtr(), columns)));
    }
  if (all.is_rigid) all.bodies[0].vertical.clear();
  read_bearings(root, parameters, all);
  std::vector<std::pair<int, int>> bearing_nodes;
  if (asked.nodes && tables[1].has("matrices")) {
    LinearBody& rotor = all.bodies[1];
    read_nodes(*asked.nodes, rotor);
    for (int b = 0; b < std::ssize(all.places); ++b)
      for (int i = 0; i < std::ssize(rotor.nodes); i += 2)
        if (all.first(1) + rotor.nodes[i] == all.places[b][2] &&
            all.first(1) + rotor.nodes[i + 1] == all.places[b][3])
          bearing_nodes.emplace_back(b, i / 2);
  }
  for (const Bearing& bearing : bearings_of(parameters))
    if (!bearing.is_plain())
      root.fail(
          "bearing",
          "of bodies given by matrices takes no contact damping, no defect, nothing in "
          "parallel, no other contact_exponent and no negative clearance");
  /** The spring is that of a ball that carries all weights and loads. */
  double weight = 0;
  for (const LinearBody& body : all.bodies) {
    const Eigen::VectorXd upright = body.upright();
    weight += gravity * upright.dot(body.m * upright) + body.load.norm();
  }
  const double k_h = parameters.bearing.contact_stiffness;
  const double penetration =
      hertz_penetration(k_h, std::max(weight, hertz_force(k_h, 1e-6)));
  const double spring = hertz_stiffness(k_h, penetration);

  if (tables[1].has("matrices"))
    parameters.unbalance = all.bodies[1].unbalance.cwiseAbs().sum() / 2;
  double passages = 0;
  for (const Bearing& bearing : bearings_of(parameters))
    passages = std::max(passages, passages_per_turn(bearing));
  const double from = angular(0.9 * asked.from), to = angular(1.1 * asked.to);
  const ReductionRange range{from, to,
                             to * std::max(16 * passages, 1.0 * asked.harmonics)};
  std::vector<std::string> notes;
  double error = 0;
  for (int body : {0, 1})
    if (!all.bodies[body].keeps_all && all.bodies[body].size() > asked.largest)
      reduce_body(all, body, range, gravity, spring, notes, error);

  std::vector<std::array<int, 2>> joints[2];
  for (const auto& place : all.places)
    for (int body : {0, 1})
      joints[body].push_back(
          {place[2 * body] - all.first(body), place[2 * body + 1] - all.first(body)});
  if (tables[1].has("matrices"))
    parameters.rotor = equivalent(all.bodies[1], joints[1], spring);
  if (tables[0].has("matrices"))
    parameters.stator = equivalent(all.bodies[0], joints[0], spring);
  if (all.is_rigid) {
    /** Its pair of coordinates, which no force reaches, is damped within the contact's
        vibration. */
    const double omega = std::sqrt(spring / parameters.rotor.mass);
    all.bodies[0] = single_mass(
        {.mass = 1, .natural_frequency = omega, .damping_ratio = 0.7}, "stator", 0);
    all.bodies[0].vertical.clear();
  }
  all.require_held(spring);
  LargeBodies machine = machine_of(all, gravity, spring);
  machine.reductions = std::move(notes);
  machine.reduction_error = error;
  machine.bearing_nodes = std::move(bearing_nodes);
  if (asked.from < asked.to) {
    machine.slowest = from;
    machine.fastest = to;
    machine.fits = std::make_shared<RationalFits>();
  }
  parameters.machine = std::make_shared<const LargeMachine>(std::move(machine));
}

}  // namespace

Parameters read_machine(StrictToml root, const ModelRange& asked)
{
  return read_parameters(std::move(root), [&](StrictToml& table, Parameters& parameters) {
    read_bodies(table, parameters, asked);
  });
}

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
  Eigen::VectorXd u(forces.size());
  for (Eigen::Index k = 0; const Bearing& bearing : bearings_of(parameters)) {
    const Vec2 answer = quasi_static_contact(bearing, {forces[k], forces[k + 1]});
    u.segment<2>(k) << answer.x, answer.y;
    k += 2;
  }
  return u;
}

namespace {

/** At rest, the bearings holding the constant loads: all displacements, and the stiffness
    of the contacts, 2b × 2b. Forces are means over so many angles of the cage between two
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
  const auto bearings = bearings_of(parameters);

  /** u - c + H (F - k_0 u) and its derivative. */
  Eigen::VectorXd force(c.size());
  Eigen::MatrixXd slope(c.size(), c.size());
  const auto open = [&](const Eigen::VectorXd& u) -> Eigen::VectorXd {
    slope.setZero();
    force.setZero();
    for (int b = 0; b < machine.bearings(); ++b)
      for (int k = 0; k < angles; ++k) {
        const double cage =
            bearings[b].cage_phase + angular(1) * k / bearings[b].balls / angles;
        const auto [f, s] = BallBearing(bearings[b], rotor_speed)
                                .reaction(Direction::of(cage), {u[2 * b], u[2 * b + 1]});
        Eigen::Matrix2d one;
        one << s.xx, s.xy, s.yx, s.yy;
        force.segment<2>(2 * b) += Eigen::Vector2d(f.x, f.y) / angles;
        slope.block<2, 2>(2 * b, 2 * b) += one / angles;
      }
    force -= machine.spring * u;
    slope.diagonal().array() -= machine.spring;
    return u - c + h * force;
  };
  Eigen::VectorXd u = quasi_static_contacts(parameters, h.ldlt().solve(c));
  for (int step = 0; step < 100; ++step) {
    const Eigen::VectorXd rest = open(u);
    const Eigen::VectorXd change =
        (Eigen::MatrixXd::Identity(u.size(), u.size()) + h * slope)
            .partialPivLu()
            .solve(rest);
    double length = 1;
    while (length > 1e-6 && !(open(u - length * change).norm() < rest.norm()))
      length /= 2;
    if (!(length > 1e-6)) break;
    u -= length * change;
  }
  open(u);
  slope.diagonal().array() += machine.spring;
  return {alone - held.solve(d * force), slope};
}

}  // namespace

LargeBodies matrices_of(const Parameters& parameters)
{
  if (const auto* large = dynamic_cast<const LargeMachine*>(parameters.machine.get()))
    return large->bodies();
  Body stator = parameters.stator;
  if (stator.rigid) stator.mass = 1;  // which nothing moves
  Assembly all{.bodies = {single_mass(stator, "stator", 0),
                          single_mass(parameters.rotor, "rotor", parameters.unbalance)},
               .is_rigid = stator.rigid,
               .places = {{0, 1, 2, 3}}};
  return machine_of(all, parameters.gravity, scales(parameters).stiffness);
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

void LargeMachine::put_keys(Table& table) const
{
  table.value("degrees_of_freedom", bodies_.mass.rows());
  table.value("reduction_error", bodies_.reduction_error);
}

}  // namespace rotor_stator
