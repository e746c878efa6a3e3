/** # Options in their range

Each throws BadInput with the option, its value and what is accepted. */
#pragma once

#include <optional>
#include <string>

#include "io/budget.hpp"
#include "io/table.hpp"
#include "model/parameters.hpp"

namespace rotor_stator::explore
{

void require_positive(const char* option, double value);
void require_between(const char* option, double value, double least, double most);
void require_range(const char* option, int value, int least, int most);

/** N as asked for, or the default for m; both checked. */
int checked_samples(int harmonics, const std::optional<int>& samples);

/** The budget that --budget gives; without it the evaluations that take `operations`. */
OperationBudget checked_budget(const std::optional<double>& evaluations,
                               double operations, const Parameters& parameters);

/**
## The tables of explore

What a follow-up study asks for, checked, computed and written as a table. */

/** One motion at one speed. */
struct MotionRequest {
  std::string parameter_file;
  double frequency = 0;             ///< [Hz]
  std::string method = "aft";       ///< or a time method
  std::optional<int> harmonics;     ///< m; without it 6, or what the tolerance asks for
  std::optional<int> samples;       ///< N
  std::optional<double> tolerance;  ///< of displacement, relative
  int points = 256;                 ///< P
  double newton_tolerance = 1e-10;  ///< relative
  double local_error = 1e-11;       ///< GSL's methods, relative
  std::optional<double> step;       ///< rk4 [s]
  double longest = 30;              ///< transient at most [s]
  bool stability = true;            ///< Floquet multipliers in the header (aft)
  std::optional<double> budget;     ///< evaluations of the force at most
};

/** One branch over a range of speeds, and on demand others beside it. */
struct ResponseRequest {
  std::string parameter_file;
  double from = 0, to = 0;       ///< [Hz]
  std::optional<int> harmonics;  ///< of the saved branch, or 6
  std::optional<int> samples;
  double newton_tolerance = 1e-10;
  std::string direction;         ///< "up", "down", or empty: the saved branch's, or up
  std::optional<double> budget;  ///< evaluations of the force at most, for all of it
  std::string save, restart;     ///< files; empty for none
  int branch = 1;                ///< number in the file `restart`
  std::optional<double> at;      ///< speed to restart from [Hz]
  int isolated = 0;              ///< speeds at which isolated branches are looked for
  int seed = 1;
  bool stability = false;  ///< multipliers at each point, and the bifurcations
};

struct Exploration {
  Table table;
  std::string unfinished;  ///< why a branch stopped early; empty when it did not
};

/** Throw BadInput for options out of range, NoSolution when nothing was found. */
Exploration explore_orbit(const MotionRequest& request);
Exploration explore_contact(const MotionRequest& request);
Exploration explore_response(const ResponseRequest& request);

}  // namespace rotor_stator::explore
