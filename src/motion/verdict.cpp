#include "motion/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "balance/bearing_problem.hpp"
#include "balance/newton.hpp"
#include "integration/time_stepper.hpp"
#include "io/errors.hpp"
#include "stability/lyapunov.hpp"
#include "stability/shooting.hpp"

namespace rotor_stator::motion {

namespace {

constexpr double local_error = 1e-11, finer = 1e-13, nearly_closed = 1e-7;
constexpr int most_harmonics = 192, points = 256;  // of each turn

}  // namespace

std::string Verdict::regime(int turns) const
{
  return floquet.stable() ? Settled{.period = turns}.regime() : from_there.regime();
}

namespace {

/** The shootings behind one verdict, one after the other until one closes a motion near the solution. */
class Shootings {
public:
  Shootings(const Parameters& parameters, const PeriodicMotion& solution,
            const OperationBudget& budget)
      : parameters_(parameters), solution_(solution), start_(state_of(solution)),
        size_(
            largest_displacement(motion_of(solution.bodies, points * parameters.turns))),
        budget_(budget)
  {
  }

  /** Why no motion was found; empty when one was, whose state is then in `state`. From `starts`, from the solution,
      from the same with more harmonics; then from all of them by other steps: where the contact
      opens and closes, those of one kind are often refused. */
  std::string run(State& state, std::vector<State> starts = {})
  {
    starts.push_back(start_);
    for (const State& start : starts)
      if (closes(start, state)) return {};
    PeriodicMotion more = solution_;
    while (raise(more)) {
      starts.push_back(state_of(more));
      if (closes(starts.back(), state)) return {};
    }
    for (bool quasi_newton : {false, true})
      for (const State& start : starts)
        if (closes(start, state, 1, quasi_newton)) return {};
    return reason();
  }

  /** From where Eq. 7 settles, if that has the same period. */
  bool from(const Settled& settled, State& state)
  {
    return settled.period == parameters_.turns && closes(settled.state, state);
  }

  double evaluations() const { return evaluations_; }

private:
  std::string reason() const
  {
    return std::isfinite(nearest_)
               ? format(
                     "the T-periodic motion found from it is another one, at phase 0 "
                     "%.2g of the largest displacement away",
                     nearest_)
               : "no T-periodic motion was found from it: " + shooting_.reason;
  }

  bool closes(const State& start, State& state, double speed_weight = 5,
              bool quasi_newton = false)
  {
    state = start;
    shooting_ = shoot(parameters_, solution_.omega, state,
                      {.tolerance = local_error,
                       .periodicity_residual = 1e-9,
                       .most_maps = 60,
                       .speed_weight = speed_weight,
                       .quasi_newton = quasi_newton,
                       .final_derivative = false,
                       .budget = budget_});
    evaluations_ += static_cast<double>(shooting_.evaluations);
    /** A motion whose disturbances grow fast closes no better than its integration: the change of the multipliers
        says what that leaves open. */
    if (!(shooting_.converged || shooting_.periodicity_residual <= nearly_closed))
      return false;
    const double away =
        (vector_of(state) - vector_of(start_)).head<4>().cwiseAbs().maxCoeff() / size_;
    nearest_ = std::min(nearest_, away);
    return away <= same_motion;
  }

  /** Four times as many harmonics, or more where Newton finds none with so many; false at the end of them. */
  bool raise(PeriodicMotion& solution)
  {
    int m = solution.harmonics.highest();
    const int most = most_harmonics * parameters_.turns;
    for (int doublings = 1; m < most && !budget_.used_up(); ++doublings) {
      m = std::min(2 * m, most);
      Balance balance(
          bearing_problem(parameters_, fast_transform_size(8 * m + 1), budget_), m);
      PeriodicMotion more =
          solve(balance, solution.omega, resize_harmonics(solution.x, 2, m));
      evaluations_ += static_cast<double>(more.force_samples);
      if (!more.found()) continue;
      solution = std::move(more);
      if (doublings == 1 && m < most) continue;
      solution.bodies = body_series(parameters_, solution);
      return true;
    }
    return false;
  }

  const Parameters& parameters_;
  const PeriodicMotion& solution_;
  State start_;
  double size_;  ///< the largest displacement of the solution [m]
  const OperationBudget& budget_;
  Shooting shooting_;
  double evaluations_ = 0;
  double nearest_ =
      std::numeric_limits<double>::infinity();  ///< motion found, at phase 0
};

/** The multipliers of the motion through `state`, and their uncertainty. */
void add_multipliers(const Parameters& parameters, double omega,
                     const OperationBudget& budget, Verdict& verdict)
{
  const auto map = [&](const State& from, double error) {
    const PeriodMap period = period_map(parameters, omega, from, error, "rk8pd", budget);
    verdict.evaluations += static_cast<double>(period.evaluations);
    return period;
  };
  const PeriodMap first = map(verdict.state, local_error), next = map(first.end, finer);
  Floquet& floquet = verdict.floquet;
  floquet.multipliers = multipliers_of(next.derivative);
  floquet.change = largest_move(floquet.multipliers, multipliers_of(first.derivative));
  floquet.settled = floquet.change <= 0.1;
}

/** The same, and the distance of the solution from the motion. */
void measure(const Parameters& parameters, const PeriodicMotion& solution,
             const OperationBudget& budget, Verdict& verdict)
{
  const int instants = points * parameters.turns;
  const TimeStepper stepper = make_stepper(
      parameters, solution.omega,
      {.intervals_per_period = instants, .tolerance = local_error, .budget = budget});
  State state = verdict.state;
  const Motion exact = recorded(stepper, instants, state);
  const Motion judged = motion_of(solution.bodies, instants);
  verdict.distance = relative_difference(judged, exact);
  verdict.distance_rms = rms_difference(judged, exact);
  verdict.evaluations += static_cast<double>(stepper.evaluations());
  add_multipliers(parameters, solution.omega, budget, verdict);
}

/** All components by 1e-6 of their size. */
State disturbed(const Parameters& parameters, const State& state)
{
  return rotor_stator::state_of(vector_of(state) + 1e-6 * state_scales(parameters));
}

/** The machine's multipliers, point after point of a branch. */
struct Along {
  static constexpr double least =
      2e6;  ///< evaluations, for a motion that is easily found
  const Parameters& parameters;
  OperationBudget budget;
  double most;                                       ///< evaluations at one point
  bool decided = true;                               ///< the last point
  std::vector<std::pair<double, State>> found = {};  ///< speed [rad/s], state at phase 0

  Floquet operator()(const BranchPoint& point)
  {
    PeriodicMotion solution = point.motion;
    solution.bodies = body_series(parameters, solution);
    const double share =
        (std::exchange(decided, false) ? most : std::max(least, most / 8)) /
        budget.left();
    const OperationBudget part = budget.part(std::min(1.0, share));
    Shootings shootings(parameters, solution, part);
    Verdict verdict;
    verdict.reason = shootings.run(verdict.state, starts_near(solution.omega));
    if (!verdict.found()) throw NoSolution(verdict.reason);
    add_multipliers(parameters, solution.omega, part, verdict);
    found.emplace_back(solution.omega, verdict.state);
    decided = true;
    return verdict.floquet;
  }

  /** On the line through the two motions nearest in speed, and the nearest one, if it is within 1 % of the
      joint resonance. */
  std::vector<State> starts_near(double omega) const
  {
    auto near = found;
    const auto away = [=](const auto& motion) { return std::abs(motion.first - omega); };
    const double reach = 0.01 * joint_resonance(parameters) / parameters.turns;
    std::erase_if(near, [=](const auto& motion) { return away(motion) > reach; });
    std::ranges::sort(near, {}, away);
    std::vector<State> starts;
    if (near.size() > 1 && near[0].first != near[1].first) {
      const double r = (omega - near[0].first) / (near[1].first - near[0].first);
      starts.push_back(rotor_stator::state_of((1 - r) * vector_of(near[0].second) +
                                              r * vector_of(near[1].second)));
    }
    if (!near.empty()) starts.push_back(near[0].second);
    return starts;
  }
};

}  // namespace

BranchStability machine_stability(const Parameters& parameters, Balance& balance,
                                  const Branch& branch,
                                  const ArcLengthSettings& arc_length,
                                  const OperationBudget& budget)
{
  const double width = 0.004 * joint_resonance(parameters) / parameters.turns;
  Along multipliers{parameters, budget,
                    std::max(Along::least, 0.04 * std::min(budget.left(), 2e9))};
  return stability_along(balance, branch, arc_length, std::ref(multipliers),
                         {.chosen = evenly_chosen(branch, width, 2), .widest = width});
}

Verdict verdict_on(const Parameters& parameters, const PeriodicMotion& solution,
                   const OperationBudget& budget, int turns)
{
  const Parameters longer = over_turns(parameters, turns);
  Verdict verdict;
  if (!std::isfinite(1 / solution.omega)) {
    verdict.reason = "the period of rotation is too long to be integrated";
    return verdict;
  }
  /** The other half is for the integration from there. */
  const OperationBudget half = budget.part(0.5);
  Shootings shootings(longer, solution, half);
  const auto integrate = [&](const State& from, const State* away_from) {
    verdict.from_there = settle(parameters, turns * solution.omega,
                                disturbed(parameters, from), budget, away_from);
  };
  try {
    verdict.reason = shootings.run(verdict.state);
    if (verdict.found()) measure(longer, solution, budget, verdict);
  } catch (const NoSolution& error) {
    verdict.reason = error.what();
  }
  try {
    if (!verdict.found()) {
      integrate(state_of(solution), nullptr);
      if (shootings.from(verdict.from_there, verdict.state)) {
        verdict.reason.clear();
        measure(longer, solution, budget, verdict);
      }
    } else if (!verdict.floquet.stable()) {
      integrate(verdict.state, verdict.floquet.unstable() ? &verdict.state : nullptr);
    }
  } catch (const NoSolution& error) {
    verdict.lost = error.what();
  }
  verdict.evaluations += shootings.evaluations();
  return verdict;
}

}  // namespace rotor_stator::motion
