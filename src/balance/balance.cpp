#include "balance/balance.hpp"

#include <limits>

#include "model/errors.hpp"

namespace rotor_stator
{

namespace
{

/** Three dense matrices of this size, as the arc length needs, stay below 0.5 GB. */
constexpr Eigen::Index most_unknowns = 4200;

using Series = Eigen::MatrixXd;

/** Complex amplitude of harmonic h: q_h = a - i b for a cos hφ + b sin hφ. */
SmallVector amplitude(const Series& series, int h)
{
  if (h == 0) return series.col(0).cast<std::complex<double>>();
  return series.col(2 * h - 1) - std::complex(0.0, 1.0) * series.col(2 * h);
}

/** Writes a complex amplitude into the rows of harmonic h of a real vector. */
void put(Eigen::VectorXd& x, int h, const SmallVector& amplitude)
{
  const auto d = amplitude.size();
  if (h == 0) {
    x.head(d) = amplitude.real();
    return;
  }
  x.segment((2 * h - 1) * d, d) = amplitude.real();
  x.segment(2 * h * d, d) = -amplitude.imag();
}

}  // namespace

LinearBlock second_order_block(const Eigen::MatrixXd& mass,
                               const Eigen::MatrixXd& damping,
                               const Eigen::MatrixXd& stiffness,
                               const Eigen::VectorXcd& load, double omega, int h)
{
  const std::complex<double> i(0, 1);
  const auto d = mass.rows();
  LinearBlock block;
  block.a = stiffness - (h * omega) * (h * omega) * mass + i * (h * omega) * damping;
  block.a_slope = -2.0 * h * h * omega * mass + i * static_cast<double>(h) * damping;
  block.b = SmallMatrix::Identity(d, d);
  block.b_slope = SmallMatrix::Zero(d, d);
  block.c = h == 1 ? SmallVector(load) : SmallVector::Zero(d);
  block.c_slope = SmallVector::Zero(d);
  return block;
}

Balance::Balance(Problem problem, int harmonics)
    : problem_(std::move(problem)),
      harmonics_(harmonics),
      transform_(problem_.samples),
      blocks_(harmonics + 1),
      omega_(std::numeric_limits<double>::quiet_NaN()),
      force_series_(problem_.dofs, 2 * harmonics + 1)
{
  if (unknowns() > most_unknowns)
    throw NoSolution(
        text("%d harmonics give %ld unknowns; the dense Jacobian stops at %ld", harmonics,
             static_cast<long>(unknowns()), static_cast<long>(most_unknowns)));
}

void Balance::refresh_blocks(double omega)
{
  if (omega == omega_) return;
  for (int h = 0; h <= harmonics_; ++h) blocks_[h] = problem_.linear(omega, h);
  omega_ = omega;
}

const Eigen::VectorXd& Balance::residual(const Eigen::VectorXd& x, double omega)
{
  ++evaluations_;
  refresh_blocks(omega);
  series_ = Eigen::Map<const Series>(x.data(), problem_.dofs, 2 * harmonics_ + 1);
  transform_.to_samples(series_, samples_);
  problem_.force(samples_, force_samples_, stiffness_samples_);
  transform_.to_series(force_samples_, force_series_);
  residual_.resize(unknowns());
  for (int h = 0; h <= harmonics_; ++h) {
    const LinearBlock& block = blocks_[h];
    put(residual_, h,
        block.a * amplitude(series_, h) + block.b * amplitude(force_series_, h) -
            block.c);
  }
  return residual_;
}

const Eigen::VectorXd& Balance::speed_derivative()
{
  speed_derivative_.resize(unknowns());
  for (int h = 0; h <= harmonics_; ++h) {
    const LinearBlock& block = blocks_[h];
    put(speed_derivative_, h,
        block.a_slope * amplitude(series_, h) +
            block.b_slope * amplitude(force_series_, h) - block.c_slope);
  }
  return speed_derivative_;
}

/** Entries ∂(coefficients of f_i)/∂(coefficients of q_j) before the blocks B_h multiply
   them. With k(φ) the stiffness and κ_p = α_p - iβ_p, cosine column q and row p hold
   α_{p-q} + α_{p+q} and so on; the indices are modulo N, which makes the derivative exact
   for any N ≥ 2m+1. */
void Balance::fill_force_jacobian(int i, int j)
{
  const int d = problem_.dofs, n = problem_.samples, m = harmonics_;
  const auto kappa = transform_.spectrum(stiffness_samples_.col(i + d * j));
  const auto at = [&](int p) {
    return 2 * p <= n ? std::conj(kappa[p]) : kappa[n - p];  // α_p + iβ_p
  };
  const auto entry = [&](int row, int column) -> double& {
    return jacobian_(row * d + i, column * d + j);
  };
  entry(0, 0) = kappa[0].real();
  for (int h = 1; h <= m; ++h) {
    const auto k = at(h);
    entry(0, 2 * h - 1) = k.real();
    entry(0, 2 * h) = k.imag();
    entry(2 * h - 1, 0) = 2 * k.real();
    entry(2 * h, 0) = 2 * k.imag();
  }
  for (int q = 1; q <= m; ++q)
    for (int p = 1; p <= m; ++p) {
      const auto sum = at(p + q);
      const auto difference = p >= q ? at(p - q) : std::conj(at(q - p));
      entry(2 * p - 1, 2 * q - 1) = difference.real() + sum.real();
      entry(2 * p - 1, 2 * q) = sum.imag() - difference.imag();
      entry(2 * p, 2 * q - 1) = sum.imag() + difference.imag();
      entry(2 * p, 2 * q) = difference.real() - sum.real();
    }
}

const Eigen::MatrixXd& Balance::jacobian()
{
  const int d = problem_.dofs;
  jacobian_.resize(unknowns(), unknowns());
  for (int j = 0; j < d; ++j)
    for (int i = 0; i < d; ++i) fill_force_jacobian(i, j);

  /** Rows of harmonic h: multiply by B_h, add A_h on the diagonal. A complex number a +
     ib acts on (cosine, sine) coefficients as the matrix ((a, b), (-b, a)). */
  jacobian_.topRows(d).applyOnTheLeft(blocks_[0].b.real());
  jacobian_.topLeftCorner(d, d) += blocks_[0].a.real();
  Eigen::MatrixXd left(2 * d, 2 * d);
  const auto expand = [&](const SmallMatrix& z) {
    left << z.real(), z.imag(), -z.imag(), z.real();
  };
  for (int h = 1; h <= harmonics_; ++h) {
    const auto first = (2 * h - 1) * d;
    expand(blocks_[h].b);
    jacobian_.middleRows(first, 2 * d).applyOnTheLeft(left);
    expand(blocks_[h].a);
    jacobian_.block(first, first, 2 * d, 2 * d) += left;
  }
  return jacobian_;
}

}  // namespace rotor_stator
