#include "stability/shooting.hpp"

#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <memory>

#include "integration/time_stepper.hpp"
#include "io/errors.hpp"
#include "stability/period_map.hpp"

namespace rotor_stator {

namespace {

/** P with and without its derivative. */
struct Maps {
  std::function<State(const State&)> end;
  std::function<PeriodMap(const State&)> map;
  std::function<long()> evaluations;
};

Maps rk4_maps(const Parameters& parameters, double omega,
              const ShootingSettings& settings)
{
  const double step = settings.step > 0 ? settings.step : default_step(parameters);
  const auto period = std::make_shared<Rk4PeriodMap>(parameters, omega, step);
  return {.end = [period](const State& s) { return period->end(s); },
          .map = [period](const State& s) { return period->map(s); },
          .evaluations = [period] { return period->evaluations(); }};
}

Maps gsl_maps(const Parameters& parameters, double omega,
              const ShootingSettings& settings)
{
  const TimeStepper stepper = make_stepper(parameters, omega,
                                           {.method = settings.method,
                                            .intervals_per_period = 1,
                                            .tolerance = settings.tolerance,
                                            .budget = settings.budget});
  const auto varied = std::make_shared<long>(0);
  return {.end =
              [stepper](const State& start) {
                State state = start;
                stepper.advance(0, state);
                return state;
              },
          .map =
              [=, &parameters, &settings](const State& start) {
                const PeriodMap map =
                    period_map(parameters, omega, start, settings.tolerance,
                               settings.method, settings.budget);
                *varied += map.evaluations;
                return map;
              },
          .evaluations = [=] { return stepper.evaluations() + *varied; }};
}

/** Newton in the scaled state y = s/sizes. */
class Iteration {
public:
  Iteration(const Parameters& parameters, double omega, const State& start,
            const ShootingSettings& settings)
      : settings_(settings),
        maps_(settings.method == "rk4" ? rk4_maps(parameters, omega, settings)
                                       : gsl_maps(parameters, omega, settings)),
        sizes_(state_scales(parameters)),
        y_(vector_of(start).cwiseQuotient(sizes_))
  {
  }

  Shooting run(State& state, PeriodicityJacobian& jacobian)
  {
    try {
      if (jacobian) start_with(*jacobian);
      while (report_.reason.empty()) newton_step();
      if (report_.converged) take_known_step();
    } catch (const NoSolution& broken) {
      report_.converged = false;
      report_.reason = broken.what();
    }
    if (report_.derivatives > 0 || jacobian) jacobian = jacobian_;
    report_.evaluations = maps_.evaluations();
    state = state_of(Vector8(y_.cwiseProduct(sizes_)));
    return report_;
  }

private:
  void start_with(const Matrix8& jacobian)
  {
    jacobian_ = jacobian;
    open_ = mapped(y_) - y_;
    report_.periodicity_residual = open_.norm();
    if (!finished()) quasi_newton_steps();
  }

  /** Φ at y, one step with it, and further ones while they reduce the residual well. */
  void newton_step()
  {
    const PeriodMap map = integrate_derivative();
    open_ = vector_of(map.end).cwiseQuotient(sizes_) - y_;
    report_.periodicity_residual = open_.norm();
    jacobian_ = sizes_.cwiseInverse().asDiagonal() * map.derivative * sizes_.asDiagonal();
    jacobian_ -= Matrix8::Identity();
    if (finished()) return;
    if (!quasi_newton_steps() && report_.reason.empty())
      stop("no step closes the motion better");
  }

  /** False when not even the first step reduces the residual. */
  bool quasi_newton_steps()
  {
    constexpr double well = 0.3;  ///< a reduction that earns another step without Φ
    bool reduced = false;
    do {
      if (!damped_step()) return reduced;
      reduced = true;
    } while (!finished() && reduction_ < well);
    return true;
  }

  /** One step, halved until the residual decreases; Broyden's rule learns from it. */
  bool damped_step()
  {
    const Vector8 step = -jacobian_.partialPivLu().solve(open_);
    double length = 1;
    for (int halvings = 0; halvings < 8 && !out_of_maps(); ++halvings, length /= 2) {
      const Vector8 y = y_ + length * step;
      const Vector8 open = mapped(y) - y;
      const double reduction = open.norm() / report_.periodicity_residual;
      if (!(reduction < 1)) continue;
      jacobian_ += (open - (1 - length) * open_) * step.transpose() /
                   (length * step.squaredNorm());
      y_ = y;
      open_ = open;
      reduction_ = reduction;
      report_.periodicity_residual = open.norm();
      return true;
    }
    return false;
  }

  void take_known_step()
  {
    const Vector8 step = jacobian_.partialPivLu().solve(open_);
    if (step.allFinite()) y_ -= step;
    if (settings_.final_derivative) integrate_derivative();
  }

  PeriodMap integrate_derivative()
  {
    const PeriodMap map = maps_.map(unscaled(y_));
    ++report_.maps;
    ++report_.derivatives;
    report_.derivative = map.derivative;
    return map;
  }

  Vector8 mapped(const Vector8& y)
  {
    ++report_.maps;
    const Vector8 end = vector_of(maps_.end(unscaled(y)));
    return end.cwiseQuotient(sizes_);
  }

  State unscaled(const Vector8& y) const
  {
    return state_of(Vector8(y.cwiseProduct(sizes_)));
  }
  bool out_of_maps() const { return report_.maps >= settings_.most_maps; }

  bool finished()
  {
    report_.converged = report_.periodicity_residual <= settings_.periodicity_residual;
    if (report_.converged)
      stop("converged");
    else if (out_of_maps())
      stop(format("%d periods were integrated", report_.maps));
    return !report_.reason.empty();
  }

  void stop(const std::string& why)
  {
    report_.reason = why + format(" (closure %.1e)", report_.periodicity_residual);
  }

  const ShootingSettings& settings_;
  Maps maps_;
  Vector8 sizes_, y_;
  Vector8 open_;      ///< P(y) - y
  Matrix8 jacobian_;  ///< its derivative
  double reduction_ = 1;
  Shooting report_;
};

}  // namespace

Shooting shoot(const Parameters& parameters, double omega, State& state,
               const ShootingSettings& settings, PeriodicityJacobian* jacobian)
{
  PeriodicityJacobian none;
  return Iteration(parameters, omega, state, settings)
      .run(state, jacobian ? *jacobian : none);
}

State quasi_static_state(const Parameters& parameters, double omega)
{
  /** F = gravity + Re(whirl (1, -i) e^{iφ}); the stator answers with its receptance, the rotor stands
      off by u, which follows the force. */
  const Vec2 at_0 = rigid_joint_force(parameters, omega, 0);
  const Vec2 at_90 = rigid_joint_force(parameters, omega, std::numbers::pi / 2);
  const double gravity = at_90.y - at_0.x;
  const std::complex<double> whirl(at_0.x, at_0.y - gravity);
  const auto response = whirl / dynamic_stiffness(parameters.stator, omega).value;
  const double sag = (gravity - parameters.stator.mass * parameters.gravity) /
                     parameters.stator.stiffness();
  const auto stator = [&](double phase) -> Vec2 {
    const auto turned = response * std::polar(1.0, phase);
    return {turned.real(), sag + turned.imag()};
  };
  const auto relative = [&](double phase) {
    return quasi_static_contact(parameters, rigid_joint_force(parameters, omega, phase));
  };
  constexpr double little = 1e-4;
  const auto speed = [&](const auto& path) -> Vec2 {
    const Vec2 a = path(-little), b = path(little);
    return {omega * (b.x - a.x) / (2 * little), omega * (b.y - a.y) / (2 * little)};
  };
  const Vec2 s = stator(0), u = relative(0), v_s = speed(stator), v_u = speed(relative);
  return {.position = {.stator = s, .rotor = {s.x + u.x, s.y + u.y}},
          .velocity = {.stator = v_s, .rotor = {v_s.x + v_u.x, v_s.y + v_u.y}}};
}

}  // namespace rotor_stator
