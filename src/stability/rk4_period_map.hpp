/**
# The period map by classical Runge-Kutta, with its derivative

One period in S equal steps: 4S evaluations of Eq. 7 and no sine or cosine. The derivative
is that of the map as it is computed: each stage of the variational equations takes the
bearing's stiffness at the same stage of the state. */
#pragma once

#include "integration/rk4.hpp"
#include "stability/disturbances.hpp"
#include "stability/period_map.hpp"

namespace rotor_stator
{

class Rk4PeriodMap
{
public:
  /** The fewest steps per period not longer than `longest_step` [s]. */
  Rk4PeriodMap(const Parameters& parameters, double omega, double longest_step);

  /** The state one period after `start` at phase 0. */
  State end(const State& start);

  /** The same with its derivative. */
  PeriodMap map(const State& start);

  /** Of the bearing's force, with or without its stiffness. */
  long evaluations() const { return rk4_.evaluations() + evaluations_; }

private:
  struct Variation {
    Disturbances q, v;
  };
  struct Slopes {
    Bodies state;
    Disturbances disturbances;
  };

  Slopes acceleration(const State& state, const Variation& variation,
                      const Rk4::Angles& at) const;
  void step(const Rk4::Angles* angles, State& state, Variation& variation) const;

  Rk4 rk4_;
  RotorStator system_;
  DisturbanceRates rates_;
  long evaluations_ = 0;
};

}  // namespace rotor_stator
