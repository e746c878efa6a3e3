#include "balance/chosen_harmonics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "balance/newton.hpp"
#include "io/errors.hpp"

namespace rotor_stator {

namespace {

Eigen::MatrixXd project_series(const Eigen::MatrixXd& series, const Harmonics& from,
                               const Harmonics& to)
{
  const auto rows = static_cast<int>(series.rows());
  return project(series.reshaped(), rows, from, to).reshaped(rows, to.coefficients());
}

/** The places of those with the same |k_2|: the contact turns with its load, so that a harmonic is
    coupled most with those two orders away. */
std::vector<std::vector<int>> by_passages(const Harmonics& harmonics)
{
  std::vector<std::vector<int>> parts;
  for (int h = 0; h <= harmonics.count(); ++h) {
    const auto k_2 = static_cast<std::size_t>(
        std::lround(std::abs(harmonics.list()[static_cast<std::size_t>(h)].k_2)));
    if (parts.size() <= k_2) parts.resize(k_2 + 1);
    parts[k_2].push_back(h);
  }
  std::erase_if(parts, [](const auto& part) { return part.empty(); });
  return parts;
}

struct Choosing {
  const Parameters& parameters;
  double omega;
  const AdaptiveSettings& settings;
  const SettledOn& settled;
  const OperationBudget& budget;
  const Bearing& bearing = parameters.bearing;

  /** Up to the contact's frequency under the usual load, and beyond. */
  double highest_order =
      std::max(8.0, std::min(0.5 * contact_frequency(parameters) / omega + 4, 30.0));
  int least_samples = settings.tolerance >= 1e-3 ? 1024 : 4096;
  /** A flexible shaft gives way to the contact at more orders than a mass does. */
  Harmonics passing =
      of_passages(bearing, parameters.machine->takes_explicit_steps() ? 16 : 32);
  Harmonics medium = up_to(highest_order, 4, bearing);
  Harmonics large =
      joined(joined(joined(up_to(1.3 * highest_order, 6, bearing), medium),
                    joined(up_to(1.5, 12, bearing), sidebands(bearing, 12, 4))),
             passing);
  TorusLine finest = line_without_images(large, large, 4 * least_samples);
  const int dofs = 2 * static_cast<int>(1 + parameters.further.size());
  AdaptiveMotion result = {};
  PeriodicMotion finer = {};  ///< on `large`, the harmonics kept first

  AdaptiveMotion run()
  {
    if (settled.only || !from_few()) from_settled();
    return std::move(result);
  }

  /** Whether a solution is found to the tolerance from the first harmonics. */
  bool from_few()
  {
    constexpr int most_rounds = 6;
    Harmonics kept = sidebands(bearing, 3, 1);
    Eigen::VectorXd x =
        project(quasi_static_start(parameters, omega, 3), dofs, Harmonics(3), kept);
    double share = 0.5;
    for (int round = 0; round < most_rounds; ++round) {
      if (!solve_on(kept, x, "quasi-static contact") || !estimate()) return false;
      if (result.reached) return true;
      kept = chosen(share * settings.tolerance, finer.harmonics, finer.bodies);
      x = project(finer.x, dofs, finer.harmonics, kept);
      share /= 3;
    }
    return false;
  }

  /** The same from the lines of what Eq. 7 settles on, of whole orders or also of halves; then from those of a later and
      longer record, which tells more of them apart. */
  void from_settled()
  {
    constexpr double chaos =
        0.03;  // so far from all lines, a longer record does not help
    std::string why;
    for (const bool is_longer : {false, true}) {
      if (is_longer && !(result.motion.error->larger() < chaos)) break;
      if (is_longer) settled.go_on();
      for (const int turns : {1, 2}) {
        const int passages = is_longer ? 16 : 8;
        take_lines(turns == 1 ? lines_with({}, passages) : lines_with_halves(passages),
                   turns);
        solve_on_largest();
        if (!result.reached) {
          why = result.end;
          result.motion = finer;
          measure();
        }
        if (result.reached) return drop_small();
      }
    }
    result.end = why + format("; with all %d lines of time integration it is %.2g",
                              finer.harmonics.count(), result.motion.error->larger());
  }

  struct SettledLines {
    Harmonics harmonics;
    Eigen::MatrixXd series;  ///< of the relative motions [m]

    /** Sum of the squares of those that are not whole. */
    double halves() const
    {
      double squares = 0;
      for (int h = 1; h <= harmonics.count(); ++h) {
        const auto [k_1, k_2] = harmonics.list()[static_cast<std::size_t>(h)];
        if (k_1 != std::round(k_1) || k_2 != std::round(k_2))
          squares += series.middleCols(2 * h - 1, 2).squaredNorm();
      }
      return squares;
    }
  };

  /** At whole pairs, and at those moved by `half`. */
  SettledLines lines_with(Harmonic half, int passages) const
  {
    constexpr double beyond_contact = 1.3, most = 120;
    const double contact = contact_frequency(parameters) / omega;
    const double order =
        std::max(2 * highest_order, std::min(beyond_contact * contact, most));
    const Harmonics all = joined(up_to(order, passages, bearing, half), passing);
    return {all, settled.lines(all).reshaped(dofs, all.coefficients())};
  }

  /** A torus that has doubled has lines at all whole pairs moved by one half: that where they are largest. */
  SettledLines lines_with_halves(int passages) const
  {
    std::vector<SettledLines> kinds;
    for (const Harmonic half : {Harmonic{0.5, 0}, Harmonic{0, 0.5}, Harmonic{0.5, 0.5}})
      kinds.push_back(lines_with(half, passages));
    return *std::ranges::max_element(kinds, {}, &SettledLines::halves);
  }

  /** Those that the tolerance may notice. */
  void take_lines(const SettledLines& lines, int turns)
  {
    constexpr int samples = 4096;
    constexpr double unnoticed = 0.03;
    const Harmonics all =
        chosen(unnoticed * settings.tolerance, lines.harmonics, lines.series);
    const TorusLine line = line_without_images(all, all, samples, turns);
    Balance balance(bearing_problem(parameters, line, budget), all);
    finer = {.omega = omega,
             .harmonics = all,
             .samples = line.samples,
             .line = line,
             .x = project(lines.series.reshaped(), dofs, lines.harmonics, all),
             .start = "the lines of time integration"};
    finer.newton = {.end = NewtonEnd::not_begun,
                    .delta_1 = balance.residual(finer.x, omega).norm() /
                               balance.problem().residual_scale};
    finer.force = balance.balancing_force(finer.x, omega);
    finer.bodies = body_series(parameters, finer);
  }

  void solve_on_largest()
  {
    constexpr int most = 120;
    const Harmonics kept = chosen(0, finer.harmonics, finer.bodies, most);
    if (solve_on(kept, project(finer.x, dofs, finer.harmonics, kept), "time integration"))
      measure();
  }

  /** Keeps those that the tolerance asks for, where the solution on them is good enough. */
  void drop_small()
  {
    const AdaptiveMotion whole = result;
    const PeriodicMotion& all = whole.motion;
    const Harmonics kept = chosen(0.3 * settings.tolerance, all.harmonics, all.bodies);
    const Eigen::VectorXd x = project(all.x, dofs, all.harmonics, kept);
    if (!all.found()) {
      PeriodicMotion& few = result.motion;
      few.x = x;
      few.force = project_series(all.force, all.harmonics, kept);
      few.bodies = project_series(all.bodies, all.harmonics, kept);
      few.harmonics = kept;
      measure();
    } else if (solve_on(kept, x, "time integration")) {
      measure();
    }
    if (!result.reached) result = whole;
  }

  void measure()
  {
    result.motion.error = settled.error(result.motion);
    conclude();
  }

  bool solve_on(const Harmonics& kept, const Eigen::VectorXd& x, const std::string& start)
  {
    const TorusLine line = line_without_images(
        kept, large, std::max(least_samples, 16 * kept.count()), finer.line.turns);
    Balance balance(bearing_problem(parameters, line, budget), kept);
    NewtonSettings newton = settings.newton;
    newton.tolerance = level_tolerance(settings);
    BalanceSolver solver(balance, true);
    PeriodicMotion motion{.omega = omega, .x = x};
    solve(balance, solver, motion, newton);
    result.force_samples += motion.force_samples;
    motion.start = start;
    result.reached = false;
    const bool found = motion.found();
    if (found) motion.bodies = body_series(parameters, motion);
    result.end = format("with %d harmonics: ", kept.count()) + motion.newton.reason();
    result.motion = std::move(motion);
    if (!found && finer.x.size() > 0) result.end += largest_dropped();
    return found;
  }

  /** Measures the solution on the large set. False where GMRES does not lead there. */
  bool estimate()
  {
    const PeriodicMotion& coarse = result.motion;
    Balance balance(bearing_problem(parameters, finest, budget),
                    joined(coarse.harmonics, large));
    BalanceSolver solver(balance, by_passages(balance.harmonics()));
    finer = {.omega = omega, .harmonics = balance.harmonics(), .samples = finest.samples};
    finer.x = project(coarse.x, dofs, coarse.harmonics, finer.harmonics);
    const Approached approached =
        approach(balance, solver, omega, level_tolerance(settings), finer.x, true);
    result.force_samples += balance.evaluations() * finest.samples;
    if (approached.settled) {
      finer.force = balance.force(finer.x, omega);
      finer.bodies = body_series(parameters, finer);
      finer.x += approached.next;
    }
    finer.newton.iterations = approached.steps;
    finer.newton.end = approached.settled ? NewtonEnd::converged : NewtonEnd::no_decrease;
    compare();
    return approached.settled;
  }

  /** The error of the solution against the finer one. */
  void compare()
  {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const PeriodicMotion& coarse = result.motion;
    ErrorEstimate error{.displacement = infinite,
                        .rms = infinite,
                        .settled = finer.found(),
                        .harmonics = finer.harmonics.count(),
                        .samples = finest.samples,
                        .force_samples = 0};
    if (error.settled) {
      const Eigen::MatrixXd off =
          project_series(coarse.bodies, coarse.harmonics, finer.harmonics) - finer.bodies;
      error.displacement = error.rms = 0;
      each_group(finer.bodies, [&](Eigen::Index row, Eigen::Index rows) {
        const Eigen::MatrixXd part = off.middleRows(row, rows),
                              of = finer.bodies.middleRows(row, rows);
        error.displacement = std::max(error.displacement, largest(part) / largest(of));
        error.rms = std::max(error.rms, vibration(part) / vibration(of));
      });
    }
    result.motion.error = error;
    conclude();
  }

  /** What the error says. */
  void conclude()
  {
    const PeriodicMotion& motion = result.motion;
    /** A part is left for what no candidate, or none of the instants compared, stands for. */
    const double share = motion.error->harmonics > 0 ? 0.75 : 0.9;
    result.reached =
        motion.error->settled && motion.error->larger() <= share * settings.tolerance;
    result.end = motion.error->settled
                     ? format("the error with %d harmonics is estimated as %.2g",
                              motion.harmonics.count(), motion.error->larger())
                     : format("the error with %d harmonics cannot be estimated",
                              motion.harmonics.count());
    if (!result.reached && finer.x.size() > 0) result.end += largest_dropped();
  }

  /** The largest of the large set that the solution does not have. */
  std::string largest_dropped() const
  {
    if (finer.bodies.size() == 0) return {};
    const auto& kept = result.motion.harmonics.list();
    double most = 0;
    Harmonic at{};
    for (int h = 1; h <= finer.harmonics.count(); ++h) {
      const Harmonic candidate = finer.harmonics.list()[static_cast<std::size_t>(h)];
      const double size = finer.bodies.middleCols(2 * h - 1, 2).norm();
      if (size <= most || std::ranges::find(kept, candidate) != kept.end()) continue;
      most = size;
      at = candidate;
    }
    if (most == 0) return "; the candidates are exhausted, none is dropped";
    return format("; the largest dropped harmonic is (%g, %g), %.2g of the vibration",
                  at.k_1, at.k_2, most / vibration(finer.bodies));
  }

  double largest(const Eigen::MatrixXd& series) const
  {
    Eigen::MatrixXd samples;
    FourierTransform(finest.samples)
        .to_samples(series, samples, finer.harmonics.images(finest, finest.samples));
    return samples.cwiseAbs().maxCoeff();
  }

  /** The fewest harmonics of a series without which the rms error stays below `off`, at most so many. */
  Harmonics chosen(double off, const Harmonics& all, const Eigen::MatrixXd& series,
                   std::size_t most = 1000) const
  {
    std::vector<std::pair<double, Harmonic>> by_size;
    for (int h = 1; h <= all.count(); ++h)
      by_size.push_back({series.middleCols(2 * h - 1, 2).squaredNorm(),
                         all.list()[static_cast<std::size_t>(h)]});
    std::ranges::sort(by_size, {}, &std::pair<double, Harmonic>::first);
    const double rest = off * vibration(series);
    double squares = 0;
    std::vector<Harmonic> list;
    for (std::size_t k = 0; k < by_size.size(); ++k) {
      const auto& [size, h] = by_size[k];
      squares += size;
      const bool counts = squares > rest * rest && k + most >= by_size.size();
      if (counts || h == Harmonic{1, 0}) list.push_back(h);
    }
    std::ranges::stable_sort(list, {}, [&](Harmonic h) { return order_of(h, bearing); });
    list.insert(list.begin(), {0, 0});
    return Harmonics(std::move(list));
  }
};

}  // namespace

AdaptiveMotion solve_on_chosen(const Parameters& parameters, double omega,
                               const AdaptiveSettings& settings, const SettledOn& settled,
                               const OperationBudget& budget)
{
  return Choosing{parameters, omega, settings, settled, budget}.run();
}

}  // namespace rotor_stator
