#include "motion/quasi_periodic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "balance/bearing_problem.hpp"
#include "balance/torus_line.hpp"
#include "io/errors.hpp"
#include "motion/answer.hpp"
#include "motion/lines.hpp"
#include "time/flow.hpp"

namespace rotor_stator::motion {

namespace {

/** The smallest |a| + 2|b| + 2|c| for which a line is that of aX + b BPFO + c BPFI
    (motion/lines.hpp). */
double length_of_name(Harmonic h, const Bearing& bearing)
{
  double least = std::abs(h.k_1) + 2 * std::abs(h.k_2);
  for (double c = -h.k_2 - 8; c <= -h.k_2 + 8; ++c)
    least = std::min(least, std::abs(h.k_1 - c * bearing.balls) +
                                2 * std::abs(h.k_2 + c) + 2 * std::abs(c));
  return least;
}

/** Those whose orders differ by more than half a main lobe, the shortest names first; as
    places in the list. */
std::vector<int> distinct(const Harmonics& harmonics, const Bearing& bearing,
                          double main_lobe)
{
  const std::vector<Harmonic>& list = harmonics.list();
  std::vector<double> lengths, orders{0};
  for (const Harmonic h : list) lengths.push_back(length_of_name(h, bearing));
  std::vector<int> places(list.size() - 1);
  std::iota(places.begin(), places.end(), 1);
  std::ranges::stable_sort(places, {}, [&](int h) { return lengths[h]; });
  std::erase_if(places, [&](int h) {
    const double order = order_of(list[h], bearing);
    const bool is_near = std::ranges::any_of(
        orders, [&](double other) { return std::abs(order - other) < main_lobe / 2; });
    if (!is_near) orders.push_back(order);
    return is_near;
  });
  return places;
}

/** The integral over a record with a window of Blackman and Harris, at any frequency:
    from a transform so fine that a polynomial of degree 7 through its nearest values has
    it to 1e-8. */
class FineTransform {
public:
  /** Of samples times the window. */
  explicit FineTransform(const Eigen::VectorXd& weighted)
  {
    Eigen::VectorXd padded = Eigen::VectorXd::Zero(finer * weighted.size());
    padded.head(weighted.size()) = weighted;
    FourierTransform transform(static_cast<int>(padded.size()));
    values_ = transform.spectrum(padded) * static_cast<double>(padded.size());
    for (Eigen::Index p = 0; p < values_.size(); ++p)
      values_[p] *= std::polar(1.0, half_record(static_cast<double>(p)));
  }

  /** Of e^{-iφ}, φ going round `turns` times in the record; 0 where the samples do not
      resolve it. */
  std::complex<double> operator()(double turns) const
  {
    constexpr double weights[] = {1, -7, 21, -35, 35, -21, 7, -1};
    const double at = turns * finer;
    const auto first = static_cast<Eigen::Index>(std::floor(at)) - 3;
    if (first + 8 > values_.size()) return 0;
    std::complex<double> above = 0;
    double below = 0;
    for (int k = 0; k < 8; ++k) {
      const Eigen::Index p = first + k;
      const auto value = p < 0 ? std::conj(values_[-p]) : values_[p];
      const double distance = at - static_cast<double>(p);
      if (std::abs(distance) < 1e-9) return value * std::polar(1.0, -half_record(at));
      above += weights[k] / distance * value;
      below += weights[k] / distance;
    }
    return above / below * std::polar(1.0, -half_record(at));
  }

private:
  static constexpr int finer = 8;

  /** Counted from the middle of the record the values are smooth. */
  static double half_record(double at) { return std::numbers::pi * at / finer; }

  Eigen::VectorXcd values_;
};

constexpr int compared_turns = 100;

bool is_whole(Harmonic h)
{
  return h.k_1 == std::round(h.k_1) && h.k_2 == std::round(h.k_2);
}

/** Of a solution from a record. A torus that has doubled is two motions, one a turn or a
    passage after the other: the nearer one counts. */
Error distance(const Parameters& parameters, PeriodicMotion solution,
               const Motion& record)
{
  const int points = record.points_per_period,
            turns = static_cast<int>(record.size()) / points;
  const auto off = [&] {
    return difference(as_one_period(motion_of(parameters, solution, points, turns,
                                              record.first_period)),
                      as_one_period(record));
  };
  const Error one = off();
  if (solution.line.turns == 1) return one;
  for (int h = 1; h <= solution.harmonics.count(); ++h)
    if (!is_whole(solution.harmonics.list()[h]))
      solution.bodies.middleCols(2 * h - 1, 2) *= -1;
  const Error other = off();
  return one.larger() < other.larger() ? one : other;
}

/** The force has lines that inertia keeps out of the motion, here all up to order 40:
    sampled, none of these may fall on one that is kept. */
Harmonics lines_of_force(const Bearing& bearing, Harmonic half = {})
{
  return up_to(40, 8, bearing, half);
}

/** Newton on these harmonics, along a line on which others do not disturb them. */
PeriodicMotion solved_on(const TorusSearch& search, const Harmonics& kept,
                         const Harmonics& others, int line_turns, Eigen::VectorXd x,
                         const std::string& start)
{
  constexpr int least_samples = 4096, samples_each = 16;
  const TorusLine line = line_without_images(
      kept, others, std::max(least_samples, samples_each * kept.count()), line_turns);
  Balance balance(bearing_problem(search.parameters, line, search.budget), kept);
  BalanceSolver solver(balance, true);
  PeriodicMotion motion{.omega = search.omega, .x = std::move(x), .start = start};
  if (solve(balance, solver, motion, search.newton))
    motion.bodies = body_series(search.parameters, motion);
  return motion;
}

/** What Eq. 7 settles on from rest, with its lines. */
struct SettledTorus {
  static constexpr int turns = 1280;  ///< of the record

  const TorusSearch& search;
  const Parameters& parameters = search.parameters;
  Answer compared = {};   ///< with solutions, and how exact it is, if that is wanted
  long first_period = 0;  ///< of the record
  std::vector<FineTransform> transforms = {};  ///< of the relative motions [m]

  explicit SettledTorus(const TorusSearch& wanted, double step_ratio = 1,
                        bool is_compared = false)
      : search(wanted)
  {
    /** Twice as many as the highest order that is looked for. */
    const double contact = contact_frequency(parameters) / search.omega;
    const int points = contact < 40 ? 128 : 256;
    Request request{.omega = search.omega, .points = points, .step_ratio = step_ratio};
    const Answer rest = settled_answer(
        {.parameters = parameters,
         .request = request,
         .budget = search.budget,
         .transient_share = parameters.bodies->patience().transient_share});
    if (!rest.settled.contracts)
      throw NoSolution(
          format("the motion from rest is %s, without lines that a branch could follow; "
                 "response without --method has its amplitudes",
                 word(rest.kind())));
    const auto completed = [&](int periods, bool is_measured) {
      Answer answer = rest;
      request.periods = periods;
      request.is_measured = is_measured;
      complete(answer, request, search.budget);
      return answer;
    };
    const Motion record = completed(turns, false).motion;
    first_period = record.first_period;
    if (is_compared) compared = completed(compared_turns, true);
    if (is_compared && !compared.error)
      throw NoSolution("the error of the integrated motion needs more than the budget");
    const Eigen::MatrixXd samples = relative_samples(parameters, record);
    const Eigen::VectorXd window = blackman_harris(samples.rows());
    for (const auto& column : samples.colwise())
      transforms.emplace_back(column.cwiseProduct(window));
  }

  /** The amplitudes of its lines as coefficients of the relative motions [m]; of lines
      that the window cannot tell apart the one with the shortest name is taken. */
  Eigen::VectorXd lines(const Harmonics& harmonics) const
  {
    Eigen::MatrixXd series = Eigen::MatrixXd::Zero(dofs(), harmonics.coefficients());
    for (int i = 0; i < dofs(); ++i) series(i, 0) = transforms[i](0).real();
    for (int h : distinct(harmonics, parameters.bearing, 8.0 / turns)) {
      const double order = order_of(harmonics.list()[h], parameters.bearing);
      const double since = std::fmod(order * static_cast<double>(first_period), 1.0);
      const auto wave = std::polar(2.0, -2 * std::numbers::pi * since);
      SmallVector line(dofs());
      for (int i = 0; i < dofs(); ++i) line[i] = wave * transforms[i](order * turns);
      put_amplitude(series, h, line);
    }
    return series.reshaped();
  }

  struct Lines {
    Harmonic half;
    Harmonics harmonics;
    Eigen::VectorXd x = {};
    double halves = 0, all = 0;  ///< norms of those that are not whole, and of all
  };

  /** All its lines. A torus that has doubled has some at all whole pairs moved by one
      half: that where they are largest. */
  Lines all_lines() const
  {
    constexpr double noticed = 1e-3;
    Lines all = lines_moved_by({});
    for (const Harmonic half : {Harmonic{0.5, 0}, Harmonic{0, 0.5}, Harmonic{0.5, 0.5}}) {
      Lines moved = lines_moved_by(half);
      if (moved.halves > std::max(all.halves, noticed * moved.all))
        all = std::move(moved);
    }
    return all;
  }

  /** The solution on the `count` largest of them. */
  PeriodicMotion solution(const Lines& all, int count) const
  {
    std::vector<int> places;
    for (int h = 1; h <= all.harmonics.count(); ++h)
      if (size(all, h) > 0) places.push_back(h);
    std::ranges::stable_sort(places, std::greater{}, [&](int h) { return size(all, h); });
    places.resize(std::min(places.size(), static_cast<std::size_t>(count)));
    std::ranges::sort(places);
    std::vector<Harmonic> list{{0, 0}};
    for (int h : places) list.push_back(all.harmonics.list()[h]);
    const Harmonics kept(std::move(list));
    return solved_on(search, kept, lines_of_force(parameters.bearing, all.half),
                     all.halves > 0 ? 2 : 1, project(all.x, dofs(), all.harmonics, kept),
                     "time integration");
  }

  int dofs() const { return static_cast<int>(transforms.size()); }

  double size(const Lines& lines, int h) const
  {
    return lines.x.segment((2 * h - 1) * dofs(), 2 * dofs()).norm();
  }

  /** Whole pairs, and those moved by `half`. */
  Lines lines_moved_by(Harmonic half) const
  {
    constexpr double beyond_contact = 1.3, least = 40, most = 120;
    constexpr int passages = 16;
    const double contact = contact_frequency(parameters) / search.omega;
    const double highest = std::clamp(beyond_contact * contact, least, most);
    Lines all{half, up_to(highest, passages, parameters.bearing, half)};
    all.x = lines(all.harmonics);
    for (int h = 1; h <= all.harmonics.count(); ++h) {
      all.all = std::hypot(all.all, size(all, h));
      if (!is_whole(all.harmonics.list()[h]))
        all.halves = std::hypot(all.halves, size(all, h));
    }
    return all;
  }
};

/** Without a tolerance a solution is of the motion that integration from it comes to,
    where that is so near. */
constexpr double near = 0.05;

/** What Eq. 7 makes of the solution: it is integrated from there by `settle`, with steps
    so many times as long as `step_at`. */
void add_verdict(const TorusSearch& search, double tolerance, double step_ratio,
                 Torus& torus)
try {
  constexpr int points = 64;
  const Parameters& parameters = search.parameters;
  const double omega = search.omega;
  TorusVerdict verdict{.settled =
                           settle(parameters, omega, base_period(parameters),
                                  {state_of(parameters, torus.motion), 0},
                                  {.step = step_ratio * step_at(parameters, omega)},
                                  search.budget.part(0.8))};
  const Settled& settled = verdict.settled;
  /** With error control, from so much earlier that those of fixed steps are forgotten. */
  const auto stepper =
      flow(parameters, omega,
           {.intervals_per_period = points, .tolerance = 1e-9, .budget = search.budget});
  const Instant& from = settled.contracts ? settled.before : settled.at;
  State state = from.state;
  const long first = settled.at.period;
  for (long k = from.period * points; k < first * points; ++k) stepper->advance(k, state);
  verdict.record = recorded(*stepper, points, state, first, compared_turns);
  verdict.distance = distance(parameters, torus.motion, verdict.record);
  verdict.stays = verdict.distance.larger() <= tolerance;
  verdict.evaluations = settled.evaluations + static_cast<double>(stepper->evaluations());
  torus.error = verdict.distance;
  torus.verdict = std::move(verdict);
} catch (const NoSolution& none) {
  torus.end = none.what();
}

/** A solution that is taken as it is. */
Torus judged(const TorusSearch& search, PeriodicMotion motion)
{
  Torus torus{.motion = std::move(motion)};
  torus.reached = torus.motion.found();
  torus.end = torus.motion.newton.reason();
  if (torus.reached && search.stability) add_verdict(search, near, 1, torus);
  return torus;
}

}  // namespace

Eigen::VectorXd half_peak_to_peak_of_torus(const Parameters& parameters,
                                           const PeriodicMotion& solution)
{
  FourierTransform transform(solution.samples);
  Eigen::MatrixXd samples;
  transform.to_samples(body_series(parameters, solution), samples,
                       solution.harmonics.images(solution.line, solution.samples));
  return 0.5 * (samples.colwise().maxCoeff() - samples.colwise().minCoeff());
}

Torus torus_on_orders(const TorusSearch& search, int m)
{
  const Parameters& parameters = search.parameters;
  const Harmonics kept = orders_up_to(m, parameters.bearing),
                  others = lines_of_force(parameters.bearing);
  const int dofs = 2 * static_cast<int>(joints_of(parameters).size());
  const Eigen::VectorXd x =
      project(quasi_static_start(parameters, search.omega, m), dofs, Harmonics(m), kept);
  PeriodicMotion motion = solved_on(search, kept, others, 1, x, "quasi-static contact");
  if (!motion.found())
    motion = solved_on(search, kept, others, 1, SettledTorus(search).lines(kept),
                       "time integration");
  return judged(search, std::move(motion));
}

Torus torus_on_lines(const TorusSearch& search, int lines)
{
  const SettledTorus settled(search);
  return judged(search, settled.solution(settled.all_lines(), lines));
}

Torus torus_to_tolerance(const TorusSearch& search, double tolerance)
{
  constexpr int first = 16, most = 256;
  Torus torus;
  try {
    const SettledTorus settled(search, step_ratio(tolerance), true);
    const auto all = settled.all_lines();
    Motion exact = settled.compared.motion;
    Error uncertain = *settled.compared.error;
    double before = std::numeric_limits<double>::infinity();
    for (int lines = first; lines <= most && !torus.reached; lines *= 2) {
      PeriodicMotion motion = settled.solution(all, lines);
      torus.end = format("with %d lines: ", lines) + motion.newton.reason();
      if (!motion.found()) continue;
      torus.motion = std::move(motion);
      torus.error = distance(search.parameters, torus.motion, exact);
      torus.error->largest += uncertain.largest;
      torus.error->rms += uncertain.rms;
      const bool is_far = torus.error->larger() > std::max(tolerance, before / 2);
      if (is_far || (!torus.verdict && search.stability)) {
        add_verdict(search, tolerance, step_ratio(tolerance), torus);
        if (!torus.verdict) break;
        exact = torus.verdict->record;
        uncertain = {};
      }
      before = torus.error->larger();
      torus.reached = before <= tolerance;
      torus.end = format(
          "with %d lines the solution is %.2g away from the motion that "
          "integration comes to",
          lines, before);
    }
    if (torus.verdict) torus.verdict->distance = *torus.error;
    if (torus.verdict) torus.verdict->stays = torus.reached;
  } catch (const NoSolution& none) {
    torus.end = none.what();
  }
  return torus;
}

}  // namespace rotor_stator::motion
