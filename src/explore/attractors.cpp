#include "explore/attractors.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <numbers>

#include "balance/torus_line.hpp"
#include "io/errors.hpp"
#include "io/output_file.hpp"
#include "io/parallel.hpp"
#include "motion/attractor.hpp"
#include "motion/contact.hpp"

namespace rotor_stator::explore {

namespace {

using motion::Attractor;
using motion::AttractorSettings;

constexpr int section_points = 200;    // of a motion that does not close
constexpr int most_runs = 200000;      // each keeps its state and statistics
constexpr int amplitude_points = 512;  // per period of one that does
constexpr int motion_points = 256, motion_periods = 16;  // of --motions

/** The request, checked, with the machine and the settings that belong to it. */
struct Task {
  const AttractorsRequest& request;
  Parameters asked, machine;   ///< the second with the base period of its motions
  double passages;             ///< the base frequency over the speed
  std::vector<double> speeds;  ///< base frequencies [Hz]
  AttractorSettings settings;
  OperationBudget budget;

  bool is_edge(std::size_t speed) const
  {
    return speed == 0 || speed + 1 == speeds.size();
  }
};

/** Rk4 between two looks at the neighbour, which must not come too near in the meantime. */
int intervals_at(double frequency, const AttractorSettings& settings)
{
  constexpr int least = 64, most = 1 << 20;
  return static_cast<int>(
      std::clamp(50 / (frequency * settings.block), 1.0 * least, 1.0 * most));
}

/** All times in units of fifty vibrations of the joined bodies, 1 s for data set 1. */
AttractorSettings settings_of(const Parameters& machine)
{
  AttractorSettings settings{.stepper = {.method = "rk4", .intervals_per_period = 64}};
  const double unit = 50 * 2 * std::numbers::pi / joint_resonance(machine);
  for (double* time : {&settings.longest, &settings.block, &settings.least,
                       &settings.chaotic, &settings.most})
    *time *= unit;
  settings.rule.zero_rate /= unit;
  return settings;
}

Task task_of(const AttractorsRequest& request)
{
  require_range(request.from, request.to);
  const Parameters asked = machine_of(request, request.from, request.to);
  const bool is_still = !turns_visibly(asked);  // only the passing balls move it
  const Parameters machine =
      is_still && !has_rotation_period(asked.bearing) ? over_passage(asked) : asked;
  const double passages =
      passages_per_turn(asked.bearing) / passages_per_turn(machine.bearing);
  std::vector<std::string> inputs{request.parameter_file};
  if (request.section) require_writable("--section", *request.section, inputs);
  if (request.motions) require_writable("--motions", *request.motions, inputs);
  const int most_starts = most_runs / request.count - 3;
  if (request.starts > most_starts)
    throw BadInput(format("--starts %d: must be in 0...%d with --count %d",
                          request.starts, most_starts, request.count));
  std::vector<double> speeds;
  for (int k = 0; k < request.count; ++k)
    speeds.push_back(passages * (request.from + (request.to - request.from) * k /
                                                    std::max(1, request.count - 1)));
  AttractorSettings settings = settings_of(machine);
  const OperationBudget budget =
      budget_of(request, request.count * (3.0 + request.starts), machine);
  return {request, asked, machine, passages, std::move(speeds), settings, budget};
}

/**
## The starts

Two chains carry the state on from speed to speed; each speed has its own starts beside them. Some are integrated at
once, but what they cost is added up in their order, and what goes beyond the budget is lost, so that the table does
not depend on the number of threads. */

const char* const out_of_budget = "the budget is used up, more with --budget";

enum class Origin { rest, below, above, random };

/** Where one start ended. */
struct Run : Attractor {
  std::size_t speed;
  Origin origin;
  double spent;           ///< evaluations of the force
  std::string lost = {};  ///< why it has no result
};

/** Starts that are integrated one after the other. */
struct Piece {
  enum { up, down, at_speed } kind;
  std::size_t speed = 0;
};

std::vector<Piece> pieces_of(const Task& task)
{
  std::vector<Piece> pieces{{Piece::up}};
  if (task.speeds.size() > 1) pieces.push_back({Piece::down});
  for (std::size_t k = 0; k < task.speeds.size(); ++k)
    if (!task.is_edge(k) || task.request.starts > 0)
      pieces.push_back({Piece::at_speed, k});
  return pieces;
}

/** The chains begin at rest, which at the edges is the start from rest. */
std::vector<Run> runs_of(const Task& task, const Piece& piece,
                         const OperationBudget& budget)
{
  AttractorSettings settings = task.settings;
  settings.stepper.budget = budget;
  std::vector<Run> runs;
  /** The state that the next start of a chain takes; at rest again after one that was lost. */
  const auto run = [&](std::size_t speed, Origin origin, const State& start) {
    const double frequency = task.speeds[speed], left = budget.left();
    settings.stepper.intervals_per_period = intervals_at(frequency, settings);
    Run one{{}, speed, origin, 0};
    one.state = static_start(task.machine);
    try {
      static_cast<Attractor&>(one) =
          attractor_from(task.machine, angular(frequency), start, settings);
    } catch (const NoSolution& error) {
      one.lost = budget.used_up() ? out_of_budget : error.what();
    }
    one.spent = left - budget.left();
    runs.push_back(one);
    return one.state;
  };
  State state = static_start(task.machine);
  if (piece.kind == Piece::at_speed) {
    const double omega = angular(task.speeds[piece.speed]);
    if (!task.is_edge(piece.speed)) run(piece.speed, Origin::rest, state);
    for (int k = 0; k < task.request.starts; ++k) {
      const auto seed = (static_cast<std::uint64_t>(task.request.seed) << 32) +
                        (static_cast<std::uint64_t>(piece.speed) << 16) +
                        static_cast<std::uint64_t>(k);
      run(piece.speed, Origin::random, motion::random_state(task.machine, omega, seed));
    }
    return runs;
  }
  const Origin carried = piece.kind == Piece::up ? Origin::below : Origin::above;
  for (std::size_t k = 0; k < task.speeds.size(); ++k) {
    const std::size_t speed = piece.kind == Piece::up ? k : task.speeds.size() - 1 - k;
    state = run(speed, k == 0 ? Origin::rest : carried, state);
  }
  return runs;
}

/** All starts in order, and whether the budget paid for them. */
std::vector<Run> all_runs(const Task& task)
{
  const std::vector<Piece> pieces = pieces_of(task);
  /** The rest is for the exponents of closed motions. */
  const double most = 0.9 * task.budget.left();
  std::atomic<double> spent = 0;
  const auto of_pieces = computed_in_parallel(
      task.request.quiet ? "" : "attractors", pieces.size(), [&](std::size_t k) {
        /** Of earlier pieces only: these begin in order. */
        auto runs =
            runs_of(task, pieces[k], OperationBudget(std::max(0.0, most - spent)));
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
struct Found : Attractor {
  double frequency, passages;          ///< of the base period [Hz]; over the speed
  int number;                          ///< at this speed
  std::array<int, 4> from = {};        ///< starts by `Origin`
  int undecided = 0;                   ///< of them
  std::vector<double> exponents = {};  ///< of the motions of these starts [1/s]
  std::vector<Displacements> section = {};
  std::vector<std::pair<Displacements, Vec2>> motion = {};  ///< with its force [N]
  bool touches = false;

  int starts() const { return from[0] + from[1] + from[2] + from[3]; }
  double speed() const { return frequency / passages; }
  double turns(double rate) const { return rate / frequency; }

  /** K; 0 aperiodic, -1 quasi-periodic, -2 undecided. */
  int period_number() const
  {
    if (closed()) return period;
    return verdict == Verdict::chaotic ? 0 : verdict == Verdict::quasi_periodic ? -1 : -2;
  }
};

/** The section, amplitudes on fine points and what --motions asks for. Throws NoSolution when the budget is used up. */
void look_closer(const Task& task, Found& found)
{
  const bool is_written = task.request.motions.has_value();
  const int points = found.closed() ? amplitude_points : is_written ? motion_points : 4;
  const motion::Motion motion = motion::motion_along(
      found, task.machine, angular(found.frequency), points, section_points, task.budget);
  if (found.closed()) found.amplitude = half_peak_to_peak(motion);
  for (std::size_t k = 0; k < motion.size(); k += static_cast<std::size_t>(points))
    found.section.push_back(displacements(motion.positions[k]));
  const std::vector<Vec2> forces = motion::bearing_forces(task.machine, motion);
  found.touches =
      std::ranges::any_of(forces, [](Vec2 f) { return f.x != 0 || f.y != 0; });
  if (!is_written) return;
  const int periods = found.closed() ? found.period : motion_periods;
  for (int k = 0; k < periods * points; k += points / motion_points)
    found.motion.emplace_back(displacements(motion.positions[k]), forces[k]);
}

/** Of a closed motion from its multipliers: where they do not call it stable, the machine does not settle on it.
    Of another the mean over its starts, whose scatter knows more than one motion does of itself; its verdict must
    hold for the mean, and a quasi-periodic one for each start; a section that nearly closes may be about to. */
void sharpen_exponent(const Task& task, Found& found)
{
  if (!found.closed()) {
    const BatchMean mean = batch_mean(found.exponents);
    found.exponent = {mean.value, std::max(mean.error, found.exponent.error)};
    const bool positive =
        mean.value - 3 * found.exponent.error > task.settings.rule.zero_rate;
    const bool is_driven_twice = turns_to_repeat(task.machine.bearing) == 0;
    const bool nearly_closed = found.spread_k < 1e-4 && !is_driven_twice;
    if (found.verdict == Verdict::chaotic ? !positive
                                          : found.undecided > 0 || nearly_closed)
      found.verdict = Verdict::undecided;
    return;
  }
  try {
    found.exponent = motion::closed_exponent(found, task.machine,
                                             angular(found.frequency), task.budget);
  } catch (const NoSolution&) {
    /** The neighbour's stays. */
  }
  if (found.exponent.value + found.exponent.error >= 0)
    found.verdict = Verdict::undecided;
}

/** One of each attractor in the order of the starts; a decided motion speaks for those that are not. */
std::vector<Found> found_at(const Task& task, std::size_t speed, std::vector<Run> runs)
{
  std::stable_sort(runs.begin(), runs.end(),
                   [](const Run& a, const Run& b) { return a.origin < b.origin; });
  std::stable_partition(runs.begin(), runs.end(), [](auto& r) { return r.decided(); });
  std::vector<Found> all;
  for (const Run& run : runs) {
    auto one = std::ranges::find_if(
        all, [&](const Found& f) { return same_attractor(run, f, task.settings); });
    if (one == all.end())
      one = all.insert(one, {run, task.speeds[speed], task.passages,
                             static_cast<int>(all.size()) + 1});
    ++one->from[static_cast<std::size_t>(run.origin)];
    one->exponents.push_back(run.exponent.value);
    if (!run.decided()) ++one->undecided;
  }
  return all;
}

/**
## The tables */

using Fields = std::vector<Field<Found>>;

template <int k>
constexpr auto amplitude = [](const Found& f) -> Cell { return f.amplitude[k]; };
template <Origin origin>
constexpr auto from =
    [](const Found& f) -> Cell { return f.from[static_cast<std::size_t>(origin)]; };

const Fields fields{
    {"f", "Hz", "speed of rotation", &Found::speed},
    {"motion", "-", "number of the motion at this speed", &Found::number},
    {"period", "-", "K base periods; 0 aperiodic, -1 quasi-periodic, -2 undecided",
     &Found::period_number},
    {"starts", "-", "how many ended there", &Found::starts},
    {"lyapunov", "1/base period", "largest Lyapunov exponent",
     [](auto& f) { return f.turns(f.exponent.value); }},
    {"lyapunov_uncertainty", "1/base period",
     "its standard error; of a closed motion, the change at the last refinement",
     [](auto& f) { return f.turns(f.exponent.error); }},
    {"amp_x_s", "m", "half peak-to-peak of x_s", amplitude<0>},
    {"amp_y_s", "m", "half peak-to-peak of y_s", amplitude<1>},
    {"amp_x_r", "m", "half peak-to-peak of x_r", amplitude<2>},
    {"amp_y_r", "m", "half peak-to-peak of y_r", amplitude<3>},
    {"from_rest", "-", "starts at rest that ended there", from<Origin::rest>},
    {"from_below", "-", "carried on from the next lower speed", from<Origin::below>},
    {"from_above", "-", "carried on from the next higher speed", from<Origin::above>},
    {"from_random", "-", "at random states", from<Origin::random>},
    {"undecided", "-", "of these starts, whose own motion is undecided",
     &Found::undecided},
    {"spread", "-",
     "largest distance of section points K periods apart over the largest displacement; of "
     "any two, where the section does not close",
     [](auto& f) { return f.period_number() > 0 ? f.spread_k : f.spread; }}};

const std::vector<Column> section_columns{
    {"f", "Hz", "speed of rotation"},
    {"motion", "-", "number of the motion at this speed"},
    {"x_s", "m", "stator, at phase 0"},
    {"y_s", "m", "stator"},
    {"x_r", "m", "rotor"},
    {"y_r", "m", "rotor"},
    {"period", "-", "of the motion, as in the table of attractors"},
    {"lyapunov", "1/base period", "of the motion"},
    {"lyapunov_uncertainty", "1/base period", ""}};

std::string section_text(const Task& task, const std::vector<Found>& all)
{
  Table table("Poincare sections of the attractors", section_columns);
  describe(table, task.asked);
  table.note(format("points: K of a motion that closes, %d of another", section_points));
  for (const Found& found : all)
    for (const Displacements& q : found.section)
      table.row({found.speed(), found.number, q[0], q[1], q[2], q[3],
                 found.period_number(), found.turns(found.exponent.value),
                 found.turns(found.exponent.error)});
  return table.text();
}

const std::vector<Column> motion_columns{
    {"f", "Hz", "speed of rotation"},
    {"motion", "-", "number of the motion at this speed"},
    {"t_over_T", "-", "time over the base period, from phase 0"},
    {"x_s", "m", "stator"},
    {"y_s", "m", "stator"},
    {"x_r", "m", "rotor"},
    {"y_r", "m", "rotor"},
    {"F_x", "N", "Eq. 6, on the stator"},
    {"F_y", "N", "Eq. 6, on the stator"}};

std::string motion_text(const Task& task, const std::vector<Found>& all)
{
  Table table("Motions on the attractors", motion_columns);
  describe(table, task.asked);
  table.note(format("periods: K of a motion that closes, %d of another", motion_periods));
  for (const Found& found : all) {
    double k = 0;
    for (const auto& [q, force] : found.motion)
      table.row({found.speed(), found.number, k++ / motion_points, q[0], q[1], q[2], q[3],
                 force.x, force.y});
  }
  return table.text();
}

void note(Table& table, const Task& task)
{
  const AttractorSettings& s = task.settings;
  describe(table, task.asked);
  table.value("method", "rk4");
  table.value("step", default_step(task.machine), 4);
  table.value("base", task.passages != 1                           ? "passing"
                      : turns_to_repeat(task.machine.bearing) == 0 ? "two"
                                                                   : "turn");
  table.value("speeds", task.speeds.size());
  table.value("starts", task.request.starts);
  table.value("seed", task.request.seed);
  table.note(format(
      "transient: until the section's spread is below %g, at most %.3g s; then observed for "
      "%.3g s if the section closes, %.3g s if aperiodic, %.3g s else",
      s.settled, s.longest, s.least, s.chaotic, s.most));
  table.note(format(
      "period: K up to %d where points K periods apart are within %g and the exponent is "
      "negative; aperiodic if the exponent less 3 errors is above %.3g 1/s; quasi-periodic "
      "if for every start it is within 3 errors of 0, these below %.3g 1/s, and no points "
      "K periods apart are all within 1e-4; undecided otherwise",
      s.rule.most_period, s.rule.periodic, s.rule.zero_rate, 2 * s.rule.zero_rate));
  if (turns_to_repeat(task.machine.bearing) == 0)
    table.note(
        "two frequencies drive the machine: a motion to which neighbours come, its "
        "exponent plus 3 errors negative, is quasi-periodic");
  table.note(
      "lyapunov: ln of the largest multiplier of a closed motion over K; of others the "
      "growth of a neighbour's distance, mean over the starts");
  table.note(format(
      "same motion: means and scatters within %g of the largest scatter if closed, %g else",
      s.same_periodic, s.same_aperiodic));
}

/** What is missing and why; empty when nothing is. */
std::string unfinished(const Task& task, const std::vector<Run>& all)
{
  const auto is_lost = [](const Run& run) { return !run.lost.empty(); };
  const auto first = std::ranges::find_if(all, is_lost);
  if (first == all.end()) return "";
  return format("%s: partial, %td of %zu starts have no result, the first at %.9g Hz: %s",
                task.machine.file.c_str(), std::ranges::count_if(all, is_lost),
                all.size(), task.speeds[first->speed] / task.passages,
                first->lost.c_str());
}

}  // namespace

SettledMotion settled_from_rest(const Parameters& machine, double frequency,
                                const OperationBudget& budget)
{
  const AttractorsRequest alone;
  const Task task{alone, machine, machine, 1, {frequency}, settings_of(machine), budget};
  const Run run = runs_of(task, {Piece::up}, budget).front();
  if (!run.lost.empty()) throw NoSolution(run.lost);
  Found found = found_at(task, 0, {run}).front();
  sharpen_exponent(task, found);
  const motion::Motion motion = motion::motion_along(found, machine, angular(frequency),
                                                     128, section_points, budget);
  return {found.period_number(), found.turns(found.exponent.value),
          motion::contact_share(machine, motion)};
}

Exploration explore_attractors(const AttractorsRequest& request)
{
  Table table("Attractors, speed by speed", fields);
  table.choose(request.columns, fields.size(), false);
  const Task task = task_of(request);
  const std::vector<Run> ended = all_runs(task);
  std::string missing = unfinished(task, ended);
  std::vector<std::vector<Run>> runs(task.speeds.size());
  for (const Run& run : ended)
    if (run.lost.empty()) runs[run.speed].push_back(run);
  if (std::ranges::all_of(runs, &std::vector<Run>::empty)) throw NoSolution(missing);
  std::vector<Found> all;
  for (std::size_t speed = 0; speed < runs.size(); ++speed)
    for (Found& found : found_at(task, speed, std::move(runs[speed]))) {
      try {
        look_closer(task, found);
      } catch (const NoSolution& error) {
        if (missing.empty())
          missing = format("%s: partial, no section at %.9g Hz: %s",
                           task.machine.file.c_str(), found.speed(), error.what());
      }
      sharpen_exponent(task, found);
      all.push_back(std::move(found));
    }
  note(table, task);
  put_complete(table, missing);
  for (const Found& found : all) table.row(fields, found);
  conclude(table, task.machine, std::ranges::any_of(all, &Found::touches), task.budget);
  std::string section;
  if (request.section || request.plot) section = section_text(task, all);
  if (request.section) write_file(*request.section, section);
  if (request.motions) write_file(*request.motions, motion_text(task, all));
  return {std::move(table), missing, section};
}

}  // namespace rotor_stator::explore
