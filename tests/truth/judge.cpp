/**
# An independent judge of periodic motions

Shares no code with src: its own right-hand sides, its own integrator (Runge-Kutta-Fehlberg 4(5) on the
state and its 8 variations together, the local error of all of them controlled), its own Newton iteration
on the period map, eigenvalues by Eigen. One line in, one line out:

    machine m_s w_s xi_s m_r w_r xi_r m_e_e n K_H delta c g  f[Hz] periods  y_1 … y_8
    springs Omega periods  y_1 … y_4                 two masses, unilateral spring (NLvib's third example)

    converged closure largest_multiplier its_change real imaginary  y_1 …

The state is x_s, y_s, x_r, y_r, then their rates; for the springs q_1, q_2, then their rates. The change is
that of the modulus between two tolerances of the integration. */
#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iostream>
#include <numbers>
#include <sstream>
#include <vector>

namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/** y' = f(t, y) with its Jacobian. */
struct Equation {
  double period;
  Vector size;  ///< of each component
  std::function<void(double t, const Vector& y, Vector& rate, Matrix& jacobian)> evaluate;
};

/** Eq. 7 of the paper, written from the page. */
Equation machine(std::istream& in)
{
  double ms, ws, xs, mr, wr, xr, me, n, k, delta, c, g, f, periods;
  in >> ms >> ws >> xs >> mr >> wr >> xr >> me >> n >> k >> delta >> c >> g >> f >>
      periods;
  const double omega = 2 * std::numbers::pi * f;
  const auto evaluate = [=](double t, const Vector& y, Vector& rate, Matrix& jacobian) {
    double fx = 0, fy = 0, kxx = 0, kxy = 0, kyy = 0;
    for (int j = 0; j < static_cast<int>(n); ++j) {
      const double theta = c * omega * t + 2 * std::numbers::pi * j / n;
      const double cosine = std::cos(theta), sine = std::sin(theta);
      const double p = cosine * (y[2] - y[0]) + sine * (y[3] - y[1]) - delta;
      if (p <= 0) continue;
      const double q = k * std::pow(p, 1.5), slope = 1.5 * k * std::sqrt(p);
      fx += q * cosine, fy += q * sine;
      kxx += slope * cosine * cosine, kxy += slope * cosine * sine,
          kyy += slope * sine * sine;
    }
    const double cs = 2 * xs * ms * ws, ks = ms * ws * ws;
    const double cr = 2 * xr * mr * wr, kr = mr * wr * wr;
    const double turn = me * omega * omega;
    rate.head(4) = y.tail(4);
    rate[4] = (fx - cs * y[4] - ks * y[0]) / ms;
    rate[5] = (fy - cs * y[5] - ks * y[1]) / ms - g;
    rate[6] = (-fx - cr * y[6] - kr * y[2] + turn * std::cos(omega * t)) / mr;
    rate[7] = (-fy - cr * y[7] - kr * y[3] + turn * std::sin(omega * t)) / mr - g;
    jacobian.setZero();
    jacobian.topRightCorner(4, 4).setIdentity();
    Eigen::Matrix2d contact;
    contact << kxx, kxy, kxy, kyy;
    jacobian.block(4, 0, 2, 2) = -contact / ms;
    jacobian.block(4, 2, 2, 2) = contact / ms;
    jacobian.block(6, 0, 2, 2) = contact / mr;
    jacobian.block(6, 2, 2, 2) = -contact / mr;
    for (int i = 0; i < 2; ++i) {
      jacobian(4 + i, i) -= ks / ms, jacobian(4 + i, 4 + i) -= cs / ms;
      jacobian(6 + i, 2 + i) -= kr / mr, jacobian(6 + i, 6 + i) -= cr / mr;
    }
  };
  const double length =
      delta + std::pow((ms + mr) * g / k + 1e-3 * me * ws * ws / k, 2.0 / 3);
  Vector size(8);
  size << Vector::Constant(4, length), Vector::Constant(4, length * std::max(ws, omega));
  return {2 * std::numbers::pi / omega * periods, size, evaluate};
}

Equation springs(std::istream& in)
{
  double omega, periods;
  in >> omega >> periods;
  const auto evaluate = [=](double t, const Vector& y, Vector& rate, Matrix& jacobian) {
    const double gap = std::max(0.0, y[0] - 1), stiff = y[0] > 1 ? 100 : 0;
    rate.head(2) = y.tail(2);
    rate[2] = -(y[0] - y[1]) - 0.03 * (y[2] - y[3]) - 100 * gap;
    rate[3] = (y[0] - 2 * y[1]) + 0.03 * (y[2] - 2 * y[3]) + 0.1 * std::cos(omega * t);
    jacobian << 0, 0, 1, 0, 0, 0, 0, 1, -1 - stiff, 1, -0.03, 0.03, 1, -2, 0.03, -0.06;
  };
  return {2 * std::numbers::pi / omega * periods, Vector::Ones(4), evaluate};
}

/** State and variations as one vector of n + n² values. */
void variational(const Equation& equation, double t, const Vector& z, Vector& rate)
{
  const auto n = equation.size.size();
  static thread_local Vector f;
  static thread_local Matrix jacobian;
  f.resize(n), jacobian.resize(n, n), rate.resize(z.size());
  equation.evaluate(t, z.head(n), f, jacobian);
  rate.head(n) = f;
  Eigen::Map<Matrix>(rate.data() + n, n, n) =
      jacobian * Eigen::Map<const Matrix>(z.data() + n, n, n);
}

struct Map {
  Vector end;
  Matrix derivative;
  bool whole = true;
};

/** One period by the pair of Fehlberg. */
Map period_map(const Equation& equation, const Vector& start, double tolerance)
{
  static const double a[6][5] = {{},
                                 {1. / 4},
                                 {3. / 32, 9. / 32},
                                 {1932. / 2197, -7200. / 2197, 7296. / 2197},
                                 {439. / 216, -8, 3680. / 513, -845. / 4104},
                                 {-8. / 27, 2, -3544. / 2565, 1859. / 4104, -11. / 40}};
  static const double c[6] = {0, 1. / 4, 3. / 8, 12. / 13, 1, 1. / 2};
  static const double b[6] = {16. / 135,      0,        6656. / 12825,
                              28561. / 56430, -9. / 50, 2. / 55};
  static const double e[6] = {1. / 360,       0,       -128. / 4275,
                              -2197. / 75240, 1. / 50, 2. / 55};
  const auto n = equation.size.size();
  Vector z(n + n * n), trial, error, k[6];
  z << start, Matrix::Identity(n, n).reshaped();
  double t = 0, h = equation.period / 1000;
  for (long steps = 0; t < equation.period && steps < 2000000; ++steps) {
    h = std::min(h, equation.period - t);
    for (int i = 0; i < 6; ++i) {
      trial = z;
      for (int j = 0; j < i; ++j) trial += h * a[i][j] * k[j];
      variational(equation, t + c[i] * h, trial, k[i]);
    }
    trial = z, error = Vector::Zero(z.size());
    for (int i = 0; i < 6; ++i) trial += h * b[i] * k[i], error += h * e[i] * k[i];
    double worst = (error.head(n).array() / equation.size.array()).abs().maxCoeff();
    const Eigen::Map<const Matrix> phi(trial.data() + n, n, n),
        change(error.data() + n, n, n);
    const auto scaled = [&](const auto& m) {
      return (equation.size.cwiseInverse().asDiagonal() * m * equation.size.asDiagonal())
          .cwiseAbs()
          .maxCoeff();
    };
    worst = std::max(worst, 1e-2 * scaled(change) / (1 + scaled(phi)));
    if (!(worst < 1e300)) return {start, Matrix::Identity(n, n), false};
    if (worst <= tolerance) t += h, z = trial;
    h *= std::clamp(0.9 * std::pow(tolerance / (worst + 1e-300), 0.2), 0.2, 5.0);
  }
  return {z.head(n), Eigen::Map<const Matrix>(z.data() + n, n, n), t >= equation.period};
}

std::complex<double> largest(const Matrix& phi)
{
  const Eigen::VectorXcd values = phi.eigenvalues();
  Eigen::Index at;
  values.cwiseAbs().maxCoeff(&at);
  return values[at];
}

void judge(const Equation& equation, Vector y)
{
  const auto& s = equation.size;
  Map map = period_map(equation, y, 1e-9);
  const auto open = [&](const Map& m, const Vector& at) {
    return m.whole ? ((m.end - at).array() / s.array()).matrix().norm() : 1e300;
  };
  double closure = open(map, y);
  for (int k = 0; k < 40 && closure > 1e-8; ++k) {
    const auto n = y.size();
    const Matrix a = s.cwiseInverse().asDiagonal() *
                     (map.derivative - Matrix::Identity(n, n)) * s.asDiagonal();
    const Vector step = s.asDiagonal() *
                        a.fullPivLu().solve(((y - map.end).array() / s.array()).matrix());
    double part = 1;
    for (; part > 1e-3; part /= 2) {
      const Map next = period_map(equation, y + part * step, 1e-9);
      if (open(next, y + part * step) < (1 - 0.1 * part) * closure) {
        y += part * step, map = next, closure = open(map, y);
        break;
      }
    }
    if (part <= 1e-3) break;
  }
  const std::complex<double> mu = largest(map.derivative);
  const Map finer = closure < 1e-6 ? period_map(equation, y, 1e-11) : map;
  std::printf("%d %.3g %.9g %.3g %.9g %.9g", closure < 1e-6 && finer.whole, closure,
              std::abs(mu), std::abs(std::abs(largest(finer.derivative)) - std::abs(mu)),
              mu.real(), mu.imag());
  for (double value : y) std::printf(" %.15g", value);
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main()
{
  for (std::string line; std::getline(std::cin, line);) {
    std::istringstream in(line);
    std::string kind;
    in >> kind;
    const Equation equation = kind == "machine" ? machine(in) : springs(in);
    Vector y(equation.size.size());
    for (double& value : y) in >> value;
    if (!in) {
      std::fprintf(stderr, "not a case: %s\n", line.c_str());
      return 2;
    }
    judge(equation, y);
  }
}
