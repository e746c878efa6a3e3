/**
# explore response: what the machine does, speed by speed

A row for every speed, both ends included, written as soon as it is known: the motion that integration from rest settles
on or, with --direction up or down, from the motion at the speed before. */
#pragma once

#include "explore/response.hpp"

namespace rotor_stator::explore {

/** Writes the table to stdout, row by row; what is returned has all of it, for --plot and JSON. Throws BadInput,
    NoSolution where no speed has a value. */
Exploration explore_settled_response(const ResponseRequest& request);

}  // namespace rotor_stator::explore
