/** The hard cases: the check of the study finds wrong answers, and explore ends on every case. The
   study's table is tested in hard_cases.py. */
#include <algorithm>
#include <set>

#include "balance/torus_line.hpp"
#include "hard/verification.hpp"
#include "io/errors.hpp"
#include "io/table.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"

using namespace rotor_stator;
using namespace rotor_stator::hard;
using namespace rotor_stator::motion;
using namespace rotor_stator::tests;

namespace {

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

/** A table of finite numbers, which NumberTable reads, or one line that says why there is none. */
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
  const Scratch scratch;
  CHECK(NumberTable(scratch.write("orbit.tsv", outcome.out)).rows() > 0);
}

}  // namespace

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
    const Answer answer = answer_by(method, *found, hard.rule);
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
    /** With two frequencies the harmonics are chosen. */
    const bool are_chosen = turns_to_repeat(hard.machine.bearing) == 0;
    check_end(
        hard,
        run_program(orbit + (are_chosen ? std::string(" --method aft --tolerance 1e-3")
                                        : format(" --harmonics %d --samples %d",
                                                 hard.harmonics, hard.samples))));
    if (asked.insert(machine + options).second)
      check_end(hard, run_program(orbit + " --method rk4"));
  }
}
