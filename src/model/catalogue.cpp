#include "model/catalogue.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <regex>

#include "io/errors.hpp"
#include "model/bearing_catalogue.hpp"
#include "model/hertz.hpp"
#include "model/parallel.hpp"

namespace rotor_stator {

namespace {

constexpr int most_balls = 1024;

const char* const designation_key = "designation";
constexpr const char *exponent_key = "contact_exponent",
                     *power_key = "contact_stiffness_N_per_mn";

}  // namespace

const Ways clearance_ways{
    {"radial_clearance_m"}, {"diametral_clearance_m"}, {"internal_clearance"}};
const Ways own_stiffness_ways{
    {"contact_stiffness_N_per_m1p5"},
    {power_key, exponent_key},
    {"inner_groove_ratio", "outer_groove_ratio", "youngs_modulus_Pa", "poissons_ratio"}};

namespace {

const Ways cage_ways{{"cage_speed_ratio"},
                     {"ball_radius_m", "inner_race_radius_m"},
                     {"ball_diameter_m", "pitch_diameter_m"},
                     {designation_key}};
const Ways stiffness_ways{own_stiffness_ways[0],
                          own_stiffness_ways[1],
                          own_stiffness_ways[2],
                          {designation_key}};

StrictToml catalogue()
{
  return StrictToml("deep_groove.toml", bearing_catalogue);
}

/** A designation as people write it, "SKF 6205-2RS1/C3": what is looked up, the class of
    clearance, and the rest, which says nothing of balls and clearance. */
struct Designation {
  std::string basic, clearance, unused;
};

/** Throws BadInput for other kinds of bearings, by the reason and the way round. */
Designation read_designation(StrictToml& table)
{
  const std::string text = table.string(designation_key);
  std::smatch part;
  static const std::regex whole(R"(((?:[A-Z]+ +|FAG|KOYO|NACHI|NSK|NTN|SKF|SNR)*))"
                                R"(([A-Z]*)(\d+(?:/\d\d)?)(?!\d)(.*))",
                                std::regex::icase);
  constexpr std::size_t longest = 100;  // std::regex recurses for each
  if (text.size() > longest)
    table.fail(designation_key, format("has more than %zu characters", longest));
  if (!std::regex_match(text, part, whole))
    table.fail(designation_key, "\"" + text + "\" holds no number such as 6205");
  const std::string prefix = part[2], basic = part[3];
  const auto refuse = [&](const std::string& kind, const std::string& instead) {
    table.fail(designation_key, "\"" + text + "\" is " + kind +
                                    "; designations are of deep groove ball bearings: "
                                    "give " +
                                    instead + " instead");
  };
  static const std::regex rollers("R?NU?[JPB]?|RNU", std::regex::icase);
  if (std::regex_match(prefix, rollers))
    refuse("a cylindrical roller bearing", "balls, cage_speed_ratio, contact_exponent");
  if (prefix.empty() && basic.size() == 4 && basic[0] == '7')
    refuse("an angular contact ball bearing", "balls, diameters and contact_angle_deg");
  Designation found{prefix + basic, "", part[1]};
  const std::string tail = part[4];
  static const std::regex word("HC[0-9]?|[A-Z0-9]+", std::regex::icase);
  /** Perhaps behind a code of seals, as in ZZC3; HC5 are ceramic balls. */
  static const std::regex clearance(
      "(?!HC)([A-Z0-9]*[A-Z])?[Cc]([02345Nn])(?:[A-Z].*)?|P[56]([2-5])"),
      no_class("[Cc][1-9][0-9]*");
  for (std::sregex_iterator at(tail.begin(), tail.end(), word), end; at != end; ++at) {
    const std::string code = at->str();
    std::string other = code;
    if (std::regex_match(code, part, clearance)) {
      const std::string name = part[2].str() + part[3].str();
      if (!found.clearance.empty())
        table.fail(designation_key, "\"" + text + "\" names two classes of clearance");
      found.clearance = name == "0" || name == "n" ? "CN" : "C" + name;
      other = part[1];
    } else if (std::regex_match(code, no_class)) {
      table.fail(designation_key, "\"" + text + "\": " + code +
                                      " is no class of clearance: C2, CN, C3, C4, C5");
    }
    if (other.empty()) continue;
    found.unused +=
        (found.unused.empty() || found.unused.back() == ' ' ? "" : " ") + other;
  }
  return found;
}

/** The entry of a designation. Throws BadInput for one that is not there, with the
    nearest one or, where none is near, all that there are. */
StrictToml entry_of(StrictToml& table, const std::string& wanted)
{
  std::vector<std::string> known;
  for (StrictToml& entry : catalogue().tables("bearing")) {
    known.push_back(entry.string(designation_key));
    if (known.back() == wanted) return entry;
  }
  std::ranges::sort(known);
  std::string advice = suggestion(wanted, known);
  if (advice.empty()) advice = "; there are " + joined(known, ", ");
  table.fail(designation_key, "\"" + table.string(designation_key) +
                                  "\" is not in the catalogue" + advice +
                                  "; give the bearing's dimensions instead");
}

/** Diameters of balls and pitch circle [m], 0 where only the cage's ratio is given. */
struct Diameters {
  double ball, pitch;
};

/** Eq. 3, c = ½(1 - R_b/(R_b + R)) with the radii R_b of a ball and R of the inner race
    (in the paper's Eq. 2 R is the ball's, D-07), for any contact angle and speed of the
    outer ring. `source`: the catalogue's entry where there is a designation, else the
    same table. */
Diameters read_cage(StrictToml& table, StrictToml& source, Bearing& bearing)
{
  const std::size_t way = table.way(cage_ways);
  constexpr const char *angle_key = "contact_angle_rad",
                       *outer_key = "outer_ring_speed_ratio";
  const double angle = bearing.contact_angle =
      table.number_or(angle_key, Range::not_negative, 0);
  const double outer = bearing.outer_ring_speed_ratio =
      table.number_or(outer_key, Range::any, 0);
  if (angle >= std::numbers::pi / 2) table.fail(angle_key, "must be below a right angle");
  if (std::abs(outer) >= 1) table.fail(outer_key, "must be in -1 < ratio < 1");
  if (way == 0) {
    const double c = bearing.cage_speed_ratio =
        table.number("cage_speed_ratio", Range::positive);
    if (c > (1 + outer) / 2 || c <= outer)
      table.fail(
          "cage_speed_ratio",
          format("must be in %g < c <= %g%s", std::max(0.0, outer), (1 + outer) / 2,
                 outer == 0 ? ", or give outer_ring_speed_ratio too" : ""));
    return {};
  }
  const bool has_radii = way == 1;
  StrictToml& from = has_radii ? table : source;
  const char* const key = has_radii ? "ball_radius_m" : "ball_diameter_m";
  const double ball = from.number(key, Range::positive),
               other = from.number(has_radii ? "inner_race_radius_m" : "pitch_diameter_m",
                                   Range::positive);
  const Diameters found =
      has_radii ? Diameters{2 * ball, 2 * (ball + other)} : Diameters{ball, other};
  bearing.radius_ratio = found.ball / found.pitch;
  const double most = bearing.balls >= 2 ? std::sin(std::numbers::pi / bearing.balls) : 1;
  if (!(bearing.radius_ratio < most))
    from.fail(key, format("makes the %d balls overlap: R_b/(R_b+R) = %g must be below "
                          "sin(pi/n) = %g",
                          bearing.balls, bearing.radius_ratio, most));
  const double ratio = bearing.radius_ratio * std::cos(angle);
  bearing.cage_speed_ratio = 0.5 * (1 - ratio) + 0.5 * outer * (1 + ratio);
  if (bearing.cage_speed_ratio <= 0)
    table.fail(outer_key, "lets the cage stand still or turn backwards");
  return found;
}

/** The range of a class of clearance [m], on the diameter, for a bore. */
std::vector<double> clearance_range(StrictToml& table, const std::string& wanted,
                                    double bore)
{
  for (StrictToml& range : catalogue().tables("clearance"))
    if (bore > range.number("above_m", Range::positive) &&
        bore <= range.number("up_to_m", Range::positive))
      return range.numbers(wanted, Range::not_negative);
  table.fail(designation_key,
             format("has no %s for a bore of %g m", wanted.c_str(), bore));
}

/** The class of clearance, by the key or by the designation; without either the normal
    one, which bearings do not bear a mark of (ISO 5753-1). */
std::string clearance_class(StrictToml& table, const std::string& by_designation)
{
  constexpr const char* key = "internal_clearance";
  if (!table.has(key)) return by_designation.empty() ? "CN" : by_designation;
  std::string given = table.string(key);
  static const std::regex known("C[02345N]", std::regex::icase);
  if (!std::regex_match(given, known))
    table.fail(key, "\"" + given + "\": must be C2, CN or C0 (normal), C3, C4 or C5");
  for (char& letter : given) letter = static_cast<char>(std::toupper(letter));
  const std::string wanted = given == "C0" ? "CN" : given;
  if (!by_designation.empty() && by_designation != wanted)
    table.fail(key,
               "\"" + given + "\" contradicts " + by_designation + " of designation");
  return wanted;
}

double read_clearance(StrictToml& table, StrictToml& source,
                      const std::string& by_designation,
                      std::vector<std::string>& derived, std::string& doubt)
{
  const bool is_given = std::ranges::any_of(
      clearance_ways, [&](const auto& keys) { return table.has(keys[0]); });
  const bool has_designation = table.has(designation_key);
  const std::size_t way = is_given || !has_designation ? table.way(clearance_ways) : 2;
  if (way < 2) {
    const double given = table.number(clearance_ways[way][0], Range::any),
                 radial = way == 0 ? given : given / 2;
    if (way == 1)
      derived.push_back(
          format("clearance: %.15g m on the diameter, delta is half of it", given));
    if (!has_designation) return radial;
    if (!by_designation.empty())
      derived.push_back("clearance: as given; " + by_designation +
                        " of the designation is not used");
    const std::string widest = by_designation.empty() ? "C5" : by_designation;
    const double most =
        clearance_range(table, widest, source.number("bore_m", Range::positive))[1];
    if (radial > most / 2)
      doubt = format(
          "a clearance of %g um on the diameter, where %s has at most %g: is "
          "it radial?",
          2e6 * std::min(radial, 1e300), widest.c_str(), 1e6 * most);
    return radial;
  }
  if (!has_designation)
    table.fail("internal_clearance",
               "needs designation, which gives the bore; without it give "
               "diametral_clearance_m");
  const std::string wanted = clearance_class(table, by_designation);
  const auto range =
      clearance_range(table, wanted, source.number("bore_m", Range::positive));
  derived.push_back(
      format("clearance: %s%s, %g to %g um on the diameter unmounted (ISO 5753-1), "
             "delta is half of the middle",
             wanted.c_str(),
             is_given || !by_designation.empty() ? "" : ", as nothing else is named",
             1e6 * range[0], 1e6 * range[1]));
  return (range[0] + range[1]) / 4;
}

double groove_ratio(StrictToml& source, const std::string& key)
{
  const double ratio = source.number(key, Range::positive);
  if (ratio <= 0.5)
    source.fail(key,
                format("must be > 0.5: groove radius over ball diameter, got %g", ratio));
  return ratio;
}

double read_stiffness(StrictToml& table, StrictToml& source, const Diameters& diameters,
                      Bearing& bearing, std::vector<std::string>& derived)
{
  if (table.has(exponent_key) && !table.has(power_key))
    table.fail(exponent_key, std::string("needs ") + power_key + ", in N/m^n");
  const std::size_t way = table.way(stiffness_ways);
  if (way == 0) return table.number("contact_stiffness_N_per_m1p5", Range::positive);
  if (way == 1) {
    bearing.exponent = table.number(exponent_key, Range::positive);
    if (bearing.exponent < 1 || bearing.exponent > 3)
      table.fail(exponent_key, format("must be in 1...3, got %g", bearing.exponent));
    return table.number(power_key, Range::positive);
  }
  if (way == 2 && diameters.ball == 0)
    table.fail("cage_speed_ratio",
               "does not give the ball's size, which the groove ratios need; give "
               "ball_diameter_m and pitch_diameter_m instead");
  const BallGeometry geometry{diameters.ball, diameters.pitch,
                              groove_ratio(source, "inner_groove_ratio"),
                              groove_ratio(source, "outer_groove_ratio")};
  constexpr double widest_groove = 0.7;
  for (const double ratio : {geometry.inner_groove_ratio, geometry.outer_groove_ratio})
    if (ratio > widest_groove)
      bearing.doubt = format(
          "a groove ratio of %g: it is the groove's radius over the ball's diameter, "
          "about 0.52",
          std::min(ratio, 1e300));
  StrictToml material = way == 2 ? table : catalogue().table("steel");
  const Solid steel{
      .young_modulus = material.number("youngs_modulus_Pa", Range::positive),
      .poisson_ratio = material.number("poissons_ratio", Range::not_negative)};
  if (steel.poisson_ratio > 0.5)
    material.fail("poissons_ratio",
                  format("must be in 0...0.5, got %g", steel.poisson_ratio));
  const PointContact inner = inner_contact(geometry, steel);
  const PointContact outer = outer_contact(geometry, steel);
  const double stiffness = in_series(inner.stiffness, outer.stiffness);
  bearing.pressure = std::max(inner.pressure, outer.pressure);
  if (!(stiffness > 0 && std::isfinite(stiffness)))
    source.fail("youngs_modulus_Pa",
                "and the dimensions give no contact stiffness that a double holds");
  derived.push_back(
      format("contact: groove ratios %.15g and %.15g (%s), E = %.15g Pa, nu = %.15g; "
             "Hertz: K_inner = %.6g, K_outer = %.6g N/m^1.5, in series K_H",
             geometry.inner_groove_ratio, geometry.outer_groove_ratio,
             way == 2 ? "given" : source.string("groove_ratios").c_str(),
             steel.young_modulus, steel.poisson_ratio, inner.stiffness, outer.stiffness));
  return stiffness;
}

Defect read_defect(StrictToml table, const Bearing& bearing)
{
  using enum Defect::Surface;
  Defect defect;
  const std::string surface = table.string("surface");
  const auto named = std::ranges::find(Defect::surfaces, surface);
  if (named == Defect::surfaces.begin() || named == Defect::surfaces.end())
    table.fail("surface",
               "\"" + surface + "\": must be \"outer_race\", \"inner_race\" or \"ball\"");
  defect.surface = static_cast<Defect::Surface>(named - Defect::surfaces.begin());
  defect.depth = table.number("depth_m", Range::not_negative);
  defect.width = table.number("width_rad", Range::positive);
  defect.place = table.number_or("angle_rad", Range::any, 0);
  const bool is_ball = defect.surface == ball;
  if (defect.surface == outer_race && bearing.outer_ring_speed_ratio != 0)
    table.fail("surface",
               "\"outer_race\" does not turn here, but "
               "outer_ring_speed_ratio says that the ring does");
  const double widest = (is_ball ? 1 : 2.0 / bearing.balls) * std::numbers::pi;
  if (defect.width > widest)
    table.fail("width_rad", format("must not exceed %s, %.9g rad, got %g",
                                   is_ball ? "half a turn of the ball"
                                           : "the spacing of the balls 2 pi/n",
                                   widest, defect.width));
  if (!is_ball) return defect;
  defect.ball = table.integer_or("ball", 1, bearing.balls, 1);
  defect.spin = kinematic_orders(bearing).spin;
  if (defect.spin == 0)
    table.fail("surface",
               "\"ball\": with omega_cage/omega = 1/2 no ball of finite size turns about "
               "itself");
  return defect;
}

}  // namespace

KinematicOrders kinematic_orders(const Bearing& bearing)
{
  const double c = bearing.cage_speed_ratio, outer = bearing.outer_ring_speed_ratio;
  const double ratio = (1 + outer - 2 * c) / (1 - outer);  // D cos α/d_m
  return {.cage = c,
          .spin = ratio > 0 ? std::cos(bearing.contact_angle) * (1 - outer) *
                                  (1 - ratio * ratio) / (2 * ratio)
                            : 0,
          .outer = bearing.balls * (c - outer),
          .inner = bearing.balls * (1 - c)};
}

Bearing read_bearing(StrictToml table, std::vector<std::string>& derived)
{
  for (const Ways& ways : {cage_ways, stiffness_ways, clearance_ways})
    table.may_hold(ways);
  table.may_hold(
      {{"balls", "contact_angle_rad", "outer_ring_speed_ratio", "cage_phase_rad",
        "stator_dofs", "rotor_dofs", "defect", "parallel", "contact_damping_s_per_m"}});
  Bearing bearing{};
  const bool has_count = table.way({{"balls"}, {designation_key}}) == 0;
  const Designation name = has_count ? Designation{} : read_designation(table);
  StrictToml source = has_count ? table : entry_of(table, name.basic);
  bearing.balls = source.integer("balls", 1, most_balls);
  const Diameters diameters = read_cage(table, source, bearing);
  bearing.ball_diameter = diameters.ball;
  if (bearing.contact_angle > 0)
    derived.push_back(
        format("contact angle: %.15g rad in the orders of cage, balls and races; "
               "forces and motion stay in the plane, without axial load",
               bearing.contact_angle));
  if (bearing.outer_ring_speed_ratio != 0)
    derived.push_back(
        format("outer ring: turns %.15g times as fast as the rotor; in names of "
               "lines BPFO is n omega_cage, of a point at rest",
               bearing.outer_ring_speed_ratio));
  bearing.contact_stiffness = read_stiffness(table, source, diameters, bearing, derived);
  bearing.clearance =
      read_clearance(table, source, name.clearance, derived, bearing.doubt);
  bearing.damping = table.number_or("contact_damping_s_per_m", Range::not_negative, 0);
  if (table.has("defect")) bearing.defect = read_defect(table.table("defect"), bearing);
  if (table.has("parallel")) bearing.parallel = read_parallel(table.table("parallel"));
  if (!has_count || table.has("ball_diameter_m"))
    derived.insert(derived.begin(),
                   format("%s: D = %.15g m, d_m = %.15g m",
                          has_count ? "dimensions" : name.basic.c_str(), diameters.ball,
                          diameters.pitch) +
                       (has_count ? "" : "; geometry: " + source.string("source")) +
                       (name.unused.empty() ? "" : "; not used: " + name.unused));
  return bearing;
}

}  // namespace rotor_stator
