/**
# An independent judge of periodic motions

Shares no code with src: its own right-hand sides, its own integrator (Runge-Kutta-Fehlberg 4(5) on the
state and its 8 variations together, the local error of all of them controlled), its own Newton iteration
on the period map, eigenvalues by Eigen. One line in, one line out:

    machine m_s w_s xi_s m_r w_r xi_r m_e_e n K_H delta c g  f[Hz] periods  y_1 … y_8
    springs Omega periods  y_1 … y_4                 two masses, unilateral spring (NLvib's third example)

    converged closure largest_multiplier its_change real imaginary  y_1 …

    settle transient observed instants  machine … f[Hz] periods  y_1 … y_8      what becomes of a state

    K exponent[1/s] its_error  x_s y_s x_r y_r  x_s … K periods close to 1e-5, 0: none up to 16; the
                                                    last periods, at most 32, at their instants

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

/** Advances z over `length` from t by the pair of Fehlberg, at local errors of which `worst` is below the tolerance;
    h is the first and then the next step. False if that does not get there. */
template <class Rate, class Worst>
bool advance(const Rate& find_rate, const Worst& find_worst, double tolerance, double t,
             double length, double& h, Vector& z)
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
  static thread_local Vector trial, error, k[6];
  const double end = t + length;
  for (long steps = 0; t < end && steps < 2000000; ++steps) {
    const double left = end - t, step = std::min(h, left);
    for (int i = 0; i < 6; ++i) {
      trial = z;
      for (int j = 0; j < i; ++j) trial += step * a[i][j] * k[j];
      find_rate(t + c[i] * step, trial, k[i]);
    }
    trial = z, error = Vector::Zero(z.size());
    for (int i = 0; i < 6; ++i) trial += step * b[i] * k[i], error += step * e[i] * k[i];
    const double worst = find_worst(trial, error);
    if (!(worst < 1e300)) return false;
    if (worst <= tolerance) t = step == left ? end : t + step, z = trial;
    h = step * std::clamp(0.9 * std::pow(tolerance / (worst + 1e-300), 0.2), 0.2, 5.0);
  }
  return t == end;
}

/** One period. */
Map period_map(const Equation& equation, const Vector& start, double tolerance)
{
  const auto n = equation.size.size();
  Vector z(n + n * n);
  z << start, Matrix::Identity(n, n).reshaped();
  const auto worst = [&](const Vector& next, const Vector& error) {
    const auto scaled = [&](const auto& m) {
      return (equation.size.cwiseInverse().asDiagonal() * m * equation.size.asDiagonal())
          .cwiseAbs()
          .maxCoeff();
    };
    const Eigen::Map<const Matrix> phi(next.data() + n, n, n),
        change(error.data() + n, n, n);
    return std::max((error.head(n).array() / equation.size.array()).abs().maxCoeff(),
                    1e-2 * scaled(change) / (1 + scaled(phi)));
  };
  const auto rate = [&](double t, const Vector& at, Vector& rate) {
    variational(equation, t, at, rate);
  };
  double h = equation.period / 1000;
  if (!advance(rate, worst, tolerance, 0, equation.period, h, z))
    return {start, Matrix::Identity(n, n), false};
  return {z.head(n), Eigen::Map<const Matrix>(z.data() + n, n, n)};
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

/** A state and its neighbour, whose distance is set back once per period: where they settle, and how fast they part. */
void settle(const Equation& equation, Vector y, int transient, int observed, int instants)
{
  const int kept = std::min(32, transient + observed);
  constexpr int most = 16;
  constexpr double apart = 1e-6, tolerance = 1e-8;
  const auto n = y.size();
  const auto& s = equation.size;
  Vector f(n), z(2 * n);
  Matrix unused(n, n);
  const auto rate = [&](double t, const Vector& at, Vector& out) {
    out.resize(2 * n);
    for (int half : {0, 1}) {
      equation.evaluate(t, at.segment(half * n, n), f, unused);
      out.segment(half * n, n) = f;
    }
  };
  const auto worst = [&](const Vector&, const Vector& error) {
    return std::max((error.head(n).array() / s.array()).abs().maxCoeff(),
                    (error.tail(n).array() / s.array()).abs().maxCoeff());
  };
  z << y, y + apart * s;
  std::vector<Vector> section, motion;
  std::vector<double> growth;
  double h = equation.period / 1000;
  for (int period = 0; period < transient + observed; ++period) {
    for (int k = 0; k < instants; ++k) {
      if (period >= transient + observed - kept) motion.push_back(z.head(4));
      if (!advance(rate, worst, tolerance,
                   (period + 1.0 * k / instants) * equation.period,
                   equation.period / instants, h, z)) {
        std::printf("-1 0 0\n");
        std::fflush(stdout);
        return;
      }
    }
    const Vector away = ((z.tail(n) - z.head(n)).array() / s.array()).matrix();
    if (period >= transient)
      growth.push_back(std::log(away.norm() / (apart * std::sqrt(n))));
    z.tail(n) = z.head(n) + apart * std::sqrt(n) / away.norm() * (z.tail(n) - z.head(n));
    if (period >= transient) section.push_back((z.head(n).array() / s.array()).matrix());
  }
  int closed = 0;
  double size = 0;
  for (const Vector& at : motion) size = std::max(size, at.cwiseAbs().maxCoeff());
  for (int k = 1; k <= most && closed == 0 && observed >= kept + most; ++k) {
    double open = 0;
    for (std::size_t i = section.size() - kept; i < section.size(); ++i)
      open = std::max(
          open,
          ((section[i] - section[i - k]).array() * s.array()).head(4).abs().maxCoeff());
    if (open < 1e-5 * size) closed = k;
  }
  /** The error from the means of ten parts. */
  const int part = observed / 10;
  double mean = 0, squares = 0;
  for (int i = 0; i < 10 && part > 0; ++i) {
    double sum = 0;
    for (int k = 0; k < part; ++k) sum += growth[static_cast<std::size_t>(i * part + k)];
    sum /= part * equation.period;
    mean += sum / 10, squares += sum * sum / 10;
  }
  std::printf("%d %.9g %.3g", closed, mean,
              std::sqrt(std::max(0.0, squares - mean * mean) / 9));
  for (const Vector& at : motion)
    for (double value : at) std::printf(" %.12g", value);
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
    int transient = 0, observed = 0, instants = 0;
    const bool settles = kind == "settle";
    if (settles) in >> transient >> observed >> instants >> kind;
    const Equation equation = kind == "machine" ? machine(in) : springs(in);
    Vector y(equation.size.size());
    for (double& value : y) in >> value;
    if (!in) {
      std::fprintf(stderr, "not a case: %s\n", line.c_str());
      return 2;
    }
    if (settles)
      settle(equation, y, transient, observed, instants);
    else
      judge(equation, y);
  }
}
