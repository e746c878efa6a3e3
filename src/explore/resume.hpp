/**
# The rows of an interrupted table

A map or a sweep that was stopped goes on from the rows that it has written, if they
answer the same question: the lines before the rows must be the same. */
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rotor_stator::explore {

/** Takes a row, as its line and its cells. */
using TakeRow =
    std::function<void(const std::string& row, const std::vector<std::string>& cells)>;

/** Calls `take` for each whole row. Throws BadInput unless the table in `file`, the value
    of --resume, begins as `beginning` does, or is cut off within it; `what`: a map or a
    response. */
void each_row_of(const std::string& file, const std::string& what,
                 const std::string& beginning, const TakeRow& take);

/** The finite number that a cell is, as tables write it; nothing for another cell. */
std::optional<double> number_of(const std::string& cell);

}  // namespace rotor_stator::explore
