/**
# Springs, dampers and a stop beside the balls

Between rotor and stator, at the bearing, there may stand more than balls: a seal, a
squeeze film, a retainer that the rotor meets after a gap. For the relative displacement u
[m] they press the stator by

$$F = k_3 |u|^2 u + k_{stop}\,(|u| - g)_+ \frac{u}{|u|} + K(\Omega)\,u
  + C(\Omega)\,\dot u,$$

without friction. K and C, 2 × 2, are numbers or depend on the rotor's speed Ω by a table,
linear between its rows and constant beyond them. In the machine's file:

    [bearing.parallel]
    cubic_stiffness_N_per_m3 = 1e14
    stop_stiffness_N_per_m = 1e8
    stop_gap_m = 5e-5
    stiffness_N_per_m = [0, 2e5, -2e5, 0]     # k_xx, k_xy, k_yx, k_yy
    damping_N_s_per_m = [50, 0, 0, 50]
    coefficients = "seal.tsv"                 # instead of the last two

Each may be left out, and the stiffness of a stop needs its gap. The columns of the
coefficients' file are `f` [Hz] and k_xx … c_yy; those that are missing are 0. A table
[rotor.ground] or [stator.ground] has the same keys: there u is the displacement of that
body, and F presses it back. */
#pragma once

#include "model/parameters.hpp"

namespace rotor_stator {

/** ∂F/∂u [N/m] or ∂F/∂u̇ [N s/m]; of balls without damping symmetric. */
struct Slopes2 {
  double xx, xy, yx, yy;

  Eigen::Matrix2d matrix() const { return Eigen::Matrix2d{{xx, xy}, {yx, yy}}; }
};

/** Force on the stator [N] and its derivative. */
struct ElasticReaction {
  Vec2 force;
  Slopes2 stiffness;  ///< ∂F/∂u [N/m]
};
struct BearingReaction : ElasticReaction {
  Slopes2 damping = {};   ///< ∂F/∂u̇ [N s/m]
  Vec2 speed_slope = {};  ///< dF/dω along a motion u(φ), φ = ωt [N s]
};

/** Throws BadInput with file, line and key. */
ParallelElements read_parallel(StrictToml table);

/** The `#` lines of what is there, which begin with `name`. */
void describe_parallel(Table& table, const std::string& name,
                       const ParallelElements& elements);

/** The largest stiffness [N/m] of all together under a load [N] that moves the rotor by
    at most `length` [m], and their largest damping [N s/m]: for the sizes of steps. */
double largest_stiffness(const ParallelElements& elements, double load, double length);
double largest_damping(const ParallelElements& elements);

/** The elements at one speed of the rotor [rad/s]. */
class Parallel {
public:
  Parallel(const ParallelElements& elements, double rotor_speed);

  /** Adds force and derivatives; `omega` [rad/s] of the base period, 0 if not known. */
  void add(Vec2 u, Vec2 rate, double omega, BearingReaction& sum) const;

  /** These alone. */
  BearingReaction reaction(Vec2 u, Vec2 rate) const
  {
    BearingReaction sum{};
    add(u, rate, 0, sum);
    return sum;
  }

private:
  double cubic_, stop_stiffness_, stop_gap_;
  Coefficients now_, slope_;  ///< per rad/s
  double rotor_speed_;
};

}  // namespace rotor_stator
