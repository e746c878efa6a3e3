#include "balance/fourier_transform.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <mutex>
#ifdef ROTOR_STATOR_EIGEN_FFT
#include <unsupported/Eigen/FFT>
#else
#include <fftw3.h>
#endif

namespace rotor_stator {

#ifdef ROTOR_STATOR_EIGEN_FFT

/** Eigen's own transform, where there is no FFTW: in the browser. */
struct FourierTransform::Plans {
  using Engine = Eigen::FFT<double>;
  int samples;
  Eigen::VectorXd time = Eigen::VectorXd::Zero(samples);
  Eigen::VectorXcd frequency = Eigen::VectorXcd::Zero(samples / 2 + 1);
  Engine engine{{}, Engine::Flag(Engine::HalfSpectrum | Engine::Unscaled)};

  explicit Plans(int n) : samples(n) {}
  double operations() const { return samples * (2.5 * std::log2(samples) + 5); }
  void forward() { engine.fwd(frequency.data(), time.data(), samples); }
  void backward() { engine.inv(time.data(), frequency.data(), samples); }
};

#else

namespace {

struct FftwFree {
  void operator()(void* memory) const { fftw_free(memory); }
};

/** FFTW's planner is shared by all threads; executing a plan is not. */
std::mutex planner;

struct DestroyPlan {
  void operator()(fftw_plan plan) const
  {
    const std::lock_guard lock(planner);
    fftw_destroy_plan(plan);
  }
};

using Plan = std::unique_ptr<std::remove_pointer_t<fftw_plan>, DestroyPlan>;

}  // namespace

/** FFTW_ESTIMATE plans do not depend on timings: the same machine gives the same bits.
    They are made when they are needed: many serve in one direction only. */
struct FourierTransform::Plans {
  int samples;
  std::unique_ptr<double[], FftwFree> time;
  std::unique_ptr<std::complex<double>[], FftwFree> frequency;
  Plan to_frequency, to_time;

  explicit Plans(int n)
      : samples(n), time(fftw_alloc_real(n)),
        frequency(reinterpret_cast<std::complex<double>*>(fftw_alloc_complex(n / 2 + 1)))
  {
  }
  fftw_complex* spectrum() { return reinterpret_cast<fftw_complex*>(frequency.get()); }
  void plan_forward()
  {
    if (to_frequency) return;
    const std::lock_guard lock(planner);
    to_frequency.reset(
        fftw_plan_dft_r2c_1d(samples, time.get(), spectrum(), FFTW_ESTIMATE));
  }
  void forward()
  {
    plan_forward();
    fftw_execute(to_frequency.get());
  }
  void backward()
  {
    if (!to_time) {
      const std::lock_guard lock(planner);
      to_time.reset(fftw_plan_dft_c2r_1d(samples, spectrum(), time.get(), FFTW_ESTIMATE));
    }
    fftw_execute(to_time.get());
  }
  double operations()
  {
    plan_forward();
    double additions, products, both;
    fftw_flops(to_frequency.get(), &additions, &products, &both);
    return additions + products + 2 * both + 5.0 * samples;
  }
};

#endif

int fast_transform_size(int at_least)
{
  const auto is_fast = [](int n) {
    for (int factor : {2, 3, 5, 7})
      while (n % factor == 0) n /= factor;
    return n == 1;
  };
  int n = std::max(2, at_least + at_least % 2);
  while (!is_fast(n)) n += 2;
  return n;
}

int default_samples(int harmonics)
{
  constexpr double coefficient = 2.0 / 3, order = 8.0 / 5, most = 1 << 17;
  const double as_truncation = coefficient * std::pow(harmonics, order);
  return fast_transform_size(
      std::max({32, 8 * harmonics + 1, static_cast<int>(std::min(as_truncation, most))}));
}

/** Plans of transforms that are gone wait for the next one of their length: planning
    costs as much as some hundred transforms, and a search at one speed asks for the same
    few lengths again and again. */
std::multimap<int, std::unique_ptr<FourierTransform::Plans>>& FourierTransform::idle()
{
  thread_local std::multimap<int, std::unique_ptr<Plans>> plans;
  return plans;
}

FourierTransform::FourierTransform(int samples)
{
  auto waiting = idle().extract(samples);
  plans_.reset(waiting.empty() ? new Plans(samples) : waiting.mapped().release());
}

void FourierTransform::KeepForNext::operator()(Plans* plans) const
{
  constexpr int longest = 1 << 14;
  constexpr std::size_t most = 64;
  std::unique_ptr<Plans> own(plans);
  if (own->samples <= longest && idle().size() < most)
    idle().emplace(own->samples, std::move(own));
}

double FourierTransform::operations() const
{
  return plans_->operations();
}

/** Where harmonic h stands. */
static Eigen::Index place(const Images& images, Eigen::Index h)
{
  return images.empty() ? h : images[h];
}

void FourierTransform::to_samples(const Eigen::Ref<const Eigen::MatrixXd>& series,
                                  Eigen::MatrixXd& samples, const Images& images)
{
  const int n = plans_->samples;
  const auto harmonics = (series.cols() - 1) / 2;
  std::complex<double>* spectrum = &plans_->frequency[0];
  samples.resize(n, series.rows());
  for (Eigen::Index row = 0; row < series.rows(); ++row) {
    std::fill(spectrum + 1, spectrum + n / 2 + 1, 0.0);
    spectrum[0] = series(row, 0);
    for (Eigen::Index h = 1; h <= harmonics; ++h) {
      const Eigen::Index p = place(images, h);
      const double sine = series(row, 2 * h);
      spectrum[std::abs(p)] =
          0.5 * std::complex(series(row, 2 * h - 1), p < 0 ? sine : -sine);
    }
    plans_->backward();
    std::copy_n(&plans_->time[0], n, samples.col(row).data());
  }
}

void FourierTransform::to_series(const Eigen::MatrixXd& samples,
                                 Eigen::Ref<Eigen::MatrixXd> series, const Images& images)
{
  const auto harmonics = (series.cols() - 1) / 2;
  for (Eigen::Index row = 0; row < series.rows(); ++row) {
    const auto kappa = spectrum(samples.col(row));
    series(row, 0) = kappa[0].real();
    for (Eigen::Index h = 1; h <= harmonics; ++h) {
      const Eigen::Index p = place(images, h);
      const double sine = 2 * kappa[std::abs(p)].imag();
      series(row, 2 * h - 1) = 2 * kappa[std::abs(p)].real();
      series(row, 2 * h) = p < 0 ? sine : -sine;
    }
  }
}

Eigen::Map<const Eigen::VectorXcd> FourierTransform::spectrum(
    const Eigen::Ref<const Eigen::VectorXd>& column)
{
  const int n = plans_->samples;
  std::copy_n(column.data(), n, &plans_->time[0]);
  plans_->forward();
  Eigen::Map<Eigen::VectorXcd> kappa(&plans_->frequency[0], n / 2 + 1);
  kappa *= 1.0 / n;
  return {&plans_->frequency[0], n / 2 + 1};
}

Eigen::MatrixXd sample_series(const Eigen::MatrixXd& series, int points)
{
  const int stride = static_cast<int>((series.cols() + points - 1) / points);
  Eigen::MatrixXd fine;
  FourierTransform(points * stride).to_samples(series, fine);
  return fine(Eigen::seqN(0, points, stride), Eigen::all);
}

Eigen::MatrixXd differentiate(const Eigen::MatrixXd& series)
{
  Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(series.rows(), series.cols());
  for (Eigen::Index h = 1; 2 * h < series.cols(); ++h) {
    slope.col(2 * h - 1) = static_cast<double>(h) * series.col(2 * h);
    slope.col(2 * h) = -static_cast<double>(h) * series.col(2 * h - 1);
  }
  return slope;
}

Vertex vertex(double before, double top, double after)
{
  const double curvature = before - 2 * top + after;
  const double slope = 0.5 * (after - before);
  if (curvature == 0) return {0, top};
  return {-slope / curvature, top - 0.5 * slope * slope / curvature};
}

double largest_of(const Eigen::VectorXd& x, bool is_closed)
{
  Eigen::Index k = 0;
  const Eigen::Index n = x.size();
  const double top = x.maxCoeff(&k);
  if (!is_closed && (k == 0 || k + 1 == n)) return top;
  return vertex(x[(k + n - 1) % n], top, x[(k + 1) % n]).height;
}

double half_range(const Eigen::VectorXd& x, bool is_closed)
{
  return 0.5 * (largest_of(x, is_closed) + largest_of(-x, is_closed));
}

Eigen::VectorXd half_peak_to_peak(const Eigen::MatrixXd& series)
{
  const int n = fast_transform_size(std::max(256, 8 * static_cast<int>(series.cols())));
  Eigen::MatrixXd samples;
  FourierTransform(n).to_samples(series, samples);
  Eigen::VectorXd amplitude(series.rows());
  for (Eigen::Index row = 0; row < series.rows(); ++row)
    amplitude[row] = half_range(samples.col(row), true);
  return amplitude;
}

}  // namespace rotor_stator
