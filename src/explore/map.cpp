#include "explore/map.hpp"

#include <omp.h>
#include <algorithm>
#include <condition_variable>
#include <map>
#include <mutex>

#include "explore/map_quantities.hpp"
#include "explore/plot.hpp"
#include "explore/resume.hpp"
#include "io/errors.hpp"
#include "io/parallel.hpp"
#include "io/program.hpp"

namespace rotor_stator::explore {

namespace {

/**
## The header */

void put_method(Table& table, const MapTask& task)
{
  const MapRequest& request = task.request;
  table.value("method", request.method);
  if (request.method != "aft")
    return table.note(
        format("longest step %g s (0: from K_H), transient at most %g s after t = 0",
               request.step, request.longest));
  if (request.tolerance && !request.harmonics)
    return table.note("harmonics: chosen for the tolerance");
  table.value("harmonics", task.harmonics);
  table.value("samples", task.samples);
  table.note(format("relative tolerance of Newton %g", request.newton_tolerance));
}

std::string header_of(const MapTask& task, const std::vector<Quantity>& chosen)
{
  const MapRequest& request = task.request;
  std::vector<Column> columns;
  for (const std::string& key : task.keys)
    columns.push_back({key, key == speed_key ? "Hz" : "see key",
                       key == speed_key ? "speed of rotation" : "of the parameter file"});
  columns.insert(columns.end(), chosen.begin(), chosen.end());
  columns.push_back(
      {"status", "word", "ok, or why a quantity is missing, which is then -"});
  Table table("Map of a machine", columns);
  const Parameters base = task.read({}, request.frequency.value_or(0));
  describe(table, base);
  table.row_line("keys", {task.keys.begin(), task.keys.end()});
  for (const auto& [name, text] : {std::pair{"x", request.x}, {"y", request.y}})
    if (!text.empty()) table.note(format("--%s ", name) + text);
  if (request.list) table.note("--list " + *request.list);
  if (request.frequency) table.value("frequency", *request.frequency);
  if (!task.sweep.empty()) {
    table.value("sweep_count", task.sweep.size());
    table.value("sweep_from", task.sweep.front());
    table.value("sweep_to", task.sweep.back());
  }
  const auto from_rest = [](const Quantity& q) { return q.source == Source::rest; };
  if (std::ranges::any_of(chosen, from_rest))
    table.note("motion from rest: as explore orbit settles it");
  if (!std::ranges::all_of(chosen, from_rest)) put_method(table, task);
  if (request.tolerance) table.value("tolerance", *request.tolerance);
  table.value("budget", budget_of_each(request.budget, seconds_of_a_point, base).most(),
              6);
  table.note("budget: evaluations of the force for each point");
  return table.text();
}

/**
## The rows */

bool is_lost(const std::string& row)
{
  return !row.ends_with(std::string("\t") + all_well);
}

/** Throws BadInput unless a row could be that of the point. */
void require_row(const InterruptedTable& old, const std::vector<Quantity>& chosen,
                 const std::vector<double>& values, const std::vector<std::string>& cells)
{
  const std::size_t keys = values.size();
  for (std::size_t k = 0; k < keys; ++k)
    if (k >= cells.size() || cells[k] != Cell(values[k]).text())
      old.refuse("holds other points");
  if (cells.size() != keys + chosen.size() + 1)
    old.refuse(format("has a row of %zu cells, where %zu are needed", cells.size(),
                      keys + chosen.size() + 1));
  bool is_complete = true;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const std::string& cell = cells[keys + k];
    const bool is_word =
        chosen[k].unit == "word" && !cell.empty() &&
        cell.find_first_not_of("abcdefghijklmnopqrstuvwxyz-") == std::string::npos;
    if (cell == no_value)
      is_complete = false;
    else if (!is_word && !(chosen[k].unit != "word" && number_of(cell)))
      old.refuse("'" + cell.substr(0, 40) + "' is no value of " + chosen[k].name);
  }
  if (cells.back().empty() || (cells.back() == all_well) != is_complete)
    old.refuse("the status of a row does not fit its cells");
}

/** Rows in order of their lines, written as soon as all before them are there. */
class Output {
public:
  Output(const MapTask& task, const std::vector<Quantity>& chosen)
      : task_(task), next_(task.grid.first)
  {
    const std::string header = header_of(task, chosen);
    if (task.request.resume)
      copy(*task.request.resume, header, chosen);
    else
      print(header);
  }

  std::size_t next() const { return next_; }

  /** Waits until the line is not too far ahead of the first that is missing: what is kept is bounded. */
  void wait_for_turn(std::size_t line)
  {
    constexpr std::size_t most_ahead = 256;
    std::unique_lock lock(mutex_);
    moved_.wait(lock, [&] { return stopped_ || line < next_ + most_ahead; });
  }

  void take(std::size_t line, std::string rows, std::size_t failed)
  {
    const std::lock_guard lock(mutex_);
    failed_ += failed;
    waiting_.emplace(line, std::move(rows));
    while (!waiting_.empty() && waiting_.begin()->first == next_) {
      print(waiting_.begin()->second);
      waiting_.erase(waiting_.begin());
      ++next_;
    }
    moved_.notify_all();
  }

  void stop()
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    moved_.notify_all();
  }

  std::size_t failed() const { return failed_; }
  const std::string& all() const { return all_; }

private:
  void print(const std::string& text)
  {
    write(text);
    if (task_.request.plot) all_ += text;
  }

  /** The whole lines of x of an interrupted table, after all of it was looked at. */
  void copy(const std::string& file, const std::string& header,
            const std::vector<Quantity>& chosen)
  {
    InterruptedTable old(file, "map", header);
    const Grid& grid = task_.grid;
    const std::size_t count = grid.x.count, most = (grid.last - grid.first) * count;
    std::size_t rows = 0;
    old.each_row([&](const std::string&, const std::vector<std::string>& cells) {
      if (rows == most) old.refuse("holds other points");
      require_row(old, chosen, grid.values(grid.first + rows / count, rows % count),
                  cells);
      ++rows;
    });
    print(header);
    next_ += rows / count;
    std::size_t left = rows / count * count;
    old.each_row([&](const std::string& row, const std::vector<std::string>&) {
      if (left == 0) return;
      --left;
      failed_ += is_lost(row);
      print(row + "\n");
    });
  }

  const MapTask& task_;
  std::mutex mutex_;
  std::condition_variable moved_;
  bool stopped_ = false;
  std::map<std::size_t, std::string> waiting_;
  std::size_t next_, failed_ = 0;
  std::string all_;
};

/** Computes one line of x. Throws NoSolution when the seconds of the run are over. */
void add_line(const MapTask& task, const std::vector<Quantity>& chosen, std::size_t line,
              Output& output)
{
  output.wait_for_turn(line);
  std::string rows;
  std::size_t failed = 0;
  PeriodicMotion before;
  for (std::size_t k = 0; k < task.grid.x.count; ++k) {
    const std::string row = row_of(task, chosen, task.grid.values(line, k), before);
    if (task.request.budget && task.request.budget->is_over())
      throw NoSolution(format(
          "%s: %s is used up; --resume FILE goes on with the rows "
          "that are written",
          task.request.parameter_file.c_str(), task.request.budget->words().c_str()));
    failed += is_lost(row);
    rows += row + "\n";
  }
  output.take(line, std::move(rows), failed);
}

}  // namespace

void explore_map(const MapRequest& request)
{
  const MapTask task = task_of(request);
  const std::vector<Quantity> chosen = chosen_quantities(task);
  if (request.threads > 0) omp_set_num_threads(request.threads);
  Output output(task, chosen);
  const std::size_t first = output.next(), last = task.grid.last;
  in_parallel(request.quiet ? "" : "lines", last - first, [&](std::size_t piece) {
    try {
      add_line(task, chosen, first + piece, output);
    } catch (...) {
      output.stop();
      throw;
    }
  });
  if (output.failed() > 0)
    std::fprintf(stderr, "%zu of %zu points have no result: see their status\n",
                 output.failed(), (last - task.grid.first) * task.grid.x.count);
  if (!request.plot) return;
  const std::string undrawn = plot(*request.plot, "map.py", output.all());
  if (!undrawn.empty()) throw NoSolution(undrawn);
}

}  // namespace rotor_stator::explore
