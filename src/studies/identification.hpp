/**
# Identifying what the paper leaves out

Masses, mass ratio and cage are not printed. A grid of candidates is judged by the rule of
data/claims.toml: each candidate's motions at 60 speeds, integrated in time, give the
quantities of claims C1, C4, C5, C6 and C10, and their mean is its score. */
#pragma once

#include "io/table.hpp"
#include "motion/regime.hpp"

namespace rotor_stator::studies {

/** The rule of the verdicts, from data/claims.toml. */
struct ClaimRule {
  double low_to, middle_to;  ///< ends of the speed ranges [Hz]
  double multi_harmonic;  ///< share of higher harmonics from which an orbit has many [-]
  double paper_peak, peak_width;  ///< [Hz]
  double within;  ///< candidates within this share of the best score are accepted [-]
};

struct Candidate {
  int reading;          ///< 0 exchanged, 1 as printed
  double ratio_factor;  ///< mass ratio over that of the joint resonance at the peak
  Parameters machine;
};

struct IdentificationScene {
  std::vector<Candidate> candidates = {};
  std::vector<double> frequencies = {};  ///< [Hz]
  motion::RegimeSettings settings = {};
  ClaimRule rule;
  std::vector<std::string> files;  ///< that were read
};

/** Both readings of a scene. */
IdentificationScene read_identification_scene(const std::string& file,
                                              const std::string& claims);

/** Shares of the speeds of one range [-]. */
struct RangeShares {
  double permanent_contact, periodic, simple;
};

/** What a candidate's regimes come to. */
struct ClaimScore {
  double f_peak;                     ///< [Hz], by the parabola through the highest points
  double f_loss_first, f_loss_last;  ///< [Hz]; -1 where contact is never lost
  RangeShares low, middle, high;
  double passages;             ///< per ball and 2T, mean over the high speeds [-]
  double c1, c4, c5, c6, c10;  ///< quantities of the claims, 0…1
  double score;                ///< their mean
};

ClaimScore score(const std::vector<motion::Regime>& regimes, const ClaimRule& rule);

/** `scores` in the order of the candidates. */
Table identification_table(const IdentificationScene& scene, const std::string& claims,
                           const std::vector<std::vector<ClaimScore>>& scores);

}  // namespace rotor_stator::studies
