#include "time/gsl.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <algorithm>
#include <array>
#include <map>

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

/** The evaluations that GSL's callbacks make. */
struct PaidEvaluations {
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

/** One of GSL's adaptive steppers on a system of equations, which must outlive it. */
class GslDriver {
public:
  /** `scales`: the size of each component. */
  GslDriver(gsl_odeiv2_system& system, const std::string& method, double first_step,
            double tolerance, const double* scales);

  /** Advances `y` from `from` to `to` [s]. Throws NoSolution when the steps become too
      small or `evaluations` are not paid for. */
  void advance(double from, double to, double* y, const PaidEvaluations& evaluations);

  /** Forgets the history of multistep methods; the step size is kept. */
  void reset();

private:
  std::unique_ptr<gsl_odeiv2_driver, void (*)(gsl_odeiv2_driver*)> driver_;
};

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
  PaidEvaluations evaluations;
};

int derivative(double t, const double y[], double dydt[], void* data)
{
  auto& equation = *static_cast<Forced*>(data);
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
  auto& equation = *static_cast<Forced*>(data);
  if (!equation.evaluations.pay()) return GSL_EBADFUNC;
  equation_7_slopes(equation.parameters, equation.system, t, y, dfdy, dfdt);
  return GSL_SUCCESS;
}

/** Eq. 7 advanced by GSL. */
class GslStepper : public Flow {
public:
  GslStepper(const Parameters& parameters, double omega, const StepSettings& settings)
      : equation_{parameters,
                  {parameters, omega},
                  {settings.budget, evaluation_price(parameters, settings.method)}},
        interval_length_(equation_.system.period() / settings.intervals_per_period),
        driver_(system_, settings.method,
                std::min(interval_length_, default_step(parameters)), settings.tolerance,
                state_scales(parameters).data())
  {
  }

  /** A jump to another interval than the next one is a new start. */
  using Flow::advance;
  void advance(long interval, State& state) override
  {
    if (interval != next_) driver_.reset();
    next_ = interval + 1;
    Eigen::VectorXd y = vector_of(state);
    driver_.advance(static_cast<double>(interval) * interval_length_,
                    static_cast<double>(next_) * interval_length_, y.data(),
                    equation_.evaluations);
    state = state_of(y);
  }
  long evaluations() const override { return equation_.evaluations.count; }

private:
  Forced equation_;
  gsl_odeiv2_system system_{derivative, jacobian, 8, &equation_};
  double interval_length_;  ///< T/P [s]
  GslDriver driver_;
  long next_ = 0;  ///< the interval that would continue the motion
};

}  // namespace

std::unique_ptr<Flow> gsl_flow(const Parameters& parameters, double omega,
                               const StepSettings& settings)
{
  return std::make_unique<GslStepper>(parameters, omega, settings);
}

/**
## The period map with its derivative */

namespace {

constexpr int equations = 8 + 8 * 8;
constexpr double with_variations = 3;  ///< evaluations of Eq. 7 that take as long

/** What GSL's callback sees. */
struct Variation {
  RotorStator system;
  DisturbanceRates rates;
  PaidEvaluations evaluations;
};

/** State first, then the displacements and the speeds of the disturbances. */
int varied_derivative(double t, const double y[], double dydt[], void* data)
{
  auto& variation = *static_cast<Variation*>(data);
  const RotorStator& system = variation.system;
  if (!variation.evaluations.pay()) return GSL_EBADFUNC;
  const double phase = system.omega() * t;
  const Bodies q_now = bodies_at(y), v_now = bodies_at(y + 4);
  const Angles at = system.bearing().angles(phase);
  const BearingReaction bearing =
      system.bearing().reaction(at, q_now.relative(), v_now.relative());
  std::copy_n(y + 4, 4, dydt);
  put(system.acceleration(q_now, v_now, at.rotor, bearing.force), dydt + 4);

  const Eigen::Map<const Disturbances> q(y + 8), v(y + 40);
  Eigen::Map<Disturbances>(dydt + 8) = v;
  Eigen::Map<Disturbances>(dydt + 40) = variation.rates.acceleration(bearing, q, v);
  return Eigen::Map<Vector8>(dydt).allFinite() ? GSL_SUCCESS : GSL_EBADFUNC;
}

/** Error scales: those of the state; the variations are given so much room that they
    never decide the step. */
std::array<double, equations> error_scales(const Parameters& parameters)
{
  constexpr double room = 1e6;
  const Vector8 sizes = state_scales(parameters);
  std::array<double, equations> scale;
  for (int i = 0; i < 8; ++i) {
    scale[i] = sizes[i];
    for (int j = 0; j < 8; ++j) scale[8 + 8 * i + j] = room * sizes[i] / sizes[j];
  }
  return scale;
}

}  // namespace

PeriodMap gsl_period_map(const Parameters& parameters, double omega, const State& start,
                         const StepSettings& settings, long interval)
{
  Variation variation{
      {parameters, omega},
      DisturbanceRates(parameters),
      {settings.budget, with_variations * evaluation_price(parameters, settings.method)}};
  gsl_odeiv2_system system{varied_derivative, nullptr, equations, &variation};
  const double length = variation.system.period() / settings.intervals_per_period;
  const double from = static_cast<double>(interval) * length;
  GslDriver driver(system, settings.method, std::min(length, default_step(parameters)),
                   settings.tolerance, error_scales(parameters).data());
  std::array<double, equations> y{};
  Eigen::Map<Vector8>(y.data()) = vector_of(start);
  Eigen::Map<Matrix8> disturbances(y.data() + 8);  // the transpose of Φ
  disturbances.setIdentity();
  driver.advance(from, from + length, y.data(), variation.evaluations);
  return {.end = {bodies_at(y.data()), bodies_at(y.data() + 4)},
          .derivative = disturbances.transpose(),
          .evaluations = variation.evaluations.count};
}

}  // namespace rotor_stator
