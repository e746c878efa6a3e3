#include "explore/map_quantities.hpp"

#include <algorithm>

#include "balance/fourier_transform.hpp"
#include "continuation/sweep.hpp"
#include "explore/measures.hpp"
#include "io/errors.hpp"
#include "motion/contact.hpp"
#include "motion/find_periodic.hpp"
#include "motion/judge.hpp"
#include "time/period_map.hpp"

namespace rotor_stator::explore {

namespace {

constexpr int instants = 512, swept_instants = 128;  // of a period, of a turn

/** A response curve over the speeds of --sweep. */
struct Swept {
  CurvePoint peak = {};  ///< of x_r [Hz, m]
  int solved = 0, permanent = 0;
  double loss_first = -1, loss_last = -1;  ///< speeds losing contact [Hz]; -1: none
  double ball_load = 0;                    ///< [N]
};

}  // namespace

/** One point. Its functions throw NoSolution where it has no such value. */
class MapPoint {
public:
  /** A machine at its speed [Hz]. */
  MapPoint(const MapTask& task, std::pair<Parameters, double> at, PeriodicMotion& before)
      : task_(task), machine_(std::move(at.first)), frequency_(at.second), before_(before)
  {
  }

  /**
  ## The solution of harmonic balance */

  const PeriodicMotion& solution()
  {
    return solution_([&] {
      BalanceSearch near = search();
      if (before_.found() && before_.harmonics.count() == near.harmonics)
        near.starts.push_back(before_.x);
      PeriodicMotion found = is_chosen() ? chosen().motion : motion::find_periodic(near);
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
      motion::Judged at =
          motion::to_tolerance(search(), task_.request.tolerance.value_or(1e-3));
      if (!at.reached) throw NoSolution("tolerance not reached: " + at.end);
      return at;
    });
  }

  int harmonics() { return chosen().motion.harmonics.count() / base_.turns; }

  const motion::Verdict& verdict()
  {
    return verdict_([&] {
      return is_chosen() ? chosen().verdict
                         : motion::judge(based_.machine, solution(), budget_);
    });
  }

  /** The multipliers of the motion of Eq. 7 near it, and of its own m harmonics. */
  const Floquet& floquet()
  {
    if (!verdict().found()) throw NoSolution(verdict().reason);
    return verdict().floquet;
  }
  const Floquet& series()
  {
    return series_([&] { return series_multipliers(based_.machine, solution()); });
  }

  double error()
  {
    if (verdict().found()) return verdict().distance.rms;
    const Settled& there = verdict().from_there;
    if (there.kind == Kind::undecided) throw NoSolution(verdict().reason);
    const auto steps =
        flow(based_.machine, based_.omega,
             {.method = "auto", .intervals_per_period = instants, .budget = budget_});
    State state = there.at.state;
    return motion::rms_difference(
        motion::motion_of(solution(), instants),
        motion::recorded(*steps, instants, state, there.at.period,
                         std::max(1, there.period) * 40));
  }

  /**
  ## The motion from rest, and what both have */

  motion::Question question() const
  {
    motion::Request asked = task_.request;
    asked.omega = angular(frequency_);
    asked.periods = Measures::open_periods;
    asked.is_measured = asked.tolerance ||
                        asks_for({"stability", "multiplier", "uncertainty", "lyapunov"});
    if (is_balance()) asked.method = "auto", asked.tolerance.reset();
    asked.step_ratio = step_ratio(asked.tolerance);
    return {machine_,
            asked,
            budget_,
            {},
            machine_.bodies->patience().transient_share,
            asks_for({"amplitude"})};
  }

  /** What its question came to. */
  void take(motion::Observed settled) { settled_ = std::move(settled); }

  const motion::Answer& settled() { return settled_.answer.get(); }
  const motion::Answer& answer()
  {
    return answer_([&] {
      motion::Answer whole = settled();
      complete(whole, question().request, budget_);
      return whole;
    });
  }
  double lyapunov()
  {
    return answer().settled.lyapunov.value * angular(1) / answer().omega;
  }

  double amplitude()
  {
    return is_balance() ? half_peak_to_peak(solution().bodies)[2]
                        : settled_.seen.get().amplitude[2];
  }
  /** A measure of that name. */
  Cell measured(const std::string& name)
  {
    const Measures measures(name, machine_);
    if (is_balance()) return measures.of(based_.machine, solution(), instants).at(0);
    const motion::Answer& whole = whole_(
        [&] { return whole_motion(measures, settled(), question().request, budget_); });
    return measures.of(record_of(whole)).at(0);
  }

  std::string stability() { return is_balance() ? verdict().word() : answer().stability; }

  /** The largest multiplier and its uncertainty. */
  std::pair<double, double> multiplier()
  {
    if (is_balance()) return {floquet().largest(), floquet().uncertainty()};
    if (!(answer().multiplier > 0)) throw NoSolution("the motion does not close");
    return {answer().multiplier, answer().uncertainty};
  }

  /**
  ## The solutions at the speeds of --sweep */

  const Swept& swept()
  {
    return swept_([&] {
      require_period();
      Swept all;
      std::vector<CurvePoint> curve;
      std::vector<double> speeds = angular(task_.sweep);
      for (double& omega : speeds) omega *= base_.per_turn;
      for (const PeriodicMotion& at :
           rotor_stator::sweep(based_.machine, speeds, base_.turns * task_.harmonics,
                               base_.turns * task_.samples, budget_)) {
        if (!at.found()) continue;
        const int instants = base_.turns * swept_instants;
        budget_.spend(3 * instants);
        const double hertz = at.omega / (angular(1) * base_.per_turn);
        const motion::Motion motion = motion::motion_of(at, instants);
        curve.push_back({hertz, motion::half_peak_to_peak(motion)[2]});
        all.ball_load =
            std::max(all.ball_load, motion::largest_ball_load(based_.machine, motion));
        if (motion::contact_share(based_.machine, motion) == 1) {
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

  int missed() { return static_cast<int>(task_.sweep.size()) - swept().solved; }

private:
  bool is_balance() const { return task_.request.method == "aft"; }
  /** Whether the tolerance chooses m. */
  bool is_chosen() const { return task_.request.tolerance.has_value(); }

  bool asks_for(const std::vector<std::string>& names) const
  {
    return std::ranges::find_first_of(task_.request.quantities, names) !=
           task_.request.quantities.end();
  }

  void require_period() const
  {
    if (base_.is_driven_twice())
      throw NoSolution(
          format("two frequencies drive, %.9g balls pass in a turn: without "
                 "--harmonics and --tolerance there are amplitudes",
                 passages_per_turn(machine_.bearing)));
  }

  BalanceSearch search() const
  {
    require_period();
    return {.parameters = based_.machine,
            .omega = based_.omega,
            .harmonics = base_.turns * task_.harmonics,
            .samples = base_.turns * task_.samples,
            .newton = {.tolerance = task_.request.newton_tolerance},
            .budget = budget_};
  }

  const MapTask& task_;
  Parameters machine_;
  double frequency_;  ///< [Hz]
  BasePeriod base_ = base_period(machine_);
  Based based_ = over(base_, machine_, angular(frequency_));
  PeriodicMotion& before_;
  OperationBudget budget_ =
      budget_of_each(task_.request.budget, seconds_of_a_point, machine_);
  Once<PeriodicMotion> solution_;
  Once<motion::Judged> chosen_;
  Once<motion::Verdict> verdict_;
  Once<Floquet> series_;
  motion::Observed settled_;
  Once<motion::Answer> answer_;
  Once<motion::Answer> whole_;
  Once<Swept> swept_;
};

namespace {

const std::vector<Quantity> quantities{
    {"amplitude", "m", "half peak-to-peak of x_r", Source::motion, &MapPoint::amplitude},
    {"mean", "m", "mean of y_r", Source::motion,
     [](auto& p) { return p.measured("mean_y_r"); }},
    {"stability", "word",
     "of the motion, or of that of Eq. 7 found from the solution: stable, unstable, "
     "undecided",
     Source::motion, &MapPoint::stability},
    {"multiplier", "-", "largest modulus of the multipliers behind stability",
     Source::motion, [](auto& p) { return p.multiplier().first; }},
    {"uncertainty", "-", "of multiplier", Source::motion,
     [](auto& p) { return p.multiplier().second; }},

    {"period", "-",
     "K of the motion from rest; 0 chaotic, -1 quasi-periodic, -2 undecided",
     Source::rest, [](auto& p) { return p.settled().period_number(); }},
    {"regime", "word",
     "of the motion from rest: rest, periodic, quasi-periodic, chaotic, undecided",
     Source::rest, [](auto& p) { return word(p.settled().kind()); }},
    {"lyapunov", "1/base period", "largest Lyapunov exponent of the motion from rest",
     Source::rest, &MapPoint::lyapunov},

    {"harmonics", "-", "m that --tolerance needs, 1e-3 without it", Source::solution,
     &MapPoint::harmonics},
    {"distance", "-",
     "of the solution from the motion behind stability, rms about the mean",
     Source::solution, [](auto& p) { return p.floquet(), p.verdict().distance.rms; }},
    {"error", "-",
     "of the solution, rms about the mean: distance or, where no motion was found near "
     "it, that from what integration settles on from the solution",
     Source::solution, &MapPoint::error},
    {"evaluations", "-", "of the force, for the verdict of stability", Source::solution,
     [](auto& p) { return p.verdict().evaluations; }},
    {"series", "-", "largest modulus of the multipliers along the m harmonics",
     Source::solution, [](auto& p) { return p.series().largest(); }, true},
    {"series_uncertainty", "-", "of series", Source::solution,
     [](auto& p) { return p.series().uncertainty(); }, true},
    {"series_stability", "word", "what they say: stable, unstable, undecided",
     Source::solution, [](auto& p) { return p.series().verdict(); }, true},

    {"peak", "m", "largest amplitude over the speeds of --sweep, refined by a parabola",
     Source::sweep, [](auto& p) { return p.swept().peak.amplitude; }},
    {"peak_frequency", "Hz", "its speed", Source::sweep,
     [](auto& p) { return p.swept().peak.frequency; }},
    {"permanent", "-", "share of the solved speeds of --sweep with permanent contact",
     Source::sweep, [](auto& p) { return 1.0 * p.swept().permanent / p.swept().solved; }},
    {"loss_first", "Hz", "first speed of --sweep at which contact is lost; -1: none",
     Source::sweep, [](auto& p) { return p.swept().loss_first; }},
    {"loss_last", "Hz", "last such speed; -1: none", Source::sweep,
     [](auto& p) { return p.swept().loss_last; }},
    {"largest_load", "N", "largest force on a ball over the speeds of --sweep",
     Source::sweep, [](auto& p) { return p.swept().ball_load; }},
    {"missed", "-", "speeds of --sweep without a solution", Source::sweep,
     &MapPoint::missed}};

/** The quantity, or the measure of a machine, of that name. */
Quantity named(const std::string& name, const std::function<Parameters()>& machine)
{
  if (const auto found = std::ranges::find(quantities, name, &Quantity::name);
      found != quantities.end())
    return *found;
  if (const Measures one(name, machine()); !one.empty())
    return {one.columns()[0], Source::motion,
            [name](MapPoint& p) { return p.measured(name); }};
  std::vector<std::string> known;
  for (const Quantity& q : quantities) known.push_back(q.name);
  throw BadInput("--quantity " + name + ": is not a quantity" + suggestion(name, known) +
                 " (known: " + joined(known, ", ") +
                 "; measures such as contact_share, ball_load, force, rms_v_x_r)");
}

std::string row_of(MapPoint* point, const std::vector<Quantity>& chosen,
                   std::string status)
{
  std::string row;
  for (const Quantity& quantity : chosen) {
    std::string text = no_value;
    try {
      if (point) {
        const Cell cell = quantity.value(*point);
        if (!cell.is_finite()) throw NoSolution(quantity.name + " is not finite");
        text = cell.text();
      }
    } catch (const std::runtime_error& none) {
      if (status == all_well) status = printable(none.what());
    }
    row += text + "\t";
  }
  return row + status;
}

}  // namespace

std::vector<Column> map_quantities()
{
  return {quantities.begin(), quantities.end()};
}

std::vector<Quantity> chosen_quantities(const MapTask& task)
{
  const MapRequest& request = task.request;
  const auto first = [&] {
    return task.machine(task.grid.values(task.grid.first, 0)).first;
  };
  std::vector<Quantity> chosen;
  for (const std::string& name : request.quantities) {
    chosen.push_back(named(name, first));
    if (std::ranges::count(chosen, name, &Quantity::name) > 1)
      throw BadInput("--quantity " + name + ": is given twice");
  }
  /** The first of these sources, or nothing. */
  const auto of = [&](auto... sources) {
    const auto one = std::ranges::find_if(
        chosen, [&](const Quantity& q) { return ((q.source == sources) || ...); });
    return one == chosen.end() ? std::string() : one->name;
  };
  const std::string swept = of(Source::sweep), balanced = of(Source::solution),
                    here = of(Source::solution, Source::motion, Source::rest);
  const bool has_speed = request.frequency || task.has_speed();
  if (!swept.empty() && task.sweep.empty())
    throw BadInput("--sweep: is missing, the speeds of " + swept);
  if (!swept.empty() && request.tolerance)
    throw BadInput("--tolerance: not for " + swept + ", over --sweep; give --harmonics");
  if (swept.empty() && !task.sweep.empty())
    throw BadInput("--sweep: no quantity of a range of speeds is asked for");
  if (!here.empty() && !has_speed)
    throw BadInput("--frequency: is missing, the speed of " + here);
  if (here.empty() && has_speed)
    throw BadInput("--frequency: the quantities asked for are those of --sweep");
  const Parameters machine = first();
  if (request.method != "aft" && !(balanced + swept).empty())
    throw BadInput("--method " + request.method + ": " +
                   (balanced.empty() ? swept : balanced) + " is of harmonic balance; " +
                   (base_period(machine).is_driven_twice()
                        ? "a map has none where two frequencies drive; response has "
                          "amplitudes over speeds"
                        : "give --harmonics M"));
  const auto is_from_rest = [](const Quantity& q) { return q.source == Source::rest; };
  if (request.method == "aft" && std::ranges::all_of(chosen, is_from_rest))
    throw BadInput("--harmonics, --method aft: " + here +
                   " is of the motion from rest; leave them out");
  require_method_of(machine, request.method);
  for (const Quantity& one : chosen)
    if (one.of_two_masses)
      require_two_masses(machine, ("--quantity " + one.name).c_str());
  return chosen;
}

std::vector<std::string> rows_of(const MapTask& task, const std::vector<Quantity>& chosen,
                                 std::span<const std::vector<double>> points,
                                 PeriodicMotion& before)
{
  std::vector<std::unique_ptr<MapPoint>> made;
  std::vector<std::string> statuses;
  for (const auto& values : points) try {
      made.push_back(std::make_unique<MapPoint>(task, task.machine(values), before));
      statuses.emplace_back(all_well);
    } catch (const std::runtime_error& none) {
      made.push_back(nullptr);
      statuses.push_back(printable(none.what()));
    }
  const bool is_balance = task.request.method == "aft";
  const bool needs_rest = std::ranges::any_of(chosen, [&](const Quantity& one) {
    return one.source == Source::rest || (one.source == Source::motion && !is_balance);
  });
  std::vector<motion::Question> questions;
  for (const auto& point : made)
    if (point && needs_rest) questions.push_back(point->question());
  auto answers = motion::observed_answers(questions);
  for (auto answer = answers.begin(); const auto& point : made)
    if (point && needs_rest) point->take(std::move(*answer++));
  std::vector<std::string> rows;
  for (std::size_t k = 0; k < points.size(); ++k) {
    std::string keys;
    for (const double value : points[k]) keys += Cell(value).text() + "\t";
    rows.push_back(keys + row_of(made[k].get(), chosen, statuses[k]));
    made[k].reset();  // with its records
  }
  return rows;
}

}  // namespace rotor_stator::explore
