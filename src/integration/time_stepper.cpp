#include "integration/time_stepper.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>

#include "integration/rk4.hpp"
#include "io/errors.hpp"

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

/** The budget of a stepper, bounded in any case: 1e9 evaluations are half a minute of RK4. */
OperationBudget budget_of(const StepperSettings& settings, double price)
{
  return settings.budget.bounded() ? settings.budget : OperationBudget(1e9 * price);
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

double evaluation_price(const Parameters& parameters, const std::string& method)
{
  if (method == "rk4") return 1;
  const int balls = parameters.bearing.balls;
  const bool explicit_steps = method == "rkf45" || method == "rkck" || method == "rk8pd";
  return ((explicit_steps ? 75 : 330) + 1.5 * balls) / operations_per_evaluation(balls);
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
                                      step, budget_of(settings, 1)));
  }
  return wrap(std::make_shared<GslStepper>(parameters, omega, settings));
}

namespace
{

constexpr int size = 8;
using Flat = std::array<double, size>;  ///< x_s, y_s, x_r, y_r and their speeds

const std::map<std::string, const gsl_odeiv2_step_type*>& step_types()
{
  static const std::map<std::string, const gsl_odeiv2_step_type*> types{
      {"rkf45", gsl_odeiv2_step_rkf45}, {"rkck", gsl_odeiv2_step_rkck},
      {"rk8pd", gsl_odeiv2_step_rk8pd}, {"msadams", gsl_odeiv2_step_msadams},
      {"msbdf", gsl_odeiv2_step_msbdf}, {"bsimp", gsl_odeiv2_step_bsimp}};
  return types;
}

/** What GSL's callbacks see. */
struct Equation7 {
  Parameters parameters;
  RotorStator system;
  OperationBudget budget;
  double price;  ///< of one evaluation
  long evaluations = 0;

  bool pay_for_one()
  {
    ++evaluations;
    return budget.pay(price);
  }
};

int derivative(double t, const double y[], double dydt[], void* data)
{
  auto& equation = *static_cast<Equation7*>(data);
  if (!equation.pay_for_one()) return GSL_EBADFUNC;
  const double phase = equation.system.omega() * t;
  Flat flat;
  std::copy_n(y, size, flat.begin());
  const State state = std::bit_cast<State>(flat);
  const State slope{state.velocity, equation.system.acceleration(
                                        state, equation.system.rotor_direction(phase),
                                        equation.system.cage_direction(phase))};
  const Flat result = std::bit_cast<Flat>(slope);
  std::copy(result.begin(), result.end(), dydt);
  for (double value : result)
    if (!std::isfinite(value)) return GSL_EBADFUNC;
  return GSL_SUCCESS;
}

/** ∂(Eq. 7)/∂y, 8 × 8 by rows, with the bearing's stiffness `s`. */
void state_slopes(const Parameters& parameters, const Stiffness2& s, double* dfdy)
{
  std::fill_n(dfdy, size * size, 0.0);
  for (int i = 0; i < 4; ++i) dfdy[i * size + i + 4] = 1;
  const double slope[2][2] = {{s.xx, s.xy}, {s.xy, s.yy}};
  const Body* bodies[2] = {&parameters.stator, &parameters.rotor};
  for (int body = 0; body < 2; ++body)
    for (int i = 0; i < 2; ++i) {
      double* row = dfdy + (4 + 2 * body + i) * size;
      const double sign = (body == 0 ? 1 : -1) / bodies[body]->mass;
      for (int j = 0; j < 2; ++j) {
        row[j] = -sign * slope[i][j];
        row[2 + j] = sign * slope[i][j];
      }
      row[2 * body + i] -= bodies[body]->stiffness() / bodies[body]->mass;
      row[4 + 2 * body + i] -= bodies[body]->damping() / bodies[body]->mass;
    }
}

int jacobian(double t, const double y[], double* dfdy, double dfdt[], void* data)
{
  auto& equation = *static_cast<Equation7*>(data);
  if (!equation.pay_for_one()) return GSL_EBADFUNC;
  equation_7_slopes(equation.parameters, equation.system, t, y, dfdy, dfdt);
  return GSL_SUCCESS;
}

struct FreeDriver {
  void operator()(gsl_odeiv2_driver* driver) const { gsl_odeiv2_driver_free(driver); }
};

}  // namespace

/** The unbalance turns with the rotor, and the bearing's force with the cage, dF/dθ = F⊥ - S u⊥ at
    constant u. */
void equation_7_slopes(const Parameters& p, const RotorStator& system, double t,
                       const double y[], double* dfdy, double* dfdt)
{
  const double omega = system.omega(), phase = omega * t;
  const Vec2 u{y[2] - y[0], y[3] - y[1]};
  const auto [f, s] = system.bearing().reaction(system.cage_direction(phase), u);
  state_slopes(p, s, dfdy);

  const double cage_speed = p.bearing.cage_speed_ratio * omega;
  const Vec2 turning{cage_speed * (-f.y + s.xx * u.y - s.xy * u.x),
                     cage_speed * (f.x + s.xy * u.y - s.yy * u.x)};
  const double unbalance = p.unbalance * omega * omega * omega;
  std::fill_n(dfdt, 4, 0.0);
  dfdt[4] = turning.x / p.stator.mass;
  dfdt[5] = turning.y / p.stator.mass;
  dfdt[6] = (-turning.x - unbalance * std::sin(phase)) / p.rotor.mass;
  dfdt[7] = (-turning.y + unbalance * std::cos(phase)) / p.rotor.mass;
}

void keep_gsl_from_aborting()
{
  static const bool once = (gsl_set_error_handler_off(), true);
  (void)once;
}

const gsl_odeiv2_step_type* gsl_step_type(const std::string& method)
{
  const auto found = step_types().find(method);
  if (found == step_types().end())
    throw BadInput("method " + method + ": not one of GSL's steppers");
  return found->second;
}

namespace
{

Equation7 equation_of(const Parameters& parameters, double omega,
                      const StepperSettings& settings)
{
  const double price = evaluation_price(parameters, settings.method);
  return {parameters, {parameters, omega}, budget_of(settings, price), price};
}

}  // namespace

struct GslStepper::Driver {
  Equation7 equation;
  gsl_odeiv2_system system;
  std::unique_ptr<gsl_odeiv2_driver, FreeDriver> driver;
};

GslStepper::GslStepper(const Parameters& parameters, double omega,
                       const StepperSettings& settings)
    : driver_(std::make_unique<Driver>(
          Driver{equation_of(parameters, omega, settings), {}, {}})),
      interval_length_(driver_->equation.system.period() / settings.intervals_per_period)
{
  keep_gsl_from_aborting();
  const Scales scale = scales(parameters);
  const double contact_frequency = std::sqrt(
      scale.stiffness * (1 / parameters.stator.mass + 1 / parameters.rotor.mass));
  Flat sizes;
  for (int i = 0; i < 4; ++i) {
    sizes[i] = scale.length;
    sizes[i + 4] = scale.length * contact_frequency;
  }
  driver_->system = {derivative, jacobian, size, &driver_->equation};
  const double first_step = std::min(interval_length_, default_step(parameters));
  driver_->driver.reset(gsl_odeiv2_driver_alloc_scaled_new(
      &driver_->system, gsl_step_type(settings.method), first_step, settings.tolerance, 0,
      1, 0, sizes.data()));
  if (!driver_->driver)
    throw NoSolution(format("%s cannot start with a step of %g s and a tolerance of %g",
                            settings.method.c_str(), first_step, settings.tolerance));
}

GslStepper::~GslStepper() = default;

void GslStepper::advance(long interval, State& state)
{
  if (interval != next_) gsl_odeiv2_driver_reset(driver_->driver.get());
  next_ = interval + 1;
  Flat y = std::bit_cast<Flat>(state);
  double t = static_cast<double>(interval) * interval_length_;
  const double end = static_cast<double>(interval + 1) * interval_length_;
  const int status = gsl_odeiv2_driver_apply(driver_->driver.get(), &t, end, y.data());
  if (status != GSL_SUCCESS) {
    driver_->equation.budget.spend(
        driver_->equation.price);  // throws where that was the reason
    throw NoSolution(
        format("time integration stopped at t = %.9g s: %s", t, gsl_strerror(status)));
  }
  state = std::bit_cast<State>(y);
}

long GslStepper::evaluations() const
{
  return driver_->equation.evaluations;
}

const std::vector<std::string>& gsl_methods()
{
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const auto& [name, type] : step_types()) list.push_back(name);
    return list;
  }();
  return names;
}

}  // namespace rotor_stator
