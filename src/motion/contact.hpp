/**
# The contact of the balls along a motion

The force Q_j of every ball is given over two periods, 2T. With the paper's ω_cage = ω/2
the rotating contact passes each ball once in 2T (D-11, D-20); for other bearings two
periods are a convention. */
#pragma once

#include <optional>

#include "motion/motion.hpp"

namespace rotor_stator::motion {

/** Share of the instants with at least one loaded ball, of any bearing; of one of them,
    counted from 0 [-]. */
double contact_share(const Parameters& parameters, const Motion& motion,
                     std::optional<std::size_t> bearing = {});

/** Whether any ball is loaded in a solution of harmonic balance. */
bool touches(const Parameters& parameters, PeriodicMotion solution);

/** Q_j [N] at P instants per period, a row each. Ball j stands where Eq. 3 puts it, with
    t counted as the motion counts it. A motion of one period is repeated. `bearing`
    counts from 0. */
Eigen::MatrixXd ball_forces(const Parameters& parameters, const Motion& motion,
                            long periods = 2, std::size_t bearing = 0);

/** The largest force on a ball along a motion, where three instants of that ball lie on a
    parabola [N]. */
double largest_ball_load(const Parameters& parameters, const Motion& motion,
                         std::size_t bearing = 0);

/** Times that each ball is loaded anew in two periods, counted around the end. */
std::vector<int> passages_per_ball(const Eigen::MatrixXd& forces);

}  // namespace rotor_stator::motion
