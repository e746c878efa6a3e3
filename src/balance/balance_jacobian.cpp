/**
# The derivative of the balance

As a matrix, as a product, and the block of one harmonic. */
#include <Eigen/LU>

#include "balance/balance.hpp"
#include "balance/with_dofs.hpp"
#include "model/errors.hpp"

namespace rotor_stator
{

namespace
{

/** Three dense matrices of this size, as the arc length needs, stay below 0.5 GB. */
constexpr Eigen::Index most_unknowns = 4200;

}  // namespace

void Balance::need_stiffness()
{
  if (!has_stiffness_) evaluate_force(With::stiffness);
}

void Balance::need_spectra()
{
  need_stiffness();
  if (has_spectra_) return;
  spend(static_cast<double>(stiffness_samples_.cols()) * transform_.operations());
  spectra_.resize(problem_.samples / 2 + 1, stiffness_samples_.cols());
  for (Eigen::Index k = 0; k < spectra_.cols(); ++k)
    spectra_.col(k) = transform_.spectrum(stiffness_samples_.col(k));
  has_spectra_ = true;
}

/** α_p + iβ_p = conj κ_p of one stiffness series for p = -`below` … `above`. The indices are
    modulo N, which makes the derivative exact for any N ≥ 2m+1. */
void Balance::extend_spectrum(Eigen::Index column, int below, int above)
{
  const int n = problem_.samples;
  const auto at = [&](int p) {
    return 2 * p <= n ? std::conj(spectra_(p, column)) : spectra_(n - p, column);
  };
  extended_.resize(below + above + 1);
  for (int p = 0; p <= above; ++p) extended_[below + p] = at(p);
  for (int p = 1; p <= below; ++p) extended_[below - p] = std::conj(at(p));
}

/** Entries ∂(coefficients of f_i)/∂(coefficients of q_j) before the blocks B_h multiply
   them: cosine column q and row p hold α_{p-q} + α_{p+q} and so on. */
void Balance::fill_force_jacobian(int i, int j, int harmonics, Eigen::MatrixXd& jacobian)
{
  const int d = problem_.dofs;
  extend_spectrum(i + d * j, harmonics, 2 * harmonics);
  for (int q = 0; q <= harmonics; ++q) {
    const std::complex<double>* sums = &extended_[harmonics + q];
    const std::complex<double>* differences = &extended_[harmonics - q];
    double* cosine = &jacobian(i, (q == 0 ? 0 : 2 * q - 1) * d + j);
    double* sine =
        &jacobian(i, 2 * q * d + j);  // for q = 0 the same column: written first
    sine[0] = sums[0].imag();
    cosine[0] = sums[0].real();
    for (int p = 1; p <= harmonics; ++p) {
      const auto sum = sums[p], difference = differences[p];
      const Eigen::Index row = (2 * p - 1) * d;
      sine[row] = sum.imag() - difference.imag();
      sine[row + d] = difference.real() - sum.real();
      cosine[row] = difference.real() + sum.real();
      cosine[row + d] = sum.imag() + difference.imag();
    }
  }
}

void Balance::jacobian(int harmonics, Eigen::MatrixXd& jacobian)
{
  const double n = problem_.dofs * (2.0 * harmonics + 1);
  spend(1.5e4 + 10 * n * n + n * n * n / 18);  // with its factorisation
  need_spectra();
  const int dofs = problem_.dofs;
  const Eigen::Index size = dofs * (2 * harmonics + 1);
  jacobian.resize(size, size);
  for (int j = 0; j < dofs; ++j)
    for (int i = 0; i < dofs; ++i) fill_force_jacobian(i, j, harmonics, jacobian);

  /** Rows of harmonic h: multiply by B_h, add A_h on the diagonal. */
  with_dofs(dofs, [&](auto constant) {
    constexpr int d = constant, two = 2 * d;
    using Block = Eigen::Matrix<double, two, two>;
    const Eigen::Matrix<double, d, d> mean = b_.template topLeftCorner<d, d>();
    for (Eigen::Index k = 0; k < size; ++k) {
      auto column = jacobian.col(k);
      column.template head<d>() = (mean * column.template head<d>()).eval();
      for (Eigen::Index h = 1; h <= harmonics; ++h) {
        auto part = column.template segment<two>((2 * h - 1) * d);
        part = (Eigen::Map<const Block>(&b_(0, h * two)) * part).eval();
      }
    }
    jacobian.template topLeftCorner<d, d>() += a_.template topLeftCorner<d, d>();
    for (Eigen::Index h = 1; h <= harmonics; ++h)
      jacobian.template block<two, two>((2 * h - 1) * d, (2 * h - 1) * d) +=
          a_.template middleCols<two>(h * two);
  });
}

const Eigen::MatrixXd& Balance::jacobian()
{
  if (unknowns() > most_unknowns)
    throw NoSolution(text(
        "%d harmonics give %ld unknowns; the dense Jacobian stops at %ld", harmonics_,
        static_cast<long>(unknowns()), static_cast<long>(most_unknowns)));
  jacobian(harmonics_, jacobian_);
  return jacobian_;
}

void Balance::apply_jacobian(const Eigen::VectorXd& v, Eigen::VectorXd& product)
{
  need_stiffness();
  const int d = problem_.dofs;
  spend(2 * d * transform_.operations() + 2.0 * d * d * problem_.samples);
  const Eigen::Map<const Eigen::MatrixXd> series(v.data(), d, 2 * harmonics_ + 1);
  transform_.to_samples(series, product_samples_);
  product_force_.resize(problem_.samples, d);
  for (int i = 0; i < d; ++i) {
    product_force_.col(i) =
        stiffness_samples_.col(i).cwiseProduct(product_samples_.col(0));
    for (int j = 1; j < d; ++j)
      product_force_.col(i) +=
          stiffness_samples_.col(i + d * j).cwiseProduct(product_samples_.col(j));
  }
  transform_.to_series(product_force_, product_series_);
  combine(series, product_series_, product);
}

RealBlock Balance::diagonal_block(int h)
{
  need_spectra();
  const int d = problem_.dofs, two = 2 * d, n = problem_.samples;
  RealBlock force(two, two);
  for (int j = 0; j < d; ++j)
    for (int i = 0; i < d; ++i) {
      const Eigen::Index column = i + d * j;
      const double mean = spectra_(0, column).real();
      const auto twice =
          4 * h <= n ? std::conj(spectra_(2 * h, column)) : spectra_(n - 2 * h, column);
      force(i, j) = mean + twice.real();
      force(i, d + j) = twice.imag();
      force(d + i, j) = twice.imag();
      force(d + i, d + j) = mean - twice.real();
    }
  return a_.middleCols(h * two, two) + b_.middleCols(h * two, two) * force;
}

int Balance::highest_coupled(double coupling)
{
  need_stiffness();
  const double stiffness = stiffness_samples_.rowwise().norm().maxCoeff();
  const int two = 2 * problem_.dofs;
  for (int h = harmonics_; h > 0; --h) {
    const RealBlock a = a_.middleCols(h * two, two), b = b_.middleCols(h * two, two);
    if (!(a.partialPivLu().solve(b).norm() * stiffness < coupling)) return h;
  }
  return 0;
}

}  // namespace rotor_stator
