/**
# An independent judge of motions

Shares no code with src: its own right-hand sides, its own integrator (the pair 4(5) of
Fehlberg, local errors controlled), its own Newton iteration on the period map, and
eigenvalues by Eigen. One line in, one line out. A motion is closed with its variations:

    MACHINE f[Hz] periods  y_1 … y_8
    springs Omega periods  y_1 … y_4      two masses, unilateral spring (NLvib, example 3)

    converged  largest multiplier, real and imaginary  y_1 …

or a state is followed beside a neighbour from the period `first` on; period 0 begins at
t = 0. Printed are `kept` periods, the first of them `from` periods after the start:

    settle first transient observed from kept instants tolerance  MACHINE f periods  y_1 …

    K  (exponent, error) x 2  (mean, error) x 4  (mean square, error) x 4  x_s y_s x_r …

K periods close to 1e-6, 0: none up to 16, -1: no number left. The exponents [1/s] are of
both halves of what is observed; errors come from the means of ten parts. MACHINE is

    eq7 m_s k_s c_s m_r k_r c_r m_e_e n K exponent delta c lambda
        depth width place turning  f_x_s f_y_s f_x_r f_y_r

A period is `periods` turns, which need not be whole. The state is x_s, y_s, x_r, y_r and
their rates; for the springs q_1, q_2 and their rates. */
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

/** Eq. 7 of the paper, written from the page; balls are summed in the cage's frame. */
struct Machine {
  double ms, ks, cs, mr, kr, cr, unbalance, stiffness, exponent, delta, cage, damping;
  double omega;
  double depth, width, place, turning;  // of a spall, whose race turns or not (1 or 0)
  double load[4];                       // constant forces, weights included
  std::vector<double> cosine, sine;

  /** What ball j has lost of its deflection over the spall, and how fast more is lost. */
  std::pair<double, double> lost(std::size_t j, double t) const
  {
    const double full = 2 * std::numbers::pi, speed = (cage - turning) * omega;
    const double angle =
        full * static_cast<double>(j) / static_cast<double>(cosine.size()) + speed * t;
    const double share = std::remainder(angle - place, full) / width;
    if (std::abs(share) >= 0.5) return {0, 0};
    const double c = std::cos(std::numbers::pi * share);
    const double s = std::sin(std::numbers::pi * share);
    return {depth * std::pow(c, 4),
            -4 * std::numbers::pi / width * depth * std::pow(c, 3) * s * speed};
  }

  /** The four accelerations; with `slopes`, 2 x 4, the force by u and by its rate. */
  void rate(double t, double cc, double sc, double ct, double st, const double* y,
            double* out, Eigen::Matrix<double, 2, 4>* slopes = nullptr) const
  {
    const double w = cage * omega;
    const double ux = y[2] - y[0], uy = y[3] - y[1], vx = y[6] - y[4], vy = y[7] - y[5];
    const double a = cc * ux + sc * uy, b = cc * uy - sc * ux;
    const double da = cc * vx + sc * vy + w * b, db = cc * vy - sc * vx - w * a;
    double fa = 0, fb = 0;
    Eigen::Matrix2d by_place = Eigen::Matrix2d::Zero(), by_rate = by_place;
    for (std::size_t j = 0; j < cosine.size(); ++j) {
      const double c = cosine[j], s = sine[j];
      double p = c * a + s * b - delta, faster = c * da + s * db;
      if (p <= 0) continue;
      if (depth > 0) {
        const auto [by, speed] = lost(j, t);
        p -= by, faster -= speed;
        if (p <= 0) continue;
      }
      const double root = exponent == 1.5 ? std::sqrt(p) : std::pow(p, exponent - 1);
      const double q = stiffness * p * root;
      const double share = 1 + damping * faster;
      if (share <= 0) continue;
      fa += share * q * c, fb += share * q * s;
      if (!slopes) continue;
      const Eigen::Vector2d ball(c, s), across(-s, c);
      by_place += exponent * stiffness * root * share * ball * ball.transpose() +
                  damping * q * w * ball * across.transpose();
      by_rate += damping * q * ball * ball.transpose();
    }
    const double fx = cc * fa - sc * fb, fy = sc * fa + cc * fb;
    const double turn = unbalance * omega * omega;
    std::copy(y + 4, y + 8, out);
    out[4] = (fx - cs * y[4] - ks * y[0] + load[0]) / ms;
    out[5] = (fy - cs * y[5] - ks * y[1] + load[1]) / ms;
    out[6] = (-fx - cr * y[6] - kr * y[2] + turn * ct + load[2]) / mr;
    out[7] = (-fy - cr * y[7] - kr * y[3] + turn * st + load[3]) / mr;
    if (!slopes) return;
    Eigen::Matrix2d back;
    back << cc, -sc, sc, cc;
    *slopes << back * by_place * back.transpose(), back * by_rate * back.transpose();
  }

  void rate(double t, const double* y, double* out,
            Eigen::Matrix<double, 2, 4>* slopes = nullptr) const
  {
    rate(t, std::cos(cage * omega * t), std::sin(cage * omega * t), std::cos(omega * t),
         std::sin(omega * t), y, out, slopes);
  }

  /** Of a state and of its neighbour. */
  void rates(double t, const double* y, double* out) const
  {
    const double cc = std::cos(cage * omega * t), sc = std::sin(cage * omega * t);
    const double ct = std::cos(omega * t), st = std::sin(omega * t);
    rate(t, cc, sc, ct, st, y, out), rate(t, cc, sc, ct, st, y + 8, out + 8);
  }

  Vector size() const
  {
    const double weight = std::hypot(load[0] + load[2], load[1] + load[3]);
    const double length =
        std::abs(delta) +
        std::pow((weight + 1e-3 * unbalance * ks / ms) / stiffness, 2.0 / 3);
    const double joint = std::sqrt((ks + kr) / (ms + mr));
    Vector size(8);
    size << Vector::Constant(4, length),
        Vector::Constant(4, length * (ms < 1e20 ? joint : omega));
    return size;
  }
};

/** The words of a case and its period [s]. */
Machine read_machine(std::istream& in, double& period)
{
  Machine m{};
  double n, f, periods;
  in >> m.ms >> m.ks >> m.cs >> m.mr >> m.kr >> m.cr >> m.unbalance >> n >> m.stiffness >>
      m.exponent >> m.delta >> m.cage >> m.damping >> m.depth >> m.width >> m.place >>
      m.turning;
  for (double& force : m.load) in >> force;
  in >> f >> periods;
  m.omega = 2 * std::numbers::pi * f, period = periods / f;
  for (int j = 0; j < n; ++j) {
    m.cosine.push_back(std::cos(2 * std::numbers::pi * j / n));
    m.sine.push_back(std::sin(2 * std::numbers::pi * j / n));
  }
  return m;
}

Equation equation_of(const Machine& m, double period)
{
  const auto evaluate = [m](double t, const Vector& y, Vector& rate, Matrix& jacobian) {
    Eigen::Matrix<double, 2, 4> slopes;
    m.rate(t, y.data(), rate.data(), &slopes);
    jacobian.setZero();
    jacobian.topRightCorner(4, 4).setIdentity();
    for (int of : {0, 4}) {
      const auto part = slopes.middleCols(of / 2, 2);
      jacobian.block(4, of, 2, 2) = -part / m.ms;
      jacobian.block(4, of + 2, 2, 2) = part / m.ms;
      jacobian.block(6, of, 2, 2) = part / m.mr;
      jacobian.block(6, of + 2, 2, 2) = -part / m.mr;
    }
    for (int i = 0; i < 2; ++i) {
      jacobian(4 + i, i) -= m.ks / m.ms, jacobian(4 + i, 4 + i) -= m.cs / m.ms;
      jacobian(6 + i, 2 + i) -= m.kr / m.mr, jacobian(6 + i, 6 + i) -= m.cr / m.mr;
    }
  };
  return {period, m.size(), evaluate};
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

/** Advances z over `length` from t by the pair of Fehlberg, at local errors of which
    `worst` is below the tolerance; h is the first and then the next step. False if that
    does not get there. */
template <class State, class Rate, class Worst>
bool advance(const Rate& find_rate, const Worst& find_worst, double tolerance, double t,
             double length, double& h, State& z)
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
  static thread_local State trial, error, k[6];
  const double end = t + length;
  for (long steps = 0; t < end && steps < 2000000; ++steps) {
    const double left = end - t, step = std::min(h, left);
    for (int i = 0; i < 6; ++i) {
      trial = z;
      for (int j = 0; j < i; ++j) trial += step * a[i][j] * k[j];
      find_rate(t + c[i] * step, trial, k[i]);
    }
    trial = z, error = State::Zero(z.size());
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
  std::printf("%d %.9g %.9g", closure < 1e-6, mu.real(), mu.imag());
  for (double value : y) std::printf(" %.15g", value);
  std::printf("\n");
  std::fflush(stdout);
}

struct Asked {
  int first, transient, observed, from, kept, instants;
  double tolerance;
};

/** Mean and standard error from the means of ten parts. */
std::pair<double, double> mean_of(const std::vector<double>& values, std::size_t from,
                                  std::size_t count)
{
  const std::size_t part = count / 10;
  double mean = 0, squares = 0;
  for (std::size_t i = 0; i < 10 && part > 0; ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < part; ++k)
      sum += values[from + i * part + k] / static_cast<double>(part);
    mean += sum / 10, squares += sum * sum / 10;
  }
  return {mean, std::sqrt(std::max(0.0, squares - mean * mean) / 9)};
}

/** After how many periods the section closes to 1e-6 of `size`, up to 16; else 0. */
int closing(const std::vector<Vector>& section, double size)
{
  constexpr std::size_t most = 16;
  const std::size_t n = section.size(), look = std::min<std::size_t>(32, n / 3);
  for (std::size_t k = 1; k <= most && n >= look + most; ++k) {
    double open = 0;
    for (std::size_t i = n - look; i < n; ++i)
      open = std::max(open, (section[i] - section[i - k]).cwiseAbs().maxCoeff());
    if (open < 1e-6 * size) return static_cast<int>(k);
  }
  return 0;
}

/** A state and its neighbour, whose distance is set back once per period. */
void settle(const Machine& m, double period, const Vector& y, const Asked& asked)
{
  using State = Eigen::Matrix<double, 16, 1>;
  constexpr double apart = 1e-6;
  constexpr int coarse = 32;  // instants of a period that is observed, but not kept
  const Vector s = m.size();
  State sizes, z;
  sizes << s, s;
  z << y, y + apart * s;
  const State per = sizes.cwiseInverse();
  const auto rate = [&](double t, const State& at, State& out) {
    m.rates(t, at.data(), out.data());
  };
  const auto worst = [&](const State&, const State& error) {
    return error.cwiseProduct(per).cwiseAbs().maxCoeff();
  };
  std::vector<Vector> section, motion;
  std::vector<double> growth, first[4], second[4];
  double h = period / 1000, size = 0;
  for (int turn = 0; turn < asked.transient + asked.observed; ++turn) {
    const bool kept = turn >= asked.from && turn < asked.from + asked.kept;
    const bool seen = turn >= asked.transient;
    const int instants = kept ? asked.instants : seen ? coarse : 1;
    double sums[8] = {};
    for (int k = 0; k < instants; ++k) {
      if (kept) motion.push_back(z.head(4));
      for (int i = 0; i < 4 && seen; ++i)
        sums[i] += z[i] / instants, sums[4 + i] += z[i] * z[i] / instants,
            size = std::max(size, std::abs(z[i]));
      if (!advance(rate, worst, asked.tolerance,
                   (asked.first + turn + 1.0 * k / instants) * period, period / instants,
                   h, z)) {
        std::printf("-1\n");
        std::fflush(stdout);
        return;
      }
    }
    const Vector away = (z.tail(8) - z.head(8)).cwiseProduct(per.head(8));
    const double back = apart * std::sqrt(8.0) / away.norm();
    z.tail(8) = z.head(8) + back * (z.tail(8) - z.head(8)).eval();
    if (!seen) continue;
    growth.push_back(-std::log(back) / period);
    section.push_back(z.head(4));
    for (int i = 0; i < 4; ++i)
      first[i].push_back(sums[i]), second[i].push_back(sums[4 + i]);
  }
  std::printf("%d", closing(section, size));
  const std::size_t half = growth.size() / 2;
  for (std::size_t window : {0, 1}) {
    const auto [mean, error] = mean_of(growth, window * half, half);
    std::printf(" %.9g %.3g", mean, error);
  }
  for (const auto* of : {first, second})
    for (int i = 0; i < 4; ++i) {
      const auto [mean, error] = mean_of(of[i], 0, of[i].size());
      std::printf(" %.12g %.3g", mean, error);
    }
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
    Asked asked{};
    const bool settles = kind == "settle";
    if (settles)
      in >> asked.first >> asked.transient >> asked.observed >> asked.from >>
          asked.kept >> asked.instants >> asked.tolerance >> kind;
    Machine machine{};
    double period = 0;
    if (kind != "springs") machine = read_machine(in, period);
    const Equation equation =
        kind == "springs" ? springs(in) : equation_of(machine, period);
    Vector y(equation.size.size());
    for (double& value : y) in >> value;
    if (!in) {
      std::fprintf(stderr, "not a case: %s\n", line.c_str());
      return 2;
    }
    if (settles)
      settle(machine, period, y, asked);
    else
      judge(equation, y);
  }
}
