#include "figures/response.hpp"
#include "motion/find_periodic.hpp"

#include <algorithm>

#include "balance/bearing_problem.hpp"
#include "figures/bearing.hpp"
#include "io/errors.hpp"
#include "io/program.hpp"

namespace rotor_stator::figures
{

ResponseScene read_response_scene(const std::string& file, const std::string& reading)
{
  SceneFile scene_file(file, reading);
  StrictToml& toml = scene_file.toml();
  ResponseScene scene{.sets = read_parameter_list(scene_file, "parameters"),
                      .harmonics = toml.integers("harmonics", 1, 4096),
                      .balance_speeds = scene_file.speed_range("balance_hz"),
                      .time_speeds = scene_file.speed_range("time_integration_hz"),
                      .time_integration = read_steady_settings(scene_file)};
  if (scene.harmonics.size() != scene.sets.size())
    toml.fail("harmonics", "must have one value for each of parameters");
  toml.refuse_unknown_keys();
  return scene;
}

namespace
{

/** What one data set adds to the figure. */
class SetResponse
{
public:
  SetResponse(const ResponseScene& scene, std::size_t set,
              std::vector<ResponsePoint>& points)
      : scene_(scene),
        parameters_(scene.sets[set]),
        number_(static_cast<int>(set) + 1),
        harmonics_(scene.harmonics[set]),
        points_(points)
  {
  }

  void add_sweep(Curve curve)
  {
    std::vector<double> omegas;
    for (double frequency : scene_.balance_speeds) omegas.push_back(angular(frequency));
    if (curve == Curve::speed_down) std::reverse(omegas.begin(), omegas.end());
    Balance balance(bearing_problem(parameters_, default_samples(harmonics_)),
                    harmonics_);
    std::vector<Eigen::MatrixXd> solutions;
    const auto points = sweep(
        balance, omegas,
        [&](double omega) { return quasi_static_start(parameters_, omega, harmonics_); },
        motion::sweep_settings(parameters_),
        [&](const SweepPoint& point) {
          solutions.push_back(body_series(parameters_, balance, point.omega, point.x));
        });
    int segment = 1;
    std::size_t solution = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (!points[k].found()) {
        if (k > 0 && points[k - 1].found()) ++segment;
        continue;
      }
      if (k > 0 && points[k - 1].found() && points[k].restarted) ++segment;
      add_solution(curve, segment, points[k], solutions[solution++]);
    }
  }

  void add_time_integration(Progress& progress)
  {
    const int points = scene_.time_integration.stepper.intervals_per_period;
    for (double frequency : scene_.time_speeds) {
      const SteadyState steady =
          steady_state(parameters_, angular(frequency), static_start(parameters_),
                       scene_.time_integration);
      const motion::Motion motion = motion::motion_of(steady, points);
      points_.push_back({number_, Curve::time_integration, 1, frequency,
                         half_peak_to_peak(motion),
                         motion::contact_share(parameters_, motion), 0, steady.spread,
                         steady.periodic});
      progress.step();
    }
  }

private:
  void add_solution(Curve curve, int segment, const SweepPoint& point,
                    const Eigen::MatrixXd& bodies)
  {
    const Eigen::VectorXd amplitude = half_peak_to_peak(bodies);
    points_.push_back({number_,
                       curve,
                       segment,
                       point.omega / angular(1),
                       {amplitude[0], amplitude[1], amplitude[2], amplitude[3]},
                       motion::contact_share(parameters_, motion::motion_of(bodies, 256)),
                       point.newton.iterations,
                       0,
                       true});
  }

  const ResponseScene& scene_;
  const Parameters& parameters_;
  int number_, harmonics_;
  std::vector<ResponsePoint>& points_;
};

}  // namespace

std::vector<ResponsePoint> compute_response(const ResponseScene& scene)
{
  std::vector<ResponsePoint> points;
  Progress progress("frequency response", scene.sets.size() * scene.time_speeds.size());
  for (std::size_t set = 0; set < scene.sets.size(); ++set) {
    SetResponse response(scene, set, points);
    response.add_sweep(Curve::speed_up);
    response.add_sweep(Curve::speed_down);
    response.add_time_integration(progress);
  }
  return points;
}

/**
## The table of the response

Figure 3: amplitudes against speed, by both methods. */

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
    describe(table, scene.sets[set]);
    table.note(format("  harmonic balance: m = %d, N = %d, relative tolerance %g",
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

}  // namespace rotor_stator::figures
