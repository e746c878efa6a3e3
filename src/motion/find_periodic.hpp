/**
# The periodic motion at one speed

Found by harmonic balance, from several starts. */
#pragma once

#include "balance/newton.hpp"
#include "motion/motion.hpp"
#include "time/flow.hpp"

namespace rotor_stator::motion {

/** The name of the first start. */
inline constexpr const char* quasi_static_name = "quasi-static contact";

/** A start for Newton: its name, and its coefficients, empty or NoSolution where they cannot be had. */
struct Start {
  std::string name;
  std::function<Eigen::VectorXd()> coefficients;
};

/** What is looked for, and how. */
struct Search {
  const Parameters& parameters;
  double omega;                              ///< [rad/s]
  int harmonics;                             ///< m
  int samples = default_samples(harmonics);  ///< N
  NewtonSettings newton = {};
  OperationBudget budget = {};
};

/** Looks for the periodic motion, and for the series of both bodies. Newton starts from quasi-static contact, then
    from a solution with fewer harmonics, from `further` ones, from one period of time integration where that
    settles, and from a neighbouring speed; the first that converges is kept. No start depends on rounding.
    Not found means that none of these found one. Throws NoSolution when the budget is used up. */
PeriodicMotion find_periodic(const Search& search,
                             const std::vector<Start>& further = {});

/** From these coefficients alone, which `name` describes; and from quasi-static contact alone. */
PeriodicMotion find_from(const Search& search, const std::string& name,
                         Eigen::VectorXd x);
PeriodicMotion find_near_contact(const Search& search);

/** A start for Newton: the relative motion [m] of one period after ten seconds of RK4 from rest, as
    coefficients. Throws NoSolution when the integration breaks down, or does not settle on a T-periodic motion,
    the same one in the same time at speeds that differ by 1e-11: chaotic motion differs from processor to processor. */
Eigen::VectorXd integrated_start(const Parameters& parameters, double omega,
                                 int harmonics, const OperationBudget& budget = {});

/** Short time integration as a start: RK4 goes on from where it ended last, with steps that are too long for
    a result. */
class CoarseIntegration {
public:
  CoarseIntegration(const Parameters& parameters, const State& state,
                    OperationBudget budget = {});

  /** Coefficients of the relative motion [m] over the period that follows `seconds` at this speed. Where it diverges,
      those of quasi-static contact, and it begins from the static load again. Throws NoSolution when the budget is
      used up. */
  Eigen::VectorXd go_on(double omega, double seconds, int harmonics);

  /** Evaluations of the force. */
  long evaluations() const { return evaluations_; }

private:
  Parameters parameters_;
  State state_;  ///< at phase 0
  OperationBudget budget_;
  long evaluations_ = 0;
};

}  // namespace rotor_stator::motion
