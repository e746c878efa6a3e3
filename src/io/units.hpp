/**
# Units that a key may end in

radial_clearance_um is radial_clearance_m in another unit. */
#pragma once

#include <string>
#include <vector>

namespace rotor_stator {

/** The key as it is read. */
std::string own_key(const std::string& key);

/** A value of `key` in the unit of `own_key`. */
double in_own_unit(const std::string& key, double value);

/** "; did you mean …?" with the known key, in any of its units, that differs least from
    the one that was found; empty when none is near. */
std::string meant(const std::string& found, const std::vector<std::string>& known);

}  // namespace rotor_stator
