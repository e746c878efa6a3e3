#include "explore/campbell.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "explore/modes.hpp"
#include "io/errors.hpp"

namespace rotor_stator::explore {

namespace {

const char* word(Whirl whirl)
{
  constexpr const char* words[] = {"backward", "planar", "forward", "mixed"};
  return words[static_cast<int>(whirl) + 1];
}

/** Where the frequency of a mode is that of the order, between two speeds at which their
    differences have other signs, by bisection with secants. */
double critical_speed(const LinearMachine& machine, double order, std::size_t mode,
                      double low, double high, double at_low, double at_high)
{
  for (int step = 0; step < 30 && high - low > 1e-9 * high; ++step) {
    double middle = step % 3 == 2 ? (low + high) / 2
                                  : low + (high - low) * at_low / (at_low - at_high);
    middle = std::clamp(middle, low + 1e-3 * (high - low), high - 1e-3 * (high - low));
    const auto modes = machine.modes(middle, mode + 1);
    const double found = mode < modes.size() ? modes[mode].frequency - order * middle : 0;
    const bool is_low = (found > 0) == (at_low > 0);
    (is_low ? low : high) = middle;
    (is_low ? at_low : at_high) = found;
  }
  return (low + high) / 2;
}

std::vector<Column> columns_of(bool critical)
{
  if (critical)
    return {{"f", "Hz", "critical speed of rotation"},
            {"line", "word", "what meets the mode: 1X, or the passing balls"},
            {"mode", "-", "by frequency at that speed, from 1"},
            {"frequency", "Hz", "of the mode there"},
            {"damping", "-", "ratio to critical damping"},
            {"whirl", "word",
             "forward, backward, planar; mixed: forward at some places only"}};
  return {{"f", "Hz", "speed of rotation"},
          {"mode", "-", "by frequency at this speed, from 1"},
          {"frequency", "Hz", "of the damped mode"},
          {"damping", "-", "ratio to critical damping"},
          {"whirl", "-",
           "1 forward, -1 backward, 0 planar, 2 mixed: forward at some places only"}};
}

}  // namespace

Exploration explore_campbell(const CampbellRequest& request)
{
  if (request.count > 1)
    require_range(request.from, request.to);
  else if (request.from != request.to || request.critical || request.plot)
    throw BadInput(
        "--count 1: is for --from equal to --to, without --critical and --plot");
  if (request.critical && request.plot)
    throw BadInput("--plot: draws frequencies; leave out --critical");
  const Parameters parameters =
      machine_of(request, request.from, request.to, {.largest = largest_linear});
  const OperationBudget budget = budget_of(request, 60, parameters);
  const LinearMachine linear(parameters, budget, request.from);
  const Eigen::MatrixXd& stiffness = linear.contact();
  const std::vector<Bearing> bearings = bearings_of(parameters);
  const auto columns = columns_of(request.critical);
  Table table(request.critical ? "Critical speeds of the linear machine"
                               : "Whirl frequencies against speed (Campbell)",
              columns);
  table.choose(request.columns, columns.size(), request.plot.has_value());
  describe(table, parameters);
  for (Eigen::Index k = 0; k < 2 * std::ssize(bearings); k += 2)
    table.row_line("bearing", {k / 2 + 1, stiffness(k, k), stiffness(k, k + 1),
                               stiffness(k + 1, k + 1)});
  table.note(
      "row bearing: mean stiffness xx, xy, yy [N/m] of contact and elements beside it, "
      "at --from; 0: no contact at rest");
  if (leaves_damping_out(parameters)) table.note("damping of the contact is left out");
  std::vector<std::pair<double, std::string>> orders{{1, "1X"}};
  for (std::size_t number = 0; const Bearing& bearing : bearings) {
    const double value = passages_per_turn(bearing);
    const auto is_same = [&](auto& one) { return std::abs(value - one.first) <= 1e-9; };
    if (std::ranges::none_of(orders, is_same))
      orders.emplace_back(value, numbered("BPFO", number));
    ++number;
  }
  for (const auto& [value, name] : orders) table.row_line("order", {name, value});
  const auto speeds = evenly_spaced(request.from, request.to, request.count);
  std::vector<std::vector<Mode>> modes;
  std::string warning, unfinished;
  try {
    for (const double speed : speeds) {
      modes.push_back(linear.modes(speed, request.modes));
      for (int number = 1; const Mode& mode : modes.back()) {
        if (warning.empty()) warning = doubt(mode);
        if (!request.critical)
          table.row({speed, number++, mode.frequency, mode.damping, mode.whirl});
      }
    }
    for (const auto& [value, name] : orders)
      for (std::size_t k = 1; k < speeds.size(); ++k)
        for (std::size_t i = 0; i < std::min(modes[k - 1].size(), modes[k].size()); ++i) {
          const double a = modes[k - 1][i].frequency - value * speeds[k - 1],
                       b = modes[k][i].frequency - value * speeds[k];
          if ((a > 0) == (b > 0)) continue;
          const double at =
              critical_speed(linear, value, i, speeds[k - 1], speeds[k], a, b);
          const auto there = linear.modes(at, i + 1);
          /** None where mode i ends, or another one takes its place. */
          constexpr double meets = 1e-3;
          if (there.size() <= i ||
              std::abs(there[i].frequency - value * at) > meets * value * at)
            continue;
          const Mode& mode = there[i];
          if (request.critical)
            table.row({at, name, i + 1, mode.frequency, mode.damping, word(mode.whirl)});
          else
            table.row_line("critical_speed", {at, name, i + 1, word(mode.whirl)});
        }
  } catch (const NoSolution& used_up) {
    if (modes.empty()) throw;
    unfinished = used_up.what();
  }
  if (std::ranges::all_of(modes, &std::vector<Mode>::empty))
    throw NoSolution(
        format("no mode oscillates from %g to %g Hz", request.from, request.to));
  if (!warning.empty()) table.note("warning: " + warning);
  put_complete(table, unfinished);
  put_cost(table, budget);
  return {.table = std::move(table), .unfinished = unfinished};
}

}  // namespace rotor_stator::explore
