#include "stability/monodromy.hpp"

#include <Eigen/LU>

#include "model/errors.hpp"

namespace rotor_stator
{

namespace
{

/** The equation with d = D known to the compiler: four stages of small products per step. */
template <int D>
class Disturbances
{
public:
  using Square = Eigen::Matrix<double, D, D>;
  using Columns = Eigen::Matrix<double, D, 2 * D>;

  Disturbances(const Vibration& vibration, double step)
      : per_mass_(vibration.mass.inverse()),
        damping_(per_mass_ * vibration.damping),
        stiffness_(per_mass_ * vibration.stiffness),
        h_(step)
  {
    q_.setZero();
    v_.setZero();
    q_.template leftCols<D>().setIdentity();
    v_.template rightCols<D>().setIdentity();
  }

  /** M⁻¹(K + k) from a row of the table. */
  Square rate(const Eigen::MatrixXd& table, Eigen::Index row) const
  {
    Square k;
    for (int j = 0; j < D; ++j)
      for (int i = 0; i < D; ++i) k(i, j) = table(row, i + D * j);
    return stiffness_ + per_mass_ * k;
  }

  void step(const Square& first, const Square& middle, const Square& last)
  {
    const Columns a_1 = -first * q_ - damping_ * v_;
    const Columns v_2 = v_ + 0.5 * h_ * a_1;
    const Columns a_2 = -middle * (q_ + 0.5 * h_ * v_) - damping_ * v_2;
    const Columns v_3 = v_ + 0.5 * h_ * a_2;
    const Columns a_3 = -middle * (q_ + 0.5 * h_ * v_2) - damping_ * v_3;
    const Columns v_4 = v_ + h_ * a_3;
    const Columns a_4 = -last * (q_ + h_ * v_3) - damping_ * v_4;
    q_ += h_ / 6 * (v_ + 2 * v_2 + 2 * v_3 + v_4);
    v_ += h_ / 6 * (a_1 + 2 * a_2 + 2 * a_3 + a_4);
  }

  Eigen::MatrixXd matrix() const
  {
    Eigen::MatrixXd phi(2 * D, 2 * D);
    phi << q_, v_;
    return phi;
  }

private:
  Square per_mass_, damping_, stiffness_;
  double h_;
  Columns q_, v_;  ///< the disturbances that start as the unit vectors
};

template <int D>
Eigen::MatrixXd integrate(const Vibration& vibration, const Eigen::MatrixXd& stiffness,
                          double period)
{
  const Eigen::Index steps = stiffness.rows() / 2;
  Disturbances<D> disturbances(vibration, period / static_cast<double>(steps));
  auto first = disturbances.rate(stiffness, 0);
  for (Eigen::Index k = 0; k < steps; ++k) {
    const auto middle = disturbances.rate(stiffness, 2 * k + 1);
    const auto last = disturbances.rate(stiffness, (2 * k + 2) % stiffness.rows());
    disturbances.step(first, middle, last);
    first = last;
  }
  return disturbances.matrix();
}

}  // namespace

Eigen::MatrixXd monodromy(const Vibration& vibration, const Eigen::MatrixXd& stiffness,
                          double period)
{
  switch (vibration.mass.rows()) {
    case 1:
      return integrate<1>(vibration, stiffness, period);
    case 2:
      return integrate<2>(vibration, stiffness, period);
    case 4:
      return integrate<4>(vibration, stiffness, period);
    default:
      throw BadInput("a monodromy matrix is computed for 1, 2 or 4 displacements");
  }
}

}  // namespace rotor_stator
