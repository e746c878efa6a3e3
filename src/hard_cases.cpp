/**
# Hard cases: what each method does where it may fail

Run: build/hard_cases > data/generated/hard_cases.tsv
Each case ends in one of two ways: a solution that an independent check confirms, or a refusal with its
reason. A wrong answer that claims success is the only failure. Modelled: all cases of
data/scenes/hard_cases.toml by harmonic balance (the paper's predictor, arc length), shooting and
RK4. */
#include <CLI/CLI.hpp>

#include "output/hard_table.hpp"
#include "output/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  std::string list = "data/scenes/hard_cases.toml";
  int every = 1;
  CLI::App app("Puts every hard case to every method; TSV on stdout.");
  app.add_option("list", list, "the cases")->capture_default_str();
  app.add_option("--every", every, "only each n-th of the rows")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  return guarded([&] {
    if (!parse(app, argc, argv)) return 0;
    write(hard_table(list, every).text());
    return 0;
  });
}
