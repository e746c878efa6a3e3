#include "costs/equal_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/errors.hpp"
#include "io/program.hpp"

namespace rotor_stator::costs {

/** The T-periodic speeds of each range with their references; no empty range. */
static std::vector<References> periodic_ranges(const EqualErrorScene& scene,
                                               const References& references)
{
  std::vector<References> ranges(scene.range_ends.size(), {{scene.parameters, {}}, {}});
  for (const TrueMotion& truth : references.truths) {
    if (!truth.periodic) continue;
    const auto end = std::ranges::lower_bound(scene.range_ends, truth.frequency);
    References& range = ranges.at(end - scene.range_ends.begin());
    range.frequencies.push_back(truth.frequency);
    range.truths.push_back(truth);
  }
  std::erase_if(ranges, [](const References& range) { return range.truths.empty(); });
  return ranges;
}

/** The settings of one method in one range, group by group. */
static std::vector<Measurement> try_settings(const EqualErrorScene& scene,
                                             const References& range,
                                             const Candidates& candidates)
{
  constexpr double clearly = 1.3;
  std::vector<Measurement> tried;
  double used = 0, least = std::numeric_limits<double>::infinity();
  for (const SettingGroup& group : watched(candidates.method, candidates.groups))
    for (const Setting& setting : group) {
      if (used > scene.search) return tried;
      tried.push_back(measure(range, setting, 1));
      const double cpu = tried.back().median;
      used += cpu;
      if (tried.back().*scene.error <= scene.targets.back()) least = std::min(least, cpu);
      if (cpu > clearly * least) break;
    }
  return tried;
}

/** The least CPU over all speeds, one of the settings `allowed` at each; a speed whose
    setting is not that of the speed before costs a median speed of it more, for the start
    and the factors that a change loses. Empty where a speed has none. */
static std::vector<std::size_t> least_path(const std::vector<Measurement>& tried,
                                           const std::vector<std::vector<bool>>& allowed)
{
  constexpr double never = std::numeric_limits<double>::infinity();
  const std::size_t speeds = allowed.size(), settings = tried.size();
  std::vector<double> change;
  for (const Measurement& trial : tried) {
    std::vector<double> seconds = trial.seconds;
    std::ranges::nth_element(seconds, seconds.begin() + seconds.size() / 2);
    change.push_back(seconds[seconds.size() / 2]);
  }
  std::vector<double> least(settings, 0);  // to this speed, with this setting there
  std::vector<std::vector<std::size_t>> before(speeds);
  for (std::size_t k = 0; k < speeds; ++k) {
    const std::size_t best = std::ranges::min_element(least) - least.begin();
    const std::vector<double> last = least;
    for (std::size_t i = 0; i < settings; ++i) {
      const double changed = last[best] + (k > 0 ? change[i] : 0);
      before[k].push_back(last[i] <= changed ? i : best);
      least[i] = allowed[k][i] ? std::min(last[i], changed) + tried[i].seconds[k] : never;
    }
  }
  std::size_t one = std::ranges::min_element(least) - least.begin();
  if (!(least[one] < never)) return {};
  std::vector<std::size_t> path(speeds);
  for (std::size_t k = speeds; k-- > 0; one = before[k][one]) path[k] = one;
  return path;
}

/** The settings that stay below the target at their speeds and take the least CPU
    together. A speed that misses the target among its new neighbours takes another
    one. */
static std::optional<Schedule> schedule_by_speed(const EqualErrorScene& scene,
                                                 const References& range,
                                                 const std::vector<Measurement>& tried,
                                                 double target)
{
  constexpr int attempts = 12;
  const std::size_t speeds = range.frequencies.size();
  std::vector<std::vector<bool>> allowed(speeds);
  for (std::size_t k = 0; k < speeds; ++k)
    for (const Measurement& trial : tried)
      allowed[k].push_back(trial.errors[k].*scene.error <= target);
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const std::vector<std::size_t> path = least_path(tried, allowed);
    if (path.empty()) return {};
    std::vector<Setting> settings;
    for (std::size_t k = 0; k < speeds; ++k)
      settings.push_back(tried[path[k]].schedule.at(k));
    const Schedule schedule(settings);
    const Measurement whole = measure(range, schedule, 1);
    if (whole.*scene.error <= target) return schedule;
    for (std::size_t k = 0; k < speeds; ++k)
      if (!(whole.errors[k].*scene.error <= target)) allowed[k][path[k]] = false;
  }
  return {};
}

/** Of the settings tried. */
static EqualErrorRow cheapest(const EqualErrorScene& scene, const References& range,
                              const std::vector<Measurement>& tried, double target)
{
  constexpr std::size_t few = 4;
  std::vector<Measurement> good = tried;
  std::erase_if(good, [&](auto& m) { return !(m.*scene.error <= target); });
  std::ranges::sort(good, {}, &Measurement::median);
  if (good.size() > few) good.erase(good.begin() + few, good.end());
  for (Measurement& m : good) m = measure(range, m.schedule, scene.repetitions);
  if (const auto schedule = schedule_by_speed(scene, range, tried, target))
    good.push_back(measure(range, *schedule, scene.repetitions));
  return {good.empty() ? *std::ranges::min_element(
                             tried, {}, [&](auto& m) { return m.*scene.error; })
                       : *std::ranges::min_element(good, {}, &Measurement::median),
          format("%g-%g", range.frequencies.front(), range.frequencies.back()),
          range.frequencies.size(),
          tried.size(),
          target,
          !good.empty()};
}

std::vector<EqualErrorRow> at_equal_error(const EqualErrorScene& scene,
                                          const References& references)
{
  std::vector<EqualErrorRow> rows;
  for (const References& range : periodic_ranges(scene, references))
    for (const Candidates& method : watched("methods", scene.candidates)) {
      const std::vector<Measurement> tried = try_settings(scene, range, method);
      for (double target : scene.targets) {
        rows.push_back(cheapest(scene, range, tried, target));
        EqualErrorRow& row = rows.back();
        for (const EqualErrorRow& aft : rows)
          if (aft.schedule.method() == "aft" && aft.reached && aft.range == row.range &&
              aft.target == target)
            row.ratio = row.median / aft.median;
      }
    }
  return rows;
}

Setting cheapest_rk4(const std::vector<Setting>& settings, const References& references,
                     const MotionError& target)
{
  if (!std::isfinite(target.displacement))
    throw NoSolution(
        format("no harmonic-balance solution at %g Hz", target.worst_frequency));
  for (const Setting& setting : watched("RK4 settings", settings)) {
    const MotionError error = measure(references, setting, 1);
    if (error.displacement <= target.displacement && error.force <= target.force)
      return setting;
  }
  throw NoSolution(
      format("no tried RK4 setting reaches the errors %.2g of displacement and %.2g of "
             "force",
             target.displacement, target.force));
}

}  // namespace rotor_stator::costs
