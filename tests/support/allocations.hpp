/**
# Counting heap allocations

The counter replaces malloc and its kin in a test program: operator new, Eigen and FFTW all end
there. Under the address sanitizer, which has its own, nothing is counted. */
#pragma once

namespace rotor_stator::tests {

/** Whether allocations are counted at all. */
bool counts_allocations();

/** Allocations of this thread so far. */
long allocations();

}  // namespace rotor_stator::tests
