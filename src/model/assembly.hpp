/**
# Two bodies and their bearings as one system of matrices

Stator and rotor are matrices of their own, of single masses too; the assembly joins them
at the places of the bearings and puts those coordinates first that are shown. */
#pragma once

#include "model/large_machine.hpp"
#include "model/reduction.hpp"

namespace rotor_stator {

/** A body that moves in its own degrees of freedom, counted from 0. */
struct LinearBody : BodyMatrices {
  std::string name;
  std::vector<int> vertical = {};
  Eigen::VectorXd load = {};                 ///< beside the weight [N]
  Eigen::VectorXcd unbalance = {};           ///< [kg m]
  std::vector<int> joint = {}, output = {};  ///< x and y
  std::vector<int> nodes = {};               ///< x and y of each node that is asked for
  SparseMatrix at_nodes = {};  ///< their displacements over the body's coordinates
  bool keeps_all = false;

  int size() const { return static_cast<int>(m.rows()); }

  /** Ones where the weight acts. */
  Eigen::VectorXd upright() const
  {
    Eigen::VectorXd ones = Eigen::VectorXd::Zero(size());
    for (int dof : vertical) ones[dof] = 1;
    return ones;
  }
};

/** A single mass, the same in x and y, with an unbalance [kg m]. */
LinearBody single_mass(const Body& body, const std::string& name, double unbalance);

/** The whole machine, its coordinates in the order of the files. */
struct Assembly {
  std::vector<LinearBody> bodies;               ///< stator and rotor
  bool is_rigid;                                ///< the stator
  std::vector<std::array<int, 4>> places = {};  ///< of the joints
  std::size_t bearings = 1;                     ///< those of them that come first

  int first(int body) const { return body == 0 ? 0 : bodies[0].size(); }
  int size() const { return bodies[0].size() + bodies[1].size(); }

  SparseMatrix joined(SparseMatrix LinearBody::*part) const;

  /** D. */
  SparseMatrix joints() const;

  /** Degrees of freedom, those first that are shown; their number. */
  std::pair<std::vector<int>, int> order() const;

  /** Throws BadInput for what neither K nor a joint of this stiffness [N/m] holds. */
  void require_held(double spring) const;
};

/** Its matrices, with a spring [N/m] in each joint (`LargeBodies::spring`). */
LargeBodies assembled(const Assembly& all, double gravity, double spring);

}  // namespace rotor_stator
