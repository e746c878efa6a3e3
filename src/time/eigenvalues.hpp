/**
# Eigenvalues of real matrices

Eigen's solver is compiled once, since each source that includes it takes ten seconds. */
#pragma once

#include <Eigen/Core>

namespace rotor_stator {

/** Eigenvalues and right eigenvectors, column by column; without `vectors` these are
    empty. Throws NoSolution when the matrix is not finite or the iteration does not
    converge. */
struct Eigensystem {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
};
Eigensystem eigensystem(const Eigen::MatrixXd& matrix, bool vectors);
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix);

}  // namespace rotor_stator
