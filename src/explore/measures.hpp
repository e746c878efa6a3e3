/**
# What standards and accelerometers ask of a motion

Columns by name, WHAT_PLACE: of any displacement that `orbit` prints, as x_r, x_r_2 or
x_r_out, of its velocity v_x_r and its acceleration a_x_r. WHAT is `amp` (half
peak-to-peak), `peak` (the largest distance from the mean), `mean`, `rms` (about the
mean), `amp_1X` and `phase_1X` (a cos(ωt + φ), ωt the rotor's angle), or `iso` (rms of the
velocity in mm/s from 10 to 1000 Hz, below 600 turns a minute from 2 Hz, ISO 20816).
Without WHAT the value at each instant. The same, but no rates, of a bearing's force on
the stator, F_x or F_x_2. Of each bearing also `ball_load`, `stress` and the largest
`force`, ball_load_2 of the second, and `contact_share`, which is of any one where there
are several, contact_share_1 of the first.

All are taken from one record at equal instants, sixteen in its quickest vibration: K
base periods of a motion that closes, 256 of another one (fewer where these would not fit
into memory), under Hann's window where lines are asked for. Rates are differences of
order 8.

    const Measures measures(request.columns, machine);
    const std::vector<double> row = measures.of(record_of(answer)); */
#pragma once

#include "io/table.hpp"
#include "motion/answer.hpp"

namespace rotor_stator::explore {

/** A motion of a machine whose instants are `step` [s] apart, the rotor's speed [Hz], and
    whether it goes on from its beginning. `record_of` takes both from the motion's base
    frequency. */
struct Record {
  const Parameters& machine;
  const motion::Motion& motion;
  double step, speed;
  bool is_closed;
};

Record record_of(const Parameters& machine, const motion::Motion& motion, bool is_closed);
Record record_of(const motion::Answer& answer);

/** How a motion is recorded for them: P, and base periods where it does not close. */
struct Recording {
  int points, periods;
};

/** WHAT is taken of which displacement, as `shown_at` counts, or of which bearing; -1: of
    any. What a bearing has once in a record is taken as its mean. */
struct Measure {
  enum class Of {
    displacement,
    force_x,
    force_y,
    force,
    contact_share,
    ball_load,
    stress
  };
  Column column;
  std::string what;
  Of of;
  int place, rates = 0;
};

class Measures {
public:
  static constexpr int open_periods = 256;

  /** Those among names separated by commas that are measures of the machine, and of which
      there is no column yet; of the whole motion, and with `at_instants` the others. */
  Measures(const std::string& names, const Parameters& machine,
           const std::vector<Column>& known = {}, bool at_instants = false);

  bool empty() const { return all_.empty(); }
  std::vector<Column> columns() const;

  /** Whether any is of the whole motion, not of its instants. */
  bool needs_whole() const;

  /** What they need, P `points` times a power of two; that alone without any. */
  Recording recording(const Parameters& machine, double omega, int points) const;

  /** The values of the whole motion. */
  std::vector<double> of(const Record& record) const;

  /** The same of a solution of harmonic balance, with P at least `points`. */
  std::vector<double> of(const Parameters& machine, const PeriodicMotion& solution,
                         int points) const;

  /** The columns of values at all instants. */
  std::vector<std::vector<double>> at_instants(const Record& record) const;

private:
  std::vector<Measure> all_;
};

/** Those of a table, with their columns, whose rows have the values in `measured`. */
template <class Row>
Measures add_measures(std::vector<Field<Row>>& fields, const std::string& names,
                      const Parameters& machine)
{
  Measures measures(names, machine, {fields.begin(), fields.end()});
  for (std::size_t k = 0; const Column& one : measures.columns()) {
    fields.push_back({one, [k](const Row& row) -> Cell { return row.measured[k]; }});
    ++k;
  }
  return measures;
}

/** The motion of an answer, recorded as measures need it. */
motion::Answer whole_motion(const Measures& measures, motion::Answer answer,
                            motion::Request request, const OperationBudget& budget);

}  // namespace rotor_stator::explore
