#include "hard/answer.hpp"

#include <algorithm>
#include <cmath>

#include "io/errors.hpp"

namespace rotor_stator::hard {

void claim(const HardRule& rule, const std::string& refined, Answer& answer)
{
  if (!(answer.stated <= rule.accuracy))
    throw NoSolution(refined + format(" moves it by %.2g of its size", answer.stated));
  answer.claimed = true;
}

OperationBudget budget_of(const HardCase& hard, const std::string& method,
                          double evaluations)
{
  return OperationBudget(evaluations * evaluation_price(hard.machine, method));
}

OperationBudget shooting_budget(const HardCase& hard)
{
  return budget_of(hard, "rk8pd", 1.5e7);
}

SteadySettings hard_settings(const HardCase& hard, const std::string& method, double step)
{
  SteadySettings settings;
  settings.stepper = {.method = method,
                      .intervals_per_period = compared_points,
                      .step = step,
                      .budget = budget_of(hard, method, 1e8)};
  settings.settled = 1e-8;
  settings.longest = 20;
  return settings;
}

motion::Motion period_from(const HardCase& hard, const State& start)
{
  const TimeStepper stepper = make_stepper(hard.machine, angular(hard.frequency),
                                           {.method = "rk8pd",
                                            .intervals_per_period = compared_points,
                                            .tolerance = 1e-11,
                                            .budget = budget_of(hard, "rk8pd", 1e8)});
  State state = start;
  return motion::recorded(stepper, compared_points, state);
}

double motion_difference(const motion::Motion& motion, const motion::Motion& reference)
{
  const double difference = motion::relative_difference(motion, reference);
  return std::isnan(difference) ? 0 : difference;
}

double amplitude_change(const motion::Motion& motion, const motion::Motion& reference)
{
  const auto a = half_peak_to_peak(motion), b = half_peak_to_peak(reference);
  double largest = 0, size = 0;
  for (int i = 0; i < 4; ++i) {
    largest = std::max(largest, std::abs(a[i] - b[i]));
    size = std::max(size, b[i]);
  }
  return size > 0 ? largest / size : 0;
}

int shown_periods(const HardCase& hard)
{
  return static_cast<int>(std::clamp(hard.frequency, 1.0, 100.0));
}

}  // namespace rotor_stator::hard
