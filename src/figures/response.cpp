#include "figures/response.hpp"

#include <algorithm>

#include "balance/fourier_transform.hpp"
#include "io/errors.hpp"
#include "io/parallel.hpp"
#include "io/toml_file.hpp"
#include "motion/contact.hpp"

namespace rotor_stator::figures {

namespace {

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

const std::vector<Field<Row>> fields{
    {"set", "-", "data set", &Row::set},
    {"curve", "-", "1 harmonic balance speed up, 2 speed down, 3 time integration",
     &Row::curve},
    {"segment", "-", "counts the gaps where no solution was found", &Row::segment},
    {"f", "Hz", "speed of rotation", &Row::frequency},
    {"amp_x_s", "m", "half peak-to-peak of x_s", [](auto& r) { return r.amplitude[0]; }},
    {"amp_y_s", "m", "half peak-to-peak of y_s", [](auto& r) { return r.amplitude[1]; }},
    {"amp_x_r", "m", "half peak-to-peak of x_r", [](auto& r) { return r.amplitude[2]; }},
    {"amp_y_r", "m", "half peak-to-peak of y_r", [](auto& r) { return r.amplitude[3]; }},
    {"contact", "-", "share of the time with at least one loaded ball", &Row::contact},
    {"newton", "-", "Newton iterations, 0 for time integration", &Row::newton},
    {"spread", "-", "Poincare spread over the largest displacement", &Row::spread},
    {"periodic", "-",
     "1 if the motion has the period of rotation; where 0, the amplitudes and the share "
     "of contact are means over single turns, the spread over windows of a second",
     &Row::periodic},
    {"spread_error", "-", "standard error of spread", &Row::spread_error},
    {"contact_error", "-", "standard error of contact", &Row::contact_error},
    {"amp_x_s_error", "m", "standard error of amp_x_s",
     [](auto& r) { return r.amplitude_error[0]; }},
    {"amp_y_s_error", "m", "standard error of amp_y_s",
     [](auto& r) { return r.amplitude_error[1]; }},
    {"amp_x_r_error", "m", "standard error of amp_x_r",
     [](auto& r) { return r.amplitude_error[2]; }},
    {"amp_y_r_error", "m", "standard error of amp_y_r",
     [](auto& r) { return r.amplitude_error[3]; }}};

}  // namespace

ResponseScene read_response(SceneFile& file)
{
  StrictToml& toml = file.toml();
  const auto machines = read_parameter_list(file, "parameters");
  const auto harmonics = toml.integers("harmonics", 1, 4096);
  ResponseScene scene{.sets = {},
                      .balance_speeds = file.speed_range("balance_hz"),
                      .time_speeds = file.speed_range("time_integration_hz"),
                      .time_integration = read_steady_settings(file)};
  if (harmonics.size() != machines.size())
    toml.fail("harmonics", "must have one value for each of parameters");
  for (std::size_t k = 0; k < machines.size(); ++k)
    scene.sets.push_back({static_cast<int>(k) + 1, machines[k], harmonics[k]});
  toml.refuse_unknown_keys();
  return scene;
}

Table response_table(const ResponseScene& scene)
{
  Table table("Frequency response (Fig. 3)", fields);
  for (const DataSet& set : scene.sets) {
    describe(table, set.machine, false);
    table.row_line("clearance", {set.machine.bearing.clearance});
    table.row_line("harmonics", {set.harmonics, default_samples(set.harmonics)});
  }
  table.note("rows of each data set; harmonics: m, N");
  table.note("modelled: amplitudes of the m-harmonic solution; time integration by " +
             scene.time_integration.stepper.method + " from rest at each of its speeds");
  return table;
}

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
                       .contact = motion::contact_share(
                           set.machine, motion::motion_of(solution.bodies, 256)),
                       .newton = solution.newton.iterations});
  }
  table.gap();
}

/** Of an aperiodic motion, the amplitudes and the contact of a turn. */
static void average_over_turns(Row& row, const Parameters& machine,
                               const motion::Motion& motion)
{
  std::array<std::vector<double>, 4> amplitudes;
  std::vector<double> contact;
  for (const motion::Motion& turn : motion::pieces(motion, 1)) {
    const Displacements amplitude = half_peak_to_peak(turn);
    for (std::size_t i = 0; i < 4; ++i) amplitudes[i].push_back(amplitude[i]);
    contact.push_back(motion::contact_share(machine, turn));
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const BatchMean mean = long_mean(amplitudes[i]);
    row.amplitude[i] = mean.value;
    row.amplitude_error[i] = mean.error;
  }
  row.contact_error = long_mean(contact).error;
}

static Row settled_row(const DataSet& set, double frequency, const motion::Motion& motion,
                       const SteadyState& settled)
{
  Row row{.set = set.number,
          .curve = Curve::time_integration,
          .segment = 1,
          .frequency = frequency,
          .amplitude = half_peak_to_peak(motion),
          .contact = motion::contact_share(set.machine, motion),
          .spread = settled.spread,
          .periodic = settled.periodic,
          .spread_error = settled.spread_error};
  if (!settled.periodic) average_over_turns(row, set.machine, motion);
  return row;
}

void add_settled(Table& table, const DataSet& set, const ResponseScene& scene)
{
  const std::vector<double>& speeds = scene.time_speeds;
  std::vector<SteadyRun> runs;
  for (const double frequency : speeds) {
    SteadySettings settings = scene.time_integration;
    int& instants = settings.stepper.intervals_per_period;
    instants = std::max(instants, motion::instants_of(set.machine, angular(frequency)));
    runs.push_back(
        {set.machine, angular(frequency), static_start(set.machine), settings});
  }
  std::vector<Row> rows(speeds.size());
  Progress progress("time integration", speeds.size());
  steady_states(runs, [&](std::size_t k, const SteadyState& settled) {
    const int instants = runs[k].settings.stepper.intervals_per_period;
    rows[k] = settled_row(set, speeds[k], motion::motion_of(settled, instants), settled);
    progress.step();
  });
  for (const Row& row : rows) table.row(fields, row);
}

}  // namespace rotor_stator::figures
