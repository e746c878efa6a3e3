#include "explore/map_axes.hpp"

#include <algorithm>
#include <cmath>
#include <ranges>
#include <tuple>

#include "explore/balance_motion.hpp"
#include "io/errors.hpp"
#include "io/program.hpp"
#include "io/units.hpp"
#include "model/read_machine.hpp"

namespace rotor_stator::explore {

namespace {

constexpr int most_points = 10'000'000;

std::vector<std::string> parts_of(const std::string& text, char between)
{
  std::vector<std::string> parts;
  for (const auto part : std::views::split(text, between))
    parts.emplace_back(part.begin(), part.end());
  return parts;
}

Axis read_axis(const std::string& option, const std::string& text)
{
  if (text.empty()) return {};
  const auto refuse = [&](const std::string& why) {
    throw BadInput(option + " " + text + ": " + why);
  };
  const auto equals = text.find('=');
  auto parts = parts_of(equals < text.size() ? text.substr(equals + 1) : "", ':');
  const bool logarithmic = parts.size() == 4 && parts.back() == "log";
  if (logarithmic) parts.pop_back();
  if (equals == 0 || parts.size() != 3) refuse("must be KEY=from:to:count[:log]");
  const std::string key = text.substr(0, equals);
  for (const char* speed : {"frequency_rad_per_s", "speed_rad_per_s", "speed", "rpm"})
    if (own_key(key) == speed) refuse("a speed is frequency=600rpm:6000rpm:5");
  std::string unit;
  const auto end = [&](const std::string& word) {
    return key == speed_key ? speed_in_hertz(option, word, unit)
                            : real_number(option, word, -1e300, 1e300);
  };
  const double from = end(parts[0]), to = end(parts[1]);
  const int count = whole_number(option, parts[2], 1, most_points);
  if (count > 1 && from == to) refuse("from and to must differ");
  if (count == 1 && from != to) refuse("one value is KEY=A:A:1");
  if (logarithmic && (from <= 0 || to <= 0)) refuse("log needs from > 0 and to > 0");
  return {key, from, to, static_cast<std::size_t>(count), logarithmic};
}

/** A:B, two whole numbers. */
void read_lines(const std::string& text, Grid& grid)
{
  grid.last = grid.lines();
  if (text.empty()) return;
  const auto parts = parts_of(text, ':');
  if (parts.size() != 2) throw BadInput("--lines " + text + ": must be A:B");
  const int most = static_cast<int>(std::min<std::size_t>(grid.lines(), most_points));
  const int first = whole_number("--lines", parts[0], 0, most - 1);
  grid.first = first;
  grid.last = whole_number("--lines", parts[1], first + 1, most);
}

Grid grid_of(const MapRequest& request)
{
  if (request.list && !request.y.empty())
    throw BadInput("--y: not together with --list, whose rows stand for its lines");
  if (!request.list && request.x.empty() && request.y.empty())
    throw BadInput("--x: is missing; give --x, --y or --list");
  Grid grid{read_axis("--x", request.x), read_axis("--y", request.y)};
  if (request.list) grid.list.emplace(*request.list);
  read_lines(request.lines, grid);
  auto keys = grid.keys();
  std::ranges::sort(keys);
  if (const auto twice = std::ranges::adjacent_find(keys); twice != keys.end())
    throw BadInput(*twice + ": is given twice, in --x, --y or --list");
  return grid;
}

/** The speeds [Hz] of --sweep A:B[:COUNT], none without it. */
std::vector<double> swept_speeds(const std::string& text)
{
  if (text.empty()) return {};
  const auto parts = parts_of(text, ':');
  if (parts.size() != 2 && parts.size() != 3)
    throw BadInput("--sweep " + text + ": must be A:B or A:B:COUNT");
  std::string unit;
  const double from = speed_in_hertz("--sweep", parts[0], unit),
               to = speed_in_hertz("--sweep", parts[1], unit);
  const int count =
      parts.size() == 3 ? whole_number("--sweep", parts[2], 2, 100000) : 101;
  if (from >= to) throw BadInput("--sweep " + text + ": A must be below B");
  return evenly_spaced(from, to, count);
}

/** What is wrong with a machine, with the axis whose key it names. */
BadInput of_axis(const MapTask& task, const std::string& why)
{
  for (const auto& [option, axis, text] :
       {std::tuple{"--x ", &task.grid.x, &task.request.x},
        {"--y ", &task.grid.y, &task.request.y}})
    if (const std::string& key = axis->key;
        !key.empty() && key != speed_key && why.find(own_key(key)) != why.npos)
      return BadInput(option + *text + ": " + why);
  return BadInput(why);
}

/** Throws BadInput for a key without its table, with those that take its last value. */
void require_tables(const MapTask& task)
{
  const auto values = task.grid.values(task.grid.lines() - 1, task.grid.x.count - 1);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::string& key = task.keys[k];
    if (key == speed_key || key.find('.') != key.npos) continue;
    std::string known;
    for (const std::string& table : task.file.keys()) try {
        task.read({{table + "." + key, values[k]}}, task.request.frequency.value_or(0));
        known += (known.empty() ? "; did you mean " : " or ") + table + "." + key;
      } catch (const BadInput&) {
      }
    if (!known.empty())
      throw of_axis(task, own_key(key) + " is not a known key here" + known + "?");
  }
}

}  // namespace

double Axis::at(std::size_t k) const
{
  if (k == 0 || count == 1) return from;
  if (k + 1 == count) return to;
  const double share = static_cast<double>(k) / static_cast<double>(count - 1);
  return logarithmic ? from * std::pow(to / from, share) : from + (to - from) * share;
}

std::vector<std::string> Grid::keys() const
{
  std::vector<std::string> all;
  for (const Axis& axis : {x, y})
    if (!axis.key.empty()) all.push_back(axis.key);
  if (list) all.insert(all.end(), list->names().begin(), list->names().end());
  return all;
}

std::vector<double> Grid::values(std::size_t line, std::size_t k) const
{
  std::vector<double> all;
  if (!x.key.empty()) all.push_back(x.at(k));
  if (!y.key.empty()) all.push_back(y.at(line));
  if (list) all.insert(all.end(), list->row(line).begin(), list->row(line).end());
  return all;
}

std::pair<Parameters, double> MapTask::machine(const std::vector<double>& values) const
{
  double frequency = request.frequency.value_or(0);
  std::vector<std::pair<std::string, double>> changes;
  for (std::size_t k = 0; k < keys.size(); ++k)
    if (keys[k] != speed_key)
      changes.emplace_back(keys[k], values[k]);
    else if (frequency = values[k]; !(frequency >= 1e-300 && frequency <= 1e300))
      throw BadInput(
          format("%s: must be a positive speed in Hz, got %g", speed_key, frequency));
  return {read(changes, frequency), frequency};
}

Parameters MapTask::read(const std::vector<std::pair<std::string, double>>& changes,
                         double frequency) const
{
  ModelRange range{.harmonics = std::max(64, harmonics)};
  if (frequency > 0) range.from = range.to = frequency;
  if (!sweep.empty()) {
    range.from = frequency > 0 ? std::min(frequency, sweep.front()) : sweep.front();
    range.to = std::max(frequency, sweep.back());
  }
  return read_machine(file.with(changes, excludes), range);
}

double MapTask::highest_speed() const
{
  double most = sweep.empty() ? request.frequency.value_or(0) : sweep.back();
  for (const Axis* axis : {&grid.x, &grid.y})
    if (axis->key == speed_key) most = std::max(axis->from, axis->to);
  const bool is_listed = grid.list && grid.x.key != speed_key && has_speed();
  for (std::size_t k = 0; is_listed && k < grid.list->rows(); ++k)
    most = std::max(most, grid.list->at(k, speed_key));
  return most;
}

MapTask task_of(const MapRequest& request)
{
  Grid grid = grid_of(request);
  const int harmonics = request.harmonics.value_or(usual_harmonics);
  const MapTask task{request,
                     grid,
                     StrictToml(request.parameter_file),
                     grid.keys(),
                     swept_speeds(request.sweep),
                     harmonics,
                     checked_samples(harmonics, request.samples)};
  if (task.has_speed() && request.frequency)
    throw BadInput("--frequency: is a key of the map already");
  if (request.tolerance && request.harmonics)
    throw BadInput("--tolerance: chooses the harmonics; with --harmonics ask for error");
  if (request.tolerance && request.samples)
    throw BadInput("--samples: chosen with m for --tolerance");
  require_tables(task);
  /** The corners, so that an unknown key or a range that no machine has is refused at
      once. */
  const std::size_t top = grid.list ? 0 : grid.lines() - 1;
  for (const std::size_t line : {std::size_t{0}, top})
    for (const std::size_t k : {std::size_t{0}, grid.x.count - 1}) try {
        task.machine(grid.values(line, k));
      } catch (const BadInput& error) {
        throw of_axis(task, error.what());
      }
  return task;
}

}  // namespace rotor_stator::explore
