/**
# One motion at one speed, and what all commands share

`explore orbit` and `explore contact` print a motion, by harmonic balance or in time; the
other commands read their machine, bound their work and end their tables likewise. */
#pragma once

#include "explore/request.hpp"
#include "model/read_machine.hpp"
#include "motion/answer.hpp"
#include "motion/lines.hpp"

namespace rotor_stator::explore {

/** Of orbit, contact and spectrum: the motion from rest, with the speed in `frequency`
    and `periods` as printed; or that of a method that `is_periodic`, which `is_measured`
    gives its multipliers. */
struct MotionRequest : Request, motion::Request {
  double frequency = 0;           ///< [Hz]
  std::optional<int> lines = {};  ///< of the settled motion, with two frequencies (aft)
};

Exploration explore_orbit(const MotionRequest& request);
Exploration explore_contact(const MotionRequest& request);

/** Whether it finds a periodic motion, stable or not: harmonic balance and shooting. */
inline bool is_periodic(const std::string& method)
{
  return method == "aft" || method == "shooting";
}

/** A table of this length takes about a second and 0.4 GB to write. */
constexpr int most_rows = 1 << 20;

inline const Column phase_column{
    "phase", "rad",
    "2 pi t over the base period, modulo 2 pi, or 2 pi K with --subharmonic K or "
    "--periods K"};
inline const Column time_column{"t", "s", "time since phase 0"};

/** The machine, right at these speeds [Hz], the request's harmonics and what else is in
    `range`. Throws BadInput. */
Parameters machine_of(const Request& request, double from, double to,
                      ModelRange range = {});

/**
## A motion */

/** Throws BadInput for a time method that does not integrate such bodies. */
void require_method_of(const Parameters& parameters, const std::string& method);

/** A motion, the machine counted over its period, its lines, which a record leaves out,
    and what it has cost. */
struct FoundMotion {
  motion::Motion motion;
  motion::Lines lines = {};
  Parameters machine = {};
  double base_frequency = 0;    ///< of the base period [Hz]
  double turns_of_period = 1;   ///< turns of the rotor in one base period
  int base_periods = 1;         ///< in one period of the motion's points
  int closes_after = 0;         ///< K base periods, exactly; 0 for a record
  bool has_statistics = false;  ///< whether its means are in the header
  OperationBudget budget = {};

  bool touches() const;
};

/** The motion that is asked for; how it was found goes to the table's header. */
FoundMotion computed(const Parameters& parameters, const MotionRequest& request,
                     Table& table);

/** Throws BadInput unless --from is below --to, or the same where one speed is taken. */
void require_range(double from, double to, std::optional<int> count = 2);

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

}  // namespace rotor_stator::explore
