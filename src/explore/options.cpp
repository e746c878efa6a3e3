#include "explore/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "explore/map_quantities.hpp"
#include "io/errors.hpp"
#include "io/program.hpp"
#include "time/flow.hpp"

namespace rotor_stator::explore {

namespace {

using Options = std::vector<CLI::Option*>;
constexpr int largest_seed = 1000000000, most_samples = 1 << 20, most_points = 1 << 16;
constexpr double largest = 1e300;  // 2 pi times as much is still a number

/** An option with a number in decimal notation, in its range; the help shows its
    default. */
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

bool is_given(const CLI::Option* option)
{
  return option->count() > 0;
}

/** Throws BadInput for given options not `used` by the method; `where` they are. */
void refuse(const Options& options, bool used, const char* where,
            const std::string& method)
{
  for (const CLI::Option* option : options)
    if (!used && is_given(option))
      throw BadInput(option->get_name() + ": is " + where + ", and --method is " +
                     method);
}

/**
## Options that several commands have */

const std::string measures_in_words =
    "; of a motion amp_, peak_, mean_, rms_, amp_1X_ or phase_1X_ of x_s ... y_r, x_r_2, "
    "x_r_out, a velocity v_x_r, an acceleration a_x_r, a force F_x, F_x_2; iso_x_r, mm/s "
    "rms of ISO 20816; force, ball_load, stress, contact_share, contact_share_1, force_2";

/** A file to be read. */
template <class Name>
CLI::Option* add_input(CLI::App& command, Request& request, const std::string& option,
                       Name& file, const std::string& meaning)
{
  return command.add_option_function<std::string>(
      option,
      [&](const std::string& name) {
        file = name;
        request.inputs.push_back(name);
      },
      meaning);
}

/** A file to be written. */
CLI::Option* add_output(CLI::App& command, Request& request, const std::string& option,
                        File& file, const std::string& meaning)
{
  return command.add_option_function<std::string>(
      option,
      [&, option](const std::string& name) {
        file = name;
        request.outputs.emplace_back(option, name);
      },
      meaning);
}

/** The machine, and how the table is written. */
void add_table_options(CLI::App& command, Request& request)
{
  add_input(command, request, "parameters", request.parameter_file, "TOML parameter file")
      ->required();
  const std::string name = command.get_name();
  if (name == "map") return;  // its quantities are chosen
  const bool has_measures = name == "orbit" || name == "response" || name == "attractors";
  command.add_option_function<std::string>(
      "--columns",
      [&request](std::string names) {
        std::erase(names, ' ');
        request.columns = names;
      },
      "NAME,... that are printed, or all; others are not computed" +
          (has_measures ? measures_in_words : ""));
  command.add_option_function<std::string>(
      "--format",
      [&request](const std::string& word) {
        constexpr std::array words{"tsv", "csv", "json"};  // in the order of the type
        const auto found = std::ranges::find(words, word);
        if (found == words.end())
          throw BadInput("--format " + word + ": must be one of tsv, csv, json");
        request.format = static_cast<TableFormat>(found - words.begin());
      },
      "tsv, csv (without the # lines) or json");
}

/** Evaluations or, as 60s, seconds that begin now. */
Allowance allowance_of(const std::string& word)
{
  if (!word.ends_with('s'))
    return {.evaluations = real_number("--budget", word, 1, 1e15)};
  const double seconds =
      real_number("--budget", word.substr(0, word.size() - 1), 1e-3, 1e7);
  return {.seconds = seconds,
          .end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                    std::chrono::duration<double>(seconds))};
}

/** The same, what a run may cost and its figure. */
void add_common_options(CLI::App& command, Request& request, const std::string& budget)
{
  add_table_options(command, request);
  command.add_flag("--quiet", request.quiet,
                   "no warnings on stderr, and no progress, which a terminal gets after "
                   "two seconds");
  add_output(command, request, "--plot", request.plot, "figure: .svg, .png or .pdf");
  command.add_flag("--force", request.force,
                   "replace files that this program did not write, too");
  command
      .add_option_function<std::string>(
          "--budget",
          [&request](const std::string& word) { request.budget = allowance_of(word); },
          "most evaluations of the force " + budget +
              "; or seconds of the clock for the whole run, as 60s")
      ->type_name("NUMBER");
}

/** Options with the same `unit` are in one unit. */
template <class Number>
CLI::Option* add_speed(CLI::App& command, const std::string& name, Number& speed,
                       const std::string& meaning, bool may_rest = false,
                       std::shared_ptr<std::string> unit = {})
{
  return command
      .add_option_function<std::string>(
          name,
          [=, &speed](const std::string& word) {
            std::string own;
            speed = speed_in_hertz(name, word, unit ? *unit : own, may_rest);
          },
          meaning + " [Hz], or as 1500rpm")
      ->type_name("SPEED");
}

void add_speeds(CLI::App& command, RangeRequest& request, bool may_rest = false,
                bool is_required = true)
{
  const auto unit = std::make_shared<std::string>();
  add_speed(command, "--from", request.from, "first speed", may_rest, unit)
      ->required(is_required);
  add_speed(command, "--to", request.to, "last speed", may_rest, unit)
      ->required(is_required);
}

void add_rpm(CLI::App& command, Request& request)
{
  command.add_flag("--rpm", request.rpm, "the figure's speeds in turns a minute");
}

/** Those of harmonic balance, which are returned; `or_m`: what may stand for the default
    m. */
Options add_balance_options(CLI::App& command, Request& request, const std::string& or_m)
{
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

const char* const usual_budget =
    "in the whole run, other work counted as the evaluations that take as long (default: "
    "those of 10 s, 2.7e8 with 16 balls, for a motion in time, in response for each; of "
    "3 s for aft and shooting, up to 60 s for a branch)";

/** Options of a motion in time. */
Check add_time_options(CLI::App& command, motion::Request& request)
{
  const auto step = add_number(
      command, "--step", request.step, 0.0, largest,
      "longest step of rk4, a fourth of one of splitting [s] (default: from K_H and the "
      "speed)");
  const auto longest =
      add_number(command, "--longest", request.longest, 1e-3, 1e5,
                 "longest transient of a motion in time, after t = 0 [s]");
  return [=, &method = request.method] {
    refuse({step}, method == "auto" || has_fixed_step(method),
           "for a motion in time, by rk4, splitting or auto", method);
    refuse({longest}, !is_periodic(method), "for a motion in time", method);
  };
}

std::string methods_in_words(bool has_shooting)
{
  const std::string periodic =
      "auto (what the machine does from rest; aft with --harmonics), aft (harmonic "
      "balance), ";
  return periodic + (has_shooting ? "shooting, " : "") +
         "gauss (of bodies given by matrices), " + joined(time_methods(), ", ");
}

/** An option of harmonic balance asks for it. */
void choose_method(std::string& method, const Options& aft,
                   const std::vector<std::string>& others)
{
  if (method == "auto" && std::ranges::any_of(aft, is_given)) method = "aft";
  require_method(method, others);
  refuse(aft, method == "aft", "for --method aft", method);
}

}  // namespace

/**
## The commands */

Check add_options(CLI::App& command, MotionRequest& request)
{
  const std::string name = command.get_name();
  const bool is_spectrum = name == "spectrum";
  add_common_options(command, request, usual_budget);
  Options aft = add_balance_options(
      command, request,
      is_spectrum ? "three times BPFO, or by --tolerance" : "by --tolerance");
  add_speed(command, "--frequency", request.frequency, "speed of rotation")->required();
  command.add_option("--method", request.method, methods_in_words(true))
      ->capture_default_str();
  const auto points =
      add_number(command, "--points", request.points, is_spectrum ? 32 : 1, most_points,
                 is_spectrum ? "P, samples per period of shooting and the time methods"
                             : "P, rows per period");
  add_number(
      command, "--tolerance", request.tolerance, 1e-8, 0.1,
      "relative error of displacement, the largest and the rms about the mean; with "
      "--method aft and without --harmonics, m is chosen");
  aft.push_back(
      add_number(command, "--lines", request.lines, 1, 1024,
                 "with two frequencies: the M largest lines of the motion from rest"));
  Options periodic;
  if (name != "contact") periodic.push_back(add_subharmonic(command, request));
  if (is_spectrum)
    add_input(command, request, "--overlay", request.overlay,
              "table of a measured spectrum for --plot: f [Hz], amplitude [m]");
  if (name == "orbit" || name == "shape")
    add_number(command, "--periods", request.periods, 1, 1000,
               "base periods that are printed");
  command.add_flag("!--no-stability", request.is_measured,
                   "leave out stability and, of a motion in time, the error");
  const Check check_time = add_time_options(command, request);
  const auto local_error =
      add_number(command, "--local-error", request.local_error, 1e-15, 1e-2,
                 "relative, per step, of GSL's methods and of shooting, with which auto "
                 "closes a motion");
  return [=, &request] {
    std::string& method = request.method;
    choose_method(method, aft, {"auto", "gauss", "aft", "shooting"});
    refuse(periodic, is_periodic(method), "for the methods aft and shooting", method);
    check_time();
    if (const double turn = 1 / request.frequency; request.step > turn)
      throw BadInput(
          format("--step %g: is too long, a turn takes %.3g s", request.step, turn));
    if (request.plot && request.points < 2)
      throw BadInput("--points 1: --plot needs two or more");
    refuse({local_error}, method != "aft" && !has_fixed_step(method),
           "for shooting and the time methods without fixed steps", method);
    refuse({points}, !is_spectrum || method != "aft", "for shooting and the time methods",
           method);
  };
}

Check add_options(CLI::App& command, ShapeRequest& request)
{
  add_input(command, request, "--nodes", request.nodes,
            "table of nodes, as shaft prints: z [m], x and y, degrees of freedom")
      ->required();
  return add_options(command, static_cast<MotionRequest&>(request));
}

Check add_options(CLI::App& command, ResponseRequest& request)
{
  add_common_options(command, request, usual_budget);
  const Options asking = add_balance_options(command, request, "the saved branch's");
  Options aft = asking, branch;
  command
      .add_option("--method", request.method,
                  "auto (what the machine does, speed by speed), or a branch of periodic "
                  "solutions: aft (harmonic balance), shooting")
      ->capture_default_str();
  aft.push_back(add_subharmonic(command, request));
  CLI::Option* tolerance =
      add_number(command, "--tolerance", request.tolerance, 1e-8, 0.1,
                 "relative error; chooses the step of integration. With --method aft of "
                 "each solution, at evenly spaced speeds instead of along the branch; "
                 "with two frequencies, of the five that choose the harmonics");
  CLI::Option* count =
      add_number(command, "--count", request.count, 1, 100000,
                 "speeds, evenly spaced (101; 21 of large bodies; 1 of one speed)");
  add_speeds(command, request);
  add_rpm(command, request);
  command.add_option("--direction", request.direction,
                     "rest: each speed from rest; up, down: from the motion or solution "
                     "at the speed before");
  branch.push_back(command.add_flag(
      "--stability", request.stability,
      "Floquet multipliers of each point and, with aft, the bifurcations between"));
  branch.push_back(command.add_option(
      "--harmonics-of", request.harmonics_of,
      "x_s, y_s, x_r or y_r: its harmonics at each point, complex amplitudes"));
  aft.push_back(add_output(command, request, "--waterfall", request.waterfall,
                           "file for the lines of each point, with their names"));
  aft.push_back(add_output(command, request, "--save", request.save,
                           "file for the branch, all coefficients"));
  CLI::Option* restart = add_input(command, request, "--restart", request.restart,
                                   "file of --save to continue from");
  add_speed(command, "--at", request.at, "restart near this speed (default: the end)")
      ->needs(restart);
  add_number(command, "--branch", request.branch, 1, 1000000,
             "number of the branch to restart")
      ->needs(restart);
  CLI::Option* isolated = add_number(command, "--isolated", request.isolated, 0, 10000,
                                     "look for isolated branches at so many speeds");
  aft.push_back(isolated);
  aft.push_back(command.add_flag("--times", request.times, "CPU time on stderr"));
  add_number(command, "--seed", request.seed, 0, largest_seed,
             "of the random starts of --isolated")
      ->needs(isolated);
  const Options sweep{
      add_input(command, request, "--resume", request.resume,
                "table of the same sweep that was interrupted: its rows are kept"),
      add_number(command, "--longest", request.longest, 1e-3, 1e5,
                 "longest transient of a sweep after t = 0 [s]")};
  return [=, &request] {
    std::string& method = request.method;
    if (method == "auto" && (std::ranges::any_of(asking, is_given) || is_given(restart)))
      method = "aft";
    if (method != "auto" && method != "aft" && method != "shooting")
      throw BadInput("--method " + method + ": must be one of auto, aft, shooting");
    const bool is_sweep = method == "auto";
    const auto refuse_in_sweep = [&](const Options& options, const char* instead) {
      for (const CLI::Option* option : options)
        if (is_sweep && is_given(option)) throw BadInput(option->get_name() + instead);
    };
    refuse_in_sweep(aft,
                    ": is of a branch of solutions; give --harmonics M or "
                    "--restart FILE too");
    refuse_in_sweep(branch,
                    ": is of a branch of solutions; give --harmonics M, --method "
                    "shooting or --restart FILE too");
    refuse(aft, method == "aft", "for --method aft", method);
    refuse({restart}, method == "aft", "for --method aft", method);
    refuse({tolerance}, method != "shooting", "for --method auto or aft", method);
    refuse(sweep, is_sweep, "for a sweep, without --method", method);
    if (is_given(count) && !is_sweep && !is_given(tolerance))
      throw BadInput(
          "--count: of a branch needs --tolerance; without --harmonics and "
          "--method it is the number of speeds");
  };
}

Check add_options(CLI::App& command, AttractorsRequest& request)
{
  add_common_options(command, request,
                     "in the whole run (default: those of 1 s for each start)");
  add_speeds(command, request);
  add_number(command, "--count", request.count, 1, 10000,
             "speeds from --from to --to, evenly spaced (51)");
  add_rpm(command, request);
  add_number(command, "--starts", request.starts, 0, 1000,
             "random states to start from at each speed");
  add_number(command, "--seed", request.seed, 0, largest_seed, "of the random states");
  add_number(command, "--tolerance", request.tolerance, 1e-8, 0.1,
             "relative error; chooses the step of integration");
  add_output(command, request, "--section", request.section,
             "file for the points of the Poincare sections");
  add_output(command, request, "--motions", request.motions,
             "file for the motions themselves, with the bearing's force");
  return [] {};
}

Check add_options(CLI::App& command, MapRequest& request)
{
  std::vector<std::string> known;
  for (const Column& one : map_quantities())
    known.push_back(one.name + " [" + one.unit + "] " + one.meaning);
  add_common_options(command, request,
                     "at each point (default: those of 5 s, 1.4e8 with 16 balls)");
  const Options aft = add_balance_options(command, request, "by --tolerance");
  command.add_option(
      "--x", request.x,
      "KEY=from:to:count[:log]; KEY: frequency [Hz], or of the parameter file, "
      "as bearing.radial_clearance_m; the points of a line start from each other");
  command.add_option("--y", request.y, "the same, a line for each value");
  add_input(command, request, "--list", request.list,
            "table whose columns are keys, a line for each row, instead of --y");
  command
      .add_option("--quantity", request.quantities,
                  joined(known, "; ") + measures_in_words)
      ->delimiter(',')
      ->required();
  add_speed(command, "--frequency", request.frequency,
            "speed of rotation, where it is no key");
  command.add_option(
      "--sweep", request.sweep,
      "A:B[:COUNT], range of speeds of the quantities over one [Hz] (101)");
  command.add_option("--method", request.method, methods_in_words(false))
      ->capture_default_str();
  add_number(command, "--tolerance", request.tolerance, 1e-8, 0.1,
             "relative error; chooses the step of integration, with --method aft m");
  const Check check_time = add_time_options(command, request);
  add_number(command, "--threads", request.threads, 1, 1024,
             "parts of the map at a time (default: OMP_NUM_THREADS, or all cores)");
  command.add_option("--lines", request.lines, "A:B, only the lines with A <= index < B");
  add_input(command, request, "--resume", request.resume,
            "table of the same map that was interrupted: its rows are taken over");
  return [=, &request] {
    choose_method(request.method, aft, {"auto", "aft", "gauss"});
    check_time();
  };
}

Check add_options(CLI::App& command, CheckRequest& request)
{
  add_table_options(command, request);
  request.from = 1;
  request.to = 60;
  add_speeds(command, request, false, false);
  command.get_option("--to")->description(
      "last speed [Hz], or as 1500rpm (60); balance grade and warnings are of it");
  return [] {};
}

Check add_options(CLI::App& command, ShaftRequest& request)
{
  add_table_options(command, request);
  add_input(command, request, "--to", request.folder,
            "folder for M.mtx, C.mtx, G.mtx and K.mtx")
      ->required();
  command.add_flag("--force", request.force,
                   "replace files that this program did not write, too");
  return [] {};
}

Check add_options(CLI::App& command, CampbellRequest& request)
{
  add_common_options(command, request, "in the whole run (default: those of 60 s)");
  add_speeds(command, request, true);
  CLI::Option* count =
      add_number(command, "--count", request.count, 1, 10000,
                 "speeds from --from to --to, evenly spaced (51, 1 of one speed)");
  add_rpm(command, request);
  add_number(command, "--modes", request.modes, 1, 1000, "of lowest frequency");
  command.add_flag("--critical", request.critical,
                   "the critical speeds instead of the frequencies");
  return [&request, count] {
    if (!is_given(count) && request.from == request.to) request.count = 1;
  };
}

Check add_options(CLI::App& command, RunUpRequest& request)
{
  add_common_options(command, request, "in the whole run (default: those of 60 s)");
  add_speeds(command, request, true);
  add_rpm(command, request);
  add_number(command, "--seconds", request.seconds, 0.0, 1e6, "how long the run takes")
      ->required();
  add_output(command, request, "--waterfall", request.waterfall,
             "file for the lines of every 16 turns, with their names");
  return [] {};
}

}  // namespace rotor_stator::explore
