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

/** Throws NoSolution when there is no line above rounding. */
void add_rows(Table& table, const Parameters& parameters, const MotionRequest& request,
              motion::Lines all)
{
  const int passages = is_periodic(request.method) ? 128 : 16;
  auto& lines = all.lines;
  std::ranges::stable_sort(lines, std::ranges::greater{}, &motion::Line::largest);
  const double largest = lines.empty() ? 0 : lines.front().largest();
  double rounding = 0;
  for (double mean : all.mean) rounding = std::max(rounding, 1e-13 * std::abs(mean));
  if (!(largest > rounding))
    throw NoSolution(parameters.file + ": the motion has no line, nothing moves");
  for (const motion::Line& line : lines) {
    if (line.largest() < std::max(least * largest, rounding)) break;
    const motion::LineName name =
        motion::name_of(line.order, parameters.bearing, 1e-9, passages);
    const auto& a = line.amplitude;
    table.row({line.order * request.frequency, line.order, name.rotation, name.cage,
               name.spin, name.name.empty() ? "-" : name.name, a[0], a[1], a[2], a[3]});
  }
}

/** Those that harmonic balance or shooting have found, or read from the record. */
motion::Lines lines_of(const Parameters& parameters, const MotionRequest& request,
                       Computed& at, Table& table)
{
  if (is_periodic(request.method)) return std::move(at.found.lines);
  motion::Lines lines = motion::lines_of_recorded(parameters.bearing, at.found.motion);
  table.note(
      format("lines: least squares over %d turns, window of Blackman and Harris, at most "
             "200; lines nearer than %.3g of the speed may be taken for one; rest, in no "
             "line: %.2g rms of that about the mean",
             request.periods, 4.0 / request.periods, lines.rest));
  return lines;
}

}  // namespace

Exploration explore_spectrum(const SpectrumRequest& asked)
{
  Table table("Lines of the motion of rotor and stator", columns);
  const Parameters parameters = read_parameters(asked.parameter_file);
  if (asked.plot) require_plot(*asked.plot, script, {asked.parameter_file});
  const MotionRequest request = with_defaults(asked, parameters);
  const int turns = std::max(request.periods, request.subharmonic);
  if (request.points > most_samples / turns)
    throw BadInput(format("--points %d: must be at most %d with %d turns", request.points,
                          most_samples / turns, turns));
  Computed at = computed(parameters, request, table);
  if (request.method != "aft")
    table.note(
        format("samples of shooting and time methods: %d per turn, orders up to %d; "
               "higher ones are folded onto these",
               request.points, request.points / 2));
  const motion::Lines lines = lines_of(parameters, request, at, table);
  note_names(table, lines);
  add_rows(table, parameters, request, lines);
  conclude(table, parameters, at.touches(), at.budget);
  std::string missing = plot(asked.plot, script, table.text());
  return {std::move(table), std::move(missing)};
}

}  // namespace rotor_stator::explore
