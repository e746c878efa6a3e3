#include "motion/lines.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <numeric>
#include <regex>
#include <tuple>

#include <Eigen/Cholesky>

#include "balance/fourier_transform.hpp"
#include "balance/torus_line.hpp"
#include "io/errors.hpp"
#include "model/catalogue.hpp"

namespace rotor_stator::motion {

namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr double least = 1e-6;  ///< of the largest line
constexpr double window_terms[] = {0.35875, -0.48829, 0.14128, -0.01168};

}  // namespace

Eigen::VectorXd blackman_harris(Eigen::Index samples)
{
  const double step = turn / static_cast<double>(samples);
  Eigen::VectorXd window = Eigen::VectorXd::Zero(samples);
  for (Eigen::Index at = 0; at < samples; ++at)
    for (int k = 0; k < 4; ++k)
      window[at] += window_terms[k] * std::cos(k * (step * static_cast<double>(at)));
  return window / window.sum();
}

double Line::largest() const
{
  return *std::ranges::max_element(amplitude);
}

/**
## From a series */

namespace {

/** Of a series of Eq. 9 with any frequencies. */
Lines lines_of(const Eigen::MatrixXd& series, const std::vector<double>& orders)
{
  Lines all;
  for (Eigen::Index i = 0; i < 4; ++i)
    all.mean[static_cast<std::size_t>(i)] = series(i, 0);
  for (std::size_t h = 1; h < orders.size(); ++h) {
    Line line{orders[h], {}};
    const auto column = static_cast<Eigen::Index>(2 * h);
    for (Eigen::Index i = 0; i < 4; ++i)
      line.amplitude[static_cast<std::size_t>(i)] =
          std::hypot(series(i, column - 1), series(i, column));
    all.lines.push_back(line);
  }
  return all;
}

}  // namespace

Lines lines_of(const Bearing& bearing, const PeriodicMotion& solution, int turns)
{
  std::vector<double> orders;
  for (const Harmonic& h : solution.harmonics.list())
    orders.push_back(order_of({h.k_1, 0}, bearing) / turns +
                     order_of({0, h.k_2}, bearing));
  return lines_of(solution.bodies, orders);
}

Lines lines_of_closed(const Motion& motion, double turns)
{
  const int m = (motion.points_per_period - 1) / 2;
  std::vector<double> orders;
  for (int h = 0; h <= m; ++h) orders.push_back(h / turns);
  return lines_of(series_of(motion, m), orders);
}

/**
## From a record */

namespace {

/** Frequencies are in bins, periods in the record. */
class Record {
public:
  explicit Record(const Motion& motion)
      : n_(std::ssize(motion.positions)), samples_(displacement_samples(motion)),
        weights_(blackman_harris(n_)), left_(samples_)
  {
    add(0);
  }

  std::size_t size() const { return bins_.size(); }

  /** One more line, whose amplitude the next `fit` finds. */
  void add(double bin)
  {
    Eigen::Matrix<std::complex<double>, 1, 4> sum;
    sum.setZero();
    std::complex<double> wave = 1;
    const auto step = std::polar(1.0, turn * bin / static_cast<double>(n_));
    for (Eigen::Index k = 0; k < n_; ++k, wave *= step)
      sum += (weights_[k] * wave) * samples_.row(k);
    bins_.push_back(bin);
    moments_.conservativeResize(2 * std::ssize(bins_) - 1, 4);
    const Eigen::Index at = moments_.rows() - 1;
    moments_.row(at) = sum.imag();
    moments_.row(std::max<Eigen::Index>(0, at - 1)) = sum.real();
  }

  /** All amplitudes by weighted least squares, and what they leave. */
  void fit()
  {
    series_ = normal_matrix().ldlt().solve(moments_).transpose();
    left_ = samples_.rowwise() - series_.col(0).transpose();
    for (std::size_t h = 1; h < bins_.size(); ++h) {
      const auto column = static_cast<Eigen::Index>(2 * h);
      const Eigen::RowVector4d cosine = series_.col(column - 1),
                               sine = series_.col(column);
      std::complex<double> wave = 1;
      const auto step = std::polar(1.0, turn * bins_[h] / static_cast<double>(n_));
      for (Eigen::Index k = 0; k < n_; ++k, wave *= step)
        left_.row(k) -= wave.real() * cosine + wave.imag() * sine;
    }
  }

  /** Amplitudes in what is left, the root of the sum of squares over the displacements,
      bin by bin. */
  Eigen::VectorXd spectrum_left() const
  {
    FourierTransform transform(static_cast<int>(n_));
    Eigen::VectorXd squares = Eigen::VectorXd::Zero(n_ / 2 + 1);
    for (Eigen::Index i = 0; i < 4; ++i) {
      const Eigen::VectorXd weighted =
          2.0 * static_cast<double>(n_) * left_.col(i).cwiseProduct(weights_);
      squares += transform.spectrum(weighted).cwiseAbs2();
    }
    return squares.cwiseSqrt();
  }

  const Eigen::MatrixXd& series() const { return series_; }

  double rest() const
  {
    const double all = (samples_.rowwise() - samples_.colwise().mean()).norm();
    return all > 0 ? left_.norm() / all : 0;
  }

private:
  /** Σ_k e^{2πi bk/N} */
  std::complex<double> sum_of_waves(double bin) const
  {
    const auto n = static_cast<double>(n_);
    const double angle = std::numbers::pi * bin / n;
    const double ratio =
        std::abs(angle) < 1e-12 ? n : std::sin(n * angle) / std::sin(angle);
    return std::polar(1.0, angle * (n - 1)) * ratio;
  }

  /** Σ_k w_k e^{2πi bk/N} over Σ_k w_k */
  std::complex<double> window_at(double bin) const
  {
    std::complex<double> sum = 0;
    for (int k = 0; k < 4; ++k)
      sum += 0.5 * window_terms[k] * (sum_of_waves(bin + k) + sum_of_waves(bin - k));
    return sum / (window_terms[0] * static_cast<double>(n_));
  }

  /** Weighted products of the columns 1, cos, sin, … */
  Eigen::MatrixXd normal_matrix() const
  {
    Eigen::MatrixXd matrix(moments_.rows(), moments_.rows());
    const auto lines = std::ssize(bins_);
    for (Eigen::Index i = 0; i < lines; ++i)
      for (Eigen::Index j = 0; j <= i; ++j) {
        const double a = bins_[static_cast<std::size_t>(i)],
                     b = bins_[static_cast<std::size_t>(j)];
        const auto sum = 0.5 * window_at(a + b), difference = 0.5 * window_at(a - b);
        Eigen::Matrix2d block;  // rows: cos, sin of a; columns: of b
        block << sum.real() + difference.real(), sum.imag() - difference.imag(),
            sum.imag() + difference.imag(), difference.real() - sum.real();
        const Eigen::Index row = i == 0 ? 0 : 2 * i - 1, column = j == 0 ? 0 : 2 * j - 1;
        const Eigen::Index rows = i == 0 ? 1 : 2, columns = j == 0 ? 1 : 2;
        matrix.block(row, column, rows, columns) = block.topLeftCorner(rows, columns);
        matrix.block(column, row, columns, rows) =
            block.topLeftCorner(rows, columns).transpose();
      }
    return matrix;
  }

  Eigen::Index n_;
  Eigen::MatrixXd samples_;  ///< N × 4 [m]
  Eigen::VectorXd weights_;
  Eigen::MatrixXd left_;      ///< without the lines
  std::vector<double> bins_;  ///< of the lines, that of the mean first
  Eigen::MatrixXd moments_;   ///< weighted products of the columns with the samples
  Eigen::MatrixXd series_;    ///< as of Eq. 9
};

struct Peak {
  double bin, height;
};

/** The highest first. */
std::vector<Peak> peaks_of(const Eigen::VectorXd& heights, double lowest)
{
  std::vector<Peak> peaks;
  for (Eigen::Index p = 1; p + 5 < heights.size(); ++p) {
    const auto top = heights.segment<3>(p - 1);
    if (top[1] < lowest || top[1] <= top[0] || top[1] < top[2]) continue;
    const auto log = [&](int k) { return std::log(std::max(top[k], 1e-300)); };
    peaks.push_back({static_cast<double>(p) + vertex(log(0), log(1), log(2)).at, top[1]});
  }
  std::ranges::stable_sort(peaks, std::ranges::greater{}, &Peak::height);
  return peaks;
}

}  // namespace

Lines lines_of_recorded(const std::vector<Bearing>& bearings, const Motion& motion,
                        double near)
{
  constexpr std::size_t most_lines = 200;
  constexpr int most_rounds = 12, passages = 16;
  constexpr double side_lobe = 1e-4;                   // bins
  constexpr double apart = 1.5, apart_of_unnamed = 4;  // bins
  const double turns = static_cast<double>(motion.size()) / motion.points_per_period;
  Record record(motion);
  std::vector<double> orders{0};
  std::vector<bool> is_named{true};
  const auto add = [&](double bin) {
    const LineName name = name_of(bin / turns, bearings, near / turns, passages);
    const bool named = !name.name.empty();
    const double order = named ? name.order(bearings[name.bearing]) : bin / turns;
    for (std::size_t h = 0; h < record.size(); ++h)
      if (std::abs(order - orders[h]) * turns <
          (is_named[h] && named ? apart : apart_of_unnamed))
        return false;
    record.add(order * turns);
    orders.push_back(order);
    is_named.push_back(named);
    return true;
  };
  double largest = 0;
  for (int round = 0; round < most_rounds; ++round) {
    record.fit();
    const Eigen::VectorXd heights = record.spectrum_left();
    const double highest = heights.maxCoeff();
    largest = std::max(largest, highest);
    bool is_new = false;
    for (const Peak& peak :
         peaks_of(heights, std::max(0.5 * least * largest, side_lobe * highest)))
      if (record.size() <= most_lines && add(peak.bin)) is_new = true;
    if (!is_new) break;
  }
  record.fit();
  Lines all = lines_of(record.series(), orders);
  all.rest = record.rest();
  return all;
}

/**
## Names */

double LineName::order(const Bearing& own) const
{
  const double ball = spin == 0 ? 0 : spin * kinematic_orders(own).spin;
  return rotation + cage * own.cage_speed_ratio + ball;
}

namespace {

/** A term as in BPFO, 2BPFO, 1X or 1/2X, where the multiple is h/K. */
std::string term(int h, int denominator, const char* symbol)
{
  const int common = std::gcd(h, denominator);
  h /= common;
  denominator /= common;
  const std::string whole =
      h == 1 && denominator == 1 && symbol[0] != 'X' ? "" : format("%d", h);
  return whole + (denominator > 1 ? format("/%d", denominator) : "") + symbol;
}

/** h/K X + outer/L BPFO + inner BPFI. */
struct Sum {
  int h, denominator, outer, passing, inner;

  /** Smaller is shorter. */
  auto length() const
  {
    return std::tuple(static_cast<double>(std::abs(h)) / denominator +
                          2.0 * std::abs(outer) / passing + 2 * std::abs(inner),
                      (h != 0) + (outer != 0) + (inner != 0), std::abs(inner));
  }

  /** Positive terms first. */
  std::string name() const
  {
    std::string text;
    const auto write = [&](int sign) {
      const auto one = [&](int multiple, int of, const char* symbol) {
        if (sign * multiple <= 0) return;
        if (sign < 0)
          text += "-";
        else if (!text.empty())
          text += "+";
        text += term(std::abs(multiple), of, symbol);
      };
      one(inner, 1, "BPFI");
      one(outer, passing, "BPFO");
      one(h, denominator, "X");
    };
    write(1);
    write(-1);
    return text;
  }
};

/** The shortest with the multiple h/K of X in all: k_1 = h/K + n inner, k_2/L = outer/L -
    inner. */
void shorten(std::optional<Sum>& best, int h, int denominator, int k_2, int passing,
             int balls)
{
  const int most = std::abs(h) / (denominator * balls) + 1;
  for (int inner = -most; inner <= most; ++inner) {
    const Sum sum{h - denominator * balls * inner, denominator, k_2 + passing * inner,
                  passing, inner};
    if (!best || sum.length() < best->length()) best = sum;
  }
}

LineName multiple_of(const char* symbol, double order, double unit, int most,
                     double tolerance)
{
  const double multiple = std::round(order / unit);
  if (multiple < 1 || multiple > most || std::abs(order - multiple * unit) > tolerance)
    return {};
  return {0, 0, 0, term(static_cast<int>(multiple), 1, symbol)};
}

}  // namespace

namespace {

/** The shortest in parts of X, and in as many parts of BPFO; |k_2| at most `most`. */
std::optional<Sum> sum_of(double order, const Bearing& bearing, double tolerance,
                          int parts, int passing, int most)
{
  std::optional<Sum> best;
  for (int k_2 = -most * passing; k_2 <= most * passing; ++k_2) {
    const double k_1 = order - k_2 * passages_per_turn(bearing) / passing;
    const double h = std::round(parts * k_1);
    if (std::abs(k_1 - h / parts) <= tolerance && std::abs(h) < 1e6)
      shorten(best, static_cast<int>(h), parts, k_2, passing, bearing.balls);
  }
  return best;
}

LineName name_of(const Sum& sum, int balls)
{
  return {static_cast<double>(sum.h) / sum.denominator + balls * sum.inner,
          balls * (static_cast<double>(sum.outer) / sum.passing - sum.inner), 0,
          sum.name(), std::get<0>(sum.length())};
}

/** Of a damaged ball, which meets a race every half turn and stands elsewhere each time:
    2s BSF + j FTF + h X, if shorter than `length`. */
std::optional<LineName> name_of_spin(double order, const Bearing& bearing,
                                     double tolerance, double length)
{
  constexpr int most = 16, sidebands = 2;
  const KinematicOrders orders = kinematic_orders(bearing);
  std::optional<LineName> best;
  for (int s = 2; s <= most; s += 2)
    for (int h = -sidebands; h <= sidebands; ++h) {
      const double rest = order - s * orders.spin - h;
      const auto j = static_cast<int>(std::lround(rest / orders.cage));
      const double cost = s + 0.5 * std::abs(j) + std::abs(h);
      if (std::abs(j) > bearing.balls || cost >= length ||
          std::abs(rest - j * orders.cage) > tolerance)
        continue;
      length = cost;
      std::string name = term(s, 1, "BSF");
      for (const auto& [multiple, symbol] : {std::pair{j, "FTF"}, {h, "X"}})
        if (multiple != 0)
          name += (multiple > 0 ? "+" : "-") + term(std::abs(multiple), 1, symbol);
      best = LineName{static_cast<double>(h), static_cast<double>(j),
                      static_cast<double>(s), name, cost};
    }
  return best;
}

}  // namespace

LineName name_of(double order, const Bearing& bearing, double tolerance, int passages)
{
  const bool is_periodic = has_rotation_period(bearing);
  const int fractions = is_periodic ? 8 : 1;
  std::optional<Sum> sum;
  for (int parts = 1; parts <= fractions && !sum; ++parts)
    sum = sum_of(order, bearing, tolerance, parts, 1, passages);
  if (bearing.is_damaged(Defect::Surface::ball))
    if (const auto spin = name_of_spin(
            order, bearing, tolerance,
            sum ? std::get<0>(sum->length()) : std::numeric_limits<double>::infinity()))
      return *spin;
  if (sum) return name_of(*sum, bearing.balls);
  const KinematicOrders orders = kinematic_orders(bearing);
  LineName name = multiple_of("FTF", order, orders.cage, bearing.balls, tolerance);
  name.cage = std::round(order / orders.cage);
  if (name.name.empty() && orders.spin > 0) {
    name = multiple_of("BSF", order, orders.spin, 4, tolerance);
    name.spin = std::round(order / orders.spin);
  }
  if (!name.name.empty()) return name;
  /** A torus that has doubled has halves of both; as many would name anything. */
  if (!is_periodic)
    if (const auto halves = sum_of(order, bearing, tolerance, 2, 2, passages / 8))
      return name_of(*halves, bearing.balls);
  return {};
}

LineName name_of(double order, const std::vector<Bearing>& bearings, double tolerance,
                 int passages)
{
  static const std::regex symbols("BPFO|BPFI|FTF|BSF");
  LineName best;
  for (std::size_t k = 0; k < bearings.size(); ++k) {
    LineName name = name_of(order, bearings[k], tolerance, passages);
    if (name.name.empty() || (!best.name.empty() && name.length >= best.length)) continue;
    if (k > 0)
      name.name = std::regex_replace(name.name, symbols, format("$&_%zu", k + 1));
    name.bearing = k;
    best = name;
  }
  return best;
}

}  // namespace rotor_stator::motion
