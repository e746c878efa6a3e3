/**
# A branch in a file

A table with all coefficients of each point and 17 digits, so that a branch that was
followed once can be gone on with. The header says what the branch belongs to: the
machine's values, m, N, and the direction of the walk. */
#pragma once

#include <optional>

#include "continuation/arc_length.hpp"

namespace rotor_stator::explore {

struct SavedBranch {
  int harmonics, samples;  ///< m and N
  bool upwards;            ///< the walk led to higher speeds
  /** With the speed's part of the tangent alone, none corrected yet. */
  std::vector<BranchPoint> points;
};

/** The text of a file with the branches of one machine, numbered from 1. */
std::string branch_text(const Parameters& parameters, int harmonics, int samples,
                        bool upwards, const std::vector<Branch>& branches);

/** Reads branch `number`. Throws BadInput with file and line when the file is not one of
    these, is of another machine, is cut off, or has no such branch. */
SavedBranch read_branch(const std::string& file, const Parameters& parameters,
                        int number);

/** The point of the branch nearest to the speed `frequency` [Hz], with the direction of
    the branch there as its tangent; the last point without one. */
BranchPoint restart_point(const SavedBranch& branch, std::optional<double> frequency,
                          const Curve& curve);

}  // namespace rotor_stator::explore
