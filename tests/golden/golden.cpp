/** The tables of the figures against kept ones. A golden file freezes behaviour and proves
    nothing: what is right is tested in unit/. It holds some rows of a table and, in its header,

    # program: fig05_displacements
    # key: panel source t_over_T       the columns that name a row
    # agreeing: 0.9 where set = 2      share of such rows that must agree; of others all
    # tolerance: x_s 1e-6 1e-10        relative, absolute; columns without one are not compared

    Rows of aperiodic motion (periodic = 0, from time integration) differ from machine to
    machine in every digit: per panel or data set, the mean of each column must agree within
    half its standard deviation or a tenth, and the deviation within a half. */
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

#include "support/command.hpp"
#include "support/tsv.hpp"

using namespace rotor_stator::tests;

namespace
{

struct Tolerance {
  double relative, absolute;
};

struct Golden {
  Tsv table;
  std::string program;
  std::vector<std::string> key;
  double agreeing = 1;  ///< share of the rows where `column` = `value`
  std::string column, value;
  std::map<std::string, Tolerance> tolerances;
};

Golden read_golden(const std::string& name)
{
  Golden golden{parse_tsv(read_whole(SOURCE_DIR "/tests/golden/" + name + ".tsv")),
                {},
                {},
                1,
                {},
                {},
                {}};
  for (const std::string& line : golden.table.header) {
    std::istringstream words(line.substr(1));
    std::string what, word;
    words >> what;
    if (what == "program:") words >> golden.program;
    if (what == "agreeing:")
      words >> golden.agreeing >> word >> golden.column >> word >> golden.value;
    if (what == "key:")
      while (words >> word) golden.key.push_back(word);
    if (what == "tolerance:") {
      words >> word;
      words >> golden.tolerances[word].relative >> golden.tolerances[word].absolute;
    }
  }
  return golden;
}

std::string key_of(const Golden& golden, const Tsv& table, std::size_t row)
{
  std::string key;
  for (const std::string& name : golden.key)
    key += table.rows[row][table.index(name)] + " ";
  return key;
}

bool is_aperiodic(const Tsv& table, std::size_t row)
{
  if (!table.has("periodic") || table.number(row, "periodic") == 1) return false;
  return !table.has("source") || table.number(row, "source") == 2;
}

/** Whether only a share of the rows like this one must agree. */
bool is_sensitive(const Golden& golden, std::size_t row)
{
  if (golden.column.empty()) return false;
  return golden.table.rows[row][golden.table.index(golden.column)] == golden.value;
}

/** Whether a row agrees with the golden one in every column that has a tolerance. */
bool agrees(const Golden& golden, std::size_t row, const Tsv& table, std::size_t other)
{
  for (const auto& [name, tolerance] : golden.tolerances) {
    const double expected = golden.table.number(row, name),
                 got = table.number(other, name);
    if (!(std::abs(got - expected) <=
          tolerance.absolute + tolerance.relative * std::abs(expected)))
      return false;
  }
  return true;
}

struct Statistics {
  double sum = 0, squares = 0;
  int count = 0;

  void add(double value)
  {
    sum += value;
    squares += value * value;
    ++count;
  }
  double mean() const { return sum / count; }
  double deviation() const
  {
    return std::sqrt(std::max(0.0, squares / count - mean() * mean()));
  }
};

using GroupStatistics = std::map<std::string, std::map<std::string, Statistics>>;

void check_statistics(const GroupStatistics& expected, const GroupStatistics& got)
{
  for (const auto& [group, columns] : expected)
    for (const auto& [name, statistics] : columns) {
      INFO("aperiodic group " << group << ", column " << name);
      const Statistics& other = got.at(group).at(name);
      const double deviation = statistics.deviation();
      CHECK(other.mean() ==
            Approx(statistics.mean()).epsilon(0.1).margin(0.5 * deviation));
      CHECK(other.deviation() == Approx(deviation).epsilon(0.5).margin(1e-12));
    }
}

/** How the rows of a table agree with the golden ones. */
struct Comparison {
  int disagreements = 0, sensitive = 0, sensitive_disagreements = 0;
  std::string first_disagreement;
  GroupStatistics expected, got;  ///< of aperiodic rows
};

Comparison compare(const Golden& golden, const Tsv& table)
{
  std::map<std::string, std::size_t> rows;
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    rows[key_of(golden, table, row)] = row;
  Comparison result;
  for (std::size_t row = 0; row < golden.table.rows.size(); ++row) {
    const std::string key = key_of(golden, golden.table, row);
    const auto found = rows.find(key);
    if (is_aperiodic(golden.table, row) && found != rows.end()) {
      const std::string group = golden.table.rows[row][0];
      for (const auto& [column, tolerance] : golden.tolerances) {
        result.expected[group][column].add(golden.table.number(row, column));
        result.got[group][column].add(table.number(found->second, column));
      }
      continue;
    }
    const bool sensitive = is_sensitive(golden, row);
    if (sensitive) ++result.sensitive;
    if (found != rows.end() && agrees(golden, row, table, found->second)) continue;
    ++(sensitive ? result.sensitive_disagreements : result.disagreements);
    if (result.first_disagreement.empty()) result.first_disagreement = key;
  }
  return result;
}

void check_against_golden(const std::string& name)
{
  const Golden golden = read_golden(name);
  REQUIRE_FALSE(golden.program.empty());
  REQUIRE_FALSE(golden.tolerances.empty());
  const Outcome outcome = run_program(golden.program);
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  const Tsv table = parse_tsv(outcome.out);
  CHECK(table.names == golden.table.names);

  const Comparison result = compare(golden, table);
  INFO("first disagreement at " << result.first_disagreement);
  CHECK(result.disagreements == 0);
  CHECK(result.sensitive_disagreements <= (1 - golden.agreeing) * result.sensitive);
  check_statistics(result.expected, result.got);
}

}  // namespace

TEST_CASE("Golden table of Fig. 1")
{
  check_against_golden("fig01_bearing");
}
TEST_CASE("Golden table of Fig. 2")
{
  check_against_golden("fig02_ball_position");
}
TEST_CASE("Golden table of Fig. 3")
{
  check_against_golden("fig03_response");
}
TEST_CASE("Golden table of Fig. 4")
{
  check_against_golden("fig04_displacements");
}
TEST_CASE("Golden table of Fig. 5")
{
  check_against_golden("fig05_displacements");
}
TEST_CASE("Golden table of Fig. 6")
{
  check_against_golden("fig06_orbits");
}
TEST_CASE("Golden table of Fig. 7")
{
  check_against_golden("fig07_contact");
}
TEST_CASE("Golden table of Fig. 8")
{
  check_against_golden("fig08_orbits");
}
TEST_CASE("Golden table of Fig. 9")
{
  check_against_golden("fig09_contact");
}
TEST_CASE("Golden table of Table 1")
{
  check_against_golden("tab01_parameters");
}
TEST_CASE("Golden table of the sensitivity to unpublished parameters")
{
  check_against_golden("sensitivity");
}
