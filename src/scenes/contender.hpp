/**
# Contenders: every method on the same task

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
#pragma once

#include <string>
#include <vector>

#include "scenes/motions.hpp"

namespace rotor_stator
{

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
  std::function<Motions(int points)> motions;
  std::function<Counts()> counts;
};

Contender make_contender(const Task& task, const Setting& setting);

}  // namespace rotor_stator
