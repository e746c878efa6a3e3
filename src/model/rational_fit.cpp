#include "model/rational_fit.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace rotor_stator {

namespace {

using Complex = std::complex<double>;

constexpr Eigen::Index first_intervals = 24, most_samples = 1500, most_support = 100;

/** Few random combinations of all components, which have their common poles too. */
Eigen::MatrixXcd combinations(Eigen::Index components)
{
  std::mt19937 random(1);
  Eigen::MatrixXcd mix(std::min<Eigen::Index>(4, components), components);
  for (Eigen::Index i = 0; i < mix.size(); ++i)
    mix(i) = std::polar(1.0, static_cast<double>(random()) / 4294967296.0 * 6.283);
  return mix;
}

}  // namespace

RationalFit::RationalFit(const Function& f, double from, double to, double tolerance)
    : from_(from), to_(to)
{
  std::vector<std::pair<double, double>> open;
  const double step = (to - from) / first_intervals;
  for (Eigen::Index k = 0; k <= first_intervals; ++k)
    sample(f, from + static_cast<double>(k) * step);
  for (Eigen::Index k = 0; k < first_intervals; ++k)
    open.emplace_back(points_[k], points_[k + 1]);
  fit(tolerance);
  while (!open.empty() && values_.cols() < most_samples) {
    std::vector<std::pair<double, double>> missed;
    for (const auto& [a, b] : open) {
      const double middle = (a + b) / 2;
      sample(f, middle);
      if (miss(values_.cols() - 1) <= tolerance) continue;
      missed.emplace_back(a, middle);
      missed.emplace_back(middle, b);
    }
    if (!missed.empty()) fit(tolerance);
    open = std::move(missed);
  }
  is_good_ = open.empty();
  for (Eigen::Index k = 0; k < values_.cols(); ++k)
    is_good_ = is_good_ && miss(k) <= 10 * tolerance;
}

void RationalFit::sample(const Function& f, double x)
{
  const Eigen::VectorXcd value = f(x);
  const Eigen::Index k = values_.cols();
  points_.conservativeResize(k + 1);
  values_.conservativeResize(value.size(), k + 1);
  points_[k] = x;
  values_.col(k) = value;
  if (k == 0) largest_.setZero(value.size());
  largest_ = largest_.cwiseMax(value.cwiseAbs());
  sizes_ = largest_.array().max(0.1 * largest_.maxCoeff()).max(1e-300);
}

/** The largest error of a component at a sample, over its size. */
double RationalFit::miss(Eigen::Index sample) const
{
  const Eigen::VectorXcd off = at(points_[sample]).value - values_.col(sample);
  return std::sqrt((off.array().abs2() / sizes_.square()).maxCoeff());
}

void RationalFit::fit(double tolerance)
{
  while (support_.size() < std::min(most_support, values_.cols() / 2)) {
    Eigen::Index worst = 0;
    double most = -1;
    for (Eigen::Index k = 0; k < values_.cols(); ++k)
      if (const double off = support_.size() == 0 ? 1.0 : miss(k); off > most) {
        most = off;
        worst = k;
      }
    if (most <= 0.1 * tolerance) return;
    const Eigen::Index j = support_.size();
    if ((support_.array() == points_[worst]).any()) return;
    support_.conservativeResize(j + 1);
    supported_.conservativeResize(values_.rows(), j + 1);
    support_[j] = points_[worst];
    supported_.col(j) = values_.col(worst);
    find_weights();
  }
}

/** The vector of the smallest singular value of the Loewner matrix. */
void RationalFit::find_weights()
{
  const Eigen::MatrixXcd mix =
      combinations(values_.rows()) * sizes_.inverse().matrix().asDiagonal();
  const Eigen::MatrixXcd mixed = mix * values_, held = mix * supported_;
  const Eigen::Index functions = mixed.rows(), columns = support_.size();
  weights_.setOnes(columns);
  if (columns == 1) return;
  Eigen::MatrixXcd loewner =
      Eigen::MatrixXcd::Zero(std::max(functions * values_.cols(), columns), columns);
  for (Eigen::Index k = 0, row = 0; k < values_.cols(); ++k) {
    if ((support_.array() == points_[k]).any()) continue;
    for (Eigen::Index i = 0; i < functions; ++i, ++row)
      for (Eigen::Index j = 0; j < columns; ++j)
        loewner(row, j) = (mixed(i, k) - held(i, j)) / (points_[k] - support_[j]);
  }
  const Eigen::HouseholderQR<Eigen::MatrixXcd> qr(loewner);
  Eigen::MatrixXcd r = qr.matrixQR().topRows(columns).triangularView<Eigen::Upper>();
  r.diagonal().array() +=
      1e-20 * r.diagonal().cwiseAbs().maxCoeff() + 1e-300;  // nothing is divided by zero
  for (int iteration = 0; iteration < 5; ++iteration) {
    r.adjoint().triangularView<Eigen::Lower>().solveInPlace(weights_);
    weights_.normalize();
    r.triangularView<Eigen::Upper>().solveInPlace(weights_);
    weights_.normalize();
  }
}

RationalFit::At RationalFit::at(double x) const
{
  Eigen::Index same = -1;
  for (Eigen::Index j = 0; j < support_.size(); ++j)
    if (std::abs(x - support_[j]) <= 1e-13 * (to_ - from_)) same = j;
  if (same >= 0) {
    Eigen::VectorXcd slope = Eigen::VectorXcd::Zero(supported_.rows());
    for (Eigen::Index j = 0; j < support_.size(); ++j)
      if (j != same)
        slope -= weights_[j] / weights_[same] *
                 (supported_.col(same) - supported_.col(j)) /
                 (support_[same] - support_[j]);
    return {supported_.col(same), slope};
  }
  const Eigen::ArrayXd per_distance = (x - support_.array()).inverse();
  Eigen::MatrixX2cd shares(support_.size(), 2);
  shares.col(0) = weights_.array() * per_distance;
  shares.col(1) = shares.col(0).array() * per_distance;
  const Complex per = 1.0 / shares.col(0).sum();
  const Eigen::MatrixX2cd sums = per * (supported_ * shares);
  return {sums.col(0), per * shares.col(1).sum() * sums.col(0) - sums.col(1)};
}

}  // namespace rotor_stator
