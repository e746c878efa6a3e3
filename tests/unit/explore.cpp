/** explore: its fixed columns, and another bearing than the paper's. */
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "support/command.hpp"
#include "support/tsv.hpp"

using namespace rotor_stator::tests;

namespace
{

using Names = std::vector<std::string>;

bool has_line(const Tsv& table, const std::string& line)
{
  return std::find(table.header.begin(), table.header.end(), line) != table.header.end();
}

/** Fourteen balls of finite size (14 c = 6) between other masses. */
const std::string another_bearing = R"(title = "another bearing"
[stator]
mass_kg = 30.0
natural_frequency_rad_per_s = 420.0
damping_ratio = 0.05
[rotor]
mass_kg = 25.0
natural_frequency_rad_per_s = 180.0
damping_ratio = 0.03
unbalance_kg_m = 0.02
[bearing]
balls = 14
contact_stiffness_N_per_m1p5 = 2e10
radial_clearance_m = 1e-5
ball_radius_m = 0.01
inner_race_radius_m = 0.06
[gravity]
acceleration_m_per_s2 = 9.81
)";

Tsv orbit(const std::string& file, const std::string& options)
{
  const Outcome outcome =
      run_program("explore orbit " + file + " --points 64 " + options);
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  return parse_tsv(outcome.out);
}

/** Largest difference over the four displacements, over the largest displacement. */
double difference(const Tsv& a, const Tsv& b)
{
  double largest = 0, size = 0;
  for (const char* name : {"x_s", "y_s", "x_r", "y_r"}) {
    const auto u = a.column(name), v = b.column(name);
    for (std::size_t k = 0; k < v.size(); ++k) {
      largest = std::max(largest, std::abs(u[k] - v[k]));
      size = std::max(size, std::abs(v[k]));
    }
  }
  return largest / size;
}

}  // namespace

TEST_CASE("explore orbit: columns, phases and regime")
{
  const Tsv table = orbit("data/set1.toml", "--frequency 45");
  CHECK(table.names == Names{"phase", "x_s", "y_s", "x_r", "y_r", "F_x", "F_y"});
  REQUIRE(table.rows.size() == 64);
  CHECK(table.number(0, "phase") == 0);
  CHECK(table.number(16, "phase") == Approx(std::numbers::pi / 2));
  CHECK(has_line(table, "# regime: periodic"));
  CHECK(has_line(orbit("data/set1.toml", "--frequency 13.4 --method rk4 --longest 5"),
                 "# regime: aperiodic"));
}

TEST_CASE("explore contact: two periods of every ball")
{
  const Outcome outcome =
      run_program("explore contact data/set1.toml --frequency 45 --points 32");
  const Tsv table = parse_tsv(outcome.out);
  CHECK(table.names == Names{"t_over_T", "ball", "Q"});
  CHECK(table.rows.size() == 2 * 32 * 16);
  CHECK(table.number(table.rows.size() - 1, "t_over_T") == Approx(2 - 1.0 / 32));
  const auto q = table.column("Q");
  CHECK(*std::min_element(q.begin(), q.end()) == 0);
  CHECK(*std::max_element(q.begin(), q.end()) > 100);
}

TEST_CASE("explore contact: integration and balance give each ball the same force")
{
  const auto forces = [](const std::string& method) {
    return parse_tsv(
               run_program("explore contact data/set1.toml --frequency 45 --points 16 " +
                           method)
                   .out)
        .column("Q");
  };
  const auto a = forces("--harmonics 64"), b = forces("--method rk8pd");
  REQUIRE(a.size() == b.size());
  const double size = *std::max_element(b.begin(), b.end());
  double difference = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    difference = std::max(difference, std::abs(a[k] - b[k]));
  CHECK(difference / size < 1e-3);
}

TEST_CASE("explore response: from end to end, with the peak near 50 Hz")
{
  const Outcome outcome = run_program("explore response data/set1.toml --from 1 --to 60");
  REQUIRE(outcome.status == 0);
  const Tsv table = parse_tsv(outcome.out);
  CHECK(table.names ==
        Names{"f", "amp_x_s", "amp_y_s", "amp_x_r", "amp_y_r", "arc", "newton"});
  CHECK(table.number(0, "f") == Approx(1));
  CHECK(table.number(table.rows.size() - 1, "f") == Approx(60));
  const auto amplitude = table.column("amp_x_r");
  const auto peak =
      std::max_element(amplitude.begin(), amplitude.end()) - amplitude.begin();
  CHECK(table.number(static_cast<std::size_t>(peak), "f") == Approx(50).margin(1));
}

TEST_CASE(
    "explore response: a branch that turns back is printed, and said to be unfinished")
{
  const Outcome outcome =
      run_program("explore response data/set2.toml --from 1 --to 60 --harmonics 16");
  CHECK(outcome.status == 3);
  CHECK(parse_tsv(outcome.out).rows.size() > 10);
  CHECK(outcome.err.find("the branch stopped at") != std::string::npos);
}

TEST_CASE("Another bearing: harmonic balance approaches rk8pd as harmonics are added")
{
  const Scratch scratch;
  const std::string file = scratch.write("another.toml", another_bearing);
  for (const char* frequency : {"--frequency 12 ", "--frequency 45 "}) {
    INFO(frequency);
    const Tsv exact = orbit(file, std::string(frequency) + "--method rk8pd");
    REQUIRE(has_line(exact, "# regime: periodic"));
    const auto error = [&](const std::string& harmonics) {
      return difference(orbit(file, frequency + harmonics), exact);
    };
    CHECK(error("--harmonics 10") < 4e-3);
    CHECK(error("--harmonics 64") < 5e-4);
    CHECK(error("--harmonics 256") < 3e-6);
  }
}
