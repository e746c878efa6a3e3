/**
# Matrix Market files

The exchange format of the National Institute of Standards and Technology, as SciPy,
Octave and finite-element programs write it. Real and integer matrices are read, given by
coordinates or in full, of the kinds general, symmetric and skew-symmetric; of the last
two the file holds one triangle, either one, and the other is filled in. Entries of one
place add up. Numbers may have Fortran's D exponents. */
#pragma once

#include <Eigen/SparseCore>
#include <string>

namespace rotor_stator {

using SparseMatrix = Eigen::SparseMatrix<double>;

/** Reads a square matrix. Throws BadInput with file and line for everything that is not
    one: another kind, numbers that are missing, left over, not finite or out of range. No
    memory is asked for that the length of the file does not account for. */
SparseMatrix read_matrix(const std::string& file);

/** The text of such a file: real, general, every digit of a double. */
std::string matrix_text(const SparseMatrix& matrix);

}  // namespace rotor_stator
