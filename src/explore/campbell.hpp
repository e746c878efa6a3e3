/**
# explore campbell

Whirl of a machine whose bearings are springs. Each spring is the mean contact stiffness:
the derivative of the bearing's force, averaged over the angles of the cage, at the
displacement where that mean force carries weights and loads (found by Newton's
iteration). At each speed ω the eigenvalues λ of

$$M\ddot q + (C + \omega G)\,\dot q + (K + D \bar S D^T)\, q = 0$$

give frequencies Im λ/2π and damping ratios -Re λ/|λ|. A mode whirls forward where its
ellipses turn as the rotor does. At a critical speed a frequency is that of the unbalance
(1X) or of the passing balls. */
#pragma once

#include "explore/orbit.hpp"

namespace rotor_stator::explore {

struct CampbellRequest : Request {
  double from = 0, to = 0;  ///< speeds [Hz]
  int count = 0;            ///< of speeds, evenly spaced
  int modes = 8;            ///< of lowest frequency
  bool critical = false;    ///< critical speeds instead of frequencies
};

/** Throws BadInput for a range that is none. */
Exploration explore_campbell(const CampbellRequest& request);

/** Damped frequencies [Hz] of the lowest modes without rotation, ascending, at most so
    many. */
std::vector<double> natural_frequencies(const Parameters& parameters, std::size_t most);

}  // namespace rotor_stator::explore
