/**
# What every command is asked, and what it gives

A command NAME has its request and `explore_NAME` in the header of that name. It throws
BadInput for options that contradict each other or do not suit the machine, NoSolution
when nothing was found. */
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/budget.hpp"
#include "io/output_file.hpp"
#include "io/table.hpp"

namespace rotor_stator::explore {

/** --budget: evaluations of the force or, with an s, seconds of the clock. */
struct Allowance {
  double evaluations = 0, seconds = 0;  ///< one of them, or none
  Clock::time_point end = {};           ///< of the seconds

  bool is_over() const { return seconds > 0 && Clock::now() >= end; }
  std::string words() const;  ///< "the budget of 60 s"
};

using File = std::optional<std::string>;

/** What the options of all commands ask for, each in its range. */
struct Request {
  std::string parameter_file;
  std::optional<int> harmonics;     ///< m; without it 6, or what the command knows better
  std::optional<int> samples;       ///< N
  double newton_tolerance = 1e-10;  ///< relative
  Allowance budget = {};
  int subharmonic = 1;       ///< K: motions of period KT
  std::string columns = {};  ///< names, "all", or empty: the usual ones
  TableFormat format = TableFormat::tsv;
  bool quiet = false;  ///< no progress on stderr
  File plot = {}, overlay = {};
  bool force = false;  ///< outputs replace any file
  bool rpm = false;    ///< the figure's axis of speeds in turns a minute

  /** The files that options name: read, and written, these with their options. */
  std::vector<std::string> inputs = {};
  std::vector<std::pair<std::string, std::string>> outputs = {};
};

/** Of commands over a range of speeds. */
struct RangeRequest : Request {
  double from = 0, to = 0;  ///< [Hz]
};

struct Exploration {
  Table table;
  std::vector<NamedContent> files = {};  ///< beside the table
  std::string unfinished = {};  ///< why a branch stopped early; empty when it did not
  std::string drawn = {};       ///< the table of the figure, where it is another one
  bool is_written = false;      ///< row by row, on stdout
};

}  // namespace rotor_stator::explore
