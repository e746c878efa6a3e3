/**
# explore: one's own machine

Run: build/explore orbit data/set1.toml --frequency 45 > orbit.tsv
     build/explore orbit data/set1.toml --frequency 45 --tolerance 1e-4 > orbit.tsv
     build/explore contact data/set1.toml --frequency 45 --method rk8pd > contact.tsv
     build/explore response data/set1.toml --from 1 --to 60 --harmonics 10 > response.tsv

The general program for follow-up studies: any parameter file, any speed, harmonic balance
or one of the time integrators. A table on stdout, errors on stderr. */
#include <CLI/CLI.hpp>
#include <cstdio>

#include "explore/tables.hpp"
#include "io/errors.hpp"
#include "io/program.hpp"

namespace
{

using namespace rotor_stator;
using namespace rotor_stator::explore;

void add_budget_option(CLI::App& command, std::optional<double>& budget)
{
  command.add_option(
      "--budget", budget,
      "evaluations of the force at most, all else charged in as many as take "
      "its time (default: 3 s, with --stability 30 s; 16 balls: 8e7 in 3 s)");
}

/** Options that orbit and contact share. */
void add_motion_options(CLI::App& command, MotionRequest& request)
{
  command.add_option("parameters", request.parameter_file, "TOML parameter file")
      ->required();
  command.add_option("--frequency", request.frequency, "speed of rotation [Hz]")
      ->required();
  command.add_option("--method", request.method, "aft, rk4, rkf45, rk8pd, …")
      ->capture_default_str();
  command.add_option("--harmonics", request.harmonics,
                     "m of harmonic balance (default: 6, or by --tolerance)");
  command.add_option("--samples", request.samples,
                     "N per period (default: 8m+1 rounded up)");
  command.add_option("--tolerance", request.tolerance,
                     "relative error of displacement; without --harmonics, m is chosen");
  command.add_option("--points", request.points, "P, rows per period")
      ->capture_default_str();
  command
      .add_option("--newton-tolerance", request.newton_tolerance,
                  "relative tolerance of Newton")
      ->capture_default_str();
  command
      .add_option("--local-error", request.local_error,
                  "relative, per step, of GSL's methods")
      ->capture_default_str();
  command.add_option("--step", request.step,
                     "longest step of rk4 [s] (default: from K_H)");
  command.add_option("--longest", request.longest, "longest transient [s]")
      ->capture_default_str();
  command.add_flag("!--no-stability", request.stability,
                   "leave out the Floquet multipliers of aft");
  add_budget_option(command, request.budget);
}

void add_response_options(CLI::App& command, ResponseRequest& request)
{
  command.add_option("parameters", request.parameter_file, "TOML parameter file")
      ->required();
  command.add_option("--from", request.from, "first speed [Hz]")->required();
  command.add_option("--to", request.to, "last speed [Hz]")->required();
  command.add_option("--harmonics", request.harmonics,
                     "m of harmonic balance (default: 6, or the saved branch's)");
  command.add_option("--samples", request.samples,
                     "N per period (default: 8m+1 rounded up)");
  command
      .add_option("--newton-tolerance", request.newton_tolerance,
                  "relative tolerance of Newton")
      ->capture_default_str();
  command.add_option("--direction", request.direction,
                     "up: from --from to --to; down: from --to to --from");
  add_budget_option(command, request.budget);
  command.add_option("--save", request.save, "file for the branch, all coefficients");
  command.add_option("--restart", request.restart, "file of --save to go on from");
  command.add_option("--at", request.at,
                     "restart near this speed [Hz] (default: the end)");
  command.add_option("--branch", request.branch, "number of the branch to restart")
      ->capture_default_str();
  command.add_option("--isolated", request.isolated,
                     "look for isolated branches at so many speeds");
  command.add_flag("--stability", request.stability,
                   "Floquet multipliers of each point, and the bifurcations between");
  command.add_option("--seed", request.seed, "of the random starts of --isolated")
      ->capture_default_str();
}

int finish(const Exploration& exploration)
{
  write(exploration.table.text());
  if (!exploration.unfinished.empty()) throw NoSolution(exploration.unfinished);
  return 0;
}

}  // namespace

int main(int argc, char** argv)
{
  CLI::App app("Explores a rotor and a stator joined by a ball bearing; TSV on stdout.");
  app.require_subcommand(1);
  MotionRequest motion;
  ResponseRequest response;
  CLI::App* orbit =
      app.add_subcommand("orbit", "displacements and force over one period");
  CLI::App* contact =
      app.add_subcommand("contact", "force of every ball over two periods");
  CLI::App* branch =
      app.add_subcommand("response", "amplitudes along the branch, arc length");
  add_motion_options(*orbit, motion);
  add_motion_options(*contact, motion);
  add_response_options(*branch, response);
  return guarded([&] {
    if (!parse(app, argc, argv)) return 0;
    if (orbit->parsed()) return finish(explore_orbit(motion));
    if (contact->parsed()) return finish(explore_contact(motion));
    return finish(explore_response(response));
  });
}
