#include "scenes/timed_sweeps.hpp"

#include <cmath>

#include "balance/bearing_problem.hpp"
#include "integration/rk4.hpp"
#include "scenes/response.hpp"

namespace rotor_stator
{

void BalanceSweep::run()
{
  std::vector<double> omegas;
  for (double frequency : scene_.frequencies) omegas.push_back(angular(frequency));
  Balance balance(bearing_problem(scene_.parameters, samples_), harmonics_);
  series_.clear();
  points_ = sweep(
      balance, omegas,
      [&](double omega) {
        return quasi_static_start(scene_.parameters, omega, harmonics_);
      },
      sweep_settings(scene_.parameters),
      [&](const SweepPoint& point) {
        series_.push_back(body_series(scene_.parameters, balance, point.omega, point.x));
      });
  evaluations_ = balance.evaluations() * samples_;
}

Motions BalanceSweep::motions() const
{
  Motions motions;
  std::size_t found = 0;
  for (const SweepPoint& point : points_) {
    motions.emplace_back();
    if (!point.found()) continue;
    motions.back() =
        motion_of(series_[found++], scene_.reference.stepper.intervals_per_period);
  }
  return motions;
}

void Rk4Sweep::run()
{
  const int points = scene_.reference.stepper.intervals_per_period;
  State state = static_start(scene_.parameters);
  motions_.clear();
  evaluations_ = 0;
  for (double frequency : scene_.frequencies) {
    /** Whole periods of the transient in the fewest steps; one period cut at the instants that are
        compared. */
    Rk4 transient(scene_.parameters, angular(frequency), 1, step_);
    const long periods = std::lround(std::ceil(transient_ * frequency));
    for (long k = 0; k < periods; ++k) transient.advance(k, state);
    Rk4 last_period(scene_.parameters, angular(frequency), points, step_);
    motions_.push_back(recorded(last_period, points, state, periods));
    evaluations_ += transient.evaluations() + last_period.evaluations();
  }
}

}  // namespace rotor_stator
