#include "deviations/deviations.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "balance/bearing_problem.hpp"
#include "balance/fourier_transform.hpp"
#include "continuation/arc_length.hpp"
#include "continuation/sweep.hpp"
#include "deviations/printed_equations.hpp"
#include "integration/time_stepper.hpp"
#include "io/errors.hpp"
#include "motion/other_starts.hpp"

namespace rotor_stator::deviations
{

namespace
{

void read_equations(SceneFile& file, DeviationScene& scene)
{
  StrictToml predictor = file.toml().table("predictor");
  scene.predictor_speeds = predictor.numbers("speeds_hz", Range::positive);
  if (scene.predictor_speeds.size() != 5) predictor.fail("speeds_hz", "must be five");
  predictor.refuse_unknown_keys();

  StrictToml sampling = file.toml().table("sampling");
  scene.sampled_harmonics = sampling.integers("harmonics", 1, 64);
  scene.common_samples = sampling.integers("common_samples", 3, 1 << 20);
  for (int m : scene.sampled_harmonics)
    for (int n : scene.common_samples)
      if (n < 2 * m + 1) sampling.fail("common_samples", "must be at least 2m+1 each");
  sampling.refuse_unknown_keys();

  StrictToml newton = file.toml().table("newton");
  scene.newton_start_speed = newton.number("start_speed_hz", Range::positive);
  scene.newton_iterations = newton.integers("iterations", 1, 100);
  newton.refuse_unknown_keys();

  StrictToml block = file.toml().table("block");
  scene.block_speeds = block.numbers("speeds_hz", Range::positive);
  block.refuse_unknown_keys();

  StrictToml fine = file.toml().table("fine");
  scene.fine_samples = fine.integer("samples", 2 * scene.harmonics + 1, 1 << 20);
  scene.fine_tolerance = fine.number("tolerance", Range::positive);
  scene.tolerances = fine.numbers("tolerances", Range::positive);
  scene.continuation_steps = fine.numbers("steps_hz", Range::positive);
  fine.refuse_unknown_keys();
}

void read_machine(SceneFile& file, DeviationScene& scene)
{
  StrictToml steel = file.toml().table("steel");
  scene.steel = {.young_modulus = steel.number("young_modulus_Pa", Range::positive),
                 .poisson_ratio = steel.number("poisson_ratio", Range::not_negative),
                 .ball_radius = steel.number("ball_radius_m", Range::positive)};
  steel.refuse_unknown_keys();

  StrictToml readings = file.toml().table("readings");
  scene.reading_speed = readings.number("speed_hz", Range::positive);
  readings.refuse_unknown_keys();
  StrictToml cage = file.toml().table("cage");
  scene.cage_ratios = cage.numbers("speed_ratios", Range::positive);
  cage.refuse_unknown_keys();
  StrictToml masses = file.toml().table("masses");
  scene.mass_factors = masses.numbers("factors", Range::positive);
  masses.refuse_unknown_keys();
  StrictToml rk4 = file.toml().table("rk4");
  scene.rk4_steps = rk4.numbers("steps_s", Range::positive);
  rk4.refuse_unknown_keys();
  StrictToml panels = file.toml().table("panels");
  scene.panel_speeds = panels.numbers("speeds_hz", Range::positive);
  panels.refuse_unknown_keys();
}

}  // namespace

DeviationScene read_deviation_scene(const std::string& file, const std::string& reading)
{
  if (reading != "exchanged")
    throw BadInput("--reading " + reading +
                   ": must be exchanged; the deviations compare both readings (D-09)");
  SceneFile scene_file(file, reading);
  StrictToml& toml = scene_file.toml();
  DeviationScene scene{};
  scene.parameters = read_parameters(scene_file, "parameters");
  scene.printed_parameters = read_parameters(scene_file, "printed_parameters");
  scene.harmonics = toml.integer("harmonics", 1, 64);
  scene.speed = toml.number("speed_hz", Range::positive);
  scene.gravity_speed = toml.number("gravity_speed_hz", Range::positive);
  scene.transition_speed = toml.number("transition_speed_hz", Range::positive);
  scene.range = scene_file.speed_range("range_hz");
  scene.time_integration = read_steady_settings(scene_file);
  read_equations(scene_file, scene);
  read_machine(scene_file, scene);
  toml.refuse_unknown_keys();
  return scene;
}

EvidenceList compute_deviations(const DeviationScene& scene)
{
  EvidenceList all;
  for (const auto& entry :
       {sign_of_approach,      printed_predictor,    arc_length_scaling,
        names_of_gamma,        samples_as_printed,   printed_newton_step,
        radius_of_hertz,       unit_of_stiffness,    two_readings,
        amplitude_definitions, cage_and_period,      printed_block,
        unprinted_masses,      default_sample_count, tolerance_and_step,
        runge_kutta_settings,  speeds_of_panels,     unit_of_cpu,
        kind_of_figures,       passages_over_2t,     parentheses_of_gamma,
        criteria_without_scale}) {
    const EvidenceList evidence = entry(scene);
    all.insert(all.end(), evidence.begin(), evidence.end());
  }
  return all;
}

PeriodicMotion require_periodic(const Parameters& parameters, double frequency,
                                int harmonics, int samples,
                                const NewtonSettings& settings)
{
  PeriodicMotion solution = motion::search_periodic(parameters, angular(frequency),
                                                    harmonics, samples, settings);
  if (!solution.found())
    throw NoSolution(format("%s: %d harmonics at %g Hz: %s", parameters.file.c_str(),
                            harmonics, frequency, solution.newton.reason().c_str()));
  return solution;
}

int points(const DeviationScene& scene)
{
  return scene.time_integration.stepper.intervals_per_period;
}

SteadyState settled(const DeviationScene& scene, const Parameters& machine,
                    double frequency)
{
  return steady_state(machine, angular(frequency), static_start(machine),
                      scene.time_integration);
}

motion::Motion integrated(const DeviationScene& scene, double frequency)
{
  const SteadyState steady = settled(scene, scene.parameters, frequency);
  if (!steady.periodic)
    throw NoSolution(format("the motion at %g Hz is not T-periodic (spread %.2g)",
                            frequency, steady.spread));
  return motion::motion_of(steady, points(scene));
}

/**
## Evidence on the model (§2 and Table 1)

Contact, readings, masses, cage. */

namespace
{

double in_hertz(double omega)
{
  return omega / (2 * std::numbers::pi);
}

/** The largest sag v [m] of the rotor below the stator, without contact, that both
   bodies can carry with Eq. 4 as printed: the greatest value of v - F(v)(1/k_s + 1/k_r),
   where the printed force pushes them further apart. */
double largest_printed_sag(const Parameters& parameters)
{
  const double compliance =
      1 / parameters.stator.stiffness() + 1 / parameters.rotor.stiffness();
  const BallBearing bearing(parameters.bearing);
  double largest = 0;
  for (int k = 0; k <= 10000; ++k) {
    const double v = 2 * parameters.bearing.clearance * k / 10000;
    largest = std::max(largest, v - compliance * bearing.force({1, 0}, {0, v}).y);
  }
  return largest;
}

double joint_resonance_hz(Parameters machine, double stator_mass, double rotor_mass)
{
  machine.stator.mass = stator_mass;
  machine.rotor.mass = rotor_mass;
  return in_hertz(joint_resonance(machine));
}

}  // namespace

EvidenceList sign_of_approach(const DeviationScene& scene)
{
  const StaticContact contact = static_contact(scene.parameters);
  const double growth = free_mode_rates(scene.parameters, -contact.stiffness).front();
  const double sag = std::abs(free_displacement(scene.parameters, 0, 0).y);
  return {
      {"D-01.stiffness_ours", contact.stiffness, "N/m",
       "slope of the bearing's force along the static contact, Eq. 4 corrected"},
      {"D-01.stiffness_printed", -contact.stiffness, "N/m",
       "the same at the same penetration, Eq. 4 as printed"},
      {"D-01.suspension", scene.parameters.stator.stiffness(), "N/m",
       "stiffness of the stiffer suspension"},
      {"D-01.growth_printed", growth, "1/s",
       "growth rate of both bodies linearised about that contact, as printed"},
      {"D-01.growth_ours", free_mode_rates(scene.parameters, contact.stiffness).front(),
       "1/s", "the same with Eq. 4 corrected; negative: it decays"},
      {"D-01.doubling_printed", std::numbers::ln2 / growth, "s",
       "time in which a disturbance doubles, as printed"},
      {"D-01.sag", sag, "m",
       "distance by which the rotor sags below the stator without contact"},
      {"D-01.sag_printed", largest_printed_sag(scene.parameters), "m",
       "largest such distance for which the printed sign has an equilibrium"}};
}

EvidenceList radius_of_hertz(const DeviationScene& scene)
{
  const Solid steel{scene.steel.young_modulus, scene.steel.poisson_ratio};
  const double k_h = hertz_contact_stiffness(scene.steel.ball_radius, steel, steel);
  const double table = scene.parameters.bearing.contact_stiffness;
  const double needed = scene.steel.ball_radius * (table / k_h) * (table / k_h);
  /** Balls that do not overlap: R_b < (R_b + R) sin(π/n). */
  const double race =
      needed / std::sin(std::numbers::pi / scene.parameters.bearing.balls) - needed;
  const double force = std::abs(static_contact(scene.parameters).force);
  return {{"D-07.ball_radius", scene.steel.ball_radius, "m", "radius of a steel ball"},
          {"D-07.K_H", k_h, "N/m^1.5", "Eq. 2 for it, steel on steel"},
          {"D-07.K_H_table", table, "N/m^1.5", "Table 1"},
          {"D-07.ball_radius_needed", needed, "m",
           "radius at which Eq. 2 gives Table 1's value"},
          {"D-07.race_radius_needed", race, "m",
           "inner race that has room for balls of that size"},
          {"D-07.penetration_ratio",
           hertz_penetration(k_h, force) / hertz_penetration(table, force), "-",
           "static penetration of one ball with Eq. 2's value over that with Table 1's"}};
}

EvidenceList unit_of_stiffness(const DeviationScene& scene)
{
  const StaticContact contact = static_contact(scene.parameters);
  const double k = scene.parameters.bearing.contact_stiffness;
  const double force = std::abs(contact.force);
  return {{"D-08.force", force, "N", "static contact force"},
          {"D-08.penetration_hertz",
           std::abs(contact.displacement) - scene.parameters.bearing.clearance, "m",
           "static penetration with Table 1's value in N/m^1.5"},
          {"D-08.penetration_linear", force / k, "m",
           "static penetration of one linear spring with Table 1's value in N/m"},
          {"D-08.stiffness_ratio", k / contact.stiffness, "-",
           "that spring's stiffness over the bearing's at the static contact"}};
}

EvidenceList two_readings(const DeviationScene& scene)
{
  const Parameters &ours = scene.parameters, &printed = scene.printed_parameters;
  EvidenceList list{
      {"D-09.joint_exchanged", in_hertz(joint_resonance(ours)), "Hz",
       "joint resonance, exchanged frequencies with their working masses"},
      {"D-09.joint_printed", in_hertz(joint_resonance(printed)), "Hz",
       "joint resonance, printed frequencies with their working masses"},
      {"D-09.joint_printed_masses_exchanged",
       joint_resonance_hz(printed, ours.stator.mass, ours.rotor.mass), "Hz",
       "joint resonance, printed frequencies with the masses of the exchanged reading"},
      {"D-09.joint_exchanged_masses_printed",
       joint_resonance_hz(ours, printed.stator.mass, printed.rotor.mass), "Hz",
       "joint resonance, exchanged frequencies with the masses of the printed reading"},
      {"D-09.stator_alone_exchanged", in_hertz(ours.stator.natural_frequency), "Hz",
       "resonance of the stator alone, exchanged"},
      {"D-09.stator_alone_printed", in_hertz(printed.stator.natural_frequency), "Hz",
       "resonance of the stator alone, printed: inside the range of Fig. 3"},
      {"D-09.speed", scene.reading_speed, "Hz", "speed of the following"}};
  for (const auto& [name, machine] :
       {std::pair{"exchanged", &ours}, std::pair{"printed", &printed}}) {
    const SteadyState steady = settled(scene, *machine, scene.reading_speed);
    list.push_back(
        {format("D-09.contact_%s", name),
         motion::contact_share(*machine, motion::motion_of(steady, points(scene))), "-",
         "share of the time with a loaded ball"});
    list.push_back(
        {format("D-09.spread_%s", name), steady.spread, "-", "Poincare spread"});
  }
  return list;
}

EvidenceList unprinted_masses(const DeviationScene& scene)
{
  EvidenceList list{
      {"D-13.m_s", scene.parameters.stator.mass, "kg", "stator, exchanged reading"},
      {"D-13.m_r", scene.parameters.rotor.mass, "kg", "rotor, exchanged reading"},
      {"D-13.m_s_printed", scene.printed_parameters.stator.mass, "kg",
       "stator, printed reading"},
      {"D-13.m_r_printed", scene.printed_parameters.rotor.mass, "kg",
       "rotor, printed reading"},
      {"D-13.joint", in_hertz(joint_resonance(scene.parameters)), "Hz",
       "joint resonance"},
      {"D-13.speed", scene.transition_speed, "Hz", "speed of the following"}};
  int number = 0;
  for (double factor : scene.mass_factors) {
    list.push_back({format("D-13.factor_%d", ++number), factor, "-", "of both masses"});
    Parameters machine = scene.parameters;
    machine.stator.mass *= factor;
    machine.rotor.mass *= factor;
    const SteadyState steady = settled(scene, machine, scene.transition_speed);
    const motion::Motion motion = motion::motion_of(steady, points(scene));
    list.push_back(
        {format("D-13.contact_%d", number), motion::contact_share(machine, motion), "-",
         format("share of the time in contact with both masses times %g", factor)});
    list.push_back({format("D-13.spread_%d", number), steady.spread, "-",
                    format("Poincare spread with both masses times %g", factor)});
  }
  return list;
}

/**
## Evidence on Newton's method (§3.1)

The blocks of Eq. 11, Newton's step and its criteria. */

namespace
{

/** The coefficients of all four displacements in the order of PlainBalance. */
Eigen::VectorXd coefficients(const PeriodicMotion& solution)
{
  return solution.bodies.reshaped();
}

/** The solution of the plain equations, from the library's. */
motion::Motion plain_solution(const DeviationScene& scene, double frequency,
                              FirstEntry first)
{
  const int m = scene.harmonics, n = default_samples(m);
  PeriodicMotion solution = require_periodic(scene.parameters, frequency, m, n);
  PlainBalance balance(scene.parameters, angular(frequency), m, n, first);
  Eigen::VectorXd x = coefficients(solution);
  const Equations equations{
      .residual_scale = balance.load().norm(),
      .unknown_scale = scales(scene.parameters).length,
      .residual = [&](const Eigen::VectorXd& y,
                      Eigen::VectorXd& residual) { residual = balance.residual(y); },
      .jacobian = [&](const Eigen::VectorXd& y) -> const Eigen::MatrixXd& {
        return balance.jacobian(y);
      }};
  const NewtonReport report = newton(equations, x, {});
  if (!report.converged())
    throw NoSolution(
        format("plain balance at %g Hz: %s", frequency, report.reason().c_str()));
  solution.bodies = x.reshaped(4, 2 * m + 1);
  return motion::motion_of(solution.bodies, points(scene));
}

}  // namespace

EvidenceList printed_newton_step(const DeviationScene& scene)
{
  const int m = scene.harmonics, n = default_samples(m);
  const Eigen::VectorXd truth =
      coefficients(require_periodic(scene.parameters, scene.speed, m, n));
  const Eigen::VectorXd start =
      coefficients(require_periodic(scene.parameters, scene.newton_start_speed, m, n));
  PlainBalance balance(scene.parameters, angular(scene.speed), m, n);
  const auto residual = [&](const Eigen::VectorXd& x) {
    return balance.residual(x).norm() / balance.load().norm();
  };
  EvidenceList list{
      {"D-06.speed", scene.speed, "Hz", "speed of the iterations"},
      {"D-06.start_speed", scene.newton_start_speed, "Hz",
       "speed of the solution they start from"},
      {"D-06.start", residual(start), "-", "residual of the start over the load"}};
  Eigen::VectorXd printed = start, ours = start;
  int done = 0;
  for (int iterations : scene.newton_iterations) {
    for (; done < iterations; ++done) {
      printed += balance.printed_step(printed);
      ours += balance.corrected_step(ours);
    }
    list.push_back({format("D-06.printed_%d", iterations), residual(printed), "-",
                    format("residual over the load after %d printed steps", iterations)});
    list.push_back({format("D-06.ours_%d", iterations), residual(ours), "-",
                    format("the same after %d corrected steps", iterations)});
  }
  for (const auto& [name, x] : {std::pair{"printed", &printed}, std::pair{"ours", &ours}})
    list.push_back({format("D-06.distance_%s", name), (*x - truth).norm() / truth.norm(),
                    "-",
                    format("distance to the solution after the last step, %s", name)});
  return list;
}

EvidenceList printed_block(const DeviationScene& scene)
{
  const Parameters& machine = scene.parameters;
  EvidenceList list;
  for (double frequency : scene.block_speeds) {
    const motion::Motion truth = integrated(scene, frequency);
    const motion::Motion printed = plain_solution(scene, frequency, FirstEntry::printed);
    const motion::Motion ours = plain_solution(scene, frequency, FirstEntry::corrected);
    const std::string at = format("_%gHz", frequency);
    list.push_back({"D-12.printed" + at, motion::relative_difference(printed, truth), "-",
                    "distance to time integration with the printed block"});
    list.push_back({"D-12.ours" + at, motion::relative_difference(ours, truth), "-",
                    "the same with the corrected block"});
    list.push_back({"D-12.force_printed" + at,
                    motion::relative_force_difference(machine, printed, truth), "-",
                    "distance of the bearing's force, printed block"});
    list.push_back({"D-12.force_ours" + at,
                    motion::relative_force_difference(machine, ours, truth), "-",
                    "the same with the corrected block"});
  }
  return list;
}

EvidenceList criteria_without_scale(const DeviationScene& scene)
{
  const int m = scene.harmonics, n = default_samples(m);
  const Eigen::VectorXd truth =
      coefficients(require_periodic(scene.parameters, scene.speed, m, n));
  Eigen::VectorXd x =
      coefficients(require_periodic(scene.parameters, scene.newton_start_speed, m, n));
  PlainBalance balance(scene.parameters, angular(scene.speed), m, n);
  const Eigen::VectorXd step = balance.corrected_step(x);
  x += step;
  const double penetration = scales(scene.parameters).penetration;
  return {{"D-22.delta_1", balance.residual(x).norm(), "N", "Eq. 17 after one iteration"},
          {"D-22.delta_2", step.norm(), "m", "Eq. 18 after one iteration"},
          {"D-22.penetration", penetration, "m",
           "penetration of one ball under the whole load"},
          {"D-22.distance", (x - truth).norm() / penetration, "-",
           "distance to the solution over that penetration"}};
}

/**
## Evidence on the samples of a period (§3.1)

What Γ takes to harmonics, and what too few samples fold onto them. */

namespace
{

Branch branch_over_range(const DeviationScene& scene, int harmonics, int samples)
{
  const Parameters& parameters = scene.parameters;
  const double from = angular(scene.range.front()), to = angular(scene.range.back());
  Balance balance(bearing_problem(parameters, samples), harmonics);
  return follow_branch(balance, from, to, quasi_static_start(parameters, from, harmonics),
                       arc_length_settings(parameters));
}

/** What m harmonics with N samples give: folds, and the distance to the true motion. */
void add_sampled(EvidenceList& list, const DeviationScene& scene, int m, int n,
                 const motion::Motion& truth)
{
  const Branch branch = branch_over_range(scene, m, n);
  const std::string where = format("_m%d_N%d", m, n),
                    with = format("m = %d, N = %d", m, n);
  const auto solution = require_periodic(scene.parameters, scene.speed, m, n);
  list.push_back({"D-05.folds" + where, static_cast<double>(branch.folds.size()), "-",
                  "folds of the branch, " + with});
  list.push_back({"D-05.end" + where, branch.points.back().motion.omega / angular(1),
                  "Hz", "speed where the branch ended, " + with + ": " + branch.end});
  list.push_back({"D-05.error" + where,
                  motion::relative_difference(
                      motion::motion_of(solution.bodies, points(scene)), truth),
                  "-", "distance to time integration, " + with});
}

}  // namespace

EvidenceList names_of_gamma(const DeviationScene& scene)
{
  const int m = scene.harmonics, n = 2 * m + 1;
  const Eigen::MatrixXd series =
      require_periodic(scene.parameters, scene.speed, m, default_samples(m)).bodies;
  const Eigen::MatrixXd gamma = gamma_matrix(m, n, Argument::parenthesised);
  const Eigen::MatrixXd truth = gamma_inverse(m, n) * series.transpose();
  const Eigen::MatrixXd as_text = gamma * series.transpose();
  return {{"D-04.speed", scene.speed, "Hz", "speed of the solution"},
          {"D-04.error_text", (as_text - truth).norm() / truth.norm(), "-",
           "samples with gamma taken as frequency to time, over the true ones: distance"},
          {"D-04.error_ours", (sample_series(series, n) - truth).norm() / truth.norm(),
           "-", "the same with our transforms"},
          {"D-04.size_text", as_text.cwiseAbs().maxCoeff() / truth.cwiseAbs().maxCoeff(),
           "-", "largest displacement of the text's samples over the true one"}};
}

EvidenceList samples_as_printed(const DeviationScene& scene)
{
  const motion::Motion truth = integrated(scene, scene.speed);
  EvidenceList list{
      {"D-05.speed", scene.speed, "Hz", "speed of the errors"},
      {"D-05.from", scene.range.front(), "Hz", "first speed of the branches"},
      {"D-05.to", scene.range.back(), "Hz", "last speed of the branches"}};
  for (int m : scene.sampled_harmonics) {
    std::vector<int> counts{2 * m + 1, 4 * m + 1};
    counts.insert(counts.end(), scene.common_samples.begin(), scene.common_samples.end());
    for (int n : counts) add_sampled(list, scene, m, n, truth);
  }
  return list;
}

EvidenceList default_sample_count(const DeviationScene& scene)
{
  const int m = scene.harmonics;
  const auto motion = [&](int n) {
    return motion::motion_of(require_periodic(scene.parameters, scene.speed, m, n).bodies,
                             points(scene));
  };
  const motion::Motion fine = motion(scene.fine_samples),
                       truth = integrated(scene, scene.speed);
  const int n = default_samples(m);
  return {{"D-14.speed", scene.speed, "Hz", "speed of the errors"},
          {"D-14.samples", static_cast<double>(n), "-", format("our N for m = %d", m)},
          {"D-14.samples_printed", 2.0 * m + 1, "-", "the printed N"},
          {"D-14.samples_fine", static_cast<double>(scene.fine_samples), "-",
           "the N that stands for exact"},
          {"D-14.sampling_ours", motion::relative_difference(motion(n), fine), "-",
           "error of sampling with our N"},
          {"D-14.sampling_printed", motion::relative_difference(motion(2 * m + 1), fine),
           "-", "error of sampling with the printed N"},
          {"D-14.truncation", motion::relative_difference(fine, truth), "-",
           "error of the truncated series, sampled finely"}};
}

EvidenceList parentheses_of_gamma(const DeviationScene& scene)
{
  const int m = scene.harmonics, n = 2 * m + 1;
  const Eigen::MatrixXd inverse = gamma_inverse(m, n);
  const auto defect = [&](Argument argument) {
    const Eigen::MatrixXd product = gamma_matrix(m, n, argument) * inverse;
    return (product - Eigen::MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff();
  };
  const Eigen::MatrixXd series =
      require_periodic(scene.parameters, scene.speed, m, default_samples(m)).bodies;
  const Eigen::MatrixXd back =
      gamma_matrix(m, n, Argument::printed) * inverse * series.transpose();
  return {
      {"D-21.printed", defect(Argument::printed), "-",
       "largest entry of gamma times its inverse minus one, arguments as printed"},
      {"D-21.ours", defect(Argument::parenthesised), "-", "the same with parentheses"},
      {"D-21.back_printed", (back - series.transpose()).norm() / series.norm(), "-",
       "coefficients after one return trip to samples, as printed: relative distance"}};
}

/**
## Evidence on continuation (§3.2)

Predictor, arc length, tolerance, step, cost. */

namespace
{

Balance balance_of(const DeviationScene& scene, int harmonics)
{
  return Balance(bearing_problem(scene.parameters, default_samples(harmonics)),
                 harmonics);
}

/** The sweep of Fig. 3 with `harmonics` harmonics, at every step [Hz]. */
std::vector<PeriodicMotion> sweep_at(const DeviationScene& scene, int harmonics,
                                     double step)
{
  std::vector<double> omegas;
  for (double f = scene.range.front(); f <= scene.range.back() + 1e-9; f += step)
    omegas.push_back(angular(f));
  return sweep(scene.parameters, omegas, harmonics);
}

double unscaled_step(const PeriodicMotion& a, const PeriodicMotion& b)
{
  return (a.x - b.x).norm() + std::abs(a.omega - b.omega);
}

/** Newton iterations from `x` at speed ω. */
int iterations_from(Balance& balance, double omega, Eigen::VectorXd x)
{
  const NewtonReport report = solve(balance, omega, std::move(x)).newton;
  if (!report.converged()) throw NoSolution("prediction: " + report.reason());
  return report.iterations;
}

double mean_iterations(const std::vector<PeriodicMotion>& points)
{
  double sum = 0;
  for (const PeriodicMotion& point : points) sum += point.newton.iterations;
  return sum / static_cast<double>(points.size());
}

}  // namespace

EvidenceList printed_predictor(const DeviationScene& scene)
{
  Balance balance = balance_of(scene, scene.harmonics);
  const SweepSettings scaling = sweep_settings(scene.parameters);
  LagrangePredictor predictor(scaling.arc_unknown_scale, scaling.speed_scale);
  std::vector<PeriodicMotion> known;
  for (double frequency : scene.predictor_speeds)
    known.push_back(require_periodic(scene.parameters, frequency, scene.harmonics,
                                     default_samples(scene.harmonics)));
  const PeriodicMotion next = known.back();
  known.pop_back();
  for (const PeriodicMotion& solution : known) predictor.add(solution.x, solution.omega);
  const PeriodicMotion printed = printed_prediction(known);
  const Eigen::VectorXd ours = predictor.at_speed(next.omega);
  return {
      {"D-02.last", scene.predictor_speeds[3], "Hz", "speed of the last known solution"},
      {"D-02.next", scene.predictor_speeds[4], "Hz", "speed of the next one"},
      {"D-02.moved_printed", unscaled_step(printed, known.back()), "-",
       "distance of the printed prediction from the last solution, speed included"},
      {"D-02.error_printed", (printed.x - next.x).norm() / next.x.norm(), "-",
       "relative distance of the printed prediction from the next solution"},
      {"D-02.error_ours", (ours - next.x).norm() / next.x.norm(), "-",
       "the same with the corrected prediction"},
      {"D-02.iterations_printed",
       static_cast<double>(iterations_from(balance, next.omega, printed.x)), "-",
       "Newton iterations at the next speed from the printed prediction"},
      {"D-02.iterations_ours",
       static_cast<double>(iterations_from(balance, next.omega, ours)), "-",
       "the same from the corrected prediction"}};
}

EvidenceList arc_length_scaling(const DeviationScene& scene)
{
  const SweepSettings scaling = sweep_settings(scene.parameters);
  const auto points = sweep_at(scene, scene.harmonics, scene.continuation_steps.front());
  double plain = 0, scaled = 0, least_scaled = 1;
  int pairs = 0;
  for (std::size_t k = 1; k < points.size(); ++k) {
    if (!points[k].found() || !points[k - 1].found()) continue;
    const double x = (points[k].x - points[k - 1].x).squaredNorm();
    const double w = std::pow(points[k].omega - points[k - 1].omega, 2);
    const double x_scaled = x / std::pow(scaling.arc_unknown_scale, 2);
    const double w_scaled = w / std::pow(scaling.speed_scale, 2);
    plain = std::max(plain, x / (x + w));
    scaled += w_scaled / (x_scaled + w_scaled);
    least_scaled = std::min(least_scaled, w_scaled / (x_scaled + w_scaled));
    ++pairs;
  }
  return {{"D-03.displacement_share_printed", plain, "-",
           "largest share of the displacements in the square of Eq. 19 as printed"},
          {"D-03.speed_share_ours", scaled / pairs, "-",
           "mean share of the speed in it with our scales"},
          {"D-03.speed_share_ours_least", least_scaled, "-", "least share of the speed"},
          {"D-03.length", scaling.arc_unknown_scale, "m", "our length scale"},
          {"D-03.speed", scaling.speed_scale, "rad/s", "our speed scale"}};
}

namespace
{

void add_tolerances(EvidenceList& list, const DeviationScene& scene)
{
  const auto solution = [&](double tolerance) {
    return require_periodic(scene.parameters, scene.speed, scene.harmonics,
                            default_samples(scene.harmonics), {.tolerance = tolerance})
        .x;
  };
  const Eigen::VectorXd exact = solution(scene.fine_tolerance);
  int number = 0;
  for (double tolerance : scene.tolerances) {
    list.push_back({format("D-15.tolerance_%d", ++number), tolerance, "-", "of Newton"});
    list.push_back({format("D-15.error_%d", number),
                    (solution(tolerance) - exact).norm() / exact.norm(), "-",
                    "distance to the solution with that tolerance"});
  }
}

void add_steps(EvidenceList& list, const DeviationScene& scene)
{
  int number = 0;
  for (double step : scene.continuation_steps) {
    const auto points = sweep_at(scene, scene.harmonics, step);
    double missed = 0;
    for (const PeriodicMotion& point : points) missed += point.found() ? 0 : 1;
    list.push_back({format("D-15.step_%d", ++number), step, "Hz", "of the sweep"});
    list.push_back({format("D-15.iterations_%d", number), mean_iterations(points), "-",
                    "Newton iterations per speed with that step"});
    list.push_back({format("D-15.missed_%d", number), missed, "-",
                    "speeds without solution with that step"});
  }
}

}  // namespace

EvidenceList tolerance_and_step(const DeviationScene& scene)
{
  EvidenceList list{{"D-15.tolerance", NewtonSettings{}.tolerance, "-", "ours, relative"},
                    {"D-15.speed", scene.speed, "Hz", "speed of the errors"}};
  add_tolerances(list, scene);
  add_steps(list, scene);
  return list;
}

EvidenceList unit_of_cpu(const DeviationScene& scene)
{
  EvidenceList list;
  double first = 0;
  for (int m : scene.sampled_harmonics) {
    double instants = 0;
    for (const PeriodicMotion& point :
         sweep_at(scene, m, scene.continuation_steps.front()))
      instants += static_cast<double>(point.force_samples);
    if (first == 0) first = instants;
    list.push_back(
        {format("D-18.instants_m%d", m), instants, "-",
         format("evaluations of the bearing's force over the sweep, m = %d", m)});
    list.push_back({format("D-18.ratio_m%d", m), instants / first, "-",
                    format("the same over the first, m = %d", m)});
  }
  return list;
}

/**
## Evidence on the motions (§3.3)

Amplitudes, cage, time integration, figures. */

namespace
{

/** The series of x_s, y_s, x_r, y_r over the first period of a motion, 4 × (2m+1). */
Eigen::MatrixXd series_of(const motion::Motion& motion, int harmonics)
{
  Eigen::MatrixXd samples(motion.points_per_period, 4);
  for (int k = 0; k < motion.points_per_period; ++k) {
    const auto q = std::bit_cast<std::array<double, 4>>(motion.positions[k]);
    samples.row(k) << q[0], q[1], q[2], q[3];
  }
  Eigen::MatrixXd series(4, 2 * harmonics + 1);
  FourierTransform(motion.points_per_period).to_series(samples, series);
  return series;
}

double harmonic(const Eigen::MatrixXd& series, int row, int h)
{
  return std::hypot(series(row, 2 * h - 1), series(row, 2 * h));
}

/** What "amplitude" may mean for one displacement, each over half its peak-to-peak. */
struct Amplitudes {
  double half_peak_to_peak;             ///< [m]
  double largest, rms, first_harmonic;  ///< [-]
};

Amplitudes amplitudes(const Eigen::MatrixXd& series, int row, int points)
{
  const double half = half_peak_to_peak(series)[row];
  double squares = 0;
  for (int h = 1; 2 * h < series.cols(); ++h)
    squares += 0.5 * std::pow(harmonic(series, row, h), 2);
  const Eigen::VectorXd samples = sample_series(series, points).col(row);
  return {half, samples.cwiseAbs().maxCoeff() / half, std::sqrt(2 * squares) / half,
          harmonic(series, row, 1) / half};
}

/** How often a ball becomes loaded in the two periods of a contact evolution, mean. */
double loadings_per_ball(const motion::ContactEvolution& evolution)
{
  const auto& q = evolution.ball_force;
  double loadings = 0;
  for (std::size_t ball = 0; ball < q.front().size(); ++ball)
    for (std::size_t k = 1; k < q.size(); ++k)
      if (q[k][ball] > 0 && q[k - 1][ball] == 0) ++loadings;
  return loadings / static_cast<double>(q.front().size());
}

struct Rk4Run {
  double error;        ///< distance to the truth [-]
  double evaluations;  ///< of Eq. 7 per second of motion [1/s]
};

Rk4Run run_rk4(const DeviationScene& scene, double step, const motion::Motion& truth)
{
  SteadySettings settings = scene.time_integration;
  settings.stepper.method = "rk4";
  settings.stepper.step = step;
  const SteadyState steady = steady_state(scene.parameters, angular(scene.speed),
                                          static_start(scene.parameters), settings);
  return {motion::relative_difference(motion::motion_of(steady, points(scene)), truth),
          static_cast<double>(steady.evaluations) / steady.seconds};
}

}  // namespace

EvidenceList amplitude_definitions(const DeviationScene& scene)
{
  EvidenceList list;
  for (const auto& [name, frequency] :
       {std::pair{"gravity", scene.gravity_speed}, std::pair{"rotating", scene.speed}}) {
    const Eigen::MatrixXd series =
        require_periodic(scene.parameters, frequency, scene.harmonics,
                         default_samples(scene.harmonics))
            .bodies;
    list.push_back(
        {format("D-10.speed_%s", name), frequency, "Hz", "speed of the amplitudes"});
    for (int row : {2, 3}) {
      const Amplitudes a = amplitudes(series, row, points(scene));
      const std::string key = format("_%s_%s", row == 2 ? "x_r" : "y_r", name);
      list.push_back({"D-10.half" + key, a.half_peak_to_peak, "m", "half peak-to-peak"});
      list.push_back({"D-10.largest" + key, a.largest, "-",
                      "largest modulus over half peak-to-peak"});
      list.push_back({"D-10.rms" + key, a.rms, "-",
                      "rms about the mean times sqrt 2, over half peak-to-peak"});
      list.push_back({"D-10.first" + key, a.first_harmonic, "-",
                      "first harmonic over half peak-to-peak"});
    }
  }
  return list;
}

EvidenceList cage_and_period(const DeviationScene& scene)
{
  const int balls = scene.parameters.bearing.balls;
  const double least = 0.5 * (1 - std::sin(std::numbers::pi / balls));
  EvidenceList list{{"D-11.speed", scene.speed, "Hz", "speed of the spreads"},
                    {"D-11.passages_least", balls * least, "-",
                     "n c of balls that touch each other: finite balls need more"},
                    {"D-11.periodic_below", scene.time_integration.periodic, "-",
                     "spread below which a motion counts as T-periodic"}};
  for (double ratio : scene.cage_ratios) {
    Parameters machine = scene.parameters;
    machine.bearing.cage_speed_ratio = ratio;
    list.push_back({format("D-11.passages_c%g", ratio),
                    passages_per_turn(machine.bearing), "-",
                    format("ball passages per turn, c = %g", ratio)});
    list.push_back({format("D-11.spread_c%g", ratio),
                    settled(scene, machine, scene.speed).spread, "-",
                    format("Poincare spread, c = %g", ratio)});
  }
  return list;
}

EvidenceList runge_kutta_settings(const DeviationScene& scene)
{
  const motion::Motion truth = integrated(scene, scene.speed);
  const double stiffness = static_contact(scene.parameters).stiffness;
  EvidenceList list{
      {"D-16.speed", scene.speed, "Hz", "speed of the errors"},
      {"D-16.default_step", default_step(scene.parameters), "s",
       "our step where none is asked"},
      {"D-16.decay_joined", -free_mode_rates(scene.parameters, stiffness).front(), "1/s",
       "slowest decay of both bodies in contact, linearised"},
      {"D-16.decay_apart", -free_mode_rates(scene.parameters, 0).front(), "1/s",
       "slowest decay without contact"}};
  double first = 0, last = 0;
  for (std::size_t k = 0; k < scene.rk4_steps.size(); ++k) {
    const Rk4Run run = run_rk4(scene, scene.rk4_steps[k], truth);
    (k == 0 ? first : last) = run.evaluations;
    list.push_back(
        {format("D-16.step_%zu", k + 1), scene.rk4_steps[k], "s", "longest step of rk4"});
    list.push_back({format("D-16.error_%zu", k + 1), run.error, "-",
                    "distance of rk4 with that step to rk8pd"});
  }
  list.push_back({"D-16.work_ratio", last / first, "-",
                  "evaluations of Eq. 7 with the last of these steps over the first"});
  return list;
}

EvidenceList speeds_of_panels(const DeviationScene& scene)
{
  EvidenceList list;
  for (std::size_t k = 0; k < scene.panel_speeds.size(); ++k) {
    const double frequency = scene.panel_speeds[k];
    const SteadyState steady = settled(scene, scene.parameters, frequency);
    const motion::Motion motion = motion::motion_of(steady, points(scene));
    const Eigen::MatrixXd series = series_of(motion, scene.harmonics);
    double higher = 0;
    for (int h = 2; h <= scene.harmonics; ++h)
      higher += std::pow(harmonic(series, 2, h), 2);
    const std::string key = format("_%zu", k + 1);
    list.push_back({"D-17.speed" + key, frequency, "Hz", "speed of the panel"});
    list.push_back({"D-17.contact" + key, motion::contact_share(scene.parameters, motion),
                    "-", "share of the time with a loaded ball"});
    list.push_back({"D-17.higher" + key, std::sqrt(higher) / harmonic(series, 2, 1), "-",
                    "harmonics 2 and more of x_r over the first"});
    list.push_back({"D-17.spread" + key, steady.spread, "-", "Poincare spread"});
  }
  return list;
}

EvidenceList kind_of_figures(const DeviationScene& scene)
{
  const auto amplitude = [&](double frequency) {
    return half_peak_to_peak(require_periodic(scene.parameters, frequency,
                                              scene.harmonics,
                                              default_samples(scene.harmonics))
                                 .bodies)[2];
  };
  double peak = 0, peak_speed = 0;
  for (double frequency : scene.range)
    if (const double a = amplitude(frequency); a > peak) {
      peak = a;
      peak_speed = frequency;
    }
  return {{"D-19.spread_fig4",
           settled(scene, scene.parameters, scene.transition_speed).spread, "-",
           "Poincare spread at the speed of Fig. 4"},
          {"D-19.spread_fig5", settled(scene, scene.parameters, scene.speed).spread, "-",
           "Poincare spread at the speed of Fig. 5"},
          {"D-19.from", scene.range.front(), "Hz", "first speed of our Fig. 3"},
          {"D-19.to", scene.range.back(), "Hz", "last speed of our Fig. 3"},
          {"D-19.peak_speed", peak_speed, "Hz", "speed of the largest amplitude of x_r"},
          {"D-19.amplitude_from", amplitude(scene.range.front()) / peak, "-",
           "amplitude of x_r at the first speed over the largest"},
          {"D-19.amplitude_to", amplitude(scene.range.back()) / peak, "-",
           "amplitude of x_r at the last speed over the largest"}};
}

EvidenceList passages_over_2t(const DeviationScene& scene)
{
  EvidenceList list{{"D-20.speed", scene.speed, "Hz", "speed of the counts"}};
  for (double ratio : scene.cage_ratios) {
    Parameters machine = scene.parameters;
    machine.bearing.cage_speed_ratio = ratio;
    const SteadyState steady = settled(scene, machine, scene.speed);
    const motion::Motion motion = motion::motion_of(steady, points(scene));
    list.push_back(
        {format("D-20.loadings_c%g", ratio),
         loadings_per_ball(motion::contact_evolution(machine, motion)), "-",
         format("loadings of a ball in 2T, mean over the balls, c = %g", ratio)});
    list.push_back(
        {format("D-20.interval_c%g", ratio), 1 / (1 - ratio), "-",
         format("time between two loadings over T, 1/(1 - c), c = %g", ratio)});
  }
  return list;
}

Table deviation_table(const DeviationScene& scene)
{
  Table table("Evidence for the deviations from the printed paper (paper/deviations.md)",
              {{"key", "-", "entry and name"},
               {"value", "-", "in the unit of its row"},
               {"unit", "-", "of the value"},
               {"meaning", "-", "what the value is"}});
  describe(table, scene.parameters);
  describe(table, scene.printed_parameters);
  for (const Evidence& e : compute_deviations(scene))
    table.row({e.key, e.value, e.unit, e.meaning});
  return table;
}

}  // namespace rotor_stator::deviations
