#include "studies/clearance_stiffness.hpp"

#include <algorithm>
#include <cmath>

#include "io/errors.hpp"
#include "motion/contact.hpp"

namespace rotor_stator::studies {

GridScene read_grid_scene(SceneFile& file)
{
  StrictToml& toml = file.toml();
  GridScene scene{.base = read_parameters(file, "parameters"),
                  .harmonics = toml.integer("harmonics", 1, 256),
                  .frequencies = file.speed_range("speeds_hz")};
  StrictToml grid = toml.table("grid");
  const int clearances = grid.integer("clearances", 2, 1000);
  const double widest = grid.number("largest_clearance_m", Range::positive);
  const int stiffnesses = grid.integer("stiffnesses", 2, 1000);
  const double low = grid.number("least_stiffness_N_per_m1p5", Range::positive);
  const double high = grid.number("largest_stiffness_N_per_m1p5", Range::positive);
  toml.refuse_unknown_keys();
  for (int j = 0; j < stiffnesses; ++j)
    for (int k = 0; k < clearances; ++k) {
      Parameters& machine = scene.machines.emplace_back(scene.base);
      machine.bearing.clearance = widest * k / (clearances - 1);
      machine.bearing.contact_stiffness =
          low * std::pow(high / low, j / (stiffnesses - 1.0));
    }
  return scene;
}

GridPoint summary(const Parameters& machine, const std::vector<PeriodicMotion>& sweep)
{
  GridPoint point{.clearance = machine.bearing.clearance,
                  .contact_stiffness = machine.bearing.contact_stiffness};
  std::vector<CurvePoint> curve;
  for (const PeriodicMotion& solution : sweep) {
    if (!solution.found()) {
      ++point.missed;
      continue;
    }
    const double frequency = solution.omega / angular(1);
    const motion::Motion motion = motion::motion_of(solution.bodies, 128);
    curve.push_back({frequency, half_peak_to_peak(motion)[2]});
    for (const auto& forces : motion::contact_evolution(machine, motion).ball_force)
      for (double force : forces)
        point.largest_force = std::max(point.largest_force, force);
    if (motion::contact_share(machine, motion) < 1) {
      if (point.f_loss_first < 0) point.f_loss_first = frequency;
      point.f_loss_last = frequency;
    }
  }
  if (!curve.empty()) point.peak = refined_peak(curve);
  return point;
}

namespace {

using Point = GridPoint;
const std::vector<Field<Point>> fields{
    {"delta", "m", "radial clearance", &Point::clearance},
    {"K_H", "N/m^1.5", "contact stiffness", &Point::contact_stiffness},
    {"f_peak", "Hz", "speed of the largest x_r; -1 without any solution",
     [](auto& p) { return p.peak.frequency; }},
    {"amp_peak", "m", "half peak-to-peak of x_r there",
     [](auto& p) { return p.peak.amplitude; }},
    {"f_loss_first", "Hz", "first speed at which contact is lost; -1 when never",
     &Point::f_loss_first},
    {"f_loss_last", "Hz", "last such speed; -1 when never", &Point::f_loss_last},
    {"largest_force", "N", "largest force on one ball over all speeds",
     &Point::largest_force},
    {"missed", "-", "speeds without a solution", &Point::missed}};

}  // namespace

Table grid_table(const GridScene& scene, const std::vector<std::vector<Point>>& points)
{
  Table table("Clearance against contact stiffness", fields);
  describe(table, scene.base);
  table.note(format("modelled: sweeps up, m = %d, %zu speeds from %g to %g Hz",
                    scene.harmonics, scene.frequencies.size(), scene.frequencies.front(),
                    scene.frequencies.back()));
  for (const auto& of_machine : points)
    for (const Point& point : of_machine) table.row(fields, point);
  return table;
}

}  // namespace rotor_stator::studies
