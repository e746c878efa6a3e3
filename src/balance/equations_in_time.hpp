/**
# The equations of motion at the samples

The derivative of the balance, seen in time, is that of two bodies with the contact's stiffness K(t) between them,

$$M\ddot q + C\dot q + (K_0 + D^T K(t)\, D)\, q = g, \qquad u = D q = q_r - q_s,$$

whose N samples are coupled with their neighbours only. With second differences corrected to fourth order but for the damping (Numerov 1924;
Hairer, Nørsett and Wanner 1993, III.10),

$$M\,\delta^2 q_k/\Delta^2 + C\,(q_{k+1} - q_{k-1})/2\Delta = (1 + \delta^2/12)\,(g - K q)_k,$$

they are solved in O(N) operations, from block to block around the period: too coarse as a solution, but an inverse
that is near enough for GMRES (StepSolver), where the dense factors cost m³. */
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

  /** How many samples they have: N, or a multiple of it where the contact vibrates faster. */
  int samples() const { return static_cast<int>(chain_.size()) + 1; }

  /** The relative displacement u [m], at these samples, under the load g [N] on the rotor and -g on the stator. */
  void solve(const Eigen::MatrixXd& load, Eigen::MatrixXd& u);

  /** 4 × 4 of x_s, y_s, x_r, y_r, row by row: loops of fixed length become vector instructions. */
  struct Block {
    double at[16];
  };
  struct Vector {
    double at[4];
  };

  /** What couples a sample with the one before or after it: a number for each body, and the contact, ∂F_i/∂u_j/12 at
      i + 2j. */
  struct Neighbour {
    double stator, rotor;
    const double* contact;
  };

private:
  /** One sample: S_k⁻¹, S_k⁻¹ times the block after it, and what the last sample adds. */
  struct Link {
    Block inverse, after, last;
  };
  struct Constants {
    double mass[2], damping[2], spring[2];
  };

  Neighbour neighbour(std::size_t k, double sign) const;
  void eliminate();
  void substitute(const Eigen::MatrixXd& load, Eigen::MatrixXd& u);

  std::array<PointBody, 2> bodies_;
  Constants constants_;
  std::vector<std::array<double, 4>> contact_;  ///< a twelfth of it, at all samples
  std::vector<Link> chain_;                     ///< all samples but the last
  Block closing_;
  std::vector<Vector> q_;
};

}  // namespace rotor_stator
