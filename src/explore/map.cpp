#include "explore/map.hpp"

#include <omp.h>
#include <algorithm>
#include <map>
#include <mutex>

#include "explore/map_quantities.hpp"
#include "explore/plausible.hpp"
#include "explore/resume.hpp"
#include "io/errors.hpp"
#include "io/parallel.hpp"

namespace rotor_stator::explore {

namespace {

/**
## The header */

void put_method(Table& table, const MapTask& task, bool is_integrated)
{
  const MapRequest& request = task.request;
  table.value("method", request.method);
  if (is_integrated)
    table.note("longest step of rk4, a fourth of one of splitting: " +
               (request.step > 0 ? format("%.15g s", request.step)
                                 : std::string("from K_H and --tolerance")) +
               "; transient " +
               (request.longest > 0
                    ? format("at most %.15g s after t = 0", request.longest)
                    : std::string("until it is over")));
  if (request.method != "aft") return;
  table.note(format("relative tolerance of Newton %.15g", request.newton_tolerance));
  if (request.tolerance) return table.note("harmonics: chosen for the tolerance");
  table.value("harmonics", task.harmonics);
  table.value("samples", task.samples);
}

/** What the first and the last point add to the doubts of the machine. */
void doubt_corners(const MapTask& task, Parameters& machine)
{
  const auto is_speed = [](const std::string& key) { return key == speed_key; };
  if (std::ranges::all_of(task.keys, is_speed)) return;  // the same machine everywhere
  for (const bool is_last : {false, true}) {
    const auto values = task.grid.values(is_last ? task.grid.last - 1 : task.grid.first,
                                         is_last ? task.grid.x.count - 1 : 0);
    for (const std::string& doubt : doubts(task.machine(values).first, 0))
      if (std::ranges::find(machine.doubts, doubt) == machine.doubts.end())
        machine.doubts.push_back(doubt);
  }
}

Table header_of(const MapTask& task, const std::vector<Quantity>& chosen)
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
  Parameters base =
      doubted(task.read({}, request.frequency.value_or(0)), task.highest_speed());
  doubt_corners(task, base);
  describe(table, base);
  table.row_line("keys", {task.keys.begin(), task.keys.end()});
  for (const auto& [name, text] : {std::pair{"x", request.x}, {"y", request.y}})
    if (!text.empty()) table.note(format("--%s ", name) + text);
  if (request.list) table.note("--list '" + *request.list + "'");
  if (request.frequency) table.value("frequency", *request.frequency);
  if (!task.sweep.empty()) {
    table.value("sweep_count", task.sweep.size());
    table.value("sweep_from", task.sweep.front());
    table.value("sweep_to", task.sweep.back());
  }
  const auto from_rest = [](const Quantity& q) { return q.source == Source::rest; };
  const bool has_rest = std::ranges::any_of(chosen, from_rest);
  if (has_rest) table.note("motion from rest: as explore orbit settles it");
  put_method(table, task, has_rest || request.method != "aft");
  if (request.tolerance) table.value("tolerance", *request.tolerance);
  table.value("budget", budget_of_each(request.budget, seconds_of_a_point, base).most(),
              6);
  table.note("budget: evaluations of the force for each point");
  return table;
}

/**
## The rows */

constexpr std::size_t side_by_side = 64, widest_lanes = 8;  // points

bool is_lost(const std::string& row)
{
  return !row.ends_with(std::string("\t") + all_well);
}

/** Throws BadInput unless a row could be that of the point. */
void require_row(const std::vector<Quantity>& chosen, const std::vector<double>& values,
                 const std::vector<std::string>& cells)
{
  const std::size_t keys = values.size(), wanted = keys + chosen.size() + 1;
  for (std::size_t k = 0; k < keys; ++k)
    if (k >= cells.size() || cells[k] != Cell(values[k]).text())
      throw BadInput("holds other points");
  if (cells.size() != wanted)
    throw BadInput(
        format("has a row of %zu cells, where %zu are needed", cells.size(), wanted));
  bool is_complete = true;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const std::string& cell = cells[keys + k];
    const bool is_value =
        chosen[k].unit == "word"
            ? cell.find_first_not_of("abcdefghijklmnopqrstuvwxyz-") == std::string::npos
            : number_of(cell).has_value();
    if (cell == no_value)
      is_complete = false;
    else if (!is_value || cell.empty())
      throw BadInput("'" + cell.substr(0, 40) + "' is no value of " + chosen[k].name);
  }
  if (cells.back().empty() || (cells.back() == all_well) != is_complete)
    throw BadInput("the status of a row does not fit its cells");
}

/** The rows in order. Pieces of them are computed at once: whole lines of x where the
    points of a line start from each other; each is written as soon as all before it are
    there. */
class Output {
public:
  Output(const MapTask& task, const std::vector<Quantity>& chosen,
         const std::string& header)
      : task_(task), chosen_(chosen), points_(task.grid.x.count),
        rows_((task.grid.last - task.grid.first) * points_),
        of_piece_(task.request.method == "aft"      ? points_
                  : task.request.budget.seconds > 0 ? std::min(widest_lanes, points_)
                                                    : std::min(side_by_side, points_))
  {
    if (task.request.resume)
      copy(*task.request.resume, header);
    else
      print(header);
  }

  /** Computes a piece. Throws NoSolution when the seconds of the run are over. */
  void add(std::size_t piece)
  {
    std::string text;
    std::size_t failed = 0;
    PeriodicMotion before;
    std::vector<std::vector<double>> block;
    const std::size_t begin = piece * of_piece_, end = std::min(begin + of_piece_, rows_);
    for (std::size_t row = begin; row < end; ++row) {
      block.push_back(values(row));
      if (block.size() < side_by_side && row + 1 < end) continue;
      const auto found = rows_of(task_, chosen_, block, before);
      block.clear();
      if (task_.request.budget.is_over())
        throw NoSolution(
            task_.request.parameter_file + ": " + task_.request.budget.words() +
            " is used up; --resume FILE goes on with the rows that are written");
      for (const std::string& one : found) {
        failed += is_lost(one);
        text += one + "\n";
      }
    }
    const std::lock_guard lock(mutex_);
    failed_ += failed;
    waiting_[piece] = std::move(text);
    for (; !waiting_.empty() && waiting_.begin()->first == next_; ++next_) {
      print(waiting_.begin()->second);
      waiting_.erase(waiting_.begin());
    }
  }

  std::size_t next() const { return next_; }
  std::size_t pieces() const { return (rows_ + of_piece_ - 1) / of_piece_; }
  std::size_t rows() const { return rows_; }
  std::size_t failed() const { return failed_; }
  const std::string& all() const { return all_; }

private:
  std::vector<double> values(std::size_t row) const
  {
    return task_.grid.values(task_.grid.first + row / points_, row % points_);
  }

  void print(const std::string& text)
  {
    write(text);
    if (task_.request.plot) all_ += text;
  }

  /** The whole pieces of an interrupted table, after all of it was looked at. */
  void copy(const std::string& file, const std::string& header)
  {
    std::size_t rows = 0;
    each_row_of(file, "map", header, [&](const std::string&, const auto& cells) {
      if (rows == rows_) throw BadInput("holds other points");
      require_row(chosen_, values(rows++), cells);
    });
    print(header);
    next_ = rows == rows_ ? pieces() : rows / of_piece_;
    rows = std::min(next_ * of_piece_, rows_);
    each_row_of(file, "map", header, [&](const std::string& row, const auto&) {
      if (rows == 0) return;
      --rows;
      failed_ += is_lost(row);
      print(row + "\n");
    });
    if (rows > 0) throw BadInput("--resume " + file + ": changed while it was read");
  }

  const MapTask& task_;
  const std::vector<Quantity>& chosen_;
  const std::size_t points_, rows_, of_piece_;  ///< on a line, in all, in a piece
  std::mutex mutex_;
  std::map<std::size_t, std::string> waiting_;
  std::size_t next_ = 0, failed_ = 0;
  std::string all_;
};

}  // namespace

Exploration explore_map(const MapRequest& request)
{
  const MapTask task = task_of(request);
  const std::vector<Quantity> chosen = chosen_quantities(task);
  if (request.threads > 0) omp_set_num_threads(request.threads);
  const Table header = header_of(task, chosen);
  Output output(task, chosen, header.text());
  const std::size_t first = output.next();
  in_parallel(request.quiet ? "" : "parts of the map", output.pieces() - first,
              [&](std::size_t piece) { output.add(first + piece); });
  const std::string failed = format("%zu of %zu points have no result: see their status",
                                    output.failed(), output.rows());
  const bool is_empty = output.failed() == output.rows();
  if (output.failed() > 0 && !is_empty) std::fprintf(stderr, "%s\n", failed.c_str());
  return {.table = header,
          .unfinished = is_empty ? request.parameter_file + ": " + failed : "",
          .drawn = output.all(),
          .is_written = true};
}

}  // namespace rotor_stator::explore
