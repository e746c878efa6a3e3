#include "motion/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <limits>
#include <utility>
#include <vector>

#include "balance/bearing_problem.hpp"
#include "balance/newton.hpp"
#include "integration/time_stepper.hpp"
#include "io/errors.hpp"
#include "model/large_machine.hpp"
#include "stability/lyapunov.hpp"
#include "stability/shooting.hpp"

namespace rotor_stator::motion {

namespace {

constexpr double local_error = 1e-11, finer = 1e-13, nearly_closed = 1e-8;
/** Far from a motion a cheap integration shows Newton the way as well. */
constexpr double rough_error = 1e-6, roughly_closed = 1e-5, nearly_roughly_closed = 1e-3;
/** A motion so near is the solution's own [of the largest displacement]; of two, one `as_near` times as far is not. */
constexpr double surely_its_own = 5e-4, as_near = 2;
constexpr int most_harmonics = 192, points = 256;  // of each turn

}  // namespace

namespace {

/** The shootings behind one verdict, one after the other until one closes a motion near the solution. */
class Shootings {
public:
  Shootings(const Parameters& parameters, const PeriodicMotion& solution,
            OperationBudget budget)
      : parameters_(parameters), solution_(solution),
        start_(state_of(parameters, solution)),
        size_(
            largest_displacement(motion_of(solution.bodies, points * parameters.turns))),
        budget_(std::move(budget))
  {
  }

  /** Whether a motion was found, whose state is then in `state`. From `starts`, from the solution, from the same with
      more harmonics; then from all of them by other steps: where the contact opens and closes, those of one
      kind are often refused. */
  bool run(State& state, std::vector<State> starts = {})
  {
    starts.push_back(start_);
    if (closes_any(starts, state, {5, 20, 1})) return true;
    std::vector<State> raised;
    for (PeriodicMotion more = solution_; raise(more);) {
      raised.push_back(state_of(parameters_, more));
      if (closes(raised.back(), state, 5)) return true;
    }
    if (closes_any(raised, state, {20, 1})) return true;
    starts.insert(starts.end(), raised.begin(), raised.end());
    for (const State& start : starts)
      if (closes(start, state, 1, true)) return true;
    return false;
  }

  /** From the solution with more harmonics alone. */
  bool from_more_harmonics(State& state)
  {
    PeriodicMotion more = solution_;
    if (!raise(more)) return false;
    const State start = state_of(parameters_, more);
    return closes_any({start}, state, {5, 20, 1}) || closes(start, state, 1, true);
  }

  /** From where Eq. 7 settles. */
  bool from(const Settled& settled, const OperationBudget& budget, State& state)
  {
    budget_ = budget;
    return closes(settled.state, state, 5);
  }

  double evaluations() const { return evaluations_; }

  /** Whether the first iteration, from the solution itself, closed the motion: then no other is as near to it. */
  bool found_at_once() const { return iterations_ == 1 && shooting_.converged; }

  /** Throws where the motion is farther away over the period than the estimated error allows. */
  void must_be_near(const Verdict& motion) const
  {
    const auto& error = solution_.error;
    if (!error || !error->settled) return;
    if (motion.distance > allowed(error->displacement))
      throw NoSolution(too_far(motion.distance, "of the largest displacement"));
    if (motion.distance_rms > allowed(error->rms))
      throw NoSolution(too_far(motion.distance_rms, "rms about the mean"));
  }

  /** Distance of the nearest motion closed, at phase 0; 0 without one. */
  double nearest() const { return std::isfinite(nearest_) ? nearest_ : 0; }

  /** Why no motion was found. */
  std::string reason() const
  {
    return nearest() > 0
               ? too_far(nearest_, "of the largest displacement at phase 0")
               : "no motion of its period was found from it: " + shooting_.reason;
  }

private:
  static std::string too_far(double away, const char* measure)
  {
    return format(
        "the motion of its period found from it is too far away to be its own, "
        "%.2g %s",
        away, measure);
  }

  /** Three times the estimated error: a motion farther away is another one, or the estimate is wrong. */
  static double allowed(double error) { return std::max(3 * error, 1e-3); }

  bool closes_any(const std::vector<State>& starts, State& state,
                  std::initializer_list<double> speed_weights)
  {
    for (double speed_weight : speed_weights)
      for (const State& start : starts)
        if (closes(start, state, speed_weight)) return true;
    return false;
  }

  bool closes(const State& start, State& state, double speed_weight,
              bool quasi_newton = false)
  {
    state = start;
    ++iterations_;
    ShootingSettings settings{.tolerance = rough_error,
                              .periodicity_residual = roughly_closed,
                              .most_maps = 60,
                              .speed_weight = speed_weight,
                              .quasi_newton = quasi_newton,
                              .final_derivative = false,
                              .budget = budget_};
    if (!shoot_from(state, settings) &&
        shooting_.periodicity_residual > nearly_roughly_closed)
      return false;
    settings.tolerance = local_error;
    settings.periodicity_residual = 1e-9;
    shoot_from(state, settings);
    /** A motion whose disturbances grow fast closes no better than its integration: the change of the multipliers
        says what that leaves open. */
    if (!(shooting_.converged || shooting_.periodicity_residual <= nearly_closed))
      return false;
    const double away =
        (vector_of(state) - vector_of(start_)).head<4>().cwiseAbs().maxCoeff() / size_;
    nearest_ = std::min(nearest_, away);
    return away <= reach();
  }

  bool shoot_from(State& state, const ShootingSettings& settings)
  {
    shooting_ = shoot(parameters_, solution_.omega, state, settings);
    evaluations_ += static_cast<double>(shooting_.evaluations);
    return shooting_.converged;
  }

  double reach() const
  {
    const auto& error = solution_.error;
    if (!error || !error->settled) return same_motion;
    return std::min(allowed(error->larger()), same_motion);
  }

  /** Four times as many harmonics where Newton finds a solution with them, else as many as it finds one with; false
      at the end of them. */
  bool raise(PeriodicMotion& solution)
  {
    bool raised = false;
    int m = solution.harmonics.count();
    const int most = most_harmonics * parameters_.turns;
    for (int doublings = 1; m < most && !budget_.used_up(); ++doublings) {
      m = std::min(2 * m, most);
      Balance balance(
          bearing_problem(parameters_, fast_transform_size(8 * m + 1), budget_), m);
      PeriodicMotion more =
          solve(balance, solution.omega,
                resize_harmonics(solution.x, balance.problem().dofs, m));
      evaluations_ += static_cast<double>(more.force_samples);
      if (!more.found()) continue;
      raised = true;
      solution = std::move(more);
      if (doublings > 1) break;
    }
    if (raised) solution.bodies = body_series(parameters_, solution);
    return raised;
  }

  const Parameters& parameters_;
  const PeriodicMotion& solution_;
  State start_;
  double size_;  ///< the largest displacement of the solution [m]
  OperationBudget budget_;
  Shooting shooting_;
  int iterations_ = 0;
  double evaluations_ = 0;
  double nearest_ =
      std::numeric_limits<double>::infinity();  ///< motion found, at phase 0
};

/** The multipliers of the motion through `state`, and their uncertainty. */
void add_multipliers(const Parameters& parameters, double omega,
                     const OperationBudget& budget, Verdict& verdict)
{
  const auto [first, next] =
      period_map_twice(parameters, omega, verdict.state, local_error, finer, budget);
  verdict.evaluations += static_cast<double>(first.evaluations + next.evaluations);
  Floquet& floquet = verdict.floquet;
  floquet.multipliers = multipliers_of(next.derivative);
  floquet.change = largest_move(floquet.multipliers, multipliers_of(first.derivative));
  /** Receptances that are wrong by ε move no exponent by more than ε times the contact's frequency. */
  if (parameters.large)
    floquet.change += parameters.large->reduction_error * contact_frequency(parameters) *
                      angular(1) / omega;
  floquet.settled = floquet.change <= 0.1;
}

/** The distance of the solution from the motion. */
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
}

/** All components by 1e-6 of their size. */
State disturbed(const Parameters& parameters, const State& state)
{
  return rotor_stator::state_of(vector_of(state) + 1e-6 * state_scales(parameters));
}

/** Of the motions within reach the nearest one; `reason` if there is none. */
Verdict own_motion(const std::vector<Verdict>& motions, const std::string& reason)
{
  if (motions.empty()) return {.reason = reason};
  Verdict own = *std::ranges::min_element(motions, {}, &Verdict::distance_rms);
  for (const Verdict& other : motions) {
    const bool opposite = (own.floquet.stable() && other.floquet.unstable()) ||
                          (own.floquet.unstable() && other.floquet.stable());
    if (opposite && other.distance_rms < as_near * own.distance_rms)
      return {.reason = format(
                  "of two motions of its period near it one is %s, %.3g rms away, the "
                  "other one %s, %.3g",
                  own.word(), own.distance_rms, other.word(), other.distance_rms)};
  }
  return own;
}

/** The machine's multipliers, point after point of a branch. */
struct Along {
  struct Found {
    double arc, omega;
    State state;  ///< at phase 0
  };

  static constexpr double least = 2e6;  ///< evaluations where a motion is easily found
  const Parameters& parameters;
  OperationBudget budget;
  double most;               ///< evaluations at one point
  bool motion_found = true;  ///< at the last point
  std::vector<Found> found = {};

  Floquet operator()(const BranchPoint& point)
  {
    PeriodicMotion solution = point.motion;
    solution.bodies = body_series(parameters, solution);
    const double share =
        (std::exchange(motion_found, false) ? most : std::max(least, most / 8)) /
        budget.left();
    const OperationBudget part = budget.part(std::min(1.0, share));
    Shootings shootings(parameters, solution, part);
    Verdict verdict;
    if (!shootings.run(verdict.state, starts_near(point)))
      throw NoSolution(shootings.reason());
    add_multipliers(parameters, solution.omega, part, verdict);
    found.push_back({point.arc, solution.omega, verdict.state});
    motion_found = true;
    return verdict.floquet;
  }

  /** On the line through the two motions nearest along the branch, and the nearest one, of those whose speed differs by
      at most 1 % of the joint resonance. */
  std::vector<State> starts_near(const BranchPoint& point) const
  {
    auto near = found;
    const double reach = 0.01 * joint_resonance(parameters) / parameters.turns;
    std::erase_if(near, [&](const Found& motion) {
      return std::abs(motion.omega - point.motion.omega) > reach;
    });
    std::ranges::sort(
        near, {}, [&](const Found& motion) { return std::abs(motion.arc - point.arc); });
    std::vector<State> starts;
    if (near.size() > 1 && near[0].arc != near[1].arc) {
      const double r = (point.arc - near[0].arc) / (near[1].arc - near[0].arc);
      starts.push_back(rotor_stator::state_of((1 - r) * vector_of(near[0].state) +
                                              r * vector_of(near[1].state)));
    }
    if (!near.empty()) starts.push_back(near[0].state);
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

/** What the machine does from `state`, slightly disturbed, if that is not stable. */
static void add_settled(const Parameters& parameters, double omega, const State& state,
                        const OperationBudget& budget, Verdict& verdict)
{
  try {
    const bool leaves = verdict.found() && verdict.floquet.unstable();
    verdict.from_there = settle(parameters, omega, disturbed(parameters, state), budget,
                                leaves ? &verdict.state : nullptr);
  } catch (const NoSolution& error) {
    verdict.lost = error.what();
  }
}

Verdict verdict_through(const Parameters& parameters, double omega, const State& state,
                        const OperationBudget& budget, int turns)
{
  Verdict verdict{.state = state};
  try {
    add_multipliers(over_turns(parameters, turns), omega / turns, budget, verdict);
  } catch (const NoSolution& error) {
    verdict.reason = error.what();
  }
  if (!verdict.floquet.stable()) add_settled(parameters, omega, state, budget, verdict);
  return verdict;
}

Floquet multipliers_through(const Parameters& parameters, double omega,
                            const State& state, const OperationBudget& budget)
{
  Verdict verdict{.state = state};
  const Shooting closed = shoot(parameters, omega, verdict.state,
                                {.tolerance = local_error,
                                 .periodicity_residual = 1e-8,
                                 .speed_weight = 5,
                                 .quasi_newton = false,
                                 .final_derivative = false,
                                 .budget = budget});
  if (!closed.converged) throw NoSolution(closed.reason);
  add_multipliers(parameters, omega, budget, verdict);
  return verdict.floquet;
}

Verdict verdict_on(const Parameters& parameters, const PeriodicMotion& solution,
                   const OperationBudget& budget, int turns)
{
  if (!std::isfinite(1 / solution.omega))
    return {.reason = "the period of rotation is too long to be integrated"};
  const Parameters longer = over_turns(parameters, turns);
  /** The rest is for the integration from there, and for the multipliers. */
  Shootings shootings(longer, solution, budget.part(0.5));
  std::vector<Verdict> motions;  // within reach
  std::string reason;
  double evaluations = 0, refused = 0;
  /** The distance of the solution from the motion that was closed, 0 where none was. */
  const auto add = [&](const std::function<bool(State&)>& close) {
    Verdict motion;
    try {
      if (!close(motion.state)) throw NoSolution(shootings.reason());
      measure(longer, solution, budget, motion);
      shootings.must_be_near(motion);
      add_multipliers(longer, solution.omega, budget, motion);
      motions.push_back(motion);
    } catch (const NoSolution& error) {
      if (reason.empty()) {
        reason = error.what();
        refused = motion.distance > 0 ? motion.distance : shootings.nearest();
      }
    }
    evaluations += motion.evaluations;
    return motion.distance;
  };

  if (add([&](State& state) { return shootings.run(state); }) > surely_its_own)
    add([&](State& state) { return shootings.from_more_harmonics(state); });
  Verdict verdict = own_motion(motions, reason);
  if (!verdict.floquet.stable()) {
    add_settled(parameters, turns * solution.omega,
                verdict.found() ? verdict.state : state_of(parameters, solution), budget,
                verdict);
    const bool is_nearest = !motions.empty() && shootings.found_at_once();
    if (verdict.from_there.period == turns && !is_nearest) {
      const Verdict first = verdict;
      add([&](State& state) {
        return shootings.from(first.from_there, budget.part(0.5), state);
      });
      verdict = own_motion(motions, first.reason);
      verdict.from_there = first.from_there;
      verdict.lost = first.lost;
    }
  }
  if (!verdict.found()) verdict.refused = refused;
  verdict.evaluations = evaluations + shootings.evaluations();
  return verdict;
}

}  // namespace rotor_stator::motion
