/**
# Evidence on Newton's method (§3.1)

The blocks of Eq. 11, Newton's step and its criteria. */
#include "model/errors.hpp"
#include "scenes/evidence.hpp"
#include "scenes/printed_equations.hpp"

namespace rotor_stator
{

namespace
{

/** The coefficients of all four displacements in the order of PlainBalance. */
Eigen::VectorXd coefficients(const PeriodicSolution& solution)
{
  return solution.bodies.reshaped();
}

/** The solution of the plain equations, from the library's. */
Motion plain_solution(const DeviationScene& scene, double frequency, FirstEntry first)
{
  const int m = scene.harmonics, n = default_samples(m);
  PeriodicSolution solution = require_periodic(scene.parameters, frequency, m, n);
  PlainBalance balance(scene.parameters, angular(frequency), m, n, first);
  Eigen::VectorXd x = coefficients(solution);
  const Equations equations{
      .residual_scale = balance.load().norm(),
      .unknown_scale = scales(scene.parameters).length,
      .residual = [&](const Eigen::VectorXd& y,
                      Eigen::VectorXd& residual) { residual = balance.residual(y); },
      .jacobian = [&]() -> const Eigen::MatrixXd& { return balance.jacobian(); }};
  const NewtonReport report = newton(equations, x, {});
  if (!report.converged())
    throw NoSolution(
        text("plain balance at %g Hz: %s", frequency, report.reason().c_str()));
  solution.bodies = x.reshaped(4, 2 * m + 1);
  return motion_of(solution.bodies, points(scene));
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
    list.push_back({text("D-06.printed_%d", iterations), residual(printed), "-",
                    text("residual over the load after %d printed steps", iterations)});
    list.push_back({text("D-06.ours_%d", iterations), residual(ours), "-",
                    text("the same after %d corrected steps", iterations)});
  }
  for (const auto& [name, x] : {std::pair{"printed", &printed}, std::pair{"ours", &ours}})
    list.push_back({text("D-06.distance_%s", name), (*x - truth).norm() / truth.norm(),
                    "-", text("distance to the solution after the last step, %s", name)});
  return list;
}

EvidenceList printed_block(const DeviationScene& scene)
{
  const Parameters& machine = scene.parameters;
  EvidenceList list;
  for (double frequency : scene.block_speeds) {
    const Motion truth = integrated(scene, frequency);
    const Motion printed = plain_solution(scene, frequency, FirstEntry::printed);
    const Motion ours = plain_solution(scene, frequency, FirstEntry::corrected);
    const std::string at = text("_%gHz", frequency);
    list.push_back({"D-12.printed" + at, relative_difference(printed, truth), "-",
                    "distance to time integration with the printed block"});
    list.push_back({"D-12.ours" + at, relative_difference(ours, truth), "-",
                    "the same with the corrected block"});
    list.push_back({"D-12.force_printed" + at,
                    relative_force_difference(machine, printed, truth), "-",
                    "distance of the bearing's force, printed block"});
    list.push_back({"D-12.force_ours" + at,
                    relative_force_difference(machine, ours, truth), "-",
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

}  // namespace rotor_stator
