#include "stability/hill.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "balance/fourier_transform.hpp"
#include "stability/eigenvalues.hpp"

namespace rotor_stator {

namespace {

using Complex = std::complex<double>;

/** κ_p, p = 0…2H, each d × d. */
std::vector<Eigen::MatrixXcd> stiffness_spectrum(const PeriodicStiffness& stiffness,
                                                 Eigen::Index d, int harmonics)
{
  const int n = fast_transform_size(std::max(4096, 64 * harmonics));
  Eigen::MatrixXd samples(d * d, n);
  for (int k = 0; k < n; ++k)
    stiffness.at(2 * std::numbers::pi * k / n, samples.col(k).data());
  std::vector<Eigen::MatrixXcd> kappa(2 * harmonics + 1, Eigen::MatrixXcd(d, d));
  FourierTransform transform(n);
  for (Eigen::Index entry = 0; entry < d * d; ++entry) {
    const auto spectrum = transform.spectrum(samples.row(entry).transpose());
    for (int p = 0; p <= 2 * harmonics; ++p) kappa[p].reshaped()[entry] = spectrum[p];
  }
  return kappa;
}

/** Block k, l of the sum over the harmonics of k(φ). */
Eigen::MatrixXcd coupling(const std::vector<Eigen::MatrixXcd>& kappa, int k, int l)
{
  return k >= l ? kappa[k - l] : Eigen::MatrixXcd(kappa[l - k].conjugate());
}

/** p_k, k = -H…H, from the cosines and sines of a real series: p = T a, T unitary. */
Eigen::MatrixXcd from_real(Eigen::Index d, int harmonics)
{
  const Eigen::MatrixXcd one = Eigen::MatrixXcd::Identity(d, d);
  const double root = std::sqrt(0.5);
  const auto at = [&](int k) { return d * (harmonics + k); };
  Eigen::MatrixXcd t = Eigen::MatrixXcd::Zero(at(harmonics + 1), at(harmonics + 1));
  t.block(at(0), at(0), d, d) = one;
  for (int k = 1; k <= harmonics; ++k) {
    t.block(at(k), at(k), d, d) = t.block(at(-k), at(k), d, d) = root * one;
    t.block(at(k), at(-k), d, d) = Complex(0, -root) * one;
    t.block(at(-k), at(-k), d, d) = Complex(0, root) * one;
  }
  return t;
}

/** The quadratic problem λ² + λ R + S, times M⁻¹ and in cosines and sines. */
struct Quadratic {
  Eigen::MatrixXd linear, constant;
};

Quadratic quadratic_of(const Vibration& v, const std::vector<Eigen::MatrixXcd>& kappa,
                       double omega, int harmonics, const Eigen::MatrixXcd& t)
{
  const auto d = v.mass.rows();
  const Eigen::MatrixXd per_mass = v.mass.inverse();
  Eigen::MatrixXcd linear = Eigen::MatrixXcd::Zero(t.rows(), t.rows()), constant = linear;
  for (int k = -harmonics; k <= harmonics; ++k) {
    const auto row = d * (harmonics + k);
    const Complex turn(0, k * omega);
    linear.block(row, row, d, d) =
        per_mass * v.damping + 2.0 * turn * Eigen::MatrixXcd::Identity(d, d);
    for (int l = -harmonics; l <= harmonics; ++l)
      constant.block(row, d * (harmonics + l), d, d) = per_mass * coupling(kappa, k, l);
    constant.block(row, row, d, d) += per_mass * (v.stiffness + turn * v.damping) +
                                      turn * turn * Eigen::MatrixXcd::Identity(d, d);
  }
  return {(t.adjoint() * linear * t).real(), (t.adjoint() * constant * t).real()};
}

struct Candidate {
  Complex exponent;
  double rank;  ///< the smaller, the better its harmonics are held
};

/** Distance of the mean harmonic of p from 0. */
double asymmetry(const Eigen::VectorXcd& p, Eigen::Index d)
{
  const auto harmonics = (p.size() / d - 1) / 2;
  double mean = 0;
  for (Eigen::Index k = -harmonics; k <= harmonics; ++k)
    mean += static_cast<double>(k) * p.segment(d * (harmonics + k), d).squaredNorm();
  return std::abs(mean) / p.squaredNorm();
}

std::vector<Candidate> candidates(const Quadratic& q, const Eigen::MatrixXcd& t,
                                  Eigen::Index d, HillChoice choice)
{
  const auto n = t.rows();
  /** The second half of the vector is λ p / r: both halves are of one size. */
  const double rate = std::sqrt(q.constant.norm() / std::sqrt(n));
  Eigen::MatrixXd standard(2 * n, 2 * n);
  standard << Eigen::MatrixXd::Zero(n, n), rate * Eigen::MatrixXd::Identity(n, n),
      -q.constant / rate, -q.linear;
  const bool symmetric = choice == HillChoice::most_symmetric;
  const Eigensystem system = eigensystem(standard, symmetric);
  std::vector<Candidate> all;
  for (Eigen::Index j = 0; j < 2 * n; ++j) {
    const Complex exponent = system.values[j];
    all.push_back({exponent, symmetric ? asymmetry(t * system.vectors.col(j).head(n), d)
                                       : std::abs(exponent.imag())});
  }
  std::sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
    return a.rank != b.rank ? a.rank < b.rank : a.exponent.imag() > b.exponent.imag();
  });
  return all;
}

/** Whether two exponents differ by i n ω, n ≠ 0, as far as cut series can show it. */
bool is_copy(Complex a, Complex b, double omega)
{
  const double turns = std::round((a - b).imag() / omega);
  return turns != 0 && std::abs(a - b - Complex(0, turns * omega)) < 0.02 * omega;
}

}  // namespace

Multipliers hill_multipliers(const Vibration& vibration,
                             const PeriodicStiffness& stiffness, double period,
                             int harmonics, HillChoice choice)
{
  const auto d = vibration.mass.rows();
  const double omega = 2 * std::numbers::pi / period;
  const auto kappa = stiffness_spectrum(stiffness, d, harmonics);
  const Eigen::MatrixXcd t = from_real(d, harmonics);
  const Quadratic q = quadratic_of(vibration, kappa, omega, harmonics, t);
  std::vector<Complex> chosen;
  for (const Candidate& c : candidates(q, t, d, choice)) {
    if (static_cast<Eigen::Index>(chosen.size()) == 2 * d) break;
    if (std::none_of(chosen.begin(), chosen.end(),
                     [&](Complex other) { return is_copy(c.exponent, other, omega); }))
      chosen.push_back(c.exponent);
  }
  Multipliers multipliers;
  for (const Complex& exponent : chosen)
    multipliers.push_back(std::exp(exponent * period));
  sort_by_modulus(multipliers);
  return multipliers;
}

}  // namespace rotor_stator
