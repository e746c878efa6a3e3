#include "hard/outcome.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace rotor_stator::tests
{

namespace
{

/** Whether nan or inf stands somewhere as a word. */
bool has_no_number(const std::string& text)
{
  std::string word;
  for (char c : text + " ") {
    if (std::isalnum(static_cast<unsigned char>(c))) {
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      continue;
    }
    if (word == "nan" || word == "inf" || word == "infinity") return true;
    word.clear();
  }
  return false;
}

/** What is wrong with a table; empty when every row has as many finite numbers as there are names. */
std::string table_problem(const std::string& table)
{
  std::istringstream lines(table);
  long columns = 0, rows = 0;
  for (std::string line; std::getline(lines, line);) {
    /** The title is the reader's, the flags may name NaN. */
    if (line.starts_with("# parameters:") || line.starts_with("# compiler:")) continue;
    if (has_no_number(line)) return "not finite: " + line;
    if (line.empty() || line.starts_with("#")) continue;  // empty between two branches
    const long cells = 1 + std::count(line.begin(), line.end(), '\t');
    if (columns == 0)
      columns = cells;
    else if (cells != columns)
      return "cells of row " + std::to_string(rows) + ": " + line;
    else
      ++rows;
  }
  return rows > 0 ? "" : "no rows";
}

bool is_one_line(const std::string& text)
{
  return text.size() > 1 && std::count(text.begin(), text.end(), '\n') == 1 &&
         text.back() == '\n';
}

}  // namespace

std::string problem(const LimitedOutcome& outcome)
{
  if (outcome.signal != 0) return "signal " + std::to_string(outcome.signal);
  const bool help =
      outcome.out.starts_with("Explores") || outcome.out.find("Usage:") < 200;
  switch (outcome.status) {
    case 0:
      if (!outcome.err.empty()) return "status 0 with words on stderr";
      return help ? "" : table_problem(outcome.out);
    case 2:
      if (!outcome.out.empty()) return "status 2 with words on stdout";
      return is_one_line(outcome.err) ? "" : "status 2 without one line on stderr";
    case 3:
      if (!is_one_line(outcome.err)) return "status 3 without one line on stderr";
      if (has_no_number(outcome.err))
        return "status 3 with a reason that is not a number";
      return outcome.out.empty() ? "" : table_problem(outcome.out);
    default:
      return "status " + std::to_string(outcome.status);
  }
}

}  // namespace rotor_stator::tests
