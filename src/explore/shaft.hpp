/**
# explore shaft

The matrices of a turning shaft of round Timoshenko beam elements with disks, concentrated
masses and linear supports. Node k has four degrees of freedom, 4(k-1) + 1 … 4: x, y [m]
and their slopes dx/dz, dy/dz. In either plane an element of length L with Φ = 12 EI/(κ GA
L²) has, over (x₁, x₁', x₂, x₂'),

$$K = \frac{EI}{L^3 (1 + \Phi)}
\begin{pmatrix} 12 & 6L & -12 & 6L \\ & (4+\Phi) L^2 & -6L & (2-\Phi) L^2 \\
& & 12 & -6L \\ & & & (4+\Phi) L^2
\end{pmatrix},$$

the consistent masses ρA and ρI of the same shape functions, and gyroscopic moments of
twice the rotary inertia between the planes (Friswell, Penny, Garvey and Lees, Dynamics of
Rotating Machines, 2010, chapter 5). κ is Cowper's. The moments of a body with polar
inertia I_p at the speed ω are I_p ω d(dy/dz)/dt on dx/dz and the opposite on dy/dz: a
whirl in the direction of rotation becomes faster with the speed. */
#pragma once

#include "explore/orbit.hpp"

namespace rotor_stator::explore {

struct ShaftRequest : Request {
  std::string folder;  ///< for M.mtx, C.mtx, G.mtx, K.mtx
};

Exploration explore_shaft(const ShaftRequest& request);

}  // namespace rotor_stator::explore
