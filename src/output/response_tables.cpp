/**
# The table of the response

Figure 3: amplitudes against speed, by both methods. */
#include "output/figure_tables.hpp"

#include "model/errors.hpp"

namespace rotor_stator
{

namespace
{

const std::vector<Column> response_columns{
    {"set", "-", "data set"},
    {"curve", "-", "1 harmonic balance speed up, 2 speed down, 3 time integration"},
    {"segment", "-", "counts the gaps where no solution was found"},
    {"f", "Hz", "speed of rotation"},
    {"amp_x_s", "m", "half peak-to-peak of x_s"},
    {"amp_y_s", "m", "half peak-to-peak of y_s"},
    {"amp_x_r", "m", "half peak-to-peak of x_r"},
    {"amp_y_r", "m", "half peak-to-peak of y_r"},
    {"contact", "-", "share of the time with at least one loaded ball"},
    {"newton", "-", "Newton iterations, 0 for time integration"},
    {"spread", "-", "Poincare spread over the largest displacement"},
    {"periodic", "-", "1 if the motion has the period of rotation"}};

std::vector<Cell> response_cells(const ResponsePoint& p)
{
  return {p.set,           static_cast<int>(p.curve),
          p.segment,       p.frequency,
          p.amplitude[0],  p.amplitude[1],
          p.amplitude[2],  p.amplitude[3],
          p.contact_share, p.newton_iterations,
          p.spread,        p.periodic};
}

bool same_line(const ResponsePoint& a, const ResponsePoint& b)
{
  return a.set == b.set && a.curve == b.curve && a.segment == b.segment;
}

}  // namespace

Table response_table(const ResponseScene& scene)
{
  Table table("Frequency response (Fig. 3)", response_columns);
  for (std::size_t set = 0; set < scene.sets.size(); ++set) {
    table.describe(scene.sets[set]);
    table.note(text("  harmonic balance: m = %d, N = %d, relative tolerance %g",
                    scene.harmonics[set], default_samples(scene.harmonics[set]),
                    NewtonSettings{}.tolerance));
  }
  table.note("modelled: amplitudes of the m-harmonic solution; time integration by " +
             scene.time_integration.stepper.method + " from rest at each of its speeds");
  const auto points = compute_response(scene);
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (k > 0 && !same_line(points[k - 1], points[k])) table.gap();
    table.row(response_cells(points[k]));
  }
  return table;
}

namespace
{

const std::vector<Column> timing_columns{
    {"method", "-", "aft: harmonic balance; rk4: classical Runge-Kutta with fixed step"},
    {"harmonics", "-", "m; for rk4 that of the row whose error it reaches"},
    {"samples", "-", "N per period; 0 for rk4"},
    {"cpu_s", "s", "CPU of one thread for the whole sweep, median of the repetitions"},
    {"cpu_min_s", "s", "least"},
    {"cpu_max_s", "s", "most"},
    {"error", "-", "largest relative error of displacement over the periodic speeds"},
    {"error_force", "-", "largest relative error of force over the periodic speeds"},
    {"ratio", "-", "CPU of the rk4 row with the same harmonics over this row's"},
    {"step_s", "s", "rk4: longest step; 0 for aft"},
    {"transient_s", "s", "rk4: transient at each speed; 0 for aft"},
    {"evaluations", "-", "evaluations of the bearing's force"},
    {"worst_f", "Hz", "speed with the largest error of displacement"},
    {"paper_cpu", "-", "the paper's figure, unit not given"}};

}  // namespace

Table timing_table(const TimingScene& scene)
{
  Table table("CPU time of the same sweep at equal error (paper: section 3.3)",
              timing_columns);
  table.describe(scene.parameters);
  const TimingResult result = compute_timing(scene);
  table.note(text("modelled: %zu speeds from %g to %g Hz; %d repetitions",
                  scene.frequencies.size(), scene.frequencies.front(),
                  scene.frequencies.back(), scene.repetitions));
  table.note(text("reference: %s to its steady state, Poincare spread below %.3g",
                  scene.reference.stepper.method.c_str(), result.reference_spread));
  std::string list;
  for (double frequency : result.aperiodic) list += text(" %g", frequency);
  table.note("not T-periodic, left out of the errors [Hz]:" +
             (list.empty() ? " none" : list));
  for (const TimedSweep& s : result.sweeps)
    table.row({s.method, s.harmonics, s.samples, s.cpu.median, s.cpu.least, s.cpu.most,
               s.error, s.error_force, s.ratio, s.step, s.transient, s.evaluations,
               s.worst_frequency, s.paper_cpu});
  return table;
}

}  // namespace rotor_stator
