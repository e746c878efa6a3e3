/**
# Eigenvalues of real matrices

Eigen's solver, compiled once: it takes ten seconds in every source that asks for it. */
#pragma once

#include <Eigen/Core>

namespace rotor_stator {

/** Throws NoSolution when the matrix is not finite or the iteration does not converge. */
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix);

/** The same with the right eigenvectors, column by column. */
struct Eigensystem {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
};
Eigensystem eigensystem(const Eigen::MatrixXd& matrix);

}  // namespace rotor_stator
