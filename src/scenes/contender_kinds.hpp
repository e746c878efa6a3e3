/**
# The three kinds of contenders */
#pragma once

#include "scenes/contender.hpp"

namespace rotor_stator
{

Contender aft_contender(const Task& task, const Setting& setting);
Contender time_contender(const Task& task, const Setting& setting);
Contender shooting_contender(const Task& task, const Setting& setting);

}  // namespace rotor_stator
