/**
# Hard cases (code)

Machines and speeds where a solver may fail: no clearance, hardly any damping, one ball, grazing, the
fold of a branch. The list is data/hard_cases.toml; a group there is one machine or several, at one
speed or several. Each case is put to every method, and each answer to an independent check, by the rule
that stands in the same file. */
#pragma once

#include <string>
#include <vector>

#include "io/toml_file.hpp"
#include "model/parameters.hpp"

namespace rotor_stator::hard {

/** One machine at one speed. */
struct HardCase {
  std::string name;
  Parameters machine;
  double frequency = 0;  ///< [Hz]
  double from = 0;       ///< start of its branch [Hz]; the frequency itself: a cold start
  int harmonics = 0;     ///< m
  int samples = 0;       ///< N
};

/** When an answer may be claimed, and when a claim is false. Relative errors of displacement. */
struct HardRule {
  double accuracy;  ///< the largest error that a method may state and still claim [-]
  double most_error_ratio;  ///< of what the check finds over what was stated [-]
  double least_error;       ///< below this nothing is compared [-]
  double
      most_error;  ///< more than this found by the check is false whatever was stated [-]
  double most_change;  ///< of the amplitudes of an aperiodic motion [-]
};

struct HardCases {
  HardRule rule;
  std::vector<HardCase> cases = {};
};

/** Throws BadInput for a bad list, NoSolution when a fold that it asks for is not there. */
HardCases read_hard_cases(SceneFile& file);

}  // namespace rotor_stator::hard
