/**
# Fewer coordinates for a large body

Nothing but its bearings and its own loads moves a body. At a frequency Ω and a speed ω it
is therefore one of few shapes

$$x = Z^{-1} b,
\qquad Z(\Omega, \omega) = K + k E E^T - \Omega^2 M + i\Omega\,(C + \omega G),$$

with b a unit force on a degree of freedom of a bearing (E), or its unbalance; k holds the
body as k_0(1 + i) does in harmonic balance. The shapes at rest and at some (Ω, ω), real
and imaginary parts, M-orthonormal, are a basis V, and Vᵀ M V, Vᵀ C V, … take the place of
the matrices (a rational Krylov space, projected by Galerkin). At the points of the basis
nothing is lost. Points are drawn at random over the range asked for; those at which the
receptances are wrong join the basis, until so many in a row are right that had no part in
it. */
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "io/matrix_market.hpp"

namespace rotor_stator {

/** A body that moves in its own degrees of freedom, counted from 0. */
struct LinearBody {
  SparseMatrix m, c = {}, g = {}, k = {};
  std::string name = {};
  Eigen::VectorXd load = {};                 ///< constant, weight included [N]
  double size_of_loads = 0;                  ///< of the weight and of other loads [N]
  Eigen::VectorXcd unbalance = {};           ///< [kg m]
  std::vector<int> joint = {}, output = {};  ///< x and y
  std::vector<int> nodes = {};               ///< x and y of each node that is asked for
  SparseMatrix at_nodes = {};  ///< their displacements over the body's coordinates
  bool keeps_all = false;

  int size() const { return static_cast<int>(m.rows()); }
};

/** Where the reduced body must be right: speeds and frequencies Ω [rad/s], of which at
    least ten times that of the contact is taken; and k_0 [N/m]. */
struct ReductionRange {
  double from, to, highest, spring;
};

/** What was done, a line for headers; the largest relative error of the receptances at
    points that are not in the basis; and the highest frequency of them [rad/s]. */
struct Reduction {
  std::string note;
  double error, highest;
};

/** The message about a degree of freedom that neither K nor a bearing holds. */
std::string not_held(const std::string& who, int dof);

/** Puts few coordinates in the place of a body's own. The first are the degrees of
    freedom `kept`, of which so many come first at which joints stand. Throws BadInput
    where K leaves the body free or the factors would not fit into the memory; NoSolution
    where the error stays above 1e-6. */
Reduction reduce(LinearBody& body, const std::vector<int>& kept, std::size_t joints,
                 const ReductionRange& range);

}  // namespace rotor_stator
