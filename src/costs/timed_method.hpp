/**
# Methods against the clock

A task is a row of speeds of one machine, to be solved in order for the motion of period T. A timed
method is one method at one setting. Its `run` does all the work anew and is what is timed: tables, the
start, the transient or the iteration, at every speed. Writing the motions down afterwards belongs to the
comparison and is timed for none. A process plans the Fourier transforms of a length once, in the first run
that needs it: the median of the repetitions does not show it.

- Harmonic balance: a speed starts from the paper's predictor; without one, or where Newton fails from
  it, from quasi-static contact if the harmonics are few, and then from half a second of time integration
  with coarse steps, which goes on from where it ended last; where that fails too, from more of it with half as
  many harmonics more. More than 128 harmonics begin with a solution on 64. With a transient in the setting, that is the
  first start at every speed. Or, as the paper does it, the gap to the last speed is halved where Newton fails.
- Harmonic balance to a tolerance: motion/find_periodic.hpp, each speed alone.
- Time integration: a transient in seconds, whole periods, from the static load or from the known state;
  then from speed to speed.
- Shooting: from speed to speed the state is extrapolated by the same predictor, and Φ is handed on. */
#pragma once

#include <functional>
#include <memory>

#include "costs/setting.hpp"
#include "costs/true_motion.hpp"

namespace rotor_stator::costs {

/** CPU seconds of one thread: median, least and most of the repetitions. */
struct CpuTime {
  double median, least, most;
};

/** The CPU clock of the calling thread [s]. */
double thread_cpu_seconds();

CpuTime time_of(int repetitions, const std::function<void()>& work);

/** Operations of the last run. */
struct Counts {
  long force_instants = 0;   ///< evaluations of the bearing's force, one instant each
  long transforms = 0;       ///< Fourier transforms of one series
  long transformed = 0;      ///< samples of all of them
  int maps = 0;              ///< periods integrated by shooting
  int derivatives = 0;       ///< of them with the variational equations
  double force_seconds = 0;  ///< in the bearing's force, of a profiled aft run [s]
};

class TimedMethod {
public:
  TimedMethod(const Task& task, const Setting& setting) : task_(task), setting_(setting)
  {
  }
  virtual ~TimedMethod() = default;

  /** All the work anew, speed by speed, until `goes_on`, asked after each, says no. */
  void run(const std::function<bool(std::size_t speed)>& goes_on = {});

  /** The motion at a speed of the task; none where it was not found. */
  virtual std::optional<motion::Motion> motion(std::size_t speed, int points) const = 0;

  virtual Counts counts() const { return counts_; }

protected:
  Task task_;
  Setting setting_;
  Counts counts_;

private:
  virtual void begin() = 0;
  virtual void solve(std::size_t speed) = 0;
};

std::unique_ptr<TimedMethod> timed_method(const Task& task, const Setting& setting);

/** One method at one setting over all speeds of a sweep: what it costs, and how far off it is. */
struct Measurement : CpuTime, Counts, MotionError {
  Setting setting;
  int repetitions;
};

Measurement measure(const References& sweep, const Setting& setting, int repetitions);

/** The largest error over the speeds, as far as it is not above `bound`: the run ends at the first speed
    that is. */
MotionError error_up_to(double bound, const References& sweep, const Setting& setting);

/** For headers of tables: what is timed. */
inline constexpr const char* what_is_timed =
    "timed: the whole solution on one thread, tables, start, transient or iteration; Fourier "
    "transforms are planned once in a process, in the first run that needs them; "
    "writing the motion down is timed for none";

}  // namespace rotor_stator::costs
