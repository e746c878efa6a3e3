#include "studies/clearance_stiffness.hpp"

#include <algorithm>
#include <cmath>

#include "balance/fourier_transform.hpp"
#include "continuation/sweep.hpp"
#include "io/errors.hpp"
#include "io/journal.hpp"
#include "motion/motion.hpp"

namespace rotor_stator::studies
{

Parameters ParametricStudy::machine(std::size_t index) const
{
  Parameters parameters = base;
  parameters.bearing.clearance = clearances[index % clearances.size()];
  parameters.bearing.contact_stiffness = contact_stiffnesses[index / clearances.size()];
  return parameters;
}

ParametricStudy read_parametric_study(const std::string& file)
{
  SceneFile scene_file(file, "exchanged");
  StrictToml& toml = scene_file.toml();
  ParametricStudy study{.base = read_parameters(scene_file, "parameters"),
                        .harmonics = toml.integer("harmonics", 1, 256),
                        .frequencies = scene_file.speed_range("speeds_hz"),
                        .clearances = {},
                        .contact_stiffnesses = {}};
  StrictToml grid = toml.table("grid");
  const int clearances = grid.integer("clearances", 2, 1000);
  const double largest = grid.number("largest_clearance_m", Range::positive);
  for (int k = 0; k < clearances; ++k)
    study.clearances.push_back(largest * k / (clearances - 1));
  const int stiffnesses = grid.integer("stiffnesses", 2, 1000);
  const double low = grid.number("least_stiffness_N_per_m1p5", Range::positive);
  const double high = grid.number("largest_stiffness_N_per_m1p5", Range::positive);
  for (int k = 0; k < stiffnesses; ++k)
    study.contact_stiffnesses.push_back(low *
                                        std::pow(high / low, k / (stiffnesses - 1.0)));
  grid.refuse_unknown_keys();
  toml.refuse_unknown_keys();
  return study;
}

namespace
{

double largest_ball_force(const Parameters& parameters, const motion::Motion& motion)
{
  double largest = 0;
  for (const auto& forces : motion::contact_evolution(parameters, motion).ball_force)
    largest = std::max(largest, *std::max_element(forces.begin(), forces.end()));
  return largest;
}

/** Adds one solution of the sweep to what it comes to, and its amplitude to the curve. */
void add_solution(const Parameters& parameters, double frequency,
                  const Eigen::MatrixXd& bodies, StudyPoint& point,
                  std::vector<motion::CurvePoint>& curve)
{
  const motion::Motion motion = motion::motion_of(bodies, 128);
  point.largest_force =
      std::max(point.largest_force, largest_ball_force(parameters, motion));
  curve.push_back({frequency, half_peak_to_peak(motion)[2]});
  if (motion::contact_share(parameters, motion) < 1) {
    if (point.f_loss_first < 0) point.f_loss_first = frequency;
    point.f_loss_last = frequency;
  }
}

}  // namespace

StudyPoint sweep_machine(const Parameters& parameters, const ParametricStudy& study)
{
  StudyPoint point{-1, -1, -1, -1, 0, 0};
  std::vector<motion::CurvePoint> curve;
  for (const PeriodicMotion& motion :
       sweep(parameters, angular(study.frequencies), study.harmonics)) {
    if (motion.found())
      add_solution(parameters, motion.omega / angular(1), motion.bodies, point, curve);
    else
      ++point.missed;
  }
  if (!curve.empty()) {
    const motion::CurvePoint peak = motion::refined_peak(curve);
    point.f_peak = peak.frequency;
    point.amp_peak = peak.amplitude;
  }
  return point;
}

namespace
{

const std::vector<Column> study_columns{
    {"delta", "m", "radial clearance"},
    {"K_H", "N/m^1.5", "contact stiffness"},
    {"f_peak", "Hz", "speed of the largest x_r; -1 without any solution"},
    {"amp_peak", "m", "half peak-to-peak of x_r there"},
    {"f_loss_first", "Hz", "first speed at which contact is lost; -1 when never"},
    {"f_loss_last", "Hz", "last such speed; -1 when never"},
    {"largest_force", "N", "largest force on one ball over all speeds"},
    {"missed", "-", "speeds without a solution"}};

}  // namespace

Table study_table(const std::string& scene_file, const std::string& journal)
{
  const ParametricStudy study = read_parametric_study(scene_file);
  Table table("Clearance against contact stiffness", study_columns);
  describe(table, study.base);
  table.note(format("modelled: sweeps up, m = %d, %zu speeds from %g to %g Hz",
                    study.harmonics, study.frequencies.size(), study.frequencies.front(),
                    study.frequencies.back()));
  const auto rows = run_study(
      {.name = "machines",
       .journal = journal,
       .stamp = stamp_of({scene_file, study.base.file}),
       .pieces = study.points(),
       .work = [&](std::size_t k) {
         const StudyPoint p = sweep_machine(study.machine(k), study);
         return Row{p.f_peak,      p.amp_peak,      p.f_loss_first,
                    p.f_loss_last, p.largest_force, static_cast<double>(p.missed)};
       }});
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Parameters machine = study.machine(k);
    std::vector<Cell> cells{machine.bearing.clearance, machine.bearing.contact_stiffness};
    cells.insert(cells.end(), rows[k].begin(), rows[k].end());
    table.row(std::move(cells));
  }
  return table;
}

}  // namespace rotor_stator::studies
