/**
# A branch of solutions

A branch is followed in the scaled unknowns y = (X/ℓ, ω/ω_ref), in which a step along it
is measured. It is a row of solutions with the unit tangent at each; between two of them
the cubic with both tangents stands for it. */
#pragma once

#include <Eigen/LU>
#include <functional>

#include "continuation/curve.hpp"
#include "continuation/sweep.hpp"

namespace rotor_stator {

struct BranchPoint;

/** The first three have no default: two scales of the problem and Newton's settings.
    Lengths are scaled arc lengths [-]. */
struct ArcLengthSettings {
  NewtonSettings newton;
  double speed_scale;        ///< ω_ref [rad/s]
  double arc_unknown_scale;  ///< ℓ, in the unknowns' unit
  double first_step = 0.01;
  double least_step = 1e-7;
  double most_step = 0.05;
  double most_turn = 0.5;            ///< angle between successive tangents [rad]
  double wanted_turn = 0.25;         ///< the step grows below it, shrinks above it [rad]
  double most_bend = 0.1;            ///< angle between chord and mean tangent [rad]
  double wanted_bend = 0.03;         ///< as for the turn [rad]
  double most_contraction = 0.5;     ///< second over first Newton correction [-]
  double wanted_contraction = 0.15;  ///< as for the turn [-]
  double fold_tolerance = 1e-8;      ///< of the folds' speeds, relative
  int most_points = 100000;
  long most_evaluations = 1000000;  ///< of the force: the bound on work
  std::function<void(const BranchPoint&)> watch =
      {};  ///< sees each point when it is kept
};

struct BranchPoint {
  PeriodicMotion motion;
  double arc = 0;                ///< scaled arc length from the start [-]
  Eigen::VectorXd tangent = {};  ///< unit, scaled: of X/ℓ, then of ω/ω_ref

  /** dω/ds over ω_ref [-]; changes sign at a fold. */
  double speed_direction() const { return tangent[tangent.size() - 1]; }
};

/** The settings of arc length for one machine, scaled as its sweeps are. */
ArcLengthSettings arc_length_settings(const Parameters& parameters,
                                      const NewtonSettings& newton = {});

/** How a branch ended. `goal`: at the end of the range. `came_back`: at the edge where it
    began. `closed`: at its first point, going the same way. `on_itself`: at another of
    its points. The rest: out of work, of points, or of step length. */
enum class BranchEnd { goal, came_back, closed, on_itself, work, points, step };

struct Branch {
  std::vector<BranchPoint> points;  ///< folds included
  std::vector<double> folds;        ///< speeds [rad/s] of the folds, in order
  bool covered;                     ///< the end of the range was reached
  std::string end;                  ///< why it stopped
  BranchEnd kind = BranchEnd::goal;
  long evaluations = 0;  ///< of the force: the work done
};

/** y = (X/ℓ, ω/ω_ref), n+1 values. */
Eigen::VectorXd scaled(const BranchPoint& point, const ArcLengthSettings& settings);

/** Angle [rad] between two unit vectors, accurate when it is small. */
double angle(const Eigen::VectorXd& a, const Eigen::VectorXd& b);

/** The cubic through `a` and `b` with both tangents, scaled: between them at 0 ≤ r ≤ 1,
    continued beyond b at r > 1. */
Eigen::VectorXd between(const BranchPoint& a, const BranchPoint& b, double r,
                        const ArcLengthSettings& settings);

/** The same point, walked through the other way. */
BranchPoint reversed(BranchPoint point);

/**
## Newton on a curve

The n equations of a curve are closed by one linear condition d·(y - y_predicted) = 0.
With d near the branch's tangent the bordered Jacobian stays regular where the branch
folds back in ω (Keller 1977). The corrector is Newton without damping: where it does not
contract, the step was too long, and a damped Newton would look for another solution far
away. Its factors are kept while a correction leaves less than a tenth of itself, with
Broyden's updates from the steps taken (Kelley 1995, section 7.3). They serve the tangent
too, which iterations on the Jacobian at the solution refine. */

/** Where Newton ended, and how fast it was (Den Heijer and Rheinboldt 1981). */
struct Correction {
  PeriodicMotion motion = {};
  Eigen::VectorXd y;       ///< scaled
  double contraction = 0;  ///< the largest ‖Δy_{k+1}‖/‖Δy_k‖ above rounding [-]
};

/** The unit tangent, and the sign of the bordered Jacobian's determinant: along a branch
    that is followed in one direction the sign stays the same, through folds too. */
struct Tangent {
  Eigen::VectorXd direction;
  bool positive;
};

class Corrector {
public:
  Corrector(Curve& curve, const ArcLengthSettings& settings);

  Curve& curve() const { return curve_; }

  /** The longest last correction with which Newton may end [-]. */
  double last_correction() const;

  /** Newton on the curve and direction·(y - predicted) = 0, from `predicted`. */
  Correction correct(const Eigen::VectorXd& direction, const Eigen::VectorXd& predicted);

  /** At y, on the side of `previous`. */
  Tangent tangent(const Eigen::VectorXd& y, const Eigen::VectorXd& previous);

private:
  NewtonEnd verdict(const Correction& correction, double length, double ratio) const;
  void factor(const Eigen::VectorXd& y, const Eigen::VectorXd& last_row);
  bool refine(const Eigen::VectorXd& y, double error, Eigen::VectorXd& tangent);

  Curve& curve_;
  const ArcLengthSettings& settings_;
  Eigen::Index n_;
  Eigen::MatrixXd matrix_;
  Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
  Eigen::VectorXd last_row_;  ///< of the matrix that they are of
};

/** The solution near `x` at `omega` with its tangent, on the side of higher speeds if
    `upwards`. Throws NoSolution when there is none. */
BranchPoint point_of(Curve& curve, double omega, const Eigen::VectorXd& x, bool upwards,
                     const ArcLengthSettings& settings);

}  // namespace rotor_stator
