/**
# Table 1 with what the paper leaves out (code)

The columns of the table, and the speeds that follow from the parameters alone. */
#pragma once

#include "model/parameters.hpp"

namespace rotor_stator::figures {

Table data_set_table(const std::vector<Parameters>& machines);

/** Speeds [Hz] that follow from the parameters alone; -1 where there is none. */
struct Landmarks {
  double joint;          ///< resonance of both bodies moving as one
  double loss;           ///< gravity and unbalance load a rigid joint equally
  double gravity_again;  ///< the next such speed
};

/** The row of data set `set`. */
void add_data_set(Table& table, int set, const Parameters& machine,
                  const Landmarks& speeds);

}  // namespace rotor_stator::figures
