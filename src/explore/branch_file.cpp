#include "explore/branch_file.hpp"

#include <algorithm>
#include <cmath>

#include "io/errors.hpp"
#include "io/table.hpp"

namespace rotor_stator::explore {

namespace {

const std::string what = "Branch of harmonic balance";

std::string exact(double number)
{
  return format("%.17g", number);
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
                        bool upwards, const std::vector<Branch>& branches)
{
  Table table(what, columns_of(harmonics));
  describe(table, parameters);
  table.value("harmonics", harmonics);
  table.value("samples", samples);
  table.value("direction", upwards ? "up" : "down");
  for (std::size_t k = 0; k < branches.size(); ++k)
    for (const BranchPoint& point : branches[k].points) {
      std::vector<Cell> row{k + 1, exact(point.motion.omega), exact(point.arc),
                            exact(point.speed_direction())};
      for (double value : point.motion.x) row.emplace_back(exact(value));
      table.row(std::move(row));
    }
  return table.text();
}

SavedBranch read_branch(const std::string& file, const Parameters& parameters, int number)
{
  const NumberTable table(file, "# " + what);
  if (table.header("machine") != parameters.identity.word())
    table.fail("the branch is of another machine than " + parameters.file);
  const std::string direction = table.header("direction");
  if (direction != "up" && direction != "down")
    table.fail("# direction: " + direction + ": must be up or down");
  const auto whole = [&](const std::string& key, int least, int most) {
    const std::optional<double> value = decimal(table.header(key));
    if (!value || *value < least || *value > most || *value != std::floor(*value))
      table.fail("# " + key + ": " + table.header(key) +
                 format(": must be in %d...%d, a whole number", least, most));
    return static_cast<int>(*value);
  };
  const int harmonics = whole("harmonics", 1, 4096);
  const int samples = whole("samples", 2 * harmonics + 1, 1 << 20);
  const auto columns = columns_of(harmonics);
  if (!std::equal(columns.begin(), columns.end(), table.names().begin(),
                  table.names().end(), [](const Column& column, const std::string& name) {
                    return column.name == name;
                  }))
    table.fail(
        format("the names of the columns are not those of %d harmonics", harmonics));

  SavedBranch branch{harmonics, samples, direction == "up", {}};
  for (std::size_t k = 0; k < table.rows(); ++k) {
    const std::vector<double>& row = table.row(k);
    if (row[0] != number) continue;
    if (!(row[1] > 0)) table.fail(k, "omega must be > 0");
    if (!branch.points.empty() && row[2] <= branch.points.back().arc)
      table.fail(k, "arc must increase along a branch");
    const auto n = static_cast<Eigen::Index>(row.size()) - 4;
    branch.points.push_back({{.omega = row[1],
                              .harmonics = harmonics,
                              .x = Eigen::Map<const Eigen::VectorXd>(&row[4], n)},
                             row[2],
                             row[3] * Eigen::VectorXd::Unit(n + 1, n)});
  }
  if (branch.points.empty()) table.fail(format("there is no branch %d", number));
  return branch;
}

BranchPoint restart_point(const SavedBranch& branch, std::optional<double> frequency,
                          const Curve& curve)
{
  const auto& points = branch.points;
  auto near = points.end() - 1;
  if (frequency)
    near = std::ranges::min_element(points, {}, [&](const BranchPoint& p) {
      return std::abs(p.motion.omega - angular(*frequency));
    });
  BranchPoint point = *near;
  const BranchPoint &before = near == points.begin() ? *near : near[-1],
                    &after = near + 1 == points.end() ? *near : near[1];
  const double speed = point.speed_direction();
  point.tangent = curve.scaled(after.motion) - curve.scaled(before.motion);
  /** A branch of one point: its direction is that of the speed. */
  if (points.size() == 1) point.tangent[point.motion.x.size()] = speed < 0 ? -1 : 1;
  point.tangent.normalize();
  point.arc = 0;
  return point;
}

}  // namespace rotor_stator::explore
