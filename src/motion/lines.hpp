/**
# The lines of a motion

A motion with few frequencies is a sum of lines. Each has an order, its frequency over the
speed, and an amplitude in each displacement. A line of the machine has the frequency

$$2\pi f = k_{rotation}\,\omega + k_{cage}\,\omega_{cage} + k_{spin}\,\omega_{ball},$$

with ω_ball a ball's rotation about itself, seen from the cage. X = ω, BPFO = n ω_cage,
BPFI = n (ω - ω_cage), FTF = ω_cage, BSF = ω_ball.

The name of a line is the shortest sum of multiples of X, BPFO and BPFI. Its length is the
sum of the absolute multiples, those of BPFO and BPFI doubled; of equally long sums that
with the fewest terms, then with the smallest multiple of BPFI, is taken. A multiple of X
may be h/K, K ≤ 8, where n c is whole. A line without such a name may be a multiple of FTF
or of BSF. Where a ball is damaged, 2sBSF + jFTF + hX is a name too, if its
2s + |j|/2 + |h| is smaller. */
#pragma once

#include <string>
#include <vector>

#include "motion/motion.hpp"

namespace rotor_stator::motion {

struct Line {
  double order;             ///< f over the speed [-]
  Displacements amplitude;  ///< of x_s, y_s, x_r, y_r [m]

  double largest() const { return std::ranges::max(amplitude); }
};

struct Lines {
  Displacements mean = {};  ///< [m]
  std::vector<Line> lines = {};
  double rest = 0;  ///< rms that no line holds, over the rms about the mean [-]
};

/** Of a solution of harmonic balance, whose base period is `turns` turns. */
Lines lines_of(const Bearing& bearing, const PeriodicMotion& solution, int turns = 1);

/** Of a motion that closes after `turns` turns, its one period: by Fourier transform. */
Lines lines_of_closed(const Motion& motion, double turns);

/** Of a motion recorded over many turns: its peaks, then all amplitudes together by least
    squares, weighted by a window of Blackman and Harris, then the peaks of what is left,
    until none is above `least` of the largest. A peak within `near` of the resolution,
    one over the number of turns, of a frequency of the machine is taken to be there. At
    most 200 lines. */
Lines lines_of_recorded(const std::vector<Bearing>& bearings, const Motion& motion,
                        double near = 0.2, double least = 1e-6);

/** A frequency of the machine; its name is empty when the line has none. */
struct LineName {
  double rotation = 0, cage = 0, spin = 0;  ///< k of the equation above
  std::string name = {};
  double length = 1e3;      ///< of a sum; less is better
  std::size_t bearing = 0;  ///< whose cage and balls

  double order(const Bearing& own) const;
};

/** The shortest name of an order, at most `tolerance` off, with k_cage at most n
    `passages`; half-integer k of both frequencies, of a motion that has doubled its
    periods, up to an eighth of that. */
LineName name_of(double order, const Bearing& bearing, double tolerance, int passages);

/** The shortest by any of the bearings: the frequencies of the second are BPFO_2, … */
LineName name_of(double order, const std::vector<Bearing>& bearings, double tolerance,
                 int passages);

/** 4-term window of Blackman and Harris for a record of `samples`, its sum 1; its side
    lobes are below -92 dB. */
Eigen::VectorXd blackman_harris(Eigen::Index samples);

}  // namespace rotor_stator::motion
