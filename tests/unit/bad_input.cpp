/** Every kind of bad input ends with status 2, one line on stderr that says what is
   wrong, and nothing on stdout; no solution ends with status 3 in the same way. */
#include <algorithm>
#include "support/catch.hpp"

#include "support/command.hpp"
#include "support/tsv.hpp"

using namespace rotor_stator::tests;

namespace
{

const std::string good = R"(title = "good"
[stator]
mass_kg = 20.0
natural_frequency_rad_per_s = 500.0
damping_ratio = 0.05
[rotor]
mass_kg = 40.0
natural_frequency_rad_per_s = 150.0
damping_ratio = 0.02
unbalance_kg_m = 0.05
[bearing]
balls = 16
contact_stiffness_N_per_m1p5 = 1e11
radial_clearance_m = 2e-5
cage_speed_ratio = 0.5
[gravity]
acceleration_m_per_s2 = 9.81
)";

/** The good file with one piece of text replaced. */
std::string with(const std::string& from, const std::string& to)
{
  std::string content = good;
  const auto at = content.find(from);
  REQUIRE(at != std::string::npos);
  return content.replace(at, from.size(), to);
}

void check_refused(const Outcome& outcome, int status, const std::string& mentions)
{
  INFO(outcome.err);
  CHECK(outcome.status == status);
  CHECK(outcome.out.empty());
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
  CHECK(outcome.err.find(mentions) != std::string::npos);
}

Outcome explore_file(const std::string& content)
{
  const Scratch scratch;
  return run_program("explore orbit " + scratch.write("machine.toml", content) +
                     " --frequency 30 --points 4");
}

Outcome explore_set_1(const std::string& options)
{
  return run_program("explore " + options);
}

}  // namespace

TEST_CASE("The unchanged parameter file is accepted")
{
  const Outcome outcome = explore_file(good);
  CHECK(outcome.status == 0);
  CHECK(outcome.err.empty());
  CHECK(parse_tsv(outcome.out).rows.size() == 4);
}

TEST_CASE("Bad parameter files are refused with file, line and key")
{
  struct Case {
    std::string from, to, mentions;
  };
  const Case cases[] = {
      {"mass_kg = 20.0", "mass_kg = 0.0", ":3: stator.mass_kg must be > 0"},
      {"mass_kg = 20.0", "mass_kg = -1", "stator.mass_kg"},
      {"mass_kg = 20.0", "mass_kg = nan", "stator.mass_kg must be finite"},
      {"mass_kg = 20.0", "mass_kg = inf", "stator.mass_kg must be finite"},
      {"mass_kg = 20.0", "mass_kg = \"heavy\"", "stator.mass_kg must be a number"},
      {"mass_kg = 20.0", "mass = 20.0", "stator.mass_kg is missing"},
      {"mass_kg = 20.0", "mass_kg = 20.0\ncolour = 1",
       ":4: stator.colour is not a known key"},
      {"natural_frequency_rad_per_s = 500.0", "natural_frequency_rad_per_s = 0",
       "natural_frequency_rad_per_s must be > 0"},
      {"damping_ratio = 0.05", "damping_ratio = -0.1", "damping_ratio must be >= 0"},
      {"unbalance_kg_m = 0.05", "unbalance_kg_m = -1", "rotor.unbalance_kg_m"},
      {"balls = 16", "balls = 0", "bearing.balls must be in 1...1024"},
      {"balls = 16", "balls = 1025", "bearing.balls must be in 1...1024"},
      {"balls = 16", "balls = 16.5", "bearing.balls must be a whole number"},
      {"contact_stiffness_N_per_m1p5 = 1e11", "contact_stiffness_N_per_m1p5 = 0",
       "contact_stiffness_N_per_m1p5 must be > 0"},
      {"radial_clearance_m = 2e-5", "radial_clearance_m = -1e-9", "radial_clearance_m"},
      {"cage_speed_ratio = 0.5", "cage_speed_ratio = 0.6", "0 < c <= 0.5"},
      {"cage_speed_ratio = 0.5", "cage_speed_ratio = 0.0", "cage_speed_ratio"},
      {"cage_speed_ratio = 0.5", "", "cage_speed_ratio is missing"},
      {"cage_speed_ratio = 0.5",
       "cage_speed_ratio = 0.5\nball_radius_m = 0.01\ninner_race_radius_m = 0.07",
       "both given"},
      {"cage_speed_ratio = 0.5", "ball_radius_m = 0.01",
       "inner_race_radius_m is missing"},
      {"cage_speed_ratio = 0.5", "ball_radius_m = 0.03\ninner_race_radius_m = 0.07",
       "overlap"},
      {"[gravity]", "[wind]", "gravity is missing"},
      {"acceleration_m_per_s2 = 9.81", "acceleration_m_per_s2 = -9.81",
       "gravity.acceleration"},
      {"title = \"good\"", "title = 3", "title must be a string"},
      {"title = \"good\"", "title = \"two\\nlines\"", "title must be one line"},
      {"[stator]", "stator = 1\n[other]", "stator must be a table"},
      {"[stator]", "[stator", "not TOML"},
  };
  for (const Case& c : cases) {
    INFO(c.from << " -> " << c.to);
    check_refused(explore_file(with(c.from, c.to)), 2, c.mentions);
  }
}

TEST_CASE("Files that are no parameter files are refused")
{
  check_refused(explore_file(""), 2, "is empty");
  check_refused(explore_file("just some words"), 2, "not TOML");
  check_refused(explore_set_1("orbit no/such/file.toml --frequency 30"), 2,
                "no such file");
  check_refused(explore_set_1("orbit data --frequency 30"), 2, "is a directory");
}

TEST_CASE("Bad options are refused with what would be accepted")
{
  const std::string orbit = "orbit data/set1.toml ",
                    response = "response data/set1.toml ";
  struct Case {
    std::string options, mentions;
  };
  const Case cases[] = {
      {orbit + "--frequency 0", "--frequency"},
      {orbit + "--frequency -3", "--frequency"},
      {orbit + "--frequency nan", "--frequency"},
      {orbit + "--frequency inf", "--frequency"},
      {orbit + "--frequency fast", "--frequency"},
      {orbit, "--frequency"},
      {orbit + "--frequency 30 --harmonics 0", "--harmonics 0: must be in 1...4096"},
      {orbit + "--frequency 30 --harmonics 4097", "1...4096"},
      {orbit + "--frequency 30 --harmonics 10 --samples 20",
       "--samples 20: must be in 21"},
      {orbit + "--frequency 30 --method euler", "rk8pd"},
      {orbit + "--frequency 30 --points 0", "--points"},
      {orbit + "--frequency 30 --colour red", "--colour"},
      {orbit + "--frequency 30 --tolerance 0", "--tolerance"},
      {orbit + "--frequency 30 --tolerance 1e6", "must be in 1e-08...0.1"},
      {orbit + "--frequency 30 --tolerance nan", "--tolerance nan"},
      {orbit + "--frequency 30 --tolerance 1e-4 --samples 64", "--harmonics"},
      {orbit + "--frequency 30 --tolerance 1e-4 --method rk4", "--tolerance: is for"},
      {orbit + "--frequency 30 --newton-tolerance 0", "--newton-tolerance"},
      {orbit + "--frequency 30 --newton-tolerance 1e6", "must be in 1e-15...0.001"},
      {response + "--from 1 --to 10 --newton-tolerance 1", "--newton-tolerance 1"},
      {orbit + "--frequency 30 --method rk8pd --local-error 1e10", "--local-error"},
      {orbit + "--frequency 30 --method rk4 --step 0", "--step"},
      {response + "--from 10 --to 10", "--from 10: must be below --to 10"},
      {response + "--from 20 --to 10", "--from"},
      {response + "--from 0 --to 10", "--from"},
      {response + "--from 1 --to inf", "--to"},
      {response + "--from 1 --to 2 --direction left", "must be up or down"},
      {response + "--from 1 --to 2 --budget 0", "--budget 0: must be in 1"},
      {response + "--from 1 --to 2 --isolated -1", "--isolated -1: must be in 0"},
      {response + "--from 1 --to 2 --at 1.5", "--at requires --restart"},
      {response + "--from 1 --to 2 --save no/such/folder/file", "folder does not exist"},
      {response + "--from 1 --to 2 --save data", "is a directory"},
      {response + "--from 1 --to 2 --restart no/such/file", "no such file"},
      {response + "--from 1 --to 2 --restart data", "is a directory"},
      {response + "--from 1 --to 2 --restart /dev/zero", "is no regular file"},
      {response + "--from 1 --to 2 --restart " + std::string(300, 'x'), "no such file"},
      {response + "--from 1 --to 2 --restart data/set1.toml", "set1.toml:1: '# format"},
      {"", "subcommand"},
      {"dance", "subcommand"},
  };
  for (const Case& c : cases) {
    INFO(c.options);
    check_refused(explore_set_1(c.options), 2, c.mentions);
  }
}

TEST_CASE("Figure programs refuse bad scenes and readings")
{
  check_refused(run_program("fig05_displacements no/such/scene.toml"), 2, "no such file");
  check_refused(
      run_program(
          "fig05_displacements data/scenes/fig05_displacements.toml --reading upside-down"),
      2, "must be exchanged or as-printed");
  check_refused(run_program("fig05_displacements data/scenes/tab01_parameters.toml"), 2,
                "title is missing");
}

TEST_CASE("What has no solution ends with status 3 and the reason")
{
  check_refused(explore_file(with("cage_speed_ratio = 0.5", "cage_speed_ratio = 0.4321")),
                3, "not a whole number");
  check_refused(explore_set_1("orbit data/set2.toml --frequency 13.4 --harmonics 24"), 3,
                "no solution found with 24 harmonics at 13.4 Hz");
}

TEST_CASE("Zero is legal for clearance, gravity, unbalance and damping")
{
  for (const auto& [from, to] :
       {std::pair{"radial_clearance_m = 2e-5", "radial_clearance_m = 0"},
        std::pair{"acceleration_m_per_s2 = 9.81", "acceleration_m_per_s2 = 0.0"},
        std::pair{"unbalance_kg_m = 0.05", "unbalance_kg_m = 0"},
        std::pair{"damping_ratio = 0.05", "damping_ratio = 0"}}) {
    INFO(to);
    CHECK(explore_file(with(from, to)).status == 0);
  }
}
