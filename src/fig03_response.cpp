/**
# Figure 3: amplitudes of rotor and stator against the speed

Paper: §3.3, Fig. 3; data set 2 is added.
Run: `build/fig03_response > data/generated/fig03_response.tsv`

The figure shows how strongly rotor and stator vibrate at each speed of rotation, with the
small clearance (left) and the large one (right). The first two rows are the horizontal
motion x, on a linear and on a logarithmic scale; the third is the vertical motion y, the
fourth the stator's amplitude of x over the rotor's. The amplitude of a displacement is
half the difference between its largest and its smallest value in one turn; the paper
defines neither it (D-10) nor the range of speeds (D-19).

The peak is the resonance of both bodies moving as one: the unbalance presses them
together, and they vibrate like a single mass on both suspensions. Its speed follows from
their natural frequencies (Table 1) and masses (D-13) alone. With the small clearance the
curves have kinks between 10 and 19 Hz. There the force of the unbalance is about as large
as the weight, and contact may be lost during a turn.

Each curve is computed in three ways. Harmonic balance assumes a motion that repeats after
one turn and finds its Fourier coefficients; the solutions at the last speeds predict the
one at the next (Eqs 19 to 21). This is done once with rising and once with falling speed.
Where the two differ, several periodic solutions exist at one speed. A gap is a speed at
which no solution was found.

Time integration is the check, at fewer speeds. It starts from rest and continues until
the motion is steady. The motion is recorded twelve times per vibration of the contact,
which vibrates some hundred times in a slow turn. A full point is a motion that repeats
after one turn; its distance from the curve is the error of harmonic balance. An open
point is a motion that does not; there the curve does not describe the motion after a
start from rest. With the large clearance most speeds below the resonance are of this
kind, and at low speeds the curve has wide gaps. The figure says nothing about stability;
the figure `stability` does. */
#include "balance/fourier_transform.hpp"
#include "continuation/sweep.hpp"
#include "io/program.hpp"
#include "motion/contact.hpp"

namespace {

using namespace rotor_stator;

struct DataSet {
  int number;  ///< 1, 2, … in the scene's order
  Parameters machine;
  int harmonics;  ///< m
};

enum class Curve { speed_up = 1, speed_down = 2, time_integration = 3 };

struct Row {
  int set;
  Curve curve;
  int segment;
  double frequency;
  std::array<double, 4> amplitude;  ///< of x_s, y_s, x_r, y_r [m]
  double contact;
  int newton = 0;
  double spread = 0;
  bool periodic = true;  ///< harmonic balance finds nothing else
  /** Standard errors. */
  double spread_error = 0, contact_error = 0;
  std::array<double, 4> amplitude_error = {};
};

using Fields = std::vector<Field<Row>>;
const Fields fields =
    Fields{{"set", "-", "data set", &Row::set},
           {"curve", "-", "1 harmonic balance speed up, 2 speed down, 3 time integration",
            &Row::curve},
           {"segment", "-", "counts the gaps where no solution was found", &Row::segment},
           {"f", "Hz", "speed of rotation", &Row::frequency}} +
    displacement_fields<Row>("amp_", "half peak-to-peak of ", &Row::amplitude) +
    Fields{{"contact", "-", "share of the time with at least one loaded ball",
            &Row::contact},
           {"newton", "-", "Newton iterations, 0 for time integration", &Row::newton},
           {"spread", "-", "Poincare spread over the largest displacement", &Row::spread},
           {"periodic", "-",
            "1 if the motion has the period of rotation; where 0, the amplitudes and the "
            "share of contact are means over single turns, the spread over windows of a "
            "second",
            &Row::periodic},
           {"spread_error", "-", "standard error of spread", &Row::spread_error},
           {"contact_error", "-", "standard error of contact", &Row::contact_error}} +
    displacement_fields<Row>("amp_", "standard error of amp_", &Row::amplitude_error,
                             "_error");

/** The amplitudes along a sweep, with a gap wherever no solution was found. */
void add_curve(Table& table, const DataSet& set, Curve curve,
               const std::vector<PeriodicMotion>& solutions)
{
  int segment = 1;
  bool connected = false;
  table.gap();
  for (const PeriodicMotion& solution : solutions) {
    /** After a cold start it may lie on another branch. */
    if (connected && (!solution.found() || solution.start != from_predictor)) {
      ++segment;
      table.gap();
    }
    connected = solution.found();
    if (!solution.found()) continue;
    const Eigen::Vector4d a = half_peak_to_peak(solution.bodies);
    table.row(fields, {.set = set.number,
                       .curve = curve,
                       .segment = segment,
                       .frequency = solution.omega / angular(1),
                       .amplitude = {a[0], a[1], a[2], a[3]},
                       .contact = motion::contact_share(set.machine,
                                                        motion::motion_of(solution, 256)),
                       .newton = solution.newton.iterations});
  }
  table.gap();
}

/** Of an aperiodic motion, the amplitudes and the contact of a turn. */
void average_over_turns(Row& row, const Parameters& machine, const motion::Motion& motion)
{
  for (std::size_t i = 0; i < 4; ++i) {
    const BatchMean mean = mean_over(motion, 1, [i](const motion::Motion& turn) {
      return half_peak_to_peak(turn)[i];
    });
    row.amplitude[i] = mean.value;
    row.amplitude_error[i] = mean.error;
  }
  const auto share = [&](const motion::Motion& turn) {
    return motion::contact_share(machine, turn);
  };
  row.contact_error = mean_over(motion, 1, share).error;
}

/** Those of the motions that settle from rest, looked at twelve times in a vibration of
    the contact. */
void add_settled(Table& table, const DataSet& set, const std::vector<double>& speeds,
                 const SteadySettings& integration)
{
  std::vector<SteadyRun> runs;
  for (const double frequency : speeds) {
    SteadySettings settings = integration;
    int& instants = settings.stepper.intervals_per_period;
    instants = std::max(instants, motion::instants_of(set.machine, angular(frequency)));
    runs.push_back(
        {set.machine, angular(frequency), static_start(set.machine), settings});
  }
  std::vector<Row> rows(speeds.size());
  Progress progress("time integration", speeds.size());
  steady_states(runs, [&](std::size_t k, const SteadyState& settled) {
    const int instants = runs[k].settings.stepper.intervals_per_period;
    const motion::Motion motion = motion::motion_of(settled, instants);
    rows[k] = {.set = set.number,
               .curve = Curve::time_integration,
               .segment = 1,
               .frequency = speeds[k],
               .amplitude = half_peak_to_peak(motion),
               .contact = motion::contact_share(set.machine, motion),
               .spread = settled.spread,
               .periodic = settled.periodic,
               .spread_error = settled.spread_error};
    if (!settled.periodic) average_over_turns(rows[k], set.machine, motion);
    progress.step();
  });
  for (const Row& row : rows) table.row(fields, row);
}

}  // namespace

int main(int argc, char** argv)
{
  return run_figure(argc, argv, [](SceneFile& file) {
    const auto machines = read_parameter_list(file, "parameters");
    const auto harmonics = file.toml().integers("harmonics", 1, 4096);
    const std::vector<double> upwards = file.speed_range("balance_hz"),
                              downwards(upwards.rbegin(), upwards.rend()),
                              time_speeds = file.speed_range("time_integration_hz");
    const SteadySettings integration = read_steady_settings(file);
    if (harmonics.size() != machines.size())
      file.toml().fail("harmonics", "must have one value for each of parameters");
    file.toml().refuse_unknown_keys();
    Table table("Frequency response (Fig. 3)", fields);
    for (std::size_t k = 0; k < machines.size(); ++k) {
      describe(table, machines[k], false);
      table.row_line("clearance", {machines[k].bearing.clearance});
      table.row_line("harmonics", {harmonics[k], default_samples(harmonics[k])});
    }
    table.note("rows of each data set; harmonics: m, N");
    table.note("modelled: amplitudes of the m-harmonic solution; time integration by " +
               integration.stepper.method + " from rest at each of its speeds");
    for (std::size_t k = 0; k < machines.size(); ++k) {
      const DataSet set{static_cast<int>(k) + 1, machines[k], harmonics[k]};
      add_curve(table, set, Curve::speed_up,
                sweep(set.machine, angular(upwards), set.harmonics));
      add_curve(table, set, Curve::speed_down,
                sweep(set.machine, angular(downwards), set.harmonics));
      add_settled(table, set, time_speeds, integration);
    }
    return table;
  });
}
