#include "model/base_period.hpp"

#include <algorithm>
#include <cmath>

#include "io/errors.hpp"

namespace rotor_stator {

std::string BasePeriod::words() const
{
  if (kind == Kind::turns) return format("turns %d", turns);
  return kind == Kind::turn ? "turn" : kind == Kind::passing ? "passing" : "two";
}

int turns_to_repeat(const std::vector<Bearing>& bearings)
{
  for (int q = 1; q <= 8; ++q)
    if (std::ranges::all_of(bearings, [q](Bearing bearing) {
          bearing.cage_speed_ratio *= q;
          return has_rotation_period(bearing);
        }))
      return q;
  return 0;
}

/** Whether a passing of the first bearing is a whole number of those of all others. */
static bool has_passing(const std::vector<Bearing>& bearings)
{
  const double first = passages_per_turn(bearings.front());
  return first > 0 && std::ranges::all_of(bearings, [first](const Bearing& bearing) {
           const double ratio = passages_per_turn(bearing) / first;
           return !bearing.is_damaged(Defect::Surface::ball) &&
                  std::abs(ratio - std::round(ratio)) < 1e-9;
         });
}

BasePeriod base_period(const Parameters& parameters)
{
  using Kind = BasePeriod::Kind;
  const std::vector<Bearing> bearings = bearings_of(parameters);
  if (!turns_visibly(parameters) && has_passing(bearings))
    return {Kind::passing, 1, passages_per_turn(parameters.bearing)};
  const int q = turns_to_repeat(bearings);
  if (q == 0) return {Kind::two, 1, 1};
  return {q == 1 ? Kind::turn : Kind::turns, q, 1.0 / q};
}

/** The machine without unbalance, where only the passing balls move anything: its base
    frequency is n ω_cage. */
static Parameters over_passage(Parameters parameters)
{
  const double ratio = parameters.speed_ratio = 1 / passages_per_turn(parameters.bearing);
  change_joints(parameters, [ratio](Bearing& joint) {
    joint.parallel.speed_ratio = ratio;
    joint.cage_speed_ratio *= ratio;
  });
  parameters.bearing.cage_speed_ratio = 1.0 / parameters.bearing.balls;
  return parameters;
}

Based over(const BasePeriod& base, const Parameters& parameters, double rotor_speed)
{
  const double omega = rotor_speed * base.per_turn;
  if (base.kind == BasePeriod::Kind::passing) return {over_passage(parameters), omega};
  return {over_turns(parameters, base.turns), omega};
}

}  // namespace rotor_stator
