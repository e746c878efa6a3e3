/**
# A bearing from the catalogue

A catalogue gives a designation, a diametral clearance and perhaps ball and pitch
diameter; the model wants the cage's speed ratio, the radial clearance and the contact
stiffness. Each of them has several ways to be given, and exactly one is taken:

- balls n: `balls`, or `designation`;
- cage ω_cage/ω: `cage_speed_ratio`, or both radii (Eq. 3), or `ball_diameter_m` and
  `pitch_diameter_m` with (1 - D/d_m)/2, or `designation`;
- radial clearance δ: `radial_clearance_m`, or half of `diametral_clearance_m`, or half of
  the middle of the range of the class `internal_clearance`, of a designation that names
  none CN, the normal one;
- stiffness K_H: `contact_stiffness_N_per_m1p5`, or Hertz's from `inner_groove_ratio`,
  `outer_groove_ratio`, `youngs_modulus_Pa` and `poissons_ratio`, or `designation`; with
  another exponent `contact_exponent` and `contact_stiffness_N_per_mn`.

These may be added: `contact_angle_rad`, `outer_ring_speed_ratio`,
`contact_damping_s_per_m`, and a table `defect` with `surface`
("outer_race", "inner_race" or "ball"), `depth_m`, `width_rad`, the place `angle_rad` of
its middle, and for a ball its number `ball`; and a table `parallel` (parallel.hpp).

Designations and classes of clearance are those of data/bearings/deep_groove.toml. Maker,
seals and cage may stand in a designation; the class of clearance in it counts. */
#pragma once

#include <string>
#include <vector>

#include "io/toml_file.hpp"
#include "model/parameters.hpp"

namespace rotor_stator {

/** Ways to give the clearance, and the stiffness beside a designation. */
extern const Ways clearance_ways, own_stiffness_ways;

/** The table [bearing] of a machine. What a key of a catalogue gave is said in `derived`,
    lines for headers. Throws BadInput for a value given in two ways, or in none. */
Bearing read_bearing(StrictToml table, std::vector<std::string>& derived);

/** Events per turn of the inner ring, the contacts rolling. */
struct KinematicOrders {
  double cage;   ///< FTF, ω_cage/ω
  double spin;   ///< BSF, of a ball about itself, seen from the cage
  double outer;  ///< BPFO, balls passing a point of the outer race
  double inner;  ///< BPFI, the same for the inner race
};
KinematicOrders kinematic_orders(const Bearing& bearing);

}  // namespace rotor_stator
