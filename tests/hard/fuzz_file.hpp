/**
# Random parameter files */
#pragma once

#include "hard/fuzz_random.hpp"

namespace rotor_stator::tests
{

/** A legal machine: near data set 1, or with some values extreme. */
std::string legal_file(Dice& dice, bool extreme);

/** A good file with one to three things wrong with it: a value, a key, a table, or bytes. */
std::string spoilt_file(Dice& dice);

}  // namespace rotor_stator::tests
