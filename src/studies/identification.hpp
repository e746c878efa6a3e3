/**
# Identifying what the paper leaves out

Masses, mass ratio and cage are not printed, but the text bounds them in closed form: the joint resonance is
"around 50 Hz", which gives the ratio of the masses; gravity prevails up to 10 Hz and the unbalance above 19 Hz,
which bounds the stator's mass; the force has the period of rotation and balls do not overlap, which leaves few
cages. For the machines so accepted the motion is integrated speed by speed, so that every claim can be judged for
all of them. No claim's verdict takes part in the choice. */
#pragma once

#include "io/table.hpp"
#include "motion/regime.hpp"

namespace rotor_stator::studies {

/** Largest and smallest [kg], or [Hz]. */
struct Interval {
  double from, to;
};

/** What the text says, from data/claims.toml. */
struct Text {
  double peak;        ///< [Hz]
  Interval peaks;     ///< [Hz]
  Interval loss;      ///< speeds between which gravity and unbalance become equal [Hz]
  double loss_shown;  ///< the speed of Fig. 4 [Hz]
};

struct Candidate {
  int reading;   ///< 0 exchanged, 1 as printed
  int set;       ///< data set
  double joint;  ///< joint resonance [Hz]
  Parameters machine;
};

struct IdentificationScene {
  std::vector<Candidate> candidates = {};
  std::vector<std::string> accepted = {};  ///< the intervals of masses in words
  std::vector<double> frequencies = {};    ///< [Hz]
  motion::RegimeSettings settings = {};
};

/** Both readings of a scene. */
IdentificationScene read_identification_scene(const std::string& file,
                                              const std::string& claims);

/** The machine with a stator of `mass` [kg] and a rotor that puts the joint resonance at `joint` [rad/s]. */
Parameters with_masses(Parameters machine, double mass, double joint);

/** The stator's masses [kg], at that joint resonance [rad/s], for which gravity and unbalance first load the rigid
    joint equally between two speeds [rad/s]. */
Interval accepted_masses(const Parameters& machine, double joint, Interval loss);

/** Cage ratios k/n for which the balls do not overlap, the largest first: ω_cage/ω ≤ 1/2. */
std::vector<double> accepted_cages(int balls);

/** The numbers of harmonics whose error is looked at. */
inline constexpr std::array<int, 7> judged_harmonics{6, 7, 8, 9, 10, 12, 16};

/** A candidate's motion at one speed. Errors: rms about the mean of the solution nearest to the motion; -1 where the
    motion is not T-periodic, 2 where there is no solution. */
struct CandidateMotion {
  motion::Regime regime;
  std::array<double, judged_harmonics.size()> error;
};

/** At every speed of the scene. */
std::vector<CandidateMotion> motions_of(const IdentificationScene& scene,
                                        const Parameters& machine);

/** `motions` in the order of the candidates. */
Table identification_table(const IdentificationScene& scene, const std::string& claims,
                           const std::vector<std::vector<CandidateMotion>>& motions);

}  // namespace rotor_stator::studies
