#include "integration/time_stepper.hpp"

#include <gsl/gsl_errno.h>
#include <algorithm>
#include <map>
#include <numbers>

#include "integration/gauss.hpp"
#include "time/rk4.hpp"
#include "io/errors.hpp"

namespace rotor_stator {

namespace {

const std::map<std::string, const gsl_odeiv2_step_type*>& step_types()
{
  static const std::map<std::string, const gsl_odeiv2_step_type*> types{
      {"rkf45", gsl_odeiv2_step_rkf45}, {"rkck", gsl_odeiv2_step_rkck},
      {"rk8pd", gsl_odeiv2_step_rk8pd}, {"msadams", gsl_odeiv2_step_msadams},
      {"msbdf", gsl_odeiv2_step_msbdf}, {"bsimp", gsl_odeiv2_step_bsimp}};
  return types;
}

}  // namespace

const std::vector<std::string>& time_methods()
{
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list{"rk4"};
    for (const auto& [name, type] : step_types()) list.push_back(name);
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
  const int balls = parameters.bearing.balls;
  const bool explicit_steps = method == "rkf45" || method == "rkck" || method == "rk8pd";
  return ((explicit_steps ? 75 : 330) + 1.5 * balls) / operations_per_evaluation(balls);
}

GslDriver::GslDriver(gsl_odeiv2_system& system, const std::string& method,
                     double first_step, double tolerance, const double* scales)
    : driver_(nullptr, gsl_odeiv2_driver_free)
{
  const auto type = step_types().find(method);
  if (type == step_types().end())
    throw BadInput("method " + method + ": not one of GSL's steppers");
  /** GSL calls abort() on errors unless told otherwise. */
  static const auto handler = gsl_set_error_handler_off();
  (void)handler;
  driver_.reset(gsl_odeiv2_driver_alloc_scaled_new(&system, type->second, first_step,
                                                   tolerance, 0, 1, 0, scales));
  if (!driver_)
    throw NoSolution(format("%s cannot start with a step of %g s and a tolerance of %g",
                            method.c_str(), first_step, tolerance));
}

void GslDriver::advance(double from, double to, double* y,
                        const PaidEvaluations& evaluations)
{
  const int status = gsl_odeiv2_driver_apply(driver_.get(), &from, to, y);
  if (status == GSL_SUCCESS) return;
  evaluations.budget.spend(evaluations.price);  // throws where that was the reason
  throw NoSolution(
      format("time integration stopped at t = %.9g s: %s", from, gsl_strerror(status)));
}

void GslDriver::reset()
{
  gsl_odeiv2_driver_reset(driver_.get());
}

/** The unbalance turns with the rotor, and the bearing's force with the cage, dF/dθ = F⊥ - S u⊥ at
    constant u. */
void equation_7_slopes(const Parameters& p, const RotorStator& system, double t,
                       const double y[], double* dfdy, double* dfdt)
{
  const double omega = system.omega(), phase = omega * t;
  const Vec2 u{y[2] - y[0], y[3] - y[1]};
  const Angles at = system.bearing().angles(phase);
  const auto [f, s] = system.bearing().reaction(at.cage, u);

  const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
  Eigen::Matrix2d joint;
  joint << s.xx, s.xy, s.xy, s.yy;
  Eigen::Map<Eigen::Matrix<double, 8, 8, Eigen::RowMajor>> slopes(dfdy);
  slopes.setZero();
  slopes.topRightCorner<4, 4>().setIdentity();
  for (int body : {0, 1}) {
    const Body& b = body == 0 ? p.stator : p.rotor;
    const int row = 4 + 2 * body, other = 2 - 2 * body;
    slopes.block<2, 2>(row, 2 * body) = -(joint + b.stiffness() * one) / b.mass;
    slopes.block<2, 2>(row, other) = joint / b.mass;
    slopes.block<2, 2>(row, 4 + 2 * body) = -b.damping() / b.mass * one;
  }

  const double cage_speed = p.bearing.cage_speed_ratio * omega;
  const Vec2 turning{cage_speed * (-f.y + s.xx * u.y - s.xy * u.x),
                     cage_speed * (f.x + s.xy * u.y - s.yy * u.x)};
  const double speed = p.turns * omega;
  const double unbalance = p.unbalance * speed * speed * speed;
  std::fill_n(dfdt, 4, 0.0);
  dfdt[4] = turning.x / p.stator.mass;
  dfdt[5] = turning.y / p.stator.mass;
  dfdt[6] = (-turning.x - unbalance * at.rotor.sin) / p.rotor.mass;
  dfdt[7] = (-turning.y + unbalance * at.rotor.cos) / p.rotor.mass;
}

namespace {

/** What GSL's callbacks see. */
struct Equation7 {
  Parameters parameters;
  RotorStator system;
  PaidEvaluations evaluations;
};

int derivative(double t, const double y[], double dydt[], void* data)
{
  auto& equation = *static_cast<Equation7*>(data);
  if (!equation.evaluations.pay()) return GSL_EBADFUNC;
  const double phase = equation.system.omega() * t;
  const RotorStator& system = equation.system;
  std::copy_n(y + 4, 4, dydt);
  put(system.acceleration(bodies_at(y), bodies_at(y + 4), system.bearing().angles(phase)),
      dydt + 4);
  return Eigen::Map<Vector8>(dydt).allFinite() ? GSL_SUCCESS : GSL_EBADFUNC;
}

int jacobian(double t, const double y[], double* dfdy, double dfdt[], void* data)
{
  auto& equation = *static_cast<Equation7*>(data);
  if (!equation.evaluations.pay()) return GSL_EBADFUNC;
  equation_7_slopes(equation.parameters, equation.system, t, y, dfdy, dfdt);
  return GSL_SUCCESS;
}

/** Eq. 7 advanced by GSL. */
class GslStepper {
public:
  GslStepper(const Parameters& parameters, double omega, const StepperSettings& settings,
             PaidEvaluations evaluations)
      : equation_{parameters, {parameters, omega}, std::move(evaluations)},
        interval_length_(equation_.system.period() / settings.intervals_per_period),
        driver_(system_, settings.method,
                std::min(interval_length_, default_step(parameters)), settings.tolerance,
                state_scales(parameters).data())
  {
  }

  /** A jump to another interval than the next one is a new start. */
  void advance(long interval, State& state)
  {
    if (interval != next_) driver_.reset();
    next_ = interval + 1;
    Eigen::VectorXd y = vector_of(state);
    driver_.advance(static_cast<double>(interval) * interval_length_,
                    static_cast<double>(next_) * interval_length_, y.data(),
                    equation_.evaluations);
    state = state_of(y);
  }
  long evaluations() const { return equation_.evaluations.count; }

private:
  Equation7 equation_;
  gsl_odeiv2_system system_{derivative, jacobian, 8, &equation_};
  double interval_length_;  ///< T/P [s]
  GslDriver driver_;
  long next_ = 0;  ///< the interval that would continue the motion
};

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
        ": knows no contact damping and no defect; take rk4, rk8pd, rkf45, rkck "
        "or msadams");
  const double price = evaluation_price(parameters, settings.method);
  /** Bounded in any case: 1e9 evaluations are half a minute of RK4. */
  const OperationBudget budget =
      settings.budget.bounded() ? settings.budget : OperationBudget(1e9 * price);
  if (parameters.large)
    return wrap(std::make_shared<GaussStepper>(
        parameters, omega, settings.intervals_per_period,
        settings.method == "rk4" ? 1e-8 : settings.tolerance, budget));
  if (settings.method != "rk4")
    return wrap(std::make_shared<GslStepper>(parameters, omega, settings,
                                             PaidEvaluations{budget, price}));
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
