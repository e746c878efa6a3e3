/**
# Long studies: in parallel, and not lost when interrupted

A study is a numbered list of independent pieces of work, each giving a row of numbers.
Finished rows are appended to a journal file at once; a run that finds the journal of the
same study goes on from it. The rows do not depend on the number of threads. */
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace rotor_stator
{

using Row = std::vector<double>;

struct Study {
  std::string name;     ///< for the line of progress
  std::string journal;  ///< file; a new one is begun if its first line is not `stamp`
  std::string stamp;    ///< all that the rows depend on, in one line
  std::size_t pieces;
  std::function<Row(std::size_t piece)> work;
};

/** The rows of all pieces in order. Throws what `work` throws. */
std::vector<Row> run_study(const Study& study);

/** Source revision, compiler and the text of files in one line, for a stamp. */
std::string stamp_of(const std::vector<std::string>& files);

}  // namespace rotor_stator
