/**
# Tables of numbers, read back

What a program wrote (output/table.hpp) and another goes on from: `#` lines, a row of names, rows of
numbers, separated by tabs. */
#pragma once

#include <string>
#include <vector>

namespace rotor_stator
{

class NumberTable
{
public:
  /** Throws BadInput with file and line when it is missing, empty or not such a table. */
  explicit NumberTable(const std::string& file);

  std::size_t rows() const { return rows_.size(); }

  /** Throws BadInput if there is no such column. */
  double at(std::size_t row, const std::string& column) const;

private:
  void read_row(const std::string& line, int number);

  std::string file_;
  std::vector<std::string> names_;
  std::vector<std::vector<double>> rows_;
};

}  // namespace rotor_stator
