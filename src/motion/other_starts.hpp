/**
# Starts for branches beside the one that is followed

Newton finds the solution that is near: other branches need other starts. At each speed
one comes from time integration, the others are random: harmonics of the size of the
clearance that fall like 1/h², from a seeded generator. */
#pragma once

#include <cstdint>
#include <random>

#include "continuation/isolated.hpp"
#include "motion/find_periodic.hpp"

namespace rotor_stator::motion {

/** Uniform in -1 … 1 from the generator's bits: the standard's distributions differ
    between libraries. */
double uniform(std::mt19937_64& generator);

struct OtherStarts {
  int speeds = 0;  ///< in the range, evenly spaced, the edges left out
  int random = 8;  ///< at each speed
  std::uint64_t seed = 1;
};

struct FoundStarts {
  std::vector<PeriodicMotion> candidates;  ///< none of them solved
  int cut_off = 0;  ///< time integrations that used up their part of the work
};

/** The starts with m harmonics in the range; the same for the same seed on every machine.
    The integrations take at most half of `budget`, in equal parts of what is left of it.
    */
FoundStarts other_starts(const Parameters& parameters, SpeedRange range, int harmonics,
                         const OtherStarts& wanted, const OperationBudget& budget = {});

}  // namespace rotor_stator::motion
