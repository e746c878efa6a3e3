#include "truth/attractors.hpp"

#include <algorithm>

#include "continuation/sweep.hpp"
#include "io/errors.hpp"
#include "motion/find_periodic.hpp"
#include "motion/regime.hpp"

namespace rotor_stator::truth {

namespace {

AttractorSettings read_attractor_settings(StrictToml table)
{
  const VerdictRule rule{.periodic = table.number("periodic", Range::positive),
                         .most_period = table.integer("most_period", 1, 1000),
                         .zero_rate = table.number("zero_rate_per_s", Range::positive)};
  const int points = table.integer("points_per_period", 4, 4096);
  return {.stepper = {.method = "rk4", .intervals_per_period = points},
          .settled = table.number("settled", Range::positive),
          .longest = table.number("longest_transient_s", Range::positive),
          .block = table.number("block_s", Range::positive),
          .least = table.number("least_s", Range::positive),
          .chaotic = table.number("chaotic_s", Range::positive),
          .most = table.number("most_s", Range::positive),
          .rule = rule,
          .same_periodic = table.number("same_periodic", Range::positive),
          .same_aperiodic = table.number("same_aperiodic", Range::positive)};
}

}  // namespace

AttractorScene read_attractor_scene(SceneFile& file)
{
  StrictToml& toml = file.toml();
  AttractorScene scene{.sets = read_parameter_list(file, "parameters"),
                       .frequencies = file.speed_range("speeds_hz"),
                       .random_frequencies = file.speed_range("random_speeds_hz"),
                       .random_starts = toml.integer("random_starts", 0, 64),
                       .seed = toml.integer("seed", 0, 1'000'000),
                       .few_harmonics = toml.integer("few_harmonics", 1, 256),
                       .many_harmonics = toml.integer("many_harmonics", 1, 256),
                       .settings = read_attractor_settings(toml.table("attractor"))};
  toml.refuse_unknown_keys();
  return scene;
}

std::vector<Chain> chains(const AttractorScene& scene)
{
  const int sets = static_cast<int>(scene.sets.size());
  std::vector<Chain> chains;
  for (int set = 1; set <= sets; ++set)
    for (Origin origin : {Origin::up, Origin::down, Origin::few_harmonics})
      chains.push_back({set, origin});
  for (int set = 1; set <= sets; ++set)
    for (std::size_t speed = 0; speed < scene.random_frequencies.size(); ++speed)
      chains.push_back({set, Origin::random, speed});
  for (int set = 1; set <= sets; ++set) chains.push_back({set, Origin::many_harmonics});
  return chains;
}

std::vector<AttractorPoint> settled(const AttractorScene& scene, const Chain& chain)
{
  const Parameters& machine = scene.sets[chain.set - 1];
  std::vector<AttractorPoint> points;
  const auto settle = [&](double frequency, const State& start) {
    const Attractor attractor =
        motion::attractor_from(machine, angular(frequency), start, scene.settings);
    points.push_back({attractor, chain.set, frequency, chain.origin});
    return attractor.state;
  };
  std::vector<double> frequencies = scene.frequencies;
  switch (chain.origin) {
    case Origin::down:
      std::reverse(frequencies.begin(), frequencies.end());
      [[fallthrough]];
    case Origin::up: {
      State state = static_start(machine);
      for (double frequency : frequencies) state = settle(frequency, state);
      break;
    }
    case Origin::few_harmonics:
      for (const PeriodicMotion& solution :
           sweep(machine, angular(frequencies), scene.few_harmonics))
        if (solution.found())
          settle(solution.omega / angular(1), motion::state_of(solution));
      break;
    case Origin::many_harmonics:
      for (double frequency : frequencies) {
        const PeriodicMotion solution =
            motion::find_periodic({machine, angular(frequency), scene.many_harmonics});
        if (solution.found()) settle(frequency, motion::state_of(solution));
      }
      break;
    case Origin::random: {
      const double frequency = scene.random_frequencies[chain.speed];
      const std::uint64_t first =
          ((scene.seed * 64ull + (chain.set - 1)) * 4096 + chain.speed) * 64;
      for (int k = 0; k < scene.random_starts; ++k)
        settle(frequency, motion::random_state(machine, angular(frequency), first + k));
    }
  }
  return points;
}

namespace {

bool same_speed(const AttractorPoint& a, const AttractorPoint& b)
{
  return a.set == b.set && std::abs(a.frequency - b.frequency) < 1e-6;
}

/** By set, speed and origin. */
bool before(const AttractorPoint& a, const AttractorPoint& b)
{
  if (same_speed(a, b)) return a.origin < b.origin;
  return std::pair(a.set, a.frequency) < std::pair(b.set, b.frequency);
}

}  // namespace

/** Random starts that end alike count as one point. */
std::vector<AttractorPoint> numbered(
    const std::vector<std::vector<AttractorPoint>>& of_chains,
    const AttractorSettings& settings)
{
  std::vector<AttractorPoint> all, kept;
  for (const auto& points : of_chains)
    all.insert(all.end(), points.begin(), points.end());
  std::stable_sort(all.begin(), all.end(), before);
  std::size_t first = 0;  // of this speed, in `kept`
  int attractors = 0;
  for (AttractorPoint point : all) {
    if (kept.size() > first && !same_speed(kept.back(), point)) {
      first = kept.size();
      attractors = 0;
    }
    const auto here = kept.begin() + static_cast<long>(first);
    const auto known = std::find_if(here, kept.end(), [&](const auto& other) {
      return same_attractor(point, other, settings);
    });
    point.number = known == kept.end() ? ++attractors : known->number;
    const auto same = std::find_if(here, kept.end(), [&](const auto& other) {
      return other.number == point.number && other.origin == Origin::random;
    });
    if (point.origin == Origin::random && same != kept.end())
      ++same->starts;
    else
      kept.push_back(point);
  }
  return kept;
}

namespace {

using Point = AttractorPoint;
using Get = Cell (*)(const Point&);

/** One of the four amplitudes, one of the eight components of the state. */
template <int k>
constexpr Get amplitude = [](const Point& p) -> Cell { return p.amplitude[k]; };
template <int k>
constexpr Get state = [](const Point& p) -> Cell { return vector_of(p.state)[k]; };

const std::vector<Field<Point>> fields{
    {"set", "-", "data set", &Point::set},
    {"f", "Hz", "speed of rotation", &Point::frequency},
    {"origin", "-",
     "1 carried on from the next lower speed, 2 from the next higher; begun on the solution with 3 few, 4 many harmonics; 5 at random states",
     &Point::origin},
    {"starts", "-", "number of starts that ended so", &Point::starts},
    {"attractor", "-", "number of the attractor at this set and speed", &Point::number},
    {"verdict", "-",
     "1 T-periodic, 2 kT-periodic, 3 quasi-periodic, 4 chaotic, 0 undecided",
     &Point::verdict},
    {"period", "-", "k of the least spread", &Point::period},
    {"spread", "-", "extent of the Poincare section over the largest displacement",
     &Point::spread},
    {"spread_k", "-", "largest distance of points kT apart over the largest displacement",
     &Point::spread_k},
    {"exponent", "1/s", "largest Lyapunov exponent",
     [](auto& p) { return p.exponent.value; }},
    {"exponent_error", "1/s", "its standard error",
     [](auto& p) { return p.exponent.error; }},
    {"seconds", "s", "integrated", &Point::seconds},
    {"amp_x_s", "m", "half peak-to-peak of x_s", amplitude<0>},
    {"amp_y_s", "m", "", amplitude<1>},
    {"amp_x_r", "m", "", amplitude<2>},
    {"amp_y_r", "m", "", amplitude<3>},
    {"x_s", "m", "state at phase 0", state<0>},
    {"y_s", "m", "", state<1>},
    {"x_r", "m", "", state<2>},
    {"y_r", "m", "", state<3>},
    {"vx_s", "m/s", "", state<4>},
    {"vy_s", "m/s", "", state<5>},
    {"vx_r", "m/s", "", state<6>},
    {"vy_r", "m/s", "", state<7>}};

}  // namespace

Table attractor_table(const AttractorScene& scene, const std::vector<Point>& points)
{
  Table table("Attractors", fields);
  const AttractorSettings& s = scene.settings;
  for (const Parameters& machine : scene.sets) describe(table, machine);
  table.note(format(
      "modelled: rk4, up and down through %zu speeds, from %d and %d harmonics at each, and from %d random states at %zu speeds (seed %d)",
      scene.frequencies.size(), scene.few_harmonics, scene.many_harmonics,
      scene.random_starts, scene.random_frequencies.size(), scene.seed));
  table.note(format(
      "transient: until the section's spread is below %g, at most %g s; then %g s if the section closes, %g s if chaotic, at most %g s else",
      s.settled, s.longest, s.least, s.chaotic, s.most));
  table.note(format(
      "verdict: closed below a spread of %g, k up to %d; chaotic if the exponent less 3 errors is above %g 1/s; quasi-periodic if it is within 3 errors of 0",
      s.rule.periodic, s.rule.most_period, s.rule.zero_rate));
  table.note(format(
      "same attractor: means and scatters within %g of the largest scatter if closed, %g else",
      s.same_periodic, s.same_aperiodic));
  for (const Point& point : points) table.row(fields, point);
  return table;
}

}  // namespace rotor_stator::truth
