#include "time/eigenvalues.hpp"

#include <Eigen/Eigenvalues>

#include "io/errors.hpp"

namespace rotor_stator {

Eigensystem eigensystem(const Eigen::MatrixXd& matrix, bool vectors)
{
  if (!matrix.allFinite())
    throw NoSolution("the eigenvalues of a matrix that is not finite");
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(matrix, vectors);
  if (solver.info() != Eigen::Success)
    throw NoSolution("the eigenvalues of a matrix cannot be computed");
  return {solver.eigenvalues(), vectors ? solver.eigenvectors() : Eigen::MatrixXcd()};
}

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix)
{
  return eigensystem(matrix, false).values;
}

}  // namespace rotor_stator
