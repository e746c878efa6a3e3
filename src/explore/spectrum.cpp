#include "explore/spectrum.hpp"

#include <algorithm>
#include <cmath>

#include "io/errors.hpp"
#include "io/table.hpp"

namespace rotor_stator::explore {

namespace {

constexpr int most_samples = 1 << 18;  // of a record; larger ones take minutes
constexpr double least = 1e-6;         // of the largest line

}  // namespace

const std::vector<Column> line_columns{
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

motion::Lines lines_of(const FoundMotion& found)
{
  if (found.closes_after > 0) return found.lines;
  motion::Lines lines =
      motion::lines_of_recorded(bearings_of(found.machine), found.motion);
  for (motion::Line& line : lines.lines) line.order /= found.turns_of_period;
  return lines;
}

bool add_lines(Table& table, const std::vector<Bearing>& bearings, double frequency,
               motion::Lines all, int passages, double smallest)
{
  auto& lines = all.lines;
  std::ranges::stable_sort(lines, std::ranges::greater{}, &motion::Line::largest);
  const double largest = lines.empty() ? 0 : lines.front().largest();
  double rounding = 0;
  for (double mean : all.mean) rounding = std::max(rounding, 1e-13 * std::abs(mean));
  if (!(largest > rounding)) return false;
  for (const motion::Line& line : lines) {
    if (line.largest() < std::max(smallest * largest, rounding)) break;
    const motion::LineName name = motion::name_of(line.order, bearings, 1e-9, passages);
    const auto& a = line.amplitude;
    table.row({line.order * frequency, line.order, name.rotation, name.cage, name.spin,
               name.name.empty() ? "-" : name.name, a[0], a[1], a[2], a[3]});
  }
  return true;
}

Exploration explore_spectrum(const MotionRequest& asked)
{
  Table table("Lines of the motion of rotor and stator", line_columns);
  table.choose(asked.columns, line_columns.size(), asked.plot.has_value());
  const Parameters parameters = machine_of(asked, asked.frequency, asked.frequency);
  if (asked.overlay) {
    const NumberTable measured(*asked.overlay);
    constexpr double most = 1e30;  // what a figure can show
    for (std::size_t k = 0; k < measured.rows(); ++k)
      for (const char* name : {"f", "amplitude"})
        if (std::abs(measured.at(k, name)) > most)
          measured.fail(k, std::string(name) + ": is beyond 1e30, too large to draw");
    table.note("overlay: " + *asked.overlay);
  }
  MotionRequest request = asked;
  const bool is_free = !request.harmonics && !request.tolerance && !request.samples &&
                       !request.lines && request.subharmonic == 1;
  /** Up to three times BPFO. */
  if (request.method == "aft" && is_free && turns_to_repeat({parameters.bearing}) > 0)
    request.harmonics = static_cast<int>(
        std::clamp(std::ceil(3 * passages_per_turn(parameters.bearing)), 6.0, 96.0));
  /** Ten seconds in 64 to 256 turns tell lines apart. */
  request.periods =
      is_periodic(request.method)
          ? request.subharmonic
          : static_cast<int>(std::clamp(std::ceil(10 * request.frequency), 64.0, 256.0));
  if (request.points > most_samples / request.periods)
    throw BadInput(format("--points %d: must be at most %d with %d turns", request.points,
                          most_samples / request.periods, request.periods));
  const FoundMotion at = computed(parameters, request, table);
  if (request.method != "aft")
    table.note(format(
        "samples of shooting and time methods: %.6g per turn, orders up to %.6g; "
        "higher ones are folded onto these",
        request.points / at.turns_of_period, request.points / at.turns_of_period / 2));
  const motion::Lines lines = lines_of(at);
  if (at.closes_after == 0) {
    const int turns = static_cast<int>(at.motion.size()) / request.points;
    table.note(format(
        "lines: least squares over %d base periods, window of Blackman and Harris, at "
        "most 200; lines nearer than %.3g of the speed may be taken for one; "
        "unexplained: rms of the rest, in no line, over that about the mean",
        turns, 4.0 / (turns * at.turns_of_period)));
    table.value("unexplained", lines.rest, 2);
  }
  for (int k = 0; const char* name : {"mean_x_s", "mean_y_s", "mean_x_r", "mean_y_r"})
    if (!at.has_statistics) table.value(name, lines.mean[k++]);
  table.note(format("rows: amplitudes down to %g of the largest, largest first", least));
  table.note(
      "name: sum of multiples of X (rotation), BPFO and BPFI with the smallest sum of "
      "their absolute values, BPFO and BPFI counted twice, then the fewest terms, then "
      "the smallest multiple of BPFI; else a multiple of FTF or BSF; of a second bearing "
      "BPFO_2, ..., and k_cage counts its cage");
  if (!add_lines(table, bearings_of(parameters), request.frequency, lines,
                 at.closes_after > 0 ? 128 : 16, least))
    throw NoSolution(parameters.file + ": the motion has no line, nothing moves");
  conclude(table, parameters, at.touches(), at.budget);
  return {std::move(table)};
}

}  // namespace rotor_stator::explore
