#include "explore/branch_file.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "io/errors.hpp"
#include "io/strict_toml.hpp"
#include "io/table.hpp"

namespace rotor_stator::explore
{

namespace
{

const std::string format_name = "branch of harmonic balance, version 1";

std::string exact(double number)
{
  return format("%.17g", number);
}

/** All values of a machine on one line. */
std::string machine(const Parameters& p)
{
  std::string line;
  for (double value :
       {p.stator.mass, p.stator.natural_frequency, p.stator.damping_ratio, p.rotor.mass,
        p.rotor.natural_frequency, p.rotor.damping_ratio, p.unbalance, p.gravity,
        static_cast<double>(p.bearing.balls), p.bearing.contact_stiffness,
        p.bearing.clearance, p.bearing.cage_speed_ratio})
    line += (line.empty() ? "" : " ") + exact(value);
  return line;
}

std::vector<Column> columns_of(int harmonics)
{
  std::vector<Column> columns{{"branch", "-", "number"},
                              {"omega", "rad/s", "speed of rotation"},
                              {"arc", "-", "scaled arc length"},
                              {"speed_direction", "-", "d omega / d arc, scaled"}};
  const auto add = [&](const std::string& name, const std::string& meaning) {
    for (const char* axis : {"x", "y"})
      columns.push_back(
          {format("u_%s_%s", axis, name.c_str()), "m", meaning + " of u_" + axis});
  };
  add("0", "mean");
  for (int h = 1; h <= harmonics; ++h) {
    add(format("cos%d", h), format("cosine %d", h));
    add(format("sin%d", h), format("sine %d", h));
  }
  return columns;
}

}  // namespace

std::string branch_text(const Parameters& parameters, int harmonics, int samples,
                        bool upwards, const std::vector<const Branch*>& branches)
{
  Table table("format: " + format_name, columns_of(harmonics));
  describe(table, parameters);
  table.note("machine: " + machine(parameters));
  table.note(format("harmonics: %d", harmonics));
  table.note(format("samples: %d", samples));
  table.note(std::string("direction: ") + (upwards ? "up" : "down"));
  for (std::size_t k = 0; k < branches.size(); ++k)
    for (const BranchPoint& point : branches[k]->points) {
      std::vector<Cell> row{k + 1, exact(point.omega), exact(point.arc),
                            exact(point.speed_direction)};
      for (double value : point.x) row.emplace_back(exact(value));
      table.row(std::move(row));
    }
  return table.text();
}

namespace
{

/** The lines of a branch file, read one after the other. */
class Reader
{
public:
  explicit Reader(const std::string& file) : file_(file)
  {
    require_plain_file(file, "a saved branch");
    in_.open(file);
    if (!in_) throw BadInput(file + ": cannot be read");
  }

  [[noreturn]] void fail(const std::string& problem) const
  {
    throw BadInput(format("%s:%d: %s", file_.c_str(), line_, problem.c_str()));
  }

  bool next(std::string& line)
  {
    if (!std::getline(in_, line)) return false;
    ++line_;
    if (in_.eof()) fail("the line is cut off");
    return true;
  }

  double number(const std::string& word) const
  {
    double value = 0;
    const char* end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (error != std::errc() || stop != end || !std::isfinite(value))
      fail("'" + word.substr(0, 40) + "' is not a finite number");
    return value;
  }

  int integer(const std::string& word, int least, int most) const
  {
    const double value = number(word);
    if (value < least || value > most || value != std::floor(value))
      fail("'" + word.substr(0, 40) +
           format("' is not a whole number in %d...%d", least, most));
    return static_cast<int>(value);
  }

private:
  std::string file_;
  std::ifstream in_;
  int line_ = 0;
};

std::vector<std::string> words_of(const std::string& line)
{
  std::vector<std::string> words;
  std::istringstream in(line);
  for (std::string word; std::getline(in, word, '\t');) words.push_back(word);
  return words;
}

/** The `# key: value` lines; `line` is then the row of names. */
std::map<std::string, std::string> read_keys(Reader& reader, const Parameters& parameters,
                                             std::string& line)
{
  std::map<std::string, std::string> values;
  while (reader.next(line) && line.starts_with("# ")) {
    const auto colon = line.find(": ");
    const bool pair = colon != std::string::npos && !line.starts_with("# column");
    const std::string key = pair ? line.substr(2, colon - 2) : "";
    if (pair) values[key] = line.substr(colon + 2);
    if (values["format"] != format_name)
      reader.fail("is no saved branch: '# format: " + format_name + "' is expected");
    if (key == "machine" && values[key] != machine(parameters))
      reader.fail("the branch is of another machine than " + parameters.file);
  }
  if (values["format"] != format_name) reader.fail("is no saved branch");
  for (const char* key : {"machine", "harmonics", "samples", "direction"})
    if (!values.contains(key)) reader.fail(format("'# %s: ' is missing above", key));
  return values;
}

SavedBranch read_header(Reader& reader, const Parameters& parameters)
{
  std::string line, names;
  auto values = read_keys(reader, parameters, line);
  const int harmonics = reader.integer(values["harmonics"], 1, 4096);
  const int samples = reader.integer(values["samples"], 2 * harmonics + 1, 1 << 20);
  const std::string direction = values["direction"];
  if (direction != "up" && direction != "down")
    reader.fail("direction " + direction + " above: must be up or down");
  for (const Column& column : columns_of(harmonics))
    names += (names.empty() ? "" : "\t") + column.name;
  if (line != names)
    reader.fail(
        format("the names of the columns are not those of %d harmonics", harmonics));
  return {harmonics, samples, direction == "up", {}};
}

BranchPoint read_point(const Reader& reader, const std::vector<std::string>& words)
{
  const auto n = static_cast<Eigen::Index>(words.size()) - 4;
  BranchPoint point{reader.number(words[1]),
                    reader.number(words[2]),
                    reader.number(words[3]),
                    {},
                    Eigen::VectorXd(n)};
  if (!(point.omega > 0)) reader.fail("omega must be > 0");
  for (Eigen::Index k = 0; k < n; ++k)
    point.x[k] = reader.number(words[static_cast<std::size_t>(k) + 4]);
  return point;
}

}  // namespace

SavedBranch read_branch(const std::string& file, const Parameters& parameters, int number)
{
  Reader reader(file);
  SavedBranch branch = read_header(reader, parameters);
  const auto wanted = columns_of(branch.harmonics).size();
  for (std::string line; reader.next(line);) {
    const auto words = words_of(line);
    if (words.size() != wanted)
      reader.fail(format("%zu numbers where %zu are expected", words.size(), wanted));
    const int which = reader.integer(words[0], 1, 1000000);
    BranchPoint point = read_point(reader, words);
    if (which != number) continue;
    if (!branch.points.empty() && point.arc <= branch.points.back().arc)
      reader.fail("arc must increase along a branch");
    branch.points.push_back(std::move(point));
  }
  if (branch.points.empty()) reader.fail(format("there is no branch %d", number));
  return branch;
}

BranchPoint restart_point(const SavedBranch& branch, const double* omega,
                          const ArcLengthSettings& settings)
{
  const auto& points = branch.points;
  std::size_t k = points.size() - 1;
  if (omega)
    for (std::size_t j = 0; j < points.size(); ++j)
      if (std::abs(points[j].omega - *omega) < std::abs(points[k].omega - *omega)) k = j;
  BranchPoint point = points[k];
  const BranchPoint &before = points[k == 0 ? 0 : k - 1],
                    &after = points[std::min(k + 1, points.size() - 1)];
  point.tangent = scaled(after, settings) - scaled(before, settings);
  /** A branch of one point: its direction is that of the speed. */
  if (points.size() == 1)
    point.tangent[point.x.size()] = point.speed_direction < 0 ? -1 : 1;
  point.tangent.normalize();
  point.arc = 0;
  return point;
}

}  // namespace rotor_stator::explore
