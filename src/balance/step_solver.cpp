#include "balance/step_solver.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace rotor_stator {

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

namespace {

/** Harmonics whose coupling through the contact is weaker than this leave the dense block. */
constexpr double weak_coupling = 1;

/** Past this share of all harmonics the dense block takes them all. */
constexpr double most_low_share = 0.8;

/** A dense block of more harmonics costs more than the equations in time. */
constexpr int most_dense = 32;

/** What a step by them may leave, of what another iterated step may: it is then as good as a dense one, after which
    Newton's error is that of δ₂². */
constexpr double in_time_goal = 0.01;

/** Of the residual: an answer by them that leaves more is taken further by GMRES. */
constexpr double good_in_time = 0.3;

/** The dense block and its factors stay below 0.3 GB. */
constexpr int most_low_unknowns = 4200;

/** Up to this many unknowns, new factors of all cost less than the iterations of GMRES that they save. */
constexpr Eigen::Index most_chord_unknowns = 130;

constexpr int most_linear_iterations = 80;

/** More than this and the factors are made anew. */
constexpr int many_linear_iterations = 25;

int largest_low(const Balance& balance)
{
  return std::min(balance.harmonics().count(),
                  (most_low_unknowns / balance.problem().dofs - 1) / 2);
}

}  // namespace

void StepSolver::divide(std::vector<std::vector<int>> parts)
{
  for (std::vector<int>& places : parts) parts_.push_back({std::move(places), {}});
}

void StepSolver::factor_parts(Balance& balance, const Eigen::VectorXd& x, double omega)
{
  const int d = balance.problem().dofs;
  for (Part& part : parts_) {
    part.unknowns.clear();
    for (int h : part.places)
      for (int k = 0; k < (h == 0 ? d : 2 * d); ++k)
        part.unknowns.push_back((h == 0 ? 0 : (2 * h - 1) * d) + k);
    balance.jacobian(x, omega, part.places, low_jacobian_);
    part.factors.compute(low_jacobian_.cast<float>());
  }
  is_complete_ = parts_.size() == 1;
  factored_ = true;
  ++factorisations_;
}

void StepSolver::factor(Balance& balance, const Eigen::VectorXd& x, double omega)
{
  if (!parts_.empty()) return factor_parts(balance, x, omega);
  const int m = balance.harmonics().count(), two = 2 * balance.problem().dofs;
  low_ = m;
  if (!holds_ && m > least_low_ && balance.unknowns() > most_chord_unknowns) {
    low_ = std::max(least_low_, balance.highest_coupled(x, omega, weak_coupling));
    if (low_ >= most_low_share * m) low_ = m;
  }
  low_ = std::min(low_, largest_low(balance));
  in_time_ = balance.problem().bodies && !holds_ && !stalls_in_time_ && low_ > most_dense;
  is_complete_ = low_ == m && !in_time_;
  if (in_time_) {
    balance.factor_in_time(x, omega);
    factored_ = true;
    ++factorisations_;
    return;
  }
  balance.jacobian(x, omega, low_, low_jacobian_);
  low_factors_.compute(low_jacobian_);
  balance.diagonal_blocks(x, omega, low_ + 1, high_inverses_);
  for (Eigen::Index k = 0; k < high_inverses_.cols(); k += two) {
    const RealBlock block = high_inverses_.middleCols(k, two);
    high_inverses_.middleCols(k, two) = block.inverse();
  }
  factored_ = true;
  ++factorisations_;
}

void StepSolver::precondition(Balance& balance, const Eigen::VectorXd& r,
                              Eigen::VectorXd& z) const
{
  if (in_time_) return balance.solve_in_time(r, z);
  const auto low = low_jacobian_.rows();
  z.resize(r.size());
  for (const Part& part : parts_) {
    const Eigen::VectorXf own = r(part.unknowns).cast<float>();
    z(part.unknowns) = part.factors.solve(own).cast<double>();
  }
  if (!parts_.empty()) return;
  z.head(low) = low_factors_.solve(r.head(low));
  with_dofs(static_cast<int>(high_inverses_.rows() / 2), [&](auto dofs) {
    constexpr int two = 2 * dofs;
    using Pair = Eigen::Matrix<double, two, 1>;
    using Block = Eigen::Map<const Eigen::Matrix<double, two, two>>;
    for (Eigen::Index k = 0; low + k < r.size(); k += two)
      Eigen::Map<Pair>(z.data() + low + k) =
          Block(&high_inverses_(0, k)) * Eigen::Map<const Pair>(r.data() + low + k);
  });
}

void StepSolver::iterate(Balance& balance, const Eigen::VectorXd& x, double omega,
                         const Eigen::VectorXd& residual, double goal, bool are_new,
                         Eigen::VectorXd& step)
{
  const auto n = static_cast<double>(residual.size());
  const auto low = in_time_ ? 0.0 : static_cast<double>(low_jacobian_.rows());
  int known = 0;  // those that the next one is made orthogonal to, twice
  const auto apply = [&](const Eigen::VectorXd& v, Eigen::VectorXd& product) {
    balance.spend(1.5 * low * low + 5.0 * n * ++known);
    balance.apply_jacobian(x, omega, v, product);
  };
  if (in_time_) goal *= in_time_goal;
  const auto report = gmres_.solve(
      std::ref(apply),  // a copy would be allocated
      [&](const Eigen::VectorXd& v, Eigen::VectorXd& z) { precondition(balance, v, z); },
      residual, goal, most_linear_iterations, step);
  step = -step;
  linear_iterations_ += report.iterations;
  stalled_ = !(report.residual <= goal);
  /** Where new factors of parts need as many, age is not the reason. */
  if (are_new) least_iterations_ = parts_.empty() ? 0 : report.iterations;
  if (report.iterations > std::max(many_linear_iterations, 2 * least_iterations_))
    factored_ = false;
  if (!stalled_ || !are_new) return;
  /** Factors of this very point were not enough: dense ones, or a larger block, if there is one. */
  if (!parts_.empty()) return;
  if (in_time_) {
    stalls_in_time_ = true;
    factored_ = false;
    return;
  }
  least_low_ = 2 * low_;
  factored_ = low_ >= largest_low(balance);
}

bool StepSolver::takes_chords() const
{
  return is_complete_ && low_jacobian_.rows() <= most_chord_unknowns;
}

/** Chord steps cost an evaluation each, new factors about one for every eight unknowns: they
    pay when the steps that are left, at the contraction of the last ones, cost more. A first
    step's contraction is trusted a little less each time it is not tried. */
bool StepSolver::chord_pays(double decrease) const
{
  const double contraction = entering_ ? entering_contraction_ : contraction_;
  if (contraction >= chord_contraction_) return false;
  const double worth = 2 + static_cast<double>(low_jacobian_.rows()) / 8;
  return std::log(decrease) >= worth * std::log(contraction);
}

void StepSolver::learn(double contraction)
{
  contraction_ = contraction;
  if (entering_ && last_ == StepKind::chord) entering_contraction_ = contraction;
  if (entering_ && last_ == StepKind::fresh) entering_contraction_ *= 0.9;
  entering_ = false;
  if (last_ == StepKind::chord && !(contraction <= chord_contraction_)) factored_ = false;
  if (answered_ && contraction > good_in_time) answers_in_time_ = factored_ = false;
}

StepKind StepSolver::step(Balance& balance, const Eigen::VectorXd& x, double omega,
                          const Eigen::VectorXd& residual, double goal,
                          Eigen::VectorXd& step)
{
  if (factored_ && takes_chords() && !chord_pays(goal / residual.norm()))
    factored_ = false;
  stalled_ = false;
  /** Factors in time are made anew: they cost as much as a few iterations of GMRES and save more. */
  if (in_time_) factored_ = false;
  const bool are_new = !factored_;
  if (are_new) factor(balance, x, omega);
  if (is_complete_ && (are_new || takes_chords())) {
    precondition(balance, residual, step);
    step = -step;
    return last_ = are_new ? StepKind::fresh : StepKind::chord;
  }
  answered_ = in_time_ && answers_in_time_;
  if (answered_) {
    precondition(balance, residual, step);
    step = -step;
  } else {
    iterate(balance, x, omega, residual, goal, are_new, step);
  }
  return last_ = StepKind::iterated;
}

}  // namespace rotor_stator
