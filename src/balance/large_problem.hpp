/**
# Bodies given by matrices as a harmonic-balance problem

However large the bodies, the balance has two unknowns per harmonic and bearing. Per
harmonic of frequency Ω all n unknowns condense exactly to the relative displacements u =
Dᵀq of the b bearings,

$$(I - k H)\, u_h + H F_h(u) = D^T S^{-1} p_h, \qquad H = D^T S^{-1} D,\qquad
S = K + k D D^T - \Omega^2 M + i\Omega\,(C + \omega G),$$

for any spring k that is added to the bearings and taken off their forces. Here it is k_0
at rest and k_0(1 + i) for a vibration, so that no resonance of the bodies with k_0,
however little damped, makes S singular. */
#pragma once

#include "balance/bearing_problem.hpp"
#include "model/large_machine.hpp"
