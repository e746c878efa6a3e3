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
#include "io/errors.hpp"
#include "model/catalogue.hpp"

namespace rotor_stator::motion {

static constexpr double turn = 2 * std::numbers::pi;
static constexpr double window_terms[] = {0.35875, -0.48829, 0.14128, -0.01168};

Eigen::VectorXd blackman_harris(Eigen::Index samples)
{
  const double step = turn / static_cast<double>(samples);
  Eigen::VectorXd window = Eigen::VectorXd::Zero(samples);
  for (Eigen::Index at = 0; at < samples; ++at)
    for (int k = 0; k < 4; ++k)
      window[at] += window_terms[k] * std::cos(k * (step * static_cast<double>(at)));
  return window / window.sum();
}

/**
## From a series */

/** Of a series of Eq. 9 with any frequencies. */
static Lines lines_of(const Eigen::MatrixXd& series, const std::vector<double>& orders)
{
  Lines all;
  for (int i = 0; i < 4; ++i) all.mean[i] = series(i, 0);
  for (std::size_t h = 1; h < orders.size(); ++h) {
    Line& line = all.lines.emplace_back(Line{orders[h], {}});
    for (int i = 0; i < 4; ++i)
      line.amplitude[i] = std::hypot(series(i, 2 * h - 1), series(i, 2 * h));
  }
  return all;
}

Lines lines_of(const Bearing& bearing, const PeriodicMotion& solution, int turns)
{
  std::vector<double> orders;
  for (const Harmonic& h : solution.harmonics.list())
    orders.push_back(h.k_1 / turns + h.k_2 * passages_per_turn(bearing));
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
struct Record {
  Eigen::MatrixXd samples;  ///< N × 4 [m]
  Eigen::Index n = samples.rows();
  Eigen::VectorXd weights = blackman_harris(n);
  Eigen::MatrixXd left = samples;  ///< without the lines
  std::vector<double> bins = {};   ///< of the lines, that of the mean first
  Eigen::MatrixXd moments = {};    ///< weighted products of the columns with the samples
  Eigen::MatrixXd normal = {};     ///< and with each other, below the diagonal
  Eigen::MatrixXd series = {};     ///< as of Eq. 9

  /** One more line, whose amplitude the next `fit` finds. */
  void add(double bin)
  {
    Eigen::Matrix<std::complex<double>, 1, 4> sum;
    sum.setZero();
    std::complex<double> wave = 1;
    const auto step = std::polar(1.0, turn * bin / static_cast<double>(n));
    for (Eigen::Index k = 0; k < n; ++k, wave *= step)
      sum += (weights[k] * wave) * samples.row(k);
    bins.push_back(bin);
    moments.conservativeResize(2 * std::ssize(bins) - 1, 4);
    const Eigen::Index at = moments.rows() - 1;
    moments.row(at) = sum.imag();
    moments.row(std::max<Eigen::Index>(0, at - 1)) = sum.real();
  }

  /** All amplitudes by weighted least squares, and what they leave. */
  void fit()
  {
    extend_normal();
    series = normal.ldlt().solve(moments).transpose();
    left = samples.rowwise() - series.col(0).transpose();
    for (std::size_t h = 1; h < bins.size(); ++h) {
      const Eigen::RowVector4d cosine = series.col(2 * h - 1), sine = series.col(2 * h);
      std::complex<double> wave = 1;
      const auto step = std::polar(1.0, turn * bins[h] / static_cast<double>(n));
      for (Eigen::Index k = 0; k < n; ++k, wave *= step)
        left.row(k) -= wave.real() * cosine + wave.imag() * sine;
    }
  }

  /** Amplitudes in what is left, the root of the sum of squares over the displacements,
      bin by bin. */
  Eigen::VectorXd spectrum_left() const
  {
    FourierTransform transform(static_cast<int>(n));
    Eigen::VectorXd squares = Eigen::VectorXd::Zero(n / 2 + 1);
    for (Eigen::Index i = 0; i < 4; ++i) {
      const Eigen::VectorXd weighted =
          2.0 * static_cast<double>(n) * left.col(i).cwiseProduct(weights);
      squares += transform.spectrum(weighted).cwiseAbs2();
    }
    return squares.cwiseSqrt();
  }

  /** Σ_k e^{2πi bk/N} */
  std::complex<double> sum_of_waves(double bin) const
  {
    const auto count = static_cast<double>(n);
    const double angle = std::numbers::pi * bin / count;
    const double ratio =
        std::abs(angle) < 1e-12 ? count : std::sin(count * angle) / std::sin(angle);
    return std::polar(1.0, angle * (count - 1)) * ratio;
  }

  /** Σ_k w_k e^{2πi bk/N} over Σ_k w_k */
  std::complex<double> window_at(double bin) const
  {
    std::complex<double> sum = 0;
    for (int k = 0; k < 4; ++k)
      sum += 0.5 * window_terms[k] * (sum_of_waves(bin + k) + sum_of_waves(bin - k));
    return sum / (window_terms[0] * static_cast<double>(n));
  }

  /** By the columns 1, cos, sin, … of the lines that it does not have yet. */
  void extend_normal()
  {
    const Eigen::Index known = (normal.rows() + 1) / 2, lines = std::ssize(bins);
    normal.conservativeResize(moments.rows(), moments.rows());
    for (Eigen::Index i = known; i < lines; ++i)
      for (Eigen::Index j = 0; j <= i; ++j) {
        const auto sum = 0.5 * window_at(bins[i] + bins[j]),
                   difference = 0.5 * window_at(bins[i] - bins[j]);
        Eigen::Matrix2d block;  // rows: cos, sin of a; columns: of b
        block << sum.real() + difference.real(), sum.imag() - difference.imag(),
            sum.imag() + difference.imag(), difference.real() - sum.real();
        const Eigen::Index row = i == 0 ? 0 : 2 * i - 1, column = j == 0 ? 0 : 2 * j - 1;
        const Eigen::Index rows = i == 0 ? 1 : 2, columns = j == 0 ? 1 : 2;
        normal.block(row, column, rows, columns) = block.topLeftCorner(rows, columns);
      }
  }
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
                        double near, double least)
{
  constexpr std::size_t most_lines = 200;
  constexpr int most_rounds = 12, passages = 16;
  constexpr double side_lobe = 1e-4;                   // bins
  constexpr double apart = 1.5, apart_of_unnamed = 4;  // bins
  const double turns = static_cast<double>(motion.size()) / motion.points_per_period;
  Record record{displacement_samples(motion)};
  record.add(0);
  std::vector<double> orders{0};
  std::vector<bool> is_named{true};
  const auto add = [&](double bin) {
    const LineName name = name_of(bin / turns, bearings, near / turns, passages);
    const bool named = !name.name.empty();
    const double order = named ? name.order(bearings[name.bearing]) : bin / turns;
    for (std::size_t h = 0; h < record.bins.size(); ++h)
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
      if (record.bins.size() <= most_lines && add(peak.bin)) is_new = true;
    if (!is_new) break;
  }
  record.fit();
  Lines all = lines_of(record.series, orders);
  const Eigen::MatrixXd& q = record.samples;
  const double vibration = (q.rowwise() - q.colwise().mean()).norm();
  all.rest = vibration > 0 ? record.left.norm() / vibration : 0;
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

  double length() const
  {
    return static_cast<double>(std::abs(h)) / denominator +
           2.0 * std::abs(outer) / passing + 2 * std::abs(inner);
  }

  bool is_shorter_than(const Sum& other) const
  {
    const auto key = [](const Sum& s) {
      return std::tuple(s.length(), (s.h != 0) + (s.outer != 0) + (s.inner != 0),
                        std::abs(s.inner));
    };
    return key(*this) < key(other);
  }

  /** Positive terms first. */
  LineName name(int balls) const
  {
    std::string text;
    for (const int sign : {1, -1})
      for (const auto& [multiple, of, symbol] : {std::tuple{inner, 1, "BPFI"},
                                                 {outer, passing, "BPFO"},
                                                 {h, denominator, "X"}}) {
        if (sign * multiple <= 0) continue;
        if (sign < 0 || !text.empty()) text += sign < 0 ? "-" : "+";
        text += term(std::abs(multiple), of, symbol);
      }
    return {static_cast<double>(h) / denominator + balls * inner,
            balls * (static_cast<double>(outer) / passing - inner), 0, text, length()};
  }
};

/** The shortest in parts of X, and in as many parts of BPFO; |k_2| at most `most`. In all
    k_1 = h/K + n inner and k_2/L = outer/L - inner. */
std::optional<Sum> sum_of(double order, const Bearing& bearing, double tolerance,
                          int parts, int passing, int most)
{
  std::optional<Sum> best;
  for (int k_2 = -most * passing; k_2 <= most * passing; ++k_2) {
    const double k_1 = order - k_2 * passages_per_turn(bearing) / passing;
    const double rounded = std::round(parts * k_1);
    if (!(std::abs(k_1 - rounded / parts) <= tolerance && std::abs(rounded) < 1e6))
      continue;
    const int h = static_cast<int>(rounded), each = parts * bearing.balls;
    const int inners = std::abs(h) / each + 1;
    for (int inner = -inners; inner <= inners; ++inner) {
      const Sum sum{h - each * inner, parts, k_2 + passing * inner, passing, inner};
      if (!best || sum.is_shorter_than(*best)) best = sum;
    }
  }
  return best;
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
    if (const auto spin =
            name_of_spin(order, bearing, tolerance,
                         sum ? sum->length() : std::numeric_limits<double>::infinity()))
      return *spin;
  if (sum) return sum->name(bearing.balls);
  const KinematicOrders orders = kinematic_orders(bearing);
  for (const auto& [symbol, unit, most, part] :
       {std::tuple{"FTF", orders.cage, bearing.balls, &LineName::cage},
        {"BSF", orders.spin, 4, &LineName::spin}}) {
    const double multiple = std::round(order / unit);
    if (!(multiple >= 1 && multiple <= most &&
          std::abs(order - multiple * unit) <= tolerance))
      continue;
    LineName name{.name = term(static_cast<int>(multiple), 1, symbol)};
    name.*part = multiple;
    return name;
  }
  /** A torus that has doubled has halves of both; as many would name anything. */
  if (!is_periodic)
    if (const auto halves = sum_of(order, bearing, tolerance, 2, 2, passages / 8))
      return halves->name(bearing.balls);
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
