#include "balance/gmres.hpp"

#include <cmath>

namespace rotor_stator
{

/** Gram-Schmidt, twice: the product loses its parts along the basis and becomes its column
    k+1. */
void Gmres::orthogonalise(int k)
{
  const auto known = basis_.leftCols(k + 1);
  auto h = hessenberg_.col(k);
  h.head(k + 1).noalias() = known.transpose() * product_;
  product_.noalias() -= known * h.head(k + 1);
  again_.head(k + 1).noalias() = known.transpose() * product_;
  product_.noalias() -= known * again_.head(k + 1);
  h.head(k + 1) += again_.head(k + 1);
  h[k + 1] = product_.norm();
  basis_.col(k + 1) = product_ / (h[k + 1] > 0 ? h[k + 1] : 1);
}

/** Givens rotations, the old ones and a new one, take column k to the upper triangle. */
void Gmres::rotate(int k)
{
  auto h = hessenberg_.col(k);
  for (int j = 0; j < k; ++j) {
    const double upper = cosine_[j] * h[j] + sine_[j] * h[j + 1];
    h[j + 1] = cosine_[j] * h[j + 1] - sine_[j] * h[j];
    h[j] = upper;
  }
  const double length = std::hypot(h[k], h[k + 1]);
  cosine_[k] = length > 0 ? h[k] / length : 1;
  sine_[k] = length > 0 ? h[k + 1] / length : 0;
  h[k] = length;
  right_[k + 1] = -sine_[k] * right_[k];
  right_[k] *= cosine_[k];
}

Gmres::Report Gmres::solve(const Operator& apply, const Operator& precondition,
                           const Eigen::VectorXd& b, double goal, int most_iterations,
                           Eigen::VectorXd& x)
{
  basis_.resize(b.size(), most_iterations + 1);
  hessenberg_.resize(most_iterations + 1, most_iterations);
  for (auto* vector : {&cosine_, &sine_, &again_}) vector->resize(most_iterations);
  right_.resize(most_iterations + 1);
  right_[0] = b.norm();
  basis_.col(0) = b / (right_[0] > 0 ? right_[0] : 1);
  int k = 0;
  while (k < most_iterations && std::abs(right_[k]) > goal) {
    product_ = basis_.col(k);
    precondition(product_, preconditioned_);
    apply(preconditioned_, product_);
    orthogonalise(k);
    rotate(k);
    ++k;
  }
  const double residual = std::abs(right_[k]);
  auto weights = right_.head(k);
  hessenberg_.topLeftCorner(k, k).triangularView<Eigen::Upper>().solveInPlace(weights);
  product_.noalias() = basis_.leftCols(k) * weights;
  precondition(product_, x);
  return {k, residual};
}

}  // namespace rotor_stator
