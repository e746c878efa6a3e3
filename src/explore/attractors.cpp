#include "explore/attractors.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <random>

#include "explore/measures.hpp"
#include "io/errors.hpp"
#include "io/output_file.hpp"
#include "io/parallel.hpp"
#include "motion/answer.hpp"
#include "motion/contact.hpp"
#include "motion/find_periodic.hpp"
#include "time/flow.hpp"

namespace rotor_stator::explore {

namespace {

constexpr int section_points = 200;  // of a motion that does not close
constexpr int most_runs = 200000;    // each keeps its state and statistics
constexpr int motion_points = 256, motion_periods = 16;                 // of --motions
constexpr double same_closed = 1e-5, same_open = 0.1, same_errors = 4;  // `is_same`

/** The request, checked, with the machine that belongs to it. */
struct Task {
  const AttractorsRequest& request;
  Parameters machine;
  BasePeriod base;
  std::vector<double> speeds;  ///< [Hz]
  OperationBudget budget;

  motion::Request asked_at(std::size_t speed) const
  {
    return {.omega = angular(speeds[speed]),
            .points = motion_points,
            .periods = section_points,
            .step_ratio = step_ratio(request.tolerance)};
  }
};

Task task_of(const AttractorsRequest& request)
{
  require_range(request.from, request.to, request.count);
  const Parameters machine = machine_of(request, request.from, request.to);
  const int most_starts = most_runs / request.count - 3;
  if (request.starts > most_starts)
    throw BadInput(format("--starts %d: must be in 0...%d with --count %d",
                          request.starts, most_starts, request.count));
  return {request, machine, base_period(machine),
          evenly_spaced(request.from, request.to, request.count),
          budget_of(request, request.count * (3.0 + request.starts), machine)};
}

/** A random state of the size of the motion: both bodies together within twice the
    unbalance response of the joined bodies, the relative motion within twice the
    bearing's size. */
State random_state(const Based& at, std::uint64_t seed)
{
  const auto& [machine, base] = at;
  const double omega = rotor_speed(machine, base);
  std::mt19937_64 generator(seed);
  const auto random = [&] { return 2 * motion::uniform(generator); };
  const double joined = std::abs(dynamic_stiffness(machine.stator, omega).value +
                                 dynamic_stiffness(machine.rotor, omega).value);
  const double amplitude = machine.unbalance * omega * omega / joined;
  const Eigen::VectorXd scales = state_scales(machine);
  Eigen::VectorXd y = vector_of(static_start(machine));
  const Eigen::Index speeds = y.size() / 2;
  for (int i = 0; i < 2; ++i) {
    const double position = random() * amplitude, speed = random() * amplitude * omega;
    for (int body : {0, 2}) {
      y[body + i] += position;
      y[speeds + body + i] += speed;
    }
    y[2 + i] += random() * scales[2 + i];
    y[speeds + 2 + i] += random() * scales[speeds + 2 + i];
  }
  return state_of(y);
}

/**
## The starts

Two chains carry the state on from speed to speed; each speed has its own starts beside
them. They are integrated side by side, each as far as the whole budget would pay for it
alone; what they cost is added up in their order, so that the table does not depend on the
number of threads. */

const char* const out_of_budget = "the budget is used up, more with --budget";

enum class Origin { rest, below, above, random };

/** Where one start ended. */
struct Run {
  std::size_t speed;
  Origin origin;
  std::optional<State> start = {};  ///< else at rest
  motion::Answer answer = {.base = {}, .settled = {}};
  motion::Observation seen = {};
  double spent = 0;       ///< evaluations of the force
  std::string lost = {};  ///< why it has no result
};

/** Each at most `most` evaluations. */
void integrate(const Task& task, std::span<Run> runs, double most)
{
  std::vector<motion::Question> questions;
  for (const Run& run : runs)
    questions.push_back({task.machine, task.asked_at(run.speed),
                         budget_until(task.request.budget, most), run.start});
  auto all = motion::observed_answers(questions);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const OperationBudget& budget = questions[k].budget;
    Run& run = runs[k];
    try {
      run.answer = std::move(all[k].answer.get());
      run.seen = all[k].seen.get();
      if (budget.used_up()) throw NoSolution(out_of_budget);
    } catch (const NoSolution& error) {
      run.lost = budget.used_up() ? out_of_budget : error.what();
    }
    run.spent = budget.spent();
  }
}

/** Both chains. They begin at rest, which at the edges is the start from rest, and again
    after a start that was lost. */
std::vector<Run> runs_of_chains(const Task& task, double most)
{
  const std::size_t count = task.speeds.size();
  std::vector<Run> all;
  std::array<std::optional<State>, 2> states;
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<Run> both{{k, k == 0 ? Origin::rest : Origin::below, states[0]}};
    if (count > 1)
      both.push_back({count - 1 - k, k == 0 ? Origin::rest : Origin::above, states[1]});
    integrate(task, both, most);
    for (std::size_t chain = 0; chain < both.size(); ++chain) {
      states[chain].reset();
      if (both[chain].lost.empty()) states[chain] = both[chain].answer.settled.at.state;
      most = std::max(0.0, most - both[chain].spent);
    }
    std::ranges::move(both, std::back_inserter(all));
  }
  return all;
}

/** The starts of one speed alone. */
std::vector<Run> runs_of_speed(const Task& task, std::size_t speed, double most)
{
  std::vector<Run> runs;
  if (speed > 0 && speed + 1 < task.speeds.size()) runs.push_back({speed, Origin::rest});
  const Based at = over(task.base, task.machine, angular(task.speeds[speed]));
  const std::uint64_t seed =
      (static_cast<std::uint64_t>(task.request.seed) << 32) + (speed << 16);
  for (int k = 0; k < task.request.starts; ++k)
    runs.push_back({speed, Origin::random, random_state(at, seed + k)});
  integrate(task, runs, most);
  return runs;
}

/** All starts in order, and whether the budget paid for them. */
std::vector<Run> all_runs(const Task& task)
{
  /** The rest is for the exponents of closed motions. */
  const double most = 0.9 * task.budget.left();
  std::atomic<double> spent = 0;
  const auto of_pieces = computed_in_parallel(
      task.request.quiet ? "" : "attractors", task.speeds.size() + 1, [&](std::size_t k) {
        /** Of earlier pieces only: these begin in order. */
        const double left = std::max(0.0, most - spent);
        auto runs =
            k == 0 ? runs_of_chains(task, left) : runs_of_speed(task, k - 1, left);
        for (const Run& run : runs) spent += run.spent;
        return runs;
      });
  std::vector<Run> all;
  double used = 0;
  for (const auto& runs : of_pieces)
    for (const Run& run : runs) {
      used += run.spent;
      all.push_back(run);
      if (used > most) all.back().lost = out_of_budget;
    }
  task.budget.pay(std::min(used, most));
  return all;
}

/**
## The motions of one speed */

/** An attractor with the starts that ended on it. */
struct Found {
  double speed;  ///< [Hz]
  motion::Answer answer;
  motion::Observation seen;
  int number = 0;                      ///< at this speed, from 1
  std::array<int, 4> from = {};        ///< starts by `Origin`
  int undecided = 0;                   ///< of them
  std::vector<double> exponents = {};  ///< of the motions of these starts [1/s]
  bool touches = false;
  std::vector<double> measured = {};
  std::string lost = {};  ///< why it has no section

  bool is_closed() const { return answer.period() > 0 || answer.kind() == Kind::rest; }
  int starts() const { return from[0] + from[1] + from[2] + from[3]; }
  Exponent exponent() const  ///< over a base period
  {
    const auto [rate, error] = answer.settled.lyapunov;
    const double period = angular(1) / answer.omega;
    return {rate * period, error * period};
  }
};

/** Whether two motions of one speed are on one attractor: both close after as many
    periods or neither does, two kinds do not contradict each other, and means and
    scatters agree over the largest scatter or within their errors. At rest all do. */
template <class One>
bool is_same(const One& a, const Found& b)
{
  const Kind kind = a.answer.kind(), other = b.answer.kind();
  if (kind == Kind::rest && other == Kind::rest) return true;
  const bool differ = kind != other && std::min(kind, other) != Kind::undecided;
  if (differ || a.answer.period() != b.answer.period()) return false;
  const motion::Observation &p = a.seen, &q = b.seen;
  double apart = 0, size = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double mean_error = std::hypot(p.mean_error[i], q.mean_error[i]);
    const double rms_error = std::hypot(p.rms_error[i], q.rms_error[i]);
    apart = std::max({apart, std::abs(p.mean[i] - q.mean[i]) - same_errors * mean_error,
                      std::abs(p.rms[i] - q.rms[i]) - same_errors * rms_error});
    size = std::max({size, p.rms[i], q.rms[i]});
  }
  return apart <= size * (a.answer.period() > 0 ? same_closed : same_open);
}

/** The motion itself, closed where it closes. Of another one the exponent is the mean
    over its starts, whose scatter knows more than one motion does of itself. Throws
    NoSolution when the budget is used up. */
void look_closer(const Task& task, std::size_t speed, const Measures& measures,
                 const OperationBudget& budget, Found& found)
{
  motion::Request request = task.asked_at(speed);
  if (!found.is_closed()) {
    const BatchMean mean = batch_mean(found.exponents);
    found.answer.settled.lyapunov = {
        mean.value, std::max(mean.error, found.answer.settled.lyapunov.error)};
    request.is_measured = false;
    if (!task.request.motions) request.points = 4;
  }
  if (!measures.empty()) {
    const motion::Answer all = whole_motion(measures, found.answer, request, budget);
    found.measured = measures.of(record_of(all));
  }
  complete(found.answer, request, budget);
  if (found.answer.method == "shooting") {
    found.seen.mean = mean_of(found.answer.motion);
    found.seen.rms = rms_of(found.answer.motion);
  }
  found.touches = motion::contact_share(found.answer.machine, found.answer.motion) > 0;
}

/** One of each attractor in the order of the starts; a decided motion speaks for those
    that are not. */
std::vector<Found> found_at(const Task& task, std::size_t speed, std::vector<Run> runs)
{
  const auto is_decided = [](auto& run) { return run.answer.kind() != Kind::undecided; };
  std::ranges::stable_sort(runs, {}, &Run::origin);
  std::ranges::stable_partition(runs, is_decided);
  std::vector<Found> all;
  for (const Run& run : runs) {
    auto one = std::ranges::find_if(all, [&](const Found& f) { return is_same(run, f); });
    if (one == all.end())
      one = all.insert(one, {task.speeds[speed], run.answer, run.seen});
    ++one->from[static_cast<std::size_t>(run.origin)];
    one->exponents.push_back(run.answer.settled.lyapunov.value);
    if (!is_decided(run)) ++one->undecided;
  }
  return all;
}

/** Those that are different, numbered: the phases of one motion are apart by errors of
    integration until shooting has closed them. */
std::vector<Found> merged(std::vector<Found> all)
{
  std::vector<Found> kept;
  const auto is_shot = [](const Found& one) { return one.answer.method == "shooting"; };
  for (Found& one : all) {
    const auto same = std::ranges::find_if(kept, [&](const Found& other) {
      return is_shot(one) && is_shot(other) && is_same(one, other);
    });
    if (same == kept.end()) {
      kept.push_back(std::move(one));
      kept.back().number = static_cast<int>(kept.size());
      continue;
    }
    for (std::size_t i = 0; i < one.from.size(); ++i) same->from[i] += one.from[i];
    same->undecided += one.undecided;
  }
  return kept;
}

/** The attractors of all speeds, each paid from what is left of the budget. As with the
    starts, what goes beyond it in their order is lost; `missing` says what, unless it
    says something already. */
std::vector<Found> all_found(const Task& task, const Measures& measures,
                             std::vector<std::vector<Run>> runs, std::string& missing)
{
  const double most = task.budget.left();
  const auto pieces = computed_in_parallel(
      task.request.quiet ? "" : "motions", runs.size(), [&](std::size_t speed) {
        const OperationBudget budget =
            budget_until(task.request.budget, most, "--budget");
        auto all = found_at(task, speed, std::move(runs[speed]));
        for (Found& found : all) try {
            look_closer(task, speed, measures, budget, found);
          } catch (const NoSolution& error) {
            found.lost = error.what();
          }
        return std::pair{merged(std::move(all)), budget.spent()};
      });
  std::vector<Found> all;
  for (const auto& [found_here, spent] : pieces) {
    const bool is_paid = task.budget.pay(spent);
    for (const Found& found : found_here) {
      const std::string lost = is_paid ? found.lost : out_of_budget;
      if (!lost.empty() && missing.empty())
        missing = format("%s: partial, no section at %.9g Hz: %s",
                         task.machine.file.c_str(), found.speed, lost.c_str());
      if (lost.empty() || found.measured.size() == measures.columns().size())
        all.push_back(found);
    }
  }
  return all;
}

/**
## The tables */

using Fields = std::vector<Field<Found>>;

template <Origin origin>
constexpr auto from =
    [](const Found& f) -> Cell { return f.from[static_cast<std::size_t>(origin)]; };

const Fields usual_fields =
    Fields{{"f", "Hz", "speed of rotation", &Found::speed},
           {"motion", "-", "number of the motion at this speed", &Found::number},
           {"period", "-", "K base periods; 0 chaotic, -1 quasi-periodic, -2 undecided",
            [](auto& f) { return f.answer.period_number(); }},
           {"starts", "-", "how many ended there", &Found::starts},
           {"lyapunov", "1/base period", "largest Lyapunov exponent",
            [](auto& f) { return f.exponent().value; }},
           {"lyapunov_uncertainty", "1/base period",
            "its standard error; of a closed motion, the change at the last refinement",
            [](auto& f) { return f.exponent().error; }}} +
    displacement_fields<Found>("amp_", "half peak-to-peak of ",
                               [](auto& f) { return f.seen.amplitude; }) +
    Fields{
        {"from_rest", "-", "starts at rest that ended there", from<Origin::rest>},
        {"from_below", "-", "carried on from the next lower speed", from<Origin::below>},
        {"from_above", "-", "carried on from the next higher speed", from<Origin::above>},
        {"from_random", "-", "at random states", from<Origin::random>},
        {"undecided", "-", "of these starts, whose own motion is undecided",
         &Found::undecided}};

std::string section_text(const Task& task, const std::vector<Found>& all)
{
  Table table("Poincare sections of the attractors",
              {{"f", "Hz", "speed of rotation"},
               {"motion", "-", "number of the motion at this speed"},
               {"x_s", "m", "stator, at phase 0"},
               {"y_s", "m", "stator"},
               {"x_r", "m", "rotor"},
               {"y_r", "m", "rotor"},
               {"period", "-", "of the motion, as in the table of attractors"},
               {"lyapunov", "1/base period", "of the motion"},
               {"lyapunov_uncertainty", "1/base period", ""}});
  describe(table, task.machine);
  if (task.request.rpm) table.value("speed_axis", "rpm");
  table.note(format("points: K of a motion that closes, %d of another", section_points));
  for (const Found& found : all) {
    const motion::Motion& motion = found.answer.motion;
    const auto step = static_cast<std::size_t>(motion.points_per_period);
    for (std::size_t k = 0; k < motion.size(); k += step) {
      const Displacements q = displacements(motion.positions[k]);
      table.row({found.speed, found.number, q[0], q[1], q[2], q[3],
                 found.answer.period_number(), found.exponent().value,
                 found.exponent().error});
    }
  }
  return table.text();
}

std::string motion_text(const Task& task, const std::vector<Found>& all)
{
  Table table("Motions on the attractors",
              {{"f", "Hz", "speed of rotation"},
               {"motion", "-", "number of the motion at this speed"},
               {"t_over_T", "-", "time over the base period, from phase 0"},
               {"x_s", "m", "stator"},
               {"y_s", "m", "stator"},
               {"x_r", "m", "rotor"},
               {"y_r", "m", "rotor"},
               {"F_x", "N", "Eq. 6, on the stator"},
               {"F_y", "N", "Eq. 6, on the stator"}});
  describe(table, task.machine);
  table.note(format("periods: K of a motion that closes, %d of another", motion_periods));
  for (const Found& found : all) {
    const motion::Motion& motion = found.answer.motion;
    if (motion.size() == 0) continue;
    const auto forces = motion::bearing_forces(found.answer.machine, motion);
    const int periods =
        found.is_closed() ? std::max(1, found.answer.period()) : motion_periods;
    const auto rows = std::min<std::size_t>(motion.size(), periods * motion_points);
    for (std::size_t k = 0; k < rows; ++k) {
      const Displacements q = displacements(motion.positions[k]);
      table.row({found.speed, found.number, motion.t_over_period(k), q[0], q[1], q[2],
                 q[3], forces[k].x, forces[k].y});
    }
  }
  return table.text();
}

void note(Table& table, const Task& task)
{
  describe(table, task.machine);
  const std::string method = task.machine.bodies->time_method(task.machine);
  table.value("method", method);
  if (task.machine.bodies->takes_explicit_steps()) {
    const Based last = over(task.base, task.machine, angular(task.speeds.back()));
    const double ratio = steps_of_rk4(method) * step_ratio(task.request.tolerance);
    table.value("step", ratio * step_at(last.machine, last.omega), 4);
  }
  if (task.request.tolerance) table.value("tolerance", *task.request.tolerance);
  table.value("base", task.base.words());
  table.value("speeds", task.speeds.size());
  table.value("starts", task.request.starts);
  table.value("seed", task.request.seed);
  table.note(
      "starts: at each speed from rest, from the motion at the speed below, from that at "
      "the speed above, and from random states");
  table.note(
      "period: K up to 16 where the section closes; 0 where neighbours part; -1 where "
      "they do not, or come nearer while two frequencies drive; -2 undecided");
  table.note(
      "lyapunov: ln of the largest multiplier of a closed motion over K; of others the "
      "growth of a neighbour's distance, mean over the starts");
  table.note(format(
      "same motion: means and rms within %g of the largest rms if closed, else within %g "
      "of it plus %g standard errors",
      same_closed, same_open, same_errors));
}

/** What is missing and why; empty when nothing is. */
std::string unfinished(const Task& task, const std::vector<Run>& all)
{
  const auto is_lost = [](const Run& run) { return !run.lost.empty(); };
  const auto first = std::ranges::find_if(all, is_lost);
  if (first == all.end()) return "";
  return format("%s: partial, %td of %zu starts have no result, the first at %.9g Hz: %s",
                task.machine.file.c_str(), std::ranges::count_if(all, is_lost),
                all.size(), task.speeds[first->speed], first->lost.c_str());
}

}  // namespace

Exploration explore_attractors(const AttractorsRequest& request)
{
  const Task task = task_of(request);
  Fields fields = usual_fields;
  const Measures measures = add_measures(fields, request.columns, task.machine);
  Table table("Attractors, speed by speed", fields);
  table.choose(request.columns, usual_fields.size(), false);
  const std::vector<Run> ended = all_runs(task);
  std::string missing = unfinished(task, ended);
  std::vector<std::vector<Run>> runs(task.speeds.size());
  for (const Run& run : ended)
    if (run.lost.empty()) runs[run.speed].push_back(run);
  if (std::ranges::all_of(runs, &std::vector<Run>::empty)) throw NoSolution(missing);
  std::vector<Found> all = all_found(task, measures, std::move(runs), missing);
  note(table, task);
  put_complete(table, missing);
  for (const Found& found : all) table.row(fields, found);
  const bool touches = std::ranges::any_of(all, &Found::touches);
  if (touches || missing.empty()) put_contact(table, task.machine, touches);
  put_cost(table, task.budget);
  const auto section = request.section || request.plot ? section_text(task, all) : "";
  std::vector<NamedContent> files;
  if (request.section) files.push_back({*request.section, section});
  if (request.motions) files.push_back({*request.motions, motion_text(task, all)});
  return {std::move(table), std::move(files), missing, section};
}

}  // namespace rotor_stator::explore
