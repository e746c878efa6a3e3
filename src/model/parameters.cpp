#include "model/parameters.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/errors.hpp"
#include "model/catalogue.hpp"
#include "model/parallel.hpp"
#include "model/rotor_stator.hpp"

namespace rotor_stator {

namespace {

/** What a value and the mass give, where a double holds it. */
double derived(StrictToml& table, const char* key, double value)
{
  if (!std::isfinite(value)) table.fail(key, "and mass_kg give more than a double holds");
  return value;
}

const Ways suspension_ways{{"natural_frequency_rad_per_s"}, {"stiffness_N_per_m"}};
const Ways damping_ways{{"damping_ratio"}, {"damping_N_s_per_m"}};
const Ways unbalance_ways{
    {"unbalance_kg_m"}, {"eccentricity_m"}, {"balance_grade", "balance_speed_rad_per_s"}};

Body read_body(StrictToml& table)
{
  table.may_hold({{"mass_kg", "load_N", ground_key, "matrices"}});
  for (const Ways& ways : {suspension_ways, damping_ways, unbalance_ways})
    table.may_hold(ways);
  Body body{};
  body.mass = table.number("mass_kg", Range::positive);
  constexpr const char *frequency_key = "natural_frequency_rad_per_s",
                       *stiffness_key = "stiffness_N_per_m";
  if (table.way(suspension_ways) == 0)
    body.natural_frequency = table.number(frequency_key, Range::not_negative);
  else
    body.natural_frequency =
        derived(table, stiffness_key,
                std::sqrt(table.number(stiffness_key, Range::not_negative) / body.mass));
  const bool is_free = body.natural_frequency == 0;
  if (is_free && !table.has("damping_ratio") && !table.has("damping_N_s_per_m"))
    table.missing("damping_N_s_per_m",
                  ": a body without a suspension has no damping_ratio; 0, or what damps "
                  "it against the ground");
  if (table.way(damping_ways) == 0)
    body.damping_ratio = table.number("damping_ratio", Range::not_negative);
  else
    body.damper = table.number("damping_N_s_per_m", Range::not_negative);
  if (body.damping_ratio > 0 && is_free)
    table.fail("damping_ratio",
               "damps nothing where natural_frequency_rad_per_s is 0; give "
               "damping_N_s_per_m instead");
  if (table.has("load_N")) {
    const std::vector<double> load = table.numbers("load_N", Range::any, "[x, y]");
    body.load = {load[0], load[1]};
  }
  return body;
}

/** m_e e [kg m], or the rotor's mass times its eccentricity, or what a grade G of ISO
    21940-11, the speed of the eccentricity in mm/s, allows at a speed. */
double read_unbalance(StrictToml& table, Parameters& parameters)
{
  constexpr const char *key = "eccentricity_m", *grade = "balance_grade",
                       *speed = "balance_speed_rad_per_s";
  const std::size_t way = table.way(unbalance_ways);
  if (way == 0) return table.number("unbalance_kg_m", Range::not_negative);
  if (way == 1)
    return derived(table, key,
                   parameters.rotor.mass * table.number(key, Range::not_negative));
  parameters.balance_speed = table.number(speed, Range::positive);
  const double e =
      1e-3 * table.number(grade, Range::not_negative) / parameters.balance_speed;
  return derived(table, grade, parameters.rotor.mass * e);
}

/** A stator that no force moves: so much heavier than the rotor that its motion is below
    the rounding of the rotor's, and damped within the contact's vibration, so that it
    adds no slow multiplier. Its frequency is set when the rest is known. */
bool read_rigid(StrictToml& table, double rotor_mass, Body& stator)
{
  if (!table.has("rigid") || !table.flag("rigid")) return false;
  for (const std::string& key : table.keys())
    if (key != "rigid" && key != ground_key)
      table.fail(key, "is not a known key here: a rigid stator has no other keys");
  constexpr double heavier = 1e15;
  stator = {.mass = heavier * rotor_mass,
            .natural_frequency = 0,
            .damping_ratio = 1,
            .rigid = true};
  return true;
}

}  // namespace

Parameters read_parameters(StrictToml root, const MatrixReader& reader)
{
  Parameters parameters{};
  parameters.file = root.file();
  const std::string read = root.text_without("title");
  parameters.identity.add(std::as_bytes(std::span(read)));
  constexpr const char *matrices = "matrices", *bearing_key = "bearing",
                       *gravity_key = "acceleration_m_per_s2";
  root.may_hold({{"title", "stator", "rotor", bearing_key, "gravity"}});
  parameters.title = root.string("title");

  StrictToml stator = root.table("stator"), rotor = root.table("rotor");
  const bool is_mass = !rotor.has(matrices);
  if (is_mass) parameters.rotor = read_body(rotor);
  if (!read_rigid(stator, parameters.rotor.mass, parameters.stator) &&
      !stator.has(matrices))
    parameters.stator = read_body(stator);
  if (is_mass) parameters.unbalance = read_unbalance(rotor, parameters);
  StrictToml gravity = root.table("gravity");
  gravity.may_hold({{gravity_key}});
  parameters.gravity = gravity.number(gravity_key, Range::not_negative);
  const bool has_matrices =
      !is_mass || stator.has(matrices) || stator.has(ground_key) || rotor.has(ground_key);
  if (has_matrices) {
    if (!reader)
      throw BadInput(root.file() +
                     ": bodies given by matrices, or with elements to the ground, need "
                     "the program explore");
    reader(root, parameters);
    read_rigid(stator, parameters.rotor.mass, parameters.stator);
  } else {
    if (root.has_tables(bearing_key))
      root.fail(
          bearing_key,
          "must be [bearing]; several are of bodies given by matrices, which explore "
          "shaft writes");
    parameters.bearing = read_bearing(root.table(bearing_key), parameters.derived);
  }
  for (const Bearing& joint : joints_of(parameters))
    for (const Coefficients& at : joint.parallel.linear)
      parameters.identity.add(std::as_bytes(std::span(&at, 1)));

  root.refuse_unknown_keys();
  if (parameters.stator.rigid)
    parameters.stator.natural_frequency = contact_frequency(parameters);
  else if (!has_matrices && parameters.stator.stiffness() == 0 &&
           parameters.rotor.stiffness() == 0)
    rotor.fail("natural_frequency_rad_per_s",
               "and the stator's must not both be 0: nothing would hold the machine");
  return parameters;
}

double rotor_speed(const Parameters& parameters, double omega)
{
  return parameters.turns * parameters.speed_ratio * omega;
}

Parameters over_turns(Parameters parameters, int turns)
{
  parameters.turns *= turns;
  change_joints(parameters, [turns](Bearing& joint) {
    joint.cage_speed_ratio *= turns;
    joint.defect.spin *= turns;
  });
  return parameters;
}

double passages_per_turn(const Bearing& bearing)
{
  return bearing.balls * bearing.cage_speed_ratio;
}

bool has_rotation_period(const Bearing& bearing)
{
  const double passages = passages_per_turn(bearing);
  return !bearing.is_damaged(Defect::Surface::ball) &&
         std::abs(passages - std::round(passages)) < 1e-9;
}

void require_two_masses(const Parameters& parameters, const char* who)
{
  if (!parameters.bodies->takes_explicit_steps() || !parameters.grounds.empty())
    throw BadInput(parameters.file + ": " + who +
                   " knows no bodies given by matrices, and nothing between a body and "
                   "the ground");
}

std::vector<Bearing> bearings_of(const Parameters& parameters)
{
  std::vector<Bearing> list{parameters.bearing};
  list.insert(list.end(), parameters.further.begin(), parameters.further.end());
  return list;
}

std::string numbered(const std::string& name, std::size_t b)
{
  return b == 0 ? name : format("%s_%zu", name.c_str(), b + 1);
}

std::vector<Bearing> joints_of(const Parameters& parameters)
{
  std::vector<Bearing> list = bearings_of(parameters);
  list.insert(list.end(), parameters.grounds.begin(), parameters.grounds.end());
  return list;
}

/** Whether one of the bearings is damaged there. */
static bool is_damaged(const Parameters& parameters, Defect::Surface at)
{
  return std::ranges::any_of(bearings_of(parameters),
                             [at](const Bearing& one) { return one.is_damaged(at); });
}

void require_two_angles(const Parameters& parameters)
{
  if (is_damaged(parameters, Defect::Surface::ball))
    throw BadInput(parameters.file +
                   ": bearing.defect: a damaged ball turns about itself, a third "
                   "frequency beside those of rotor and cage; use a time method");
}

bool turns_visibly(const Parameters& parameters)
{
  return parameters.unbalance > 0 || is_damaged(parameters, Defect::Surface::inner_race);
}

void require_rotation_period(const Parameters& parameters, const char* who)
{
  require_two_angles(parameters);
  for (const Bearing& bearing : bearings_of(parameters))
    if (!has_rotation_period(bearing))
      throw BadInput(format(
          "%s: bearing.cage_speed_ratio: %s needs a force with the period of rotation, "
          "but %.9g balls pass in a turn, not a whole number",
          parameters.file.c_str(), who, passages_per_turn(bearing)));
}

bool is_bare(const Parameters& parameters)
{
  return std::ranges::none_of(joints_of(parameters),
                              [](const Bearing& one) { return one.parallel.any(); });
}

bool excludes(const std::string& key, const std::string& other)
{
  const auto all = {clearance_ways, own_stiffness_ways, damping_ways, suspension_ways,
                    unbalance_ways};
  return std::ranges::any_of(all, [&](const Ways& ways) {
    const auto way_of = [&](const std::string& name) {
      return std::ranges::find_if(
          ways, [&](const auto& keys) { return std::ranges::count(keys, name) > 0; });
    };
    const auto one = way_of(key), two = way_of(other);
    return one != ways.end() && two != ways.end() && one != two;
  });
}

Parameters read_parameters(SceneFile& scene, const std::string& key)
{
  return read_parameters(scene.data_set(key));
}

std::vector<Parameters> read_parameter_list(SceneFile& scene, const std::string& key)
{
  std::vector<Parameters> list;
  for (const std::string& file : scene.data_sets(key))
    list.push_back(read_parameters(file));
  return list;
}

void Machine::describe(Table& table, const Parameters& parameters) const
{
  const auto body = [](const std::string& name, const Body& b) {
    if (b.rigid) return name + ": rigid";
    return format("%s: m = %.15g kg, omega_0 = %.15g rad/s, ", name.c_str(), b.mass,
                  b.natural_frequency) +
           (b.damper > 0 ? format("c = %.15g N s/m", b.damper)
                         : format("xi = %.15g", b.damping_ratio)) +
           (b.load.x != 0 || b.load.y != 0
                ? format(", load = (%.15g, %.15g) N", b.load.x, b.load.y)
                : "");
  };
  table.detail(body("stator", parameters.stator) + "; " +
               body("rotor", parameters.rotor));
}

namespace {

const char* surface_of(const Defect& defect)
{
  return Defect::surfaces[static_cast<std::size_t>(defect.surface)];
}

/** The `#` lines of a joint; its number where there are several. */
void describe(Table& table, const Bearing& joint, const std::string& number)
{
  if (joint.balls == 0) return describe_parallel(table, joint.place, joint.parallel);
  table.detail(format("bearing%s: n = %d, K_H = %.15g N/m^%g, delta = %.15g m, "
                      "omega_cage/omega = %.15g",
                      number.c_str(), joint.balls, joint.contact_stiffness,
                      joint.exponent, joint.clearance, joint.cage_speed_ratio) +
               (joint.cage_phase != 0
                    ? format(", cage phase = %.15g rad", joint.cage_phase)
                    : ""));
  if (joint.damping > 0)
    table.detail(
        format("contact damping%s: lambda = %.15g s/m", number.c_str(), joint.damping));
  describe_parallel(table, "parallel" + number, joint.parallel);
  const Defect& defect = joint.defect;
  if (defect.surface == Defect::Surface::none) return;
  const bool is_ball = defect.surface == Defect::Surface::ball;
  table.detail(format("defect%s: %s, depth %.15g m, width %.15g rad, angle %.15g rad",
                      number.c_str(), surface_of(defect), defect.depth, defect.width,
                      defect.place) +
               (is_ball ? format(", ball %d", defect.ball) : ""));
}

}  // namespace

void describe(Table& table, const Parameters& parameters, bool with_keys)
{
  table.parameters(parameters.file + " (" + parameters.title + ")");
  parameters.bodies->describe(table, parameters);
  table.detail(format("m_e e = %.15g kg m; g = %.15g m/s^2", parameters.unbalance,
                      parameters.gravity));
  const std::vector<Bearing> bearings = bearings_of(parameters);
  for (const auto& joints : {bearings, parameters.grounds})
    for (std::size_t k = 0; const Bearing& joint : joints)
      describe(table, joint, joints.size() == 1 ? "" : format(" %zu", ++k));
  for (const std::string& line : parameters.derived) table.detail(line);
  for (const std::string& doubt : parameters.doubts) table.warning(doubt);
  if (!with_keys) return;
  table.value("machine", parameters.identity.word());
  table.value("stator", parameters.stator.rigid ? "rigid" : "moving");
  parameters.bodies->put_keys(table);
  for (std::size_t k = 0; k < bearings.size(); ++k) {
    const Bearing& one = bearings[k];
    const auto put = [&](const char* key, const Cell& value) {
      table.value(numbered(key, k), value);
    };
    if (!one.is_damaged(Defect::Surface::none)) put("defect", surface_of(one.defect));
    put("balls", one.balls);
    put("contact_stiffness", one.contact_stiffness);
    put("clearance", one.clearance);
    put("cage_speed_ratio", one.cage_speed_ratio);
    if (one.ball_diameter == 0) continue;
    const KinematicOrders orders = kinematic_orders(one);
    put("ball_diameter", one.ball_diameter);
    put("bpfo", orders.outer);
    put("bpfi", orders.inner);
    if (orders.spin > 0) put("bsf", orders.spin);
  }
}

double angular(double hertz)
{
  return 2 * std::numbers::pi * hertz;
}

std::vector<double> angular(const std::vector<double>& hertz)
{
  std::vector<double> omegas = hertz;
  for (double& omega : omegas) omega = angular(omega);
  return omegas;
}

}  // namespace rotor_stator
