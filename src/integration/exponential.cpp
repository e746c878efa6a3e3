#include "integration/exponential.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "io/errors.hpp"

namespace rotor_stator {

namespace {

using Complex = std::complex<double>;

/** φ_0 = e^z, φ_k = (φ_{k-1} - 1/(k-1)!)/z. */
Complex phi(int k, Complex z)
{
  if (std::abs(z) < 1) {
    double factorial = 1;
    for (int j = 2; j <= k; ++j) factorial *= j;
    Complex sum = 0, term = 1 / factorial;
    for (int j = 1; j <= 24; ++j) {
      sum += term;
      term *= z / static_cast<double>(j + k);
    }
    return sum;
  }
  Complex value = std::exp(z);
  double constant = 1;
  for (int j = 1; j <= k; ++j) {
    value = (value - constant) / z;
    constant /= j;
  }
  return value;
}

constexpr int finest = 16;  ///< halvings of an interval below the first step

}  // namespace

ExponentialStepper::ExponentialStepper(const Parameters& parameters, double omega,
                                       int intervals, double tolerance,
                                       OperationBudget budget)
    : bearings_(bearings_of(parameters)),
      turns_(parameters.turns * parameters.speed_ratio),
      speed_(rotor_speed(parameters, omega)), spring_(parameters.large->spring),
      length_(scales(parameters).length), tolerance_(std::max(tolerance, 2e-14)),
      interval_(2 * std::numbers::pi / omega / intervals), intervals_(intervals),
      free_(held_motion(*parameters.large, speed_)), joints_(parameters.large->joints),
      budget_(std::move(budget))
{
  double balls = 0;
  for (const Bearing& bearing : bearings_) {
    forces_.emplace_back(bearing);
    balls += bearing.balls;
  }
  const double quarter = 0.5 * std::numbers::pi / contact_frequency(parameters);
  first_ = now_ =
      std::clamp(static_cast<int>(std::ceil(std::log2(interval_ / quarter))), 0, 40);
  find_modes(*parameters.large);
  const auto size = static_cast<double>(inputs_.size());
  price_ = (100 + 3 * size + 1.5 * balls) /
           operations_per_evaluation(parameters.bearing.balls);
}

/** The modes of M, K + k_0 D Dᵀ bring displacements and speeds to one scale, in which the first-order system is normal
    but for the damping; its eigenvectors are then well conditioned. */
void ExponentialStepper::find_modes(const LargeMachine& machine)
{
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> held(
      machine.held_stiffness(), machine.mass);
  const Eigen::MatrixXd& shapes = held.eigenvectors();
  const Eigen::VectorXd omega = held.eigenvalues().cwiseMax(0).cwiseSqrt();
  const auto n = omega.size();
  Eigen::MatrixXd damping =
      shapes.transpose() * (machine.damping + speed_ * machine.gyroscopic) * shapes;
  /** No two modes are damped alike, which keeps their vectors apart: a change below all other errors. */
  for (Eigen::Index i = 0; i < n; ++i)
    damping(i, i) +=
        1e-13 * omega[i] * static_cast<double>(1 + i) / static_cast<double>(n);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  a.topRightCorner(n, n) = omega.asDiagonal();
  a.bottomLeftCorner(n, n) = -a.topRightCorner(n, n);
  a.bottomRightCorner(n, n) = -damping;
  const Eigen::EigenSolver<Eigen::MatrixXd> modes(a);
  if (modes.info() != Eigen::Success)
    throw NoSolution("the modes of the bodies given by matrices were not found");
  const Eigen::VectorXcd lambda = modes.eigenvalues();
  const Eigen::MatrixXd vectors = modes.pseudoEigenvectors();
  std::vector<Eigen::Index> order;
  for (const int kind : {1, -1, 0})
    for (Eigen::Index i = 0; i < 2 * n; ++i)
      if ((lambda[i].imag() > 0) - (lambda[i].imag() < 0) == kind) order.push_back(i);
  pairs_ = (lambda.imag().array() > 0).count();
  decay_ = lambda.real()(order).array();
  frequency_ = lambda.imag()(order).array();
  const Eigen::MatrixXd basis = vectors(Eigen::all, order);
  const Eigen::PartialPivLU<Eigen::MatrixXd> factors(basis);
  constexpr double worst = 1e-12;
  if (!(factors.rcond() > worst))
    throw NoSolution("the modes of the bodies given by matrices are not independent");
  Eigen::MatrixXd to_state(2 * n, 2 * n),
      from_state = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  to_state << shapes * omega.cwiseInverse().asDiagonal() * basis.topRows(n),
      shapes * basis.bottomRows(n);
  const Eigen::MatrixXd back = shapes.transpose() * machine.mass;
  from_state.topLeftCorner(n, n) = omega.asDiagonal() * back;
  from_state.bottomRightCorner(n, n) = back;
  Eigen::MatrixXd pushed = Eigen::MatrixXd::Zero(2 * n, joints_.cols());
  pushed.bottomRows(n) = -shapes.transpose() * joints_;
  to_state_ = to_state;
  to_modes_ = factors.solve(from_state);
  inputs_ = factors.solve(pushed);
  outputs_ = joints_.transpose() * to_state.topRows(n);
}

template <class Function>
ExponentialStepper::Factors ExponentialStepper::factors(Function function,
                                                        double seconds) const
{
  Factors f{decay_, decay_};
  for (Eigen::Index i = 0; i < decay_.size(); ++i) {
    const Complex value = function(seconds * Complex(decay_[i], frequency_[i]));
    f.real[i] = value.real();
    f.imaginary[i] = value.imag();
  }
  return f;
}

/** A pair (c, s) stands for the complex coordinate c - is. */
Eigen::MatrixXd ExponentialStepper::times(const Factors& factors,
                                          const Eigen::MatrixXd& y) const
{
  Eigen::MatrixXd product = factors.real.matrix().asDiagonal() * y;
  const auto imaginary = factors.imaginary.head(pairs_).matrix().asDiagonal();
  product.topRows(pairs_) += imaginary * y.middleRows(pairs_, pairs_);
  product.middleRows(pairs_, pairs_) -= imaginary * y.topRows(pairs_);
  return product;
}

const ExponentialStepper::Level& ExponentialStepper::level(int k)
{
  const auto known = levels_.find(k);
  if (known != levels_.end()) return known->second;
  Level made{.step = std::ldexp(1.0, -k),
             .half = {},
             .whole = {},
             .to_half = {},
             .f_1 = {},
             .f_2 = {},
             .f_3 = {}};
  const double h = made.step * interval_;
  const auto weights = [&](double seconds, double a, double b,
                           double c) -> Eigen::MatrixXd {
    return h * times(factors(
                         [=](Complex z) {
                           return a * phi(1, z) + b * phi(2, z) + c * phi(3, z);
                         },
                         seconds),
                     inputs_);
  };
  const auto power = [](Complex z) { return std::exp(z); };
  made.half = factors(power, 0.5 * h);
  made.whole = factors(power, h);
  made.to_half = weights(0.5 * h, 0.5, 0, 0);
  made.f_1 = weights(h, 1, -3, 4);
  made.f_2 = weights(h, 0, 2, -4);
  made.f_3 = weights(h, 0, -1, 4);
  return levels_.emplace(k, std::move(made)).first->second;
}

/** The state that loads and unbalance drive against k_0, `at` in output intervals. */
Eigen::VectorXd ExponentialStepper::driven(double at) const
{
  const double phase = 2 * std::numbers::pi * turns_ * at / intervals_;
  const Complex turn = std::polar(1.0, phase);
  Eigen::VectorXd state(2 * free_.rest.size());
  state << free_.rest + (turn * free_.whirl).real(),
      (Complex(0, speed_) * turn * free_.whirl).real();
  return state;
}

/** g of the motion in the first column, and its change for the disturbances in the others. */
Eigen::MatrixXd ExponentialStepper::forces(const Eigen::MatrixXd& y, double at)
{
  const double phase = 2 * std::numbers::pi * at / intervals_;
  const Complex turn = std::polar(1.0, turns_ * phase);
  Eigen::MatrixXd u = outputs_ * y;
  u.col(0) += joints_.transpose() * free_.rest;
  u.col(0) += (joints_.transpose() * free_.whirl * turn).real();
  Eigen::MatrixXd g = -spring_ * u;
  for (std::size_t b = 0; b < forces_.size(); ++b) {
    const auto at_b = static_cast<Eigen::Index>(2 * b);
    const Direction cage = Direction::of(bearings_[b].cage_angle(phase));
    const Vec2 relative{u(at_b, 0), u(at_b + 1, 0)};
    if (y.cols() == 1) {
      const Vec2 f = forces_[b].force(cage, relative);
      g.col(0).segment<2>(at_b) += Eigen::Vector2d(f.x, f.y);
      continue;
    }
    const auto [f, s] = forces_[b].reaction(cage, relative);
    Eigen::Matrix2d stiffness;
    stiffness << s.xx, s.xy, s.xy, s.yy;
    g.rightCols(y.cols() - 1).middleRows<2>(at_b) +=
        stiffness * u.rightCols(y.cols() - 1).middleRows<2>(at_b);
    g.col(0).segment<2>(at_b) += Eigen::Vector2d(f.x, f.y);
  }
  ++evaluations_;
  return g;
}

void ExponentialStepper::step(const Level& level, double at, Eigen::MatrixXd& y)
{
  budget_.spend(4 * price_ * static_cast<double>(y.cols()));
  const double half = 0.5 * level.step;
  const Eigen::MatrixXd drift = times(level.half, y), g_0 = forces(y, at);
  const Eigen::MatrixXd a = drift + level.to_half * g_0, g_a = forces(a, at + half);
  const Eigen::MatrixXd b = drift + level.to_half * g_a, g_b = forces(b, at + half);
  const Eigen::MatrixXd c = times(level.half, a) + level.to_half * (2 * g_b - g_0);
  y = times(level.whole, y) + level.f_1 * g_0 + level.f_2 * (g_a + g_b) +
      level.f_3 * forces(c, at + level.step);
}

/** One interval. The motion alone chooses the steps. */
void ExponentialStepper::integrate(long interval, Eigen::MatrixXd& y)
{
  const auto begin = static_cast<double>(interval);
  for (double x = 0; x < 1;) {
    const Level &whole = level(now_), &half = level(now_ + 1);
    Eigen::MatrixXd coarse = y.leftCols(1), fine = coarse;
    step(whole, begin + x, coarse);
    step(half, begin + x, fine);
    step(half, begin + x + half.step, fine);
    const double error = (outputs_ * (fine - coarse)).cwiseAbs().maxCoeff() / length_;
    if (!std::isfinite(error))
      throw NoSolution(
          format("time integration diverged at t = %.9g s", (begin + x) * interval_));
    if (error > tolerance_ && now_ < first_ + finest) {
      ++now_;
      continue;
    }
    if (y.cols() > 1) {
      step(half, begin + x, y);
      step(half, begin + x + half.step, y);
    } else {
      y = fine;
    }
    x += whole.step;
    const bool fits = std::fmod(x, 2 * whole.step) == 0;
    if (now_ > first_ && fits && error < tolerance_ / 50) --now_;
  }
}

void ExponentialStepper::advance(long interval, State& state)
{
  const auto begin = static_cast<double>(interval);
  Eigen::MatrixXd y = to_modes_ * (vector_of(state) - driven(begin));
  integrate(interval, y);
  state = state_of(to_state_ * y.col(0) + driven(begin + 1));
}

Eigen::MatrixXd ExponentialStepper::derivative(long interval, const State& start)
{
  const Eigen::Index n = to_modes_.rows();
  Eigen::MatrixXd y(n, n + 1);
  y << to_modes_ * (vector_of(start) - driven(static_cast<double>(interval))), to_modes_;
  integrate(interval, y);
  return to_state_ * y.rightCols(n);
}

}  // namespace rotor_stator
