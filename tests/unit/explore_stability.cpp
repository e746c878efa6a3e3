/** explore response --stability: verdicts against those of single orbits, and its bound on work. */
#include <algorithm>
#include <cmath>
#include "support/catch.hpp"

#include "io/errors.hpp"
#include "support/command.hpp"
#include "support/tsv.hpp"

using namespace rotor_stator;
using namespace rotor_stator::tests;

namespace
{

const std::string response = "explore response data/set1.toml ";

/** The verdict and the largest multiplier that explore orbit finds, from a start of its own. */
struct Single {
  std::string verdict;
  double multiplier;
};

Single orbit_at(double frequency)
{
  const Outcome outcome = run_program(
      format("explore orbit data/set1.toml --points 1 --frequency %.15g", frequency));
  const std::string before = "# stability: ", between = "; largest Floquet multiplier ";
  const auto line = outcome.out.find(before) + before.size();
  const auto number = outcome.out.find(between, line);
  REQUIRE(number != std::string::npos);
  return {outcome.out.substr(line, number - line),
          std::stod(outcome.out.substr(number + between.size()))};
}

std::string cell(const Tsv& table, std::size_t row, const std::string& name)
{
  return table.rows[row][table.index(name)];
}

}  // namespace

TEST_CASE("explore response --stability: each verdict is that of the orbit there")
{
  const Outcome outcome =
      run_program(response + "--from 12 --to 12.7 --harmonics 6 --stability");
  REQUIRE(outcome.status == 0);
  const Tsv table = parse_tsv(outcome.out);
  REQUIRE(table.names.size() == 11);
  const std::size_t step = std::max<std::size_t>(1, table.rows.size() / 6);
  for (std::size_t k = 0; k < table.rows.size(); k += step) {
    if (cell(table, k, "bifurcation") != "-") continue;
    const Single single = orbit_at(table.number(k, "f"));
    CHECK(cell(table, k, "verdict") == single.verdict);
    CHECK(table.number(k, "multiplier") == Approx(single.multiplier).epsilon(1e-5));
    CHECK(table.number(k, "multiplier_change") < 1e-6 * std::max(1.0, single.multiplier));
  }
}

TEST_CASE("explore response --stability: a period doubling is right to 1e-6 in speed")
{
  const Outcome outcome =
      run_program(response + "--from 12 --to 12.7 --harmonics 6 --stability");
  const Tsv table = parse_tsv(outcome.out);
  std::vector<double> doublings;
  for (std::size_t k = 0; k < table.rows.size(); ++k)
    if (cell(table, k, "bifurcation") == "period-doubling") {
      doublings.push_back(table.number(k, "f"));
      CHECK(outcome.out.find(format("# period-doubling: %.9g Hz\n", doublings.back())) !=
            std::string::npos);
    }
  /** The first opens a stretch of unstable orbits, the second closes it. */
  REQUIRE(doublings.size() >= 2);
  CHECK(orbit_at(doublings[0] * (1 - 1e-6)).multiplier < 1);
  CHECK(orbit_at(doublings[0] * (1 + 1e-6)).multiplier > 1);
  CHECK(orbit_at(doublings[1] * (1 - 1e-6)).multiplier > 1);
  CHECK(orbit_at(doublings[1] * (1 + 1e-6)).multiplier < 1);
}

TEST_CASE("explore response --stability: what the work does not allow is said")
{
  const Outcome outcome =
      run_program(response + "--from 1 --to 60 --stability --budget 2.7e7");
  CHECK(outcome.status == 3);
  CHECK(outcome.err.find("no multipliers at") != std::string::npos);
  CHECK(outcome.err.find("used up") != std::string::npos);
  CHECK(outcome.out.find("nan") == std::string::npos);
  const Tsv table = parse_tsv(outcome.out);
  std::size_t known = 0;
  for (std::size_t k = 0; k < table.rows.size(); ++k)
    known += cell(table, k, "verdict") != "unknown";
  CHECK(known > 0);
  CHECK(known < table.rows.size());
  CHECK(table.number(table.rows.size() - 1, "f") == Approx(60));
  CHECK(table.number(table.rows.size() - 1, "multiplier") == -1);
}
