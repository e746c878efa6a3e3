#include "explore/runup.hpp"

#include <algorithm>

#include "explore/spectrum.hpp"
#include "io/errors.hpp"
#include "motion/run_up.hpp"

namespace rotor_stator::explore {

namespace {

using Turn = const motion::PassedTurn&;

const std::vector<Field<motion::PassedTurn>> fields{
    {"f", "Hz", "speed of rotation in the middle of the turn",
     [](Turn t) { return t.speed / angular(1); }},
    {"t", "s", "time of that middle, from the start of the run",
     &motion::PassedTurn::time},
    {"amp_x_s", "m", "half of the largest less the smallest x of the stator in the turn",
     [](Turn t) { return t.amplitude[0]; }},
    {"amp_y_s", "m", "the same of y", [](Turn t) { return t.amplitude[1]; }},
    {"amp_x_r", "m", "of the rotor's x", [](Turn t) { return t.amplitude[2]; }},
    {"amp_y_r", "m", "of the rotor's y", [](Turn t) { return t.amplitude[3]; }},
    {"contact_share", "-", "share of the turn with contact",
     &motion::PassedTurn::contact},
    {"force", "N", "largest force of the bearing in the turn",
     &motion::PassedTurn::force}};

}  // namespace

Exploration explore_runup(const RunUpRequest& request)
{
  Table table("Run-up or coast-down, turn by turn", fields);
  table.choose(request.columns, fields.size(), request.plot.has_value());
  if (request.from == request.to)
    throw BadInput(format("--from %g: must differ from --to", request.from));
  const double turns = 0.5 * (request.from + request.to) * request.seconds;
  if (!(turns <= most_rows))
    throw BadInput(format("--seconds %g: would be %.3g turns, more than %d",
                          request.seconds, turns, most_rows));
  motion::Stretches stretches;
  if (request.waterfall && turns < stretches.turns)
    throw BadInput(
        format("--waterfall: needs %d turns, the run has %.3g", stretches.turns, turns));
  const Parameters machine = machine_of(request, std::min(request.from, request.to),
                                        std::max(request.from, request.to));
  const OperationBudget budget = budget_of(request, 60, machine);
  const motion::RunUp run{angular(request.from), angular(request.to), request.seconds};
  Table lines("Lines of a run-up or coast-down", line_columns);
  if (request.waterfall) {
    describe(lines, machine);
    lines.note(
        format("of %d turns each; the change of speed widens them", stretches.turns));
    stretches.seen = [&lines, bearings = bearings_of(machine)](
                         double speed, const motion::Motion& motion) {
      constexpr int passages = 16;
      constexpr double smallest = 1e-4, near = 0.6;
      add_lines(lines, bearings, speed / angular(1),
                lines_of_recorded(bearings, motion, near, 0.1 * smallest), passages,
                smallest);
    };
  }
  std::vector<motion::PassedTurn> all;
  std::string missing;
  try {
    motion::run_up(machine, run, all, budget, stretches);
  } catch (const NoSolution& none) {
    if (all.empty()) throw;
    missing = machine.file + ": " + none.what();
  }
  if (all.empty())
    throw BadInput(format("--seconds %g: is less than a turn", request.seconds));
  describe(table, machine);
  table.value("method", "rk4");
  table.value("kind", "runup");
  table.value("from", request.from);
  table.value("to", request.to);
  table.value("seconds", request.seconds);
  table.value("acceleration", (request.to - request.from) / request.seconds);
  table.note("acceleration in Hz/s; the drive that turns the rotor is not modelled");
  table.note(request.from > 0 ? "begins on the motion that the machine has at --from"
                              : "begins at rest");
  const auto peak =
      std::ranges::max_element(all, {}, [](Turn t) { return t.amplitude[2]; });
  table.value("peak_x_r", peak->amplitude[2]);
  table.value("peak_f", peak->speed / angular(1));
  const auto lost = std::ranges::find_if(all, [](Turn t) { return t.contact < 1; });
  if (lost != all.end()) table.value("contact_lost_f", lost->speed / angular(1));
  for (Turn turn : all) table.row(fields, turn);
  put_complete(table, missing);
  conclude(table, machine, std::ranges::any_of(all, [](Turn t) { return t.contact > 0; }),
           budget);
  Exploration found{.table = std::move(table), .unfinished = missing};
  if (request.waterfall) found.files.push_back({*request.waterfall, lines.text()});
  return found;
}

}  // namespace rotor_stator::explore
