#include "time/time_stepper.hpp"

#include <algorithm>
#include <memory>
#include <numbers>

#include "io/errors.hpp"
#include "time/gauss.hpp"
#include "time/gsl.hpp"
#include "time/rk4.hpp"
#include "time/rk8.hpp"

namespace rotor_stator {

const std::vector<std::string>& time_methods()
{
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list{"rk4", "rk8"};
    list.insert(list.end(), gsl_methods().begin(), gsl_methods().end());
    return list;
  }();
  return names;
}

void require_method(const std::string& method, std::vector<std::string> others)
{
  others.insert(others.end(), time_methods().begin(), time_methods().end());
  if (std::ranges::find(others, method) != others.end()) return;
  std::string list;
  for (const auto& name : others) list += (list.empty() ? "" : ", ") + name;
  throw BadInput("--method " + method + ": must be one of " + list);
}

double default_step(const Parameters& parameters)
{
  const double contact = 2 * std::numbers::pi / contact_frequency(parameters) / 40;
  /** A damper of the contact's own size lets no speed change within a step. */
  const double rate = parameters.bearing.damping * scales(parameters).load *
                      (1 / parameters.stator.mass + 1 / parameters.rotor.mass);
  return rate > 0 ? std::min(contact, 0.5 / rate) : contact;
}

double evaluation_price(const Parameters& parameters, const std::string& method)
{
  if (method == "rk4") return 1;
  if (method == "rk8") return Rk8::price;
  const int balls = parameters.bearing.balls;
  const bool explicit_steps = method == "rkf45" || method == "rkck" || method == "rk8pd";
  return ((explicit_steps ? 75 : 330) + 1.5 * balls) / operations_per_evaluation(balls);
}

namespace {

template <class Stepper>
TimeStepper wrap(std::shared_ptr<Stepper> stepper)
{
  return {.advance = [stepper](long interval,
                               State& state) { stepper->advance(interval, state); },
          .evaluations = [stepper] { return stepper->evaluations(); }};
}

}  // namespace

TimeStepper make_stepper(const Parameters& parameters, double omega,
                         const StepperSettings& settings)
{
  if (!parameters.large) require_method(settings.method);
  const bool needs_slopes = settings.method == "bsimp" || settings.method == "msbdf";
  if (needs_slopes && !parameters.bearing.is_plain())
    throw BadInput(
        "--method " + settings.method +
        ": knows no contact damping and no defect; take rk4, rk8, rk8pd, rkf45, "
        "rkck or msadams");
  const double price = evaluation_price(parameters, settings.method);
  /** Bounded in any case: 1e9 evaluations are half a minute of RK4. */
  const OperationBudget budget =
      settings.budget.bounded() ? settings.budget : OperationBudget(1e9 * price);
  if (parameters.large)
    return wrap(std::make_shared<GaussStepper>(
        parameters, omega, settings.intervals_per_period,
        settings.method == "rk4" ? 1e-8 : settings.tolerance, budget));
  if (settings.method == "rk8")
    return wrap(std::make_shared<Rk8>(parameters, omega, settings.intervals_per_period,
                                      settings.tolerance, budget));
  if (settings.method != "rk4") {
    StepperSettings paid = settings;
    paid.budget = budget;
    return wrap(std::shared_ptr<Flow>(gsl_flow(parameters, omega, paid)));
  }
  const double step = settings.step > 0 ? settings.step : default_step(parameters);
  const auto rk4 = std::make_shared<Rk4>(parameters, omega, settings.intervals_per_period,
                                         step, budget);
  TimeStepper stepper = wrap(rk4);
  if (parameters.bearing.is_plain())
    stepper.advance_both = [rk4](long interval, State& a, State& b) {
      rk4->advance(interval, a, b);
    };
  return stepper;
}

}  // namespace rotor_stator
