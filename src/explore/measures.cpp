#include "explore/measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <sstream>
#include <tuple>

#include "balance/fourier_transform.hpp"
#include "io/errors.hpp"
#include "motion/contact.hpp"

namespace rotor_stator::explore {

namespace {

constexpr double turn = 2 * std::numbers::pi;

struct What {
  const char *name, *unit, *meaning;  ///< without unit: that of the displacement
};
constexpr std::array<What, 8> whats{
    {{"", "", ""},
     {"amp_", "", "half peak-to-peak of "},
     {"peak_", "", "largest distance from the mean of "},
     {"mean_", "", "mean of "},
     {"rms_", "", "rms about the mean of "},
     {"amp_1X_", "", "amplitude at the frequency of rotation of "},
     {"phase_1X_", "rad", "phase there, a cos(omega t + phase), of "},
     {"iso_", "mm/s",
      "rms of the velocity from 10 (below 600 turns a minute 2) to 1000 Hz, ISO 20816, "
      "of "}}};
constexpr std::array<What, 3> rates{
    {{"", "m", ""}, {"v_", "m/s", "velocity of "}, {"a_", "m/s^2", "acceleration of "}}};

constexpr int order = 8;  // of the differences

/** The rate of change at all instants, by the polynomial through nine of them, in whose
    middle an instant stands where it can. */
Eigen::VectorXd rate_of(const Eigen::VectorXd& x, double step, bool is_closed)
{
  const Eigen::Index n = x.size();
  if (n <= order) throw NoSolution("velocities need at least nine instants: --points");
  /** Row j: weights of the nine at the j-th of them, from b_i = (-1)^i C(8, i). */
  Eigen::Matrix<double, order + 1, order + 1> weights;
  Eigen::Vector<double, order + 1> b;
  b[0] = 1;
  for (int i = 0; i < order; ++i) b[i + 1] = -b[i] * (order - i) / (i + 1);
  for (int j = 0; j <= order; ++j) {
    weights(j, j) = 0;
    for (int i = 0; i <= order; ++i)
      if (i != j) weights(j, i) = b[i] / b[j] / (j - i);
    weights(j, j) = -weights.row(j).sum();
  }
  Eigen::VectorXd rate(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Index middle = k - order / 2;
    const Eigen::Index first =
        is_closed ? middle : std::clamp<Eigen::Index>(middle, 0, n - order - 1);
    double sum = 0;
    for (int i = 0; i <= order; ++i)
      sum += weights(k - first, i) * x[(first + i + n) % n];
    rate[k] = sum / step;
  }
  return rate;
}

/** Hann's window with mean 1, or ones. */
Eigen::VectorXd window_of(const Record& record, Eigen::Index n)
{
  if (record.is_closed) return Eigen::VectorXd::Ones(n);
  return 1 -
         Eigen::ArrayXd::LinSpaced(n, 0, turn * (1 - 1.0 / static_cast<double>(n))).cos();
}

/** The complex amplitude at the rotor's angle; 0 where the record holds no whole turns,
    as of a rotor without unbalance over its passing balls. */
std::complex<double> at_rotation(const Eigen::VectorXd& x, const Record& record)
{
  const double angle = turn * record.speed * record.step;  // from instant to instant
  const double turns = static_cast<double>(x.size()) * angle / turn;
  if (record.is_closed && std::abs(turns - std::round(turns)) > 1e-6) return 0;
  const Eigen::VectorXd weighted =
      (x.array() - x.mean()).matrix().cwiseProduct(window_of(record, x.size()));
  const double first = angle * static_cast<double>(record.motion.first_period) *
                       record.motion.points_per_period;
  std::complex<double> sum = 0;
  for (Eigen::Index k = 0; k < x.size(); ++k)
    sum += weighted[k] *
           std::polar(1.0, -std::remainder(first + angle * static_cast<double>(k), turn));
  return 2.0 * sum / static_cast<double>(x.size());
}

/** The rms of what lies between two frequencies [Hz]. */
double rms_between(const Eigen::VectorXd& x, const Record& record, double low,
                   double high)
{
  const auto n = static_cast<int>(x.size());
  const Eigen::VectorXd window = window_of(record, n);
  FourierTransform transform(n);
  const Eigen::VectorXd centred = (x.array() - x.mean()) * window.array();
  const auto lines = transform.spectrum(centred);
  /** Hann's window spreads a line over two to either side. */
  const double resolution = 1 / (n * record.step),
               beyond = (record.is_closed ? 1e-6 : 2) * resolution;
  double square = 0;
  for (Eigen::Index p = 1; p < lines.size(); ++p) {
    const double f = static_cast<double>(p) * resolution;
    if (f >= low - beyond && f <= high + beyond) square += 2 * std::norm(lines[p]);
  }
  return std::sqrt(square / window.array().square().mean());
}

double value_of(const std::string& what, const Eigen::VectorXd& x, const Record& record)
{
  const double mean = x.mean();
  if (what == "mean_") return mean;
  if (what == "amp_" || what == "peak_") {
    /** Rates are worst at the ends of a record. */
    const Eigen::Index ends =
        record.is_closed ? 0 : std::min<Eigen::Index>(2 * order, x.size() / 4);
    const Eigen::ArrayXd inner = x.segment(ends, x.size() - 2 * ends);
    if (what == "amp_") return half_range(inner, record.is_closed);
    return std::max(largest_of(inner - mean, record.is_closed),
                    largest_of(mean - inner, record.is_closed));
  }
  if (what == "rms_") return std::sqrt((x.array() - mean).square().mean());
  if (what == "amp_1X_") return std::abs(at_rotation(x, record));
  if (what == "phase_1X_") return std::arg(at_rotation(x, record));
  constexpr double slow = 10;  // [Hz], 600 turns a minute
  return 1e3 * rms_between(x, record, record.speed < slow ? 2 : 10, 1000);
}

/** At all instants. */
Eigen::VectorXd samples_of(const Record& record, const Measure& one)
{
  using Of = Measure::Of;
  const auto& [machine, motion, step, speed, is_closed] = record;
  Eigen::VectorXd x(std::ssize(motion.positions));
  if (one.of == Of::displacement) {
    for (std::size_t k = 0; k < motion.size(); ++k)
      x[static_cast<Eigen::Index>(k)] = motion::shown_at(motion, k, one.place);
    for (int i = 0; i < one.rates; ++i) x = rate_of(x, step, is_closed);
  } else if (one.of == Of::contact_share) {
    x.setConstant(one.place < 0 ? motion::contact_share(machine, motion)
                                : motion::contact_share(machine, motion, one.place));
  } else if (one.of == Of::ball_load || one.of == Of::stress) {
    const double load = motion::largest_ball_load(machine, motion, one.place);
    const double pressure = bearings_of(machine)[one.place].pressure;
    x.setConstant(one.of == Of::stress ? 1e-6 * pressure * std::cbrt(load) : load);
  } else {
    const auto forces = motion::bearing_forces(machine, motion, one.place);
    std::ranges::transform(forces, x.begin(), [&](Vec2 f) {
      return one.of == Of::force_x   ? f.x
             : one.of == Of::force_y ? f.y
                                     : std::hypot(f.x, f.y);
    });
    if (one.of == Of::force) x.setConstant(largest_of(x, is_closed));
  }
  return x;
}

/** All that a machine has. */
std::vector<Measure> measures_of(const Parameters& machine)
{
  using Of = Measure::Of;
  std::vector<std::pair<std::string, int>> places{
      {"x_s", 0}, {"y_s", 1}, {"x_r", 2}, {"y_r", 3}};
  for (const auto& output : machine.bodies->outputs()) places.push_back(output);
  const std::vector<Bearing> bearings = bearings_of(machine);
  std::vector<Measure> all;
  for (const What& what : whats) {
    const std::string name = what.name, meaning = what.meaning;
    const bool is_iso = name == "iso_";
    for (const auto& [place, at] : places)
      for (int k = 0; k < (is_iso ? 1 : std::ssize(rates)); ++k)
        if (!name.empty() || k > 0)  // which orbit has, as it has the forces
          all.push_back(
              {{name + rates[k].name + place, *what.unit ? what.unit : rates[k].unit,
                meaning + rates[k].meaning + place},
               name,
               Of::displacement,
               at,
               is_iso ? 1 : k});
    for (int b = 0; b < std::ssize(bearings) && !name.empty() && !is_iso; ++b)
      for (const Of axis : {Of::force_x, Of::force_y}) {
        const std::string force = numbered(axis == Of::force_x ? "F_x" : "F_y", b);
        all.push_back({{name + force, *what.unit ? what.unit : "N", meaning + force},
                       name,
                       axis,
                       b});
      }
  }
  const auto add = [&](const std::string& name, const char* unit, const char* meaning,
                       Of of, int b) {
    all.push_back({{name, unit, meaning}, "mean_", of, b});
  };
  add("contact_share", "-", "share of the time with a loaded ball", Of::contact_share,
      -1);
  for (int b = 0; b < std::ssize(bearings); ++b) {
    add(format("contact_share_%d", b + 1), "-", "the same, of that bearing",
        Of::contact_share, b);
    add(numbered("ball_load", b), "N", "largest force of a ball of the bearing",
        Of::ball_load, b);
    add(numbered("force", b), "N", "largest force of the bearing, Eq. 6", Of::force, b);
    if (bearings[b].pressure > 0)
      add(numbered("stress", b), "N/mm^2", "largest pressure of Hertz in the bearing",
          Of::stress, b);
  }
  return all;
}

}  // namespace

Measures::Measures(const std::string& names, const Parameters& machine,
                   const std::vector<Column>& known, bool at_instants)
{
  const std::vector<Measure> all = measures_of(machine);
  std::istringstream in(names);
  for (std::string name; std::getline(in, name, ',');) {
    if (std::ranges::find(known, name, &Column::name) != known.end()) continue;
    const auto is_named = [&](const Measure& one) { return one.column.name == name; };
    const auto found = std::ranges::find_if(all, is_named);
    if (found == all.end() || (found->what.empty() && !at_instants)) continue;
    all_.push_back(*found);
  }
}

std::vector<Column> Measures::columns() const
{
  std::vector<Column> columns;
  for (const Measure& one : all_) columns.push_back(one.column);
  return columns;
}

bool Measures::needs_whole() const
{
  return std::ranges::any_of(all_, [](const Measure& one) { return !one.what.empty(); });
}

std::vector<double> Measures::of(const Record& record) const
{
  std::map<std::tuple<Measure::Of, int, int>, Eigen::VectorXd> known;
  std::vector<double> values;
  for (const Measure& one : all_) {
    auto& x = known[{one.of, one.place, one.rates}];
    if (x.size() == 0) x = samples_of(record, one);
    values.push_back(value_of(one.what, x, record));
  }
  return values;
}

std::vector<double> Measures::of(const Parameters& machine,
                                 const PeriodicMotion& solution, int points) const
{
  points = recording(machine, solution.omega, points).points;
  return of(record_of(machine, motion::motion_of(solution, points), true));
}

std::vector<std::vector<double>> Measures::at_instants(const Record& record) const
{
  std::vector<std::vector<double>> columns;
  for (const Measure& one : all_) {
    Eigen::VectorXd x = samples_of(record, one);
    if (!one.what.empty()) x.setConstant(value_of(one.what, x, record));
    columns.emplace_back(x.begin(), x.end());
  }
  return columns;
}

Recording Measures::recording(const Parameters& machine, double omega, int points) const
{
  if (empty()) return {points, open_periods};
  constexpr double each = 16;   // of a vibration
  constexpr double most = 3e7;  // numbers that are kept
  constexpr int least_periods = 16;
  const auto numbers =
      8 + static_cast<double>(machine.bodies->state_scales(machine).size());
  const double needed =
      each * std::max(motion::vibrations_of(machine, omega),
                      machine.bodies->quickest_contact(machine) / omega);
  while (points < needed && 2 * points * numbers * least_periods <= most) points *= 2;
  return {points, std::clamp(static_cast<int>(most / numbers / points), least_periods,
                             open_periods)};
}

motion::Answer whole_motion(const Measures& measures, motion::Answer answer,
                            motion::Request request, const OperationBudget& budget)
{
  const auto [points, periods] = measures.recording(answer.machine, answer.omega, 256);
  request.points = points;
  request.periods = periods;
  request.is_measured = false;
  complete(answer, request, budget);
  return answer;
}

Record record_of(const Parameters& machine, const motion::Motion& motion, bool is_closed)
{
  return {machine, motion, angular(1) / (motion.omega * motion.points_per_period),
          rotor_speed(machine, motion.omega) / angular(1), is_closed};
}

Record record_of(const motion::Answer& answer)
{
  return record_of(answer.machine, answer.motion,
                   answer.method == "shooting" || answer.kind() == Kind::rest);
}

}  // namespace rotor_stator::explore
