#include "balance/balance.hpp"

#include <limits>

#include "balance/with_dofs.hpp"

namespace rotor_stator
{

namespace
{

/** A complex matrix z as it acts on (cosine, sine) coefficients, q = a - ib: ((Re z, Im z),
    (-Im z, Re z)). */
template <class Block>
void expand(const SmallMatrix& z, Block block)
{
  const auto d = z.rows();
  block.topLeftCorner(d, d) = z.real();
  block.topRightCorner(d, d) = z.imag();
  block.bottomLeftCorner(d, d) = -z.imag();
  block.bottomRightCorner(d, d) = z.real();
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

/** Complex amplitude of harmonic h. */
SmallVector amplitude(const Eigen::MatrixXd& series, int h)
{
  if (h == 0) return series.col(0).cast<std::complex<double>>();
  return series.col(2 * h - 1) - std::complex(0.0, 1.0) * series.col(2 * h);
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
      omega_(std::numeric_limits<double>::quiet_NaN()),
      a_(2 * problem_.dofs, 2 * problem_.dofs * (harmonics + 1)),
      b_(a_.rows(), a_.cols()),
      c_(unknowns()),
      force_series_(problem_.dofs, 2 * harmonics + 1),
      product_series_(problem_.dofs, 2 * harmonics + 1),
      residual_(unknowns())
{
}

void Balance::refresh_blocks(double omega)
{
  if (omega == omega_) return;
  const auto size = a_.rows();
  for (int h = 0; h <= harmonics_; ++h) {
    const LinearBlock block = problem_.linear(omega, h);
    expand(block.a, a_.middleCols(h * size, size));
    expand(block.b, b_.middleCols(h * size, size));
    put(c_, h, block.c);
  }
  omega_ = omega;
}

/** Rows of A q + B f for the coefficients `series` of q and `force` of f. */
void Balance::combine(const Eigen::Ref<const Eigen::MatrixXd>& series,
                      const Eigen::MatrixXd& force, Eigen::VectorXd& sum) const
{
  with_dofs(problem_.dofs, [&](auto constant) {
    constexpr int d = constant, two = 2 * d;
    using Part = Eigen::Matrix<double, two, 1>;
    using Mean = Eigen::Matrix<double, d, 1>;
    sum.template head<d>() =
        a_.template topLeftCorner<d, d>() * Eigen::Map<const Mean>(series.data()) +
        b_.template topLeftCorner<d, d>() * Eigen::Map<const Mean>(force.data());
    using Block = Eigen::Map<const Eigen::Matrix<double, two, two>>;
    for (Eigen::Index h = 1; h <= harmonics_; ++h) {
      const Eigen::Index first = (2 * h - 1) * d;
      const Eigen::Map<const Part> q(series.data() + first), f(force.data() + first);
      sum.template segment<two>(first) =
          Block(&a_(0, h * two)) * q + Block(&b_(0, h * two)) * f;
    }
  });
}

void Balance::evaluate_force(With with)
{
  ++evaluations_;
  has_stiffness_ = with == With::stiffness;
  has_spectra_ = false;
  problem_.force(samples_, force_samples_,
                 has_stiffness_ ? &stiffness_samples_ : nullptr);
}

const Eigen::VectorXd& Balance::residual(const Eigen::VectorXd& x, double omega,
                                         With with)
{
  spend(2 * problem_.dofs * transform_.operations());
  refresh_blocks(omega);
  series_ =
      Eigen::Map<const Eigen::MatrixXd>(x.data(), problem_.dofs, 2 * harmonics_ + 1);
  transform_.to_samples(series_, samples_);
  evaluate_force(with);
  transform_.to_series(force_samples_, force_series_);
  combine(series_, force_series_, residual_);
  residual_ -= c_;
  return residual_;
}

const Eigen::VectorXd& Balance::speed_derivative()
{
  speed_derivative_.resize(unknowns());
  for (int h = 0; h <= harmonics_; ++h) {
    const LinearBlock block = problem_.linear(omega_, h);
    put(speed_derivative_, h,
        block.a_slope * amplitude(series_, h) +
            block.b_slope * amplitude(force_series_, h) - block.c_slope);
  }
  return speed_derivative_;
}

}  // namespace rotor_stator
