#include "motion/quasi_periodic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>

#include "motion/lines.hpp"
#include "time/settle.hpp"
#include "time/steady_state.hpp"

namespace rotor_stator::motion {

namespace {

/** Turns until the slower of both suspensions has damped a disturbance to 1e-5. Throws NoSolution when they are too
    many. */
long settling_turns(const Parameters& parameters, double omega)
{
  const auto rate = [](const Body& body) {
    return body.rigid ? std::numeric_limits<double>::infinity()
                      : body.damping() / (2 * body.mass);
  };
  const double slower = std::min(rate(parameters.stator), rate(parameters.rotor));
  constexpr double longest = 10, most = 20000;  // [s], turns
  const double seconds = std::min(longest, std::log(1e5) / slower);
  return std::lround(std::ceil(std::min(most, seconds / checked_period(omega, seconds))));
}

/** Those whose orders differ by more than half a main lobe, the smallest |k_2| first; as places in the list. */
std::vector<int> distinct(const Harmonics& harmonics, const Bearing& bearing,
                          double main_lobe)
{
  std::vector<int> places;
  for (int h = 1; h <= harmonics.count(); ++h) places.push_back(h);
  const auto at = [&](int h) { return harmonics.list()[static_cast<std::size_t>(h)]; };
  std::ranges::stable_sort(places, {}, [&](int h) { return std::abs(at(h).k_2); });
  std::vector<double> orders{0};
  std::erase_if(places, [&](int h) {
    const double order = order_of(at(h), bearing);
    const bool is_near = std::ranges::any_of(
        orders, [&](double other) { return std::abs(order - other) < main_lobe / 2; });
    if (!is_near) orders.push_back(order);
    return is_near;
  });
  return places;
}

/** The integral over a record with a window of Blackman and Harris, at any frequency: from a transform so fine that a
    polynomial of degree 7 through its nearest values has it to 1e-8. */
class FineTransform {
public:
  /** Of samples times the window. */
  explicit FineTransform(const Eigen::VectorXd& weighted)
  {
    Eigen::VectorXd padded = Eigen::VectorXd::Zero(finer * weighted.size());
    padded.head(weighted.size()) = weighted;
    FourierTransform transform(static_cast<int>(padded.size()));
    values_ = transform.spectrum(padded) * static_cast<double>(padded.size());
    for (Eigen::Index p = 0; p < values_.size(); ++p)
      values_[p] *= std::polar(1.0, half_record(static_cast<double>(p)));
  }

  /** Of e^{-iφ}, φ going round `turns` times in the record; 0 where the samples do not resolve it. */
  std::complex<double> operator()(double turns) const
  {
    constexpr double weights[] = {1, -7, 21, -35, 35, -21, 7, -1};
    const double at = turns * finer;
    const auto first = static_cast<Eigen::Index>(std::floor(at)) - 3;
    if (first + 8 > values_.size()) return 0;
    std::complex<double> above = 0;
    double below = 0;
    for (int k = 0; k < 8; ++k) {
      const Eigen::Index p = first + k;
      const auto value = p < 0 ? std::conj(values_[-p]) : values_[p];
      const double distance = at - static_cast<double>(p);
      if (std::abs(distance) < 1e-9) return value * std::polar(1.0, -half_record(at));
      above += weights[k] / distance * value;
      below += weights[k] / distance;
    }
    return above / below * std::polar(1.0, -half_record(at));
  }

private:
  static constexpr int finer = 8;

  /** Counted from the middle of the record the values are smooth. */
  static double half_record(double at) { return std::numbers::pi * at / finer; }

  Eigen::VectorXcd values_;
};

/** What Eq. 7 settles on from rest, by rk4. */
class SettledMotion {
public:
  SettledMotion(const Parameters& parameters, double omega, const OperationBudget& budget)
      : parameters_(parameters), omega_(omega), budget_(budget)
  {
  }

  /** Of lines that the window cannot tell apart the one with the smallest |k_2| is taken. */
  Eigen::VectorXd lines(const Harmonics& harmonics)
  {
    integrate();
    const auto dofs = static_cast<Eigen::Index>(transforms_.size());
    Eigen::MatrixXd series = Eigen::MatrixXd::Zero(dofs, harmonics.coefficients());
    for (Eigen::Index i = 0; i < dofs; ++i)
      series(i, 0) = transforms_[static_cast<std::size_t>(i)](0).real();
    for (int h : distinct(harmonics, parameters_.bearing, 8.0 / turns_)) {
      const double order =
          order_of(harmonics.list()[static_cast<std::size_t>(h)], parameters_.bearing);
      const double since = std::fmod(order * static_cast<double>(first_), 1.0);
      const auto wave = std::polar(2.0, -2 * std::numbers::pi * since);
      SmallVector line(dofs);
      for (Eigen::Index i = 0; i < dofs; ++i)
        line[i] = wave * transforms_[static_cast<std::size_t>(i)](order * turns_);
      put_amplitude(series, h, line);
    }
    return series.reshaped();
  }

  void go_on()
  {
    constexpr int longer = 1280;
    integrate();
    advance(0, longer);
  }

  /** The distance of a solution from the next turns, integrated with small steps. */
  ErrorEstimate error(const PeriodicMotion& solution)
  {
    integrate();
    constexpr int points = 64, turns = 16;
    if (!next_) {
      const auto stepper =
          flow(parameters_, omega_, {.intervals_per_period = points, .budget = budget_});
      State state = state_;
      next_ = recorded(*stepper, points, state, turn_, turns);
      next_->points_per_period = points * turns;
    }
    Motion series = motion::motion_of(parameters_, solution, points, turns, turn_);
    series.points_per_period = points * turns;
    return error_against(*next_, series, points);
  }

private:
  void integrate()
  {
    if (turn_ > 0) return;
    constexpr int turns = 160;
    state_ = static_start(parameters_);
    advance(settling_turns(parameters_, omega_), turns);
  }

  /** Over so many turns, and then the record. */
  void advance(long before, int turns)
  {
    /** Twice as many as the highest order that is looked for. */
    const double contact = contact_frequency(parameters_) / omega_;
    const int points = contact < 8 ? 64 : contact < 40 ? 128 : 256;
    const auto stepper =
        flow(parameters_, omega_,
             {.method = "rk4", .intervals_per_period = points, .budget = budget_});
    first_ = turn_ + before;
    for (long k = turn_ * points; k < first_ * points; ++k) stepper->advance(k, state_);
    const Motion motion = recorded(*stepper, points, state_, first_, turns);
    turns_ = turns;
    turn_ = first_ + turns;
    next_.reset();
    const Eigen::MatrixXd samples = relative_samples(parameters_, motion);
    const Eigen::VectorXd window = blackman_harris(samples.rows());
    transforms_.clear();
    for (const auto& column : samples.colwise())
      transforms_.emplace_back(column.cwiseProduct(window));
  }

  const Parameters& parameters_;
  double omega_;
  OperationBudget budget_;
  long first_ = 0, turn_ = 0;   ///< of the record, from t = 0 [turns]
  int turns_ = 0;               ///< that it holds
  State state_ = {};            ///< at its end
  std::optional<Motion> next_;  ///< the turns after it, once they are asked for
  std::vector<FineTransform> transforms_;  ///< of the relative motions [m]
};

}  // namespace

Motion motion_of(const Parameters& parameters, const PeriodicMotion& solution, int points,
                 int turns, long first)
{
  constexpr double turn = 2 * std::numbers::pi;
  const auto n = static_cast<Eigen::Index>(points) * turns;
  Eigen::MatrixXd samples = solution.bodies.col(0).transpose().replicate(n, 1);
  Eigen::MatrixX2d rates = Eigen::MatrixX2d::Zero(n, 2), wave(n, 2);  // of u; cos, sin
  const double passages = passages_per_turn(parameters.bearing);
  for (int h = 1; h <= solution.harmonics.count(); ++h) {
    const auto& [k_1, k_2] = solution.harmonics.list()[static_cast<std::size_t>(h)];
    const double order = k_1 + k_2 * passages;
    const auto step = std::polar(1.0, turn * order / points);
    for (long since = first; since < first + turns; ++since) {
      auto now = std::polar(
          1.0, turn * (k_1 * static_cast<double>(since % 2) +
                       k_2 * std::fmod(passages * static_cast<double>(since), 2.0)));
      for (int k = 0; k < points; ++k, now *= step)
        wave.row((since - first) * points + k) << now.real(), now.imag();
    }
    const Eigen::MatrixX2d pair = solution.bodies.middleCols(2 * h - 1, 2);
    samples += wave.lazyProduct(pair.transpose());
    const Eigen::Matrix2d u = pair.middleRows<2>(2) - pair.topRows<2>();
    Eigen::Matrix2d slopes;  // of cos and sin
    slopes << u.col(1).transpose(), -u.col(0).transpose();
    rates += wave.lazyProduct(order * solution.omega * slopes);
  }
  Motion motion = motion_of_samples(samples, points, first);
  motion.omega = solution.omega;
  for (Eigen::Index k = 0; k < n; ++k) motion.rates.push_back({rates(k, 0), rates(k, 1)});
  return motion;
}

Eigen::VectorXd half_peak_to_peak_of_torus(const Parameters& parameters,
                                           const PeriodicMotion& solution)
{
  FourierTransform transform(solution.samples);
  Eigen::MatrixXd samples;
  transform.to_samples(body_series(parameters, solution), samples,
                       solution.harmonics.images(solution.line, solution.samples));
  return 0.5 * (samples.colwise().maxCoeff() - samples.colwise().minCoeff());
}

TorusVerdict verdict_on_torus(const Parameters& parameters,
                              const PeriodicMotion& solution, double tolerance,
                              const OperationBudget& budget)
{
  constexpr int points = 64, turns = 100;
  const double omega = solution.omega, step = step_at(parameters, omega);
  const Instant start{state_of(parameters, solution), 0};
  const auto from_there = [&](double longest_step) {
    return settle(parameters, omega, base_period(parameters), start,
                  {.step = longest_step}, budget.part(0.4));
  };
  const Settled coarse = from_there(step);
  TorusVerdict verdict{.settled = from_there(step / 2)};
  const Exponent& rate = verdict.settled.lyapunov;
  verdict.uncertainty =
      std::max(3 * rate.error, std::abs(rate.value - coarse.lyapunov.value));
  /** With error control, from so much earlier that the errors of rk4 are forgotten. */
  const auto stepper =
      flow(parameters, omega,
           {.intervals_per_period = points, .tolerance = 1e-9, .budget = budget});
  const Instant& from =
      verdict.settled.contracts ? verdict.settled.before : verdict.settled.at;
  State state = from.state;
  const long first = verdict.settled.at.period;
  for (long k = from.period * points; k < first * points; ++k) stepper->advance(k, state);
  Motion exact = recorded(*stepper, points, state, first, turns);
  Motion judged = motion_of(parameters, solution, points, turns, first);
  exact.points_per_period = judged.points_per_period = points * turns;
  verdict.away = relative_difference(judged, exact);
  verdict.away_rms = rms_difference(judged, exact);
  verdict.stays = verdict.larger() <= tolerance;
  verdict.evaluations = coarse.evaluations + verdict.settled.evaluations +
                        static_cast<double>(stepper->evaluations());
  return verdict;
}

SettledOn settled_torus(const Parameters& parameters, double omega,
                        const OperationBudget& budget)
{
  const auto settled = std::make_shared<SettledMotion>(parameters, omega, budget);
  return {[=](const Harmonics& harmonics) { return settled->lines(harmonics); },
          [=] { settled->go_on(); },
          [=](const PeriodicMotion& solution) { return settled->error(solution); }};
}

AdaptiveMotion find_quasi_periodic(const Parameters& parameters, double omega,
                                   const AdaptiveSettings& settings,
                                   const OperationBudget& budget)
{
  return solve_on_chosen(parameters, omega, settings,
                         settled_torus(parameters, omega, budget), budget);
}

}  // namespace rotor_stator::motion
