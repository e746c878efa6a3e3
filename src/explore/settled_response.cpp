#include "explore/settled_response.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <utility>

#include "explore/settled_motion.hpp"
#include "io/errors.hpp"
#include "io/output_file.hpp"
#include "io/parallel.hpp"
#include "io/table.hpp"
#include "motion/contact.hpp"

namespace rotor_stator::explore {

namespace {

constexpr int record_points = 256, record_periods = 64;

/** The motion at one speed and what is seen of it. */
struct Row {
  double frequency;  ///< [Hz]
  motion::Answer answer = {.base = {}, .settled = {}};
  motion::Observation seen = {};
  std::vector<Vec2> forces =
      {};                 ///< at the instants of a record, where columns need them
  double ball_load = 0;   ///< [N]
  double spent = 0;       ///< evaluations
  std::string lost = {};  ///< why there is no motion

  double contact_share() const
  {
    const auto loaded =
        std::ranges::count_if(forces, [](Vec2 f) { return f.x != 0 || f.y != 0; });
    return static_cast<double>(loaded) / static_cast<double>(forces.size());
  }
  double force(double Vec2::*axis) const
  {
    const auto [low, high] = std::ranges::minmax_element(forces, {}, axis);
    return 0.5 * ((*high).*axis - (*low).*axis);
  }
};

using Fields = std::vector<Field<Row>>;

template <Displacements motion::Observation::*what, int k>
constexpr auto seen = [](const Row& r) -> Cell { return (r.seen.*what)[k]; };
using Seen = motion::Observation;

const Fields usual_fields{
    {"f", "Hz", "speed of rotation", &Row::frequency},
    {"amp_x_s", "m", "half peak-to-peak of x_s", seen<&Seen::amplitude, 0>},
    {"amp_y_s", "m", "half peak-to-peak of y_s", seen<&Seen::amplitude, 1>},
    {"amp_x_r", "m", "half peak-to-peak of x_r", seen<&Seen::amplitude, 2>},
    {"amp_y_r", "m", "half peak-to-peak of y_r", seen<&Seen::amplitude, 3>},
    {"period", "-", "K base periods; 0 chaotic, -1 quasi-periodic, -2 undecided",
     [](auto& r) { return r.answer.period_number(); }}};

const Fields further_fields{
    {"lyapunov", "1/s", "growth rate of neighbouring motions",
     [](auto& r) { return r.answer.settled.lyapunov.value; }},
    {"mean_x_s", "m", "mean of x_s", seen<&Seen::mean, 0>},
    {"mean_y_s", "m", "mean of y_s", seen<&Seen::mean, 1>},
    {"mean_x_r", "m", "mean of x_r", seen<&Seen::mean, 2>},
    {"mean_y_r", "m", "mean of y_r", seen<&Seen::mean, 3>},
    {"rms_x_s", "m", "rms of x_s about the mean", seen<&Seen::rms, 0>},
    {"rms_y_s", "m", "rms of y_s about the mean", seen<&Seen::rms, 1>},
    {"rms_x_r", "m", "rms of x_r about the mean", seen<&Seen::rms, 2>},
    {"rms_y_r", "m", "rms of y_r about the mean", seen<&Seen::rms, 3>},
    {"amp_F_x", "N", "half peak-to-peak of F_x",
     [](auto& r) { return r.force(&Vec2::x); }},
    {"amp_F_y", "N", "half peak-to-peak of F_y",
     [](auto& r) { return r.force(&Vec2::y); }},
    {"contact_share", "-", "share of the time with a loaded ball", &Row::contact_share},
    {"ball_load", "N", "largest force of a ball", &Row::ball_load}};

/** What the rows have in common. */
struct Plan {
  const ResponseRequest& request;
  Parameters machine;
  std::vector<double> speeds;  ///< [Hz], in the order in which they are computed
  bool is_chain, has_records;
  Table table;

  double evaluations_of_one() const
  {
    return budget_of(std::nullopt, machine.machine->patience().settling, machine).left();
  }
};

Fields fields_of(const Parameters& machine)
{
  Fields fields = usual_fields;
  fields.insert(fields.end(), further_fields.begin(), further_fields.end());
  if (const double pressure = machine.bearing.pressure; pressure > 0)
    fields.push_back(
        {"stress", "N/mm^2", "largest pressure of Hertz under ball_load",
         [=](const Row& r) { return 1e-6 * pressure * std::cbrt(r.ball_load); }});
  return fields;
}

Plan plan_of(const ResponseRequest& request)
{
  require_range(request.from, request.to);
  const std::string direction = request.direction.empty() ? "rest" : request.direction;
  if (direction != "rest" && direction != "up" && direction != "down")
    throw BadInput("--direction " + direction + ": must be rest, up or down");
  if (request.resume && direction != "rest")
    throw BadInput("--resume: not with --direction " + direction +
                   ", where each speed starts from the one before");
  Parameters machine = machine_of(request, request.from, request.to);
  const int count = request.count.value_or(machine.machine->patience().speeds);
  std::vector<double> speeds;
  for (int k = 0; k < count; ++k)
    speeds.push_back(k + 1 == count && count > 1
                         ? request.to
                         : request.from +
                               (request.to - request.from) * k / std::max(1, count - 1));
  if (direction == "down") std::ranges::reverse(speeds);
  Table table("Frequency response, what the machine does", fields_of(machine));
  const bool has_further =
      table.choose(request.columns, usual_fields.size(), request.plot.has_value());
  describe(table, machine);
  const BasePeriod base = base_period(machine);
  table.value("method", machine.machine->time_method());
  table.value("kind", "sweep");
  table.value("base", base.words());
  table.value("direction", direction);
  table.value("speeds", count);
  table.note(
      "amplitudes over the K base periods of a motion that closes, over 256 of "
      "another one");
  return {request,     std::move(machine), std::move(speeds), direction != "rest",
          has_further, std::move(table)};
}

/** From `start`, or from rest without one; `start` becomes the state that is reached. */
Row row_at(const Plan& plan, double frequency, const OperationBudget& budget,
           std::optional<State>* start)
{
  Row row{frequency};
  const double before = budget.left();
  try {
    const motion::Request request{.omega = angular(frequency),
                                  .points = record_points,
                                  .periods = record_periods,
                                  .longest = plan.request.longest,
                                  .is_measured = false};
    row.answer = motion::settled_answer(plan.machine, request, budget.part(0.7),
                                        start && *start ? &**start : nullptr);
    if (start) *start = row.answer.settled.at.state;
    row.seen = motion::observe(row.answer, budget);
    if (plan.has_records) {
      complete(row.answer, request, budget);
      row.forces = motion::bearing_forces(row.answer.machine, row.answer.motion);
      row.ball_load = motion::largest_ball_load(
          row.answer.machine, row.answer.motion,
          std::ssize(row.answer.motion.positions) / row.answer.motion.points_per_period);
    }
  } catch (const NoSolution& none) {
    row.lost = none.what();
    if (start) start->reset();
  }
  row.spent = before - budget.left();
  return row;
}

/** The rows of an interrupted table of the same question, at the first speeds. */
std::vector<std::vector<Cell>> rows_of(const std::string& file,
                                       const std::string& beginning, const Plan& plan)
{
  std::ifstream in = open_file(file, "a response", std::uintmax_t{1} << 40);
  std::stringstream whole;
  whole << in.rdbuf();
  const std::string text = whole.str();
  const auto refuse = [&](const std::string& why) {
    throw BadInput("--resume " + file + ": " + why);
  };
  if (!text.starts_with(beginning)) {
    const std::string writer = writer_of_other_schema(file);
    refuse(writer.empty() ? "was made with other settings"
                          : "was written by " + writer + ", start this response anew");
  }
  std::istringstream lines(text.substr(beginning.size()));
  std::vector<std::vector<Cell>> rows;
  for (std::string line; std::getline(lines, line) && !lines.eof();) {
    if (line.starts_with("#")) break;
    std::vector<Cell> cells;
    std::istringstream words(line);
    for (std::string word; std::getline(words, word, '\t');) {
      const std::optional<double> number = decimal(word);
      if (!number) refuse("has a cell that is no number: " + word);
      cells.emplace_back(*number);
    }
    const std::string speed =
        rows.size() < plan.speeds.size() ? Cell(plan.speeds[rows.size()]).text() : "";
    if (cells.size() != plan.table.printed() || cells.front().text() != speed)
      refuse("holds other points");
    rows.push_back(std::move(cells));
  }
  return rows;
}

}  // namespace

Exploration explore_settled_response(const ResponseRequest& request)
{
  Plan plan = plan_of(request);
  Table& table = plan.table;
  const Fields fields = fields_of(plan.machine);
  std::vector<std::vector<Cell>> known;
  if (request.resume) known = rows_of(*request.resume, table.beginning(), plan);
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
  std::optional<State> state;
  const double most = request.budget.value_or(std::numeric_limits<double>::infinity());
  const std::size_t group = plan.is_chain ? 1 : 2 * most_threads();
  while (next < plan.speeds.size() && missing.empty()) {
    const std::size_t count = std::min(group, plan.speeds.size() - next);
    const double each = std::min(plan.evaluations_of_one(), most - spent);
    const auto rows = computed_in_parallel("", count, [&](std::size_t k) {
      return row_at(plan, plan.speeds[next + k], OperationBudget(each),
                    plan.is_chain ? &state : nullptr);
    });
    for (const Row& row : rows) {
      spent += row.spent;
      if (spent > most || (request.budget && each < plan.evaluations_of_one() &&
                           row.answer.kind() == Kind::undecided)) {
        missing = format(
            "%s: the budget of %.3g evaluations of the force is used up at "
            "%g Hz; --resume FILE goes on with the rows that are written",
            request.parameter_file.c_str(), most, row.frequency);
        break;
      }
      ++next;
      if (!row.lost.empty()) {
        if (lost++ == 0) first_lost = format("at %g Hz: ", row.frequency) + row.lost;
        continue;
      }
      begin();
      table.row(fields, row);
      if (request.watch)
        request.watch(row.frequency,
                      Eigen::Map<const Eigen::Vector4d>(row.seen.amplitude.data()));
    }
  }
  if (next == lost)
    throw NoSolution(missing.empty() ? request.parameter_file +
                                           ": no speed has a value, " + first_lost
                                     : missing);
  if (missing.empty() && lost > 0)
    missing = format("%s: %zu of %zu speeds have no value, the first ",
                     request.parameter_file.c_str(), lost, plan.speeds.size()) +
              first_lost;
  put_complete(table, missing);
  table.value("evaluations", spent, 3);
  if (is_streamed) table.end_stream();
  return {.table = std::move(table), .unfinished = missing, .is_written = is_streamed};
}

}  // namespace rotor_stator::explore
