/**
# Computing time at equal error (§3.3, code)

All settings of the scene file are run once. Within a group of equal accuracy, where the
cheaper ones come first, the search stops when a run costs clearly more than the cheapest
that has reached every target; it ends once the method has used its time. From these runs
come the error and the time of each setting at each speed, and from them a schedule: a
setting that stays below the target at each speed, so that all speeds together, with what
a change of setting costs, take the least time. The cheapest uniform settings and the
schedule are then repeated, and the one with the least median is the row.
*/
#pragma once

#include "costs/timed_method.hpp"

namespace rotor_stator::costs {

struct EqualErrorScene {
  Parameters parameters;
  std::vector<double> frequencies;   ///< [Hz]
  std::vector<double> range_ends;    ///< [Hz]: a range ends below or at each
  std::vector<double> targets;       ///< of the error [-], loosest first
  std::vector<double> paper_ratios;  ///< printed
  std::vector<Candidates> candidates;
  int repetitions;
  double search;  ///< [s]: a method's search in a range ends when it has used that
  TruthSettings truth;
  double MotionError::*error = &MotionError::displacement;  ///< that the targets bound
};

/** One method in one range at one target: its cheapest settings that reach the target, or
    the setting with the least error where none does. */
struct EqualErrorRow : Measurement {
  std::string range;          ///< first and last speed [Hz]
  std::size_t speeds, tried;  ///< settings tried
  double target;
  bool reached;
  double ratio = 0;  ///< CPU over that of aft; 0 where aft has not reached the target
};

/** Every method in every range of T-periodic speeds at every target. */
std::vector<EqualErrorRow> at_equal_error(const EqualErrorScene& scene,
                                          const References& references);

/** The first of these settings, cheapest first, that reaches both errors of a balance.
    Throws NoSolution when the balance failed at a periodic speed, or when none reaches
    them. */
Setting cheapest_rk4(const std::vector<Setting>& settings, const References& references,
                     const MotionError& target);

}  // namespace rotor_stator::costs
