#include "scenes/known_attractors.hpp"

#include <algorithm>
#include <cmath>

#include "model/errors.hpp"
#include "model/number_table.hpp"

namespace rotor_stator
{

namespace
{

State state_in(const NumberTable& table, std::size_t row)
{
  const auto at = [&](const char* column) { return table.at(row, column); };
  return {.position = {{at("x_s"), at("y_s")}, {at("x_r"), at("y_r")}},
          .velocity = {{at("vx_s"), at("vy_s")}, {at("vx_r"), at("vy_r")}}};
}

}  // namespace

std::vector<KnownAttractor> read_attractors(const std::string& file)
{
  const NumberTable table(file);
  std::vector<KnownAttractor> attractors;
  for (std::size_t k = 0; k < table.rows(); ++k)
    attractors.push_back(
        {.set = static_cast<int>(table.at(k, "set")),
         .frequency = table.at(k, "f"),
         .origin = static_cast<Origin>(table.at(k, "origin")),
         .number = static_cast<int>(table.at(k, "attractor")),
         .verdict = static_cast<Verdict>(table.at(k, "verdict")),
         .period = static_cast<int>(table.at(k, "period")),
         .exponent = {table.at(k, "exponent"), table.at(k, "exponent_error")},
         .state = state_in(table, k)});
  return attractors;
}

std::vector<KnownAttractor> attractors_at(const std::vector<KnownAttractor>& all, int set,
                                          double frequency)
{
  std::vector<KnownAttractor> here;
  for (const KnownAttractor& one : all) {
    if (one.set != set || std::abs(one.frequency - frequency) > 1e-6) continue;
    if (std::none_of(here.begin(), here.end(),
                     [&](const auto& other) { return other.number == one.number; }))
      here.push_back(one);
  }
  if (here.empty())
    throw BadInput(
        text("the table of attractors has none of set %d at %g Hz", set, frequency));
  return here;
}

Motion motion_on(const KnownAttractor& attractor, const Parameters& parameters,
                 int points_per_period, int periods)
{
  const TimeStepper stepper =
      make_stepper(parameters, angular(attractor.frequency),
                   {.method = "rk4", .intervals_per_period = points_per_period});
  const long own = attractor.closed() ? attractor.period : periods;
  State state = attractor.state;
  Motion motion = recorded(stepper, points_per_period, state, 0, own);
  const std::size_t once = motion.size();
  const auto whole = static_cast<std::size_t>(periods) * points_per_period;
  for (std::size_t k = once; k < whole; ++k)
    motion.positions.push_back(motion.positions[k - once]);
  return motion;
}

std::vector<Vec2> section_of(const KnownAttractor& attractor,
                             const Parameters& parameters, int points)
{
  constexpr int intervals = 4;
  const TimeStepper stepper =
      make_stepper(parameters, angular(attractor.frequency),
                   {.method = "rk4", .intervals_per_period = intervals});
  const int own = attractor.closed() ? attractor.period : points;
  std::vector<Vec2> section;
  State state = attractor.state;
  for (long period = 0; period < own; ++period) {
    section.push_back(state.position.relative());
    if (period + 1 == own) break;
    for (long k = 0; k < intervals; ++k) stepper.advance(period * intervals + k, state);
  }
  return section;
}

}  // namespace rotor_stator
