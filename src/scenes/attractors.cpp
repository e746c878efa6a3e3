#include "scenes/attractors.hpp"

#include <algorithm>
#include <bit>

#include "balance/bearing_problem.hpp"
#include "scenes/motion.hpp"
#include "scenes/regime.hpp"

namespace rotor_stator
{

namespace
{

/** A motion as it stands in a row of the journal. */
struct Entry {
  double frequency;
  double verdict, period;
  double spread, spread_k, exponent, error;
  std::array<double, 4> mean, rms, amplitude;
  State state;
  double seconds;
};
constexpr std::size_t entry_size = sizeof(Entry) / sizeof(double);
using FlatEntry = std::array<double, entry_size>;

void append(double frequency, const Attractor& a, Row& row)
{
  const SectionJudgement& j = a.judgement;
  const Entry entry{frequency,
                    static_cast<double>(j.verdict),
                    static_cast<double>(j.period),
                    j.spread,
                    j.spread_k,
                    j.exponent.value,
                    j.exponent.error,
                    a.mean,
                    a.rms,
                    a.amplitude,
                    a.state,
                    a.seconds};
  const auto flat = std::bit_cast<FlatEntry>(entry);
  row.insert(row.end(), flat.begin(), flat.end());
}

/** The motions of one piece of work, numbered later. */
std::vector<AttractorPoint> points_of(const Row& row, int set, Origin origin)
{
  std::vector<AttractorPoint> points;
  for (std::size_t at = 0; at + entry_size <= row.size(); at += entry_size) {
    FlatEntry flat;
    std::copy_n(row.begin() + static_cast<long>(at), entry_size, flat.begin());
    const auto e = std::bit_cast<Entry>(flat);
    const SectionJudgement judgement{static_cast<Verdict>(e.verdict),
                                     static_cast<int>(e.period),
                                     e.spread,
                                     e.spread_k,
                                     {e.exponent, e.error}};
    points.push_back({set,
                      e.frequency,
                      origin,
                      1,
                      0,
                      {judgement, e.mean, e.rms, e.amplitude, e.state, e.seconds}});
  }
  return points;
}

/** The whole range in one direction: each speed starts from the state where the last one ended. */
Row follow(const Parameters& parameters, std::vector<double> frequencies, Origin origin,
           const AttractorSettings& settings)
{
  if (origin == Origin::down) std::reverse(frequencies.begin(), frequencies.end());
  Row row;
  State state = static_start(parameters);
  for (double frequency : frequencies) {
    const Attractor attractor =
        attractor_from(parameters, angular(frequency), state, settings);
    state = attractor.state;
    append(frequency, attractor, row);
  }
  return row;
}

/** Every speed from the solution with few harmonics, where a sweep up finds one. */
Row from_sweep(const Parameters& parameters, const AttractorScene& scene)
{
  std::vector<double> omegas;
  for (double frequency : scene.frequencies) omegas.push_back(angular(frequency));
  const int m = scene.few_harmonics, samples = default_samples(m);
  Balance balance(bearing_problem(parameters, samples), m);
  Row row;
  sweep(
      balance, omegas,
      [&](double omega) { return quasi_static_start(parameters, omega, m); },
      sweep_settings(parameters),
      [&](const SweepPoint& point) {
        const PeriodicSolution solution{
            point.omega,
            m,
            samples,
            point.newton,
            {},
            point.x,
            body_series(parameters, balance, point.omega, point.x)};
        append(
            point.omega / angular(1),
            attractor_from(parameters, point.omega, state_of(solution), scene.settings),
            row);
      });
  return row;
}

/** Every speed from a solution with many harmonics, where there is one. */
Row from_solutions(const Parameters& parameters, const AttractorScene& scene)
{
  Row row;
  const int m = scene.many_harmonics;
  for (double frequency : scene.frequencies) {
    const double omega = angular(frequency);
    const auto solution = find_periodic(parameters, omega, m, default_samples(m));
    if (!solution.found()) continue;
    append(frequency,
           attractor_from(parameters, omega, state_of(solution), scene.settings), row);
  }
  return row;
}

/** One speed from random states. */
Row from_random(const AttractorScene& scene, std::size_t set, std::size_t speed)
{
  const Parameters& parameters = scene.sets[set];
  const double frequency = scene.random_frequencies[speed];
  Row row;
  for (int k = 0; k < scene.random_starts; ++k) {
    const std::uint64_t seed =
        ((static_cast<std::uint64_t>(scene.seed) * 64 + set) * 4096 + speed) * 64 +
        static_cast<std::uint64_t>(k);
    append(frequency,
           attractor_from(parameters, angular(frequency),
                          random_state(parameters, angular(frequency), seed),
                          scene.settings),
           row);
  }
  return row;
}

/** What piece `k` of the study is: three long chains of each set, the random starts, and the starts from
    many harmonics. */
struct Piece {
  std::size_t set;
  Origin origin;
  std::size_t speed;
};

Piece piece_of(const AttractorScene& scene, std::size_t k)
{
  const std::size_t sets = scene.sets.size();
  if (k < 3 * sets) return {k / 3, static_cast<Origin>(1 + k % 3), 0};
  k -= 3 * sets;
  const std::size_t speeds = scene.random_frequencies.size();
  if (k < sets * speeds) return {k / speeds, Origin::random, k % speeds};
  return {k - sets * speeds, Origin::many_harmonics, 0};
}

Row work_on(const AttractorScene& scene, const Piece& piece)
{
  const Parameters& parameters = scene.sets[piece.set];
  switch (piece.origin) {
    case Origin::few_harmonics:
      return from_sweep(parameters, scene);
    case Origin::many_harmonics:
      return from_solutions(parameters, scene);
    case Origin::random:
      return from_random(scene, piece.set, piece.speed);
    default:
      return follow(parameters, scene.frequencies, piece.origin, scene.settings);
  }
}

/** Numbers the attractors of one set and speed, and counts random starts with the same end as one
    point. Expects the points in the order of their origins. */
std::vector<AttractorPoint> numbered(const std::vector<AttractorPoint>& points,
                                     const AttractorSettings& settings)
{
  std::vector<AttractorPoint> kept;
  int attractors = 0;
  for (AttractorPoint point : points) {
    const auto known = std::find_if(kept.begin(), kept.end(), [&](const auto& other) {
      return same_attractor(point.attractor, other.attractor, settings);
    });
    point.number = known == kept.end() ? ++attractors : known->number;
    const auto same = std::find_if(kept.begin(), kept.end(), [&](const auto& other) {
      return other.number == point.number && other.origin == Origin::random;
    });
    if (point.origin == Origin::random && same != kept.end())
      ++same->starts;
    else
      kept.push_back(point);
  }
  return kept;
}

/** By set, speed and origin. */
bool before(const AttractorPoint& a, const AttractorPoint& b)
{
  if (a.set != b.set) return a.set < b.set;
  if (std::abs(a.frequency - b.frequency) > 1e-6) return a.frequency < b.frequency;
  return a.origin < b.origin;
}

}  // namespace

std::vector<AttractorPoint> compute_attractors(const AttractorScene& scene,
                                               const std::string& journal,
                                               const std::string& stamp)
{
  const std::size_t pieces = scene.sets.size() * (4 + scene.random_frequencies.size());
  const auto rows = run_study(
      {.name = "attractors",
       .journal = journal,
       .stamp = stamp,
       .pieces = pieces,
       .work = [&](std::size_t k) { return work_on(scene, piece_of(scene, k)); }});
  std::vector<AttractorPoint> all, result;
  for (std::size_t k = 0; k < pieces; ++k) {
    const Piece piece = piece_of(scene, k);
    for (auto& point : points_of(rows[k], static_cast<int>(piece.set) + 1, piece.origin))
      all.push_back(point);
  }
  std::stable_sort(all.begin(), all.end(), before);
  for (auto first = all.begin(); first != all.end();) {
    auto last = first;
    while (last != all.end() && last->set == first->set &&
           std::abs(last->frequency - first->frequency) < 1e-6)
      ++last;
    for (auto& point : numbered({first, last}, scene.settings)) result.push_back(point);
    first = last;
  }
  return result;
}

}  // namespace rotor_stator
