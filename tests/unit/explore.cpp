/** explore: its fixed columns, and another bearing than the paper's. */
#include <algorithm>
#include <cmath>
#include <numbers>
#include "support/catch.hpp"

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

TEST_CASE("explore response: a branch that is not covered is printed and said to be")
{
  const Outcome outcome = run_program(
      "explore response data/set2.toml --from 1 --to 60 --harmonics 16 --budget 2e5");
  CHECK(outcome.status == 3);
  const Tsv table = parse_tsv(outcome.out);
  CHECK(table.rows.size() > 10);
  const std::string why =
      "the budget of 2e+05 evaluations of the force is used up; more with --budget";
  CHECK(has_line(table, "# incomplete: " + why));
  CHECK(outcome.err.find("the branch stopped at") != std::string::npos);
  CHECK(outcome.err.find("before --to 60 Hz: " + why) != std::string::npos);
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

namespace
{

const std::string response = "explore response data/set1.toml --from 1 --to 60 ";

/** The largest relative difference of the amplitudes in one row of each table. */
double row_difference(const Tsv& a, std::size_t i, const Tsv& b, std::size_t j)
{
  double largest = 0;
  for (const char* name : {"f", "amp_x_s", "amp_y_s", "amp_x_r", "amp_y_r"})
    largest = std::max(largest, std::abs(a.number(i, name) / b.number(j, name) - 1));
  return largest;
}

}  // namespace

TEST_CASE("explore response: downwards it ends where upwards it begins")
{
  const Tsv up = parse_tsv(run_program(response).out);
  const Tsv down = parse_tsv(run_program(response + "--direction down").out);
  const std::size_t last_up = up.rows.size() - 1, last_down = down.rows.size() - 1;
  CHECK(down.number(0, "f") == Approx(60).epsilon(1e-12));
  CHECK(row_difference(down, last_down, up, 0) < 1e-9);
  CHECK(row_difference(down, 0, up, last_up) < 1e-9);
}

TEST_CASE("explore response: a saved branch is gone on with, either way")
{
  const Scratch scratch;
  const std::string file = scratch.path("branch.tsv");
  const Outcome whole = run_program(response + "--save " + file);
  REQUIRE(whole.status == 0);
  const Tsv table = parse_tsv(whole.out);
  const std::string restart = response + "--restart " + file + " ";
  const auto end_of = [&](const std::string& options, std::size_t row) {
    const Outcome outcome = run_program(restart + options);
    INFO(options << ": " << outcome.err);
    REQUIRE(outcome.status == 0);
    const Tsv part = parse_tsv(outcome.out);
    CHECK(row_difference(part, part.rows.size() - 1, table, row) < 1e-9);
  };
  end_of("--at 30", table.rows.size() - 1);
  end_of("--at 30 --direction down", 0);
  end_of("--direction down", 0);

  /** With more harmonics the saved points are starts. */
  const Outcome more = run_program(restart + "--at 30 --harmonics 12");
  REQUIRE(more.status == 0);
  const Tsv direct = parse_tsv(run_program(response + "--harmonics 12").out);
  const Tsv warm = parse_tsv(more.out);
  CHECK(row_difference(warm, warm.rows.size() - 1, direct, direct.rows.size() - 1) <
        1e-9);
}

TEST_CASE("explore response: a branch is gone on with from the very end of its range")
{
  const Scratch scratch;
  const std::string file = scratch.path("branch.tsv"),
                    machine = "explore response data/set1.toml ";
  for (const auto& [first, on] :
       {std::pair("--from 29 --to 30 --direction up", "--from 30 --to 31"),
        std::pair("--from 26 --to 27 --direction down", "--from 25 --to 26")}) {
    INFO(first);
    REQUIRE(run_program(machine + first + " --save " + file).status == 0);
    CHECK(run_program(machine + on + " --restart " + file).status == 0);
  }
}

TEST_CASE("explore response: a search for isolated branches that was cut off says so")
{
  const Outcome outcome = run_program(
      "explore response data/set2.toml --from 1 --to 60 --isolated 10 --budget 5.5e7");
  CHECK(outcome.status == 3);
  CHECK(outcome.err.find("cut off") != std::string::npos);
  CHECK(outcome.out.find("# incomplete: the budget cut off") != std::string::npos);
}

TEST_CASE("explore response: what is no saved branch of this machine is refused by line")
{
  const Scratch scratch;
  const std::string file = scratch.path("branch.tsv");
  REQUIRE(run_program(response + "--save " + file).status == 0);
  const std::string saved = read_whole(file);
  const auto refused = [&](const std::string& content, const std::string& mentions) {
    const std::string changed = scratch.write("changed.tsv", content);
    const Outcome outcome = run_program(response + "--restart " + changed);
    INFO(outcome.err);
    CHECK(outcome.status == 2);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.find("changed.tsv:") != std::string::npos);
    CHECK(outcome.err.find(mentions) != std::string::npos);
  };
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = saved;
    const auto place = changed.find(from);
    REQUIRE(place != std::string::npos);
    return changed.replace(place, from.size(), to);
  };
  const std::string expected = "changed.tsv:1: '# format: branch of harmonic balance";
  refused("", expected);
  refused("f\tamp\n1\t2\n", expected);
  refused("# a table\n", expected);
  refused(with("# machine: 20 ", "# machine: 21 "), "another machine");
  refused(with("# harmonics: 6", "# harmonics: 7"), "the names of the columns");
  refused(with("# harmonics: 6", "# harmonics: many"),
          "# harmonics: many: must be in 1...4096");
  refused(with("# direction: up", "# direction: left"), "must be up or down");
  refused(saved.substr(0, saved.size() - 20), "the line is cut off");
  refused(saved + "1\tnan\n", "is not a finite number");
  const auto last_row = saved.rfind("\n1\t") + 1;
  refused(saved + saved.substr(last_row), "arc must increase");
  refused(
      saved.substr(0, last_row) + "1\tinf" + saved.substr(saved.find('\t', last_row + 2)),
      "'inf' is not a finite number");
  CHECK(run_program(response + "--branch 2 --restart " + file)
            .err.find("there is no branch 2") != std::string::npos);
  CHECK(run_program("explore response data/set2.toml --from 1 --to 60 --restart " + file)
            .status == 2);
}

TEST_CASE("explore response: a branch beside the followed one is reported and printed")
{
  const Outcome outcome =
      run_program("explore response data/set2.toml --from 1 --to 60 --isolated 10");
  REQUIRE(outcome.status == 0);
  CHECK(outcome.err.empty());
  CHECK(outcome.out.find("# branch 2: off the branches before it") != std::string::npos);
  CHECK(outcome.out.find("the branch is closed") != std::string::npos);
  const Tsv table = parse_tsv(outcome.out);
  const auto number = table.column("branch");
  CHECK(number.front() == 1);
  CHECK(number.back() == 2);
  /** It begins and ends at the same point, and that is no row of the first branch. */
  const auto first = static_cast<std::size_t>(std::find(number.begin(), number.end(), 2) -
                                              number.begin());
  CHECK(row_difference(table, first, table, number.size() - 1) < 1e-12);
  for (std::size_t k = 0; k < first; ++k)
    CHECK(row_difference(table, first, table, k) > 1e-6);
}
