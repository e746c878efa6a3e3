/**
# All degrees of freedom of bodies given by matrices, however many

Gauss's implicit Runge-Kutta rule of two stages has order 4 and allows any step with the
stiff part of the equations (Hairer and Wanner, Solving Ordinary Differential Equations
II, IV.5 and IV.8). The accelerations W of both stages of a step h solve

$$M W + C\,(v 1^T + h W A^T) + K\,(q 1^T + h v (A1)^T + h^2 W (A^2)^T) = P - D F,$$

where C includes ωG. A complex eigenvector of Aᵀ with the eigenvalue λ separates the
stages. The sparse matrix M + hλ C + h²λ² K, factored for each step size, gives the
responses to the loads and to unit forces at the joints: bearings, and elements to the
ground. Newton's method then solves for the relative displacements at both stages, 4
unknowns per joint, or 8 with their rates if a force depends on these. */
#pragma once

#include <Eigen/SparseLU>
#include <map>
#include <memory>
#include <vector>

#include "io/matrix_market.hpp"
#include "model/large_machine.hpp"
#include "time/flow.hpp"

namespace rotor_stator {

class GaussStepper : public Flow {
public:
  /** P = `intervals` per base period. `tolerance`: of u in a step, over its size. */
  GaussStepper(const LargeBodies& machine, const Parameters& parameters, double omega,
               int intervals, double tolerance, OperationBudget budget = {});

  /** Advances over output interval `interval`, counted from t = 0. Throws NoSolution when
      the budget is used up. */
  void advance(long interval, State& state) override;
  void advance_beside(long interval, State& state) override;

  /** The derivative of that map at `start`, 2n × 2n. */
  Eigen::MatrixXd derivative(long interval, const State& start);

  /** Of the forces of all joints. */
  long evaluations() const override { return evaluations_; }

private:
  using Sparse = Eigen::SparseMatrix<std::complex<double>>;

  /** What belongs to a step size. Its matrices give what the forces depend on, u [m] of
      the joints at both stages and perhaps their rates [m/s]; below it u after the step;
      below that the state after it, 2n rows. */
  struct Level {
    double step;  ///< [s]
    Eigen::SparseLU<Sparse> factors;
    Eigen::MatrixXd per_force;  ///< what forces of the joints take at both stages
    Eigen::MatrixXd unforced;   ///< of a state, and of 1, cos, sin; where few coordinates
    Eigen::VectorXd force;      ///< of the joints at both stages of the last step
    long steps = 0;
  };
  Level& level(int k);
  Eigen::MatrixXd answer(const Level& level, const Eigen::MatrixXcd& x) const;
  Eigen::MatrixXd unforced_by_factors(const Level& level, const double* angle,
                                      const Eigen::MatrixXd& y) const;
  Eigen::MatrixXd all_unforced(const Level& level) const;
  Eigen::MatrixXd unforced(Level& level, double angle, const Eigen::MatrixXd& y,
                           Eigen::Index rows) const;
  /** At most four joints: small vectors and matrices without heap memory. */
  static constexpr int most_forces = 16, most_seen = 2 * most_forces;
  using Seen = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_seen, 1>;
  using Slopes =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_forces, most_seen>;
  Seen reaction(const double* phases, const Seen& seen, Slopes& slopes);
  enum class After { state, joints };
  bool step(Level& level, double phase, Eigen::MatrixXd& y, After after = After::state);
  void integrate(long interval, Eigen::MatrixXd& y);

  /** Rows of what the forces depend on, at both stages; and with u after the step. */
  Eigen::Index seen() const { return (is_damped_ ? 4 : 2) * joints_.cols(); }
  Eigen::Index with_end() const { return seen() + joints_.cols(); }

  std::vector<BallBearing> forces_;  ///< of the joints
  std::vector<Bearing> cages_;
  bool is_damped_ = false;
  double omega_, turns_, length_, interval_, tolerance_;  ///< interval_ [s]
  double last_change_;  ///< of u in Newton, beyond which the force is taken as linear [m]
  SparseMatrix mass_, damping_, stiffness_, joints_;
  Eigen::VectorXd rest_;
  Eigen::VectorXcd unbalance_;
  int first_, now_;         ///< k of the longest step and of the present one
  std::vector<int> taken_;  ///< k of the steps of the last motion, two halves each
  std::map<int, std::unique_ptr<Level>> levels_;
  OperationBudget budget_;
  double price_;
  long evaluations_ = 0;
};

}  // namespace rotor_stator
