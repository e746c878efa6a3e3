/**
# The equations of motion at the samples

The derivative of the balance, seen in time, is that of two bodies with the contact's stiffness K(t) between them,

$$M\ddot q + C\dot q + (K_0 + D^T K(t)\, D)\, q = g, \qquad u = D q = q_r - q_s,$$

whose N samples are coupled with their neighbours only. With second differences corrected to fourth order but for the damping (Numerov 1924;
Hairer, Nørsett and Wanner 1993, III.10),

$$M\,\delta^2 q_k/\Delta^2 + C\,(q_{k+1} - q_{k-1})/2\Delta = (1 + \delta^2/12)\,(g - K q)_k,$$

they are solved in O(N) operations: too coarse as a solution, but an inverse that is near enough for GMRES (StepSolver),
where the dense factors cost m³. The period is cut into parts, whose inner samples are eliminated from one to the next, all
parts at once, each in its lane of a vector register; the last samples of the parts are left, a short cyclic
chain (Wang, ACM Transactions on Mathematical Software 7, 1981). */
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace rotor_stator {

/** Constants of one of two bodies [kg, N s/m, N/m], the same in x and y. */
struct PointBody {
  double mass, damping, stiffness;
};

class EquationsInTime {
public:
  /** Stator and rotor. */
  explicit EquationsInTime(const std::array<PointBody, 2>& bodies) : bodies_(bodies) {}

  /** Factors for ∂F_i/∂u_j [N/m] in column i + 2j of `stiffness`, N × 4, over one period at `omega` [rad/s]. */
  void factor(const Eigen::MatrixXd& stiffness, double omega);

  /** How many samples they have: N, or a multiple of it where the contact vibrates faster, rounded up to whole parts and to a fast transform. */
  int samples() const { return parts * static_cast<int>(contact_.size()); }

  /** The relative displacement u [m], at these samples, under the load g [N] on the rotor and -g on the stator. */
  void solve(const Eigen::MatrixXd& load, Eigen::MatrixXd& u);

  /** Parts of the period, and one number of each. */
  static constexpr int parts = 8;
  using Lanes = double __attribute__((vector_size(parts * sizeof(double))));

  /** 4 × 4 of x_s, y_s, x_r, y_r, row by row. The compiler aligns Lanes for the registers that it knows, not for wider ones. */
  template <class Number>
  struct Block {
    alignas(sizeof(Number)) Number at[16];
  };
  template <class Number>
  struct Vector {
    alignas(sizeof(Number)) Number at[4];
  };

  /** What couples a sample with the one before or after it: a number for each body, and the contact, ∂F_i/∂u_j/12 at
      i + 2j. */
  struct Neighbour {
    double stator, rotor;
    const Lanes* contact;
  };

private:
  /** An inner sample of each part: S_k⁻¹, S_k⁻¹ times the block after it, and what the last samples of the part before
      and of its own part add. */
  struct Link {
    Block<Lanes> inverse, after, before_part, own_part;
  };
  /** The last sample of a part, among these: the block before, S_p⁻¹, S_p⁻¹ times the block after, and what that of the last
      part adds; of that part itself the block after. */
  struct End {
    Block<double> before, inverse, after, last;
  };
  struct Constants {
    double mass[2], damping[2], spring[2];
  };
  using Contact = Vector<Lanes>;

  Neighbour neighbour(const Contact& contact, double sign) const;
  Block<Lanes> own(const Contact& contact) const;
  void eliminate();
  void eliminate_ends();
  void substitute(const Eigen::MatrixXd& load, Eigen::MatrixXd& u);
  void substitute_ends(std::array<Vector<double>, parts>& end) const;

  std::array<PointBody, 2> bodies_;
  Constants constants_;
  std::vector<Contact> contact_;  ///< a twelfth of it
  Contact contact_before_;        ///< that of the last samples of the parts before
  std::vector<Link> chain_;
  std::array<End, parts> ends_;
  std::vector<Vector<Lanes>> q_;
};

}  // namespace rotor_stator
