/** Random input to explore, seeded: 6000 runs of the program. Whatever it is asked, explore ends by itself
   within 5 s of processor time, with status 0, 2 or 3 and the output that belongs to it, and prints
   no number that is not finite. The seed of a failing case is in the message, and its file is kept in
   the build folder under fuzz/. FUZZ_SEED and FUZZ_CASES in the environment give other cases. */
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "hard/fuzz_cases.hpp"
#include "hard/outcome.hpp"
#include "support/command.hpp"
#include "support/limited_run.hpp"

using namespace rotor_stator::tests;

namespace
{

long from_environment(const char* name, long otherwise)
{
  const char* value = std::getenv(name);
  return value ? std::atol(value) : otherwise;
}

void keep(const FuzzCase& failing, std::uint64_t seed)
{
  const std::string folder = PROGRAM_DIR "/fuzz/";
  std::filesystem::create_directories(folder);
  const std::string name = folder + std::to_string(seed);
  std::ofstream(name + ".toml", std::ios::binary) << failing.file;
  std::ofstream(name + ".command", std::ios::binary) << failing.command() << "\n";
}

/** How often each status came. */
struct Tally {
  long done = 0, bad_input = 0, no_solution = 0;
};

/** Runs a case and checks how it ended. */
int status_of(Fuzz kind, std::uint64_t seed, const std::string& work,
              const Scratch& scratch)
{
  const FuzzCase made = fuzz_case(seed, kind, work);
  std::ofstream(scratch.path("machine.toml"), std::ios::binary) << made.file;
  const auto outcome = run_limited(made.arguments, scratch.path(""), cpu_seconds);
  const std::string wrong = problem(outcome);
  if (!wrong.empty()) keep(made, seed);
  INFO("seed " << seed << ": " << made.command() << "\n" << outcome.err.substr(0, 2000));
  CHECK(wrong == "");
  return outcome.status;
}

Tally run_cases(Fuzz kind, std::uint64_t first_seed, long cases, const std::string& work)
{
  const Scratch scratch;
  const auto seed_0 = static_cast<std::uint64_t>(
      from_environment("FUZZ_SEED", static_cast<long>(first_seed)));
  Tally tally;
  for (std::uint64_t seed = seed_0; seed < seed_0 + cases; ++seed) {
    const int status = status_of(kind, seed, work, scratch);
    tally.done += status == 0;
    tally.bad_input += status == 2;
    tally.no_solution += status == 3;
  }
  WARN(cases << " cases from seed " << seed_0 << ": " << tally.done << " done, "
             << tally.bad_input << " bad input, " << tally.no_solution << " no solution");
  return tally;
}

long cases(long usual)
{
  return from_environment("FUZZ_CASES", usual);
}

}  // namespace

TEST_CASE("Spoilt parameter files")
{
  const Tally tally = run_cases(Fuzz::file, 1'000'000, cases(3000), "3e5");
  CHECK(tally.bad_input > tally.done);
}

TEST_CASE("Spoilt options")
{
  const Tally tally = run_cases(Fuzz::options, 2'000'000, cases(2000), "3e5");
  CHECK(tally.bad_input > tally.done);
}

TEST_CASE("Legal and extreme machines and options")
{
  const Tally tally = run_cases(Fuzz::extreme, 3'000'000, cases(1000), "3e5");
  CHECK(tally.done + tally.no_solution > tally.bad_input);
}

TEST_CASE("Legal and extreme machines with the work that explore allows by itself")
{
  run_cases(Fuzz::extreme, 4'000'000, cases(sanitized ? 20 : 40), sanitized ? "3e6" : "");
}

TEST_CASE("Machines whose work was once counted too cheap")
{
  /** In order: integrations that break down; a large dense block; two branches along one speed, whose
      every step met all earlier ones; a thousand balls in contact; N with a large prime factor. */
  const Scratch scratch;
  for (std::uint64_t seed :
       {4000011, 4000298, 4000434, 4000497, 4000329, 4000991, 4001380})
    status_of(Fuzz::extreme, seed, sanitized ? "3e6" : "", scratch);
}
