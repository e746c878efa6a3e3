/**
# CPU time of one thread */
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "balance/bearing_problem.hpp"
#include "motion/motion.hpp"

namespace rotor_stator::costs
{

/** CPU seconds of one thread: median, least and most of the repetitions. */
struct CpuTime {
  double median, least, most;
};

/** The CPU clock of the calling thread [s]. */
double thread_cpu_seconds();

CpuTime time_of(int repetitions, const std::function<void()>& work);

/**
## Contenders: every method on the same task

A task is a row of speeds of one machine, to be solved in order for the motion of period
T. A contender is one method at one setting. Its `run` does all the work anew and is what
is timed: plans and tables, the start, the transient or the iteration, at every speed.
Writing the motions down afterwards belongs to the comparison and is timed for none.

- *aft*: harmonic balance. A speed starts from the paper's predictor; without one, or where Newton fails
  from it, from quasi-static contact if the harmonics are few, and then from half a second of time
  integration with coarse steps; where that fails too, with half as many harmonics more. The number of
  harmonics is the same at all speeds, or falls with the speed, or is raised until an estimate of what
  is left out is small (left_out.hpp).
- *rk4* (fixed step) and GSL's steppers: a transient in seconds, whole periods, from the static load or
  from the known state; then from speed to speed.
- *shooting-rk4*, *shooting-rk8pd*, …: Newton on the period map. From speed to speed the state is
  extrapolated by the same predictor, and Φ is handed on. */

/** Zero where a method has no such setting. */
struct Setting {
  std::string method;
  int harmonics = 0;  ///< aft: m, the least where `corner` asks for more
  double corner = 0;  ///< aft: m f is at least this [Hz]
  double estimate =
      0;  ///< aft: m is raised until what it leaves out is estimated below this
  int samples_per_harmonic =
      0;                 ///< aft: N is the fast size from this times m, plus 1, on
  double tolerance = 0;  ///< aft: Newton's; GSL: local error
  double step = 0;       ///< rk4 [s]
  double transient = 0;  ///< time methods, at each speed [s]
  double closure = 0;    ///< shooting

  bool is_shooting() const { return method.starts_with("shooting-"); }

  /** "m=6 N=32 tol=1e-07". */
  std::string text() const;
};

/** The next whole number with at most three binary digits: few different m in a sweep, and fast
    transforms. */
int rounded_up(int harmonics);

/** Number of harmonics and samples of an aft setting at a speed [Hz]. */
int harmonics_at(const Setting& setting, double frequency);
int samples_for(const Setting& setting, int harmonics);

struct Task {
  Parameters parameters;
  std::vector<double> frequencies;  ///< [Hz]

  /** A speed [Hz] whose solution is known when the work begins, and the state there at phase 0. */
  struct Known {
    double frequency;
    State state;
  };
  std::optional<Known> before = {};

  bool profiled = false;  ///< time the force inside harmonic balance
};

/** Operations of the last run. */
struct Counts {
  long force_instants = 0;   ///< evaluations of the bearing's force, one instant each
  long transforms = 0;       ///< Fourier transforms of one series
  long transformed = 0;      ///< samples of all of them
  int maps = 0;              ///< periods integrated by shooting
  int derivatives = 0;       ///< of them with the variational equations
  double force_seconds = 0;  ///< in the bearing's force, of a profiled aft run [s]
};

struct Contender {
  std::function<void()> run;
  std::function<motion::Motions(int points)> motions;
  std::function<Counts()> counts;
};

Contender make_contender(const Task& task, const Setting& setting);

/**
## The three kinds of contenders */

/** A solver of all speeds of a task, as a contender. */
template <class Solver>
Contender contender(const Task& task, const Setting& setting)
{
  const auto solver = std::make_shared<Solver>(task, setting);
  return {.run = [solver] { solver->run(); },
          .motions = [solver](int points) { return solver->motions(points); },
          .counts = [solver] { return solver->counts(); }};
}

Contender aft_contender(const Task& task, const Setting& setting);
Contender time_contender(const Task& task, const Setting& setting);
Contender shooting_contender(const Task& task, const Setting& setting);

/**
## What a truncated solution leaves out

The force of a solution with m harmonics has harmonics above m too, which leave a residual
R_h there. Newton's step with the diagonal blocks of the Jacobian alone,

$$u_h \approx -(A + J)_{hh}^{-1} R_h, \qquad h > m,$$

answers it with the inertia of the bodies and the mean stiffness of the contact: right
above the contact mode and of the right size around it. It costs one evaluation of the
force and no large linear system: an indicator, not a bound. */

struct LeftOut {
  Eigen::VectorXd x;  ///< the solution with those harmonics added
  Eigen::VectorXd
      tail;  ///< sum of their amplitudes above m, over the motion's size [-]; m = 0, 1, …

  double above(int harmonics) const
  {
    return harmonics < tail.size() ? tail[harmonics] : 0;
  }

  /** The least number of harmonics above which less than `part` is left. */
  int harmonics(double part) const;
};

/** Harmonics to look at from a solution with `harmonics`: to the contact mode, and twice as many at
    least. */
int look_ahead(const Parameters& parameters, double omega, int harmonics);

/** `x`: 2 × (2m+1) coefficients as a vector; `balance`: one with more harmonics. */
LeftOut what_is_left_out(const Parameters& parameters, double omega,
                         const Eigen::VectorXd& x, Balance& balance);

/** Coefficients of the relative motion over one period after half a second of RK4. */
Eigen::VectorXd start_after_transient(const Parameters& parameters, double omega,
                                      int harmonics);

/** For headers of tables: what is timed. */
inline constexpr const char* what_is_timed =
    "timed: the whole solution on one thread, tables and plans, start, transient or iteration; "
    "writing the motion down is timed for none";

/**
## Settings to be tried

A table of a scene file for each method, with the values of its settings. They come in
groups: one accuracy each, within it the cheaper ones first, so that a search can stop
early. */

/** Settings of one method with the same accuracy, cheapest first. */
using SettingGroup = std::vector<Setting>;

struct Candidates {
  std::string method;
  std::vector<SettingGroup> groups;
};

/** The tables of `toml` that are named in its key "methods", in that order. Throws BadInput. */
std::vector<Candidates> read_candidates(StrictToml& toml);

}  // namespace rotor_stator::costs
