/**
# explore orbit, explore contact

One motion of one machine at one speed, by harmonic balance or in time, as a table. */
#pragma once

#include <optional>
#include <string>

#include "io/budget.hpp"
#include "io/output_file.hpp"
#include "io/table.hpp"
#include "model/parameters.hpp"
#include "motion/lines.hpp"

namespace rotor_stator::explore {

/** --budget: evaluations of the force or, with an s, seconds of the clock. */
struct Allowance {
  double evaluations = 0, seconds = 0;  ///< one of them
  Clock::time_point end = {};           ///< of the seconds

  bool is_over() const { return seconds > 0 && Clock::now() >= end; }
  std::string words() const;  ///< "the budget of 60 s"
};

/** What the options of all commands ask for, each in its range. */
struct Request {
  std::string parameter_file;
  std::optional<int> harmonics;     ///< m; without it 6, or what the command knows better
  std::optional<int> samples;       ///< N
  double newton_tolerance = 1e-10;  ///< relative
  std::optional<Allowance> budget;
  int subharmonic = 1;       ///< K: motions of period KT
  std::string columns = {};  ///< names, "all", or empty: the usual ones
  TableFormat format = TableFormat::tsv;
  bool quiet = false;                                  ///< no progress on stderr
  std::optional<std::string> plot = {}, overlay = {};  ///< files
  bool force = false;                                  ///< outputs replace any file
  bool rpm = false;  ///< the figure's axis of speeds in turns a minute
};

/** Those that find a periodic motion, stable or not: harmonic balance and shooting. */
inline const std::vector<std::string> periodic_methods{"aft", "shooting"};
bool is_periodic(const std::string& method);

struct MotionRequest : Request {
  double frequency = 0;  ///< [Hz]
  /** What the machine does from rest; or one of `periodic_methods`, or a time method. */
  std::string method = "auto";
  std::optional<double> tolerance;  ///< of displacement, relative
  std::optional<int> lines = {};    ///< of the settled motion, with two frequencies (aft)
  int points = 256;                 ///< P
  double local_error = 1e-11;       ///< GSL's methods, relative
  double step = 0;                  ///< rk4 [s]; 0: from K_H
  double longest = 0;     ///< 0: as settle chooses; transient at most after t = 0 [s]
  int periods = 1;        ///< base periods that are printed
  bool stability = true;  ///< Floquet multipliers in the header (aft)
};

struct Exploration {
  Table table;
  std::vector<NamedContent> files = {};  ///< beside the table
  std::string unfinished = {};  ///< why a branch stopped early; empty when it did not
  std::string drawn = {};       ///< the table of the figure, where it is another one
  bool is_written = false;      ///< row by row, on stdout
};

/** Throw BadInput for options that contradict each other, NoSolution when nothing was
    found. */
Exploration explore_orbit(const MotionRequest& request);
Exploration explore_contact(const MotionRequest& request);

/**
## What the other commands need too */

/** A table of this length takes about a second and 0.4 GB to write. */
constexpr int most_rows = 1 << 20;

inline const Column phase_column{
    "phase", "rad",
    "2 pi t over the base period, modulo 2 pi, or 2 pi K with --subharmonic K or "
    "--periods K"};
inline const Column time_column{"t", "s", "time since phase 0"};

/** The machine, right at these speeds [Hz], the request's harmonics and the rotor's
    `nodes`. Throws BadInput. */
Parameters machine_of(const Request& request, double from, double to,
                      const NumberTable* nodes = nullptr);

/** `machine` with its doubts up to a speed [Hz]. */
Parameters doubted(Parameters machine, double highest);

/** Throws BadInput for a time method that does not integrate such bodies. */
void require_method_of(const Parameters& parameters, const std::string& method);

/** A motion, the machine counted over its period, and its lines, which a record leaves
    out. */
struct FoundMotion {
  motion::Motion motion;
  motion::Lines lines = {};
  Parameters machine = {};
  double base_frequency = 0;    ///< of the base period [Hz]
  double turns_of_period = 1;   ///< turns of the rotor in one base period
  int base_periods = 1;         ///< in one period of the motion's points
  int closes_after = 0;         ///< K base periods, exactly; 0 for a record
  bool has_statistics = false;  ///< whether its means are in the header
};

/** A motion, the bearing's force at its instants, and what it has cost. */
struct Computed {
  FoundMotion found = {};
  std::vector<Vec2> forces = {};
  OperationBudget budget;

  bool touches() const;
};

/** The motion that is asked for, `open_periods` of one that does not close; how it was
    found goes to the table's header. */
Computed computed(const Parameters& parameters, const MotionRequest& request,
                  int open_periods, Table& table);

/** Throws BadInput unless --from is below --to. */
void require_range(double from, double to);

/** So many speeds, both ends among them. */
std::vector<double> evenly_spaced(double from, double to, int count);

/** N as asked for, or the default for m. Throws BadInput when it is too small. */
int checked_samples(int harmonics, const std::optional<int>& samples);

/** The budget that is asked for, or the evaluations that take `seconds`; watched
    where a person is. Seconds of the clock bound the evaluations too, by what a fast
    core does. */
OperationBudget budget_of(const Request& request, double seconds,
                          const Parameters& parameters);

/** So many evaluations, and no longer than a user's seconds. */
OperationBudget budget_until(const std::optional<Allowance>& allowed, double evaluations,
                             const std::string& option = "");

/** Of one motion of many: a user's seconds are those of the whole run. */
OperationBudget budget_of_each(const std::optional<Allowance>& allowed, double seconds,
                               const Parameters& parameters);

/** The key `contact`, with a warning where no ball touched; what was spent; both. */
void put_contact(Table& table, const Parameters& parameters, bool touches);
void put_cost(Table& table, const OperationBudget& budget);
void conclude(Table& table, const Parameters& parameters, bool touches,
              const OperationBudget& budget);

/** The keys `regime` and `period`: a motion that closes after `period` base periods; 0:
    `otherwise`, and why. */
void put_regime(Table& table, int period, const std::string& otherwise = "undecided",
                const std::string& why = "");

/** The key `complete`, and what is missing. */
void put_complete(Table& table, const std::string& missing);

}  // namespace rotor_stator::explore
