/**
# explore spectrum

The lines of one motion, their amplitudes and their names, by any method. */
#pragma once

#include "explore/orbit.hpp"

namespace rotor_stator::explore {

/** Of a spectrum, and of the waterfall of a branch or a run-up. */
extern const std::vector<Column> line_columns;

/** Those of a motion, as it was found with them or read from its record. */
motion::Lines lines_of(const FoundMotion& found);

/** The rows of a motion at the speed `frequency` [Hz], down to `smallest` of its largest
    line; names have k_cage up to n `passages`. False where no line is above rounding. */
bool add_lines(Table& table, const std::vector<Bearing>& bearings, double frequency,
               motion::Lines all, int passages, double smallest);

Exploration explore_spectrum(const MotionRequest& request);

}  // namespace rotor_stator::explore
