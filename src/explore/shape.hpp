/**
# explore shape

The shape of a rotor given by matrices while it runs at one speed (operating deflection
shape): the orbits of its nodes along the shaft, at the same instants. The motion is that
of `explore orbit`. */
#pragma once

#include "explore/orbit.hpp"

namespace rotor_stator::explore {

struct ShapeRequest : MotionRequest {
  std::string nodes;  ///< table with z [m], x and y, degrees of freedom from 1
};

Exploration explore_shape(const ShapeRequest& request);

}  // namespace rotor_stator::explore
