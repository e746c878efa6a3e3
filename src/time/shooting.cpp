#include "time/shooting.hpp"

#include <Eigen/LU>
#include <functional>
#include <memory>

#include "io/errors.hpp"
#include "time/flow.hpp"
#include "time/period_map.hpp"

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

Maps controlled_maps(const Parameters& parameters, double omega,
                     const ShootingSettings& settings)
{
  const std::shared_ptr<Flow> stepper = flow(parameters, omega,
                                             {.method = settings.method,
                                              .intervals_per_period = 1,
                                              .tolerance = settings.tolerance,
                                              .budget = settings.budget});
  const auto varied = std::make_shared<long>(0);
  return {.end =
              [stepper](const State& start) {
                State state = start;
                stepper->advance(0, state);
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
          .evaluations = [=] { return stepper->evaluations() + *varied; }};
}

/** Newton in the scaled state y = s/sizes. */
struct Iteration {
  const ShootingSettings& settings;
  Maps maps;
  Eigen::VectorXd sizes, y;
  Eigen::VectorXd open = {};      ///< P(y) - y
  Eigen::MatrixXd jacobian = {};  ///< its derivative
  double reduction = 1;
  Shooting report = {};

  Shooting run(State& state, PeriodicityJacobian& kept)
  {
    try {
      if (kept) {
        jacobian = *kept;
        open = mapped(y) - y;
        report.periodicity_residual = open.norm();
        if (!finished()) quasi_newton_steps();
      }
      while (report.reason.empty()) newton_step();
      if (report.converged) take_known_step();
    } catch (const NoSolution& broken) {
      report.converged = false;
      report.reason = broken.what();
    }
    if (report.derivatives > 0 || kept) kept = jacobian;
    report.evaluations = maps.evaluations();
    state = unscaled(y);
    return report;
  }

  /** Φ at y, one step with it, and further ones while they reduce the residual well. */
  void newton_step()
  {
    const PeriodMap map = integrate_derivative();
    open = vector_of(map.end).cwiseQuotient(sizes) - y;
    report.periodicity_residual = open.norm();
    jacobian = sizes.cwiseInverse().asDiagonal() * map.derivative * sizes.asDiagonal();
    jacobian.diagonal().array() -= 1;
    if (finished()) return;
    if (!quasi_newton_steps() && report.reason.empty())
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
    } while (!finished() && settings.quasi_newton && reduction < well);
    return true;
  }

  /** One step, halved until the residual decreases; Broyden's rule learns from it. */
  bool damped_step()
  {
    const Eigen::VectorXd step = -jacobian.partialPivLu().solve(open);
    const int most_halvings = settings.quasi_newton ? 8 : 12;
    double length = 1;
    for (int halvings = 0; halvings < most_halvings && !out_of_maps();
         ++halvings, length /= 2) {
      const Eigen::VectorXd next = y + length * step;
      const Eigen::VectorXd open_next = mapped(next) - next;
      const double residual = open_next.norm();
      reduction = residual / report.periodicity_residual;
      if (!(reduction < 1)) continue;
      jacobian += (open_next - (1 - length) * open) * step.transpose() /
                  (length * step.squaredNorm());
      y = next;
      open = open_next;
      report.periodicity_residual = residual;
      return true;
    }
    return false;
  }

  void take_known_step()
  {
    const Eigen::VectorXd step = jacobian.partialPivLu().solve(open);
    if (step.allFinite()) y -= step;
    if (settings.final_derivative) integrate_derivative();
  }

  PeriodMap integrate_derivative()
  {
    const PeriodMap map = maps.map(unscaled(y));
    ++report.maps;
    ++report.derivatives;
    report.derivative = map.derivative;
    return map;
  }

  Eigen::VectorXd mapped(const Eigen::VectorXd& at)
  {
    ++report.maps;
    return vector_of(maps.end(unscaled(at))).cwiseQuotient(sizes);
  }

  State unscaled(const Eigen::VectorXd& at) const
  {
    return state_of(at.cwiseProduct(sizes));
  }
  bool out_of_maps() const { return report.maps >= settings.most_maps; }

  bool finished()
  {
    report.converged = report.periodicity_residual <= settings.periodicity_residual;
    if (report.converged)
      stop("converged");
    else if (out_of_maps())
      stop(format("%d periods were integrated", report.maps));
    return !report.reason.empty();
  }

  void stop(const std::string& why)
  {
    report.reason = why + format(" (closure %.1e)", report.periodicity_residual);
  }
};

}  // namespace

Shooting shoot(const Parameters& parameters, double omega, State& state,
               const ShootingSettings& settings, PeriodicityJacobian* jacobian)
{
  PeriodicityJacobian none;
  Eigen::VectorXd sizes = state_scales(parameters);
  sizes.tail(sizes.size() / 2) /= settings.speed_weight;
  const bool by_rk4 =
      settings.method == "rk4" && parameters.machine->takes_explicit_steps();
  const auto maps = by_rk4 ? rk4_maps : controlled_maps;
  return Iteration{settings, maps(parameters, omega, settings), sizes,
                   vector_of(state).cwiseQuotient(sizes)}
      .run(state, jacobian ? *jacobian : none);
}

State quasi_static_state(const Parameters& parameters, double omega)
{
  /** F = rest + Re(whirl (1, -i) e^{iφ}); the stator answers with its receptance, the rotor stands
      off by u, which follows the force. */
  const Vec2 at_0 = rigid_joint_force(parameters, omega, 0);
  const Vec2 rest = static_joint_force(parameters);
  const std::complex<double> whirl(at_0.x - rest.x, at_0.y - rest.y);
  const auto response =
      whirl / dynamic_stiffness(parameters.stator, parameters.turns * omega).value;
  const Vec2 sag = static_start(parameters).position.stator;
  const auto stator = [&](double phase) -> Vec2 {
    const auto turned = response * std::polar(1.0, parameters.turns * phase);
    return {sag.x + turned.real(), sag.y + turned.imag()};
  };
  const auto relative = [&](double phase) {
    return quasi_static_contact(parameters.bearing,
                                rigid_joint_force(parameters, omega, phase));
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
