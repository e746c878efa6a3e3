#include "model/reduction.hpp"

#include <Eigen/LU>
#include <Eigen/OrderingMethods>
#include <Eigen/QR>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <random>
#include <type_traits>

#include "io/errors.hpp"

namespace rotor_stator {

namespace {

using Complex = std::complex<double>;
using ComplexSparse = Eigen::SparseMatrix<Complex>;

constexpr double wanted = 1e-8, worst = 1e-6;  ///< errors of the receptances
constexpr int right_in_a_row = 8, most_points = 200;
constexpr double most_memory = 12e9;  ///< [bytes] of the factors

/** Reverse Cuthill and McKee: the degrees of freedom of a long body from one end to the
    other, which keeps the factors in a band. */
std::vector<int> along_the_body(const SparseMatrix& pattern)
{
  const int n = static_cast<int>(pattern.rows());
  const auto degree = [&](int i) {
    return pattern.outerIndexPtr()[i + 1] - pattern.outerIndexPtr()[i];
  };
  std::vector<bool> is_seen(static_cast<std::size_t>(n));
  const auto breadth_first = [&](int start, std::vector<int>& list) {
    std::size_t at = list.size();
    list.push_back(start);
    for (is_seen[start] = true; at < list.size(); ++at) {
      const std::size_t first = list.size();
      for (SparseMatrix::InnerIterator it(pattern, list[at]); it; ++it)
        if (!is_seen[it.row()]) {
          is_seen[it.row()] = true;
          list.push_back(static_cast<int>(it.row()));
        }
      std::sort(list.begin() + static_cast<std::ptrdiff_t>(first), list.end(),
                [&](int a, int b) { return degree(a) < degree(b); });
    }
  };
  std::vector<int> order;
  for (int i = 0; i < n; ++i) {
    if (is_seen[i]) continue;
    /** The last of a search is far from where it began, and a good begin. */
    int start = i;
    for (int k = 0; k < 3; ++k) {
      std::vector<int> list;
      breadth_first(start, list);
      start = list.back();
      for (const int seen : list) is_seen[seen] = false;
    }
    breadth_first(start, order);
  }
  std::ranges::reverse(order);
  return order;
}

/** Bytes of the factors of a matrix within its profile. */
double profile_bytes(const SparseMatrix& a)
{
  double entries = 0;
  for (int j = 0; j < a.outerSize(); ++j)
    if (a.outerIndexPtr()[j] < a.outerIndexPtr()[j + 1])
      entries += std::max(0, j - a.innerIndexPtr()[a.outerIndexPtr()[j]]);
  return 2 * sizeof(Complex) * entries;
}

SparseMatrix reordered(const SparseMatrix& a, const std::vector<int>& order)
{
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> p(a.rows());
  for (int i = 0; i < a.rows(); ++i) p.indices()[order[i]] = i;
  SparseMatrix mixed;
  mixed = a.twistedBy(p);
  const SparseMatrix sorted =
      mixed.transpose();  // which sorts, and twice is the same again
  return sorted.transpose();
}

/** A x for A = sign Aᵀ. Neighbours of a fine mesh move nearly alike, so that forces of
    opposite sign cancel in all but the last digits; their sums are taken with more of
    them. */
template <class Scalar>
Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> product(
    const SparseMatrix& a, double sign,
    const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& x)
{
  using Long = std::conditional_t<std::is_same_v<Scalar, double>, long double,
                                  std::complex<long double>>;
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> y(x.rows(), x.cols());
  for (Eigen::Index c = 0; c < x.cols(); ++c)
    for (int j = 0; j < a.outerSize(); ++j) {
      Long sum = 0;
      for (SparseMatrix::InnerIterator it(a, j); it; ++it)
        sum += static_cast<long double>(it.value()) * static_cast<Long>(x(it.row(), c));
      y(j, c) = sign * static_cast<Scalar>(sum);
    }
  return y;
}

/** The body along its length, and what drives it. */
class HeldBody {
public:
  HeldBody(const BodyMatrices& body, const BodyPorts& ports, const std::string& who)
      : spring_(ports.spring)
  {
    const SparseMatrix one =
        body.m.cwiseAbs() + body.k.cwiseAbs() + body.c.cwiseAbs() + body.g.cwiseAbs();
    order_ = along_the_body(one);
    const SparseMatrix pattern = reordered(one, order_);
    if (const double bytes = profile_bytes(pattern); bytes > most_memory)
      throw BadInput(
          format("%s: the factors of its %ld degrees of freedom would take "
                 "%.0f GB",
                 who.c_str(), static_cast<long>(one.rows()), 1e-9 * bytes));
    m_ = reordered(body.m, order_);
    c_ = reordered(body.c, order_);
    g_ = reordered(body.g, order_);
    k_ = reordered(body.k, order_);
    places_.resize(order_.size());
    for (std::size_t i = 0; i < order_.size(); ++i)
      places_[order_[i]] = static_cast<int>(i);
    std::vector<Eigen::Triplet<double, int>> held;
    for (int dof : ports.joints) held.emplace_back(places_[dof], places_[dof], 1);
    held_.resize(m_.rows(), m_.rows());
    held_.setFromTriplets(held.begin(), held.end());
    const ComplexSparse z = dynamic_stiffness(1, 1);
    factors_.isSymmetric(true);
    factors_.setPivotThreshold(1e-3);
    factors_.analyzePattern(z);
  }

  const std::vector<int>& order() const { return order_; }
  int place(int dof) const { return places_[dof]; }
  Eigen::Index size() const { return m_.rows(); }
  const SparseMatrix& m() const { return m_; }
  const SparseMatrix& c() const { return c_; }
  const SparseMatrix& g() const { return g_; }
  const SparseMatrix& k() const { return k_; }

  /** k of the added spring at a frequency. */
  Complex spring(double frequency) const { return spring_ * Complex(1, frequency > 0); }

  ComplexSparse dynamic_stiffness(double frequency, double speed) const
  {
    const SparseMatrix real = k_ - frequency * frequency * m_,
                       imaginary = frequency * (c_ + speed * g_);
    return real.cast<Complex>() + Complex(0, 1) * imaginary.cast<Complex>() +
           spring(frequency) * held_.cast<Complex>();
  }

  Eigen::MatrixXcd solve(double frequency, double speed, const Eigen::MatrixXcd& b)
  {
    const ComplexSparse z = dynamic_stiffness(frequency, speed);
    factors_.factorize(z);
    if (factors_.info() != Eigen::Success)
      throw NoSolution("the matrices of a body have no factors: " +
                       factors_.lastErrorMessage());
    Eigen::MatrixXcd x = factors_.solve(b);
    for (int refinement = 0; refinement < 3; ++refinement) {
      Eigen::MatrixXcd rest = b - product(k_, 1, x) - spring(frequency) * (held_ * x);
      rest += frequency * frequency * product(m_, 1, x);
      rest -= Complex(0, frequency) * (product(c_, 1, x) + speed * product(g_, -1, x));
      x += factors_.solve(rest);
    }
    return x;
  }

private:
  double spring_;
  std::vector<int> order_, places_;
  SparseMatrix m_, c_, g_, k_, held_;
  Eigen::SparseLU<ComplexSparse, Eigen::NaturalOrdering<int>> factors_;
};

/** The basis, and the matrices on it, which grow together. */
class Basis {
public:
  explicit Basis(const HeldBody& body) : body_(body), v_(body.size(), 0), mv_(v_) {}

  const Eigen::MatrixXd& vectors() const { return v_; }

  void add(const Eigen::MatrixXd& shapes)
  {
    const Eigen::Index first = v_.cols();
    Eigen::Index size = first;
    v_.conservativeResize(Eigen::NoChange, first + shapes.cols());
    mv_.conservativeResize(Eigen::NoChange, first + shapes.cols());
    for (Eigen::Index j = 0; j < shapes.cols(); ++j) {
      Eigen::VectorXd x = shapes.col(j), mx = body_.m() * x;
      const double whole = std::sqrt(x.dot(mx));
      if (!(whole > 0)) continue;
      x /= whole;
      for (int twice : {0, 1}) {
        static_cast<void>(twice);
        x -= v_.leftCols(size) * (mv_.leftCols(size).transpose() * x);
      }
      mx = body_.m() * x;
      const double rest = std::sqrt(std::max(0.0, x.dot(mx)));
      constexpr double rounding = 1e-11;
      if (!(rest > rounding)) continue;
      v_.col(size) = x / rest;
      mv_.col(size++) = mx / rest;
    }
    v_.conservativeResize(Eigen::NoChange, size);
    mv_.conservativeResize(Eigen::NoChange, size);
    grow(m_, body_.m(), 1);
    grow(c_, body_.c(), 1);
    grow(g_, body_.g(), -1);
    grow(k_, body_.k(), 1);
  }

  /** Z⁻¹ b on the basis, for b = Vᵀ of the whole right-hand side. */
  Eigen::MatrixXcd solve(double frequency, double speed, const Eigen::MatrixXd& joints,
                         const Eigen::MatrixXcd& b) const
  {
    Eigen::MatrixXcd z = Complex(0, frequency) * (c_ + speed * g_);
    z += k_ - frequency * frequency * m_;
    z += body_.spring(frequency) * (joints.transpose() * joints);
    return z.partialPivLu().solve(b);
  }

  /** In coordinates of which the first are the displacements `kept`. */
  ReducedBody reduced(const std::vector<int>& kept) const
  {
    Eigen::MatrixXd shown(static_cast<Eigen::Index>(kept.size()), v_.cols());
    for (std::size_t i = 0; i < kept.size(); ++i)
      shown.row(static_cast<Eigen::Index>(i)) = v_.row(body_.place(kept[i]));
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(shown.transpose());
    const auto s = shown.rows();
    const Eigen::MatrixXd r = qr.matrixQR().topRows(s).triangularView<Eigen::Upper>();
    Eigen::MatrixXd to = Eigen::MatrixXd::Identity(v_.cols(), v_.cols());
    to.topLeftCorner(s, s) = r.transpose().triangularView<Eigen::Lower>().solve(
        Eigen::MatrixXd::Identity(s, s));
    to.applyOnTheLeft(qr.householderQ());
    const auto image = [&](const Eigen::MatrixXd& a) -> SparseMatrix {
      return Eigen::MatrixXd(to.transpose() * a * to).sparseView();
    };
    Eigen::MatrixXd basis(v_.rows(), v_.cols());
    const Eigen::MatrixXd turned = v_ * to;
    for (Eigen::Index i = 0; i < v_.rows(); ++i)
      basis.row(body_.order()[static_cast<std::size_t>(i)]) = turned.row(i);
    return {.basis = std::move(basis),
            .matrices = {image(m_), image(c_), image(g_), image(k_)},
            .error = 0,
            .highest = 0,
            .points = 0};
  }

private:
  void grow(Eigen::MatrixXd& reduced, const SparseMatrix& a, double sign) const
  {
    const auto old = reduced.rows(), more = v_.cols() - old;
    const Eigen::MatrixXd block =
        v_.transpose() * product<double>(a, sign, v_.rightCols(more));
    reduced.conservativeResize(v_.cols(), v_.cols());
    reduced.rightCols(more) = block;
    reduced.bottomLeftCorner(more, old) = sign * block.topRows(old).transpose();
    const Eigen::MatrixXd corner = block.bottomRows(more);
    reduced.bottomRightCorner(more, more) = 0.5 * (corner + sign * corner.transpose());
  }

  const HeldBody& body_;
  Eigen::MatrixXd v_, mv_, m_, c_, g_, k_;
};

/** Throws BadInput for what neither K nor a bearing holds. */
void require_held(const HeldBody& body, const BodyPorts& ports, const std::string& who)
{
  SparseMatrix held = body.k();
  for (int dof : ports.joints)
    held.coeffRef(body.place(dof), body.place(dof)) += ports.spring;
  const Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>>
      factors(held);
  const Eigen::VectorXd pivots = factors.vectorD();  // a copy each time
  constexpr double rounding = 1e-12;
  for (int i = 0; i < held.rows(); ++i)
    if (!(pivots[i] > rounding * held.coeff(i, i)))
      throw BadInput(format(
          "%s: K is singular, and no bearing holds what it leaves free: found at degree "
          "of freedom %d (torsion and axial motion must be held too)",
          who.c_str(), body.order()[static_cast<std::size_t>(i)] + 1));
}

}  // namespace

ReducedBody reduce(const BodyMatrices& matrices, const BodyPorts& ports,
                   const ReductionRange& range, const std::string& who)
{
  HeldBody body(matrices, ports, who);
  require_held(body, ports, who);
  const auto s = static_cast<Eigen::Index>(ports.kept.size()),
             joints = static_cast<Eigen::Index>(ports.joints.size());
  Eigen::MatrixXcd inputs = Eigen::MatrixXcd::Zero(body.size(), s + 2);
  for (Eigen::Index i = 0; i < s; ++i)
    inputs(body.place(ports.kept[static_cast<std::size_t>(i)]), i) = 1;
  for (Eigen::Index i = 0; i < body.size(); ++i) {
    const int dof = body.order()[static_cast<std::size_t>(i)];
    inputs(i, s) = ports.load[dof];
    inputs(i, s + 1) = ports.unbalance[dof];
  }
  std::vector<int> all = ports.kept;
  all.insert(all.end(), ports.nodes.begin(), ports.nodes.end());
  Basis basis(body);
  const Eigen::MatrixXcd rest = body.solve(0, 0, inputs.leftCols(s + 1));
  basis.add(rest.real());

  /** The slowest that the contact vibrates against the body, in the shape of a force on
      one joint. */
  double contact = 0;
  for (Eigen::Index i = 0; i < joints; ++i) {
    const Eigen::VectorXd shape = rest.col(i).real();
    const double at = shape[body.place(ports.joints[static_cast<std::size_t>(i)])];
    contact = std::max(
        contact, std::abs(at) * std::sqrt(ports.spring / shape.dot(body.m() * shape)));
  }
  const double highest = std::max(range.highest, 10 * contact);

  /** The receptances' error at a point; the point joins the basis where that is too
      large. */
  const bool is_turning = ports.unbalance.norm() > 0;
  double rounding = 0;
  const auto measured = [&](double frequency, double speed, bool joins) {
    const bool is_first = is_turning && frequency == speed;
    Eigen::MatrixXcd b(body.size(), joints + is_first);
    b.leftCols(joints) = inputs.leftCols(joints);
    if (is_first) b.col(joints) = inputs.col(s + 1);
    const Eigen::MatrixXcd exact = body.solve(frequency, speed, b);
    const auto off = [&] {
      const auto rows = [&](const auto& from, const std::vector<int>& dofs) {
        using Scalar = typename std::decay_t<decltype(from)>::Scalar;
        Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> picked(
            static_cast<Eigen::Index>(dofs.size()), from.cols());
        for (std::size_t i = 0; i < dofs.size(); ++i)
          picked.row(static_cast<Eigen::Index>(i)) = from.row(body.place(dofs[i]));
        return picked;
      };
      const Eigen::MatrixXd& v = basis.vectors();
      const Eigen::MatrixXcd q =
          basis.solve(frequency, speed, rows(v, ports.joints), v.transpose() * b);
      const auto off_at = [&](const std::vector<int>& dofs) {
        const Eigen::MatrixXcd right = rows(exact, dofs),
                               difference = rows(v, dofs) * q - right;
        return (difference.colwise().norm().array() / right.colwise().norm().array())
            .maxCoeff();
      };
      return std::max(off_at(ports.kept), off_at(all));
    };
    const double error = off();
    if (joins || error > std::max(wanted, 3 * rounding)) {
      Eigen::MatrixXd both(body.size(), 2 * b.cols());
      both << exact.real(), exact.imag();
      basis.add(both);
      rounding = std::max(rounding, off());
    }
    return error;
  };

  std::mt19937 random(1);
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
  double error = 0;
  int right = 0;
  for (int point = 0; right < right_in_a_row; ++point) {
    if (point == most_points)
      throw NoSolution(
          format("%s: no reduction found: the error of the receptances is "
                 "%.2g with %ld coordinates",
                 who.c_str(), error, static_cast<long>(basis.vectors().cols())));
    const double speed = range.from + uniform() * (range.to - range.from);
    const double share = uniform();
    const double frequency = point % 4 == 0 ? speed : share * share * highest;
    const double found = measured(frequency, speed, point < 4);
    const bool is_right = point >= 4 && found <= std::max(wanted, 3 * rounding);
    right = is_right ? right + 1 : 0;
    error = is_right && right > 1 ? std::max(error, found) : found;
    if (rounding > worst)
      throw NoSolution(
          format("%s: the receptances have only %.1g digits: K is too badly "
                 "conditioned",
                 who.c_str(), -std::log10(rounding)));
  }
  ReducedBody reduced = basis.reduced(ports.kept);
  reduced.error = error;
  reduced.highest = highest;
  reduced.points = right_in_a_row;
  return reduced;
}

}  // namespace rotor_stator
