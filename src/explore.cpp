/**
# explore: one's own machine

    build/explore check data/set1.toml
    build/explore orbit data/set1.toml --frequency 45 --harmonics 10 > orbit.tsv
    build/explore contact data/set1.toml --frequency 45 --method rk8pd > contact.tsv
    build/explore spectrum data/set1.toml --frequency 45 --harmonics 24 > spectrum.tsv
    build/explore response data/set1.toml --from 1 --to 60 --harmonics 10 > response.tsv
    build/explore attractors data/set1.toml --from 18 --to 22 --count 17 > attractors.tsv
    build/explore map data/set1.toml --x frequency=10:50:41 \
      --y bearing.radial_clearance_m=0:1e-4:21 --quantity amplitude --harmonics 6 > map.tsv
    build/explore shaft data/rotors/overhung_shaft.toml --to overhung > nodes.tsv
    build/explore shape data/rotors/overhung.toml --frequency 30 --harmonics 6 \
      --nodes nodes.tsv > shape.tsv

The general program for follow-up studies: any parameter file, any speed, harmonic balance
or one of the time integrators. A table on stdout, errors on stderr. */
#include <CLI/CLI.hpp>

#include "explore/attractors.hpp"
#include "explore/campbell.hpp"
#include "explore/check.hpp"
#include "explore/map.hpp"
#include "explore/orbit.hpp"
#include "explore/plot.hpp"
#include "explore/response.hpp"
#include "explore/shaft.hpp"
#include "explore/shape.hpp"
#include "explore/spectrum.hpp"
#include "io/errors.hpp"
#include "io/program.hpp"
#include "time/time_stepper.hpp"

namespace {

using namespace rotor_stator;
using namespace rotor_stator::explore;

/** An option with a number in decimal notation, in its range; the help shows its default. */
template <class Number, class Bound>
CLI::Option* add_number(CLI::App& command, const std::string& name, Number& value,
                        Bound least, Bound most, const std::string& meaning)
{
  CLI::Option* option = command.add_option_function<std::string>(
      name,
      [&value, name, least, most](const std::string& word) {
        if constexpr (std::is_same_v<Bound, int>)
          value = whole_number(name, word, least, most);
        else
          value = real_number(name, word, least, most);
      },
      meaning);
  option->type_name(std::is_same_v<Bound, int> ? "WHOLE" : "NUMBER");
  if constexpr (std::is_arithmetic_v<Number>)
    if (value != 0) option->default_str(format("%g", static_cast<double>(value)));
  return option;
}

constexpr int largest_seed = 1000000000, most_samples = 1 << 20, most_points = 1 << 16;
constexpr double largest = 1e300;  // 2 pi times as much is still a number

/** The machine, and how the table is written. */
void add_table_options(CLI::App& command, Request& request)
{
  command.add_option("parameters", request.parameter_file, "TOML parameter file")
      ->required();
  if (command.get_name() == "map") return;  // its quantities are chosen
  command.add_option("--columns", request.columns,
                     "NAME,... that are printed, or all; others are not computed");
  command.add_option_function<std::string>(
      "--format",
      [&request](const std::string& word) {
        if (word != "tsv" && word != "csv" && word != "json")
          throw BadInput("--format " + word + ": must be one of tsv, csv, json");
        request.format = word == "csv"    ? TableFormat::csv
                         : word == "json" ? TableFormat::json
                                          : TableFormat::tsv;
      },
      "tsv, csv (without the # lines) or json");
}

/** The same, what a run may cost and its figure. */
void add_common_options(CLI::App& command, Request& request,
                        const std::string& usual_budget)
{
  add_table_options(command, request);
  command.add_flag("--quiet", request.quiet,
                   "no progress on stderr, which a terminal gets after two seconds");
  command.add_option("--plot", request.plot, "figure: .svg, .png or .pdf");
  add_number(command, "--budget", request.budget, 1.0, 1e15,
             "most evaluations of the force in the whole run, other work counted as the "
             "evaluations that take as long (default: those of " +
                 usual_budget + ")");
}

/** Those of the commands that know harmonic balance; its own are returned. `or_m`: what may stand for the
    default m. */
std::vector<CLI::Option*> add_balance_options(CLI::App& command, Request& request,
                                              const std::string& or_m)
{
  add_common_options(
      command, request,
      "3 s, 8.2e7 with 16 balls; of 60 s with --stability, of 30 s with --subharmonic in response");
  return {add_number(command, "--harmonics", request.harmonics, 1, 4096,
                     "m of harmonic balance (default: 6, or " + or_m + ")"),
          add_number(
              command, "--samples", request.samples, 3, most_samples,
              "N per period (default: the larger of 8m+1 and 2/3 m^(8/5), rounded up)"),
          add_number(command, "--newton-tolerance", request.newton_tolerance, 1e-15, 1e-3,
                     "relative tolerance of Newton")};
}

CLI::Option* add_subharmonic(CLI::App& command, Request& request)
{
  return add_number(command, "--subharmonic", request.subharmonic, 1, 8,
                    "K: motions of period K T, harmonics of orders h/K");
}

/** Throws BadInput for an option that was given and is not `used` by the method; `where` it is. */
void refuse(const CLI::Option* option, bool used, const char* where,
            const std::string& method)
{
  if (!used && option->count() > 0)
    throw BadInput(option->get_name() + ": is " + where + ", and --method is " + method);
}

/** The options of orbit, shape, contact and spectrum. What is returned throws BadInput for an option that the method
    would ignore. */
std::function<void()> add_motion_options(CLI::App& command, MotionRequest& request)
{
  std::string methods =
      "auto (what the machine does from rest; aft with --harmonics), aft (harmonic "
      "balance), shooting, gauss (of bodies given by matrices)";
  for (const std::string& name : time_methods()) methods += ", " + name;
  const bool is_spectrum = command.get_name() == "spectrum";
  auto aft = add_balance_options(
      command, request,
      is_spectrum ? "three times BPFO, or by --tolerance" : "by --tolerance");
  add_number(command, "--frequency", request.frequency, 0.0, largest,
             "speed of rotation [Hz]")
      ->required();
  command.add_option("--method", request.method, methods)->capture_default_str();
  const auto points =
      add_number(command, "--points", request.points, is_spectrum ? 32 : 1, most_points,
                 is_spectrum ? "P, samples per period of shooting and the time methods"
                             : "P, rows per period");
  std::vector<CLI::Option*> periodic;
  add_number(
      command, "--tolerance", request.tolerance, 1e-8, 0.1,
      "relative error of displacement, the largest and the rms about the mean; with "
      "--method aft and without --harmonics, m is chosen");
  aft.push_back(
      add_number(command, "--lines", request.lines, 1, 1024,
                 "with two frequencies: the M largest lines of the motion from rest"));
  if (command.get_name() != "contact")
    periodic.push_back(add_subharmonic(command, request));
  if (is_spectrum)
    command.add_option("--overlay", request.overlay,
                       "table of a measured spectrum for --plot: f [Hz], amplitude [m]");
  if (command.get_name() == "orbit" || command.get_name() == "shape")
    add_number(command, "--periods", request.periods, 1, 1000, "turns that are printed");
  command.add_flag("!--no-stability", request.stability,
                   "leave out stability and, of a motion in time, the error");
  const auto step = add_number(command, "--step", request.step, 0.0, largest,
                               "longest step of rk4 [s] (default: from K_H)");
  const auto local_error =
      add_number(command, "--local-error", request.local_error, 1e-15, 1e-2,
                 "relative, per step, of shooting and the time methods but rk4");
  const auto longest = add_number(command, "--longest", request.longest, 1e-3, 1e5,
                                  "longest transient of the time methods [s]");
  return [=, &request] {
    std::string& method = request.method;
    const bool asks_balance =
        std::ranges::any_of(aft, [](const auto* option) { return option->count() > 0; });
    if (method == "auto" && asks_balance) method = "aft";
    auto others = periodic_methods;
    others.insert(others.end(), {"auto", "gauss"});
    require_method(method, others);
    const bool is_balance = method == "aft", is_auto = method == "auto";
    for (const CLI::Option* option : aft)
      refuse(option, is_balance, "for --method aft", method);
    for (const CLI::Option* option : periodic)
      refuse(option, is_periodic(method), "for the methods aft and shooting", method);
    refuse(step, method == "rk4" || is_auto, "for --method rk4", method);
    refuse(local_error, !is_balance && method != "rk4",
           "for shooting and the time methods but rk4", method);
    refuse(longest, !is_periodic(method), "for the time methods", method);
    refuse(points, !is_spectrum || !is_balance, "for shooting and the time methods",
           method);
  };
}

template <class Ranged>
void add_range_options(CLI::App& command, Ranged& request)
{
  add_number(command, "--from", request.from, 0.0, largest, "first speed [Hz]")
      ->required();
  add_number(command, "--to", request.to, 0.0, largest, "last speed [Hz]")->required();
}

/** What is returned throws BadInput for an option that the method would ignore. */
std::function<void()> add_response_options(CLI::App& command, ResponseRequest& request)
{
  const auto balance = add_balance_options(command, request, "the saved branch's");
  std::vector<CLI::Option*> aft = balance, branch;
  command
      .add_option("--method", request.method,
                  "auto (what the machine does, speed by speed), or a branch of periodic "
                  "solutions: aft (harmonic balance), shooting (rk4)")
      ->capture_default_str();
  aft.push_back(add_subharmonic(command, request));
  CLI::Option* tolerance =
      add_number(command, "--tolerance", request.tolerance, 1e-8, 0.1,
                 "of --method aft: relative error of each solution, at evenly spaced "
                 "speeds instead of along the branch; with two frequencies, of the five "
                 "solutions that choose the harmonics");
  aft.push_back(tolerance);
  CLI::Option* count = add_number(command, "--count", request.count, 1, 100000,
                                  "speeds, evenly spaced (101; 21 of large bodies)");
  add_range_options(command, request);
  command.add_option("--direction", request.direction,
                     "rest: each speed from rest; up, down: from the motion or solution "
                     "at the speed before");
  branch.push_back(command.add_flag(
      "--stability", request.stability,
      "Floquet multipliers of each point and, with aft, the bifurcations between"));
  branch.push_back(command.add_option(
      "--harmonics-of", request.harmonics_of,
      "x_s, y_s, x_r or y_r: its harmonics at each point, complex amplitudes"));
  aft.push_back(command.add_option("--waterfall", request.waterfall,
                                   "file for the lines of each point, with their names"));
  aft.push_back(command.add_option("--save", request.save,
                                   "file for the branch, all coefficients"));
  CLI::Option* restart =
      command.add_option("--restart", request.restart, "file of --save to continue from");
  add_number(command, "--at", request.at, 0.0, largest,
             "restart near this speed [Hz] (default: the end)")
      ->needs(restart);
  add_number(command, "--branch", request.branch, 1, 1000000,
             "number of the branch to restart")
      ->needs(restart);
  CLI::Option* isolated = add_number(command, "--isolated", request.isolated, 0, 10000,
                                     "look for isolated branches at so many speeds");
  aft.push_back(command.add_flag("--times", request.times, "CPU time on stderr"));
  add_number(command, "--seed", request.seed, 0, largest_seed,
             "of the random starts of --isolated")
      ->needs(isolated);
  aft.push_back(isolated);
  CLI::Option* resume = command.add_option(
      "--resume", request.resume,
      "table of the same sweep that was interrupted: its rows are kept");
  CLI::Option* longest = add_number(command, "--longest", request.longest, 1e-3, 1e5,
                                    "longest transient of a sweep after t = 0 [s]");
  return [=, &request] {
    std::string& method = request.method;
    const auto is_given = [](const CLI::Option* option) { return option->count() > 0; };
    if (method == "auto" && (std::ranges::any_of(balance, is_given) || is_given(restart)))
      method = "aft";
    if (method != "auto" && method != "aft" && method != "shooting")
      throw BadInput("--method " + method + ": must be one of auto, aft, shooting");
    const bool is_sweep = method == "auto";
    for (const auto& list : {aft, branch})
      for (const CLI::Option* option : list)
        if (is_sweep && is_given(option))
          throw BadInput(option->get_name() +
                         (option == tolerance
                              ? ": is of solutions; give --method aft too"
                              : ": is of a branch of solutions; give --harmonics M, "
                                "--method shooting or --restart FILE too"));
    for (const CLI::Option* option : aft)
      refuse(option, method == "aft", "for --method aft", method);
    refuse(restart, method == "aft", "for --method aft", method);
    refuse(resume, is_sweep, "for a sweep, without --method", method);
    refuse(longest, is_sweep, "for a sweep, without --method", method);
    if (is_given(count) && !is_sweep && !is_given(tolerance))
      throw BadInput(
          "--count: of a branch needs --tolerance; without --harmonics and "
          "--method it is the number of speeds");
  };
}

void add_attractors_options(CLI::App& command, AttractorsRequest& request)
{
  add_common_options(command, request, "1 s for each start");
  add_range_options(command, request);
  add_number(command, "--count", request.count, 1, 10000,
             "speeds from --from to --to, evenly spaced")
      ->required();
  add_number(command, "--starts", request.starts, 0, 1000,
             "random states to start from at each speed");
  add_number(command, "--seed", request.seed, 0, largest_seed, "of the random states");
  command.add_option("--section", request.section,
                     "file for the points of the Poincare sections");
  command.add_option("--motions", request.motions,
                     "file for the motions themselves, with the bearing's force");
}

/** What is returned throws BadInput for an option that the method would ignore. */
std::function<void()> add_map_options(CLI::App& command, MapRequest& request)
{
  std::string known;
  for (const Column& one : map_quantities())
    known +=
        (known.empty() ? "" : "; ") + one.name + " [" + one.unit + "] " + one.meaning;
  std::string methods =
      "auto (what the machine does from rest; aft with --harmonics), aft (harmonic "
      "balance), gauss (of bodies given by matrices)";
  for (const std::string& name : time_methods()) methods += ", " + name;
  const auto aft = add_balance_options(command, request, "by --tolerance");
  command.get_option("--budget")
      ->description(
          "most evaluations of the force at each point (default: those of 5 s, 1.4e8 with 16 balls)");
  command.add_option(
      "--x", request.x,
      "KEY=from:to:count[:log]; KEY: frequency [Hz], or of the parameter file, "
      "as bearing.radial_clearance_m; the points of a line start from each other");
  command.add_option("--y", request.y, "the same, a line for each value");
  command.add_option("--list", request.list,
                     "table whose columns are keys, a line for each row, instead of --y");
  command.add_option("--quantity", request.quantities, known)->delimiter(',')->required();
  add_number(command, "--frequency", request.frequency, 0.0, largest,
             "speed of rotation [Hz], where it is no key");
  command.add_option(
      "--sweep", request.sweep,
      "A:B[:COUNT], range of speeds of the quantities over one [Hz] (101)");
  command.add_option("--method", request.method, methods)->capture_default_str();
  add_number(command, "--tolerance", request.tolerance, 1e-8, 0.1,
             "relative error; with --method aft m is chosen for it");
  const auto step = add_number(command, "--step", request.step, 0.0, largest,
                               "longest step of rk4 [s] (default: from K_H)");
  const auto longest =
      add_number(command, "--longest", request.longest, 1e-3, 1e5,
                 "longest transient of the time methods after t = 0 [s]");
  add_number(command, "--threads", request.threads, 1, 1024,
             "lines at a time (default: OMP_NUM_THREADS, or all cores)");
  command.add_option("--lines", request.lines, "A:B, only the lines with A <= index < B");
  command.add_option(
      "--resume", request.resume,
      "table of the same map that was interrupted: its whole lines are taken over");
  return [=, &request] {
    std::string& method = request.method;
    if (method == "auto" &&
        std::ranges::any_of(aft, [](const auto* option) { return option->count() > 0; }))
      method = "aft";
    require_method(method, {"auto", "aft", "gauss"});
    for (const CLI::Option* option : aft)
      refuse(option, method == "aft", "for --method aft", method);
    refuse(step, method == "rk4" || method == "auto", "for --method rk4", method);
    refuse(longest, method != "aft", "for the time methods", method);
  };
}

/** Computes, draws and prints. `files` are others that the command reads or writes. */
int finish(const Request& request, const std::string& script,
           const std::function<Exploration()>& explored,
           std::vector<std::optional<std::string>> files = {})
{
  files.insert(files.end(), {request.plot, request.overlay});
  std::ranges::sort(files);
  const auto same = std::ranges::adjacent_find(
      files, [](const auto& a, const auto& b) { return a && a == b; });
  if (same != files.end()) throw BadInput(**same + ": is the file of two options");
  if (request.plot) require_plot(*request.plot, script, {request.parameter_file});
  if (request.overlay && !request.plot) throw BadInput("--overlay: needs --plot");
  const Exploration found = explored();
  std::string undrawn;
  if (request.plot)
    undrawn =
        plot(*request.plot, script,
             found.drawn.empty() ? found.table.text(TableFormat::tsv, true) : found.drawn,
             request.overlay);
  if (!found.is_written) write(found.table.text(request.format));
  if (!found.unfinished.empty()) throw NoSolution(found.unfinished);
  if (!undrawn.empty()) throw NoSolution(undrawn);
  return 0;
}

}  // namespace

int main(int argc, char** argv)
{
  CLI::App app("Explores a rotor and a stator in a ball bearing; a table on stdout.");
  app.require_subcommand(1);
  const auto command = [&](const char* name, const char* meaning) {
    return app.add_subcommand(name, meaning);
  };
  MotionRequest motion;
  ResponseRequest response;
  AttractorsRequest attractors;
  CheckRequest checked;
  CLI::App* check = command("check", "what a machine is, before anything is computed");
  CLI::App* orbit = command("orbit", "displacements and force over one period");
  CLI::App* contact = command("contact", "force of every ball over two periods");
  CLI::App* branch =
      command("response", "amplitudes against speed: what the machine does, or a branch");
  CLI::App* lines =
      command("spectrum", "lines of the motion, with names such as BPFO-1X");
  CLI::App* settled =
      command("attractors", "what the machine settles on, speed by speed");
  add_table_options(*check, checked);
  add_number(*check, "--from", checked.from, 0.0, largest, "first speed [Hz]");
  add_number(*check, "--to", checked.to, 0.0, largest, "last speed [Hz]");
  CLI::App* map = command("map", "quantities over two keys of the parameter file");
  MapRequest mapped;
  CLI::App* beams = command("shaft", "matrices of a shaft of beam elements, in files");
  ShaftRequest shaft;
  CLI::App* deflected =
      command("shape", "orbits along a rotor given by matrices, at one speed");
  CLI::App* whirl =
      command("campbell", "whirl frequencies against speed, critical speeds");
  CampbellRequest campbell;
  add_table_options(*whirl, campbell);
  add_range_options(*whirl, campbell);
  add_number(*whirl, "--count", campbell.count, 2, 10000,
             "speeds from --from to --to, evenly spaced")
      ->required();
  add_number(*whirl, "--modes", campbell.modes, 1, 1000, "of lowest frequency");
  whirl->add_flag("--critical", campbell.critical,
                  "the critical speeds instead of the frequencies");
  whirl->add_option("--plot", campbell.plot, "file of the figure: .svg, .png or .pdf");
  add_table_options(*beams, shaft);
  beams->add_option("--to", shaft.folder, "folder for M.mtx, C.mtx, G.mtx and K.mtx")
      ->required();
  const auto refuse_of_map = add_map_options(*map, mapped);
  const auto refuse_of_orbit = add_motion_options(*orbit, motion);
  const auto refuse_of_contact = add_motion_options(*contact, motion);
  ShapeRequest shape;
  const auto refuse_of_shape = add_motion_options(*deflected, shape);
  deflected
      ->add_option("--nodes", shape.nodes,
                   "table of nodes, as shaft prints: z [m], x and y, degrees of freedom")
      ->required();
  MotionRequest spectrum;
  const auto refuse_of_spectrum = add_motion_options(*lines, spectrum);
  const auto refuse_of_response = add_response_options(*branch, response);
  add_attractors_options(*settled, attractors);
  return guarded([&] {
    if (!parse(app, argc, argv)) return 0;
    for (const auto& refuse : {refuse_of_orbit, refuse_of_shape, refuse_of_contact,
                               refuse_of_spectrum, refuse_of_response, refuse_of_map})
      refuse();
    if (map->parsed()) {
      explore_map(mapped);
      return 0;
    }
    if (beams->parsed()) return finish(shaft, "", [&] { return explore_shaft(shaft); });
    if (whirl->parsed())
      return finish(campbell, "campbell.py", [&] { return explore_campbell(campbell); });
    if (check->parsed())
      return finish(checked, "", [&] { return explore_check(checked); });
    if (settled->parsed())
      return finish(attractors, "sections.py",
                    [&] { return explore_attractors(attractors); },
                    {attractors.section, attractors.motions});
    if (branch->parsed())
      return finish(response, "response.py", [&] { return explore_response(response); },
                    {response.save, response.waterfall});
    if (lines->parsed())
      return finish(spectrum, "spectrum.py", [&] { return explore_spectrum(spectrum); });
    if (deflected->parsed())
      return finish(shape, "shape.py", [&] { return explore_shape(shape); },
                    {shape.nodes});
    if (orbit->parsed())
      return finish(motion, "orbit.py", [&] { return explore_orbit(motion); });
    return finish(motion, "contact.py", [&] { return explore_contact(motion); });
  });
}
