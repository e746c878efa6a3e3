/**
# The motions of a sweep */
#pragma once

#include <optional>
#include <vector>

#include "scenes/motion.hpp"

namespace rotor_stator
{

/** The motion at each speed of a sweep; none where no solution was found. */
using Motions = std::vector<std::optional<Motion>>;

}  // namespace rotor_stator
