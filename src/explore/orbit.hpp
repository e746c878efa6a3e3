/**
# One motion at one speed, and what all commands share

`explore orbit` and `explore contact` print a motion, by harmonic balance or in time; the
other commands read their machine, bound their work and end their tables likewise. */
#pragma once

#include "explore/commands.hpp"
#include "model/parameters.hpp"
#include "motion/judge.hpp"
#include "motion/lines.hpp"

namespace rotor_stator::explore {

/** Those that find a periodic motion, stable or not: harmonic balance and shooting. */
inline const std::vector<std::string> periodic_methods{"aft", "shooting"};
bool is_periodic(const std::string& method);

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

/** Of Hertz, above which a ball marks its race for good [Pa]. */
inline constexpr double most_pressure = 4e9;

/** Doubts about the machine and the highest speed [Hz] that it is asked for, a sentence
    each. */
std::vector<std::string> doubts(const Parameters& machine, double highest);

/** A value, or the largest number that is printed, 1e300, where it is beyond. */
double printable_size(double value);

/** n d_m, by which makers bound the speed [mm/min]; 0 where the sizes are not known. */
double speed_value(const Bearing& bearing, double hertz);

/**
## A motion */

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

/** m where none is asked for. */
inline constexpr int usual_harmonics = 6;

/** What harmonic balance finds. Throws BadInput for options that the machine does not
    allow, NoSolution when nothing was found. */
FoundMotion balance_motion(const Parameters& parameters, const MotionRequest& request,
                           const OperationBudget& budget, Table& table);

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
OperationBudget budget_until(const Allowance& allowed, double evaluations,
                             const std::string& option = "");

/** Of one motion of many: a user's seconds are those of the whole run. */
OperationBudget budget_of_each(const Allowance& allowed, double seconds,
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

/** `base` with its period, where a frequency [Hz] has one. */
void put_base(Table& table, const std::string& base, double frequency);

/** `NAME_largest` and `NAME_rms` of a difference of displacements, and what it is. The
    rms is left out where nothing moves about the mean. */
void put_difference(Table& table, const std::string& name, const motion::Error& error,
                    const std::string& meaning);

/** What stands behind a verdict, as keys; that it is not tested, without one. */
void put_verdict(Table& table, const Parameters& parameters,
                 const motion::Verdict* verdict, int turns);

/** Of a spectrum, and of the waterfall of a branch or a run-up. */
extern const std::vector<Column> line_columns;

/** The rows of a motion at the speed `frequency` [Hz], down to `smallest` of its largest
    line; names have k_cage up to n `passages`. False where no line is above rounding. */
bool add_lines(Table& table, const std::vector<Bearing>& bearings, double frequency,
               motion::Lines all, int passages, double smallest);

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
