#include "explore/shaft.hpp"

#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <utility>

#include "explore/plausible.hpp"
#include "io/errors.hpp"
#include "io/matrix_market.hpp"
#include "io/output_file.hpp"
#include "io/toml_file.hpp"

namespace rotor_stator::explore {

namespace {

constexpr int most_nodes = 100000;

struct Material {
  double young, shear, density;  ///< [Pa], [Pa], [kg/m³]
};

/** Entries of the four matrices, which add up. */
struct Matrices {
  using Triplets = std::vector<Eigen::Triplet<double, int>>;
  Triplets m, c, g, k;

  using Dofs = std::vector<int>;  // of the plane of x

  /** A symmetric matrix in both planes. */
  static void add(Triplets& to, const Dofs& dofs, const Eigen::MatrixXd& block)
  {
    for (int axis : {0, 1})
      for (std::size_t i = 0; i < dofs.size(); ++i)
        for (std::size_t j = 0; j < dofs.size(); ++j)
          to.emplace_back(dofs[i] + axis, dofs[j] + axis, block(i, j));
  }

  /** Moments ω R q̇_y on the plane of x, -ω R q̇_x on that of y. */
  void add_gyroscopic(const Dofs& dofs, const Eigen::MatrixXd& r)
  {
    for (std::size_t i = 0; i < dofs.size(); ++i)
      for (std::size_t j = 0; j < dofs.size(); ++j) {
        g.emplace_back(dofs[i], dofs[j] + 1, r(i, j));
        g.emplace_back(dofs[i] + 1, dofs[j], -r(i, j));
      }
  }

  /** A rigid body at a node. */
  void add_body(int node, double mass, double diametral, double polar)
  {
    const auto one = [](double value) { return Eigen::MatrixXd::Constant(1, 1, value); };
    add(m, {4 * node}, one(mass));
    add(m, {4 * node + 2}, one(diametral));
    add_gyroscopic({4 * node + 2}, one(polar));
  }
};

/** Symmetric, from its upper triangle by rows. */
Eigen::Matrix4d symmetric(const std::array<double, 10>& upper)
{
  Eigen::Matrix4d full;
  for (int i = 0, k = 0; i < 4; ++i)
    for (int j = i; j < 4; ++j, ++k) full(i, j) = full(j, i) = upper[k];
  return full;
}

void add_element(Matrices& all, int node, double l, double outer, double inner,
                 const Material& steel)
{
  constexpr double pi = std::numbers::pi;
  const double area = pi / 4 * (outer * outer - inner * inner);
  const double moment = pi / 64 * (std::pow(outer, 4) - std::pow(inner, 4));
  const double nu = steel.young / (2 * steel.shear) - 1, r2 = std::pow(inner / outer, 2);
  const double r12 = (1 + r2) * (1 + r2);
  const double kappa = 6 * r12 * (1 + nu) / (r12 * (7 + 6 * nu) + r2 * (20 + 12 * nu));
  const double f = 12 * steel.young * moment / (kappa * steel.shear * area * l * l);
  const double per = 1 / (1 + f), f2 = f * f;
  const Eigen::Matrix4d stiffness =
      steel.young * moment * per / (l * l * l) *
      symmetric({12, 6 * l, -12, 6 * l, (4 + f) * l * l, -6 * l, (2 - f) * l * l, 12,
                 -6 * l, (4 + f) * l * l});
  const double m_2 = (44 + 77 * f + 35 * f2) * l, m_4 = (26 + 63 * f + 35 * f2) * l;
  const double m_5 = (8 + 14 * f + 7 * f2) * l * l, m_1 = 312 + 588 * f + 280 * f2;
  const Eigen::Matrix4d mass =
      steel.density * area * l * per * per / 840 *
      symmetric({m_1, m_2, 108 + 252 * f + 140 * f2, -m_4, m_5, m_4,
                 -(6 + 14 * f + 7 * f2) * l * l, m_1, -m_2, m_5});
  const double r_2 = (3 - 15 * f) * l, r_3 = (4 + 5 * f + 10 * f2) * l * l;
  const Eigen::Matrix4d rotary =
      steel.density * moment * per * per / (30 * l) *
      symmetric(
          {36, r_2, -36, r_2, r_3, -r_2, (-1 - 5 * f + 5 * f2) * l * l, 36, -r_2, r_3});
  const Matrices::Dofs dofs{4 * node, 4 * node + 2, 4 * node + 4, 4 * node + 6};
  Matrices::add(all.k, dofs, stiffness);
  Matrices::add(all.m, dofs, mass + rotary);
  all.add_gyroscopic(dofs, 2 * rotary);
}

/** A shaft being read. */
struct Shaft {
  StrictToml file;
  Material steel = {};
  std::vector<double> z{0};  ///< of the nodes [m]
  Matrices all = {};

  std::vector<StrictToml> tables(const std::string& key)
  {
    if (!file.has(key)) return {};
    return file.tables(key);
  }
  int node_of(StrictToml& table) const
  {
    return table.integer("node", 1, static_cast<int>(z.size())) - 1;
  }

  void read_segments()
  {
    for (StrictToml& segment : file.tables("segment")) {
      const double length = segment.number("length_m", Range::positive);
      const double outer = segment.number("diameter_m", Range::positive);
      const double inner = segment.number_or("bore_m", Range::not_negative, 0);
      if (inner >= outer) segment.fail("bore_m", "must be below diameter_m");
      const int count = segment.integer("elements", 1, most_nodes);
      if (count > most_nodes - std::ssize(z))
        segment.fail("elements", format("must give at most %d nodes", most_nodes));
      for (int k = 0; k < count; ++k) {
        add_element(all, static_cast<int>(z.size()) - 1, length / count, outer, inner,
                    steel);
        z.push_back(z.back() + length / count);
      }
    }
  }

  /** By mass and inertia, or by the dimensions of a ring of the shaft's material. */
  void read_disk(StrictToml& disk)
  {
    const int node = node_of(disk);
    if (disk.way({{"mass_kg", "diametral_inertia_kg_m2", "polar_inertia_kg_m2"},
                  {"outer_diameter_m", "bore_m", "thickness_m"}}) == 0)
      return all.add_body(node, disk.number("mass_kg", Range::positive),
                          disk.number("diametral_inertia_kg_m2", Range::not_negative),
                          disk.number("polar_inertia_kg_m2", Range::not_negative));
    const double outer = disk.number("outer_diameter_m", Range::positive);
    const double inner = disk.number_or("bore_m", Range::not_negative, 0);
    const double thickness = disk.number("thickness_m", Range::positive);
    if (inner >= outer) disk.fail("bore_m", "must be below outer_diameter_m");
    const double squares = outer * outer + inner * inner;
    const double mass = steel.density * std::numbers::pi / 4 *
                        (outer * outer - inner * inner) * thickness;
    all.add_body(node, mass, mass * (squares / 16 + thickness * thickness / 12),
                 mass * squares / 8);
  }

  void read_support(StrictToml& support)
  {
    const int node = node_of(support);
    for (const auto& [key, to] :
         {std::pair{"stiffness_N_per_m", &all.k}, {"damping_N_s_per_m", &all.c}}) {
      if (to == &all.c && !support.has(key)) continue;
      const auto values = support.numbers(key, Range::not_negative, "[x, y]");
      for (int axis : {0, 1})
        to->emplace_back(4 * node + axis, 4 * node + axis, values[axis]);
    }
  }

  SparseMatrix matrix(const Matrices::Triplets& entries) const
  {
    const int n = 4 * static_cast<int>(z.size());
    SparseMatrix sum(n, n);
    sum.setFromTriplets(entries.begin(), entries.end());
    return sum;
  }
};

/** What no shaft of metal or plastic has. */
Doubts doubts_of(const Shaft& shaft, double over_stiffness)
{
  constexpr double softest = 1e9, stiffest = 1e12;                    // [Pa]
  constexpr double massless = 0.5, lightest = 500, heaviest = 25000;  // [kg/m³]
  constexpr double longest = 50, slowest = 0.1;                       // [m], [s]
  const auto& [young, shear, density] = shaft.steel;
  Doubts all;
  all.add(young < softest || young > stiffest,
          format("a modulus of %.3g Pa: is it in Pa?", young));
  all.add((density > massless && density < lightest) || density > heaviest,
          format("a density of %.3g kg/m^3: is it in kg/m^3?", density));
  const double nu = young / (2 * shear) - 1;
  all.add(nu < 0 || nu > 0.5,
          format("the moduli give a Poisson's ratio of %.3g: are both in Pa?", nu));
  all.add(shaft.z.back() > longest,
          format("a shaft of %.3g m: are its lengths in m?", shaft.z.back()));
  all.add(over_stiffness > slowest,
          format("a damping of %.3g s over the stiffness: steel has less than 1e-4",
                 over_stiffness));
  return all;
}

}  // namespace

Exploration explore_shaft(const ShaftRequest& request)
{
  Shaft shaft{StrictToml(request.parameter_file)};
  const std::string title = shaft.file.string("title");
  StrictToml material = shaft.file.table("material");
  shaft.steel = {material.number("youngs_modulus_Pa", Range::positive),
                 material.number("shear_modulus_Pa", Range::positive),
                 material.number("density_kg_per_m3", Range::positive)};
  shaft.read_segments();
  for (StrictToml& disk : shaft.tables("disk")) shaft.read_disk(disk);
  for (StrictToml& mass : shaft.tables("mass"))
    shaft.all.add_body(shaft.node_of(mass), mass.number("mass_kg", Range::positive), 0,
                       0);
  for (StrictToml& support : shaft.tables("support")) shaft.read_support(support);
  double over_mass = 0, over_stiffness = 0;
  if (shaft.file.has("damping")) {
    StrictToml damping = shaft.file.table("damping");
    over_mass = damping.number_or("over_mass_1_per_s", Range::not_negative, 0);
    over_stiffness = damping.number_or("over_stiffness_s", Range::not_negative, 0);
  }
  shaft.file.refuse_unknown_keys();
  const SparseMatrix m = shaft.matrix(shaft.all.m), k = shaft.matrix(shaft.all.k);
  const SparseMatrix c = shaft.matrix(shaft.all.c) + over_mass * m + over_stiffness * k;
  const std::filesystem::path folder = request.folder;
  std::error_code error;
  std::optional<Temporary> empty;  // while it is
  if (std::filesystem::create_directory(folder, error)) empty.emplace(folder);
  if (!std::filesystem::is_directory(folder, error))
    throw BadInput("--to " + request.folder + ": is no folder and cannot be made one");
  const std::vector<NamedContent> files{
      {folder / "M.mtx", matrix_text(m)},
      {folder / "C.mtx", matrix_text(c)},
      {folder / "G.mtx", matrix_text(shaft.matrix(shaft.all.g))},
      {folder / "K.mtx", matrix_text(k)}};
  for (const NamedContent& file : files)
    require_writable("--to", file.name, {request.parameter_file}, request.force);

  Table table("Nodes of a shaft and their degrees of freedom",
              {{"node", "-", "from 1"},
               {"z", "m", "along the shaft"},
               {"x", "-", "degree of freedom of x"},
               {"y", "-", "degree of freedom of y"},
               {"dx_dz", "-", "degree of freedom of the slope of x"},
               {"dy_dz", "-", "degree of freedom of the slope of y"}});
  table.choose(request.columns, 6, false);
  table.parameters(request.parameter_file + " (" + title + ")");
  table.value("degrees_of_freedom", 4 * shaft.z.size());
  /** The whole shaft moves along x. */
  const Eigen::VectorXd along = Eigen::Vector4d::Unit(0).replicate(m.rows() / 4, 1);
  table.value("mass", along.dot(m * along));
  table.note("mass [kg]: of all; damping over_stiffness_s: over K with the supports");
  for (const std::string& doubt : doubts_of(shaft, over_stiffness)) table.warning(doubt);
  table.note("matrices: M, C, G, K in " + request.folder);
  for (std::size_t i = 0; i < shaft.z.size(); ++i)
    table.row({i + 1, shaft.z[i], 4 * i + 1, 4 * i + 2, 4 * i + 3, 4 * i + 4});
  write_files(files);
  return {std::move(table)};
}

}  // namespace rotor_stator::explore
