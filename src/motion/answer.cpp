#include "motion/answer.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "io/errors.hpp"
#include "motion/judge.hpp"
#include "time/flow.hpp"
#include "time/shooting.hpp"

namespace rotor_stator::motion {

int Answer::period_number() const
{
  constexpr int others[] = {-2, 1, 0, -1, 0};  // by kind
  return period() > 0 ? period() : others[static_cast<int>(kind())];
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

/** What integrates the transient and what is observed. */
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

/**
## A motion that closes */

/** The closed motion that the state is on; none where shooting closes none so near. */
std::optional<State> closed(const Parameters& machine, double omega, const State& state,
                            double local_error, const OperationBudget& budget)
{
  /** Of the sizes: farther away it is another one; Newton may pass a hundred times as
      far from it. Rounding, which grows within a period, may keep it from closing. */
  constexpr double near = 1e-2, rounding = 1e-7;
  for (const double wanted : {std::max(1e-9, 10 * local_error), rounding}) {
    State at = state;
    const ShootingSettings settings{.tolerance = local_error,
                                    .closed = wanted,
                                    .farthest = 100 * near,
                                    .budget = budget};
    const bool is_closed = shoot(machine, omega, at, settings).converged;
    if (is_closed && apart(machine, at, state) < near) return at;
  }
  return {};
}

/** The stability of the closed motion through `state`, and λ from its largest
    multiplier. */
void judge_closed(Answer& answer, const Parameters& machine, double omega,
                  const State& state, const OperationBudget& budget)
try {
  const Floquet floquet = multipliers_through(machine, omega, state, budget);
  answer.stability = floquet.verdict();
  answer.multiplier = floquet.largest();
  answer.uncertainty = floquet.uncertainty();
  const double period = answer.settled.period * 2 * std::numbers::pi / answer.omega;
  if (answer.multiplier > 10 * answer.uncertainty)
    answer.settled.lyapunov = {std::log(answer.multiplier) / period,
                               answer.uncertainty / answer.multiplier / period};
} catch (const NoSolution&) {
  answer.stability = "undecided";
}

/** Whether shooting closes the motion; else the integrated one is recorded. */
bool close(Answer& answer, const Request& request, const OperationBudget& budget)
{
  const int k = answer.settled.period;
  const Parameters machine = over_turns(answer.machine, k);
  const double omega = answer.omega / k;
  const auto record = [&](const State& state, double local_error) {
    return one_period(machine, omega, state,
                      {.intervals_per_period = k * request.points,
                       .tolerance = local_error,
                       .budget = budget});
  };
  const double local_error = request.local_error, finer_error = 0.01 * local_error;
  const auto state = closed(machine, omega, answer.settled.at.state, local_error, budget);
  if (!state) return false;
  const auto finer =
      request.is_measured ? closed(machine, omega, *state, finer_error, budget) : state;
  if (!finer) return false;
  answer.settled.at = {*state, 0};
  answer.motion = record(*state, local_error);
  answer.method = "shooting";
  answer.error_note =
      format("shooting over %d base periods from where integration settles", k);
  if (request.is_measured) {
    answer.error = difference(answer.motion, record(*finer, finer_error));
    judge_closed(answer, machine, omega, *finer, budget);
  }
  answer.motion.points_per_period = request.points;
  answer.motion.omega = answer.omega;
  return true;
}

/**
## A motion that is recorded */

/** Whether the budget is enough for a record of so many base periods from the earlier
    state, and for another one with half the step. */
bool can_begin_earlier(const Answer& answer, long periods, const OperationBudget& budget)
{
  constexpr double times = 3, motions = 2;
  const Settled& settled = answer.settled;
  const long all = settled.at.period - settled.before.period + periods;
  const double share = angular(static_cast<double>(all)) / answer.omega / settled.seconds;
  return times * share * settled.evaluations / motions < budget.left();
}

/** So many base periods, from an earlier instant. `finer`: by so much smaller steps, or a
    local error smaller by its square. */
Motion recorded_from(const Instant& from, const Answer& answer, const Request& request,
                     long periods, double finer, const OperationBudget& budget)
{
  double step = step_of(request, answer);
  /** Not longer than an interval, else half of it would change nothing. */
  if (const auto method = recording_method(request, answer); method == "splitting")
    step = std::min(step, 2 * std::numbers::pi / answer.omega / request.points /
                              steps_of_rk4(method));
  const auto stepper = [&](int intervals) {
    return flow(answer.machine, answer.omega,
                {.method = request.method,
                 .intervals_per_period = intervals,
                 .step = step / finer,
                 .tolerance = request.local_error / (finer * finer),
                 .budget = budget});
  };
  const auto whole = stepper(1), parts = stepper(request.points);
  const long first = answer.settled.at.period;
  State state = from.state;
  for (long k = from.period; k < first; ++k) whole->advance(k, state);
  Motion motion = recorded(*parts, request.points, state, first, periods);
  motion.omega = answer.omega;
  return motion;
}

void record(Answer& answer, const Request& request, const OperationBudget& budget)
{
  constexpr double finest = 64;
  const Settled& settled = answer.settled;
  const auto is_rough = [](const Bearing& one) {
    return one.exponent < 1.5 || !one.is_damaged(Defect::Surface::none) ||
           one.parallel.stop_stiffness > 0;
  };
  const bool is_smooth = std::ranges::none_of(joints_of(answer.machine), is_rough);
  std::optional<Error> before;
  const long periods = std::max(request.periods, settled.period);
  const bool begins_earlier =
      settled.contracts && can_begin_earlier(answer, periods, budget);
  const Instant& from = begins_earlier ? settled.before : settled.at;
  answer.motion = recorded_from(from, answer, request, periods, 1, budget);
  answer.method = recording_method(request, answer);
  answer.error_note = "integration";
  if (settled.contracts) answer.stability = "stable";
  if (!request.is_measured || !begins_earlier) return;
  for (double finer = 2; finer <= finest; finer *= 2) {
    Motion next = recorded_from(from, answer, request, periods, finer, budget);
    const Error off = difference(as_one_period(answer.motion), as_one_period(next));
    const Error last = is_smooth ? off : before.value_or(off);
    answer.error = {std::max(off.largest, last.largest) + settled.remainder,
                    std::max(off.rms, last.rms) + settled.remainder};
    answer.motion = std::move(next);
    answer.error_note =
        format("integration, with half the step for the error; step over %g", finer);
    const bool is_known = is_smooth || before;
    before = off;
    if (is_known && (!request.tolerance || answer.error->larger() <= *request.tolerance))
      return;
  }
}

/** A machine that does not move. */
void rest(Answer& answer, const Request& request)
{
  answer.motion = {request.points, 0, {}, {}, answer.omega};
  for (int k = 0; k < request.periods * request.points; ++k)
    add(answer.motion, answer.settled.at.state);
  answer.error = Error{};
  if (answer.settled.contracts) answer.stability = "stable";
  answer.method = recording_method(request, answer);
  answer.error_note = "static equilibrium";
}

std::unique_ptr<Settling> settling(const Question& question, const Answer& at)
{
  const Request& request = question.request;
  Instant first = from_rest(at.machine, at.omega);
  if (question.start) first.state = *question.start;
  return std::make_unique<Settling>(at.machine, at.omega, at.base, first,
                                    SettleRule{.method = settling_method(request),
                                               .step = step_of(request, at),
                                               .is_fixed = request.step > 0,
                                               .longest = request.longest},
                                    question.transient_share < 1
                                        ? question.budget.part(question.transient_share)
                                        : question.budget);
}

}  // namespace

std::vector<Attempt<Answer>> settled_answers(std::span<const Question> questions)
{
  std::vector<Attempt<Answer>> answers;
  std::vector<Attempt<std::unique_ptr<Settling>>> settlings;
  for (const Question& question : questions) {
    answers.push_back(attempt([&] {
      Answer answer{.base = base_period(question.parameters), .settled = {}};
      Based based = over(answer.base, question.parameters, question.request.omega);
      answer.machine = std::move(based.machine);
      answer.omega = based.omega;
      return answer;
    }));
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
  const auto low = [i](const PeriodSums& one) { return one.low[i]; };
  const auto high = [i](const PeriodSums& one) { return one.high[i]; };
  return 0.5 * (high(*std::ranges::max_element(periods, {}, high)) -
                low(*std::ranges::min_element(periods, {}, low)));
}

/** One motion while it is observed. */
class Observing : public Traveller {
public:
  Observing(const Answer& answer, const char* method, double step,
            const OperationBudget& budget)
      : is_closed_(answer.period() > 0 || answer.kind() == Kind::rest),
        may_close_(!is_closed_ && !answer.base.is_driven_twice()),
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
    section_.push_back(first);
    for (const State& to : path_) {
      const Displacements a = displacements(from.position),
                          a_slope = displacements(interval * from.velocity),
                          b = displacements(to.position),
                          b_slope = displacements(interval * to.velocity);
      for (std::size_t i = 0; i < 4; ++i) {
        const double turning = turning_point(a[i], a_slope[i], b[i], b_slope[i]);
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
      /** The extremes of all scatter as those of a part do, and not less as means do. */
      seen.amplitude_error[i] =
          std::sqrt(parts) * over_batches(periods_, observed / parts, [&](auto part) {
                               return half_range(part, i);
                             }).error;
    }
    if (may_close_ && closes()) seen.closed = state_;
    return seen;
  }

private:
  static constexpr std::size_t observed = 256, parts = 8;

  /** Whether the last base periods are about to repeat themselves. */
  bool closes() const
  {
    constexpr double nearly = 1e-3;  // over the vibration
    const auto last = std::span(periods_).last(most_period);
    double size = 0;
    for (std::size_t i = 0; i < 4; ++i) size = std::max(size, half_range(last, i));
    return closing_period(section_, nearly * size) > 0;
  }

  bool is_closed_, may_close_;
  std::size_t count_;  ///< base periods
  double period_;
  int intervals_;
  std::unique_ptr<Flow> flow_;
  State state_, before_;
  Displacements origin_;  ///< sums of differences from it lose no digits
  long at_;
  std::vector<State> path_ = {};
  std::vector<PeriodSums> periods_ = {};
  std::vector<Displacements> section_ = {};
  std::exception_ptr lost_ = nullptr;
};

}  // namespace

static std::vector<Observed> observed_once(std::span<const Question> questions)
{
  std::vector<Attempt<Answer>> answers = settled_answers(questions);
  std::vector<Attempt<std::unique_ptr<Observing>>> observings;
  for (std::size_t k = 0; k < questions.size(); ++k)
    observings.push_back(attempt([&]() -> std::unique_ptr<Observing> {
      const Answer& at = answers[k].get();
      const auto& [parameters, request, budget, start, share, is_observed] = questions[k];
      if (!is_observed && at.kind() != Kind::chaotic) return nullptr;
      return std::make_unique<Observing>(at, settling_method(request),
                                         step_of(request, at),
                                         is_observed ? budget : budget.part(0.3));
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

std::vector<Observed> observed_answers(std::span<const Question> questions)
{
  std::vector<Observed> all = observed_once(questions);
  for (std::size_t k = 0; k < questions.size(); ++k) {
    if (!all[k].seen.has_value() || !all[k].seen.get().closed) continue;
    Question again = questions[k];
    again.start = all[k].seen.get().closed;
    all[k] = std::move(observed_once({&again, 1}).front());
  }
  return all;
}

/** Whether only the steps keep up the motion: a closed one that Eq. 7 leaves, or one
    whose neighbours meet, but not where it is recorded with half the step. */
static bool is_kept_up(const Answer& found)
{
  constexpr double apart = 0.05;
  return found.stability == "unstable" ||
         (found.settled.contracts && found.error && found.error->larger() > apart);
}

Answer answer(const Parameters& parameters, const Request& request,
              const OperationBudget& budget)
{
  constexpr int most_times = 3;
  constexpr double beside = 1e-3, shorter = 4;
  Question question{.parameters = parameters,
                    .request = request,
                    .budget = budget,
                    .transient_share = parameters.bodies->patience().transient_share,
                    .is_observed = false};
  for (int times = 1;; ++times) {
    Observed observed = std::move(observed_answers({&question, 1}).front());
    Answer found = std::move(observed.answer.get());
    if (found.kind() == Kind::chaotic && observed.seen.has_value())
      found.seen = observed.seen.get();
    const bool is_last = request.step > 0 || times == most_times;
    try {
      complete(found, question.request, budget);
    } catch (const NoSolution&) {
      if (is_last || !is_kept_up(found)) throw;
    }
    if (is_last || !is_kept_up(found)) return found;
    /** From beside it by shorter ones. */
    question.start = rotor_stator::state_of(vector_of(found.settled.at.state) +
                                            beside * state_scales(found.machine));
    question.request.step_ratio =
        found.settled.step / shorter / step_at(found.machine, found.omega);
  }
}

}  // namespace rotor_stator::motion
