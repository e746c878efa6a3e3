#include "truth/attractors.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <random>

#include "io/errors.hpp"
#include "io/table.hpp"
#include "motion/other_starts.hpp"

namespace rotor_stator::truth
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
  Row row;
  for (const PeriodicMotion& motion :
       sweep(parameters, angular(scene.frequencies), scene.few_harmonics))
    if (motion.found())
      append(motion.omega / angular(1),
             attractor_from(parameters, motion.omega, motion::state_of(motion),
                            scene.settings),
             row);
  return row;
}

/** Every speed from a solution with many harmonics, where there is one. */
Row from_solutions(const Parameters& parameters, const AttractorScene& scene)
{
  Row row;
  const int m = scene.many_harmonics;
  for (double frequency : scene.frequencies) {
    const double omega = angular(frequency);
    const auto solution =
        motion::search_periodic(parameters, omega, m, default_samples(m));
    if (!solution.found()) continue;
    append(frequency,
           attractor_from(parameters, omega, motion::state_of(solution), scene.settings),
           row);
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

/**
## Attractors: the scene file

What data/scenes/attractors.toml may say. */

namespace
{

AttractorSettings read_settings(StrictToml table)
{
  AttractorSettings settings{};
  settings.transient.stepper.method = "rk4";
  settings.transient.stepper.intervals_per_period =
      table.integer("points_per_period", 4, 4096);
  settings.transient.settled = table.number("settled", Range::positive);
  settings.transient.longest = table.number("longest_transient_s", Range::positive);
  settings.block = table.number("block_s", Range::positive);
  settings.least = table.number("least_s", Range::positive);
  settings.chaotic = table.number("chaotic_s", Range::positive);
  settings.most = table.number("most_s", Range::positive);
  settings.rule = {.periodic = table.number("periodic", Range::positive),
                   .most_period = table.integer("most_period", 1, 1000),
                   .zero_rate = table.number("zero_rate_per_s", Range::positive)};
  settings.transient.periodic = settings.rule.periodic;
  settings.same_periodic = table.number("same_periodic", Range::positive);
  settings.same_aperiodic = table.number("same_aperiodic", Range::positive);
  table.refuse_unknown_keys();
  return settings;
}

}  // namespace

AttractorScene read_attractor_scene(const std::string& file, const std::string& reading)
{
  SceneFile scene_file(file, reading);
  StrictToml& toml = scene_file.toml();
  AttractorScene scene{.sets = read_parameter_list(scene_file, "parameters"),
                       .frequencies = scene_file.speed_range("speeds_hz"),
                       .random_frequencies = scene_file.speed_range("random_speeds_hz"),
                       .random_starts = toml.integer("random_starts", 0, 64),
                       .seed = toml.integer("seed", 0, 1'000'000),
                       .few_harmonics = toml.integer("few_harmonics", 1, 256),
                       .many_harmonics = toml.integer("many_harmonics", 1, 256),
                       .settings = read_settings(toml.table("attractor"))};
  toml.refuse_unknown_keys();
  return scene;
}

/**
## Attractors: one motion

Its transient, its section, its exponent (attractors.hpp). */

namespace
{

/** Sums and extremes of the displacements over instants. */
struct Statistics {
  double count = 0;
  std::array<double, 4> sum{}, squares{};
  std::array<double, 4> low{1e300, 1e300, 1e300, 1e300};
  std::array<double, 4> high{-1e300, -1e300, -1e300, -1e300};

  void add(const Displacements& q)
  {
    ++count;
    for (std::size_t i = 0; i < 4; ++i) {
      sum[i] += q[i];
      squares[i] += q[i] * q[i];
      low[i] = std::min(low[i], q[i]);
      high[i] = std::max(high[i], q[i]);
    }
  }

  void add(const Statistics& other)
  {
    count += other.count;
    for (std::size_t i = 0; i < 4; ++i) {
      sum[i] += other.sum[i];
      squares[i] += other.squares[i];
      low[i] = std::min(low[i], other.low[i]);
      high[i] = std::max(high[i], other.high[i]);
    }
  }

  double size() const
  {
    double largest = 0;
    for (std::size_t i = 0; i < 4; ++i)
      largest = std::max({largest, std::abs(low[i]), std::abs(high[i])});
    return largest;
  }
};

/** A motion observed after its transient. */
class Observation
{
public:
  Observation(const Parameters& parameters, double omega, const State& start,
              const AttractorSettings& settings)
      : settings_(settings),
        period_(2 * std::numbers::pi / omega),
        motion_(make_stepper(parameters, omega, settings.transient.stepper),
                settings.transient.stepper.intervals_per_period, state_scales(parameters),
                start)
  {
  }

  /** Blocks until there is enough to judge by. The first block turns the neighbour into the
      direction of fastest growth, and its rate is not used. */
  Attractor run()
  {
    add_block();
    rates_.clear();
    SectionJudgement judgement;
    do {
      add_block();
      judgement = judged();
    } while (!enough(judgement));
    return summary(judgement);
  }

private:
  void add_block()
  {
    const int count = static_cast<int>(std::ceil(settings_.block / period_));
    double growth = 0;
    for (int k = 0; k < count; ++k) {
      section_.push_back(std::bit_cast<std::array<Displacements, 2>>(motion_.state())[0]);
      Statistics statistics;
      growth += motion_.advance_one_period([&](const State& state) {
        statistics.add(std::bit_cast<Displacements>(state.position));
      });
      periods_.push_back(statistics);
    }
    rates_.push_back(growth / (count * period_));
  }

  double seconds() const { return static_cast<double>(periods_.size()) * period_; }

  /** The last points decide whether the section closes, the whole observation what the exponent is. */
  SectionJudgement judged() const
  {
    const auto window =
        static_cast<std::size_t>(std::max(std::ceil(settings_.transient.window / period_),
                                          3.0 * settings_.rule.most_period));
    const auto last = section_.size() - std::min(section_.size(), window);
    const std::vector<Displacements> section(section_.begin() + static_cast<long>(last),
                                             section_.end());
    const Exponent exponent = rates_.size() < 2
                                  ? Exponent{0, std::numeric_limits<double>::infinity()}
                                  : exponent_of(rates_);
    return judge_section(section, periods_.back().size(), exponent, settings_.rule);
  }

  bool enough(const SectionJudgement& judgement) const
  {
    if (rates_.size() < 2 || section_.size() < 4) return false;
    const Verdict verdict = judgement.verdict;
    const bool closed = verdict == Verdict::periodic || verdict == Verdict::subharmonic;
    const double needed = closed                        ? settings_.least
                          : verdict == Verdict::chaotic ? settings_.chaotic
                                                        : settings_.most;
    return seconds() >= needed * (1 - 1e-9);
  }

  Attractor summary(const SectionJudgement& judgement) const
  {
    Attractor attractor{judgement, {}, {}, {}, motion_.state(), seconds()};
    const auto count =
        attractor.closed() ? static_cast<std::size_t>(judgement.period) : periods_.size();
    Statistics all;
    for (std::size_t k = periods_.size() - count; k < periods_.size(); ++k)
      all.add(periods_[k]);
    for (std::size_t i = 0; i < 4; ++i) {
      attractor.mean[i] = all.sum[i] / all.count;
      attractor.rms[i] = std::sqrt(std::max(
          0.0, all.squares[i] / all.count - attractor.mean[i] * attractor.mean[i]));
      attractor.amplitude[i] = 0.5 * (all.high[i] - all.low[i]);
    }
    return attractor;
  }

  const AttractorSettings& settings_;
  double period_;
  Neighbours motion_;
  std::vector<Displacements> section_;
  std::vector<Statistics> periods_;
  std::vector<double> rates_;
};

}  // namespace

Attractor attractor_from(const Parameters& parameters, double omega, const State& start,
                         const AttractorSettings& settings)
{
  if (!has_rotation_period(parameters.bearing))
    throw NoSolution("attractors: the bearing's force has not the period of rotation");
  const SteadyState steady = steady_state(parameters, omega, start, settings.transient);
  Attractor attractor =
      Observation(parameters, omega, steady.states.front(), settings).run();
  attractor.seconds += steady.seconds;
  return attractor;
}

bool same_attractor(const Attractor& a, const Attractor& b,
                    const AttractorSettings& settings)
{
  if (a.closed() != b.closed()) return false;
  if (a.closed() && a.judgement.period != b.judgement.period) return false;
  double apart = 0, size = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    apart =
        std::max({apart, std::abs(a.mean[i] - b.mean[i]), std::abs(a.rms[i] - b.rms[i])});
    size = std::max({size, a.rms[i], b.rms[i]});
  }
  return apart <= size * (a.closed() ? settings.same_periodic : settings.same_aperiodic);
}

State random_state(const Parameters& parameters, double omega, std::uint64_t seed)
{
  std::mt19937_64 generator(seed);
  /** In [-2, 2], the same with every library. */
  const auto random = [&] {
    return 4 * (static_cast<double>(generator() >> 11) * 0x1p-53 - 0.5);
  };
  const double joined = std::abs(dynamic_stiffness(parameters.stator, omega).value +
                                 dynamic_stiffness(parameters.rotor, omega).value);
  const double amplitude = parameters.unbalance * omega * omega / joined;
  const Vector8 scales = state_scales(parameters);
  Vector8 y = vector_of(static_start(parameters));
  for (int i = 0; i < 2; ++i) {
    const double position = random() * amplitude, speed = random() * amplitude * omega;
    for (int body : {0, 2}) {
      y[body + i] += position;
      y[4 + body + i] += speed;
    }
    y[2 + i] += random() * scales[2 + i];
    y[6 + i] += random() * scales[6 + i];
  }
  return state_of(y);
}

namespace
{

State state_in(const NumberTable& table, std::size_t row)
{
  const auto at = [&](const char* column) { return table.at(row, column); };
  return {.position = {{at("x_s"), at("y_s")}, {at("x_r"), at("y_r")}},
          .velocity = {{at("vx_s"), at("vy_s")}, {at("vx_r"), at("vy_r")}}};
}

}  // namespace

std::vector<KnownAttractor> read_attractors(const std::string& file)
{
  const NumberTable table(file);
  std::vector<KnownAttractor> attractors;
  for (std::size_t k = 0; k < table.rows(); ++k)
    attractors.push_back(
        {.set = static_cast<int>(table.at(k, "set")),
         .frequency = table.at(k, "f"),
         .origin = static_cast<Origin>(table.at(k, "origin")),
         .number = static_cast<int>(table.at(k, "attractor")),
         .verdict = static_cast<Verdict>(table.at(k, "verdict")),
         .period = static_cast<int>(table.at(k, "period")),
         .exponent = {table.at(k, "exponent"), table.at(k, "exponent_error")},
         .state = state_in(table, k)});
  return attractors;
}

std::vector<KnownAttractor> attractors_at(const std::vector<KnownAttractor>& all, int set,
                                          double frequency)
{
  std::vector<KnownAttractor> here;
  for (const KnownAttractor& one : all) {
    if (one.set != set || std::abs(one.frequency - frequency) > 1e-6) continue;
    if (std::none_of(here.begin(), here.end(),
                     [&](const auto& other) { return other.number == one.number; }))
      here.push_back(one);
  }
  if (here.empty())
    throw BadInput(
        format("the table of attractors has none of set %d at %g Hz", set, frequency));
  return here;
}

motion::Motion motion_on(const KnownAttractor& attractor, const Parameters& parameters,
                         int points_per_period, int periods)
{
  const TimeStepper stepper =
      make_stepper(parameters, angular(attractor.frequency),
                   {.method = "rk4", .intervals_per_period = points_per_period});
  const long own = attractor.closed() ? attractor.period : periods;
  State state = attractor.state;
  motion::Motion motion = motion::recorded(stepper, points_per_period, state, 0, own);
  const std::size_t once = motion.size();
  const auto whole = static_cast<std::size_t>(periods) * points_per_period;
  for (std::size_t k = once; k < whole; ++k)
    motion.positions.push_back(motion.positions[k - once]);
  return motion;
}

std::vector<Vec2> section_of(const KnownAttractor& attractor,
                             const Parameters& parameters, int points)
{
  constexpr int intervals = 4;
  const TimeStepper stepper =
      make_stepper(parameters, angular(attractor.frequency),
                   {.method = "rk4", .intervals_per_period = intervals});
  const int own = attractor.closed() ? attractor.period : points;
  std::vector<Vec2> section;
  State state = attractor.state;
  for (long period = 0; period < own; ++period) {
    section.push_back(state.position.relative());
    if (period + 1 == own) break;
    for (long k = 0; k < intervals; ++k) stepper.advance(period * intervals + k, state);
  }
  return section;
}

namespace
{

const std::vector<Column> columns{
    {"set", "-", "data set"},
    {"f", "Hz", "speed of rotation"},
    {"origin", "-",
     "1 carried on from the next lower speed, 2 from the next higher; begun on the solution with 3 few, 4 many harmonics; 5 at random states"},
    {"starts", "-", "number of starts that ended so"},
    {"attractor", "-", "number of the attractor at this set and speed"},
    {"verdict", "-",
     "1 T-periodic, 2 kT-periodic, 3 quasi-periodic, 4 chaotic, 0 undecided"},
    {"period", "-", "k of the least spread"},
    {"spread", "-", "extent of the Poincare section over the largest displacement"},
    {"spread_k", "-",
     "largest distance of points kT apart over the largest displacement"},
    {"exponent", "1/s", "largest Lyapunov exponent"},
    {"exponent_error", "1/s", "its standard error"},
    {"seconds", "s", "integrated"},
    {"amp_x_s", "m", "half peak-to-peak of x_s"},
    {"amp_y_s", "m", ""},
    {"amp_x_r", "m", ""},
    {"amp_y_r", "m", ""},
    {"x_s", "m", "state at phase 0"},
    {"y_s", "m", ""},
    {"x_r", "m", ""},
    {"y_r", "m", ""},
    {"vx_s", "m/s", ""},
    {"vy_s", "m/s", ""},
    {"vx_r", "m/s", ""},
    {"vy_r", "m/s", ""}};

std::vector<Cell> cells(const AttractorPoint& p)
{
  const Attractor& a = p.attractor;
  const SectionJudgement& j = a.judgement;
  std::vector<Cell> row{p.set,
                        p.frequency,
                        static_cast<int>(p.origin),
                        p.starts,
                        p.number,
                        static_cast<int>(j.verdict),
                        j.period,
                        j.spread,
                        j.spread_k,
                        j.exponent.value,
                        j.exponent.error,
                        a.seconds};
  for (double amplitude : a.amplitude) row.emplace_back(amplitude);
  for (double value : vector_of(a.state)) row.emplace_back(value);
  return row;
}

void describe(const AttractorScene& scene, Table& table)
{
  const AttractorSettings& s = scene.settings;
  for (const Parameters& parameters : scene.sets) describe(table, parameters);
  table.note(format(
      "modelled: rk4, up and down through %zu speeds, from %d and %d harmonics at each, and from %d random states at %zu speeds (seed %d)",
      scene.frequencies.size(), scene.few_harmonics, scene.many_harmonics,
      scene.random_starts, scene.random_frequencies.size(), scene.seed));
  table.note(format(
      "transient: until the section's spread is below %g, at most %g s; then %g s if the section closes, %g s if chaotic, at most %g s else",
      s.transient.settled, s.transient.longest, s.least, s.chaotic, s.most));
  table.note(format(
      "verdict: closed below a spread of %g, k up to %d; chaotic if the exponent less 3 errors is above %g 1/s; quasi-periodic if it is within 3 errors of 0",
      s.rule.periodic, s.rule.most_period, s.rule.zero_rate));
  table.note(format(
      "same attractor: means and scatters within %g of the largest scatter if closed, %g else",
      s.same_periodic, s.same_aperiodic));
}

}  // namespace

Table attractor_table(const std::string& scene_file, const std::string& reading,
                      const std::string& journal)
{
  const AttractorScene scene = read_attractor_scene(scene_file, reading);
  Table table("Attractors", columns);
  describe(scene, table);
  std::vector<std::string> files{scene_file};
  for (const Parameters& parameters : scene.sets) files.push_back(parameters.file);
  const std::string stamp = stamp_of(files);
  for (const AttractorPoint& point : compute_attractors(scene, journal, stamp))
    table.row(cells(point));
  return table;
}

}  // namespace rotor_stator::truth
