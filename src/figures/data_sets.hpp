/**
# Table 1 with what the paper leaves out */
#pragma once

#include "model/parameters.hpp"

namespace rotor_stator::figures {

Table data_set_table(const std::vector<Parameters>& machines);

/** The row of data set `set`; its bodies moving as one resonate at `joint` [Hz]. */
void add_data_set(Table& table, int set, const Parameters& machine, double joint);

}  // namespace rotor_stator::figures
