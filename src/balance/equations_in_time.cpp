#include "balance/equations_in_time.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "balance/fourier_transform.hpp"
#include "model/registers.hpp"

namespace rotor_stator {

namespace {

template <class Number>
using Block = EquationsInTime::Block<Number>;
template <class Number>
using Vector = EquationsInTime::Vector<Number>;
using Lanes = EquationsInTime::Lanes;
using Neighbour = EquationsInTime::Neighbour;
constexpr int parts = EquationsInTime::parts;

/** So many times as many samples that the contact's vibration turns by at most `most` in a step: beyond, the
    differences have resonances that the motion has not. */
Eigen::Index refinement(const Eigen::MatrixXd& stiffness, double inverse_mass,
                        double omega)
{
  constexpr double most = 1.4;
  const double fastest = std::sqrt(inverse_mass * stiffness.rowwise().norm().maxCoeff());
  const double turn =
      fastest * 2 * std::numbers::pi / (omega * static_cast<double>(stiffness.rows()));
  return static_cast<Eigen::Index>(std::clamp(std::ceil(turn / most), 1.0, 4.0));
}

/** Whole parts of at least two samples, of a size that is fast to transform. */
Eigen::Index samples_of_parts(Eigen::Index at_least)
{
  const auto quarter =
      static_cast<int>((std::max<Eigen::Index>(at_least, 2 * parts) + 3) / 4);
  return 4 * fast_transform_size(quarter);  // which is even
}

template <class Number>
IN_PLACE Block<Number> times(const Block<Number>& a, const Block<Number>& b)
{
  Block<Number> c;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      c.at[4 * i + j] = (a.at[4 * i] * b.at[j] + a.at[4 * i + 1] * b.at[4 + j]) +
                        (a.at[4 * i + 2] * b.at[8 + j] + a.at[4 * i + 3] * b.at[12 + j]);
  return c;
}

/** The contact pushes the bodies apart. */
IN_PLACE Block<Lanes> whole(const Neighbour& n)
{
  const Lanes &xx = n.contact[0], &yx = n.contact[1], &xy = n.contact[2],
              &yy = n.contact[3];
  return {{n.stator + xx, xy, -xx, -xy, yx, n.stator + yy, -yx, -yy,  //
           -xx, -xy, n.rotor + xx, xy, -yx, -yy, yx, n.rotor + yy}};
}

/** Rows x_s, y_s of (contact) (X_s - X_r), and the opposite. */
IN_PLACE Block<Lanes> times(const Neighbour& n, const Block<Lanes>& x)
{
  const Lanes* c = n.contact;
  Block<Lanes> result;
  for (int j = 0; j < 4; ++j) {
    const Lanes dx = x.at[j] - x.at[8 + j], dy = x.at[4 + j] - x.at[12 + j];
    const Lanes px = c[0] * dx + c[2] * dy, py = c[1] * dx + c[3] * dy;
    result.at[j] = n.stator * x.at[j] + px;
    result.at[4 + j] = n.stator * x.at[4 + j] + py;
    result.at[8 + j] = n.rotor * x.at[8 + j] - px;
    result.at[12 + j] = n.rotor * x.at[12 + j] - py;
  }
  return result;
}

IN_PLACE Block<Lanes> times(const Block<Lanes>& x, const Neighbour& n)
{
  const Lanes* c = n.contact;
  Block<Lanes> result;
  for (int i = 0; i < 4; ++i) {
    const Lanes* row = x.at + 4 * i;
    const Lanes dx = row[0] - row[2], dy = row[1] - row[3];
    const Lanes px = dx * c[0] + dy * c[1], py = dx * c[2] + dy * c[3];
    result.at[4 * i] = row[0] * n.stator + px;
    result.at[4 * i + 1] = row[1] * n.stator + py;
    result.at[4 * i + 2] = row[2] * n.rotor - px;
    result.at[4 * i + 3] = row[3] * n.rotor - py;
  }
  return result;
}

template <class Number>
IN_PLACE Vector<Number> times(const Block<Number>& a, const Vector<Number>& v)
{
  Vector<Number> result;
  for (int i = 0; i < 4; ++i) {
    const Number* row = a.at + 4 * i;
    result.at[i] =
        (row[0] * v.at[0] + row[1] * v.at[1]) + (row[2] * v.at[2] + row[3] * v.at[3]);
  }
  return result;
}

IN_PLACE Vector<Lanes> times(const Neighbour& n, const Vector<Lanes>& v)
{
  const Lanes* c = n.contact;
  const Lanes dx = v.at[0] - v.at[2], dy = v.at[1] - v.at[3];
  const Lanes px = c[0] * dx + c[2] * dy, py = c[1] * dx + c[3] * dy;
  return {{n.stator * v.at[0] + px, n.stator * v.at[1] + py, n.rotor * v.at[2] - px,
           n.rotor * v.at[3] - py}};
}

template <class Numbers>
IN_PLACE void subtract(Numbers& a, const Numbers& b)
{
  for (std::size_t k = 0; k < std::size(a.at); ++k) a.at[k] -= b.at[k];
}

template <class Numbers>
IN_PLACE Numbers minus(const Numbers& a)
{
  Numbers result;
  for (std::size_t k = 0; k < std::size(a.at); ++k) result.at[k] = -a.at[k];
  return result;
}

/** Those of one part. */
IN_PLACE Block<double> of_part(const Block<Lanes>& block, int part)
{
  Block<double> result;
  for (int i = 0; i < 16; ++i) result.at[i] = block.at[i][part];
  return result;
}

/** Each part's number to the next part, or to the one before. */
IN_PLACE void hand_on(const Lanes& from, Lanes& to)
{
  for (int part = 0; part < parts; ++part) to[(part + 1) % parts] = from[part];
}

IN_PLACE void hand_back(const Lanes& from, Lanes& to)
{
  for (int part = 0; part < parts; ++part) to[part] = from[(part + 1) % parts];
}

/** Sample k of each part of a series over the period. */
IN_PLACE void take(const double* series, std::size_t length, std::size_t k, Lanes& to)
{
  for (std::size_t part = 0; part < parts; ++part) to[part] = series[part * length + k];
}

IN_PLACE void put(const Lanes& from, std::size_t length, std::size_t k, double* series)
{
  for (std::size_t part = 0; part < parts; ++part) series[part * length + k] = from[part];
}

/** By the minors of the upper and of the lower two rows. */
template <class Number>
IN_PLACE Block<Number> inverse(const Block<Number>& block)
{
  const Number* a = block.at;
  const Number s0 = a[0] * a[5] - a[4] * a[1], s1 = a[0] * a[6] - a[4] * a[2],
               s2 = a[0] * a[7] - a[4] * a[3], s3 = a[1] * a[6] - a[5] * a[2],
               s4 = a[1] * a[7] - a[5] * a[3], s5 = a[2] * a[7] - a[6] * a[3];
  const Number c5 = a[10] * a[15] - a[14] * a[11], c4 = a[9] * a[15] - a[13] * a[11],
               c3 = a[9] * a[14] - a[13] * a[10], c2 = a[8] * a[15] - a[12] * a[11],
               c1 = a[8] * a[14] - a[12] * a[10], c0 = a[8] * a[13] - a[12] * a[9];
  const Number per = 1.0 / (s0 * c5 - s1 * c4 + s2 * c3 + s3 * c2 - s4 * c1 + s5 * c0);
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
  const Eigen::Index n = samples_of_parts(times * given), length = n / parts;
  const double step = 2 * std::numbers::pi / (omega * static_cast<double>(n));
  for (int body = 0; body < 2; ++body) {
    constants_.mass[body] = bodies_[body].mass / (step * step);
    constants_.damping[body] = bodies_[body].damping / (2 * step);
    constants_.spring[body] = bodies_[body].stiffness / 12;
  }
  contact_.resize(static_cast<std::size_t>(length));
  chain_.resize(static_cast<std::size_t>(length - 1));
  q_.resize(static_cast<std::size_t>(length));
  Eigen::Index first = 0, rest = 0;  // sample k is `first` and `rest`/n of those given
  for (Eigen::Index part = 0; part < parts; ++part)
    for (Contact& contact : contact_) {
      const Eigen::Index next = first + 1 == given ? 0 : first + 1;
      const double share = static_cast<double>(rest) / static_cast<double>(n);
      for (int i = 0; i < 4; ++i)
        contact.at[i][part] =
            ((1 - share) * stiffness(first, i) + share * stiffness(next, i)) / 12;
      rest += given;
      if (rest < n) continue;
      rest -= n;
      ++first;
    }
  eliminate();
  eliminate_ends();
}

/** The block of a sample with this contact in the equations of the one after it (`sign` = -1) or before it (1), and in its
    own. */
IN_PLACE Neighbour EquationsInTime::neighbour(const Contact& contact, double sign) const
{
  const auto& [mass, damping, spring] = constants_;
  return {spring[0] + (mass[0] + sign * damping[0]),
          spring[1] + (mass[1] + sign * damping[1]), contact.at};
}

IN_PLACE Block<Lanes> EquationsInTime::own(const Contact& contact) const
{
  const auto& [mass, damping, spring] = constants_;
  Contact tenfold;
  for (int i = 0; i < 4; ++i) tenfold.at[i] = 10.0 * contact.at[i];
  return whole({10 * spring[0] - 2 * mass[0], 10 * spring[1] - 2 * mass[1], tenfold.at});
}

/** Of the inner samples; then ends_ holds what couples the last ones, not yet eliminated. */
WIDEST_REGISTERS void EquationsInTime::eliminate()
{
  const std::size_t last = chain_.size();
  for (int i = 0; i < 4; ++i) hand_on(contact_[last].at[i], contact_before_.at[i]);
  for (std::size_t k = 0; k < last; ++k) {
    Link& link = chain_[k];
    Block<Lanes> diagonal = own(contact_[k]);
    if (k > 0)
      subtract(diagonal, times(neighbour(contact_[k - 1], -1), chain_[k - 1].after));
    link.inverse = inverse(diagonal);
    link.after = times(link.inverse, neighbour(contact_[k + 1], 1));
    link.before_part = times(
        link.inverse,
        k == 0 ? whole(neighbour(contact_before_, -1))
               : minus(times(neighbour(contact_[k - 1], -1), chain_[k - 1].before_part)));
  }
  chain_.back().own_part = chain_.back().after;
  for (std::size_t k = last - 1; k-- > 0;) {
    subtract(chain_[k].before_part, times(chain_[k].after, chain_[k + 1].before_part));
    chain_[k].own_part = minus(times(chain_[k].after, chain_[k + 1].own_part));
  }
  const Neighbour from_inner = neighbour(contact_[last - 1], -1),
                  from_next = neighbour(contact_[0], 1);
  Block<Lanes> diagonal = own(contact_[last]);
  subtract(diagonal, times(from_inner, chain_.back().own_part));
  const Block<Lanes> before = minus(times(from_inner, chain_.back().before_part)),
                     here = times(from_next, chain_[0].before_part),
                     after = minus(times(from_next, chain_[0].own_part));
  for (int part = 0; part < parts; ++part) {
    const int next = (part + 1) % parts;
    End& end = ends_[part];
    end.before = of_part(before, part);
    end.inverse = of_part(diagonal, part);
    subtract(end.inverse, of_part(here, next));
    end.after = of_part(after, next);
  }
}

/** The last end is the border of a chain; its column fills the chain from both sides. */
WIDEST_REGISTERS void EquationsInTime::eliminate_ends()
{
  constexpr int last = parts - 1;
  for (int p = 0; p < last; ++p) {
    End& end = ends_[p];
    Block<double> diagonal = end.inverse, border = end.before;
    if (p > 0) {
      subtract(diagonal, times(end.before, ends_[p - 1].after));
      border = minus(times(end.before, ends_[p - 1].last));
    }
    if (p == last - 1)
      for (int i = 0; i < 16; ++i) border.at[i] += end.after.at[i];
    end.inverse = inverse(diagonal);
    end.after = times(end.inverse, end.after);
    end.last = times(end.inverse, border);
  }
  for (int p = last - 1; p-- > 0;)
    subtract(ends_[p].last, times(ends_[p].after, ends_[p + 1].last));
  Block<double> closing = ends_[last].inverse;
  subtract(closing, times(ends_[last].after, ends_[0].last));
  subtract(closing, times(ends_[last].before, ends_[last - 1].last));
  ends_[last].inverse = inverse(closing);
}

void EquationsInTime::solve(const Eigen::MatrixXd& load, Eigen::MatrixXd& u)
{
  u.resize(samples(), 2);
  substitute(load, u);
}

WIDEST_REGISTERS void EquationsInTime::substitute(const Eigen::MatrixXd& load,
                                                  Eigen::MatrixXd& u)
{
  const std::size_t length = q_.size(), last = length - 1;
  const double *g_x = load.col(0).data(), *g_y = load.col(1).data();
  double *u_x = u.col(0).data(), *u_y = u.col(1).data();
  Lanes x_before, y_before, x, y, x_after, y_after, ends;
  take(g_x, length, last, ends);
  hand_on(ends, x_before);
  take(g_y, length, last, ends);
  hand_on(ends, y_before);
  take(g_x, length, 0, x);
  take(g_y, length, 0, y);
  const Lanes x_first = x, y_first = y;
  for (std::size_t k = 0; k < length; ++k) {
    if (k == last) {
      hand_back(x_first, x_after);
      hand_back(y_first, y_after);
    } else {
      take(g_x, length, k + 1, x_after);
      take(g_y, length, k + 1, y_after);
    }
    const Lanes f_x = (x_before + 10.0 * x + x_after) / 12.0,
                f_y = (y_before + 10.0 * y + y_after) / 12.0;
    x_before = x, y_before = y, x = x_after, y = y_after;
    Vector<Lanes> q{{-f_x, -f_y, f_x, f_y}};
    if (k > 0) subtract(q, times(neighbour(contact_[k - 1], -1), q_[k - 1]));
    q_[k] = k == last ? q : times(chain_[k].inverse, q);
  }
  for (std::size_t k = last - 1; k-- > 0;)
    subtract(q_[k], times(chain_[k].after, q_[k + 1]));
  const Vector<Lanes> here = times(neighbour(contact_[0], 1), q_[0]);
  std::array<Vector<double>, parts> end;
  for (int part = 0; part < parts; ++part)
    for (int i = 0; i < 4; ++i)
      end[part].at[i] = q_[last].at[i][part] - here.at[i][(part + 1) % parts];
  substitute_ends(end);
  Vector<Lanes> own, before;
  for (int i = 0; i < 4; ++i) {
    for (int part = 0; part < parts; ++part) own.at[i][part] = end[part].at[i];
    hand_on(own.at[i], before.at[i]);
  }
  q_[last] = own;
  for (std::size_t k = 0; k < length; ++k) {
    Vector<Lanes> q = q_[k];
    if (k < last) {
      subtract(q, times(chain_[k].before_part, before));
      subtract(q, times(chain_[k].own_part, own));
    }
    put(q.at[2] - q.at[0], length, k, u_x);
    put(q.at[3] - q.at[1], length, k, u_y);
  }
}

IN_PLACE void EquationsInTime::substitute_ends(
    std::array<Vector<double>, parts>& end) const
{
  constexpr int last = parts - 1;
  for (int p = 0; p < last; ++p) {
    if (p > 0) subtract(end[p], times(ends_[p].before, end[p - 1]));
    end[p] = times(ends_[p].inverse, end[p]);
  }
  for (int p = last - 1; p-- > 0;) subtract(end[p], times(ends_[p].after, end[p + 1]));
  subtract(end[last], times(ends_[last].after, end[0]));
  subtract(end[last], times(ends_[last].before, end[last - 1]));
  end[last] = times(ends_[last].inverse, end[last]);
  for (int p = 0; p < last; ++p) subtract(end[p], times(ends_[p].last, end[last]));
}

}  // namespace rotor_stator
