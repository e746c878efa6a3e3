/** The hard cases: every method ends with a confirmed answer or with a reason, and never with a wrong
   answer that claims success. The verdicts are formed here anew from the numbers of the table. */
#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "hard/verification.hpp"
#include "io/errors.hpp"
#include "support/command.hpp"
#include "support/tsv.hpp"

using namespace rotor_stator;
using namespace rotor_stator::hard;
using namespace rotor_stator::motion;
using namespace rotor_stator::tests;

namespace
{

#ifdef __SANITIZE_ADDRESS__
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

const std::string list = SOURCE_DIR "/data/scenes/hard_cases.toml";

HardCases listed()
{
  SceneFile file(list, "exchanged");
  return read_hard_cases(file);
}

/** One row, by name. */
struct Line {
  const Tsv& table;
  std::size_t row;

  std::string word(const std::string& name) const
  {
    return table.rows[row][table.index(name)];
  }
  double number(const std::string& name) const { return table.number(row, name); }
};

/** The verdict that the rule of the list gives the numbers of a row. */
std::string verdict(const Line& line, const HardRule& rule)
{
  if (line.number("status") == 3) return "refused";
  const double error = line.number("check_error");
  if (line.word("check") == "none" || error < 0) return "unconfirmed";
  if (line.word("regime") == "aperiodic")
    return error <= rule.most_change ? "solved" : "silent error";
  const double multiplier = line.number("check_multiplier");
  if (multiplier >= 0 && ((line.word("stability") == "stable" && multiplier > 1.001) ||
                          (line.word("stability") == "unstable" && multiplier < 0.999)))
    return "silent error";
  const double stated = std::max(line.number("stated_error"), rule.least_error);
  return error <= std::min(rule.most_error, rule.most_error_ratio * stated)
             ? "solved"
             : "silent error";
}

void check_refusal(const Line& line)
{
  CHECK(line.word("note").size() > 10);
  CHECK(line.number("residual") == -1);
  CHECK(line.number("check_error") == -1);
}

void check_claim(const Line& line, const HardRule& rule)
{
  CHECK(line.number("residual") >= 0);
  CHECK(line.number("stated_error") >= 0);
  if (line.word("regime") == "T-periodic") {
    CHECK(line.number("stated_error") <= rule.accuracy);
    CHECK(line.number("multiplier") >= 0);
  }
}

std::string machine_file(const Parameters& p)
{
  const auto body = [](const char* name, const Body& b) {
    return format(
        "[%s]\nmass_kg = %.17e\nnatural_frequency_rad_per_s = %.17e\n"
        "damping_ratio = %.17e\n",
        name, b.mass, b.natural_frequency, b.damping_ratio);
  };
  return "title = \"hard\"\n" + body("stator", p.stator) + body("rotor", p.rotor) +
         format("unbalance_kg_m = %.17e\n[bearing]\nballs = %d\n", p.unbalance,
                p.bearing.balls) +
         format("contact_stiffness_N_per_m1p5 = %.17e\nradial_clearance_m = %.17e\n",
                p.bearing.contact_stiffness, p.bearing.clearance) +
         format("cage_speed_ratio = %.17e\n[gravity]\nacceleration_m_per_s2 = %.17e\n",
                p.bearing.cage_speed_ratio, p.gravity);
}

/** A table of finite numbers, or one line that says why there is none. */
void check_end(const HardCase& hard, const Outcome& outcome)
{
  INFO(hard.name << ": " << outcome.err);
  if (outcome.status == 3) {
    CHECK(outcome.out.empty());
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    return;
  }
  CHECK(outcome.status == 0);
  CHECK(outcome.err.empty());
  const Tsv table = parse_tsv(outcome.out);
  CHECK(table.rows.size() > 0);
  for (const std::string& name : table.names)
    for (double value : table.column(name)) CHECK(std::isfinite(value));
}

}  // namespace

TEST_CASE("Hard cases end with a confirmed answer or a reason")
{
  const HardRule rule = listed().rule;
  const Outcome outcome = run_program(sanitized ? "hard_cases --every 37" : "hard_cases");
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  const Tsv table = parse_tsv(outcome.out);
  std::set<std::string> cases;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const Line line{table, row};
    INFO(line.word("case") << ", " << line.word("method") << ": " << line.word("note")
                           << ", check by " << line.word("check"));
    cases.insert(line.word("case"));
    CHECK(line.word("verdict") == verdict(line, rule));
    CHECK((line.word("verdict") == "solved" || line.word("verdict") == "refused"));
    if (line.number("status") == 3)
      check_refusal(line);
    else
      check_claim(line, rule);
  }
  if (!sanitized) CHECK(cases.size() >= 60);
  if (!sanitized) CHECK(table.rows.size() == 4 * cases.size());
}

TEST_CASE("The check finds a wrong answer that claims success")
{
  const HardCases hard = listed();
  const auto named = [](const HardCase& h) {
    return h.name == "balls of finite size, 30 Hz";
  };
  const auto found = std::find_if(hard.cases.begin(), hard.cases.end(), named);
  REQUIRE(found != hard.cases.end());
  for (const Method& method : methods) {
    if (method.name == "aft arc length") continue;
    INFO(method.name);
    const Answer answer = method.answer(*found, hard.rule);
    CHECK(verify(*found, method, answer, hard.rule).verdict == "solved");
    Answer wrong = answer;
    for (Bodies& q : wrong.motion.positions) q.rotor.x *= 1.02;
    CHECK(verify(*found, method, wrong, hard.rule).verdict == "silent error");
    wrong = answer;
    wrong.periodic = false;
    if (method.name == "rk4")
      CHECK(verify(*found, method, wrong, hard.rule).verdict == "silent error");
  }
}

TEST_CASE("explore ends on every hard case, with an answer or a reason")
{
  const Scratch scratch;
  const auto cases = listed().cases;
  std::set<std::string> asked;
  for (std::size_t k = 0; k < cases.size(); k += sanitized ? 11 : 1) {
    const HardCase& hard = cases[k];
    const std::string machine = machine_file(hard.machine),
                      options = format(" --frequency %.17e", hard.frequency) +
                                (sanitized ? " --budget 3e6" : "");
    const std::string orbit =
        "explore orbit " + scratch.write("machine.toml", machine) + options;
    check_end(hard, run_program(orbit + format(" --harmonics %d --samples %d",
                                               hard.harmonics, hard.samples)));
    if (asked.insert(machine + options).second)
      check_end(hard, run_program(orbit + " --method rk4"));
  }
}
