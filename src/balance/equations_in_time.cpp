#include "balance/equations_in_time.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace rotor_stator {

namespace {

/** So many times as many samples that the contact's vibration turns by at most `most` in a step: beyond, the
    differences have resonances that the motion has not. */
Eigen::Index refinement(const Eigen::MatrixXd& stiffness, double inverse_mass,
                        double omega)
{
  constexpr double most = 1.5;
  const double fastest = std::sqrt(inverse_mass * stiffness.rowwise().norm().maxCoeff());
  const double turn =
      fastest * 2 * std::numbers::pi / (omega * static_cast<double>(stiffness.rows()));
  return static_cast<Eigen::Index>(std::clamp(std::ceil(turn / most), 1.0, 4.0));
}

}  // namespace

void EquationsInTime::factor(const Eigen::MatrixXd& stiffness, double omega)
{
  const Eigen::Index given = stiffness.rows(),
                     times = refinement(stiffness,
                                        1 / bodies_[0].mass + 1 / bodies_[1].mass, omega);
  const Eigen::Index n = times * given, last = n - 1;
  const double step = 2 * std::numbers::pi / (omega * static_cast<double>(n));
  Vector mass, damping, spring;
  for (int body = 0; body < 2; ++body) {
    mass.segment<2>(2 * body).setConstant(bodies_[body].mass / (step * step));
    damping.segment<2>(2 * body).setConstant(bodies_[body].damping / (2 * step));
    spring.segment<2>(2 * body).setConstant(bodies_[body].stiffness);
  }
  const auto twelfth_of_springs = [&](Eigen::Index k) {
    const Eigen::Index at = (k + n) % n, first = at / times;
    const double rest = static_cast<double>(at % times) / static_cast<double>(times);
    const Eigen::RowVector4d row =
        ((1 - rest) * stiffness.row(first) + rest * stiffness.row((first + 1) % given)) /
        12;
    const Eigen::Matrix2d contact = Eigen::Map<const Eigen::Matrix2d>(row.data());
    Block springs;
    springs << contact, -contact, -contact, contact;
    springs.diagonal() += spring / 12;
    return springs;
  };
  const auto before = [&](Eigen::Index k) {
    Block block = twelfth_of_springs(k - 1);
    block.diagonal() += mass - damping;
    return block;
  };
  const auto at = [&](Eigen::Index k) {
    Block block = 10 * twelfth_of_springs(k);
    block.diagonal() -= 2 * mass;
    return block;
  };
  const auto after = [&](Eigen::Index k) {
    Block block = twelfth_of_springs(k + 1);
    block.diagonal() += mass + damping;
    return block;
  };

  /** The last sample is the border of a chain; its column fills the chain from both ends. */
  chain_.resize(static_cast<std::size_t>(last));
  for (Eigen::Index k = 0; k < last; ++k) {
    Link& link = chain_[k];
    Block diagonal = at(k), border = Block::Zero();
    link.before = before(k);
    if (k == 0) {
      border = link.before;
    } else {
      diagonal -= link.before * chain_[k - 1].after;
      border = -link.before * chain_[k - 1].last;
    }
    if (k == last - 1) border += after(k);
    link.inverse = diagonal.inverse();
    link.after = link.inverse * after(k);
    link.last = link.inverse * border;
  }
  for (Eigen::Index k = last - 1; k-- > 0;)
    chain_[k].last -= chain_[k].after * chain_[k + 1].last;
  after_last_ = after(last);
  before_last_ = before(last);
  closing_ =
      (at(last) - after_last_ * chain_.front().last - before_last_ * chain_.back().last)
          .inverse();
}

void EquationsInTime::solve(const Eigen::MatrixXd& load, Eigen::MatrixXd& u)
{
  const std::size_t n = chain_.size() + 1, last = n - 1;
  q_.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = k == last ? 0 : k + 1, previous = k == 0 ? last : k - 1;
    const Eigen::Vector2d g =
        (load.row(previous) + 10 * load.row(k) + load.row(next)).transpose() / 12;
    q_[k] << -g, g;
  }
  q_[0] = chain_[0].inverse * q_[0];
  for (std::size_t k = 1; k < last; ++k)
    q_[k] = chain_[k].inverse * (q_[k] - chain_[k].before * q_[k - 1]);
  for (std::size_t k = last - 1; k-- > 0;) q_[k] -= chain_[k].after * q_[k + 1];
  q_[last] = closing_ * (q_[last] - after_last_ * q_[0] - before_last_ * q_[last - 1]);
  for (std::size_t k = 0; k < last; ++k) q_[k] -= chain_[k].last * q_[last];
  u.resize(static_cast<Eigen::Index>(n), 2);
  for (std::size_t k = 0; k < n; ++k)
    u.row(static_cast<Eigen::Index>(k)) = (q_[k].tail<2>() - q_[k].head<2>()).transpose();
}

}  // namespace rotor_stator
