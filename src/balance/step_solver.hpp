/**
# Linear equations of a Newton step (GMRES)

The generalised minimal residual method of Saad and Schultz (1986), preconditioned from the
right, so that its residual is that of the equations. Eigen's own (unsupported) takes a relative
tolerance only, allocates at each call and wants the operator dressed as a sparse matrix. */
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <functional>
#include <vector>

#include "balance/balance.hpp"

namespace rotor_stator {

class Gmres {
public:
  using Operator =
      std::function<void(const Eigen::VectorXd& v, Eigen::VectorXd& product)>;

  struct Report {
    int iterations;
    double residual;  ///< ‖b - A x‖
  };

  /** Solves A x = b from x = 0 until ‖b - A x‖ ≤ `goal`, in at most `most_iterations`.
     `precondition` applies an approximate inverse of A. */
  Report solve(const Operator& apply, const Operator& precondition,
               const Eigen::VectorXd& b, double goal, int most_iterations,
               Eigen::VectorXd& x);

private:
  void orthogonalise(int k);
  void rotate(int k);

  Eigen::MatrixXd basis_;       ///< orthonormal, one column per iteration
  Eigen::MatrixXd hessenberg_;  ///< made triangular by the rotations
  Eigen::VectorXd cosine_, sine_, right_, again_, product_, preconditioned_;
};

/**
## The equations and their preconditioner

What is expensive is kept from step to step and from speed to speed: the LU factors of the low
harmonics' block of the Jacobian, where the contact couples everything, and beyond them one
small inverse per harmonic, where the bodies' inertia decides. With few harmonics that is the
whole Jacobian. A step then is either

- fresh: the factors are those of the present point and hold all harmonics;
- a chord: older factors of all harmonics, where there are few;
- iterated: GMRES on the present Jacobian, preconditioned by the factors, old or new. Its cost
  per iteration is that of the transforms, m log m.

Where the contact couples more than 32 harmonics, and the problem knows its bodies, the preconditioner is that of the
equations in time (equations_in_time.hpp), made anew for each step: the whole step then costs m log m. Their own answer to the
residual is the step as long as it leaves less than a third of it; after that GMRES takes it further. */

enum class StepKind { fresh, chord, iterated };

/** Vectors of Newton's iteration, kept so that they are allocated once. */
struct NewtonVectors {
  Eigen::VectorXd residual, step, start, next;
};

class StepSolver {
public:
  /** Solves ∂R/∂X step = -`residual` at (X, ω). `goal` is the linear residual an iterated step may
     leave. */
  StepKind step(Balance& balance, const Eigen::VectorXd& x, double omega,
                const Eigen::VectorXd& residual, double goal, Eigen::VectorXd& step);

  /** The negative of the step for another residual, with the factors of the last one. */
  void solve_again(Balance& balance, const Eigen::VectorXd& residual,
                   Eigen::VectorXd& step) const
  {
    precondition(balance, residual, step);
  }

  /** A new solution begins. A chord step that leaves more than `chord_contraction` of the
     residual ends the use of its factors. */
  void begin(double chord_contraction)
  {
    entering_ = answers_in_time_ = true;
    chord_contraction_ = chord_contraction;
  }

  /** What the last step, whole, left of the residual [-]. */
  void learn(double contraction);

  /** The dense block holds all harmonics, however many. */
  void hold() { holds_ = true; }

  /** Preconditions by the blocks of these places in the list, each of which is in one of them. */
  void divide(std::vector<std::vector<int>> parts);

  /** The next step factors the Jacobian anew. */
  void forget() { factored_ = false; }

  /** Whether the next step from the same point would be a better one: the last was a chord or an answer in time, or
     GMRES stalled and has a larger block to try. */
  bool retries() const
  {
    return !factored_ && (last_ == StepKind::chord || stalled_ || answered_);
  }

  /** Whether the next step is likely to be a chord: it needs no stiffness. */
  bool expects_chord() const { return factored_ && takes_chords() && !entering_; }

  /** GMRES did not reach the goal of the last step. */
  bool stalled() const { return stalled_; }

  long factorisations() const { return factorisations_; }
  long linear_iterations() const { return linear_iterations_; }

  NewtonVectors vectors;

private:
  bool takes_chords() const;
  bool chord_pays(double decrease) const;
  void factor(Balance& balance, const Eigen::VectorXd& x, double omega);
  void factor_parts(Balance& balance, const Eigen::VectorXd& x, double omega);
  void precondition(Balance& balance, const Eigen::VectorXd& r, Eigen::VectorXd& z) const;
  void iterate(Balance& balance, const Eigen::VectorXd& x, double omega,
               const Eigen::VectorXd& residual, double goal, bool are_new,
               Eigen::VectorXd& step);

  bool factored_ = false, is_complete_ = false, entering_ = true;
  StepKind last_ = StepKind::fresh;
  bool stalled_ = false;
  double chord_contraction_ = 0;
  double contraction_ = 0;           ///< of the last step with these factors
  double entering_contraction_ = 0;  ///< of the last first step with older factors
  int low_ = 0;                      ///< harmonics in the dense block
  bool holds_ = false;               ///< it is to hold all of them
  bool in_time_ = false;             ///< instead the equations of motion at the samples
  bool answers_in_time_ = true;      ///< their own steps are good enough in this solution
  bool answered_ = false;            ///< the last step was theirs
  bool stalls_in_time_ = false;      ///< which GMRES with them once did
  int least_low_ = 16;               ///< grows when GMRES stalls
  Eigen::MatrixXd low_jacobian_;
  Eigen::PartialPivLU<Eigen::MatrixXd> low_factors_;
  Eigen::MatrixXd high_inverses_;  ///< 2d × 2d blocks side by side
  struct Part {
    std::vector<int> places, unknowns;
    Eigen::PartialPivLU<Eigen::MatrixXf> factors = {};  ///< they precondition only
  };
  std::vector<Part> parts_;   ///< instead of all that, where there are any
  int least_iterations_ = 0;  ///< of GMRES, with new factors of parts
  Gmres gmres_;
  long factorisations_ = 0, linear_iterations_ = 0;
};

}  // namespace rotor_stator
