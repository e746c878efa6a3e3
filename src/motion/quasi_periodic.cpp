#include "motion/quasi_periodic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "integration/steady_state.hpp"
#include "motion/lines.hpp"
#include "stability/lyapunov.hpp"

namespace rotor_stator::motion {

namespace {

constexpr int window_turns = 160;

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

/** Those whose orders differ by more than a main lobe, the smallest |k_2| first; as places in the list. */
std::vector<int> distinct(const Harmonics& harmonics, const Bearing& bearing)
{
  std::vector<int> places;
  for (int h = 1; h <= harmonics.count(); ++h) places.push_back(h);
  const auto at = [&](int h) { return harmonics.list()[static_cast<std::size_t>(h)]; };
  std::ranges::stable_sort(places, {}, [&](int h) { return std::abs(at(h).k_2); });
  std::vector<double> orders{0};
  std::erase_if(places, [&](int h) {
    const double order = order_of(at(h), bearing);
    const bool is_near = std::ranges::any_of(orders, [&](double other) {
      return std::abs(order - other) < 4.0 / window_turns;
    });
    if (!is_near) orders.push_back(order);
    return is_near;
  });
  return places;
}

/** What Eq. 7 settles on from rest, by rk4. */
class SettledMotion {
public:
  SettledMotion(const Parameters& parameters, double omega, const OperationBudget& budget)
      : parameters_(parameters), omega_(omega), budget_(budget)
  {
  }

  /** Its lines, by integrals with a window of Blackman and Harris. Of lines that these cannot tell apart the one with the
      smallest |k_2| is taken. */
  Eigen::VectorXd lines(const Harmonics& harmonics)
  {
    integrate();
    Eigen::MatrixXd series =
        Eigen::MatrixXd::Zero(weighted_.cols(), harmonics.coefficients());
    series.col(0) = weighted_.colwise().sum().transpose();
    for (int h : distinct(harmonics, parameters_.bearing)) {
      const double order =
          order_of(harmonics.list()[static_cast<std::size_t>(h)], parameters_.bearing);
      put_amplitude(series, h, line(order));
    }
    return series.reshaped();
  }

  /** The distance of a solution from the next turns, integrated with small steps. */
  ErrorEstimate error(const PeriodicMotion& solution)
  {
    integrate();
    constexpr int points = 64, turns = 16;
    const TimeStepper stepper = make_stepper(
        parameters_, omega_, {.intervals_per_period = points, .budget = budget_});
    State state = state_;
    Motion exact = recorded(stepper, points, state, turn_, turns);
    Motion series = motion::motion_of(parameters_, solution, points, turns, turn_);
    exact.points_per_period = series.points_per_period = points * turns;
    return error_against(exact, series, points);
  }

private:
  void integrate()
  {
    if (turn_ > 0) return;
    first_ = settling_turns(parameters_, omega_);
    state_ = static_start(parameters_);
    const bool is_fast = contact_frequency(parameters_) < 8 * omega_;
    const int points_per_turn = is_fast ? 64 : 128;
    const TimeStepper stepper = make_stepper(
        parameters_, omega_,
        {.method = "rk4", .intervals_per_period = points_per_turn, .budget = budget_});
    for (long k = 0; k < first_ * points_per_turn; ++k) stepper.advance(k, state_);
    const Motion motion =
        recorded(stepper, points_per_turn, state_, first_, window_turns);
    turn_ = first_ + window_turns;
    const auto n = static_cast<Eigen::Index>(motion.size());
    weighted_ = relative_samples(parameters_, motion);
    double sum = 0;
    for (Eigen::Index k = 0; k < n; ++k) {
      const double weight =
          blackman_harris(static_cast<double>(k) / static_cast<double>(n));
      weighted_.row(k) *= weight;
      sum += weight;
    }
    weighted_ /= sum;
  }

  SmallVector line(double order) const
  {
    constexpr double turn = 2 * std::numbers::pi;
    const auto step = std::polar(
        1.0, -turn * order * window_turns / static_cast<double>(weighted_.rows()));
    std::complex<double> wave =
        std::polar(1.0, -turn * std::fmod(order * static_cast<double>(first_), 1.0));
    Eigen::VectorXcd amplitude = Eigen::VectorXcd::Zero(weighted_.cols());
    for (Eigen::Index k = 0; k < weighted_.rows(); ++k, wave *= step)
      amplitude += 2.0 * wave * weighted_.row(k).transpose();
    return amplitude;
  }

  const Parameters& parameters_;
  double omega_;
  OperationBudget budget_;
  long first_ = 0, turn_ = 0;  ///< the window, from t = 0 [turns]
  State state_ = {};           ///< at its end
  Eigen::MatrixXd weighted_;   ///< relative motions times the window [m]
};

}  // namespace

Motion motion_of(const Parameters& parameters, const PeriodicMotion& solution, int points,
                 int turns, long first)
{
  constexpr double turn = 2 * std::numbers::pi;
  const auto n = static_cast<Eigen::Index>(points) * turns;
  Eigen::MatrixXd samples = solution.bodies.col(0).transpose().replicate(n, 1);
  Eigen::MatrixX2d rates = Eigen::MatrixX2d::Zero(n, 2);  // of u
  const double passages = passages_per_turn(parameters.bearing);
  for (int h = 1; h <= solution.harmonics.count(); ++h) {
    const auto& [k_1, k_2] = solution.harmonics.list()[static_cast<std::size_t>(h)];
    const Eigen::RowVectorXd cosine = solution.bodies.col(2 * h - 1).transpose(),
                             sine = solution.bodies.col(2 * h).transpose();
    const double frequency = (k_1 + k_2 * passages) * solution.omega;
    for (Eigen::Index k = 0; k < n; ++k) {
      const double at = static_cast<double>(k % points) / points;
      const double since = static_cast<double>(first + k / points) + at;
      const double angle =
          turn * (k_1 * (at + static_cast<double>((first + k / points) % 2)) +
                  k_2 * std::fmod(passages * since, 2.0));
      samples.row(k) += std::cos(angle) * cosine + std::sin(angle) * sine;
      const Eigen::RowVector4d rate =
          frequency * (std::cos(angle) * sine - std::sin(angle) * cosine).head<4>();
      rates.row(k) += rate.tail<2>() - rate.head<2>();
    }
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
  constexpr int points = 8, fading = 56;
  constexpr double standard_errors = 3;
  const auto turns = std::clamp(settling_turns(parameters, solution.omega), 256L, 2048L);
  TorusVerdict verdict{.turns = static_cast<int>(turns)};
  const TimeStepper stepper =
      make_stepper(parameters, solution.omega,
                   {.method = "rk4", .intervals_per_period = points, .budget = budget});
  TrajectoryPair pair(stepper, points, state_scales(parameters),
                      state_of(parameters, solution));
  const Motion exact = motion_of(parameters, solution, points, verdict.turns);
  const double size = largest_displacement(exact);
  std::vector<double> growth;
  auto at = exact.positions.begin();
  const auto compare = [&](const State& state) {
    const auto a = displacements(state.position), b = displacements(*at++);
    for (std::size_t i = 0; i < 4; ++i)
      verdict.away = std::max(verdict.away, std::abs(a[i] - b[i]) / size);
  };
  for (int turn = 0; turn < verdict.turns; ++turn) {
    const double rate = pair.advance_one_period(compare);
    if (turn >= fading) growth.push_back(rate);
  }
  const BatchMean rate = batch_mean(growth);
  verdict.rate = rate.value;
  verdict.uncertainty = standard_errors * rate.error;
  verdict.stays = verdict.away <= tolerance;
  verdict.evaluations = static_cast<double>(stepper.evaluations());
  return verdict;
}

SettledOn settled_torus(const Parameters& parameters, double omega,
                        const OperationBudget& budget)
{
  const auto settled = std::make_shared<SettledMotion>(parameters, omega, budget);
  return {[=](const Harmonics& harmonics) { return settled->lines(harmonics); },
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
