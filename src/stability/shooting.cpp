#include "stability/shooting.hpp"

#include <Eigen/LU>
#include <cmath>

#include "integration/time_stepper.hpp"
#include "model/errors.hpp"

namespace rotor_stator
{

namespace
{

/** Newton in the scaled state y = s/sizes. */
class Iteration
{
public:
  Iteration(const Parameters& parameters, double omega, const State& start,
            const ShootingSettings& settings)
      : parameters_(parameters),
        omega_(omega),
        settings_(settings),
        sizes_(state_scales(parameters)),
        y_(vector_of(start).cwiseQuotient(sizes_)),
        report_{.converged = false,
                .closure = 0,
                .maps = 0,
                .derivatives = 0,
                .evaluations = 0,
                .derivative = Matrix8::Identity(),
                .reason = {}}
  {
  }

  Shooting run(State& state)
  {
    try {
      while (report_.reason.empty()) newton_step();
    } catch (const NoSolution& broken) {
      report_.reason = broken.what();
    }
    state = state_of(Vector8(y_.cwiseProduct(sizes_)));
    return report_;
  }

private:
  void newton_step()
  {
    const PeriodMap map = period_map(parameters_, omega_, unscaled(y_),
                                     settings_.tolerance, settings_.method);
    ++report_.maps;
    ++report_.derivatives;
    report_.evaluations += map.evaluations;
    report_.derivative = map.derivative;
    open_ = vector_of(map.end).cwiseQuotient(sizes_) - y_;
    report_.closure = open_.norm();
    if (finished()) return;
    const Matrix8 scaled =
        sizes_.cwiseInverse().asDiagonal() * map.derivative * sizes_.asDiagonal();
    factors_.compute(scaled - Matrix8::Identity());
    if (!chord_step()) {
      stop("no step closes the motion better");
      return;
    }
    constexpr double well = 0.1;  ///< a reduction that earns another step with the same Φ
    while (!finished() && reduction_ < well && chord_step()) {
    }
  }

  /** One step with the factors at hand, halved until the closure decreases. */
  bool chord_step()
  {
    const Vector8 step = -factors_.solve(open_);
    double length = 1;
    for (int halvings = 0; halvings < 8 && !out_of_maps(); ++halvings, length /= 2) {
      const Vector8 y = y_ + length * step;
      const Vector8 open = mapped(y) - y;
      const double reduction = open.norm() / report_.closure;
      if (!(reduction < 1)) continue;
      y_ = y;
      open_ = open;
      reduction_ = reduction;
      report_.closure = open.norm();
      return true;
    }
    return false;
  }

  /** P without its derivative. */
  Vector8 mapped(const Vector8& y)
  {
    const TimeStepper stepper = make_stepper(parameters_, omega_,
                                             {.method = settings_.method,
                                              .intervals_per_period = 1,
                                              .tolerance = settings_.tolerance});
    State state = unscaled(y);
    stepper.advance(0, state);
    ++report_.maps;
    report_.evaluations += stepper.evaluations();
    return vector_of(state).cwiseQuotient(sizes_);
  }

  State unscaled(const Vector8& y) const
  {
    return state_of(Vector8(y.cwiseProduct(sizes_)));
  }
  bool out_of_maps() const { return report_.maps >= settings_.most_maps; }

  bool finished()
  {
    report_.converged = report_.closure <= settings_.closure;
    if (report_.converged)
      stop("converged");
    else if (out_of_maps())
      stop(text("%d periods were integrated", report_.maps));
    return !report_.reason.empty();
  }

  void stop(const std::string& why)
  {
    report_.reason = why + text(" (closure %.1e)", report_.closure);
  }

  const Parameters& parameters_;
  double omega_;
  const ShootingSettings& settings_;
  Vector8 sizes_, y_;
  Vector8 open_;  ///< P(y) - y
  double reduction_ = 1;
  Eigen::PartialPivLU<Matrix8> factors_;
  Shooting report_;
};

}  // namespace

Shooting shoot(const Parameters& parameters, double omega, State& state,
               const ShootingSettings& settings)
{
  return Iteration(parameters, omega, state, settings).run(state);
}

}  // namespace rotor_stator
