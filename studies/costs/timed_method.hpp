/**
# Methods against the clock

A task is a row of speeds of one machine, to be solved in order for the motion of period
T. A timed method is one method at one setting. Its `run` does all the work anew and is
what is timed: tables, the start, the transient or the iteration, at every speed. Writing
the motions down afterwards is timed for none. A process plans the Fourier transforms of a
length once, in the first run that needs it: the median of the repetitions does not show
it.

- Harmonic balance: a speed starts from the paper's predictor; where that fails, from
  quasi-static contact if the harmonics are few, and then from half a second of time
  integration with coarse steps, which goes on from where it ended last. With a transient
  in the setting, that comes first. Or the paper's sweep, which halves the gap to the last
  speed where Newton fails.
- Time integration: a transient of whole periods, from the static load or the known state;
  then from speed to speed. `rk4-lanes` and `splitting-lanes` integrate all speeds side by
  side, each from quasi-static contact.
- Shooting: the state is extrapolated from speed to speed by the same predictor, and Φ is
  kept. */
#pragma once

#include <memory>

#include "costs/true_motion.hpp"
#include "time/flow.hpp"

namespace rotor_stator::costs {

/** One method at one setting; zero where the method has no such setting. `method` is aft
    (harmonic balance), a time method, one with a fixed step and -lanes behind it, central
    (central differences), or shooting- with a time method behind it. */
struct Setting {
  std::string method;
  int harmonics = 0;                ///< aft: m
  int samples_per_harmonic = 0;     ///< aft: N is a fast size above this times m
  int samples = 0;                  ///< aft: N itself, instead
  bool paper_sweep = false;         ///< aft: continuation/sweep.hpp, with its tolerance
  double tolerance = 0;             ///< aft: Newton's; time: local error
  double step = 0;                  ///< fixed, its own [s]
  double transient = 0;             ///< at each speed [s]; of aft, that of its start
  int recorded = 0;                 ///< time integration: intervals of a last period
  double periodicity_residual = 0;  ///< shooting; "closure" in files [-]

  bool is_shooting() const { return method.starts_with("shooting-"); }
  bool is_ensemble() const { return method.ends_with("-lanes"); }

  /** The time method: rk4 of rk4-lanes and shooting-rk4. */
  std::string stepper() const;
  int sample_count() const;  ///< N
};

/** A setting of one method for each speed of a task, or one for all. */
class Schedule {
public:
  Schedule(Setting setting) : settings_{std::move(setting)} {}
  explicit Schedule(std::vector<Setting> settings) : settings_(std::move(settings)) {}

  const Setting& at(std::size_t speed) const
  {
    return settings_.size() > 1 ? settings_.at(speed) : settings_.front();
  }
  const std::string& method() const { return settings_.front().method; }

  /** "m=6 N>4m tol=1e-07"; with the least and the largest where they differ:
      "m=1..17". */
  std::string text() const;

private:
  std::vector<Setting> settings_;
};

/** Settings of one method in groups of the same accuracy, the cheaper ones first, so that
    a search can stop early. */
using SettingGroup = std::vector<Setting>;
struct Candidates {
  std::string method;
  std::vector<SettingGroup> groups;
};

/** The tables of `toml` that are named in its key "methods", in that order. Throws
    BadInput. */
std::vector<Candidates> read_candidates(StrictToml& toml);

/** CPU seconds of one thread: median, least and most of the repetitions. */
struct CpuTime {
  double median, least, most;
};

CpuTime time_of(int repetitions, const std::function<void()>& work);

/** Operations of the last run. */
struct Counts {
  long force_instants = 0;   ///< evaluations of the bearing's force, one instant each
  long transforms = 0;       ///< Fourier transforms of one series
  double force_seconds = 0;  ///< in the bearing's force, of a profiled aft run [s]
};

class TimedMethod {
public:
  TimedMethod(const Task& task, Schedule schedule)
      : task_(task), schedule_(std::move(schedule))
  {
  }
  virtual ~TimedMethod() = default;

  /** All the work anew: it begins, and solves one speed after the other. */
  void run();

  /** Runs once and returns the CPU [s] of each speed. */
  virtual std::vector<double> seconds_by_speed();

  /** The motion at a speed of the task; none where it was not found. */
  virtual std::optional<motion::Motion> motion(std::size_t speed, int points) const = 0;

  virtual Counts counts() const { return counts_; }

protected:
  virtual void begin();
  virtual void solve(std::size_t speed) = 0;

  /** Of the time method at a speed. */
  std::unique_ptr<Flow> stepper(std::size_t speed, int intervals) const;

  /** Integrates `state_` over whole periods from phase 0, so many seconds at least.
      Returns their number. */
  long advance(Flow& whole, double seconds, double omega);

  Task task_;
  Schedule schedule_;
  Counts counts_;
  State state_;  ///< at phase 0: what time integration, also of a start, goes on from
};

std::unique_ptr<TimedMethod> timed_method(const Task& task, const Schedule& schedule);

/** The largest errors over some speeds [-]; infinite where one has no solution. */
struct MotionError {
  double displacement = 0, force = 0;  ///< largest difference over the largest value
  double mean = 0;                     ///< of displacement, rms about the mean
  double worst_frequency = 0;          ///< where the displacement is worst [Hz]
};

/** One method over all speeds of a sweep: what it costs, and how far off it is. */
struct Measurement : CpuTime, Counts, MotionError {
  Schedule schedule;
  int repetitions;
  std::vector<double> seconds = {};      ///< at each speed, where it is run once
  std::vector<MotionError> errors = {};  ///< at each speed
};

Measurement measure(const References& sweep, const Schedule& schedule, int repetitions);

/** p of y = a x^p by least squares of the logarithms; two points at least, all
    positive. */
double fitted_exponent(const std::vector<double>& x, const std::vector<double>& y);

/** For headers of tables: what is timed. */
inline constexpr const char* what_is_timed =
    "timed: the whole solution on one thread, tables, start, transient or iteration; "
    "Fourier transforms are planned once in a process, in the first run that needs them; "
    "writing the motion down is timed for none";

}  // namespace rotor_stator::costs
