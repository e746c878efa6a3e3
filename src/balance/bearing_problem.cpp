#include "balance/bearing_problem.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "io/errors.hpp"
#include "model/ball_bearing.hpp"

namespace rotor_stator {

namespace {

using Complex = std::complex<double>;

/** Without the standard's care for infinities, which takes longer than the product. */
Complex times(Complex a, Complex b)
{
  return {a.real() * b.real() - a.imag() * b.imag(),
          a.real() * b.imag() + a.imag() * b.real()};
}

/** A complex amplitude and its derivative with respect to ω. */
struct Varying {
  Complex value, slope;

  Varying operator+(const Varying& o) const { return {value + o.value, slope + o.slope}; }
  Varying operator-(const Varying& o) const { return {value - o.value, slope - o.slope}; }
  Varying operator*(const Varying& o) const
  {
    return {times(value, o.value), times(slope, o.value) + times(value, o.slope)};
  }
  Varying over(const Varying& real) const
  {
    const double per = 1 / real.value.real();
    const Complex quotient = value * per;
    return {quotient, (slope - quotient * real.slope.real()) * per};
  }
  Varying modulus() const
  {
    const double size = std::sqrt(std::norm(value));
    return {size, size > 0 ? times(std::conj(value), slope).real() / size : 0.0};
  }
};

/** A body's dynamic stiffness and the amplitudes of its load in x and y: constant forces
    on harmonic 0, unbalance on that of the rotor's turning (cos φ in x and sin φ = Re(-i
    e^{iφ}) in y). */
struct LoadedBody {
  Varying z;
  std::array<Varying, 2> load;
};

std::array<LoadedBody, 2> stator_and_rotor(const Parameters& p, double omega, Harmonic h)
{
  const double order = order_of(h, p.bearing);
  const auto loaded = [&](const Body& body) -> LoadedBody {
    const auto [value, slope] = dynamic_stiffness(body, order * omega);
    const Vec2 constant = h == Harmonic{0, 0} ? body.static_load(p.gravity) : Vec2{0, 0};
    return {{value, order * slope}, {Varying{constant.x, 0}, Varying{constant.y, 0}}};
  };
  std::array<LoadedBody, 2> bodies{loaded(p.stator), loaded(p.rotor)};
  if (h == turning(p)) {
    const double moment = p.unbalance * p.turns * p.turns;
    const Varying force{moment * omega * omega, 2 * moment * omega};
    bodies[1].load = {force, force * Varying{{0, -1}, 0}};
  }
  return bodies;
}

void put_isotropic(Complex value, SmallMatrix& matrix)
{
  matrix.resize(2, 2);
  matrix(0, 0) = matrix(1, 1) = value;
  matrix(0, 1) = matrix(1, 0) = 0;
}

void condense(const Parameters& parameters, double ball_stiffness, double omega,
              Harmonic h, LinearBlock& block)
{
  const auto [stator, rotor] = stator_and_rotor(parameters, omega, h);
  const Varying &z_s = stator.z, &z_r = rotor.z;
  const Varying product = z_s * z_r, sum = z_s + z_r;
  const Varying both = product.modulus(), either = sum.modulus();
  const Varying sigma{both.value.real() + ball_stiffness * either.value.real(),
                      both.slope.real() + ball_stiffness * either.slope.real()};
  const Varying a = product.over(sigma), b = sum.over(sigma);
  put_isotropic(a.value, block.a);
  put_isotropic(b.value, block.b);
  put_isotropic(a.slope, block.a_slope);
  put_isotropic(b.slope, block.b_slope);
  block.c.setZero(2);
  block.c_slope.setZero(2);
  if (h != Harmonic{0, 0} && h != turning(parameters)) return;
  for (int axis = 0; axis < 2; ++axis) {
    const auto &f_s = stator.load, &f_r = rotor.load;
    const Varying c = (z_s * f_r[axis] - z_r * f_s[axis]).over(sigma);
    block.c[axis] = c.value;
    block.c_slope[axis] = c.slope;
  }
}

/** Sets the force of joints that are Eq. 5 alone. */
void put_elastic_force(const std::vector<Bearing>& joints, const TorusLine& line,
                       Problem& problem)
{
  std::vector<SampledBearing> bearings;
  for (const Bearing& bearing : joints)
    bearings.emplace_back(bearing_along(line, bearing), line.samples);
  if (bearings.size() == 1) {
    problem.force = bearings.front();
    return;
  }
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
}

/** Sets the force of joints of which one is not Eq. 5 alone. */
void put_moving_force(const Parameters& parameters, const std::vector<Bearing>& joints,
                      const TorusLine& line, Problem& problem)
{
  std::vector<std::vector<Angles>> angles;  // of each joint
  for (const Bearing& joint : joints) {
    const BallBearing there(bearing_along(line, joint), 0, parameters.turns * line.turns);
    for (angles.emplace_back(); std::ssize(angles.back()) < line.samples;)
      angles.back().push_back(
          there.angles(2 * std::numbers::pi * static_cast<double>(angles.back().size()) /
                       line.samples));
  }
  problem.operations *= 4;
  problem.order = [bearing = parameters.bearing](Harmonic h) {
    return order_of(h, bearing);
  };
  problem.moving_force = [turns = parameters.turns, joints, angles](
                             const Eigen::MatrixXd& q, const Eigen::MatrixXd& rate,
                             double omega, Eigen::MatrixXd& force,
                             Eigen::MatrixXd* slopes) {
    const Eigen::Index d = q.cols();
    force.resize(q.rows(), d);
    if (slopes) slopes->setZero(q.rows(), 2 * d * d + d);
    for (Eigen::Index i = 0; i < d; i += 2) {
      const auto joint = static_cast<std::size_t>(i / 2);
      const BallBearing bearing(joints[joint], omega, turns);
      for (Eigen::Index k = 0; k < q.rows(); ++k) {
        const BearingReaction at =
            bearing.reaction(angles[joint][static_cast<std::size_t>(k)],
                             {q(k, i), q(k, i + 1)}, {rate(k, i), rate(k, i + 1)});
        force.row(k).segment<2>(i) << at.force.x, at.force.y;
        if (!slopes) continue;
        auto row = slopes->row(k);
        for (const auto& [s, first] :
             {std::pair{at.stiffness, i + d * i}, {at.damping, i + d * (d + i)}}) {
          row.segment<2>(first) << s.xx, s.yx;
          row.segment<2>(first + d) << s.xy, s.yy;
        }
        row.segment<2>(2 * d * d + i) << at.speed_slope.x, at.speed_slope.y;
      }
    }
  };
}

}  // namespace

Problem bearing_problem(const Parameters& parameters, int samples,
                        const OperationBudget& budget)
{
  require_two_angles(parameters);
  if (!has_rotation_period(parameters.bearing))
    throw NoSolution(
        format("%s: n*omega_cage/omega = %.9g is not a whole number, so the bearing's "
               "force has not the period of rotation; use a time method",
               parameters.file.c_str(), passages_per_turn(parameters.bearing)));
  const int z = static_cast<int>(std::lround(passages_per_turn(parameters.bearing)));
  return bearing_problem(parameters, TorusLine{z, samples}, budget);
}

void Machine::put_equations(const Parameters& parameters, Problem& problem) const
{
  problem.linear = [parameters, k = scales(parameters).stiffness](
                       double omega, Harmonic h, LinearBlock& block) {
    condense(parameters, k, omega, h, block);
  };
}

Problem bearing_problem(const Parameters& parameters, const TorusLine& line,
                        const OperationBudget& budget)
{
  require_two_angles(parameters);
  const Scales scale = scales(parameters);
  Problem problem{.dofs = 2,
                  .samples = line.samples,
                  .residual_scale = scale.penetration,
                  .unknown_scale = scale.penetration,
                  .linear = {},
                  .force = {},
                  .operations = 5e3 + line.samples * (8 + 1.5 * parameters.bearing.balls),
                  .line = line};
  parameters.bodies->put_equations(parameters, problem);
  const std::vector<Bearing> joints = joints_of(parameters);
  if (std::ranges::all_of(joints, &Bearing::is_elastic_hertz))
    put_elastic_force(joints, line, problem);
  else
    put_moving_force(parameters, joints, line, problem);
  if (budget.bounded())
    problem.spend = [budget, balls = parameters.bearing.balls](double operations) {
      budget.spend(operations / operations_per_evaluation(balls));
    };
  return problem;
}

/** N samples of a relative displacement that depends on the rotor's angle. */
template <class Displacement>
static Eigen::MatrixXd sampled(int samples, Displacement displacement)
{
  Eigen::MatrixXd u(samples, 2);
  for (int k = 0; k < samples; ++k) {
    const Vec2 at = displacement(2 * std::numbers::pi * k / samples);
    u.row(k) << at.x, at.y;
  }
  return u;
}

Eigen::MatrixXd Machine::start_samples(const Parameters& parameters, double omega,
                                       int samples) const
{
  const Eigen::MatrixXd u = sampled(
      samples, [&](double phase) { return free_displacement(parameters, omega, phase); });
  if (u.rowwise().norm().maxCoeff() <= parameters.bearing.clearance) return u;
  return sampled(samples, [&](double phase) {
    return quasi_static_contact(parameters.bearing,
                                rigid_joint_force(parameters, omega, phase));
  });
}

Eigen::VectorXd quasi_static_start(const Parameters& parameters, double omega,
                                   int harmonics)
{
  const int samples = default_samples(harmonics);
  const Eigen::MatrixXd u = parameters.bodies->start_samples(parameters, omega, samples);
  Eigen::MatrixXd series(u.cols(), 2 * harmonics + 1);
  FourierTransform(samples).to_series(u, series);
  return series.reshaped();
}

Eigen::MatrixXd body_series(const Parameters& parameters, const PeriodicMotion& motion)
{
  return parameters.bodies->shown_series(parameters, motion);
}

Eigen::MatrixXd Machine::all_series(const Parameters&, const PeriodicMotion& motion) const
{
  return motion.bodies;
}

Eigen::MatrixXd Machine::shown_series(const Parameters& parameters,
                                      const PeriodicMotion& motion) const
{
  return series_of(motion, 4, [&](Harmonic h, auto& force, auto& relative) {
    const auto [stator, rotor] = stator_and_rotor(parameters, motion.omega, h);
    const Complex z_s = stator.z.value, z_r = rotor.z.value;
    SmallVector body(4);
    for (int axis = 0; axis < 2; ++axis) {
      /** The stiffer of the two bodies gives its displacement and u the other's: the
         resonance of an undamped body divides nothing by zero. */
      body[axis] = std::abs(z_s) >= std::abs(z_r)
                       ? (stator.load[axis].value + force[axis]) / z_s
                       : (rotor.load[axis].value - force[axis]) / z_r - relative[axis];
      body[2 + axis] = body[axis] + relative[axis];
    }
    return body;
  });
}

}  // namespace rotor_stator
