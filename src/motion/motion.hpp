/**
# Motions: what harmonic balance and time integration both give

A motion holds the displacements of both bodies at equally spaced phases. Figures are
computed from it alone, so that both methods enter the same table. */
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "balance/periodic_motion.hpp"
#include "time/steady_state.hpp"

namespace rotor_stator::motion {

/** P instants per period, over one or more periods, from phase 0. */
struct Motion {
  int points_per_period;
  long first_period;  ///< periods since t = 0, for the cage's angle
  std::vector<Bodies> positions;
  std::vector<Vec2> rates = {};  ///< u̇ [m/s], for the force of a damped contact
  double omega = 0;              ///< the base frequency that belongs to them [rad/s]
  /** Of a large machine: its other displacements, and the rates of all. */
  std::vector<Eigen::VectorXd> further = {}, velocities = {};

  std::size_t size() const { return positions.size(); }
  double t_over_period(std::size_t k) const
  {
    return static_cast<double>(k) / points_per_period;
  }

  /** ωt [rad] of the base frequency, counted from t = 0: the rotor's angle where the base
      period is a turn. */
  double phase(std::size_t k) const;
};

/** Appends an instant. */
void add(Motion& motion, const State& state);

/** Whole periods by a stepper that cuts each into P intervals, from `state` at the start
    of period `first_period`; `state` is left at their end. */
inline Motion recorded(Flow& stepper, int points_per_period, State& state,
                       long first_period = 0, long periods = 1)
{
  Motion motion{points_per_period, first_period, {}};
  const long begin = first_period * points_per_period;
  for (long k = begin; k < begin + periods * points_per_period; ++k) {
    add(motion, state);
    stepper.advance(k, state);
  }
  return motion;
}

/** How often what is quickest vibrates in a base period: the contact, or the force while
    a ball passes a spall, taken for four vibrations. */
double vibrations_of(const Parameters& parameters, double omega);

/** Instants in a base period that resolve the motion: 256 to 4096 in a turn, twelve in
    such a vibration. No peak is missed by more than 4 % then, or a thousandth where a
    parabola is laid through it. */
int instants_of(const Parameters& parameters, double omega);

/** x_s, y_s, x_r, y_r [m] at the instants of a motion, a row each. */
Eigen::MatrixXd displacement_samples(const Motion& motion);

/** The series of x_s, y_s, x_r, y_r over the first period of a motion [m], 4 × (2m+1);
    and that of the relative motions u of all joints as the unknowns of a balance. */
Eigen::MatrixXd series_of(const Motion& motion, int harmonics);
Eigen::VectorXd relative_series(const Parameters& parameters, const Motion& motion,
                                int harmonics);

/** The relative motions u of all joints at the instants of a motion, N × 2b [m]. */
Eigen::MatrixXd relative_samples(const Parameters& parameters, const Motion& motion);

/** `points` instants of one period of a solution, from its series of both bodies; the
    second with its rates. */
Motion motion_of(const Eigen::MatrixXd& bodies, int points);
Motion motion_of(const PeriodicMotion& solution, int points);

/** `turns` turns of a solution with any frequencies, `points` instants each, from turn
    `first` after t = 0. */
Motion motion_of(const Parameters& parameters, const PeriodicMotion& solution, int points,
                 int turns, long first = 0);

/** The state [m, m/s] of a periodic motion at phase 0; the second of any machine, and of
    a motion with two frequencies. */
State state_of(const PeriodicMotion& motion);
State state_of(const Parameters& parameters, const PeriodicMotion& motion);

/** The periods kept by a time integration. */
Motion motion_of(const SteadyState& steady, int points_per_period);

/** One base period from `state` at phase 0, at the instants that `settings` cuts it
    into. */
Motion one_period(const Parameters& parameters, double omega, State state,
                  const StepSettings& settings);

/** All of a record as one period: what differences are taken over. */
Motion as_one_period(Motion motion);

/** A recorded motion cut into pieces of so many periods; an odd rest is left out. */
std::vector<Motion> pieces(const Motion& motion, int periods);

/** The mean of a measure over these pieces. */
BatchMean mean_over(const Motion& motion, int periods,
                    const std::function<double(const Motion&)>& measure);

/** Coordinate `place` of a large machine at instant k [m]; 0 of the ground, -1. */
double shown_at(const Motion& motion, std::size_t k, int place);

/** u at instant k of a joint with these places of x_s, y_s, x_r, y_r [m]. */
Vec2 relative_at(const Motion& motion, std::size_t k, const std::array<int, 4>& places);

/** Where everything in a joint stands at instant k, and how u changes: the joints are
    counted from 0, bearings first. Throws NoSolution for a damped one without rates. */
struct BearingInstants {
  BearingInstants(const Parameters& parameters, const Motion& motion,
                  std::size_t joint = 0);
  Angles angles(std::size_t k) const { return bearing.angles(motion.phase(k)); }
  Vec2 u(std::size_t k) const;
  Vec2 rate(std::size_t k) const;
  Vec2 force(std::size_t k) const { return bearing.force(angles(k), u(k), rate(k)); }
  bool touches(std::size_t k) const
  {
    const Vec2 f = bearing.ball_force(angles(k), u(k), rate(k));
    return f.x != 0 || f.y != 0;
  }

  const Motion& motion;
  BallBearing bearing;
  std::array<int, 4> places;  ///< of x_s, y_s, x_r, y_r at the joint
};

/** Eq. 6: the bearing's force [N] on the stator at each instant of a motion; also of
    another bearing than the first. */
std::vector<Vec2> bearing_forces(const Parameters& parameters, const Motion& motion,
                                 std::size_t joint = 0);

/** Half peak-to-peak of x_s, y_s, x_r, y_r [m] over the instants of a motion. */
Displacements half_peak_to_peak(const Motion& motion);

/** Their means, and rms about these [m]. */
Displacements mean_of(const Motion& motion);
Displacements rms_of(const Motion& motion);

/** The largest difference over the four displacements, over the largest displacement of
    `reference`, on the first period of both [-]; both have the same points per period. */
double relative_difference(const Motion& motion, const Motion& reference);

/** The rms difference of the two motions about their means, over that of `reference`
    about its mean, all four displacements together, at all instants of `reference`, along
    which `motion` is repeated: blind to the static deflection [-]. */
double rms_difference(const Motion& motion, const Motion& reference);

/** Both, as the error of a motion. */
struct Error {
  double largest = 0, rms = 0;
  double larger() const { return std::max(largest, rms); }
};
Error difference(const Motion& motion, const Motion& exact);

/** For the bearing's force: largest |F - F_ref| over the largest |F_ref| [-]. */
double relative_force_difference(const Parameters& parameters, const Motion& motion,
                                 const Motion& reference);

}  // namespace rotor_stator::motion
