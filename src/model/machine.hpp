/**
# A machine: two masses, or bodies given by matrices

Every method asks here for what differs between them, once for a motion and never for an
evaluation, and none asks which of them it has. `Machine` itself is the two masses of
Eq. 7; `LargeMachine` (large_machine.hpp) is a finite-element rotor. The members are
defined in the folders that they belong to: states in model/, flows in time/, equations in
balance/.

    std::unique_ptr<Flow> flow = parameters.bodies->flow(parameters, omega, settings); */
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace rotor_stator {

struct Parameters;
struct State;
struct LargeBodies;
template <class Number>
struct DirectionOf;
class Table;

/** Of time/ and of balance/. */
class Flow;
struct StepSettings;
struct PeriodMap;
struct Problem;
struct PeriodicMotion;

/** How long a person waits for it, unless a budget is given. */
struct Patience {
  double settling = 10;          ///< for a motion that is integrated [s]
  double longer = 1;             ///< times that of two masses, for anything
  double transient_share = 0.7;  ///< of a budget, for what comes before the record [-]
  int speeds = 101;              ///< of a response
};

class Machine {
public:
  virtual ~Machine() = default;

  /**
  ## At rest (model/rotor_stator.cpp) */

  /** Static equilibrium with ball 1 at the angle `cage`; 0 where none is unique. With
      elements to the ground, and of large bodies, with ball 1 where it is at t = 0. */
  virtual State at_rest(const Parameters& parameters, DirectionOf<double> cage) const;

  /** The bearings carry the constant loads: where the paper's figures start. */
  virtual State static_start(const Parameters& parameters) const;

  /** Sizes of the components of a state, for tolerances and norms. */
  virtual Eigen::VectorXd state_scales(const Parameters& parameters) const;

  /** The highest frequency of a contact [rad/s]. */
  virtual double quickest_contact(const Parameters& parameters) const;

  /**
  ## In time (time/flow.cpp) */

  /** The method of time integration that is its own: "splitting", "rk4" where the bearing
      is not `is_elastic_hertz`, or "gauss". */
  virtual const char* time_method(const Parameters& parameters) const;

  /** Whether "rk4", "splitting", "rk8" and GSL's methods integrate it too. */
  virtual bool takes_explicit_steps() const { return true; }

  virtual Patience patience() const { return {}; }

  /** The longest step [s] of a fixed one, at a base frequency. */
  virtual double step(const Parameters& parameters, double omega) const;

  virtual std::unique_ptr<Flow> flow(const Parameters& parameters, double omega,
                                     const StepSettings& settings) const;
  virtual PeriodMap period_map(const Parameters& parameters, double omega,
                               const State& start, const StepSettings& settings,
                               long interval) const;

  /**
  ## In harmonics (balance/bearing_problem.cpp) */

  /** The unknowns and blocks of the balance, and the operations of its force. */
  virtual void put_equations(const Parameters& parameters, Problem& problem) const;

  /** Samples of the relative motion [m] without contact where it stays inside the
      clearances, else in quasi-static contact, N × 2 for each bearing. */
  virtual Eigen::MatrixXd start_samples(const Parameters& parameters, double omega,
                                        int samples) const;

  /** Series of the displacements that are shown [m]; and of all, of a motion that has
      these as its `bodies`. */
  virtual Eigen::MatrixXd shown_series(const Parameters& parameters,
                                       const PeriodicMotion& motion) const;
  virtual Eigen::MatrixXd all_series(const Parameters& parameters,
                                     const PeriodicMotion& motion) const;

  /** Prepares solutions with harmonics 0 … m of a branch from `omega` on. */
  virtual void prepare(const Parameters& /*parameters*/, double /*omega*/,
                       int /*harmonics*/) const
  {
  }

  /**
  ## In tables (model/parameters.cpp) */

  /** The `#` lines and keys of the bodies. */
  virtual void describe(Table& table, const Parameters& parameters) const;
  virtual void put_keys(Table& /*table*/) const {}

  /** Of its receptances where the bodies were reduced, relative. */
  virtual double reduction_error() const { return 0; }

  /** Further displacements that are shown, and their places in a state. */
  virtual std::vector<std::pair<std::string, int>> outputs() const { return {}; }

  /** The places of x_s, y_s, x_r, y_r at joint k, bearings first; of the ground -1. */
  virtual std::array<int, 4> places(std::size_t /*k*/) const { return {0, 1, 2, 3}; }

  /** Its matrices, where its harmonics are those of matrices. */
  virtual const LargeBodies* matrices() const { return nullptr; }
};

}  // namespace rotor_stator
