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
#include <vector>

#include "io/matrix_market.hpp"

namespace rotor_stator {

struct BodyMatrices {
  SparseMatrix m, c, g, k;
};

/** Where the reduced body must be right. */
struct ReductionRange {
  double from, to;  ///< speeds [rad/s]
  double
      highest;  ///< frequency Ω [rad/s]; at least ten times that of the contact is taken
};

/** What the body is driven by, and what of it is shown; degrees of freedom counted from
    0. */
struct BodyPorts {
  std::vector<int> joints;      ///< of bearings
  std::vector<int> kept;        ///< those first, then outputs: each stays a coordinate
  Eigen::VectorXd load;         ///< constant [N]
  Eigen::VectorXcd unbalance;   ///< [kg m]
  double spring;                ///< k_0 [N/m]
  std::vector<int> nodes = {};  ///< others whose receptances must be right
};

struct ReducedBody {
  Eigen::MatrixXd basis;  ///< n × r; its first coordinates are those kept
  BodyMatrices matrices;  ///< r × r
  double error;    ///< largest of the receptances at points not in the basis, relative
  double highest;  ///< frequency up to which it was measured [rad/s]
  int points;      ///< that measured it
};

/** Throws BadInput, in the name of `who`, where K leaves the body free or the factors
    would not fit into the memory; NoSolution where the error stays above 1e-6. */
ReducedBody reduce(const BodyMatrices& body, const BodyPorts& ports,
                   const ReductionRange& range, const std::string& who);

}  // namespace rotor_stator
