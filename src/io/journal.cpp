#include "io/journal.hpp"

#include <fstream>
#include <mutex>
#include <optional>
#include <sstream>

#include "io/errors.hpp"
#include "io/parallel.hpp"
#include "io/table.hpp"

namespace rotor_stator
{

namespace
{

using Rows = std::vector<std::optional<Row>>;

/** The rows that a journal holds; none if it belongs to another study. A last line
   without an end was cut off while it was written, and does not count. */
Rows read_journal(const Study& study)
{
  Rows rows(study.pieces);
  std::ifstream in(study.journal);
  std::string line;
  if (!std::getline(in, line) || line != study.stamp) return rows;
  while (std::getline(in, line) && !in.eof()) {
    std::istringstream words(line);
    std::size_t piece;
    if (!(words >> piece) || piece >= study.pieces) continue;
    Row row;
    for (double value; words >> value;) row.push_back(value);
    rows[piece] = std::move(row);
  }
  return rows;
}

std::string journal_line(std::size_t piece, const Row& row)
{
  std::string line = std::to_string(piece);
  for (double value : row) line += format(" %.17g", value);
  return line + "\n";
}

/** The journal written anew: the stamp and the rows that are known, whole lines only. */
std::ofstream begin_journal(const Study& study, const Rows& rows)
{
  std::ofstream out(study.journal);
  out << study.stamp << "\n";
  for (std::size_t piece = 0; piece < rows.size(); ++piece)
    if (rows[piece]) out << journal_line(piece, *rows[piece]);
  if (!out.flush()) throw NoSolution(study.journal + ": cannot be written");
  return out;
}

}  // namespace

std::vector<Row> run_study(const Study& study)
{
  Rows known = read_journal(study);
  std::ofstream journal = begin_journal(study, known);
  std::mutex mutex;
  in_parallel(study.name, study.pieces, [&](std::size_t piece) {
    if (known[piece]) return;
    Row row = study.work(piece);
    const std::lock_guard lock(mutex);
    journal << journal_line(piece, row) << std::flush;
    known[piece] = std::move(row);
  });
  std::vector<Row> rows;
  for (auto& row : known) rows.push_back(std::move(*row));
  return rows;
}

std::string stamp_of(const std::vector<std::string>& files)
{
  std::string stamp = source_revision() + " " + compiler() + " ";
  for (const std::string& file : files) {
    std::ifstream in(file);
    for (std::string word; in >> word;) stamp += word + " ";
  }
  return stamp;
}

}  // namespace rotor_stator
