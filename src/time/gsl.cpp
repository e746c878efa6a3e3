#include "time/gsl.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <algorithm>
#include <map>
#include <memory>

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

const std::vector<std::string>& gsl_methods()
{
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const auto& [name, type] : step_types()) list.push_back(name);
    return list;
  }();
  return names;
}

/** The unbalance turns with the rotor, and the bearing's force with the cage, dF/dθ = F⊥
    - S u⊥ at constant u. */
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
struct Forced {
  Parameters parameters;
  RotorStator system;
  OperationBudget budget;
  double price;  ///< of one evaluation
  long count = 0;

  /** False when the budget does not pay for one more. */
  bool pay()
  {
    ++count;
    return budget.pay(price);
  }
};

int derivative(double t, const double y[], double dydt[], void* data)
{
  auto& equation = *static_cast<Forced*>(data);
  if (!equation.pay()) return GSL_EBADFUNC;
  const double phase = equation.system.omega() * t;
  const RotorStator& system = equation.system;
  std::copy_n(y + 4, 4, dydt);
  put(system.acceleration(bodies_at(y), bodies_at(y + 4), system.bearing().angles(phase)),
      dydt + 4);
  return Eigen::Map<Vector8>(dydt).allFinite() ? GSL_SUCCESS : GSL_EBADFUNC;
}

int jacobian(double t, const double y[], double* dfdy, double dfdt[], void* data)
{
  auto& equation = *static_cast<Forced*>(data);
  if (!equation.pay()) return GSL_EBADFUNC;
  equation_7_slopes(equation.parameters, equation.system, t, y, dfdy, dfdt);
  return GSL_SUCCESS;
}

/** Eq. 7 advanced by GSL. */
class GslStepper : public Flow {
public:
  GslStepper(const Parameters& parameters, double omega, const StepSettings& settings)
      : equation_{parameters,
                  {parameters, omega},
                  settings.budget,
                  evaluation_price(parameters, settings.method)},
        interval_length_(equation_.system.period() / settings.intervals_per_period),
        driver_(nullptr, gsl_odeiv2_driver_free)
  {
    const auto type = step_types().find(settings.method);
    if (type == step_types().end())
      throw BadInput("method " + settings.method + ": not one of GSL's steppers");
    /** GSL calls abort() on errors unless told otherwise. */
    static const auto handler = gsl_set_error_handler_off();
    (void)handler;
    const double first_step = std::min(interval_length_, default_step(parameters));
    driver_.reset(gsl_odeiv2_driver_alloc_scaled_new(&system_, type->second, first_step,
                                                     settings.tolerance, 0, 1, 0,
                                                     state_scales(parameters).data()));
    if (!driver_)
      throw NoSolution(format("%s cannot start with a step of %g s and a tolerance of %g",
                              settings.method.c_str(), first_step, settings.tolerance));
  }

  /** A jump to another interval than the next one is a new start; the step size is
      kept. */
  using Flow::advance;
  void advance(long interval, State& state) override
  {
    if (interval != next_) gsl_odeiv2_driver_reset(driver_.get());
    next_ = interval + 1;
    Eigen::VectorXd y = vector_of(state);
    double t = static_cast<double>(interval) * interval_length_;
    const double end = static_cast<double>(next_) * interval_length_;
    const int status = gsl_odeiv2_driver_apply(driver_.get(), &t, end, y.data());
    if (status != GSL_SUCCESS) {
      equation_.budget.spend(equation_.price);  // throws where that was the reason
      throw NoSolution(
          format("time integration stopped at t = %.9g s: %s", t, gsl_strerror(status)));
    }
    state = state_of(y);
  }
  long evaluations() const override { return equation_.count; }

private:
  Forced equation_;
  gsl_odeiv2_system system_{derivative, jacobian, 8, &equation_};
  double interval_length_;  ///< T/P [s]
  std::unique_ptr<gsl_odeiv2_driver, void (*)(gsl_odeiv2_driver*)> driver_;
  long next_ = 0;  ///< the interval that would continue the motion
};

}  // namespace

std::unique_ptr<Flow> gsl_flow(const Parameters& parameters, double omega,
                               const StepSettings& settings)
{
  return std::make_unique<GslStepper>(parameters, omega, settings);
}

}  // namespace rotor_stator
