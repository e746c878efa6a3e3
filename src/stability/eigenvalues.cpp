#include "stability/eigenvalues.hpp"

#include <Eigen/Eigenvalues>

#include "io/errors.hpp"

namespace rotor_stator {

namespace {

Eigen::EigenSolver<Eigen::MatrixXd> solved(const Eigen::MatrixXd& matrix, bool vectors)
{
  if (!matrix.allFinite())
    throw NoSolution("the eigenvalues of a matrix that is not finite");
  Eigen::EigenSolver<Eigen::MatrixXd> solver(matrix, vectors);
  if (solver.info() != Eigen::Success)
    throw NoSolution("the eigenvalues of a matrix cannot be computed");
  return solver;
}

}  // namespace

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix)
{
  return solved(matrix, false).eigenvalues();
}

Eigensystem eigensystem(const Eigen::MatrixXd& matrix)
{
  const auto solver = solved(matrix, true);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace rotor_stator
