/**
# Words of the fuzzer

What a person or a program might write by mistake. */
#pragma once

#include <string>
#include <vector>

namespace rotor_stator::tests
{

using Words = std::vector<std::string>;

/** Values of every TOML type, at and beyond the limits of each. */
const Words& odd_values();

/** What may stand where a key or a table should. */
const Words& odd_lines();

/** Values that no option takes, or that only some do. */
const Words& odd_words();

/** Where no parameter file is. */
const Words& odd_paths();

}  // namespace rotor_stator::tests
