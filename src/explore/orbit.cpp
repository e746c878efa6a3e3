#include "explore/orbit.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "balance/fourier_transform.hpp"
#include "explore/balance_motion.hpp"
#include "explore/measures.hpp"
#include "explore/plausible.hpp"
#include "io/errors.hpp"
#include "io/parallel.hpp"
#include "motion/contact.hpp"
#include "motion/find_periodic.hpp"
#include "motion/judge.hpp"
#include "time/flow.hpp"

namespace rotor_stator::explore {

void require_range(double from, double to, std::optional<int> count)
{
  if (from > to || (from == to && count.value_or(1) > 1))
    throw BadInput(format("--from %g Hz: must be below --to %g Hz", from, to));
  if (from < to && count == 1) throw BadInput("--count 1: is for --from equal to --to");
}

void require_method_of(const Parameters& parameters, const std::string& method)
{
  const bool is_of_masses =
      std::ranges::find(time_methods(), method) != time_methods().end();
  const bool is_large = !parameters.bodies->takes_explicit_steps();
  if (is_large && is_of_masses)
    throw BadInput("--method " + method +
                   ": bodies given by matrices take aft, shooting, auto or gauss");
  require_bearing_of(method, parameters);
  if (!is_large && method == "gauss")
    throw BadInput("--method gauss: is for bodies given by matrices");
}

Parameters machine_of(const Request& request, double from, double to, ModelRange range)
{
  range.from = from;
  range.to = to;
  range.harmonics = std::max(range.harmonics, request.harmonics.value_or(0));
  return doubted(read_machine(StrictToml(request.parameter_file), range), to);
}

int checked_samples(int harmonics, const std::optional<int>& samples)
{
  if (samples && *samples <= 2 * harmonics)
    throw BadInput(
        format("--samples %d: must be in %d...%d", *samples, 2 * harmonics + 1, 1 << 20));
  return samples.value_or(default_samples(harmonics));
}

std::vector<double> evenly_spaced(double from, double to, int count)
{
  std::vector<double> all;
  for (int k = 0; k + 1 < count; ++k) all.push_back(from + (to - from) * k / (count - 1));
  all.push_back(count > 1 ? to : from);
  return all;
}

std::string Allowance::words() const
{
  return seconds > 0 ? format("the budget of %g s", seconds)
                     : format("the budget of %.3g evaluations of the force", evaluations);
}

OperationBudget budget_until(const Allowance& allowed, double evaluations,
                             const std::string& option)
{
  OperationBudget budget(evaluations, option);
  if (allowed.seconds > 0) budget.end_at(allowed.end, allowed.seconds);
  return budget;
}

OperationBudget budget_of_each(const Allowance& allowed, double seconds,
                               const Parameters& parameters)
{
  const double each = operations_per_evaluation(parameters.bearing.balls);
  seconds *= parameters.bodies->patience().longer;
  return budget_until(
      allowed, allowed.evaluations > 0 ? allowed.evaluations : 1e9 * seconds / each,
      "--budget");
}

OperationBudget budget_of(const Request& request, double seconds,
                          const Parameters& parameters)
{
  if (request.budget.seconds > 0) seconds = 4 * request.budget.seconds;
  OperationBudget budget = budget_of_each(request.budget, seconds, parameters);
  const auto progress =
      std::make_shared<Progress>(request.quiet ? "" : "share of --budget", 1);
  if (progress->is_watched())
    budget.watch(
        [progress](double share) { progress->show(format("%.1f %%", 100 * share)); });
  return budget;
}

void put_contact(Table& table, const Parameters& parameters, bool touches)
{
  table.value("contact", touches ? "yes" : "no");
  if (!touches)
    table.note(
        format("warning: no ball touches its race in what is printed: the clearance of "
               "%g m is not closed there",
               parameters.bearing.clearance));
}

void conclude(Table& table, const Parameters& parameters, bool touches,
              const OperationBudget& budget)
{
  put_contact(table, parameters, touches);
  put_cost(table, budget);
}

void put_cost(Table& table, const OperationBudget& budget)
{
  /** Three digits do not depend on the order in which threads have spent. */
  table.value("evaluations", budget.spent(), 3);
  if (budget.seconds() > 0)
    table.value("budget", format("%gs", budget.seconds()));
  else
    table.value("budget", budget.most(), 3);
}

void put_regime(Table& table, int period, const std::string& otherwise,
                const std::string& why)
{
  table.value("regime", period > 0 ? "periodic" : otherwise);
  if (period > 0) table.value("period", period);
  if (!why.empty()) table.note("regime: " + why);
}

void put_complete(Table& table, const std::string& missing)
{
  table.value("complete", missing.empty() ? "yes" : "no");
  if (!missing.empty()) table.note("incomplete: " + missing);
}

void put_base(Table& table, const std::string& base, double frequency)
{
  table.value("base", base);
  if (std::isfinite(1 / frequency)) table.value("base_period", 1 / frequency);
}

void put_difference(Table& table, const std::string& name, const motion::Error& error,
                    const std::string& meaning)
{
  if (std::isfinite(error.largest)) table.value(name + "_largest", error.largest, 3);
  if (std::isfinite(error.rms)) table.value(name + "_rms", error.rms, 3);
  table.note(name + ": " + meaning);
}

namespace {

/** By shooting. */
FoundMotion closed_motion(const Parameters& parameters, const MotionRequest& request,
                          const OperationBudget& budget, Table& table)
{
  const double omega = angular(request.frequency);
  const int turns = request.subharmonic;
  const BalanceSearch search{.parameters = parameters,
                             .omega = omega,
                             .harmonics = usual_harmonics,
                             .budget = budget,
                             .turns = turns};
  motion::ClosedMotion closed =
      motion::closed_motion(search, request.points, request.local_error);
  const double error = closed.error.larger();
  table.value("method", "shooting");
  table.value("start", one_word(closed.start));
  table.note(
      format("shooting by rk8, local error %g: closed to %.2g of the sizes of the "
             "state after %d periods",
             request.local_error, closed.correction, closed.maps));
  put_difference(table, "error", closed.error, "against a hundredth of the local error");
  if (request.tolerance && !(error <= *request.tolerance))
    throw NoSolution(
        format("%s: tolerance %g not reached at %g Hz, error %.2g: "
               "--local-error is too large",
               parameters.file.c_str(), *request.tolerance, request.frequency, error));
  put_base(table, "turn", request.frequency);
  std::optional<motion::Verdict> verdict;
  if (request.is_measured)
    verdict = motion::judge_through(parameters, omega, closed.state, budget, turns);
  put_verdict(table, parameters, verdict ? &*verdict : nullptr, turns);
  motion::Lines lines = motion::lines_of_closed(closed.motion, turns);
  return {.motion = std::move(closed.motion),
          .lines = std::move(lines),
          .machine = over_turns(parameters, turns),
          .base_frequency = request.frequency,
          .base_periods = turns,
          .closes_after = turns};
}

/** Mean, rms and amplitude of a motion that never repeats itself, with their standard
    errors. */
void put_statistics(Table& table, const motion::Observation& seen)
{
  const std::tuple<std::string, Displacements, Displacements> all[] = {
      {"mean_", seen.mean, seen.mean_error},
      {"rms_", seen.rms, seen.rms_error},
      {"amp_", seen.amplitude, seen.amplitude_error}};
  for (const auto& [what, values, errors] : all)
    for (std::size_t i = 0; const char* name : {"x_s", "y_s", "x_r", "y_r"}) {
      table.value(what + name, values[i], 6);
      table.value(what + name + "_error", errors[i++], 2);
    }
  table.note(
      "mean, rms about the mean and amplitude over 256 base periods, with standard "
      "errors; an amplitude grows with the window");
}

/** What the machine does from rest. */
FoundMotion settled_motion(const Parameters& parameters, const MotionRequest& request,
                           const OperationBudget& budget, Table& table)
try {
  motion::Request asked = request;
  asked.omega = angular(request.frequency);
  asked.is_measured = request.is_measured || request.tolerance;
  const motion::Answer answer = motion::answer(parameters, asked, budget);
  const Settled& settled = answer.settled;
  table.value("method", answer.method);
  put_base(table, answer.base.words(), answer.omega / angular(1));
  table.value("regime", word(answer.kind()));
  if (answer.period() > 0) table.value("period", answer.period());
  table.value("stability", answer.stability);
  if (answer.multiplier > 0) {
    table.value("multiplier", answer.multiplier, 9);
    table.value("multiplier_uncertainty", answer.uncertainty, 2);
  }
  table.value("lyapunov", settled.lyapunov.value, 6);
  table.value("lyapunov_uncertainty", settled.lyapunov.error, 2);
  if (answer.error) put_difference(table, "error", *answer.error, answer.error_note);
  if (!settled.reason.empty()) table.note("regime: " + settled.reason);
  table.value("transient", settled.seconds, 6);
  if (answer.base.is_driven_twice()) {
    const double turns =
        answer.machine.bearing.cage_speed_ratio * static_cast<double>(settled.at.period) +
        answer.machine.bearing.cage_phase / angular(1);
    table.value("cage_angle", angular(turns - std::floor(turns)));
  }
  FoundMotion found{.motion = answer.motion, .machine = answer.machine};
  if (answer.kind() == Kind::chaotic) {
    table.note(
        format("chaotic over the %.3g s of the transient and 256 base periods: chaos "
               "that ends later looks the same",
               settled.seconds));
    found.has_statistics = answer.seen.has_value();
    if (answer.seen)
      put_statistics(table, *answer.seen);
    else
      table.note("mean, rms and amplitude need more than the budget");
  }
  found.base_frequency = answer.omega / angular(1);
  found.turns_of_period = 1 / answer.base.per_turn;
  if (answer.method == "shooting") {
    found.closes_after = answer.period();
    found.lines = motion::lines_of_closed(as_one_period(answer.motion),
                                          answer.period() * found.turns_of_period);
  }
  return found;
} catch (const Diverged& error) {
  if (request.step == 0) throw;
  throw NoSolution(error.what() + format("; is --step %g too long?", request.step));
}

}  // namespace

bool FoundMotion::touches() const
{
  return motion::contact_share(machine, motion) > 0;
}

FoundMotion computed(const Parameters& parameters, const MotionRequest& request,
                     Table& table)
{
  checked_samples(request.harmonics.value_or(usual_harmonics), request.samples);
  if (request.tolerance && request.samples && !request.harmonics)
    throw BadInput("--samples: chosen with m for --tolerance; give --harmonics too");
  require_method_of(parameters, request.method);
  describe(table, parameters);
  table.value("frequency", request.frequency);
  /** Who names a method is willing to wait. */
  double seconds = request.method == "auto" ? 0 : 3;
  if (!is_periodic(request.method))
    seconds = std::max(seconds, parameters.bodies->patience().settling);
  const OperationBudget budget = budget_of(request, seconds, parameters);
  FoundMotion found =
      request.method == "aft"        ? balance_motion(parameters, request, budget, table)
      : request.method == "shooting" ? closed_motion(parameters, request, budget, table)
                                     : settled_motion(parameters, request, budget, table);
  found.budget = budget;
  return found;
}

Exploration explore_orbit(const MotionRequest& request)
{
  const Parameters parameters = machine_of(request, request.frequency, request.frequency);
  std::vector<Column> columns{phase_column,
                              {"x_s", "m", "stator"},
                              {"y_s", "m", "stator"},
                              {"x_r", "m", "rotor"},
                              {"y_r", "m", "rotor"},
                              {"F_x", "N", "Eq. 6, on the stator"},
                              {"F_y", "N", "Eq. 6, on the stator"}};
  if (request.periods > most_rows / request.points)
    throw BadInput(format("--periods %d: %d points are at most %d rows", request.periods,
                          request.points, most_rows));
  const std::size_t bearings = 1 + parameters.further.size();
  for (std::size_t b = 1; b < bearings; ++b)
    for (const char* name : {"F_x", "F_y"})
      columns.push_back(
          {numbered(name, b), "N", "Eq. 6, of that bearing, on the stator"});
  const auto outputs = parameters.bodies->outputs();
  for (const auto& [name, place] : outputs)
    columns.push_back({name, "m", "of a body given by matrices"});
  const std::size_t usual = columns.size();
  columns.push_back(time_column);
  const Measures measures(request.columns, parameters, {}, true);
  for (const Column& one : measures.columns()) columns.push_back(one);
  Table table(request.periods == 1
                  ? "Orbit of rotor and stator over one period"
                  : format("Orbit of rotor and stator over %d periods", request.periods),
              columns);
  table.choose(request.columns, usual, request.plot.has_value());
  const BasePeriod base = base_period(parameters);
  MotionRequest finer = request;
  if (!measures.empty()) {
    const auto [machine, omega] = over(base, parameters, angular(request.frequency));
    const auto [points, periods] = measures.recording(machine, omega, request.points);
    finer.points = points;
    if (measures.needs_whole()) finer.periods = std::max(request.periods, periods);
  }
  const FoundMotion at = computed(parameters, finer, table);
  const motion::Motion& motion = at.motion;
  /** Of two frequencies harmonic balance prints a record. */
  const bool closes =
      at.closes_after > 0 && (!is_periodic(request.method) || !base.is_driven_twice());
  const auto measured = measures.at_instants(
      {at.machine, motion,
       at.base_periods / (at.base_frequency * motion.points_per_period),
       request.frequency, closes});
  std::vector<std::vector<Vec2>> forces;
  for (std::size_t b = 0; b < bearings; ++b)
    forces.push_back(motion::bearing_forces(at.machine, motion, b));
  const auto rows = static_cast<std::size_t>(std::max(request.periods, at.closes_after)) *
                    request.points;
  const auto each = static_cast<std::size_t>(finer.points / request.points);
  for (std::size_t row_at = 0; row_at < rows; ++row_at) {
    const std::size_t k = each * row_at, same = k % motion.size();
    const auto& [stator, rotor] = motion.positions[same];
    const double periods = at.base_periods * motion.t_over_period(k);
    std::vector<Cell> row{angular(periods), stator.x, stator.y, rotor.x, rotor.y};
    for (const auto& own : forces) {
      row.emplace_back(own[same].x);
      row.emplace_back(own[same].y);
    }
    for (const auto& [name, place] : outputs)
      row.emplace_back(motion::shown_at(motion, same, place));
    row.emplace_back(periods / at.base_frequency);
    for (const auto& column : measured) row.emplace_back(column[same]);
    table.row(std::move(row));
  }
  conclude(table, parameters, at.touches(), at.budget);
  return {std::move(table)};
}

Exploration explore_contact(const MotionRequest& request)
{
  const Parameters parameters = machine_of(request, request.frequency, request.frequency);
  std::vector<Column> columns{
      {"t_over_T", "-", "time over the period, 0 to 2"},
      {"ball", "-", "j of Eq. 3"},
      {"Q", "N", "Eq. 5, force of the ball"},
      time_column,
      {"angle", "rad", "theta_j of Eq. 3, modulo 2 pi"},
      {"stress", "N/mm^2", "largest pressure of Hertz on the races"}};
  const auto is_unknown = [](const Bearing& one) { return one.pressure == 0; };
  if (std::ranges::any_of(bearings_of(parameters), is_unknown)) columns.pop_back();
  const std::size_t bearings = 1 + parameters.further.size();
  if (bearings > 1)
    columns.insert(columns.begin() + 1, {"bearing", "-", "in the order of the file"});
  Table table("Contact of every ball over two periods", std::move(columns));
  table.choose(request.columns, bearings > 1 ? 4 : 3, request.plot.has_value());
  int balls = 0;
  for (const Bearing& one : bearings_of(parameters)) balls += one.balls;
  const int most_points = most_rows / (2 * balls);
  if (request.points > most_points)
    throw BadInput(format("--points %d: must be at most %d with %d balls", request.points,
                          most_points, balls));
  MotionRequest two = request;
  two.periods = 2;
  const FoundMotion at = computed(parameters, two, table);
  for (std::size_t b = 0; b < bearings; ++b) {
    const motion::Motion& motion = at.motion;
    const Bearing one = bearings_of(at.machine)[b];
    const auto forces = motion::ball_forces(at.machine, motion, 2, b);
    for (Eigen::Index k = 0; k < forces.rows(); ++k)
      for (Eigen::Index j = 0; j < forces.cols(); ++j) {
        const double q = forces(k, j), time = motion.t_over_period(k);
        const double angle = one.cage_angle(motion.phase(k)) / angular(1) +
                             static_cast<double>(j) / one.balls;
        std::vector<Cell> row{time,
                              j + 1,
                              q,
                              time / at.base_frequency,
                              angular(angle - std::floor(angle)),
                              1e-6 * one.pressure * std::cbrt(q)};
        if (bearings > 1) row.insert(row.begin() + 1, b + 1);
        table.row(std::move(row));
      }
  }
  conclude(table, parameters, at.touches(), at.budget);
  return {std::move(table)};
}

}  // namespace rotor_stator::explore
