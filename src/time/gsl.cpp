#include "time/gsl.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <algorithm>
#include <map>
#include <memory>

#include "io/errors.hpp"

namespace rotor_stator {

static std::map<std::string, const gsl_odeiv2_step_type*> step_types()
{
  return {{"rkf45", gsl_odeiv2_step_rkf45}, {"rkck", gsl_odeiv2_step_rkck},
          {"rk8pd", gsl_odeiv2_step_rk8pd}, {"msadams", gsl_odeiv2_step_msadams},
          {"msbdf", gsl_odeiv2_step_msbdf}, {"bsimp", gsl_odeiv2_step_bsimp}};
}

std::vector<std::string> gsl_methods()
{
  std::vector<std::string> names;
  for (const auto& [name, type] : step_types()) names.push_back(name);
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
  const Eigen::Matrix2d joint = s.matrix();
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

/** Eq. 7 advanced by GSL. */
class GslStepper : public Flow {
public:
  GslStepper(const Parameters& parameters, double omega, const StepSettings& settings)
      : parameters_(parameters), system_(parameters, omega), budget_(settings.budget),
        price_(evaluation_price(parameters, settings.method)),
        interval_length_(system_.period() / settings.intervals_per_period),
        driver_(nullptr, gsl_odeiv2_driver_free)
  {
    /** GSL calls abort() on errors unless told otherwise. */
    static const auto handler = gsl_set_error_handler_off();
    (void)handler;
    const double first_step = std::min(interval_length_, default_step(parameters));
    driver_.reset(gsl_odeiv2_driver_alloc_scaled_new(
        &equations_, step_types().at(settings.method), first_step, settings.tolerance, 0,
        1, 0, state_scales(parameters).data()));
    if (!driver_)
      throw NoSolution(format("%s cannot start with a step of %g s and a tolerance of %g",
                              settings.method.c_str(), first_step, settings.tolerance));
  }

  /** A jump to another interval than the next one is a new start; the step size is
      kept. */
  void advance(long interval, State& state) override
  {
    if (interval != next_) gsl_odeiv2_driver_reset(driver_.get());
    next_ = interval + 1;
    Eigen::VectorXd y = vector_of(state);
    double t = static_cast<double>(interval) * interval_length_;
    const double end = static_cast<double>(next_) * interval_length_;
    const int status = gsl_odeiv2_driver_apply(driver_.get(), &t, end, y.data());
    if (status != GSL_SUCCESS) {
      budget_.spend(price_);  // throws where that was the reason
      throw NoSolution(
          format("time integration stopped at t = %.9g s: %s", t, gsl_strerror(status)));
    }
    state = state_of(y);
  }
  long evaluations() const override { return evaluations_; }

private:
  /** What GSL calls. They fail where the budget does not pay for one more. */
  static int derivative(double t, const double y[], double dydt[], void* stepper)
  {
    auto& own = *static_cast<GslStepper*>(stepper);
    if (!own.pays()) return GSL_EBADFUNC;
    const Angles at = own.system_.bearing().angles(own.system_.omega() * t);
    std::copy_n(y + 4, 4, dydt);
    put(own.system_.acceleration(bodies_at(y), bodies_at(y + 4), at), dydt + 4);
    return Eigen::Map<Vector8>(dydt).allFinite() ? GSL_SUCCESS : GSL_EBADFUNC;
  }
  static int jacobian(double t, const double y[], double* dfdy, double dfdt[],
                      void* stepper)
  {
    auto& own = *static_cast<GslStepper*>(stepper);
    if (!own.pays()) return GSL_EBADFUNC;
    equation_7_slopes(own.parameters_, own.system_, t, y, dfdy, dfdt);
    return GSL_SUCCESS;
  }
  bool pays()
  {
    ++evaluations_;
    return budget_.pay(price_);
  }

  Parameters parameters_;
  RotorStator system_;
  OperationBudget budget_;
  double price_;  ///< of one evaluation
  long evaluations_ = 0;
  gsl_odeiv2_system equations_{derivative, jacobian, 8, this};
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
