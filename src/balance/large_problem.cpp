#include "balance/large_problem.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "balance/torus_line.hpp"
#include "io/errors.hpp"

namespace rotor_stator {

namespace {

using Complex = std::complex<double>;

/** S of one harmonic in factors, with its load. */
struct HarmonicAlone {
  double order, frequency, speed;
  Complex spring;
  Eigen::PartialPivLU<Eigen::MatrixXcd> factors;
  Eigen::VectorXcd load, load_slope;
};

HarmonicAlone harmonic_of(const Parameters& p, double omega, Harmonic h)
{
  const LargeMachine& machine = *p.large;
  const double order = order_of(h, p.bearing), frequency = order * omega;
  const double speed = rotor_speed(p, omega), per_omega = rotor_speed(p, 1);
  const double sign = (frequency > 0) - (frequency < 0);
  const Complex spring = machine.spring * Complex(1, sign);
  Eigen::VectorXcd load = Eigen::VectorXcd::Zero(machine.load.size()), slope = load;
  if (h == Harmonic{0, 0}) load = machine.load;
  if (h == Harmonic{static_cast<double>(p.turns), 0}) {
    load = speed * speed * machine.unbalance;
    slope = 2 * speed * per_omega * machine.unbalance;
  }
  return {order,
          frequency,
          speed,
          spring,
          Eigen::PartialPivLU<Eigen::MatrixXcd>(
              machine.dynamic_stiffness(spring, frequency, speed)),
          load,
          slope};
}

LinearBlock large_block(const Parameters& p, double omega, Harmonic h)
{
  const LargeMachine& machine = *p.large;
  const HarmonicAlone at = harmonic_of(p, omega, h);
  const Eigen::MatrixXcd d = machine.joints.cast<Complex>();
  const Eigen::MatrixXcd x = at.factors.solve(d);
  const Eigen::VectorXcd driven = at.factors.solve(at.load);
  const Eigen::MatrixXcd left = at.factors.transpose().solve(d);  // S⁻ᵀ D

  /** -∂S/∂ω. */
  Eigen::MatrixXcd slope =
      Complex(0, -1) * (at.order * (machine.damping + at.speed * machine.gyroscopic) +
                        at.frequency * rotor_speed(p, 1) * machine.gyroscopic);
  slope += 2 * at.frequency * at.order * machine.mass;
  const SmallMatrix receptance = d.transpose() * x;
  const SmallMatrix receptance_slope = left.transpose() * slope * x;
  return {.a = SmallMatrix::Identity(d.cols(), d.cols()) - at.spring * receptance,
          .b = receptance,
          .c = d.transpose() * driven,
          .a_slope = -at.spring * receptance_slope,
          .b_slope = receptance_slope,
          .c_slope = left.transpose() * (at.load_slope + slope * driven)};
}

/** Where the period of the passing balls is one for all bearings. */
void require_one_passage(const Parameters& parameters)
{
  const double first = passages_per_turn(parameters.bearing);
  for (const Bearing& bearing : parameters.further)
    if (std::abs(passages_per_turn(bearing) - first) > 1e-9)
      throw BadInput(
          format("%s: bearing: n*omega_cage/omega is %.9g at the first and %.9g at "
                 "another one: more than two frequencies, which only --method "
                 "exponential follows",
                 parameters.file.c_str(), first, passages_per_turn(bearing)));
}

}  // namespace

void put_large_bodies(const Parameters& parameters, const TorusLine& line,
                      Problem& problem)
{
  require_one_passage(parameters);
  problem.dofs = 2 * parameters.large->bearings();
  problem.linear = [parameters](double omega, Harmonic h) {
    return large_block(parameters, omega, h);
  };
  std::vector<SampledBearing> bearings;
  for (const Bearing& bearing : bearings_of(parameters))
    bearings.emplace_back(on(line, bearing), line.samples);
  problem.force = [bearings](const Eigen::MatrixXd& u, Eigen::MatrixXd& force,
                             Eigen::MatrixXd* stiffness) {
    const Eigen::Index d = u.cols();
    force.resize(u.rows(), d);
    if (stiffness) stiffness->setZero(u.rows(), d * d);
    Eigen::MatrixXd own_force, own_stiffness;
    for (Eigen::Index k = 0; const SampledBearing& bearing : bearings) {
      bearing(u.middleCols<2>(k), own_force, stiffness ? &own_stiffness : nullptr);
      force.middleCols<2>(k) = own_force;
      for (Eigen::Index j = 0; stiffness && j < 4; ++j)
        stiffness->col(k + j % 2 + d * (k + j / 2)) = own_stiffness.col(j);
      k += 2;
    }
  };
  problem.operations *= parameters.large->bearings();
}

Eigen::MatrixXd large_start_samples(const Parameters& parameters, double omega,
                                    int samples)
{
  const LargeMachine& machine = *parameters.large;
  const LinearBlock rest = large_block(parameters, omega, {0, 0});
  const LinearBlock turning =
      large_block(parameters, omega, {static_cast<double>(parameters.turns), 0});
  const auto sampled = [&](const Eigen::VectorXcd& mean, const Eigen::VectorXcd& whirl) {
    Eigen::MatrixXd series(samples, mean.size());
    for (int k = 0; k < samples; ++k)
      series.row(k) =
          (mean +
           std::polar(1.0, 2 * std::numbers::pi * parameters.turns * k / samples) * whirl)
              .real();
    return series;
  };
  Eigen::MatrixXd u =
      sampled(rest.a.fullPivLu().solve(rest.c), turning.a.fullPivLu().solve(turning.c));
  bool is_free = u.allFinite();
  for (Eigen::Index k = 0; const Bearing& bearing : bearings_of(parameters)) {
    is_free =
        is_free && u.middleCols<2>(k).rowwise().norm().maxCoeff() <= bearing.clearance;
    k += 2;
  }
  if (is_free) return u;
  const JointForces rigid = rigid_joint_forces(machine, rotor_speed(parameters, omega));
  u = sampled(rigid.rest.cast<Complex>(), rigid.whirl);
  for (Eigen::Index k = 0; k < samples; ++k)
    u.row(k) = quasi_static_contacts(parameters, u.row(k).transpose());
  return u;
}

Eigen::MatrixXd coordinate_series(const Parameters& parameters,
                                  const PeriodicMotion& motion)
{
  const LargeMachine& machine = *parameters.large;
  const auto columns = motion.harmonics.coefficients();
  const auto d = machine.joints.cols(), n = machine.joints.rows();
  const Eigen::Map<const Eigen::MatrixXd> u(motion.x.data(), d, columns);
  Eigen::MatrixXd series(n, columns);
  for (int h = 0; h <= motion.harmonics.count(); ++h) {
    const HarmonicAlone at =
        harmonic_of(parameters, motion.omega, motion.harmonics.list()[h]);
    const Eigen::VectorXcd push =
        amplitude(motion.force, h) - at.spring * amplitude(u, h);
    const Eigen::VectorXcd q = at.factors.solve(at.load - machine.joints * push);
    series.col(h == 0 ? 0 : 2 * h - 1) = q.real();
    if (h > 0) series.col(2 * h) = -q.imag();
  }
  return series;
}

}  // namespace rotor_stator
