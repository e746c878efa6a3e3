/**
# The table of the hard cases */
#pragma once

#include "output/table.hpp"

namespace rotor_stator
{

/** How every method ends on every case of a list; of `every` = n only each n-th row. */
Table hard_table(const std::string& list, int every);

}  // namespace rotor_stator
