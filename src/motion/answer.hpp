/**
# The motion after a start from rest

Eq. 7 is integrated from rest until it has settled (`settle`). What follows depends on
its kind:

- `rest`: the static equilibrium, error 0.
- `periodic`: shooting closes the motion over its K base periods, within 1e-2 of the sizes
  of where integration ended, and gives its multipliers. The error is the change when the
  local error is a hundredth. If shooting fails, or a stepper is asked for, the motion is
  recorded.
- Every other motion is recorded, as that of most real bearings, which two frequencies
  drive. If neighbours converge, it is stable and recorded twice from `settled.before`,
  the second time with half the step or a fourth of the local error. The second record is
  `motion`; its difference from the first plus the rest of the transient is the error.
  With a tolerance the step is halved at most six times. A force less smooth than Hertz's
  needs one halving more, and the larger of the last two differences counts. If the budget
  is too small, there is no error.
- If neighbours do not converge, the record depends on rounding: no error, `undecided`.
  Chaos may be a transient: if the motion closes while it is observed, it is settled anew
  from there.

    const Answer answer = motion::answer(parameters, {.omega = angular(25)}, budget);
    // answer.kind, answer.motion, answer.stability, answer.error

Solutions of harmonic balance have a number of harmonics instead; see motion/judge.hpp. */
#pragma once

#include <optional>
#include <span>
#include <string>

#include "io/errors.hpp"
#include "motion/motion.hpp"
#include "time/settle.hpp"

namespace rotor_stator::motion {

struct Request {
  double omega;                 ///< speed of the rotor [rad/s]
  std::string method = "auto";  ///< or what records, without shooting; rk4 also settles
  std::optional<double> tolerance = {};  ///< of the error, largest and rms [-]
  int points = 256;                      ///< P, of a base period
  int periods = 1;             ///< recorded where shooting closes nothing, at least K
  double step = 0;             ///< longest of rk4 [s]; 0: `step_at`
  double step_ratio = 1;       ///< then: so many times as long
  double local_error = 1e-11;  ///< of shooting and of steppers with error control
  double longest = 0;          ///< `SettleRule::longest` [s]
  bool is_measured = true;     ///< whether error and stability are wanted
};

/** What tables report of x_s, y_s, x_r, y_r [m]: of a periodic motion over its K base
    periods, of every other one over 256, with standard errors. */
struct Observation {
  Displacements amplitude{};    ///< half of the largest less the smallest value
  Displacements mean{}, rms{};  ///< rms about the mean
  Displacements amplitude_error{}, mean_error{}, rms_error{};
  std::optional<State> closed = {};  ///< at the end of another one that closes by then
};

struct Answer {
  BasePeriod base;
  Parameters machine = {};  ///< its angles counted per base period, `over`
  double omega = 0;         ///< base frequency [rad/s]
  Settled settled;     ///< kind, K, λ, state; after shooting those of the closed one
  Motion motion = {};  ///< from base period `motion.first_period`, mostly 0
  std::optional<Error> error = {};
  std::string stability = "undecided";
  double multiplier = 0, uncertainty = 0;  ///< largest modulus of a closed one; else 0
  std::string method = {};                 ///< shooting, or what recorded the motion
  std::string error_note = {};             ///< what the error is measured by
  std::optional<Observation> seen = {};    ///< of a chaotic one that `answer` gives

  Kind kind() const { return settled.kind; }
  int period() const { return settled.period; }

  /** K as the tables print it: 0 chaotic, -1 quasi-periodic, -2 undecided; 1 at rest. */
  int period_number() const;
};

/** Throws NoSolution when the integration breaks down, when the error stays above the
    tolerance or is unknown though neighbours converge, and when the budget ends in the
    record. The transient has 70 % of the budget (40 % of large bodies); where that ends
    first, the kind is undecided, with the reason in `settled`. Where the motion that
    closes has a multiplier above 1, or neighbours meet on a motion whose error is above
    0.05, the steps have kept it up: the question is asked again from beside it with steps
    a quarter as long, twice at most. */
Answer answer(const Parameters& parameters, const Request& request,
              const OperationBudget& budget = {});

/** One of several questions that are asked together. */
struct Question {
  const Parameters& parameters;
  Request request;
  OperationBudget budget = {};
  std::optional<State> start = {};  ///< in the place of rest, at the same time
  double transient_share = 1;       ///< of the budget, until it has settled
  bool is_observed = true;          ///< with an `Observation`, else of chaos alone
};

/** The two halves of an answer: what the machine settles on, of all questions side by
    side; and that motion itself, with error and stability. */
std::vector<Attempt<Answer>> settled_answers(std::span<const Question> questions);
Answer settled_answer(const Question& question);
void complete(Answer& answer, const Request& request, const OperationBudget& budget = {});

/** What all questions settle on, and what is reported of it, side by side. A motion that
    closes while it is observed is settled anew from there, once. Where chaos alone is
    observed, that takes at most 30 % of the budget. */
struct Observed {
  Attempt<Answer> answer;
  Attempt<Observation> seen;
};
std::vector<Observed> observed_answers(std::span<const Question> questions);

}  // namespace rotor_stator::motion
