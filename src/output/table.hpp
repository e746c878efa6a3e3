/**
# Tables

Tab-separated text that describes itself: `#` lines say what was computed, from which
source with which compiler and parameters; `# column:` lines give name, unit and meaning;
then one row of names and the numbers. There are no dates and no host names: the same
source gives the same bytes. */
#pragma once

#include <concepts>
#include <string>
#include <variant>
#include <vector>

#include "model/parameters.hpp"

namespace rotor_stator
{

struct Column {
  std::string name, unit, meaning;
};

/** A number or a word. */
class Cell
{
public:
  Cell(double number) : value_(number) {}
  Cell(std::integral auto number) : value_(static_cast<double>(number)) {}
  Cell(std::string word) : value_(std::move(word)) {}

  bool is_printable() const;  ///< not infinite and not a NaN
  std::string text() const;   ///< 15 significant digits

private:
  std::variant<double, std::string> value_;
};

class Table
{
public:
  /** `what` is the first line of the header. */
  Table(std::string what, std::vector<Column> columns);

  /** One more `#` line. */
  void note(const std::string& line);

  /** The `#` lines of a machine: its file and its values. */
  void describe(const Parameters& parameters);

  /** Throws NoSolution if a number is not finite: no NaN is ever printed as a result. */
  void row(std::vector<Cell> cells);

  /** A blank line: curves are drawn with a gap here. */
  void gap();

  std::string text() const;

private:
  std::vector<std::string> header_;
  std::vector<Column> columns_;
  std::vector<std::vector<Cell>> rows_;  ///< an empty row is a gap
};

}  // namespace rotor_stator
