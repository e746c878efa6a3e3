#include "model/reduction.hpp"

#include <Eigen/LU>
#include <Eigen/OrderingMethods>
#include <Eigen/QR>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <span>
#include <type_traits>

#include "io/errors.hpp"

namespace rotor_stator {

namespace {

using Complex = std::complex<double>;
using ComplexSparse = Eigen::SparseMatrix<Complex>;

constexpr double wanted = 1e-8, worst = 1e-6;  ///< errors of the receptances
constexpr int right_in_a_row = 8, most_points = 200;
constexpr double most_memory = 12e9;  ///< [bytes] of the factors

/** Factors of K with the springs, in an order that keeps them sparse. */
struct StaticFactors : Eigen::SimplicialLDLT<SparseMatrix> {
  explicit StaticFactors(const SparseMatrix& pattern) { analyzePattern(pattern); }

  /** Those of the dynamic stiffness in this order. */
  double bytes() const
  {
    return 2 * sizeof(Complex) * m_nonZerosPerCol.cast<double>().sum();
  }
};

using Permutation = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;

SparseMatrix reordered(const SparseMatrix& a, const Permutation& place)
{
  SparseMatrix mixed;
  mixed = a.twistedBy(place);
  const SparseMatrix sorted = mixed.transpose();  // twice is the same again, in order
  return sorted.transpose();
}

/** A x for A = sign Aᵀ. Neighbours of a fine mesh move nearly alike: their forces cancel
    in all but the last digits, and are summed with more of them. */
template <class Matrix>
Matrix product(const SparseMatrix& a, double sign, const Matrix& x)
{
  using Scalar = typename Matrix::Scalar;
  using Long = std::conditional_t<std::is_same_v<Scalar, double>, long double,
                                  std::complex<long double>>;
  Matrix y(x.rows(), x.cols());
  for (Eigen::Index c = 0; c < x.cols(); ++c)
    for (int j = 0; j < a.outerSize(); ++j) {
      Long sum = 0;
      for (SparseMatrix::InnerIterator it(a, j); it; ++it)
        sum += static_cast<long double>(it.value()) * static_cast<Long>(x(it.row(), c));
      y(j, c) = sign * static_cast<Scalar>(sum);
    }
  return y;
}

/** The body in an order of its own, held at its joints. Throws BadInput for what neither
    K nor a bearing holds. */
struct HeldBody {
  HeldBody(const LinearBody& body, std::span<const int> joints, double k_0) : spring_(k_0)
  {
    const SparseMatrix one =
        body.m.cwiseAbs() + body.k.cwiseAbs() + body.c.cwiseAbs() + body.g.cwiseAbs();
    StaticFactors factors(one);
    place_ = factors.permutationP();
    const auto& indices = factors.permutationPinv().indices();
    order.assign(indices.begin(), indices.end());
    if (factors.bytes() > most_memory)
      throw BadInput(
          format("%s: the factors of its %d degrees of freedom would take %.0f GB",
                 body.name.c_str(), body.size(), 1e-9 * factors.bytes()));
    m = reordered(body.m, place_);
    c = reordered(body.c, place_);
    g = reordered(body.g, place_);
    k = reordered(body.k, place_);
    std::vector<Eigen::Triplet<double, int>> held;
    for (int dof : joints) held.emplace_back(dof, dof, 1);
    SparseMatrix joined(m.rows(), m.rows());
    joined.setFromTriplets(held.begin(), held.end());
    const SparseMatrix supported = body.k + spring_ * joined;
    factors.factorize(supported);
    const Eigen::VectorXd pivots = factors.vectorD();  // a copy each time
    constexpr double rounding = 1e-12;
    for (Eigen::Index i = 0; i < pivots.size(); ++i)
      if (!(pivots[i] > rounding * supported.coeff(order[i], order[i])))
        throw BadInput(not_held(body.name, order[i]));
    held_ = reordered(joined, place_);
    factors_.isSymmetric(true);
    factors_.setPivotThreshold(1e-3);
    factors_.analyzePattern(dynamic_stiffness(1, 1));
  }

  std::vector<int> order;   ///< of the degrees of freedom
  SparseMatrix m, c, g, k;  ///< in this order

  /** Where degrees of freedom stand. */
  std::vector<int> rows(std::span<const int> dofs) const
  {
    std::vector<int> list;
    for (int dof : dofs) list.push_back(place_.indices()[dof]);
    return list;
  }

  /** k of the added spring at a frequency. */
  Complex spring(double frequency) const { return spring_ * Complex(1, frequency > 0); }

  ComplexSparse dynamic_stiffness(double frequency, double speed) const
  {
    const SparseMatrix real = k - frequency * frequency * m,
                       imaginary = frequency * (c + speed * g);
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
      Eigen::MatrixXcd rest = b - product(k, 1, x) - spring(frequency) * (held_ * x);
      rest += frequency * frequency * product(m, 1, x);
      rest -= Complex(0, frequency) * (product(c, 1, x) + speed * product(g, -1, x));
      x += factors_.solve(rest);
    }
    return x;
  }

private:
  double spring_;
  Permutation place_;  ///< of each degree of freedom
  SparseMatrix held_;
  Eigen::SparseLU<ComplexSparse, Eigen::NaturalOrdering<int>> factors_;
};

/** The basis, and the matrices on it, which grow together. */
class Basis {
public:
  explicit Basis(const HeldBody& body) : body_(body), v_(body.m.rows(), 0), mv_(v_) {}

  const Eigen::MatrixXd& vectors() const { return v_; }

  void add(const Eigen::MatrixXd& shapes)
  {
    const Eigen::Index first = v_.cols();
    Eigen::Index size = first;
    v_.conservativeResize(Eigen::NoChange, first + shapes.cols());
    mv_.conservativeResize(Eigen::NoChange, first + shapes.cols());
    for (Eigen::Index j = 0; j < shapes.cols(); ++j) {
      Eigen::VectorXd x = shapes.col(j), mx = body_.m * x;
      const double whole = std::sqrt(x.dot(mx));
      if (!(whole > 0)) continue;
      x /= whole;
      for (int pass = 0; pass < 2; ++pass)
        x -= v_.leftCols(size) * (mv_.leftCols(size).transpose() * x);
      mx = body_.m * x;
      const double rest = std::sqrt(std::max(0.0, x.dot(mx)));
      constexpr double rounding = 1e-11;
      if (!(rest > rounding)) continue;
      v_.col(size) = x / rest;
      mv_.col(size++) = mx / rest;
    }
    v_.conservativeResize(Eigen::NoChange, size);
    mv_.conservativeResize(Eigen::NoChange, size);
    grow(m_, body_.m, 1);
    grow(c_, body_.c, 1);
    grow(g_, body_.g, -1);
    grow(k_, body_.k, 1);
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

  /** The body in coordinates that begin with the displacements in the rows `kept`. */
  void put(const std::vector<int>& kept, LinearBody& into) const
  {
    const Eigen::MatrixXd shown = v_(kept, Eigen::all);
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
    basis(body_.order, Eigen::all) = v_ * to;
    into.m = image(m_);
    into.c = image(c_);
    into.g = image(g_);
    into.k = image(k_);
    into.load = basis.transpose() * into.load;
    into.unbalance = basis.transpose() * into.unbalance;
    if (into.at_nodes.rows() > 0)
      into.at_nodes = Eigen::MatrixXd(into.at_nodes * basis).sparseView();
  }

private:
  void grow(Eigen::MatrixXd& reduced, const SparseMatrix& a, double sign) const
  {
    const auto old = reduced.rows(), more = v_.cols() - old;
    const Eigen::MatrixXd block =
        v_.transpose() * product<Eigen::MatrixXd>(a, sign, v_.rightCols(more));
    reduced.conservativeResize(v_.cols(), v_.cols());
    reduced.rightCols(more) = block;
    reduced.bottomLeftCorner(more, old) = sign * block.topRows(old).transpose();
    const Eigen::MatrixXd corner = block.bottomRows(more);
    reduced.bottomRightCorner(more, more) = 0.5 * (corner + sign * corner.transpose());
  }

  const HeldBody& body_;
  Eigen::MatrixXd v_, mv_, m_, c_, g_, k_;
};

}  // namespace

std::string not_held(const std::string& who, int dof)
{
  return format(
      "%s: K is singular, and no bearing holds what it leaves free: found at degree of "
      "freedom %d (torsion and axial motion must be held too)",
      who.c_str(), dof + 1);
}

Reduction reduce(LinearBody& whole, const std::vector<int>& kept, std::size_t joints,
                 const ReductionRange& range)
{
  HeldBody body(whole, std::span(kept).first(joints), range.spring);
  const std::vector<int> rows = body.rows(kept),
                         held(rows.begin(), rows.begin() + static_cast<long>(joints));
  std::vector<int> all = body.rows(whole.nodes);
  all.insert(all.begin(), rows.begin(), rows.end());
  const Eigen::Index n = whole.size(), s = std::ssize(rows), ports = std::ssize(held);
  Eigen::MatrixXcd inputs = Eigen::MatrixXcd::Zero(n, s + 2);
  for (Eigen::Index i = 0; i < s; ++i) inputs(rows[i], i) = 1;
  inputs.col(s) = whole.load(body.order).cast<Complex>();
  inputs.col(s + 1) = whole.unbalance(body.order);
  Basis basis(body);
  const Eigen::MatrixXcd rest = body.solve(0, 0, inputs.leftCols(s + 1));
  basis.add(rest.real());

  /** The contact's vibration against the body, in the shape of a force on one joint. */
  double contact = 0;
  for (Eigen::Index i = 0; i < ports; ++i) {
    const Eigen::VectorXd shape = rest.col(i).real();
    contact = std::max(contact, std::abs(shape[held[i]]) *
                                    std::sqrt(range.spring / shape.dot(body.m * shape)));
  }
  const double highest = std::max(range.highest, 10 * contact);

  /** The receptances' error at a point, which joins the basis where that is large. */
  const bool is_turning = whole.unbalance.norm() > 0;
  double rounding = 0;
  const auto measured = [&](double frequency, double speed, bool joins) {
    const bool is_first = is_turning && frequency == speed;
    Eigen::MatrixXcd b(n, ports + is_first);
    b.leftCols(ports) = inputs.leftCols(ports);
    if (is_first) b.col(ports) = inputs.col(s + 1);
    const Eigen::MatrixXcd exact = body.solve(frequency, speed, b);
    const auto off = [&] {
      const Eigen::MatrixXd& v = basis.vectors();
      const Eigen::MatrixXcd q =
          basis.solve(frequency, speed, v(held, Eigen::all), v.transpose() * b);
      const auto off_at = [&](const std::vector<int>& shown) {
        const Eigen::MatrixXd shapes = v(shown, Eigen::all);
        const Eigen::MatrixXcd right = exact(shown, Eigen::all),
                               difference = shapes * q - right;
        return (difference.colwise().norm().array() / right.colwise().norm().array())
            .maxCoeff();
      };
      return std::max(off_at(rows), off_at(all));
    };
    const double error = off();
    if (joins || error > std::max(wanted, 3 * rounding)) {
      Eigen::MatrixXd both(n, 2 * b.cols());
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
                 whole.name.c_str(), error, static_cast<long>(basis.vectors().cols())));
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
                 whole.name.c_str(), -std::log10(rounding)));
  }
  basis.put(rows, whole);
  return {
      format("%s: %ld degrees of freedom reduced to %d, error of the receptances %.2g "
             "at %d random points of 0...%.4g Hz",
             whole.name.c_str(), static_cast<long>(n), whole.size(), error,
             right_in_a_row, highest / (2 * std::numbers::pi)),
      error, highest};
}

}  // namespace rotor_stator
