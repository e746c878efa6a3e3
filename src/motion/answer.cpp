#include "motion/answer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "io/errors.hpp"
#include "motion/find_periodic.hpp"
#include "motion/judge.hpp"
#include "time/shooting.hpp"

namespace rotor_stator::motion {

int Answer::period_number() const
{
  switch (kind()) {
    case Kind::rest: return 1;
    case Kind::periodic: return period();
    case Kind::quasi_periodic: return -1;
    case Kind::chaotic: return 0;
    case Kind::undecided: break;
  }
  return -2;
}

namespace {

/** All of a record as one period: what differences are taken over. */
Motion as_one_period(Motion motion)
{
  motion.points_per_period = static_cast<int>(motion.size());
  return motion;
}

/**
## A motion that closes */

class Closing {
public:
  Closing(const Answer& answer, const Request& request, const OperationBudget& budget)
      : machine_(over_turns(answer.machine, answer.settled.period)),
        omega_(answer.omega / answer.settled.period), request_(request), budget_(budget)
  {
  }

  /** Whether shooting closes the motion that the state is on. */
  bool close(State& state, double local_error) const
  {
    constexpr double near = 1e-2;  ///< of the sizes: farther away it is another one
    State closed = state;
    const Shooting shooting = shoot(machine_, omega_, closed,
                                    {.tolerance = local_error,
                                     .closed = std::max(1e-9, 10 * local_error),
                                     .budget = budget_});
    if (!shooting.converged || !(apart(machine_, closed, state) < near)) return false;
    state = closed;
    return true;
  }

  Motion record(const State& state, double local_error, int points) const
  {
    return one_period(
        machine_, omega_, state,
        {.intervals_per_period = points, .tolerance = local_error, .budget = budget_});
  }

private:
  Parameters machine_;  ///< over K base periods
  double omega_;
  const Request& request_;
  OperationBudget budget_;
};

/** λ [1/s] of a closed motion from its largest multiplier. */
Exponent exponent_of(const Floquet& floquet, double period)
{
  const double largest = floquet.largest();
  return {std::log(largest) / period, floquet.uncertainty() / largest / period};
}

/** False where shooting does not close the motion: the integrated one is then recorded. */
bool close(Answer& answer, const Request& request, const OperationBudget& budget)
{
  const int k = answer.settled.period, points = k * request.points;
  const Closing closing(answer, request, budget);
  State state = answer.settled.at.state;
  if (!closing.close(state, request.local_error)) return false;
  answer.settled.at = {state, 0};
  answer.motion = closing.record(state, request.local_error, points);
  answer.method = "shooting";
  answer.how = format("shooting over %d base periods from where integration settles", k);
  if (request.is_measured) {
    State finer = state;
    closing.close(finer, 0.01 * request.local_error);
    answer.error = difference(answer.motion,
                              closing.record(finer, 0.01 * request.local_error, points));
    const Verdict verdict = judge_through(answer.machine, answer.omega, state, budget, k);
    answer.evaluations += verdict.evaluations;
    if (verdict.found()) {
      answer.stability = verdict.word();
      answer.multiplier = verdict.floquet.largest();
      answer.uncertainty = verdict.floquet.uncertainty();
      if (answer.multiplier > 10 * answer.uncertainty)
        answer.settled.lyapunov =
            exponent_of(verdict.floquet, k * 2 * std::numbers::pi / answer.omega);
    }
  }
  answer.motion.points_per_period = request.points;
  answer.motion.omega = answer.omega;
  return true;
}

/**
## A motion that is recorded */

class Recording {
public:
  Recording(const Answer& answer, const Request& request, long periods,
            const OperationBudget& budget)
      : answer_(answer), request_(request), periods_(periods), budget_(budget)
  {
  }

  /** From the same earlier state, so that a motion whose neighbours contract is that of these steps. `finer`: by so much
      smaller steps, or a local error smaller by its square. */
  Motion operator()(double finer)
  {
    const auto stepper = [&](int intervals) {
      const bool has_step = request_.method == "auto" || request_.method == "rk4";
      const double step =
          request_.step > 0 ? request_.step : step_at(answer_.machine, answer_.omega);
      return flow(answer_.machine, answer_.omega,
                  {.method = has_step ? "rk4" : request_.method,
                   .intervals_per_period = intervals,
                   .step = step / finer,
                   .tolerance = request_.local_error / (finer * finer),
                   .budget = budget_});
    };
    const Settled& settled = answer_.settled;
    const Instant& from = settled.contracts ? settled.before : settled.at;
    State state = from.state;
    const auto whole = stepper(1), parts = stepper(request_.points);
    for (long k = from.period; k < settled.at.period; ++k) whole->advance(k, state);
    Motion motion = recorded(*parts, request_.points, state, settled.at.period, periods_);
    motion.omega = answer_.omega;
    evaluations_ += static_cast<double>(whole->evaluations() + parts->evaluations());
    return motion;
  }
  double evaluations() const { return evaluations_; }

private:
  const Answer& answer_;
  const Request& request_;
  long periods_;
  OperationBudget budget_;
  double evaluations_ = 0;
};

void record(Answer& answer, const Request& request, const OperationBudget& budget)
{
  constexpr int most_halvings = 6;
  const Settled& settled = answer.settled;
  Recording recording(answer, request, std::max(request.periods, settled.period), budget);
  answer.motion = recording(1);
  answer.method = request.method == "auto" ? "rk4" : request.method;
  answer.how = "integration";
  if (request.is_measured && settled.contracts) {
    double finer = 1;
    for (int halvings = 0; halvings < most_halvings; ++halvings) {
      Motion next = recording(finer *= 2);
      answer.error = difference(as_one_period(answer.motion), as_one_period(next));
      answer.error->largest += settled.remainder;
      answer.error->rms += settled.remainder;
      answer.motion = std::move(next);
      if (!request.tolerance || answer.error->larger() <= *request.tolerance) break;
    }
    answer.stability = "stable";
    answer.how =
        format("integration, with half the step for the error; step over %g", finer);
  }
  answer.evaluations += recording.evaluations();
}

/** A machine that does not move. */
void rest(Answer& answer, const Request& request)
{
  answer.motion = {request.points, 0, {}};
  answer.motion.omega = answer.omega;
  for (int k = 0; k < request.periods * request.points; ++k)
    add(answer.motion, answer.settled.at.state);
  answer.error = Error{};
  if (answer.settled.contracts) answer.stability = "stable";
  answer.method = request.method == "auto" ? "rk4" : request.method;
  answer.how = "static equilibrium";
}

}  // namespace

Answer settled_answer(const Parameters& parameters, const Request& request,
                      const OperationBudget& budget, const State* start)
{
  Answer found{.base = base_period(parameters), .settled = {}};
  const Based based = over(found.base, parameters, request.omega);
  found.machine = based.machine;
  found.omega = based.omega;
  Instant first = from_rest(based.machine, based.omega);
  if (start) first.state = *start;
  found.settled = settle(based.machine, based.omega, found.base, first,
                         {.step = request.step, .longest = request.longest}, budget);
  found.evaluations = found.settled.evaluations;
  return found;
}

void complete(Answer& answer, const Request& request, const OperationBudget& budget)
{
  if (answer.kind() == Kind::rest) return rest(answer, request);
  const bool is_closed = answer.kind() == Kind::periodic && request.method == "auto" &&
                         close(answer, request, budget);
  if (!is_closed) record(answer, request, budget);
  if (request.tolerance && answer.error &&
      !(answer.error->larger() <= *request.tolerance))
    throw NoSolution(format("%s: tolerance %g not reached at %g Hz, error %.2g",
                            answer.machine.file.c_str(), *request.tolerance,
                            request.omega / angular(1), answer.error->larger()));
}

Answer answer(const Parameters& parameters, const Request& request,
              const OperationBudget& budget)
{
  Answer found = settled_answer(parameters, request,
                                budget.part(parameters.machine->patience().transient));
  complete(found, request, budget);
  return found;
}

namespace {

/** Sums over the instants of one base period. */
struct PeriodSums {
  Displacements low, high;
  std::array<double, 4> sum{}, squares{};
};

/** The mean over neighbouring batches of `batch` periods of a measure of each, and its standard error. */
template <class Measure>
BatchMean over_batches(const std::vector<PeriodSums>& periods, std::size_t batch,
                       Measure measure)
{
  std::vector<double> values;
  for (std::size_t k = 0; k + batch <= periods.size(); k += batch)
    values.push_back(measure(std::span(periods).subspan(k, batch)));
  return long_mean(values);
}

/** Where the cubic from `a` with slope `s` to `b` with slope `t`, at 0 and 1, turns between them; else `b`. Its error is
    of order 4 in the interval. */
double turning_point(double a, double s, double b, double t)
{
  if (!(s * t < 0)) return b;
  /** The slope s + 2 (3d - 2s - t) x + 3 (s + t - 2d) x², d = b - a, has one root in 0…1. */
  const double half = 3 * (b - a) - 2 * s - t, square = 3 * (s + t - 2 * (b - a));
  const double root = std::sqrt(std::max(0.0, half * half - square * s));
  const double x = -s / (half + (s > 0 ? -root : root));
  return a + x * (s + x * (half + x * square / 3));
}

double half_range(std::span<const PeriodSums> periods, std::size_t i)
{
  double low = periods.front().low[i], high = periods.front().high[i];
  for (const PeriodSums& one : periods) {
    low = std::min(low, one.low[i]);
    high = std::max(high, one.high[i]);
  }
  return 0.5 * (high - low);
}

}  // namespace

Observation observe(const Answer& answer, const OperationBudget& budget)
{
  constexpr std::size_t observed = 256, quarter = observed / 4;
  const bool is_closed = answer.period() > 0 || answer.kind() == Kind::rest;
  const std::size_t count = is_closed ? std::max(1, answer.period()) : observed;
  const double period = 2 * std::numbers::pi / answer.omega;
  const int intervals = static_cast<int>(std::clamp(
      std::ceil(period / (2 * step_at(answer.machine, answer.omega))), 192.0, 1e6));
  const auto steps =
      flow(answer.machine, answer.omega,
           {.method = "rk4", .intervals_per_period = intervals, .budget = budget});
  State state = answer.settled.at.state;
  long k = answer.settled.at.period * intervals;
  std::vector<PeriodSums> periods;
  /** Sums of differences from the first instant lose no digits to the static deflection. */
  const Displacements origin = displacements(state.position);
  const double interval = period / intervals;
  while (periods.size() < count) {
    Displacements q = displacements(state.position);
    PeriodSums& one = periods.emplace_back(PeriodSums{q, q});
    for (int j = 0; j < intervals; ++j) {
      const State before = state;
      steps->advance(k++, state);
      const Displacements from = displacements(before.position),
                          from_speed = displacements(before.velocity),
                          speed = displacements(state.velocity);
      q = displacements(state.position);
      for (std::size_t i = 0; i < 4; ++i) {
        const double turning =
            turning_point(from[i], interval * from_speed[i], q[i], interval * speed[i]);
        one.low[i] = std::min({one.low[i], q[i], turning});
        one.high[i] = std::max({one.high[i], q[i], turning});
        const double off = q[i] - origin[i];
        one.sum[i] += off / intervals;
        one.squares[i] += off * off / intervals;
      }
    }
  }
  Observation seen;
  for (std::size_t i = 0; i < 4; ++i) {
    seen.amplitude[i] = half_range(periods, i);
    const BatchMean mean =
        over_batches(periods, 1, [i](auto part) { return part[0].sum[i]; });
    const BatchMean square = over_batches(periods, 1, [&](auto part) {
      return part[0].squares[i] - 2 * mean.value * part[0].sum[i] +
             mean.value * mean.value;
    });
    seen.mean[i] = origin[i] + mean.value;
    seen.rms[i] = std::sqrt(std::max(0.0, square.value));
    if (is_closed) continue;
    seen.mean_error[i] = mean.error;
    seen.rms_error[i] = seen.rms[i] > 0 ? 0.5 * square.error / seen.rms[i] : 0;
    seen.amplitude_error[i] = over_batches(periods, quarter, [&](auto part) {
                                return half_range(part, i);
                              }).error;
  }
  return seen;
}

}  // namespace rotor_stator::motion
