#include "time/flow.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "io/errors.hpp"
#include "time/fixed_step.hpp"
#include "time/gsl.hpp"
#include "time/rk8.hpp"

namespace rotor_stator {

const std::vector<std::string>& time_methods()
{
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list = gsl_methods();
    list.insert(list.begin(), {"rk4", "splitting", "rk8"});
    return list;
  }();
  return names;
}

void require_method(const std::string& method, std::vector<std::string> others)
{
  others.insert(others.end(), time_methods().begin(), time_methods().end());
  if (std::ranges::find(others, method) != others.end()) return;
  throw BadInput("--method " + method + ": must be one of " + joined(others, ", "));
}

void require_bearing_of(const std::string& method, const Parameters& parameters)
{
  const bool is_of_plain = method == "bsimp" || method == "msbdf" ||
                           method == "splitting" || method == "central";
  if (is_of_plain && !has_elastic_hertz_alone(parameters))
    throw BadInput(
        "--method " + method +
        ": knows Hertz's contact alone, undamped, undamaged and without elements beside "
        "it or to the ground; take rk4, rk8, rk8pd, "
        "rkf45, rkck or msadams");
}

double default_step(const Parameters& parameters)
{
  const Scales sizes = scales(parameters);
  double contact = 2 * std::numbers::pi / contact_frequency(parameters) / 40;
  /** A damper of the contact's own size lets no speed change within a step. */
  const double damper = parameters.bearing.damping * sizes.load +
                        largest_damping(parameters.bearing.parallel);
  double rate = damper * (1 / parameters.stator.mass + 1 / parameters.rotor.mass);
  const double mass = std::min(parameters.stator.mass, parameters.rotor.mass);
  double held = 0;
  for (const Bearing& ground : parameters.grounds) {
    held += largest_stiffness(ground.parallel, sizes.load, sizes.length) / mass;
    rate += largest_damping(ground.parallel) / mass;
  }
  if (held > 0) contact = std::min(contact, 2 * std::numbers::pi / std::sqrt(held) / 40);
  return rate > 0 ? std::min(contact, 0.5 / rate) : contact;
}

double step_ratio(std::optional<double> tolerance)
{
  return std::clamp(std::pow(tolerance.value_or(0) / 1e-6, 0.25), 1.0, 2.0);
}

double evaluation_price(const Parameters& parameters, const std::string& method)
{
  if (method == "auto" || has_fixed_step(method)) return 1;
  if (method == "rk8") return Rk8::price;
  const int balls = parameters.bearing.balls;
  const bool explicit_steps = method == "rkf45" || method == "rkck" || method == "rk8pd";
  return ((explicit_steps ? 75 : 330) + 1.5 * balls) / operations_per_evaluation(balls);
}

const char* Machine::time_method(const Parameters& parameters) const
{
  return has_elastic_hertz_alone(parameters) ? "splitting" : "rk4";
}

/** A contact of Hertz is stiffer with the third root of its force, and vibrates faster
    with the sixth. The long steps of the splitting have less to spare, and take 24 steps
    while a ball passes. */
double Machine::step(const Parameters& machine, double omega) const
{
  constexpr double in_passage = 24;
  const std::string method = time_method(machine);
  const bool is_splitting = method == "splitting";
  const double much = is_splitting ? 1 : 30;
  double usual = default_step(machine), force = 0;
  for (const double phase : {0.0, 0.5, 1.0, 1.5}) {
    const Vec2 f = rigid_joint_force(machine, omega, phase);
    force = std::max(force, std::hypot(f.x, f.y));
  }
  const double ratio = force / (much * scales(machine).load);
  if (std::isfinite(ratio) && ratio > 1) usual /= std::pow(ratio, 1.0 / 6);
  if (!is_splitting) return usual;
  const double passage =
      2 * std::numbers::pi / (passages_per_turn(machine.bearing) * omega);
  return std::min(usual, passage / (in_passage * steps_of_rk4(method)));
}

std::unique_ptr<Flow> flow(const Parameters& parameters, double omega,
                           const StepSettings& settings)
{
  StepSettings paid = settings;
  /** Bounded in any case: 1e9 evaluations are half a minute of RK4. */
  if (!paid.budget.bounded())
    paid.budget = OperationBudget(1e9 * evaluation_price(parameters, settings.method));
  return parameters.bodies->flow(parameters, omega, paid);
}

std::unique_ptr<Flow> Machine::flow(const Parameters& parameters, double omega,
                                    const StepSettings& settings) const
{
  const std::string method =
      settings.method == "auto" ? time_method(parameters) : settings.method;
  require_method(method);
  require_bearing_of(method, parameters);
  const int intervals = settings.intervals_per_period;
  const double longest = settings.step > 0 ? settings.step : step(parameters, omega);
  if (has_fixed_step(method))
    return std::make_unique<FixedStep>(
        parameters, omega, intervals, steps_of_rk4(method) * longest,
        method == "rk4" ? Rule::rk4 : Rule::splitting, settings.budget);
  if (method == "rk8")
    return std::make_unique<Rk8>(parameters, omega, intervals, settings.tolerance,
                                 settings.budget);
  return gsl_flow(parameters, omega, settings);
}

}  // namespace rotor_stator
