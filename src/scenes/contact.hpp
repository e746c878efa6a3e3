/**
# Scene: contact evolution (Figs 7 and 9)

The force Q_j of every ball over two periods, 2T, because with ω_cage = ω/2 each ball is
passed by the rotating contact once per 2T (D-11, D-20). The motion is the periodic solution
where time integration confirms one, and the integrated motion elsewhere. */
#pragma once

#include "scenes/orbits.hpp"

namespace rotor_stator
{

/** Ball forces at P instants per period over two periods. */
struct ContactEvolution {
  std::vector<double> t_over_period;            ///< 0 ≤ t/T < 2
  std::vector<std::vector<double>> ball_force;  ///< [instant][ball] Q_j [N]
};

/** Ball j stands where Eq. 3 puts it, with t counted as the motion counts it. A motion of
   one period is repeated. */
ContactEvolution contact_evolution(const Parameters& parameters, const Motion& motion);

struct ContactPanel {
  OrbitPanel orbit;
  ContactEvolution evolution;
};

std::vector<ContactPanel> compute_contact(const OrbitScene& scene);

}  // namespace rotor_stator
