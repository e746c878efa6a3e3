/**
# Scene: how many harmonics are enough (claims C2, C3 and C14)

Per speed, the motion that time integration settles on, periodic or not, and its distance
to the solution with m = 1, 2, … harmonics: rms over the instants of the difference, over
the rms of the motion, for the four displacements and for the bearing's force. */
#pragma once

#include "scenes/motion.hpp"
#include "scenes/scene_file.hpp"

namespace rotor_stator
{

struct TruncationScene {
  std::vector<Parameters> sets;
  std::vector<double> frequencies;  ///< [Hz]
  int most_harmonics;               ///< m = 1…most
  SteadySettings time_integration;
};

struct TruncationPoint {
  int set;
  double frequency;  ///< [Hz]
  int harmonics;     ///< m
  bool found;
  bool periodic;          ///< the integrated motion
  double distance;        ///< of displacement [-]; -1 when not found
  double distance_force;  ///< [-]; -1 when not found
};

TruncationScene read_truncation_scene(const std::string& file,
                                      const std::string& reading);
std::vector<TruncationPoint> compute_truncation(const TruncationScene& scene);

}  // namespace rotor_stator
