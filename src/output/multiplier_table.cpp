#include "output/multiplier_table.hpp"

#include <algorithm>
#include <cmath>

#include "model/errors.hpp"

namespace rotor_stator
{

namespace
{

const std::vector<Column> columns{
    {"set", "-", "data set"},
    {"f", "Hz", "speed of rotation"},
    {"m", "-", "harmonics of the solution"},
    {"found", "-", "1 if there is a solution with multipliers"},
    {"largest", "-", "modulus of the largest multiplier; -1 if not found"},
    {"stable", "-", "1 stable, 0 unstable, -1 within the uncertainty or not found"},
    {"change", "-", "of a multiplier at the last refinement, over max(1, modulus); -1"},
    {"liouville", "-", "relative error of the product of all eight; -1"},
    {"hill_few", "-", "largest modulus by Hill's method, fewer harmonics; -1 not asked"},
    {"hill_many", "-", "the same with more harmonics; -1 not asked"},
    {"hill_difference", "-", "of the latter to `largest`, over max(1, modulus); -1"}};

std::vector<Cell> row_of(const MultiplierPoint& p)
{
  if (!p.found) return {p.set, p.frequency, p.harmonics, 0, -1, -1, -1, -1, -1, -1, -1};
  const double largest = p.floquet.largest();
  const bool asked = p.hill[1] >= 0;
  return {p.set,
          p.frequency,
          p.harmonics,
          1,
          largest,
          p.floquet.stable_number(),
          p.floquet.change,
          p.floquet.liouville,
          p.hill[0],
          p.hill[1],
          asked ? std::abs(p.hill[1] - largest) / std::max(1.0, largest) : -1};
}

}  // namespace

Table multiplier_table(const MultiplierScene& scene)
{
  Table table("Floquet multipliers and what checks them", columns);
  for (const Parameters& parameters : scene.sets) table.describe(parameters);
  table.note(
      text("modelled: disturbances along harmonic balance; Hill's method with %d and %d "
           "harmonics from %g Hz",
           scene.hill_harmonics[0], scene.hill_harmonics[1], scene.hill_from));
  for (const MultiplierPoint& point : compute_multipliers(scene))
    table.row(row_of(point));
  return table;
}

}  // namespace rotor_stator
