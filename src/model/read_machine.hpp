/**
# Reading a machine of any kind

Two masses, or bodies of which at least one is given by the `matrices` of a folder:
`M.mtx` and `K.mtx`, if there are `C.mtx` and `G.mtx` (Matrix Market). What a body's file
may say beside them is in paper/guide.md. */
#pragma once

#include "model/parameters.hpp"

namespace rotor_stator {

/** Speeds [Hz], harmonics and places of the rotor (columns x and y, degrees of freedom
    from 1) at which the coordinates of large bodies must be right. */
struct ModelRange {
  double from = 1, to = 100;
  int harmonics = 64;
  const NumberTable* nodes = nullptr;
  int largest = 80;  ///< degrees of freedom of a body that is not reduced
};

/** For what is asked of the linear machine only, which has no small steps to take. */
constexpr int largest_linear = 400;

/** Reads a parameter file of any machine. With `matrices` several [[bearing]] may stand
    in it. Throws BadInput. */
Parameters read_machine(StrictToml root, const ModelRange& asked = {});

}  // namespace rotor_stator
