#include "explore/response_sweep.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <map>
#include <span>
#include <utility>

#include "explore/resume.hpp"
#include "io/errors.hpp"
#include "io/output_file.hpp"
#include "io/parallel.hpp"
#include "motion/contact.hpp"
#include "motion/find_periodic.hpp"

namespace rotor_stator::explore {

namespace {

using Rows = std::vector<Attempt<ResponseRow>>;

/** What the rows have in common. */
struct Sweep {
  Sweep(const ResponseRequest& asked, const Parameters& of, const char* title,
        ResponseColumns all, const std::string& towards, int count, double seconds_of_one)
      : request(asked), machine(of), columns(std::move(all)),
        table(title, columns.fields),
        has_further(table.choose(asked.columns, columns.usual, asked.plot.has_value())),
        direction(towards), is_chain(towards != "rest"),
        speeds(evenly_spaced(asked.from, asked.to,
                             asked.from < asked.to ? asked.count.value_or(count) : 1)),
        evaluations_of_one(budget_of_each({}, seconds_of_one, of).left())
  {
    if (direction == "down") std::ranges::reverse(speeds);
  }

  void describe(const std::string& method, const std::string& base,
                const std::string& note)
  {
    rotor_stator::describe(table, machine);
    table.value("method", method);
    table.value("kind", "sweep");
    table.value("base", base);
    table.value("direction", direction);
    if (request.tolerance) table.value("tolerance", *request.tolerance);
    if (request.longest > 0) table.value("longest", request.longest);
    table.value("speeds", speeds.size());
    table.note(note);
  }

  const ResponseRequest& request;
  const Parameters& machine;
  const ResponseColumns columns;
  Table table;
  bool has_further;  ///< whether columns beside the usual ones are wanted
  std::string direction;
  bool is_chain;               ///< each from the one before
  std::vector<double> speeds;  ///< [Hz], in the order in which they are computed
  double evaluations_of_one;
  std::size_t side_by_side = 1;  ///< speeds that are given to `rows_at`

  /** The rows of some speeds [Hz], each paid from its own budget. */
  std::function<Rows(std::span<const double>, std::span<const OperationBudget>)> rows_at;

  std::atomic<bool> touches = false;
};

/** A row, and the evaluations that it took. */
using Ended = std::pair<Attempt<ResponseRow>, double>;

/** Of speeds side by side, at most `each` evaluations for one. */
std::vector<Ended> ended_at(const Sweep& sweep, std::span<const double> speeds,
                            double each)
{
  std::vector<OperationBudget> budgets;
  for (std::size_t k = 0; k < speeds.size(); ++k)
    budgets.push_back(budget_until(sweep.request.budget, each));
  std::vector<Ended> all;
  for (Rows rows = sweep.rows_at(speeds, budgets); auto& row : rows)
    all.emplace_back(std::move(row), budgets[all.size()].spent());
  return all;
}

/** The rows of an interrupted table of the same question, by the numbers of their
    speeds. */
std::map<std::size_t, std::vector<Cell>> rows_to_resume(const Sweep& sweep)
{
  const ResponseRequest& request = sweep.request;
  std::map<std::size_t, std::vector<Cell>> known;
  if (!request.resume) return known;
  if (!request.columns.empty() && request.plot)
    throw BadInput("--plot: not of a resumed table with --columns; leave out --plot");
  if (!request.columns.empty() && request.columns != "all" &&
      !(request.columns + ",").starts_with("f,"))
    throw BadInput("--resume: needs f as the first of --columns");
  std::size_t next = 0;
  const auto add = [&](const std::string&, const std::vector<std::string>& words) {
    std::vector<Cell> cells;
    for (const std::string& word : words) {
      const std::optional<double> number = number_of(word);
      if (!number) throw BadInput("has a cell that is no number: " + word);
      cells.emplace_back(*number);
    }
    const auto is_next = [&](double speed) {
      return Cell(speed).text() == cells.front().text();
    };
    const auto rest = std::span(sweep.speeds).subspan(next);
    const bool is_whole = cells.size() == sweep.table.printed();
    const auto found = is_whole ? std::ranges::find_if(rest, is_next) : rest.end();
    if (found == rest.end()) throw BadInput("holds other points");
    next += static_cast<std::size_t>(found - rest.begin());
    known[next++] = std::move(cells);
  };
  each_row_of(*sweep.request.resume, "response", sweep.table.beginning(), add);
  return known;
}

Exploration computed(Sweep& sweep)
{
  const ResponseRequest& request = sweep.request;
  const Allowance& budget = request.budget;
  Table& table = sweep.table;
  const auto known = rows_to_resume(sweep);
  std::vector<std::size_t> numbers;  // of the speeds that are computed
  for (std::size_t k = 0; k < sweep.speeds.size(); ++k)
    if (!known.contains(k)) numbers.push_back(k);
  const bool is_streamed = request.format != TableFormat::json;
  bool has_rows = false;
  /** Nothing is written before there is a row. */
  const auto begin = [&] {
    if (is_streamed && !std::exchange(has_rows, true))
      table.stream(write, request.format);
  };
  auto put_known = [&, row = known.begin()](std::size_t before) mutable {
    for (; row != known.end() && row->first < before; ++row) {
      begin();
      table.printed_row(row->second);
    }
  };
  double spent = 0;
  std::size_t lost = 0, next = 0;
  std::string missing, first_lost;
  const double most = budget.evaluations > 0 ? budget.evaluations
                                             : std::numeric_limits<double>::infinity();
  const std::size_t block = sweep.side_by_side,
                    group = sweep.is_chain
                                ? 1
                                : std::max<std::size_t>(block, 2) * most_threads();
  while (next < numbers.size() && missing.empty()) {
    std::vector<double> speeds;
    for (std::size_t k = next; k < std::min(next + group, numbers.size()); ++k)
      speeds.push_back(sweep.speeds[numbers[k]]);
    const double each = std::min(sweep.evaluations_of_one, most - spent);
    const auto blocks =
        computed_in_parallel("", (speeds.size() + block - 1) / block, [&](std::size_t k) {
          const std::size_t first = k * block;
          return ended_at(
              sweep,
              std::span(speeds).subspan(first, std::min(block, speeds.size() - first)),
              each);
        });
    const bool is_short = each < sweep.evaluations_of_one || budget.is_over();
    std::vector<Ended> ended;
    for (const auto& one : blocks) ended.insert(ended.end(), one.begin(), one.end());
    for (auto& [row, cost] : ended) {
      spent += cost;
      const double frequency = sweep.speeds[numbers[next]];
      const bool is_known = row.has_value() && row.get().period != -2;
      if (spent > most || (is_short && !is_known)) {
        missing =
            format("%s: %s is used up at %g Hz; ", request.parameter_file.c_str(),
                   budget.words().c_str(), frequency) +
            (sweep.is_chain ? "more with --budget"
                            : "--resume FILE goes on with the rows that are written");
        break;
      }
      put_known(numbers[next++]);
      try {
        ResponseRow& found = row.get();
        found.frequency = frequency;  // to the last digit, which --resume looks for
        begin();
        table.row(sweep.columns.fields, found);
        if (request.watch)
          request.watch(frequency,
                        Eigen::Map<const Eigen::Vector4d>(found.amplitude.data()));
      } catch (const NoSolution& none) {
        if (lost++ == 0) first_lost = format("at %g Hz: ", frequency) + none.what();
      }
    }
  }
  put_known(sweep.speeds.size());
  if (known.empty() && next == lost)
    throw NoSolution(missing.empty() ? request.parameter_file +
                                           ": no speed has a value, " + first_lost
                                     : missing);
  if (missing.empty() && lost > 0)
    missing = format("%s: %zu of %zu speeds have no value, the first ",
                     request.parameter_file.c_str(), lost, sweep.speeds.size()) +
              first_lost + (sweep.is_chain ? "" : "; --resume FILE tries them again");
  put_complete(table, missing);
  /** Rows that were there already do not say whether a ball touched. */
  if (known.empty() || sweep.touches) put_contact(table, sweep.machine, sweep.touches);
  table.value("evaluations", spent, 3);
  if (is_streamed) table.end_stream();
  return {.table = std::move(table), .unfinished = missing, .is_written = is_streamed};
}

/** Whether anything touches in a motion that was not recorded: where it stands now or,
    where nothing is loaded then, over a few periods, if the budget has these. */
bool touches_somewhere(motion::Answer& answer, const OperationBudget& budget)
try {
  motion::Motion now{1, answer.settled.at.period, {}, {}, answer.omega};
  motion::add(now, answer.settled.at.state);
  if (motion::contact_share(answer.machine, now) > 0) return true;
  complete(answer,
           {.omega = answer.omega, .points = 64, .periods = 4, .is_measured = false},
           budget);
  return motion::contact_share(answer.machine, answer.motion) > 0;
} catch (const NoSolution&) {
  return false;
}

/** The row of a settled motion. */
ResponseRow row_of(motion::Answer& answer, const motion::Observation& seen,
                   const motion::Request& asked, Sweep& sweep,
                   const OperationBudget& budget)
{
  const Measures& measures = sweep.columns.measures;
  ResponseRow row{.frequency = asked.omega / angular(1),
                  .amplitude = seen.amplitude,
                  .period = answer.period_number()};
  if (sweep.has_further) {
    if (asked.is_measured) {
      motion::Answer closed = answer;
      complete(closed, asked, budget);
      row.lyapunov = closed.settled.lyapunov.value;
    }
    answer = whole_motion(measures, answer, asked, budget);
    row.measured = measures.of(record_of(answer));
    if (motion::contact_share(answer.machine, answer.motion) > 0) sweep.touches = true;
    answer.motion = {};
  } else if (!sweep.touches && touches_somewhere(answer, budget)) {
    sweep.touches = true;
  }
  return row;
}

}  // namespace

Exploration settled_response(const ResponseRequest& request)
{
  require_range(request.from, request.to, request.count);
  const std::string direction = request.direction.empty() ? "rest" : request.direction;
  if (direction != "rest" && direction != "up" && direction != "down")
    throw BadInput("--direction " + direction + ": must be rest, up or down");
  if (request.resume && direction != "rest")
    throw BadInput("--resume: not with --direction " + direction +
                   ", where each speed starts from the one before");
  const Parameters machine = machine_of(request, request.from, request.to);
  const Patience patience = machine.bodies->patience();
  Sweep sweep(request, machine, "Frequency response, what the machine does",
              columns_of(request, machine,
                         {{"period", "-",
                           "K base periods; 0 chaotic, -1 quasi-periodic, -2 undecided",
                           &ResponseRow::period}},
                         true),
              direction, patience.speeds, patience.settling);
  if (!sweep.is_chain && machine.bodies->takes_explicit_steps()) sweep.side_by_side = 32;
  sweep.describe(
      machine.bodies->time_method(machine), base_period(machine).words(),
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
        return row_of(answer, all[k].seen.get(), questions[k].request, sweep, budgets[k]);
      }));
    return rows;
  };
  return computed(sweep);
}

Exploration response_to_tolerance(const ResponseTask& task)
{
  const ResponseRequest& request = task.request;
  const double tolerance = *request.tolerance;
  ResponseFields own{
      {"error", "-",
       "of the solution: the larger of the largest difference of a displacement over the "
       "largest displacement and the rms about the mean",
       &ResponseRow::error}};
  own = own + harmonic_fields(task, Harmonics(task.harmonics));
  Sweep sweep(request, task.machine, "Frequency response at evenly spaced speeds",
              columns_of(request, task.machine, own), task.upwards ? "up" : "down",
              task.machine.bodies->patience().speeds, 1);
  sweep.describe("aft", task.base_period,
                 "harmonics and samples chosen for each speed, from the solution before");
  Eigen::VectorXd before;
  const auto row_at = [&](double frequency, const OperationBudget& budget) {
    BalanceSearch search{.parameters = task.parameters,
                         .omega = task.base(frequency),
                         .harmonics = 6,
                         .newton = task.settings.newton,
                         .budget = budget};
    if (before.size() > 0) search.starts = {before};
    const motion::Judged at = motion::to_tolerance(search, tolerance);
    if (!at.reached)
      throw NoSolution(format("tolerance %g not reached: ", tolerance) + at.end);
    before = at.motion.x;
    const Eigen::MatrixXd bodies = at.motion.bodies.topRows<4>();  // x_s … y_r
    ResponseRow row{.frequency = frequency, .error = at.verdict.distance.larger()};
    std::ranges::copy(half_peak_to_peak(bodies), row.amplitude.begin());
    row.harmonics =
        harmonics_of(task, resize_harmonics(bodies.reshaped(), 4, task.harmonics)
                               .reshaped(4, 2 * task.harmonics + 1));
    if (sweep.has_further)
      row.measured = sweep.columns.measures.of(
          task.parameters, at.motion, std::max(256, 4 * at.motion.harmonics.count() + 4));
    if (motion::touches(task.parameters, at.motion)) sweep.touches = true;
    return row;
  };
  sweep.rows_at = [&](std::span<const double> speeds,
                      std::span<const OperationBudget> budgets) -> Rows {
    return {attempt([&] { return row_at(speeds[0], budgets[0]); })};
  };
  return computed(sweep);
}

}  // namespace rotor_stator::explore
