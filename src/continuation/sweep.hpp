/**
# The paper's predictor (Eqs 19 to 21)

The solution at the next speed is predicted by a cubic through the last four. These
solutions (X_i, ω_i) are points on a curve whose arc length is measured by chords,

$$\delta s_{i+1} = \sqrt{\|X_{i+1} - X_i\|^2 / \ell^2 + (\omega_{i+1} - \omega_i)^2 /
\omega_{ref}^2}, \tag{19}$$

with X scaled by a length ℓ and ω by a reference speed: as printed, metres are added to
rad/s and ω alone decides (D-03). Summed up,

$$S_0 = 0, \quad S_{i+1} = S_i + \delta s_{i+1}, \quad S_4 = S_3 + \Delta s, \tag{21}$$

they are the argument of the cubic through the four points, which is evaluated at S_4:

$$(X_4, \omega_4) = \sum_{i=0}^{3} \Big(\prod_{j \ne i} \frac{S_4 - S_j}{S_i - S_j}\Big)\,
(X_i, \omega_i). \tag{20}$$

As printed, with S_3 in the numerator, it returns the last point unchanged (D-02). With
fewer points the polynomial has a lower degree. */
#pragma once

#include <deque>

#include "balance/newton.hpp"
#include "io/budget.hpp"
#include "model/parameters.hpp"

namespace rotor_stator {

class LagrangePredictor {
public:
  LagrangePredictor(double unknown_scale, double speed_scale)
      : unknown_scale_(unknown_scale), speed_scale_(speed_scale)
  {
  }

  /** Of coefficients that differ in number the shorter are filled with zeros. */
  void add(Eigen::VectorXd x, double omega);
  void clear() { points_.clear(); }
  bool empty() const { return points_.empty(); }

  /** Eq. 20 at S_3 + Δs: the extrapolated (X, ω). */
  PeriodicMotion at_arc(double delta_s) const;

  /** The extrapolated X at a prescribed speed: Δs is chosen so that ω(S_4) = ω. */
  Eigen::VectorXd at_speed(double omega) const;

private:
  Eigen::VectorXd weights(double s) const;
  double speed_at(double s) const;

  double unknown_scale_, speed_scale_;
  struct Point {
    Eigen::VectorXd x;
    double omega, arc;  ///< S_i (Eq. 21)
  };
  std::deque<Point> points_;  ///< at most four
};

/**
## A sweep at prescribed speeds, as the paper does it

At each speed Newton starts from the paper's predictor. When it fails, the gap to the
speed is halved (the solutions in between feed the predictor and are not kept); when that
fails too the speed has no solution on this branch, which is recorded, and the next speed
starts anew. */

/** The first three have no default: Newton's settings and the two scales of Eq. 19, which
    are all that a sweep at prescribed speeds needs. Steps are scaled arc lengths [-]. */
struct ArcLengthSettings {
  NewtonSettings newton;
  double speed_scale;        ///< ω_ref [rad/s]
  double arc_unknown_scale;  ///< ℓ, in the unknowns' unit
  double most_step = 0.05;
  long most_evaluations = 1000000;  ///< of the force: the bound on work
};

/** Those for one machine: scaled by the bearing's length and by the joint resonance
    (D-03). */
ArcLengthSettings arc_length_settings(const Parameters& parameters,
                                      const NewtonSettings& newton = {});

/** A start for Newton where no previous solution is at hand. */
using ColdStart = std::function<Eigen::VectorXd(double omega)>;

/** The start of a motion that the predictor led to. All others of a sweep are cold: they
    may lie on another branch than the one before. */
inline constexpr const char* from_predictor = "predictor";

/** Solves at each of `omegas` in order. Where no solution was found `x` is empty;
    `newton` is of the last attempt, its `iterations` and `force_samples` of all attempts
    at this speed. */
std::vector<PeriodicMotion> sweep(Balance& balance, const std::vector<double>& omegas,
                                  const ColdStart& cold_start,
                                  const ArcLengthSettings& settings);

/** The same for a machine, cold from quasi-static contact, with the series of both
    bodies; 0 samples are `default_samples`. Paid for from `budget`. */
std::vector<PeriodicMotion> sweep(const Parameters& parameters,
                                  const std::vector<double>& omegas, int harmonics,
                                  int samples = 0, const OperationBudget& budget = {});

/**
## The peak of a response curve */

/** A point of a response curve: speed [Hz] and amplitude [m]. */
struct CurvePoint {
  double frequency, amplitude;
};

/** The highest point of a curve, refined by the parabola through it and its neighbours;
    the point itself at an end of the curve. */
CurvePoint refined_peak(const std::vector<CurvePoint>& curve);

}  // namespace rotor_stator
