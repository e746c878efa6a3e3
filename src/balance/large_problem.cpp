#include "balance/large_problem.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

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

  HarmonicAlone(const LargeBodies& machine, const Parameters& p, double omega, Harmonic h)
      : order(order_of(h, p.bearing)), frequency(order * omega),
        speed(rotor_speed(p, omega)), spring(machine.damped_spring(order)),
        factors(machine.dynamic_stiffness(spring, frequency, speed)),
        load(Eigen::VectorXcd::Zero(machine.load.size())), load_slope(load)
  {
    if (h == Harmonic{0, 0}) load = machine.load;
    if (h != turning(p)) return;
    load = speed * speed * machine.unbalance;
    load_slope = 2 * speed * rotor_speed(p, 1) * machine.unbalance;
  }
};

/** The first coordinates, which are shown, as unit forces on the joints (held by k) and
    the loads move them; derivatives with respect to ω. */
struct Answers {
  Eigen::MatrixXcd to_forces, to_forces_slope;
  Eigen::VectorXcd driven, driven_slope;
  Complex spring;
};

Answers exact_answers(const LargeBodies& machine, const Parameters& p, double omega,
                      Harmonic h)
{
  const HarmonicAlone at(machine, p, omega, h);
  const auto n = machine.mass.rows();
  const Eigen::MatrixXcd x = at.factors.solve(machine.joints.cast<Complex>());
  const Eigen::VectorXcd driven = at.factors.solve(at.load);
  const Eigen::MatrixXcd left =  // S⁻ᵀ
      at.factors.transpose().solve(Eigen::MatrixXcd::Identity(n, machine.shown));

  /** -∂S/∂ω. */
  Eigen::MatrixXcd slope =
      Complex(0, -1) * (at.order * (machine.damping + at.speed * machine.gyroscopic) +
                        at.frequency * rotor_speed(p, 1) * machine.gyroscopic);
  slope += 2 * at.frequency * at.order * machine.mass;
  return {x.topRows(machine.shown), left.transpose() * slope * x,
          driven.head(machine.shown), left.transpose() * (at.load_slope + slope * driven),
          at.spring};
}

constexpr double fit_error = 1e-9;

/** The same from a fit over the machine's range of speeds, where it has one. */
Answers answers_of(const LargeBodies& machine, const Parameters& p, double omega,
                   Harmonic h)
{
  const double order = order_of(h, p.bearing), per_omega = rotor_speed(p, 1);
  const double ratio = order / per_omega, speed = per_omega * omega;
  if (!machine.fits || speed < machine.slowest || speed > machine.fastest)
    return exact_answers(machine, p, omega, h);
  const Complex spring = machine.damped_spring(ratio);
  const auto d = machine.joints.cols();
  Eigen::VectorXcd load = ratio == 0 ? machine.load.cast<Complex>() : machine.unbalance;
  const double size_of_load = load.norm();
  load.normalize();  // as large as a unit force
  const RationalFit& fit = machine.fits->of(ratio, [&] {
    Eigen::MatrixXcd inputs(machine.mass.rows(), d + 1);
    inputs << machine.joints.cast<Complex>(), load;
    const auto sampled = [&](double at) -> Eigen::VectorXcd {
      const Eigen::MatrixXcd z = machine.dynamic_stiffness(spring, ratio * at, at);
      return z.partialPivLu().solve(inputs).topRows(machine.shown).reshaped();
    };
    return RationalFit(sampled, machine.slowest, machine.fastest, fit_error);
  });
  if (!fit.covers(speed)) return exact_answers(machine, p, omega, h);
  const auto [value, slope] = fit.at(speed);
  const Eigen::Index size = d * machine.shown;
  Answers answers{value.head(size).reshaped(machine.shown, d),
                  per_omega * slope.head(size).reshaped(machine.shown, d),
                  Eigen::VectorXcd::Zero(machine.shown),
                  Eigen::VectorXcd::Zero(machine.shown), spring};
  const auto unit = value.tail(machine.shown), unit_slope = slope.tail(machine.shown);
  if (h == Harmonic{0, 0}) answers.driven = size_of_load * unit;
  if (h == turning(p)) {
    answers.driven = size_of_load * speed * speed * unit;
    answers.driven_slope =
        size_of_load * per_omega * speed * (2 * unit + speed * unit_slope);
  }
  return answers;
}

LinearBlock large_block(const LargeBodies& machine, const Parameters& p, double omega,
                        Harmonic h)
{
  const Answers at = answers_of(machine, p, omega, h);
  const Eigen::MatrixXd d = machine.joints.topRows(machine.shown);
  const SmallMatrix receptance = d.transpose() * at.to_forces;
  const SmallMatrix slope = d.transpose() * at.to_forces_slope;
  return {.a = SmallMatrix::Identity(d.cols(), d.cols()) - at.spring * receptance,
          .b = receptance,
          .c = d.transpose() * at.driven,
          .a_slope = -at.spring * slope,
          .b_slope = slope,
          .c_slope = d.transpose() * at.driven_slope};
}

/** Where the period of the passing balls is one for all bearings. */
void require_one_passage(const Parameters& parameters)
{
  const double first = passages_per_turn(parameters.bearing);
  for (const Bearing& bearing : parameters.further)
    if (std::abs(passages_per_turn(bearing) - first) > 1e-9)
      throw BadInput(format(
          "%s: bearing: %.9g balls of the first and %.9g of another one pass in a turn, "
          "and harmonic balance takes one number; leave out --method, --harmonics and "
          "--lines",
          parameters.file.c_str(), first / parameters.turns,
          passages_per_turn(bearing) / parameters.turns));
}

}  // namespace

void MatrixMachine::put_equations(const Parameters& parameters, Problem& problem) const
{
  require_one_passage(parameters);
  problem.dofs = static_cast<int>(bodies_.joints.cols());
  problem.linear = [this, parameters](double omega, Harmonic h, LinearBlock& block) {
    block = large_block(bodies_, parameters, omega, h);
  };
  problem.operations *= static_cast<double>(bodies_.places.size());
}

void MatrixMachine::prepare(const Parameters& parameters, double omega,
                            int harmonics) const
{
  for (int h = 0; h <= harmonics; ++h)
    answers_of(bodies_, parameters, omega, {static_cast<double>(h), 0});
}

Eigen::MatrixXd MatrixMachine::start_samples(const Parameters& parameters, double omega,
                                             int samples) const
{
  const LinearBlock rest = large_block(bodies_, parameters, omega, {0, 0});
  const LinearBlock whirling =
      large_block(bodies_, parameters, omega, turning(parameters));
  const auto sampled = [&](const Eigen::VectorXcd& mean, const Eigen::VectorXcd& whirl) {
    Eigen::MatrixXd series(samples, mean.size());
    for (int k = 0; k < samples; ++k)
      series.row(k) =
          (mean +
           std::polar(1.0, 2 * std::numbers::pi * parameters.turns * k / samples) * whirl)
              .real();
    return series;
  };
  /** Without the balls, and what is beside them as it is at u = 0. */
  const double speed = rotor_speed(parameters, omega);
  const auto free = [&](const LinearBlock& block, double frequency) -> Eigen::VectorXcd {
    SmallMatrix whole = block.a;
    for (Eigen::Index k = 0; const Bearing& joint : joints_of(parameters)) {
      const BearingReaction beside =
          Parallel(joint.parallel, speed).reaction({0, 0}, {0, 0});
      const Slopes2 &s = beside.stiffness, &d = beside.damping;
      const Complex rate(0, frequency);
      const Eigen::Matrix2cd slopes{{s.xx + rate * d.xx, s.xy + rate * d.xy},
                                    {s.yx + rate * d.yx, s.yy + rate * d.yy}};
      whole.middleCols<2>(k) += block.b.middleCols<2>(k) * slopes;
      k += 2;
    }
    return whole.fullPivLu().solve(block.c);
  };
  Eigen::MatrixXd u = sampled(free(rest, 0), free(whirling, speed));
  bool is_free = u.allFinite();
  for (Eigen::Index k = 0; const Bearing& bearing : bearings_of(parameters)) {
    is_free =
        is_free && u.middleCols<2>(k).rowwise().norm().maxCoeff() <= bearing.clearance;
    k += 2;
  }
  if (is_free) return u;
  const JointForces rigid = rigid_joint_forces(bodies_, speed);
  u = sampled(rigid.rest.cast<Complex>(), rigid.whirl);
  for (Eigen::Index k = 0; k < samples; ++k)
    u.row(k) = quasi_static_contacts(parameters, u.row(k).transpose());
  return u;
}

Eigen::MatrixXd MatrixMachine::shown_series(const Parameters& parameters,
                                            const PeriodicMotion& motion) const
{
  return series_of(motion, bodies_.shown, [&](Harmonic h, auto& force, auto& u) {
    const Answers at = answers_of(bodies_, parameters, motion.omega, h);
    const Eigen::VectorXcd push = force - at.spring * u;
    return Eigen::VectorXcd(at.driven - at.to_forces * push);
  });
}

Eigen::MatrixXd MatrixMachine::all_series(const Parameters& parameters,
                                          const PeriodicMotion& motion) const
{
  const Eigen::MatrixXd& d = bodies_.joints;
  return series_of(motion, d.rows(), [&](Harmonic h, auto& force, auto& u) {
    const HarmonicAlone at(bodies_, parameters, motion.omega, h);
    const Eigen::VectorXcd push = force - at.spring * u;
    return Eigen::VectorXcd(at.factors.solve(at.load - d * push));
  });
}

}  // namespace rotor_stator
