#include "explore/settled_motion.hpp"

#include <cmath>
#include <numbers>

#include "explore/balance_motion.hpp"
#include "io/errors.hpp"

namespace rotor_stator::explore {

namespace {

/** Mean, rms and amplitude of a motion that never repeats itself, with their standard
    errors. */
void put_statistics(Table& table, const motion::Observation& seen)
{
  const char* const names[] = {"x_s", "y_s", "x_r", "y_r"};
  const auto put = [&](const char* what, const Displacements& values,
                       const Displacements& errors) {
    for (std::size_t i = 0; i < 4; ++i) {
      const std::string key = std::string(what) + "_" + names[i];
      table.value(key, values[i], 6);
      table.value(key + "_error", errors[i], 2);
    }
  };
  put("mean", seen.mean, seen.mean_error);
  put("rms", seen.rms, seen.rms_error);
  put("amp", seen.amplitude, seen.amplitude_error);
  table.note(
      "mean, rms about the mean and amplitude over 256 base periods, with standard "
      "errors; an amplitude grows with the window");
}

}  // namespace

void put_answer(Table& table, const motion::Answer& answer)
{
  const Settled& settled = answer.settled;
  table.value("method", answer.method);
  put_base(table, answer.base.words(), answer.omega / angular(1));
  table.value("regime", word(answer.kind()));
  if (answer.period() > 0) table.value("period", answer.period());
  table.value("stability", answer.stability);
  if (answer.multiplier > 0) {
    table.value("multiplier", answer.multiplier, 9);
    table.value("multiplier_uncertainty", answer.uncertainty, 2);
  }
  table.value("lyapunov", settled.lyapunov.value, 6);
  table.value("lyapunov_uncertainty", settled.lyapunov.error, 2);
  if (answer.error)
    put_difference(table, "error", answer.error->largest, answer.error->rms,
                   answer.error_note);
  if (!settled.reason.empty()) table.note("regime: " + settled.reason);
  table.value("transient", settled.seconds, 6);
  if (answer.base.is_driven_twice()) {
    const double turns =
        answer.machine.bearing.cage_speed_ratio * static_cast<double>(settled.at.period) +
        answer.machine.bearing.cage_phase / angular(1);
    table.value("cage_angle", angular(turns - std::floor(turns)));
  }
}

FoundMotion settled_motion(const Parameters& parameters, const MotionRequest& request,
                           int open_periods, const OperationBudget& budget, Table& table)
try {
  const motion::Answer answer = motion::answer(parameters,
                                               {.omega = angular(request.frequency),
                                                .method = request.method,
                                                .tolerance = request.tolerance,
                                                .points = request.points,
                                                .periods = open_periods,
                                                .step = request.step,
                                                .local_error = request.local_error,
                                                .longest = request.longest,
                                                .is_measured = request.stability},
                                               budget);
  put_answer(table, answer);
  FoundMotion found{.motion = answer.motion, .machine = answer.machine};
  if (answer.kind() == Kind::chaotic) {
    auto seen = attempt([&] { return observe(answer, budget); });
    found.has_statistics = seen.has_value();
    if (seen.has_value())
      put_statistics(table, seen.get());
    else
      table.note("mean, rms and amplitude need more than the budget");
  }
  found.base_frequency = answer.omega / angular(1);
  found.turns_of_period = 1 / answer.base.per_turn;
  if (answer.method == "shooting") {
    found.closes_after = answer.period();
    found.lines = motion::lines_of_closed(as_one_period(answer.motion),
                                          answer.period() * found.turns_of_period);
  }
  return found;
} catch (const Diverged& error) {
  if (request.step == 0) throw;
  throw NoSolution(error.what() + format("; is --step %g too long?", request.step));
}

}  // namespace rotor_stator::explore
