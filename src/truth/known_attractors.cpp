#include "truth/known_attractors.hpp"

#include <algorithm>
#include <cmath>

#include "io/errors.hpp"
#include "io/number_table.hpp"

namespace rotor_stator::truth {

std::vector<AttractorPoint> read_attractors(const std::string& file)
{
  const NumberTable table(file);
  std::vector<AttractorPoint> points;
  for (std::size_t k = 0; k < table.rows(); ++k) {
    const auto at = [&](const char* column) { return table.at(k, column); };
    const auto integer = [&](const char* column) { return static_cast<int>(at(column)); };
    const SectionJudgement judgement{static_cast<Verdict>(integer("verdict")),
                                     integer("period"),
                                     at("spread"),
                                     at("spread_k"),
                                     {at("exponent"), at("exponent_error")}};
    const State state{{{at("x_s"), at("y_s")}, {at("x_r"), at("y_r")}},
                      {{at("vx_s"), at("vy_s")}, {at("vx_r"), at("vy_r")}}};
    const Attractor attractor{
        judgement, {},
        {},        {at("amp_x_s"), at("amp_y_s"), at("amp_x_r"), at("amp_y_r")},
        state,     at("seconds")};
    points.push_back({attractor, integer("set"), at("f"),
                      static_cast<Origin>(integer("origin")), integer("starts"),
                      integer("attractor")});
  }
  return points;
}

std::vector<AttractorPoint> attractors_at(const std::vector<AttractorPoint>& all, int set,
                                          double frequency)
{
  std::vector<AttractorPoint> here;
  for (const AttractorPoint& one : all) {
    if (one.set != set || std::abs(one.frequency - frequency) > 1e-6) continue;
    if (std::ranges::find(here, one.number, &AttractorPoint::number) == here.end())
      here.push_back(one);
  }
  if (here.empty())
    throw BadInput(
        format("the table of attractors has none of set %d at %g Hz", set, frequency));
  return here;
}

motion::Motion motion_on(const AttractorPoint& point, const Parameters& machine,
                         int points_per_period, int periods)
{
  motion::Motion motion = motion::motion_along(point, machine, angular(point.frequency),
                                               points_per_period, periods);
  const std::size_t once = motion.size();
  const auto whole = static_cast<std::size_t>(periods) * points_per_period;
  for (std::size_t k = once; k < whole; ++k)
    motion.positions.push_back(motion.positions[k - once]);
  return motion;
}

SectionScene read_section_scene(SceneFile& file, const std::string& attractors)
{
  SectionScene scene{.sets = read_parameter_list(file, "parameters"),
                     .points = file.toml().integer("points", 1, 10'000),
                     .attractors = {}};
  file.toml().refuse_unknown_keys();
  for (const AttractorPoint& point : read_attractors(attractors))
    if (point.origin == Origin::up || point.origin == Origin::down)
      scene.attractors.push_back(point);
  return scene;
}

std::vector<Vec2> section_of(const AttractorPoint& point, const Parameters& machine,
                             int points)
{
  const motion::Motion motion =
      motion::motion_along(point, machine, angular(point.frequency), 4, points);
  std::vector<Vec2> section;
  for (std::size_t k = 0; k < motion.size(); k += 4)
    section.push_back(motion.positions[k].relative());
  return section;
}

namespace {

struct SectionPoint : AttractorPoint {
  Vec2 u;
};

using Point = SectionPoint;
const std::vector<Field<Point>> fields{
    {"set", "-", "data set", &Point::set},
    {"f", "Hz", "speed of rotation", &Point::frequency},
    {"origin", "-", "1 up in speed, 2 down", &Point::origin},
    {"verdict", "-", "of the motion, as in the table of attractors", &Point::verdict},
    {"exponent", "1/s", "largest Lyapunov exponent of the motion",
     [](auto& p) { return p.exponent.value; }},
    {"exponent_error", "1/s", "its standard error",
     [](auto& p) { return p.exponent.error; }},
    {"u_x", "m", "x_r - x_s at phase 0", [](auto& p) { return p.u.x; }},
    {"u_y", "m", "y_r - y_s at phase 0", [](auto& p) { return p.u.y; }}};

}  // namespace

Table section_table(const SectionScene& scene,
                    const std::vector<std::vector<Vec2>>& sections)
{
  Table table("Poincare sections of the attractors, up and down in speed", fields);
  for (const Parameters& machine : scene.sets) describe(table, machine);
  table.note(format(
      "modelled: rk4 from the states of the table of attractors; %d points, k of a kT-periodic motion",
      scene.points));
  for (std::size_t k = 0; k < sections.size(); ++k)
    for (const Vec2 u : sections[k]) table.row(fields, {scene.attractors[k], u});
  return table;
}

}  // namespace rotor_stator::truth
