#include "balance/linear_solver.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace rotor_stator {

/** Gram-Schmidt, twice: the product loses its parts along the basis and becomes its
    column k+1. */
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

namespace {

/** Past this share of all harmonics the dense block takes them all. */
constexpr double most_low_share = 0.8;

/** Above so many harmonics the mean stiffness is near enough, and a larger block costs
    more than it saves. */
constexpr int most_low = 128;

/** The dense block and its factors stay below 0.3 GB. */
constexpr int most_low_unknowns = 4200;

/** Up to this many unknowns new factors of all cost less than the iterations of GMRES
    that they save. */
constexpr Eigen::Index most_direct_unknowns = 130;

constexpr int most_iterations = 80;

/** More than this and the factors are made anew. */
constexpr int many_iterations = 25;

int largest_low(const Balance& balance)
{
  return std::min(balance.harmonics().count(),
                  (most_low_unknowns / balance.problem().dofs - 1) / 2);
}

}  // namespace

void BalanceSolver::factor(const Eigen::VectorXd& x, double omega)
{
  const int two = 2 * balance_.problem().dofs, all = balance_.harmonics().count();
  low_ = all;
  if (!is_dense_ && all > least_low_ && balance_.unknowns() > most_direct_unknowns) {
    low_ = std::min(balance_.highest_coupled(x, omega), most_low);
    low_ = std::max(least_low_, low_);
    if (low_ >= most_low_share * all) low_ = all;
  }
  low_ = std::min(low_, largest_low(balance_));
  balance_.jacobian(x, omega, low_, jacobian_);
  factors_.compute(jacobian_);
  balance_.diagonal_blocks(x, omega, low_ + 1, high_inverses_);
  for (Eigen::Index k = 0; k < high_inverses_.cols(); k += two) {
    const RealBlock block = high_inverses_.middleCols(k, two);
    high_inverses_.middleCols(k, two) = block.inverse();
  }
  is_factored_ = true;
  ++factorisations_;
}

void BalanceSolver::precondition(const Eigen::VectorXd& r, Eigen::VectorXd& z) const
{
  z.resize(r.size());
  const Eigen::Index low = jacobian_.rows();
  z.head(low) = factors_.solve(r.head(low));
  with_dofs(balance_.problem().dofs, [&](auto dofs) {
    constexpr int two = 2 * dofs;
    using Pair = Eigen::Matrix<double, two, 1>;
    using Inverse = Eigen::Map<const Eigen::Matrix<double, two, two>>;
    for (Eigen::Index k = 0; low + k < r.size(); k += two)
      Eigen::Map<Pair>(z.data() + low + k) =
          Inverse(&high_inverses_(0, k)) * Eigen::Map<const Pair>(r.data() + low + k);
  });
}

void BalanceSolver::refresh()
{
  if (balance_.unknowns() <= most_direct_unknowns) is_factored_ = false;
}

Solved BalanceSolver::solve(const Eigen::VectorXd& x, double omega,
                            const Eigen::VectorXd& b, double goal, Eigen::VectorXd& s)
{
  const bool are_new = !is_factored_;
  if (are_new) factor(x, omega);
  const Eigen::Index n = b.size(), dense = jacobian_.rows();
  if (dense == n && (are_new || n <= most_direct_unknowns)) {
    s = factors_.solve(b);
    return are_new ? Solved::directly : Solved::by_old_factors;
  }
  const auto low = static_cast<double>(dense), all = static_cast<double>(n);
  int known = 0;  // those that the next one is made orthogonal to, twice
  const auto apply = [&](const Eigen::VectorXd& v, Eigen::VectorXd& product) {
    balance_.spend(1.5 * low * low + 5.0 * all * ++known);
    balance_.apply_jacobian(x, omega, v, product);
  };
  const auto report = gmres_.solve(
      std::ref(apply),  // a copy would be allocated
      [&](const Eigen::VectorXd& v, Eigen::VectorXd& z) { precondition(v, z); }, b, goal,
      most_iterations, s);
  iterations_ += report.iterations;
  /** Where new factors need as many, age is not the reason. */
  if (are_new) fresh_iterations_ = report.iterations;
  const bool is_solved = report.residual <= goal;
  is_factored_ =
      is_solved && report.iterations <= std::max(many_iterations, 2 * fresh_iterations_);
  if (is_solved || (are_new && low_ >= largest_low(balance_))) return Solved::iteratively;
  if (are_new) least_low_ = 2 * low_;
  return solve(x, omega, b, goal, s);
}

}  // namespace rotor_stator
