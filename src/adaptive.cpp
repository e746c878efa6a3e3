/**
# Adaptive harmonics: what the error estimate is worth

Beside the paper: §3.3 asks how many harmonics are enough.  Run: make adaptive
Estimate against true error, and cost against the best fixed number of harmonics, at the speeds of both
data sets where the motion is T-periodic. Modelled: harmonic balance, and shooting for the exact
motion. Finished speeds are kept in a journal. */
#include <CLI/CLI.hpp>

#include "output/adaptive_table.hpp"
#include "output/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  std::string scene = "data/scenes/adaptive.toml", journal = "adaptive.journal";
  CLI::App app("Estimates and true errors of adaptive harmonics; TSV on stdout.");
  app.add_option("scene", scene, "scene file")->capture_default_str();
  app.add_option("--journal", journal, "finished speeds")->capture_default_str();
  return guarded([&] {
    if (!parse(app, argc, argv)) return 0;
    write(adaptive_table(scene, journal).text());
    return 0;
  });
}
