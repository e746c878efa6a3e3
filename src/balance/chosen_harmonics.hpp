/**
# Harmonics chosen by their size

A motion with two frequencies has lines everywhere, and few of them are large. The solution starts on
the orders 0 to 3 of the speed and their first sidebands of the passing balls. It is then put on a large set of
candidates, where Newton's next steps (a dense block for the harmonics kept, a block of 2 × 2 complex
numbers with the mean stiffness of the contact for each other one, GMRES on the whole) say how large
each dropped harmonic is and what that does to the kept ones. Those that the tolerance asks for are taken, the
others dropped, until the difference of the two solutions is below it (choice by size: Grolet and
Thouverez 2012). Where that fails, at a resonance of the contact, the solution is found on all harmonics up to
that frequency, from the lines of the motion that Eq. 7 settles on, and its error is the distance from that motion. The
last answer is these lines themselves, with those of halves where the motion has doubled. */
#pragma once

#include "balance/adaptive_balance.hpp"
#include "balance/bearing_problem.hpp"

namespace rotor_stator {

/** The motion that Eq. 7 settles on, where the choice begins when that fails, and against which it is then measured. */
struct SettledOn {
  /** Coefficients of its relative motion on a set of harmonics; empty where there are none. */
  std::function<Eigen::VectorXd(const Harmonics& harmonics)> lines;

  /** Integrates further; the lines are then those of a longer record. */
  std::function<void()> go_on;

  /** The error of a solution against it. */
  std::function<ErrorEstimate(const PeriodicMotion& solution)> error;

  bool only = false;  ///< nothing else is tried
};

/** A solution with two frequencies whose error is below `settings.tolerance`; `end` names the largest dropped
    harmonic where there is none. */
AdaptiveMotion solve_on_chosen(const Parameters& parameters, double omega,
                               const AdaptiveSettings& settings, const SettledOn& settled,
                               const OperationBudget& budget = {});

}  // namespace rotor_stator
