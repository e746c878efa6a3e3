#include "explore/response_sweep.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <span>
#include <utility>

#include "explore/resume.hpp"
#include "explore/settled_motion.hpp"
#include "io/errors.hpp"
#include "io/output_file.hpp"
#include "io/parallel.hpp"
#include "motion/contact.hpp"
#include "motion/find_periodic.hpp"

namespace rotor_stator::explore {

namespace {

const ResponseFields period_field{
    {"period", "-", "K base periods; 0 chaotic, -1 quasi-periodic, -2 undecided",
     &ResponseRow::period}};
const ResponseFields error_field{
    {"error", "-",
     "of the solution: the larger of the largest difference of a displacement over the "
     "largest displacement and the rms about the mean",
     &ResponseRow::error}};

using Rows = std::vector<Attempt<ResponseRow>>;

/** What the rows have in common. */
struct Sweep {
  const ResponseRequest& request;
  const Parameters& machine;
  std::vector<double> speeds;  ///< [Hz], in the order in which they are computed
  bool is_chain;               ///< each from the one before
  std::size_t side_by_side;    ///< speeds that are given to `rows_at`
  double evaluations_of_one;
  Table table;
  ResponseFields fields;

  /** The rows of some speeds [Hz], each paid from its own budget. */
  std::function<Rows(std::span<const double>, std::span<const OperationBudget>)> rows_at;

  std::atomic<bool> touches = false;
};

/** What a speed has come to, and the evaluations that it took. */
struct Ended {
  Attempt<ResponseRow> row;
  double spent;
};

/** Of speeds side by side, at most `each` evaluations for one. */
std::vector<Ended> ended_at(const Sweep& sweep, std::span<const double> speeds,
                            double each)
{
  std::vector<OperationBudget> budgets;
  for (std::size_t k = 0; k < speeds.size(); ++k)
    budgets.push_back(budget_until(sweep.request.budget, each));
  std::vector<Ended> all;
  for (Rows rows = sweep.rows_at(speeds, budgets); auto& row : rows)
    all.push_back({std::move(row), budgets[all.size()].spent()});
  return all;
}

/** The rows of an interrupted table of the same question, at the first speeds. */
std::vector<std::vector<Cell>> rows_to_resume(const Sweep& sweep)
{
  std::vector<std::vector<Cell>> rows;
  if (!sweep.request.resume) return rows;
  const auto add = [&](const std::string&, const std::vector<std::string>& words) {
    std::vector<Cell> cells;
    for (const std::string& word : words) {
      const std::optional<double> number = number_of(word);
      if (!number) throw BadInput("has a cell that is no number: " + word);
      cells.emplace_back(*number);
    }
    const std::string speed =
        rows.size() < sweep.speeds.size() ? Cell(sweep.speeds[rows.size()]).text() : "";
    if (cells.size() != sweep.table.printed() || cells.front().text() != speed)
      throw BadInput("holds other points");
    rows.push_back(std::move(cells));
  };
  each_row_of(*sweep.request.resume, "response", sweep.table.beginning(), add);
  return rows;
}

Exploration computed(Sweep& sweep)
{
  const ResponseRequest& request = sweep.request;
  const auto& budget = request.budget;
  Table& table = sweep.table;
  const auto known = rows_to_resume(sweep);
  const bool is_streamed = request.format != TableFormat::json;
  bool has_rows = false;
  /** Nothing is written before there is a row. */
  const auto begin = [&] {
    if (is_streamed && !std::exchange(has_rows, true))
      table.stream(write, request.format);
  };
  for (const auto& cells : known) {
    begin();
    table.printed_row(cells);
  }
  double spent = 0;
  std::size_t lost = 0, next = known.size();
  std::string missing, first_lost;
  const double most = budget && budget->evaluations > 0
                          ? budget->evaluations
                          : std::numeric_limits<double>::infinity();
  const std::size_t block = sweep.side_by_side,
                    group = sweep.is_chain
                                ? 1
                                : std::max<std::size_t>(block, 2) * most_threads();
  while (next < sweep.speeds.size() && missing.empty()) {
    const auto speeds = std::span(sweep.speeds)
                            .subspan(next, std::min(group, sweep.speeds.size() - next));
    const double each = std::min(sweep.evaluations_of_one, most - spent);
    const auto blocks =
        computed_in_parallel("", (speeds.size() + block - 1) / block, [&](std::size_t k) {
          const std::size_t first = k * block;
          return ended_at(
              sweep, speeds.subspan(first, std::min(block, speeds.size() - first)), each);
        });
    const bool is_short =
        each < sweep.evaluations_of_one || (budget && budget->is_over());
    std::vector<Ended> ended;
    for (const auto& one : blocks) ended.insert(ended.end(), one.begin(), one.end());
    for (auto& [row, cost] : ended) {
      spent += cost;
      const double frequency = sweep.speeds[next];
      const bool is_known = row.has_value() && row.get().period != -2;
      if (spent > most || (is_short && !is_known)) {
        missing =
            format("%s: %s is used up at %g Hz; ", request.parameter_file.c_str(),
                   budget->words().c_str(), frequency) +
            (sweep.is_chain ? "more with --budget"
                            : "--resume FILE goes on with the rows that are written");
        break;
      }
      ++next;
      try {
        const ResponseRow& found = row.get();
        begin();
        table.row(sweep.fields, found);
        if (request.watch)
          request.watch(frequency,
                        Eigen::Map<const Eigen::Vector4d>(found.amplitude.data()));
      } catch (const NoSolution& none) {
        if (lost++ == 0) first_lost = format("at %g Hz: ", frequency) + none.what();
      }
    }
  }
  if (next == lost)
    throw NoSolution(missing.empty() ? request.parameter_file +
                                           ": no speed has a value, " + first_lost
                                     : missing);
  if (missing.empty() && lost > 0)
    missing = format("%s: %zu of %zu speeds have no value, the first ",
                     request.parameter_file.c_str(), lost, sweep.speeds.size()) +
              first_lost;
  put_complete(table, missing);
  put_contact(table, sweep.machine, sweep.touches);
  table.value("evaluations", spent, 3);
  if (is_streamed) table.end_stream();
  return {.table = std::move(table), .unfinished = missing, .is_written = is_streamed};
}

/** Whether anything touches in a motion that was not recorded: where it stands now or,
    where nothing is loaded then, over a few periods. */
bool touches_somewhere(motion::Answer& answer)
{
  motion::Motion now{1, answer.settled.at.period, {}, {}, answer.omega};
  motion::add(now, answer.settled.at.state);
  if (motion::contact_share(answer.machine, now) > 0) return true;
  complete(answer,
           {.omega = answer.omega, .points = 64, .periods = 4, .is_measured = false});
  return motion::contact_share(answer.machine, answer.motion) > 0;
}

/** The row of a settled motion. */
ResponseRow row_of(motion::Answer& answer, const motion::Observation& seen,
                   const motion::Request& asked, bool has_records,
                   const Measures& measures, std::atomic<bool>& touches,
                   const OperationBudget& budget)
{
  ResponseRow row{.frequency = asked.omega / angular(1),
                  .amplitude = seen.amplitude,
                  .period = answer.period_number()};
  if (has_records) {
    motion::Answer closed = answer;
    if (asked.is_measured || measures.empty()) complete(closed, asked, budget);
    row.lyapunov = closed.settled.lyapunov.value;
    answer = measures.empty() ? std::move(closed) : whole_motion(answer, asked, budget);
    observe(row, answer.machine, answer.motion, answer.omega, closes(answer), measures);
    if (row.contact_share > 0) touches = true;
  } else if (!touches && touches_somewhere(answer)) {
    touches = true;
  }
  row.mean = seen.mean;
  row.rms = seen.rms;
  return row;
}

}  // namespace

Exploration settled_response(const ResponseRequest& request)
{
  require_range(request.from, request.to);
  const std::string direction = request.direction.empty() ? "rest" : request.direction;
  if (direction != "rest" && direction != "up" && direction != "down")
    throw BadInput("--direction " + direction + ": must be rest, up or down");
  if (request.resume && direction != "rest")
    throw BadInput("--resume: not with --direction " + direction +
                   ", where each speed starts from the one before");
  const Parameters machine = machine_of(request, request.from, request.to);
  const Patience patience = machine.bodies->patience();
  const auto [fields, usual, measures] = columns_of(request, machine, period_field, true);
  Sweep sweep{
      request,
      machine,
      evenly_spaced(request.from, request.to, request.count.value_or(patience.speeds)),
      direction != "rest",
      direction == "rest" && machine.bodies->takes_explicit_steps() ? 32U : 1U,
      budget_of_each({}, patience.settling, machine).left(),
      Table("Frequency response, what the machine does", fields),
      fields,
      {}};
  if (direction == "down") std::ranges::reverse(sweep.speeds);
  const bool has_records =
      sweep.table.choose(request.columns, usual, request.plot.has_value());
  describe(sweep.table, machine);
  sweep.table.value("method", machine.bodies->time_method(machine));
  sweep.table.value("kind", "sweep");
  sweep.table.value("base", base_period(machine).words());
  sweep.table.value("direction", direction);
  if (request.tolerance) sweep.table.value("tolerance", *request.tolerance);
  if (request.longest > 0) sweep.table.value("longest", request.longest);
  sweep.table.value("speeds", sweep.speeds.size());
  sweep.table.note(
      "amplitudes over the K base periods of a motion that closes, over 256 of "
      "another one");
  const bool needs_multipliers =
      request.columns == "all" || request.columns.find("lyapunov") != std::string::npos;
  std::optional<State> state;
  sweep.rows_at = [&](std::span<const double> speeds,
                      std::span<const OperationBudget> budgets) {
    std::vector<motion::Question> questions;
    for (std::size_t k = 0; k < speeds.size(); ++k)
      questions.push_back({machine,
                           {.omega = angular(speeds[k]),
                            .periods = Measures::open_periods,
                            .step_ratio = step_ratio(request.tolerance),
                            .longest = request.longest,
                            .is_measured = needs_multipliers},
                           budgets[k],
                           std::exchange(state, std::nullopt),
                           0.7});
    auto all = motion::observed_answers(questions);
    Rows rows;
    for (std::size_t k = 0; k < all.size(); ++k)
      rows.push_back(attempt([&] {
        motion::Answer& answer = all[k].answer.get();
        if (sweep.is_chain) state = answer.settled.at.state;
        return row_of(answer, all[k].seen.get(), questions[k].request, has_records,
                      measures, sweep.touches, budgets[k]);
      }));
    return rows;
  };
  return computed(sweep);
}

Exploration response_to_tolerance(const ResponseTask& task)
{
  const ResponseRequest& request = task.request;
  const double tolerance = *request.tolerance;
  ResponseFields own = error_field;
  for (auto& field : harmonic_fields(task, Harmonics(task.harmonics)))
    own.push_back(std::move(field));
  const auto [fields, usual, measures] = columns_of(request, task.machine, own);
  Sweep sweep{request,
              task.machine,
              evenly_spaced(request.from, request.to, request.count.value_or(101)),
              true,
              1,
              budget_of_each({}, 1, task.machine).left(),
              Table("Frequency response at evenly spaced speeds", fields),
              fields,
              {}};
  if (!task.upwards) std::ranges::reverse(sweep.speeds);
  const bool has_further =
      sweep.table.choose(request.columns, usual, request.plot.has_value());
  describe(sweep.table, task.machine);
  sweep.table.value("method", "aft");
  sweep.table.value("kind", "sweep");
  sweep.table.value("base", task.base_period);
  sweep.table.value("direction", task.upwards ? "up" : "down");
  sweep.table.value("tolerance", tolerance);
  sweep.table.value("speeds", sweep.speeds.size());
  sweep.table.note(
      "harmonics and samples chosen for each speed, from the solution before");
  Eigen::VectorXd before;
  const auto row_at = [&](double frequency, const OperationBudget& budget) {
    BalanceSearch search{.parameters = task.parameters,
                         .omega = task.base(frequency),
                         .harmonics = 6,
                         .budget = budget};
    if (before.size() > 0) search.starts = {before};
    const motion::Judged at = motion::to_tolerance(search, tolerance);
    if (!at.reached)
      throw NoSolution(format("tolerance %g not reached: ", tolerance) + at.end);
    before = at.motion.x;
    const Eigen::MatrixXd& bodies = at.motion.bodies;
    const Eigen::VectorXd amplitude = half_peak_to_peak(bodies);
    ResponseRow row{.frequency = frequency, .error = at.verdict.distance.larger()};
    std::ranges::copy(amplitude, row.amplitude.begin());
    row.harmonics =
        harmonics_of(task, resize_harmonics(bodies.reshaped(), 4, task.harmonics)
                               .reshaped(4, 2 * task.harmonics + 1));
    const int points = std::max(256, 4 * at.motion.harmonics.count() + 4);
    if (has_further)
      observe(row, task.parameters, motion::motion_of(at.motion, points), at.motion.omega,
              true, measures);
    if (motion::touches(task.parameters, at.motion)) sweep.touches = true;
    return row;
  };
  sweep.rows_at = [&](std::span<const double> speeds,
                      std::span<const OperationBudget> budgets) {
    Rows rows;
    for (std::size_t k = 0; k < speeds.size(); ++k)
      rows.push_back(attempt([&] { return row_at(speeds[k], budgets[k]); }));
    return rows;
  };
  return computed(sweep);
}

}  // namespace rotor_stator::explore
