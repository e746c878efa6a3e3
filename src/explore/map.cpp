#include "explore/map.hpp"

#include <omp.h>
#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <map>
#include <mutex>

#include "balance/bearing_problem.hpp"
#include "balance/fourier_transform.hpp"
#include "continuation/sweep.hpp"
#include "explore/balance_motion.hpp"
#include "explore/plot.hpp"
#include "io/errors.hpp"
#include "io/number_table.hpp"
#include "io/output_file.hpp"
#include "io/parallel.hpp"
#include "io/program.hpp"
#include "motion/answer.hpp"
#include "motion/contact.hpp"
#include "motion/find_periodic.hpp"
#include "motion/judge.hpp"
#include "motion/regime.hpp"
#include "time/floquet.hpp"

namespace rotor_stator::explore {

namespace {

const char* const script = "map.py";
const char* const speed = "frequency";  // the key that no parameter file has
constexpr int instants = 512, swept_instants = 128, timed_instants = 64;  // of a period
constexpr int most_points = 10'000'000, recorded_periods = 64;
constexpr double seconds = 5;  // that a point may take, about

/**
## Where the points are */

struct Axis {
  std::string key = {};  ///< empty: the axis has one place and no column
  double from = 0, to = 0;
  std::size_t count = 1;
  bool logarithmic = false;

  double at(std::size_t k) const
  {
    if (k == 0 || count == 1) return from;
    if (k + 1 == count) return to;
    const double share = static_cast<double>(k) / static_cast<double>(count - 1);
    return logarithmic ? from * std::pow(to / from, share) : from + (to - from) * share;
  }
};

std::vector<std::string> parts_of(const std::string& text, char between)
{
  std::vector<std::string> parts{""};
  for (const char c : text)
    if (c == between)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

Axis read_axis(const std::string& option, const std::string& text)
{
  if (text.empty()) return {};
  const auto refuse = [&](const std::string& why) {
    throw BadInput(option + " " + text + ": " + why);
  };
  const auto equals = text.find('=');
  auto parts = parts_of(equals < text.size() ? text.substr(equals + 1) : "", ':');
  const bool logarithmic = parts.size() == 4 && parts.back() == "log";
  if (logarithmic) parts.pop_back();
  if (equals == 0 || parts.size() != 3) refuse("must be KEY=from:to:count[:log]");
  Axis axis{text.substr(0, equals), real_number(option, parts[0], -1e300, 1e300),
            real_number(option, parts[1], -1e300, 1e300),
            static_cast<std::size_t>(whole_number(option, parts[2], 1, most_points)),
            logarithmic};
  if (axis.count > 1 && axis.from == axis.to) refuse("from and to must differ");
  if (logarithmic && (axis.from <= 0 || axis.to <= 0))
    refuse("log needs from > 0 and to > 0");
  return axis;
}

/** The points: lines of x, one for each value of y or for each row of a list. */
struct Grid {
  Axis x, y;
  std::optional<NumberTable> list = {};
  std::size_t first = 0, last = 0;  ///< lines that are asked for: first ≤ j < last

  std::size_t lines() const { return list ? list->rows() : y.count; }

  std::vector<std::string> keys() const
  {
    std::vector<std::string> all;
    for (const Axis& axis : {x, y})
      if (!axis.key.empty()) all.push_back(axis.key);
    if (list) all.insert(all.end(), list->names().begin(), list->names().end());
    return all;
  }

  /** In the order of the keys. */
  std::vector<double> values(std::size_t line, std::size_t k) const
  {
    std::vector<double> all;
    if (!x.key.empty()) all.push_back(x.at(k));
    if (!y.key.empty()) all.push_back(y.at(line));
    if (list) all.insert(all.end(), list->row(line).begin(), list->row(line).end());
    return all;
  }
};

/** A:B, two whole numbers. */
void read_lines(const std::string& text, Grid& grid)
{
  grid.last = grid.lines();
  if (text.empty()) return;
  const auto parts = parts_of(text, ':');
  if (parts.size() != 2) throw BadInput("--lines " + text + ": must be A:B");
  const int most = static_cast<int>(std::min<std::size_t>(grid.lines(), most_points));
  grid.first = static_cast<std::size_t>(whole_number("--lines", parts[0], 0, most - 1));
  grid.last = static_cast<std::size_t>(
      whole_number("--lines", parts[1], static_cast<int>(grid.first) + 1, most));
}

Grid grid_of(const MapRequest& request)
{
  if (request.list && !request.y.empty())
    throw BadInput("--y: not together with --list, whose rows stand for its lines");
  if (!request.list && request.x.empty() && request.y.empty())
    throw BadInput("--x: is missing; give --x, --y or --list");
  Grid grid{read_axis("--x", request.x), read_axis("--y", request.y)};
  if (request.list) grid.list.emplace(*request.list);
  read_lines(request.lines, grid);
  auto keys = grid.keys();
  std::ranges::sort(keys);
  if (const auto twice = std::ranges::adjacent_find(keys); twice != keys.end())
    throw BadInput(*twice + ": is given twice, in --x, --y or --list");
  return grid;
}

/**
## What all points share */

struct Task {
  const MapRequest& request;
  Grid grid;
  StrictToml file;
  std::vector<std::string> keys;
  std::vector<double> sweep = {};  ///< [Hz]
  int harmonics = usual_harmonics, samples = 0;

  /** The machine at the values of the keys, and its speed [Hz], 0 without one. */
  std::pair<Parameters, double> machine(const std::vector<double>& values) const
  {
    double frequency = request.frequency.value_or(0);
    std::vector<std::pair<std::string, double>> changes;
    for (std::size_t k = 0; k < keys.size(); ++k)
      if (keys[k] != speed)
        changes.emplace_back(keys[k], values[k]);
      else if (frequency = values[k]; !(frequency > 0))
        throw BadInput(format("%s: must be > 0, got %g", speed, frequency));
    return {read(changes, frequency), frequency};
  }

  /** Large bodies are reduced for the speed of the point or those of --sweep. */
  Parameters read(const std::vector<std::pair<std::string, double>>& changes,
                  double frequency) const
  {
    ModelRange range{.harmonics = std::max(64, harmonics)};
    if (frequency > 0) range.from = range.to = frequency;
    if (!sweep.empty()) range.from = sweep.front(), range.to = sweep.back();
    return read_parameters(file.with(changes, given_instead), range);
  }

  bool has_speed() const { return std::ranges::find(keys, speed) != keys.end(); }
};

/**
## One point

What several quantities need is computed once, and its failure is remembered. */

template <class Value>
class Once {
public:
  template <class Make>
  const Value& operator()(const Make& make)
  {
    if (!value_ && lost_.empty()) try {
        value_ = make();
      } catch (const NoSolution& none) {
        lost_ = none.what();
      }
    if (!value_) throw NoSolution(lost_);
    return *value_;
  }

private:
  std::optional<Value> value_;
  std::string lost_;
};

/** A response curve over the speeds of --sweep. */
struct Swept {
  CurvePoint peak = {};  ///< of x_r [Hz, m]
  int solved = 0, permanent = 0;
  double loss_first = -1, loss_last = -1;  ///< speeds losing contact [Hz]; -1: none
  double ball_load = 0;                    ///< [N]
};

/** The motion that rk4 settles on from a periodic solution or, where Newton finds none, from the static load. */
struct Settled : motion::Regime {
  motion::Motion motion;
};

class Point {
public:
  /** `before`: the solution at the point before on the line, which becomes that of this one. */
  Point(const Task& task, const std::vector<double>& values, PeriodicMotion& before)
      : Point(task, task.machine(values), before)
  {
  }

  const PeriodicMotion& solution()
  {
    return solution_([&] {
      const bool is_chosen = task_.request.tolerance && !task_.request.harmonics;
      PeriodicMotion found = is_chosen ? chosen().motion : with_fixed_harmonics();
      if (!found.found())
        throw NoSolution(
            format("no solution found with %d harmonics: ", task_.harmonics) +
            found.newton.reason());
      return before_ = std::move(found);
    });
  }

  /** With the harmonics that the tolerance asks for. */
  const motion::Judged& chosen()
  {
    return chosen_([&] {
      require_period();
      motion::Judged at = motion::to_tolerance({.parameters = machine,
                                                .omega = omega(),
                                                .harmonics = 6,
                                                .newton = newton_,
                                                .budget = budget_},
                                               task_.request.tolerance.value_or(1e-3));
      if (!at.reached) throw NoSolution("tolerance not reached: " + at.end);
      return at;
    });
  }

  bool is_balance() const { return task_.request.method == "aft"; }

  /** What the machine does from rest, by the method that is asked for. */
  const motion::Answer& answer()
  {
    return answer_([&] {
      const MapRequest& asked = task_.request;
      return motion::answer(machine,
                            {.omega = omega(),
                             .method = is_balance() ? "auto" : asked.method,
                             .tolerance = is_balance() ? std::nullopt : asked.tolerance,
                             .periods = recorded_periods,
                             .step = asked.step,
                             .longest = asked.longest},
                            budget_);
    });
  }

  const motion::Observation& observed()
  {
    return observed_([&] { return observe(answer(), budget_); });
  }

  /** One period of a solution, the record of a motion in time; and the machine that counts its periods. */
  const motion::Motion& motion()
  {
    if (!is_balance()) return answer().motion;
    return motion_([&] { return motion::motion_of(solution(), instants); });
  }
  const Parameters& moving() { return is_balance() ? machine : answer().machine; }

  /** Half peak-to-peak of x_r [m]. */
  double amplitude()
  {
    return is_balance() ? half_peak_to_peak(solution().bodies)[2]
                        : observed().amplitude[2];
  }

  /** [Hz] */
  double force_balance() const
  {
    const auto speeds = equal_force_speeds(machine, 2 * joint_resonance(machine));
    if (speeds.empty()) throw NoSolution("the unbalance never lifts the static load");
    return speeds.front() / angular(1);
  }

  int missed() { return static_cast<int>(task_.sweep.size()) - swept().solved; }

  double mean()
  {
    if (!is_balance()) return observed().mean[1 + 2];
    double sum = 0;
    for (const Bodies& at : motion().positions) sum += at.rotor.y;
    return sum / static_cast<double>(motion().size());
  }

  const motion::Verdict& verdict()
  {
    return verdict_([&] {
      const bool is_chosen = task_.request.tolerance && !task_.request.harmonics;
      return is_chosen ? chosen().verdict : motion::judge(machine, solution(), budget_);
    });
  }

  std::string stability() { return is_balance() ? verdict().word() : answer().stability; }

  /** The largest multiplier and its uncertainty. */
  std::pair<double, double> multiplier()
  {
    if (is_balance()) return {floquet().largest(), floquet().uncertainty()};
    if (!(answer().multiplier > 0)) throw NoSolution("the motion does not close");
    return {answer().multiplier, answer().uncertainty};
  }

  /** The multipliers of a motion that was found. */
  const Floquet& floquet()
  {
    if (!verdict().found()) throw NoSolution(verdict().reason);
    return verdict().floquet;
  }

  /** What the m harmonics say of themselves. */
  const Floquet& series()
  {
    return series_([&] { return series_multipliers(machine, solution()); });
  }

  /** λ of the motion from rest [1/base period], and its share of the time with a loaded ball. */
  double lyapunov()
  {
    return answer().settled.lyapunov.value * angular(1) / answer().omega;
  }
  double loaded() { return motion::contact_share(answer().machine, answer().motion); }

  const Settled& regime()
  {
    return regime_([&] {
      const double longest = task_.request.longest, step = task_.request.step;
      const motion::RegimeSettings settings{
          .step_over_default = step > 0 ? step / default_step(machine) : 2,
          .longest = longest,
          .window = longest / 10,
          .average = 2 * longest,
          .points_per_period = timed_instants};
      const SteadyState steady = motion::settled_motion(machine, frequency, settings);
      return Settled{motion::regime_of(machine, frequency, {steady}, settings),
                     motion::motion_of(steady, timed_instants)};
    });
  }

  /** Of the solution with m harmonics that Newton finds from the settled motion, or from the quasi-static contact where
      that is nearer: rms about the mean; 2 where there is none. */
  double error_near(int m)
  {
    if (!regime().periodic) throw NoSolution("the settled motion is not T-periodic");
    motion::Motion truth = regime().motion;
    truth.positions.resize(timed_instants);
    const auto error = [&](const PeriodicMotion& at) {
      return at.found()
                 ? motion::rms_difference(
                       motion::motion_of(body_series(machine, at), timed_instants), truth)
                 : 2;
    };
    Balance balance(bearing_problem(machine, default_samples(m)), m);
    const double near = error(solve(balance, omega(), motion::relative_series(truth, m)));
    return std::min(near, error(motion::find_periodic({machine, omega(), m})));
  }

  const Swept& swept()
  {
    return swept_([&] {
      require_period();
      Swept all;
      std::vector<CurvePoint> curve;
      for (const PeriodicMotion& at : rotor_stator::sweep(
               machine, angular(task_.sweep), task_.harmonics, task_.samples)) {
        if (!at.found()) continue;
        const double hertz = at.omega / angular(1);
        const motion::Motion motion = motion::motion_of(at, swept_instants);
        curve.push_back({hertz, motion::half_peak_to_peak(motion)[2]});
        all.ball_load =
            std::max(all.ball_load, motion::largest_ball_load(machine, motion));
        if (motion::contact_share(machine, motion) == 1) {
          ++all.permanent;
          continue;
        }
        if (all.loss_first < 0) all.loss_first = hertz;
        all.loss_last = hertz;
      }
      if (curve.empty()) throw NoSolution("no solution at any speed of --sweep");
      all.peak = refined_peak(curve);
      all.solved = static_cast<int>(curve.size());
      return all;
    });
  }

  /** The distance from the nearest motion of Eq. 7. */
  double error()
  {
    floquet();
    return std::max(verdict().distance, verdict().distance_rms);
  }

  /** rms about the mean, from the motion of Eq. 7 found from the solution; where there is none, from what rk4 settles on
      from there. */
  double machine_error()
  {
    if (verdict().found()) return verdict().distance_rms;
    const rotor_stator::Settled& there = verdict().from_there;
    if (there.kind == Kind::undecided) throw NoSolution(verdict().reason);
    const TimeStepper stepper = make_stepper(
        machine, omega(),
        {.method = "rk4", .intervals_per_period = instants, .budget = budget_});
    State state = there.at.state;
    const motion::Motion settled = motion::recorded(
        stepper, instants, state, there.at.period, std::max(1, there.period) * 40);
    return motion::rms_difference(motion::motion_of(solution(), instants), settled);
  }

  const Parameters machine;
  const double frequency;  ///< [Hz]

private:
  Point(const Task& task, std::pair<Parameters, double> at, PeriodicMotion& before)
      : machine(std::move(at.first)), frequency(at.second), task_(task), before_(before),
        budget_(budget_of(task.request.budget, seconds, machine)),
        newton_{.tolerance = task.request.newton_tolerance}
  {
  }

  double omega() const { return angular(frequency); }

  void require_period() const
  {
    if (!has_rotation_period(machine.bearing))
      throw NoSolution(format("%.9g balls pass in a turn, not a whole number",
                              passages_per_turn(machine.bearing)));
  }

  PeriodicMotion with_fixed_harmonics() const
  {
    require_period();
    if (before_.found()) {
      Balance balance(bearing_problem(machine, task_.samples, budget_), task_.harmonics);
      PeriodicMotion next = solve(balance, omega(), before_.x, newton_);
      if (next.found()) {
        next.bodies = body_series(machine, next);
        return next;
      }
    }
    return motion::find_periodic(
        {machine, omega(), task_.harmonics, task_.samples, newton_, budget_});
  }

  const Task& task_;
  PeriodicMotion& before_;
  OperationBudget budget_;
  NewtonSettings newton_;
  Once<PeriodicMotion> solution_;
  Once<motion::Judged> chosen_;
  Once<motion::Motion> motion_;
  Once<motion::Verdict> verdict_;
  Once<Floquet> series_;
  Once<motion::Answer> answer_;
  Once<motion::Observation> observed_;
  Once<Settled> regime_;
  Once<Swept> swept_;
};

/**
## The quantities */

double largest_force(Point& point)
{
  double largest = 0;
  for (const Vec2 force : motion::bearing_forces(point.moving(), point.motion()))
    largest = std::max(largest, std::hypot(force.x, force.y));
  return largest;
}

/** What a quantity is taken from: a solution of harmonic balance, or the motion of any method, or the motion from
    rest as `explore attractors` finds it, or that of rk4 from a solution, all at one speed; or the speeds of --sweep. */
enum Source { solution, motion_of_method, rest, settled, sweeps };

struct Quantity : Column {
  Source source;
  Cell (*value)(Point& point);
  bool of_two_masses = false;
};

template <auto measure>
Cell settled_measure(Point& p)
{
  return p.regime().*measure;
}

template <int m>
Quantity error_near()
{
  return {{format("error_%d", m), "-",
           m > 6 ? ""
                 : "of the nearest solution with so many harmonics from the settled "
                   "motion, rms about the mean; 2 where there is none"},
          settled,
          [](auto& p) -> Cell { return p.error_near(m); }};
}

using Measures = motion::RegimeMeasures;
const std::vector<Quantity> quantities{
    {"amplitude", "m", "half peak-to-peak of x_r", motion_of_method,
     [](auto& p) -> Cell { return p.amplitude(); }},
    {"mean", "m", "mean of y_r over the period", motion_of_method,
     [](auto& p) -> Cell { return p.mean(); }},
    {"peak", "m", "largest amplitude over the speeds of --sweep, refined by a parabola",
     sweeps, [](auto& p) -> Cell { return p.swept().peak.amplitude; }},
    {"peak_frequency", "Hz", "its speed", sweeps,
     [](auto& p) -> Cell { return p.swept().peak.frequency; }},
    {"permanent", "-", "share of the solved speeds of --sweep with permanent contact",
     sweeps,
     [](auto& p) -> Cell { return 1.0 * p.swept().permanent / p.swept().solved; }},
    {"loss_first", "Hz", "first speed of --sweep at which contact is lost; -1: none",
     sweeps, [](auto& p) -> Cell { return p.swept().loss_first; }},
    {"loss_last", "Hz", "last such speed; -1: none", sweeps,
     [](auto& p) -> Cell { return p.swept().loss_last; }},
    {"largest_load", "N", "largest force on a ball over the speeds of --sweep", sweeps,
     [](auto& p) -> Cell { return p.swept().ball_load; }},
    {"missed", "-", "speeds of --sweep without a solution", sweeps,
     [](auto& p) -> Cell { return p.missed(); }},
    {"contact_share", "-", "share of the period with at least one loaded ball",
     motion_of_method,
     [](auto& p) -> Cell { return motion::contact_share(p.moving(), p.motion()); }},
    {"ball_load", "N", "largest force on a ball, over two periods", motion_of_method,
     [](auto& p) -> Cell { return motion::largest_ball_load(p.moving(), p.motion()); }},
    {"force", "N", "largest force of the bearing, Eq. 6", motion_of_method,
     [](auto& p) -> Cell { return largest_force(p); }},
    {"stability", "word",
     "of the motion, or of that of Eq. 7 found from the solution: stable, unstable, undecided",
     motion_of_method, [](auto& p) -> Cell { return p.stability(); }},
    {"period", "-",
     "K of the motion from rest; 0 aperiodic, -1 quasi-periodic, -2 undecided", rest,
     [](auto& p) -> Cell { return p.answer().period_number(); }},
    {"multiplier", "-", "largest modulus of the multipliers behind stability",
     motion_of_method, [](auto& p) -> Cell { return p.multiplier().first; }},
    {"uncertainty", "-", "of multiplier", motion_of_method,
     [](auto& p) -> Cell { return p.multiplier().second; }},
    {"distance", "-",
     "of the solution from the motion behind stability, rms about the mean", solution,
     [](auto& p) -> Cell { return p.floquet(), p.verdict().distance_rms; }},
    {"evaluations", "-", "of the force, for the verdict of stability", solution,
     [](auto& p) -> Cell { return p.verdict().evaluations; }},
    {"series", "-", "largest modulus of the multipliers along the m harmonics", solution,
     [](auto& p) -> Cell { return p.series().largest(); }, true},
    {"series_uncertainty", "-", "of series", solution,
     [](auto& p) -> Cell { return p.series().uncertainty(); }, true},
    {"series_stability", "word", "what they say: stable, unstable, undecided", solution,
     [](auto& p) -> Cell { return std::string(p.series().verdict()); }, true},
    {"regime", "word",
     "of the motion from rest: rest, periodic, quasi-periodic, chaotic, undecided", rest,
     [](auto& p) -> Cell { return word(p.answer().kind()); }},
    {"lyapunov", "1/base period", "largest Lyapunov exponent of the motion from rest",
     rest, [](auto& p) -> Cell { return p.lyapunov(); }},
    {"loaded", "-", "share of the time of the motion from rest with a loaded ball", rest,
     [](auto& p) -> Cell { return p.loaded(); }},
    {"harmonics", "-", "m that --tolerance needs, 1e-3 without it", solution,
     [](auto& p) -> Cell { return p.chosen().motion.harmonics.count(); }},
    {"error", "-",
     "of the solution, the larger of the largest displacement's and the rms about the mean, estimated with more "
     "harmonics or, where that does not settle, against the motion behind stability",
     solution, [](auto& p) -> Cell { return p.error(); }},
    {"machine_error", "-",
     "of the solution, rms about the mean, against the motion behind stability or, where there is none, what rk4 "
     "settles on from the solution",
     solution, [](auto& p) -> Cell { return p.machine_error(); }},
    {"periodic", "-",
     "1 if rk4 from the solution, or from the static load, settles on the period of "
     "rotation; of this settled motion:",
     settled, [](auto& p) -> Cell { return p.regime().periodic; }},
    {"settled_contact", "-", "share of the time with at least one loaded ball", settled,
     settled_measure<&Measures::contact>},
    {"turns", "-", "turns of the bearing's force per period", settled,
     settled_measure<&Measures::turns>},
    {"higher_harmonics", "-", "rms of harmonics 2 and above over the first", settled,
     settled_measure<&Measures::all>},
    {"passed_once", "-",
     "share of pairs of periods in which every ball is loaded exactly once", settled,
     settled_measure<&Measures::passed_once>},
    {"passages", "-", "times a ball is loaded in two periods, mean over the balls",
     settled, settled_measure<&Measures::passages>},
    {"loaded_arc", "rad", "mean over time of the loaded arc", settled,
     settled_measure<&Measures::loaded_arc>},
    {"settled_load", "N", "largest force on a ball in two periods", settled,
     settled_measure<&Measures::largest_force>},
    {"settled_amplitude", "m", "half peak-to-peak of x_r", settled,
     settled_measure<&Measures::amp_x_r>},
    error_near<6>(),
    error_near<7>(),
    error_near<8>(),
    error_near<9>(),
    error_near<10>(),
    error_near<12>(),
    error_near<16>(),
    {"force_balance", "Hz",
     "speed at which the unbalance lifts the static load, at u = 0", settled,
     [](auto& p) -> Cell { return p.force_balance(); }}};

std::vector<Quantity> chosen_quantities(const Task& task)
{
  std::vector<Quantity> chosen;
  for (const std::string& name : task.request.quantities) {
    const auto found = std::ranges::find(quantities, name, &Quantity::name);
    if (found == quantities.end()) {
      std::vector<std::string> names;
      std::string list;
      for (const Quantity& q : quantities) {
        names.push_back(q.name);
        list += (list.empty() ? "" : ", ") + q.name;
      }
      throw BadInput("--quantity " + name + ": is not a quantity" +
                     suggestion(name, names) + " (known: " + list + ")");
    }
    if (std::ranges::find(chosen, name, &Quantity::name) != chosen.end())
      throw BadInput("--quantity " + name + ": is given twice");
    chosen.push_back(*found);
  }
  const auto of = [&](auto... sources) {
    const auto one = std::ranges::find_if(
        chosen, [&](const Quantity& q) { return ((q.source == sources) || ...); });
    return one == chosen.end() ? std::string() : one->name;
  };
  const std::string swept = of(sweeps),
                    here = of(solution, motion_of_method, rest, settled);
  const bool has_speed = task.request.frequency || task.has_speed();
  if (!swept.empty() && task.sweep.empty())
    throw BadInput("--sweep: is missing, the speeds of " + swept);
  if (swept.empty() && !task.sweep.empty())
    throw BadInput("--sweep: no quantity of a range of speeds is asked for");
  if (!here.empty() && !has_speed)
    throw BadInput("--frequency: is missing, the speed of " + here);
  if (here.empty() && has_speed)
    throw BadInput("--frequency: the quantities asked for are those of --sweep");
  if (const std::string balanced = of(solution, sweeps);
      task.request.method != "aft" && !balanced.empty())
    throw BadInput("--method " + task.request.method + ": " + balanced +
                   " is of harmonic balance, aft");
  if (const std::string timed = of(settled);
      task.request.method != "rk4" && task.request.method != "auto" && !timed.empty())
    throw BadInput("--method " + task.request.method + ": " + timed + " is of rk4");
  const Parameters machine = task.machine(task.grid.values(task.grid.first, 0)).first;
  require_method_of(machine, task.request.method);
  for (const Quantity& one : chosen)
    if (one.source == settled || one.of_two_masses)
      require_two_masses(machine, ("--quantity " + one.name).c_str());
  return chosen;
}

Task task_of(const MapRequest& request)
{
  Task task{request, grid_of(request), StrictToml(request.parameter_file), {}};
  task.keys = task.grid.keys();
  if (task.has_speed() && request.frequency)
    throw BadInput("--frequency: is a key of the map already");
  if (!request.sweep.empty()) {
    const auto parts = parts_of(request.sweep, ':');
    if (parts.size() != 2 && parts.size() != 3)
      throw BadInput("--sweep " + request.sweep + ": must be A:B or A:B:COUNT");
    const Axis axis{"", real_number("--sweep", parts[0], 0, 1e300),
                    real_number("--sweep", parts[1], 0, 1e300),
                    parts.size() == 3 ? static_cast<std::size_t>(
                                            whole_number("--sweep", parts[2], 2, 100000))
                                      : 101};
    if (axis.from >= axis.to)
      throw BadInput("--sweep " + request.sweep + ": A must be below B");
    for (std::size_t k = 0; k < axis.count; ++k) task.sweep.push_back(axis.at(k));
  }
  task.harmonics = request.harmonics.value_or(usual_harmonics);
  task.samples = checked_samples(task.harmonics, request.samples);
  if (request.tolerance && request.samples && !request.harmonics)
    throw BadInput("--samples: chosen with m for --tolerance; give --harmonics too");
  std::vector<std::string> inputs{request.parameter_file};
  if (request.list) inputs.push_back(*request.list);
  if (request.resume) inputs.push_back(*request.resume);
  if (request.plot) require_plot(*request.plot, script, inputs);
  /** The corners, so that an unknown key or a range that no machine has is refused at once. */
  const Grid& grid = task.grid;
  const std::size_t top = grid.list ? 0 : grid.lines() - 1;
  for (const std::size_t line : {std::size_t{0}, top})
    for (const std::size_t k : {std::size_t{0}, grid.x.count - 1})
      task.machine(grid.values(line, k));
  return task;
}

/**
## The table, line by line */

void put_method(Table& table, const Task& task)
{
  const MapRequest& request = task.request;
  table.value("method", request.method);
  if (request.method != "aft")
    return table.note(
        format("longest step %g s (0: from K_H), transient at most %g s after t = 0",
               request.step, request.longest));
  if (request.tolerance && !request.harmonics)
    return table.note("harmonics: chosen for the tolerance");
  table.value("harmonics", task.harmonics);
  table.value("samples", task.samples);
  table.note(format("relative tolerance of Newton %g", request.newton_tolerance));
}

std::string header_of(const Task& task, const std::vector<Quantity>& chosen)
{
  const MapRequest& request = task.request;
  std::vector<Column> columns;
  for (const std::string& key : task.keys)
    columns.push_back({key, key == speed ? "Hz" : "see key",
                       key == speed ? "speed of rotation" : "of the parameter file"});
  columns.insert(columns.end(), chosen.begin(), chosen.end());
  columns.push_back(
      {"status", "word", "ok, or why a quantity is missing, which is then -"});
  Table table("Map of a machine", columns);
  const Parameters base = task.read({}, request.frequency.value_or(0));
  describe(table, base);
  table.row_line("keys", {task.keys.begin(), task.keys.end()});
  for (const auto& [name, text] : {std::pair{"x", request.x}, {"y", request.y}})
    if (!text.empty()) table.note(format("--%s ", name) + text);
  if (request.list) table.note("--list " + *request.list);
  if (request.frequency) table.value("frequency", *request.frequency);
  if (!task.sweep.empty()) {
    table.value("sweep_count", task.sweep.size());
    table.value("sweep_from", task.sweep.front());
    table.value("sweep_to", task.sweep.back());
  }
  const auto from_rest = [](const Quantity& q) { return q.source == rest; };
  if (std::ranges::any_of(chosen, from_rest))
    table.note("motion from rest: as explore orbit settles it");
  if (!std::ranges::all_of(chosen, from_rest)) put_method(table, task);
  if (request.tolerance) table.value("tolerance", *request.tolerance);
  table.value("budget", budget_of(request.budget, seconds, base).most(), 6);
  table.note("budget: evaluations of the force for each point");
  return table.text();
}

const char* const all_well = "\tok";

/** The cells of a point's keys. */
std::string place_of(const std::vector<double>& values)
{
  std::string cells;
  for (const double value : values) cells += Cell(value).text() + "\t";
  return cells;
}

/** The row of one point. */
std::string row_of(const Task& task, const std::vector<Quantity>& chosen,
                   const std::vector<double>& values, PeriodicMotion& before)
{
  std::string row = place_of(values), status = "ok";
  std::optional<Point> point;
  for (const Quantity& quantity : chosen) {
    std::string text = "-";
    try {
      if (!point && status == "ok") point.emplace(task, values, before);
      if (point) {
        const Cell cell = quantity.value(*point);
        if (!cell.is_finite()) throw NoSolution(quantity.name + " is not finite");
        text = cell.text();
      }
    } catch (const std::runtime_error& none) {
      if (status == "ok") status = printable(none.what());
    }
    row += text + "\t";
  }
  return row + status;
}

/** Rows in order of their lines, written as soon as all before them are there. */
class Output {
public:
  Output(const Task& task, std::string header) : task_(task), next_(task.grid.first)
  {
    if (task.request.resume)
      copy(*task.request.resume, header);
    else
      print(header);
  }

  std::size_t next() const { return next_; }

  /** Waits until the line is not too far ahead of the first that is missing: what is kept is bounded. */
  void wait_for_turn(std::size_t line)
  {
    constexpr std::size_t most_ahead = 256;
    std::unique_lock lock(mutex_);
    moved_.wait(lock, [&] { return stopped_ || line < next_ + most_ahead; });
  }

  void take(std::size_t line, std::string rows, std::size_t failed)
  {
    const std::lock_guard lock(mutex_);
    failed_ += failed;
    waiting_[line] = std::move(rows);
    for (; !waiting_.empty() && waiting_.begin()->first == next_; ++next_) {
      print(waiting_.begin()->second);
      waiting_.erase(waiting_.begin());
    }
    moved_.notify_all();
  }

  /** Nobody waits for a line that will not come. */
  void stop()
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    moved_.notify_all();
  }

  std::size_t failed() const { return failed_; }
  const std::string& all() const { return all_; }  ///< kept for --plot alone

private:
  void print(const std::string& text)
  {
    write(text);
    if (task_.request.plot) all_ += text;
  }

  /** The whole lines of x of an interrupted table. Throws BadInput when it is another one. */
  void copy(const std::string& file, const std::string& header)
  {
    std::ifstream in = open_file(file, "a map", std::uintmax_t{1} << 60);
    std::string found(header.size(), '\0');
    in.read(found.data(), static_cast<std::streamsize>(found.size()));
    found.resize(static_cast<std::size_t>(in.gcount()));
    if (!header.starts_with(found)) {
      const std::string writer = writer_of_other_schema(file);
      throw BadInput("--resume " + file +
                     (writer.empty()
                          ? ": was made with other settings"
                          : ": was written by " + writer + ", start this map anew"));
    }
    const std::size_t lines = whole_lines(in, file);
    print(header);
    in.clear();
    in.seekg(static_cast<std::streamoff>(found.size()));
    for (; next_ < lines; ++next_) {
      std::string rows, row;
      for (std::size_t k = 0; k < task_.grid.x.count && std::getline(in, row); ++k) {
        failed_ += !row.ends_with(all_well);
        rows += row + "\n";
      }
      print(rows);
    }
  }

  /** The first line of x that a table has not, or not all of. */
  std::size_t whole_lines(std::ifstream& in, const std::string& file) const
  {
    const Grid& grid = task_.grid;
    std::size_t line = grid.first, k = 0;
    for (std::string row; std::getline(in, row) && !in.eof();) {
      if (line == grid.last || !row.starts_with(place_of(grid.values(line, k))))
        throw BadInput("--resume " + file + ": holds other points");
      k = (k + 1) % grid.x.count;
      line += k == 0;
    }
    return line;
  }

  const Task& task_;
  std::mutex mutex_;
  std::condition_variable moved_;
  bool stopped_ = false;
  std::map<std::size_t, std::string> waiting_;
  std::size_t next_, failed_ = 0;
  std::string all_;
};

}  // namespace

const std::vector<Column>& map_quantities()
{
  static const std::vector<Column> columns(quantities.begin(), quantities.end());
  return columns;
}

void explore_map(const MapRequest& request)
{
  const Task task = task_of(request);
  const std::vector<Quantity> chosen = chosen_quantities(task);
  if (request.threads > 0) omp_set_num_threads(request.threads);
  Output output(task, header_of(task, chosen));
  const std::size_t first = output.next(), points = task.grid.x.count;
  in_parallel(task.request.quiet ? "" : "lines", task.grid.last - first,
              [&](std::size_t piece) {
                try {
                  output.wait_for_turn(first + piece);
                  std::string rows;
                  std::size_t failed = 0;
                  PeriodicMotion before;
                  for (std::size_t k = 0; k < points; ++k) {
                    const std::string row =
                        row_of(task, chosen, task.grid.values(first + piece, k), before);
                    failed += !row.ends_with(all_well);
                    rows += row + "\n";
                  }
                  output.take(first + piece, std::move(rows), failed);
                } catch (...) {
                  output.stop();
                  throw;
                }
              });
  if (output.failed() > 0)
    std::fprintf(stderr, "%zu of %zu points have no result: see their status\n",
                 output.failed(), (task.grid.last - task.grid.first) * points);
  if (!request.plot) return;
  const std::string undrawn = plot(*request.plot, script, output.all());
  if (!undrawn.empty()) throw NoSolution(undrawn);
}

}  // namespace rotor_stator::explore
