/**
# Bodies given by matrices in time

The stiff part of the equations is linear and is solved exactly. With the spring k_0 in every bearing the machine has
the modes λ, and in their coordinates

$$\dot y = \Lambda y + \beta\, g(t), \qquad g = F(u, t) - k_0 u,\qquad u = u_p(t) + D_u y,$$

where u_p answers weights, loads and unbalance in closed form. g alone is integrated numerically, by the exponential
Runge-Kutta rule of order 4 of Cox and Matthews (J. Comput. Phys. 176 (2002) 430), at steps h/2^k of which the
difference between one step and two halves chooses the next. All n degrees of freedom take part, however stiff. */
#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "io/budget.hpp"
#include "model/large_machine.hpp"

namespace rotor_stator {

class ExponentialStepper {
public:
  /** P = `intervals` per base period. `tolerance`: of u in a step, over its size. */
  ExponentialStepper(const Parameters& parameters, double omega, int intervals,
                     double tolerance, OperationBudget budget = {});

  /** Advances over output interval `interval`, counted from t = 0. Throws NoSolution when the budget is used up. */
  void advance(long interval, State& state);

  /** The derivative of that map at `start`, 2n × 2n. */
  Eigen::MatrixXd derivative(long interval, const State& start);

  /** Of the forces of all bearings. */
  long evaluations() const { return evaluations_; }

private:
  /** Complex factors of the modes: pairs, then real ones. */
  struct Factors {
    Eigen::ArrayXd real, imaginary;
  };
  struct Level {
    double step;  ///< [intervals]
    Factors half, whole;
    Eigen::MatrixXd to_half, f_1, f_2, f_3;
  };

  void find_modes(const LargeMachine& machine);
  template <class Function>
  Factors factors(Function function, double seconds) const;
  Eigen::MatrixXd times(const Factors& factors, const Eigen::MatrixXd& y) const;
  const Level& level(int k);
  Eigen::VectorXd driven(double at) const;
  Eigen::MatrixXd forces(const Eigen::MatrixXd& y, double at);
  void step(const Level& level, double at, Eigen::MatrixXd& y);
  void integrate(long interval, Eigen::MatrixXd& y);

  std::vector<Bearing> bearings_;
  std::vector<BallBearing> forces_;
  double turns_, speed_, spring_, length_, tolerance_, interval_;  ///< interval_ [s]
  int intervals_, first_, now_ = 0;
  FreeMotion free_;
  Eigen::MatrixXd joints_;
  Eigen::Index pairs_ = 0;
  Eigen::ArrayXd decay_, frequency_;  ///< of pairs and real modes: λ [1/s]
  Eigen::MatrixXd to_state_, to_modes_, inputs_, outputs_;
  std::map<int, Level> levels_;
  OperationBudget budget_;
  double price_;
  long evaluations_ = 0;
};

}  // namespace rotor_stator
