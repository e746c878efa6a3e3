#include "motion/answer.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <span>

#include "io/errors.hpp"
#include "motion/judge.hpp"
#include "time/flow.hpp"
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

/** The longest step of rk4 [s]; after the transient no longer than those with which that
    ended well. */
double step_of(const Request& request, const Answer& answer)
{
  const double step = request.step > 0
                          ? request.step
                          : request.step_ratio * step_at(answer.machine, answer.omega);
  return answer.settled.step > 0 ? std::min(step, answer.settled.step) : step;
}

/** What integrates the transient and what is observed: RK4 where it is asked for, else
    the machine's own method. */
const char* settling_method(const Request& request)
{
  return request.method == "rk4" ? "rk4" : "auto";
}

/** What records the motion, by its name. */
std::string recording_method(const Request& request, const Answer& answer)
{
  return request.method == "auto" ? answer.machine.bodies->time_method(answer.machine)
                                  : request.method;
}

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
    /** Of the sizes: farther away it is another one; Newton may pass a hundred times as
        far from it. */
    constexpr double near = 1e-2;
    State closed = state;
    const Shooting shooting = shoot(machine_, omega_, closed,
                                    {.tolerance = local_error,
                                     .closed = std::max(1e-9, 10 * local_error),
                                     .farthest = 100 * near,
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

  Floquet multipliers(const State& state) const
  {
    return multipliers_through(machine_, omega_, state, budget_);
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

/** False where shooting does not close the motion: the integrated one is then
    recorded. */
bool close(Answer& answer, const Request& request, const OperationBudget& budget)
{
  const int k = answer.settled.period, points = k * request.points;
  const Closing closing(answer, request, budget);
  const double finer_error = 0.01 * request.local_error;
  State state = answer.settled.at.state;
  if (!closing.close(state, request.local_error)) return false;
  State finer = state;
  if (request.is_measured && !closing.close(finer, finer_error)) return false;
  answer.settled.at = {state, 0};
  answer.motion = closing.record(state, request.local_error, points);
  answer.method = "shooting";
  answer.error_note =
      format("shooting over %d base periods from where integration settles", k);
  if (request.is_measured) {
    answer.error = difference(answer.motion, closing.record(finer, finer_error, points));
    try {
      const Floquet floquet = closing.multipliers(state);
      answer.stability = floquet.verdict();
      answer.multiplier = floquet.largest();
      answer.uncertainty = floquet.uncertainty();
      if (answer.multiplier > 10 * answer.uncertainty)
        answer.settled.lyapunov =
            exponent_of(floquet, k * 2 * std::numbers::pi / answer.omega);
    } catch (const NoSolution&) {
      answer.stability = "undecided";
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
      : answer_(answer), request_(request), periods_(periods), budget_(budget),
        begins_earlier_(answer.settled.contracts && can_begin_earlier())
  {
  }

  /** Whether a motion whose neighbours contract is that of the steps of the record. */
  bool begins_earlier() const { return begins_earlier_; }

  /** From the same earlier state, if it can be. `finer`: by so much smaller steps, or a
      local error smaller by its square. */
  Motion operator()(double finer)
  {
    const auto stepper = [&](int intervals) {
      double step = step_of(request_, answer_);
      /** Not longer than an interval, else half of it would change nothing. */
      const std::string method = recording_method(request_, answer_);
      if (method == "splitting")
        step = std::min(step, 2 * std::numbers::pi / answer_.omega / request_.points /
                                  steps_of_rk4(method));
      return flow(answer_.machine, answer_.omega,
                  {.method = request_.method,
                   .intervals_per_period = intervals,
                   .step = step / finer,
                   .tolerance = request_.local_error / (finer * finer),
                   .budget = budget_});
    };
    const Settled& settled = answer_.settled;
    const Instant& from = begins_earlier_ ? settled.before : settled.at;
    State state = from.state;
    const auto whole = stepper(1), parts = stepper(request_.points);
    for (long k = from.period; k < settled.at.period; ++k) whole->advance(k, state);
    Motion motion = recorded(*parts, request_.points, state, settled.at.period, periods_);
    motion.omega = answer_.omega;
    return motion;
  }

private:
  /** Whether the budget is enough for it, and for half the step. */
  bool can_begin_earlier() const
  {
    constexpr double times = 3, motions = 2;
    const Settled& settled = answer_.settled;
    const double periods =
        static_cast<double>(settled.at.period - settled.before.period + periods_);
    const double share = periods * 2 * std::numbers::pi / answer_.omega / settled.seconds;
    return times * share * settled.evaluations / motions < budget_.left();
  }

  const Answer& answer_;
  const Request& request_;
  long periods_;
  OperationBudget budget_;
  bool begins_earlier_;
};

void record(Answer& answer, const Request& request, const OperationBudget& budget)
{
  constexpr int most_halvings = 6;
  const Settled& settled = answer.settled;
  Recording recording(answer, request, std::max(request.periods, settled.period), budget);
  answer.motion = recording(1);
  answer.method = recording_method(request, answer);
  answer.error_note = "integration";
  if (settled.contracts) answer.stability = "stable";
  if (request.is_measured && recording.begins_earlier()) {
    double finer = 1;
    for (int halvings = 0; halvings < most_halvings; ++halvings) {
      Motion next = recording(finer *= 2);
      answer.error = difference(as_one_period(answer.motion), as_one_period(next));
      answer.error->largest += settled.remainder;
      answer.error->rms += settled.remainder;
      answer.motion = std::move(next);
      if (!request.tolerance || answer.error->larger() <= *request.tolerance) break;
    }
    answer.error_note =
        format("integration, with half the step for the error; step over %g", finer);
  }
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
  answer.method = recording_method(request, answer);
  answer.error_note = "static equilibrium";
}

}  // namespace

/** Nothing but the machine that counts its base periods. */
static Answer begun(const Question& question)
{
  Answer answer{.base = base_period(question.parameters), .settled = {}};
  Based based = over(answer.base, question.parameters, question.request.omega);
  answer.machine = std::move(based.machine);
  answer.omega = based.omega;
  return answer;
}

static std::unique_ptr<Settling> settling(const Question& question, const Answer& at)
{
  Instant first = from_rest(at.machine, at.omega);
  if (question.start) first.state = *question.start;
  return std::make_unique<Settling>(
      at.machine, at.omega, at.base, first,
      SettleRule{.method = settling_method(question.request),
                 .step = step_of(question.request, at),
                 .is_fixed = question.request.step > 0,
                 .longest = question.request.longest},
      question.transient_share < 1 ? question.budget.part(question.transient_share)
                                   : question.budget);
}

std::vector<Attempt<Answer>> settled_answers(std::span<const Question> questions)
{
  std::vector<Attempt<Answer>> answers;
  std::vector<Attempt<std::unique_ptr<Settling>>> settlings;
  for (const Question& question : questions) {
    answers.push_back(attempt([&] { return begun(question); }));
    settlings.push_back(
        attempt([&] { return settling(question, answers.back().get()); }));
  }
  travel(settlings);
  for (std::size_t k = 0; k < questions.size(); ++k)
    answers[k] = attempt([&] {
      Answer answer = std::move(answers[k].get());
      answer.settled = settlings[k].get()->settled();
      return answer;
    });
  return answers;
}

Answer settled_answer(const Question& question)
{
  return std::move(settled_answers({&question, 1}).front().get());
}

void complete(Answer& answer, const Request& request, const OperationBudget& budget)
{
  if (answer.kind() == Kind::rest) return rest(answer, request);
  const bool is_closed = answer.kind() == Kind::periodic && request.method == "auto" &&
                         close(answer, request, budget);
  if (!is_closed) record(answer, request, budget);
  if (request.tolerance && request.is_measured && answer.settled.contracts &&
      !answer.error)
    throw NoSolution(answer.machine.file +
                     ": the budget leaves no error; more with --budget");
  if (request.tolerance && answer.error &&
      !(answer.error->larger() <= *request.tolerance))
    throw NoSolution(format("%s: tolerance %g not reached at %g Hz, error %.2g",
                            answer.machine.file.c_str(), *request.tolerance,
                            request.omega / angular(1), answer.error->larger()));
}

Answer answer(const Parameters& parameters, const Request& request,
              const OperationBudget& budget)
{
  const Question question{
      .parameters = parameters,
      .request = request,
      .budget = budget,
      .transient_share = parameters.bodies->patience().transient_share};
  Answer found = settled_answer(question);
  complete(found, request, budget);
  return found;
}

namespace {

/** Sums over the instants of one base period. */
struct PeriodSums {
  Displacements low, high;
  std::array<double, 4> sum{}, squares{};
};

/** The mean over neighbouring batches of `batch` periods of a measure of each, and its
    standard error. */
template <class Measure>
BatchMean over_batches(const std::vector<PeriodSums>& periods, std::size_t batch,
                       Measure measure)
{
  std::vector<double> values;
  for (std::size_t k = 0; k + batch <= periods.size(); k += batch)
    values.push_back(measure(std::span(periods).subspan(k, batch)));
  return long_mean(values);
}

/** Where the cubic from `a` with slope `s` to `b` with slope `t`, at 0 and 1, turns
    between them; else `b`. Its error is of order 4 in the interval. */
double turning_point(double a, double s, double b, double t)
{
  if (!(s * t < 0)) return b;
  /** The slope s + 2 (3d - 2s - t) x + 3 (s + t - 2d) x², d = b - a, has one root in
      0…1. */
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

/** One motion while it is observed. */
class Observing : public Traveller {
public:
  Observing(const Answer& answer, const char* method, double step,
            const OperationBudget& budget)
      : is_closed_(answer.period() > 0 || answer.kind() == Kind::rest),
        count_(is_closed_ ? std::max(1, answer.period()) : observed),
        period_(2 * std::numbers::pi / answer.omega),
        intervals_(static_cast<int>(
            std::clamp(std::ceil(period_ / ((is_closed_ ? 2 : 4) * step)), 64.0, 1e6))),
        flow_(flow(answer.machine, answer.omega,
                   {.method = method,
                    .intervals_per_period = intervals_,
                    .step = step,
                    .budget = budget})),
        state_(answer.settled.at.state), before_(state_),
        origin_(displacements(state_.position)), at_(answer.settled.at.period)
  {
  }

  void next(std::vector<Passage>& all) override
  {
    if (lost_ || periods_.size() == count_) return;
    before_ = state_;
    path_.clear();
    all.push_back({flow_.get(), at_ * intervals_, &state_, intervals_, &path_});
  }

  void arrived() override
  {
    const double interval = period_ / intervals_;
    State from = before_;
    const Displacements first = displacements(from.position);
    PeriodSums& one = periods_.emplace_back(PeriodSums{first, first});
    for (const State& to : path_) {
      const Displacements a = displacements(from.position),
                          a_speed = displacements(from.velocity),
                          b = displacements(to.position),
                          b_speed = displacements(to.velocity);
      for (std::size_t i = 0; i < 4; ++i) {
        const double turning =
            turning_point(a[i], interval * a_speed[i], b[i], interval * b_speed[i]);
        one.low[i] = std::min({one.low[i], b[i], turning});
        one.high[i] = std::max({one.high[i], b[i], turning});
        const double off = b[i] - origin_[i];
        one.sum[i] += off / intervals_;
        one.squares[i] += off * off / intervals_;
      }
      from = to;
    }
    ++at_;
  }

  void lost(std::exception_ptr why) override { lost_ = why; }

  Observation seen() const
  {
    if (lost_) std::rethrow_exception(lost_);
    Observation seen;
    for (std::size_t i = 0; i < 4; ++i) {
      seen.amplitude[i] = half_range(periods_, i);
      const BatchMean mean =
          over_batches(periods_, 1, [i](auto part) { return part[0].sum[i]; });
      const BatchMean square = over_batches(periods_, 1, [&](auto part) {
        return part[0].squares[i] - 2 * mean.value * part[0].sum[i] +
               mean.value * mean.value;
      });
      seen.mean[i] = origin_[i] + mean.value;
      seen.rms[i] = std::sqrt(std::max(0.0, square.value));
      if (is_closed_) continue;
      seen.mean_error[i] = mean.error;
      seen.rms_error[i] = seen.rms[i] > 0 ? 0.5 * square.error / seen.rms[i] : 0;
      seen.amplitude_error[i] = over_batches(periods_, quarter, [&](auto part) {
                                  return half_range(part, i);
                                }).error;
    }
    return seen;
  }

private:
  static constexpr std::size_t observed = 256, quarter = observed / 4;

  bool is_closed_;
  std::size_t count_;  ///< base periods
  double period_;
  int intervals_;
  std::unique_ptr<Flow> flow_;
  State state_, before_;
  /** Sums of differences from the first instant lose no digits to the static
      deflection. */
  Displacements origin_;
  long at_;
  std::vector<State> path_ = {};
  std::vector<PeriodSums> periods_ = {};
  std::exception_ptr lost_ = nullptr;
};

}  // namespace

std::vector<Observed> observed_answers(std::span<const Question> questions)
{
  std::vector<Attempt<Answer>> answers = settled_answers(questions);
  std::vector<Attempt<std::unique_ptr<Observing>>> observings;
  for (std::size_t k = 0; k < questions.size(); ++k)
    observings.push_back(attempt([&]() -> std::unique_ptr<Observing> {
      const Answer& at = answers[k].get();
      if (!questions[k].is_observed) return nullptr;
      const Request& request = questions[k].request;
      return std::make_unique<Observing>(at, settling_method(request),
                                         step_of(request, at), questions[k].budget);
    }));
  travel(observings);
  std::vector<Observed> all;
  for (std::size_t k = 0; k < questions.size(); ++k)
    all.push_back({std::move(answers[k]), attempt([&] {
                     const auto& one = observings[k].get();
                     return one ? one->seen() : Observation{};
                   })});
  return all;
}

Observation observe(const Answer& answer, const OperationBudget& budget)
{
  Observing one(answer, "auto", step_of({}, answer), budget);
  travel(std::vector<Traveller*>{&one});
  return one.seen();
}

}  // namespace rotor_stator::motion
