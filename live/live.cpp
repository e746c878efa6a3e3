/**
# The library in the browser

What `explore` does, for the page: a question goes in as strings and numbers, one answer stands ready when
`live_run` returns. The status is that of `explore`: 0 done, 2 bad input, 3 no solution, with the same message. */
#include <emscripten.h>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "balance/torus_line.hpp"
#include "explore/balance_motion.hpp"
#include "explore/response.hpp"
#include "io/errors.hpp"
#include "motion/contact.hpp"

namespace {

using namespace rotor_stator;
using namespace rotor_stator::explore;

std::string text;             // header of the table, or the message
std::vector<double> numbers;  // what is drawn

EM_JS(void, show_point, (double f, double x_s, double y_s, double x_r, double y_r), {
  Module.onPoint([ f, x_s, y_s, x_r, y_r ]);
});

/** Where n·ω_cage/ω is no simple fraction, the harmonics are chosen by the tolerance. */
bool chooses_harmonics(const Parameters& parameters)
{
  return turns_to_repeat(parameters.bearing) == 0 && parameters.unbalance > 0;
}

void add_motion(const Parameters& parameters, const MotionRequest& request,
                const Computed& at)
{
  const motion::Motion& motion = at.found.motion;
  const auto contact = motion::contact_evolution(parameters, motion);
  const auto& lines = at.found.lines.lines;
  for (double head :
       {static_cast<double>(motion.size()), static_cast<double>(motion.points_per_period),
        static_cast<double>(parameters.bearing.balls),
        parameters.bearing.cage_speed_ratio, parameters.bearing.clearance,
        static_cast<double>(motion.first_period), static_cast<double>(lines.size()),
        joint_resonance(parameters) / angular(1)})
    numbers.push_back(head);
  for (std::size_t k = 0; k < motion.size(); ++k) {
    const auto& [stator, rotor] = motion.positions[k];
    for (double value :
         {stator.x, stator.y, rotor.x, rotor.y, at.forces[k].x, at.forces[k].y})
      numbers.push_back(value);
  }
  for (const auto& balls : contact.ball_force)
    numbers.insert(numbers.end(), balls.begin(), balls.end());
  for (const motion::Line& line : lines) {
    numbers.push_back(line.order * request.frequency);
    numbers.insert(numbers.end(), line.amplitude.begin(), line.amplitude.end());
    text += "=" + motion::name_of(line.order, parameters.bearing, 1e-9, 128).name + "\n";
  }
}

/** `orbit` the solution alone; `error` with its error estimate; `verdict` with the verdict; `integrate` what rk8pd
    settles on. */
void show_motion(const std::string& what, const Parameters& parameters,
                 MotionRequest request)
{
  const bool is_torus = chooses_harmonics(parameters);
  request.stability = what == "verdict";
  if (what == "integrate") request.method = "rk8pd";
  if (is_torus || what == "integrate") {
    request.harmonics.reset();
    request.periods = 8;
  } else if (what == "error") {
    request.tolerance = HUGE_VAL;  // any error is accepted, and printed
  }
  Table table("Live", {});
  const Computed at = computed(parameters, request, table);
  conclude(table, parameters, at.touches(), at.budget);
  text = table.text();
  add_motion(parameters, request, at);
}

Exploration response(const Parameters& parameters, const MotionRequest& at, double from,
                     double to)
{
  ResponseRequest request;
  static_cast<Request&>(request) = at;
  request.from = from;
  request.to = to;
  request.watch = [](double f, const Eigen::VectorXd& a) {
    show_point(f, a[0], a[1], a[2], a[3]);
  };
  if (chooses_harmonics(parameters)) request.harmonics.reset();
  return explore_response(request);
}

void answer(const std::string& what, const std::string& file,
            const MotionRequest& request, double from, double to)
{
  const Parameters parameters = read_parameters(file);
  if (what == "response") {
    const Exploration branch = response(parameters, request, from, to);
    text = branch.table.text();
    if (!branch.unfinished.empty()) throw NoSolution(branch.unfinished);
  } else if (what == "table") {
    MotionRequest plain = request;
    if (chooses_harmonics(parameters)) plain.harmonics.reset();
    text = explore_orbit(plain).table.text();
  } else {
    show_motion(what, parameters, request);
  }
}

}  // namespace

extern "C" {

EMSCRIPTEN_KEEPALIVE int live_run(const char* what, const char* file, const char* toml,
                                  double frequency, int harmonics, double from, double to)
{
  text.clear();
  numbers.clear();
  std::ofstream(file, std::ios::binary) << toml;
  MotionRequest request;
  request.parameter_file = file;
  request.frequency = frequency;
  request.harmonics = harmonics;
  if (std::string(what) == "crash") std::abort();  // asked for by the tests
  try {
    answer(what, file, request, from, to);
    return 0;
  } catch (const BadInput& error) {
    text = error.what();
    return 2;
  } catch (const std::exception& error) {
    text = error.what();
    return 3;
  }
}

EMSCRIPTEN_KEEPALIVE const char* live_text()
{
  return text.c_str();
}
EMSCRIPTEN_KEEPALIVE const double* live_numbers()
{
  return numbers.data();
}
EMSCRIPTEN_KEEPALIVE int live_count()
{
  return static_cast<int>(numbers.size());
}
}
