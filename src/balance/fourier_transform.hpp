/**
# Between the Fourier series and its samples (Eqs 9 and 13)

A periodic motion is known by its coefficients or by its samples, and either follows from
the other. With m harmonics it is the series

$$x(\varphi) = X_0 + \sum_{i=1}^{m} X_{2i-1}\cos i\varphi + X_{2i}\sin i\varphi, \tag{9}$$

with φ = ωt. From its N samples at φ_k = 2πk/N the coefficients follow by

$$X_0 = \frac{1}{N}\sum_k x(\varphi_k),
\quad X_{2i-1} = \frac{2}{N}\sum_k x(\varphi_k)\cos
i\varphi_k, \quad X_{2i} = \frac{2}{N}\sum_k x(\varphi_k)\sin i\varphi_k. \tag{13}$$

Both ways are real discrete Fourier transforms (FFTW; Eigen's with
ROTOR_STATOR_EIGEN_FFT). Γ takes samples to coefficients, Γ⁻¹ coefficients to samples
(D-04: the paper's text names them the other way round). N is a parameter, at least 2m+1;
the paper's own N = 2m+1 aliases (D-05); its arguments lack parentheses (D-21). */
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>

#include "balance/periodic_motion.hpp"

namespace rotor_stator {

/** The smallest even number ≥ `at_least` with no prime factor above 7: a fast FFTW
    size. */
int fast_transform_size(int at_least);

/** Samples per period for m harmonics when nothing else is asked (D-14): at least 8m+1,
    2/3 m^{8/5} and 32. The error of sampling falls as N^{-5/2}; that of truncation as
    m^{-7/2} in the largest norm and as m^{-4} in the rms about the mean. A fixed N/m
    loses an order or more; N ∝ m^{8/5} keeps both (figure `sampling`). Beyond 2^17 the
    error of sampling is that of rounding. */
int default_samples(int harmonics);

/** Real transforms of one length N, with their buffers. */
class FourierTransform {
public:
  explicit FourierTransform(int samples);

  /** Operations of one transform, with the copies around it: many where N has a large
      prime factor. */
  double operations() const;

  /** Γ⁻¹: series coefficients (rows = variables, columns = X_0, X_1, … X_2m) to samples
      (rows = instants, columns = variables). N ≥ 2m+1. The harmonics are those of Eq. 9,
      or stand at `images`, no two of which are the same or opposite. */
  void to_samples(const Eigen::Ref<const Eigen::MatrixXd>& series,
                  Eigen::MatrixXd& samples, const Images& images = {});

  /** Γ: samples to the coefficients of as many harmonics as `series` has columns for. */
  void to_series(const Eigen::MatrixXd& samples, Eigen::Ref<Eigen::MatrixXd> series,
                 const Images& images = {});

  /** The discrete Fourier coefficients κ_p = (1/N) Σ_k x(φ_k) e^{-ipφ_k}, p = 0…N/2, of
     one column of samples; valid until the next call. */
  Eigen::Map<const Eigen::VectorXcd> spectrum(
      const Eigen::Ref<const Eigen::VectorXd>& column);

private:
  struct Plans;
  struct KeepForNext {
    void operator()(Plans* plans) const;
  };
  static std::multimap<int, std::unique_ptr<Plans>>& idle();
  std::unique_ptr<Plans, KeepForNext> plans_;
};

/** Samples of a series at `points` equal phases of one period, for any number of points.
 */
Eigen::MatrixXd sample_series(const Eigen::MatrixXd& series, int points);

/** The series of the derivative with respect to φ. */
Eigen::MatrixXd differentiate(const Eigen::MatrixXd& series);

/** The extreme of the parabola through three values at -1, 0 and 1. */
struct Vertex {
  double at, height;
};
Vertex vertex(double before, double top, double after);

/** The largest value, where three samples lie on a parabola; `is_closed`: the first
    follows the last. */
double largest_of(const Eigen::VectorXd& x, bool is_closed);

/** Half of such a largest less the smallest. */
double half_range(const Eigen::VectorXd& x, bool is_closed);

/** The same of each row of a series over the period. */
Eigen::VectorXd half_peak_to_peak(const Eigen::MatrixXd& series);

}  // namespace rotor_stator
