#include "balance/balance.hpp"

#include <Eigen/LU>
#include <cstring>
#include <limits>

#include "io/errors.hpp"

namespace rotor_stator {

SmallVector amplitude(const Eigen::Ref<const Eigen::MatrixXd>& series, int h)
{
  if (h == 0) return series.col(0).cast<std::complex<double>>();
  return series.col(2 * h - 1) - std::complex(0.0, 1.0) * series.col(2 * h);
}

void put_amplitude(Eigen::Ref<Eigen::MatrixXd> series, int h,
                   const Eigen::Ref<const Eigen::VectorXcd>& amplitude)
{
  series.col(h == 0 ? 0 : 2 * h - 1) = amplitude.real();
  if (h > 0) series.col(2 * h) = -amplitude.imag();
}

/** A complex matrix z as it acts on (cosine, sine) coefficients, q = a - ib: ((Re z, Im
    z), (-Im z, Re z)). */
template <int d>
static void expand(const SmallMatrix& z, double* to)
{
  Eigen::Map<Eigen::Matrix<double, 2 * d, 2 * d>> block(to);
  for (int j = 0; j < d; ++j)
    for (int i = 0; i < d; ++i) {
      block(i, j) = block(d + i, d + j) = z(i, j).real();
      block(i, d + j) = z(i, j).imag();
      block(d + i, j) = -z(i, j).imag();
    }
}

LinearBlock second_order_block(const Eigen::MatrixXd& mass,
                               const Eigen::MatrixXd& damping,
                               const Eigen::MatrixXd& stiffness,
                               const Eigen::VectorXcd& load, double omega, double h)
{
  const std::complex<double> i(0, 1);
  const auto d = mass.rows();
  return {.a = stiffness - (h * omega) * (h * omega) * mass + i * (h * omega) * damping,
          .b = SmallMatrix::Identity(d, d),
          .c = h == 1 ? SmallVector(load) : SmallVector::Zero(d),
          .a_slope = -2.0 * h * h * omega * mass + i * h * damping,
          .b_slope = SmallMatrix::Zero(d, d),
          .c_slope = SmallVector::Zero(d)};
}

Balance::Balance(Problem problem, Harmonics harmonics)
    : problem_(std::move(problem)), harmonics_(std::move(harmonics)),
      m_(harmonics_.count()), images_(harmonics_.images(problem_.line, problem_.samples)),
      transform_(problem_.samples), omega_(std::numeric_limits<double>::quiet_NaN()),
      a_(2 * problem_.dofs, 2 * problem_.dofs * (m_ + 1)), b_(a_.rows(), a_.cols()),
      a_slope_(a_), b_slope_(a_), c_(problem_.dofs, harmonics_.coefficients()),
      c_slope_(c_), series_(c_), force_series_(c_), product_series_(c_),
      residual_(c_.size()), speed_derivative_(c_.size())
{
  if (!is_moving()) return;
  orders_.resize(m_ + 1);
  for (int h = 0; h <= m_; ++h) orders_[h] = problem_.order(harmonics_.list()[h]);
}

void Balance::refresh_blocks(double omega)
{
  if (omega == omega_) return;
  evaluated_ = false;
  LinearBlock block;
  for (int h = 0; h <= m_; ++h) {
    problem_.linear(omega, harmonics_.list()[h], block);
    with_dofs(problem_.dofs, [&](auto constant) {
      constexpr int d = constant;
      expand<d>(block.a, &a_(0, 2 * d * h));
      expand<d>(block.b, &b_(0, 2 * d * h));
      expand<d>(block.a_slope, &a_slope_(0, 2 * d * h));
      expand<d>(block.b_slope, &b_slope_(0, 2 * d * h));
    });
    put_amplitude(c_, h, block.c);
    put_amplitude(c_slope_, h, block.c_slope);
  }
  omega_ = omega;
}

/** Of the rate of a series, at the present speed. */
void Balance::rate_samples(const Eigen::Ref<const Eigen::MatrixXd>& series,
                           Eigen::MatrixXd& samples)
{
  rate_series_.setZero(series.rows(), series.cols());
  for (int h = 1; h <= m_; ++h) {
    const double frequency = orders_[h] * omega_;
    rate_series_.col(2 * h - 1) = frequency * series.col(2 * h);
    rate_series_.col(2 * h) = -frequency * series.col(2 * h - 1);
  }
  transform_.to_samples(rate_series_, samples, images_);
}

/** Rows of A q + B f for the coefficients `series` of q and `force` of f; A and B by
    their blocks side by side. */
void Balance::combine(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                      const Eigen::Ref<const Eigen::MatrixXd>& series,
                      const Eigen::MatrixXd& force, Eigen::VectorXd& sum) const
{
  with_dofs(problem_.dofs, [&](auto constant) {
    constexpr int d = constant, two = 2 * d;
    using Part = Eigen::Matrix<double, two, 1>;
    using Mean = Eigen::Matrix<double, d, 1>;
    sum.template head<d>() =
        a.template topLeftCorner<d, d>() * Eigen::Map<const Mean>(series.data()) +
        b.template topLeftCorner<d, d>() * Eigen::Map<const Mean>(force.data());
    using Block = Eigen::Map<const Eigen::Matrix<double, two, two>>;
    for (Eigen::Index h = 1; h <= m_; ++h) {
      const Eigen::Index first = (2 * h - 1) * d;
      const Eigen::Map<const Part> q(series.data() + first), f(force.data() + first);
      sum.template segment<two>(first) =
          Block(&a(0, h * two)) * q + Block(&b(0, h * two)) * f;
    }
  });
}

const Eigen::VectorXd& Balance::residual(const Eigen::VectorXd& x, double omega,
                                         bool with_stiffness)
{
  /** Whether (X, ω) is the point that was evaluated last, bit by bit. */
  const bool known =
      evaluated_ && omega == omega_ &&
      std::memcmp(x.data(), series_.data(), x.size() * sizeof(double)) == 0;
  if (known && (has_stiffness_ || !with_stiffness)) return residual_;
  evaluated_ = has_spectra_ = false;  // should the budget end here
  if (!known) {
    spend(2 * problem_.dofs * transform_.operations());
    refresh_blocks(omega);
    std::copy(x.begin(), x.end(), series_.data());
    transform_.to_samples(series_, samples_, images_);
  }
  spend(problem_.operations);
  ++evaluations_;
  has_stiffness_ = with_stiffness;
  Eigen::MatrixXd* slopes = has_stiffness_ ? &stiffness_samples_ : nullptr;
  if (is_moving()) {
    rate_samples(series_, rate_samples_);
    problem_.moving_force(samples_, rate_samples_, omega, force_samples_, slopes);
  } else {
    problem_.force(samples_, force_samples_, slopes);
  }
  evaluated_ = true;
  if (known) return residual_;
  transform_.to_series(force_samples_, force_series_, images_);
  combine(a_, b_, series_, force_series_, residual_);
  residual_ -= c_.reshaped();
  return residual_;
}

const Eigen::MatrixXd& Balance::force(const Eigen::VectorXd& x, double omega)
{
  residual(x, omega, false);
  return force_series_;
}

const Eigen::VectorXd& Balance::speed_derivative(const Eigen::VectorXd& x, double omega)
{
  residual(x, omega, is_moving());
  combine(a_slope_, b_slope_, series_, force_series_, speed_derivative_);
  speed_derivative_ -= c_slope_.reshaped();
  if (!is_moving()) return speed_derivative_;
  const Eigen::Index d = problem_.dofs;
  product_force_ = stiffness_samples_.rightCols(d);
  transform_.to_series(product_force_, product_series_, images_);
  Eigen::Map<Eigen::MatrixXd> slope(speed_derivative_.data(), d, c_.cols());
  for (int h = 0; h <= m_; ++h) {
    const SmallMatrix b = b_.block(0, 2 * h * d, d, d) +
                          std::complex(0.0, 1.0) * b_.block(0, (2 * h + 1) * d, d, d);
    const SmallVector sum = amplitude(slope, h) + b * amplitude(product_series_, h);
    put_amplitude(slope, h, sum);
  }
  return speed_derivative_;
}

/**
## The derivative of the balance

As a matrix, as a product, and the block of one harmonic. */

void Balance::need_spectra(const Eigen::VectorXd& x, double omega)
{
  residual(x, omega);
  if (has_spectra_) return;
  spend(static_cast<double>(stiffness_samples_.cols()) * transform_.operations());
  spectra_.resize(problem_.samples / 2 + 1, stiffness_samples_.cols());
  for (Eigen::Index k = 0; k < spectra_.cols(); ++k)
    spectra_.col(k) = transform_.spectrum(stiffness_samples_.col(k));
  has_spectra_ = true;
}

/** α_p + iβ_p = conj κ_p of one stiffness series, |p| ≤ N. The indices are modulo N,
    which makes the derivative exact for any N ≥ 2m+1. */
std::complex<double> Balance::conjugate_kappa(int p, Eigen::Index column) const
{
  const int n = problem_.samples;
  if (p < 0) return std::conj(conjugate_kappa(-p, column));
  return 2 * p <= n ? std::conj(spectra_(p, column)) : spectra_(n - p, column);
}

/** Entries ∂(coefficients of f_i)/∂(coefficients of q_j) before the blocks B_h multiply
    them: cosine column q and row p hold α_{p-q} + α_{p+q} and so on. The mean's row and
    column come first. */
void Balance::fill_force_jacobian(int i, int j, Eigen::Index column,
                                  std::span<const int> images, Eigen::MatrixXd& jacobian)
{
  const int d = problem_.dofs, count = static_cast<int>(images.size());
  int reach = 0;  // of their sums and differences
  for (int p : images) reach = std::max(reach, 2 * std::abs(p));
  extended_.resize(2 * reach + 1);
  std::complex<double>* middle = &extended_[reach];
  for (int p = 0; p <= reach; ++p) {
    middle[p] = conjugate_kappa(p, column);
    middle[-p] = std::conj(middle[p]);
  }
  for (int q = 0; q < count; ++q) {
    const std::complex<double>*sums = middle + images[q],
          *differences = middle - images[q];
    double* cosine = &jacobian(i, q == 0 ? j : (2 * q - 1) * d + j);
    double* sine = q == 0 ? cosine : &jacobian(i, 2 * q * d + j);
    sine[0] = sums[0].imag();  // for q = 0 the same column: the sine is written first
    cosine[0] = sums[0].real();
    for (int p = 1; p < count; ++p) {
      const auto sum = sums[images[p]], difference = differences[images[p]];
      const Eigen::Index row = (2 * p - 1) * d;
      sine[row] = sum.imag() - difference.imag();
      sine[row + d] = difference.real() - sum.real();
      cosine[row] = difference.real() + sum.real();
      cosine[row + d] = sum.imag() + difference.imag();
    }
  }
}

void Balance::jacobian(const Eigen::VectorXd& x, double omega, int harmonics,
                       Eigen::MatrixXd& jacobian)
{
  const int dofs = problem_.dofs;
  const Eigen::Index size = (2 * harmonics + 1) * dofs;
  const auto n = static_cast<double>(size);
  spend(1.5e4 + 10 * n * n + n * n * n / 18);  // with its factorisation
  need_spectra(x, omega);
  const auto images = std::span(images_).first(static_cast<std::size_t>(harmonics) + 1);
  jacobian.resize(size, size);
  if (is_moving()) damping_jacobian_.resize(size, size);
  for (int j = 0; j < dofs; ++j)
    for (int i = 0; i < dofs; ++i) {
      const Eigen::Index column = i + dofs * j;
      fill_force_jacobian(i, j, column, images, jacobian);
      if (is_moving())
        fill_force_jacobian(i, j, dofs * dofs + column, images, damping_jacobian_);
    }
  /** The rate of a cosine is -Ω times the sine, that of a sine Ω times the cosine. */
  for (int q = 1; is_moving() && q <= harmonics; ++q) {
    const double frequency = orders_[q] * omega;
    const Eigen::Index cosine = (2 * q - 1) * dofs, sine = cosine + dofs;
    jacobian.middleCols(cosine, dofs) -=
        frequency * damping_jacobian_.middleCols(sine, dofs);
    jacobian.middleCols(sine, dofs) +=
        frequency * damping_jacobian_.middleCols(cosine, dofs);
  }

  /** Rows of harmonic h: multiply by B_h, add A_h on the diagonal. */
  with_dofs(dofs, [&](auto constant) {
    constexpr int d = constant, two = 2 * d;
    using Block = Eigen::Matrix<double, two, two>;
    const Eigen::Matrix<double, d, d> mean = b_.template topLeftCorner<d, d>();
    for (Eigen::Index k = 0; k < size; ++k) {
      auto column = jacobian.col(k);
      column.template head<d>() = (mean * column.template head<d>()).eval();
      for (int h = 1; h <= harmonics; ++h) {
        auto part = column.template segment<two>(h * two - d);
        part = (Eigen::Map<const Block>(&b_(0, h * two)) * part).eval();
      }
    }
    jacobian.template topLeftCorner<d, d>() += a_.template topLeftCorner<d, d>();
    for (int h = 1; h <= harmonics; ++h)
      jacobian.template block<two, two>(h * two - d, h * two - d) +=
          a_.template middleCols<two>(h * two);
  });
}

const Eigen::MatrixXd& Balance::jacobian(const Eigen::VectorXd& x, double omega)
{
  /** Three dense matrices of this size, as the arc length needs, stay below 0.5 GB. */
  constexpr Eigen::Index most_unknowns = 4200;
  if (unknowns() > most_unknowns)
    throw NoSolution(
        format("%d harmonics give %ld unknowns; the dense Jacobian stops at %ld", m_,
               static_cast<long>(unknowns()), static_cast<long>(most_unknowns)));
  jacobian(x, omega, m_, jacobian_);
  return jacobian_;
}

void Balance::apply_jacobian(const Eigen::VectorXd& x, double omega,
                             const Eigen::VectorXd& v, Eigen::VectorXd& product)
{
  residual(x, omega);
  const int d = problem_.dofs;
  spend(2 * d * transform_.operations() + 2.0 * d * d * problem_.samples);
  const Eigen::Map<const Eigen::MatrixXd> series(v.data(), d, c_.cols());
  transform_.to_samples(series, product_samples_, images_);
  product_force_.resize(problem_.samples, d);
  for (int i = 0; i < d; ++i) {
    product_force_.col(i) =
        stiffness_samples_.col(i).cwiseProduct(product_samples_.col(0));
    for (int j = 1; j < d; ++j)
      product_force_.col(i) +=
          stiffness_samples_.col(i + d * j).cwiseProduct(product_samples_.col(j));
  }
  if (is_moving()) {
    rate_samples(series, product_samples_);
    for (int i = 0; i < d; ++i)
      for (int j = 0; j < d; ++j)
        product_force_.col(i) += stiffness_samples_.col(d * d + i + d * j)
                                     .cwiseProduct(product_samples_.col(j));
  }
  transform_.to_series(product_force_, product_series_, images_);
  combine(a_, b_, series, product_series_, product);
}

/** What one harmonic of q adds to the same one of the force, by the slopes from
    `first_column` on. */
RealBlock Balance::force_block(Eigen::Index first_column, int h) const
{
  const int d = problem_.dofs, two = 2 * d;
  RealBlock force(two, two);
  for (int j = 0; j < d; ++j)
    for (int i = 0; i < d; ++i) {
      const Eigen::Index column = first_column + i + d * j;
      const double mean = spectra_(0, column).real();
      const auto twice = conjugate_kappa(2 * images_[h], column);
      force(i, j) = mean + twice.real();
      force(i, d + j) = twice.imag();
      force(d + i, j) = twice.imag();
      force(d + i, d + j) = mean - twice.real();
    }
  return force;
}

void Balance::diagonal_blocks(const Eigen::VectorXd& x, double omega, int first,
                              Eigen::MatrixXd& blocks)
{
  need_spectra(x, omega);
  const int d = problem_.dofs, two = 2 * d;
  blocks.resize(two, two * (m_ + 1 - first));
  for (int h = first; h <= m_; ++h) {
    RealBlock force = force_block(0, h);
    if (is_moving()) {
      const RealBlock damping = orders_[h] * omega * force_block(d * d, h);
      force.leftCols(d) -= damping.rightCols(d);
      force.rightCols(d) += damping.leftCols(d);
    }
    blocks.middleCols((h - first) * two, two) =
        a_.middleCols(h * two, two) + b_.middleCols(h * two, two) * force;
  }
}

int Balance::highest_coupled(const Eigen::VectorXd& x, double omega)
{
  residual(x, omega);
  const int d = problem_.dofs, two = 2 * d;
  const double stiffness = stiffness_samples_.leftCols(d * d).rowwise().norm().maxCoeff();
  for (int h = m_; h > 0; --h) {
    const RealBlock a = a_.middleCols(h * two, two), b = b_.middleCols(h * two, two);
    if (!(a.partialPivLu().solve(b).norm() * stiffness < 1)) return h;
  }
  return 0;
}

}  // namespace rotor_stator
