#include "time/gauss.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "io/errors.hpp"
#include "time/period_map.hpp"

namespace rotor_stator {

namespace {

using Complex = std::complex<double>;

/** A and c = A1 of the rule, whose b are both 1/2, with an eigenvalue λ of Aᵀ. S = [s,
    s̄] holds its eigenvectors, t the first row of S⁻¹: the stages are 2 Re(x tᵀ) for the
    solution x of λ. */
struct GaussRule {
  Eigen::Matrix2d a;
  Eigen::Vector2d c;
  Complex lambda;
  Eigen::Vector2cd s, t;

  GaussRule()
  {
    const double d = std::sqrt(3.0) / 6;
    a << 0.25, 0.25 - d, 0.25 + d, 0.25;
    c << 0.5 - d, 0.5 + d;
    lambda = {0.25, 0.5 * d};
    const double q = 0.5 * d / (0.25 + d);
    s << 1, Complex(0, q);
    t << 0.5, Complex(0, -0.5 / q);
  }
};

/** Coordinates up to which one matrix is faster than the factors of a shaft's narrow
    bands. */
constexpr Eigen::Index most_dense = 150;

const GaussRule& gauss_rule()
{
  static const GaussRule rule;
  return rule;
}

}  // namespace

GaussStepper::GaussStepper(const LargeBodies& machine, const Parameters& parameters,
                           double omega, int intervals, double tolerance,
                           OperationBudget budget)
    : cages_(joints_of(parameters)), omega_(omega),
      turns_(parameters.turns * parameters.speed_ratio),
      length_(scales(parameters).length),
      interval_(2 * std::numbers::pi / omega / intervals),
      tolerance_(std::max(tolerance, 2e-14)), budget_(std::move(budget))
{
  const double speed = rotor_speed(parameters, omega);
  const double quarter = 0.5 * std::numbers::pi / contact_frequency(parameters);
  first_ = now_ =
      std::clamp(static_cast<int>(std::ceil(std::log2(interval_ / quarter))), 0, 40);
  mass_ = machine.mass.sparseView();
  damping_ = (machine.damping + speed * machine.gyroscopic).sparseView();
  stiffness_ = machine.stiffness.sparseView();
  joints_ = machine.joints.sparseView();
  rest_ = machine.load;
  unbalance_ = speed * speed * machine.unbalance;
  double balls = 0;
  bool is_smooth = true;
  for (const Bearing& joint : cages_) {
    forces_.emplace_back(joint, omega, parameters.turns);
    balls += joint.balls;
    is_damped_ = is_damped_ || joint.is_damped();
    is_smooth = is_smooth && forces_.back().is_elastic_hertz();
  }
  /** The force of a contact that opens is off by the power 3/2 of the change. */
  last_change_ = (is_smooth ? 1e-8 : 1e-12) * length_;
  const auto n = static_cast<double>(rest_.size()),
             joints = static_cast<double>(cages_.size());
  price_ = ((is_damped_ ? 1.5 : 1.0) * 650 * joints * joints + 10 * balls +
            (n <= most_dense ? 0.6 * n * n : 130 * n)) /
           operations_per_evaluation(parameters.bearing.balls);
}

GaussStepper::Level& GaussStepper::level(int k)
{
  auto& known = levels_[k];
  if (known) return *known;
  auto made = std::make_unique<Level>();
  const double h = made->step = std::ldexp(interval_, -k);
  const auto& [a, c, lambda, s, t] = gauss_rule();
  const Complex by_rate = h * lambda;
  Sparse z = mass_.cast<Complex>() + by_rate * damping_.cast<Complex>();
  z += by_rate * by_rate * stiffness_.cast<Complex>();
  made->factors.compute(z);
  if (made->factors.info() != Eigen::Success)
    throw NoSolution("the matrices of the bodies have no factors: " +
                     made->factors.lastErrorMessage());
  const Eigen::MatrixXcd x =
      made->factors.solve(Eigen::MatrixXcd(joints_.cast<Complex>()));
  Eigen::MatrixXcd of_both(x.rows(), 2 * x.cols());
  of_both << s[0] * x, s[1] * x;
  made->per_force = answer(*made, of_both);
  made->force = Eigen::VectorXd::Zero(of_both.cols());
  known = std::move(made);
  return *known;
}

/** What solutions x of the parted stages do, in the columns of `x`. */
Eigen::MatrixXd GaussStepper::answer(const Level& level, const Eigen::MatrixXcd& x) const
{
  const auto& [a, c, lambda, s, t] = gauss_rule();
  const Eigen::Index n = rest_.size(), d = joints_.cols();
  const double h = level.step;
  const Eigen::MatrixXcd joints_x = joints_.cast<Complex>().transpose() * x;
  const Eigen::Vector2cd to_rates = a * t, to_places = a * to_rates;
  const Complex to_speed = t.sum() / 2.0, to_place = to_rates.sum() / 2.0;
  Eigen::MatrixXd rows(with_end() + 2 * n, x.cols());
  for (int i : {0, 1}) {
    rows.middleRows(i * d, d) = 2 * h * h * (to_places[i] * joints_x).real();
    if (is_damped_)
      rows.middleRows((2 + i) * d, d) = 2 * h * (to_rates[i] * joints_x).real();
  }
  rows.middleRows(seen(), d) = 2 * h * h * (to_place * joints_x).real();
  rows.middleRows(with_end(), n) = 2 * h * h * (to_place * x).real();
  rows.bottomRows(n) = 2 * h * (to_speed * x).real();
  return rows;
}

/** Forces of the joints at both stages, and their derivatives by blocks of two. */
GaussStepper::Seen GaussStepper::reaction(const double* phases, const Seen& seen,
                                          Slopes& slopes)
{
  const Eigen::Index both = 2 * joints_.cols();
  Seen force(both);
  slopes.setZero(both, seen.size());
  for (Eigen::Index k = 0, stage = 0; stage < 2; ++stage)
    for (std::size_t b = 0; b < forces_.size(); ++b, k += 2) {
      const Vec2 u{seen[k], seen[k + 1]};
      const Vec2 rate =
          is_damped_ ? Vec2{seen[both + k], seen[both + k + 1]} : Vec2{0, 0};
      const auto at =
          forces_[b].is_elastic_hertz()
              ? Angles{{1, 0}, Direction::of(cages_[b].cage_angle(phases[stage]))}
          : cages_[b].balls > 0 ? forces_[b].angles(phases[stage])
                                : Angles{{1, 0}, {1, 0}};
      const BearingReaction pressed = forces_[b].reaction(at, u, rate);
      force.segment<2>(k) << pressed.force.x, pressed.force.y;
      slopes.block<2, 2>(k, k) = pressed.stiffness.matrix();
      if (is_damped_) slopes.block<2, 2>(k, both + k) = pressed.damping.matrix();
    }
  evaluations_ += 2;
  return force;
}

/** A step without the joints' forces, of states in the columns of `y`; with the rotor's
    angle at its begin the loads drive the first one. */
Eigen::MatrixXd GaussStepper::unforced_by_factors(const Level& level, const double* angle,
                                                  const Eigen::MatrixXd& y) const
{
  const auto& [a, c, lambda, s, t] = gauss_rule();
  const Eigen::Index n = rest_.size(), d = joints_.cols();
  const double h = level.step;
  const Eigen::MatrixXd v = y.bottomRows(n);
  Eigen::MatrixXcd x = -s.sum() * (stiffness_ * y.topRows(n) + damping_ * v);
  x -= h * s.cwiseProduct(c.cast<Complex>()).sum() * (stiffness_ * v);
  for (int i = 0; angle && i < 2; ++i) {
    const auto turned = std::polar(1.0, *angle + turns_ * omega_ * h * c[i]);
    x.col(0) += (rest_ + (turned * unbalance_).real()) * s[i];
  }
  x = level.factors.solve(x);
  Eigen::MatrixXd rows = answer(level, x);
  const Eigen::MatrixXd joints_q = joints_.transpose() * y.topRows(n),
                        joints_v = joints_.transpose() * v;
  for (int i : {0, 1}) {
    rows.middleRows(i * d, d) += joints_q + h * c[i] * joints_v;
    if (is_damped_) rows.middleRows((2 + i) * d, d) += joints_v;
  }
  rows.middleRows(seen(), d) += joints_q + h * joints_v;
  rows.middleRows(with_end(), n) += y.topRows(n) + h * v;
  rows.bottomRows(n) += v;
  return rows;
}

/** The same of all states and of the loads by superposition: columns for the coordinates
    and speeds, and for 1, cos and sin of the rotor's angle. */
Eigen::MatrixXd GaussStepper::all_unforced(const Level& level) const
{
  const Eigen::Index states = 2 * rest_.size();
  const auto loaded = [&](double angle) -> Eigen::VectorXd {
    return unforced_by_factors(level, &angle, Eigen::VectorXd::Zero(states));
  };
  const Eigen::VectorXd at_0 = loaded(0), mean = (at_0 + loaded(std::numbers::pi)) / 2;
  Eigen::MatrixXd all(at_0.size(), states + 3);
  all << unforced_by_factors(level, nullptr, Eigen::MatrixXd::Identity(states, states)),
      mean, at_0 - mean, loaded(std::numbers::pi / 2) - mean;
  return all;
}

/** Its first rows, of few coordinates by that matrix: it is made for disturbances, and
    for a motion when it has made as many steps as the matrix takes. */
Eigen::MatrixXd GaussStepper::unforced(Level& level, double angle,
                                       const Eigen::MatrixXd& y, Eigen::Index rows) const
{
  const Eigen::Index states = y.rows();
  const bool is_many = y.cols() > 1 || level.steps > states;
  if (level.unforced.size() == 0 && states <= 2 * most_dense && is_many)
    level.unforced = all_unforced(level);
  if (level.unforced.size() == 0)
    return unforced_by_factors(level, &angle, y).topRows(rows);
  const auto all = level.unforced.topRows(rows);
  Eigen::MatrixXd after = all.leftCols(states) * y;
  after.col(0) +=
      all.rightCols<3>() * Eigen::Vector3d(1, std::cos(angle), std::sin(angle));
  return after;
}

/** The motion in the first column of `y`, displacements and speeds, and its disturbances
    in the others; it becomes the state after the step, or u of the joints there. False
    where Newton does not converge. */
bool GaussStepper::step(Level& level, double phase, Eigen::MatrixXd& y, After after)
{
  const Eigen::Index both = 2 * joints_.cols(), others = y.cols() - 1;
  budget_.spend(price_ * static_cast<double>(y.cols()));
  ++level.steps;
  const Eigen::Vector2d& c = gauss_rule().c;
  const double by = omega_ * level.step,
               phases[] = {phase + by * c[0], phase + by * c[1]};
  const Eigen::MatrixXd rows = unforced(
      level, turns_ * phase, y, with_end() + (after == After::state ? y.rows() : 0));
  const auto free = rows.topRows(seen());
  const auto receptance = level.per_force.topRows(seen());
  Eigen::MatrixXd force(both, y.cols());
  Slopes slopes, slope;
  Eigen::PartialPivLU<Slopes> factors;
  Seen u = free.col(0) - receptance.lazyProduct(level.force), change, pushed;
  constexpr int most_iterations = 12;
  for (int iteration = 0;; ++iteration) {
    if (iteration == most_iterations) return false;
    pushed = reaction(phases, u, slopes);
    slope = slopes.lazyProduct(receptance);
    slope.diagonal().array() += 1;
    factors.compute(slope);
    change = u - free.col(0) + receptance.lazyProduct(pushed);
    change -= receptance.lazyProduct(factors.solve(slopes.lazyProduct(change)).eval());
    u -= change;
    if (!u.allFinite()) return false;
    double largest = change.head(both).cwiseAbs().maxCoeff();
    if (is_damped_)
      largest = std::max(largest, level.step * change.tail(both).cwiseAbs().maxCoeff());
    if (largest <= last_change_) break;
  }
  force.col(0) = level.force = pushed - slopes.lazyProduct(change);
  if (others > 0)
    force.rightCols(others) = factors.solve(slopes * free.rightCols(others));
  const Eigen::Index kept = after == After::state ? y.rows() : joints_.cols();
  y = rows.bottomRows(kept) -
      level.per_force.middleRows(rows.rows() - kept, kept) * force;
  return true;
}

/** One interval. The motion alone chooses the steps 2⁻ᵏ of it, by the error of their
    halves. */
void GaussStepper::integrate(long interval, Eigen::MatrixXd& y)
{
  constexpr int finest = 16;  ///< halvings below the first step
  const auto n = rest_.size();
  taken_.clear();
  for (double passed = 0; passed < 1;) {
    const double phase = omega_ * interval_ * (static_cast<double>(interval) + passed);
    Level &whole = level(now_), &half = level(now_ + 1);
    const double middle = phase + omega_ * half.step;
    Eigen::MatrixXd coarse = y.leftCols(1), fine = coarse;
    double error = std::numeric_limits<double>::infinity();  // by order 4
    if (step(whole, phase, coarse, After::joints) && step(half, phase, fine) &&
        step(half, middle, fine))
      error = (joints_.transpose() * fine.topRows(n) - coarse).cwiseAbs().maxCoeff() /
              (15 * length_);
    if (!(error <= tolerance_) && now_ < first_ + finest) {
      ++now_;
      continue;
    }
    const bool is_alone = y.cols() == 1;
    if (!std::isfinite(error) ||
        !(is_alone || (step(half, phase, y) && step(half, middle, y))))
      throw Diverged(format("time integration diverged at t = %.9g s", phase / omega_));
    if (is_alone) y = fine;
    taken_.push_back(now_);
    const double length = std::ldexp(1.0, -now_);
    passed += length;
    if (now_ > first_ && std::fmod(passed, 2 * length) == 0 && error < tolerance_ / 50)
      --now_;
  }
}

void GaussStepper::advance(long interval, State& state)
{
  Eigen::MatrixXd y = vector_of(state);
  integrate(interval, y);
  state = state_of(y.col(0));
}

void GaussStepper::advance_beside(long interval, State& state)
{
  Eigen::MatrixXd y = vector_of(state);
  double phase = omega_ * interval_ * static_cast<double>(interval);
  for (int k : taken_)
    for (int halves = 0; halves < 2; ++halves) {
      Level& half = level(k + 1);
      if (!step(half, phase, y))
        throw Diverged(format("time integration diverged at t = %.9g s", phase / omega_));
      phase += omega_ * half.step;
    }
  state = state_of(y.col(0));
}

Eigen::MatrixXd GaussStepper::derivative(long interval, const State& start)
{
  const Eigen::Index size = 2 * rest_.size();
  Eigen::MatrixXd y(size, size + 1);
  y << vector_of(start), Eigen::MatrixXd::Identity(size, size);
  integrate(interval, y);
  return y.rightCols(size);
}

double LargeMachine::step(const Parameters& parameters, double) const
{
  return default_step(parameters);
}

/** Half the step of rk4 is half the step here: the error of one falls with its fifth
    power. */
std::unique_ptr<Flow> LargeMachine::flow(const Parameters& parameters, double omega,
                                         const StepSettings& settings) const
{
  constexpr double usual = 1e-8;
  const double steps = settings.step > 0 ? settings.step / step(parameters, omega) : 1;
  return std::make_unique<GaussStepper>(
      bodies_, parameters, omega, settings.intervals_per_period,
      settings.method == "auto" ? usual * std::pow(steps, 5) : settings.tolerance,
      settings.budget);
}

/** Steps for the derivative need not be as small as those for the state. */
PeriodMap LargeMachine::period_map(const Parameters& parameters, double omega,
                                   const State& start, const StepSettings& settings,
                                   long interval) const
{
  constexpr double coarser = 7;
  const int intervals = settings.intervals_per_period;
  GaussStepper state(bodies_, parameters, omega, intervals, settings.tolerance,
                     settings.budget);
  State end = start;
  state.advance(interval, end);
  GaussStepper varied(bodies_, parameters, omega, intervals, coarser * settings.tolerance,
                      settings.budget);
  const Eigen::MatrixXd derivative = varied.derivative(interval, start);
  return {end, derivative, state.evaluations() + varied.evaluations()};
}

}  // namespace rotor_stator
