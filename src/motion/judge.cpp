#include "motion/judge.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "balance/bearing_problem.hpp"
#include "balance/fourier_transform.hpp"
#include "balance/large_problem.hpp"
#include "balance/newton.hpp"
#include "io/errors.hpp"
#include "model/large_machine.hpp"
#include "time/closing.hpp"
#include "time/time_stepper.hpp"

namespace rotor_stator::motion {

namespace {

constexpr double rough_error = 1e-7, roughly_closed = 1e-5;
constexpr double local_error = 1e-11, finer = 1e-13, well_closed = 1e-8;

/** A motion of Eq. 7 at its eight phases, and its multipliers. */
struct ClosedMotion {
  Eighths at;
  Floquet floquet = {};
  Motion record = {};
  double distance = 0, distance_rms = 0;  ///< of the solution, as in Verdict
  bool moves = false;

  bool opposite(const ClosedMotion& other) const
  {
    return (floquet.stable() && other.floquet.unstable()) ||
           (floquet.unstable() && other.floquet.stable());
  }
};

/** The solution's states at eight phases, from the series of all coordinates. */
Eighths eighths_of(const Parameters& parameters, const PeriodicMotion& solution)
{
  const Eigen::MatrixXd series =
      parameters.large ? coordinate_series(parameters, solution) : solution.bodies;
  const Eigen::MatrixXd q = sample_series(series, eighths);
  const Eigen::MatrixXd v =
      solution.omega * sample_series(differentiate(series), eighths);
  Eighths at;
  for (int k = 0; k < eighths; ++k) {
    Eigen::VectorXd y(2 * q.cols());
    y << q.row(k).transpose(), v.row(k).transpose();
    at.push_back(rotor_stator::state_of(y));
  }
  return at;
}

/** The displacements of both bodies: rms difference over the sizes, at all eight phases.
    */
double apart(const Eighths& a, const Eighths& b, double size)
{
  double sum = 0;
  for (std::size_t i = 0; i < eighths; ++i)
    sum += (vector_of(a[i]) - vector_of(b[i])).head<4>().squaredNorm();
  return std::sqrt(sum / eighths) / size;
}

/** Closes motions of Eq. 7 with one base period, and judges them. */
class Closer {
public:
  Closer(const Parameters& parameters, double omega, OperationBudget budget)
      : parameters_(parameters), omega_(omega), budget_(std::move(budget)),
        size_(state_scales(parameters)[0])
  {
  }

  Closing roughly(Eighths& motion, std::optional<int> alone = {})
  {
    return add(close(parameters_, omega_, motion,
                     {.local_error = rough_error,
                      .closed = roughly_closed,
                      .most_maps = alone ? 10 : 20,
                      .budget = budget_,
                      .alone = alone}));
  }

  /** The motion near `start` and its multipliers, whose uncertainty is what a second
      closing changes. Throws NoSolution. */
  ClosedMotion exactly(const Eighths& start)
  {
    ClosedMotion motion{start};
    const auto closed = [&](double error, double wanted) {
      const Closing closing =
          add(close(parameters_, omega_, motion.at,
                    {.local_error = error, .closed = wanted, .budget = budget_}));
      if (!closing.closed) throw NoSolution(closing.reason);
      return multipliers_of(closing.derivative);
    };
    Floquet& floquet = motion.floquet;
    const Multipliers first = closed(local_error, well_closed);
    floquet.multipliers = closed(finer, 1e2 * well_closed);
    floquet.change = largest_move(floquet.multipliers, first);
    /** Receptances that are wrong by ε move no exponent by more than ε times the
        contact's frequency. */
    if (parameters_.large)
      floquet.change += parameters_.large->reduction_error *
                        contact_frequency(parameters_) * angular(1) / omega_;
    floquet.settled = floquet.change <= 0.1;
    return motion;
  }

  /** One period, each eighth from its own state. */
  Motion record(const Eighths& motion, int instants)
  {
    const TimeStepper stepper = make_stepper(
        parameters_, omega_,
        {.intervals_per_period = instants, .tolerance = local_error, .budget = budget_});
    Motion record{instants, 0, {}};
    for (int k = 0; k < instants;) {
      State state = motion[static_cast<std::size_t>(k * eighths / instants)];
      for (const int end = k + instants / eighths; k < end; ++k) {
        motion::add(record, state);
        stepper.advance(k, state);
      }
    }
    evaluations_ += static_cast<double>(stepper.evaluations());
    return record;
  }

  double size() const { return size_; }
  double evaluations() const { return evaluations_; }

private:
  Closing add(Closing closing)
  {
    evaluations_ += static_cast<double>(closing.evaluations);
    return closing;
  }

  const Parameters& parameters_;
  double omega_;
  OperationBudget budget_;
  double size_;
  double evaluations_ = 0;
};

/** The motions around one solution. */
class Search {
public:
  Search(const Parameters& parameters, const PeriodicMotion& solution,
         const OperationBudget& budget)
      : parameters_(parameters), solution_(solution), budget_(budget),
        closer_(parameters, solution.omega, budget),
        start_(eighths_of(parameters, solution)),
        judged_(motion_of(solution.bodies, instants * parameters.turns))
  {
  }

  /** From the solution, and from `further` motions that may be near it. */
  void run(const std::vector<Eighths>& further = {})
  {
    Eighths motion = start_;
    Closing own = closer_.roughly(motion);
    if (own.first.size() > 0) own_distance_ = distance_of(own.first);
    if (!own.closed) {
      motion = raised();
      const double away = apart(motion, start_, closer_.size());
      own = closer_.roughly(motion);
      if (own.closed) own_distance_ = away + distance_of(own.first);
    }
    reason_ = own.reason;
    if (own.closed) add(motion);
    for (Eighths other : further)
      if (closer_.roughly(other).closed) add(other);
    /** Where Newton converges at once no other motion is as near. */
    if (motions_.size() == 1 && own.contraction < quick) return;
    for (int k = 0; k < eighths && !budget_.used_up(); ++k) {
      motion = start_;
      if (closer_.roughly(motion, k).closed) add(motion);
    }
    if (motions_.empty() && budget_.used_up()) reason_ = "the budget is used up";
  }

  /** Adds the motion that is closed from here. */
  void add(const Eighths& motion)
  {
    constexpr double same = 1e-5, near = 10, floor = 1e-4;
    const auto is_known = [&](const Eighths& at, double within) {
      return std::ranges::any_of(motions_, [&](const ClosedMotion& known) {
        return apart(at, known.at, closer_.size()) < within;
      });
    };
    if (is_known(motion, same)) return;
    const double away = apart(motion, start_, closer_.size());
    if (!(away <= near * own_distance_ + floor)) {
      reason_ = "the motion of its period found from it is too far away to be its own";
      refused_ = away * closer_.size() / std::max(largest_displacement(judged_), 1e-300);
      return;
    }
    try {
      ClosedMotion exact = closer_.exactly(motion);
      if (is_known(exact.at, 0.01 * same)) return;
      exact.record = closer_.record(exact.at, instants * parameters_.turns);
      exact.distance = relative_difference(judged_, exact.record);
      exact.distance_rms = rms_difference(judged_, exact.record);
      for (const double half : half_peak_to_peak(exact.record))
        exact.moves = exact.moves || half > 1e-12 * closer_.size();
      motions_.push_back(std::move(exact));
    } catch (const NoSolution& none) {
      reason_ = none.what();
    }
  }

  /** The nearest one. */
  Verdict nearest() const
  {
    constexpr double as_near = 2;
    Verdict verdict{.reason = motions_.empty() ? reason_ : ""};
    verdict.evaluations = evaluations_ + closer_.evaluations();
    if (motions_.empty()) {
      verdict.refused = refused_;
      return verdict;
    }
    const ClosedMotion& own =
        *std::ranges::min_element(motions_, {}, &ClosedMotion::distance_rms);
    for (const ClosedMotion& other : motions_)
      if (own.opposite(other) && other.distance_rms < as_near * own.distance_rms) {
        verdict.reason = format(
            "of two motions of its period near it one is %s, %.3g rms away, the other "
            "one %s, %.3g",
            own.floquet.verdict(), own.distance_rms, other.floquet.verdict(),
            other.distance_rms);
        return verdict;
      }
    verdict.floquet = own.floquet;
    verdict.state = own.at.front();
    verdict.record = own.record;
    verdict.moves = own.moves;
    verdict.distance = own.distance;
    verdict.distance_rms = own.distance_rms;
    return verdict;
  }

  const std::vector<ClosedMotion>& motions() const { return motions_; }
  const State& start() const { return start_.front(); }

private:
  static constexpr int instants = 256;  ///< of each turn
  static constexpr double quick = 0.3;  ///< second correction over the first one [-]

  /** The same solution with four times as many harmonics, where Newton finds it. */
  Eighths raised()
  try {
    const int m = 4 * solution_.harmonics.count(), most = 192 * parameters_.turns;
    if (m > most) return start_;
    Balance balance(bearing_problem(parameters_, fast_transform_size(8 * m + 1), budget_),
                    m);
    PeriodicMotion more = solve(balance, solution_.omega,
                                resize_harmonics(solution_.x, balance.problem().dofs, m));
    evaluations_ += static_cast<double>(more.force_samples);
    if (!more.found()) return start_;
    more.bodies = body_series(parameters_, more);
    return eighths_of(parameters_, more);
  } catch (const NoSolution&) {
    return start_;
  }

  /** The displacements of a correction of all eight states, as `apart` measures them. */
  double distance_of(const Eigen::VectorXd& correction) const
  {
    const Eigen::Index n = state_scales(parameters_).size();
    const Eigen::Index states = correction.size() / n;
    double sum = 0;
    for (Eigen::Index i = 0; i < states; ++i)
      sum += correction.segment(i * n, 4).squaredNorm();
    return std::sqrt(sum / static_cast<double>(states));
  }

  const Parameters& parameters_;
  const PeriodicMotion& solution_;
  OperationBudget budget_;
  Closer closer_;
  Eighths start_;
  Motion judged_;
  double own_distance_ = 0, refused_ = 0, evaluations_ = 0;
  std::vector<ClosedMotion> motions_;
  std::string reason_;
};

/** What the machine does from `state`, disturbed by 1e-3 of the sizes. */
void add_settled(const Parameters& parameters, double omega, const State& state,
                 const OperationBudget& budget, Verdict& verdict)
{
  constexpr double disturbance = 1e-3, left = 1e-2;
  constexpr long before = 200;  ///< base periods until the section is looked at
  const Eigen::VectorXd sizes = state_scales(parameters);
  try {
    const State start = rotor_stator::state_of(vector_of(state) + disturbance * sizes);
    verdict.from_there =
        settle(parameters, omega, BasePeriod{}, {start, -before}, {}, budget);
    const Eigen::VectorXd moved =
        (vector_of(verdict.from_there.at.state) - vector_of(state)).cwiseQuotient(sizes);
    if (verdict.found() && verdict.floquet.unstable() &&
        moved.cwiseAbs().maxCoeff() < left) {
      verdict.from_there.kind = Kind::undecided;
      verdict.from_there.period = 0;
      verdict.from_there.reason = "it has not left the unstable motion yet";
    }
  } catch (const NoSolution& error) {
    verdict.lost = error.what();
  }
}

/** The states of the motion through `state` at phase 0. */
Eighths eighths_from(const Parameters& parameters, double omega, State state,
                     const OperationBudget& budget)
{
  const TimeStepper stepper = make_stepper(
      parameters, omega,
      {.intervals_per_period = eighths, .tolerance = local_error, .budget = budget});
  Eighths at;
  for (int k = 0; k < eighths; ++k) {
    at.push_back(state);
    stepper.advance(k, state);
  }
  return at;
}

}  // namespace

Floquet multipliers_through(const Parameters& parameters, double omega,
                            const State& state, const OperationBudget& budget)
{
  return Closer(parameters, omega, budget)
      .exactly(eighths_from(parameters, omega, state, budget))
      .floquet;
}

Verdict judge_through(const Parameters& parameters, double omega, const State& state,
                      const OperationBudget& budget, int turns)
{
  Verdict verdict{.state = state};
  const Parameters longer = over_turns(parameters, turns);
  Closer closer(longer, omega / turns, budget);
  try {
    const ClosedMotion motion =
        closer.exactly(eighths_from(longer, omega / turns, state, budget));
    verdict.floquet = motion.floquet;
    verdict.state = motion.at.front();
  } catch (const NoSolution& error) {
    verdict.reason = error.what();
  }
  verdict.evaluations = closer.evaluations();
  if (!verdict.stable()) add_settled(parameters, omega, state, budget, verdict);
  return verdict;
}

Verdict judge(const Parameters& parameters, const PeriodicMotion& solution,
              const OperationBudget& budget, int turns)
{
  if (!std::isfinite(1 / solution.omega))
    return {.reason = "the period of rotation is too long to be integrated"};
  const Parameters longer = over_turns(parameters, turns);
  Search search(longer, solution, budget.part(0.5));
  search.run();
  Verdict verdict = search.nearest();
  if (!verdict.stable())
    add_settled(parameters, turns * solution.omega,
                verdict.found() ? verdict.state : search.start(), budget, verdict);
  return verdict;
}

namespace {

/** The multipliers point after point of a branch: shooting starts from the two nearest
    motions along it too. */
class Along {
public:
  Along(const Parameters& parameters, const OperationBudget& budget)
      : parameters_(parameters), budget_(budget),
        most_(std::max(2e6, 0.04 * std::min(budget.left(), 2e9)))
  {
  }

  Floquet operator()(const BranchPoint& point)
  {
    PeriodicMotion solution = point.motion;
    solution.bodies = body_series(parameters_, solution);
    Search search(parameters_, solution,
                  budget_.part(std::min(1.0, most_ / budget_.left())));
    search.run(starts_near(point));
    const Verdict verdict = search.nearest();
    if (!verdict.found()) throw NoSolution(verdict.reason);
    const ClosedMotion& nearest =
        *std::ranges::min_element(search.motions(), {}, &ClosedMotion::distance_rms);
    found_.push_back({point.arc, solution.omega, nearest.at});
    return verdict.floquet;
  }

private:
  struct Found {
    double arc, omega;
    Eighths at;
  };

  /** On the line through the two motions nearest along the branch, of those whose speed
      differs by at most 1 % of the joint resonance. */
  std::vector<Eighths> starts_near(const BranchPoint& point) const
  {
    auto near = found_;
    const double reach = 0.01 * joint_resonance(parameters_) / parameters_.turns;
    std::erase_if(near, [&](const Found& motion) {
      return std::abs(motion.omega - point.motion.omega) > reach;
    });
    std::ranges::sort(
        near, {}, [&](const Found& motion) { return std::abs(motion.arc - point.arc); });
    if (near.empty()) return {};
    if (near.size() == 1 || near[0].arc == near[1].arc) return {near[0].at};
    const double r = (point.arc - near[0].arc) / (near[1].arc - near[0].arc);
    Eighths between;
    for (std::size_t i = 0; i < eighths; ++i)
      between.push_back(rotor_stator::state_of((1 - r) * vector_of(near[0].at[i]) +
                                               r * vector_of(near[1].at[i])));
    return {between};
  }

  const Parameters& parameters_;
  OperationBudget budget_;
  double most_;  ///< evaluations at one point
  std::vector<Found> found_ = {};
};

}  // namespace

BranchStability machine_stability(const Parameters& parameters, Balance& balance,
                                  const Branch& branch,
                                  const ArcLengthSettings& arc_length,
                                  const OperationBudget& budget)
{
  const double width = 0.004 * joint_resonance(parameters) / parameters.turns;
  Along multipliers(parameters, budget);
  return stability_along(balance, branch, arc_length, std::ref(multipliers),
                         {.chosen = evenly_chosen(branch, width, 2), .widest = width});
}

}  // namespace rotor_stator::motion
