#include "integration/time_stepper.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "integration/gsl_stepper.hpp"
#include "integration/rk4.hpp"
#include "model/errors.hpp"

namespace rotor_stator
{

namespace
{

template <class Stepper>
TimeStepper wrap(std::shared_ptr<Stepper> stepper)
{
  return {.advance = [stepper](long interval,
                               State& state) { stepper->advance(interval, state); },
          .evaluations = [stepper] { return stepper->evaluations(); }};
}

/** Operations for an evaluation of Eq. 7, with the method's share of a step. */
double evaluation_cost(const Parameters& parameters, const std::string& method)
{
  const double balls = parameters.bearing.balls;
  if (method == "rk4") return 15 + 1.35 * balls;
  const bool explicit_steps = method == "rkf45" || method == "rkck" || method == "rk8pd";
  return explicit_steps ? 75 + 1.5 * balls : 330 + 1.5 * balls;
}

}  // namespace

const std::vector<std::string>& time_methods()
{
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list = gsl_methods();
    list.insert(list.begin(), "rk4");
    return list;
  }();
  return names;
}

double default_step(const Parameters& parameters)
{
  const double contact_frequency =
      std::sqrt(scales(parameters).stiffness *
                (1 / parameters.stator.mass + 1 / parameters.rotor.mass));
  return 2 * std::numbers::pi / contact_frequency / 40;
}

Allowance allowance(const Parameters& parameters, const StepperSettings& settings)
{
  return {settings.most_evaluations, settings.work,
          evaluation_cost(parameters, settings.method)};
}

void require_method(const std::string& method)
{
  const auto& known = time_methods();
  if (method == "aft" || std::find(known.begin(), known.end(), method) != known.end())
    return;
  std::string list = "aft";
  for (const auto& name : known) list += ", " + name;
  throw BadInput("--method " + method + ": must be one of " + list);
}

TimeStepper make_stepper(const Parameters& parameters, double omega,
                         const StepperSettings& settings)
{
  require_method(settings.method);
  if (settings.method == "rk4") {
    const double step = settings.step > 0 ? settings.step : default_step(parameters);
    return wrap(std::make_shared<Rk4>(parameters, omega, settings.intervals_per_period,
                                      step, allowance(parameters, settings)));
  }
  return wrap(std::make_shared<GslStepper>(parameters, omega, settings));
}

}  // namespace rotor_stator
