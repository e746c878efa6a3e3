#include "balance/chosen_orders.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "balance/step_solver.hpp"
#include "io/errors.hpp"

namespace rotor_stator {

namespace {

using Complex = std::complex<double>;

/** The power of two of which `samples` are at most four. */
int unit_of(int samples)
{
  int unit = 16;
  while (samples > 4 * unit) unit *= 2;
  return unit;
}

/** The next number with at most two binary digits: few different ones in a sweep. */
int rounded_up(int samples)
{
  const int unit = unit_of(samples);
  return (samples + unit - 1) / unit * unit;
}

/** The samples that measure what `samples` leave out. */
int finer_samples(int samples)
{
  const int unit = unit_of(samples);
  return samples == 4 * unit ? 7 * unit : 5 * unit;
}

Harmonics harmonics_of(const std::vector<int>& orders)
{
  std::vector<Harmonic> list;
  for (int h : orders) list.push_back({static_cast<double>(h), 0});
  return Harmonics(std::move(list));
}

/** Columns of the chosen orders in a series of all up to the highest, zeros between them; and back. */
Eigen::MatrixXd spread(const Eigen::MatrixXd& few, const std::vector<int>& orders)
{
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(few.rows(), 2 * orders.back() + 1);
  all.col(0) = few.col(0);
  for (std::size_t k = 1; k < orders.size(); ++k)
    all.middleCols(2 * orders[k] - 1, 2) =
        few.middleCols(2 * static_cast<Eigen::Index>(k) - 1, 2);
  return all;
}

Eigen::MatrixXd gathered(const Eigen::MatrixXd& all, const std::vector<int>& orders)
{
  Eigen::MatrixXd few =
      Eigen::MatrixXd::Zero(all.rows(), 2 * static_cast<Eigen::Index>(orders.size()) - 1);
  few.col(0) = all.col(0);
  for (std::size_t k = 1; k < orders.size() && 2 * orders[k] < all.cols(); ++k)
    few.middleCols(2 * static_cast<Eigen::Index>(k) - 1, 2) =
        all.middleCols(2 * orders[k] - 1, 2);
  return few;
}

Eigen::Map<const Eigen::MatrixXd> series_of(const Eigen::VectorXd& x)
{
  return {x.data(), 2, x.size() / 2};
}

/** What u adds to x_s, y_s, x_r, y_r [m] where no further load acts: a factor of each body for each order. */
class Moved {
public:
  void refresh(const Parameters& parameters, double omega, int count)
  {
    if (omega == omega_ && stator_.size() == count + 1) return;
    omega_ = omega;
    stator_.resize(count + 1);
    rotor_.resize(count + 1);
    weight_.resize(4 * count + 2);
    for (int h = 0; h <= count; ++h) {
      const Complex z_s = dynamic_stiffness(parameters.stator, h * omega).value,
                    z_r = dynamic_stiffness(parameters.rotor, h * omega).value;
      const Complex per = 1.0 / (z_s + z_r);
      stator_[h] = -z_r * per;
      rotor_[h] = z_s * per;
      weight_.segment(h == 0 ? 0 : 4 * h - 2, h == 0 ? 2 : 4)
          .setConstant(std::sqrt(std::norm(stator_[h]) + std::norm(rotor_[h])));
    }
  }

  /** Of both bodies, for each coefficient of u. */
  const Eigen::VectorXd& weight() const { return weight_; }
  double norm(const Eigen::VectorXd& u) const { return u.cwiseProduct(weight_).norm(); }

  Eigen::MatrixXd series(const Eigen::VectorXd& u) const
  {
    const auto columns = series_of(u);
    Eigen::MatrixXd series(4, columns.cols());
    for (int h = 0; 2 * h < columns.cols(); ++h)
      for (int axis = 0; axis < 2; ++axis) {
        const Eigen::Index at = h == 0 ? 0 : 2 * h - 1;
        const Complex of(columns(axis, at), h == 0 ? 0 : -columns(axis, at + 1));
        const Complex s = stator_[h] * of, r = rotor_[h] * of;
        series(axis, at) = s.real();
        series(2 + axis, at) = r.real();
        if (h == 0) continue;
        series(axis, at + 1) = -s.imag();
        series(2 + axis, at + 1) = -r.imag();
      }
    return series;
  }

private:
  double omega_ = 0;
  Eigen::VectorXcd stator_, rotor_;
  Eigen::VectorXd weight_;
};

/** The largest displacement of an order [m]. */
double size_of(const Eigen::MatrixXd& bodies, int h)
{
  return std::sqrt(bodies.middleCols(2 * h - 1, 2).rowwise().squaredNorm().maxCoeff());
}

/** The least orders without which a motion stays within a part of the tolerance. */
struct Largest {
  std::vector<int> orders;
  double displacement, rms;  ///< of the others, over those of the motion [-]

  Largest(const Eigen::MatrixXd& bodies, double largest, double most)
      : orders{0}, displacement(0), rms(0)
  {
    const int count = static_cast<int>(bodies.cols() / 2);
    const double total = vibration(bodies);
    Eigen::VectorXd sizes(count + 1);
    for (int h = 1; h <= count; ++h) sizes[h] = size_of(bodies, h);
    std::vector<int> by_size(static_cast<std::size_t>(count));
    std::iota(by_size.begin(), by_size.end(), 1);
    std::ranges::stable_sort(by_size, {}, [&](int h) { return sizes[h]; });
    double sum = 0, squares = 0;
    for (int h : by_size) {
      sum += over(sizes[h], largest);
      squares += bodies.middleCols(2 * h - 1, 2).squaredNorm();
      const double root = over(std::sqrt(squares), total);
      if (std::max(sum, root) > most || h == by_size.back()) {
        orders.push_back(h);
        continue;
      }
      displacement = sum;
      rms = root;
    }
    std::ranges::sort(orders);
  }
};

/** Of the tolerance: a part is left for what the estimate leaves out. */
constexpr double accepted = 0.9;

/** Of the tolerance: orders that together are smaller are left out. */
constexpr double unnoticed = 0.3;

/** The error of the finer samples is taken to be this part of what they add. */
constexpr double beyond = 0.5;

/** Halving the samples is taken to multiply their error by at most this. */
constexpr double fall = 8;

/** Of the tolerance, for the error of the finer samples: with more the samples are doubled, and not halved where they would come
    to more. */
constexpr double most_sampled = 0.25;

/** So many orders beside the mean are solved for by dense factors. */
constexpr std::size_t few = 16;

}  // namespace

/** What belongs to a number of samples. */
struct ChosenOrders::Grid {
  Problem problem;
  int count;  ///< the highest order that N samples say anything of
  Balance all;
  FourierTransform transform;
  Moved moved = {};
  Gmres gmres = {};
  Eigen::VectorXd answer, scaled, product;
  Eigen::MatrixXd instants = {};

  explicit Grid(Problem at)
      : problem(std::move(at)), count(problem.samples / 3), all(problem, count),
        transform(problem.samples), product(all.unknowns())
  {
  }

  double largest(const Eigen::MatrixXd& bodies)
  {
    transform.to_samples(bodies, instants);
    return instants.cwiseAbs().maxCoeff();
  }

  /** What a coarser grid leaves out at x, its last point: one step from x, without the one that it leads to itself. */
  Eigen::MatrixXd left_out_by(Grid& coarse, const Eigen::VectorXd& x,
                              const Parameters& parameters, double omega)
  {
    moved.refresh(parameters, omega, count);
    const Eigen::VectorXd start = resize_harmonics(x, 2, count);
    all.factor_in_time(start, omega);
    Eigen::VectorXd residual = all.residual(start, omega);
    residual.head(x.size()) -= coarse.all.residual(x, omega);
    all.solve_in_time(residual, answer);
    return moved.series(answer);
  }
};

/** Steps by the equations in time, measured by how far they move the bodies. */
struct ChosenOrders::Steps {
  Grid& at;
  double omega;
  Eigen::VectorXd x;
  double size = 0, ratio = 0;  ///< of the next step [m], and over that of the last one
  bool is_fresh = false;       ///< the factors are those of x

  Steps(Grid& grid, double speed, Eigen::VectorXd start)
      : at(grid), omega(speed), x(std::move(start))
  {
    refactor();
  }

  void refactor()
  {
    at.all.factor_in_time(x, omega);
    is_fresh = true;
    answer();
  }

  void answer()
  {
    at.all.solve_in_time(at.all.residual(x, omega), at.answer);
    size = at.moved.norm(at.answer);
  }

  /** Whether the step leads to a shorter one. Where that is not much shorter, it comes from new factors, and where they were
      new from GMRES. */
  bool take()
  {
    constexpr double poor = 0.35;
    double before = size;
    if (!move()) {  // by a better one
      refactor();
      iterate();
      before = size;
      if (!move()) return false;
    }
    ratio = size / before;
    const bool was_fresh = std::exchange(is_fresh, false);
    if (ratio <= poor) return true;
    refactor();
    if (was_fresh) iterate();
    return true;
  }

  /** Along the step, halved until the next one is shorter; back where it was if it never is. */
  bool move()
  {
    constexpr int most_halvings = 4;
    const double before = size;
    const Eigen::VectorXd start = x, step = at.answer;
    double length = 1;
    for (int halvings = 0; halvings <= most_halvings; ++halvings, length /= 2) {
      x = start - length * step;
      answer();
      if (size <= (1 - length / 4) * before) return true;
    }
    x = start;
    return false;
  }

  /** Newton's own step, to a tenth of what the answer is; false where GMRES does not find it. */
  bool iterate()
  {
    constexpr double goal = 0.1;
    constexpr int most = 40;
    const Eigen::VectorXd& weight = at.moved.weight();
    const auto apply = [&](const Eigen::VectorXd& v, Eigen::VectorXd& result) {
      at.all.apply_jacobian(x, omega, v.cwiseQuotient(weight), at.product);
      at.all.solve_in_time(at.product, result);
      result.array() *= weight.array();
    };
    const auto none = [](const Eigen::VectorXd& r, Eigen::VectorXd& z) { z = r; };
    const Eigen::VectorXd right = at.answer.cwiseProduct(weight);
    const double enough = goal * right.norm();
    const auto report = at.gmres.solve(apply, none, right, enough, most, at.scaled);
    at.answer = at.scaled.cwiseQuotient(weight);
    size = at.moved.norm(at.answer);
    return report.residual <= enough;
  }
};

ChosenOrders::ChosenOrders(const Parameters& parameters, const AdaptiveSettings& settings,
                           const OperationBudget& budget)
    : parameters_(parameters), settings_(settings), budget_(budget)
{
  NewtonSettings& newton = settings_.newton;
  newton.tolerance = std::max(newton.tolerance, 1e-2 * settings.tolerance);
  newton.most_iterations = std::min(newton.most_iterations, 12);
  newton.most_halvings = std::min(newton.most_halvings, 4);
}

ChosenOrders::~ChosenOrders() = default;

bool ChosenOrders::serves(const Parameters& parameters)
{
  return !parameters.large && parameters.bearing.is_plain() &&
         has_rotation_period(parameters.bearing);
}

ChosenOrders::Grid& ChosenOrders::grid(int samples)
{
  std::unique_ptr<Grid>& grid = grids_[samples];
  if (!grid)
    grid = std::make_unique<Grid>(bearing_problem(parameters_, samples, budget_));
  return *grid;
}

ChosenOrders::Grid& ChosenOrders::finer_than(const Grid& at)
{
  return grid(finer_samples(at.problem.samples));
}

Eigen::MatrixXd ChosenOrders::left_out_by(Grid& at, const Eigen::VectorXd& x,
                                          double omega)
{
  Grid& finer = finer_than(at);
  const long before = finer.all.evaluations();
  Eigen::MatrixXd bodies = finer.left_out_by(at, x, parameters_, omega);
  result_.force_samples += (finer.all.evaluations() - before) * finer.problem.samples;
  return bodies;
}

AdaptiveMotion ChosenOrders::solve(double omega, const Eigen::VectorXd& x, From from)
{
  constexpr int first = 3, most_rounds = 5, most_failures = 2, finer = 4;
  constexpr double far = 10;
  result_ = {};
  settings_.newton.by_next_step = from == From::predictor;
  /** To begin with, the contact's frequency and the passing of a ball along the rotor are among the orders of the samples. */
  const int turns = parameters_.turns;
  const Bearing& bearing = parameters_.bearing;
  const double contact = contact_frequency(parameters_) / omega,
               passing = bearing.balls * (turns - bearing.cage_speed_ratio),
               highest = std::max(1.2 * contact, passing) + 2;
  const int least =
      rounded_up(3 * static_cast<int>(std::clamp(highest, 8.0, 64.0 * turns)));
  if (from == From::guess)
    samples_ = least;
  else if (samples_ >= 2 * least || (from == From::integration && samples_ < least))
    samples_ = std::max(samples_ / 2, least);
  if (from == From::guess || orders_.empty()) {
    orders_ = {0};
    for (int h = 1; h <= first; ++h) {
      orders_.push_back(h);
      if (parameters_.turns > first) orders_.push_back(h * parameters_.turns);
    }
    std::ranges::sort(orders_);
  }
  samples_ = std::max(samples_, rounded_up(3 * orders_.back() + 2));
  /** With more samples where they are too few, while the error, which falls at least as N^{-2} and mostly as N^{-5/2}, may
      still reach the tolerance; from an integrated motion, which is near, also where no steps converge. */
  const auto on_all = [&](Eigen::VectorXd& at) {
    int failures = from == From::integration ? 0 : most_failures;
    while (!solve_on_all(omega, at)) {
      const bool is_found = result_.motion.found();
      const double error = is_found ? result_.motion.error->larger() : 0;
      const double more =
          static_cast<double>(finer) * settings_.most_harmonics / grid(samples_).count;
      if ((!is_found && failures++ == most_failures) || more <= 1 ||
          error > more * more * settings_.tolerance)
        return false;
      samples_ *= error > far * settings_.tolerance && more >= 4 ? 4 : 2;
    }
    return true;
  };
  Eigen::VectorXd start = x;
  OnFew end = from == From::integration ? OnFew::needs_all : OnFew::more_orders;
  int rounds = 0;
  for (; end == OnFew::more_orders && rounds < most_rounds && orders_.size() <= few + 1;
       ++rounds)
    end = solve_on_few(omega, start);
  /** From a predictor that fails at once on few orders steps on all do not converge either: mostly the solution has jumped. */
  has_jumped_ = end == OnFew::not_found && rounds == 1 && from == From::predictor;
  if (end != OnFew::reached && !has_jumped_) on_all(start);
  return std::move(result_);
}

/** On the chosen orders, measured at `samples_`, where `x` then is the better start. */
ChosenOrders::OnFew ChosenOrders::solve_on_few(double omega, Eigen::VectorXd& x)
{
  constexpr int fewest = 32, most_steps = 4;
  constexpr double most_left = 0.25, small = 0.02, ratio_before_steps = 0.7;
  const int samples = std::max(fewest, rounded_up(4 * orders_.back() + 2));
  if (!balance_ || balance_->problem().samples != samples || orders_ != on_)
    balance_ = std::make_unique<Balance>(grid(samples).problem, harmonics_of(orders_));
  on_ = orders_;
  PeriodicMotion motion = rotor_stator::solve(
      *balance_, omega, gathered(series_of(x), orders_).reshaped(), settings_.newton);
  result_.force_samples += motion.force_samples;
  if (!motion.found()) {
    result_.end =
        format("with %zu orders: ", orders_.size() - 1) + motion.newton.reason();
    return OnFew::not_found;
  }
  motion.bodies = spread(body_series(parameters_, motion), orders_);
  motion.force = spread(motion.force, orders_);
  motion.x = spread(series_of(motion.x), orders_).reshaped();
  motion.harmonics = Harmonics(orders_.back());

  Grid& at = grid(samples_);
  const long before = at.all.evaluations();
  const double largest = at.largest(motion.bodies), total = vibration(motion.bodies),
               most = accepted * settings_.tolerance;
  at.moved.refresh(parameters_, omega, at.count);
  const Eigen::VectorXd first = resize_harmonics(motion.x, 2, at.count);
  Steps steps(at, omega, first);
  Eigen::MatrixXd off;
  double displacement = 0, rms = 0, sampled = 0;
  const auto measure = [&] {
    const Eigen::MatrixXd sampling = left_out_by(at, steps.x, omega);
    Grid& finer = finer_than(at);
    off = sampling;
    off.leftCols(2 * at.count + 1) += at.moved.series(first - steps.x + at.answer);
    const double sampled_most = over(beyond * finer.largest(sampling), largest),
                 sampled_rms = over(beyond * vibration(sampling), total);
    sampled = std::max(sampled_most, sampled_rms);
    displacement = over(finer.largest(off), largest) + sampled_most;
    rms = over(vibration(off), total) + sampled_rms;
  };
  /** Whether the error is below the tolerance even if each further step is `ratio` times the one before: then none is taken,
      and the estimate is so much larger, in displacement by the part by which all orders together are. */
  const auto is_clear = [&](double ratio) {
    if (!(ratio <= ratio_before_steps)) return false;
    const double further = steps.size * ratio / (1 - ratio),
                 moved = at.moved.norm(first - steps.x + at.answer);
    if (!(moved + further <= most * total)) return false;
    measure();
    displacement *= 1 + over(further, moved);
    rms += over(further, total);
    return std::max(displacement, rms) <= most;
  };
  bool is_settled = is_clear(ratio_before_steps);
  int taken = 0;
  for (; taken < most_steps && !is_settled && steps.take(); ++taken) {
    is_settled = steps.size <= std::max(most_left * at.moved.norm(first - steps.x),
                                        small * settings_.tolerance * total);
    if (is_settled)
      measure();
    else
      is_settled = is_clear(steps.ratio);
  }
  result_.force_samples += (at.all.evaluations() - before) * samples_;
  if (!is_settled) {
    result_.end =
        format("the error with %zu orders cannot be estimated", orders_.size() - 1);
    return OnFew::needs_all;
  }
  x = steps.x - at.answer;
  const Grid& finer = finer_than(at);
  motion.error = {.displacement = displacement,
                  .rms = rms,
                  .settled = true,
                  .harmonics = finer.count,
                  .samples = finer.problem.samples,
                  .force_samples = 0};
  result_.reached = std::max(displacement, rms) <= most;
  result_.motion = std::move(motion);
  result_.end = format("the error with %zu orders is estimated as %.2g",
                       orders_.size() - 1, result_.motion.error->larger());
  Eigen::MatrixXd bodies = -off.leftCols(2 * at.count + 1);
  bodies.leftCols(result_.motion.bodies.cols()) += result_.motion.bodies;
  const Largest needed(bodies, largest, unnoticed * settings_.tolerance);
  if (result_.reached) {
    if (fall * sampled < most_sampled * settings_.tolerance && samples_ >= 2 * fewest)
      samples_ /= 2;
    std::erase_if(orders_, [&](int h) {
      return !std::binary_search(needed.orders.begin(), needed.orders.end(), h);
    });
    return OnFew::reached;
  }
  if (sampled > most_sampled * most) samples_ *= 2;
  std::vector<int> more;
  std::set_difference(needed.orders.begin(), needed.orders.end(), orders_.begin(),
                      orders_.end(), std::back_inserter(more));
  if (more.empty() || (taken <= 1 && needed.orders.size() > few + few / 2))
    return OnFew::needs_all;
  /** The largest few at once: after a poor solution all look large. */
  std::ranges::stable_sort(more, std::greater(),
                           [&](int h) { return size_of(bodies, h); });
  more.resize(std::min(more.size(), std::max<std::size_t>(4, orders_.size() / 2)));
  orders_.insert(orders_.end(), more.begin(), more.end());
  std::ranges::sort(orders_);
  return OnFew::more_orders;
}

/** On all orders of the samples, of which those are kept that the tolerance may notice. */
bool ChosenOrders::solve_on_all(double omega, Eigen::VectorXd& x)
{
  constexpr int most_steps = 14;
  constexpr double converged = 0.03, fast = 0.2;
  Grid& at = grid(samples_);
  const long before = at.all.evaluations();
  at.moved.refresh(parameters_, omega, at.count);
  Steps steps(at, omega, resize_harmonics(x, 2, at.count));
  const auto motion_at = [&] {
    PeriodicMotion motion{.omega = omega,
                          .harmonics = at.all.harmonics(),
                          .samples = samples_,
                          .x = steps.x,
                          .force = at.all.force(steps.x, omega)};
    motion.bodies = body_series(parameters_, motion);
    return motion;
  };
  const double enough = converged * settings_.tolerance * vibration(motion_at().bodies);
  /** A step with old factors may be short by chance, or blind to a part of the error. Where steps shrink fast, two short ones
      in a row are enough; elsewhere Newton's own step must be short. */
  int taken = 0, short_ones = 0;
  bool is_found = false;
  for (; taken < most_steps && !is_found && steps.take(); ++taken) {
    const bool is_short = steps.size * steps.ratio <= (1 - steps.ratio) * enough;
    short_ones = is_short ? short_ones + 1 : 0;
    is_found = short_ones == 2;
    if (!is_short || steps.ratio <= fast) continue;
    if (!steps.is_fresh) steps.refactor();
    is_found = steps.iterate() && steps.size <= enough;
  }
  result_.reached = false;
  result_.end = format("the steps with %d samples do not converge", samples_);
  result_.motion = {};
  if (is_found) {
    steps.x -= at.answer;
    x = steps.x;
    PeriodicMotion motion = motion_at();
    motion.newton = {
        .end = NewtonEnd::converged,
        .iterations = taken + 1,
        .delta_1 = at.all.residual(x, omega).norm() / at.problem.residual_scale,
        .delta_2 = at.answer.norm() / at.problem.unknown_scale};
    const double largest = at.largest(motion.bodies), total = vibration(motion.bodies);
    const Eigen::MatrixXd off = left_out_by(at, x, omega);
    Grid& finer = finer_than(at);
    const Largest needed(motion.bodies, largest, unnoticed * settings_.tolerance);
    const double displacement = over((1 + beyond) * finer.largest(off), largest),
                 rms = over((1 + beyond) * vibration(off), total);
    motion.error = {.displacement = displacement + needed.displacement +
                                    converged * settings_.tolerance,
                    .rms = rms + needed.rms + converged * settings_.tolerance,
                    .settled = true,
                    .harmonics = finer.count,
                    .samples = finer.problem.samples,
                    .force_samples = 0};
    result_.reached = motion.error->larger() <= accepted * settings_.tolerance &&
                      needed.orders.back() <= settings_.most_harmonics;
    result_.end = format("the error with %zu orders is estimated as %.2g",
                         needed.orders.size() - 1, motion.error->larger());
    const std::vector<int>& kept = needed.orders;
    /** At the next speed the largest of them are tried first. */
    orders_ = kept;
    std::ranges::stable_sort(orders_, std::greater(), [&](int h) {
      return h == 0 ? largest : size_of(motion.bodies, h);
    });
    orders_.resize(std::min<std::size_t>(orders_.size(), few + 1));
    std::ranges::sort(orders_);
    motion.bodies = spread(gathered(motion.bodies, kept), kept);
    motion.force = spread(gathered(motion.force, kept), kept);
    motion.x = spread(gathered(series_of(x), kept), kept).reshaped();
    motion.harmonics = Harmonics(kept.back());
    result_.motion = std::move(motion);
  }
  result_.force_samples += (at.all.evaluations() - before) * at.problem.samples;
  return result_.reached;
}

}  // namespace rotor_stator
