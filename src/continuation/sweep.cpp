#include "continuation/sweep.hpp"

#include "continuation/lagrange_predictor.hpp"

namespace rotor_stator
{

namespace
{

/** The state of a sweep between two speeds. */
class Sweep
{
public:
  Sweep(Balance& balance, const ColdStart& cold_start, const SweepSettings& settings)
      : balance_(balance),
        cold_start_(cold_start),
        settings_(settings),
        predictor_(settings.arc_unknown_scale, settings.speed_scale)
  {
  }

  SweepPoint solve_at(double omega)
  {
    SweepPoint point{omega, {}, {}, false};
    if (!predictor_.empty()) approach(point, omega, settings_.most_halvings);
    if (!point.found()) {
      predictor_.clear();
      point.restarted = true;
      attempt(point, omega, cold_start_(omega));
    }
    if (!point.found()) point.x.resize(0);
    return point;
  }

private:
  /** One Newton solution at `omega`; on success the predictor learns it. */
  bool attempt(SweepPoint& point, double omega, Eigen::VectorXd x)
  {
    const int before = point.newton.iterations;
    point.newton = solve(balance_, omega, x, settings_.newton);
    point.newton.iterations += before;
    if (!point.found()) return false;
    predictor_.add(x, omega);
    last_omega_ = omega;
    point.x = std::move(x);
    return true;
  }

  /** From the last solution to the point's speed, through half-way speeds if it must be.
   */
  bool approach(SweepPoint& point, double omega, int halvings)
  {
    if (attempt(point, omega, predictor_.at_speed(omega))) return true;
    if (halvings == 0) return false;
    const double middle = 0.5 * (last_omega_ + omega);
    return approach(point, middle, halvings - 1) && approach(point, omega, halvings - 1);
  }

  Balance& balance_;
  const ColdStart& cold_start_;
  const SweepSettings& settings_;
  LagrangePredictor predictor_;
  double last_omega_ = 0;
};

}  // namespace

std::vector<SweepPoint> sweep(Balance& balance, const std::vector<double>& omegas,
                              const ColdStart& cold_start, const SweepSettings& settings,
                              const std::function<void(const SweepPoint&)>& visit)
{
  Sweep state(balance, cold_start, settings);
  std::vector<SweepPoint> points;
  for (double omega : omegas) {
    points.push_back(state.solve_at(omega));
    if (visit && points.back().found()) visit(points.back());
  }
  return points;
}

}  // namespace rotor_stator
