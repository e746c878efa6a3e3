#include "explore/spectrum.hpp"

#include <algorithm>
#include <cmath>

#include "balance/torus_line.hpp"
#include "explore/plot.hpp"
#include "io/errors.hpp"

namespace rotor_stator::explore {

namespace {

const char* const script = "spectrum.py";
constexpr int most_samples = 1 << 18;  // of a record; larger ones take minutes
constexpr double least = 1e-6;         // of the largest line

bool is_periodic(const std::string& method)
{
  return std::ranges::find(periodic_methods, method) != periodic_methods.end();
}

/** Ten seconds in 64 to 256 turns. */
int recorded_turns(double frequency)
{
  return static_cast<int>(std::clamp(std::ceil(10 * frequency), 64.0, 256.0));
}

/** What stands for the defaults of orbit: turns enough to tell lines apart, and harmonics up to three times BPFO. */
MotionRequest with_defaults(MotionRequest request, const Parameters& parameters)
{
  if (!is_periodic(request.method)) request.periods = recorded_turns(request.frequency);
  const bool is_free = !request.harmonics && !request.tolerance && !request.samples &&
                       request.subharmonic == 1;
  if (request.method == "aft" && is_free && turns_to_repeat(parameters.bearing) > 0)
    request.harmonics = static_cast<int>(
        std::clamp(std::ceil(3 * passages_per_turn(parameters.bearing)), 6.0, 96.0));
  return request;
}

const std::vector<Column> columns{
    {"f", "Hz", "of the line"},
    {"order", "-", "f over the speed"},
    {"k_rotation", "-",
     "2 pi f = k_rotation omega + k_cage omega_cage + k_spin omega_ball"},
    {"k_cage", "-", "n for BPFO"},
    {"k_spin", "-", "all three are 0 for a line without a name"},
    {"name", "-", "- for a line that is no combination"},
    {"x_s", "m", "amplitude, stator"},
    {"y_s", "m", "amplitude, stator"},
    {"x_r", "m", "amplitude, rotor"},
    {"y_r", "m", "amplitude, rotor"}};

/** A tolerance for the orders, and the largest multiple of BPFO less that of BPFI. */
struct Naming {
  double tolerance;
  int passages;
};

void note_names(Table& table, const motion::Lines& lines)
{
  table.note(format("mean: x_s = %.15g m, y_s = %.15g m, x_r = %.15g m, y_r = %.15g m",
                    lines.mean[0], lines.mean[1], lines.mean[2], lines.mean[3]));
  table.note(format("rows: amplitudes down to %g of the largest, largest first", least));
  table.note(
      "name: sum of multiples of X (rotation), BPFO and BPFI with the smallest sum of their "
      "absolute values, BPFO and BPFI counted twice, then the fewest terms, then the smallest "
      "multiple of BPFI; else a multiple of FTF or BSF");
}

void add_rows(Table& table, const Parameters& parameters, const SpectrumRequest& request,
              std::vector<motion::Line> lines, double noise, const Naming& naming)
{
  std::ranges::stable_sort(lines, std::ranges::greater{}, &motion::Line::largest);
  const double cut =
      std::max(least * (lines.empty() ? 0 : lines.front().largest()), noise);
  if (lines.empty() || !(lines.front().largest() > cut))
    throw NoSolution(parameters.file + ": the motion has no line, nothing moves");
  for (const motion::Line& line : lines) {
    if (line.largest() < cut) break;
    const motion::LineName name = motion::name_of(line.order, parameters.bearing,
                                                  naming.tolerance, naming.passages);
    const auto& a = line.amplitude;
    table.row({line.order * request.frequency, line.order, name.rotation, name.cage,
               name.spin, name.name.empty() ? "-" : name.name, a[0], a[1], a[2], a[3]});
  }
}

}  // namespace

Exploration explore_spectrum(const SpectrumRequest& request)
{
  Table table("Lines of the motion of rotor and stator", columns);
  const Parameters parameters = read_parameters(request.parameter_file);
  if (request.plot) require_plot(*request.plot, script, {request.parameter_file});
  const MotionRequest longer = with_defaults(request, parameters);
  const bool is_recorded = !is_periodic(request.method);
  if (request.points > most_samples / std::max(longer.periods, request.subharmonic))
    throw BadInput(format("--points %d: must be at most %d with %d turns", request.points,
                          most_samples / longer.periods, longer.periods));
  Computed at = computed(parameters, longer, table);
  motion::Lines& lines = at.found.lines;
  Naming naming{1e-9, 128};
  if (is_recorded) {
    lines = motion::lines_of_recorded(parameters.bearing, at.found.motion);
    naming.passages = 16;
    table.note(format(
        "lines: least squares over %d turns, window of Blackman and Harris, at most 200; lines "
        "nearer than %.3g of the speed may be taken for one; rest, in no line: %.2g "
        "rms of that about the mean",
        longer.periods, 4.0 / longer.periods, lines.rest));
  }
  note_names(table, lines);
  const double rounding =
      1e-13 * std::ranges::max(lines.mean, {}, [](double x) { return std::abs(x); });
  add_rows(table, parameters, request, std::move(lines.lines), std::abs(rounding),
           naming);
  conclude(table, parameters, at.touches(), at.budget);
  std::string missing;
  try {
    if (request.plot) plot(*request.plot, script, table.text());
  } catch (const NoSolution& error) {
    missing = error.what();
  }
  return {std::move(table), missing};
}

}  // namespace rotor_stator::explore
