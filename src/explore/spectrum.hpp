/**
# explore spectrum

The lines of one motion, their amplitudes and their names, by any method. */
#pragma once

#include "explore/orbit.hpp"

namespace rotor_stator::explore {

struct SpectrumRequest : MotionRequest {
  std::optional<std::string> plot;  ///< file
};

/** Throws BadInput for options that contradict each other, NoSolution when nothing was found. */
Exploration explore_spectrum(const SpectrumRequest& request);

}  // namespace rotor_stator::explore
