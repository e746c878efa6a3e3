/**
# The rows of an interrupted table

A map or a sweep that was stopped goes on from the rows that it has written, if they
answer the same question: the lines before the rows must be the same. */
#pragma once

#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rotor_stator::explore {

class InterruptedTable {
public:
  /** Throws BadInput unless `file`, the value of --resume, begins as `beginning` does, or is
      cut off within it. `what`: a map or a response. */
  InterruptedTable(std::string file, const std::string& what,
                   const std::string& beginning);

  /** All whole rows; one that is cut off is left out. */
  using Take =
      std::function<void(const std::string& row, const std::vector<std::string>& cells)>;
  void each_row(const Take& take);

  /** Throws BadInput about the file. */
  [[noreturn]] void refuse(const std::string& why) const;

private:
  std::string file_;
  std::ifstream in_;
  std::streamoff begin_;
};

/** The finite number that a cell is, as tables write it; nothing for another cell. */
std::optional<double> number_of(const std::string& cell);

}  // namespace rotor_stator::explore
