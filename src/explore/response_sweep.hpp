/**
# explore response, speed by speed

A row for every speed, both ends included, written as soon as it is known: the motion that
integration from rest settles on or, with --direction up or down, from the motion at the
speed before. With --method aft and --tolerance: the solution with the harmonics that it
needs, from that at the speed before. */
#pragma once

#include "explore/response.hpp"

namespace rotor_stator::explore {

/** Speed by speed, written to stdout row by row; what is returned has all of it, for
    --plot and JSON. Throw NoSolution where no speed has a value. */
Exploration settled_response(const ResponseRequest& request);
Exploration response_to_tolerance(const ResponseTask& task);

}  // namespace rotor_stator::explore
