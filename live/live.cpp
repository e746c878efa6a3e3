/**
# The library in the browser

What `explore` does, for the page: a question goes in as strings and numbers, one answer stands ready when
`live_run` returns. The status is that of `explore`: 0 done, 2 bad input, 3 no solution, with the same message. */
#include <emscripten.h>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "explore/response.hpp"
#include "explore/spectrum.hpp"
#include "io/errors.hpp"
#include "model/base_period.hpp"
#include "motion/contact.hpp"

namespace {

using namespace rotor_stator;
using namespace rotor_stator::explore;

std::string text;             // header of the table, or the message
std::vector<double> numbers;  // what is drawn

EM_JS(void, show_point, (double f, double x_s, double y_s, double x_r, double y_r), {
  Module.onPoint([ f, x_s, y_s, x_r, y_r ]);
});

/** Instants of a motion that is drawn, in base periods; of one that does not close, of which lines need more. */
constexpr int drawn_periods = 8, recorded_periods = 64;

/** First what says how to read the rest: instants, instants per turn, base periods, balls, cage ratio, clearance, first
    turn, whether the motion closes, instants of the contact over two turns, lines. */
void add_motion(const Parameters& parameters, double frequency, const FoundMotion& found)
{
  const motion::Motion& motion = found.motion;
  const Bearing& bearing = parameters.bearing;
  const bool closes = found.closes_after > 0;
  const double turns = found.turns_of_period, per_turn = motion.points_per_period / turns;
  const std::size_t rows = std::min(
      motion.size(),
      closes ? motion.size() : std::size_t(drawn_periods * motion.points_per_period));
  const auto loads =
      motion::ball_forces(found.machine, motion, long(std::ceil(2 / turns)));
  const std::size_t instants = std::min(std::size_t(loads.rows()), std::size_t(2 * per_turn));
  const motion::Lines all = lines_of(found);
  const auto forces = motion::bearing_forces(found.machine, motion);
  const auto add = [](std::initializer_list<double> values) {
    numbers.insert(numbers.end(), values);
  };
  add({double(rows), per_turn, double(rows) / motion.points_per_period,
       double(bearing.balls), bearing.cage_speed_ratio, bearing.clearance,
       double(motion.first_period) * turns, double(closes), double(instants),
       double(all.lines.size())});
  for (std::size_t k = 0; k < rows; ++k) {
    const auto& [stator, rotor] = motion.positions[k];
    add({stator.x, stator.y, rotor.x, rotor.y, forces[k].x, forces[k].y});
  }
  for (std::size_t k = 0; k < instants; ++k)
    for (const double load : loads.row(k)) numbers.push_back(load);
  for (const auto& [order, a] : all.lines) {
    add({order * frequency, a[0], a[1], a[2], a[3]});
    text += "=" + motion::name_of(order, bearing, 1e-9, closes ? 128 : 16).name + "\n";
  }
}

/** `orbit` the motion alone; `verdict` with the verdict and the error that it knows. */
void show_motion(const std::string& what, const Parameters& parameters,
                 MotionRequest request)
{
  request.is_measured = what == "verdict";
  request.periods = recorded_periods;
  Table table("Live", {});
  const FoundMotion found = computed(parameters, request, table);
  conclude(table, parameters, found.touches(), found.budget);
  text = table.text();
  add_motion(parameters, request.frequency, found);
}

void show_response(const MotionRequest& at, double from, double to)
{
  ResponseRequest request;
  static_cast<Request&>(request) = at;
  request.from = from;
  request.to = to;
  request.method = at.method;
  request.count = at.harmonics ? std::nullopt : std::optional(41);
  request.format = TableFormat::json;  // one table at the end, not row by row
  request.watch = [](double f, const Eigen::VectorXd& a) {
    show_point(f, a[0], a[1], a[2], a[3]);
  };
  const Exploration branch = explore_response(request);
  text = branch.table.text();
  if (!branch.unfinished.empty()) throw NoSolution(branch.unfinished);
}

void answer(const std::string& what, MotionRequest request, double from, double to)
{
  const Parameters parameters = read_parameters(request.parameter_file);
  /** What the machine does from rest is asked for by 0 harmonics, and answered where two frequencies drive. */
  if (request.harmonics == 0 || base_period(parameters).is_driven_twice()) {
    request.harmonics.reset();
    request.method = "auto";
    request.periods = drawn_periods;
  }
  if (what == "response")
    show_response(request, from, to);
  else if (what == "table")
    text = explore_orbit(request).table.text();
  else
    show_motion(what, parameters, request);
}

}  // namespace

extern "C" {

EMSCRIPTEN_KEEPALIVE int live_run(const char* what, const char* file, const char* toml,
                                  double frequency, int harmonics, double from, double to)
{
  if (std::string(what) == "crash") std::abort();  // asked for by the tests
  text.clear();
  numbers.clear();
  std::ofstream(file, std::ios::binary) << toml;
  MotionRequest request{};
  request.parameter_file = file;
  request.frequency = frequency;
  request.method = "aft";
  request.harmonics = harmonics;
  try {
    answer(what, request, from, to);
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
