/**
# The tables of cost: work against precision, equal error, growth */
#pragma once

#include "output/table.hpp"
#include "scenes/cost_growth.hpp"
#include "scenes/equal_error.hpp"
#include "scenes/work_precision.hpp"

namespace rotor_stator
{

Table work_precision_table(const WorkPrecisionScene& scene);
Table equal_error_table(const EqualErrorScene& scene);
Table cost_growth_table(const CostGrowthScene& scene);

}  // namespace rotor_stator
