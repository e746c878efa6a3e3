#include "balance/equations_in_time.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/registers.hpp"

namespace rotor_stator {

namespace {

using Block = EquationsInTime::Block;
using Vector = EquationsInTime::Vector;
using Neighbour = EquationsInTime::Neighbour;

/** So many times as many samples that the contact's vibration turns by at most `most` in a step: beyond, the
    differences have resonances that the motion has not. */
Eigen::Index refinement(const Eigen::MatrixXd& stiffness, double inverse_mass,
                        double omega)
{
  constexpr double most = 2.2;
  const double fastest = std::sqrt(inverse_mass * stiffness.rowwise().norm().maxCoeff());
  const double turn =
      fastest * 2 * std::numbers::pi / (omega * static_cast<double>(stiffness.rows()));
  return static_cast<Eigen::Index>(std::clamp(std::ceil(turn / most), 1.0, 4.0));
}

IN_PLACE Block times(const Block& a, const Block& b)
{
  Block c;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) c.at[4 * i + j] = a.at[4 * i] * b.at[j];
    for (int k = 1; k < 4; ++k)
      for (int j = 0; j < 4; ++j) c.at[4 * i + j] += a.at[4 * i + k] * b.at[4 * k + j];
  }
  return c;
}

/** The contact pushes the bodies apart: rows x_s, y_s of (contact) (X_s - X_r), and the opposite. */
IN_PLACE Block times(const Neighbour& n, const Block& x)
{
  const double* c = n.contact;
  Block result;
  for (int j = 0; j < 4; ++j) {
    const double dx = x.at[j] - x.at[8 + j], dy = x.at[4 + j] - x.at[12 + j];
    const double px = c[0] * dx + c[2] * dy, py = c[1] * dx + c[3] * dy;
    result.at[j] = n.stator * x.at[j] + px;
    result.at[4 + j] = n.stator * x.at[4 + j] + py;
    result.at[8 + j] = n.rotor * x.at[8 + j] - px;
    result.at[12 + j] = n.rotor * x.at[12 + j] - py;
  }
  return result;
}

IN_PLACE Block times(const Block& x, const Neighbour& n)
{
  const double* c = n.contact;
  Block result;
  for (int i = 0; i < 4; ++i) {
    const double* row = x.at + 4 * i;
    const double dx = row[0] - row[2], dy = row[1] - row[3];
    const double px = dx * c[0] + dy * c[1], py = dx * c[2] + dy * c[3];
    result.at[4 * i] = row[0] * n.stator + px;
    result.at[4 * i + 1] = row[1] * n.stator + py;
    result.at[4 * i + 2] = row[2] * n.rotor - px;
    result.at[4 * i + 3] = row[3] * n.rotor - py;
  }
  return result;
}

IN_PLACE Vector times(const Block& a, const Vector& v)
{
  Vector result;
  for (int i = 0; i < 4; ++i) {
    const double* row = a.at + 4 * i;
    result.at[i] =
        (row[0] * v.at[0] + row[1] * v.at[1]) + (row[2] * v.at[2] + row[3] * v.at[3]);
  }
  return result;
}

IN_PLACE Vector times(const Neighbour& n, const Vector& v)
{
  const double* c = n.contact;
  const double dx = v.at[0] - v.at[2], dy = v.at[1] - v.at[3];
  const double px = c[0] * dx + c[2] * dy, py = c[1] * dx + c[3] * dy;
  return {{n.stator * v.at[0] + px, n.stator * v.at[1] + py, n.rotor * v.at[2] - px,
           n.rotor * v.at[3] - py}};
}

template <class Number>
IN_PLACE void subtract(Number& a, const Number& b)
{
  for (std::size_t k = 0; k < std::size(a.at); ++k) a.at[k] -= b.at[k];
}

/** By the minors of the upper and of the lower two rows. */
IN_PLACE Block inverse(const Block& block)
{
  const double* a = block.at;
  const double s0 = a[0] * a[5] - a[4] * a[1], s1 = a[0] * a[6] - a[4] * a[2],
               s2 = a[0] * a[7] - a[4] * a[3], s3 = a[1] * a[6] - a[5] * a[2],
               s4 = a[1] * a[7] - a[5] * a[3], s5 = a[2] * a[7] - a[6] * a[3];
  const double c5 = a[10] * a[15] - a[14] * a[11], c4 = a[9] * a[15] - a[13] * a[11],
               c3 = a[9] * a[14] - a[13] * a[10], c2 = a[8] * a[15] - a[12] * a[11],
               c1 = a[8] * a[14] - a[12] * a[10], c0 = a[8] * a[13] - a[12] * a[9];
  const double per = 1 / (s0 * c5 - s1 * c4 + s2 * c3 + s3 * c2 - s4 * c1 + s5 * c0);
  return {{(a[5] * c5 - a[6] * c4 + a[7] * c3) * per,
           (-a[1] * c5 + a[2] * c4 - a[3] * c3) * per,
           (a[13] * s5 - a[14] * s4 + a[15] * s3) * per,
           (-a[9] * s5 + a[10] * s4 - a[11] * s3) * per,
           (-a[4] * c5 + a[6] * c2 - a[7] * c1) * per,
           (a[0] * c5 - a[2] * c2 + a[3] * c1) * per,
           (-a[12] * s5 + a[14] * s2 - a[15] * s1) * per,
           (a[8] * s5 - a[10] * s2 + a[11] * s1) * per,
           (a[4] * c4 - a[5] * c2 + a[7] * c0) * per,
           (-a[0] * c4 + a[1] * c2 - a[3] * c0) * per,
           (a[12] * s4 - a[13] * s2 + a[15] * s0) * per,
           (-a[8] * s4 + a[9] * s2 - a[11] * s0) * per,
           (-a[4] * c3 + a[5] * c1 - a[6] * c0) * per,
           (a[0] * c3 - a[1] * c1 + a[2] * c0) * per,
           (-a[12] * s3 + a[13] * s1 - a[14] * s0) * per,
           (a[8] * s3 - a[9] * s1 + a[10] * s0) * per}};
}

}  // namespace

void EquationsInTime::factor(const Eigen::MatrixXd& stiffness, double omega)
{
  const Eigen::Index given = stiffness.rows(),
                     times = refinement(stiffness,
                                        1 / bodies_[0].mass + 1 / bodies_[1].mass, omega);
  const Eigen::Index n = times * given;
  const double step = 2 * std::numbers::pi / (omega * static_cast<double>(n));
  for (int body = 0; body < 2; ++body) {
    constants_.mass[body] = bodies_[body].mass / (step * step);
    constants_.damping[body] = bodies_[body].damping / (2 * step);
    constants_.spring[body] = bodies_[body].stiffness / 12;
  }
  contact_.resize(static_cast<std::size_t>(n));
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Index first = k / times, next = first + 1 == given ? 0 : first + 1;
    const double rest = static_cast<double>(k % times) / static_cast<double>(times);
    for (int i = 0; i < 4; ++i)
      contact_[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)] =
          ((1 - rest) * stiffness(first, i) + rest * stiffness(next, i)) / 12;
  }
  chain_.resize(static_cast<std::size_t>(n - 1));
  q_.resize(static_cast<std::size_t>(n));
  eliminate();
}

/** The block of sample k in the equations of the one after it (`sign` = -1) or before it (1). */
IN_PLACE EquationsInTime::Neighbour EquationsInTime::neighbour(std::size_t k,
                                                               double sign) const
{
  const auto& [mass, damping, spring] = constants_;
  return {spring[0] + (mass[0] + sign * damping[0]),
          spring[1] + (mass[1] + sign * damping[1]), contact_[k].data()};
}

/** The last sample is the border of a chain; its column fills the chain from both ends. */
WIDEST_REGISTERS void EquationsInTime::eliminate()
{
  const std::size_t n = contact_.size(), last = n - 1;
  const Constants& body = constants_;
  const auto own = [&](std::size_t k) {
    const double* c = contact_[k].data();
    const double s = 10 * body.spring[0] - 2 * body.mass[0],
                 r = 10 * body.spring[1] - 2 * body.mass[1];
    return Block{{s + 10 * c[0], 10 * c[2], -10 * c[0], -10 * c[2],  //
                  10 * c[1], s + 10 * c[3], -10 * c[1], -10 * c[3],  //
                  -10 * c[0], -10 * c[2], r + 10 * c[0], 10 * c[2],  //
                  -10 * c[1], -10 * c[3], 10 * c[1], r + 10 * c[3]}};
  };
  const Block one{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
  for (std::size_t k = 0; k < last; ++k) {
    Link& link = chain_[k];
    Block diagonal = own(k), border{};
    const Neighbour before = neighbour(k == 0 ? last : k - 1, -1),
                    after = neighbour(k + 1, 1);
    if (k == 0) {
      border = times(before, one);
    } else {
      subtract(diagonal, times(before, chain_[k - 1].after));
      subtract(border, times(before, chain_[k - 1].last));
    }
    if (k == last - 1) {
      Block more = times(after, one);
      for (int i = 0; i < 16; ++i) border.at[i] += more.at[i];
    }
    link.inverse = inverse(diagonal);
    link.after = times(link.inverse, after);
    link.last = times(link.inverse, border);
  }
  for (std::size_t k = last - 1; k-- > 0;)
    subtract(chain_[k].last, times(chain_[k].after, chain_[k + 1].last));
  Block closing = own(last);
  subtract(closing, times(neighbour(0, 1), chain_.front().last));
  subtract(closing, times(neighbour(last - 1, -1), chain_.back().last));
  closing_ = inverse(closing);
}

void EquationsInTime::solve(const Eigen::MatrixXd& load, Eigen::MatrixXd& u)
{
  u.resize(samples(), 2);
  substitute(load, u);
}

WIDEST_REGISTERS void EquationsInTime::substitute(const Eigen::MatrixXd& load,
                                                  Eigen::MatrixXd& u)
{
  const std::size_t n = q_.size(), last = n - 1;
  const double *g_x = load.col(0).data(), *g_y = load.col(1).data();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = k == last ? 0 : k + 1, previous = k == 0 ? last : k - 1;
    const double x = (g_x[previous] + 10 * g_x[k] + g_x[next]) / 12,
                 y = (g_y[previous] + 10 * g_y[k] + g_y[next]) / 12;
    q_[k] = {{-x, -y, x, y}};
  }
  q_[0] = times(chain_[0].inverse, q_[0]);
  for (std::size_t k = 1; k < last; ++k) {
    subtract(q_[k], times(neighbour(k - 1, -1), q_[k - 1]));
    q_[k] = times(chain_[k].inverse, q_[k]);
  }
  for (std::size_t k = last - 1; k-- > 0;)
    subtract(q_[k], times(chain_[k].after, q_[k + 1]));
  subtract(q_[last], times(neighbour(0, 1), q_[0]));
  subtract(q_[last], times(neighbour(last - 1, -1), q_[last - 1]));
  q_[last] = times(closing_, q_[last]);
  for (std::size_t k = 0; k < last; ++k) subtract(q_[k], times(chain_[k].last, q_[last]));
  double *u_x = u.col(0).data(), *u_y = u.col(1).data();
  for (std::size_t k = 0; k < n; ++k) {
    u_x[k] = q_[k].at[2] - q_[k].at[0];
    u_y[k] = q_[k].at[3] - q_[k].at[1];
  }
}

}  // namespace rotor_stator
