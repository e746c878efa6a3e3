/**
# Bodies given by matrices

A rotor or a stator of a finite-element program comes as mass, damping, gyroscopic and
stiffness matrices. With the relative displacements u = Dᵀq of all bearings and their
forces F on the stator the whole machine is

$$M\ddot q + (C + \omega G)\,\dot q + K q = p(t) - D F(u, \dot u, t).$$

A joint is a bearing, or what stands between a body and the ground (parallel.hpp): then u
is the displacement of the body there. The first coordinates of q are the displacements
that are shown: x_s, y_s, x_r, y_r at the first bearing, those of the other joints, the
outputs. A rigid stator is a pair of coordinates that nothing moves.

A spring k_0 in each joint, added to K and taken off F, changes nothing and keeps K + k_0
D Dᵀ regular where the joints carry a body. */
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "model/rational_fit.hpp"
#include "model/reduction.hpp"
#include "model/rotor_stator.hpp"

namespace rotor_stator {

/** n coordinates, b joints. */
struct LargeBodies {
  Eigen::MatrixXd mass, damping, gyroscopic, stiffness;  ///< n × n, SI units
  Eigen::MatrixXd joints;                                ///< D, n × 2b
  Eigen::VectorXd load;        ///< constant forces, weight included [N]
  Eigen::VectorXcd unbalance;  ///< the force is ω² Re(unbalance e^{iωt}) [kg m]
  double spring;               ///< k_0 [N/m]
  double size_of_loads = 0;    ///< of the weights and other constant loads [N]
  int shown;                   ///< coordinates that are shown, at least four
  /** Of x_s, y_s, x_r, y_r at each joint; -1, -1 and x, y of a body at the ground. */
  std::vector<std::array<int, 4>> places;
  /** Further columns, and their coordinates. */
  std::vector<std::pair<std::string, int>> outputs = {};
  std::vector<std::string> reductions = {};  ///< lines for headers
  double reduction_error = 0;                ///< of their receptances, relative
  double reduced_to = std::numeric_limits<double>::infinity();  ///< Ω [rad/s], at most
  double slowest = 0, fastest = 0;  ///< speeds [rad/s] over which responses are fitted
  std::shared_ptr<RationalFits> fits = {};  ///< by the ratio of frequency and speed
  SparseMatrix nodes = {};  ///< x, y of the rotor's nodes asked for, 2k × n
  /** Bearings and the nodes at which they stand, from 0. */
  std::vector<std::pair<int, int>> bearing_nodes = {};

  Eigen::MatrixXd held_stiffness() const  ///< K + k_0 D Dᵀ
  {
    return stiffness + spring * joints * joints.transpose();
  }

  /** k of the added spring, k_0(1 ± i): at `order` speeds S is not singular. */
  std::complex<double> damped_spring(double order) const
  {
    return {spring, spring * ((order > 0) - (order < 0))};
  }

  /** K + k D Dᵀ - Ω² M + iΩ (C + ωG) at the frequency Ω and the speed ω. */
  Eigen::MatrixXcd dynamic_stiffness(std::complex<double> k, double frequency,
                                     double speed) const;
};

/** The joints' forces [N] that would keep all u = 0 under the constant loads, 2b, and
    their amplitudes from the unbalance at the speed ω. */
struct JointForces {
  Eigen::VectorXd rest;
  Eigen::VectorXcd whirl;
};
JointForces rigid_joint_forces(const LargeBodies& machine, double speed);

/** The relative displacements [m] with which the bearings answer these forces, each on
    one ball; those of the other joints 0. */
Eigen::VectorXd quasi_static_contacts(const Parameters& parameters,
                                      const Eigen::VectorXd& forces);

/** The matrices of any machine: its own, or those of two masses. */
LargeBodies matrices_of(const Parameters& parameters);

/** Where the joints carry the constant loads: the derivative of their mean forces over
    the cage's angles, 2b × 2b [N/m]; what is beside the balls at a speed [rad/s]. */
Eigen::MatrixXd mean_contact_stiffness(const Parameters& parameters,
                                       const LargeBodies& machine, double rotor_speed);

/** A machine whose harmonics are those of its matrices; in time Eq. 7: two masses with
    elements to the ground, for which the two unknowns of the bearing are not enough. */
class MatrixMachine : public Machine {
public:
  explicit MatrixMachine(LargeBodies bodies) : bodies_(std::move(bodies)) {}

  State at_rest(const Parameters& parameters, Direction cage) const override;
  State static_start(const Parameters& parameters) const override;
  Eigen::VectorXd state_scales(const Parameters& parameters) const override;
  /** Of the mass that moves with a joint at once, 1/(dᵀ M⁻¹ d). */
  double quickest_contact(const Parameters& parameters) const override;

  void put_equations(const Parameters& parameters, Problem& problem) const override;
  Eigen::MatrixXd start_samples(const Parameters& parameters, double omega,
                                int samples) const override;
  Eigen::MatrixXd shown_series(const Parameters& parameters,
                               const PeriodicMotion& motion) const override;
  Eigen::MatrixXd all_series(const Parameters& parameters,
                             const PeriodicMotion& motion) const override;
  void prepare(const Parameters& parameters, double omega, int harmonics) const override;

  double reduction_error() const override { return bodies_.reduction_error; }
  std::vector<std::pair<std::string, int>> outputs() const override
  {
    return bodies_.outputs;
  }
  std::array<int, 4> places(std::size_t k) const override { return bodies_.places[k]; }
  const LargeBodies* matrices() const override { return &bodies_; }

protected:
  LargeBodies bodies_;
};

/** Bodies given by matrices, in time too. */
class LargeMachine : public MatrixMachine {
public:
  using MatrixMachine::MatrixMachine;

  const char* time_method(const Parameters&) const override { return "gauss"; }
  bool takes_explicit_steps() const override { return false; }
  Patience patience() const override
  {
    return {.settling = 1, .longer = 20, .transient_share = 0.4, .speeds = 21};
  }
  double step(const Parameters& parameters, double omega) const override;
  std::unique_ptr<Flow> flow(const Parameters& parameters, double omega,
                             const StepSettings& settings) const override;
  PeriodMap period_map(const Parameters& parameters, double omega, const State& start,
                       const StepSettings& settings, long interval) const override;
  void describe(Table& table, const Parameters& parameters) const override;
  void put_keys(Table& table) const override;
};

/**
## Putting it together

Stator and rotor are matrices of their own, of single masses too; the assembly joins them
at the places of the bearings and puts those coordinates first that are shown. */

/** A single mass, the same in x and y, with an unbalance [kg m] and its weight. */
LinearBody single_mass(const Body& body, const std::string& name, double unbalance,
                       double gravity);

/** Both bodies, their coordinates in the order of the files. */
struct Assembly {
  std::vector<LinearBody> bodies;               ///< stator and rotor
  bool is_rigid;                                ///< the stator
  std::vector<std::array<int, 4>> places = {};  ///< of the joints
  std::size_t bearings = 1;                     ///< those of them that come first

  int first(int body) const { return body == 0 ? 0 : bodies[0].size(); }
  int size() const { return bodies[0].size() + bodies[1].size(); }

  SparseMatrix joined(SparseMatrix LinearBody::*part) const;

  /** D. */
  SparseMatrix joints() const;

  /** Degrees of freedom, those first that are shown; their number. */
  std::pair<std::vector<int>, int> order() const;

  /** Throws BadInput for what neither K nor a joint of this stiffness [N/m] holds. */
  void require_held(double spring) const;

  /** Its matrices, with a spring [N/m] in each joint (`LargeBodies::spring`). */
  LargeBodies assembled(double spring) const;
};

}  // namespace rotor_stator
